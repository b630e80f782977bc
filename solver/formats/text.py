"""Text and csv: one column (acceleration), or times and one or more columns.

Handles this format only: `solver.formats.layout` finds rows and interprets headings,
`solver.formats.times` times. Comments after `#` are skipped, except that units, a step and a count
are read from them. Read `read` first.
"""

from __future__ import annotations

import itertools
import math
import re
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from solver.formats import layout, phrases
from solver.formats.channels import Channel, MotionFile, motion_file
from solver.formats.layout import (
    Heading,
    Kind,
    Row,
    across,
    check_shape,
    content_of,
    first_row,
    is_heading,
    plain_lines,
    remedy,
    rising,
    rows_of,
    separator_of,
)
from solver.formats.numbers import (
    COMPARED,
    DECIMAL_COMMA,
    NUMBER,
    field_problems,
    is_cut_short,
    number_in,
)
from solver.formats.source import Source, Stated, likely_text
from solver.formats.times import Sampled, is_even, sampled
from solver.model import Floats, InputError, Problem
from solver.records.record import BEYOND, HOLD, raise_any, shown, unit_size

_HOLD = re.compile(rf"\b{re.escape(HOLD)} (\d+(?:\.\d+)?) s\b", re.ASCII)

_MAX_REMARKS = 200

_MAGNITUDE_WITHIN = 0.01  # of its peak: digits are printed apart
# Of times without a unit: more are milliseconds or numbers of samples, but in a sketch of a pulse.
_LONGEST_STEP, _FEW = 1.0, 10
# Of a code such as 065XXX; NaN and D exponents are numbers.
_LETTERS = re.compile(r"\d+[a-z]{2}", re.ASCII | re.IGNORECASE)
# As MATLAB prints it, also behind a comment sign.
_FACTOR = re.compile(rf"{NUMBER.pattern}\s*[*x×]", re.ASCII)
_CLOCK = re.compile(r"\d+([-/:.])\d+\1\d+(?:[:.,T ].*)?", re.ASCII)


@dataclass(frozen=True, slots=True, kw_only=True)
class _Table:
    """Numbers of a text, with its headings."""

    values: Floats  # shape (n, k)
    start: int  # index of the first line that may hold numbers
    headings: list[Heading]  # one for each column, or none
    heading_index: int  # of their line
    remarks: list[Row]  # the other lines above the first row


def recognizes(lines: Sequence[str]) -> bool:
    """Text accepts every file that no other format does."""
    return True


def read(source: Source) -> MotionFile:
    """Read a text of one or more columns, or of values across the lines."""
    source = replace(source, lines=plain_lines(source.lines))
    table = _table(source)
    _check_count(source, table)
    _check_last(source, table)
    if table.headings and (named := layout.of_a_spectrum(table.headings)):
        raise InputError(
            f"{source.at(table.heading_index)}: found {', '.join(map(shown, named))}: this is a"
            " spectrum, no record; give accelerations by time"
        )
    _check_remarks(source, table)
    timed = _has_times(source, table)
    columns = range(int(timed), table.values.shape[1])
    others = [i for i in columns if table.headings and table.headings[i].kind is Kind.OTHER]
    left = dict.fromkeys(others, "not an acceleration")
    magnitudes = _magnitudes(table, [i for i in columns if i not in others])
    left |= dict.fromkeys(magnitudes, "the magnitude of a vector, not a component")
    taken = [i for i in columns if i not in left]
    if not taken:
        beside = (f"{shown(table.headings[i].text)}, {why}" for i, why in left.items())
        raise InputError(
            f"{source.name}: found no component of acceleration beside {'; '.join(beside)}: give"
            " one a heading such as acc_g"
        )
    even = _evened(source, table, table.values[:, taken].T, timed)
    channels = [
        Channel(
            name=table.headings[i].name if len(taken) > 1 else "",
            dt_s=even.dt_s,
            a_mps2=values * _scale(source, table, i),
            notes=(),
        )
        for i, values in zip(taken, even.columns, strict=True)
    ]
    notes = [
        f"column {shown(table.headings[i].text)} is ignored: it is {why}" for i, why in left.items()
    ]
    if not source.is_ended:
        notes.append(
            "the last line has no line end: if the file was cut there, its last value or further"
            " samples are missing"
        )
    file = motion_file(source, "text", channels, [*even.notes, *notes])
    holds = [hold for _, line in table.remarks if (hold := _HOLD.search(line))]
    return replace(file, hold_s=float(holds[0][1])) if holds else file


def _check_remarks(source: Source, table: _Table) -> None:
    """Raise where the text above the numbers says that they are no accelerations."""
    numbers = table.values[:, 1:] if table.values.shape[1] > 1 else table.values
    # A record may be matched to a spectrum: only a spectrum is nowhere below zero.
    is_positive = len(numbers) > _FEW and bool((numbers >= 0.0).all())
    is_headed = any(heading.kind is Kind.ACCELERATION for heading in table.headings)
    is_said = is_headed or any(phrases.is_of_acceleration(line) for _, line in table.remarks)
    for index, line in table.remarks:
        if is_positive and phrases.is_of_a_spectrum(line):
            raise InputError(
                f"{source.at(index)}: found {shown(line)} above values of which none is negative:"
                " this is a spectrum, no record; give accelerations by time"
            )
        if not is_said and (other := phrases.other_quantity(line)):
            heading = "acc_g" if table.values.shape[1] == 1 else "time_s,acc_g"
            raise InputError(
                f"{source.at(index)}: found {other!r}, and no acceleration; give the file of"
                f" acceleration, or a heading such as {heading} if the values are accelerations"
            )


def _check_factor(source: Source, first: int) -> None:
    """Raise where a line down to the first row is a factor of all numbers."""
    for index, line in enumerate(source.lines[: first + 1]):
        if _FACTOR.fullmatch(plain := line.strip("# ")):
            raise InputError(
                f"{source.at(index)}: found {shown(plain)}, a factor of the numbers below it;"
                " multiply them all by it, and delete the line"
            )


def _magnitudes(table: _Table, columns: Sequence[int]) -> list[int]:
    """Columns of the length of a vector, by their heading or as the root of the sum of squares."""
    magnitudes: list[int] = []
    for i in columns:
        values = table.values[:, i]
        before = [k for k in columns if k != i and k not in magnitudes]
        # Loggers write the length behind two or three components, or behind all of them.
        vectors = [before[:count] for count in (2, 3, len(before)) if 1 < count <= len(before)]
        roots = (np.linalg.norm(table.values[:, vector], axis=1) for vector in vectors)
        is_named = bool(table.headings) and table.headings[i].is_magnitude
        within = _MAGNITUDE_WITHIN * values.max()
        if (
            values.min() >= 0.0
            and values.any()
            and (is_named or any(np.abs(values - root).max() <= within for root in roots))
        ):
            magnitudes.append(i)
    return magnitudes


def _check_count(source: Source, table: _Table) -> None:
    """Compare the number of rows with the number of samples that a remark states."""
    samples = len(table.values)
    for index, line in table.remarks:
        stated = phrases.count_in(line)
        if stated not in (-1, samples):
            remedy = "give the whole file" if samples < stated else "correct the count"
            raise InputError(
                f"{source.at(index)}: states {stated} samples, found {samples}; {remedy}"
            )


def _check_last(source: Source, table: _Table) -> None:
    """Refuse a file without a line end whose last value has fewer digits than those before it."""
    # A line end, a comment or a blank shows that the last value was written whole.
    if source.is_ended or not content_of(source.lines[-1]) or "#" in source.lines[-1]:
        return
    rows = list(rows_of(source.lines, max(table.start, len(source.lines) - COMPARED)))
    fields = [content.split(separator_of(content))[-1].strip() for _, content in rows]
    if is_cut_short(fields):
        raise InputError(
            f"{source.at(rows[-1][0])}: found {shown(fields[-1])} at the end, with fewer digits"
            " than the values before it and without a line end; give the whole file, or end its"
            " last line"
        )


def _has_times(source: Source, table: _Table) -> bool:
    """Whether the first column holds times."""
    if table.values.shape[1] == 1:
        return False
    kinds = [heading.kind for heading in table.headings]
    if Kind.TIME in kinds[1:]:
        place = kinds.index(Kind.TIME, 1) + 1
        raise InputError(
            f"{source.name}: found times in column {place}; give them in the first, and once"
        )
    if not kinds or kinds[0] is Kind.TIME:
        return True
    # If no heading mentions time, the values decide.
    rises = bool((np.diff(table.values[:, 0]) > 0.0).all())
    return kinds[0] is not Kind.ACCELERATION and (rises or math.isnan(source.dt_s))


def _evened(source: Source, table: _Table, columns: Floats, timed: bool) -> Sampled:
    stated = _stated_step(source, table)
    if not timed:
        if math.isnan(stated.value) and math.isnan(source.dt_s):
            what = "one column," if table.values.shape[1] == 1 else "columns"
            found = f"{source.name}: found {what} without times"
            raise InputError(Problem(found, "give the time step dt", about="dt_s"))
        dt_s = source.dt_s if math.isnan(stated.value) else source.step(stated)
        return Sampled(dt_s=dt_s, columns=columns, notes=())
    _check_is_time(source, table, table.values[:, 0])
    unit_s = _seconds(source, table)
    times = table.values[:, 0] * unit_s
    _check_decimal_comma(source, table, times)

    def line_of(row: int) -> int:
        return next(itertools.islice(rows_of(source.lines, table.start), row, None))[0]

    even = sampled(source, times, columns, line_of, unit_s)
    # Where the times are even, they have the step that a remark states.
    if not even.notes and abs(even.dt_s - stated.value) > stated.rounding + 1e-4 * even.dt_s:
        raise InputError(
            f"{source.at(stated.index)}: states a step of {stated.value:.6g} s, the times have"
            f" {even.dt_s:.6g} s; give a file in which they agree"
        )
    return even


def _check_is_time(source: Source, table: _Table, times: Floats) -> None:
    """Raise where the first of columns without headings cannot be times at all."""
    if table.headings or len(times) <= _FEW:
        return
    falling = int((np.diff(times) <= 0.0).sum())
    if 4 * falling > len(times) and 0 not in rising(table.values):
        raise InputError(
            f"{source.name}: found {table.values.shape[1]} columns without a heading, and the first"
            f" is no time: it falls {falling} times; {remedy(table.values)}"
        )
    if times[0] == len(times) - 1 and times[1] < times[0]:
        index, first = next(rows_of(source.lines, table.start))
        raise InputError(
            f"{source.at(index)}: found {shown(first)} above {len(times) - 1} times: if it is their"
            " count and step, put # before it"
        )


def _seconds(source: Source, table: _Table) -> float:
    """Value [s] of the unit of the times."""
    heading = table.headings[0] if table.headings else layout.parse("")
    if heading.is_index:
        raise InputError(
            f"{source.at(table.heading_index)}: found {shown(heading.text)} over the first column;"
            " give times in seconds, such as time_s, or delete the column and give the time step dt"
        )
    if math.isnan(heading.seconds):
        raise InputError(
            f"{source.at(table.heading_index)}: found times in {shown(heading.unit)}; give them in"
            " s, ms or min, such as time_s"
        )
    step = float(np.median(np.diff(table.values[:, 0])))
    if not heading.unit and step >= _LONGEST_STEP and len(table.values) > _FEW:
        what = shown(heading.text) if table.headings else "a first column"
        raise InputError(
            f"{source.at(max(table.heading_index, 0))}: found {what} with steps of {step:g};"
            " give the unit of the times, such as time_s or time_ms"
        )
    return heading.seconds


def _stated_step(source: Source, table: _Table) -> Stated:
    """Step [s] that a remark states; NaN for none."""
    steps = (phrases.step_in(source, index, line) for index, line in table.remarks)
    return next((step for step in steps if not math.isnan(step.value)), Stated())


def _scale(source: Source, table: _Table, column: int) -> float:
    """Value [m/s2] of a column's unit: from its heading, the text above, or the caller."""
    if table.headings and table.headings[column].unit:
        return _heading_scale(source, table, table.headings[column])
    stated = [(unit, i) for i, line in table.remarks for unit in phrases.units_in(line)]
    return source.stated_scale(stated)


def _heading_scale(source: Source, table: _Table, heading: Heading) -> float:
    """Value [m/s2] of a heading's unit; where a comment states another, the caller's decides."""
    size = unit_size(heading.unit)
    for index, line in table.remarks:
        stated = {unit_size(unit): unit for unit in phrases.stated_units(line)}
        if not stated or size in stated:
            continue
        # A comment may tell of another file; what the caller says is meant for this one.
        if source.units and unit_size(source.units) in {size, *stated}:
            return unit_size(source.units)
        raise InputError(
            f"{source.at(index)}: the comment states {' and '.join(stated.values())}, the heading"
            f" {shown(heading.text)} states {heading.unit}: which is it? Correct one of them, or"
            " give the units"
        )
    return source.scale(heading.unit, table.heading_index)


def _table(source: Source) -> _Table:
    start = first_row(source.lines)
    first = next(rows_of(source.lines, start), None)
    if first is None:
        raise InputError(f"{source.name}: found no numbers; give one or more columns of them")
    separator = separator_of(first[1])
    fields = first[1].split(separator)
    _check_factor(source, first[0])
    if any(field.strip(" *") and _is_text(field.strip()) for field in fields):
        raise InputError(f"{source.at(first[0])}: {likely_text(source.lines, first[0])}")
    if any(_CLOCK.fullmatch(field.strip()) for field in fields[:2]):
        raise InputError(
            f"{source.at(first[0])}: found {shown(fields[0].strip())}, a date or a time of day;"
            " give seconds from the start in the first column, such as time_s"
        )
    width, remarks = len(fields), _remarks(source.lines, start)
    if due := source.values_per_line or _told_across(source, start, separator, remarks):
        numbers = across(source, start, separator, due)
        return _Table(values=numbers, start=start, headings=[], heading_index=-1, remarks=remarks)
    # numpy reads a sound file at once; one with an error is read row by row, to name its lines.
    values = _parse_fast(source.lines[start:], separator, width)
    if values is None:
        check_shape(source, start, separator)
        values = _parse_slowly(source, start, separator, width)
    if len(values) < 2:
        raise InputError(f"{source.name}: found 1 sample; give at least 2")
    heads, place = _headings(source, start, separator, width, remarks)
    if width > 2 and not heads:
        raise InputError(
            f"{source.at(first[0])}: found {width} columns without a heading; {remedy(values)}"
        )
    remarks = [remark for remark in remarks if remark[0] != place]
    return _Table(values=values, start=start, headings=heads, heading_index=place, remarks=remarks)


def _is_text(field: str) -> bool:
    return is_heading(field) or bool(_LETTERS.match(field))


def _told_across(source: Source, start: int, separator: str | None, remarks: Sequence[Row]) -> int:
    """Values in the first line, if a remark states as many samples as there are in all lines."""
    # As many lines as samples would be a column.
    stated = max((phrases.count_in(line) for _, line in remarks), default=-1)
    widths = (
        [len(row.split(separator)) for _, row in rows_of(source.lines, start)] if stated > 0 else []
    )
    return widths[0] if widths and sum(widths) == stated != len(widths) else 0


def _remarks(lines: Sequence[str], start: int) -> list[Row]:
    """Index and text of every line above the first row, without comment signs."""
    end = next((index for index, _ in rows_of(lines, start)), len(lines))
    plain = ((index, lines[index].replace("#", " ").strip()) for index in range(end))
    return list(itertools.islice(((index, line) for index, line in plain if line), _MAX_REMARKS))


def _headings(
    source: Source, start: int, separator: str | None, width: int, remarks: Sequence[Row]
) -> tuple[list[Heading], int]:
    """Heading of each column and the index of their line: the heading line, or else a comment."""
    heading = content_of(source.lines[start - 1]) if start else ""
    if heading and is_heading(heading):
        texts = layout.words(heading, separator)
        if len(texts) == width:
            return layout.settled([layout.parse(text) for text in texts]), start - 1
        if width > 2:
            raise InputError(
                f"{source.at(start - 1)}: found {len(texts)} headings over {width} columns;"
                " give one for each"
            )
    for index, line in reversed(remarks):
        if parsed := layout.remark(line, separator, width):
            return layout.settled(parsed), index
    return [], -1


def _parse_fast(lines: Sequence[str], separator: str | None, width: int) -> Floats | None:
    """Table if every row has `width` finite numbers, else None."""
    try:
        table: Floats = np.loadtxt(lines, delimiter=separator, ndmin=2)
    except ValueError:
        return None
    return table if table.shape[1] == width and (np.abs(table) < BEYOND).all() else None


def _parse_slowly(source: Source, start: int, separator: str | None, width: int) -> Floats:
    """Read a table that has an error row by row, to report all its errors."""
    rows = [(index, row.split(separator)) for index, row in rows_of(source.lines, start)]
    problems = (
        field_problems(source, index, fields)
        if len(fields) == width
        else [
            f"{source.at(index)}: found {len(fields)} column{'s' * (len(fields) > 1)}; give {width}"
            " as in the first row"
        ]
        for index, fields in rows
    )
    raise_any(itertools.chain.from_iterable(problems))
    return np.array([[number_in(field) for field in fields] for _, fields in rows])


def _check_decimal_comma(source: Source, table: _Table, times: Floats) -> None:
    """Raise for rows such as `0,12` and `0,13`: one column with decimal commas, not two."""
    rows = list(itertools.islice(rows_of(source.lines, table.start), _MAX_REMARKS))
    # `0,12` may be two columns, times and values: even times say that it is.
    if is_even(times) or not all(DECIMAL_COMMA.fullmatch(content) for _, content in rows):
        return
    index, content = rows[0]
    raise InputError(f"{source.at(index)}: found {content!r}; give a number with a decimal point")
