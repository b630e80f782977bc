"""Headings of the columns of a table, each with the format of its values. Read `ColumnHead`."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any

from report.text.unit_format import UnitFormat
from report.text.units import Quantity, Show, Unit, measured, no_less, no_more, number


@dataclass(frozen=True, slots=True, kw_only=True)
class TableColumn:
    """A column: heading, unit below it, width in shares of the table, alignment."""

    head: str
    unit: str = ""
    share: float = 1.0
    align: str = "right"


@dataclass(frozen=True, slots=True, kw_only=True)
class ColumnHead:
    """The heading of a column and the format of its values: a quantity, or else text."""

    head: str
    unit: str = ""
    quantity: Quantity | None = None
    text: Callable[[Any], str] = str
    align: str = "right"
    share: float = 1.0
    show: Show = measured  # how a quantity is rounded

    def units(self, fmt: UnitFormat) -> tuple[Unit, ...]:
        """Return the unit of its column, or of one for each system of units."""
        of_text = Unit(self.unit, 1.0, 0)
        return fmt.units(self.quantity)[: fmt.systems] if self.quantity else (of_text,)

    def columns(self, fmt: UnitFormat) -> tuple[TableColumn, ...]:
        """Return its column, or one for each system of units."""
        return tuple(
            TableColumn(head=self.head, unit=unit.symbol, align=self.align, share=self.share)
            for unit in self.units(fmt)
        )

    def cells(
        self, value: Any, none: str, units: Sequence[Unit], mark: str = "", show: Show | None = None
    ) -> list[str]:
        """Return a value for print in each of its units, or `none` for NaN."""
        if isinstance(value, float) and math.isnan(value):
            return [none] * len(units)
        # A text is shown as it is, also in place of a quantity.
        if isinstance(value, str) or not self.quantity:
            text = value if isinstance(value, str) else self.text(value)
            return [text + mark if mark else text] * len(units)
        cells, show = [], show or self.show
        for unit in units:
            cells.append(show(value, unit) + mark)
        return cells


def words(head: str, share: float = 1.0) -> ColumnHead:
    """Return the head of a text column."""
    return ColumnHead(head=head, align="left", share=share)


def weight(head: str, share: float = 1.0, show: Show = measured) -> ColumnHead:
    """Return the head of a column of weights."""
    return ColumnHead(head=head, quantity=Quantity.WEIGHT, share=share, show=show)


def length(head: str, share: float = 1.0, show: Show = measured) -> ColumnHead:
    """Return the head of a column of displacements or sizes."""
    return ColumnHead(head=head, quantity=Quantity.DISPLACEMENT, share=share, show=show)


required = partial(length, show=no_less)
"""Of lengths that are required, or that a requirement follows from: rounded up."""

provided = partial(length, show=no_more)
"""Of lengths that are provided: rounded down."""


def text(head: str, unit: str = "", share: float = 1.0) -> ColumnHead:
    """Return the head of a column of finished texts, aligned like numbers."""
    return ColumnHead(head=head, unit=unit, share=share)


def plain(head: str, decimals: int = 2, unit: str = "", share: float = 1.0) -> ColumnHead:
    """Return the head of a column of numbers with only one unit or none."""
    return ColumnHead(head=head, unit=unit, text=partial(number, decimals=decimals), share=share)


def centered(head: str, share: float = 1.0) -> ColumnHead:
    """Return the head of a column of verdicts."""
    return ColumnHead(head=head, align="center", share=share)
