"""An assessment as the page shows it: finished strings beside the numbers that are drawn.

Computes nothing: every number and verdict is that of `report.assessment`. Read `answer`.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from report.assessment.arrays import NOT_PERMITTED, ArrayAssessment
from report.assessment.clearances import ClearanceCheck
from report.assessment.overrides import MEANING
from report.assessment.project import Assessment
from report.assessment.verdict import Verdict
from report.pages.front import verdict_sentence
from report.pages.registry import package_data
from report.pages.summary import attention
from report.web.plan import NO_VALUE, plan
from report.words.units import Quantity, Show, compared, measured, pair

ONE_AXIS, FULL = "one axis", "full"

_PROVISIONAL = (
    "Provisional: each motion in one axis with vertical, in the orientation that governs at the "
    "values of the workbook; cross-slope motion neglected. The full model follows when the slider "
    "rests."
)


def answer(assessment: Assessment, *, is_provisional: bool) -> dict[str, Any]:
    """Return what the page shows; values that are provisional have no verdict."""
    shown = _Shown(assessment, is_provisional)
    return {
        "model": ONE_AXIS if is_provisional else FULL,
        "model_text": (_PROVISIONAL if is_provisional else _whole(assessment))
        + (f" {MEANING}." if assessment.is_overridden else ""),
        "is_provisional": is_provisional,
        "verdict": shown.verdict(assessment.verdict),
        "verdict_text": None if is_provisional else verdict_sentence(package_data(assessment)),
        "reasons": [] if is_provisional else reasons(assessment),
        "scale_m": _scale_m(assessment),
        "arrays": [_array(shown, item) for item in assessment.arrays],
        "clearances": [_clearance(shown, gap) for gap in assessment.clearances],
        "plan": plan(assessment, shown.verdict),
    }


class _Shown:
    """How values of an assessment are shown."""

    def __init__(self, assessment: Assessment, is_provisional: bool) -> None:
        self.assessment, self._is_provisional = assessment, is_provisional
        self.us_first = assessment.project.project.units_first == "US"

    def verdict(self, verdict: Verdict) -> str | None:
        """Return a verdict; none while values are provisional."""
        return None if self._is_provisional else verdict.value

    def source(self, item: ArrayAssessment) -> str:
        """Return what governs, if anything; while values are provisional, not whether it may."""
        if math.isnan(item.design_m):
            return ""
        return item.governs.value if self._is_provisional else item.source

    def is_refused(self, item: ArrayAssessment) -> bool:
        """Whether a design displacement is not permitted; while provisional, that is not known."""
        return item.has_unpermitted_value and not self._is_provisional

    def length(self, value_m: float) -> str:
        """Return a displacement in both systems of units, or that there is none."""
        return NO_VALUE if math.isnan(value_m) else pair(value_m, Quantity.SIZE, self.us_first)

    def short(self, value_m: float, show: Show = measured) -> str:
        """Return a length in the first system of units."""
        unit = Quantity.SIZE.us if self.us_first else Quantity.SIZE.si
        return NO_VALUE if math.isnan(value_m) else f"{show(value_m, unit)} {unit.symbol}"


def _whole(assessment: Assessment) -> str:
    """Return which models the values are of."""
    found = {run.solution.rung for a in assessment.arrays for m in a.motions for run in m.runs}
    names = ", ".join(f"{rung.title} ({int(rung)})" for rung in sorted(found))
    return f"Full model, as in the package. Models of the runs: {names}."


def reasons(assessment: Assessment) -> list[dict[str, str]]:
    """Return what needs attention, as `roofslip report` prints it."""
    return [{"level": line.level, "text": line.text} for line in attention(assessment)]


def finite(value: float) -> float | None:
    """Return a number, or none for NaN and infinity, which JSON does not have."""
    return value if math.isfinite(value) else None


def _array(shown: _Shown, item: ArrayAssessment) -> Mapping[str, Any]:
    values = {
        "mean_prd": item.analysis.mean_m,
        "largest_prd": item.analysis.largest_m,
        "design": item.design_m,
        "prescriptive": item.prescriptive.value_m,
    }
    return {
        "id": item.id,
        **{f"{name}_m": finite(value) for name, value in values.items()},
        **{name: shown.length(value) + _mark(item, name) for name, value in values.items()},
        **{
            f"{name}_short": shown.short(value) + _mark(item, name)
            for name, value in values.items()
        },
        **({"design_m": None, "design_short": NOT_PERMITTED} if shown.is_refused(item) else {}),
        "source": shown.source(item),
        "verdict": shown.verdict(shown.assessment.array_verdict(item)),
        "bars": [
            {
                "motion": run.motion.id,
                "prd_m": finite(run.governing.prd_m),
                "text": shown.length(run.governing.prd_m),
                "short": shown.short(run.governing.prd_m),
            }
            for run in item.motions
        ],
    }


def _mark(item: ArrayAssessment, name: str) -> str:
    """Return the mark of a number of an array that an override or a departure changes."""
    if math.isnan(item.design_m):
        return ""
    prescriptive = item.mark(lambda array: array.prescriptive.value_m)
    return {"design": item.design_mark, "prescriptive": prescriptive}.get(name, "")


def _clearance(shown: _Shown, gap: ClearanceCheck) -> Mapping[str, Any]:
    row = gap.clearance
    required, provided = compared(gap.required_m, row.provided_m)
    has_none = math.isnan(gap.required_m)
    return {
        "array": row.array,
        "object": row.object,
        "direction": row.direction.value,
        "provided_m": row.provided_m,
        "required_m": finite(gap.required_m),
        "ratio": finite(gap.demand_capacity),
        "provided": pair(row.provided_m, Quantity.SIZE, shown.us_first, provided),
        "required": NO_VALUE if has_none
        else pair(gap.required_m, Quantity.SIZE, shown.us_first, required) + gap.mark,
        "provided_short": shown.short(row.provided_m, provided),
        "required_short": shown.short(gap.required_m, required) + gap.mark,
        "ratio_text": NO_VALUE if has_none else gap.ratio_words,
        "verdict": shown.verdict(gap.verdict),
    }  # fmt: skip


def _scale_m(assessment: Assessment) -> float:
    """Return the largest length that the bars show [m]."""
    return max(filter(math.isfinite, _lengths(assessment.arrays)), default=0.0)


def _lengths(arrays: Sequence[ArrayAssessment]) -> Iterator[float]:
    for item in arrays:
        yield from (item.design_m, item.prescriptive.value_m)
        yield from (run.governing.prd_m for run in item.motions)
