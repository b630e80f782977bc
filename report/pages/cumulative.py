"""Cumulative displacement of the design event and smaller ones, beside the design value."""

from __future__ import annotations

from collections.abc import Sequence

from report.assessment.cumulative import Cumulative
from report.document.tables import Table, TableRow
from report.entities.columns import TableColumn
from report.pages.parts import PackageData
from report.words.units import number


def page(package: PackageData, sums: Sequence[Cumulative]) -> dict[str, object]:
    """Return the content; empty where the workbook names no smaller events."""
    return {"events": _text(package), "sums": _table(package, sums)} if sums else {}


def _text(package: PackageData) -> str:
    """Return what is added, and on what basis."""
    factor = number(_factor(package), 2) + package.mark("analysis_factor")
    factors = ", ".join(number(factor, 2) for factor in package.data.options.smaller_factors)
    return (
        "Each motion acts once as the design event and once more by each of these factors: "
        f"{factors}. The PRDs are added: however the events follow each other, the array is "
        "nowhere farther from where it began than their sum. Mean and largest sum carry the factor "
        f"{factor} of the value from analysis. This is practice and no requirement "
        "of the codes cited: neither the design displacement nor a verdict contains it."
    )


def _factor(package: PackageData) -> float:
    """Return the factor on the peaks, which is that of every array."""
    return package.governing.analysis.factor


def _table(package: PackageData, sums: Sequence[Cumulative]) -> Table:
    """Return mean and largest sum of each array."""
    fmt, factor = package.fmt, _factor(package)
    times = f"{number(factor, 2)} × "
    return Table(
        caption="Cumulative displacement over the motions, for information",
        columns=(
            TableColumn(head="Array", align="left"),
            *fmt.columns(f"{times}mean sum"),
            *fmt.columns(f"{times}largest sum"),
            *fmt.columns("Design displacement"),
        ),
        rows=tuple(
            TableRow(
                cells=(
                    item.array.id,
                    *fmt.cells(factor * item.mean_m),
                    *fmt.cells(factor * item.largest_m),
                    *fmt.cells(item.array.design_m),
                )
            )
            for item in sums
        ),
        kind="compact",
    )
