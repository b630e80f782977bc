"""Opens an untrusted package and the files in it. Read `opened`, then `take_out`.

Defines the limits on size and on the locations of extracted files.
"""

from __future__ import annotations

import hashlib
import io
import logging
import warnings
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TypeVar

from pydantic import ValidationError
from pypdf import PdfReader
from pypdf.generic import ByteStringObject, TextStringObject

from report.motions.record_reading import MAX_BYTES as MAX_RECORD
from report.project.read.archive import MAX_FILE, MAX_MEMBERS, MAX_TOTAL, MB
from report.proof.differences import parsed
from report.proof.pdf_contents import guarded
from report.provenance.package_sources import MANIFEST, RESULTS, SCHEMA_VERSION, Listed, Manifest
from solver.errors import InputError
from solver.file_checks import read_file, within
from solver.suggestions import meant

_T = TypeVar("_T")
_MOST_OTHERS = 20


@dataclass(frozen=True, slots=True, kw_only=True)
class OpenedPackage:
    """A package as shown by a PDF reader, including anything appended to it."""

    data: bytes  # the whole file
    pdf: PdfReader
    files: Mapping[str, bytes]  # its attachments by name
    manifest: Manifest
    listing: Any  # the manifest as JSON
    results: Any  # the attached results.json, as JSON


def read_package(path: Path) -> bytes:
    """Return the bytes of a package.

    Raises `InputError` if there is no such file, or it is larger than any package.
    """
    if not path.exists():
        raise InputError(f"no such file; {meant(path) or 'use a calc-package.pdf'}")
    return read_file(path, MAX_FILE, too_large="no package is")


def opened(data: bytes) -> OpenedPackage:
    """Return a package with the files in it.

    Raises `InputError` if it is damaged, unpacks to too much data, or is not a package with its
    input.
    """
    # At its first byte: readers accept a PDF behind other content, which may be a program.
    if not data.startswith(b"%PDF-"):
        raise InputError("is not a PDF; obtain the file again from its issuer")
    # It prints what it mends.
    logging.getLogger("pypdf").addHandler(logging.NullHandler())
    # Strict: a reader that mends a file may see another document than the one that a plan checker
    # sees.
    pdf = guarded(lambda: PdfReader(io.BytesIO(data), strict=True))
    files = guarded(lambda: _attachments(pdf))
    if MANIFEST not in files:
        raise InputError(
            f"contains no {MANIFEST}: it is not a package of `roofslip report`, or was written"
            " by version"
            " 0.1, which did not attach the input"
        )
    return OpenedPackage(
        data=data,
        pdf=pdf,
        files=files,
        # First, for it refuses what the manifest's model would read in another way.
        listing=parsed(files[MANIFEST], MANIFEST),
        manifest=_manifest(files),
        results=parsed(files[RESULTS], RESULTS),
    )


def _attachments(pdf: PdfReader) -> dict[str, bytes]:
    """Return the attachments by name, within the limits of a workbook and its records."""
    if pdf.is_encrypted:
        raise InputError("is encrypted, which packages never are")
    # One flat list, as packages have it: a tree of names could go on without end.
    listed = pdf.root_object.get("/Names", {}).get("/EmbeddedFiles", {}).get("/Names", ())
    files: dict[str, bytes] = {}
    total = 0
    for key, file in zip(listed[::2], listed[1::2], strict=True):
        about = file.get_object()
        name = str(about["/UF"])
        # Readers show one of three names, each another one: all must agree.
        agree = name == _in_utf8(key) == _in_utf8(about["/F"])
        if name in files or not agree or len(files) >= MAX_MEMBERS:
            raise InputError(f"its attachment {name:.80} has two names or is one of too many")
        files[name] = content = about["/EF"]["/F"].get_data()
        total += len(content)
        if len(content) > MAX_RECORD or total > MAX_TOTAL:
            raise InputError(
                f"its attachments unpack to more than {MAX_RECORD // MB} MB in one or"
                f" {MAX_TOTAL // MB} MB in total"
            )
    return files


def _in_utf8(text: Any) -> str:
    """Return a string that the renderer writes in UTF-8, which PDF takes for another encoding."""
    is_text = isinstance(text, TextStringObject | ByteStringObject)
    try:
        return text.original_bytes.decode() if is_text else str(text)
    except UnicodeDecodeError:
        return str(text)


def _manifest(files: Mapping[str, bytes]) -> Manifest:
    """Return the manifest of a package whose attachments are those that it lists."""
    try:
        manifest = Manifest.model_validate_json(files[MANIFEST])
    except ValidationError as error:
        place = "".join(f"{step}: " for step in error.errors()[0]["loc"])
        raise InputError(f"{MANIFEST} is damaged at {place}") from error
    if manifest.schema_version != SCHEMA_VERSION:
        raise InputError(
            f"{MANIFEST} has the schema_version {manifest.schema_version}; this version reads"
            f" {SCHEMA_VERSION}: use Roofslip {manifest.roofslip_version}"
        )
    counts = {kind: len(manifest.of_kind(kind)) for kind in ("workbook", "results", "former")}
    if (counts["workbook"], counts["results"]) != (1, 1) or counts["former"] > 1:
        raise InputError(f"{MANIFEST} names no workbook or results, or more than one")
    has_records = manifest.has_records
    listed = {file.name: file for file in manifest.files if has_records or file.kind != "record"}
    # Both ways: a file that no line lists is as foreign as one that is gone.
    for name in dict.fromkeys((RESULTS, *listed, *files)):
        if name not in files:
            raise InputError(f"the attachment {name} is missing")
        if name != MANIFEST and name not in listed:
            raise InputError(f"the attachment {name} is not listed in {MANIFEST}")
        if name != MANIFEST and hashlib.sha256(files[name]).hexdigest() != listed[name].sha256:
            raise InputError(
                f"the attachment {name} was changed: its SHA-256 is not the one listed"
            )
    return manifest


def take_out(
    package: OpenedPackage, folder: Path, records: Path | None = None
) -> tuple[Path, list[Path]]:
    """Write the input of a package to a folder of its own; return workbook and previous results.

    `records` is the folder of record files that the package only lists.

    Raises `InputError` if a name leads outside of the folder or appears twice, or a record is not
    that listed.
    """
    written: dict[str, list[Path]] = {}
    for file in package.manifest.files:
        if file.kind == "results":
            continue
        try:
            target = within(folder, file.path)
        except InputError as error:
            raise InputError(f"the attachment {error}") from error
        is_held = package.manifest.has_records or file.kind != "record"
        content = package.files[file.name] if is_held else _left_out(file, records)
        try:
            target.parent.mkdir(parents=True, exist_ok=True)
            # Exclusive: of names that are equal, or that a disk takes for equal, the second fails.
            with target.open("xb") as copy:
                copy.write(content)
        except (FileExistsError, NotADirectoryError) as error:
            raise InputError(
                f"the attachment {file.path!r:.80} is in the way of another"
            ) from error
        written.setdefault(file.kind, []).append(target)
    return written["workbook"][0], written.get("former", [])


class RecordsMissingError(InputError):
    """Record files that a package only lists are not available."""


def _left_out(file: Listed, records: Path | None) -> bytes:
    """Return a record file that is only listed in a package."""
    if records is None:
        raise RecordsMissingError(
            "its records are too large to be attached; name the folder of the workbook that they"
            " lie beside with --records"
        )
    path = records / file.path
    try:
        content = read_file(path, MAX_RECORD)
    except InputError as error:
        raise RecordsMissingError(
            f"{path}: is missing or too large; the package was computed from it"
        ) from error
    # Hashed as it was read: what lies there may be replaced at any time.
    if hashlib.sha256(content).hexdigest() != file.sha256:
        raise RecordsMissingError(
            f"{path}: is not the file that the package was computed from (SHA-256)"
        )
    return content


def signed_fields(pdf: PdfReader) -> list[str]:
    """Return the names of the fields of a PDF that were signed."""
    fields = [item.get_object() for item in pdf.root_object.get("/AcroForm", {}).get("/Fields", ())]
    return [str(field.get("/T")) for field in fields if "/V" in field]


def warn_of_other_input(written: Path, earlier: Sequence[Path]) -> None:
    """Warn of packages that were written from another input than a new one, such as signed ones."""
    # Each is opened and read: a folder may have hundreds.
    for path in earlier[:_MOST_OTHERS]:
        # A drawing or a letter beside the package is none, and no reason for a message.
        with suppress(InputError, OSError, KeyError, TypeError):
            package = opened(read_package(path))
            if _inputs(package) != _inputs(opened(read_package(written))):
                revision = package.results["input"]["project"]["revision"]
                sign = "; sign the new package" if signed_fields(package.pdf) else ""
                text = f"of revision {revision!s:.40}, another input: {package.results['verdict']}"
                warnings.warn(f"{path}: is {text}{sign}", stacklevel=2)


def _inputs(package: OpenedPackage) -> set[tuple[str, str]]:
    return {(file.path, file.sha256) for file in package.manifest.files if file.kind != "results"}
