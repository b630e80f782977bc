"""Files next to a workbook: which ones it may access, and the documents that it attaches."""

from __future__ import annotations

import hashlib
import posixpath
from collections.abc import Iterable
from dataclasses import dataclass
from itertools import chain, islice
from pathlib import Path, PurePosixPath, PureWindowsPath
from unicodedata import normalize

from pydantic import ValidationError

from report.project.model.finding import Finding
from report.project.model.input_rows import Inputs, Place
from report.project.read.archive import OpenBook
from report.project.read.years_file import YEARS, StudyYears
from report.project.workbook import SECTION
from report.project.workbook.entries import Entry
from report.text.grouping import grouped_by
from solver.errors import InputError
from solver.file_checks import check_length, read_file
from solver.suggestions import nearest

# Files among which one is sought whose name nearly fits, and names that are taken.
MOST_LISTED = 2_000


def path_beside(
    folder: Path, name: str, max_bytes: int, example: str, taken: Iterable[str] = ()
) -> Path:
    """Return the file of a name within the workbook's folder; names in use are not suggested.

    Raises `InputError` if it is outside the folder, also by a link, is no file, or is too large.
    """
    # A path may have been typed on Windows, and is read on any system.
    name = name.replace("\\", "/")
    where = f"use a file in the workbook's folder, such as {example}"
    # By the rules of both systems: the workbook of a stranger must not attach a file of this
    # computer to a package that is sent on.
    if PurePosixPath(name).is_absolute() or PureWindowsPath(name).drive or ".." in name.split("/"):
        raise InputError(f"'{name}' is outside the workbook's folder; {where}")
    try:
        # A link within the folder may lead out of it.
        path = _as_spelled(folder / name).resolve()
        if not path.is_relative_to(folder.resolve()):
            raise InputError(f"'{name}' is a link to a file outside the workbook's folder; {where}")
        if not path.exists():
            check_length(path)
            raise InputError(f"'{name}' does not exist; {_meant(folder, name, taken) or where}")
        if not path.is_file():
            raise InputError(f"'{name}' is not a file; {where}")
        size = path.stat().st_size
        path.open("rb").close()  # raises where that is not permitted
    except PermissionError as error:
        raise InputError(f"'{name}' cannot be read ({error.strerror}); allow it") from error
    # RuntimeError of links in a circle, ValueError of a null character.
    except (OSError, RuntimeError, ValueError) as error:
        if isinstance(error, InputError):
            raise
        raise InputError(f"'{name}' cannot be found; {where}") from error
    if size > max_bytes:
        raise InputError(f"'{name}' is {size / 1e6:.0f} MB; use at most {max_bytes / 1e6:.0f} MB")
    return path


def _as_spelled(path: Path) -> Path:
    """Return a path; if there is no such file, the one next to it with a similar-looking name."""
    if path.exists():
        return path
    # macOS writes the accent of a letter as a character of its own; Excel does not.
    name = normalize("NFC", path.name)
    files = islice(path.parent.glob("*"), MOST_LISTED)
    return next((file for file in files if normalize("NFC", file.name) == name), path)


def _meant(folder: Path, name: str, taken: Iterable[str]) -> str:
    """Suggest the file with a similar name, in the named folder or one of the workbook's."""
    asked = PurePosixPath(name)
    near = islice(chain((folder / asked).parent.glob("*"), folder.glob("*/*")), MOST_LISTED)
    by_stem = grouped_by((path for path in near if path.is_file()), lambda path: path.stem)
    stems = {PurePosixPath(name_taken).stem for name_taken in islice(taken, MOST_LISTED)}
    alike = by_stem.get(nearest(asked.stem, by_stem, stems), [])
    files = [path.relative_to(folder).as_posix() for path in alike]
    return f"did you mean '{nearest(name, files) or files[0]}'?" if files else ""


# Bytes of all documents that a workbook attaches.
MAX_DOCUMENTS = 20_000_000

DOCUMENTS = (
    ("site", "hazard_printout"),
    ("site", "acceptance_letter"),
    ("friction_tests", "report_file"),
    ("options", "peer_letter"),
    ("options", "study_years"),
)
"""Single cells that name a document to attach: a PDF, but for the study."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Document:
    """A document next to the workbook that the package attaches."""

    label: str  # of its cell
    path: str  # from the folder of the workbook
    size: int  # [bytes]
    sha256: str
    years: StudyYears | None = None  # of a study


def read_documents(book: OpenBook, inputs: Inputs) -> tuple[tuple[Document, ...], list[Finding]]:
    """Return the documents that a workbook attaches, and their problems."""
    documents: list[Document] = []
    faults: list[Finding] = []
    for section, field in DOCUMENTS:
        entry = SECTION[section].entry(field)
        for name in filter(None, (row.get(field) for row in inputs[section])):
            bytes_left = MAX_DOCUMENTS - sum(document.size for document in documents)
            try:
                documents.append(_document(book, entry, name, bytes_left))
            except InputError as error:
                (problem,) = error.parts
                text, place = f"{entry.spoken}: {problem.found}", Place(section, 0, field)
                faults.append(Finding.error(place, text, problem.remedy))
    return tuple(documents), faults


def _document(book: OpenBook, entry: Entry, name: str, bytes_left: int) -> Document:
    example = str(entry.example)
    file = path_beside(book.path.parent, name, MAX_DOCUMENTS, example)
    # Read once, and hashed and attached from memory: whatever lies there by then, the package
    # holds what was checked.
    content = read_file(file, MAX_DOCUMENTS, f"'{name}'", too_large="shrink it")
    years = _years(name, content) if entry.name == "study_years" else None
    # By its first bytes: any file may be named .pdf, and a package attaches what it is given.
    if years is None and not content.startswith(b"%PDF-"):
        raise InputError(f"'{name}' is not a PDF; attach it as a PDF")
    if len(content) > bytes_left:
        limit = f"{MAX_DOCUMENTS / 1e6:.0f} MB"
        raise InputError(f"'{name}' and the other documents have more than {limit}; shrink them")
    path = posixpath.normpath(name.replace("\\", "/"))
    sha256 = hashlib.sha256(content).hexdigest()
    book.files[sha256] = content
    return Document(label=entry.heading, path=path, size=len(content), sha256=sha256, years=years)


def _years(name: str, content: bytes) -> StudyYears:
    try:
        return StudyYears.model_validate_json(content)
    except ValidationError as error:
        first = error.errors()[0]
        where = ".".join(map(str, first["loc"])) or "its text"
        raise InputError(
            f"'{name}' is not a {YEARS} of a study ({where}: {first['msg']}); use the file that"
            " roofslip study writes where its workbook has a hazard curve"
        ) from error
