"""Cumulative displacement of the design event and smaller ones, beside the design value."""

from __future__ import annotations

from collections.abc import Sequence

from report.assessment.cumulative import Cumulative
from report.document.tables import Table, listed
from report.entities.shown import length, words
from report.pages.parts import PackageData
from report.words.units import number


def page(package: PackageData, sums: Sequence[Cumulative]) -> dict[str, object]:
    """Return the table; nothing where the workbook names no smaller events."""
    return {"sums": _table(package, sums) if sums else None}


def _table(package: PackageData, sums: Sequence[Cumulative]) -> Table:
    """Return mean and largest sum of each array."""
    factor = package.governing.analysis.factor  # that of every array
    times = f"{number(factor, 2)} × "
    columns = (
        (words("Array"), lambda item: item.array.id),
        (length(f"{times}mean sum"), lambda item: factor * item.mean_m),
        (length(f"{times}largest sum"), lambda item: factor * item.largest_m),
        (length("Design displacement"), lambda item: item.array.design_m),
    )
    return listed(sums, columns, package.fmt, kind="compact")
