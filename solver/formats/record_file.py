"""A record file as read: its channels by name or number, with notes for the user.

`motion_file.channel("N-S")` and `motion_file.channel("1")` give the first of `N-S`, `E-W`, `U-D`.
"""

from __future__ import annotations

import datetime as dt
import math
from collections.abc import Iterable
from dataclasses import dataclass, field

from solver.errors import InputError
from solver.records.record import Record, quoted
from solver.suggestions import nearest

_LISTED = 30


@dataclass(frozen=True, slots=True, kw_only=True)
class MotionFile:
    """A record file as read, not filtered and with no offset removed.

    Attributes
    ----------
    name : str
        File name without its folder.
    format : str
        Such as ``PEER AT2`` or ``text``.
    channels : tuple of Record
        In the order of the file, at least one. Each has its name in the file; a single channel
        without a name has that of the file. All names are different.
    notes : tuple of str
        Notes for the user, such as that uneven times were resampled.
    hold_s : float
        Hold of the envelope [s], if the file says that it was generated; otherwise NaN.
    start : datetime or None
        Start time of the record, as stated in the heading; None if not stated.
    content : bytes
        The file that all of this is read from.
    """

    name: str
    format: str
    channels: tuple[Record, ...]
    notes: tuple[str, ...]
    hold_s: float = math.nan
    start: dt.datetime | None = None
    content: bytes = field(default=b"", repr=False)

    def channel(self, name: str = "") -> Record:
        """Return the channel with a name (ignoring case and blanks) or a number, counted from 1.

        The name may be omitted if the file has only one channel.

        Raises
        ------
        InputError
            If there is no such channel; the message lists the names.
        """
        key = _folded(name)
        if not key and len(self.channels) == 1:
            return self.channels[0]
        by_name = {_folded(record.name): record for record in self.channels}
        by_number = {str(i): record for i, record in enumerate(self.channels, start=1)}
        # A name counts before a number: a channel may be called 2.
        chosen = (by_number | by_name).get(key)
        if chosen is None:
            problem = f"found no channel {quoted(name)}" if key else "found several channels"
            names = "; ".join(f"{i} {record.name}" for i, record in [*by_number.items()][:_LISTED])
            unlisted = len(by_number) - _LISTED
            names += f"; ... and {unlisted} more" if unlisted > 0 else ""
            near = nearest(name, (record.name for record in self.channels)) if key else ""
            asked = f"did you mean '{near}'? Use" if near else "use"
            raise InputError(f"{self.name}: {problem}; {asked} one by name or number: {names}")
        return chosen


def distinct(names: Iterable[str]) -> list[str]:
    """Names with single blanks; a number in parentheses distinguishes a repeated name."""
    named: list[str] = []
    taken: set[str] = set()
    for i, name in enumerate(names, start=1):
        plain = " ".join(name.split()) or f"channel {i}"
        # One more candidate than there are names in use, so one of them is free.
        candidates = (plain, *(f"{plain} ({k})" for k in range(2, i + 2)))
        named.append(next(text for text in candidates if _folded(text) not in taken))
        taken.add(_folded(named[-1]))
    return named


def _folded(name: str) -> str:
    return " ".join(name.split()).casefold()
