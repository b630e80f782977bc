"""The paper's own studies made again: its Figs. 5 to 12."""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import groupby

import numpy as np

from report.figures import paper
from report.manual.blocks import (
    Block,
    Chart,
    ManualSection,
    percent,
    seconds,
    slug,
)
from report.pages.parts import Picture, Table, TableColumn, TableRow
from report.words.letters import lettered
from solver.verification.evidence import (
    Convergence,
    LinkComparison,
    Verification,
)

PAPER_WORST_PERCENT, PAPER_MEAN_PERCENT = 6.78, 1.69
"""Differences in RRD between the paper's method and SAP 2000."""

PAPER_READ_OFFS = "1000 mm at θ = 4°, μ = 0.5; μ ≥ 0.55 at θ = 2° for 500 mm"


def convergence(found: Verification) -> ManualSection:
    """Return the paper's Fig. 5."""
    scenarios = found.convergence[0].scenarios if found.convergence else 0
    return ManualSection(
        id="convergence",
        title="The paper's convergence study (Fig. 5)",
        blocks=(
            Block(
                texts=(
                    f"The paper's method in its {scenarios} scenarios (five slopes, three friction "
                    "coefficients, four PPA) with more and more sub-steps P. The paper took its "
                    "own result at P = 256 as the truth; both truths are shown. The paper reports "
                    f"{paper.PAPER_P64_PERCENT} % and less than 0.09 s at P = 64, on a record that "
                    "is not to be had here. Some scenarios end within millimetres of where they "
                    "began, so that percents of the residual are large; percents of the PRD are "
                    "in the table.",
                ),
                charts=[
                    Chart(
                        name=f"convergence-{at // 3 + 1}",
                        picture=Picture(
                            svg=paper.convergence(found.convergence[at : at + 3]),
                            caption="Largest error and longest time over the scenarios, against P.",
                            alt="Largest error and longest time against the number of sub-steps",
                        ),
                    )
                    for at in range(0, len(found.convergence), 3)
                ],
                tables=[_convergence_table(one) for one in found.convergence],
            ),
        ),
    )


def _convergence_table(one: Convergence) -> Table:
    return Table(
        caption=f"{one.record}: largest error in the residual, in percent of it and of the PRD",
        columns=(
            TableColumn(head="P", share=0.6),
            TableColumn(head="Truth: exact", share=1.2),
            TableColumn(head=f"Truth: P = {one.substeps[-1]}", share=1.2),
            TableColumn(head="of the PRD", share=1.2),
            TableColumn(head="Longest time", share=1.1),
            TableColumn(head="Worst scenario", align="left", share=2.2),
        ),
        rows=tuple(
            TableRow(
                cells=(
                    str(substeps),
                    percent(float(one.largest_error_exact_percent[index])),
                    percent(float(one.largest_error_p256_percent[index] or math.nan)),
                    percent(float(one.largest_error_of_prd_percent[index])),
                    seconds(float(one.longest_seconds[index])),
                    lettered(one.worst_cases[index]),
                )
            )
            for index, substeps in enumerate(one.substeps)
        ),
        kind="compact",
    )


def links(found: Verification) -> ManualSection:
    """Return the paper's Figs. 6 to 9."""
    by_record = [
        (name, tuple(rows)) for name, rows in groupby(found.links, key=lambda one: one.record)
    ]
    return ManualSection(
        id="links",
        title="Comparison with a link (Figs. 6 to 9)",
        blocks=(
            Block(
                texts=(
                    "The exact method against a link with a friction cap, explicit, with the "
                    "stiffness and sub-step of the paper's SAP 2000 model. As in the paper, "
                    "differences are of the residual, in percent of the link's. The difference is "
                    "the link's error: it stretches before it slips. Where the residual is of a "
                    "millimetre or so, percents of it are large and say little.",
                ),
                top=(_link_table(found.links),),
                charts=[
                    Chart(
                        name=f"links-{slug(name)}",
                        picture=Picture(
                            svg=paper.links(rows),
                            caption=f"{name}, PPA = {rows[0].ppa_g:g} g. Left: the friction "
                            "coefficient whose residual differs most; right: PRD and RRD.",
                            alt=f"Exact method and link compared on {name}",
                        ),
                    )
                    for name, rows in by_record
                ],
            ),
        ),
    )


def _link_table(links: Sequence[LinkComparison]) -> Table:
    rows = [
        TableRow(
            cells=(
                one.record,
                f"{one.slope_deg:g}°",
                str(one.mus.size),
                percent(one.worst_percent),
                f"{one.history_mu:g}",
                f"{worst_mm(one):.2g} mm",
                percent(one.mean_percent),
            )
        )
        for one in links
    ]
    paper_row = TableRow(
        cells=(
            "The paper, against SAP 2000, its record",
            "0°",
            "10",
            f"{PAPER_WORST_PERCENT} %",
            "—",
            "—",
            f"{PAPER_MEAN_PERCENT} %",
        ),
        kind="total",
    )
    return Table(
        caption="Difference in RRD between the exact method and the link",
        columns=(
            TableColumn(head="Record", align="left", share=3.0),
            TableColumn(head="θ", share=0.6),
            TableColumn(head="Runs", share=0.7),
            TableColumn(head="Worst", share=1.0),
            TableColumn(head="at μ", share=0.7),
            TableColumn(head="which is", share=0.9),
            TableColumn(head="Mean", share=1.0),
        ),
        rows=(*rows, paper_row),
    )


def worst_mm(one: LinkComparison) -> float:
    """Return the difference in RRD [mm] where it is largest in percent."""
    at = int(np.abs(one.mus - one.history_mu).argmin())
    return 1e3 * abs(float(one.rrd_exact_m[at] - one.rrd_link_m[at]))


def curves(found: Verification) -> ManualSection:
    """Return the paper's Figs. 10 to 12."""
    charts = []
    for one in found.curves:
        charts += [
            Chart(
                name=f"curves-{slug(one.record)}",
                picture=Picture(
                    svg=paper.curves(one),
                    caption=f"{one.record}: PRD against PPA (Fig. 10) and against slope (Fig. 11), "
                    "the larger of both signs of the slope.",
                    alt=f"PRD against PPA and slope for {one.record}",
                ),
            ),
            Chart(
                name=f"contours-{slug(one.record)}",
                picture=Picture(
                    svg=paper.contours(one),
                    caption=f"{one.record}: contours of PRD over μ and θ at PPA = "
                    f"{paper.FIG_12_PPA_G:g} g (Fig. 12). {_read_off_words(found, one.record)}",
                    alt=f"Contours of PRD over friction and slope for {one.record}",
                ),
            ),
        ]
    return ManualSection(
        id="curves",
        title="Design curves (Figs. 10 to 12)",
        blocks=(
            Block(
                texts=(
                    "29 slopes, 15 friction coefficients and 16 PPA on each record, by the exact "
                    f"method. The paper reads off, on its record: {PAPER_READ_OFFS}. Other records "
                    "give other values: the curves show the way, not a design.",
                ),
                top=(_read_off_table(found),),
                charts=charts,
            ),
        ),
    )


def _read_off_words(found: Verification, record: str) -> str:
    one = next(one for one in found.curves if one.record == record)
    slope, wanted = paper.READ_OFF
    least = one.least_mu(slope, paper.FIG_12_PPA_G, wanted)
    if math.isnan(least):
        return f"No μ of the study keeps {1e3 * wanted:g} mm at θ = {slope:g}°."
    return (
        f"Arrow: for a PRD of at most {1e3 * wanted:g} mm at θ = {slope:g}°, μ of at least "
        f"{least:.3f}."
    )


def _read_off_table(found: Verification) -> Table:
    slope, wanted = paper.READ_OFF
    rows = []
    for one in found.curves:
        prd = float(np.interp(0.5, one.mus, one.prd(4.0, paper.FIG_12_PPA_G)))
        least = one.least_mu(slope, paper.FIG_12_PPA_G, wanted)
        rows.append(
            TableRow(
                cells=(
                    one.record,
                    f"{1e3 * prd:.0f} mm",
                    "none of the study" if math.isnan(least) else f"{least:.3f}",
                    f"{one.runs:,}",
                    seconds(one.seconds),
                )
            )
        )
    paper_row = TableRow(
        cells=("The paper, its record", "1000 mm", "0.55", "6,960", "—"), kind="total"
    )
    return Table(
        caption=f"Read-offs at PPA = {paper.FIG_12_PPA_G:g} g",
        columns=(
            TableColumn(head="Record", align="left", share=2.4),
            TableColumn(head="PRD at θ = 4°, μ = 0.5", share=1.6),
            TableColumn(head=f"Least μ at θ = {slope:g}° for {1e3 * wanted:g} mm", share=2.0),
            TableColumn(head="Runs", share=0.8),
            TableColumn(head="Time", share=0.8),
        ),
        rows=(*rows, paper_row),
    )
