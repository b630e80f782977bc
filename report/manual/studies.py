"""The studies of the paper repeated: Figs. 5 to 12."""

from __future__ import annotations

import numpy as np

from report.document.sections import Section, section
from report.figures import paper
from report.words.counts import grouped_by
from report.words.formats import slug
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
        errors=found,
        charts={
            f"convergence-{at // 3 + 1}": paper.convergence(found[at : at + 3])
            for at in range(0, len(found), 3)
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
        charts={name: paper.links(rows) for name, rows in by_chart.items()},
    )


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
        prd_mm=_prd_mm,
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


def _prd_mm(study: DesignCurves) -> float:
    return 1e3 * float(np.interp(0.5, study.mus, study.prd(4.0, paper.FIG_12_PPA_G)))
