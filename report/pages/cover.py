"""The cover: project, verdict with the governing numbers, codes and attachments. Read `cover`."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from report.assessment.arrays import ArrayAssessment
from report.assessment.runs import nan_is_worst
from report.pages.parts import PackageData
from report.pages.symbols import friction_standard
from report.provenance.files import SHORT, holds_records, record_bytes, record_paths
from report.sheet.schema.project import Revision


def cover(package: PackageData) -> Mapping[str, object]:
    """Return what the cover needs beside the package."""
    records = package.assessment.shaking.records
    return {
        "array": _governing_array(package),
        "gap": package.assessment.governing_gap(),
        "friction_standard": friction_standard(package),
        "short_hash": package.assessment.sheet.sha256[:SHORT],
        "n_records": len(record_paths(records)),
        "has_records": holds_records(records),
        "records_mb": record_bytes(records) / 1e6,
        "revisions": list(_revisions(package)),
    }


def _governing_array(package: PackageData) -> ArrayAssessment:
    """Return the array with the largest design displacement, of those that are NG if any is."""
    arrays, verdict_of = package.assessment.arrays, package.assessment.array_verdict
    return max(
        [array for array in arrays if not verdict_of(array).is_permitted] or arrays,
        key=lambda array: nan_is_worst(array.design_m),
    )


def _revisions(package: PackageData) -> Iterator[Sequence[object]]:
    """Yield revision, date, description and author of each, or of the first issue."""
    project = package.data.project
    first = Revision(
        revision=project.revision,
        date=project.date,
        description="First issue",
        by=project.prepared_by,
    )
    for row in package.data.revisions or [first]:
        yield row.revision, row.date, row.description, row.by or "—"
