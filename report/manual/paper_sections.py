"""The studies of the paper repeated, Figs. 5 to 12: sections of the manual."""

from __future__ import annotations

import math

import numpy as np
import pandas as pd

from report.document.columns import text, words
from report.document.sections import Section, section
from report.document.tables import Table, closed_by, listed
from report.manual import paper_figures
from report.text.error_text import general, percent, seconds
from report.text.grouping import grouped_by
from report.text.names import slug
from report.text.units import NO_BREAK, number
from solver.verification import paper_studies
from solver.verification.evidence import DesignCurves, LinkComparison, Verification

_SLOPE_DEG, _WANTED_M = paper_figures.READ_OFF
_WANTED = f"{1e3 * _WANTED_M:g}{NO_BREAK}mm at θ = {_SLOPE_DEG:g}°"
_PPA = f"PPA = {paper_figures.FIG_12_PPA_G:g}{NO_BREAK}g"

# Differences in RRD between the paper's method and SAP 2000.
PAPER_WORST_PERCENT, PAPER_MEAN_PERCENT = 6.78, 1.69


_IN_PERCENT = "largest error in the residual, in percent of the residual and of the PRD"


def convergence(verification: Verification) -> Section:
    """Return the paper's Fig. 5."""
    orders = list(verification.convergence.items())
    return section(
        "manual/convergence",
        "The paper's convergence study (Fig. 5)",
        scenarios=len(paper_studies.CONVERGENCE_CASES),
        paper_percent=paper_figures.PAPER_P64_PERCENT,
        by_record=[(f"{record}: {_IN_PERCENT}", _errors(study)) for record, study in orders],
        charts={
            # Three rows to a chart, which stays on one page.
            f"convergence-{start // 3 + 1}": paper_figures.convergence(orders[start : start + 3])
            for start in range(0, len(orders), 3)
        },
    )


def _errors(study: pd.DataFrame) -> Table:
    against_last = text(f"Against P = {study.index[-1]}", share=1.2)
    columns = (
        (text("P", share=0.6), lambda row: row.Index),
        (text("Against exact", share=1.2), lambda row: percent(row.exact_percent)),
        # 0 for the last P, which is compared with itself: no error, and none is printed.
        (against_last, lambda row: percent(row.finest_percent or math.nan)),
        (text("Against exact, of the PRD", share=1.3), lambda row: percent(row.prd_percent)),
        (text("Longest time"), lambda row: seconds(row.seconds)),
        (words("Worst scenario", 2.2), lambda row: row.worst_case),
    )
    return listed(study.itertuples(), columns, kind="compact")


_LINKS = (
    (words("Record", 3.0), lambda link: link.record),
    (text("θ", share=0.6), lambda link: f"{link.slope_deg:g}°"),
    (text("Runs", share=0.7), lambda link: len(link.runs_m)),
    (text("Largest"), lambda link: percent(link.worst_percent)),
    (text("At μ", share=0.7), lambda link: general(link.history_mu)),
    (text("Absolute", share=0.9), lambda link: f"{worst_mm(link):.2g} mm"),
    (text("Mean"), lambda link: percent(link.mean_percent)),
)
_SAP = "The paper against SAP 2000, record of the paper"


def links(verification: Verification) -> Section:
    """Return the paper's Figs. 6 to 9."""
    by_record = grouped_by(verification.links, lambda link: link.record)
    by_chart = {f"links-{slug(name)}": tuple(rows) for name, rows in by_record.items()}
    return section(
        "manual/links",
        "Comparison with a link model (Figs. 6 to 9)",
        differences=closed_by(
            listed(verification.links, _LINKS),
            (_SAP, "0°", "10", f"{PAPER_WORST_PERCENT}%", "—", "—", f"{PAPER_MEAN_PERCENT}%"),
        ),
        figures=[
            (
                name,
                f"{rows[0].record}, PPA = {rows[0].ppa_g:g}{NO_BREAK}g. Left: displacement history "
                "for the friction coefficient with the largest difference in percent; "
                "right: PRD and RRD.",
                f"Exact method and link compared on {rows[0].record}",
            )
            for name, rows in by_chart.items()
        ],
        charts={name: paper_figures.links(rows) for name, rows in by_chart.items()},
    )


def worst_mm(link: LinkComparison) -> float:
    """Return the difference in RRD [mm] in the case where it is largest in percent."""
    # Largest in percent, which need not be the largest in mm.
    off_m = link.runs_m["RRD, exact"] - link.runs_m["RRD, link"]
    return 1e3 * float(abs(off_m[link.history_mu]))


def curves(verification: Verification) -> Section:
    """Return the paper's Figs. 10 to 12."""
    columns = (
        (words("Record", 2.4), lambda study: study.record),
        (text("PRD at θ = 4°, μ = 0.5", share=1.6), _prd),
        (
            text(f"Least μ for {_WANTED}", share=2.0),
            lambda study: number(_least_mu(study), 3).replace("—", "none in study"),
        ),
        (text("Runs", share=0.8), lambda study: f"{study.runs:,}"),
        (text("Time", share=0.8), lambda study: seconds(study.seconds)),
    )
    names = [slug(study.record) for study in verification.curves]
    charts, figures = dict[str, str](), []
    for study, name in zip(verification.curves, names, strict=True):
        record, against = study.record, "PRD against PPA (Fig. 10) and against slope (Fig. 11)"
        charts[f"curves-{name}"] = paper_figures.curves(study)
        charts[f"contours-{name}"] = paper_figures.contours(study)
        caption = f"{record}: {against}; the larger of both signs of the slope."
        figures.append((f"curves-{name}", caption, f"PRD against PPA and slope for {record}"))
        contours = f"Contours of PRD against friction and slope for {record}"
        figures.append((f"contours-{name}", record + _answer(study), contours))
    return section(
        "manual/curves",
        "Design curves (Figs. 10 to 12)",
        caption=f"Values from the curves at {_PPA}",
        values=closed_by(
            listed(verification.curves, columns),
            # Read off the paper's text, at PPA 1.5 g, for its own record: another record differs.
            ("The paper, record of the paper", f"1000{NO_BREAK}mm", "0.55", "6,960", "—"),
        ),
        figures=figures,
        charts=charts,
    )


def _prd(study: DesignCurves) -> str:
    prd_m = np.interp(0.5, study.mus, study.prd(4.0, paper_figures.FIG_12_PPA_G))
    return f"{1e3 * prd_m:.0f} mm"


def _least_mu(study: DesignCurves) -> float:
    return study.minimum_mu(_SLOPE_DEG, paper_figures.FIG_12_PPA_G, _WANTED_M)


def _answer(study: DesignCurves) -> str:
    """Return the caption of the contours after the record, with what their arrow reads off."""
    least_mu = _least_mu(study)
    if math.isnan(least_mu):
        caption = f"No μ of the study limits the PRD to {_WANTED}."
    else:
        caption = f"Arrow: a PRD of at most {_WANTED} requires μ of at least {number(least_mu, 3)}."
    return f": contours of PRD against μ and θ at {_PPA} (Fig. 12). {caption}"
