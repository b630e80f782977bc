"""The templates of documents, with the filters that their prose uses.

Words are in the templates and numbers in Python: a filter prints a number as every page does.
A template that is given the data of a package calls it `p`. Owns no content.
"""

from __future__ import annotations

import hashlib
import math
import os
import sys
from collections.abc import Mapping
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

from jinja2 import pass_context
from markupsafe import Markup

from report.assessment.friction import mu_words
from report.assessment.friction_rows import basis_words
from report.assessment.precheck import limit_value
from report.document.tables import Table, merged, stamp, table_of
from report.entities.linked import ratio_up
from report.entities.marks import dagger
from report.typeset.equations import data_uri, fraction, symbol
from report.words.counts import capitalized, counted, joined, lowered, named, ranged, spelled
from report.words.formats import general, percent, scientific, seconds, shortened
from report.words.letters import below_mm, power_above
from report.words.units import Quantity, digits_down, digits_up, number, ratio
from solver.rules.limit import Limit

if TYPE_CHECKING:
    from jinja2 import BytecodeCache, Environment
    from jinja2.runtime import Context

    from report.sheet.schema import Array


def rendered(folder: Path, name: str, context: Mapping[str, Any]) -> str:
    """Return a document from a template of a folder."""
    return _environment(folder).get_template(name).render(context)


def sentence(folder: Path, name: str, *about: object) -> str:
    """Return a sentence that pages and the screen share, from `sentences.html`, as plain text."""
    macros = _environment(folder).get_template("sentences.html").module
    return " ".join(Markup(getattr(macros, name)(*about)).unescape().split())


def said(folder: Path, path: str, name: str, context: Mapping[str, Any]) -> str:
    """Return what a macro of a template says, as plain text: for tables and the screen."""
    module = _environment(folder).get_template(path).make_module(dict(context))
    return Markup(getattr(module, name)()).unescape().strip()


@cache
def _environment(folder: Path) -> Environment:
    """Return the templates of a folder, which are compiled once in a process."""
    from jinja2 import Environment, FileSystemLoader, StrictUndefined

    environment = Environment(
        loader=FileSystemLoader(folder),
        undefined=StrictUndefined,
        autoescape=True,
        trim_blocks=True,
        lstrip_blocks=True,
        optimized=False,  # or what a filter gave of a constant would be kept with the code
        bytecode_cache=_kept_code(Path(__file__)),
    )
    environment.filters |= {
        "below_mm": below_mm,
        "both": _both,
        "capitalized": capitalized,
        "clause": _clause,
        "counted": counted,
        "data_uri": data_uri,
        "degrees": lambda value_rad, decimals: number(math.degrees(value_rad), decimals),
        "dagger": dagger,
        "digits_down": digits_down,
        "digits_up": digits_up,
        "friction": mu_words,
        "friction_basis": _friction_basis,
        "general": general,
        "joined": joined,
        "lowered": lowered,
        "mark": _mark,
        "merged": merged,
        "named": named,
        "needs_a_line": _needs_a_line,
        "number": number,
        "percent": percent,
        "power_above": power_above,
        "of_check": _of_check,
        "ranged": ranged,
        "ratio": ratio,
        "ratio_up": ratio_up,
        "rule_length": _rule_length,
        "scientific": scientific,
        "seconds": seconds,
        "shortened": shortened,
        "spelled": spelled,
        "stamp": stamp,
        "symbol": symbol,
    }
    environment.tests |= {"infinite": math.isinf, "nan": math.isnan}
    environment.globals |= {"fraction": fraction, "rows": _rows}
    return environment


def _kept_code(module: Path) -> BytecodeCache | None:
    """Return where compiled templates are kept, as Python keeps the code of this module.

    By the hash of the module, which says how templates are compiled; that of the template is kept.
    """
    from jinja2 import FileSystemBytecodeCache

    folder = module.with_name("__pycache__")
    if sys.dont_write_bytecode or not os.access(folder, os.W_OK):
        return None
    how = hashlib.sha256(module.read_bytes()).hexdigest()[:12]
    return FileSystemBytecodeCache(str(folder), f"template-{how}-%s.cache")


SHORT_LETTERS = 64
"""Length of numbers that fit beside an equation."""


def _needs_a_line(numbers: Markup) -> bool:
    """Return whether the numbers of an equation are too long to stand beside it; notes wrap."""
    rows = (row for row in numbers.split("</div>") if 'class="small"' not in row)
    return any(len(row.striptags()) > SHORT_LETTERS for row in rows)


@pass_context
def _both(context: Context, value_si: float, quantity: str = "DISPLACEMENT") -> str:
    """Return a value in both systems of units: `81.6 in (2072 mm)`."""
    said: str = context["p"].fmt.both(value_si, Quantity[quantity])
    return said


@pass_context
def _friction_basis(context: Context, array: Array) -> str:
    return basis_words(context["p"].data, array)


@pass_context
def _mark(context: Context, key: str) -> str:
    said: str = context["p"].mark(key)
    return said


@pass_context
def _clause(context: Context, key: str) -> str:
    """Return the clause of a provision with its marks."""
    said: str = context["p"].clause(key)
    return said


@pass_context
def _of_check(context: Context, value: float, check: Limit) -> str:
    """Return a number of a check with the units of its measure."""
    return limit_value(check, value, context["p"].fmt.us_first)


@pass_context
def _rule_length(context: Context, key: str) -> str:
    """Return a length of the rule set in both systems of units, with its marks."""
    said: str = context["p"].fmt.both(context["p"].assessment.rules.length_m(key))
    return said + _mark(context, key)


@pass_context
def _rows(context: Context, entities: Any, names: str, **how: Any) -> Table:
    """Return rows of an entity as a table of the named fields."""
    return table_of(entities, names, how.pop("fmt", context["p"].fmt), **how)
