"""What changed since a former revision, and the bars beside changed rows."""

from __future__ import annotations

from collections.abc import Mapping

from report.assessment.changes import ChangeKind, Changes
from report.pages.parts import PackageData


def counted(changes: Changes) -> str:
    """Return the number of changes by kind, as a clause."""
    total = len(changes.items)
    if not total:
        return "no change in inputs, records, results or verdicts"
    counts = ((kind, changes.count(kind)) for kind in ChangeKind)
    parts = [f"{kind.value} {count}" for kind, count in counts if count]
    return f"{total} change{'s' if total > 1 else ''} ({', '.join(parts)})"


def page(package: PackageData) -> Mapping[str, object]:
    """Return the changes as rows of a table."""
    items = package.changes.items
    return {
        "counted": counted(package.changes),
        "rows": [(item.kind.value, item.title, item.cell, item.before, item.now) for item in items],
    }
