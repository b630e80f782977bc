"""The drawings of the package, by the id of their place; its template says their captions.

`report.figures` draws them.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from report.assessment.arrays import ArrayAssessment
from report.assessment.evidence import Evidence
from report.drawing.on_paper import printed_plan
from report.pages import friction_tests
from report.pages.parts import PackageData
from report.text.counts import Names, ranged
from solver.model import SlideHistory

PANELS, CHART_ROWS, ACCELERATION_ROWS = 12, 16, 16  # maximum in one figure: it must fit on a page
Drawings = Mapping[str, Sequence[Any]]
"""SVG by the id of its place; of an array, pairs of histories and paths; of the roof plan, what
is printed, the plan and its legend."""


def _in_parts(items: Sequence[Any], most: int) -> Iterator[Sequence[Any]]:
    for start in range(0, len(items), most):
        yield items[start : start + most]


def draw_assessment(package: PackageData) -> Drawings:
    """Return the drawings that need no evidence."""
    from report.figures import plan, records
    from report.figures.plan import array_section

    us_first, assessment = package.fmt.us_first, package.assessment
    names = package.data.names
    printed = printed_plan(assessment)
    drawings = {
        "inputs-friction": friction_tests.drawings(package),
        "plan": [printed, *(plan.paper_svg(each) for each in (printed.plan, printed.key))],
    }
    if not assessment.has_motions:
        return drawings
    return drawings | {
        "method-motion": [array_section(package.governing.array, us_first)],
        "motions-list": [
            records.accelerations(some, names)
            for some in _in_parts(assessment.shaking.motions, ACCELERATION_ROWS)
        ],
    }


def draw_plotted(package: PackageData, shown: Evidence) -> Drawings:
    """Return the drawings of spectra and of runs; none without motions."""
    from report.figures.charts import comparison
    from report.figures.spectra import spectra

    if not package.assessment.has_motions:
        return {}
    us_first, names = package.fmt.us_first, package.data.names
    roof = [part for part in shown.spectra if not part.is_ground]
    ground = [part for part in shown.spectra if part.is_ground]
    runs = list(zip(package.assessment.alike, shown.histories, strict=True))
    others_m = {case.array.id: case.array.design_m for case in shown.cases}
    drawings: dict[str, Sequence[Any]] = {
        "comparison": [
            comparison(some, us_first, others_m, names)
            for some in _in_parts(package.assessment.alike, CHART_ROWS)
        ],
        "motions-spectra": [spectra(parts) for parts in ((roof, ground) if ground else (roof,))],
        "results": list(_governing(runs, us_first, names)),
    }
    if "histories" in package.numbers:
        drawings["histories"] = [
            list(_histories(group[0], followed, us_first, names)) for group, followed in runs
        ]
    return drawings


def _governing(
    runs: Sequence[tuple[Sequence[ArrayAssessment], Sequence[SlideHistory]]],
    us_first: bool,
    names: Names,
) -> Iterator[str]:
    """Yield the histories of the governing runs, a panel for each group of arrays."""
    from report.figures.history import RunPanel, histories

    panels = [
        RunPanel(ranged([item.id for item in group]), motion, history)
        for group, followed in runs
        for motion, history in zip(group[0].motions, followed, strict=True)
        if motion is group[0].worst
    ]
    for some in _in_parts(panels, PANELS):
        yield histories(some, us_first, names)


def _histories(
    array: ArrayAssessment, followed: Sequence[SlideHistory], us_first: bool, names: Names
) -> Iterator[tuple[str, str]]:
    from report.figures.history import RunPanel, histories, hodographs

    runs = zip(_in_parts(array.motions, PANELS), _in_parts(followed, PANELS), strict=True)
    for motions, paths in runs:
        panels = [RunPanel("", *run) for run in zip(motions, paths, strict=True)]
        paths_in_plan = hodographs(motions, paths, us_first, names)
        yield histories(panels, us_first, names), paths_in_plan
