"""The head of the first sheet: project, codes and revisions. Read `cover`."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from report.pages.parts import PackageData
from report.pages.symbols import friction_standard
from report.sheet.schema.project import Revision


def cover(package: PackageData) -> Mapping[str, object]:
    """Return what the head needs beside the package."""
    return {
        "friction_standard": friction_standard(package),
        "revisions": list(_revisions(package)),
    }


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
