"""Changes since a previous revision."""

from __future__ import annotations

from collections.abc import Mapping

from report.assessment.revision_changes import ChangeKind, Changes
from report.document.tables import headed
from report.pages.parts import PackageData

_COLUMNS = ("Type", 1.2), ("Quantity", 2.6), ("Cell", 1.1), ("Before", 2.2), ("Now", 2.2)


def page(package: PackageData) -> Mapping[str, object]:
    """Return the previous revision, and the changes as a table."""
    changes = package.changes
    rows = [
        (item.kind.value, item.title, item.cell, item.before, item.now) for item in changes.items
    ]
    return {
        "revision": changes.revision,
        "date": changes.date,
        "counted": counted(changes),
        "has_echo": "echo" in package.numbers,
        "changes": headed(*_COLUMNS, rows=rows) if rows else None,
    }


def counted(changes: Changes) -> str:
    """Return the number of changes by kind, as a clause."""
    total = len(changes.items)
    if not total:
        return "no changes in inputs, records, results or verdicts"
    counts = ((kind, changes.count(kind)) for kind in ChangeKind)
    parts = [f"{kind.value} {count}" for kind, count in counts if count]
    return f"{total} change{'s' if total > 1 else ''} ({', '.join(parts)})"
