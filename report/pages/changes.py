"""What changed since a former revision, and the bars beside changed rows."""

from __future__ import annotations

from collections.abc import Mapping

from report.assessment.changes import ChangeKind, Changes
from report.document.tables import Table, TableRow
from report.entities.columns import TableColumn
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
    changes = package.changes
    text = (
        f"Compared with revision {changes.revision} of {changes.date}: {counted(changes)}. Results "
        "that differ by less than one part in a million count as unchanged. Bars in the margin of "
        "the tables of arrays and clearances and of the input echo mark rows that changed."
    )
    table = Table(
        caption="Changes",
        columns=(
            TableColumn(head="Kind", align="left", share=1.2),
            TableColumn(head="Quantity", align="left", share=2.6),
            TableColumn(head="Cell", align="left", share=1.1),
            TableColumn(head="Before", align="left", share=2.2),
            TableColumn(head="Now", align="left", share=2.2),
        ),
        rows=tuple(
            TableRow(cells=(item.kind.value, item.title, item.cell, item.before, item.now))
            for item in changes.items
        ),
    )
    return {"texts": (text,), "tables": (table,) if changes.items else ()}
