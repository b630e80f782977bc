"""A ballast map: number and location of blocks, and the ballast of each array.

    x,y,blocks      on an array from x 20 to 25 and y 15 to 35 ft, with the middle at 22.5, 25:
    22.5,18,2       three blocks, with their center at 22.5, 22 ft
    22.5,30,1

Knows no workbook (`report.drawing_read.fill`). Read `read_map`, then `loads`.
"""

from __future__ import annotations

import codecs
import csv
import math
import re
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import shapely

from report.project.model.shapes import Point, Shape, solid
from report.project.read.number_formats import unit_named
from report.project.read.typed_text import number_in, separator, with_point
from report.text.typed_letters import cut
from report.text.units import LENGTHS
from solver.errors import InputError
from solver.file_checks import read_file

MAX_BYTES, MAX_ROWS, MAX_BLOCKS = 5_000_000, 20_000, 10_000
COLUMNS = ("x", "y", "blocks")
_NAMES = dict.fromkeys(("block count", "number of blocks"), "blocks")
_HEADING = re.compile(  # of one blank between its words
    r"(.{0,60}?)(?:[ _]{0,2}[\[(] ?([^\])]{0,20}?) ?[\])]|[ _]{1,2}(in|ft|mm|cm|m))?"
)


@dataclass(frozen=True, slots=True, kw_only=True)
class Load:
    """The blocks of an array, their center and the centroid of its outline [m]."""

    blocks: int
    center: Point
    centroid: Point


def read_map(path: Path, unit_m: float) -> Any:
    """Return the rows of a ballast map: line of the file, x [m], y [m] and number of blocks.

    It is a CSV with the headings x, y and blocks, or block count, and its unit given in m: with
    commas, semicolons or tabs, in UTF-8 or UTF-16. A heading may name the unit of x and y.

    Raises `InputError` with every line that is wrong, or if the file is too large or no such CSV.
    """
    data = read_file(path, MAX_BYTES, too_large=f"keep only the columns {', '.join(COLUMNS)}")
    # Excel saves "Unicode text" in UTF-16, with tabs.
    is_utf_16 = data.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE))
    try:
        content = data.decode("utf-16" if is_utf_16 else "utf-8-sig").splitlines()
        mark = separator(content)
        lines = csv.reader(content, delimiter=mark, strict=True)
        rows = [(lines.line_num, row) for row in lines if any(map(str.strip, row))]
        if rows and rows[0][1][0].casefold().startswith("sep="):  # as Excel begins one
            del rows[0]
    except (UnicodeDecodeError, csv.Error) as error:
        raise InputError("not a CSV file in UTF-8 or UTF-16; save it as one") from error
    heads = []
    for heading in rows[0][1] if rows else ():
        words = _HEADING.fullmatch(" ".join(heading.split()).casefold())
        name, *units = words.groups(default="") if words else ("",)
        heads.append(_NAMES.get(name, name))
        unit = "".join(units)
        if name in ("x", "y") and unit and LENGTHS.get(unit_named(unit)) != unit_m:
            text = f"line 1: the heading is '{cut(heading)}'"
            raise InputError(f"{text}, but --units states another unit; enter the unit of x and y")
        if name == "blocks" and unit:
            text = f"line 1: the heading is '{cut(heading)}'"
            raise InputError(f"{text}; enter the number of blocks below blocks")
    if missing := [name for name in COLUMNS if heads.count(name) != 1]:
        names = ", ".join(missing)
        raise InputError(
            f"line 1: found none or several of {names}; enter x, y and blocks once each"
        )
    if len(rows) > MAX_ROWS:
        raise InputError(f"{len(rows):,} lines, more than {MAX_ROWS:,}; combine neighboring blocks")
    rows_read, wrong = [], []
    for line, row in rows[1:]:
        # A decimal comma makes two values of one, and a column without a heading moves the others.
        if any(map(str.strip, row[len(heads) :])):
            remedy = "enter a heading for each column, and decimal points or semicolons"
            wrong.append(f"line {line}: {len(row)} values, {len(heads)} headings; {remedy}")
            continue
        cells = [row[k].strip() if k < len(row) else "" for k in map(heads.index, COLUMNS)]
        x, y, blocks = (number_in(with_point(text, mark)) for text in cells)
        for name, text, value in zip(COLUMNS, cells, (x, y, blocks), strict=True):
            if not math.isfinite(value):
                wrong.append(f"line {line}: {name} is '{cut(text)}'; enter a number")
            elif name == "blocks" and not (value.is_integer() and 0.0 <= value <= MAX_BLOCKS):
                remedy = f"enter a whole number from 0 to {MAX_BLOCKS:,}"
                wrong.append(f"line {line}: blocks is {value:g}; {remedy}")
        rows_read.append((line, x * unit_m, y * unit_m, blocks))
    if wrong:
        raise InputError(wrong)
    return np.array(rows_read).reshape(-1, 4)


def repeated(rows: Any) -> list[int]:
    """Return the lines with blocks that are equal to an earlier one: a pile, or drawn twice."""
    seen: set[tuple[float, float, float]] = set()
    lines = []
    for line, x, y, blocks in rows:
        if blocks > 0.0 and (x, y, blocks) in seen:
            lines.append(int(line))
        seen.add((x, y, blocks))
    return lines


def loads(rows: Any, arrays: Mapping[str, Shape]) -> tuple[dict[str, Load], list[int]]:
    """Return the ballast of each array with blocks, and the lines of blocks outside all arrays."""
    solids = [solid(shape) for shape in arrays.values()]
    points = shapely.STRtree(shapely.points(rows[:, 1:3]))
    # Of arrays that overlap the last one carries the block: it is counted once.
    home = np.full(len(rows), -1)
    arrays_of, inside = points.query(solids, predicate="intersects")
    home[inside] = arrays_of
    by_array = {}
    for index, name in enumerate(arrays):
        blocks, middle = rows[home == index], solids[index].centroid
        if count := int(blocks[:, 3].sum()):
            x, y = (blocks[:, 3] @ blocks[:, 1:3] / count).tolist()
            by_array[name] = Load(blocks=count, center=(x, y), centroid=(middle.x, middle.y))
    return by_array, rows[(home < 0) & (rows[:, 3] > 0.0), 0].astype(int).tolist()


def center_of_gravity(load: Load, ballast_n: float, modules_n: float) -> Point:
    """Return the center [m] of ballast and of modules, which are spread over the outline."""
    share = ballast_n / (ballast_n + modules_n)
    (x, y), (x0, y0) = load.center, load.centroid
    return x0 + share * (x - x0), y0 + share * (y - y0)
