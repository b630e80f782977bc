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
from report.cli.values import Measured
from report.words.command import called

if TYPE_CHECKING:
    from report.drawing.ballast import Load
    from report.drawing.plan_read import DrawnOutline, RoofPlan
    from report.sheet.schema.fields import DraftRow

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
@click.option("--gap", "gap_m", type=Measured("SIZE", "2 m"), default="20 in", show_default=True,
              help="Largest gap between modules of one array; at most 2 m.")  # fmt: skip
@click.option("--replace", is_flag=True, help="Overwrite the places of rows that are filled.")
def read(drawing: Path, project: Path, units: str | None, gap_m: float, replace: bool) -> None:
    """Fill in arrays, objects, roof edges and outlines from the closed polylines of a DXF.

    The sheet Layers says what each layer is; the layers of plan.dxf are known. Names are texts
    inside the outlines, or attributes of blocks. Equal rectangles of the size of modules are joined
    into arrays. Everything else in the workbook is kept.
    """
    with input_errors(drawing):
        found = _drawn(drawing, project, units, gap_m)
    with input_errors(project):
        path, has_formulas = _filled(project, found, replace)
    for place in (*found.roof, *found.arrays, *found.objects):
        click.echo(plain(_line(place)))
    for text in (*_modules(found, gap_m), *_unread(found)):
        click.echo(plain(text))
    _say_filled(path, project, "the plan is", has_formulas)


def _say_filled(path: Path, project: Path, what: str, has_formulas: bool) -> None:
    """Say what was filled in, and what comes next."""
    click.echo(f"{path}: {what} filled in. Complete it, then run: {called()} check {project}")
    if has_formulas:
        click.echo("Formulas keep their former values until Excel or LibreOffice saves it.")


def _drawn(drawing: Path, project: Path, units: str | None, gap_m: float) -> RoofPlan:
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
    return plan_of(found, LENGTHS[unit], layers, gap_m)


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
    from report.words.counts import numbered
    from report.words.units import Quantity, pair

    box = place.shape.bounds
    wide, tall = (
        pair(side, Quantity.PLAN, True)
        for side in (box.x_to_m - box.x_from_m, box.y_to_m - box.y_from_m)
    )
    source = f" from {place.handle} on {place.layer}" if place.handle else ""
    note = f" ({place.note})" if place.note else ""
    count, made = len(place.shape.points), place.kind.value
    if array := place.modules:
        sizes = ", ".join(
            f"{numbered(of, 'module')} {pair(long, Quantity.SIZE)} by {pair(short, Quantity.SIZE)}"
            for of, long, short in array.sizes
        )
        made += f" of {sizes}, gaps up to {pair(array.gap_m, Quantity.SIZE)}"
        made += f", around {array.opening_m2:.1f} m2 without modules" if array.opening_m2 else ""
    return f"{place.name}: {made}, {count} vertices, {wide} by {tall}{source}{note}"


def _modules(found: RoofPlan, gap_m: float) -> Iterator[str]:
    """Yield the rule by which modules were joined, where there are any."""
    from report.drawing.modules import ALIKE_M, LEAST_ALIKE, SIDES_M
    from report.words.counts import numbered
    from report.words.units import Quantity, pair

    arrays = [place.modules for place in (*found.arrays, *found.objects) if place.modules]
    if arrays:
        low, high, alike, gap = (pair(m, Quantity.SIZE) for m in (*SIDES_M, ALIKE_M, gap_m))
        yield (
            f"modules: {sum(array.count for array in arrays)} rectangles with sides of {low} to"
            f" {high}, {LEAST_ALIKE} or more of a size within {alike} on a layer; joined to"
            f" {numbered(len(arrays), 'array')} where gaps are at most {gap} (--gap)"
        )


def _unread(found: RoofPlan) -> Iterator[str]:
    """Yield what was not understood, by layer and reason, with its handles."""
    groups: dict[tuple[str, str], list[str]] = defaultdict(list)
    for item in found.unread:
        groups[item.layer, item.reason].append(item.handle)
    for (layer, reason), handles in groups.items():
        yield f"not read: layer {layer}, {reason}: {_some(handles)}"


def _some(names: list[str]) -> str:
    more = f" and {len(names) - MOST_HANDLES} more" if len(names) > MOST_HANDLES else ""
    return f"{', '.join(names[:MOST_HANDLES])}{more}"


@plan.command()
@click.argument("ballast_map", metavar="MAP.csv", type=SOURCE)
@click.argument("project", metavar="DIR|WORKBOOK", type=SOURCE)
@click.option("--units", type=click.Choice(UNIT_CHOICES), required=True, help="Unit of x and y.")
@click.option("--block-weight", "block_n", type=Measured("WEIGHT"), required=True,
              help="Of one block, such as '32 lb'.")  # fmt: skip
@click.option("--replace", is_flag=True, help="Overwrite ballast weights that are given.")
def ballast(ballast_map: Path, project: Path, units: str, block_n: float, replace: bool) -> None:
    """Fill in the ballast weight of arrays from a CSV with the columns x, y, blocks.

    Coordinates are those of the plan. Prints the center of gravity of each array in plan.
    """
    from report.drawing.ballast import changes, loads, read_map
    from report.sheet.checking.plan_checks import shapes_of
    from report.sheet.reading.archive import open_book
    from report.sheet.reading.read import read as read_sheet
    from report.sheet.writing.filled import fill_cells
    from report.words.counts import numbered
    from report.words.units import LENGTHS
    from solver.model import InputError

    with input_errors(ballast_map):
        rows = read_map(ballast_map, LENGTHS[units])
    with input_errors(project):
        draft, book = read_sheet(project).draft, open_book(project)
        shapes = shapes_of(draft)
        arrays = {row["id"]: row for row in draft["arrays"] if row.get("id") in shapes}
        found, outside = loads(rows, {name: shapes[name] for name in arrays})
        if not found:
            raise InputError("no block of the map is within an array of the plan")
        weights = {name: load.blocks * block_n for name, load in found.items()}
        has_formulas = fill_cells(book, changes(book, weights, replace=replace))
    for name, row in arrays.items():
        text = _balance(row, found[name], weights[name]) if name in found else "no blocks"
        click.echo(plain(f"{name}: {text}"))
    if outside:
        lines = _some([str(line) for line in outside])
        click.echo(f"outside of every array: {numbered(len(outside), 'line')} of the map: {lines}")
    click.echo(
        "The model has no rotation in plan and one friction coefficient under an array; it uses no"
        " eccentricity."
    )
    _say_filled(book.path, project, "the ballast weights are", has_formulas)


def _balance(row: DraftRow, load: Load, ballast_n: float) -> str:
    """Return the ballast of an array and its center of gravity, as far as weights are known."""
    from report.drawing.ballast import center_of_gravity
    from report.words.counts import numbered
    from report.words.units import Quantity, pair

    modules, each_n = row.get("modules"), row.get("module_weight_n")
    modules_n = modules * each_n if modules and each_n else 0.0
    center = center_of_gravity(load, ballast_n, modules_n)
    off = (center[0] - load.centroid[0], center[1] - load.centroid[1])
    x, y, off_x, off_y = (pair(value, Quantity.PLAN) for value in (*center, *off))
    what = f"ballast and {modules} modules" if modules_n else "the ballast alone"
    return (
        f"{numbered(load.blocks, 'block')}, {pair(ballast_n, Quantity.WEIGHT)}; center of gravity"
        f" of {what} at x {x}, y {y}; from the centroid of the outline {off_x} in x, {off_y} in y"
    )
