"""PEER records (.AT2), and others whose heading ends with a line of count and step.

Handles these formats only: lines of text, the line of count and step, then accelerations separated
by blanks. In PEER's files that line is the fourth, `NPTS=  4000, DT=   .0100 SEC` in the NGA
databases and `4000    0.0100    NPTS, DT` in the first one; the NRC's and rotated files have more
lines above it. eqsig and RSPMatch write the two numbers alone, below a name, and no unit. Read
`read` first.
"""

from __future__ import annotations

import itertools
import re
from collections.abc import Sequence

from solver.errors import InputError
from solver.formats import phrases, remarks
from solver.formats.channels import motion_file
from solver.formats.not_accelerations import FEW
from solver.formats.numbers import Block, free_values, is_row, printed
from solver.formats.record_file import MotionFile
from solver.formats.source import Source, Stated
from solver.records.record import Record, has_gravity, quoted

# Source: the files of the Pacific Earthquake Engineering Research Center, peer.berkeley.edu (there
# is no written definition); eqsig.loader (label, then count and step, then a value a line); the
# RSPMatch09 manual (title, then count, step and a third number, then values).

# The count is in the first lines of a file: the heading has four, or seven and more.
_HEADING_LINES, _LONGEST_HEADING = 6, 20
_NAMED = re.compile(r"NPTS\s*=\s*(\d+)", re.ASCII | re.IGNORECASE)
_BEHIND = re.compile(
    r"\s*(\d+)(?:\s*+,)?\s++(\d*(?:\.\d*)?(?:[eE][+-]?\d+)?)\s*+(?:,\s*)?NPTS\s*,\s*DT",
    re.ASCII | re.IGNORECASE,
)
_COUNT_LINE = re.compile(r"(?!\s*#).*\bNPTS\b", re.IGNORECASE)
# Possessive: a line of many digits is looked at once, and refused in a time as its length.
_BARE = re.compile(r"(\d{1,9})[,\s]++(\d*\.\d+(?:[eE]-?\d+)?)(?:[,\s]++\d+)?[,\s]*+", re.ASCII)


def recognizes(source: Source) -> bool:
    """Whether a line near the top gives the count as NPTS, or count and step alone."""
    return max(_count_line(source.lines), _bare_line(source.lines)) >= 0


def read(source: Source) -> MotionFile:
    """Read the one component of a file."""
    number = _count_line(source.lines)
    form = "PEER AT2" if number >= 0 else "count and step"
    if number < 0:
        number = _bare_line(source.lines)
    heading = source.lines[:number]
    for index, line in enumerate(heading):
        if quantity := remarks.other_quantity(line):
            raise InputError(f"{source.at(index)}: found {quantity}; use the file of acceleration")
    remarks.check_units_alone(source, source.lines[: number + 1])
    stated = source.lines[number]
    counted = _counted(stated) or _BARE.fullmatch(stated.strip())
    if not counted:
        raise InputError(
            f"{source.at(number)}: found {quoted(stated.strip())}; enter the count and the step as"
            " in NPTS=  4000, DT=   .0100 SEC"
        )
    units: list[tuple[str, int]] = []
    for index, line in enumerate(source.lines[: number + 1]):
        # The name of a station may have the letters of a unit in brackets, but no m/s2.
        is_said = phrases.ACCELERATION.search(line) or phrases.stated_units(line)
        units += [(unit, index) for unit in phrases.units_in(line) if is_said or "/" in unit]
    scale = source.stated_scale(units)
    step = printed(counted[2], number) if counted.re is not _NAMED else None
    steps = [step] if step else phrases.steps_in(source, number, stated)
    dt_s = source.step(source.agreed(steps or [Stated(index=number)]))
    block = Block(first=number + 1, stop=len(source.lines), count=int(counted[1]), promised=number)
    values = free_values(source, block) * scale
    is_curve = len(values) > FEW and values.min() >= 0.0 and values.any()
    if is_curve and not has_gravity(values):
        raise InputError(
            f"{source.at(number + 1)}: found no value below zero: this is a spectrum or a curve,"
            " not a record; use accelerations by time"
        )
    # The second line has event, date, station and component.
    _, comma, component = heading[1].rpartition(",") if len(heading) > 1 else ("", "", "")
    name = component.strip() if comma else ""
    channel = Record(name=name, dt_s=dt_s, a_mps2=values, notes=())
    return motion_file(source, form, [channel], remarks.factor_notes(enumerate(heading)))


def _counted(line: str) -> re.Match[str] | None:
    return _NAMED.search(line) or _BEHIND.match(line)


def _count_line(lines: Sequence[str]) -> int:
    """Index of the line of the count as NPTS: the last, as an older heading may stand above."""
    near = list(enumerate(lines[:_LONGEST_HEADING]))
    complete = [i for i, line in near if _counted(line) and not line.lstrip().startswith("#")]
    named = [i for i, line in near[:_HEADING_LINES] if _COUNT_LINE.match(line)]
    return max(complete or named[:1], default=-1)


def _bare_line(lines: Sequence[str]) -> int:
    """Index of a line of count and step alone, below text and above rows of another width."""
    rows = ((i, line.split()) for i, line in enumerate(lines) if line.strip())
    near = list(itertools.islice(rows, _HEADING_LINES + 1))
    for (index, fields), (_, following) in itertools.pairwise(near):
        if is_row(fields):
            # Two numbers above rows of two are the first row of a table.
            is_bare = _BARE.fullmatch(lines[index].strip()) and len(fields) != len(following)
            return index if is_bare and is_row(following) else -1
    return -1
