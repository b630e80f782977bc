"""Values of options: numbers in their unit, and files and folders that must be there.

An error names the option as it was given, the value with its unit, and what is accepted. A group's
help lists its commands by section.
"""

from __future__ import annotations

import inspect
import math
from collections.abc import Mapping
from importlib import import_module
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
        self._extras: dict[str, str] = {}  # module and attribute of commands not loaded, by name

    def add_section(self, title: str, *commands: click.Command | str) -> None:
        """Add commands under a title; those of an extra by their place, as `add_extra` has it."""
        for command in commands:
            if isinstance(command, str):
                name = self.add_extra(command)
            else:
                self.add_command(command)
                name = str(command.name)
            self._titles[name] = title

    def add_extra(self, place: str) -> str:
        """Add a command that is loaded when it is asked for; return its name.

        The place is that of its function: `report.cli.verify:verify_package`.
        """
        name = place.partition(":")[2].replace("_", "-")
        self._extras[name] = place
        return name

    def get_command(self, ctx: click.Context | None, cmd_name: str) -> click.Command | None:
        """Return a command by its name; one of an extra is loaded."""
        if place := self._extras.pop(cmd_name, ""):
            module, _, attribute = place.partition(":")
            self.add_command(getattr(import_module(module), attribute))
        return self.commands.get(cmd_name)

    def every(self) -> Mapping[str, click.Command]:
        """Return all commands by name, in the order in which they are listed."""
        for name in list(self._extras):
            self.get_command(None, name)
        untitled = sorted(self.commands.keys() - self._titles.keys())
        return {name: self.commands[name] for name in (*self._titles, *untitled)}

    def list_commands(self, ctx: click.Context) -> list[str]:
        """Return the names in the order of their sections."""
        return list(self.every())

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Write each section."""
        sections: dict[str, list[tuple[str, str]]] = {}
        commands = self.every()
        # The same in every section.
        width = max(map(len, commands))
        for name, command in commands.items():
            rows = sections.setdefault(self._titles.get(name, "Commands"), [])
            rows.append((name.ljust(width), _first_sentence(command)))
        for title, rows in sections.items():
            with formatter.section(title):
                formatter.write_dl(rows)


def _first_sentence(command: click.Command) -> str:
    first, _, _ = inspect.cleandoc(command.help or "").partition("\n\n")
    return " ".join(first.split())
