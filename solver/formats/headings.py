"""How the numbers of a text are laid out in its lines, and what the text says of them.

From lines to rows and columns, headings, units and step; reads no table: `solver.formats.text`
does, with what is found here. What programs add (quotes, `sep=`, commas at the ends, a row of
units) is taken off, each line at its index, so that messages name the lines of the file. Read
`laid_out`.
"""

from __future__ import annotations

import csv
import math
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import chain, islice

from solver.formats import phrases
from solver.formats.likely_kinds import COLUMNS, likely_text
from solver.formats.numbers import DECIMAL_COMMA, NUMBER
from solver.formats.phrases import Heading, Kind, parse
from solver.formats.source import Source, Stated
from solver.model import InputError
from solver.records.record import shown, unit_size

_MAX_REMARKS = 200

# Of a code such as 065XXX; NaN and D exponents are numbers.
_LETTERS = re.compile(r"\d+[a-z]{2}", re.ASCII | re.IGNORECASE)
# As MATLAB prints it, also behind a comment sign.
_FACTOR = re.compile(rf"{NUMBER.pattern}\s*[*x×]", re.ASCII)
_CLOCK = re.compile(r"\d+([-/:.])\d+\1\d+(?:[:.,T ].*)?", re.ASCII)

_SEP = re.compile(r'"?sep=([,;\t| ])"?', re.IGNORECASE)
_QUOTED = re.compile(r'"[^"]*" *([,;\t|])?')
_GROUPED = re.compile(r"[+-]?[1-9]\d{0,2},\d{3}", re.ASCII)
_COUNT_AND_STEP = re.compile(r"(\d{1,9})[\s,;]++(0?\.\d+)", re.ASCII)
_MARKS = ",;\t"
_SEEN = 200
_BLANK_BETWEEN = re.compile(r"[^,\s]\s+[^,\s]")

# Index of a line, and its content.
Row = tuple[int, str]


@dataclass(frozen=True, slots=True, kw_only=True)
class Layout:
    """Where the numbers of a text are, and what is said of them."""

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

    def step(self) -> Stated:
        """Step [s] that a remark states; NaN for none."""
        steps = (phrases.step_in(self.source, index, line) for index, line in self.remarks)
        return next((step for step in steps if not math.isnan(step.value)), Stated())

    def seconds(self) -> float:
        """Value [s] of the unit of the times in the first column."""
        heading = self.headings[0] if self.headings else parse("")
        at = self.source.at(self.heading_index)
        if heading.is_index:
            raise InputError(
                f"{at}: found {shown(heading.text)} over the first column; give times in seconds,"
                " such as time_s, or delete the column and give the time step dt"
            )
        if math.isnan(heading.seconds):
            raise InputError(
                f"{at}: found times in {shown(heading.unit)}; give them in s, ms or min, such as"
                " time_s"
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
            sizes = {unit_size(unit): unit for unit in phrases.stated_units(line)}
            if not sizes or size in sizes:
                continue
            # A comment may tell of another file; what the caller says is meant for this one.
            if units and unit_size(units) in {size, *sizes}:
                return unit_size(units)
            raise InputError(
                f"{self.source.at(index)}: the comment states {' and '.join(sizes.values())}, the"
                f" heading {shown(heading.text)} states {heading.unit}: which is it? Correct one"
                " of them, or give the units"
            )
        return self.source.scale(heading.unit, self.heading_index)


def laid_out(source: Source) -> Layout:
    """Find the rows, columns and headings of a text.

    Raises `InputError` where there is no row of numbers, or the first one is something else.
    """
    source = replace(source, lines=plain_lines(source.lines))
    lines = source.lines
    start = _first_row(lines)
    first, content = next(rows_of(lines, start), (-1, ""))
    if not content:
        problem = likely_text(lines) or "found no numbers; give one or more columns of them"
        raise InputError(f"{source.name}: {problem}")
    separator = _separator(content)
    fields = [field.strip() for field in content.split(separator)]
    _check_first(source, first, fields)
    remarks, width = _remarks(lines[:first]), len(fields)
    per_line = source.values_per_line or _told_across(lines, start, separator, remarks)
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
        remarks=[remark for remark in remarks if not headings or remark[0] != place],
    )


def _check_first(source: Source, first: int, fields: Sequence[str]) -> None:
    """Raise where a line down to the first row is a factor of all numbers, or that row is text."""
    for index, line in enumerate(source.lines[: first + 1]):
        if _FACTOR.fullmatch(plain := line.strip("# ")):
            raise InputError(
                f"{source.at(index)}: found {shown(plain)}, a factor of the numbers below it;"
                " multiply them all by it, and delete the line"
            )
    words = [field for field in fields if field.strip(" *")]
    if any(_is_heading(word) or _LETTERS.match(word) for word in words):
        problem = likely_text(source.lines) or (
            f"found {shown(source.lines[first].strip())} where numbers are due, and no heading of a"
            f" format that is read; {COLUMNS}, times any factor that the text states, and put #"
            " before every other line of text"
        )
        raise InputError(f"{source.at(first)}: {problem}")
    if any(map(_CLOCK.fullmatch, fields[:2])):
        raise InputError(
            f"{source.at(first)}: found {shown(fields[0])}, a date or a time of day; give seconds"
            " from the start in the first column, such as time_s"
        )


def _told_across(
    lines: Sequence[str], start: int, separator: str | None, remarks: Sequence[Row]
) -> int:
    """Values in the first line, if a remark states as many samples as there are in all lines."""
    stated = max((phrases.count_in(line) for _, line in remarks), default=-1)
    if stated <= 0:
        return 0
    widths = [len(row.split(separator)) for _, row in rows_of(lines, start)]
    # As many lines as samples would be a column.
    return widths[0] if sum(widths) == stated != len(widths) else 0


def _remarks(lines: Sequence[str]) -> list[Row]:
    """Index and text of every line above the first row, without comment signs."""
    plain = ((index, line.replace("#", " ").strip()) for index, line in enumerate(lines))
    return list(islice(((index, line) for index, line in plain if line), _MAX_REMARKS))


def _headings(
    lines: Sequence[str], start: int, separator: str | None, width: int, remarks: Sequence[Row]
) -> tuple[list[Heading], int, str]:
    """Heading of each column and the index of their line: the heading line, or else a comment."""
    heading = content_of(lines[start - 1]) if start else ""
    if heading and _is_heading(heading):
        texts = phrases.words(heading, separator)
        if len(texts) == width:
            return phrases.settled([parse(text) for text in texts]), start - 1, ""
        if width > 2:
            misfit = f"found {len(texts)} headings over {width} columns; give one for each"
            return [], start - 1, misfit
    for index, line in reversed(remarks):
        if parsed := phrases.remark(line, separator, width):
            return phrases.settled(parsed), index, ""
    return [], -1, ""


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
        marks = chain.from_iterable(map(_QUOTED.findall, near))  # behind each quoted field
        mark = separator or next(filter(None, marks), ",")
        plain = [_unquoted(line, mark) if _is_row(line) else line for line in plain]
    elif separator == "|":
        plain = [line.replace("|", ";") if _is_row(line) else line for line in plain]
    plain = _without_decimal_commas(_without_units_row(_without_last_marks(plain)))
    return _with_count_and_step_told(plain)


def _is_row(line: str) -> bool:
    return line.strip()[:1] not in ("", "#")


def _unquoted(line: str, mark: str) -> str:
    # Semicolons: a quoted field may have the comma that separated it.
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
    # Excel ends every line with the separator of an empty last column.
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
    kinds = [parse(f"a [{unit.strip(' []()')}]") for unit in units if unit.strip()]
    is_units = kinds and all(
        heading.kind in (Kind.ACCELERATION, Kind.TIME) or heading.unit for heading in kinds
    )
    if not is_units or len(names) != len(units) or any(map(NUMBER.fullmatch, units)):
        return lines
    pairs = zip(names, units, strict=True)
    headings = []
    for name, unit in pairs:
        plain = unit.strip(" []()")
        headings.append(f"{name.strip()} [{plain}]" if plain else name)
    return [*lines[: rows[0]], (mark or " ").join(headings), *lines[rows[0] + 1 : rows[1]], "",
            *lines[rows[1] + 1 :]]  # fmt: skip


def _with_count_and_step_told(lines: list[str]) -> list[str]:
    """Make a remark of a first row that counts the times and values below it, as of DEEPSOIL."""
    start = _first_row(lines)
    (index, content), (_, second) = [*islice(rows_of(lines, start), 2), (0, ""), (0, "")][:2]
    match = _COUNT_AND_STEP.fullmatch(content)
    fields = second.split(_separator(second))
    if not match or len(fields) != 2 or int(match[1]) != len([*rows_of(lines, index + 1)]):
        return lines
    # Times do not fall from their count.
    is_time = NUMBER.fullmatch(fields[0]) and float(fields[0]) < float(match[1])
    remark = f"# npts {match[1]}, dt = {match[2]} s"
    return [*lines[:index], remark, *lines[index + 1 :]] if is_time else lines


def _without_decimal_commas(lines: list[str]) -> list[str]:
    near = [lines[i] for i in _rows(lines)]
    mark = ";" if any(";" in line for line in near) else "\t"
    body = [line for line in near if mark in line and line.lstrip()[:1] in "+-.0123456789"]
    fields = [field.strip() for field in mark.join(body).split(mark)]
    commas = [field for field in fields if "," in field]
    if (
        not commas
        or not all(DECIMAL_COMMA.fullmatch(field) or NUMBER.fullmatch(field) for field in fields)
        # 1,000 may be one or a thousand: it is left to be refused.
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


def _first_row(lines: Sequence[str]) -> int:
    """Index of the first line that may have numbers: after the heading, if there is one."""
    for index, content in rows_of(lines, 0):
        return index + 1 if _is_heading(content) else index
    return len(lines)


def _is_heading(content: str) -> bool:
    """Whether a line begins with what is no number."""
    word = re.split(r"[,;\s]", content)[0]
    return content[0] not in "+-.0123456789" and word.lower() not in {"nan", "inf", "infinity"}


def _separator(content: str) -> str | None:
    """Separator of the columns; None for blanks and tabs. The commas of `0,1 0,2` are decimal."""
    if ";" in content:
        return ";"
    return "," if "," in content and not _BLANK_BETWEEN.search(content) else None
