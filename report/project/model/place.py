"""The place of a value in an input, by what it means: no cell, which a user may move."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple


class Place(NamedTuple):
    """A cell by meaning: section, row of its table, field; without the last two, a whole table."""

    section: str
    row: int = 0
    field: str = ""


Where = Callable[[Place], str]
"""Returns the address of a place."""
