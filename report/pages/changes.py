"""What changed since a former revision, and the bars beside changed rows."""

from __future__ import annotations

from collections.abc import Mapping

from report.assessment.changes import ChangeKind, Changes
from report.document.tables import listed
from report.entities.shown import words
from report.pages.parts import PackageData


def title(changes: Changes) -> str:
    """Return the heading of the page."""
    return f"Changes since revision {changes.revision}"


def counted(changes: Changes) -> str:
    """Return the number of changes by kind, as a clause."""
    total = len(changes.items)
    if not total:
        return "no change in inputs, records, results or verdicts"
    counts = ((kind, changes.count(kind)) for kind in ChangeKind)
    parts = [f"{kind.value} {count}" for kind, count in counts if count]
    return f"{total} change{'s' if total > 1 else ''} ({', '.join(parts)})"


def page(package: PackageData) -> Mapping[str, object]:
    """Return the changes as a table."""
    columns = (
        (words("Kind", 1.2), lambda item: item.kind.value),
        (words("Quantity", 2.6), lambda item: item.title),
        (words("Cell", 1.1), lambda item: item.cell),
        (words("Before", 2.2), lambda item: item.before),
        (words("Now", 2.2), lambda item: item.now),
    )
    changes = package.changes
    return {
        "counted": counted(changes),
        "table": listed(changes.items, columns, package.fmt),
    }
