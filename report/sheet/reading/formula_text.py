"""Whether two formulas are the same but for how a program writes them.

LibreOffice writes numbers with 15 digits and no quotes around sheet names; Excel writes small
numbers with an exponent, and one column in single brackets. Read `canonical`.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

from openpyxl.formula import Tokenizer
from openpyxl.formula.tokenizer import Token, TokenizerError

_ONE_COLUMN = re.compile(r"\[(\[(?:'.|[^\[\]'])*\])\]")
_BETWEEN = re.compile(r"\]\s*,\s*\[")
_CELL = re.compile(r"(\$?[A-Z]{1,3}\$?)(\d+)")
_SHEET = re.compile(r"(?<!')'((?:[^']|'')++)'!")
_NEWER = "_xlfn."
_COMPUTED = re.compile(r":|\b(?:INDIRECT|OFFSET|TABLE)\b", re.IGNORECASE)


def canonical(formula: str) -> str:
    """Return a formula in the form that is compared; one that no program reads as it is."""
    return "".join(map(_written, tokens)) if (tokens := _tokens(formula)) else formula


def _tokens(formula: str) -> Sequence[Token]:
    """Return the tokens of a formula; none of one that no program reads."""
    try:
        tokens: Sequence[Token] = Tokenizer(formula).items
    except (TokenizerError, IndexError):  # the second of a bracket that closes nothing
        return ()
    return tokens


def moved(formula: str, rows: int) -> str:
    """Return a formula with the references to its own sheet moved down, absolute ones as well.

    One that no program reads stays as it is.
    """
    if not (tokens := _tokens(formula)):
        return formula
    for token in tokens:
        if token.subtype == Token.RANGE and not re.search(r"[!\[]", token.value):
            matches = [(cell, _CELL.fullmatch(cell)) for cell in token.value.split(":")]
            token.value = ":".join(f"{m[1]}{int(m[2]) + rows}" if m else c for c, m in matches)
    return "=" + "".join(token.value for token in tokens)


def references(formula: str) -> Sequence[str]:
    """Return the cells and names that a formula refers to; one is empty where it computes some."""
    tokens = _tokens(formula)
    others = "".join(token.value for token in tokens if token.type != Token.OPERAND)
    if not tokens or _COMPUTED.search(others):
        return [""]
    return [token.value for token in tokens if token.subtype == Token.RANGE]


def _written(token: Token) -> str:
    text = str(token.value)
    match token.type, token.subtype:
        case Token.OPERAND, Token.TEXT:
            return text
        case Token.OPERAND, Token.NUMBER:
            return f"{float(text):.12g}"
        case Token.OPERAND, Token.RANGE:
            return _range(text)
        case Token.WSPACE, _:
            return ""
        case _:
            return text.casefold().removeprefix(_NEWER)


def _range(text: str) -> str:
    """Return cells, a name or a column of a table as they are compared."""
    if sheet := _SHEET.match(text):
        text = f"{sheet[1]}!{text[sheet.end() :]}".replace("''", "'")
    before, bracket, columns = text.partition("[")
    columns = _BETWEEN.sub("],[", " ".join(f"{bracket}{columns}".split()))
    one = _ONE_COLUMN.fullmatch(columns)
    return f"{before.replace('$', '')}{one[1] if one else columns}".casefold()
