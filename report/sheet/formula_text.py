"""Whether two formulas are the same but for how a program writes them.

LibreOffice writes numbers with 15 digits and no quotes around sheet names; Excel writes small
numbers with an exponent, and one column in single brackets. Read `canonical`.
"""

from __future__ import annotations

import re

_TOKEN = re.compile(
    r"""
    (?P<text>"(?:[^"]|"")*")
    | (?P<sheet>'(?:[^']|'')+'(?=!))
    | (?P<column>\[(?:'.|[^\[\]']|\[(?:'.|[^\[\]'])*\])*\])
    | (?P<word>[A-Za-z_\\$][\w.\\$]*)
    | (?P<number>(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)
    | (?P<space>\s+)
    | (?P<other>.)
    """,
    re.VERBOSE | re.DOTALL,
)
_ONE_COLUMN = re.compile(r"\[\[(?:'.|[^\[\]'])*\]\]")
_BETWEEN = re.compile(r"\]\s*,\s*\[")
_CELL = re.compile(r"(\$?[A-Z]{1,3}\$?)(\d+)")
_NEWER = "_xlfn."


def canonical(formula: str) -> str:
    """Return a formula in the form that is compared."""
    return "".join(_written(match) for match in _TOKEN.finditer(formula))


def moved(formula: str, rows: int) -> str:
    """Return a formula with the references to its own sheet moved down, absolute ones as well."""
    parts, before = [], ""
    for match in _TOKEN.finditer(formula):
        cell = _CELL.fullmatch(match[0]) if before != "!" else None
        before = match[0]
        parts.append(f"{cell[1]}{int(cell[2]) + rows}" if cell else match[0])
    return "".join(parts)


def _written(match: re.Match[str]) -> str:
    token = match[0]
    match match.lastgroup:
        case "text":
            return token
        case "sheet":
            return token[1:-1].replace("''", "'").casefold()
        case "column":
            name = _BETWEEN.sub("],[", " ".join(token.split())).casefold()
            return name[1:-1] if _ONE_COLUMN.fullmatch(name) else name
        case "number":
            return f"{float(token):.12g}"
        case "space":
            return ""
        case _:
            return token.replace("$", "").casefold().removeprefix(_NEWER)
