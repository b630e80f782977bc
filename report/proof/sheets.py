"""The sheets of two packages, and all else in the PDFs beside their attachments. Read `changes`."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Sequence, Set
from typing import Any

from pypdf import PdfReader

from report.proof.metadata import facts, is_date
from report.proof.numbers import listed, word_differences
from report.proof.objects import MISSING, differences, resolved
from report.proof.shape import Part, strangers
from report.provenance.files import MANIFEST, RESULTS

Restated = Callable[[str], str]
"""Returns a text of a package with the versions and hashes of another one in place of its own."""

_DRAWN = {
    re.compile(pattern): name
    for pattern, name in (
        (r"sheet \d+ /Resources /Font\b", "fonts"),
        (r"sheet \d+ /Resources\b", "pictures"),
        (r"(sheet \d+) (/Contents|/Annots\[\d+\] /Rect\[\d\])$", r"\1"),
        (r"document /Outlines\b.* /Dest\[[23]\]$", "bookmarks"),
        (r"document /Names /Dests /Names\[\d+\]\[[23]\]$", "links"),
        (r"document /StructTreeRoot\b.*( /K(\[\d+\])?| /BBox\[\d\])$", "tags"),
        (r"document /StructTreeRoot /ParentTree\b", "tags"),
    )
}
"""Strokes and letters, where they lie, and which of them a tag belongs to: places, and what to say.

Other versions of what places letters and draws may write these otherwise, and nothing else. The
sheets share their resources.
"""

_COUNTED = (" /EF /F stream", " /Params /Size", " /Params /CheckSum")


def changes(
    theirs: PdfReader, ours: PdfReader, known: Set[Part], restated: Restated, *, is_redrawn: bool
) -> tuple[list[str], list[str]]:
    """Return where a package differs from ours, and apart from it what may be drawn otherwise.

    Parameters
    ----------
    theirs, ours : PdfReader
    known : set of Part
        What ours is built of.
    restated : callable
        Applied to our texts.
    is_redrawn : bool
        Whether other versions drew it; else it may not be drawn otherwise.

    Raises
    ------
    InputError
        If it is larger than any package.
    """
    own = _own(theirs)

    def allowed(place: str, one: Any, two: Any) -> bool:
        is_own = place.endswith(_COUNTED) and id(one) in own
        return is_own or _is_told_apart(place, one, two, restated)

    unknown = strangers(theirs, known)
    places = dict.fromkeys(differences(theirs, ours, allowed))
    open_ones = [place for place in places if is_redrawn and place not in unknown]
    drawn = {place: name for place in open_ones if (name := _drawn(place))}
    words = dict(_words(theirs, ours, restated, list(places)))
    told = {*drawn, *(f"sheet {count} /Contents" for count in words)} - {*unknown}
    found = [
        *(f"sheet {count}: {text}" for count, found in words.items() for text in listed(found)),
        *listed([place for place in dict.fromkeys([*unknown, *places]) if place not in told]),
    ]
    return found, list(dict.fromkeys(drawn.values()))


def _drawn(place: str) -> str:
    """Return what lies at a place that other versions may draw otherwise; empty elsewhere."""
    found = ((pattern.match(place), name) for pattern, name in _DRAWN.items())
    return next((match.expand(name) for match, name in found if match), "")


def _words(
    theirs: PdfReader, ours: PdfReader, restated: Restated, places: Sequence[str]
) -> Iterator[tuple[int, list[str]]]:
    """Yield where words differ, by sheet, where anything does that could have changed them."""
    has_other_letters = any(" /Resources" in place for place in places)
    for count, (one, two) in enumerate(zip(theirs.pages, ours.pages, strict=False), start=1):
        if has_other_letters or f"sheet {count} /Contents" in places:
            found = word_differences(one.extract_text(), restated(two.extract_text()))
            if found:
                yield count, found


def _own(pdf: PdfReader) -> set[int]:
    """Return the identities of what is compared as numbers: two attachments with their sums."""
    own = (file for file in pdf.attachment_list if file.name in (MANIFEST, RESULTS))
    streams: list[Any] = [resolved(file.pdf_object["/EF"])["/F"] for file in own]
    return {id(item) for one in streams for item in (one, *one.get("/Params", {}).values())}


def _is_told_apart(place: str, one: Any, two: Any, restated: Restated) -> bool:
    """Whether what differs at a place is the name of a version, or the date of a rewriting."""
    if place == "document /Info /ModDate":
        return is_date(one)
    if place == "document /Info /Producer":
        return two is not MISSING and one == restated(str(two))
    if place == "document /Metadata stream":
        return facts(one) == {(name, restated(value)) for name, value in facts(two)}
    return False
