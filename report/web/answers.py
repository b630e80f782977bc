"""An assessment as the page shows it: finished strings beside the numbers that are drawn.

Computes nothing: every number and verdict is that of `report.assessment`. Read `answer`.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from report.assessment.arrays import NOT_PERMITTED, ArrayAssessment
from report.assessment.overrides import MEANING
from report.assessment.project import Assessment
from report.assessment.runs import MotionRun
from report.assessment.verdict import Verdict
from report.entities.array import ArrayResult, array_results
from report.entities.clearance import ClearanceResult, clearance_results
from report.entities.columns import UnitFormat
from report.entities.marks import Marked
from report.entities.shown import Entity
from report.pages.front import verdict_sentence
from report.pages.registry import package_data
from report.pages.summary import attention
from report.web.plan import NO_VALUE, plan

ONE_AXIS, FULL = "one axis", "full"

_PROVISIONAL = (
    "Provisional: each motion in one axis with vertical, in the orientation that governs at the "
    "values of the workbook; cross-slope motion neglected. The full model follows when the slider "
    "rests."
)


def answer(assessment: Assessment, *, is_provisional: bool) -> dict[str, Any]:
    """Return what the page shows; values that are provisional have no verdict."""
    marked = Marked(assessment=assessment, has_daggers=False)
    fmt = UnitFormat(us_first=marked.fmt.us_first, none=NO_VALUE)
    gaps = dict(enumerate(assessment.clearances))

    def verdict(found: Verdict) -> str | None:
        return None if is_provisional else found.word

    def array(item: ArrayResult, assessed: ArrayAssessment) -> Mapping[str, Any]:
        is_refused = item.is_refused and not is_provisional
        return {
            "id": item.id,
            **_lengths(item, ("mean_prd", "largest_prd", "design", "prescriptive"), fmt),
            **({"design_m": None, "design_short": NOT_PERMITTED} if is_refused else {}),
            "source": _source(item, is_provisional),
            "verdict": verdict(item.verdict),
            "bars": [_bar(run, fmt) for run in assessed.motions],
        }

    def clearance(item: ClearanceResult) -> Mapping[str, Any]:
        return {
            **item.model_dump(include={"array", "object", "direction"}),
            **_lengths(item, ("provided", "required"), fmt),
            "ratio": finite(item.demand_capacity),
            "ratio_text": item.both("demand_capacity", fmt),
            "verdict": verdict(item.verdict),
        }

    rows = list(clearance_results(marked, gaps))
    return {
        "model": ONE_AXIS if is_provisional else FULL,
        "model_text": (_PROVISIONAL if is_provisional else _whole(assessment))
        + (f" {MEANING}." if assessment.is_overridden else ""),
        "is_provisional": is_provisional,
        "verdict": None if is_provisional else assessment.verdict.value,
        "verdict_text": None if is_provisional else verdict_sentence(package_data(assessment)),
        "reasons": [] if is_provisional else reasons(assessment),
        "scale_m": _scale_m(assessment),
        "arrays": list(map(array, array_results(marked), assessment.arrays)),
        "clearances": list(map(clearance, rows)),
        "plan": plan(assessment, rows, fmt, verdict),
    }


def _lengths(item: Entity, names: Sequence[str], fmt: UnitFormat) -> dict[str, Any]:
    """Return displacements and sizes: the numbers, in both systems of units, and in one."""
    return {
        **{f"{name}_m": finite(getattr(item, f"{name}_m")) for name in names},
        **{name: item.both(f"{name}_m", fmt) for name in names},
        **{f"{name}_short": item.short(f"{name}_m", fmt) for name in names},
    }


def _source(item: ArrayResult, is_provisional: bool) -> str:
    """Return what governs, if anything; while values are provisional, not whether it may."""
    if math.isnan(item.design_m):
        return ""
    return item.design_governs.value if is_provisional else item.source


def _bar(run: MotionRun, fmt: UnitFormat) -> Mapping[str, Any]:
    prd_m = run.governing.prd_m
    return {
        "motion": run.motion.id,
        "prd_m": finite(prd_m),
        "text": fmt.both(prd_m),
        "short": fmt.short(prd_m),
    }


def _whole(assessment: Assessment) -> str:
    """Return which models the values are of."""
    found = {run.solution.model for a in assessment.arrays for m in a.motions for run in m.runs}
    names = ", ".join(f"{model.title} ({int(model)})" for model in sorted(found))
    return f"Full model, as in the package. Models of the runs: {names}."


def reasons(assessment: Assessment) -> list[dict[str, str]]:
    """Return what needs attention, as `roofslip report` prints it."""
    return [{"level": line.level, "text": line.text} for line in attention(assessment)]


def finite(value: float) -> float | None:
    """Return a number, or none for NaN and infinity, which JSON does not have."""
    return value if math.isfinite(value) else None


def _scale_m(assessment: Assessment) -> float:
    """Return the largest length that the bars show [m]."""
    return max(filter(math.isfinite, _drawn(assessment.arrays)), default=0.0)


def _drawn(arrays: Sequence[ArrayAssessment]) -> Iterator[float]:
    for item in arrays:
        yield from (item.design_m, item.prescriptive.value_m)
        yield from (run.governing.prd_m for run in item.motions)
