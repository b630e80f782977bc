"""What only the package prints, beyond the assessment: each computed once.

Draws nothing. Read `support`; `report.pages` says it.
"""

from __future__ import annotations

from dataclasses import dataclass

from report.assessment.highpass import Beyond, beyond_corners
from report.assessment.project import Assessment
from report.assessment.sensitivity import Accuracy, accuracy
from report.assessment.spectra import Spectra, spectra
from solver.model import SlideHistory


@dataclass(frozen=True, slots=True, kw_only=True)
class Evidence:
    """What stands behind an assessment.

    Attributes
    ----------
    spectra : tuple of Spectra
    histories : tuple of tuple of SlideHistory
        For each array, the governing run of each motion; all NaN where it gave no displacement.
    accuracy : Accuracy
        The governing run by every method, and the design with other friction.
    highpass : tuple of Beyond
        What the high-pass of each motion takes from the slip of the governing array.
    """

    spectra: tuple[Spectra, ...]
    histories: tuple[tuple[SlideHistory, ...], ...]
    accuracy: Accuracy
    highpass: tuple[Beyond, ...]


def support(assessment: Assessment) -> Evidence:
    """Compute what stands behind an assessment."""
    return Evidence(
        spectra=spectra(assessment),
        histories=tuple(tuple(run.history() for run in one.motions) for one in assessment.arrays),
        accuracy=accuracy(assessment),
        highpass=beyond_corners(assessment),
    )
