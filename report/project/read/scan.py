"""Scans the XML of a workbook's parts before openpyxl makes objects of them.

Limits their cost, and collects data that openpyxl does not keep: formulas with values, the cell
that sets the extent of a sheet, and how the workbook was calculated. Read `archive` first.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any
from xml.sax import SAXException
from xml.sax.handler import ContentHandler

import defusedxml.sax
from defusedxml import DefusedXmlException
from openpyxl.formula.translate import Translator
from openpyxl.utils import coordinate_to_tuple, get_column_letter, range_boundaries

from solver.errors import InputError

REOPEN = "open it in Excel or LibreOffice and save it again"

# What openpyxl reads in less than 10 s: 14 us for a cell or a row, 50 us for another element.
MAX_TAGS = 2_500_000
MAX_CELLS = 300_000
MAX_OTHERS = 100_000
MAX_SPREAD_CELLS = 100_000
# As many characters as Excel allows (Excel specifications and limits).
MAX_FORMULA = 8192
# Of a sheet of Excel.
LAST_COLUMN, LAST_ROW = 16_384, 1_048_576
_VALUES = frozenset(("v", "f", "t", "is", "si"))
_FORMULAS = frozenset(("f", "definedName", "formula", "formula1", "formula2"))
# Formulas that fetch from elsewhere: DDE is `app|topic!item`. A bar within quotes is text.
_QUOTED = re.compile(r""""[^"]*"|'[^']*'""")
_FETCHES = re.compile(r"\||\b(?:DDE|RTD|WEBSERVICE)\s*\(", re.IGNORECASE)
_SHAPES = ("xl/drawings/", "xl/charts/", "xl/media/", "xl/theme/")


@dataclass(slots=True)
class UsedRange:
    """The used range of a sheet: last row and last column, each with the cell that sets it."""

    last_row: int = 0
    last_column: int = 0
    row_cell: str = ""
    column_cell: str = ""

    def grow(self, row: int, column: int) -> None:
        """Include a cell that has content."""
        if row > self.last_row:
            self.last_row, self.row_cell = row, f"{get_column_letter(column)}{row}"
        if column > self.last_column:
            self.last_column, self.column_cell = column, f"{get_column_letter(column)}{row}"


@dataclass(slots=True)
class Budget:
    """Elements that the parts of a workbook may still have, all together."""

    cells: int = field(default_factory=lambda: MAX_CELLS)
    others: int = field(default_factory=lambda: MAX_OTHERS)

    def take(self, element: str, areas: str) -> None:
        """Count an element, and each of the areas that it is given for."""
        # openpyxl makes an object for each area of a format or a validation.
        self.others -= areas.count(" ")
        if element in ("c", "row"):
            self.cells -= 1
        # Values are within cells, which are counted.
        elif element not in _VALUES:
            self.others -= 1
        if self.cells < 0:
            raise InputError(
                f"more than {MAX_CELLS:,} cells and rows; keep records in files next to it"
            )
        if self.others < 0:
            raise InputError(
                f"more than {MAX_OTHERS:,} comments, formats and the like; copy the inputs into a "
                "new workbook (roofslip new FOLDER)"
            )


@dataclass(slots=True)
class Scan(ContentHandler):
    """The extent of values in a part, and its formulas by cell: each with the cell it is of."""

    budget: Budget
    extent: UsedRange = field(default_factory=UsedRange)
    formulas: dict[str, tuple[str, str]] = field(default_factory=dict)
    cells: set[tuple[int, int]] = field(default_factory=set)  # that are there: row and column
    computed: set[tuple[int, int]] = field(default_factory=set)  # formulas with a saved text
    # Of the part of the workbook, how it was calculated (ECMA-376-1, 18.2.2).
    calculation: dict[str, str] = field(default_factory=dict)
    outside: list[str] = field(default_factory=list)  # what it takes values or pictures from
    twice: str = ""  # a cell, or a defined name, that is there twice: openpyxl keeps the last
    is_beyond: bool = False  # whether it has a cell that no sheet has
    _once: set[tuple[str, str | None]] = field(default_factory=set)
    _shared: dict[str, tuple[str, str]] = field(default_factory=dict)
    _formula: Mapping[str, str] | None = None
    _last_formula: tuple[int, int] = (0, 0)
    _has_text: bool = False  # whether the value of a formula in the cell is a text
    _text: list[str] = field(default_factory=list)
    _spread_cells: int = 0
    _row: int = 0
    _column: int = 0

    def startElement(self, name: str, attrs: Any) -> None:  # noqa: N802
        """Count the element, and keep its data on the sheet."""
        element = name.rpartition(":")[2]
        self.budget.take(element, attrs.get("sqref", ""))
        match element:
            case "row":
                # Addresses of rows and cells may be left out: each then follows the one before it.
                self._row, self._column = int(attrs.get("r") or self._row + 1), 0
            case "c":
                self._column += 1
                if reference := attrs.get("r"):
                    self._row, self._column = coordinate_to_tuple(reference)
                position = self._row, self._column
                if not (0 < self._row <= LAST_ROW and 0 < self._column <= LAST_COLUMN):
                    self.is_beyond = True
                if position in self.cells:
                    self.twice = f"{get_column_letter(self._column)}{self._row}"
                self.cells.add(position)
                self._has_text = attrs.get("t") == "str"
            case "v" | "is":
                self.extent.grow(self._row, self._column)
                # An empty value without a type is a formula that was never computed: openpyxl
                # writes it.
                if self._has_text and self._last_formula == (self._row, self._column):
                    self.computed.add(self._last_formula)
            case _ if element in _FORMULAS:
                self._formula, self._text = dict(attrs), []
                if element == "f":
                    self.extent.grow(self._row, self._column)
                # LibreOffice writes those of Excel's own twice, such as _xlnm.Print_Titles.
                defined = attrs.get("name", "_xlnm.")
                is_own = defined.startswith("_xlnm.")
                key = defined.casefold(), attrs.get("localSheetId")
                if key in self._once and not is_own:
                    self.twice = defined
                self._once.add(key)
            case "ddeLink":
                self.outside.append(f"DDE {attrs.get('ddeService')}|{attrs.get('ddeTopic')}")
            case "connection" if attrs.get("name"):
                self.outside.append(f"connection {attrs['name']}")
            case "Relationship" if attrs.get("TargetMode") == "External":
                kind = attrs.get("Type", "").rpartition("/")[2]
                self.outside += [str(attrs.get("Target"))] if kind != "hyperlink" else []
            case "mergeCell" | "hyperlink":
                self._spread(attrs.get("ref"))
            case "calcPr":
                self.calculation = dict(attrs)

    def characters(self, content: str) -> None:
        """Gather the text of a formula."""
        if self._formula is not None:
            self._text.append(content)

    def endElement(self, name: str) -> None:  # noqa: N802
        """Keep a formula with its cell."""
        element = name.rpartition(":")[2]
        if self._formula is None or element not in _FORMULAS:
            return
        formula, self._formula = self._formula, None
        text = "".join(self._text)
        if _FETCHES.search(_QUOTED.sub("", text)):
            self.outside.append(f"={text}")
        # In the part of a chart the elements of this name are references of its series.
        if element != "f" or not self._column:
            return
        self._last_formula = self._row, self._column
        cell = f"{get_column_letter(self._column)}{self._row}"
        if len(text) > MAX_FORMULA:
            raise InputError(
                f"the formula in {cell} has more than {MAX_FORMULA:,} characters; shorten it"
            )
        self.formulas[cell] = self._typed(cell, formula, text)

    def _typed(self, cell: str, attributes: Mapping[str, str], text: str) -> tuple[str, str]:
        kind, index = attributes.get("t"), attributes.get("si", "")
        if kind == "dataTable":
            # A what-if table has no formula text: Excel shows it as TABLE.
            return "=TABLE()", cell
        formula = f"={text}", cell
        if kind != "shared":
            return formula
        if text:
            self._shared[index] = formula
        return self._shared.get(index, formula)

    def formula(self, cell: str) -> str:
        """Return the formula of a cell, empty if it has none; one that is shared is moved to it."""
        text, origin = self.formulas.get(cell, ("", cell))
        return text if origin == cell else str(Translator(text, origin).translate_formula(cell))

    def _spread(self, reference: str | None) -> None:
        # openpyxl creates an object for every cell of such a range.
        if not reference or ":" not in reference:
            return
        left, top, right, bottom = (side or 0 for side in range_boundaries(reference))
        is_open = 0 in (left, top, right, bottom)  # such as A:C
        area = (abs(right - left) + 1) * (abs(bottom - top) + 1)
        self._spread_cells += MAX_CELLS if is_open else area
        if self._spread_cells > MAX_SPREAD_CELLS:
            raise InputError(
                f"merged cells or links over {reference}; unmerge them, or remove the links"
            )


def scan_parts(parts: Mapping[str, bytes]) -> dict[str, Scan]:
    """Scan every part that a parser may read as XML: what passes is safe for any parser.

    Raises `InputError` if a part is damaged, declares entities, or would cost more than an input
    can.
    """
    markup = {name: data for name, data in parts.items() if _is_xml(name, data)}
    # Counted in the bytes, before any parser begins: 10 MB of `<a>` are 3 million elements.
    tags = sum(data.count(b"<") for data in markup.values())
    if tags > MAX_TAGS:
        raise InputError(
            f"has {tags:,} XML tags, more than {MAX_TAGS:,}; keep records in files next to it"
        )
    budget = Budget()
    scans = {}
    for name, data in markup.items():
        # Shapes are drawn by nobody here: their elements are free.
        scans[name] = Scan(Budget() if name.startswith(_SHAPES) else budget)
        _walk(name, data, scans[name])
    return scans


def _is_xml(name: str, data: bytes) -> bool:
    """Whether a parser may read it as XML: by its name, or by a first `<`."""
    if name.lower().endswith((".xml", ".rels")):
        return True
    # Python's parser knows UTF-16, and encodings that write `<` as ASCII does.
    return data.lstrip(b"\xef\xbb\xbf\xff\xfe\x00 \t\r\n").startswith(b"<")


def _walk(name: str, data: bytes, scan: Scan) -> None:
    try:
        defusedxml.sax.parseString(data, scan, forbid_dtd=True)
    except DefusedXmlException as error:
        raise InputError(f"contains XML entity declarations at {name}; {REOPEN}") from error
    except InputError as error:
        raise InputError(f"{name}: {error.problems[0]}") from error
    except (SAXException, ValueError, LookupError) as error:  # LookupError: unknown encodings
        raise InputError(f"damaged at {name}; {REOPEN}") from error
