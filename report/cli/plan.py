"""The command `roofslip plan`: the roof plan of a workbook, from a drawing.

Read `read` first.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

import click

from report.cli.groups import SectionedGroup
from report.cli.terminal import SOURCE, input_errors, plain
from report.words.command import called

if TYPE_CHECKING:
    from report.drawing.plan_read import DrawnOutline, RoofPlan

UNIT_CHOICES = ("in", "ft", "mm", "cm", "m")
MOST_HANDLES = 20


@click.group(cls=SectionedGroup)
def plan() -> None:
    """Fill in the roof plan of a workbook from a drawing."""


@plan.command()
@click.argument("drawing", metavar="ROOF.DXF", type=SOURCE)
@click.argument("project", metavar="DIR|WORKBOOK", type=SOURCE)
@click.option("--units", type=click.Choice(UNIT_CHOICES),
              help="Unit of the drawing; required if it states none.")  # fmt: skip
@click.option("--replace", is_flag=True, help="Overwrite the places of rows that are filled.")
def read(drawing: Path, project: Path, units: str | None, replace: bool) -> None:
    """Fill in arrays, objects, roof edges and outlines from the closed polylines of a DXF.

    The sheet Layers says what each layer is; the layers of plan.dxf are known. Names are texts
    inside the outlines, or attributes of blocks. Everything else in the workbook is kept. If
    the workbook has no other errors, the clearances follow as by plan clearances.
    """
    from solver.model import InputError

    with input_errors(drawing):
        found = _drawn(drawing, project, units)
    with input_errors(project):
        path, has_formulas = _filled(project, found, replace)
    for place in (*found.roof, *found.arrays, *found.objects):
        click.echo(plain(_line(place)))
    for text in _unread(found):
        click.echo(plain(text))
    try:
        has_formulas |= _with_clearances(project)
    except InputError as error:
        click.echo(plain(f"Clearances are not added yet: {error.problems[0]}."))
        click.echo(f"Once the workbook has no errors, run: {called()} plan clearances {project}")
    click.echo(f"{path}: the plan is filled in. Complete it, then run: {called()} check {project}")
    _note_formulas(has_formulas)


@plan.command()
@click.argument("project", metavar="DIR|WORKBOOK", type=SOURCE)
def clearances(project: Path) -> None:
    """Add a row to the sheet Clearances for each pair of the plan that a package would require.

    Arrays, objects and roof edges within reach of an array: twice the prescriptive displacement,
    as nothing is run. Distances are those of the plan, rounded down, and say so in the column
    Distance from: a condition of the package until they are confirmed. Rows that stand are kept.
    """
    with input_errors(project):
        has_formulas = _with_clearances(project)
    click.echo(f"Next: {called()} check {project}")
    _note_formulas(has_formulas)


def _with_clearances(project: Path) -> bool:
    """Add the rows that a workbook lacks; return whether formulas keep their former values."""
    from report.assessment.plan_clearances import missing_rows
    from report.sheet.reading.read import read as read_sheet
    from report.sheet.writing.filled import fill_cells

    sheet = read_sheet(project)
    cells, lines = missing_rows(sheet)
    has_formulas = bool(cells) and fill_cells(sheet.book, cells)
    for line in lines:
        click.echo(plain(line))
    return has_formulas


def _note_formulas(has_formulas: bool) -> None:
    if has_formulas:
        click.echo("Formulas keep their former values until Excel or LibreOffice saves it.")


def _drawn(drawing: Path, project: Path, units: str | None) -> RoofPlan:
    """Read the drawing by the layers that the workbook names."""
    from report.drawing.plan_read import plan_of
    from report.drawing.read_dxf import read_dxf
    from report.sheet.reading.read import read as read_sheet
    from report.words.units import LENGTHS
    from solver.model import InputError

    sheet = read_sheet(project)
    layers = {
        row["layer"]: row["kind"]
        for row in sheet.draft["layers"]
        if {"layer", "kind"} <= row.keys()
    }
    found = read_dxf(drawing, LENGTHS[units] if units else None)
    unit = units or found.unit
    if not unit:
        choices = ", ".join(UNIT_CHOICES)
        raise InputError(f"states no unit; add --units with one of {choices}")
    return plan_of(found, LENGTHS[unit], layers)


def _filled(project: Path, found: RoofPlan, replace: bool) -> tuple[Path, bool]:
    """Fill the plan in; return the workbook, and whether it has formulas."""
    from report.drawing.fill import changes
    from report.sheet.reading.archive import open_book
    from report.sheet.writing.filled import fill_cells
    from solver.model import InputError

    if not (found.roof or found.arrays or found.objects):
        lines = list(_unread(found)) or ["the drawing has no closed polylines"]
        raise InputError(["nothing to fill in: give the layers on the sheet Layers", *lines])
    book = open_book(project)
    return book.path, fill_cells(book, changes(book, found, replace=replace))


def _line(place: DrawnOutline) -> str:
    from report.words.units import Quantity, pair

    box = place.shape.bounds
    wide, tall = (
        pair(side, Quantity.PLAN, True)
        for side in (box.x_to_m - box.x_from_m, box.y_to_m - box.y_from_m)
    )
    source = f" from {place.handle} on {place.layer}" if place.handle else ""
    note = f" ({place.note})" if place.note else ""
    count = len(place.shape.points)
    return f"{place.name}: {place.kind.value}, {count} vertices, {wide} by {tall}{source}{note}"


def _unread(found: RoofPlan) -> Iterator[str]:
    """Yield what was not understood, by layer and reason, with its handles."""
    groups: dict[tuple[str, str], list[str]] = defaultdict(list)
    for item in found.unread:
        groups[item.layer, item.reason].append(item.handle)
    for (layer, reason), handles in groups.items():
        shown = ", ".join(handles[:MOST_HANDLES])
        more = f" and {len(handles) - MOST_HANDLES} more" if len(handles) > MOST_HANDLES else ""
        yield f"not read: layer {layer}, {reason}: {shown}{more}"
