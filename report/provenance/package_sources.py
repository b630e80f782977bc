"""The files that a package is computed from, as attachments of the package, and their hashes.

Reads no file and runs nothing. Read `attachments`; `report.proof` takes them out.

The software that computes a package: the parts whose versions matter to numbers and pages.
"""

from __future__ import annotations

import hashlib
import json
import platform
import posixpath
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import cache
from importlib import metadata
from pathlib import Path
from typing import Annotated

from pydantic import BaseModel, ConfigDict, StringConstraints

from report.motions.components import RecordFile
from report.motions.prepare import Shaking
from report.motions.record_reading import BAR, MOST_RECORDS
from report.project.read.workbook_data import Sheet, WorkbookSource
from report.provenance.release import version
from report.typeset.finish import Attached
from solver.errors import InputError

# Those that numbers, pages or the bytes of the file come from; not tools and servers.
_LIBRARIES = (
    "numpy",
    "numba",
    "llvmlite",
    "pandas",
    "openpyxl",
    "lxml",
    "matplotlib",
    "weasyprint",
    "pydyf",
    "fonttools",
)


@cache
def versions() -> Mapping[str, str]:
    """Return the versions that a package prints, by name, except packages not installed."""
    by_name = {"roofslip": version(), "python": platform.python_version()}
    for name in _LIBRARIES:
        with suppress(metadata.PackageNotFoundError):
            by_name[name] = metadata.version(name)
    return by_name


def environment() -> Mapping[str, str]:
    """Return the versions, and the system and processor."""
    # The mathematical functions of the C library round by version and processor.
    system = f"{platform.system()} {platform.machine()} {' '.join(platform.libc_ver())}"
    return {**versions(), "system": system.strip()}


def installed(library: str) -> str:
    """Return the version of a library, or that it is not installed."""
    try:
        return metadata.version(library)
    except metadata.PackageNotFoundError:
        return "not installed"


def processor() -> str:
    """Return the processor's model name, if the system reports it."""
    try:
        # Linux alone has this file.
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
    except OSError:
        lines = []
    names = [line.partition(":")[2].strip() for line in lines if line.startswith("model name")]
    return names[0] if names else platform.processor() or platform.machine()


# Attachments beside the input: what is attached and by which software, and the results.
MANIFEST, RESULTS, FORMER = "roofslip.json", "results.json", "since/results.json"

# Of the manifest; raised where a key changes its name or meaning.
SCHEMA_VERSION = 1

# Characters of a hash where there is no room for all 64.
SHORT = 12

_MIMES = {
    ".xlsx": "application/vnd.openxmlformats-officedocument.spreadsheetml.sheet",
    ".json": "application/json",
    ".csv": "text/csv",
    ".pdf": "application/pdf",
}

_Sha256 = Annotated[str, StringConstraints(pattern=r"^[0-9a-f]{64}$")]
# It is printed as it is: no markup, and no letter that a font may lack.
_Version = Annotated[str, StringConstraints(pattern=r"^[\w.+ -]{0,80}$")]


class _Part(BaseModel):
    model_config = ConfigDict(frozen=True, extra="ignore", strict=True)


class Listed(_Part):
    """A file of the manifest: its path, its name as an attachment, its size and hash."""

    path: str
    name: str
    bytes: int = 0
    sha256: _Sha256
    kind: str


class Manifest(_Part):
    """Files and software that a package was computed with."""

    schema_version: int
    roofslip_version: _Version
    hash: str
    has_records: bool
    files: tuple[Listed, ...]
    environment: dict[str, _Version]

    def of_kind(self, kind: str) -> tuple[Listed, ...]:
        """Return the files of a kind: workbook, record, document, former or results."""
        return tuple(file for file in self.files if file.kind == kind)


@dataclass(frozen=True, slots=True, kw_only=True)
class SourceFile:
    """A file that was read: its path, its name as an attachment, and its content."""

    path: str
    name: str
    content: bytes
    kind: str
    record: RecordFile | None = None  # of which a package has the hash only

    @property
    def listed(self) -> Listed:
        """Its line in the manifest."""
        return Listed(
            path=self.path,
            name=self.name,
            bytes=self.record.size if self.record else len(self.content),
            sha256=self.record.sha256 if self.record else hashlib.sha256(self.content).hexdigest(),
            kind=self.kind,
        )


def fingerprint(source: WorkbookSource, shaking: Shaking) -> str:
    """Return the hash of workbook, records, documents and version at the foot of every sheet."""
    # Order counts: records that are exchanged give other runs, with the same hashes.
    lines = [
        version(),
        source.sha256,
        *shaking.hashes,
        *(f"{document.label} {document.sha256}" for document in source.documents),
    ]
    return hashlib.sha256("\n".join(lines).encode()).hexdigest()[:SHORT]


def record_paths(records: Sequence[RecordFile]) -> Mapping[str, RecordFile]:
    """Return one record of each file, by the path from the folder of the workbook."""
    return {_path(row): row for row in records if row.is_file}


def record_bytes(records: Sequence[RecordFile]) -> int:
    """Return the size of the record files."""
    # A file with several channels counts once.
    return sum(row.size for row in record_paths(records).values())


def holds_records(records: Sequence[RecordFile]) -> bool:
    """Whether a package contains the record files themselves."""
    return record_bytes(records) <= MOST_RECORDS


def sources(sheet: Sheet, shaking: Shaking, earlier: bytes = b"") -> tuple[SourceFile, ...]:
    """Return the files embedded in a package: workbook, records, documents, earlier results.json.

    Each as it was read, even if the file has changed since.

    Raises `InputError` if a file was read for several motions or cells, and was not the same each
    time.
    """
    contents, rows = sheet.book.files | sheet.book.records, record_paths(shaking.records)
    used = [(_path(row), row.sha256) for row in shaking.records if row.is_file]
    used += [(document.path, document.sha256) for document in sheet.documents]
    # One file may be named by several motions or cells, and is read for each.
    last = dict(used)
    if changed := [path for path, sha256 in used if sha256 != last[path]]:
        raise InputError(f"{changed[0]}: changed while the report was running; run it again")
    are_held = holds_records(shaking.records)
    files = [_source(sheet.path.name, contents[sheet.sha256], "workbook")]
    for path, row in rows.items():
        content, only = (contents[row.sha256], None) if are_held else (b"", row)
        files.append(replace(_source(path, content, "record"), record=only))
    for path in dict.fromkeys(document.path for document in sheet.documents):
        files.append(_source(path, contents[last[path]], "document"))
    if earlier:
        files.append(_source(FORMER, earlier, "former"))
    return tuple(_unlike(files))


def _path(row: RecordFile) -> str:
    """Return the path of a record file from the folder of the workbook."""
    return posixpath.normpath(row.name.partition(BAR)[0].strip().replace("\\", "/"))


def _source(path: str, content: bytes, kind: str) -> SourceFile:
    return SourceFile(path=path, name=path, content=content, kind=kind)


def _unlike(files: Sequence[SourceFile]) -> Iterator[SourceFile]:
    """Yield the files under names that differ in more than capitals, own names reserved."""
    taken = {MANIFEST, RESULTS}
    for count, source in enumerate(files):
        name = source.path
        # Windows and macOS would write "a.csv" over "A.csv" where they are taken out.
        if name.casefold() in taken:
            name = f"renamed/{count}/{posixpath.basename(source.path)}"
        taken.add(name.casefold())
        yield replace(source, name=name)


def attachments(files: Sequence[SourceFile], results: bytes, short: str) -> tuple[Attached, ...]:
    """Return the attachments of a package; `short` is what `fingerprint` returns."""
    has_records = not any(source.record for source in files)
    results_file = SourceFile(path=RESULTS, name=RESULTS, content=results, kind="results")
    document = Manifest(
        schema_version=SCHEMA_VERSION,
        roofslip_version=version(),
        hash=short,
        has_records=has_records,
        files=tuple(source.listed for source in (*files, results_file)),
        environment=dict(environment()),
    ).model_dump(mode="json")
    # Two runs must give the same bytes: no date, and keys in the order of the model.
    listed = json.dumps(document, indent=1, ensure_ascii=False).encode() + b"\n"
    return (
        *(_attached(source) for source in files if has_records or source.kind != "record"),
        _attached(results_file),
        _attached(SourceFile(path=MANIFEST, name=MANIFEST, content=listed, kind="manifest")),
    )


_KINDS = {
    "workbook": ("Source", "Input workbook"),
    "record": ("Data", "Record of motion"),
    "document": ("Supplement", "Document that the workbook names"),
    "former": ("Source", "Results of the previous revision"),
    "results": ("Data", "Results, with units in their keys"),
    "manifest": ("Supplement", "What the package is computed from, and by which software"),
}


def _attached(source: SourceFile) -> Attached:
    relationship, description = _KINDS[source.kind]
    return Attached(
        name=source.name,
        content=source.content,
        mime=_MIMES.get(posixpath.splitext(source.name)[1].lower(), "text/plain"),
        relationship=relationship,
        description=description,
    )
