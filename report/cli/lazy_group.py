"""A group of commands that imports the module of a command on first use.

    main.add_section("Package", "report.cli.commands.project:report")

A module of `report.cli.commands` contains the options of a command and imports the code that does
its work only when it runs; help and completion import only click.
"""

from __future__ import annotations

import inspect
from collections.abc import Mapping
from importlib import import_module

import click


class LazyGroup(click.Group):
    """A group whose commands are listed under titles, each given by its module and function."""

    def __init__(self, **options: object) -> None:
        super().__init__(**options)  # type: ignore[arg-type]
        self._sections: dict[str, list[str]] = {}
        self._modules: dict[str, str] = {}

    def add_section(self, title: str, *commands: str) -> None:
        """Add commands under a title, each as `report.cli.commands.trust:sign`."""
        for command in commands:
            module, _, function = command.partition(":")
            name = function.replace("_", "-")
            self._sections.setdefault(title, []).append(name)
            self._modules[name] = module

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        """Return a command by its name, from its module."""
        if cmd_name not in self.commands and cmd_name in self._modules:
            module = import_module(self._modules[cmd_name])
            # From here on click has it, as any group does.
            self.add_command(getattr(module, cmd_name.replace("-", "_")))
        return super().get_command(ctx, cmd_name)

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        """Find the command; click suggests one of those loaded for a name that does not exist."""
        if args[0] not in self._modules:
            self.every()
        return super().resolve_command(ctx, args)

    def list_commands(self, ctx: click.Context) -> list[str]:
        """Return the names in the order of their sections."""
        return list(self._modules)

    def every(self) -> Mapping[str, click.Command]:
        """Return all commands by name, in listed order."""
        context = click.Context(self)
        commands = {}
        for name in self._modules:
            command = self.get_command(context, name)
            assert command is not None  # by `add_section`
            commands[name] = command
        return commands

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Write each section: its commands, with the first sentence of their help."""
        commands = self.every()
        width = max(map(len, commands))  # the same in every section
        for title, names in self._sections.items():
            rows = []
            for name in names:
                first, _, _ = inspect.cleandoc(commands[name].help or "").partition("\n\n")
                rows.append((name.ljust(width), " ".join(first.split())))
            with formatter.section(title):
                formatter.write_dl(rows)
