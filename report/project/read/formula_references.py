"""The cells and names that a formula refers to."""

from __future__ import annotations

import re
from collections.abc import Sequence
from functools import lru_cache

from openpyxl.formula import Tokenizer
from openpyxl.formula.tokenizer import Token, TokenizerError

_COMPUTED = re.compile(r":|\b(?:INDIRECT|OFFSET|TABLE)\b", re.IGNORECASE)


# The rows of a table have the same formula.
@lru_cache(maxsize=1024)
def references(formula: str) -> Sequence[str]:
    """Return the cells and names that a formula refers to; one is empty where it computes some."""
    try:
        tokens: Sequence[Token] = Tokenizer(formula).items
    except (TokenizerError, IndexError):  # the second of a bracket that closes nothing
        return [""]
    operators = "".join(token.value for token in tokens if token.type != Token.OPERAND)
    if not tokens or _COMPUTED.search(operators):
        return [""]
    return [token.value for token in tokens if token.subtype == Token.RANGE]
