"""The studies of the paper repeated: Figs. 5 to 12."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
import pandas as pd

from report.document.sections import Section, section
from report.document.tables import Table, listed, with_total
from report.entities.shown import text, words
from report.figures import paper
from report.words.counts import grouped_by
from report.words.formats import general, percent, seconds, slug
from report.words.letters import lettered
from solver.verification import paper_studies
from solver.verification.evidence import DesignCurves, LinkComparison, Verification

PAPER_WORST_PERCENT, PAPER_MEAN_PERCENT = 6.78, 1.69
"""Differences in RRD between the paper's method and SAP 2000."""


def convergence(verification: Verification) -> Section:
    """Return the paper's Fig. 5."""
    found = list(verification.convergence.items())
    return section(
        "manual/convergence",
        "The paper's convergence study (Fig. 5)",
        scenarios=len(paper_studies.CONVERGENCE_CASES),
        paper_percent=paper.PAPER_P64_PERCENT,
        errors=[(record, _errors(study)) for record, study in found],
        charts={
            f"convergence-{at // 3 + 1}": paper.convergence(found[at : at + 3])
            for at in range(0, len(found), 3)
        },
    )


def _errors(study: pd.DataFrame) -> Table:
    return listed(
        study.itertuples(),
        (
            (text("P", share=0.6), lambda row: row.Index),
            (text("Against exact", share=1.2), lambda row: percent(row.exact_percent)),
            # 0 for the last P, which is compared with itself: no error, and none is printed.
            (
                text(f"Against P = {study.index[-1]}", share=1.2),
                lambda row: percent(row.finest_percent or math.nan),
            ),
            (text("Against exact, of the PRD", share=1.3), lambda row: percent(row.prd_percent)),
            (text("Longest time"), lambda row: seconds(row.seconds)),
            (words("Worst scenario", 2.2), lambda row: lettered(row.worst_case)),
        ),
        kind="compact",
    )


def links(verification: Verification) -> Section:
    """Return the paper's Figs. 6 to 9."""
    by_record = grouped_by(verification.links, lambda link: link.record)
    by_chart = {f"links-{slug(name)}": tuple(rows) for name, rows in by_record.items()}
    return section(
        "manual/links",
        "Comparison with a link model (Figs. 6 to 9)",
        by_chart=by_chart,
        differences=_differences(verification.links),
        charts={name: paper.links(rows) for name, rows in by_chart.items()},
    )


def _differences(links: Sequence[LinkComparison]) -> Table:
    found = listed(
        links,
        (
            (words("Record", 3.0), lambda link: link.record),
            (text("θ", share=0.6), lambda link: f"{link.slope_deg:g}°"),
            (text("Runs", share=0.7), lambda link: len(link.runs_m)),
            (text("Largest"), lambda link: percent(link.worst_percent)),
            (text("At μ", share=0.7), lambda link: general(link.history_mu)),
            (text("Absolute", share=0.9), lambda link: f"{worst_mm(link):.2g} mm"),
            (text("Mean"), lambda link: percent(link.mean_percent)),
        ),
    )
    return with_total(
        found,
        ("The paper against SAP 2000, record of the paper", "0°", "10",
         f"{PAPER_WORST_PERCENT} %", "—", "—", f"{PAPER_MEAN_PERCENT} %"),
    )  # fmt: skip


def worst_mm(link: LinkComparison) -> float:
    """Return the difference in RRD [mm] in the case where it is largest in percent."""
    off_m = link.runs_m["RRD, exact"] - link.runs_m["RRD, link"]
    return 1e3 * float(abs(off_m[link.history_mu]))


def curves(verification: Verification) -> Section:
    """Return the paper's Figs. 10 to 12."""
    slope_deg, wanted_m = paper.READ_OFF
    names = [slug(study.record) for study in verification.curves]
    return section(
        "manual/curves",
        "Design curves (Figs. 10 to 12)",
        ppa_g=paper.FIG_12_PPA_G,
        slope_deg=slope_deg,
        wanted_mm=1e3 * wanted_m,
        studies=[
            (study, _least_mu(study), f"curves-{name}", f"contours-{name}")
            for study, name in zip(verification.curves, names, strict=True)
        ],
        read_off=_read_off(verification.curves),
        charts={
            chart: svg
            for study, name in zip(verification.curves, names, strict=True)
            for chart, svg in (
                (f"curves-{name}", paper.curves(study)),
                (f"contours-{name}", paper.contours(study)),
            )
        },
    )


def _least_mu(study: DesignCurves) -> float:
    slope_deg, wanted_m = paper.READ_OFF
    return study.minimum_mu(slope_deg, paper.FIG_12_PPA_G, wanted_m)


def _read_off(studies: Sequence[DesignCurves]) -> Table:
    slope_deg, wanted_m = paper.READ_OFF
    least = f"Least μ for {1e3 * wanted_m:g} mm at θ = {slope_deg:g}°"
    found = listed(
        studies,
        (
            (words("Record", 2.4), lambda study: study.record),
            (text("PRD at θ = 4°, μ = 0.5", share=1.6), lambda study: f"{_prd_mm(study):.0f} mm"),
            (text(least, share=2.0), lambda study: _least_words(_least_mu(study))),
            (text("Runs", share=0.8), lambda study: f"{study.runs:,}"),
            (text("Time", share=0.8), lambda study: seconds(study.seconds)),
        ),
    )
    return with_total(found, ("The paper, record of the paper", "1000 mm", "0.55", "6,960", "—"))


def _prd_mm(study: DesignCurves) -> float:
    return 1e3 * float(np.interp(0.5, study.mus, study.prd(4.0, paper.FIG_12_PPA_G)))


def _least_words(mu: float) -> str:
    return "none in study" if math.isnan(mu) else f"{mu:.3f}"
