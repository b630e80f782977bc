"""The clearances: required and provided separation, and the parapets beside them."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence

from report.assessment.clearances import ClearanceCheck
from report.assessment.friction import mus_words
from report.assessment.remedies import Remedy
from report.pages.parts import (
    PackageData,
    Table,
    TableColumn,
    TableRow,
    joined,
    stamp,
)
from report.pages.remedies import table
from report.sheet.schema import Array, Direction, ObjectKind
from report.words.units import Quantity, compared, number, rounded_apart
from solver.rules.provisions import SEPARATION_KEYS, Neighbor


def clearance_table(package: PackageData, *, brief: bool) -> Table:
    """Return the clearances: required and provided separation."""
    gaps = dict(enumerate(package.assessment.clearances, start=1))
    return table_of(package, gaps, "Clearances: required and provided separation", brief=brief)


def table_of(
    package: PackageData, gaps: Mapping[int, ClearanceCheck], caption: str, *, brief: bool
) -> Table:
    """Return clearances, by their number in the workbook."""
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
        caption=caption,
        columns=(
            TableColumn(head="No.", share=0.42),
            TableColumn(head="From", align="left", share=0.9),
            TableColumn(head="To", align="left", share=1.3),
            TableColumn(head="Condition", align="left", share=3.1 if brief else 2.2),
            *more,
            *fmt.columns("Required", share=0.8),
            *fmt.columns("Provided", share=0.8),
            TableColumn(head="D/C", share=0.75),
            TableColumn(head="Verdict", align="center", share=0.95),
        ),
        rows=tuple(_clearance_row(package, count, gap, brief) for count, gap in gaps.items()),
        notes=(*_rounded(gaps), *_without_verdict(package, gaps.values())),
        kind="" if brief else "compact",
    )


def _rounded(gaps: Mapping[int, ClearanceCheck]) -> Iterator[str]:
    """Yield which separations print rounded apart, if any do."""
    numbers = [
        str(count)
        for count, gap in gaps.items()
        if rounded_apart(gap.required_m, gap.clearance.provided_m, Quantity.DISPLACEMENT)
    ]
    if numbers:
        yield (
            f"No. {', '.join(numbers)}: required and provided are rounded apart: both would "
            "print alike, and less is provided."
        )


def _without_verdict(package: PackageData, gaps: Iterable[ClearanceCheck]) -> Iterator[str]:
    """Yield why clearances have no verdict, if any have none."""
    names = [array.id for array in package.assessment.arrays if not array.is_permitted]
    if not all(gap.is_permitted for gap in gaps):
        yield (
            f"Verdict none: no route to a design displacement is permitted for {', '.join(names)}; "
            "the required separation is not known."
        )


def _by_direction(package: PackageData) -> bool:
    """Whether any clearance takes the displacement in one direction."""
    gaps = package.assessment.clearances
    return any(gap.governing_direction is not Direction.ANY for gap in gaps)


def _clearance_row(package: PackageData, count: int, gap: ClearanceCheck, brief: bool) -> TableRow:
    fmt, row = package.fmt, gap.clearance
    key = SEPARATION_KEYS[gap.neighbor]
    least = package.mark("separation_edge_min_in") if gap.is_least_value else ""
    marks = joined(least, gap.mark)
    required, provided = compared(gap.required_m, row.provided_m)
    more = (
        ()
        if brief
        else (
            *fmt.cells(gap.design_m, mark=gap.design_mark),
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
            *fmt.cells(gap.required_m, mark=marks, show=required),
            *fmt.cells(row.provided_m, Quantity.SIZE, show=provided),
            gap.ratio_words,
            stamp(gap.verdict),
        ),
        kind=package.bar(count in package.changes.clearances),
    )


def clearances(package: PackageData, remedies: Sequence[Remedy]) -> Mapping[str, object]:
    """Return the part on clearances, without its chart."""
    notes = [
        "Displ. is the design displacement of the array in the next column "
        f"({package.part('comparison')}). " + _direction_note(package),
        f"Friction coefficients as run: {mus_words(package.data.arrays)}.",
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
