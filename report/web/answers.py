"""An assessment as shown on the page: finished strings and the numbers for drawing.

Computes nothing: every number and verdict is that of `report.assessment`. Read `answer`.
"""

from __future__ import annotations

import math
import string
from collections.abc import Iterator, Mapping, Sequence
from itertools import chain
from typing import Any

from report.assessment.assessment import Assessment
from report.assessment.causes import failed, governing_words, largest
from report.assessment.checks.check import Check, by_ratio
from report.assessment.checks.sentence import sentence, size, words
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
from report.text.counts import numbered
from report.text.grouping import grouped_by
from report.text.json_numbers import finite
from report.text.names import ranged
from report.text.unit_format import UnitFormat
from report.text.units import Show, no_less, ratio
from report.web.plan import USUAL_PX, Cell, ShowVerdict, described, plan, stamp

_MEAN = "Mean PRD"
_ARRAY_HEADS = ["Array", _MEAN, "Design Δ", "Prescriptive", "D/C", "Verdict"]
_GAP_HEADS = ["No.", "From, to", "Provided", "Required", "D/C", "Verdict"]

_PROVISIONAL = (
    "Provisional: each motion is run only in the orientations that had the largest PRDs in the "
    "last full run, so that a displacement may be too small. All orientations are run when you "
    "release the slider."
)
_LESS = "Computing the effect of reduced friction."


def answer(
    assessment: Assessment, *, is_provisional: bool, room_px: int = USUAL_PX
) -> dict[str, Any]:
    """Return the content of the page, with the plan's width; provisional values have no verdict."""
    marks = Marks(assessment, has_daggers=False)
    fmt = unit_format(assessment)
    arrays, gaps = assessment.arrays, numbered_gaps(assessment)
    ratios = _ratios(assessment, gaps)
    missing = [near for near in assessment.neighbors if near.is_missing]
    designs = {item.id: _design(marks, item, is_provisional) for item in arrays}

    reasons = [] if is_provisional else list(_reasons(assessment))
    # What less friction would change is computed after the rest; only an OK may change by it.
    is_whole = is_provisional or assessment.at_reduced_friction is not None
    may_change = not is_whole and assessment.verdict is Verdict.OK

    def verdict(verdict: Verdict) -> Cell | None:
        return None if is_provisional else stamp(verdict)

    return {
        "model_text": (_PROVISIONAL if is_provisional else _whole(assessment))
        + (f" {MEANING}." if assessment.is_overridden else ""),
        "verdict": {"text": "OK (provisional)", "look": "provisional"}
        if may_change
        # The checks of provisional values are not computed: they take a third of the time.
        else None
        if is_provisional
        else stamp(assessment.verdict, assessment.verdict.value),
        "line": "" if is_provisional else _LESS if may_change else governing_words(assessment),
        "worst": _worst(assessment, is_provisional),
        "next": "" if is_provisional or may_change else _next_step(assessment, reasons),
        # What it rests on; the reasons are listed below it.
        "verdict_text": None
        if is_provisional or may_change
        else verdict_sentence(assessment, "here"),
        "reasons": reasons,
        # Of what is not whole, the rest is asked next.
        "pending": "" if is_whole else _LESS,
        "arrays": {
            "caption": "Arrays: displacement",
            "heads": [head for head in _ARRAY_HEADS if assessment.has_motions or head != _MEAN],
            "rows": _array_rows(marks, designs, ratios, is_provisional),
        },
        "clearances": {
            "caption": "Clearances",
            "heads": _GAP_HEADS,
            "rows": [
                *(_gap(gap, marks, verdict) for gap in gaps),
                *(_missing(near, fmt, verdict) for near in missing),
            ],
        },
        "bars": {item.id: _bars(marks, item, designs[item.id]) for item in arrays},
        "tips": _tips(marks, designs, gaps),
        "plan": plan(marks, designs, (gaps, missing), verdict, ratios, room_px),
    }


def _ratios(assessment: Assessment, gaps: Sequence[NumberedGap]) -> Mapping[str, float]:
    """Return the D/C of each clearance, and the largest of those of each array, by their keys."""
    ratios = {f"#{gap.number}": gap.check.demand_capacity for gap in gaps}
    for item in assessment.arrays:
        gap = assessment.governing_gap(item.id)
        ratios[item.id] = gap.demand_capacity if gap else math.nan
    return ratios


def _array_rows(
    marks: Marks, designs: Mapping[str, Cell], ratios: Mapping[str, float], is_provisional: bool
) -> list[list[Any]]:
    """Return the arrays, those that differ in their name alone as one row with the names of all."""
    assessment, fmt = marks.assessment, unit_format(marks.assessment)
    rows: list[list[Cell | None]] = []
    for item in assessment.arrays:
        row: list[Cell | None] = [{"text": item.id}]
        if assessment.has_motions:
            row.append(_length(fmt, item.analysis.mean_m, no_less))
        row += designs[item.id], _prescriptive(marks, item), {"text": _ratio(ratios[item.id], fmt)}
        row.append(None if is_provisional else stamp(assessment.array_verdict(item)))
        rows.append(row)
    alike = grouped_by(rows, lambda row: str(row[1:]))
    return [[_names(group), *group[0][1:]] for group in alike.values()]


def _names(rows: Sequence[Sequence[Cell | None]]) -> Mapping[str, Any]:
    ids = [str(row[0]["text"]) for row in rows if row[0]]
    return {"text": ranged(ids), "ids": ids}


def _worst(assessment: Assessment, is_provisional: bool) -> Mapping[str, Any] | None:
    """Return the check that governs, with its D/C; of provisional values the clearance."""
    if is_provisional:
        gap = assessment.governing_gap()
        between = " to ".join(gap.between) if gap else ""
        return _headline(f"Clearance {between}", gap.demand_capacity) if gap else None
    satisfied = largest(assessment)
    clearances = [check for check in satisfied if check.id == "clearance"]
    checks = failed(assessment) or clearances or by_ratio(satisfied)
    if not checks:
        return None
    first, count = checks[0], len(failed(assessment)) - 1
    further = f", and {numbered(count, 'more check')} NG" if count > 0 else ""
    return _headline(f"{first.title} {first.subject}".rstrip() + further, first.ratio)


def _headline(text: str, value: float) -> Mapping[str, Any]:
    ratio_text = "" if math.isnan(value) else ratio(value)
    return {"text": text, "ratio": finite(value), "ratio_text": ratio_text}


def _next_step(assessment: Assessment, reasons: Sequence[Mapping[str, Any]]) -> str:
    """Return the next step: a sufficient change, else the action for the first open check."""
    enough = (reason["text"] for reason in reasons if reason["level"] == "remedy")
    closing = (check.to_close for check in assessment.open)
    return next(chain(enough, filter(None, closing)), "")


def _reasons(assessment: Assessment) -> Iterator[Mapping[str, Any]]:
    """Yield items that need attention, each with the checks combined in it."""
    us_first = assessment.project.us_first
    joined = {sentence(check, us_first): check for check in assessment.open}
    for group in grouped_by(attention(assessment, may_run=False), _about).values():
        level, text = group[0]
        parts = list(map(words, _joined_by(assessment, joined[text]))) if text in joined else []
        if len(group) > 1:
            parts = [warning for _, warning in group]
            text += f", and {numbered(len(group) - 1, 'more warning')} in this column"
        yield {"level": level, "text": text, "parts": parts}


def _about(line: tuple[str, str]) -> str:
    """Return what is said as one: warnings on a column of the workbook, and all else by itself."""
    level, text = line
    return text.partition(":")[0].rstrip(string.digits) if level == "warning" else text


def _joined_by(assessment: Assessment, joined: Check) -> Sequence[Check]:
    """Return the checks that are listed as one, the worst first; none of a single one."""
    parts = [
        check
        for check in assessment.checks
        if (check.id, check.verdict) == (joined.id, joined.verdict)
        and set(check.places) <= set(joined.places)
    ]
    # Of two without any capacity, that which lacks more.
    return sorted(parts, key=size, reverse=True) if len(parts) > 1 else []


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
    cell = _length(unit_format(marks.assessment), item.prescriptive.value_m, no_less, mark)
    return {**cell, "text": NOT_PERMITTED} if NOT_PERMITTED in mark else cell


def _length(fmt: UnitFormat, value_m: float, show: Show, mark: str = "") -> dict[str, str]:
    """Return a length in the preferred system, with both as its title; none has no title."""
    text, both = (way(value_m, show=show, mark=mark) for way in (fmt.short, fmt.both))
    return {"text": text} if text == both else {"text": text, "title": both}


def _ratio(value: float, fmt: UnitFormat) -> str:
    return fmt.none if math.isnan(value) else ratio(value)


def _gap_ratio(gap: NumberedGap, fmt: UnitFormat) -> str:
    return fmt.none if math.isnan(gap.check.demand_capacity) else gap.check.ratio_words


def _gap(gap: NumberedGap, marks: Marks, verdict: ShowVerdict) -> list[Cell | None]:
    fmt, (had, needed), row = unit_format(marks.assessment), gap.check.shows, gap.check.clearance
    return [
        {"text": str(gap.number)},
        _between(row.array, row.object, row.direction.value),
        _length(fmt, row.provided_m, had),
        _length(fmt, gap.check.required_m, needed, marks.required(gap.check)),
        {"text": _gap_ratio(gap, fmt)},
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
    """Return the tips of the plan for each array, object and clearance, by name and by number."""
    assessment, fmt = marks.assessment, unit_format(marks.assessment)
    tips = {id: f"{id}: Δ {design.get('title', fmt.none)}" for id, design in designs.items()}
    tips |= {row.id: f"{row.id}: {row.kind.value}" for row in assessment.project.objects}
    worst: dict[str, NumberedGap] = {}
    for gap in gaps:
        tips[f"#{gap.number}"] = f"{described(gap, marks)}, D/C {_gap_ratio(gap, fmt)}"
        for name in gap.check.between:
            known = worst.get(name)
            if known is None or not gap.check.demand_capacity <= known.check.demand_capacity:
                worst[name] = gap
    for name, gap in worst.items():
        across = gap.check.across_from(name)
        tips[name] = f"{tips.get(name, name)}, D/C {_gap_ratio(gap, fmt)} to {across}"
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
    """Return the models that the values are from."""
    if not assessment.has_motions:
        return "Prescriptive procedure, as in the package: no motions are entered."
    models = {run.solution.model for item in assessment.arrays for run in item.runs}
    names = ", ".join(f"{model.title} ({int(model)})" for model in sorted(models))
    return f"Full model, as in the package. Models of the runs: {names}."
