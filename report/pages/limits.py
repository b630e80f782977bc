"""Limits, requirements and interconnection strength, and what of them the summary says.

The part with the roof plan: its tables and notes, what is near each array, and the parapets.

The provisions behind the numbers, overrides and departures.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any

from markupsafe import Markup, escape

from report.assessment.assessment import Assessment
from report.assessment.checks.alike import subjects
from report.assessment.checks.check import dagger
from report.assessment.design.friction import mus_words
from report.assessment.design.verdict import Verdict
from report.assessment.plan.neighbors import Cover
from report.assessment.precheck import findings
from report.assessment.remedies.remedies import MOST, Remedies
from report.assessment.support.evidence import Evidence
from report.assessment.support.plan_gaps import plan_gaps
from report.document.columns import ColumnHead, length, provided, text, words
from report.document.tables import LONG_NAME, Table, grouped, listed
from report.drawing.labels import alike_arrays
from report.drawing.sheet import unit_format
from report.pages.checks import all_checks
from report.pages.clearance_tables import (
    NumberedGap,
    neighbor_table,
    numbered_gaps,
    plan_schedule,
)
from report.pages.marks import UNVERIFIED
from report.pages.parts import PackageData
from report.pages.saving import without_analysis
from report.project.check.finding_lines import lines
from report.project.model.array import Array
from report.project.model.choices import ObjectKind
from report.project.model.finding import Level
from report.project.model.roof import RoofObject
from report.project.model.shapes import Polygon, Shape
from report.text.counts import capitalized, grouped_by
from report.text.unit_format import UnitFormat
from report.text.units import Quantity
from report.typeset.equations import symbol
from solver.rules.provisions import Neighbor
from solver.rules.rulesets import ALLOWED


def limits(package: PackageData, evidence: Evidence) -> Mapping[str, object]:
    """Return the part on limits and requirements."""
    return {
        "checks": all_checks(package.assessment),
        "remedies": list(remedy_lines(package.assessment, evidence.remedies)),
        "warnings": list(_warnings(package)),
    }


def _warnings(package: PackageData) -> Iterator[Sequence[str]]:
    """Yield cells, text and reason of each warning on the input.

    A contradiction of the plan is also among the requirements.
    """
    sheet = package.assessment.sheet
    listed = findings(sheet, package.assessment.shaking)
    warnings = [finding for finding in listed if finding.level is Level.WARNING]
    for line in lines(warnings, sheet.addresses):
        yield line.cell, f"{line.text}.", line.reason or "not acknowledged"


def remedy_lines(assessment: Assessment, found: Remedies) -> Iterator[str]:
    """Yield the set of changes that is enough, then what would satisfy each check that is NG."""
    if len(found.together) > 1:
        yield found.sentence
    for checks, own in grouped_by(found.own, lambda remedy: remedy.checks).items():
        titles = grouped_by(checks, lambda check: check.title)
        names = (", ".join(filter(None, (title, subjects(of)))) for title, of in titles.items())
        yield f"{'; '.join(names)}: {' '.join(each.sentence for each in own)}"
    failed = sum(check.verdict is Verdict.NG for check in assessment.checks)
    if found.own and failed > MOST:
        yield f"Searched for the {MOST} with the largest ratio of {failed} that are NG."
    if found.own and not found.together:
        yield "No combination of these changes is enough."
    if assessment.has_motions and (lacks := without_analysis(assessment)):
        yield f"{capitalized(lacks)}"


# Letters of names for which there is room in half the width of a sheet.
SHORT_NAME = 8
# Of pairs whose clearance is not given, or not as in the plan: the others need no table.
_APART = {Cover.SHORT, Cover.SUFFICIENT, Cover.DIFFERS}


def plan(package: PackageData) -> Mapping[str, object]:
    """Return what the part needs beside its drawings."""
    assessment = package.assessment
    near, gaps = assessment.neighbors, numbered_gaps(assessment)
    drawn = list(plan_gaps(assessment))
    numbers = {gap.number for gap in drawn}
    apart = [pair for pair in near if pair.cover in _APART]
    beyond = [pair for pair in assessment.pairs if not pair.is_listed]
    # In one unit, as the drawings: the tables and the plan are read side by side.
    fmt = replace(unit_format(assessment), systems=1, none="none")
    placed: Sequence[Array | RoofObject] = (*package.data.arrays, *package.data.objects)
    return {
        "fmt": fmt,
        "arrays": alike_arrays(assessment, fmt),
        "friction": mus_words(package.data.arrays),
        "schedule": plan_schedule(package, fmt),
        "n_gaps": len(gaps),
        "has_short_names": all(
            len(name) <= SHORT_NAME for gap in gaps for name in gap.check.between
        ),
        "undrawn": [gap.number for gap in gaps if gap.number not in numbers],
        "bases": _bases(gaps),
        "has_unknown": any(gap.check.verdict is Verdict.NONE for gap in gaps),
        "unpermitted": [item.id for item in assessment.arrays if not item.is_permitted],
        "neighbors": neighbor_table(package, apart) if apart else None,
        "as_drawn": [
            str(row.number) for pair in near if pair.cover not in _APART for row in pair.given
        ],
        "n_beyond": len(beyond),
        "nearest": min(beyond, key=lambda pair: pair.gap_m, default=None),
        "factors": _factors(package),
        "clauses": dict.fromkeys(package.marks.clause(gap.key) for gap in gaps),
        "parapets": _parapets(package),
        "places": _places(package, fmt),
        # By id, with the number of vertices: the table of places has only the rectangle around.
        "outlined": [
            (row.id, len(row.placed.points)) for row in placed if isinstance(row.placed, Polygon)
        ],
        "is_least": any(gap.is_minimum_value for gap in assessment.clearances),
    }


def _bases(gaps: Sequence[NumberedGap]) -> Sequence[tuple[str, Sequence[str]]]:
    """Return the numbers of the clearances by the basis of what is provided."""
    bases = grouped_by(gaps, lambda gap: gap.check.basis.value)
    return [(basis, [str(gap.number) for gap in bases[basis]]) for basis in sorted(bases)]


def _factors(package: PackageData) -> Sequence[Mapping[str, object]]:
    """Return each kind of neighbor with its factor, and the clearances to it."""
    gaps = numbered_gaps(package.assessment)
    kinds = grouped_by(gaps, lambda gap: (gap.check.neighbor.value, gap.check.factor))
    return [
        {"kind": kind, "factor": factor, "numbers": [str(gap.number) for gap in rows]}
        for (kind, factor), rows in kinds.items()
    ]


def _parapets(package: PackageData) -> Table:
    """Return the parapet of each clearance to an edge that has one, and whether it qualifies."""
    edges = {
        item.id: item.height_m
        for item in package.data.objects
        if item.kind is ObjectKind.EDGE_WITH_PARAPET and item.height_m is not None
    }
    arrays = {array.id: array.cg_height_m for array in package.data.arrays}
    columns = (
        (words("Parapet"), lambda row: row[0].object),
        (words("Beside"), lambda row: row[0].array),
        (length("Top above the roof"), lambda row: row[1]),
        (length("Center of gravity"), lambda row: row[2]),
        (provided("Top above c.g."), lambda row: row[1] - row[2]),
        (words("Result", 1.3), lambda row: row[3]),
    )
    rows = [
        (
            gap.clearance,
            edges[gap.clearance.object],
            arrays[gap.clearance.array],
            "qualifies" if gap.neighbor is Neighbor.PARAPET else "does not qualify",
        )
        for gap in package.assessment.clearances
        if gap.clearance.object in edges
    ]
    return listed(rows, columns, package.fmt, kind="compact")


def _places(package: PackageData, fmt: UnitFormat) -> Sequence[Table]:
    """Return where arrays, objects and roof edges are in plan, and how high the latter, halved."""
    data = package.data
    rows = [
        *((array.id, "array", None, array.placed) for array in data.arrays if array.placed),
        *((item.id, item.kind.value, item.height_m, item.placed) for item in data.objects),
    ]
    columns = (
        (words("Item", 1.1), lambda row: row[0]),
        (length("Height"), lambda row: "—" if row[2] is None else row[2]),
        (_in_plan("x from"), lambda row: _sides(row[3])[0]),
        (_in_plan("x to"), lambda row: _sides(row[3])[1]),
        (_in_plan("y from"), lambda row: _sides(row[3])[2]),
        (_in_plan("y to"), lambda row: _sides(row[3])[3]),
    )
    # Long names have no room in half the sheet: then all are in the first.
    is_short = max((len(row[0]) for row in rows), default=0) <= LONG_NAME
    middle = (len(rows) + 1) // 2 if is_short else len(rows)
    halves = rows[:middle], rows[middle:]
    return [grouped(grouped_by(half, lambda row: row[1]), columns, fmt) for half in halves]


def _sides(shape: Shape | None) -> tuple[Any, ...]:
    """Return x from, x to, y from and y to of the rectangle around a shape."""
    if shape is None:
        return ("—",) * 4
    box = shape.bounds
    return box.x_from_m, box.x_to_m, box.y_from_m, box.y_to_m


def _in_plan(head: str) -> ColumnHead:
    return ColumnHead(head=head, quantity=Quantity.PLAN)


def provisions(package: PackageData) -> Mapping[str, object]:
    """Return every number of the rule set in two columns, and the overrides."""
    rules = package.assessment.rules
    named = [
        (_sentence_case(ALLOWED[key].meaning), value)
        for key, value in rules.values.items()
        # Without an analysis only its floor is said, as what it could save.
        if package.assessment.has_motions or key == "analysis_floor" or "analysis" not in key
    ]
    # The heading names the rule set: its name before each clause would need a second line.
    own = rules.name.removeprefix("SEAOC ") + " "  # before its clauses
    columns = (
        (words("Provision", 6.0), lambda row: row[0]),
        (text("Value", share=0.75), lambda row: f"{row[1].value:.4g}" + dagger(row[1])),
        (words("Clause", 1.7), lambda row: row[1].clause.removeprefix(own)),
    )
    # Two columns of the page; the left one has the odd row.
    middle = (len(named) + 1) // 2
    halves = named[:middle], named[middle:]
    return {
        "halves": [listed(half, columns, package.fmt, kind="compact") for half in halves],
        "noted": [(name, provision) for name, provision in named if provision.note],
        "unverified": UNVERIFIED,
        "overrides": [
            (_sentence_case(ALLOWED[row.provision].meaning), f"{row.value:.6g}†‡", row.reason)
            for row in package.data.overrides
        ],
    }


def _sentence_case(name: str) -> Markup:
    """Return the name of a provision in sentence case with typeset symbols."""
    # Names of provisions are those of the sheet Overrides, which can be typed: hyphen, ^2, S_DS.
    plain = escape(name[0].upper() + name[1:]).replace(" - ", " − ").replace("^2", "²")
    return plain.replace("S_DS", symbol("S_DS")).replace("W1", symbol("W_1"))
