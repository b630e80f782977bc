"""Opens an untrusted package: its first revision, and the files that it holds.

Owns the limits on size and on where files may be taken out to; compares nothing. Read
`open_package`.
"""

from __future__ import annotations

import hashlib
import io
import re
import warnings
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path, PurePosixPath, PureWindowsPath
from typing import Any, TypeVar

from pydantic import ValidationError
from pypdf import PdfReader

from report.motions.files import MAX_BYTES as MAX_RECORD
from report.proof.numbers import parsed
from report.provenance.files import MANIFEST, RESULTS, SCHEMA_VERSION, Listed, Manifest
from report.sheet.reading.archive import MAX_FILE, MAX_MEMBERS, MAX_TOTAL, MB
from solver.meant import meant
from solver.model import InputError

_T = TypeVar("_T")
_END = re.compile(rb"startxref\s+(\d{1,12})\s+%%EOF[\r\n]*")
# Cross-references, a table or a stream, to which the end of a PDF points. That of an attached PDF,
# which compression may store as it is, points to a place within that PDF.
_XREF = re.compile(rb"xref\s|\d{1,10} \d{1,10} obj\b")
_LONGEST_NAME = 255
_MOST_OTHERS = 20


@dataclass(frozen=True, slots=True, kw_only=True)
class ReadPackage:
    """A package as read.

    Attributes
    ----------
    data : bytes
        The whole file.
    first : bytes
        Its first revision: what `roofslip report` wrote, unless the file was rewritten.
    files : mapping of str to bytes
        Attachments of the first revision by name.
    pdf : PdfReader
        The first revision, to read further.
    """

    path: Path
    data: bytes
    first: bytes
    manifest: Manifest
    files: Mapping[str, bytes]
    pdf: PdfReader

    @property
    def listing(self) -> Any:
        """The manifest as JSON."""
        return parsed(self.files[MANIFEST], MANIFEST)

    @property
    def results(self) -> Any:
        """The attached results.json; empty if there is none."""
        return parsed(self.files.get(RESULTS, b"{}"), RESULTS)


def open_package(path: Path) -> ReadPackage:
    """Read a package and the files that it holds.

    Raises
    ------
    InputError
        If it cannot be read, is too large, or is no package with its input inside.
    """
    data = _read(path)
    ends = (end for end in _END.finditer(data) if _XREF.match(data, int(end[1])))
    end = next(ends, None)
    if not data.startswith(b"%PDF-") or end is None:
        raise InputError("is no PDF, or is cut off; get the file again from where it was issued")
    # What was appended later has an end of its own.
    first = data[: end.end()]
    pdf = guarded(lambda: reader(first))
    files = guarded(lambda: _attachments(pdf))
    if MANIFEST not in files:
        raise InputError(
            f"holds no {MANIFEST}: it is no package of `roofslip report`, or was written by version"
            " 0.1, which did not attach the input"
        )
    for name in {MANIFEST, RESULTS} & files.keys():
        parsed(files[name], name)
    manifest = _manifest(files[MANIFEST])
    return ReadPackage(path=path, data=data, first=first, manifest=manifest, files=files, pdf=pdf)


def warn_of_other_input(new: Path, others: Sequence[Path]) -> None:
    """Warn of packages that were written from another input than a new one, such as signed ones."""
    for path in others[:_MOST_OTHERS]:
        with suppress(InputError, OSError, KeyError, TypeError):  # no package, or a damaged one
            package = open_package(path)
            if _inputs(package) != _inputs(open_package(new)):
                revision = package.results["input"]["project"]["revision"]
                sign = "; sign the new package" if package.data != package.first else ""
                what = f"of revision {revision!s:.40}, another input: {package.results['verdict']}"
                warnings.warn(f"{path}: is {what}{sign}", stacklevel=2)


def _inputs(package: ReadPackage) -> set[tuple[str, str]]:
    return {(file.path, file.sha256) for file in package.manifest.files if file.kind != "results"}


def reader(data: bytes) -> PdfReader:
    """Return a PDF to read; nothing damaged in it is mended."""
    return PdfReader(io.BytesIO(data), strict=True)


def guarded(read: Callable[[], _T]) -> _T:
    """Run what reads a PDF; a damaged one makes the library raise almost anything.

    Raises
    ------
    InputError
    """
    try:
        return read()
    except InputError:
        raise
    except Exception as error:
        raise InputError("is damaged; get the file again from where it was issued") from error


def _read(path: Path) -> bytes:
    if not path.is_file():
        raise InputError(f"no such file; {meant(path) or 'give a calc-package.pdf'}")
    if path.stat().st_size > MAX_FILE:
        raise InputError(f"larger than {MAX_FILE // MB} MB, which no package is")
    return path.read_bytes()


def _attachments(pdf: PdfReader) -> dict[str, bytes]:
    """Return the attachments by name, within the limits of a workbook and its records."""
    found: dict[str, bytes] = {}
    for count, file in enumerate(pdf.attachment_list, start=1):
        if count > MAX_MEMBERS:
            raise InputError(f"has more than {MAX_MEMBERS} attachments, which no package has")
        if file.name in found:
            raise InputError(f"has two attachments of the name {file.name}")
        found[file.name] = file.content
        total = sum(map(len, found.values()))
        if len(file.content) > MAX_RECORD or total > MAX_TOTAL:
            raise InputError(
                f"its attachments unpack to more than {MAX_RECORD // MB} MB in one or"
                f" {MAX_TOTAL // MB} MB in all"
            )
    return found


def _manifest(content: bytes) -> Manifest:
    try:
        manifest = Manifest.model_validate_json(content)
    except ValidationError as error:
        first = error.errors()[0]
        place = "".join(f"{step}: " for step in first["loc"])
        raise InputError(f"{MANIFEST} is damaged at {place}") from error
    if manifest.schema_version != SCHEMA_VERSION:
        raise InputError(
            f"{MANIFEST} has the schema_version {manifest.schema_version}; this version reads"
            f" {SCHEMA_VERSION}: use Roofslip {manifest.roofslip_version}"
        )
    if len(manifest.of_kind("workbook")) != 1 or len(manifest.of_kind("former")) > 1:
        raise InputError(f"{MANIFEST} names no workbook, or more than one")
    return manifest


def take_out(
    package: ReadPackage, folder: Path, records: Path | None = None
) -> tuple[Path, list[Path]]:
    """Write the input of a package to a folder of its own; return workbook and former results.

    Parameters
    ----------
    records : Path, optional
        Where the record files lie that the package only lists.

    Raises
    ------
    InputError
        If a file is missing, or would lie outside of the folder.
    """
    written: dict[str, list[Path]] = {}
    for file in package.manifest.files:
        if file.kind == "results":
            continue
        target = folder / _inside(file.path)
        target.parent.mkdir(parents=True, exist_ok=True)
        with target.open("xb") as new:
            new.write(_content(package, file, records))
        written.setdefault(file.kind, []).append(target)
    return written["workbook"][0], written.get("former", [])


def _inside(path: str) -> PurePosixPath:
    """Return a relative path that leads to no other folder on any system."""
    parts = PurePosixPath(path).parts
    is_bad = (
        not parts
        or PurePosixPath(path).is_absolute()
        or bool(PureWindowsPath(path).drive)
        or any(part == ".." or len(part) > _LONGEST_NAME for part in parts)
        or re.search(r"[\\\x00-\x1f\x7f]", path) is not None
    )
    if is_bad:
        raise InputError(f"the attachment {path!r:.80} would lie outside of its folder")
    return PurePosixPath(path)


def _content(package: ReadPackage, file: Listed, records: Path | None) -> bytes:
    if file.kind == "record" and not package.manifest.has_records:
        return _left_out(file, records)
    if file.name not in package.files:
        raise InputError(f"the attachment {file.name} is missing")
    return package.files[file.name]


def _left_out(file: Listed, records: Path | None) -> bytes:
    """Return a record file that a package is too small to hold."""
    if records is None:
        raise InputError(
            "its records are too large to be attached; name the folder of the workbook that they"
            " lie beside with --records"
        )
    path = records / _inside(file.path)
    if not path.is_file() or path.stat().st_size > MAX_RECORD:
        raise InputError(f"{path}: is missing or too large; the package was computed from it")
    content = path.read_bytes()
    if hashlib.sha256(content).hexdigest() != file.sha256:
        raise InputError(f"{path}: is not the file that the package was computed from (SHA-256)")
    return content


def mismatched(package: ReadPackage) -> Sequence[str]:
    """Return attachments that are not those of the manifest: changed, missing or added."""
    has_records, files = package.manifest.has_records, package.manifest.files
    listed = {file.name: file.sha256 for file in files if has_records or file.kind != "record"}
    held = {
        name: hashlib.sha256(content).hexdigest()
        for name, content in package.files.items()
        if name != MANIFEST
    }
    return [
        *(f"{name} is missing" for name in listed if name not in held),
        *(f"{name} is not listed" for name in held if name not in listed),
        *(
            f"{name} was changed: its SHA-256 is not the one listed"
            for name in held
            if name in listed and held[name] != listed[name]
        ),
    ]
