"""Writes the pages and tables of these docs that the program can say of itself.

    .venv/bin/python docs/make.py

`commands.md` is the command line's own help, `workbook-fields.md` the schema of the input sheets
and `results-json.md` that of results.json; `examples.md` lists the scripts of `docs/examples` with
their own first words. A test compares the pages with what this would write.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import click

from report.cli.main import main
from report.entities import results
from report.sheet.schema import SECTIONS
from report.sheet.schema.fields import Entry, SheetSection, entries

HERE = Path(__file__).resolve().parent

EXAMPLES = (
    "slip", "two_axes", "design_curves", "least_friction", "workbook", "suite", "ground_to_roof",
    "fragility", "own_method", "newmark",
)  # fmt: skip


def pages() -> Mapping[Path, str]:
    """Return every page that is made."""
    made = {
        "commands.md": _commands,
        "examples.md": _examples,
        "workbook-fields.md": _fields,
        "results-json.md": _results,
    }
    return {HERE / name: "\n".join(lines()) for name, lines in made.items()}


def _commands() -> Iterator[str]:
    yield "# Commands\n"
    yield "As `./roofslip COMMAND --help` prints them.\n"
    for words, command in _named(main, ("roofslip",)):
        settings = main.context_settings | {"terminal_width": 96}
        context = click.Context(command, info_name=" ".join(words), **settings)
        name = " ".join(words[1:]) or "roofslip"
        yield f"## {name}\n\n```text\n{command.get_help(context)}\n```\n"


def _named(command: click.Command, words: tuple[str, ...]) -> Iterator[tuple[tuple[str, ...], Any]]:
    yield words, command
    if isinstance(command, click.Group):
        for name, below in sorted(command.commands.items()):
            yield from _named(below, (*words, name))


def _examples() -> Iterator[str]:
    yield "# Examples\n"
    yield (
        "Scripts that run in the checkout, each in a minute or less. Jupyter (with jupytext) and "
        "editors that know `# %%` open them as notebooks. Each saves its plots where it runs.\n"
    )
    for name in EXAMPLES:
        title, *words = _first_cell(HERE / "examples" / f"{name}.py")
        yield f"## {title}\n\n{' '.join(words)}\n\n[`{name}.py`](examples/{name}.py)\n"


def _first_cell(path: Path) -> list[str]:
    """Return the title and the words of the first cell of a script, by line."""
    _, first, *_ = path.read_text(encoding="utf-8").split("# %%")
    lines = [line.removeprefix("#").strip() for line in first.splitlines()[1:]]
    title, *words = filter(None, lines)
    return [title.removeprefix("# "), *words]


def _fields() -> Iterator[str]:
    yield "# Fields of the workbook\n"
    yield "Every sheet, block and table of the input workbook, as the reader checks them.\n"
    yield from map(_section, SECTIONS)


def _section(section: SheetSection) -> str:
    place = "a table" if section.is_table else "single cells"
    rows = "\n".join(map(_field, entries(section.model)))
    return (
        f"## {section.sheet}: {section.title}\n\n{_text(section.instruction)} ({place})\n\n"
        f"| field | need | unit | accepted | meaning |\n|---|---|---|---|---|\n{rows}\n"
    )


def _field(entry: Entry) -> str:
    quantity = entry.quantity
    units = [unit.symbol for unit in dict.fromkeys(quantity.value)] if quantity else []
    accepted = ", ".join(entry.choices) or _range(entry)
    cells = (
        entry.cell.label,
        entry.need,
        " or ".join(units) if quantity else str(entry.cell.unit),
        accepted,
        entry.help,
    )
    return f"| {' | '.join(map(_text, cells))} |"


def _range(entry: Entry) -> str:
    sides = list(dict.fromkeys(entry.quantity.value)) if entry.quantity else []
    if not sides:
        return entry.bounds.words()
    said = [f"{entry.bounds.words(unit.si)} [{unit.symbol}]" for unit in sides]
    return "; ".join(said) if entry.bounds.words() else ""


def _results() -> Iterator[str]:
    schema = results.schema()
    yield "# results.json\n"
    yield "All quantities are SI; a key ends with its unit. As JSON schema: `./roofslip schema`.\n"
    for name, model in ({"results.json": schema} | schema["$defs"]).items():
        if "properties" in model:
            told = model.get("description", "").partition("\n\nAttributes\n")[0]
            yield f"## {name}\n\n{_text(told)}\n"
            yield "| key | type | meaning |\n|---|---|---|"
            for key, field in model["properties"].items():
                yield f"| `{key}` | {_text(_type(field))} | {_text(_meaning(key, field))} |"
            yield ""


def _meaning(key: str, field: Mapping[str, Any]) -> str:
    """Return the heading or label under which a field is shown, where it has one."""
    made = key.replace("_", " ").title()  # what pydantic makes of the key
    title = str(field.get("title", made))
    return "" if title == made else title


def _type(field: Mapping[str, Any]) -> str:
    if "$ref" in field:
        return str(field["$ref"]).rpartition("/")[2]
    if "anyOf" in field:
        return " or ".join(map(_type, field["anyOf"]))
    if "enum" in field:
        return "one of " + ", ".join(map(str, field["enum"]))
    if "items" in field:
        return f"list of {_type(field['items'])}"
    kind = field.get("const", field.get("type", "any"))
    return " or ".join(kind) if isinstance(kind, list) else str(kind)


def _text(text: str) -> str:
    return " ".join(text.split()).replace("|", "\\|").replace("<", "&lt;").replace("_", "\\_")


if __name__ == "__main__":
    for path, text in pages().items():
        path.write_text(text, encoding="utf-8")
