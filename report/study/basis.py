"""How a study was run: motions, mats, models; and its limits."""

from __future__ import annotations

from report.document.sections import Section, section
from report.study.results import StudyResults
from report.study.spread import FREQ_HZ
from report.words.validation import explained
from solver.verification.shake_table import SHIPPED


def basis(results: StudyResults) -> Section:
    """Return the section on how the study was run."""
    without, motions = results.curves.without_value, results.plan.motions.motions[0]
    return section(
        "study/basis",
        "Basis",
        first=motions[0],
        lost=int(without.sum()),
        pairs=without.size * len(motions),
    )


def limits(results: StudyResults) -> Section:
    """Return the section on what the study does not say."""
    return section(
        "study/limits",
        "Limits",
        has_probabilities=any(one.exceedances for one in results.arrays),
        FREQ_HZ=FREQ_HZ,
        validation=explained(SHIPPED),
    )
