"""Numbers in lines of text: in columns of fixed width, as written by Fortran, or free format.

`-.1234E-02-.5678E+01` are two numbers of ten columns: a sign fills the field of the second.

Reports errors in numbers, counts and the end of a file; knows no file format. Read `fixed_values`
first.
"""

from __future__ import annotations

import math
import re
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import chain
from typing import TypeVar

import numpy as np

from solver.errors import InputError, raise_any
from solver.formats.columns import rising
from solver.formats.source import Source, Stated
from solver.model import Floats
from solver.records.record import BEYOND, is_finite_number, quoted

# ASCII alone: float would take the digits of other scripts as well.
NUMBER = re.compile(r"[+-]?(\d+(\.\d*)?|\.\d+)([eE][+-]?\d+)?", re.ASCII)
DECIMAL_COMMA = re.compile(r"[+-]?\d*,\d+", re.ASCII)
_GROUPED = re.compile(r"[+-]?\d{1,3}(?:,\d{3})+\.\d*", re.ASCII)
_FORMAT = re.compile(r"\s*(\d{1,2})\s*(?:[A-Z]{1,2})\s*(\d{1,2})(\D|$)", re.ASCII | re.IGNORECASE)

_NUMBERS = re.compile(r"[\s+\-.*eEdD]*\d[\s\d+\-.*eEdD]*", re.ASCII)

# Fortran prints `-.1234E-02-.5678E+01` where a sign fills its field.
_TOUCHING = re.compile(r"(?<=[\d.])(?=[+-])", re.ASCII)

# Fortran prints the exponent of a double-precision number after a D.
_FORTRAN = str.maketrans("dD", "eE")

# Last values whose digits are compared, and how many of them show how a file writes numbers.
COMPARED, _ENOUGH = 50, 5

_Item = TypeVar("_Item")
_Result = TypeVar("_Result")


@dataclass(frozen=True, slots=True, kw_only=True)
class FieldFormat:
    """Fields of fixed width: 8F10.3 has 8 per line, each 10 characters wide."""

    per_line: int
    width: int

    @property
    def whole(self) -> int:
        """Characters of a full line."""
        return self.per_line * self.width

    def lines(self, count: int) -> int:
        """Number of lines for `count` values."""
        # Rounded up: the last line may be short.
        return -(-count // self.per_line)

    def fields(self, line: str) -> int:
        """Number of fields in a line, including an incomplete one."""
        return -(-len(line.rstrip()) // self.width)


@dataclass(frozen=True, slots=True, kw_only=True)
class Block:
    """Location of the values of a record, and the line that states their number."""

    first: int  # index of the first line of values
    stop: int  # index of the line after the last one that may have values
    count: int
    promised: int  # index of the line that states the count


def layout_of(text: str) -> FieldFormat | None:
    """Layout of a Fortran format such as ``8f10.3`` or ``1E15.6``; None if it is not one."""
    match = _FORMAT.match(text)
    per_line, width = (int(match[1]), int(match[2])) if match else (0, 0)
    return FieldFormat(per_line=per_line, width=width) if per_line and width else None


def fixed_values(source: Source, block: Block, layout: FieldFormat) -> Floats:
    """Values of a block of fixed columns, in which every line but the last is full.

    Raises `InputError` with every invalid field, or if there are fewer values than stated, or if a
    line is cut within a number.
    """
    _check_enough(source, block)
    last = min(block.first + layout.lines(block.count), block.stop)
    rows = [line.rstrip() for line in source.lines[block.first : last]]
    numbers = list(rows)  # up to the last line that has one
    # A line of text may follow the values where their count is stated too large.
    while numbers and all(map(_problem, _cut(numbers[-1], layout))):
        numbers.pop()
    # Looked for only where something is wrong: a sound file is read at once.
    problems = partial(_fixed_problems, source, block, numbers, layout)
    values = _values(numbers, partial(_cut, layout=layout), problems())
    if len(values) != block.count or any(layout.fields(r) != layout.per_line for r in numbers[:-1]):
        raise_any(problems())
    _check_no_more(source, block, last)
    raise_any(_cut_lines(source, block, rows, layout))
    return values


def fixed_rows(source: Source, block: Block, layout: FieldFormat) -> Floats:
    """Values of all lines of a block of fixed columns, in which any line may be short.

    Ignores `block.count`.
    """
    rows = [line.rstrip() for line in source.lines[block.first : block.stop]]
    return _row_by_row(source, block, rows, partial(_cut, layout=layout))


def free_values(source: Source, block: Block) -> Floats:
    """Values of all lines of a block, separated by blanks; their number must be that stated."""
    _check_enough(source, block)
    rows = source.lines[block.first : block.stop]
    values = _row_by_row(source, block, rows, separated)
    if len(values) != block.count:
        if len(values) == 2 * block.count and rising(values.reshape(-1, 2)) == [0]:
            raise InputError(
                f"{source.at(block.promised)}: states {block.count} values, found times next to"
                " them; delete the lines above the times, and enter a heading such as time_s,acc_g"
            )
        raise InputError(_wrong_count(source, block, len(values)))
    written = [(index, row) for index, row in enumerate(rows, block.first) if row.strip()]
    if len(written) == len(values):
        _check_halved(source, written)
    last = " ".join(row for _, row in written[-COMPARED:])
    check_last(source, written[-1][0], separated(last.translate(_FORTRAN)))
    return values


def _check_halved(source: Source, rows: Sequence[tuple[int, str]]) -> None:
    """Reject a truncated line of one value: it alone has fewer digits than all others."""
    digits = [number_digits(row.strip().translate(_FORTRAN)) for _, row in rows]
    counts = Counter(digits)
    # Programs that drop zeros at the end print all sorts of lengths: they say nothing.
    if len(counts) != 2 or min(counts.values()) > 1 or len(digits) < COMPARED // 3:
        return
    usual, odd = (step for step, _ in counts.most_common())
    # More digits than usual are no loss.
    if odd < usual:
        index, row = rows[digits.index(odd)]
        raise InputError(
            f"{source.at(index)}: found {quoted(row.strip())}, with fewer digits than all other"
            " values; use the complete file"
        )


def check_last(source: Source, index: int, fields: Sequence[str]) -> None:
    """Reject a last value with fewer digits than all others: the file was cut within it."""
    if is_cut_short(fields[-COMPARED:]):
        raise InputError(
            f"{source.at(index)}: found {quoted(fields[-1])} at the end, with fewer digits than all"
            " other values; use the complete file"
        )


def is_cut_short(fields: Sequence[str]) -> bool:
    """Whether the last of some numbers has fewer digits than all others, which have equally many.

    They are the last ones of a file, at most `COMPARED`.
    """
    *before, last = map(number_digits, fields)
    # Whole numbers have no decimals that a cut could take.
    is_even = len(before) >= _ENOUGH and len({*before}) == 1 and before[0][0] > 0
    return is_even and last < before[0]


def number_digits(field: str) -> tuple[int, int]:
    """Return the number of decimals and of digits in the exponent."""
    mantissa, _, exponent = field.upper().partition("E")
    return len(mantissa.partition(".")[2]), len(exponent.lstrip("+-"))


def header_values(source: Source, first: int, count: int, layout: FieldFormat) -> list[Stated]:
    """Values of a header; NaN for fields, often unused, that are blank, missing or not a number."""
    values: list[Stated] = []
    for index in range(first, first + layout.lines(count)):
        # A line may end where its last fields are blank.
        fields = _cut(source.line(index)[: layout.whole].ljust(layout.whole), layout)
        values += [printed(field.translate(_FORTRAN), index) for field in fields]
    return values[:count]


def field_problem(field: str) -> str:
    """Error of a field that should be a finite number, with what is accepted; "" if valid."""
    if NUMBER.fullmatch(field) and is_finite_number(float(field)):
        return ""
    if field and not field.strip("*"):
        return f"found {quoted(field)}, a number too large for its columns; use a wider file"
    if _GROUPED.fullmatch(field):
        return f"found {quoted(field)}; enter a number without commas for thousands"
    point = " with a decimal point" if DECIMAL_COMMA.match(field) else ""
    return f"found {quoted(field)}; enter a number{point}"


def number_in(field: str) -> float:
    """Value of a field without errors, whose exponent may be behind a D."""
    return float(field.translate(_FORTRAN))


def dated_table(source: Source, rows: Sequence[tuple[int, list[str]]], width: int) -> Floats:
    """Numbers of rows, each with the index of its line, but of the first column, a date."""
    raise_any(
        f"{source.at(index)}: found {len(fields)} columns; enter {width}"
        for index, fields in rows
        if len(fields) != width
    )
    raise_any(row_problems(source, ((index, fields[1:]) for index, fields in rows)))
    return np.array([[number_in(field) for field in fields[1:]] for _, fields in rows])


def separated(text: str) -> list[str]:
    """Fields between blanks, between commas beside points, or before a sign that fills a field."""
    # In text that has decimal points, a comma is a separator. Otherwise it may be a decimal comma,
    # which is rejected later.
    if "," in text and "." in text:
        text = text.replace(",", " ")
    return _TOUCHING.sub(" ", text).split()


def is_row(fields: Sequence[str]) -> bool:
    """Whether all fields of a line are numbers, of which there is one."""
    plain = [field.rstrip(",").translate(_FORTRAN) for field in fields]
    return bool(plain) and all(map(NUMBER.fullmatch, plain))


def printed(text: str, index: int) -> Stated:
    """A number as printed, with a rounding of up to half of its last digit."""
    match = NUMBER.fullmatch(text.strip())
    if not match:
        return Stated(index=index)
    mantissa, _, exponent = text.strip().lower().partition("e")
    decimals = len(mantissa.partition(".")[2]) - int(exponent or 0)
    # A whole number is taken as exact.
    # With 300 or more decimals, the power of ten may overflow.
    rounding = 0.5 * 10.0**-decimals if "." in mantissa and abs(decimals) < 300 else 0.0
    return Stated(value=float(text), rounding=rounding, index=index)


def each(read: Callable[[_Item], _Result], items: Iterable[_Item]) -> list[_Result]:
    """Read every item, and raise the problems of all of them together."""
    results: list[_Result] = []
    problems: list[str] = []
    for item in items:
        try:
            results.append(read(item))
        except InputError as error:
            problems += error.problems
    raise_any(problems)
    return results


def _check_enough(source: Source, block: Block) -> None:
    if block.count < 2:
        values = "1 value" if block.count == 1 else f"{block.count} values"
        raise InputError(f"{source.at(block.promised)}: states {values}; enter at least 2")


def _cut(row: str, layout: FieldFormat) -> list[str]:
    return [row[i : i + layout.width].strip() for i in range(0, len(row), layout.width)]


def _fixed_problems(
    source: Source, block: Block, rows: Sequence[str], layout: FieldFormat
) -> Iterator[str]:
    count = 0
    for number, row in enumerate(rows):
        fields, index = _cut(row, layout), block.first + number
        due, count = layout.per_line, number * layout.per_line + len(fields)
        if len(fields) != due and number < len(rows) - 1:
            values = "1 value" if len(fields) == 1 else f"{len(fields)} values"
            yield f"{source.at(index)}: found {values}; enter {due}"
        yield from field_problems(source, index, fields)
    if count != block.count:
        yield _wrong_count(source, block, count)


def _row_by_row(
    source: Source, block: Block, rows: Sequence[str], split: Callable[[str], list[str]]
) -> Floats:
    fields = ((index, split(row)) for index, row in enumerate(rows, block.first))
    return _values(rows, split, row_problems(source, fields))


def _values(
    rows: Sequence[str], split: Callable[[str], list[str]], problems: Iterable[str]
) -> Floats:
    """Values of the fields of rows; the problems are looked for where one may be no number."""
    try:
        # One field at a time, without a list of all fields: a file may have 64 MB.
        fields = chain.from_iterable(split(row.translate(_FORTRAN)) for row in rows)
        values = np.fromiter(map(float, fields), np.float64)
    except ValueError:
        # NaN fails the comparison below, so that the problems are told.
        values = np.array([math.nan])
    is_plain = all(row.isascii() and "_" not in row for row in rows)  # or Python takes 1_0 as 10
    if not (is_plain and (np.abs(values) < BEYOND).all()):
        raise_any(problems)
    return values


def _problem(field: str) -> str:
    # The message shows the field as in the file, with a D exponent instead of an E.
    return field_problem(field) if field_problem(field.translate(_FORTRAN)) else ""


def field_problems(source: Source, index: int, fields: Iterable[str]) -> Iterator[str]:
    """Errors of the fields of the line at an index that are no numbers."""
    problems = (_problem(field.strip()) for field in fields)
    return (f"{source.at(index)}: {problem}" for problem in problems if problem)


def row_problems(source: Source, rows: Iterable[tuple[int, Sequence[str]]]) -> Iterator[str]:
    """Errors of the fields of rows, each with the index of its line."""
    for index, fields in rows:
        yield from field_problems(source, index, fields)


def _cut_lines(
    source: Source, block: Block, rows: Sequence[str], layout: FieldFormat
) -> Iterator[str]:
    """Problems of lines that end within a field, where most lines end with one."""
    within = [index for index, row in enumerate(rows) if len(row) % layout.width]
    # Fields set to the left end anywhere: then nothing is said by where a line ends.
    if 2 * len(within) >= len(rows):
        return
    for index in within:
        yield (
            f"{source.at(block.first + index)}: found a line of {len(rows[index])} characters that"
            f" ends within a field of {layout.width}; use the complete file"
        )


def _wrong_count(source: Source, block: Block, count: int) -> str:
    remedy = "use the complete file" if count < block.count else "correct the count"
    return f"{source.at(block.promised)}: states {block.count} values, found {count}; {remedy}"


def _check_no_more(source: Source, block: Block, last: int) -> None:
    """Raise if another line of numbers follows the stated ones."""
    # Blank lines may follow the values; another line of numbers means that the count is wrong.
    following = source.lines[last : block.stop]
    if _NUMBERS.fullmatch(next((line for line in following if line.strip()), "")):
        raise InputError(
            f"{source.at(block.promised)}: states {block.count} values, found more in line"
            f" {last + 1}; correct the count"
        )
