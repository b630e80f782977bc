"""PEER records (.AT2): four lines of heading, then accelerations in g separated by blanks.

Handles this format only. The last line of the heading is `NPTS=  4000, DT=   .0100 SEC` in files of
the NGA databases and `4000    0.0100    NPTS, DT` in those of the first PEER database. Read `read`
first.

Source: the files of the Pacific Earthquake Engineering Research Center, peer.berkeley.edu (there
is no written definition).
"""

from __future__ import annotations

import re
from collections.abc import Sequence

from solver.formats.channels import Channel, motion_file
from solver.formats.motionfile import MotionFile
from solver.formats.numbers import Block, free_values, printed
from solver.formats.source import Source
from solver.model import InputError
from solver.records.record import shown

# The count is in the first lines of a file; the heading has four.
_HEADING_LINES = 6
_NUMBER = r"([+-]?\d*(?:\.\d*)?(?:[eE][+-]?\d+)?)"
_NAMED = re.compile(rf"NPTS\s*=\s*(\d+)\s*+(?:,\s*)?DT\s*=\s*{_NUMBER}", re.ASCII | re.IGNORECASE)
_BEHIND = re.compile(
    rf"\s*(\d+)(?:\s*+,)?\s++{_NUMBER}\s*+(?:,\s*)?NPTS\s*,\s*DT", re.ASCII | re.IGNORECASE
)
_COUNT_LINE = re.compile(r"\bNPTS\b", re.IGNORECASE)
_UNIT = re.compile(r"IN UNITS OF\s+([A-Z/0-9^]+)", re.ASCII | re.IGNORECASE)
_OTHER = re.compile(r"\b(VELOCITY|DISPLACEMENT)\b", re.IGNORECASE)


def recognizes(lines: Sequence[str]) -> bool:
    """Whether a line near the top gives the count as NPTS."""
    return _count_line(lines) >= 0


def read(source: Source) -> MotionFile:
    """Read the one component of a PEER file."""
    at = _count_line(source.lines)
    heading = source.lines[:at]
    _check_acceleration(source, heading)
    counted = _NAMED.search(source.lines[at]) or _BEHIND.match(source.lines[at])
    if not counted:
        raise InputError(
            f"{source.at(at)}: found {shown(source.lines[at].strip())}; give the count and the step"
            " as in NPTS=  4000, DT=   .0100 SEC"
        )
    scale = _scale(source, heading)
    dt_s = source.step(printed(counted[2], at))
    block = Block(first=at + 1, stop=len(source.lines), count=int(counted[1]), promised=at)
    values = free_values(source, block) * scale
    channel = Channel(name=_component(heading), dt_s=dt_s, a_mps2=values, notes=())
    return motion_file(source, "PEER AT2", [channel])


def _count_line(lines: Sequence[str]) -> int:
    near = enumerate(lines[:_HEADING_LINES])
    return next((index for index, line in near if _COUNT_LINE.search(line)), -1)


def _check_acceleration(source: Source, heading: Sequence[str]) -> None:
    for index, line in enumerate(heading):
        # Another line of the heading may mention velocity, for example of the site.
        if (other := _OTHER.search(line)) and _UNIT.search(line):
            raise InputError(
                f"{source.at(index)}: found {other[1].lower()}; give the file of acceleration"
            )


def _scale(source: Source, heading: Sequence[str]) -> float:
    for index, line in enumerate(heading):
        if unit := _UNIT.search(line):
            return source.scale(unit[1], index)
    return source.given_scale()


def _component(heading: Sequence[str]) -> str:
    """Last part of the line of event, date, station and component."""
    title = heading[1] if len(heading) > 1 else ""
    return title.rpartition(",")[2].strip() if "," in title else ""
