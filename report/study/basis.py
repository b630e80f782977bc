"""How a study was run: motions, mats, models; and its limits."""

from __future__ import annotations

from report.document.sections import Section, section
from report.document.tables import Table, listed
from report.entities.shown import text, words
from report.pages.symbols import with_symbols
from report.study.results import StudyResults
from report.study.schema import Mat
from report.study.spread import FREQ_HZ
from report.words.validation import explained
from solver.verification.shake_table import SHIPPED

_WARNING = (
    (words("Cell", 1.2), lambda row: row[0]),
    (words("Warning", 6.0), lambda row: f"{row[1]}."),
)


def basis(results: StudyResults) -> Section:
    """Return the section on how the study was run."""
    without, motions = results.curves.without_value, results.plan.motions.motions[0]
    return section(
        "study/basis",
        "Basis",
        first=motions[0],
        lost=int(without.sum()),
        pairs=without.size * len(motions),
        models=_models(results),
        mats=_mats(results),
        motions=_motions(results),
        warnings=listed(results.plan.warnings, _WARNING),
    )


def _models(results: StudyResults) -> Table:
    manifest = results.manifest
    columns = (
        (words("Model", 3.0), lambda row: row[0]),
        (text("Runs"), lambda row: f"{row[1]:,}"),
        (text("Share"), lambda row: f"{100.0 * row[1] / manifest['rows']:.1f} %"),
    )
    return listed(manifest["models"].items(), columns, kind="compact")


def _mats(results: StudyResults) -> Table:
    friction = results.plan.input.friction

    def deviation(mat: Mat) -> str:
        return f"{friction(mat.id).beta:.3f}" if mat.tested else "none"

    columns = (
        (words("Mat", 1.5), lambda mat: mat.id),
        (text("μ, median"), lambda mat: f"{friction(mat.id).center:.3g}"),
        (text("Standard deviation of ln μ", share=1.4), deviation),
        (words("Tested values", 2.4), lambda mat: mat.tested or "none"),
        (words("Report", 1.8), lambda mat: mat.report or "none"),
    )
    return listed(results.plan.input.mats, columns, kind="compact")


def _motions(results: StudyResults) -> Table:
    factor = with_symbols(f"Factor for {results.plan.input.study.intensity.letters} = 1")
    columns = (
        (words("Motion", 1.4), lambda motion: motion.id),
        (text("Samples"), lambda motion: f"{motion.ax_mps2.size:,}"),
        (text("Time step", "s"), lambda motion: f"{motion.dt_s:g}"),
        (text(factor, share=1.4), lambda motion: f"{motion.scale:.4g}"),
        (words("Source", 2.4), lambda motion: motion.source or "not stated"),
    )
    return listed(results.plan.motions.motions[0], columns, kind="compact")


def limits(results: StudyResults) -> Section:
    """Return the section on what the study does not say."""
    return section(
        "study/limits",
        "Limits",
        has_probabilities=any(one.exceedances for one in results.arrays),
        FREQ_HZ=FREQ_HZ,
        validation=explained(SHIPPED),
    )
