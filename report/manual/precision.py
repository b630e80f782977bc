"""Accuracy against run time: charts and medians.

Where methods fail, and where the problem itself is ill-conditioned.

The studies of the paper repeated: Figs. 5 to 12.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterator

import numpy as np
import pandas as pd

from report.document.columns import text, words
from report.document.sections import Section, section
from report.document.tables import Column, Table, listed
from report.figures.base import power_of_ten
from report.manual import paper_figures, stability_maps
from report.manual import work_figures as figures
from report.text.error_text import percent, seconds
from report.text.formula_text import lettered
from report.text.grouping import grouped_by
from report.text.letter_case import capitalized
from report.text.names import slug
from solver.rivals.methods import METHODS
from solver.sliding.two_axes import DEFAULT_TOLERANCE
from solver.verification import paper_studies
from solver.verification.checks import RANDOM, ROOF
from solver.verification.evidence import DesignCurves, LinkComparison, Verification
from solver.verification.workprecision import OURS, RUN, SINGLE, TIME, times_longer


def floor(verification: Verification) -> float:
    """Return the largest relative error of the exact method against 50-digit arithmetic."""
    errors = [row.error for row in verification.checks if row.section.endswith("digits")]
    # A chart in logarithms has no place for 0.
    return max([1e-16, *errors])


def methods(verification: Verification) -> Section:
    """Return what each method is, and its errors against 50 digits."""
    errors = verification.rivals
    kinds = errors.pivot(columns="motions", values="error [%]").assign(method=errors["method"])
    name = (words("Method", 3.6), lambda row: lettered(METHODS[row[0]].title))
    of_kinds = (_errors(capitalized(kind), kind, reference="") for kind in (RANDOM, ROOF))
    return section(
        "manual/methods",
        "Methods compared",
        methods=tuple(METHODS.values()),
        errors=listed(
            kinds.groupby("method", sort=False),
            (name, *itertools.chain.from_iterable(of_kinds)),
            kind="compact",
        ),
    )


def work(verification: Verification) -> Section:
    """Return accuracy against run time."""
    runs, floor_share = verification.work, floor(verification)
    plane = verification.models[0].work if verification.models else runs[:0]
    lost = runs[runs[[TIME, "PRD error [m]"]].isna().any(axis=1)]
    ours = plane[(plane["method"] == OURS) & (plane["setting"] == DEFAULT_TOLERANCE)]
    return section(
        "manual/work",
        "Accuracy against run time",
        cases=len(runs[RUN].drop_duplicates()),
        lost=lost.groupby("method", sort=False).size().to_dict(),
        floor_percent=100.0 * floor_share,
        plane=plane,
        ours=ours,
        in_plane=times_longer(
            plane[plane["method"].str.endswith("(compiled)")], ours, "residual error [%]"
        ),
        medians=_medians(runs),
        charts={"work-percent": figures.overview(runs, plane, 100.0 * floor_share)},
    )


def _medians(runs: pd.DataFrame) -> Table:
    return listed(
        _shown(runs),
        (
            (words("Method", 3.6), lambda row: row[0]),
            (words("Setting", 1.4), lambda row: _setting(*row[1].iloc[0][["method", "setting"]])),
            (text("Time per run", share=1.2), lambda row: seconds(row[1][TIME].median())),
            (text("Single run", share=1.2), lambda row: seconds(row[1][SINGLE].median())),
            *_errors("Error in PRD", "PRD error [%]"),
            *_errors("Error in residual", "residual error [%]"),
            (text("Failed", share=0.7), lambda row: row[1][TIME].isna().sum()),
        ),
        kind="compact",
    )


def _shown(runs: pd.DataFrame) -> Iterator[tuple[str, pd.DataFrame]]:
    """Yield the runs of each setting that is shown, the first with the name of its method."""
    for name, own in runs.groupby("method", sort=False):
        groups = [group for _, group in own.groupby("setting", sort=False, dropna=False)]
        # Every other setting of a long sweep keeps the table short.
        for count, group in enumerate(groups[::2] if len(groups) > 5 else groups):
            yield "" if count else lettered(METHODS[str(name)].title), group


def _setting(method: str, value: float) -> str:
    knob = METHODS[method].knob
    if knob == "substeps":
        return f"P = {value:g}"
    form = {"stiffness_per_m": "k = {} /m", "velocity_mps": "v₀ = {} m/s"}
    return form[knob].format(power_of_ten(value)) if knob in form else "none"


def _errors(head: str, error: str, reference: str = "exact") -> tuple[Column, Column]:
    """Return the columns of the median and of the largest error."""

    def found(runs: pd.DataFrame, statistic: str) -> str:
        # It is what the others are compared with; its own error is against 50 digits.
        is_reference = runs["method"].iloc[0] == reference
        return "reference" if is_reference else percent(runs[error].agg(statistic))

    return (
        (text(head, "median", 1.2), lambda row: found(row[1], "median")),
        (text(head, "largest", 1.2), lambda row: found(row[1], "max")),
    )


def stability(verification: Verification) -> Section:
    """Return the stability maps with their notes."""
    # Numbered through all charts: the notes name a map by its number.
    counted = list(enumerate(verification.maps, start=1))
    by_chart = {
        f"stability-{k // stability_maps.MOST + 1}": counted[k : k + stability_maps.MOST]
        for k in range(0, len(counted), stability_maps.MOST)
    }
    return section(
        "manual/stability",
        "Stability",
        by_chart=by_chart,
        charts={
            name: stability_maps.stability([sweep for _, sweep in maps], first=maps[0][0])
            for name, maps in by_chart.items()
        },
    )


def conditioning(verification: Verification) -> Section:
    """Return the effect of a small change of friction, the largest and the median change [%]."""
    return section(
        "manual/conditioning",
        "Sensitivity to the friction coefficient",
        cases=[
            (case, np.nanmax(case.change_percent), np.nanmedian(case.change_percent))
            for case in verification.conditioning
        ],
    )


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
        prd_mm=_prd_mm,
        charts=charts,
    )


def _least_mu(study: DesignCurves) -> float:
    slope_deg, wanted_m = paper_figures.READ_OFF
    return study.minimum_mu(slope_deg, paper_figures.FIG_12_PPA_G, wanted_m)


def _prd_mm(study: DesignCurves) -> float:
    return 1e3 * float(np.interp(0.5, study.mus, study.prd(4.0, paper_figures.FIG_12_PPA_G)))
