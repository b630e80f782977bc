"""Values of options: numbers in their unit, and files and folders that must exist.

An error names the option as it was given, the value with its unit, and what is accepted. Options of
several commands are here as well.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import click

from report.cli.console import NOT_OK
from solver.suggestions import meant


class Number(click.ParamType[float]):
    """A finite number above a lower limit, or between two; its unit stands for it in the help."""

    name = "number"

    def __init__(
        self,
        unit: str = "",
        low: float = -math.inf,
        high: float = math.inf,
        *,
        is_open: bool = False,
    ) -> None:
        self._unit, self._low, self._high, self._is_open = unit, low, high, is_open

    def get_metavar(self, param: click.Parameter, ctx: click.Context) -> str | None:
        """Return the unit, if there is one."""
        return self._unit.upper() or None

    def convert(
        self, value: Any, param: click.Parameter | None, ctx: click.Context | None
    ) -> float:
        """Return the number."""
        # A default is the program's own, and may be NaN for none.
        if not isinstance(value, str):
            return float(value)
        number = float(click.FLOAT(value, param, ctx))
        is_limit = self._is_open and number in (self._low, self._high)
        if is_limit or not (math.isfinite(number) and self._low <= number <= self._high):
            unit = f" {self._unit}" if self._unit else ""
            self.fail(f"it is {number:g}{unit}; enter {self._accepted(unit)}.", param, ctx)
        return number

    def _accepted(self, unit: str) -> str:
        low, high = self._low, self._high
        if math.isinf(low):
            return "a finite number"
        if math.isinf(high):
            return f"more than {low:g}{unit}" if self._is_open else f"{low:g}{unit} or more"
        return f"more than {low:g}{unit} and less than {high:g}{unit}"


TIME_STEP = Number("s", 0.0, is_open=True)


class Existing(click.Path):
    """An existing file or folder."""

    def __init__(self, **kinds: bool) -> None:
        super().__init__(exists=True, path_type=Path, **kinds)

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """Return the path; suggest a similar one if it does not exist."""
        path = Path(value)
        if not path.exists() and (asked := meant(path)):
            self.fail(f"'{path}' does not exist; {asked}", param, ctx)
        return super().convert(value, param, ctx)


SOURCE = click.Path(path_type=Path)

# Of acceleration, of a file: `solver.records.record.UNIT_CHOICES`, which is slow to import.
UNITS = click.Choice(("g", "m/s2", "cm/s2", "mm/s2", "gal"))

QUIET = click.option("--quiet", is_flag=True, help="Print errors only.")
AS_JSON = click.option(
    "--json", "as_json", is_flag=True, help="Print JSON, with the units in the keys."
)
FAIL_ON_NG = click.option(
    "--fail-on-ng", is_flag=True, help=f"Exit with code {NOT_OK} if the verdict is not OK."
)


def reading(command: Callable[..., None]) -> Callable[..., None]:
    """Add the options for reading a record."""
    step = click.option("--dt", "dt_s", type=TIME_STEP, default=math.nan,
                        help="Time step, if the file has none.")  # fmt: skip
    units = click.option("--units", type=UNITS, help="Units, if the file does not state them.")
    return step(units(command))
