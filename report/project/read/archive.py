"""Opens an untrusted workbook, or reports why it cannot be used.

Makes every check that must precede openpyxl: file type, sizes, and that each sheet is a part of the
file; `scan` checks the content of the parts. Read `report.project.read.read` next.
"""

from __future__ import annotations

import hashlib
import io
import posixpath
import re
import warnings
import zipfile
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import chain
from pathlib import Path
from typing import IO, Any
from xml.etree.ElementTree import ParseError

import defusedxml.ElementTree
from openpyxl import Workbook, load_workbook
from openpyxl.worksheet.worksheet import Worksheet

from report.project.read.scan import REOPEN, Scan, UsedRange, scan_parts
from solver.errors import InputError
from solver.file_checks import check_length, read_file
from solver.suggestions import meant

MB = 1_000_000
MAX_FILE = 100 * MB
MAX_TOTAL = 100 * MB
MAX_MEMBER = 50 * MB
MAX_MEMBERS = 2000
# Deflate reaches at most 1032; sheets with identical rows reach about 100.
MAX_RATIO = 200

MOST_ASKED = 3  # workbooks
_CSV = "a text file"
OTHER_KINDS = {
    ".xls": "an old Excel workbook",
    ".xlsm": "a workbook with macros",
    ".xlsb": "a binary Excel workbook",
    ".xltx": "an Excel template",
    ".ods": "an OpenDocument spreadsheet",
    ".csv": _CSV,
    ".numbers": "a Numbers spreadsheet",
}
_WORKBOOK = "xl/workbook.xml"
_RELATIONS = "xl/_rels/workbook.xml.rels"
_MACROS = re.compile(rb"<Override\b(?=[^<>]*/xl/workbook\.xml)[^<>]*macroEnabled", re.IGNORECASE)
SAVE_AS = "save it as .xlsx (Excel Workbook)"
REL = "{http://schemas.openxmlformats.org/officeDocument/2006/relationships}id"


@dataclass(frozen=True, slots=True, kw_only=True)
class OpenBook:
    """A workbook with the values last computed by the program that saved it."""

    path: Path
    sha256: str
    book: Workbook
    sheets: Mapping[str, Worksheet]  # by the title, as the scans
    scans: Mapping[str, Scan]
    calculation: Mapping[str, str]  # how it was calculated when it was saved, as the file says it
    outside: Sequence[str] = ()  # what its formulas and links take values from
    # what a package holds, as it was read, by SHA-256: workbook and documents; records
    files: dict[str, bytes] = field(default_factory=dict)
    records: dict[str, bytes] = field(default_factory=dict)
    labels: dict[str, Sequence[Any]] = field(default_factory=dict)  # see `positions.labels`

    @property
    def data(self) -> bytes:
        """The content of its file."""
        return self.files[self.sha256]

    def extent(self, title: str) -> UsedRange:
        """Return the extent of a sheet's values."""
        return self.scans[title].extent

    def cells(self, title: str) -> Iterator[Any]:
        """Yield the cells of a sheet that its file has, row by row."""
        # openpyxl's own rows have every cell up to the last one, and make those that are missing.
        for row, column in sorted(self.scans[title].cells):
            yield self.sheets[title].cell(row, column)

    def formula(self, title: str, cell: str) -> str:
        """Return the formula typed into a cell, empty if there is none."""
        return self.scans[title].formula(cell)


def open_book(path: Path) -> OpenBook:
    """Open an .xlsx, or `input.xlsx` in a folder.

    Raises `InputError` if there is none, or it is another type of file, damaged, or too large.
    """
    path = located(path)
    return book_of(path, read_file(path, MAX_FILE, too_large="keep records in files next to it"))


def book_of(path: Path, data: bytes) -> OpenBook:
    """Open a workbook from the content of its file, existing or future; raises as `open_book`."""
    # Sizes before anything is unpacked, and the scan before openpyxl makes objects of the parts.
    with _zip(data) as archive:
        _check_sizes(archive)
        _check_kind(archive)
        parts = scan_parts({name: _content(archive, name) for name in archive.namelist()})
        scans = _scans_by_title(archive, parts)
        book = _load(data)
    # A sheet that openpyxl left out would be missing without a word.
    if book.sheetnames != list(scans):
        raise InputError(f"its worksheets cannot all be read; {REOPEN}")
    sha256 = hashlib.sha256(data).hexdigest()
    return OpenBook(
        path=path,
        sha256=sha256,
        files={sha256: data},
        book=book,
        sheets={sheet.title: sheet for sheet in book.worksheets},
        scans=scans,
        calculation=parts[_WORKBOOK].calculation,
        outside=tuple(dict.fromkeys(chain.from_iterable(scan.outside for scan in parts.values()))),
    )


def located(path: Path) -> Path:
    """Return the path of a workbook, or of `input.xlsx` in a folder; raises as `open_book`."""
    lacks = "no such file"
    if path.is_dir():
        asked, path = _workbook_in(path, path.parent), path / "input.xlsx"
        lacks = "a folder without input.xlsx"
    else:
        asked = meant(path) or _workbook_in(path.parent)
    if not path.exists():
        check_length(path)
        remedy = "use a workbook, or a folder that contains input.xlsx"
        raise InputError(f"{lacks}; {asked or remedy}")
    if not path.is_file():
        raise InputError("not a file; use a workbook, or a folder that contains input.xlsx")
    if path.suffix.lower() != ".xlsx":
        kind = OTHER_KINDS.get(path.suffix.lower(), "not a workbook file name")
        raise InputError(f"{kind} ({path.suffix or 'no extension'}); {SAVE_AS}")
    return path


def _workbook_in(*folders: Path) -> str:
    """Suggest the workbooks of the first folder that has any, or name one of another type."""
    for folder in filter(Path.is_dir, folders):
        # Excel puts ~$NAME beside a workbook that is open; the others are results.
        files = sorted(
            file
            for file in folder.iterdir()
            if not file.name.startswith("~$") and file.name not in ("results.xlsx", "study.xlsx")
        )
        if books := [file for file in files if file.suffix.lower() == ".xlsx"]:
            names = " or ".join(f"'{file}'" for file in books)
            return f"did you mean {names}?" if len(books) <= MOST_ASKED else ""
        other_files = [file for file in files if OTHER_KINDS.get(file.suffix.lower(), _CSV) != _CSV]
        if len(other_files) == 1:
            return f"'{other_files[0]}' is {OTHER_KINDS[other_files[0].suffix.lower()]}; {SAVE_AS}"
    return ""


def _zip(data: bytes) -> zipfile.ZipFile:
    if not data:
        raise InputError("empty file; start again with a new workbook (roofslip new FOLDER)")
    # An OLE file: an .xls, or the container in which Office encrypts an .xlsx.
    if data.startswith(b"\xd0\xcf\x11\xe0"):
        # The stream that holds an encrypted workbook ([MS-OFFCRYPTO]); OLE has names in UTF-16.
        if "EncryptedPackage".encode("utf-16-le") in data:
            raise InputError("protected with a password; save it without a password")
        raise InputError(f"an old Excel workbook (.xls) by its content; {SAVE_AS}")
    return zip_of(io.BytesIO(data), f"not a workbook, or truncated; {REOPEN}")


def zip_of(content: IO[bytes], damaged: str) -> zipfile.ZipFile:
    """Return a zip, opened; raises `InputError` for one with too many parts, or damaged."""
    # The library makes an object of each entry of the directory before anything can be refused,
    # however many the record at the end states; each begins with these bytes.
    content.seek(0)
    count = content.read().count(b"PK\x01\x02")
    if count > MAX_MEMBERS:
        raise InputError(f"has {count:,} parts, more than {MAX_MEMBERS:,}; use a smaller one")
    try:
        return zipfile.ZipFile(content)
    except (zipfile.BadZipFile, ArithmeticError, ValueError, RuntimeError, OSError) as error:
        raise InputError(damaged) from error


def _check_sizes(archive: zipfile.ZipFile) -> None:
    members = archive.infolist()
    # zipfile never returns more of a member than the directory states, so these sizes are limits.
    total = sum(m.file_size for m in members)
    largest = max((m.file_size for m in members), default=0)
    packed = sum(m.compress_size for m in members)
    if total > MAX_TOTAL or largest > MAX_MEMBER:
        raise InputError(
            f"unpacks to {total / MB:.0f} MB, more than {MAX_TOTAL // MB} MB in total or"
            f" {MAX_MEMBER // MB} MB in one part; keep records in files next to it"
        )
    # Below 1 MB no ratio is a danger.
    if total > MB and total > MAX_RATIO * packed:
        raise InputError(f"unpacks to more than {MAX_RATIO} times its size; {REOPEN}")


def _check_kind(archive: zipfile.ZipFile) -> None:
    names = set(archive.namelist())
    if any(member.flag_bits & 1 for member in archive.infolist()):
        raise InputError("protected with a password; save it without a password")
    # Macros are never run here; the package would attach them to what is handed to a plan checker.
    if any(name.lower().endswith("vbaproject.bin") for name in names):
        raise InputError(f"a workbook with macros; {SAVE_AS}")
    if "xl/workbook.bin" in names:
        raise InputError(f"a binary Excel workbook (.xlsb) by its content; {SAVE_AS}")
    if "mimetype" in names and "content.xml" in names:
        raise InputError(f"an OpenDocument spreadsheet (.ods) by its content; {SAVE_AS}")
    if not {"[Content_Types].xml", _WORKBOOK} <= names:
        raise InputError(f"a zip archive, but not a workbook; {SAVE_AS}")
    # Its names are others, which openpyxl does not know.
    if b"http://purl.oclc.org/ooxml/" in _content(archive, _WORKBOOK):
        raise InputError(
            "a Strict Open XML workbook; save it as Excel Workbook (.xlsx), not Strict"
        )
    # SheetJS writes such a default for parts that there are none of; what counts is the workbook's.
    if _MACROS.search(_content(archive, "[Content_Types].xml")):
        raise InputError(f"a workbook with macros; {SAVE_AS}")


def _content(archive: zipfile.ZipFile, name: str) -> bytes:
    try:
        return archive.read(name)
    except Exception as error:  # zlib, lzma and bz2 raise errors of their own
        raise InputError(f"damaged at {name}; {REOPEN}") from error


def _scans_by_title(archive: zipfile.ZipFile, scans: Mapping[str, Scan]) -> dict[str, Scan]:
    by_title = {}
    for title, part in sheet_parts(archive):
        # openpyxl would skip it, and its rows would be lost without a word.
        if part not in scans:
            raise InputError(
                f"worksheet '{title}': its part {part or '(no name)'} is missing; {REOPEN}"
            )
        if scans[part].is_beyond:
            raise InputError(f"damaged at {part}; {REOPEN}")
        by_title[title] = scans[part]
        if scans[part].twice:
            raise InputError(f"{title}!{scans[part].twice}: the file has this cell twice; {REOPEN}")
    if scans[_WORKBOOK].twice:
        raise InputError(f"the file contains the name {scans[_WORKBOOK].twice} twice; {REOPEN}")
    return by_title


def sheet_parts(archive: zipfile.ZipFile) -> list[tuple[str, str]]:
    """Return each sheet's title with the name of its part, as openpyxl resolves it."""
    # Targets are relative to the part of the workbook (ECMA-376-2, 9.3).
    targets = {
        item.get("Id"): posixpath.normpath(posixpath.join("/xl", item.get("Target"))).lstrip("/")
        for item in _tree(archive, _RELATIONS)
        if item.get("Target")
    }
    listed = [
        (element.get("name", ""), targets.get(element.get(REL), ""))
        for element in _tree(archive, _WORKBOOK).iter()
        if element.tag.rpartition("}")[2] == "sheet"
    ]
    # Excel makes no such file, and its references to a sheet by its name would be to either of
    # them.
    for title, count in Counter(title.casefold() for title, _ in listed).items():
        if count > 1:
            raise InputError(f"two worksheets have the name '{title}'; rename one")
    return listed


def _tree(archive: zipfile.ZipFile, name: str) -> Any:
    try:
        return defusedxml.ElementTree.fromstring(_content(archive, name), forbid_dtd=True)
    except ParseError as error:  # of names: the scan knows no namespaces
        raise InputError(f"damaged at {name}; {REOPEN}") from error


def _load(data: bytes) -> Workbook:
    try:
        with warnings.catch_warnings():
            # It warns about features that it drops, none of which is an input.
            warnings.simplefilter("ignore")
            # Values alone: formulas are kept by the scan, for openpyxl gives one or the other.
            # Links to other workbooks are not followed in any case.
            return load_workbook(io.BytesIO(data), data_only=True, keep_links=False)
    except Exception as error:  # a damaged workbook makes openpyxl raise almost anything
        raise InputError(f"damaged, or not as Excel writes it; {REOPEN}") from error
