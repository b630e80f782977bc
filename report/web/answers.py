"""An assessment as the page shows it: finished strings beside the numbers that are drawn.

Computes nothing: every number and verdict is that of `report.assessment`. Read `answer`.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

from report.assessment.causes import governing_words
from report.assessment.neighbors import PlanNeighbor
from report.assessment.project import Assessment
from report.assessment.routes import NOT_PERMITTED
from report.assessment.runs import MotionRun
from report.assessment.verdict import MEANING, Verdict
from report.drawing.sheet import unit_format
from report.entities.array import ArrayRow, short_rows
from report.entities.clearance import ClearanceResult, clearance_results
from report.entities.requirement import Marked
from report.entities.shown import UnitFormat
from report.pages.checks import verdict_sentence
from report.pages.summary import attention
from report.text.amounts import capacity, demand, shown_in_order
from report.text.units import no_less
from report.web.plan import USUAL_PX, Cell, ShowVerdict, cells, described, heads, plan, stamp

_ARRAY = "id mean_prd_m design_m prescriptive_m verdict"
_CLEARANCE = "count array provided_m required_m demand_capacity verdict"

_PROVISIONAL = (
    "Provisional: each motion in the two orientations with the largest PRD at rest. All of them "
    "follow when the slider rests."
)
_LESS = "What less friction would change is being computed."


def answer(
    assessment: Assessment, *, is_provisional: bool, room_px: int = USUAL_PX
) -> dict[str, Any]:
    """Return what the page shows, with room for its plan; provisional values have no verdict."""
    marked = Marked(assessment=assessment, has_daggers=False)
    fmt = unit_format(assessment)
    arrays = list(short_rows(marked))
    gaps = list(clearance_results(marked, dict(enumerate(assessment.clearances, start=1))))
    missing = [near for near in assessment.neighbors if near.is_missing]
    designs = {item.id: _design(item, fmt, is_provisional) for item in arrays}

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
            "heads": heads(ArrayRow, _ARRAY, mean_prd_m="Mean PRD"),
            "rows": [
                cells(item, _ARRAY, fmt, design_m=designs[item.id], verdict=verdict(item.verdict))
                for item in arrays
            ],
        },
        "clearances": {
            "caption": "Clearances",
            "heads": heads(ClearanceResult, _CLEARANCE, array="From, to"),
            "rows": _rows(gaps, missing, fmt, verdict),
        },
        "bars": {
            "heads": ["Motion", "Bar", "PRD"],
            "arrays": {
                item.id: _bars(item, assessed.motions, fmt, designs[item.id])
                for item, assessed in zip(arrays, assessment.arrays, strict=True)
            },
        },
        "tips": _tips(assessment, arrays, designs, gaps),
        "plan": plan(assessment, designs, (gaps, missing), fmt, verdict, room_px),
    }


def _design(item: ArrayRow, fmt: UnitFormat, is_provisional: bool) -> Cell:
    """Return the design displacement and what governs; while provisional, not whether it may."""
    if math.isnan(item.design_m):
        return {"text": fmt.none}
    text, both = item.short("design_m", fmt), item.both("design_m", fmt)
    if is_provisional:
        return {"text": text, "title": f"{both}, {item.design_governs.value}"}
    return {"text": NOT_PERMITTED if item.is_refused else text, "title": f"{both}, {item.source}"}


def _rows(
    gaps: Sequence[ClearanceResult],
    missing: Sequence[PlanNeighbor],
    fmt: UnitFormat,
    verdict: ShowVerdict,
) -> list[list[Cell | None]]:
    """Return the clearances in the order of the workbook, then pairs of the plan without one."""
    rows = []
    for gap in gaps:
        names = _between(gap.array, gap.object, gap.direction.value)
        rows.append(cells(gap, _CLEARANCE, fmt, array=names, verdict=verdict(gap.verdict)))
    return [*rows, *(_missing(near, fmt, verdict) for near in missing)]


def _missing(near: PlanNeighbor, fmt: UnitFormat, verdict: ShowVerdict) -> list[Cell | None]:
    had, needed = shown_in_order(capacity(near.gap_m), demand(near.required_m))
    lengths = ((near.gap_m, had, ""), (near.required_m, needed, near.mark))
    missing_cells = (
        {"text": fmt.short(value_m, show=show) + mark, "title": fmt.both(value_m, show=show)}
        for value_m, show, mark in lengths
    )
    names, none = _between(near.array, near.other, "not entered; in plan"), {"text": ""}
    return [none, names, *missing_cells, none, verdict(near.verdict)]


def _between(first: str, other: str, note: str) -> Cell:
    return {"text": f"{first} to {other}", "from": first, "to": other, "note": note}


def _tips(
    assessment: Assessment,
    arrays: Sequence[ArrayRow],
    designs: Mapping[str, Cell],
    gaps: Sequence[ClearanceResult],
) -> dict[str, str]:
    """Return what the plan tells of each array, object and clearance, by name and by number."""
    fmt = unit_format(assessment)
    tips = {item.id: f"{item.id}: Δ {designs[item.id].get('title', fmt.none)}" for item in arrays}
    tips |= {row.id: f"{row.id}: {row.kind.value}" for row in assessment.project.objects}
    worst: dict[str, ClearanceResult] = {}
    for gap in gaps:
        tips[f"#{gap.count}"] = f"{described(gap, fmt)}, D/C {gap.short('demand_capacity', fmt)}"
        for name in (gap.array, gap.object):
            known = worst.get(name)
            if known is None or not gap.demand_capacity <= known.demand_capacity:
                worst[name] = gap
    for name, gap in worst.items():
        other = gap.object if name == gap.array else gap.array
        ratio = gap.short("demand_capacity", fmt)
        tips[name] = f"{tips.get(name, name)}, D/C {ratio} to {other}"
    return tips


def _bars(
    item: ArrayRow, motions: Sequence[MotionRun], fmt: UnitFormat, design: Cell
) -> Mapping[str, Any]:
    """Return the PRD of each motion, and the lengths that are lines across its bars."""
    # A displacement that is not permitted is no line across the bars.
    design_m = math.nan if design["text"] == NOT_PERMITTED else item.design_m
    lines = {
        "design": (design_m, design["text"]),
        "prescriptive": (item.prescriptive_m, item.short("prescriptive_m", fmt)),
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
                "prd_m": finite(prd_m),
                "text": fmt.short(prd_m, show=no_less),
            }
            for run, prd_m in ((run, run.governing.prd_m) for run in motions)
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
