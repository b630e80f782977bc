"""The documents that a workbook attaches."""

from __future__ import annotations

import hashlib
import posixpath
from dataclasses import dataclass

from pydantic import ValidationError

from report.project.model.finding import Finding
from report.project.model.input_rows import Inputs
from report.project.model.place import Place
from report.project.read.archive import OpenBook
from report.project.read.linked_files import path_beside
from report.project.read.study_years import YEARS, StudyYears
from report.project.workbook import SECTION
from report.project.workbook.entries import Entry
from solver.errors import InputError
from solver.file_checks import read_file

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
    """A document beside the workbook, which the package attaches."""

    label: str  # of its cell
    path: str  # from the folder of the workbook
    size: int  # [bytes]
    sha256: str
    years: StudyYears | None = None  # of a study


def read_documents(book: OpenBook, inputs: Inputs) -> tuple[tuple[Document, ...], list[Finding]]:
    """Return the documents that a workbook attaches, and what is wrong with them."""
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
    content = read_file(file, MAX_DOCUMENTS, f"'{name}'", too_large="shrink it")
    years = _years(name, content) if entry.name == "study_years" else None
    if years is None and not content.startswith(b"%PDF-"):
        raise InputError(f"'{name}' is no PDF; attach it as a PDF")
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
            f"'{name}' is no {YEARS} of a study ({where}: {first['msg']}); give the file that"
            " roofslip study writes where its workbook has a hazard curve"
        ) from error
