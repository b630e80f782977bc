"""Supporting results that only the package prints, each computed once.

Draws nothing. Read `support`; `report.pages` prints it.
"""

from __future__ import annotations

from dataclasses import dataclass

from report.assessment.assessment import Assessment
from report.assessment.remedies.remedy import Remedies, remedies
from report.assessment.support.further_runs import (
    Beyond,
    Cumulative,
    Variations,
    beyond_corners,
    building_variations,
    cumulative,
)
from report.assessment.support.input_cases import InputCase, cases
from report.assessment.support.response_spectra import Spectra, spectra
from report.assessment.support.shifted_friction import Accuracy, accuracy
from report.assessment.support.uncertainty import Uncertainty, uncertainty
from solver.model import SlideHistory


@dataclass(frozen=True, slots=True, kw_only=True)
class Evidence:
    """Results that support an assessment."""

    spectra: tuple[Spectra, ...]
    # for each group of arrays that share runs, the governing run of each motion; all NaN where it
    # has no displacement
    histories: tuple[tuple[SlideHistory, ...], ...]
    accuracy: Accuracy  # the design with changed friction
    # effect of the high-pass of each motion on the slip of the governing array
    highpass: tuple[Beyond, ...]
    remedies: Remedies  # what would satisfy each check that is NG, and all of them
    # margins in friction, and directions of shaking that are not run; none without motions
    uncertainty: Uncertainty | None
    cumulative: tuple[Cumulative, ...]  # for each array, if the workbook names smaller events
    building: Variations
    cases: tuple[InputCase, ...]  # other inputs that would change a verdict or the route


def histories(assessment: Assessment) -> tuple[tuple[SlideHistory, ...], ...]:
    """Return the governing run of each motion at its samples, for arrays that share runs once."""
    return tuple(tuple(run.history() for run in group[0].motions) for group in assessment.alike)


def support(assessment: Assessment) -> Evidence:
    """Compute the results that support an assessment."""
    building = building_variations(assessment)
    return Evidence(
        spectra=spectra(assessment),
        histories=histories(assessment),
        accuracy=accuracy(assessment),
        highpass=beyond_corners(assessment),
        remedies=remedies(assessment),
        uncertainty=uncertainty(assessment),
        cumulative=cumulative(assessment),
        building=building,
        cases=tuple(cases(assessment, building)),
    )
