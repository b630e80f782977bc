"""The record files with their hashes, the software, and what the references need."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

from report.document.tables import listed
from report.entities.shown import plain, words
from report.motions.components import RecordFile
from report.pages.parts import MOTION_ROWS, PackageData
from report.pages.symbols import friction_standard
from report.provenance.files import SHORT, holds_records, record_bytes, record_paths
from report.provenance.software import versions


def page(package: PackageData) -> Mapping[str, object]:
    """Return the records by motion, the software versions and what is cited."""
    records = package.assessment.shaking.records
    return {
        "short_hash": package.assessment.sheet.sha256[:SHORT],
        "n_files": len(record_paths(records)),
        "has_files": holds_records(records),
        "files_mb": record_bytes(records) / 1e6,
        "software": ", ".join(f"{name} {version}" for name, version in versions().items()),
        "friction_standard": friction_standard(package),
    }


def hashes(package: PackageData) -> Mapping[str, object]:
    """Return the record files with their hashes; what all files have alike is in a note."""
    rows = package.assessment.shaking.records
    alike = _alike(rows)
    own = [name for name in _ALIKE if name not in alike]
    columns = (
        (words("Motion", 0.45), lambda row: row.motion_id),
        (words("Component", 0.68), lambda row: row.component),
        *((words(name, 0.55), _ALIKE[name]) for name in own),
        (plain("Peak [g]", 4, share=0.5), lambda row: row.peak_g),
        (words("File", 1.04), lambda row: row.name),
        (words("SHA-256", 4.15 - 0.55 * len(own)), lambda row: row.sha256),
    )
    table = listed(rows, columns, package.fmt, kind="compact digest", whole_rows=MOTION_ROWS)
    return {"files": table, "alike": alike}


_ALIKE: Mapping[str, Callable[[RecordFile], str]] = {
    "Format": lambda row: row.format,
    "Samples": lambda row: str(row.npts),
    "Step [s]": lambda row: f"{row.dt_s:g}",
}


def _alike(rows: Sequence[RecordFile]) -> Mapping[str, str]:
    """Return what all files have alike, by name."""
    found = {name: {show(row) for row in rows} for name, show in _ALIKE.items()}
    return {name: values.pop() for name, values in found.items() if len(values) == 1}
