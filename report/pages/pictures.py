"""The pictures of the package.

Gives each picture its caption; `report.figures` draws it.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace

from report.assessment.arrays import ArrayAssessment
from report.assessment.evidence import Plotted
from report.assessment.project import Assessment
from report.assessment.spectra import Spectra, departures
from report.assessment.uncertainty import Uncertainty
from report.assessment.verdict import Requirement, Verdict
from report.document.blocks import Picture
from report.pages import accuracy, friction_tests, limits, section, uncertainty
from report.pages.parts import PackageData
from report.typeset.pdf import TEMPLATES
from solver.model import SlideHistory

PANELS, CHART_ROWS, ACCELERATION_ROWS = 12, 16, 16  # maximum in one figure: it must fit on a page
LEAST_PLAN_IN = 1.6  # a plan of less height shows nothing
SHEET_IN = 8.8  # from the head of a sheet to its foot
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
        "plan": [
            Picture(
                svg=figures.roof_plan(
                    assessment,
                    figures.LANDSCAPE if figures.is_wide(assessment) else figures.PORTRAIT,
                ),
                caption="Roof plan to the scale stated, where printed at full size. Provided and "
                "required separations are those of "
                f"{package.part('clearances')}. The same plan is in the file plan.dxf.",
                alt="Roof plan with displacement envelopes, clearances and field notes",
            )
        ],
        "comparison": [
            Picture(
                svg=figures.comparison(assessment.arrays[at : at + CHART_ROWS], us_first),
                caption=f"Prescriptive displacement,{_floor(assessment)} peak relative "
                "displacement (PRD) of each motion, their mean, and design displacement.",
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


def _floor(assessment: Assessment) -> str:
    """Return the floor where the chart draws one."""
    return " floor," if any(array.floor_m for array in assessment.arrays) else ""


def _small_plan(package: PackageData, spectra: Sequence[Spectra]) -> Iterator[Picture]:
    """Yield the plan for the summary in the room that its tables leave; none on a full sheet."""
    from report.figures import charts as figures

    tall = min(_summary_room_in(package, spectra), figures.SMALL.tall)
    if tall < LEAST_PLAN_IN:
        return
    yield Picture(
        svg=figures.roof_plan(package.assessment, replace(figures.SMALL, tall=tall)),
        caption="Roof plan to scale. Clearances are numbered as in "
        f"{package.part('clearances')}; {package.part('plan')} is the plan in full.",
        alt="Roof plan with arrays, objects, edges and clearances",
    )


def _summary_room_in(package: PackageData, spectra: Sequence[Spectra]) -> float:
    """Return what the tables and sentences of the summary leave of its last sheet [in]."""
    assessment, found = package.assessment, limits.troubles(package)
    failed = sum(gap.verdict is Verdict.NG for gap in assessment.clearances)
    # Their conditions take two lines.
    edges = sum("without" in gap.neighbor.value for gap in assessment.clearances)
    rows = len(assessment.arrays) + len(assessment.clearances)
    answers = 0.7 + 0.45 * failed if failed else 0.0
    troubles = 0.3 + 0.33 * sum(map(len, found.values())) if found else 0.0
    missed = 0.5 * len(departures(spectra))
    room = 5.1 - 0.2 * rows - 0.15 * edges - answers - troubles - missed
    room -= _conditions_in(package) + sum(map(_wrapped_in, assessment.arrays))
    return room % SHEET_IN


def _conditions_in(package: PackageData) -> float:
    """Return how tall the list of conditions is [in]."""
    rows = package.assessment.conditions
    return 0.3 + sum(0.16 * math.ceil(_letters(row) / 110) for row in rows) if rows else 0.0


def _letters(row: Requirement) -> int:
    """Return how long a condition is, with the words between its parts."""
    of_subject = len(f"array {row.subject}, ") if row.subject else 0
    texts = (row.consequence.value, row.title, row.found, row.limit, row.remedy)
    return of_subject + len(": : ; required: . ") + sum(map(len, texts))


def _wrapped_in(array: ArrayAssessment) -> float:
    """Return what friction that depends on velocity adds to the row of an array [in]."""
    return 0.0 if array.array.friction.is_constant else 0.3


def draw_plotted(package: PackageData, shown: Plotted) -> Pictures:
    """Return the pictures of spectra and of runs, by the id of their part."""
    from report.figures import charts as figures

    load_charts()
    us_first = package.fmt.us_first
    pictures = {
        "summary": list(_small_plan(package, shown.spectra)),
        "motions-spectra": [
            Picture(
                svg=figures.spectra(parts),
                caption=f"Response spectra of the motions {where}, 5 % damping, and target.",
                alt="Response spectra of all motions, their mean and the target",
            )
            for where, parts in _by_place(shown.spectra)
        ],
        "accuracy": (
            [accuracy.picture(shown.accuracy.rivals, us_first)]
            if shown.accuracy.rivals.runs
            else []
        ),
    }
    runs = zip(package.assessment.arrays, shown.histories, strict=True)
    for count, (array, followed) in enumerate(runs, start=1):
        pictures[f"results-{count}"] = list(_histories(array, followed, us_first))
    return pictures


def draw_uncertainty(package: PackageData, found: Uncertainty) -> Pictures:
    """Return the pictures of what is not known exactly, by the id of their part."""
    load_charts()
    return {"how-sure": uncertainty.pictures(package, found.surface)}


def _by_place(spectra: Sequence[Spectra]) -> Iterator[tuple[str, Sequence[Spectra]]]:
    """Yield the spectra at the roof, and those on the ground where there are any."""
    below = [part for part in spectra if part.is_ground]
    yield "as run", [part for part in spectra if not part.is_ground]
    if below:
        yield "on the ground, scaled", below


def _histories(
    array: ArrayAssessment, followed: Sequence[SlideHistory], us_first: bool
) -> Iterator[Picture]:
    from report.figures.charts import histories, hodographs

    two = any(history.across_m.size for history in followed)
    lines = (
        ": downslope (solid) and cross-slope, positive to the left when facing downslope (dashed)"
        if two
        else ", downslope"
    )
    one_axis = [
        run.motion.id
        for run, path in zip(array.motions, followed, strict=True)
        if not path.across_m.size and path.result.prd_m > 0.0
    ]
    straight = f" Straight lines: {', '.join(one_axis)}, in one axis." if one_axis else ""
    for start in range(0, len(array.motions), PANELS):
        here = slice(start, start + PANELS)
        yield Picture(
            svg=histories(array.motions[here], followed[here], us_first),
            caption=f"Array {array.id}: displacement relative to the roof in the "
            f"governing run{lines}. Dot: time of the PRD, the largest distance in "
            "plan, whose value is at the upper right.",
            alt=f"Relative displacement histories of array {array.id}",
        )
        yield Picture(
            svg=hodographs(array.motions[here], followed[here], us_first),
            caption=f"Array {array.id}: path in plan in the governing run, all motions at one "
            f"scale. Cross: start. Dot: PRD.{straight}",
            alt=f"Paths of array {array.id} in plan",
        )
