"""Changes cells of a workbook within the parts of its file, and leaves everything else unchanged.

Formats, cached values, formulas, sketches and charts stay, which a load and save would lose. Read
`changed`.
"""

from __future__ import annotations

import io
import posixpath
import re
import zipfile
from collections.abc import Iterator, Mapping, Sequence, Set
from types import MappingProxyType
from typing import Any

from lxml import etree
from openpyxl.utils import coordinate_to_tuple, get_column_letter, range_boundaries

from report.project.read.archive import sheet_parts
from report.project.read.cells import escaped
from report.project.read.positions import CellPosition
from report.project.read.scan import REOPEN
from solver.errors import InputError


class Formula(str):
    """A formula with its equals sign, to be written as such."""

    __slots__ = ()


# What is written in a cell: a formula, text, a number, or nothing.
Value = Formula | str | float | int | None

_Place = tuple[int, int]  # row and column
_Cells = Mapping[_Place, Value]
_Columns = Sequence[tuple[range, Any]]  # with their elements

_CALC_CHAIN = "xl/calcChain.xml"
_CONTROL = re.compile("[\x00-\x08\x0b\x0c\x0e-\x1f\ufffe\uffff\ud800-\udfff]")
_ONES = ("1", "true")


def changed(
    data: bytes,
    changes: Mapping[CellPosition, Value],
    stale: Set[CellPosition] = frozenset(),
    *,
    looks: Mapping[CellPosition, CellPosition] = MappingProxyType({}),
    recalculates: bool = True,
) -> bytes:
    """Return a workbook with other contents of some cells; formulas are computed when it is opened.

    None leaves a cell blank; each keeps its format, or takes that of another one of its sheet by
    `looks`. Stale formulas lose their values, which LibreOffice would keep. It need not be
    recalculated if no formula refers to the cells.

    Raises `InputError` if a sheet is missing or damaged, or a cell shares its formula.
    """
    with zipfile.ZipFile(io.BytesIO(data)) as archive:
        titles = dict(sheet_parts(archive))
        members = archive.infolist()
        files = {member.filename: archive.read(member) for member in members}
    has_formula = any(isinstance(value, Formula) for value in changes.values())
    for title in dict.fromkeys(position.sheet for position in (*changes, *stale, *looks)):
        if title not in titles:
            raise InputError(f"{title}: the worksheet is missing")
        part = titles[title]
        sheet = _sheet(title, files[part])
        cells = {(p.row, p.column): value for p, value in changes.items() if p.sheet == title}
        has_formula |= _fill(title, sheet, cells)
        _forget(sheet, {(p.row, p.column) for p in stale if p.sheet == title} - cells.keys())
        _look_alike(sheet, {place: like for place, like in looks.items() if place.sheet == title})
        files[part] = _written(sheet)
        files |= _longer_tables(files, part, cells)
    book = _parsed("xl/workbook.xml", files["xl/workbook.xml"])
    filled = {position.sheet for position, value in changes.items() if value is not None}
    for sheet in book.iterfind("{*}sheets/{*}sheet"):
        if sheet.get("name") in filled:
            # What is written on a hidden sheet would be a warning of the next `check`.
            sheet.attrib.pop("state", None)
    # Excel computes a workbook with this mark as it opens it; LibreOffice does not, hence `stale`.
    for calculation in book.iter("{*}calcPr") if recalculates else ():
        calculation.set("fullCalcOnLoad", "1")
    files["xl/workbook.xml"] = _written(book)
    if has_formula and files.pop(_CALC_CHAIN, b""):
        # The order of computation may name a cell that is no formula any more.
        for name in ("[Content_Types].xml", "xl/_rels/workbook.xml.rels"):
            files[name] = re.sub(rb"<[^<>]*calcChain\.xml[^<>]*/>", b"", files[name])
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w", zipfile.ZIP_DEFLATED) as packed:
        for member in members:
            if member.filename in files:
                # By its own entry, with its date and order: what is not changed stays the same to
                # the byte when unpacked.
                packed.writestr(member, files[member.filename], member.compress_type)
    return out.getvalue()


def _parsed(name: str, data: bytes) -> Any:
    """Return the root of a part; one with a document type, which may have entities, is refused."""
    try:
        root = etree.fromstring(data, etree.XMLParser(resolve_entities=False, no_network=True))
    except etree.XMLSyntaxError as error:
        raise InputError(f"{name}: damaged; {REOPEN}") from error
    if root.getroottree().docinfo.internalDTD is not None:
        raise InputError(f"{name}: has a document type; {REOPEN}")
    return root


def _sheet(title: str, data: bytes) -> Any:
    sheet = _parsed(title, data)
    rows = sheet.find("{*}sheetData")
    if rows is None:
        raise InputError(f"{title}: has no cells; {REOPEN}")
    # They may be left out: then what is inserted has no place among the others.
    if any("r" not in element.attrib for element in rows.iter("{*}row", "{*}c")):
        raise InputError(f"{title}: has cells without addresses; {REOPEN}")
    return sheet


def _written(tree: Any) -> bytes:
    written: bytes = etree.tostring(tree, xml_declaration=True, encoding="UTF-8", standalone=True)
    return written


def _cells_of(sheet: Any) -> dict[_Place, Any]:
    cells = sheet.iterfind("{*}sheetData/{*}row/{*}c")
    return {coordinate_to_tuple(cell.get("r")): cell for cell in cells}


def _fill(title: str, sheet: Any, cells: _Cells) -> bool:
    """Write cells of a sheet, and show columns that are filled; return if one was a formula."""
    home, elements = sheet.find("{*}sheetData"), _cells_of(sheet)
    rows = {int(row.get("r")): row for row in home.iterfind("{*}row")}
    formulas = {place: cell.find("{*}f") for place, cell in elements.items()}
    formulas = {place: formula for place, formula in formulas.items() if formula is not None}
    columns = [
        (range(int(element.get("min")), int(element.get("max")) + 1), element)
        for element in sheet.iterfind("{*}cols/{*}col")
    ]
    # The text of a shared formula is in its first cell alone (ECMA-376-1, 18.3.1.40): to overwrite
    # it would take it from the others.
    for place in cells.keys() & formulas.keys():
        if _is_needed_elsewhere(place, formulas, cells):
            address = f"{title}!{get_column_letter(place[1])}{place[0]}"
            raise InputError(f"{address}: shares its formula with other cells; clear it first")
    for (row, column), value in sorted(cells.items(), key=lambda item: item[0]):
        cell = elements.get((row, column))
        if cell is None and value is not None:
            if row not in rows:
                rows[row] = _inserted(home, "row", str(row), int, row)
            cell = _added(rows[row], f"{get_column_letter(column)}{row}", columns, column)
        if cell is not None:
            _put(cell, value)
    _show(columns, {column for (_, column), value in cells.items() if value is not None})
    return bool(cells.keys() & formulas.keys())


def _is_needed_elsewhere(place: _Place, formulas: Mapping[_Place, Any], cells: _Cells) -> bool:
    """Whether the formula of a cell is shared with cells that are not changed."""
    formula = formulas[place]
    reach = formula.get("ref", "")
    if formula.get("t") != "shared":
        # An array formula or a data table: its first cell alone has it, for all of its range.
        return ":" in reach
    group = {
        shared
        for shared, shared_formula in formulas.items()
        if shared_formula.get("si") == formula.get("si")
    }
    return bool(reach) and not cells.keys() >= group


def _inserted(parent: Any, tag: str, name: str, number_of: Any, number: int) -> Any:
    """Return a new row or cell, in its place among those of its parent."""
    space = etree.QName(parent).namespace
    element = parent.makeelement(etree.QName(space, tag), {"r": name})
    before = sum(
        number_of(element_before.get("r")) < number
        for element_before in parent.iterfind(f"{{*}}{tag}")
    )
    parent.insert(before, element)
    return element


def _added(row: Any, address: str, columns: _Columns, column: int) -> Any:
    """Return a new cell, with the style of its row or else of its column."""
    # A hint for readers, which would be false now (ECMA-376-1, 18.3.1.73).
    row.attrib.pop("spans", None)
    cell = _inserted(row, "c", address, lambda reference: coordinate_to_tuple(reference)[1], column)
    if row.get("customFormat") in _ONES:
        style = row.get("s")
    else:
        styles = (element.get("style") for numbers, element in columns if column in numbers)
        style = next(filter(None, styles), None)
    if style:
        cell.set("s", style)
    return cell


def _put(cell: Any, value: Value) -> None:
    """Write the content of a cell; a number as such, a text within the cell itself."""

    def below(parent: Any, tag: str) -> Any:
        return etree.SubElement(parent, etree.QName(etree.QName(cell).namespace, tag))

    del cell[:]
    # The type of the content that was there: a number under t="s" would be read as the number of a
    # shared string.
    cell.attrib.pop("t", None)
    match value:
        case None:
            pass
        case Formula():
            below(cell, "f").text = value[1:]
        case str():
            # Within the cell: a shared string would need the part of all strings changed as well.
            cell.set("t", "inlineStr")
            text = below(below(cell, "is"), "t")
            # Without it readers drop the blanks at both ends.
            text.set("{http://www.w3.org/XML/1998/namespace}space", "preserve")
            text.text = escaped(_CONTROL.sub("?", value))
        case _:  # a number of numpy is written as a number of Python
            number = value if isinstance(value, int) else float(value)
            below(cell, "v").text = repr(number)


def _show(columns: _Columns, filled: set[int]) -> None:
    """Show columns which are hidden, folded groups also, and filled."""
    for numbers, column in columns:
        if column.get("hidden") in _ONES and filled.intersection(numbers):
            column.attrib.pop("hidden")
            column.attrib.pop("collapsed", None)
            for after, mark in columns:  # where a group ends, its mark would fold it again
                if after.start == numbers.stop:
                    mark.attrib.pop("collapsed", None)


def _look_alike(sheet: Any, looks: Mapping[CellPosition, CellPosition]) -> None:
    """Give cells the format of others, also those that have no content, for their borders."""
    elements = _cells_of(sheet) if looks else {}
    rows = {int(row.get("r")): row for row in sheet.iterfind("{*}sheetData/{*}row")}
    for position, like in looks.items():
        model = elements.get((like.row, like.column))
        if model is None or position.row not in rows:
            continue
        cell = elements.get((position.row, position.column))
        if cell is None:
            cell = _added(rows[position.row], position.cell, (), position.column)
        if style := model.get("s"):
            cell.set("s", style)


def _forget(sheet: Any, stale: set[_Place]) -> None:
    # LibreOffice shows a saved value, and computes only where there is none.
    cells = _cells_of(sheet) if stale else {}
    for place in stale:
        value = cells[place].find("{*}v")
        if value is not None and value.text:
            cells[place].remove(value)
            cells[place].attrib.pop("t", None)


def _longer_tables(
    files: Mapping[str, bytes], part: str, cells: _Cells
) -> Iterator[tuple[str, bytes]]:
    """Yield the tables of a sheet that grow to the rows written just below them."""
    folder, _, name = part.rpartition("/")
    relations = f"{folder}/_rels/{name}.rels"
    if relations not in files:
        return
    for relation in _parsed(relations, files[relations]).iterfind("{*}Relationship[@Target]"):
        # A target may begin at the root of the archive.
        path = posixpath.normpath(posixpath.join("/", folder, relation.get("Target"))).lstrip("/")
        if "tables/" not in path or path not in files:
            continue
        table = _parsed(path, files[path])
        reference = table.get("ref")
        corners: Any = range_boundaries(reference)  # a table has none without numbers
        left, top, right, bottom = corners
        filled = {
            row
            for (row, column), value in cells.items()
            if value is not None and left <= column <= right
        }
        last = bottom
        # Excel itself makes a table longer as one types below it; in the file its range says where
        # it ends.
        while last + 1 in filled:
            last += 1
        # Rows that are typed below a row of totals are no part of the table.
        if last > bottom and "totalsRowCount" not in table.attrib:
            longer = f"{get_column_letter(left)}{top}:{get_column_letter(right)}{last}"
            # Its filter has the same range.
            for part_of_table in table.iter():
                if part_of_table.get("ref") == reference:
                    part_of_table.set("ref", longer)
            yield path, _written(table)
