"""The clearances: required and provided separation, and the parapets beside them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from report.assessment.clearances import ClearanceCheck
from report.assessment.remedies import Remedy
from report.assessment.verdict import Verdict
from report.pages.parts import (
    PackageData,
    Table,
    TableColumn,
    TableRow,
    stamp,
)
from report.pages.remedies import table
from report.sheet.schema import Array, Direction, ObjectKind
from report.words.units import Quantity, compared, number, ratio
from solver.rules.provisions import SEPARATION_KEYS, Neighbor


def clearance_table(package: PackageData, *, brief: bool) -> Table:
    """Return the clearances: required and provided separation."""
    fmt = package.fmt
    factor = " × I" if package.assessment.rules.importance_in_separation else ""
    directions = (
        [TableColumn(head="Direction", align="left", share=1.05)] if _by_direction(package) else []
    )
    more = (
        ()
        if brief
        else (
            *fmt.columns("Displ.", share=0.8),
            TableColumn(head="Array", align="left", share=0.75),
            *directions,
            TableColumn(head="Factor" + factor, share=0.75),
            TableColumn(head="Clause", align="left", share=2.1),
        )
    )
    return Table(
        caption="Clearances: required and provided separation",
        columns=(
            TableColumn(head="No.", share=0.42),
            TableColumn(head="From", align="left", share=0.9),
            TableColumn(head="To", align="left", share=1.3),
            TableColumn(head="Condition", align="left", share=3.1 if brief else 2.2),
            *more,
            *fmt.columns("Required", share=0.8),
            *fmt.columns("Provided", share=0.8),
            TableColumn(head="D/C", share=0.62),
            TableColumn(head="Verdict", align="center", share=_verdict_share(package)),
        ),
        rows=tuple(
            _clearance_row(package, count, gap, brief)
            for count, gap in enumerate(package.assessment.clearances, start=1)
        ),
        kind="" if brief else "compact",
    )


def _verdict_share(package: PackageData) -> float:
    """Return a width for the longest verdict on a clearance."""
    verdicts = {gap.verdict for gap in package.assessment.clearances}
    return 1.7 if Verdict.CONDITIONS in verdicts else 0.95


def _by_direction(package: PackageData) -> bool:
    """Whether any clearance takes the displacement in one direction."""
    gaps = package.assessment.clearances
    return any(gap.governing_direction is not Direction.ANY for gap in gaps)


def _clearance_row(package: PackageData, count: int, gap: ClearanceCheck, brief: bool) -> TableRow:
    fmt, row = package.fmt, gap.clearance
    key = SEPARATION_KEYS[gap.neighbor]
    least = package.mark("separation_edge_min_in") if gap.is_least_value else ""
    required, provided = compared(gap.required_m, row.provided_m)
    more = (
        ()
        if brief
        else (
            *fmt.cells(gap.design_m),
            gap.governing_array,
            *([gap.governing_direction.value] if _by_direction(package) else []),
            number(gap.factor, 2) + package.mark(key),
            package.clause(key),
        )
    )
    where = "" if row.direction == "any" else f", {row.direction.value}"
    return TableRow(
        cells=(
            str(count),
            row.array,
            row.object,
            gap.neighbor.value + where,
            *more,
            *fmt.cells(gap.required_m, mark=least, show=required),
            *fmt.cells(row.provided_m, Quantity.SIZE, show=provided),
            ratio(gap.demand_capacity),
            stamp(gap.verdict),
        ),
        kind=package.bar(count in package.changes.clearances),
    )


def clearances(package: PackageData, remedies: Sequence[Remedy]) -> Mapping[str, object]:
    """Return the part on clearances, without its chart."""
    notes = [
        "Displ. is the design displacement of the array in the next column "
        f"({package.part('comparison')}). " + _direction_note(package),
        "Between two arrays the larger of the two displacements governs.",
    ]
    parapets = _parapets(package)
    if parapets:
        notes += [*parapets, "The strength of a parapet is not checked."]
    if any(gap.is_least_value for gap in package.assessment.clearances):
        notes.append(
            "The minimum separation to an edge without a qualifying parapet governs where the "
            "required value exceeds factor × displacement: "
            f"{package.fmt.both(package.assessment.rules.length_m('separation_edge_min_in'))}"
            f"{package.mark('separation_edge_min_in')}."
        )
    return {
        "table": clearance_table(package, brief=False),
        "notes": tuple(notes),
        "remedies": table(package, remedies) if remedies else None,
    }


def _parapets(package: PackageData) -> Sequence[str]:
    """Return for each clearance to a parapet whether it qualifies, with the numbers."""
    heights = {
        item.id: item.height_m
        for item in package.data.objects
        if item.kind is ObjectKind.EDGE_WITH_PARAPET and item.height_m is not None
    }
    arrays = {array.id: array for array in package.data.arrays}
    return [
        _parapet(package, gap, heights[gap.clearance.object], arrays[gap.clearance.array])
        for gap in package.assessment.clearances
        if gap.clearance.object in heights
    ]


def _parapet(package: PackageData, gap: ClearanceCheck, top_m: float, array: Array) -> str:
    rules, over_m = package.assessment.rules, top_m - array.cg_height_m
    top, cg, over = (package.fmt.both(v, Quantity.SIZE) for v in (top_m, array.cg_height_m, over_m))
    least, least_over = (
        f"{package.fmt.both(rules.length_m(key), Quantity.SIZE)}{package.mark(key)}"
        for key in ("parapet_height_in", "parapet_over_cg_in")
    )
    qualifies = gap.neighbor is Neighbor.PARAPET
    return (
        f"Parapet {gap.clearance.object} beside {array.id}: top {top} above the roof, at least "
        f"{least}; above the center of gravity {top} − {cg} = {over}, at least {least_over}: "
        + ("it qualifies." if qualifies else "it does not qualify, an edge without a parapet.")
    )


def _direction_note(package: PackageData) -> str:
    """Return which part of the displacement a clearance takes."""
    if package.data.options.directional:
        return (
            "It is taken in the direction shown, not less than the floor: a departure from the "
            f"rule set ({package.part('provisions')})."
        )
    return "It is taken in full in every direction."
