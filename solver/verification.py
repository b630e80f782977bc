"""Everything that a verification of the software computes, as plain data.

Draws nothing and writes no files. Read `verify`, then `solver.evidence` for what it gives.
"""

from __future__ import annotations

from solver.evidence import (
    CheckRow,
    Conditioning,
    Convergence,
    DesignCurves,
    LinkComparison,
    PeerPoint,
    StabilityMap,
    Verification,
    WorkPoint,
)

__all__ = [
    "CheckRow",
    "Conditioning",
    "Convergence",
    "DesignCurves",
    "LinkComparison",
    "PeerPoint",
    "StabilityMap",
    "Verification",
    "WorkPoint",
]
