"""Opens an untrusted workbook, or reports why it cannot be used.

Owns every check that must precede openpyxl: file type, size, far-away cells, XML entities.
Independent of the fields of the sheets. Read `report.sheet.read` next.
"""

from __future__ import annotations

import hashlib
import io
import warnings
import zipfile
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any
from xml.sax import SAXException
from xml.sax.handler import ContentHandler

import defusedxml.ElementTree
import defusedxml.sax
from defusedxml import DefusedXmlException
from openpyxl import DEFUSEDXML, Workbook, load_workbook
from openpyxl.utils import coordinate_to_tuple, get_column_letter, range_boundaries

from solver.model import DefectError, InputError

MB = 1_000_000
MAX_FILE = 100 * MB
MAX_TOTAL = 100 * MB
MAX_MEMBER = 50 * MB
MAX_MEMBERS = 2000
# Deflate reaches at most 1032; sheets with identical rows reach about 100.
MAX_RATIO = 200
MAX_CELLS = 3_000_000
MAX_SPREAD_CELLS = 100_000

OTHER_KINDS = {
    ".xls": "an old Excel workbook",
    ".xlsm": "a workbook with macros",
    ".xlsb": "a binary Excel workbook",
    ".xltx": "an Excel template",
    ".ods": "an OpenDocument sheet",
    ".csv": "a text file",
    ".numbers": "a Numbers sheet",
}
SAVE_AS = "save it as .xlsx (Excel Workbook)"
REOPEN = "open it in Excel or LibreOffice and save it again"
REL = "{http://schemas.openxmlformats.org/officeDocument/2006/relationships}id"


@dataclass(slots=True)
class Extent:
    """Extent of a sheet's values: last row and last column, each with the cell that sets it."""

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


@dataclass(frozen=True, slots=True, kw_only=True)
class OpenBook:
    """A workbook, read twice: as typed, and as last computed by the program that saved it.

    Attributes
    ----------
    path : Path
    sha256 : str
        Of the file.
    typed, computed : Workbook
        The same object if there is no formula.
    extents : mapping of sheet title to Extent
    """

    path: Path
    sha256: str
    typed: Workbook
    computed: Workbook
    extents: Mapping[str, Extent]

    def extent(self, title: str) -> Extent:
        """Return the extent of a sheet's values."""
        return self.extents.get(title, Extent())


def open_book(path: Path) -> OpenBook:
    """Open an .xlsx, or `input.xlsx` in a folder.

    Raises
    ------
    InputError
        If there is none, or it is another type of file, damaged, or too large.
    """
    path = _located(path)
    data = _read(path)
    with _zip(data) as archive:
        _check_sizes(archive)
        _check_kind(archive)
        scans = _scan(archive)
        extents = {title: scans[part].extent for title, part in _parts(archive) if part in scans}
    typed = _load(data, computed=False)
    has_formula = any(scan.has_formula for scan in scans.values())
    return OpenBook(
        path=path,
        sha256=hashlib.sha256(data).hexdigest(),
        typed=typed,
        computed=_load(data, computed=True) if has_formula else typed,
        extents=extents,
    )


def _located(path: Path) -> Path:
    if path.is_dir():
        path = path / "input.xlsx"
    if not path.exists():
        raise InputError("no such file; give a workbook, or a folder that holds input.xlsx")
    if not path.is_file():
        raise InputError("not a file; give a workbook, or a folder that holds input.xlsx")
    if path.suffix.lower() != ".xlsx":
        kind = OTHER_KINDS.get(path.suffix.lower(), "not a workbook file name")
        raise InputError(f"{kind} ({path.suffix or 'no extension'}); {SAVE_AS}")
    return path


def _read(path: Path) -> bytes:
    try:
        if path.stat().st_size > MAX_FILE:
            raise InputError(f"larger than {MAX_FILE // MB} MB; keep records in files beside it")
        return path.read_bytes()
    except OSError as error:
        raise InputError(
            f"cannot be read ({error.strerror}); close it in other programs"
        ) from error


def _zip(data: bytes) -> zipfile.ZipFile:
    if not data:
        raise InputError("empty file; start again from a fresh workbook (roofslip new)")
    if data.startswith(b"\xd0\xcf\x11\xe0"):
        if "EncryptedPackage".encode("utf-16-le") in data:
            raise InputError("protected with a password; save it without one")
        raise InputError(f"an old Excel workbook (.xls) by its content; {SAVE_AS}")
    try:
        return zipfile.ZipFile(io.BytesIO(data))
    except (zipfile.BadZipFile, ValueError, NotImplementedError, OSError) as error:
        raise InputError(f"not a workbook, or truncated; {REOPEN}") from error


def _check_sizes(archive: zipfile.ZipFile) -> None:
    members = archive.infolist()
    # zipfile never returns more of a member than the directory states, so these sizes are limits.
    total = sum(m.file_size for m in members)
    largest = max((m.file_size for m in members), default=0)
    packed = sum(m.compress_size for m in members)
    if len(members) > MAX_MEMBERS:
        raise InputError(f"has {len(members)} parts, more than {MAX_MEMBERS}; {REOPEN}")
    if total > MAX_TOTAL or largest > MAX_MEMBER:
        raise InputError(
            f"unpacks to {total / MB:.0f} MB, more than {MAX_TOTAL // MB} MB in total or"
            f" {MAX_MEMBER // MB} MB in one part; keep records in files beside it"
        )
    if total > MB and total > MAX_RATIO * packed:
        raise InputError(f"unpacks to more than {MAX_RATIO} times its size; {REOPEN}")


def _check_kind(archive: zipfile.ZipFile) -> None:
    names = set(archive.namelist())
    if any(member.flag_bits & 1 for member in archive.infolist()):
        raise InputError("protected with a password; save it without one")
    if any(name.lower().endswith("vbaproject.bin") for name in names):
        raise InputError(f"a workbook with macros; {SAVE_AS}")
    if "xl/workbook.bin" in names:
        raise InputError(f"a binary Excel workbook (.xlsb) by its content; {SAVE_AS}")
    if "mimetype" in names and "content.xml" in names:
        raise InputError(f"an OpenDocument sheet (.ods) by its content; {SAVE_AS}")
    if not {"[Content_Types].xml", "xl/workbook.xml"} <= names:
        raise InputError(f"a zip archive, but not a workbook; {SAVE_AS}")
    if b"macroEnabled" in _content(archive, "[Content_Types].xml"):
        raise InputError(f"a workbook with macros; {SAVE_AS}")


def _content(archive: zipfile.ZipFile, name: str) -> bytes:
    try:
        return archive.read(name)
    except (zipfile.BadZipFile, EOFError, OSError, NotImplementedError, ValueError) as error:
        raise InputError(f"damaged at {name}; {REOPEN}") from error
    except Exception as error:  # zlib, lzma and bz2 raise errors of their own
        raise InputError(f"damaged at {name} ({error}); {REOPEN}") from error


@dataclass(slots=True)
class _Scan(ContentHandler):
    """Scans the XML of a part for the extent of values, formulas and large ranges."""

    budget: list[int]
    extent: Extent = field(default_factory=Extent)
    has_formula: bool = False
    spread: int = 0
    row: int = 0
    column: int = 0

    def startElement(self, name: str, attrs: Any) -> None:  # noqa: N802
        match name.rpartition(":")[2]:
            case "row":
                self.row, self.column = _whole(attrs.get("r"), self.row + 1), 0
            case "c":
                self._start_cell(attrs.get("r"))
            case "v" | "is":
                self.extent.grow(self.row, self.column)
            case "f":
                self.has_formula = True
                self.extent.grow(self.row, self.column)
            case "mergeCell" | "hyperlink":
                self._spread(attrs.get("ref"))

    def _start_cell(self, reference: str | None) -> None:
        self.column += 1
        if reference:
            self.row, self.column = coordinate_to_tuple(reference)
        self.budget[0] -= 1
        if self.budget[0] < 0:
            raise InputError(f"more than {MAX_CELLS:,} cells; keep records in files beside it")

    def _spread(self, reference: str | None) -> None:
        # openpyxl creates an object for every cell of such a range.
        if not reference or ":" not in reference:
            return
        left, top, right, bottom = (side or 0 for side in range_boundaries(reference))
        whole = 0 in (left, top, right, bottom)  # such as A:C
        area = (abs(right - left) + 1) * (abs(bottom - top) + 1)
        self.spread += MAX_CELLS if whole else area
        if self.spread > MAX_SPREAD_CELLS:
            raise InputError(
                f"merged cells or links over {reference}; unmerge them, or remove the links"
            )


def _whole(text: str | None, default: int) -> int:
    return int(text) if text else default


def _scan(archive: zipfile.ZipFile) -> dict[str, _Scan]:
    budget = [MAX_CELLS]
    scans = {}
    for name in archive.namelist():
        data = _content(archive, name)
        if data.lstrip(b"\xef\xbb\xbf \t\r\n").startswith((b"<", b"\xff\xfe", b"\xfe\xff")):
            scans[name] = _Scan(budget)
            _walk(name, data, scans[name])
    return scans


def _walk(name: str, data: bytes, scan: _Scan) -> None:
    try:
        defusedxml.sax.parseString(data, scan, forbid_dtd=True)
    except DefusedXmlException as error:
        raise InputError(f"contains XML entity declarations at {name}; {REOPEN}") from error
    except InputError as error:
        raise InputError(f"{name}: {error.problems[0]}") from error
    except (SAXException, ValueError, LookupError) as error:  # LookupError: unknown encodings
        raise InputError(f"damaged at {name}; {REOPEN}") from error


def _parts(archive: zipfile.ZipFile) -> Iterator[tuple[str, str]]:
    """Yield each sheet's title with the name of its part."""
    targets = {}
    if "xl/_rels/workbook.xml.rels" in archive.namelist():
        relations = _tree(archive, "xl/_rels/workbook.xml.rels")
        targets = {item.get("Id"): item.get("Target", "") for item in relations}
    for element in _tree(archive, "xl/workbook.xml").iter():
        if element.tag.rpartition("}")[2] == "sheet":
            target = targets.get(element.get(REL), "")
            part = target.lstrip("/") if target.startswith("/") else f"xl/{target}"
            yield element.get("name", ""), part


def _tree(archive: zipfile.ZipFile, name: str) -> Any:
    return defusedxml.ElementTree.fromstring(_content(archive, name), forbid_dtd=True)


def _load(data: bytes, computed: bool) -> Workbook:
    if not DEFUSEDXML:
        raise DefectError("openpyxl does not read through defusedxml")
    try:
        with warnings.catch_warnings():
            # It warns about features that it drops, none of which is an input.
            warnings.simplefilter("ignore")
            return load_workbook(io.BytesIO(data), data_only=computed, keep_links=False)
    except Exception as error:  # a damaged workbook makes openpyxl raise almost anything
        raise InputError(f"damaged ({type(error).__name__}: {error}); {REOPEN}") from error
