"""The studies of the paper repeated, Figs. 5 to 12: sections of the manual."""

from __future__ import annotations

import numpy as np

from report.document.sections import Section, section
from report.manual import paper_figures
from report.text.grouping import grouped_by
from report.text.names import slug
from solver.verification import paper_studies
from solver.verification.evidence import DesignCurves, LinkComparison, Verification

# Differences in RRD between the paper's method and SAP 2000.
PAPER_WORST_PERCENT, PAPER_MEAN_PERCENT = 6.78, 1.69


def convergence(verification: Verification) -> Section:
    """Return the paper's Fig. 5."""
    orders = list(verification.convergence.items())
    return section(
        "manual/convergence",
        "The paper's convergence study (Fig. 5)",
        scenarios=len(paper_studies.CONVERGENCE_CASES),
        paper_percent=paper_figures.PAPER_P64_PERCENT,
        errors=orders,
        charts={
            # Three rows to a chart, which stays on one page.
            f"convergence-{start // 3 + 1}": paper_figures.convergence(orders[start : start + 3])
            for start in range(0, len(orders), 3)
        },
    )


def links(verification: Verification) -> Section:
    """Return the paper's Figs. 6 to 9."""
    by_record = grouped_by(verification.links, lambda link: link.record)
    by_chart = {f"links-{slug(name)}": tuple(rows) for name, rows in by_record.items()}
    return section(
        "manual/links",
        "Comparison with a link model (Figs. 6 to 9)",
        by_chart=by_chart,
        worst_mm=worst_mm,
        PAPER_WORST_PERCENT=PAPER_WORST_PERCENT,
        PAPER_MEAN_PERCENT=PAPER_MEAN_PERCENT,
        charts={name: paper_figures.links(rows) for name, rows in by_chart.items()},
    )


def worst_mm(link: LinkComparison) -> float:
    """Return the difference in RRD [mm] in the case where it is largest in percent."""
    # Largest in percent, which need not be the largest in mm.
    off_m = link.runs_m["RRD, exact"] - link.runs_m["RRD, link"]
    return 1e3 * float(abs(off_m[link.history_mu]))


def curves(verification: Verification) -> Section:
    """Return the paper's Figs. 10 to 12."""
    slope_deg, wanted_m = paper_figures.READ_OFF
    names = [slug(study.record) for study in verification.curves]
    charts: dict[str, str] = {}
    for study, name in zip(verification.curves, names, strict=True):
        charts[f"curves-{name}"] = paper_figures.curves(study)
        charts[f"contours-{name}"] = paper_figures.contours(study)
    return section(
        "manual/curves",
        "Design curves (Figs. 10 to 12)",
        ppa_g=paper_figures.FIG_12_PPA_G,
        slope_deg=slope_deg,
        wanted_mm=1e3 * wanted_m,
        studies=[
            (study, _least_mu(study), f"curves-{name}", f"contours-{name}")
            for study, name in zip(verification.curves, names, strict=True)
        ],
        prd_mm=lambda study: (
            1e3 * float(np.interp(0.5, study.mus, study.prd(4.0, paper_figures.FIG_12_PPA_G)))
        ),
        charts=charts,
    )


def _least_mu(study: DesignCurves) -> float:
    slope_deg, wanted_m = paper_figures.READ_OFF
    return study.minimum_mu(slope_deg, paper_figures.FIG_12_PPA_G, wanted_m)
