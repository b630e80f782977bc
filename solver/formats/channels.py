"""Converts the values of channels into records, with notes for the user.

A header that states a peak of 0.30 g is noted above values that reach 0.31 g, and refused above
values that reach 0.90 g, which are in another unit.

Compares a record with what its header states; knows no format. Read `motion_file` first.
"""

from __future__ import annotations

import datetime as dt
import re
from collections.abc import Callable, Sequence
from contextlib import suppress

import numpy as np

from solver.bounds import TIME_STEP
from solver.errors import InputError
from solver.formats.record_file import MotionFile, distinct
from solver.formats.source import Source, Stated
from solver.model import Floats
from solver.records.record import UNITS, Record, check_gaps, check_peak, has_gravity, own, quoted
from solver.spaces import NO_BREAK

MAX_CHANNELS = 1000
COMPONENTS = 3

# The peak in a header may be rounded or of other processing; a factor of two means another unit.
_PEAK_WITHIN = 0.01
_PEAK_FACTOR = 2.0
_OFFSET = 0.01
# A peak / those of the other channels: no component of shaking, but a gal or a milli-g among g.
_OTHER_UNIT = 300.0

# A length may count the step after the last sample, and may be rounded.
_LENGTH_STEPS = 2.0
_LENGTH_WITHIN = 0.005

# COSMOS and CSMIP: start time; RENADIC: trigger time; K-NET and KiK-net: record time.
_START = re.compile(
    r"(?:(?:START|TRIGGER)\s+TIME:|^RECORD\s+TIME)\s+(\d{1,4})/\s?(\d{1,2})/\s?(\d{1,4}),?"
    r"\s+(\d{1,2}):(\d\d):(\d\d(?:\.\d{1,6})?)",
    re.ASCII | re.IGNORECASE,
)
_START_LINES, _START_LETTERS = 20, 200

_OF_RECORDER = re.compile(
    r"\(\s*(\d{1,4})\s*CHNS?\s+OF\s+\d+\s+AT\s+STA\s*\)", re.ASCII | re.IGNORECASE
)


def parts_of(source: Source, heading: re.Pattern[str]) -> list[range]:
    """Lines of each part of a file, by index; it begins with the first line of a heading."""
    starts = [index for index, line in enumerate(source.lines) if heading.match(line)]
    check_number(source, len(starts))
    return list(map(range, starts, [*starts[1:], len(source.lines)]))


def check_components(source: Source, parts: Sequence[range]) -> None:
    """Refuse a file without three components, the last of which may have been cut off whole."""
    if len(parts) != COMPONENTS:
        raise InputError(
            f"{source.at(parts[-1].start)}: found the heading of component {len(parts)}, the last"
            f" one, where the format has {COMPONENTS} components; use the complete file"
        )


def motion_file(
    source: Source,
    form: str,
    channels: Sequence[Record],
    notes: Sequence[str] = (),
    start: dt.datetime | None = None,
) -> MotionFile:
    """Build the result of a reader from records as printed: unnamed, or with names that repeat.

    Names of the result are distinct, and notes name their channel.

    `start` is the start time of the record, if its heading states it in a format of its own.
    """
    if not channels:
        raise InputError(
            f"{source.name}: found no acceleration in this {form} file; use a file of acceleration"
        )
    check_number(source, len(channels))
    alone = len(channels) == 1
    names = distinct(channel.name or (source.name if alone else "") for channel in channels)
    records, all_notes = [], list(notes)
    for name, channel in zip(names, channels, strict=True):
        if len(channel.a_mps2) < 2:
            count = len(channel.a_mps2)
            samples = "1 sample" if count == 1 else f"{count} samples"
            raise InputError(f"{source.name}: found {samples}; enter at least 2")
        _check_size(source, channel)
        # A read-only copy, so that the bounds of its samples can be cached.
        a_mps2 = own(channel.a_mps2)
        # A constant is no shaking with gravity in it.
        shakes = has_gravity(a_mps2) and np.ptp(a_mps2) > 0.0
        gravity = (
            (f"the mean is about 1{NO_BREAK}g because the record includes gravity",)
            if shakes
            else ()
        )
        channel_notes = (*gravity, *channel.notes)
        records.append(
            Record(name=name, dt_s=float(channel.dt_s), a_mps2=a_mps2, notes=channel_notes)
        )
        all_notes += channel_notes if alone else [f"{name}: {note}" for note in channel_notes]
    peaks = sorted((float(np.abs(record.a_mps2).max()), record.name) for record in records)
    if len(peaks) > 1:
        (below, _), (peak, name) = peaks[-2:]
        if 0.0 < below * _OTHER_UNIT <= peak:
            times = f"{peak / below:.0f} times the peaks of the others"
            all_notes.append(f"{name} reaches {times}: is it in the same unit?")
    # Each component of a tilted logger contains a part of gravity; their vector sum is 1 g.
    mean = np.array([record.a_mps2.mean() for record in records])
    if (
        len(mean) == 3
        and has_gravity(float(np.linalg.norm(mean)))
        and not any(map(has_gravity, mean))
    ):
        all_notes.append(
            f"the means of the three add up to about 1{NO_BREAK}g because the records include"
            " gravity"
        )
    return MotionFile(
        name=source.name,
        format=form,
        channels=tuple(records),
        # Removes duplicates but keeps the order, unlike a set.
        notes=tuple(dict.fromkeys(all_notes)),
        start=start or _start(source),
    )


def time_in(text: str, *formats: str) -> dt.datetime | None:
    """Return the time that a text states in one of some formats; None for none."""
    for form in formats:
        with suppress(ValueError):
            return dt.datetime.strptime(text.strip(), form)
    return None


def _start(source: Source) -> dt.datetime | None:
    """Return the time at which a record begins by its heading, if that names one."""
    for line in source.lines[:_START_LINES]:
        if match := _START.search(line[:_START_LETTERS]):
            *date, hour, minute = map(int, match.groups()[:5])
            # Japan writes the year first, the United States the month.
            year, month, day = date if date[0] > 12 else (date[2], date[0], date[1])
            year += 2000 if year < 100 else 0  # the century is not printed
            seconds = dt.timedelta(seconds=float(match[6]))
            try:
                return dt.datetime(year, month, day, hour, minute) + seconds
            except (ValueError, OverflowError):  # no date of the calendar
                return None
    return None


def _check_size(source: Source, channel: Record) -> None:
    """Raise if a step or a value is impossible for an accelerogram: wrong units or scale."""
    # Before the check of the peak, so that 9999 is reported as a code and not as 9999 g.
    check_gaps(source.name, channel.a_mps2)
    check_peak(source.name, channel.a_mps2)
    if not TIME_STEP.has(channel.dt_s):
        raise InputError(
            f"{source.name}: the time step is {channel.dt_s:.3g} s; use a record with steps of"
            f" {TIME_STEP.words}"
        )


def check_number(source: Source, channels: int) -> None:
    """Raise if a file has more channels than any instrument."""
    if channels > MAX_CHANNELS:
        raise InputError(
            f"{source.name}: found {channels} channels; enter at most {MAX_CHANNELS} in a file"
        )


def peak_notes(source: Source, index: int, stated_mps2: float, a_mps2: Floats) -> tuple[str, ...]:
    """Compare values with the peak stated in a header; NaN or 0 if it states none.

    Raises `InputError` if they differ by a factor of two or more: the unit, the scale or the values
    are wrong.
    """
    stated, reached = abs(stated_mps2), float(np.abs(a_mps2).max(initial=0.0))
    if not 0.0 < stated < np.inf:
        return ()
    g = UNITS["g"]
    words = (
        f"the header states a peak of {stated / g:.4g}{NO_BREAK}g, the values reach"
        f" {reached / g:.4g}{NO_BREAK}g"
    )
    if not stated / _PEAK_FACTOR <= reached <= stated * _PEAK_FACTOR:
        raise InputError(f"{source.at(index)}: {words}; use a file whose header and values agree")
    return () if abs(reached - stated) <= _PEAK_WITHIN * stated else (words,)


def centered_peak_notes(
    source: Source, index: int, stated_mps2: float, a_mps2: Floats
) -> tuple[str, ...]:
    """Same as `peak_notes`, for a stated peak that may exclude the mean."""
    centered = a_mps2 - a_mps2.mean() if len(a_mps2) else a_mps2
    # Whichever is closer: K-NET states the peak with the mean removed, other networks the peak of
    # the values.
    alike = min(
        (a_mps2, centered),
        key=lambda values: abs(float(np.abs(values).max(initial=0.0)) - abs(stated_mps2)),
    )
    return peak_notes(source, index, stated_mps2, alike)


def check_length(source: Source, stated: Stated, reached_s: float, dt_s: float) -> None:
    """Raise if a record is not as long as a heading states; NaN or 0 if it states no length."""
    within_s = _LENGTH_STEPS * dt_s + _LENGTH_WITHIN * stated.value
    # No length is NaN, which is not above zero.
    if stated.value > 0.0 and abs(reached_s - stated.value) > within_s:
        raise InputError(
            f"{source.at(stated.index)}: the heading states {stated.value:g} s, the record lasts"
            f" {reached_s:g} s; enter dt with more digits, or a file whose headings agree"
        )


def check_steps(source: Source, stated: Stated, exact: Stated) -> None:
    """Raise if the step in the text of a heading and the one in its numbers do not agree."""
    if abs(exact.value - stated.value) > stated.rounding + exact.rounding:
        raise InputError(
            f"{source.at(stated.index)}: found a step of {stated.value:g} s and one of"
            f" {exact.value:g} s in line {exact.index + 1}; use a file whose headings agree"
        )


def check_only_blank(source: Source, first: int, stop: int, before: str) -> None:
    """Raise at the first line from index `first` to before `stop` that is not blank.

    Such a line is the rest of a channel whose heading, or the beginning of it, is missing.
    """
    for index in range(first, stop):
        if source.lines[index].strip():
            raise InputError(
                f"{source.at(index)}: found {quoted(source.lines[index].strip())} after {before},"
                " but a heading was expected; use the complete file"
            )


def end_of_values(
    source: Source, lines: range, is_mark: Callable[[str], object], words: str, noun: str
) -> tuple[int, tuple[str, ...]]:
    """Index of the line that ends the values of a series or a channel, with a note if none does.

    Nothing but blank lines may follow it. The words are those of the mark and of its place.
    """
    for index in lines:
        if is_mark(source.lines[index]):
            check_only_blank(source, index + 1, lines.stop, f"the end of a {noun}")
            return index, ()
    note = f"no end-of-data line{words} follows the values; the file may be truncated"
    return lines.stop, (note,)


def recorder_notes(source: Source, samples: int) -> tuple[str, ...]:
    """Note that a file has fewer channels than its headings state for the recorder.

    It is no error: a file may hold one channel of a recorder.
    """
    matches = enumerate(map(_OF_RECORDER.search, source.lines))
    stated = [(int(match[1]), index) for index, match in matches if match]
    stated_count, index = max(stated, default=(0, 0))
    if stated_count <= samples:
        return ()
    return (
        f"line {index + 1} states {stated_count} channels of the recorder, the file has {samples}:"
        " the others are in other files, or the file is truncated",
    )


def offset_notes(a_mps2: Floats) -> tuple[str, ...]:
    """Note an offset of uncorrected values: its integral over the record is a velocity."""
    mean, peak = float(np.mean(a_mps2)), float(np.abs(a_mps2).max())
    # An offset of 0.001 g gives a velocity of 0.6 m/s at the end of a 60 s record.
    if abs(mean) <= _OFFSET * peak:
        return ()
    return (
        f"uncorrected: the mean is {mean / UNITS['g']:.3g}{NO_BREAK}g,"
        f" {100.0 * abs(mean) / peak:.2g}% of the peak; it is not removed",
    )
