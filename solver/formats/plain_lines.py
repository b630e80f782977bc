"""Lines of a table of numbers, without additions by the program that wrote it, and their rows.

`"0,01";"0,2";` becomes `0.01;0.2`, which is a row of two numbers; `time_s,acc_g` is a heading. Each
line keeps its index, so that messages name the lines of the file. Read `plain_lines`.
"""

from __future__ import annotations

import csv
import re
from collections.abc import Iterator, Sequence
from itertools import chain, islice

from solver.formats.numbers import DECIMAL_COMMA, NUMBER
from solver.formats.phrases import Kind, parse

# The line at the top of a CSV file that tells Excel the separator.
_SEP = re.compile(r'"?sep=([,;\t| ])"?', re.IGNORECASE)
_COMMENT = re.compile(r"^\s*(?:%|//|!)")
_QUOTED = re.compile(r'"[^"]*" *([,;\t|])?')
_GROUPED = re.compile(r"[+-]?[1-9]\d{0,2},\d{3}", re.ASCII)
_COUNT_AND_STEP = re.compile(r"(\d{1,9})[\s,;]++(0?\.\d+)", re.ASCII)
_MARKS = ",;\t"
_SEEN = 200


def plain_lines(lines: Sequence[str]) -> list[str]:
    """Return the lines of a table without additions by its program; their number is unchanged.

    Separators between quoted fields become semicolons; a decimal comma becomes a point where the
    columns are separated by something else and no number has a point.
    """
    # As MATLAB, C and Fortran write comments.
    plain = [_COMMENT.sub("#", line) for line in lines]
    first = next((i for i, line in enumerate(plain) if line.strip()), 0)
    separator = ""
    if plain and (match := _SEP.fullmatch(plain[first].strip(" "))):
        # Blanked, not removed: messages state line numbers of the file.
        separator, plain[first] = match[1], ""
    near = list(islice((line for line in plain if _is_row(line)), _SEEN))
    if any('"' in line for line in near):
        marks = chain.from_iterable(map(_QUOTED.findall, near))  # behind each quoted field
        mark = separator or next(filter(None, marks), ",")
        plain = [_unquoted(line, mark) if _is_row(line) else line for line in plain]
    elif separator == "|":
        plain = [line.replace("|", ";") if _is_row(line) else line for line in plain]
    # The separators at the ends of lines are removed first; otherwise the row of units would have
    # an additional empty column.
    plain = _without_decimal_commas(_without_units_row(_without_last_marks(plain)))
    return _with_count_and_step(plain)


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
    """Remove the separator from the end of all lines, if each of the first lines ends with it."""
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
    # A blank takes the place of the row, so that messages count the lines of the file.
    return [*lines[: rows[0]], (mark or " ").join(headings), *lines[rows[0] + 1 : rows[1]], "",
            *lines[rows[1] + 1 :]]  # fmt: skip


def _with_count_and_step(lines: list[str]) -> list[str]:
    """Turn a first row with count and step into a remark, as in DEEPSOIL files."""
    start = first_row(lines)
    (index, content), (_, second) = [*islice(rows_of(lines, start), 2), (0, ""), (0, "")][:2]
    match = _COUNT_AND_STEP.fullmatch(content)
    fields = second.split(separator_of(second))
    # The count must equal the number of rows below; otherwise the two numbers may be the first row.
    if not match or len(fields) != 2 or int(match[1]) != len([*rows_of(lines, index + 1)]):
        return lines
    # Times do not fall from their count.
    is_time = NUMBER.fullmatch(fields[0]) and float(fields[0]) < float(match[1])
    remark = f"# npts {match[1]}, dt = {match[2]} s"
    return [*lines[:index], remark, *lines[index + 1 :]] if is_time else lines


def _without_decimal_commas(lines: list[str]) -> list[str]:
    near = [lines[i] for i in _rows(lines)]
    # The comma of 0,12 alone may separate columns: there is another mark in each row.
    mark = next((mark for mark in ";\t" if any(mark in line for line in near)), None)
    rows = [line.strip(" ") for line in near if line.lstrip()[:1] in "+-.0123456789"]
    body = [line.split(mark) for line in rows if len(line.split(mark)) > 1]
    if not mark and len(body) < len(rows):
        return lines
    fields = [field.strip() for field in chain.from_iterable(body)]
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


_BLANK_BETWEEN = re.compile(r"[^,\s]\s+[^,\s]")
# Index of a line, and its content.
Row = tuple[int, str]


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
    """Whether a line begins with something other than a number."""
    word = re.split(r"[,;\s]", content)[0]
    return content[0] not in "+-.0123456789" and word.lower() not in {"nan", "inf", "infinity"}


def separator_of(content: str) -> str | None:
    """Separator of the columns; None for blanks and tabs. The commas of `0,1 0,2` are decimal."""
    if ";" in content:
        return ";"
    return "," if "," in content and not _BLANK_BETWEEN.search(content) else None
