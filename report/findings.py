"""What the pictures of a package are drawn from, beyond its assessment.

Runs the solver and draws nothing: who draws need not load the solver's code. Read
`report.package` next.
"""

from __future__ import annotations

from dataclasses import dataclass

from report.accuracy import Rivals, rivals
from report.arrays import ArrayAssessment
from report.assess import Assessment
from report.sheet.workbook import InputBook
from report.spectra import Spectra, spectra
from solver.model import SlideHistory


@dataclass(frozen=True, slots=True, kw_only=True)
class Findings:
    """What the pictures of a package are drawn from, beyond its assessment.

    Attributes
    ----------
    spectra : tuple of Spectra
    histories : tuple of tuple of SlideHistory
        For each array, the governing run of each motion; all NaN where it gave no displacement.
    rivals : Rivals
        The run that governs the package, by every method.
    """

    spectra: tuple[Spectra, ...]
    histories: tuple[tuple[SlideHistory, ...], ...]
    rivals: Rivals


def find(book: InputBook, assessment: Assessment, governing: ArrayAssessment) -> Findings:
    """Return what the pictures of a package are drawn from."""
    return Findings(
        spectra=spectra(assessment, book.motions, book.stories),
        histories=tuple(tuple(run.history() for run in one.motions) for one in assessment.arrays),
        rivals=rivals(governing),
    )
