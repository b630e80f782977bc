"""Values of options: numbers in their unit, and files and folders that must be there.

An error names the option as it was given, the value with its unit, and what is accepted. A group's
help lists its commands by section.
"""

from __future__ import annotations

import inspect
import math
from pathlib import Path
from typing import Any

import click

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
            self.fail(f"it is {number:g}{unit}; give {self._accepted(unit)}.", param, ctx)
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
    """A file or folder that is there."""

    def __init__(self, **kinds: bool) -> None:
        super().__init__(exists=True, path_type=Path, **kinds)

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """Return the path; ask for the one that may have been meant."""
        path = Path(value)
        if not path.exists() and (asked := meant(path)):
            self.fail(f"'{path}' does not exist; {asked}", param, ctx)
        return super().convert(value, param, ctx)


class SectionedGroup(click.Group):
    """A group whose commands stand under titles; those added without one, under "Commands"."""

    def __init__(self, *arguments: Any, **options: Any) -> None:
        super().__init__(*arguments, **options)
        self._titles: dict[str, str] = {}

    def add_section(self, title: str, *commands: click.Command) -> None:
        """Add commands under a title."""
        for command in commands:
            self.add_command(command)
            self._titles[str(command.name)] = title

    def list_commands(self, ctx: click.Context) -> list[str]:
        """Return the names in the order of their sections."""
        return [
            *self._titles,
            *(name for name in sorted(self.commands) if name not in self._titles),
        ]

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Write each section."""
        sections: dict[str, list[tuple[str, str]]] = {}
        names = self.list_commands(ctx)
        # The same in every section.
        width = max(map(len, names))
        for name in names:
            rows = sections.setdefault(self._titles.get(name, "Commands"), [])
            rows.append((name.ljust(width), _first_sentence(self.commands[name])))
        for title, rows in sections.items():
            with formatter.section(title):
                formatter.write_dl(rows)


def _first_sentence(command: click.Command) -> str:
    first, _, _ = inspect.cleandoc(command.help or "").partition("\n\n")
    return " ".join(first.split())
