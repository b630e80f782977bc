"""Comparison of arrays with a row of linked blocks: results, and where one block may not do.

Runs nothing: `report.assessment.links` does. Read `report.pages.parts` first.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from report.assessment.links import LinkedArray
from report.entities.linked import linked_result
from report.pages.parts import PackageData, statistic
from solver.model import Status


@dataclass(frozen=True, slots=True, kw_only=True)
class LinkTrouble:
    """A reason why one rigid block has not been shown to be adequate for an array.

    Attributes
    ----------
    status, runs : Status, tuple of str
        An outcome without a final displacement, and the runs that have it.
    is_too_far : bool
        Whether the row slides too far; if not, and without runs, there is nothing to compare with.
    """

    linked: LinkedArray
    status: Status = Status.OK
    runs: tuple[str, ...] = ()
    is_too_far: bool = False


def part(package: PackageData) -> Mapping[str, object]:
    """Return the rows of linked blocks for the page on the models; empty where there are none."""
    linked = package.assessment.linked
    return {
        "rows": tuple(map(linked_result, linked)),
        "statistics": sorted({statistic(array.design.analysis.basis) for array in linked}),
        "troubles": tuple(link_troubles(package)),
    }


def link_troubles(package: PackageData) -> Iterator[LinkTrouble]:
    """Yield for which arrays one rigid block has not been shown to be adequate, and why."""
    for linked in package.assessment.linked:
        yield from _unfinished(linked)
        if not linked.design.is_permitted:
            yield LinkTrouble(linked=linked)
        if not linked.is_within and not math.isnan(linked.estimated_m):
            yield LinkTrouble(linked=linked, is_too_far=True)


def _unfinished(linked: LinkedArray) -> Iterator[LinkTrouble]:
    for status in Status:
        runs = [
            f"{motion.motion.id} {run.orientation.name}"
            for motion in linked.motions
            for run in motion.runs
            if run.row.status is status
        ]
        if runs and status is not Status.OK:
            yield LinkTrouble(linked=linked, status=status, runs=tuple(runs))
