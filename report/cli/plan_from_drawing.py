"""Fills in the roof plan of a workbook from a drawing.

Read `read_plan`, then `choose`, which handles layers not listed on the Layers worksheet.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

import click

from report.cli.clearance_rows import add_clearances
from report.cli.commands.plan import UNIT_CHOICES
from report.cli.console import say, say_next
from report.cli.input_errors import input_errors
from report.cli.progress import Progress
from report.drawing_read.fill import fill_plan, layers_of, plan_as_rows, unread
from report.drawing_read.geometry import own_axes
from report.drawing_read.layer_names import drawn_on, proposed
from report.drawing_read.plan_read import known_layers
from report.drawing_read.read_dxf import read_dxf
from report.drawing_read.roof_drawing import DrawnOutline, RoofDrawing
from report.project.check.plan_shapes import us_first
from report.project.model.choices import LayerKind
from report.project.write.filled import changing, withdrawn
from report.text.aligned import aligned
from report.text.command_line import command
from report.text.counts import numbered
from report.text.units import LENGTHS, Quantity, pair
from solver.errors import InputError, Problem
from solver.suggestions import nearest

# A drawing may have thousands of layers, with names of any length.
_MAX_ROWS, _MAX_LETTERS = 100, 60


def read_plan(
    drawing: Path,
    project: Path,
    *,
    units: str | None,
    gap: tuple[float, str],
    replace: bool,
    accept: bool,
    layers: Sequence[str],
    rotate_deg: float,
) -> None:
    """Fill in arrays, objects, roof edges and outlines, and print what was read.

    `rotate_deg` is NaN to turn the north of the drawing to +y.
    """
    kinds = _kinds(layers)
    gap_m = gap[0] * LENGTHS[gap[1]]
    with input_errors(project), changing(project) as change:
        inputs = change.sheet_before.inputs
        with input_errors(drawing):
            with Progress() as progress:
                progress("reading the drawing")
                roof_drawing, unit_m = _read(drawing, units)
            # Outside of a progress, whose line would be written over the table of layers.
            roof_drawing, turn_lines = _turned(roof_drawing, rotate_deg)
            layer_kinds = choose(roof_drawing, layers_of(inputs), kinds, accept)
            with Progress() as progress:
                progress("finding the plan in the drawing")
                plan, layer_kinds = plan_as_rows(
                    roof_drawing,
                    unit_m,
                    inputs,
                    layer_kinds,
                    gap_m,
                    is_unit_given=units is not None,
                )
        plan_lines = fill_plan(change, plan, layer_kinds, replace=replace)
        try:
            clearance_lines = add_clearances(change)
        # The plan is filled in all the same: it is what the next errors are corrected on.
        except InputError as error:
            clearance_lines = [
                f"Clearances have not been added: {error.problems[0]}.",
                f"Once the workbook has no errors, run: {command('plan clearances', project)}",
            ]
        withdrawn_lines = withdrawn(change)
    lines = [roof_drawing.repairs] if roof_drawing.repairs else []
    lines += turn_lines
    for outline in (*plan.roof, *plan.arrays, *plan.objects):
        lines.append(_line(outline, gap_m, us_first(inputs)))
    lines += unread(plan)
    lines += [f"layer {name}: {kind.value}" for name, kind in layer_kinds.items()]
    lines.append(f"{change.book.path}: plan updated: {change.areas}")
    for text in (*lines, *plan_lines, *clearance_lines, *withdrawn_lines):
        say(text)
    say_next(project, change.has_formulas)


def _kinds(layers: Sequence[str]) -> dict[str, LayerKind]:
    """Return the type in each `--layer NAME=TYPE`, by name."""
    kinds = {}
    for text in layers:
        # From the right: a layer may have the sign in its name, a kind has not.
        name, _, kind = text.rpartition("=")
        if not name or kind.lower() not in list(LayerKind):
            choices = ", ".join(LayerKind)
            raise click.BadParameter(
                f"'{text}' is not NAME=TYPE, where TYPE is one of {choices}.",
                ctx=click.get_current_context(),
                param_hint="'--layer'",
            )
        kinds[name] = LayerKind(kind.lower())
    return kinds


def choose(
    drawing: RoofDrawing,
    sheet_kinds: Mapping[str, LayerKind],
    option_kinds: Mapping[str, LayerKind],
    accept: bool,
) -> dict[str, LayerKind]:
    """Return the types of layers not on the Layers worksheet: as given, or proposed and accepted.

    Raises `InputError` if a given layer is not in the drawing; or, after printing them, if layers
    with closed lines are unknown.
    """
    # Names of layers are equal whatever their capitals, as in AutoCAD.
    names = {layer.casefold(): layer for layer, _ in drawing.counts}
    problems = []
    for name in option_kinds:
        if name.casefold() not in names:
            near = nearest(name, names.values())
            problems.append(Problem(f"no layer '{name}'", near and f"did you mean '{near}'?"))
    if problems:
        raise InputError(problems)
    known = known_layers({**sheet_kinds, **option_kinds})
    outlines = Counter(line.layer for line in drawing.lines if line.layer.casefold() not in known)
    kinds = {layer: proposed(layer) for layer in sorted(outlines)}
    # A guess that is filled in unseen would move an array: it is shown first.
    if kinds and not accept:
        for line in _table(drawing, outlines, kinds):
            say(line)
        raise InputError(
            f"nothing was written: no type is known for {numbered(len(kinds), 'layer')};"
            " use --accept to accept the proposed types, or --layer NAME=TYPE for a layer, where"
            f" TYPE is one of {', '.join(LayerKind)}"
        )
    return {**option_kinds, **{layer: kind for layer, kind in kinds.items() if kind}}


def _table(
    drawing: RoofDrawing, outlines: Mapping[str, int], kinds: Mapping[str, LayerKind | None]
) -> Iterator[str]:
    rows = [("layer", "closed lines", "drawn", "proposed")]
    for layer, kind in list(kinds.items())[:_MAX_ROWS]:
        drawn = drawn_on(drawing, layer)
        rows.append((layer[:_MAX_LETTERS], str(outlines[layer]), drawn, kind or "none"))
    yield from aligned(rows, "<><<")


def _read(drawing: Path, units: str | None) -> tuple[RoofDrawing, float]:
    """Read the drawing; return it and the size of its unit [m]."""
    roof_drawing = read_dxf(drawing, LENGTHS.get(units or ""))
    unit = units or roof_drawing.unit
    if not unit:
        if roof_drawing.other_unit:
            raise InputError(roof_drawing.other_unit)
        raise InputError(
            "the drawing does not state its unit; use --units with one of"
            f" {', '.join(UNIT_CHOICES)}"
        )
    return roof_drawing, LENGTHS[unit]


def _turned(drawing: RoofDrawing, rotate_deg: float) -> tuple[RoofDrawing, list[str]]:
    """Return the rotated drawing, and lines on the rotation and north; NaN turns north to +y."""
    # North is given from +x, counterclockwise.
    degrees = 90.0 - drawing.north_deg if math.isnan(rotate_deg) else rotate_deg
    if math.isnan(degrees):
        raise InputError(
            "the drawing does not state north (GEODATA); use --rotate with an angle in degrees"
        )
    lines = []
    if degrees:
        drawing = drawing.turned(degrees)
        lines += [f"rotated counterclockwise by {degrees:.6g}° about the origin of the drawing"]
    if not math.isnan(drawing.north_deg):
        north = f"{drawing.north_deg:.6g}° counterclockwise from +x"
        lines += [f"north is {north}: check it on the Building worksheet"]
    elif degrees:
        lines += ["the drawing does not state north: check the direction on the Building worksheet"]
    return drawing, lines


def _line(outline: DrawnOutline, gap_m: float, is_us: bool) -> str:
    *sides, angle = own_axes(outline.shape)
    wide, tall = (pair(side, Quantity.PLAN, is_us) for side in sides)
    # A millionth of a degree is 1.7 µm over 100 m: rounding of the coordinates, not a rotation.
    angle_text = f" at {angle:.6g}° to the axes" if round(angle, 6) else ""
    source = f" from {outline.handle} on {outline.layer}" if outline.handle else ""
    note = "; ".join(filter(None, (outline.unnamed, outline.note)))
    note = f" ({note})" if note else ""
    count, kind = len(outline.shape.points), outline.kind.value
    if outline.sizes:
        sizes = []
        for modules, long_m, short_m in outline.sizes:
            size = f"{pair(long_m, Quantity.SIZE, is_us)} by {pair(short_m, Quantity.SIZE, is_us)}"
            sizes.append(f"{numbered(modules, 'module')} {size}")
        gap = pair(gap_m, Quantity.SIZE, is_us)
        kind += f" of {', '.join(sizes)} with gaps of at most {gap}"
    size = f"{wide} by {tall}{angle_text}"
    return f"{outline.name}: {kind}, {count} vertices, {size}{source}{note}"
