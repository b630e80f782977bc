"""An assessment as the page shows it: finished strings beside the numbers that are drawn.

Computes nothing: every number and verdict is that of `report.assessment`. Read `answer`.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

from report.assessment.assessment import Assessment
from report.assessment.causes import governing_words
from report.assessment.design.arrays import ArrayAssessment
from report.assessment.design.routes import NOT_PERMITTED
from report.assessment.design.rule_set import MEANING
from report.assessment.design.verdict import Verdict
from report.assessment.plan.neighbors import PlanNeighbor
from report.drawing.sheet import unit_format
from report.pages.attention import attention
from report.pages.checks import verdict_sentence
from report.pages.clearance_tables import NumberedGap, numbered_gaps
from report.pages.marks import Marks
from report.text.unit_format import UnitFormat
from report.text.units import Show, no_less
from report.web.plan import USUAL_PX, Cell, ShowVerdict, described, plan, stamp

_ARRAY_HEADS = ["Array", "Mean PRD", "Design", "Prescriptive", "Verdict"]
_GAP_HEADS = ["No.", "From, to", "Provided", "Required", "D/C", "Verdict"]

_PROVISIONAL = (
    "Provisional: each motion in the two orientations with the largest PRD at rest. All of them "
    "follow when the slider rests."
)
_LESS = "What less friction would change is being computed."


def answer(
    assessment: Assessment, *, is_provisional: bool, room_px: int = USUAL_PX
) -> dict[str, Any]:
    """Return what the page shows, with room for its plan; provisional values have no verdict."""
    marks = Marks(assessment, has_daggers=False)
    fmt = unit_format(assessment)
    arrays, gaps = assessment.arrays, numbered_gaps(assessment)
    missing = [near for near in assessment.neighbors if near.is_missing]
    designs = {item.id: _design(marks, item, is_provisional) for item in arrays}

    # What less friction would change is computed after the rest; only an OK may change by it.
    is_whole = is_provisional or assessment.at_reduced_friction is not None
    may_change = not is_whole and assessment.verdict is Verdict.OK

    def verdict(verdict: Verdict, text: str = "") -> Cell | None:
        return None if is_provisional else stamp(verdict, text)

    return {
        "model_text": (_PROVISIONAL if is_provisional else _whole(assessment))
        + (f" {MEANING}." if assessment.is_overridden else ""),
        "verdict": {"text": "OK so far", "look": "provisional"}
        if may_change
        else verdict(assessment.verdict, assessment.verdict.value),
        "line": "" if is_provisional else _LESS if may_change else governing_words(assessment),
        # What it rests on; the reasons are listed below it.
        "verdict_text": None
        if is_provisional or may_change
        else verdict_sentence(assessment, "here"),
        "reasons": []
        if is_provisional
        else [
            {"level": level, "text": text} for level, text in attention(assessment, may_run=False)
        ],
        # Of what is not whole, the rest is asked next.
        "pending": "" if is_whole else _LESS,
        "arrays": {
            "caption": "Arrays: displacement",
            "heads": _ARRAY_HEADS,
            "rows": [
                [
                    {"text": item.id},
                    _length(fmt, item.analysis.mean_m, no_less),
                    designs[item.id],
                    _prescriptive(marks, item),
                    verdict(assessment.array_verdict(item)),
                ]
                for item in arrays
            ],
        },
        "clearances": {
            "caption": "Clearances",
            "heads": _GAP_HEADS,
            "rows": [
                *(_gap(gap, marks, verdict) for gap in gaps),
                *(_missing(near, fmt, verdict) for near in missing),
            ],
        },
        "bars": {
            "heads": ["Motion", "Bar", "PRD"],
            "arrays": {item.id: _bars(marks, item, designs[item.id]) for item in arrays},
        },
        "tips": _tips(marks, designs, gaps),
        "plan": plan(marks, designs, (gaps, missing), verdict, room_px),
    }


def _design(marks: Marks, item: ArrayAssessment, is_provisional: bool) -> Cell:
    """Return the design displacement and what governs; while provisional, not whether it may."""
    fmt = unit_format(marks.assessment)
    if math.isnan(item.design_m):
        return {"text": fmt.none}
    cell = _length(fmt, item.design_m, no_less, marks.design(item))
    if is_provisional:
        return cell | {"title": f"{cell['title']}, {item.governs.value}"}
    text = NOT_PERMITTED if item.has_unpermitted_value else cell["text"]
    return {"text": text, "title": f"{cell['title']}, {item.source}"}


def _prescriptive(marks: Marks, item: ArrayAssessment) -> Cell:
    mark = marks.prescriptive(item)
    return _length(unit_format(marks.assessment), item.prescriptive.value_m, no_less, mark)


def _length(fmt: UnitFormat, value_m: float, show: Show, mark: str = "") -> dict[str, str]:
    """Return a length in the preferred system, with both as its title; none has no title."""
    text, both = (way(value_m, show=show, mark=mark) for way in (fmt.short, fmt.both))
    return {"text": text} if text == both else {"text": text, "title": both}


def _ratio(gap: NumberedGap, fmt: UnitFormat) -> str:
    return fmt.none if math.isnan(gap.check.demand_capacity) else gap.check.ratio_words


def _gap(gap: NumberedGap, marks: Marks, verdict: ShowVerdict) -> list[Cell | None]:
    fmt, (had, needed), row = unit_format(marks.assessment), gap.check.shows, gap.check.clearance
    return [
        {"text": str(gap.number)},
        _between(row.array, row.object, row.direction.value),
        _length(fmt, row.provided_m, had),
        _length(fmt, gap.check.required_m, needed, marks.required(gap.check)),
        {"text": _ratio(gap, fmt)},
        verdict(gap.check.verdict),
    ]


def _missing(near: PlanNeighbor, fmt: UnitFormat, verdict: ShowVerdict) -> list[Cell | None]:
    """Return a pair of the plan without a clearance."""
    had, needed = near.shows
    lengths = ((near.gap_m, had, ""), (near.required_m, needed, near.mark))
    missing_cells = (
        {"text": fmt.short(value_m, show=show) + mark, "title": fmt.both(value_m, show=show)}
        for value_m, show, mark in lengths
    )
    names, none = _between(near.array, near.other, "not entered; in plan"), {"text": ""}
    return [none, names, *missing_cells, none, verdict(near.verdict)]


def _between(first: str, other: str, note: str) -> Cell:
    return {"text": f"{first} to {other}", "from": first, "to": other, "note": note}


def _tips(marks: Marks, designs: Mapping[str, Cell], gaps: Sequence[NumberedGap]) -> dict[str, str]:
    """Return what the plan tells of each array, object and clearance, by name and by number."""
    assessment, fmt = marks.assessment, unit_format(marks.assessment)
    tips = {id: f"{id}: Δ {design.get('title', fmt.none)}" for id, design in designs.items()}
    tips |= {row.id: f"{row.id}: {row.kind.value}" for row in assessment.project.objects}
    worst: dict[str, NumberedGap] = {}
    for gap in gaps:
        tips[f"#{gap.number}"] = f"{described(gap, marks)}, D/C {_ratio(gap, fmt)}"
        for name in gap.check.between:
            known = worst.get(name)
            if known is None or not gap.check.demand_capacity <= known.check.demand_capacity:
                worst[name] = gap
    for name, gap in worst.items():
        other = gap.check.across_from(name)
        tips[name] = f"{tips.get(name, name)}, D/C {_ratio(gap, fmt)} to {other}"
    return tips


def _bars(marks: Marks, item: ArrayAssessment, design: Cell) -> Mapping[str, Any]:
    """Return the PRD of each motion, and the lengths that are lines across its bars."""
    # A displacement that is not permitted is no line across the bars.
    design_m = math.nan if design["text"] == NOT_PERMITTED else item.design_m
    fmt, prescriptive = unit_format(marks.assessment), _prescriptive(marks, item)
    lines = {
        "design": (design_m, design["text"]),
        "prescriptive": (item.prescriptive.value_m, prescriptive["text"]),
    }
    return {
        "caption": f"PRD of {item.id} by motion",
        "lines": [
            {"look": name, "length_m": finite(value_m), "text": f"{name} {text}"}
            for name, (value_m, text) in lines.items()
        ],
        "rows": [
            {
                "motion": run.motion.id,
                "prd_m": finite(run.governing.prd_m),
                "text": fmt.short(run.governing.prd_m, show=no_less),
            }
            for run in item.motions
        ],
    }


def _whole(assessment: Assessment) -> str:
    """Return which models the values are of."""
    models = {run.solution.model for a in assessment.arrays for m in a.motions for run in m.runs}
    names = ", ".join(f"{model.title} ({int(model)})" for model in sorted(models))
    return f"Full model, as in the package. Models of the runs: {names}."


def finite(value: float) -> float | None:
    """Return a number, or none for NaN and infinity, which JSON does not have."""
    return value if math.isfinite(value) else None
