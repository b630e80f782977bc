"""An assessment as shown on the page: finished strings and the numbers for drawing.

Computes nothing: every number and verdict is that of `report.assessment`. Read `answer`.
"""

from __future__ import annotations

import math
import string
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import chain
from typing import Any, NamedTuple

from report.assessment.assessment import Assessment
from report.assessment.causes import failed, governing_words, largest
from report.assessment.checks.check import Check, by_ratio
from report.assessment.checks.sentence import sentence, size, words
from report.assessment.design.arrays import ArrayAssessment
from report.assessment.design.clearances import ClearanceCheck
from report.assessment.design.routes import NOT_PERMITTED
from report.assessment.design.rule_set import MEANING
from report.assessment.design.separation import ComparedGap
from report.assessment.design.verdict import Verdict
from report.assessment.plan.neighbors import PlanNeighbor
from report.drawing.sheet import unit_format
from report.pages.attention import attention
from report.pages.checks import verdict_sentence
from report.pages.marks import Marks
from report.text.counts import numbered
from report.text.grouping import grouped_by
from report.text.json_numbers import finite
from report.text.names import ranged
from report.text.unit_format import UnitFormat
from report.text.units import Show, no_less, ratio
from report.web.plan import USUAL_PX, Cell, plan, stamp

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
    shown, described = _Shown(assessment, is_provisional), []
    for one in shown.gaps:
        described.append({"text": shown.described(one), "verdict": shown.verdict(one.gap.verdict)})
    ratios = {name: gap.demand_capacity for name, gap in shown.governing.items() if gap}
    said = _passing(assessment) if is_provisional else _at_rest(assessment)
    overridden = f" {MEANING}." if assessment.is_overridden else ""
    unsaid = {"line": "", "next": "", "verdict": None, "verdict_text": None, "pending": ""}
    return {
        **unsaid,
        **said,
        "model_text": said["model_text"] + overridden,
        "arrays": shown.arrays(),
        "clearances": {
            "caption": "Clearances",
            "heads": ["No.", "From, to", "Provided", "Required", "D/C", "Verdict"],
            "rows": list(map(shown.clearance, shown.gaps)),
        },
        "bars": {item.id: shown.bars(item) for item in assessment.arrays},
        "tips": shown.tips(),
        "plan": {
            **plan(assessment, shown.designs, ratios, room_px, has_verdicts=not is_provisional),
            "described": described,
        },
    }


def _passing(assessment: Assessment) -> dict[str, Any]:
    """Return what provisional values come to: the clearance that governs."""
    gap = assessment.governing_gap()
    # Their checks are not computed: they take a third of the time.
    return {
        "model_text": _PROVISIONAL,
        "worst": gap and _headline(f"Clearance {' to '.join(gap.between)}", gap.demand_capacity),
        "reasons": [],
    }


def _at_rest(assessment: Assessment) -> dict[str, Any]:
    """Return the verdict, the check that governs, and what both rest on."""
    reasons, verdict = list(_reasons(assessment)), assessment.verdict
    said = {"model_text": _whole(assessment), "worst": _worst(assessment), "reasons": reasons}
    # What less friction would change is computed after the rest, which is asked next.
    if assessment.at_reduced_friction is None:
        said["pending"] = _LESS
        # Only an OK may change by it.
        if verdict is Verdict.OK:
            look = {"text": "OK (provisional)", "look": "provisional"}
            return said | {"verdict": look, "line": _LESS}
    return said | {
        "verdict": stamp(verdict, verdict.value),
        "line": governing_words(assessment),
        "next": _next_step(assessment, reasons),
        # What it rests on; the reasons are listed below it.
        "verdict_text": verdict_sentence(assessment, "here"),
    }


def _worst(assessment: Assessment) -> Mapping[str, Any] | None:
    """Return the check that governs, with its D/C."""
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


def _whole(assessment: Assessment) -> str:
    """Return the models that the values are from."""
    if not assessment.has_motions:
        return "Prescriptive procedure, as in the package: no motions are entered."
    models = {run.solution.model for item in assessment.arrays for run in item.runs}
    names = ", ".join(f"{model.title} ({int(model)})" for model in sorted(models))
    return f"Full model, as in the package. Models of the runs: {names}."


class _Gap(NamedTuple):
    """A clearance with its number in the workbook, or without one a pair of the plan."""

    number: str
    gap: ClearanceCheck | PlanNeighbor
    mark: str  # of what is required
    note: str


@dataclass(frozen=True)
class _Shown:
    """The numbers of an assessment as cells of tables, tips and lines."""

    assessment: Assessment
    is_provisional: bool

    @cached_property
    def marks(self) -> Marks:
        return Marks(self.assessment, has_daggers=False)

    @cached_property
    def fmt(self) -> UnitFormat:
        return unit_format(self.assessment)

    @cached_property
    def gaps(self) -> Sequence[_Gap]:
        """The clearances, and below them the pairs of the plan without one."""
        entered = (
            _Gap(str(n), check, self.marks.required(check), check.clearance.direction.value)
            for n, check in enumerate(self.assessment.clearances, start=1)
        )
        neighbors = (near for near in self.assessment.neighbors if near.is_missing)
        return [
            *entered,
            *(_Gap("", near, near.mark, "not entered; in plan") for near in neighbors),
        ]

    @cached_property
    def designs(self) -> Mapping[str, Cell]:
        return {item.id: self._design(item) for item in self.assessment.arrays}

    @cached_property
    def governing(self) -> Mapping[str, ComparedGap | None]:
        """The gap that governs next to each array and object."""
        names = [*self.designs, *(row.id for row in self.assessment.project.objects)]
        return {name: self.assessment.governing_gap(name) for name in names}

    def verdict(self, verdict: Verdict) -> Cell | None:
        return None if self.is_provisional else stamp(verdict)

    def _length(self, value_m: float, show: Show = no_less, mark: str = "") -> dict[str, str]:
        """Return a length in the preferred system, with both as its title; none has no title."""
        text, both = (way(value_m, show=show, mark=mark) for way in (self.fmt.short, self.fmt.both))
        return {"text": text} if text == both else {"text": text, "title": both}

    def _design(self, item: ArrayAssessment) -> Cell:
        """Return the design displacement and what governs; if provisional, not whether it may."""
        cell = self._length(item.design_m, mark=self.marks.design(item))
        if math.isnan(item.design_m):
            return cell
        if self.is_provisional:
            return cell | {"title": f"{cell['title']}, {item.governs.value}"}
        text = NOT_PERMITTED if item.has_unpermitted_value else cell["text"]
        return {"text": text, "title": f"{cell['title']}, {item.source}"}

    def _prescriptive(self, item: ArrayAssessment) -> Cell:
        mark = self.marks.prescriptive(item)
        cell = self._length(item.prescriptive.value_m, mark=mark)
        return cell | {"text": NOT_PERMITTED} if NOT_PERMITTED in mark else cell

    def _ratio(self, gap: ComparedGap | None) -> str:
        if gap is None or math.isnan(gap.demand_capacity):
            return self.fmt.none
        return gap.ratio_words

    def arrays(self) -> Mapping[str, Any]:
        """Return the table of arrays; those that differ in their name alone are one row."""
        assessment = self.assessment
        rows: dict[str, dict[str, Cell | None]] = {}
        for item in assessment.arrays:
            mean = {"Mean PRD": self._length(item.analysis.mean_m)}
            rows[item.id] = (mean if assessment.has_motions else {}) | {
                "Design Δ": self.designs[item.id],
                "Prescriptive": self._prescriptive(item),
                "D/C": {"text": self._ratio(self.governing[item.id])},
                "Verdict": None if self.is_provisional else stamp(assessment.array_verdict(item)),
            }
        alike = grouped_by(rows, lambda id: str(rows[id])).values()
        return {
            "caption": "Arrays: displacement",
            "heads": ["Array", *rows[assessment.arrays[0].id]],
            "rows": [[{"text": ranged(ids), "ids": ids}, *rows[ids[0]].values()] for ids in alike],
        }

    def clearance(self, one: _Gap) -> list[Cell | None]:
        """Return the row of a clearance, or of a pair without one."""
        (had, needed), (first, other) = one.gap.shows, one.gap.between
        return [
            {"text": one.number},
            {"text": f"{first} to {other}", "from": first, "to": other, "note": one.note},
            self._length(one.gap.provided_m, had),
            self._length(one.gap.required_m, needed, one.mark),
            {"text": self._ratio(one.gap) if one.number else ""},
            self.verdict(one.gap.verdict),
        ]

    def described(self, one: _Gap) -> str:
        """Return a clearance in words."""
        (had, needed), names = one.gap.shows, " to ".join(one.gap.between)
        provided = self.fmt.both(one.gap.provided_m, show=had)
        required = self.fmt.both(one.gap.required_m, show=needed, mark=one.mark)
        if not one.number:
            return f"{names}: no clearance given, {provided} in plan, required {required}"
        name = f"Clearance {one.number}, {names}, {one.note}"
        return f"{name}: provided {provided}, required {required}"

    def tips(self) -> Mapping[str, str]:
        """Return the tips of the plan for each array, object and clearance, by name and number."""
        tips = {id: f"Δ {cell.get('title', self.fmt.none)}" for id, cell in self.designs.items()}
        tips |= {row.id: row.kind.value for row in self.assessment.project.objects}
        for name, about in tips.items():
            gap = self.governing[name]
            worst = f", D/C {self._ratio(gap)} to {gap.across_from(name)}" if gap else ""
            tips[name] = f"{name}: {about}{worst}"
        return tips | {
            f"#{one.number}": f"{self.described(one)}, D/C {self._ratio(one.gap)}"
            for one in self.gaps
            if one.number
        }

    def bars(self, item: ArrayAssessment) -> Mapping[str, Any]:
        """Return the PRD of each motion, and the lengths that are lines across its bars."""
        design, prescriptive = self.designs[item.id]["text"], self._prescriptive(item)["text"]
        # A displacement that is not permitted is no line across the bars.
        design_m = math.nan if design == NOT_PERMITTED else item.design_m
        lines = (
            ("design", design_m, design),
            ("prescriptive", item.prescriptive.value_m, prescriptive),
        )
        prds = ((motion.motion.id, motion.governing.prd_m) for motion in item.motions)
        return {
            "caption": f"PRD of {item.id} by motion",
            "lines": [
                {"name": name, "length_m": finite(value_m), "text": text}
                for name, value_m, text in lines
            ],
            "rows": [
                {"name": id, "length_m": finite(prd_m), "text": self._length(prd_m)["text"]}
                for id, prd_m in prds
            ],
        }
