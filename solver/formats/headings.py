"""The layout of the numbers in a text, and what the text states about them.

From lines to rows and columns, headings, units and step; reads no table: `solver.formats.text`
does, with what is found here. `time_s,acc_g` above rows of two numbers heads a column of times and
one of accelerations in g. Read `laid_out`.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import chain, islice

from solver.errors import InputError
from solver.formats import phrases
from solver.formats.likely_kinds import COLUMNS, likely_text
from solver.formats.numbers import NUMBER
from solver.formats.phrases import Heading, parse
from solver.formats.plain_lines import (
    Row,
    content_of,
    first_row,
    is_heading,
    plain_lines,
    rows_of,
    separator_of,
)
from solver.formats.remarks import check_units_alone
from solver.formats.source import Source, Stated
from solver.records.record import quoted, unit_size

_MAX_REMARKS = 200

# Of a code such as 065XXX; NaN and D exponents are numbers.
_LETTERS = re.compile(r"\d+[a-z]{2}", re.ASCII | re.IGNORECASE)
# As MATLAB prints it, also behind a comment sign.
_FACTOR = re.compile(rf"{NUMBER.pattern}\s*[*x×]", re.ASCII)
# 10:20:30, 2024-01-02 or 31.12.2024: three numbers separated by the same mark.
_CLOCK = re.compile(r"\d+([-/:.])\d+\1\d+(?:[:.,T ].*)?", re.ASCII)


@dataclass(frozen=True, slots=True, kw_only=True)
class Layout:
    """Location of the numbers in a text, and what the text states about them."""

    source: Source  # with plain lines
    start: int  # index of the first line that may hold numbers
    first: int  # index of the first row
    separator: str | None  # of columns; None for blanks
    width: int  # numbers in the first row
    per_line: int  # of values across the lines, in each but the last; 0 for columns
    headings: list[Heading]  # one for each column, or none
    heading_index: int  # of their line; -1 for none
    misfit: str  # why the headings are none of these columns; empty if there are none at all
    remarks: list[Row]  # the other lines above the first row

    def rows(self, start: int = 0) -> Iterator[Row]:
        """Yield index and content of each row of numbers, from an index on."""
        return rows_of(self.source.lines, max(self.start, start))

    def fields(self, content: str) -> list[str]:
        """Return the fields of a row."""
        return content.split(self.separator)

    def steps(self) -> list[Stated]:
        """Steps [s] that remarks state."""
        lines = (phrases.steps_in(self.source, index, line) for index, line in self.remarks)
        return list(chain.from_iterable(lines))

    def seconds(self) -> float:
        """Value [s] of the unit of the times in the first column."""
        heading = self.headings[0] if self.headings else parse("")
        place = self.source.at(self.heading_index)
        if heading.is_index:
            raise InputError(
                f"{place}: found {quoted(heading.text)} over the first column; enter times in"
                " seconds, such as time_s, or delete the column and enter the time step dt"
            )
        if math.isnan(heading.seconds):
            raise InputError(
                f"{place}: found times in {quoted(heading.unit)}; enter them in s, ms or min, such"
                " as time_s"
            )
        return heading.seconds

    def scale(self, column: int) -> float:
        """Value [m/s2] of a column's unit: from its heading, the text above, or the caller."""
        if not self.headings or not self.headings[column].unit:
            stated: list[tuple[str, int]] = []
            for index, line in self.remarks:
                stated += [(unit, index) for unit in phrases.units_in(line)]
            return self.source.stated_scale(stated)
        heading, units = self.headings[column], self.source.units
        size = unit_size(heading.unit)
        for index, line in self.remarks:
            # Only if the line contains "unit": a comment such as "peak 0.3 g" does not state the
            # unit of a column.
            sizes = {unit_size(unit): unit for unit in phrases.stated_units(line)}
            if not sizes or size in sizes:
                continue
            # A comment may tell of another file; what the caller says is meant for this one.
            if units and unit_size(units) in {size, *sizes}:
                return unit_size(units)
            raise InputError(
                f"{self.source.at(index)}: the comment states {' and '.join(sizes.values())}, the"
                f" heading {quoted(heading.text)} states {heading.unit}: which is it? Correct one"
                " of them, or enter the units"
            )
        return self.source.scale(heading.unit, self.heading_index)


def laid_out(source: Source) -> Layout:
    """Find the rows, columns and headings of a text.

    Raises `InputError` where there is no row of numbers, or the first one is something else.
    """
    source = replace(source, lines=plain_lines(source.lines))
    lines = source.lines
    start = first_row(lines)
    first, content = next(rows_of(lines, start), (-1, ""))
    if not content:
        problem = likely_text(lines) or "no numbers found; enter one or more columns of numbers"
        raise InputError(f"{source.name}: {problem}")
    separator = separator_of(content)
    fields = [field.strip() for field in content.split(separator)]
    _check_first(source, first, fields)
    # Comments may state a unit or a step, as lines of text do.
    plain = ((index, line.replace("#", " ").strip()) for index, line in enumerate(lines[:first]))
    remarks = list(islice((row for row in plain if row[1]), _MAX_REMARKS))
    width = len(fields)
    per_line = source.values_per_line or _stated_across(lines, start, separator, remarks)
    headings, place, misfit = list[Heading](), -1, ""
    if not per_line:
        headings, place, misfit = _headings(lines, start, separator, width, remarks)
    return Layout(
        source=source,
        start=start,
        first=first,
        separator=separator,
        width=width,
        per_line=per_line,
        headings=headings,
        heading_index=place,
        misfit=misfit,
        # The heading line states units of its columns, not of the file.
        remarks=[remark for remark in remarks if not headings or remark[0] != place],
    )


def _check_first(source: Source, first: int, fields: Sequence[str]) -> None:
    """Raise where a line down to the first row is a factor of all numbers, or that row is text."""
    for index, line in enumerate(source.lines[: first + 1]):
        if _FACTOR.fullmatch(plain := line.strip("# ")):
            raise InputError(
                f"{source.at(index)}: found {quoted(plain)}, a factor for the numbers below it;"
                " multiply them all by it, and delete the line"
            )
    check_units_alone(source, source.lines[: first + 1])
    words = [field for field in fields if field.strip(" *")]
    if any(is_heading(word) or _LETTERS.match(word) for word in words):
        problem = likely_text(source.lines) or (
            f"found {quoted(source.lines[first].strip())} where numbers were expected; the file"
            " is in"
            f" no supported format; {COLUMNS}, multiplied by any factor in the text, and put #"
            " before every other line of text"
        )
        raise InputError(f"{source.at(first)}: {problem}")
    # The date and the time of day may be two columns.
    if any(map(_CLOCK.fullmatch, fields[:2])):
        raise InputError(
            f"{source.at(first)}: found {quoted(fields[0])}, a date or a time of day; enter seconds"
            " from the start in the first column, such as time_s"
        )


def _stated_across(
    lines: Sequence[str], start: int, separator: str | None, remarks: Sequence[Row]
) -> int:
    """Values in the first line, if a remark states as many samples as there are in all lines."""
    stated = max((phrases.count_in(line) for _, line in remarks), default=-1)
    if stated <= 0:
        return 0
    widths = [len(row.split(separator)) for _, row in rows_of(lines, start)]
    # As many lines as samples would be a column.
    return widths[0] if sum(widths) == stated != len(widths) else 0


def _headings(
    lines: Sequence[str], start: int, separator: str | None, width: int, remarks: Sequence[Row]
) -> tuple[list[Heading], int, str]:
    """Heading of each column and the index of their line: the heading line, or else a comment."""
    heading = content_of(lines[start - 1]) if start else ""
    if heading and is_heading(heading):
        texts = phrases.words(heading, separator)
        if len(texts) == width:
            return phrases.settled([parse(text) for text in texts]), start - 1, ""
        # Two columns are times and values, whatever stands above them (`text._has_times`).
        if width > 2:
            misfit = f"found {len(texts)} headings over {width} columns; enter one for each"
            return [], start - 1, misfit
    # The nearest to the numbers first.
    for index, line in reversed(remarks):
        if parsed := phrases.remark(line, separator, width):
            return phrases.settled(parsed), index, ""
    return [], -1, ""
