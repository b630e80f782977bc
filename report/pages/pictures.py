"""The pictures of the package.

Gives each picture its caption; `report.figures` draws it.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from report.assessment.arrays import ArrayAssessment
from report.assessment.evidence import Evidence
from report.assessment.spectra import Spectra
from report.pages import accuracy, certainty, friction_tests, section
from report.pages.parts import PackageData, Picture
from report.typeset.pdf import TEMPLATES
from solver.model import SlideHistory

PANELS, CHART_ROWS, ACCELERATION_ROWS = 12, 16, 16  # maximum in one figure: it must fit on a page
Pictures = Mapping[str, Sequence[Picture]]


def load_charts() -> None:
    """Load the plotting library, which is slow, and the fonts."""
    from report.figures.base import load_fonts

    load_fonts(TEMPLATES / "fonts")


def draw_assessment(package: PackageData) -> Pictures:
    """Return the pictures that need no evidence, by the id of their part."""
    from report.figures import charts as figures

    load_charts()
    us_first, assessment = package.fmt.us_first, package.assessment
    motions = assessment.shaking.motions
    return {
        "inputs-plan": [
            Picture(
                svg=figures.roof_plan(package.data, us_first),
                caption="Roof plan to scale: arrays with downslope direction and slope, objects, "
                f"roof edges, and clearances, numbered as in {package.part('clearances')}.",
                alt="Roof plan with arrays, objects, edges and clearances",
            )
        ],
        "inputs-friction": friction_tests.picture(package),
        "method-motion": [section.picture(package)],
        "motions-list": [
            Picture(
                svg=figures.accelerations(motions[at : at + ACCELERATION_ROWS]),
                caption="Accelerations of the motions as run, after scaling, all at one scale.",
                alt="Acceleration histories of the motions",
            )
            for at in range(0, len(motions), ACCELERATION_ROWS)
        ],
        "comparison": [
            Picture(
                svg=figures.comparison(assessment.arrays[at : at + CHART_ROWS], us_first),
                caption="Prescriptive displacement, floor, peak relative displacement (PRD) of "
                "each motion, their mean, and design displacement.",
                alt="Chart of displacements by array",
            )
            for at in range(0, len(assessment.arrays), CHART_ROWS)
        ],
        "clearances": [
            Picture(
                svg=figures.clearances(
                    assessment.clearances[at : at + CHART_ROWS], us_first, start=at + 1
                ),
                caption="Required and provided separation.",
                alt="Chart of required and provided separations",
            )
            for at in range(0, len(assessment.clearances), CHART_ROWS)
        ],
    }


def draw_evidence(package: PackageData, evidence: Evidence) -> Pictures:
    """Return the other pictures, by the id of their part."""
    from report.figures import charts as figures

    us_first = package.fmt.us_first
    pictures = {
        "motions-spectra": [
            Picture(
                svg=figures.spectra(parts),
                caption=f"Response spectra of the motions {where}, 5 % damping, and target.",
                alt="Response spectra of all motions, their mean and the target",
            )
            for where, parts in _by_place(evidence.spectra)
        ],
        "accuracy": (
            [accuracy.picture(evidence.accuracy.rivals, us_first)]
            if evidence.accuracy.rivals.runs
            else []
        ),
        "how-sure": certainty.pictures(package, evidence.certainty.surface),
    }
    runs = zip(package.assessment.arrays, evidence.histories, strict=True)
    for count, (array, followed) in enumerate(runs, start=1):
        pictures[f"results-{count}"] = list(_histories(array, followed, us_first))
    return pictures


def _by_place(spectra: Sequence[Spectra]) -> Iterator[tuple[str, Sequence[Spectra]]]:
    """Yield the spectra at the roof, and those on the ground where there are any."""
    below = [part for part in spectra if part.is_ground]
    yield "as run", [part for part in spectra if not part.is_ground]
    if below:
        yield "on the ground, scaled", below


def _histories(
    array: ArrayAssessment, followed: Sequence[SlideHistory], us_first: bool
) -> Iterator[Picture]:
    from report.figures.charts import histories

    two = any(m.governing.has_across for m in array.motions)
    lines = (
        ": downslope (blue) and cross-slope, positive to the left (orange)"
        if two
        else ", downslope"
    )
    for start in range(0, len(array.motions), PANELS):
        here = slice(start, start + PANELS)
        yield Picture(
            svg=histories(array.motions[here], followed[here], us_first),
            caption=f"Array {array.id}: displacement relative to the roof in the "
            f"governing run{lines}. Dot: time of the PRD, the largest distance in plan.",
            alt=f"Relative displacement histories of array {array.id}",
        )
