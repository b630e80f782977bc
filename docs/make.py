"""Writes the pages and tables of these docs that the program can say of itself.

    .venv/bin/python docs/make.py

`commands.md` is the command line's own help, `workbook-fields.md` the schema of the input sheets
and `results-json.md` that of results.json, each with its further pages; `examples.md` lists the
scripts of `docs/examples` with their own first words. A test compares the pages with what this
would write.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from itertools import chain, starmap
from pathlib import Path
from typing import Any

import click

from report.cli.main import main
from report.entities import results
from report.sheet.schema import SECTIONS
from report.sheet.schema.fields import Entry, entries

HERE = Path(__file__).resolve().parent

EXAMPLES = (
    "slip", "two_axes", "design_curves", "least_friction", "workbook", "varied", "suite",
    "ground_to_roof", "fragility", "own_method", "newmark",
)  # fmt: skip


MOST_LINES = 244
"""Of a page; what is longer goes on with the next one."""

COMMANDS = "As `./roofslip COMMAND --help` prints them."
FIELDS = "Every sheet, block and table of the input workbook, as the reader checks them."
RESULTS = "All quantities are SI; a key ends with its unit. As JSON schema: `./roofslip schema`."

ATTRIBUTES = "\n\nAttributes\n----------\n"

Parts = Iterator[tuple[str, str]]
"""Headings, each with what is below it; `{Name}` is a link to the heading Name."""


def pages() -> Mapping[Path, str]:
    """Return every page that is made."""
    long = (
        ("commands", "Commands", COMMANDS, _commands()),
        ("workbook-fields", "Fields of the workbook", FIELDS, _fields()),
        ("results-json", "results.json", RESULTS, _results()),
    )
    made = dict(chain.from_iterable(starmap(_paged, long)))
    return {HERE / "examples.md": "\n".join(_examples())} | made


def _paged(name: str, title: str, about: str, parts: Parts) -> Iterator[tuple[Path, str]]:
    """Yield the pages of a long text, none longer than it may be."""
    made: list[list[tuple[str, str]]] = [[]]
    for part in parts:
        if sum(text.count("\n") + 4 for _, text in (*made[-1], part)) > MOST_LINES:
            made.append([])
        made[-1].append(part)
    files: list[str] = []
    titles: list[str] = []
    links: dict[str, str] = {}
    for count, page in enumerate(made, start=1):
        first, last = (heading.partition(":")[0] for heading, _ in (page[0], page[-1]))
        files.append(f"{name}-{count}.md" if count > 1 else f"{name}.md")
        titles.append(f"{title}, {first} to {last}" if count > 1 else title)
        links |= {f"{{{each}}}": f"[{each}]({files[-1]}#{each.lower()})" for each, _ in page}
    listed = [f"[{title}]({file})" for title, file in zip(titles, files, strict=True)]
    for file, title, page in zip(files, titles, made, strict=True):
        goes_on = f"{about} It goes on in {', '.join(listed[1:])}."
        head = goes_on if file == files[0] else f"Begins in {listed[0]}."
        text = "\n".join(f"## {heading}\n\n{text}\n" for heading, text in page)
        for mark, link in links.items():
            text = text.replace(mark, link)
        yield HERE / file, f"# {title}\n\n{head}\n\n{text}"


def _commands() -> Parts:
    for words, command in _named(main, ("roofslip",)):
        settings = main.context_settings | {"terminal_width": 96}
        context = click.Context(command, info_name=" ".join(words), **settings)
        yield " ".join(words[1:]) or "roofslip", f"```text\n{command.get_help(context)}\n```"


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


def _fields() -> Parts:
    for section in SECTIONS:
        place = "a table" if section.is_table else "single cells"
        fields = entries(section.model) if section.is_table else [row for _, row in section.rows]
        rows = "\n".join(map(_field, fields))
        yield (
            f"{section.sheet}: {section.title}",
            f"{_text(section.instruction)} ({place})\n\n"
            f"| field | need | unit | accepted | meaning |\n|---|---|---|---|---|\n{rows}",
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


def _results() -> Parts:
    schema = results.schema()
    models = schema["$defs"]
    for name, model in (("results.json", schema), *models.items()):
        if "properties" in model:
            told, _, attributes = model.get("description", "").partition(ATTRIBUTES)
            said = dict(_attributes(attributes))
            keys = [
                (f"`{key}`", _type(field, models), _text(_meaning(key, field, said)))
                for key, field in model["properties"].items()
            ]
            rows = [("key", "type", "meaning"), ("---",) * 3, *keys]
            table = "\n".join(f"| {' | '.join(row)} |" for row in rows)
            yield name, f"{_text(told)}\n\n{table}"


def _attributes(section: str) -> Iterator[tuple[str, str]]:
    """Yield the names of a section Attributes, each with its text, or its type if it has none."""
    for names, kind, text in re.findall(r"^(\S.*?) : (.*)((?:\n    .*)*)", section, re.M):
        yield from ((name, text or kind) for name in names.split(", "))


def _meaning(key: str, field: Mapping[str, Any], said: Mapping[str, str]) -> str:
    """Return what a field says of itself, or the heading or label under which it is shown."""
    return str(field.get("description") or said.get(key) or field["title"])


def _type(field: Mapping[str, Any], models: Mapping[str, Any]) -> str:
    """Return what a field holds; a link where that is described on its own."""
    if "$ref" in field:
        name = str(field["$ref"]).rpartition("/")[2]
        return f"{{{name}}}" if "properties" in models[name] else _type(models[name], models)
    if "anyOf" in field:
        return " or ".join(_type(each, models) for each in field["anyOf"])
    if "enum" in field:
        return "one of " + ", ".join(f"`{value}`" for value in field["enum"])
    if "items" in field:
        return f"list of {_type(field['items'], models)}"
    kind = field.get("const", field.get("type", "any"))
    return " or ".join(kind) if isinstance(kind, list) else str(kind)


def _text(text: str) -> str:
    return " ".join(text.split()).replace("|", "\\|").replace("<", "&lt;").replace("_", "\\_")


if __name__ == "__main__":
    for path, text in pages().items():
        path.write_text(text, encoding="utf-8")
