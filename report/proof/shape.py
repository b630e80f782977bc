"""What a PDF is built of: which kinds of objects hold what. Knows no package. Read `parts`."""

from __future__ import annotations

import re
from collections import deque
from collections.abc import Iterator, Set
from typing import Any

from pypdf import PdfReader
from pypdf.generic import (
    ArrayObject,
    BooleanObject,
    DictionaryObject,
    FloatObject,
    NameObject,
    NullObject,
    NumberObject,
    StreamObject,
)

from report.proof.objects import MISSING, entry, resolved

Part = tuple[str, str, str]
"""Kind of an object, key under which it holds something, and kind of that."""

_TYPES = ("/Type", "/Subtype", "/S", "/FT")
_RESOURCES = {
    f"dictionary {key}"
    for key in ("/Font", "/XObject", "/Pattern", "/ExtGState", "/ColorSpace", "/Shading")
}
_SUBSET = re.compile(r"/[A-Z]{6}\+")


def parts(pdf: PdfReader) -> frozenset[Part]:
    """Return what a PDF is built of; numbers and texts are no part of it."""
    return frozenset(part for part, _ in _parts(pdf))


def strangers(pdf: PdfReader, known: Set[Part]) -> list[str]:
    """Return the places at which a PDF holds what is not among known parts."""
    return [place for part, place in _parts(pdf, known) if part not in known]


def _parts(pdf: PdfReader, known: Set[Part] | None = None) -> Iterator[tuple[Part, str]]:
    """Yield each kind of part with the shortest place; below one that is not known none is seen."""
    found = {f"sheet {count}": page for count, page in enumerate(pdf.pages, start=1)}
    keys = {"document": "/Root", "document /Info": "/Info", "document /Encrypt": "/Encrypt"}
    found |= {place: entry(pdf, key) for place, key in keys.items()}
    pending = deque((_kind("", item), place, item) for place, item in found.items())
    seen, told = set[tuple[str, int]](), set[Part]()
    while pending:
        kind, place, item = pending.popleft()
        if (kind, id(item)) in seen or item is MISSING:
            continue
        seen.add((kind, id(item)))
        for key, step, below in _held(kind, item):
            part = (kind, key, _kind(kind if key == "[]" else key, below))
            if part not in told:
                told.add(part)
                yield part, f"{place}{step}"
            if known is None or part in known:
                pending.append((part[2], f"{place}{step}", below))


def _held(kind: str, item: Any) -> Iterator[tuple[str, str, Any]]:
    """Yield what an object holds: the key, how the place goes on, and the object itself."""
    if isinstance(item, ArrayObject):
        yield from (("[]", f"[{at}]", resolved(below)) for at, below in enumerate(item))
    elif isinstance(item, DictionaryObject):
        # The keys of resources are names that the renderer makes up.
        is_named = kind in _RESOURCES
        for key in item:
            yield "name" if is_named else key, f" {key}", resolved(item.raw_get(key))


def _kind(under: str, item: Any) -> str:
    """Return what an object is: its types, or what holds it; of a name, what it says."""
    if isinstance(item, DictionaryObject):
        types = " ".join(str(item[key]) for key in _TYPES if key in item)
        return f"{'stream' if isinstance(item, StreamObject) else 'dictionary'} {types or under}"
    if isinstance(item, ArrayObject):
        return f"{under}[]"
    if isinstance(item, (NumberObject, FloatObject)):
        return "number"
    if isinstance(item, NameObject):
        return _SUBSET.sub("", item)
    return str(item) if isinstance(item, (BooleanObject, NullObject)) else "text"
