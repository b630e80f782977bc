"""The templates of documents, with the filters used in their text.

A template prints the dict that its page returns and calls no method; filters are plain functions of
values. Owns no content.
"""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import suppress
from functools import cache
from importlib.metadata import version
from pathlib import Path
from typing import TYPE_CHECKING, Any

from markupsafe import Markup

from report.text.counts import numbered, thousands
from report.text.error_text import general, scientific
from report.text.names import joined, named, shortened
from report.text.units import number, ratio
from report.typeset.equations import data_uri, formula, symbol

if TYPE_CHECKING:
    from jinja2 import BytecodeCache, Environment


_HERE = Path(__file__).resolve().parents[2]


_FILTERS = (
    data_uri, formula, general, joined, named, number, numbered, ratio, scientific, shortened,
    symbol, thousands,
)  # fmt: skip


def rendered(folder: Path, name: str, context: Mapping[str, Any]) -> str:
    """Return a document from a template of a folder."""
    return _environment(folder).get_template(name).render(context)


@cache
def _environment(folder: Path) -> Environment:
    """Return the templates of a folder, compiled once per process."""
    from jinja2 import Environment, FileSystemLoader, StrictUndefined

    environment = Environment(
        loader=FileSystemLoader(folder),
        # Compiled anew in each process, templates took 9% of the processor time of a report.
        bytecode_cache=_kept(folder / "__pycache__"),
        # A name that is missing is an error: an empty place would go unseen under a seal.
        undefined=StrictUndefined,
        autoescape=True,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.filters |= {function.__name__: function for function in _FILTERS}
    environment.filters["needs_a_line"] = _needs_a_line
    return environment


def _kept(folder: Path) -> BytecodeCache:
    """Return the cache folder of compiled templates, next to Python's own."""
    from jinja2 import FileSystemBytecodeCache
    from jinja2.bccache import Bucket

    # What a filter makes of a constant is part of a compiled template.
    code = f"{version('jinja2')} {state_of(_HERE / 'report', _HERE / 'solver')}"

    class Kept(FileSystemBytecodeCache):
        def get_source_checksum(self, source: str) -> str:
            return super().get_source_checksum(code + source)

        def dump_bytecode(self, bucket: Bucket) -> None:
            with suppress(OSError):  # another user's folder, or a full disk
                folder.mkdir(exist_ok=True)
                super().dump_bytecode(bucket)

    return Kept(str(folder))


def state_of(*folders: Path) -> str:
    """Return a fingerprint of all modules in folders: names, sizes and times of writing."""
    modules = sorted((str(path), path.stat()) for top in folders for path in top.rglob("*.py"))
    return str([(name, stat.st_size, stat.st_mtime_ns) for name, stat in modules])


# Length of numbers that fit beside an equation.
SHORT_LETTERS = 64


def _needs_a_line(numbers: Markup) -> bool:
    """Return whether the numbers of an equation are too long to fit beside it; notes wrap."""
    rows = (row for row in numbers.split("</div>") if 'class="small"' not in row)
    # Tags take no room.
    return any(len(row.striptags()) > SHORT_LETTERS for row in rows)
