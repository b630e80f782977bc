"""The commands on the roof plan of a workbook: `roofslip plan read`, `clearances`, `ballast`."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import click

from report.cli.lazy_group import LazyGroup
from report.cli.option_types import SOURCE, Number

UNIT_CHOICES = ("in", "ft", "mm", "cm", "m")
WEIGHT_CHOICES = ("lb", "kip", "N", "kN", "kg")

_POSITIVE = Number(low=0.0, is_open=True)


def _degrees(context: click.Context, parameter: click.Parameter, value: str) -> float:
    """Return the angle of `--rotate` [deg]; NaN for `north`."""
    if value == "north":
        return math.nan
    return Number("deg", -360.0, 360.0).convert(value, parameter, context)


@click.group(cls=LazyGroup)
def plan() -> None:
    """Fill in the roof plan of a workbook from a drawing."""


_HERE = "report.cli.commands.plan"
plan.add_section("Commands", f"{_HERE}:ballast", f"{_HERE}:clearances", f"{_HERE}:read")


@click.command()
@click.argument("drawing", metavar="ROOF.DXF", type=SOURCE)
@click.argument("project", metavar="DIR|WORKBOOK", type=SOURCE)
@click.option("--units", type=click.Choice(UNIT_CHOICES),
              help="Unit of the drawing; required if the drawing does not state it.")  # fmt: skip
@click.option("--gap", type=(_POSITIVE, click.Choice(UNIT_CHOICES)), default=(20.0, "in"),
              metavar="NUMBER UNIT",
              help="Largest gap between modules of one array; default: 20 in.")  # fmt: skip
@click.option("--replace", is_flag=True, help="Overwrite existing locations.")
@click.option("--accept", is_flag=True, help="Accept the proposed types of unknown layers.")
@click.option("--layer", "layers", metavar="NAME=TYPE", multiple=True,
              help="Type of a layer; may be repeated.")  # fmt: skip
@click.option("--rotate", "rotate_deg", metavar="DEGREES|north", default="0", callback=_degrees,
              help="Rotate the drawing counterclockwise, or its north to +y.")  # fmt: skip
def read(drawing: Path, project: Path, **options: Any) -> None:
    """Import arrays, objects, roof edges and outlines from the closed lines of a DXF.

    The Layers worksheet lists the type of each layer; the layers of plan.dxf are known, and types
    of others are proposed from their names. Names and heights are text inside the outlines, or
    attributes of blocks. Equal module-size rectangles are grouped into arrays. Everything else in
    the workbook is kept. If it has no other errors, clearances are added as with plan clearances.
    """
    from report.cli.plan_from_drawing import read_plan

    read_plan(drawing, project, **options)


@click.command()
@click.argument("project", metavar="DIR|WORKBOOK", type=SOURCE)
def clearances(project: Path) -> None:
    """Add a row to the Clearances worksheet for each pair on the plan that the package requires.

    Searches arrays, objects and roof edges within twice the prescriptive displacement of an array,
    or twice the design displacement if the motions can be run and it is larger. Distances are those
    on the plan, rounded down, and are marked in the column Clearance source: an open condition
    until they are confirmed. Rows with distances from the drawing are updated; all others are kept.
    """
    from report.cli.clearance_rows import fill_clearances

    fill_clearances(project)


@click.command()
@click.argument("ballast_map", metavar="MAP.csv", type=SOURCE)
@click.argument("project", metavar="DIR|WORKBOOK", type=SOURCE)
@click.option("--units", type=click.Choice(UNIT_CHOICES), required=True, help="Unit of x and y.")
@click.option("--block-weight", type=(_POSITIVE, click.Choice(WEIGHT_CHOICES)), required=True,
              metavar="NUMBER UNIT", help="Weight of one block, such as 32 lb.")  # fmt: skip
@click.option("--replace", is_flag=True, help="Overwrite entered ballast weights.")
def ballast(ballast_map: Path, project: Path, **options: Any) -> None:
    """Fill in the ballast weight of arrays from a CSV with the columns x, y, blocks.

    Coordinates are those of the plan. Prints the center of gravity of each array in plan.
    """
    from report.cli.ballast_weights import fill_ballast

    fill_ballast(ballast_map, project, **options)
