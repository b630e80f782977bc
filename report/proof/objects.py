"""Two PDFs compared object by object, from the root down. Knows no package. Read `differences`."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Set
from dataclasses import dataclass, field
from typing import Any

from pypdf import PdfReader
from pypdf.generic import (
    ArrayObject,
    DictionaryObject,
    IndirectObject,
    StreamObject,
)

Allowed = Callable[[str, Any, Any], bool]
"""Whether objects at a place may differ: place, object of the first PDF and of the second."""

MISSING = object()
"""Stands for the object that one of two PDFs does not have."""


def differences(first: PdfReader, second: PdfReader, allowed: Allowed) -> Iterator[str]:
    """Yield the places at which two PDFs differ, pages as `sheet 3`.

    Only what is reached from the root, and the information dictionary, are compared; streams are
    compared unpacked.
    """
    walk = _Walk(allowed)
    pages = zip(first.pages, second.pages, strict=False)
    for count, (one, two) in enumerate(pages, start=1):
        # First, and without the ways up, so that what belongs to a sheet is told by it.
        yield from walk.below(f"sheet {count}", one, two, skipped=_UPWARD)
    if len(first.pages) != len(second.pages):
        yield f"number of sheets: {len(first.pages)} and {len(second.pages)}"
    yield from walk.below("document", first.trailer["/Root"], second.trailer["/Root"])
    yield from walk.below("document /Info", *(information(pdf) for pdf in (first, second)))


def information(pdf: PdfReader) -> Any:
    """Return the information dictionary of a PDF, or `MISSING`."""
    found = pdf.trailer.get("/Info")
    return MISSING if found is None else found.get_object()


@dataclass
class _Walk:
    """Follows two graphs of objects side by side; each pair of them once."""

    allowed: Allowed
    seen: set[tuple[int, int]] = field(default_factory=set)

    def below(
        self, place: str, one: Any, two: Any, *, skipped: Set[str] = frozenset()
    ) -> Iterator[str]:
        pending = [(place, one, two)]
        while pending:
            place, one, two = pending.pop()
            one, two = self._resolved(one), self._resolved(two)
            if (id(one), id(two)) in self.seen or self.allowed(place, one, two):
                continue
            self.seen.add((id(one), id(two)))
            if one is MISSING or two is MISSING or type(one) is not type(two):
                yield place
            elif isinstance(one, DictionaryObject):
                pending += _entries(place, one, two, skipped)
                if isinstance(one, StreamObject) and one.get_data() != two.get_data():
                    yield place
            elif isinstance(one, ArrayObject):
                pending += _items(place, one, two)
            elif one != two:
                yield place

    @staticmethod
    def _resolved(item: Any) -> Any:
        return item.get_object() if isinstance(item, IndirectObject) else item


_UPWARD = {"/Parent", "/P"}
_PACKING = {"/Length", "/Filter", "/DecodeParms"}


def _entries(place: str, one: Any, two: Any, skipped: Set[str]) -> Iterator[tuple[str, Any, Any]]:
    if isinstance(one, StreamObject):
        skipped = skipped | _PACKING
    for key in dict.fromkeys((*one, *two)):
        if key in skipped:
            continue
        yield f"{place} {key}", one.get(key, MISSING), two.get(key, MISSING)


def _items(place: str, one: Any, two: Any) -> Iterator[tuple[str, Any, Any]]:
    for at in range(max(len(one), len(two))):
        yield (
            f"{place}[{at}]",
            one[at] if at < len(one) else MISSING,
            two[at] if at < len(two) else MISSING,
        )
