"""Text and csv: one column (acceleration), or times and one or more columns.

`time_s,acc_g` above `0.00,0.1` and `0.01,-0.2` heads two samples in g at a step of 0.01 s.

Handles this format only: `solver.formats.headings` finds rows and what is said of them,
`solver.formats.columns` what their numbers show, `solver.formats.times` times. Read `read` first.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import chain, islice

import numpy as np

from solver.errors import InputError, Problem, raise_any
from solver.formats import phrases, remarks
from solver.formats.channels import motion_file
from solver.formats.columns import (
    SIDE_BY_SIDE,
    counting,
    magnitudes,
    numbered,
    pairs,
    remedy,
    rising,
)
from solver.formats.headings import Layout, laid_out
from solver.formats.likely_kinds import likely_text
from solver.formats.not_accelerations import FEW, check_both_ways, check_count_among, check_remarks
from solver.formats.numbers import (
    COMPARED,
    DECIMAL_COMMA,
    field_problems,
    is_cut_short,
    number_in,
    row_problems,
)
from solver.formats.phrases import Kind
from solver.formats.plain_lines import content_of
from solver.formats.record_file import MotionFile
from solver.formats.source import Source
from solver.formats.times import Even, is_even, sampled
from solver.model import Floats
from solver.records.record import BEYOND, HOLD, Record, quoted

_HOLD = re.compile(rf"\b{re.escape(HOLD)} (\d+(?:\.\d+)?) s\b", re.ASCII)

# Of times without a unit: more are milliseconds or numbers of samples, but in a sketch of a pulse.
_LONGEST_STEP = 1.0
_LOOKED_AT = 200


def recognizes(source: Source) -> bool:
    """Text accepts every file not recognized by another format."""
    return True


def read(source: Source) -> MotionFile:
    """Read a text of one or more columns, or of values across the lines."""
    layout = laid_out(source)
    source = layout.source
    table = _table(layout)
    if [heading.kind for heading in layout.headings[1:2]] == [Kind.TIME] and 0 in counting(table):
        # Before the times, pandas and R write the number of the row.
        layout = replace(layout, headings=layout.headings[1:], width=layout.width - 1)
        table = table[:, 1:]
    _check_count(layout, table)
    _check_last(layout)
    if layout.headings and (named := phrases.of_a_spectrum(layout.headings)):
        raise InputError(
            f"{source.at(layout.heading_index)}: found {', '.join(map(quoted, named))}: this is a"
            " spectrum, not a record; use accelerations by time"
        )
    check_remarks(layout, table)
    timed = _has_times(layout, table)
    ignored = _left_out(layout, table, range(int(timed), table.shape[1]))
    taken = [i for i in range(int(timed), table.shape[1]) if i not in ignored]
    if not taken:
        ignored_names = (f"{quoted(layout.headings[i].text)}, {why}" for i, why in ignored.items())
        raise InputError(
            f"{source.name}: found no acceleration component next to {'; '.join(ignored_names)}:"
            " name one with a heading such as acc_g"
        )
    columns = table[:, taken].T
    if timed:
        dt_s, columns, time_notes = _timed(layout, table, columns)
    else:
        dt_s, time_notes = _untimed_step(layout, table.shape[1]), ()
        check_count_among(layout, table)
        check_both_ways(layout, table)
    several = len(taken) > 1
    channels = [
        Record(
            # A single component is named for its file, not for a heading such as acc_g.
            name=layout.headings[i].name if several else "",
            dt_s=dt_s,
            a_mps2=values * layout.scale(i),
        )
        for i, values in zip(taken, columns, strict=True)
    ]
    notes = [*time_notes, *remarks.factor_notes(layout.remarks)]
    if in_line := _pairs_in_line(layout, table):
        notes.append(f"each line has {in_line} pairs of time and value")
    for i, why in ignored.items():
        notes.append(f"column {quoted(layout.headings[i].text)} is ignored: it is {why}")
    if not source.is_ended:
        notes.append(
            "the last line has no line end: if the file was truncated, its last value or further"
            " samples are missing"
        )
    file = motion_file(source, "text", channels, notes)
    # Written by `motion suite` into its records (`record_csv`): only a generated motion states it.
    hold = next(filter(None, (_HOLD.search(line) for _, line in layout.remarks)), None)
    return replace(file, hold_s=float(hold[1])) if hold else file


def _table(layout: Layout) -> Floats:
    """Read all rows, shape (n, k)."""
    source = layout.source
    if layout.per_line:
        return _across(layout, layout.per_line)
    # numpy reads a sound file at once; one with an error is read row by row, to name its lines.
    table = _read_fast(layout)
    if table is None:
        if (table := _shaped(layout)) is not None:
            return table
        table = _read_slowly(layout)
    if not layout.headings and (paired := pairs(table.ravel(), layout.width)) is not None:
        return paired
    if layout.misfit:
        raise InputError(f"{source.at(layout.heading_index)}: {layout.misfit}")
    if layout.width > 2 and not layout.headings:
        raise InputError(
            f"{source.at(layout.first)}: found {layout.width} columns without a heading;"
            f" {remedy(table)}"
        )
    if len(table) < 2:
        raise InputError(f"{source.name}: found 1 sample; enter at least 2")
    return table


def _read_fast(layout: Layout) -> Floats | None:
    """Table if every row has as many finite numbers as the first, else None."""
    lines = layout.source.lines[layout.start :]
    try:
        table: Floats = np.loadtxt(lines, delimiter=layout.separator, ndmin=2)
    except ValueError:
        return None
    # NaN also fails the comparison; such a file is read again, row by row, to report its lines.
    return table if table.shape[1] == layout.width and (np.abs(table) < BEYOND).all() else None


def _read_slowly(layout: Layout) -> Floats:
    """Read a table that has an error row by row, to report all its errors."""
    problems = list(_row_problems(layout))
    if problems and (likely := likely_text(layout.source.lines)):
        raise InputError(f"{layout.source.name}: {likely}")
    raise_any(problems)
    rows = (layout.fields(row) for _, row in layout.rows())
    return np.array([[number_in(field) for field in fields] for fields in rows])


def _row_problems(layout: Layout) -> Iterator[str]:
    source, width = layout.source, layout.width
    for index, row in layout.rows():
        fields = layout.fields(row)
        if len(fields) == width:
            yield from field_problems(source, index, fields)
        else:
            columns = "1 column" if len(fields) == 1 else f"{len(fields)} columns"
            yield f"{source.at(index)}: found {columns}; enter {width} as in the first row"


def _shaped(layout: Layout) -> Floats | None:
    """Read pairs across the lines whose last line is short; None for rows of another shape.

    Raises `InputError` for other values across the lines, and for a first row unlike all.
    """
    source, start, width = layout.source, layout.start, layout.width
    (first, _), *widths_below = [(i, len(layout.fields(row))) for i, row in layout.rows()]
    heading = content_of(source.lines[start - 1]) if start else ""
    is_headed = bool(heading) and len(phrases.words(heading, layout.separator)) == width
    if len(widths_below) < 2:
        return None
    # Values across the lines: only the last line may be short, all others have the same width.
    *middle, (last, last_width) = widths_below
    widths = {numbers for _, numbers in middle}
    if not is_headed and widths == {width} and last_width < width:
        values = _across(layout, width)
        if values.shape[1] == 2:
            return values
        table = values[:-last_width].reshape(-1, width)
        raise InputError(
            f"{source.at(last)}: found {last_width} values after lines of {width}: values across"
            f" the lines, not in columns; {remedy(table)}"
        )
    if len(widths) == 1 and widths != {width} and last_width <= min(widths):
        raise InputError(
            f"{source.at(first)}: found {width} numbers above rows of {min(widths)}; if they"
            " are not"
            " samples, put # before them, and enter the time step"
        )
    return None


def _across(layout: Layout, due: int) -> Floats:
    """Return values across the lines, as many in each but the last: one column, or pairs."""
    source = layout.source
    # Some programs end each line with the separator.
    rows = [(i, layout.fields(row.rstrip(",;"))) for i, row in layout.rows()]
    raise_any(
        f"{source.at(index)}: found {len(fields)} values; enter {due} as in every line but the last"
        for index, fields in rows
        if len(fields) > due or (len(fields) < due and index != rows[-1][0])
    )
    raise_any(row_problems(source, rows))
    values = np.array([*map(number_in, chain.from_iterable(fields for _, fields in rows))])
    if (paired := pairs(values, due)) is not None:
        return paired
    table = values[: values.size // due * due].reshape(-1, due)
    if due > 1 and (rising(table) or numbered(table)):
        raise InputError(f"{source.name}: found no values across the lines; {remedy(table)}")
    return values.reshape(-1, 1)


def _pairs_in_line(layout: Layout, table: Floats) -> int:
    """Return how many pairs of time and value are in each line; 0 for columns and for values."""
    return layout.width // 2 if 1 < table.shape[1] < layout.width else 0


def _check_count(layout: Layout, table: Floats) -> None:
    """Compare the number of rows with the number of samples that a remark states."""
    samples = len(table)
    # Of pairs, times may be counted as well.
    # -1: the line does not state a count.
    counts = {-1, samples, table.size if _pairs_in_line(layout, table) else samples}
    for index, line in layout.remarks:
        stated = phrases.count_in(line)
        if stated not in counts:
            remedy = "use the complete file" if samples < stated else "correct the count"
            raise InputError(
                f"{layout.source.at(index)}: states {stated} samples, found {samples}; {remedy}"
            )


def _check_last(layout: Layout) -> None:
    """Refuse a file without a line end whose last value has fewer digits than those before it."""
    source = layout.source
    # A line end, a comment or a blank shows that the last value was written whole.
    if source.is_ended or not content_of(source.lines[-1]) or "#" in source.lines[-1]:
        return
    rows = list(layout.rows(len(source.lines) - COMPARED))
    fields = [layout.fields(content)[-1].strip() for _, content in rows]
    if is_cut_short(fields):
        raise InputError(
            f"{source.at(rows[-1][0])}: found {quoted(fields[-1])} at the end, with fewer digits"
            " than the values before it and without a line end; use the complete file, or end its"
            " last line"
        )


def _left_out(layout: Layout, table: Floats, columns: Sequence[int]) -> dict[int, str]:
    """Return the columns that are not a component of acceleration, and why."""
    headings = layout.headings
    not_accelerations = [i for i in columns if headings and headings[i].kind is Kind.OTHER]
    components = [i for i in columns if i not in not_accelerations]
    named = [i for i in components if headings and headings[i].is_magnitude]
    lengths = magnitudes(table, components, named)
    return dict.fromkeys(not_accelerations, "not an acceleration") | dict.fromkeys(
        lengths, "the magnitude of a vector, not a component"
    )


def _has_times(layout: Layout, table: Floats) -> bool:
    """Whether the first column holds times."""
    if table.shape[1] == 1:
        return False
    kinds = [heading.kind for heading in layout.headings]
    if Kind.TIME in kinds[1:]:
        place = kinds.index(Kind.TIME, 1) + 1
        # Two tables pasted side by side contain the times twice.
        if kinds[0] is Kind.TIME and np.array_equal(table[:, 0], table[:, place - 1]):
            raise InputError(
                f"{layout.source.name}: found times in columns 1 and {place}: {SIDE_BY_SIDE}"
            )
        raise InputError(
            f"{layout.source.name}: found times in column {place}; put them in the first, and once"
        )
    if not kinds or kinds[0] is Kind.TIME:
        return True
    # If no heading mentions time, the values decide.
    # If a time step is given, a first column that does not rise is a component.
    rises = bool((np.diff(table[:, 0]) > 0.0).all())
    return kinds[0] is not Kind.ACCELERATION and (rises or math.isnan(layout.source.dt_s))


def _untimed_step(layout: Layout, columns: int) -> float:
    """Step [s] of a text without times: from a remark, or the caller."""
    source, steps = layout.source, layout.steps()
    if not steps and math.isnan(source.dt_s):
        noun = "one column," if columns == 1 else "columns"
        problem = f"{source.name}: found {noun} without times"
        raise InputError(Problem(problem, "enter the time step dt", about="dt_s"))
    return source.step(source.agreed(steps)) if steps else source.dt_s


def _timed(layout: Layout, table: Floats, columns: Floats) -> Even:
    """Columns by the times in the first one, which must agree with a step that is stated."""
    source, steps = layout.source, layout.steps()
    in_line = _pairs_in_line(layout, table) or 1
    _check_decimal_comma(layout, table[:, 0])
    unit_s = _unit_of_times(layout, table)
    check_both_ways(layout, table)
    t_s = unit_s * table[:, 0]

    def line_of(row: int) -> int:
        # The search starts at the top each time, because it is needed only for messages.
        return next(islice(layout.rows(), row // in_line, None))[0]

    dt_s, columns, notes = sampled(source, t_s, columns, line_of, unit_s)
    # Where the times are even, or rounded at a step that is entered, a remark states that step.
    off = [step for step in steps if not step.is_step(dt_s)]
    if steps and off == steps and (not notes or dt_s == source.dt_s):
        raise InputError(
            f"{source.at(steps[0].index)}: states a step of {steps[0].value:.6g} s, the times have"
            f" {dt_s:.6g} s; use a file in which they agree"
        )
    return dt_s, columns, notes


def _unit_of_times(layout: Layout, table: Floats) -> float:
    """Value [s] of the unit of the first column, which must be times."""
    _check_is_time(layout, table)
    unit_s = layout.seconds()
    heading = layout.headings[0] if layout.headings else None
    step = float(np.median(np.diff(table[:, 0])))
    if not (heading and heading.unit) and step >= _LONGEST_STEP and len(table) > FEW:
        noun = quoted(heading.text) if heading else "a first column"
        or_none = "" if heading else ", or delete the column if it contains sample numbers"
        raise InputError(
            f"{layout.source.at(max(layout.heading_index, 0))}: found {noun} with steps of"
            f" {step:g}; enter the unit of the times, such as time_s or time_ms{or_none}"
        )
    return unit_s


def _check_is_time(layout: Layout, table: Floats) -> None:
    """Raise if the first of several columns without headings cannot be times."""
    source, times = layout.source, table[:, 0]
    if layout.headings or len(times) <= FEW:
        return
    # Not the first fall: times that stand twice or out of order are told as times.
    falling = int((np.diff(times) <= 0.0).sum())
    # Accelerations decrease in about half of the steps, times with errors in a few; the threshold
    # is a quarter.
    if 4 * falling > len(times) and 0 not in rising(table):
        raise InputError(
            f"{source.name}: found {table.shape[1]} columns without a heading, and the first is no"
            f" time: it falls {falling} times; {remedy(table)}"
        )


def _check_decimal_comma(layout: Layout, times: Floats) -> None:
    """Raise for rows such as `0,12` and `0,13`: one column with decimal commas, not two."""
    rows = list(islice(layout.rows(), _LOOKED_AT))
    # `0,12` may be two columns, times and values: even times say that it is.
    if is_even(times) or not all(DECIMAL_COMMA.fullmatch(content) for _, content in rows):
        return
    index, content = rows[0]
    raise InputError(
        f"{layout.source.at(index)}: found {content!r}; enter a number with a decimal point"
    )
