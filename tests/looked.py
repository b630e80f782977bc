"""What a reader sees on the sheets of a PDF: blocks in order, how full each is, a contact sheet.

Reads the tags and the marks on the paper, by a library that the program does not use.
"""

from __future__ import annotations

import ctypes
import math
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path
from typing import Any

import pypdfium2
import pypdfium2.raw as pdfium
from PIL import Image

COLUMNS = 5
TOP_PT, FOOT_PT = 0.9 * 72, 0.95 * 72  # margins, as in templates/package.css
DRAWING_PT = 200.0  # a picture that is wider is a drawing, a narrower one an equation

# A line of a cell ends within a number, and the next goes on with it; a clause (13.6.12) does not.
_BROKEN = re.compile(r"(?:\d[.\-−/]?|[\-−/])\n(?!\d+\.\d+\.\d)[\d.]")
SHIFT_PT = 5.0  # of a subscript from its line
_HASH = re.compile(r"[0-9a-f]{12}")
_KINDS = ("H1", "H2", "P", "LI", "Caption", "Figure", "Table", "TH", "TD")


@dataclass(frozen=True)
class Block:
    """A tagged element on one sheet: a heading, paragraph, figure, table, or a cell of one.

    `lines` are its own texts from top to bottom; `wide` is its extent [pt].
    """

    kind: str
    sheet: int
    lines: tuple[str, ...]
    wide: float

    @property
    def text(self) -> str:
        """The words, in one line."""
        return " ".join(self.lines)


@dataclass(frozen=True)
class Sheet:
    """A sheet: its blocks in order of reading, its share above its lowest mark, its width [pt]."""

    number: int
    blocks: Sequence[Block]
    filled: float
    wide: float


def sheets(path: Path) -> list[Sheet]:
    """Return the sheets of a tagged PDF."""
    with pypdfium2.PdfDocument(path) as pdf:
        return [_sheet(page, number) for number, page in enumerate(pdf, start=1)]


def contact_sheet(path: Path, to: Path) -> None:
    """Draw all sheets of a PDF into one PNG."""
    with pypdfium2.PdfDocument(path) as pdf:
        images = [page.render(scale=0.75).to_pil() for page in pdf]
    wide, tall = (max(image.size[axis] for image in images) + 6 for axis in (0, 1))
    rows = -(-len(images) // COLUMNS)
    whole = Image.new("RGB", (COLUMNS * wide, rows * tall), "gray")
    for count, image in enumerate(images):
        whole.paste(image, (count % COLUMNS * wide, count // COLUMNS * tall))
    to.parent.mkdir(parents=True, exist_ok=True)
    whole.save(to)


def broken_numbers(found: Sequence[Sheet]) -> list[tuple[int, str]]:
    """Return the cells in which a line ends within a number, with their sheets."""
    return [
        (sheet.number, " / ".join(block.lines))
        for sheet in found
        for block in sheet.blocks
        if block.kind in ("TD", "TH")
        and _BROKEN.search("\n".join(block.lines))
        and not _HASH.search(block.text)
    ]


def headings_left_behind(found: Sequence[Sheet]) -> list[tuple[int, str]]:
    """Return the headings whose first drawing, with nothing but text before it, is overleaf."""
    left, heading = [], None
    for block in (block for sheet in found for block in sheet.blocks):
        if block.kind in ("H1", "H2"):
            heading = block
        elif block.kind == "Table":
            heading = None
        elif block.kind == "Figure" and heading:  # an equation is a figure too, and less wide
            if is_drawing(block) and block.sheet > heading.sheet:
                left.append((heading.sheet, heading.text))
            heading = None
    return left


def is_drawing(block: Block) -> bool:
    """Whether a block is a drawing, and no equation."""
    return block.kind == "Figure" and block.wide > DRAWING_PT


def short_sheets(found: Sequence[Sheet], least: float) -> list[tuple[int, float]]:
    """Return the sheets under a share full that are neither the last nor before a larger one."""
    return [
        (sheet.number, round(sheet.filled, 2))
        for sheet, after in pairwise(found)
        if sheet.filled < least and after.wide <= sheet.wide
    ]


def _sheet(page: Any, number: int) -> Sheet:
    marks: dict[int, list[Any]] = {}
    lowest = page.get_height()
    text = page.get_textpage()
    for mark in page.get_objects(max_depth=1):
        left, bottom, right, top = mark.get_bounds()
        if bottom > FOOT_PT and top < page.get_height() - TOP_PT:
            lowest = min(lowest, bottom)
        name = pdfium.FPDFPageObj_GetMarkedContentID(mark.raw)
        if name >= 0:
            marks.setdefault(name, []).append((mark, left, right))
    tree = pdfium.FPDF_StructTree_GetForPage(page.raw)
    blocks = [
        _block(element, kind, number, marks, text)
        for at in range(pdfium.FPDF_StructTree_CountChildren(tree))
        for element, kind in _below(pdfium.FPDF_StructTree_GetChildAtIndex(tree, at))
        if kind in _KINDS
    ]
    pdfium.FPDF_StructTree_Close(tree)
    body = page.get_height() - TOP_PT - FOOT_PT
    filled = (page.get_height() - TOP_PT - lowest) / body
    return Sheet(number, blocks, filled, page.get_width())


def _below(element: Any) -> Iterator[tuple[Any, str]]:
    """Yield an element and all below it, in order of reading, with their kinds."""
    if not element:
        return
    named = ctypes.create_string_buffer(64)
    pdfium.FPDF_StructElement_GetType(element, named, 64)
    yield element, named.raw.decode("utf-16-le").split("\0")[0]
    for at in range(pdfium.FPDF_StructElement_CountChildren(element)):
        yield from _below(pdfium.FPDF_StructElement_GetChildAtIndex(element, at))


def _block(element: Any, kind: str, sheet: int, marks: dict[int, list[Any]], text: Any) -> Block:
    own = (
        []
        if kind == "Table"
        else [mark for one, _ in _below(element) for mark in _marks(one, marks)]
    )
    lines: list[str] = []
    baseline = math.inf
    for mark, *_ in own:
        if mark.type == pdfium.FPDF_PAGEOBJ_TEXT and (words := _words(mark, text)):
            y = mark.get_matrix().f
            same = lines and abs(y - baseline) < SHIFT_PT
            lines[-1:] = [f"{lines[-1]} {words}"] if same else [*lines[-1:], words]
            baseline = y if not same else baseline
    wide = max((r for _, _, r in own), default=0.0) - min((x for _, x, _ in own), default=0.0)
    return Block(kind, sheet, tuple(lines), wide)


def _marks(element: Any, marks: dict[int, list[Any]]) -> Iterator[Any]:
    for at in range(max(0, pdfium.FPDF_StructElement_GetMarkedContentIdCount(element))):
        yield from marks.get(pdfium.FPDF_StructElement_GetMarkedContentIdAtIndex(element, at), [])


def _words(mark: Any, text: Any) -> str:
    """Return the text of a mark."""
    size = pdfium.FPDFTextObj_GetText(mark.raw, text.raw, None, 0)
    found = ctypes.create_string_buffer(2 * size)
    units = ctypes.cast(found, ctypes.POINTER(pdfium.FPDF_WCHAR))
    pdfium.FPDFTextObj_GetText(mark.raw, text.raw, units, 2 * size)
    return found.raw.decode("utf-16-le").strip("\0 ")
