"""How a table of numbers is laid out in lines: its rows and separators, and what programs add.

Quotes, `sep=`, commas at the ends and a row of units are taken off, each line at its index, so that
messages name the lines of the file. Knows no meaning of a column. Read `plain_lines`.
"""

from __future__ import annotations

import csv
import re
from collections.abc import Iterator, Sequence
from itertools import islice

import numpy as np

from solver.formats import headings
from solver.formats.headings import Kind
from solver.formats.numbers import DECIMAL_COMMA, NUMBER, field_problem
from solver.formats.source import Source
from solver.model import Floats, InputError
from solver.records.record import raise_any

_SEP = re.compile(r'"?sep=([,;\t| ])"?', re.IGNORECASE)
_QUOTED = re.compile(r'"[^"]*" *([,;\t|])?')
_GROUPED = re.compile(r"[+-]?[1-9]\d{0,2},\d{3}", re.ASCII)
_MARKS = ",;\t"
_SEEN = 200
_BLANK_BETWEEN = re.compile(r"[^,\s]\s+[^,\s]")

ACROSS = "put one on each line, or give the values per line (--values-per-line {})"

Row = tuple[int, str]
"""Index of a line, and its content."""


def plain_lines(lines: Sequence[str]) -> list[str]:
    """Return the lines of a table without what its program added, as many as there are.

    Separators between quoted fields become semicolons; a decimal comma becomes a point where the
    columns are separated by something else and no number has a point.
    """
    plain = list(lines)
    first = next((i for i, line in enumerate(plain) if line.strip()), 0)
    separator = ""
    if plain and (match := _SEP.fullmatch(plain[first].strip(" "))):
        separator, plain[first] = match[1], ""
    near = list(islice((line for line in plain if _is_row(line)), _SEEN))
    if any('"' in line for line in near):
        marks = (match[1] for line in near for match in _QUOTED.finditer(line) if match[1])
        mark = separator or next(marks, ",")
        plain = [_unquoted(line, mark) if _is_row(line) else line for line in plain]
    elif separator == "|":
        plain = [line.replace("|", ";") if _is_row(line) else line for line in plain]
    return _without_decimal_commas(_without_units_row(_without_last_marks(plain)))


def _is_row(line: str) -> bool:
    return bool(line.strip()) and not line.lstrip().startswith("#")


def _unquoted(line: str, mark: str) -> str:
    fields = next(csv.reader([line], delimiter=mark, skipinitialspace=True))
    return ";".join(field.replace(";", " ") for field in fields)


def _rows(lines: Sequence[str]) -> list[int]:
    """Indexes of the first rows, the heading among them."""
    return list(islice((i for i, line in enumerate(lines) if _is_row(line)), _SEEN))


def _without_last_marks(lines: list[str]) -> list[str]:
    """Take the separator off the ends of all lines, if each of the first ones has it there."""
    rows = [lines[i].rstrip(" ") for i in _rows(lines)]
    if len(rows) < 2 or not all(row.endswith(tuple(_MARKS)) for row in rows[1:]):
        return lines
    mark, widths = rows[1][-1], {row.count(rows[1][-1]) for row in rows[1:]}
    is_headed = not rows[0].endswith(mark) and rows[0].count(mark) == rows[1].count(mark)
    if is_headed or len(widths) > 1:
        return lines  # the last column has a heading: its values are missing
    return [line.rstrip(" ").removesuffix(mark) for line in lines]


def _without_units_row(lines: list[str]) -> list[str]:
    """Put the units of a second row behind the headings of the first."""
    rows = _rows(lines)
    if len(rows) < 3:
        return lines
    top, below = lines[rows[0]], lines[rows[1]]
    mark = next((mark for mark in ";,\t" if mark in below), None)
    names, units = top.split(mark), below.split(mark)
    kinds = [headings.parse(f"a [{unit.strip(' []()')}]") for unit in units if unit.strip()]
    is_units = kinds and all(
        each.kind in (Kind.ACCELERATION, Kind.TIME) or each.unit for each in kinds
    )
    if not is_units or len(names) != len(units) or any(map(NUMBER.fullmatch, units)):
        return lines
    pairs = zip(names, units, strict=True)
    said = [
        f"{name.strip()} [{plain}]" if (plain := u.strip(" []()")) else name for name, u in pairs
    ]
    return [*lines[: rows[0]], (mark or " ").join(said), *lines[rows[0] + 1 : rows[1]], "",
            *lines[rows[1] + 1 :]]  # fmt: skip


def _without_decimal_commas(lines: list[str]) -> list[str]:
    near = [lines[i] for i in _rows(lines)]
    mark = ";" if any(";" in line for line in near) else "\t"
    body = [line for line in near if mark in line and line.lstrip()[:1] in "+-.0123456789"]
    fields = [field.strip() for line in body for field in line.split(mark)]
    commas = [field for field in fields if "," in field]
    if (
        not commas
        or not all(DECIMAL_COMMA.fullmatch(field) or NUMBER.fullmatch(field) for field in fields)
        or all(map(_GROUPED.fullmatch, commas))
        or any("." in line for line in lines if line.lstrip()[:1] in "+-.0123456789")
    ):
        return lines
    return [
        line.replace(",", ".") if line.lstrip()[:1] in "+-.0123456789" else line for line in lines
    ]


def content_of(line: str) -> str:
    """Return a line without comment and blanks at its ends."""
    return line.partition("#")[0].strip()


def rows_of(lines: Sequence[str], start: int) -> Iterator[Row]:
    """Index and content of each line from index `start` on that is not blank or a comment."""
    for index in range(start, len(lines)):
        if content := content_of(lines[index]):
            yield index, content


def first_row(lines: Sequence[str]) -> int:
    """Index of the first line that may have numbers: after the heading, if there is one."""
    for index, content in rows_of(lines, 0):
        return index + 1 if is_heading(content) else index
    return len(lines)


def is_heading(content: str) -> bool:
    """Whether a line begins with what is no number."""
    word = re.split(r"[,;\s]", content)[0]
    return content[0] not in "+-.0123456789" and word.lower() not in {"nan", "inf", "infinity"}


def separator_of(content: str) -> str | None:
    """Separator of the columns; None for blanks and tabs. The commas of `0,1 0,2` are decimal."""
    if ";" in content:
        return ";"
    return "," if "," in content and not _BLANK_BETWEEN.search(content) else None


def check_shape(source: Source, start: int, separator: str | None) -> None:
    """Raise for rows that are no columns: values across the lines, or a first row unlike all."""
    rows = [(i, len(row.split(separator))) for i, row in rows_of(source.lines, start)]
    (first, width), *others = rows
    heading = content_of(source.lines[start - 1]) if start else ""
    is_headed = bool(heading) and len(headings.words(heading, separator)) == width
    if len(others) < 2:
        return
    *middle, (last, left) = others
    widths = {found for _, found in middle}
    if not is_headed and widths == {width} and left < width:
        raise InputError(
            f"{source.at(last)}: found {left} values after lines of {width}: values across the"
            f" lines, not in columns; {ACROSS.format(width)}"
        )
    if len(widths) == 1 and widths != {width} and left <= min(widths):
        raise InputError(
            f"{source.at(first)}: found {width} numbers above rows of {min(widths)}; if they are no"
            " samples, put # before them, and give the time step"
        )


def across(source: Source, start: int, separator: str | None, due: int) -> Floats:
    """Return values that follow each other across the lines, as many in each but the last.

    Returns
    -------
    array, shape (n, 1)
    """
    rows = [(i, row.rstrip(",;").split(separator)) for i, row in rows_of(source.lines, start)]
    raise_any(
        f"{source.at(index)}: found {len(fields)} values; give {due} as in every line but the last"
        for index, fields in rows
        if len(fields) > due or (len(fields) < due and index != rows[-1][0])
    )
    raise_any(
        f"{source.at(index)}: {problem}"
        for index, fields in rows
        for field in fields
        if (problem := field_problem(field.strip()))
    )
    return np.array([float(field) for _, fields in rows for field in fields]).reshape(-1, 1)
