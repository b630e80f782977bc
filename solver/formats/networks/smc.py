"""SMC files of the U.S. Geological Survey (.smc): one component, in cm/s2.

Handles this format only. Eleven lines of text, 48 integers (8I10), 50 real numbers (5E15.7), lines
of comment that begin with |, then values (8E10.4E1): evenly spaced if the heading gives a rate,
otherwise pairs of time and acceleration. Read `read` first.
"""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from solver.errors import InputError
from solver.formats.channels import motion_file, offset_notes, peak_notes
from solver.formats.numbers import Block, FieldFormat, fixed_rows, fixed_values, header_values
from solver.formats.record_file import MotionFile
from solver.formats.source import Source, Stated
from solver.formats.times import sampled
from solver.records.record import Record

# Source: U.S. Geological Survey, National Strong-Motion Program, SMC- and BBF-format data files,
# escweb.wr.usgs.gov/nsmp-data/smcfmt.html: integers 1 (code of an unknown one), 16 (comments), 17
# (values), 18 (problem flag); real numbers 1 (code of an unknown one), 2 (rate [1/s]), 30 and 32
# (largest and smallest value). That an uneven file counts times and accelerations together, and may
# have short lines where two pieces of film join, was found in files (575 Market Street, 1989).
_KINDS = "UNCORRECTED ACCEL|CORRECTED ACCEL|VELOCITY|DISPLACEMENT|RESPONSE SPECTR|FOURIER"
_FIRST = re.compile(rf"\s*\d\s+({_KINDS})", re.ASCII | re.IGNORECASE)
_COMPONENT = re.compile(r"component\s*=(.*)", re.IGNORECASE)

_TEXT = 11
_WHOLE = FieldFormat(per_line=8, width=10)
_REAL = FieldFormat(per_line=5, width=15)
_VALUES = FieldFormat(per_line=8, width=10)
_WHOLES, _REALS = 48, 50

# Positions of the numbers in the heading, from 1.
_COMMENTS, _COUNT, _FLAG = 16, 17, 18
_RATE, _LARGEST, _SMALLEST = 2, 30, 32

# Unknown real numbers are coded as 1.7E38; no rate or acceleration is near that.
_UNKNOWN = 1e30


def recognizes(source: Source) -> bool:
    """Whether the first line is a type number with the name of the type."""
    return bool(_FIRST.match(source.line(0)))


def read(source: Source) -> MotionFile:
    """Read the one component of a file of type 1 (uncorrected) or 2 (corrected)."""
    match = _FIRST.match(source.line(0))
    kind = match[1].upper() if match else ""
    if "ACCEL" not in kind:
        raise InputError(f"{source.at(0)}: found {kind.lower()}; use a file of acceleration")
    integers = header_values(source, _TEXT, _WHOLES, _WHOLE)
    real = header_values(source, _TEXT + _WHOLE.lines(_WHOLES), _REALS, _REAL)
    # The format has no other unit.
    scale = source.scale("cm/s2", 0)
    block, comment_notes = _block(source, integers)
    rate = real[_RATE - 1]
    if _known(rate) > 0.0:
        dt_s = source.step(Stated(value=1.0 / rate.value, index=rate.index))
        record = Record(name="", dt_s=dt_s, a_mps2=fixed_values(source, block, _VALUES) * scale)
    else:
        record = _uneven(source, block, scale)
    notes = [*comment_notes, *record.notes]
    if integers[_FLAG - 1].value == 1.0:
        notes.append("the heading flags a problem with this record: read its comments")
    # The heading has peaks in the unit of the values.
    peak = max(abs(_known(real[_LARGEST - 1])), abs(_known(real[_SMALLEST - 1]))) * scale
    notes += peak_notes(source, real[_LARGEST - 1].index, peak, record.a_mps2)
    if kind.startswith("UNCORRECTED"):
        notes += offset_notes(record.a_mps2)
    named = _COMPONENT.search(source.line(5))
    name = named[1].strip() if named else ""
    return motion_file(source, "USGS SMC", [replace(record, name=name, notes=tuple(notes))])


def _block(source: Source, integers: Sequence[Stated]) -> tuple[Block, tuple[str, ...]]:
    """Lines of the values, after the comments, with a note where these are more than stated."""
    comments, count = integers[_COMMENTS - 1], integers[_COUNT - 1]
    for number, meaning in ((comments, "lines of comment"), (count, "values")):
        # A blank field is NaN, for which the comparison is false.
        if not 0.0 <= number.value < 1e8:
            raise InputError(
                f"{source.at(number.index)}: found no number of {meaning}; use the complete file"
            )
    heading = _TEXT + _WHOLE.lines(_WHOLES) + _REAL.lines(_REALS)
    first = heading + int(comments.value)
    for index in range(heading, min(first, len(source.lines))):
        if not source.lines[index].startswith("|"):
            raise InputError(
                f"{source.at(index)}: found a line without | among the {comments.value:.0f} lines"
                " of comment; use the complete file"
            )
    further = 0
    while source.line(first + further).startswith("|"):
        further += 1
    note = f"states {comments.value:.0f} lines of comment, found {comments.value + further:.0f}"
    stop, promised = len(source.lines), count.index
    block = Block(first=first + further, stop=stop, count=int(count.value), promised=promised)
    return block, (note,) if further else ()


def _uneven(source: Source, block: Block, scale: float) -> Record:
    """Pairs of time and acceleration; a line may have fewer than four."""
    fields = [_VALUES.fields(line) for line in source.lines[block.first : block.stop]]
    last = max((i for i, number in enumerate(fields) if number), default=0)
    notes: tuple[str, ...] = ()
    # As in many records of film: the rest of another piece.
    if fields and sum(fields[:last]) == block.count:
        line = block.first + last
        notes = (f"line {line + 1} is beyond the {block.count} values stated, and is skipped",)
        block = replace(block, stop=line)
    values = fixed_rows(source, block, _VALUES)
    # Files state the number of values; one that states the number of pairs is not truncated.
    if len(values) not in (block.count, 2 * block.count):
        raise InputError(
            f"{source.at(block.promised)}: states {block.count} values, found {len(values)};"
            " use the complete file"
        )
    rows = []
    for index, number in enumerate(fields[: block.stop - block.first], block.first):
        if number % 2:
            raise InputError(
                f"{source.at(index)}: found {number} values; enter pairs of time and acceleration"
            )
        # The line number is repeated for each pair, so that a message about a time states its line.
        rows += [index] * (number // 2)
    pairs = values.reshape(-1, 2)
    if len(pairs) < 2:
        raise InputError(f"{source.at(block.promised)}: found {len(pairs)} pairs; enter at least 2")
    # Five digits print some readings of film at the same time.
    times, first, count = np.unique(pairs[:, 0], return_index=True, return_counts=True)
    if len(times) < len(pairs) and (np.diff(pairs[:, 0]) >= 0.0).all():
        means = np.add.reduceat(pairs[:, 1], first) / count
        repeated = len(pairs) - len(times)
        notes += (f"repeated times: {repeated}; the mean of their values is used",)
        pairs, rows = np.column_stack((times, means)), [rows[i] for i in first]
    dt_s, columns, resampling = sampled(source, pairs[:, 0], pairs[:, 1:].T, rows.__getitem__)
    return Record(name="", dt_s=dt_s, a_mps2=columns[0] * scale, notes=(*notes, *resampling))


def _known(number: Stated) -> float:
    return 0.0 if math.isnan(number.value) or abs(number.value) > _UNKNOWN else number.value
