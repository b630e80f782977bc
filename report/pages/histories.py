"""Histories and paths in plan of the governing runs, by group of arrays."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from report.assessment.support.evidence import Evidence
from report.pages.parts import PackageData
from report.text.names import named
from solver.model import SlideHistory

_HISTORIES = "Relative displacement histories of"


def axes(paths: Iterable[SlideHistory]) -> str:
    """Return along which axes the displacements of runs are drawn, and how."""
    if any(path.across_m.size for path in paths):
        left = "positive to the left when facing downslope (dashed)"
        return f": downslope (solid) and cross-slope, {left}"
    return ", downslope"


def page(package: PackageData, evidence: Evidence) -> Mapping[str, object]:
    """Return of each group: its names, what its charts are of, and the motions without a path."""
    groups = []
    for group, paths in zip(package.assessment.alike, evidence.histories, strict=True):
        # In one axis a path is a line along the slope: it is drawn, and the caption says why.
        straight = [
            run.motion.id
            for run, path in zip(group[0].motions, paths, strict=True)
            if not path.across_m.size and path.result.prd_m > 0.0
        ]
        ids = [item.id for item in group]
        histories, plan = (f"{of} {named(ids, 'array')}" for of in (_HISTORIES, "Paths of"))
        groups.append((named(ids, "Array"), histories, f"{plan} in plan", axes(paths), straight))
    return {"groups": groups}
