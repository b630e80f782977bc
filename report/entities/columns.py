"""A column of a table, and values in both systems of units.

Owns no content. Read `report.entities.shown` next.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from report.words.units import Quantity, Show, Unit, measured, pair

NO_VALUE = "none"


@dataclass(frozen=True, slots=True, kw_only=True)
class TableColumn:
    """A column: heading, unit below it, width in shares of the table, alignment, its field."""

    head: str
    unit: str = ""
    share: float = 1.0
    align: str = "right"
    field: str = ""


@dataclass(frozen=True, slots=True)
class UnitFormat:
    """Formats values, the preferred system of units first."""

    us_first: bool
    none: str = NO_VALUE
    systems: int = 2  # in which a table has a quantity: a narrow one has the first alone

    def both(
        self,
        value_si: float,
        quantity: Quantity = Quantity.DISPLACEMENT,
        show: Show = measured,
    ) -> str:
        """Return `81.6 in (2072 mm)`; `none` for NaN."""
        return self.none if math.isnan(value_si) else pair(value_si, quantity, self.us_first, show)

    def short(
        self,
        value_si: float,
        quantity: Quantity = Quantity.DISPLACEMENT,
        show: Show = measured,
    ) -> str:
        """Return a value with its unit in the preferred system; `none` for NaN."""
        unit = self.units(quantity)[0]
        return self.none if math.isnan(value_si) else f"{show(value_si, unit)} {unit.symbol}"

    def first(
        self,
        value_si: float,
        quantity: Quantity = Quantity.DISPLACEMENT,
        *,
        mark: str = "",
        show: Show = measured,
    ) -> str:
        """Return a value in the preferred system, without its unit; `none` for NaN."""
        return self.none if math.isnan(value_si) else show(value_si, self.units(quantity)[0]) + mark

    def units(self, quantity: Quantity = Quantity.DISPLACEMENT) -> tuple[Unit, Unit]:
        """Return the units of a quantity, the preferred one first."""
        return (quantity.us, quantity.si) if self.us_first else (quantity.si, quantity.us)
