"""Changes cells of a workbook within the parts of its file, and leaves every other byte as it is.

Formats, cached values, formulas, sketches and charts stay, which a load and save would lose. Knows
no fields: `report.sheet.reading.locate` finds the cells.
"""

from __future__ import annotations

import io
import posixpath
import re
import zipfile
from collections.abc import Iterator, Mapping, Sequence, Set
from dataclasses import dataclass, field
from xml.parsers import expat
from xml.sax.saxutils import escape, unescape

from openpyxl.utils import coordinate_to_tuple, get_column_letter

from report.sheet.reading.archive import sheet_parts
from report.sheet.reading.cells import escaped
from report.sheet.reading.positions import CellPosition
from report.sheet.reading.scan import REOPEN
from solver.model import InputError


class Formula(str):
    """A formula with its equals sign, to be written as such."""

    __slots__ = ()


Value = Formula | str | float | int | None
"""What is written in a cell: a formula, text, a number, or nothing."""

_Cells = Mapping[tuple[int, int], Value]  # by row and column
_Edit = tuple[int, int, bytes]  # start, end and new bytes

_CALC_CHAIN = "xl/calcChain.xml"
_VALUE = re.compile(rb"<(?:\w+:)?v\b[^>]*>[^<]+</(?:\w+:)?v>")
_SPANS = re.compile(rb'\sspans="[^"]*"')
_CONTROL = re.compile("[\x00-\x08\x0b\x0c\x0e-\x1f\ufffe\uffff\ud800-\udfff]")


@dataclass(frozen=True, slots=True, eq=False)
class _Element:
    """A row or a cell in the bytes of a sheet: where it starts and ends, and its start tag."""

    name: bytes
    attributes: Mapping[str, str]
    start: int
    opened: int  # where its start tag ends
    closing: int  # where its end tag starts
    end: int

    def insertion(self, before: _Element | None, content: bytes) -> _Edit:
        """Return the edit that adds to its content, before one of its children or at its end."""
        if before is not None:
            return before.start, before.start, content
        if self.closing < self.end:
            return self.closing, self.closing, content
        return self.end - len(b"/>"), self.end, b">%b</%b>" % (content, self.name)


@dataclass(slots=True)
class _Sheet:
    """Where the rows and the cells of a sheet are in its bytes."""

    data: _Element | None = None
    rows: dict[int, _Element] = field(default_factory=dict)
    cells: dict[int, dict[int, _Element]] = field(default_factory=dict)
    formulas: dict[tuple[int, int], Mapping[str, str]] = field(default_factory=dict)
    columns: list[tuple[range, Mapping[str, str], int, int]] = field(default_factory=list)

    def style(self, row: int, column: int) -> str:
        """Return the style of a cell; of one that is not there, that of its row or column."""
        if cell := self.cells.get(row, {}).get(column):
            return cell.attributes.get("s", "")
        if row in self.rows and self.rows[row].attributes.get("customFormat") in ("1", "true"):
            return self.rows[row].attributes.get("s", "")
        styles = (
            said["style"] for at, said, *_ in self.columns if column in at and "style" in said
        )
        return next(styles, "")


def changed(
    data: bytes,
    changes: Mapping[CellPosition, Value],
    stale: Set[CellPosition] = frozenset(),
    *,
    recalculates: bool = True,
) -> bytes:
    """Return a workbook with other contents of some cells; formulas are computed when it is opened.

    Parameters
    ----------
    changes : mapping of CellPosition to value
        None leaves a cell blank. Each keeps its format.
    stale : set of CellPosition, optional
        Formulas that lose their values: LibreOffice would keep them.
    recalculates : bool
        Not where no formula refers to the cells.
    """
    with zipfile.ZipFile(io.BytesIO(data)) as archive:
        parts = dict(sheet_parts(archive))
        new: dict[str, bytes] = {}
        had_formula = False
        for title in dict.fromkeys(position.sheet for position in (*changes, *stale)):
            if title not in parts:
                raise InputError(f"{title}: the sheet is missing")
            cells = {(p.row, p.column): v for p, v in changes.items() if p.sheet == title}
            before = archive.read(parts[title])
            sheet = _scanned(title, before)
            had_formula |= any(at in sheet.formulas for at in cells)
            had_formula |= any(isinstance(value, Formula) for value in cells.values())
            values = [sheet.cells[at.row][at.column] for at in stale if at.sheet == title]
            new[parts[title]] = _spliced(title, before, sheet, cells, values)
            new |= _longer_tables(archive, parts[title], cells)
        if recalculates:
            new["xl/workbook.xml"] = _computed_when_opened(archive.read("xl/workbook.xml"))
        left_out = _without_chain(archive, new) if had_formula else frozenset()
        out = io.BytesIO()
        with zipfile.ZipFile(out, "w", zipfile.ZIP_DEFLATED) as packed:
            for member in archive.infolist():
                if member.filename not in left_out:
                    content = new.get(member.filename, archive.read(member))
                    packed.writestr(member, content, compress_type=member.compress_type)
    return out.getvalue()


def _scanned(title: str, data: bytes) -> _Sheet:
    if re.match(rb'<\?xml[^>]*encoding=["\'](?!utf-8["\'])', data, re.IGNORECASE):
        raise InputError(f"{title}: not in UTF-8; {REOPEN}")
    scan = _Scan(title, data)
    parser = expat.ParserCreate()
    parser.StartElementHandler = scan.start
    parser.EndElementHandler = scan.end
    scan.parser = parser
    try:
        parser.Parse(data, True)
    except expat.ExpatError as error:
        raise InputError(f"{title}: damaged; {REOPEN}") from error
    if scan.sheet.data is None:
        raise InputError(f"{title}: has no cells; {REOPEN}")
    return scan.sheet


_NESTED = ("row", "c", "sheetData")


class _Scan:
    """Collects rows and cells with their places while a sheet is parsed."""

    parser: expat.XMLParserType

    def __init__(self, title: str, data: bytes) -> None:
        self.sheet = _Sheet()
        self._title, self._data = title, data
        self._open: list[tuple[str, Mapping[str, str], int, int]] = []
        self._row = 0

    def start(self, name: str, attributes: dict[str, str]) -> None:
        """Note the start of an element."""
        local = name.rpartition(":")[2]
        at = self.parser.CurrentByteIndex
        if local in _NESTED:
            if local != "sheetData" and "r" not in attributes:
                raise InputError(f"{self._title}: has cells without addresses; {REOPEN}")
            self._open.append((name, attributes, at, _tag_end(self._data, at)))
        if local == "row":
            self._row = int(attributes["r"])
        elif local == "col":
            low, high = int(attributes["min"]), int(attributes["max"])
            columns, end = range(low, high + 1), _tag_end(self._data, at)
            self.sheet.columns.append((columns, attributes, at, end))
        elif local == "f" and self._open:
            row, column = coordinate_to_tuple(self._open[-1][1]["r"])
            self.sheet.formulas[row, column] = attributes

    def end(self, name: str) -> None:
        """Note the end of an element."""
        local = name.rpartition(":")[2]
        if local not in _NESTED:
            return
        _, attributes, start, opened = self._open.pop()
        at = self.parser.CurrentByteIndex
        has_end = self._data.startswith(f"</{name}".encode(), at)
        end = self._data.index(b">", at) + 1 if has_end else at
        closing = at if has_end else end
        element = _Element(name.encode(), attributes, start, opened, closing, end)
        match local:
            case "sheetData":
                self.sheet.data = element
            case "row":
                self.sheet.rows[self._row] = element
            case "c":
                column = coordinate_to_tuple(attributes["r"])[1]
                self.sheet.cells.setdefault(self._row, {})[column] = element


def _tag_end(data: bytes, start: int) -> int:
    """Return where a start tag ends; its attributes may hold a > in quotes."""
    match = re.compile(rb"""<(?:[^>"']|"[^"]*"|'[^']*')*>""").match(data, start)
    return match.end() if match else start


def _spliced(
    title: str, data: bytes, sheet: _Sheet, cells: _Cells, stale: Sequence[_Element]
) -> bytes:
    """Return the bytes of a sheet with other contents of cells, and stale ones without values."""
    for row, column in cells:
        if _is_needed_elsewhere(sheet, row, column, cells):
            cell = f"{title}!{get_column_letter(column)}{row}"
            raise InputError(f"{cell}: shares its formula with other cells; clear it first")
    out, at = [], 0
    edits = [*_shown(data, sheet, cells), *_edits(data, sheet, cells)]
    for lost in stale:
        if value := _VALUE.search(data, lost.opened, lost.end):
            tag = re.sub(rb'\st="\w+"', b"", data[lost.start : lost.opened])
            edits += [(lost.start, lost.opened, tag), (*value.span(), b"")]
    for start, end, content in sorted(edits, key=lambda edit: edit[:2]):
        out += [data[at:start], content]
        at = end
    return b"".join([*out, data[at:]])


def _shown(data: bytes, sheet: _Sheet, cells: _Cells) -> Iterator[_Edit]:
    """Yield the edits that show columns which are hidden, folded groups also, and filled."""
    filled = {column for (_, column), value in cells.items() if value is not None}
    hidden = [
        columns
        for columns, said, *_ in sheet.columns
        if said.get("hidden") in ("1", "true") and filled.intersection(columns)
    ]
    for columns, _, start, end in sheet.columns:
        # Where a group ends, its mark would fold it again.
        is_end = any(columns.start == other.stop for other in hidden)
        if columns in hidden or is_end:
            names = rb"hidden|collapsed" if columns in hidden else rb"collapsed"
            yield start, end, re.sub(rb'\s(?:%b)="\w+"' % names, b"", data[start:end])


def _is_needed_elsewhere(sheet: _Sheet, row: int, column: int, cells: _Cells) -> bool:
    """Whether the formula of a cell is also that of cells which are not changed."""
    formula = sheet.formulas.get((row, column), {})
    reach = formula.get("ref", "")
    if formula.get("t") != "shared":
        return ":" in reach
    group = [at for at, other in sheet.formulas.items() if other.get("si") == formula.get("si")]
    return bool(reach) and not cells.keys() >= set(group)


def _edits(data: bytes, sheet: _Sheet, cells: _Cells) -> Iterator[_Edit]:
    """Yield the edits of cells that are there, and those that add cells and rows."""
    assert sheet.data is not None
    prefix = sheet.data.name.removesuffix(b"sheetData")
    added: dict[int, dict[int, bytes]] = {}
    for (row, column), value in sorted(cells.items(), key=lambda item: item[0]):
        content = _cell(prefix.decode(), sheet.style(row, column), row, column, value)
        if cell := sheet.cells.get(row, {}).get(column):
            yield cell.start, cell.end, content
        elif value is not None:
            added.setdefault(row, {})[column] = content
    inserted: dict[tuple[_Element, _Element | None], list[bytes]] = {}
    for row, written in added.items():
        home, old = sheet.rows.get(row), sheet.cells.get(row, {})
        if home is None:
            whole = b'<%brow r="%d">%b</%brow>' % (prefix, row, b"".join(written.values()), prefix)
            inserted.setdefault((sheet.data, _next(sheet.rows, row)), []).append(whole)
            continue
        if spans := _SPANS.search(data, home.start, home.opened):
            yield *spans.span(), b""
        for column, content in written.items():
            inserted.setdefault((home, _next(old, column)), []).append(content)
    for (parent, before), contents in inserted.items():
        yield parent.insertion(before, b"".join(contents))


def _next(elements: Mapping[int, _Element], number: int) -> _Element | None:
    """Return the first of the elements beyond a row or column."""
    return elements.get(min((at for at in elements if at > number), default=0))


def _cell(prefix: str, style: str, row: int, column: int, value: Value) -> bytes:
    """Return a cell; a number as such, a text within the cell itself."""
    start = f'<{prefix}c r="{get_column_letter(column)}{row}"' + (f' s="{style}"' if style else "")
    if value is None:
        return f"{start}/>".encode()
    if isinstance(value, Formula):
        inner = f"<{prefix}f>{escape(value[1:])}</{prefix}f>"
    elif isinstance(value, str):
        start += ' t="inlineStr"'
        words = escape(escaped(_CONTROL.sub("?", value)))
        text = f'<{prefix}t xml:space="preserve">{words}</{prefix}t>'
        inner = f"<{prefix}is>{text}</{prefix}is>"
    else:
        # A number of numpy is written as a number of Python.
        number = value if isinstance(value, int) else float(value)
        inner = f"<{prefix}v>{number!r}</{prefix}v>"
    return f"{start}>{inner}</{prefix}c>".encode()


def _computed_when_opened(workbook: bytes) -> bytes:
    """Return the part of the workbook that asks for all formulas to be computed when opened."""
    match = re.search(rb"<((?:\w+:)?)calcPr\b[^>]*?/?>", workbook)
    if match is None:
        return workbook
    if b"fullCalcOnLoad" in match[0]:
        tag = re.sub(rb'fullCalcOnLoad="[^"]*"', b'fullCalcOnLoad="1"', match[0])
    else:
        tag = match[0].replace(b"calcPr", b'calcPr fullCalcOnLoad="1"', 1)
    return workbook[: match.start()] + tag + workbook[match.end() :]


def _without_chain(archive: zipfile.ZipFile, new: dict[str, bytes]) -> frozenset[str]:
    """Leave out the order of computation, which may name a cell that is no formula any more."""
    if _CALC_CHAIN not in archive.namelist():
        return frozenset()
    for name in ("[Content_Types].xml", "xl/_rels/workbook.xml.rels"):
        content = new.get(name, archive.read(name))
        new[name] = re.sub(rb"<[^<>]*calcChain\.xml[^<>]*/>", b"", content)
    return frozenset({_CALC_CHAIN})


def _longer_tables(
    archive: zipfile.ZipFile, part: str, cells: _Cells
) -> Iterator[tuple[str, bytes]]:
    """Yield the tables of a sheet that grow to the rows written just below them."""
    filled = [at for at, value in cells.items() if value is not None]
    for name in _tables(archive, part):
        content = archive.read(name)
        match = re.search(rb'<(?:\w+:)?table\b[^>]*?\sref="([A-Z]+)(\d+):([A-Z]+)(\d+)"', content)
        if match is None or b"totalsRowCount" in content:
            continue
        left, right = (coordinate_to_tuple(f"{match[k].decode()}1")[1] for k in (1, 3))
        top, bottom = int(match[2]), int(match[4])
        below = {row for row, column in filled if row > bottom and left <= column <= right}
        last = bottom
        while last + 1 in below:
            last += 1
        if last > bottom:
            old = b"%b%d:%b%d" % (match[1], top, match[3], bottom)
            longer = b"%b%d:%b%d" % (match[1], top, match[3], last)
            yield name, content.replace(b'ref="%b"' % old, b'ref="%b"' % longer)


def _tables(archive: zipfile.ZipFile, part: str) -> Sequence[str]:
    """Return the parts of the tables on a sheet."""
    folder, _, name = part.rpartition("/")
    relations = f"{folder}/_rels/{name}.rels"
    if relations not in archive.namelist():
        return ()
    targets = re.findall(rb'Target="([^"]*tables/[^"]*)"', archive.read(relations))
    # A target may begin at the root of the archive.
    paths = [posixpath.join("/", folder, unescape(target.decode())) for target in targets]
    found = [posixpath.normpath(path).lstrip("/") for path in paths]
    return [target for target in found if target in archive.namelist()]
