"""Supporting results that only the package prints, each computed once.

Draws nothing. Read `support`; `report.pages` prints it.
"""

from __future__ import annotations

from dataclasses import dataclass

from report.assessment.building_variations import building_variations
from report.assessment.cumulative import Cumulative, cumulative
from report.assessment.highpass import Beyond, beyond_corners
from report.assessment.project import Assessment
from report.assessment.remedies import Remedy, remedies
from report.assessment.sensitivity import Accuracy, accuracy
from report.assessment.spectra import Spectra, spectra
from report.assessment.uncertainty import Uncertainty, uncertainty
from report.sheet.schema.building import BuildingInput
from solver.model import SlideHistory
from solver.rules.provisions import AnalysisValue


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
    remedies: tuple[Remedy, ...]  # what would satisfy each clearance and array marked NG
    # margins in friction, and directions of shaking that are not run; none without motions
    uncertainty: Uncertainty | None
    cumulative: tuple[Cumulative, ...]  # for each array, if the workbook names smaller events
    building: tuple[tuple[BuildingInput, AnalysisValue], ...]  # with other periods and damping


def histories(assessment: Assessment) -> tuple[tuple[SlideHistory, ...], ...]:
    """Return the governing run of each motion at its samples, for arrays that share runs once."""
    return tuple(tuple(run.history() for run in group[0].motions) for group in assessment.alike)


def support(assessment: Assessment) -> Evidence:
    """Compute the results that support an assessment."""
    return Evidence(
        spectra=spectra(assessment),
        histories=histories(assessment),
        accuracy=accuracy(assessment),
        highpass=beyond_corners(assessment),
        remedies=remedies(assessment),
        uncertainty=uncertainty(assessment),
        cumulative=cumulative(assessment),
        building=building_variations(assessment),
    )
