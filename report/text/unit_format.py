"""Values in SI as they are printed, the preferred system of units first.

1.0363 m is 40.8 in (1036 mm); as a demand, rounded up, 40.8 in (1037 mm). Read `UnitFormat`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from report.text.units import Quantity, Show, Unit, measured, no_less, pair, with_unit

NO_VALUE = "none"
_LENGTH = Quantity.DISPLACEMENT


@dataclass(frozen=True, slots=True)
class UnitFormat:
    """Formats values, the preferred system of units first."""

    us_first: bool
    none: str = NO_VALUE
    # In which a table has a quantity: a narrow one has the first alone.
    systems: int = 2

    def both(
        self, value_si: float, quantity: Quantity = _LENGTH, show: Show = measured, mark: str = ""
    ) -> str:
        """Return `81.6 in (2072 mm)` with its mark; `none` for NaN, without a mark."""
        if math.isnan(value_si):
            return self.none
        return pair(value_si, quantity, self.us_first, show) + mark

    def both_up(self, value_si: float, mark: str = "") -> str:
        """Return a required length, or one that determines a requirement, rounded up."""
        return self.both(value_si, show=no_less, mark=mark)

    def short(
        self, value_si: float, quantity: Quantity = _LENGTH, show: Show = measured, mark: str = ""
    ) -> str:
        """Return a value with its unit in the preferred system; `none` for NaN."""
        unit = self.units(quantity)[0]
        text = with_unit(show(value_si, unit), unit.symbol) + mark
        return self.none if math.isnan(value_si) else text

    def first(
        self, value_si: float, quantity: Quantity = _LENGTH, show: Show = measured, mark: str = ""
    ) -> str:
        """Return a value in the preferred system, without its unit; `none` for NaN."""
        return self.none if math.isnan(value_si) else show(value_si, self.units(quantity)[0]) + mark

    def units(self, quantity: Quantity = _LENGTH) -> tuple[Unit, Unit]:
        """Return the units of a quantity, the preferred one first."""
        return (quantity.us, quantity.si) if self.us_first else (quantity.si, quantity.us)
