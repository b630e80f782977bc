"""The command `roofslip plan`: the roof plan of a workbook, from a drawing.

Read `read` first, then `choose`: what it does with layers that nobody said anything of.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import click

from report.cli.options import Number, SectionedGroup
from report.cli.terminal import SOURCE, Progress, input_errors, plain, say_next
from report.text.counts import command, numbered

if TYPE_CHECKING:
    from report.assessment.design.arrays import ArrayAssessment
    from report.drawing_read.ballast import Load
    from report.drawing_read.roof_drawing import DrawnOutline, RoofDrawing
    from report.project.model.choices import LayerKind
    from report.project.model.input_rows import InputRow
    from report.project.write.filled import WorkbookChange


# A drawing may have thousands of layers, with names of any length.
_MOST_ROWS, _MOST_LETTERS = 100, 60


def given_kinds(
    _: click.Context, __: click.Parameter, value: Sequence[str]
) -> dict[str, LayerKind]:
    """Return what each `--layer NAME=KIND` says, by the name."""
    from report.project.model.choices import LayerKind

    kinds = {}
    for text in value:
        # From the right: a layer may have the sign in its name, a kind has not.
        name, _sign, word = text.rpartition("=")
        if not name or word.lower() not in list(LayerKind):
            choices = ", ".join(LayerKind)
            raise click.BadParameter(f"'{text}' is not NAME=KIND, where KIND is one of {choices}.")
        kinds[name] = LayerKind(word.lower())
    return kinds


def choose(
    drawing: RoofDrawing,
    sheet: Mapping[str, LayerKind],
    chosen: Mapping[str, LayerKind],
    accept: bool,
) -> dict[str, LayerKind]:
    """Return what is said of layers beyond the sheet Layers: as given, or proposed and accepted.

    Raises `InputError` if a layer that is given is not in the drawing; or, after a table of them,
    if layers with closed lines are not known.
    """
    from report.drawing_read.layer_names import proposed
    from report.drawing_read.plan_read import known_layers
    from report.project.model.choices import LayerKind
    from report.text.counts import numbered
    from solver.model import InputError, Problem
    from solver.suggestions import nearest

    names = {layer.casefold(): layer for layer, _ in drawing.counts}
    if lost := [name for name in chosen if name.casefold() not in names]:
        near = [nearest(name, names.values()) for name in lost]
        raise InputError(
            [Problem(f"no layer '{name}'", meant and f"did you mean '{meant}'?")
             for name, meant in zip(lost, near, strict=True)]
        )  # fmt: skip
    known = known_layers({**sheet, **chosen})
    outlines = Counter(line.layer for line in drawing.lines if line.layer.casefold() not in known)
    kinds = {layer: proposed(layer) for layer in sorted(outlines)}
    # A guess that is filled in unseen would move an array: it is shown first.
    if kinds and not accept:
        for line in _table(drawing, outlines, kinds):
            click.echo(plain(line))
        raise InputError(
            f"nothing is written: nobody says what is drawn on {numbered(len(kinds), 'layer')};"
            " add --accept to take what is proposed, or --layer NAME=KIND for a layer, where KIND"
            f" is one of {', '.join(LayerKind)}"
        )
    return {**chosen, **{layer: kind for layer, kind in kinds.items() if kind}}


def _table(
    drawing: RoofDrawing, outlines: Mapping[str, int], kinds: Mapping[str, LayerKind | None]
) -> Iterator[str]:
    from report.drawing_read.layer_names import drawn_on
    from report.text.formats import aligned

    rows = [("layer", "closed lines", "drawn", "proposed")]
    for layer, kind in list(kinds.items())[:_MOST_ROWS]:
        drawn = drawn_on(drawing, layer)
        rows.append((layer[:_MOST_LETTERS], str(outlines[layer]), drawn, kind or "none"))
    yield from aligned(rows, "<><<")


UNIT_CHOICES = ("in", "ft", "mm", "cm", "m")
WEIGHT_CHOICES = ("lb", "kip", "N", "kN", "kg")

_POSITIVE = Number(low=0.0, is_open=True)


def _rotation(context: click.Context, parameter: click.Parameter, value: str) -> float:
    """Return the angle of `--rotate` [deg]; NaN for `north`."""
    if value == "north":
        return math.nan
    return Number("deg", -360.0, 360.0).convert(value, parameter, context)


@click.group(cls=SectionedGroup)
def plan() -> None:
    """Fill in the roof plan of a workbook from a drawing."""


@plan.command()
@click.argument("drawing", metavar="ROOF.DXF", type=SOURCE)
@click.argument("project", metavar="DIR|WORKBOOK", type=SOURCE)
@click.option("--units", type=click.Choice(UNIT_CHOICES),
              help="Unit of the drawing; required if it states none.")  # fmt: skip
@click.option("--gap", type=(_POSITIVE, click.Choice(UNIT_CHOICES)), default=(20.0, "in"),
              metavar="NUMBER UNIT",
              help="Largest gap between modules of one array; 20 in unless given.")  # fmt: skip
@click.option("--replace", is_flag=True, help="Overwrite the places of rows that are filled.")
@click.option("--accept", is_flag=True, help="Take what is proposed for layers that are not known.")
@click.option("--layer", "kinds", metavar="NAME=KIND", multiple=True, callback=given_kinds,
              help="What is drawn on a layer; may be repeated.")  # fmt: skip
@click.option("--rotate", metavar="DEGREES|north", default="0", callback=_rotation,
              help="Turn the drawing counterclockwise, or its north to +y.")  # fmt: skip
def read(
    drawing: Path,
    project: Path,
    units: str | None,
    gap: tuple[float, str],
    replace: bool,
    accept: bool,
    kinds: dict[str, LayerKind],
    rotate: float,
) -> None:
    """Fill in arrays, objects, roof edges and outlines from the closed lines of a DXF.

    The sheet Layers says what each layer is; the layers of plan.dxf are known, and others are
    proposed by their names. Names and heights are texts inside the outlines, or attributes of
    blocks. Equal rectangles of the size of modules are joined into arrays. Everything else in the
    workbook is kept. If it has no other errors, the clearances follow as by plan clearances.
    """
    from report.drawing_read.fill import fill_plan, layers_of, plan_as_rows, unread
    from report.project.check.plan_shapes import us_first
    from report.project.write.filled import changing, withdrawn
    from report.text.units import LENGTHS
    from solver.model import InputError

    gap_m = gap[0] * LENGTHS[gap[1]]
    with input_errors(project), changing(project) as change:
        inputs = change.sheet_before.inputs
        is_us = us_first(inputs)
        with input_errors(drawing):
            with Progress() as progress:
                progress("reading the drawing")
                drawn, unit_m = _read(drawing, units)
            # Outside of a progress, whose line would be written over the table of layers.
            drawn, turn = _turned(drawn, rotate)
            layers = choose(drawn, layers_of(inputs), kinds, accept)
            with Progress() as progress:
                progress("finding the plan in the drawing")
                found, layers = plan_as_rows(
                    drawn, unit_m, inputs, layers, gap_m, is_unit_given=units is not None
                )
        plan_lines = fill_plan(change, found, layers, replace=replace)
        try:
            more = _add_clearances(change)
        # The plan is filled in all the same: it is what the next errors are corrected on.
        except InputError as error:
            more = [
                f"Clearances are not added yet: {error.problems[0]}.",
                f"Once the workbook has no errors, run: {command('plan clearances', project)}",
            ]
        more = [*more, *withdrawn(change)]
    lines = (
        *filter(None, (drawn.repairs,)),
        *turn,
        *(_line(place, gap_m, is_us) for place in (*found.roof, *found.arrays, *found.objects)),
        *unread(found),
        *(f"layer {name}: {kind.value}" for name, kind in layers.items()),
        f"{change.book.path}: the plan is filled in: {change.areas}",
        *plan_lines,
        *more,
    )
    for text in lines:
        click.echo(plain(text))
    say_next(project, change.has_formulas)


@plan.command()
@click.argument("project", metavar="DIR|WORKBOOK", type=SOURCE)
def clearances(project: Path) -> None:
    """Add a row to the sheet Clearances for each pair of the plan that a package would require.

    Arrays, objects and roof edges within reach of an array: twice the prescriptive displacement, or
    the design displacement where the motions can be run and give more. Distances are those of the
    plan, rounded down, and say so in the column Distance from: a condition of the package until
    they are confirmed. Rows whose distance is from the drawing are renewed; all others are kept.
    """
    from report.project.write.filled import changing, withdrawn

    with input_errors(project), changing(project) as change:
        lines = [*_add_clearances(change), *withdrawn(change)]
    for line in lines:
        click.echo(plain(line))
    if change.written:
        click.echo(plain(f"{change.book.path}: written: {change.areas}"))
    say_next(project, change.has_formulas)


def _add_clearances(change: WorkbookChange) -> Sequence[str]:
    """Add the rows of clearances that a workbook lacks; return what to print of them."""
    from report.project.read.read import read_book, without_motions
    from solver.model import InputError

    sheet = read_book(change.book) if change.written else change.sheet_before
    not_run: list[str] = []
    # An error in it does not wait for the compiler, which the imports below load.
    without_motions(sheet)
    from report.assessment.assess import assess
    from report.assessment.plan.missing_rows import missing_rows, without_clearances
    from report.motions.prepare import prepare

    arrays: Sequence[ArrayAssessment] = ()
    with Progress(1) as progress:
        try:
            to_run = without_clearances(sheet)
            shaking = prepare(to_run)
            progress("running the motions")
            arrays = assess(to_run, shaking).arrays
        except InputError as error:
            # Rows within twice the prescriptive displacement are known without a run.
            not_run = [f"the motions are not run: {error.problems[0]}"]
    cells, lines = missing_rows(sheet, arrays)
    change.fill(cells)
    return [*not_run, *lines]


def _read(drawing: Path, units: str | None) -> tuple[RoofDrawing, float]:
    """Read the drawing; return it and the size of its unit [m]."""
    from report.drawing_read.read_dxf import read_dxf
    from report.text.units import LENGTHS
    from solver.model import InputError

    roof_drawing = read_dxf(drawing, LENGTHS.get(units or ""))
    unit = units or roof_drawing.unit
    if not unit:
        if roof_drawing.other_unit:
            raise InputError(roof_drawing.other_unit)
        raise InputError(f"states no unit; add --units with one of {', '.join(UNIT_CHOICES)}")
    return roof_drawing, LENGTHS[unit]


def _turned(drawn: RoofDrawing, rotate: float) -> tuple[RoofDrawing, list[str]]:
    """Return the drawing as turned, and lines on that and its north; NaN turns its north to +y."""
    from solver.model import InputError

    # North is given from +x, counterclockwise.
    degrees = 90.0 - drawn.north_deg if math.isnan(rotate) else rotate
    if math.isnan(degrees):
        raise InputError("states no north (GEODATA); give --rotate in degrees")
    lines = []
    if degrees:
        drawn = drawn.turned(degrees)
        lines += [f"turned counterclockwise by {degrees:.6g}° about the origin of the drawing"]
    if not math.isnan(drawn.north_deg):
        north = f"{drawn.north_deg:.6g}° counterclockwise from +x"
        lines += [f"north is {north}: check it on the sheet Building"]
    elif degrees:
        lines += ["the drawing states no north: check its direction on the sheet Building"]
    return drawn, lines


def _line(place: DrawnOutline, gap_m: float, is_us: bool) -> str:
    from report.drawing_read.geometry import own_axes
    from report.text.units import Quantity, pair

    *sides, angle = own_axes(place.shape)
    wide, tall = (pair(side, Quantity.PLAN, is_us) for side in sides)
    askew = f" at {angle:.6g}° to the axes" if round(angle, 6) else ""
    source = f" from {place.handle} on {place.layer}" if place.handle else ""
    note = "; ".join(filter(None, (place.unnamed, place.note)))
    note = f" ({note})" if note else ""
    count, made = len(place.shape.points), place.kind.value
    if place.sizes:
        sizes = ", ".join(
            f"{numbered(of, 'module')} {pair(long, Quantity.SIZE, is_us)} by"
            f" {pair(short, Quantity.SIZE, is_us)}"
            for of, long, short in place.sizes
        )
        made += f" of {sizes} with gaps of at most {pair(gap_m, Quantity.SIZE, is_us)}"
    return f"{place.name}: {made}, {count} vertices, {wide} by {tall}{askew}{source}{note}"


@plan.command()
@click.argument("ballast_map", metavar="MAP.csv", type=SOURCE)
@click.argument("project", metavar="DIR|WORKBOOK", type=SOURCE)
@click.option("--units", type=click.Choice(UNIT_CHOICES), required=True, help="Unit of x and y.")
@click.option("--block-weight", type=(_POSITIVE, click.Choice(WEIGHT_CHOICES)), required=True,
              metavar="NUMBER UNIT", help="Of one block, such as 32 lb.")  # fmt: skip
@click.option("--replace", is_flag=True, help="Overwrite ballast weights that are given.")
def ballast(
    ballast_map: Path, project: Path, units: str, block_weight: tuple[float, str], replace: bool
) -> None:
    """Fill in the ballast weight of arrays from a CSV with the columns x, y, blocks.

    Coordinates are those of the plan. Prints the center of gravity of each array in plan.
    """
    from report.drawing_read.ballast import loads, read_map
    from report.drawing_read.fill import fill_ballast
    from report.project.check.plan_shapes import shapes_of, us_first
    from report.project.check.problem_lines import listed
    from report.project.read.read import read_book
    from report.project.write.filled import changing
    from report.text.units import LENGTHS, WEIGHTS, Quantity, pair
    from solver.model import InputError

    block_n = block_weight[0] * WEIGHTS[block_weight[1]]
    with input_errors(ballast_map):
        rows = read_map(ballast_map, LENGTHS[units])
    with input_errors(project), changing(project) as change:
        sheet = read_book(change.book)
        shapes = shapes_of(sheet.inputs)
        arrays = {row["id"]: row for row in sheet.inputs["arrays"] if row.get("id") in shapes}
        blocks, outside = loads(rows, {name: shapes[name] for name in arrays})
        if not blocks:
            what = "no block of the map is within an array of the plan"
            raise InputError(f"{what}; give --units of the map, or x and y from the plan's origin")
        weights = {name: load.blocks * block_n for name, load in blocks.items()}
        # What is not on the map any more goes only where that is asked for.
        bare = [name for name in arrays if name not in blocks] if replace else []
        fill_ballast(change, {**weights, **dict.fromkeys(bare)}, replace=replace)
    is_us = us_first(sheet.inputs)
    for name, row in arrays.items():
        text = _balance(row, blocks[name], weights[name], is_us) if name in blocks else "no blocks"
        if name not in blocks and row.get("ballast_n") is not None:
            was = pair(row["ballast_n"], Quantity.WEIGHT, is_us)
            text += f"; the {was} given {'are taken out' if replace else 'stay without --replace'}"
        click.echo(plain(f"{name}: {text}"))
    if outside:
        lines = f"{numbered(len(outside), 'line')} of the map: {listed(map(str, outside))}"
        click.echo(f"outside of every array: {lines}")
    click.echo(f"{sheet.path}: the ballast weights are filled in: {change.areas}")
    say_next(project, change.has_formulas)


def _balance(row: InputRow, load: Load, ballast_n: float, is_us: bool) -> str:
    """Return the ballast of an array and its center of gravity, as far as weights are known."""
    from report.drawing_read.ballast import center_of_gravity
    from report.text.units import Quantity, pair

    modules, each_n = row.get("modules"), row.get("module_weight_n")
    modules_n = modules * each_n if modules and each_n else 0.0
    center = center_of_gravity(load, ballast_n, modules_n)
    off = (center[0] - load.centroid[0], center[1] - load.centroid[1])
    x, y, off_x, off_y = (pair(value, Quantity.PLAN, is_us) for value in (*center, *off))
    what = f"ballast and {modules} modules" if modules_n else "the ballast alone"
    return (
        f"{numbered(load.blocks, 'block')}, {pair(ballast_n, Quantity.WEIGHT, is_us)}; center of"
        f" gravity of {what} at x {x}, y {y}; from the centroid of the outline {off_x} in x,"
        f" {off_y} in y"
    )
