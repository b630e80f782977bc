"""What was appended to a package after it was written: signatures, and nothing else, may be.

Checks what an update changes; `report.proof.signatures` checks what it says of it. Read `appended`.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence, Set
from dataclasses import dataclass
from typing import Any

from pypdf import PdfReader
from pypdf.generic import ArrayObject, DictionaryObject, IndirectObject

from report.proof.metadata import PRODUCER, facts
from report.proof.objects import MISSING, differences, resolved
from report.proof.package import ReadPackage, guarded, reader
from report.proof.signatures import Signature, checked

_SIGNED = {"/V", "/AP", "/F", "/Lock"}
"""What signing may add to a signature field or change in it."""

_INVISIBLE = {"/Type", "/Subtype", "/FT", "/T", "/Rect", "/P", *_SIGNED}
"""What a signature field may have that was added and shows on no sheet."""

_FORM = {"/SigFlags", "/Fields"}
_WRITING = {"document /Info /ModDate", "document /Info /Producer"}
_HEX = re.compile(rb"<[0-9A-Fa-f\s]*>")


@dataclass(frozen=True, slots=True, kw_only=True)
class Appended:
    """Signatures of a package, and what else was appended."""

    signed: Sequence[Signature]
    others: Sequence[str]


def appended(package: ReadPackage) -> Appended:
    """Return what was appended to the first revision of a package.

    Raises
    ------
    InputError
        If it cannot be read.
    """
    if len(package.data) == len(package.first):
        return Appended(signed=(), others=())
    first, last = package.pdf, guarded(lambda: reader(package.data))
    signatures = guarded(lambda: dict(_signatures(last)))
    others = guarded(lambda: [f"appended: {place}" for place in _changes(first, last)])
    if not _is_covered(package, signatures):
        others.append("appended: bytes that no signature covers")
    signed = tuple(checked(package.data, list(signatures)))
    others += [f"signature '{one.field}': {one.problem}" for one in signed if one.problem]
    return Appended(signed=signed, others=tuple(others))


def _fields(pdf: PdfReader) -> Sequence[Any]:
    form = resolved(pdf.root_object.get("/AcroForm", {}))
    return list(resolved(form.get("/Fields", ())))


def _signatures(pdf: PdfReader) -> Iterator[tuple[str, Any]]:
    for field in map(resolved, _fields(pdf)):
        if field.get("/FT") == "/Sig" and "/V" in field:
            yield str(field.get("/T", "")), field["/V"]


def _is_covered(package: ReadPackage, signatures: dict[str, Any]) -> bool:
    """Whether each signature covers all that was there, and the last one the whole file."""
    ends = [_covered_to(package.data, value) for value in signatures.values()]
    return bool(ends) and min(ends) > len(package.first) and max(ends) == len(package.data)


def _covered_to(data: bytes, value: Any) -> int:
    """Return where the bytes end that a signature covers from the first on; 0 if there is a gap.

    What it leaves out may be its own value and nothing else (ISO 32000-1, 12.8.1).
    """
    spans = [int(number) for number in value.get("/ByteRange", ())]
    if len(spans) != 4 or min(spans) < 0:
        return 0
    start, length, after, rest = spans
    is_value = _HEX.fullmatch(data, length, after) is not None
    return after + rest if start == 0 and is_value else 0


def _changes(first: PdfReader, last: PdfReader) -> Iterator[str]:
    """Yield what differs between two revisions beyond what signing changes."""
    yield from differences(first, last, _is_signing)
    old = {_number(field) for field in _fields(first)}
    for field in _fields(last):
        if _number(field) not in old and not _is_hidden(resolved(field)):
            yield "a field that shows on a sheet"


def _is_signing(place: str, one: Any, two: Any) -> bool:
    """Whether what differs at a place is what a signature changes there."""
    if _is_signed_field(one, two):
        return True
    if place.startswith("sheet ") and place.rpartition(" ")[2].startswith("/Annots"):
        return one is MISSING and _is_hidden(two)
    if place == "document /AcroForm":
        return two is not MISSING and _same_but(one, two, _FORM)
    if place == "document /Metadata":
        return two is not MISSING and _stated(one) == _stated(two)
    return place == "document /Extensions" or place in _WRITING


def _is_signed_field(one: Any, two: Any) -> bool:
    is_field = isinstance(one, DictionaryObject) and one.get("/FT") == "/Sig"
    return is_field and isinstance(two, DictionaryObject) and _same_but(one, two, _SIGNED)


def _same_but(one: Any, two: Any, changing: Set[str]) -> bool:
    """Whether two dictionaries agree but for some keys; objects keep their number in an update."""
    old, new = one.keys() - changing, two.keys() - changing
    return old == new and all(_plain(one.raw_get(k)) == _plain(two.raw_get(k)) for k in old)


def _plain(item: Any) -> Any:
    return item.idnum if isinstance(item, IndirectObject) else item


def _is_hidden(item: Any) -> bool:
    """Whether what was added to a sheet is signature fields without any area."""
    fields = [resolved(field) for field in (item if isinstance(item, ArrayObject) else [item])]
    return all(
        isinstance(field, DictionaryObject)
        and field.get("/FT") == "/Sig"
        and field.keys() <= _INVISIBLE
        and _area(field.get("/Rect", (0, 0, 1, 1))) == 0.0
        for field in fields
    )


def _area(rectangle: Sequence[Any]) -> float:
    left, bottom, right, top = map(float, rectangle)
    return abs((right - left) * (top - bottom))


def _stated(metadata: Any) -> set[tuple[str, str]]:
    """Return what the metadata of a document state beside the program that wrote them."""
    return {(name, value) for name, value in facts(metadata) if name != PRODUCER}


def _number(field: Any) -> int:
    return field.idnum if isinstance(field, IndirectObject) else id(field)
