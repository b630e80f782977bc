"""The drawings of the package, by the id of their place; its template says their captions.

`report.figures` draws them, at once or after the pages that name them. Read `Draw`.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import partial
from typing import Any

from report.assessment.arrays import ArrayAssessment
from report.assessment.evidence import Evidence
from report.assessment.spectra import Spectra, departures
from report.assessment.uncertainty import Uncertainty
from report.assessment.verdict import Verdict
from report.drawing.on_paper import printed_plan
from report.drawing.sheet import SMALL
from report.pages import friction_tests, limits
from report.pages.parts import PackageData
from report.typeset.equations import data_uri
from solver.model import SlideHistory

PANELS, CHART_ROWS, ACCELERATION_ROWS = 12, 16, 16  # maximum in one figure: it must fit on a page
GAP_ROWS = 32
LEAST_PLAN_IN = 1.6  # a plan of less height shows nothing
SHEET_IN = 8.8  # from the head of a sheet to its foot
Drawings = Mapping[str, Sequence[Any]]
"""SVG by the id of its place; of an array, pairs of histories and paths; of the roof plan, what
is printed, the plan and its legend."""

Draw = Callable[..., str]
"""Given the function that draws a picture and its arguments, returns the SVG or a name for it."""


def at_once(function: Draw, *about: Any, **how: Any) -> str:
    """Draw a picture where a page asks for it."""
    return function(*about, **how)


class Later:
    """Names pictures where pages ask for them: they are drawn while the pages are laid out."""

    def __init__(self) -> None:
        self.undrawn: dict[str, Callable[[], str]] = {}

    def __call__(self, function: Draw, *about: Any, **how: Any) -> str:
        """Return a name that stands for the SVG on the pages."""
        name = f"picture {len(self.undrawn) + 1}"
        self.undrawn[data_uri(name)] = partial(function, *about, **how)
        return name


def _in_parts(items: Sequence[Any], most: int) -> Iterator[Sequence[Any]]:
    for start in range(0, len(items), most):
        yield items[start : start + most]


def draw_assessment(package: PackageData, draw: Draw = at_once) -> Drawings:
    """Return the drawings that need no evidence."""
    from report.figures import accelerations, charts, plan
    from report.figures.section import array_section

    us_first, assessment = package.fmt.us_first, package.assessment
    printed = printed_plan(assessment)
    return {
        "inputs-friction": friction_tests.drawings(package, draw),
        "method-motion": [draw(array_section, package.governing.array, us_first)],
        "motions-list": [
            draw(accelerations.accelerations, some)
            for some in _in_parts(assessment.shaking.motions, ACCELERATION_ROWS)
        ],
        "plan": [printed, *(draw(plan.paper_svg, each) for each in (printed.plan, printed.key))],
        "comparison": [
            draw(charts.comparison, some, us_first)
            for some in _in_parts(assessment.alike, CHART_ROWS)
        ],
        "clearances": [
            draw(charts.clearances, some, us_first, start=1 + count * GAP_ROWS)
            for count, some in enumerate(_in_parts(assessment.clearances, GAP_ROWS))
        ],
    }


def _small_plan(package: PackageData, spectra: Sequence[Spectra], draw: Draw) -> Iterator[str]:
    """Yield the plan for the summary in the room that its tables leave; none on a full sheet."""
    from report.figures.plan import roof_plan

    tall = min(_summary_room_in(package, spectra), SMALL.tall)
    if tall >= LEAST_PLAN_IN:
        yield draw(roof_plan, package.assessment, replace(SMALL, tall=tall))


def _summary_room_in(package: PackageData, spectra: Sequence[Spectra]) -> float:
    """Return what the tables and sentences of the summary leave of its last sheet [in]."""
    # Estimated: the plan is drawn before the pages are laid out.
    assessment, found = package.assessment, limits.troubles(package)
    failed = sum(gap.verdict is Verdict.NG for gap in assessment.clearances)
    # Their conditions take two lines.
    edges = sum("without" in gap.neighbor.value for gap in assessment.clearances)
    rows = len(assessment.arrays) + len(assessment.clearances)
    answers = 0.7 + 0.45 * failed if failed else 0.0
    troubles = 0.3 + 0.33 * sum(map(len, found.values())) if found else 0.0
    missed = 0.5 * len(departures(spectra))
    room = 5.1 - 0.2 * rows - 0.15 * edges - answers - troubles - missed
    # Friction that depends on velocity adds a line to the row of an array.
    room -= 0.3 * sum(not item.array.friction.is_constant for item in assessment.arrays)
    return (room - _conditions_in(package)) % SHEET_IN


def _conditions_in(package: PackageData) -> float:
    """Return how tall the list of conditions is [in]."""
    heights = []
    for row in package.assessment.conditions:
        of_subject = f"array {row.subject}, " if row.subject else ""
        letters = sum(map(len, (of_subject, ": : ; required: . ", *row.said)))
        heights.append(0.16 * math.ceil(letters / 110))
    return 0.3 + sum(heights) if heights else 0.0


def draw_plotted(package: PackageData, shown: Evidence, draw: Draw = at_once) -> Drawings:
    """Return the drawings of spectra and of runs."""
    from report.figures.accuracy import work_precision
    from report.figures.spectra import spectra

    us_first, rivals = package.fmt.us_first, shown.accuracy.rivals
    roof = [part for part in shown.spectra if not part.is_ground]
    ground = [part for part in shown.spectra if part.is_ground]
    runs = zip(package.assessment.alike, shown.histories, strict=True)
    return {
        "summary": list(_small_plan(package, shown.spectra, draw)),
        "motions-spectra": [
            draw(spectra, parts) for parts in ((roof, ground) if ground else (roof,))
        ],
        "accuracy": [draw(work_precision, rivals)] if rivals.runs else [],
        **{
            f"results-{count}": list(_histories(group[0], followed, us_first, draw))
            for count, (group, followed) in enumerate(runs, start=1)
        },
    }


def draw_uncertainty(package: PackageData, found: Uncertainty, draw: Draw = at_once) -> Drawings:
    """Return the contours; none where nothing slides on the whole grid."""
    from report.figures.uncertainty import contours

    surface, arrays, us_first = found.surface, package.assessment.arrays, package.fmt.us_first
    slides = bool((surface.mean_m > 0.0).any())
    return {"how-sure": [draw(contours, surface, arrays, us_first)] if slides else []}


def _histories(
    array: ArrayAssessment, followed: Sequence[SlideHistory], us_first: bool, draw: Draw
) -> Iterator[tuple[str, str]]:
    from report.figures.history import histories
    from report.figures.hodograph import hodographs

    runs = zip(_in_parts(array.motions, PANELS), _in_parts(followed, PANELS), strict=True)
    for motions, paths in runs:
        about = (motions, paths, us_first)
        yield draw(histories, *about), draw(hodographs, *about)
