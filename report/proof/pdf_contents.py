"""The sheets and text of an untrusted PDF, and content that no package contains.

`refused` yields `sheet 3: a script (/JavaScript)`; `words` the place and text of each sheet.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Sequence
from typing import Any, TypeVar

from pypdf import PageObject, PdfReader
from pypdf.generic import ArrayObject, DictionaryObject, IndirectObject, StreamObject

from report.typeset.finish import FIELD
from solver.errors import InputError

_T = TypeVar("_T")

# What a stranger sends may double at each level: counts and time, beyond any package, end it, and
# not the depth.
MOST_SHEETS, MOST_OBJECTS, MOST_SECONDS = 5_000, 5_000_000, 300.0

# Keys of a PDF that no package has, and what they stand for.
_FORBIDDEN = {
    **dict.fromkeys(("/AA", "/OpenAction", "/URI", "/PA"), "an action"),
    **dict.fromkeys(("/JS", "/JavaScript", "/XFA"), "a script"),
    **dict.fromkeys(("/OC", "/OCGs", "/OCProperties"), "a layer"),
    **dict.fromkeys(("/Collection", "/RF"), "a foreign attachment"),
}

# References back to what lies above: followed last, or all would belong to the first sheet.
_UPWARD = {"/Parent", "/P", "/Dest", "/Obj", "/Pg"}
_READ_ALOUD = {"/Alt", "/ActualText", "/E", "/Contents", "/Title", "/TU"}


def pages(pdf: PdfReader) -> Sequence[PageObject]:
    """Return the sheets.

    Raises `InputError` if the tree of sheets names one twice, or has more than any package.
    """
    # Without recursion: a node may be its own kid, or a tree as deep as the file is long.
    pending, seen, count = [pdf.root_object.raw_get("/Pages")], set[int](), 0
    while pending:
        node: Any = pending.pop().get_object()
        if id(node) in seen or len(seen) > MOST_SHEETS:
            raise InputError("has a sheet twice, or more sheets than a package can have")
        seen.add(id(node))
        count += "/Kids" not in node
        # Of a list alone: a text or a dictionary in its place raises, and the file is damaged.
        pending += list.__iter__(node.get("/Kids", []))
    # Readers differ in which of the two they believe.
    if len(pdf.pages) != count:
        raise InputError(f"states {len(pdf.pages)} sheets and has {count}")
    return list(pdf.pages)


def refused(pdf: PdfReader) -> Iterator[str]:
    """Yield locations of content in a PDF that no package contains, whichever software wrote it.

    Raises `InputError` if it has more sheets or objects than any package.
    """
    fields = 0
    for count, page in enumerate(pages(pdf), start=1):
        for note in (item.get_object() for item in page.get("/Annots", ())):
            fields += note["/Subtype"] == "/Widget" and not _is_hidden(note)
            if _is_other(note) or fields > 1:
                yield f"sheet {count}: an annotation other than links and the signature field"
        # A second stream paints over the first one, and leaves its words as they were.
        if not isinstance(page["/Contents"], StreamObject):
            yield f"sheet {count}: its content is in several parts"
        # What is cropped or scaled away keeps its words. Readers may be told to show any frame.
        frames = [page.mediabox, page.cropbox, page.bleedbox, page.trimbox, page.artbox]
        page_frame = [0.0, 0.0, page.mediabox.width, page.mediabox.height]
        if page.rotation or page.user_unit != 1.0 or frames != [page_frame] * len(frames):
            yield f"sheet {count}: rotated, cropped, moved or scaled"
    root: Any = pdf.root_object
    attached = {id(file.get_object()) for file in root["/Names"]["/EmbeddedFiles"]["/Names"]}
    for place, item in _dictionaries(pdf):
        for key in sorted(item.keys() & _FORBIDDEN.keys()):
            yield f"{place}: {_FORBIDDEN[key]} ({key})"
        action: Any = item.get("/A")
        if isinstance(action, DictionaryObject) and "/S" in action:  # no tag has it
            yield f"{place}: an action (/A)"
        if "/Kids" in item and "/UserUnit" in item:
            yield f"{place}: its sheets are scaled"
        # Files belong to the document (PDF/A-3): in the catalog, which has /Pages, and nowhere
        # else.
        if ("/EF" in item and id(item) not in attached) or ("/AF" in item and "/Pages" not in item):
            yield f"{place}: a foreign attachment"


def _is_other(note: Any) -> bool:
    """Whether an annotation is neither a link within the package nor the signature field."""
    if note["/Subtype"] == "/Link":
        return "/Dest" not in note or "/AP" in note or note["/BS"]["/W"] != 0
    if note["/Subtype"] != "/Widget" or note.get("/FT") != "/Sig":
        return True
    # Signing programs put fields of no size on a sheet.
    if _is_hidden(note):
        return False
    return note["/T"] != FIELD or ("/V" not in note and bool(note["/AP"]["/N"].get_data().strip()))


def _is_hidden(note: Any) -> bool:
    left, bottom, right, top = map(float, note["/Rect"])
    return (right - left) * (top - bottom) == 0.0


def _dictionaries(pdf: PdfReader) -> Iterator[tuple[str, DictionaryObject]]:
    """Yield each dictionary with its sheet, or as of the document if it belongs to none."""
    # Sheets in order first, so that what is found below one is said of it.
    starts = [(f"sheet {count}", page) for count, page in enumerate(pages(pdf), start=1)]
    pending: list[tuple[str, Any]] = [*reversed(starts)]
    last: list[tuple[str, Any]] = [("document", pdf.trailer)]
    seen, count = set[int](), 0
    while pending or last:
        place, item = pending.pop() if pending else last.pop()
        if isinstance(item, IndirectObject):
            item = item.get_object()
        if id(item) in seen or not isinstance(item, (ArrayObject, DictionaryObject)):
            continue
        seen.add(id(item))
        count += len(item)
        if count > MOST_OBJECTS:
            raise InputError("has more objects than a package can have")
        if isinstance(item, ArrayObject):
            # A stack gives back the last first: reversed, items come in the order of the file.
            pending += [(place, below) for below in reversed(list(list.__iter__(item)))]
            continue
        yield place, item
        below = [(key, item.raw_get(key)) for key in sorted(item, reverse=True)]
        pending += [(place, value) for key, value in below if key not in _UPWARD]
        # What lies above belongs to no sheet.
        last += [("document", value) for key, value in below if key in _UPWARD]


def words(pdf: PdfReader) -> Iterator[tuple[str, str]]:
    """Yield the place and the text of each sheet, then text for screen readers and bookmarks.

    Raises `InputError` if that takes longer than with any package.
    """
    end = time.monotonic() + MOST_SECONDS

    def check(*_: object) -> None:
        if time.monotonic() > end:
            raise InputError("takes longer to read than a package can")

    for count, page in enumerate(pages(pdf), start=1):
        check()
        # A smaller sheet cuts off what its words still say.
        yield f"size of sheet {count}", f"{page.mediabox.width:g} x {page.mediabox.height:g}"
        # The clock is asked at each operand: one stream may keep the reader of texts busy for
        # hours.
        yield f"sheet {count}", page.extract_text(visitor_operand_before=check)
    for place, item in _dictionaries(pdf):
        check()
        for key in sorted(item.keys() & _READ_ALOUD):
            if isinstance(item[key], str):
                yield f"{place} ({key})", str(item[key])
    for key, value in sorted((pdf.metadata or {}).items()):
        # Who signs rewrites these two.
        if key not in ("/Producer", "/ModDate"):
            yield f"document ({key})", str(value)


def guarded(read: Callable[[], _T]) -> _T:
    """Run a function that reads a PDF; raises `InputError` if it is damaged."""
    try:
        return read()
    except InputError:
        raise
    # A damaged file makes the libraries raise almost anything.
    except Exception as error:
        raise InputError("is damaged; obtain the file again from its issuer") from error
