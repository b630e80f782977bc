"""Motions that are listed twice: equal horizontal samples, apart from scale and sign.

Two components of one recording differ, and so do two recordings: equal samples are one motion that
would be counted twice in a mean. Read `repeated`.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from report.motions.components import HORIZONTAL, Components
from report.project.check.motion_faults import LABELS
from report.project.model.finding import Finding
from report.project.model.input_rows import InputRow, Place, Where
from solver.model import Floats

# Largest difference of two samples / peak where records are the same: above that of rounding.
ALIKE = 1e-3


_Key = tuple[int, int]  # number of samples, and index of the largest one


@dataclass(frozen=True, slots=True)
class _Horizontal:
    """A horizontal record: its cell, its row, and its samples / the sample of largest size."""

    place: Place
    row: InputRow
    shape: Floats

    def repeats(self, record: _Horizontal) -> bool:
        """Whether it repeats another one, at any scale and of either sign."""
        # Times that two motions take of their records may be apart: a file may hold two.
        (start, end), (other_start, other_end) = map(_times, (self.row, record.row))
        overlaps = start < other_end and other_start < end
        return overlaps and bool(np.abs(self.shape - record.shape).max() <= ALIKE)


def repeated(
    rows: Sequence[InputRow], by_motion: Mapping[int, Components], where: Where
) -> Iterator[Finding]:
    """Yield each motion with a horizontal record of a motion above it.

    `by_motion` is by row, without the motions that could not be read; `where` returns the address
    of a place.
    """
    seen: dict[_Key, list[_Horizontal]] = {}
    for index, components in by_motion.items():
        records = list(_horizontal_records(index, rows[index], components))
        if repetition := _repetition(records, seen):
            record, earlier = repetition
            text = (
                f"{LABELS[record.place.field]} record repeats the {LABELS[earlier.place.field]}"
                f" record at {where(earlier.place)} (equal samples, apart from scale and sign):"
                f" {record.row['id']} is {earlier.row['id']} again"
            )
            yield Finding.error(record.place, text, "enter each motion once")
        for key, record in records:
            seen.setdefault(key, []).append(record)


def _repetition(
    records: Sequence[tuple[_Key, _Horizontal]], seen: Mapping[_Key, Sequence[_Horizontal]]
) -> tuple[_Horizontal, _Horizontal] | None:
    """Return the first record that repeats an earlier one, with that one."""
    for key, record in records:
        for earlier in seen.get(key, ()):
            if record.repeats(earlier):
                return record, earlier
    return None


def _horizontal_records(
    index: int, row: InputRow, components: Components
) -> Iterator[tuple[_Key, _Horizontal]]:
    """Yield the horizontal records of a motion that are not all zeros, each with a key."""
    # Records that are the same have the same key: few others are then to be compared.
    for field in HORIZONTAL:
        if field in components.whole:
            a = components.whole[field].a_mps2
            peak_index = int(np.abs(a).argmax())
            if a[peak_index] != 0.0:
                place = Place("motions", index, field)
                # Divided by its peak with its sign: a record and its reverse, in whatever unit,
                # have one shape.
                yield (len(a), peak_index), _Horizontal(place, row, a / a[peak_index])


def _times(row: InputRow) -> tuple[float, float]:
    return row["from_s"] or 0.0, math.inf if row["to_s"] is None else row["to_s"]
