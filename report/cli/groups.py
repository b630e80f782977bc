"""A group of commands whose help lists them by section, each with its whole first sentence.

click cuts these sentences at the end of the line. Read `SectionedGroup`.
"""

from __future__ import annotations

import inspect
from typing import Any

import click


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
        width = max(map(len, names))  # the same in every section
        for name in names:
            rows = sections.setdefault(self._titles.get(name, "Commands"), [])
            rows.append((name.ljust(width), _first_sentence(self.commands[name])))
        for title, rows in sections.items():
            with formatter.section(title):
                formatter.write_dl(rows)


def _first_sentence(command: click.Command) -> str:
    first, _, _ = inspect.cleandoc(command.help or "").partition("\n\n")
    return " ".join(first.split())
