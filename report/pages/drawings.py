"""The drawings of a package by the id of their place.

`report.figures` draws them, templates say their captions.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from report.assessment.design.arrays import ArrayAssessment
from report.assessment.support.evidence import Evidence
from report.pages import friction_tests
from report.pages.parts import PackageData
from report.text.names import ranged
from solver.model import SlideHistory

# Maximum in one figure: a picture cannot break, so it must fit on a page.
PANELS, CHART_ROWS, ACCELERATION_ROWS = 12, 16, 16
Drawings = Mapping[str, Sequence[Any]]
"""SVG by the id of its place; of an array, pairs of histories and paths; of the roof plan, the
plan and its legend."""


def _in_parts(items: Sequence[Any], maximum: int) -> Iterator[Sequence[Any]]:
    for start in range(0, len(items), maximum):
        yield items[start : start + maximum]


def draw_assessment(package: PackageData) -> Drawings:
    """Return the drawings that need no evidence."""
    # Here and below: what draws nothing loads no matplotlib.
    from report.figures.plan_figure import array_section, paper_svg
    from report.figures.record_charts import accelerations

    us_first, assessment = package.fmt.us_first, package.assessment
    printed = package.printed_plan
    drawings = {
        "inputs-friction": friction_tests.drawings(package),
        "plan": [paper_svg(printed.plan), paper_svg(printed.key)],
    }
    if not assessment.has_motions:
        return drawings
    return drawings | {
        "method-motion": [array_section(package.assessment.governing.array, us_first)],
        "motions-list": [
            accelerations(some) for some in _in_parts(assessment.shaking.motions, ACCELERATION_ROWS)
        ],
    }


def draw_plotted(package: PackageData, evidence: Evidence) -> Drawings:
    """Return the drawings of spectra and of runs; none without motions."""
    from report.figures.charts import comparison
    from report.figures.spectrum_charts import spectra

    if not package.assessment.has_motions:
        return {}
    us_first = package.fmt.us_first
    roof = [part for part in evidence.spectra if not part.is_ground]
    ground = [part for part in evidence.spectra if part.is_ground]
    runs = list(zip(package.assessment.alike, evidence.histories, strict=True))
    others_m = {case.array.id: case.array.design_m for case in evidence.cases}
    drawings: dict[str, Sequence[Any]] = {
        "comparison": [
            comparison(some, us_first, others_m)
            for some in _in_parts(package.assessment.alike, CHART_ROWS)
        ],
        "motions-spectra": [spectra(parts) for parts in ((roof, ground) if ground else (roof,))],
        "results": list(_governing(runs, us_first)),
    }
    # Only the complete edition has this part: the other draws the governing runs alone.
    if "histories" in package.numbers:
        drawings["histories"] = [
            list(_histories(group[0], followed, us_first)) for group, followed in runs
        ]
    return drawings


def _governing(
    runs: Sequence[tuple[Sequence[ArrayAssessment], Sequence[SlideHistory]]],
    us_first: bool,
) -> Iterator[str]:
    """Yield the histories of the governing runs, a panel for each group of arrays."""
    from report.figures.history_charts import RunPanel, histories

    panels = []
    for group, followed in runs:
        name = ranged([item.id for item in group])
        for motion, history in zip(group[0].motions, followed, strict=True):
            # One panel for each group: the run that its largest PRD is from.
            if motion is group[0].worst:
                panels.append(RunPanel(name, motion, history))
    for some in _in_parts(panels, PANELS):
        yield histories(some, us_first)


def _histories(
    array: ArrayAssessment, followed: Sequence[SlideHistory], us_first: bool
) -> Iterator[tuple[str, str]]:
    from report.figures.history_charts import RunPanel, histories, hodographs

    runs = zip(_in_parts(array.motions, PANELS), _in_parts(followed, PANELS), strict=True)
    for some, paths in runs:
        panels = [RunPanel("", *run) for run in zip(some, paths, strict=True)]
        paths_in_plan = hodographs(some, paths, us_first)
        yield histories(panels, us_first), paths_in_plan
