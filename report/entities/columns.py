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
    """A column: heading, unit below it, width in shares of the table, alignment."""

    head: str
    unit: str = ""
    share: float = 1.0
    align: str = "right"


@dataclass(frozen=True, slots=True)
class UnitFormat:
    """Formats values, the preferred system of units first."""

    us_first: bool
    none: str = NO_VALUE

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

    def cells(
        self,
        value_si: float,
        quantity: Quantity = Quantity.DISPLACEMENT,
        *,
        mark: str = "",
        show: Show = measured,
    ) -> tuple[str, str]:
        """Return the value in both systems, for two columns; `none` for NaN."""
        if math.isnan(value_si):
            return self.none, self.none
        first, second = self.units(quantity)
        return show(value_si, first) + mark, show(value_si, second) + mark

    def units(self, quantity: Quantity = Quantity.DISPLACEMENT) -> tuple[Unit, Unit]:
        """Return the units of a quantity, the preferred one first."""
        return (quantity.us, quantity.si) if self.us_first else (quantity.si, quantity.us)

    def columns(
        self, head: str, quantity: Quantity = Quantity.DISPLACEMENT, share: float = 1.0
    ) -> tuple[TableColumn, TableColumn]:
        """Return the two columns of a quantity."""
        first, second = self.units(quantity)
        return (
            TableColumn(head=head, unit=first.symbol, share=share),
            TableColumn(head=head, unit=second.symbol, share=share),
        )
