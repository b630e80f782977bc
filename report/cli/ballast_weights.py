"""Fills in the ballast weight of arrays from a map of the ballast blocks."""

from __future__ import annotations

from pathlib import Path

from report.cli.console import say, say_next
from report.cli.input_errors import input_errors
from report.drawing_read.ballast import Load, center_of_gravity, loads, read_map, repeated
from report.drawing_read.fill import fill_ballast as write_ballast
from report.project.check.finding_lines import listed
from report.project.check.plan_shapes import shapes_of, us_first
from report.project.model.input_rows import InputRow
from report.project.read.read import read_book
from report.project.write.filled import changing
from report.text.counts import numbered
from report.text.units import LENGTHS, WEIGHTS, Quantity, pair
from solver.errors import InputError


def fill_ballast(
    ballast_map: Path, project: Path, *, units: str, block_weight: tuple[float, str], replace: bool
) -> None:
    """Fill in the weights, and print the center of gravity of each array."""
    block_n = block_weight[0] * WEIGHTS[block_weight[1]]
    with input_errors(ballast_map):
        rows = read_map(ballast_map, LENGTHS[units])
    with input_errors(project), changing(project) as change:
        # From the open change, not from the file: it is locked, and what is read here is what is
        # written.
        sheet = read_book(change.book)
        shapes = shapes_of(sheet.inputs)
        arrays = {row["id"]: row for row in sheet.inputs["arrays"] if row.get("id") in shapes}
        blocks, outside = loads(rows, {name: shapes[name] for name in arrays})
        if not blocks:
            problem = "no ballast block of the map is inside an array on the plan"
            raise InputError(
                f"{problem}; use the --units of the map, and measure x and y from the origin of"
                " the plan"
            )
        weights = {name: load.blocks * block_n for name, load in blocks.items()}
        cell_values: dict[str, float | None] = {**weights}
        if replace:  # what is not on the map any more goes only where that is asked for
            cell_values |= {name: None for name in arrays if name not in blocks}
        write_ballast(change, cell_values, replace=replace)
    is_us = us_first(sheet.inputs)
    for name, row in arrays.items():
        if name in blocks:
            text = _balance(row, blocks[name], weights[name], is_us)
        else:
            text = "no blocks"
            if row.get("ballast_n") is not None:
                weight_text = pair(row["ballast_n"], Quantity.WEIGHT, is_us)
                fate = "was deleted" if replace else "is kept; use --replace to delete it"
                text += f"; the entered weight, {weight_text}, {fate}"
        say(f"{name}: {text}")
    if outside:
        lines = f"{numbered(len(outside), 'line')} of the map: {listed(map(str, outside))}"
        say(f"outside all arrays: {lines}")
    if equal := repeated(rows):
        lines = f"{numbered(len(equal), 'line')} of the map: {listed(map(str, equal))}"
        say(f"equal to an earlier line and counted again: {lines}; delete those drawn twice")
    say(sheet.path, f": ballast weights filled in: {change.areas}")
    say_next(project, change.has_formulas)


def _balance(row: InputRow, load: Load, ballast_n: float, is_us: bool) -> str:
    """Return the ballast of an array and its center of gravity, as far as weights are known."""
    modules, module_n = row.get("modules"), row.get("module_weight_n")
    modules_n = modules * module_n if modules and module_n else 0.0
    center = center_of_gravity(load, ballast_n, modules_n)
    offset = (center[0] - load.centroid[0], center[1] - load.centroid[1])
    x, y, offset_x, offset_y = (pair(value, Quantity.PLAN, is_us) for value in (*center, *offset))
    content = f"ballast and {modules} modules" if modules_n else "the ballast only"
    return (
        f"{numbered(load.blocks, 'block')}, {pair(ballast_n, Quantity.WEIGHT, is_us)}; center of"
        f" gravity of {content} at x {x}, y {y}; from the centroid of the outline {offset_x} in x,"
        f" {offset_y} in y"
    )
