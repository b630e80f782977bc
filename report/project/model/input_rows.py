"""An input as it was read: rows of values, each at its place, not yet checked against the others.

A value that could not be read is absent, so that one wrong cell hides no other fault.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Hashable, Iterable, Iterator, Mapping, Sequence
from typing import Any, NamedTuple

from report.text.typed_letters import foreign_letters, looks
from solver.suggestions import nearest


class Place(NamedTuple):
    """A cell by meaning: section, row of its table, field; without the last two, a whole table."""

    section: str
    row: int = 0
    field: str = ""


Where = Callable[[Place], str]
"""Returns the address of a place."""


InputRow = Mapping[str, Any]
"""Values of a row by field."""

Inputs = Mapping[str, Sequence[InputRow]]
"""Rows by section."""


def column(inputs: Inputs, sections: Iterable[str], field: str) -> Iterator[tuple[Place, Any]]:
    """Yield the readable cells of a field in the tables that have it, each with its place."""
    for section in sections:
        for index, row in enumerate(inputs[section]):
            if field in row:
                yield Place(section, index, field), row[field]


def repeated(
    cells: Iterable[tuple[Place, Any]], key: Callable[[Any], Hashable] = lambda value: value
) -> Iterator[tuple[Place, Any, Place]]:
    """Yield place and value of repeated entries, and the place of the first one."""
    places: dict[Hashable, Place] = {}
    for place, value in cells:
        first = places.setdefault(key(value), place)
        if first is not place:
            yield place, value, first


def suggestion(value: str, ids: Collection[str]) -> str:
    """Return text on the id that may have been meant, or on the existing ones."""
    same = next((name for name in ids if looks(name) == looks(value)), "")
    # Letters of two alphabets may look alike, so that the list would show the same name again.
    foreign = same and (foreign_letters(value) or foreign_letters(same))
    if foreign:
        return f"it looks like '{same}', but {foreign}: retype it"
    close = nearest(value, ids)
    if close:
        return f"did you mean '{close}'?"
    names = ", ".join(list(ids)[:8])
    return f"enter one of {names}" if names else "add it there first"
