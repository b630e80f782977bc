"""Arrays held against a row of linked blocks: what it is, what came of it, what would do.

Runs nothing: `report.assessment.links` did. Read `report.pages.parts` first.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence

from report.assessment.links import LinkedArray
from report.pages.parts import (
    NO_VALUE,
    Line,
    PackageData,
    Table,
    TableColumn,
    TableRow,
    statistic,
    verdict,
)
from report.sheet.schema import Direction
from report.words.units import Quantity, number
from solver.model import Status


def part(package: PackageData, matters: str) -> Mapping[str, object]:
    """Return what the page on the models says of rows; tables without rows where none is asked.

    Parameters
    ----------
    matters : str
        Up to where a change of a displacement is none, in words.
    """
    return {
        "text": _text(package),
        "lines": _lines(package) if package.assessment.linked else (),
        "rows": _row_table(package),
        "design": _design_table(package, matters),
        "troubles": tuple(link_troubles(package)),
    }


def link_troubles(package: PackageData) -> Iterator[str]:
    """Yield in words for which arrays one rigid block is not enough, and what would do."""
    for found in package.assessment.linked:
        yield from _unfinished(found)
        if not found.is_within and not math.isnan(found.estimated_m):
            yield f"{_too_far(package, found)} {_what_would_do(found)}"


def _unfinished(found: LinkedArray) -> Iterator[str]:
    """Yield the outcomes of rows that give no final displacement, each with its runs."""
    for status in Status:
        runs = [
            f"{motion.motion.id} {run.heading.name}"
            for motion in found.motions
            for run in motion.runs
            if run.row.status is status
        ]
        if runs and status is not Status.OK:
            name = found.found.array.id
            yield f"Array {name} as a row of linked blocks, {', '.join(runs)}: {status.sentence}."


def _too_far(package: PackageData, found: LinkedArray) -> str:
    name, fmt, used = found.found.array.id, package.fmt, found.found.design_m
    if math.isinf(found.estimated_m):
        return (
            f"Array {name}: one rigid block does not slide in one axis, a row of linked blocks by "
            f"{fmt.both(found.linked.value_m)}."
        )
    return (
        f"Array {name}: a row of linked blocks goes {_ratio(found.ratio)} times as far as one "
        f"rigid block, estimated design displacement {fmt.both(found.estimated_m)}, used "
        f"{fmt.both(used)}."
    )


def _what_would_do(found: LinkedArray) -> str:
    least = min(found.row.mus)
    if found.found.array.mu > least:
        return (
            f"Enter {number(least, 3)}, the least of its blocks, as its friction coefficient, or "
            "give it stiffer links."
        )
    return "Give it stiffer links."


def _ratio(value: float) -> str:
    """Return a ratio, rounded up, so that it never reads less than it is."""
    if math.isnan(value):
        return NO_VALUE
    return "∞" if math.isinf(value) else number(math.ceil(value * 1e3 - 1e-6) / 1e3, 3)


def _text(package: PackageData) -> str:
    names = [found.found.array.id for found in package.assessment.linked]
    are = "is" if len(names) == 1 else "are"
    return (
        f"The workbook asks it of {', '.join(names)}, which {are} run once more as a row of blocks "
        "of equal weight down the slope, each with its own friction and stick-slip state, with a "
        "spring and a dashpot between neighbors. All feel the same roof motion, in one axis, with "
        "the vertical where there is one. Beside it stands one rigid block with the array's own "
        "friction coefficient in that same axis, so that their ratio is the effect of links and of "
        "uneven friction alone; the ratio is taken to hold for the model that the design uses too."
    )


def _lines(package: PackageData) -> Sequence[Line]:
    return (
        Line(
            latex=(
                r"m\ddot{s}_i=G-\mu_i N\,\mathrm{sign}(\dot{s}_i)+F_i-F_{i-1},"
                r"\quad F_i=k\,e_i+c\,\dot{e}_i,\quad e_i=s_{i+1}-s_i"
            ),
            reference="block i, link i below it",
            note=f"m, N and G are those of one block ({package.part('method')}), c = 2ζ√(km). A block "
            "rests while what pushes it, F included, is not above its friction.",
        ),
        Line(
            latex=(
                r"\Delta_{links}=\mathrm{max}(\mathrm{max}(1,\,r)\,\Delta_{RHA},\,\Delta_{floor}),"
                r"\quad r=\Delta_{row}/\Delta_{rigid}"
            ),
            reference="estimated with links",
            steps=tuple(_step(package, found) for found in package.assessment.linked),
            note="Where a model is asked for, the value from analysis is the larger of its own and "
            "that of the model that the motions need."
            if any(found.found.is_model_asked_for for found in package.assessment.linked)
            else "",
        ),
    )


def _step(package: PackageData, found: LinkedArray) -> tuple[str, str]:
    fmt, design = package.fmt, found.found
    return (
        f"{design.array.id}: max(max(1, {_ratio(found.ratio)}) × "
        f"{fmt.both(found.value_m)}, {fmt.both(design.floor_m)})",
        _estimated(package, found),
    )


def _estimated(package: PackageData, found: LinkedArray) -> str:
    return "no limit" if math.isinf(found.estimated_m) else package.fmt.both(found.estimated_m)


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
        rows=tuple(TableRow(cells=_row(package, found)) for found in package.assessment.linked),
        notes=(
            "Block: the one that goes farthest, counted from the highest. Link force: the largest "
            f"in any link; it stands beside the strength that {package.part('limits')} asks for.",
        ),
        kind="compact",
    )


def _row(package: PackageData, found: LinkedArray) -> tuple[str, ...]:
    fmt, mus, farthest = package.fmt, found.row.mus, found.farthest
    return (
        found.found.array.id,
        str(len(mus)),
        " to ".join(number(mu, 3) for mu in sorted({min(mus), max(mus)})),
        *fmt.cells(found.links.stiffness_n_per_m, Quantity.STIFFNESS),
        number(found.links.damping_ratio, 3),
        *fmt.cells(found.rigid_prd_m),
        *fmt.cells(farthest.prd_m),
        NO_VALUE if math.isnan(farthest.prd_m) else str(farthest.block),
        *fmt.cells(found.link_force_n, Quantity.WEIGHT),
    )


def _design_table(package: PackageData, matters: str) -> Table:
    fmt = package.fmt
    linked = package.assessment.linked
    ways = sorted({statistic(found.found.analysis.basis) for found in linked})
    return Table(
        caption="Whether one rigid block is enough",
        columns=(
            TableColumn(head="Array", align="left", share=0.9),
            *fmt.columns("Rigid, one axis"),
            *fmt.columns("Row, one axis"),
            TableColumn(head="Ratio r", share=0.9),
            *fmt.columns("Design, used"),
            *fmt.columns("Design, with links"),
            TableColumn(head="Verdict", align="center", share=1.0),
        ),
        rows=tuple(TableRow(cells=_design(package, found)) for found in linked),
        notes=(
            f"Rigid and row: {', '.join(ways)} of the motions' PRDs, of the row those of the block "
            "that goes farthest. OK where the design with links is above the one used by no more "
            f"than {matters}, whichever is larger, and every run ends at rest.",
        ),
        kind="compact",
    )


def _design(package: PackageData, found: LinkedArray) -> tuple[str, ...]:
    fmt, estimated = package.fmt, found.estimated_m
    return (
        found.found.array.id,
        *fmt.cells(found.rigid.value_m),
        *fmt.cells(found.linked.value_m),
        _ratio(found.ratio),
        *fmt.cells(found.found.design_towards_m(Direction.ANY)),
        *(("∞", "∞") if math.isinf(estimated) else fmt.cells(estimated)),
        verdict(found.is_rigid_enough),
    )
