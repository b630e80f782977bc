"""Two PDFs compared object by object, from the root down. Knows no package. Read `differences`."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Set
from dataclasses import dataclass, field
from itertools import zip_longest
from typing import Any

from pypdf import PdfReader
from pypdf.generic import (
    ArrayObject,
    DictionaryObject,
    IndirectObject,
    StreamObject,
)

from report.sheet.reading.archive import MAX_TOTAL, MB
from solver.model import InputError

Allowed = Callable[[str, Any, Any], bool]
"""Whether objects at a place may differ: place, object of the first PDF and of the second.

The data of a stream are asked for apart from its entries, at the place with ` stream` behind it.
"""

MISSING = object()
"""Stands for the object that one of two PDFs does not have."""

MOST_UNPACKED = 4 * MAX_TOTAL
"""Bytes of all streams of two PDFs beyond which they are not unpacked further."""


def differences(
    first: PdfReader, second: PdfReader, allowed: Allowed = lambda *_: False
) -> Iterator[str]:
    """Yield the places at which two PDFs differ, pages as `sheet 3`.

    Only what is reached from the root, the information dictionary and the encryption are compared;
    streams are compared unpacked.

    Raises
    ------
    InputError
        If their streams are larger than those of any package.
    """
    walk = _Walk(allowed)
    pages = zip(first.pages, second.pages, strict=False)
    for count, (one, two) in enumerate(pages, start=1):
        # First, and without the ways up, so that what belongs to a sheet is told by it.
        yield from walk.below(f"sheet {count}", one, two, later=_UPWARD)
    if len(first.pages) != len(second.pages):
        yield f"number of sheets: {len(first.pages)}, not {len(second.pages)}"
    yield from walk.below("document", first.trailer["/Root"], second.trailer["/Root"])
    for key in ("/Info", "/Encrypt"):
        yield from walk.below(f"document {key}", *(entry(pdf, key) for pdf in (first, second)))
    for place, one, two in walk.upward:
        yield from walk.below(place, one, two)


def entry(pdf: PdfReader, key: str) -> Any:
    """Return an entry of the trailer of a PDF, or `MISSING`."""
    found = pdf.trailer.get(key)
    return MISSING if found is None else resolved(found)


def resolved(item: Any) -> Any:
    """Return the object that a reference stands for, anything else as it is."""
    return item.get_object() if isinstance(item, IndirectObject) else item


_Pair = tuple[str, Any, Any]


@dataclass
class _Walk:
    """Follows two graphs of objects side by side; each pair of them once."""

    allowed: Allowed
    seen: set[tuple[int, int]] = field(default_factory=set)
    upward: list[_Pair] = field(default_factory=list)
    unpacked: int = 0

    def below(
        self, place: str, one: Any, two: Any, *, later: Set[str] = frozenset()
    ) -> Iterator[str]:
        pending = [(place, one, two)]
        while pending:
            place, one, two = pending.pop()
            one, two = resolved(one), resolved(two)
            is_one = one is two  # missing in both
            if is_one or (id(one), id(two)) in self.seen or self.allowed(place, one, two):
                continue
            self.seen.add((id(one), id(two)))
            if one is MISSING or two is MISSING or _type(one) is not _type(two):
                yield place
            elif isinstance(one, DictionaryObject):
                pending += self._entries(place, one, two, later)
                if isinstance(one, StreamObject) and self._is_other(place, one, two):
                    yield place
            elif isinstance(one, ArrayObject):
                pairs = enumerate(zip_longest(one, two, fillvalue=MISSING))
                pending += reversed([(f"{place}[{at}]", *pair) for at, pair in pairs])
            elif one != two:
                yield place

    def _entries(self, place: str, one: Any, two: Any, later: Set[str]) -> list[_Pair]:
        """Return the entries of two dictionaries, the last one by name first."""
        keys = sorted({*one, *two} - (_PACKING if isinstance(one, StreamObject) else set()))
        pairs = {
            key: (f"{place} {key}", one.get(key, MISSING), two.get(key, MISSING)) for key in keys
        }
        self.upward += [pair for key, pair in pairs.items() if key in later]
        return [pair for key, pair in reversed(pairs.items()) if key not in later]

    def _is_other(self, place: str, one: Any, two: Any) -> bool:
        is_other = self._data(one) != self._data(two)
        return is_other and not self.allowed(f"{place} stream", one, two)

    def _data(self, stream: Any) -> bytes:
        data: bytes = stream.get_data()
        self.unpacked += len(data)
        if self.unpacked > MOST_UNPACKED:
            raise InputError(f"unpacks to more than {MOST_UNPACKED // MB} MB, as no package does")
        return data


def _type(item: Any) -> type:
    """Return the type of an object; a packed stream is as good as one that is not."""
    return StreamObject if isinstance(item, StreamObject) else type(item)


_UPWARD = {"/Parent", "/P"}
_PACKING = {"/Length", "/Filter", "/DecodeParms"}
