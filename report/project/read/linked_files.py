"""Files beside a workbook: which of them it may access, and the documents that it attaches.

One of them is years.json of a study, what arrays see in their life: lengths in meters, null for
none. Records are read by `report.motions`. Read `path_beside`, `read_documents`, `StudyYears`.
"""

from __future__ import annotations

import hashlib
import math
import posixpath
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from itertools import chain, islice
from pathlib import Path, PurePosixPath, PureWindowsPath
from typing import Annotated, Final, Literal
from unicodedata import normalize

from pydantic import BaseModel, BeforeValidator, ConfigDict, ValidationError

from report.project.model.finding import Finding
from report.project.model.input_rows import Inputs
from report.project.model.place import Place
from report.project.read.archive import OpenBook
from report.project.workbook import SECTION
from report.project.workbook.entries import Entry
from report.text.counts import grouped_by
from solver.files import check_length
from solver.model import InputError
from solver.suggestions import nearest

# Bytes of all documents that a workbook attaches.
MAX_DOCUMENTS = 20_000_000

# Files among which one is sought whose name nearly fits, and names that are taken.
MOST_LISTED = 2_000

DOCUMENTS = (
    ("site", "hazard_printout"),
    ("site", "acceptance_letter"),
    ("friction_tests", "report_file"),
    ("options", "peer_letter"),
    ("options", "study_years"),
)
"""Single cells that name a document to attach: a PDF, but for the study."""


SUPPORTING: Final = "Supporting analysis, not a code value"
YEARS = "years.json"
# When an array is put back where it was installed.
NEVER, ABOVE, ALWAYS = "never", "above a distance", "after every event"


# JSON has no infinity: a distance without bound is null.
Meters = Annotated[
    float | None, BeforeValidator(lambda v: None if isinstance(v, float) and math.isinf(v) else v)
]


class _Written(BaseModel):
    model_config = ConfigDict(
        frozen=True, extra="forbid", allow_inf_nan=False, from_attributes=True
    )


class Distance(_Written):
    """A distance from the installed place over lives, as in `LifeStatistics`."""

    mean_m: Meters
    p95_m: Meters
    beyond: float
    without_value: float


class YearsOfArray(_Written):
    """One array on one building."""

    array: str
    building: str
    slope_deg: float
    mu: float
    clearance_m: float
    clearance_rate: float
    prd_m: Mapping[str, Meters]  # by mean recurrence interval in years
    largest: Mapping[str, Distance]  # by when the array is put back
    last: Mapping[str, Distance]


class StudyYears(_Written):
    """The whole file."""

    note: Literal["Supporting analysis, not a code value"]
    title: str
    date: str
    study: str  # identity of its manifest
    program: str
    hazard: Mapping[str, str | float | None]  # the cells of the sheet Hazard
    life_years: float
    arrays: tuple[YearsOfArray, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class Document:
    """A document beside the workbook, which the package attaches."""

    label: str  # of its cell
    path: str  # from the folder of the workbook
    size: int  # [bytes]
    sha256: str


def path_beside(
    folder: Path, name: str, max_bytes: int, example: str, taken: Iterable[str] = ()
) -> Path:
    """Return the file of a name within the workbook's folder; names that are taken are not meant.

    Raises `InputError` if it is outside the folder, also by a link, is no file, or is too large.
    """
    # A path may have been typed on Windows, and is read on any system.
    name = name.replace("\\", "/")
    where = f"give a file in the workbook's folder, such as {example}"
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
        raise InputError(f"'{name}' has {size / 1e6:.0f} MB; give at most {max_bytes / 1e6:.0f} MB")
    return path


def _as_spelled(path: Path) -> Path:
    """Return a path; where there is no such file, the one beside it whose name looks the same."""
    if path.exists():
        return path
    # macOS writes the accent of a letter as a character of its own; Excel does not.
    name = normalize("NFC", path.name)
    beside = islice(path.parent.glob("*"), MOST_LISTED)
    return next((file for file in beside if normalize("NFC", file.name) == name), path)


def _meant(folder: Path, name: str, taken: Iterable[str]) -> str:
    """Ask for the file whose name nearly fits, in the named folder or one of the workbook's."""
    wanted = PurePosixPath(name)
    near = islice(chain((folder / wanted).parent.glob("*"), folder.glob("*/*")), MOST_LISTED)
    by_stem = grouped_by((path for path in near if path.is_file()), lambda path: path.stem)
    stems = {PurePosixPath(each).stem for each in islice(taken, MOST_LISTED)}
    alike = by_stem.get(nearest(wanted.stem, by_stem, stems), [])
    files = [path.relative_to(folder).as_posix() for path in alike]
    return f"did you mean '{nearest(name, files) or files[0]}'?" if files else ""


def read_documents(book: OpenBook, inputs: Inputs) -> tuple[tuple[Document, ...], list[Finding]]:
    """Return the documents that a workbook attaches, and what is wrong with them."""
    documents: list[Document] = []
    faults: list[Finding] = []
    for section, field in DOCUMENTS:
        entry = SECTION[section].entry(field)
        for name in filter(None, (row.get(field) for row in inputs[section])):
            left = MAX_DOCUMENTS - sum(document.size for document in documents)
            try:
                documents.append(_document(book, entry, name, left))
            except InputError as error:
                (problem,) = error.parts
                text, place = f"{entry.spoken}: {problem.found}", Place(section, 0, field)
                faults.append(Finding.error(place, text, problem.remedy))
    return tuple(documents), faults


def _document(book: OpenBook, entry: Entry, name: str, left: int) -> Document:
    example = str(entry.example)
    content = path_beside(book.path.parent, name, MAX_DOCUMENTS, example).read_bytes()
    if entry.name == "study_years":
        _check_years(name, content)
    elif not content.startswith(b"%PDF-"):
        raise InputError(f"'{name}' is no PDF; attach it as a PDF")
    if len(content) > left:
        most = f"{MAX_DOCUMENTS / 1e6:.0f} MB"
        raise InputError(f"'{name}' and the other documents have more than {most}; shrink them")
    path = posixpath.normpath(name.replace("\\", "/"))
    sha256 = hashlib.sha256(content).hexdigest()
    book.files[sha256] = content
    return Document(label=entry.heading, path=path, size=len(content), sha256=sha256)


def _check_years(name: str, content: bytes) -> None:
    try:
        StudyYears.model_validate_json(content)
    except ValidationError as error:
        first = error.errors()[0]
        where = ".".join(map(str, first["loc"])) or "its text"
        raise InputError(
            f"'{name}' is no {YEARS} of a study ({where}: {first['msg']}); give the file that"
            " roofslip study writes where its workbook has a hazard curve"
        ) from error
