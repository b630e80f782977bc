"""Physical bounds of input values.

A value outside them is in another unit or damaged; it is rejected and never used. Read
`PhysicalBounds`.
"""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class PhysicalBounds:
    """The smallest and largest possible values of a quantity."""

    least: float
    most: float
    unit: str

    def has(self, value: float) -> bool:
        """Whether a value is within the bounds; NaN and infinities are not."""
        return self.least <= value <= self.most

    @property
    def words(self) -> str:
        """Both bounds, as shown in a message."""
        return f"{self.least:g} to {self.most:g} {self.unit}"


# Of a hazard curve at the ground: those of the U.S. Geological Survey have 0.0001 to 7.4 g.
INTENSITY = PhysicalBounds(1e-6, 10.0, "g")
# A greater number is no annual rate, and lives of as many events fill the memory.
ANNUAL_RATE = PhysicalBounds(1e-30, 10.0, "a year")
# Of a target spectrum, at a roof too.
ORDINATE = PhysicalBounds(1e-6, 100.0, "g")
# Of a record: more than twice that of any ground, roof or shake table.
PEAK = PhysicalBounds(0.0, 10.0, "g")
# Of a record, with a wide margin.
TIME_STEP = PhysicalBounds(1e-6, 1.0, "s")
# From 8 bits for 100 g to 32 bits for a thousandth of 1 g.
SENSITIVITY = PhysicalBounds(0.1, 1e12, "counts per m/s2")
