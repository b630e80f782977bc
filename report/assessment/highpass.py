"""How much of the slip comes from periods that a high-pass takes away.

Runs the solver on motions with their high-pass left out; `report.pages.motions` says the outcome.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from report.assessment.arrays import ArrayAssessment, same_id
from report.assessment.project import Assessment
from report.assessment.runs import run_motion


@dataclass(frozen=True, slots=True, kw_only=True)
class Beyond:
    """One array under one motion, with its high-pass as run and without it [m]."""

    motion_id: str
    corner_hz: float
    filtered_m: float
    unfiltered_m: float

    @property
    def share(self) -> float:
        """Part of the PRD without the high-pass that is lost with it; NaN where nothing slides."""
        if not self.unfiltered_m > 0.0:
            return math.nan
        return (self.unfiltered_m - self.filtered_m) / self.unfiltered_m


def beyond_corners(assessment: Assessment) -> tuple[Beyond, ...]:
    """Run the governing array under every motion that has a high-pass once more without it."""
    rows, found = assessment.project.motions, assessment.governing
    corners = {row.id.casefold(): row.highpass_hz or math.nan for row in rows}
    return tuple(
        Beyond(
            motion_id=bare.id,
            corner_hz=corners[bare.id.casefold()],
            filtered_m=_prd_m(found, bare.id),
            unfiltered_m=run_motion(found.array, bare).governing.result.prd_m,
        )
        for prepared in assessment.shaking.prepared
        for bare in prepared.unfiltered
    )


def _prd_m(found: ArrayAssessment, motion_id: str) -> float:
    run = next(run for run in found.motions if same_id(run.motion.id, motion_id))
    return run.governing.result.prd_m
