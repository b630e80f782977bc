"""The hashes of the record files."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

from report.document.columns import plain, words
from report.document.tables import listed
from report.motions.components import RecordFile
from report.pages.parts import MOTION_ROWS, PackageData


def page(package: PackageData) -> Mapping[str, object]:
    """Return the record files with their hashes; common values are in a note."""
    rows = package.assessment.shaking.records
    alike = _alike(rows)
    differing = [name for name in _ALIKE if name not in alike]
    columns = (
        (words("Motion", 0.45), lambda row: row.motion_id),
        (words("Component", 0.68), lambda row: row.component),
        *((words(name, 0.55), _ALIKE[name]) for name in differing),
        (plain("Peak [g]", 4, share=0.5), lambda row: row.peak_g),
        (words("File", 1.04), lambda row: row.name),
        (words("SHA-256", 4.15 - 0.55 * len(differing)), lambda row: row.sha256),
    )
    table = listed(rows, columns, package.fmt, kind="compact digest", whole_rows=MOTION_ROWS)
    return {
        "files": table,
        "alike": ", ".join(f"{name} {value}" for name, value in alike.items()),
    }


_ALIKE: Mapping[str, Callable[[RecordFile], str]] = {
    "Format": lambda row: row.format,
    "Samples": lambda row: str(row.npts),
    "Step [s]": lambda row: f"{row.dt_s:g}",
}


def _alike(rows: Sequence[RecordFile]) -> Mapping[str, str]:
    """Return the values common to all files, by name."""
    values_by_name = {name: {show(row) for row in rows} for name, show in _ALIKE.items()}
    return {name: values.pop() for name, values in values_by_name.items() if len(values) == 1}
