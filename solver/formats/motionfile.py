"""What a file of records holds, and how one of its channels is chosen.

Owns no reading. Read `MotionFile.channel` first.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from solver.model import InputError
from solver.records.record import Record, shown

_LISTED = 30


@dataclass(frozen=True, slots=True, kw_only=True)
class MotionFile:
    """A file of records as it was read: nothing is filtered and no offset is removed.

    Attributes
    ----------
    name : str
        Of the file, without its folder.
    format : str
        Such as ``PEER AT2`` or ``text``.
    channels : tuple of Record
        In the order of the file, at least one. Each is named as the file names it, a lone one
        without a name after the file. No two names are alike.
    notes : tuple of str
        What a user should know of the reading, such as that uneven times were resampled.
    """

    name: str
    format: str
    channels: tuple[Record, ...]
    notes: tuple[str, ...]

    def channel(self, name: str = "") -> Record:
        """Return the channel of a name, case and blanks aside, or of a number, counted from 1.

        The name may be left out where the file has one channel only.

        Raises
        ------
        InputError
            Which lists the names.
        """
        wanted = _folded(name)
        if not wanted and len(self.channels) == 1:
            return self.channels[0]
        by_name = {_folded(record.name): record for record in self.channels}
        by_number = {str(i): record for i, record in enumerate(self.channels, start=1)}
        found = (by_number | by_name).get(wanted)
        if found is None:
            said = f"channel {shown(name)} is not there" if wanted else "found several channels"
            names = "; ".join(f"{i} {record.name}" for i, record in [*by_number.items()][:_LISTED])
            more = len(by_number) - _LISTED
            names += f"; ... and {more} more" if more > 0 else ""
            raise InputError(f"{self.name}: {said}; give one by name or number: {names}")
        return found


def distinct(names: Iterable[str]) -> list[str]:
    """Names with their blanks collapsed, a repeated one told apart by a number in brackets."""
    given: list[str] = []
    taken: set[str] = set()
    for i, name in enumerate(names, start=1):
        plain = " ".join(name.split()) or f"channel {i}"
        candidates = (plain, *(f"{plain} ({k})" for k in range(2, i + 2)))
        given.append(next(text for text in candidates if _folded(text) not in taken))
        taken.add(_folded(given[-1]))
    return given


def _folded(name: str) -> str:
    return " ".join(name.split()).casefold()
