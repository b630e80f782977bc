"""Acceptance of the motions of a project, as run at the roof.

Computes nothing itself: `solver.records.acceptance` does. Read `shaking_acceptance`.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

from report.motions.components import RecordFile
from report.motions.history import PreparedMotion
from report.motions.prepare import Shaking
from report.motions.targets import Targets
from report.sheet.schema.choices import RecordedAt
from solver.records.acceptance import Acceptance, acceptance


def shaking_acceptance(shaking: Shaking, targets: Targets) -> Acceptance:
    """Compare the motions as run with the targets at the roof, and with the other limits.

    Without motions, no limit on them applies.
    """
    if not shaking.motions:
        return Acceptance(rows=(), motions=())
    return acceptance(
        shaking.motions,
        [_hold_s(prepared, shaking.records) for prepared in shaking.prepared],
        lambda freq_hz: targets.roof.ordinates(1.0 / freq_hz),
        lambda freq_hz: targets.vertical.ordinates(1.0 / freq_hz),
    )


def _hold_s(prepared: PreparedMotion, files: Sequence[RecordFile]) -> float:
    """Hold of the envelope that all files of a motion state [s]; NaN if any does not.

    The response of a building no longer has the envelope of the ground motion.
    """
    holds = [file.hold_s for file in files if file.motion_id == prepared.motion_id]
    is_stated = prepared.recorded_at is RecordedAt.ROOF and not any(map(math.isnan, holds))
    return min(holds, default=math.nan) if is_stated else math.nan
