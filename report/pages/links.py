"""Comparison of arrays with a row of linked blocks: model, results, corrective measures.

Runs nothing: `report.assessment.links` does. Read `report.pages.parts` first.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence

from report.assessment.links import LinkedArray
from report.document.blocks import Line
from report.document.tables import Table, TableRow
from report.entities.columns import NO_VALUE, TableColumn
from report.pages.parts import PackageData, statistic, verdict
from report.words.units import Quantity, number
from solver.model import Status


def part(package: PackageData, matters: str) -> Mapping[str, object]:
    """Return the rows of linked blocks for the page on the models; empty tables if none.

    Parameters
    ----------
    matters : str
        Tolerance of a displacement that matters to the choice of model, in words.
    """
    return {
        "text": _text(package),
        "lines": _lines(package) if package.assessment.linked else (),
        "rows": _row_table(package),
        "design": _design_table(package, matters),
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
            f"{motion.motion.id} {run.heading.name}"
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
        f"Array {name}: a row of linked blocks slides {_ratio(linked.ratio)} times as far as one "
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


def _ratio(value: float) -> str:
    """Return a ratio, rounded up."""
    if math.isnan(value):
        return NO_VALUE
    return "∞" if math.isinf(value) else number(math.ceil(value * 1e3 - 1e-6) / 1e3, 3)


def _text(package: PackageData) -> str:
    names = [linked.design.id for linked in package.assessment.linked]
    arrays = "array" if len(names) == 1 else "arrays"
    return (
        f"The workbook requests this check for {arrays} {', '.join(names)}. Each array is also run "
        "as a row of blocks of equal weight along the slope, each with its own friction and "
        "stick-slip state, with a spring and a dashpot between adjacent blocks. All blocks are "
        "subject to the same roof motion, in one axis, with the vertical component where there is "
        "one. One rigid block with the friction coefficient of the array is run in the same axis, "
        "so the ratio of the two is the effect of links and nonuniform friction alone. This ratio "
        "is assumed to apply to the model used in design."
    )


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
        f"{design.id}: max(max(1, {_ratio(linked.ratio)}) × "
        f"{fmt.both(linked.value_m)}, {fmt.both(design.floor_m)})",
        _estimated(package, linked),
    )


def _estimated(package: PackageData, linked: LinkedArray) -> str:
    return "no limit" if math.isinf(linked.estimated_m) else package.fmt.both(linked.estimated_m)


def _row_table(package: PackageData) -> Table:
    fmt = package.fmt
    return Table(
        caption="Rows of linked blocks and one rigid block: the largest of all runs",
        columns=(
            TableColumn(head="Array", align="left", share=0.9),
            TableColumn(head="Blocks", share=0.9),
            TableColumn(head="μ", share=1.5),
            *fmt.columns("Link stiffness", Quantity.STIFFNESS, share=1.0),
            TableColumn(head="Damping", unit="of critical", share=1.2),
            *fmt.columns("PRD, rigid", share=0.8),
            *fmt.columns("PRD, row", share=0.8),
            TableColumn(head="Block", share=0.8),
            *fmt.columns("Link force", Quantity.WEIGHT, share=0.9),
        ),
        rows=tuple(TableRow(cells=_row(package, linked)) for linked in package.assessment.linked),
        notes=(
            "Block: the one with the largest PRD, numbered from the upslope end. Link force: the "
            f"largest in any link; compare with the strength required in {package.part('limits')}.",
        ),
        kind="compact",
    )


def _row(package: PackageData, linked: LinkedArray) -> tuple[str, ...]:
    fmt, mus, farthest = package.fmt, linked.row.mus, linked.farthest
    return (
        linked.design.id,
        str(len(mus)),
        " to ".join(number(mu, 3) for mu in sorted({min(mus), max(mus)})),
        *fmt.cells(linked.links.stiffness_n_per_m, Quantity.STIFFNESS),
        number(linked.links.damping_ratio, 3),
        *fmt.cells(linked.rigid_prd_m),
        *fmt.cells(farthest.prd_m),
        NO_VALUE if math.isnan(farthest.prd_m) else str(farthest.block),
        *fmt.cells(linked.link_force_n, Quantity.WEIGHT),
    )


def _design_table(package: PackageData, matters: str) -> Table:
    fmt = package.fmt
    linked = package.assessment.linked
    ways = sorted({statistic(array.design.analysis.basis) for array in linked})
    return Table(
        caption="Adequacy of one rigid block",
        columns=(
            TableColumn(head="Array", align="left", share=0.9),
            *fmt.columns("Rigid, one axis"),
            *fmt.columns("Row, one axis"),
            TableColumn(head="Ratio r", share=0.9),
            *fmt.columns("Design, used"),
            *fmt.columns("Design, with links"),
            TableColumn(head="Verdict", align="center", share=1.0),
        ),
        rows=tuple(TableRow(cells=_design(package, array)) for array in linked),
        notes=(
            f"Rigid and row: {', '.join(ways)} of the motions' PRDs; for the row, of the block "
            "with the largest PRD. OK where the design value with links exceeds the value used by "
            f"no more than {matters}, whichever is larger, every run ends at rest, and the value "
            "used is permitted.",
        ),
        kind="compact",
    )


def _design(package: PackageData, linked: LinkedArray) -> tuple[str, ...]:
    fmt, estimated = package.fmt, linked.estimated_m
    return (
        linked.design.id,
        *fmt.cells(linked.rigid.value_m),
        *fmt.cells(linked.linked.value_m),
        _ratio(linked.ratio),
        *fmt.cells(linked.design.permitted_m),
        *(("∞", "∞") if math.isinf(estimated) else fmt.cells(estimated)),
        verdict(linked.is_rigid_enough),
    )
