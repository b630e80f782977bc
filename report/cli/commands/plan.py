"""The commands on the roof plan of a workbook: `roofslip plan read`, `clearances`, `ballast`."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import click

from report.cli.lazy_group import LazyGroup
from report.cli.options import SOURCE, Number

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
              help="Unit of the drawing; required if it states none.")  # fmt: skip
@click.option("--gap", type=(_POSITIVE, click.Choice(UNIT_CHOICES)), default=(20.0, "in"),
              metavar="NUMBER UNIT",
              help="Largest gap between modules of one array; 20 in unless given.")  # fmt: skip
@click.option("--replace", is_flag=True, help="Overwrite the places of rows that are filled.")
@click.option("--accept", is_flag=True, help="Take what is proposed for layers that are not known.")
@click.option("--layer", "layers", metavar="NAME=KIND", multiple=True,
              help="What is drawn on a layer; may be repeated.")  # fmt: skip
@click.option("--rotate", "rotate_deg", metavar="DEGREES|north", default="0", callback=_degrees,
              help="Turn the drawing counterclockwise, or its north to +y.")  # fmt: skip
def read(drawing: Path, project: Path, **options: Any) -> None:
    """Fill in arrays, objects, roof edges and outlines from the closed lines of a DXF.

    The sheet Layers says what each layer is; the layers of plan.dxf are known, and others are
    proposed by their names. Names and heights are texts inside the outlines, or attributes of
    blocks. Equal rectangles of the size of modules are joined into arrays. Everything else in the
    workbook is kept. If it has no other errors, the clearances follow as by plan clearances.
    """
    from report.cli.plan_from_drawing import read_plan

    read_plan(drawing, project, **options)


@click.command()
@click.argument("project", metavar="DIR|WORKBOOK", type=SOURCE)
def clearances(project: Path) -> None:
    """Add a row to the sheet Clearances for each pair of the plan that a package would require.

    Arrays, objects and roof edges within reach of an array: twice the prescriptive displacement, or
    the design displacement where the motions can be run and give more. Distances are those of the
    plan, rounded down, and say so in the column Distance from: a condition of the package until
    they are confirmed. Rows whose distance is from the drawing are renewed; all others are kept.
    """
    from report.cli.clearance_rows import fill_clearances

    fill_clearances(project)


@click.command()
@click.argument("ballast_map", metavar="MAP.csv", type=SOURCE)
@click.argument("project", metavar="DIR|WORKBOOK", type=SOURCE)
@click.option("--units", type=click.Choice(UNIT_CHOICES), required=True, help="Unit of x and y.")
@click.option("--block-weight", type=(_POSITIVE, click.Choice(WEIGHT_CHOICES)), required=True,
              metavar="NUMBER UNIT", help="Of one block, such as 32 lb.")  # fmt: skip
@click.option("--replace", is_flag=True, help="Overwrite ballast weights that are given.")
def ballast(ballast_map: Path, project: Path, **options: Any) -> None:
    """Fill in the ballast weight of arrays from a CSV with the columns x, y, blocks.

    Coordinates are those of the plan. Prints the center of gravity of each array in plan.
    """
    from report.cli.ballast_weights import fill_ballast

    fill_ballast(ballast_map, project, **options)
