"""How a field is a column of a sheet of results.xlsx, and how its change is told by `--since`.

Writes and compares nothing: see `report.results.sheets` and `report.results.compare`.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from report.assessment.changes import ChangeKind
from report.words.units import NEWTONS_PER_POUND
from solver.model import INCH_M

_FROM_SI: Mapping[str, Callable[[Any], Any]] = {
    "in": lambda value_m: value_m / INCH_M,
    "mm": lambda value_m: value_m * 1e3,
    "lb": lambda value_n: value_n / NEWTONS_PER_POUND,
    "in/s": lambda value_mps: value_mps / INCH_M,
}
"""What a value in SI is in the units of a sheet; a value in another unit stays as it is."""


@dataclass(frozen=True, slots=True)
class Column:
    """A column of a sheet; a field may have several."""

    head: str = ""  # with its unit; the unit alone, or nothing, below the heading of the field
    decimals: int | None = None  # of a number; None to show it as it is
    # live, with names of fields of the row and of other cells in braces; empty for none
    formula: str = ""
    # returns what a cell holds of the value of the field, where the unit does not say it
    value: Callable[[Any], Any] | None = None
    is_always: bool = False  # whether the formula is written also where it gives no value
    is_input: bool = False  # whether what has no formula may be changed there

    def heading(self, of_field: str) -> str:
        """Return the heading, from that of the field where it has none of its own."""
        is_unit = not self.head or self.head.startswith("[")
        return f"{of_field} {self.head}".strip() if is_unit else self.head

    def held(self, value: Any) -> Any:
        """Return what a cell holds of the value of the field."""
        convert = self.value or _FROM_SI.get(self.head.partition("[")[2].rstrip("]"))
        return convert(value) if convert else value


@dataclass(frozen=True, slots=True)
class Told:
    """A change of a field, which marks its row in the package and may be listed."""

    kind: ChangeKind | None = None  # None if it is not listed
    title: str = ""  # what changed, with what it says of the `row` in braces
    # whether it is listed of a row that the former revision did not have, or that is gone
    of_new: bool = True
    of_gone: bool = False
