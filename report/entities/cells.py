"""How a field is a column of a sheet of results.xlsx.

Writes nothing: see `report.results.sheets`. Read `Column`.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from report.words.units import NEWTONS_PER_POUND
from solver.model import INCH_M


def _as_it_is(value: Any) -> Any:
    return value


_FROM_SI: Mapping[str, Callable[[Any], Any]] = {
    "in": lambda value_m: value_m / INCH_M,
    "mm": lambda value_m: value_m * 1e3,
    "lb": lambda value_n: value_n / NEWTONS_PER_POUND,
    "in/s": lambda value_mps: value_mps / INCH_M,
}
"""What a value in SI is in the units of a sheet; a value in another unit stays as it is."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Column:
    """A column of a sheet of results.xlsx.

    Attributes
    ----------
    head : str
        Heading with its unit; the unit alone, or nothing, below the heading of the field.
    decimals : int or None
        Of a number; None to show it as it is.
    formula : str
        Live formula, with names of fields of the row and of other cells in braces; empty for none.
    value : callable
        Returns what a cell holds of the value of the field.
    is_always : bool
        Whether the formula is written also where it gives no value.
    is_input : bool
        Whether what has no formula may be changed there.
    """

    head: str
    decimals: int | None
    formula: str
    value: Callable[[Any], Any]
    is_always: bool
    is_input: bool


def column(
    head: str = "",
    decimals: int | None = None,
    formula: str = "",
    *,
    value: Callable[[Any], Any] | None = None,
    is_always: bool = False,
    is_input: bool = False,
) -> Column:
    """Return how a field is a column of results.xlsx; a field may be several."""
    unit = head.partition("[")[2].rstrip("]")
    return Column(
        head=head,
        decimals=decimals,
        formula=formula,
        value=value or _FROM_SI.get(unit, _as_it_is),
        is_always=is_always,
        is_input=is_input,
    )
