"""Finds motions that a workbook gives more than once, by the samples of their horizontal records.

Rule sets count motions: one that is entered twice must not pass for two. Compares records as read,
before processing and scaling. Read `repeated`.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from report.motions.components import HORIZONTAL, Components
from report.sheet.checking.motion_checks import LABELS
from report.sheet.schema.fields import DraftRow, Finding, Place, Where
from solver.model import Floats

ALIKE = 1e-3
"""Largest difference of two samples / peak where records are the same: above that of rounding."""


@dataclass(frozen=True, slots=True)
class _Given:
    """A horizontal record: its cell, its row, and its samples / the sample of largest size."""

    place: Place
    row: DraftRow
    shape: Floats

    def repeats(self, other: _Given) -> bool:
        """Whether it is another one again, at any scale and of either sign."""
        return _overlap(self.row, other.row) and bool(
            np.abs(self.shape - other.shape).max() <= ALIKE
        )


def repeated(
    rows: Sequence[DraftRow], by_motion: Mapping[int, Components], where: Where
) -> Iterator[Finding]:
    """Yield each motion with a horizontal record of a motion above it.

    Parameters
    ----------
    rows : sequence of DraftRow
    by_motion : mapping of int to Components
        By row; without those that could not be read.
    where : callable
        Returns the address of a place.
    """
    seen: dict[tuple[int, int], list[_Given]] = {}
    for index, components in by_motion.items():
        given = list(_given(index, rows[index], components))
        pairs = ((new, old) for key, new in given for old in seen.get(key, ()) if new.repeats(old))
        new, old = next(pairs, (None, None))
        if new is not None and old is not None:
            text = (
                f"{LABELS[new.place.field]} record repeats the {LABELS[old.place.field]} record at "
                f"{where(old.place)} (equal samples, apart from scale and sign): {new.row['id']} "
                f"is {old.row['id']} again"
            )
            yield Finding.error(new.place, text, "give each motion once")
        for key, item in given:
            seen.setdefault(key, []).append(item)


def _given(
    index: int, row: DraftRow, components: Components
) -> Iterator[tuple[tuple[int, int], _Given]]:
    """Yield the horizontal records of a motion that are not all zeros, each with a key.

    Records that are the same have the same key: few others are then to be compared.
    """
    for field in HORIZONTAL:
        if field in components.whole:
            a = components.whole[field].a_mps2
            at = int(np.abs(a).argmax())
            if a[at] != 0.0:
                yield (len(a), at), _Given(Place("motions", index, field), row, a / a[at])


def _overlap(one: DraftRow, other: DraftRow) -> bool:
    """Whether the times that two motions take of their records overlap: a file may hold two."""
    (start, end), (other_start, other_end) = map(_times, (one, other))
    return start < other_end and other_start < end


def _times(row: DraftRow) -> tuple[float, float]:
    return row["from_s"] or 0.0, math.inf if row["to_s"] is None else row["to_s"]
