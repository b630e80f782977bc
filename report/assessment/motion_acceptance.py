"""The motions as run, compared with the targets at the roof and with the other limits."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

from report.assessment.checks.motion_limits import drift_limits
from report.motions.components import RecordFile
from report.motions.history import PreparedMotion, Targets
from report.motions.prepare import Shaking
from report.project.model.choices import RecordedAt
from solver.records.acceptance import Acceptance, SpectraOf, acceptance, one_by_one


def shaking_acceptance(
    shaking: Shaking, targets: Targets, spectra_of: SpectraOf = one_by_one
) -> Acceptance:
    """Compare the motions as run with the targets at the roof, and with the other limits."""
    if not shaking.motions:
        return Acceptance(rows=(), motions=())
    done = acceptance(
        shaking.motions,
        [_hold_s(prepared, shaking.records) for prepared in shaking.prepared],
        lambda freq_hz: targets.roof.ordinates(1.0 / freq_hz),
        lambda freq_hz: targets.vertical.ordinates(1.0 / freq_hz),
        spectra_of,
    )
    return replace(done, rows=(*done.rows, *drift_limits(shaking.prepared)))


def _hold_s(prepared: PreparedMotion, files: Sequence[RecordFile]) -> float:
    """Hold of the envelope that all files of a motion state [s]; NaN if any does not."""
    holds = [file.hold_s for file in files if file.motion_id == prepared.motion_id]
    # The response of a building no longer has the envelope of the ground motion.
    is_stated = prepared.recorded_at is RecordedAt.ROOF and not any(map(math.isnan, holds))
    return min(holds, default=math.nan) if is_stated else math.nan
