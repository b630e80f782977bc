"""Writes the pages and tables of these docs that the program can say of itself.

    .venv/bin/python docs/make.py

`commands.md` is the command line's own help and scripts, and `help` has them one by one, as the
launchers print them where nothing is installed;
`index.md` is the README; `workbook-fields*.md` is the schema of the input sheets,
`results-json.md` has the first keys of results.json, `known-errors.md` the errors of earlier
versions, `api.md` a table of the public names, and `examples.md` the scripts of `docs/examples`
with their own first words. A test compares the pages with what this would write.
"""

from __future__ import annotations

import inspect
import re
import tomllib
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import Any

import click
from click.shell_completion import get_completion_class

import report
from report.cli.commands.installation import VARIABLE
from report.cli.lazy_group import LazyGroup
from report.cli.main import main
from report.project.workbook import SECTIONS
from report.project.workbook.entries import Entry, rows_of
from report.provenance.known_errors import known_errors
from report.results.results_schema import schema
from report.text.grouping import grouped_by
from solver import public

HERE = Path(__file__).resolve().parent

EXAMPLES = (
    "slip", "two_axes", "design_curves", "least_friction", "workbook", "varied", "suite",
    "ground_to_roof", "fragility", "own_method", "newmark",
)  # fmt: skip


ATTRIBUTES = "\n\nAttributes\n----------\n"

MOTIONS = {"Motions", "Building", "Spectrum", "Options", "Acknowledged"}
"""Sheets of the second page of fields; the first one has the project and its roof."""

NOT_SI = {"g": "g, 9.80665 m/s²", "deg": "degrees", "percent": "percent", "km": "kilometers"}
"""Last words of keys of results.json whose value is in no SI unit."""

_NAMES = re.compile(r"(<!-- names -->\n).*?(<!-- end -->)", re.DOTALL)

Parts = Iterator[tuple[str, str]]
"""Headings, each with what is below it."""


def pages() -> Mapping[Path, str]:
    """Return every page that is made."""
    sheets = list(_fields())
    split = [part for part in sheets if part[0].partition(":")[0] in MOTIONS]
    roof = [part for part in sheets if part not in split]
    made = {
        "commands": _page(
            "Commands",
            "As `./roofslip COMMAND --help` and `./roofslip completion SHELL` print them.",
            (*_commands(), *_completions()),
        ),
        "workbook-fields": _page(
            "Fields of the workbook: project and roof",
            "As the reader checks them. Motions, building and options: "
            "[the other sheets](workbook-fields-motions.md).",
            roof,
        ),
        "workbook-fields-motions": _page(
            "Fields of the workbook: motions, building and options",
            "As the reader checks them. Project, site, arrays, objects and clearances: "
            "[the other sheets](workbook-fields.md).",
            split,
        ),
        "results-json": "\n".join(_results()),
        "examples": "\n".join(_examples()),
        "known-errors": _page(
            "Known errors",
            "Errors that could change a number, a verdict or a refusal, by the last version with "
            "them. Commits between releases that print the same version may also contain them. "
            "`./roofslip verify-package FILE.pdf` lists those that a package may have; the "
            "engineer of record decides whether an issued package is affected.",
            _errors(),
        ),
        "index": _home((HERE.parent / "README.md").read_text(encoding="utf-8")),
        "api": _NAMES.sub(
            lambda found: f"{found[1]}\n{_names()}\n\n{found[2]}",
            (HERE / "api.md").read_text(encoding="utf-8"),
        ),
    }
    made = {f"{name}.md": text for name, text in made.items()}
    helped = {f"help/{name}.txt": text for name, text in _helped()}
    return {HERE / name: text for name, text in (made | helped).items()}


def _helped() -> Parts:
    """Yield what the launchers print with nothing installed, each with the name of its file."""
    project = tomllib.loads((HERE.parent / "pyproject.toml").read_text(encoding="utf-8"))
    yield "version", f"roofslip, version {project['tool']['roofslip']['version']}\n"
    for heading, text in (*_commands(), *_completions()):
        name = heading.replace("Completion in", "completion").replace(" ", "-")
        yield name, text.removeprefix("```text\n").removesuffix("```")


def _home(readme: str) -> str:
    """Return the README as the first page of the site, which has no files of other folders."""
    return re.sub(r"\[([^]]+)\]\((?!docs/|http)[^)]+\)", r"\1", readme).replace("](docs/", "](")


def _page(title: str, about: str, parts: Iterable[tuple[str, str]]) -> str:
    text = "\n".join(f"## {heading}\n\n{text}\n" for heading, text in parts)
    return f"# {title}\n\n{about}\n\n{text}"


def _commands() -> Parts:
    for words, command in _named(main, ("roofslip",)):
        settings = main.context_settings | {"terminal_width": 96}
        context = click.Context(command, info_name=" ".join(words), **settings)
        yield " ".join(words[1:]) or "roofslip", f"```text\n{command.get_help(context)}\n```"


def _completions() -> Parts:
    for shell in ("bash", "zsh", "fish"):
        script = get_completion_class(shell)(main, {}, "roofslip", VARIABLE).source()
        yield f"Completion in {shell}", f"```text\n{script.rstrip()}\n```"


def _errors() -> Parts:
    for until, errors in grouped_by(known_errors(), lambda error: error.until).items():
        rows = [f"| {error.error} | {error.effect} | {error.action} |" for error in errors]
        yield (
            f"Through version {until}",
            "\n".join(("| error | effect | what to do |", "|---|---|---|", *rows)),
        )


def _named(command: click.Command, words: tuple[str, ...]) -> Iterator[tuple[tuple[str, ...], Any]]:
    yield words, command
    if isinstance(command, LazyGroup):
        for name, below in sorted(command.every().items()):
            yield from _named(below, (*words, name))


def _names() -> str:
    """Return the public names, and the keys of the two mappings among them."""
    offered = [*((public, name) for name in public.__all__), *((report, n) for n in report.__all__)]
    objects = {name: getattr(package, name) for package, name in offered}
    rows = ["| function | does |", "|---|---|"]
    for name, found in objects.items():
        if inspect.isfunction(found):
            stars = {inspect.Parameter.VAR_POSITIONAL: "*", inspect.Parameter.VAR_KEYWORD: "**"}
            parameters = inspect.signature(found).parameters.values()
            given = ", ".join(f"{stars.get(each.kind, '')}{each.name}" for each in parameters)
            rows.append(f"| `{name}({given})` | {_first(found)} |")
    rows += ["", "| class | is |", "|---|---|"]
    rows += [
        f"| `{n}` | {_first(found)} |" for n, found in objects.items() if inspect.isclass(found)
    ]
    keys = ", ".join(f'`"{key}"`' for key in public.EDITIONS)
    rows += ["", f"Keys of `EDITIONS`: {keys}. Keys of `METHODS`, the methods in one axis:", ""]
    rows += ["| key | method | parameters |", "|---|---|---|"]
    for key, method in public.METHODS.items():
        given = ", ".join(f"`{name}` = {value:g}" for name, value in method.parameters.items())
        rows.append(f'| `"{key}"` | {method.title} | {given} |')
    return "\n".join(rows)


def _first(found: object) -> str:
    sentence = (inspect.getdoc(found) or "").partition("\n\n")[0]
    return " ".join(sentence.split()).replace("|", "\\|")


def _examples() -> Iterator[str]:
    yield "# Examples\n"
    yield (
        "Run a script in this folder with `.venv/bin/python docs/examples/slip.py` (on Windows, "
        "`.venv\\Scripts\\python docs\\examples\\slip.py`). Jupyter with jupytext, and editors "
        "that support `# %%`, open the scripts as notebooks. Each saves its plots in the current "
        "folder. "
        "`fragility.py` needs SciPy, which the first `./roofslip study` installs.\n"
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
        fields = [entry for _, entry in rows_of(section, SECTIONS)]
        rows = "\n".join(map(_field, fields))
        yield (
            f"{section.sheet}: {section.title}",
            f"{_text(section.note)} ({place})\n\n"
            f"| field | meaning | need | unit | accepted |\n|---|---|---|---|---|\n{rows}",
        )


def _field(entry: Entry) -> str:
    quantity = entry.quantity
    units = [unit.symbol for unit in dict.fromkeys(quantity.value)] if quantity else []
    accepted = ", ".join(entry.choices) or _range(entry)
    cells = (
        entry.heading,
        entry.note,
        entry.needed,
        " or ".join(units) if quantity else str(entry.unit),
        accepted,
    )
    return f"| {' | '.join(map(_text, cells))} |"


def _range(entry: Entry) -> str:
    sides = list(dict.fromkeys(entry.quantity.value)) if entry.quantity else []
    if not sides:
        return entry.bounds.words()
    said = [f"{entry.bounds.words(unit.si)} [{unit.symbol}]" for unit in sides]
    return "; ".join(said) + entry.or_zero if entry.bounds.words() else ""


RESULTS = """# results.json

All results of a package. `./roofslip schema` prints its JSON schema: every key of every object with
its type, and below `description` what it means:

```sh
./roofslip schema > results.schema.json
```

A key ends with its unit, in SI: `_m`, `_s`, `_rad`, `_n`, `_pa`, `_mps`, `_mps2`; a key without one
is a count, a ratio, a text or an object. Keys in other units:
"""


def _results() -> Iterator[str]:
    written = schema()
    models = written["$defs"]
    objects = [model.get("properties", {}) for model in (written, *models.values())]
    keys = sorted({key for each in objects for key in each})
    yield RESULTS
    for unit, words in NOT_SI.items():
        found = [f"`{key}`" for key in keys if key.endswith(f"_{unit}")]
        yield f"- {words}: {', '.join(found)}"
    yield (
        "- as typed: `slope_value` in `slope_unit`, `scale_value` (a factor, or a PPA in g), and "
        "the `value` of an override"
    )
    said = attributes(written)
    yield "\nThe file itself, an object with these keys:\n"
    yield "| key | holds | meaning |\n|---|---|---|"
    for key, field in written["properties"].items():
        yield f"| `{key}` | {_type(field, models)} | {_text(meaning(key, field, said))} |"
    yield (
        "\n`schema_version` is increased if the name or meaning of a key changes. "
        "`report --since` reads files of this version and of the previous one, whose checks are "
        "not compared.\n"
    )


def attributes(model: Mapping[str, Any]) -> Mapping[str, str]:
    """Return what the section Attributes of a model says of each, or its type alone."""
    section = model.get("description", "").partition(ATTRIBUTES)[2]
    return {
        name: text or kind
        for names, kind, text in re.findall(r"^(\S.*?) : (.*)((?:\n    .*)*)", section, re.M)
        for name in names.split(", ")
    }


def meaning(key: str, field: Mapping[str, Any], said: Mapping[str, str]) -> str:
    """Return what a field says of itself, or the heading or label under which it is shown."""
    return str(field.get("description") or said.get(key) or field["title"])


def _type(field: Mapping[str, Any], models: Mapping[str, Any]) -> str:
    """Return what a field holds; an object by its name in the schema."""
    if "$ref" in field:
        name = str(field["$ref"]).rpartition("/")[2]
        return f"`{name}`" if "properties" in models[name] else _type(models[name], models)
    if "anyOf" in field:
        return " or ".join(_type(each, models) for each in field["anyOf"])
    if "enum" in field:
        return "one of " + ", ".join(f"`{value}`" for value in field["enum"])
    if "items" in field:
        return f"list of {_type(field['items'], models)}"
    kind = field.get("const", field.get("type", "any"))
    return " or ".join(kind) if isinstance(kind, list) else str(kind)


def _text(text: str) -> str:
    escaped = {"|": "&#124;", "<": "&lt;", "_": "\\_"}
    return " ".join(text.split()).translate(str.maketrans(escaped))


if __name__ == "__main__":
    for path, text in pages().items():
        path.parent.mkdir(exist_ok=True)
        path.write_text(text, encoding="utf-8")
