"""The part on clearances: what its template needs beside the clearances themselves."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from report.assessment.neighbors import Cover
from report.document.tables import Table, listed
from report.entities.evidence import NeighborResult
from report.entities.shown import length, words
from report.pages.parts import PackageData
from report.sheet.schema.choices import ObjectKind
from report.words.counts import grouped_by
from solver.rules.provisions import Neighbor


def clearances(package: PackageData) -> Mapping[str, object]:
    """Return the part on clearances, without its chart."""
    near = list(map(NeighborResult.of, package.assessment.neighbors))
    beyond = [pair for pair in package.assessment.pairs if not pair.is_listed]
    return {
        "neighbors": [pair for pair in near if pair.cover is not Cover.BEYOND],
        "farther": [
            row.clearance for pair in near if pair.cover is Cover.BEYOND for row in pair.given
        ],
        "n_beyond": len(beyond),
        "nearest": min(beyond, key=lambda pair: pair.gap_m, default=None),
        "factors": _factors(package),
        "clauses": dict.fromkeys(row.clause for row in package.clearances),
        "parapets": _parapets(package),
        "is_least": any(gap.is_minimum_value for gap in package.assessment.clearances),
    }


def _factors(package: PackageData) -> Sequence[Mapping[str, object]]:
    """Return each kind of neighbor with its factor, and the clearances to it."""
    kinds = grouped_by(package.clearances, lambda row: (row.neighbor.value, row.factor))
    return [
        {"kind": kind, "factor": factor, "numbers": [str(row.count) for row in rows]}
        for (kind, factor), rows in kinds.items()
    ]


def _parapets(package: PackageData) -> Table:
    """Return the parapet of each clearance to an edge that has one, and whether it qualifies."""
    edges = {
        item.id: item.height_m
        for item in package.data.objects
        if item.kind is ObjectKind.EDGE_WITH_PARAPET and item.height_m is not None
    }
    arrays = {array.id: array.cg_height_m for array in package.data.arrays}
    columns = (
        (words("Parapet"), lambda row: row[0].object),
        (words("Beside"), lambda row: row[0].array),
        (length("Top above the roof"), lambda row: row[1]),
        (length("Center of gravity"), lambda row: row[2]),
        (length("Top above it"), lambda row: row[1] - row[2]),
        (words("Result", 1.3), lambda row: row[3]),
    )
    rows = [
        (
            gap.clearance,
            edges[gap.clearance.object],
            arrays[gap.clearance.array],
            "qualifies" if gap.neighbor is Neighbor.PARAPET else "does not qualify",
        )
        for gap in package.assessment.clearances
        if gap.clearance.object in edges
    ]
    return listed(rows, columns, package.fmt, kind="compact")
