"""Comparison of arrays with a row of linked blocks: model, results, corrective measures.

Runs nothing: `report.assessment.links` does. Read `report.pages.parts` first.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence

from report.assessment.links import LinkedArray
from report.document.blocks import Line
from report.entities.linked import linked_result, ratio_up
from report.pages.parts import PackageData, statistic
from report.words.units import number
from solver.model import Status


def part(package: PackageData) -> Mapping[str, object]:
    """Return the rows of linked blocks for the page on the models; empty where there are none."""
    linked = package.assessment.linked
    return {
        "lines": _lines(package) if linked else (),
        "rows": tuple(map(linked_result, linked)),
        "statistics": sorted({statistic(array.design.analysis.basis) for array in linked}),
        "troubles": tuple(link_troubles(package)),
    }


def link_troubles(package: PackageData) -> Iterator[str]:
    """Yield in words for which arrays one rigid block is not adequate, and the remedy."""
    for linked in package.assessment.linked:
        yield from _unfinished(linked)
        if not linked.design.is_permitted:
            yield (
                f"Array {linked.design.id}: there is no permitted design displacement to compare a "
                "row of linked blocks with."
            )
        if not linked.is_within and not math.isnan(linked.estimated_m):
            yield f"{_too_far(package, linked)} {_remedy(linked)}"


def _unfinished(linked: LinkedArray) -> Iterator[str]:
    """Yield the outcomes of rows without a final displacement, each with its runs."""
    for status in Status:
        runs = [
            f"{motion.motion.id} {run.orientation.name}"
            for motion in linked.motions
            for run in motion.runs
            if run.row.status is status
        ]
        if runs and status is not Status.OK:
            name = linked.design.id
            yield f"Array {name} as a row of linked blocks, {', '.join(runs)}: {status.sentence}."


def _too_far(package: PackageData, linked: LinkedArray) -> str:
    name, fmt, used = linked.design.id, package.fmt, linked.design.design_m
    if math.isinf(linked.estimated_m):
        return (
            f"Array {name}: in one axis, one rigid block does not slide; a row of linked blocks "
            f"slides {fmt.both(linked.linked.value_m)}."
        )
    return (
        f"Array {name}: a row of linked blocks slides {ratio_up(linked.ratio)} times as far as one "
        f"rigid block; the estimated design displacement is {fmt.both(linked.estimated_m)}, the "
        f"value used is {fmt.both(used)}."
    )


def _remedy(linked: LinkedArray) -> str:
    least = min(linked.row.mus)
    if linked.design.array.mu > least:
        return (
            f"Enter {number(least, 3)}, the smallest value of its blocks, as its friction "
            "coefficient, or provide stiffer links."
        )
    return "Provide stiffer links."


def _lines(package: PackageData) -> Sequence[Line]:
    return (
        Line(
            latex=(
                r"m\ddot{s}_i=G-\mu_i N\,\mathrm{sign}(\dot{s}_i)+F_i-F_{i-1},"
                r"\quad F_i=k\,e_i+c\,\dot{e}_i,\quad e_i=s_{i+1}-s_i"
            ),
            reference="block i, link i on its downslope side",
            note=f"m, N and G are those of one block ({package.part('method')}), c = 2ζ√(km). "
            "A block rests while the driving force, including F, does not exceed its friction.",
        ),
        Line(
            latex=(
                r"\Delta_{links}=\mathrm{max}(\mathrm{max}(1,\,r)\,\Delta_{RHA},\,\Delta_{floor}),"
                r"\quad r=\Delta_{row}/\Delta_{rigid}"
            ),
            reference="estimated with links",
            steps=tuple(_step(package, linked) for linked in package.assessment.linked),
            note="Where a model is requested, the value from analysis is the larger of its value "
            "and that of the adequate model."
            if any(linked.design.is_model_requested for linked in package.assessment.linked)
            else "",
        ),
    )


def _step(package: PackageData, linked: LinkedArray) -> tuple[str, str]:
    fmt, design = package.fmt, linked.design
    return (
        f"{design.id}: max(max(1, {ratio_up(linked.ratio)}) × "
        f"{fmt.both(linked.value_m)}, {fmt.both(design.floor_m)})",
        _estimated(package, linked),
    )


def _estimated(package: PackageData, linked: LinkedArray) -> str:
    return "no limit" if math.isinf(linked.estimated_m) else package.fmt.both(linked.estimated_m)
