"""Effect of the high-pass filter of each motion on the slip of the governing array."""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import chain

from report.assessment.assessment import Assessment
from report.runs import run_motion


@dataclass(frozen=True, slots=True, kw_only=True)
class Beyond:
    """One array under one motion, with the high-pass as run and without it [m]."""

    motion_id: str
    corner_hz: float
    filtered_m: float
    unfiltered_m: float

    @property
    def share(self) -> float:
        """Fraction of the PRD without high-pass that the filter removes; NaN without sliding."""
        if not self.unfiltered_m > 0.0:
            return math.nan
        return (self.unfiltered_m - self.filtered_m) / self.unfiltered_m


def beyond_corners(assessment: Assessment) -> tuple[Beyond, ...]:
    """Rerun the governing array without high-pass under every motion that has one."""
    rows, governing = assessment.project.motions, assessment.governing
    corners = {row.id: row.highpass_hz or math.nan for row in rows}
    as_run_m = {run.motion.id: run.governing.prd_m for run in governing.motions}
    unfiltered = chain.from_iterable(motion.unfiltered for motion in assessment.shaking.prepared)
    return tuple(
        Beyond(
            motion_id=motion.id,
            corner_hz=corners[motion.id],
            filtered_m=as_run_m[motion.id],
            unfiltered_m=run_motion(governing.array, motion).governing.prd_m,
        )
        for motion in unfiltered
    )
