"""The pages of the package in order: title, and function that fills it.

To add a page, add it here with the function that fills it, and a template with its id. Parts refer
to each other by id (`PackageData.part`). Read `PAGES`.

The drawings by the id of their place; `report.figures` draws them, templates say their captions.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

from report.assessment.assessment import Assessment
from report.assessment.design.arrays import ArrayAssessment
from report.assessment.revision_changes import NO_FORMER, Changes
from report.assessment.support.evidence import Evidence
from report.document.templates import Part
from report.pages import (
    accuracy,
    basis,
    changes,
    comparison,
    echo,
    friction_tests,
    hashes,
    histories,
    inputs,
    limits,
    method,
    model,
    motions,
    notes,
    permit,
    plan,
    provisions,
    records,
    results,
    spectra,
    summary,
    symbols,
)
from report.pages.parts import PackageData
from report.project.model.choices import PackageEdition
from report.text.names import ranged
from solver.model import SlideHistory

Content = Mapping[str, Any]
Fill = Callable[[PackageData, Evidence], Content]
Below = tuple[tuple[str, str], ...]


@dataclass(frozen=True, slots=True)
class Page:
    """A part of the package."""

    id: str  # anchor, and name of the template and of the content in it
    title: str  # heading
    fill: Fill  # returns the content
    below: Callable[[PackageData], Below] = lambda _: ()  # returns ids and titles of parts below
    is_appendix: bool = False  # numbered by a letter
    edition: PackageEdition = PackageEdition.PLAN_CHECK  # complete: in the complete one alone


def _alone(fill: Callable[[PackageData], Content]) -> Fill:
    """Return what fills a page that needs no evidence."""
    return lambda package, _: fill(package)


def _complete(id: str, title: str, fill: Fill) -> Page:
    """Return an appendix of the complete edition."""
    return Page(id, title, fill, is_appendix=True, edition=PackageEdition.COMPLETE)


BELOW_INPUTS = (
    ("inputs-site", "Site and seismic parameters"),
    ("inputs-arrays", "Arrays"),
    ("inputs-friction", "Friction tests"),
)
PAGES = (
    Page("summary", "Summary", summary.page),
    Page("comparison", "Comparison with the prescriptive displacement", comparison.page),
    Page("basis", "Basis and limits of the method", _alone(basis.page)),
    Page("plan", "Roof plan and schedule of clearances", _alone(plan.page)),
    Page("model", "Model used", _alone(model.page)),
    Page("limits", "Limits and requirements", limits.page),
    Page("provisions", "Provisions and overrides", _alone(provisions.page)),
    Page("inputs", "Inputs", _alone(inputs.page), lambda _: BELOW_INPUTS),
    Page("motions", "Roof motions", motions.page, motions.below),
    Page("method", "Equations", _alone(method.page), method.below),
    Page("results", "Results", results.page, results.below),
    Page("accuracy", "Accuracy and sensitivity", accuracy.page),
    Page("records", "Records, software and references", _alone(records.page), is_appendix=True),
    Page("notes", "Notes for the construction documents", _alone(notes.page), is_appendix=True),
    _complete("echo", "Input echo", _alone(echo.page)),
    _complete("hashes", "Hashes of the records", _alone(hashes.page)),
    _complete("spectra", "Table of spectra", spectra.page),
    _complete("histories", "Histories and paths", histories.page),
    _complete("symbols", "Symbols", _alone(symbols.page)),
)

# Of the edition letter.
LETTER_PAGES = (
    Page("permit", "Displacements and separations", _alone(permit.letter)),
    Page("permit-plan", "Roof plan and conditions", _alone(permit.plan)),
)

# Pages that need runs: a package without motions does not have them.
OF_MOTIONS = frozenset(
    {"motions", "results", "comparison", "model", "accuracy", "hashes", "spectra", "histories"}
)

LETTER = Part(id="letter", number="", title="Results letter")  # before the first page

# After the summary, without a number: the other parts have the same in every revision.
CHANGES = Page("changes", "Changes", _alone(changes.page))


def pages_of(
    edition: PackageEdition, since: Changes, *, has_motions: bool = True
) -> tuple[Page, ...]:
    """Return the pages of a package: with the changes only where they are asked for."""
    if edition is PackageEdition.LETTER:
        return LETTER_PAGES
    left_out = frozenset() if has_motions else OF_MOTIONS
    editions = PackageEdition.PLAN_CHECK, edition
    pages = [page for page in PAGES if page.edition in editions and page.id not in left_out]
    if not has_motions:
        # The plan begins a sheet: the few words on the basis would have one to themselves.
        pages[1:3] = pages[2], pages[1]
    title = f"Changes since revision {since.revision}"
    changed = (replace(CHANGES, title=title),) if since.is_asked_for else ()
    return (*pages[:1], *changed, *pages[1:])


def pages_in(package: PackageData) -> tuple[Page, ...]:
    """Return the pages that a package has."""
    assessment = package.assessment
    return pages_of(package.edition, package.changes, has_motions=assessment.has_motions)


def package_data(
    assessment: Assessment,
    since: Changes = NO_FORMER,
    edition: PackageEdition | None = None,
) -> PackageData:
    """Return an assessment with the part numbers, and what changed since a former revision.

    Without an edition, that of the sheet Options.
    """
    edition = edition or assessment.project.options.package_edition
    numbers = _numbers(pages_of(edition, since, has_motions=assessment.has_motions))
    return PackageData(assessment=assessment, edition=edition, numbers=numbers, changes=since)


def _numbers(pages: Sequence[Page]) -> Mapping[str, str]:
    body = [page.id for page in pages if not page.is_appendix and page.id != CHANGES.id]
    appendices = [page.id for page in pages if page.is_appendix]
    numbers = {name: str(count) for count, name in enumerate(body, start=1)}
    letters = {name: chr(ord("A") + count) for count, name in enumerate(appendices)}
    return {CHANGES.id: ""} | numbers | letters


def parts(package: PackageData) -> tuple[Part, ...]:
    """Return the parts of the package in order, as the contents list them."""
    return tuple(
        Part(
            id=page.id,
            number=package.numbers[page.id],
            title=page.title,
            parts=tuple(
                Part(id=name, number=f"{package.numbers[page.id]}.{count}", title=title)
                for count, (name, title) in enumerate(page.below(package), start=1)
            ),
        )
        for page in pages_in(package)
    )


# Maximum in one figure: a picture cannot break, so it must fit on a page.
PANELS, CHART_ROWS, ACCELERATION_ROWS = 12, 16, 16
Drawings = Mapping[str, Sequence[Any]]
"""SVG by the id of its place; of an array, pairs of histories and paths; of the roof plan, the
plan and its legend."""


def _in_parts(items: Sequence[Any], most: int) -> Iterator[Sequence[Any]]:
    for start in range(0, len(items), most):
        yield items[start : start + most]


def draw_assessment(package: PackageData) -> Drawings:
    """Return the drawings that need no evidence."""
    # Here and below: what draws nothing loads no matplotlib.
    from report.figures.plan import array_section, paper_svg
    from report.figures.records import accelerations

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


def draw_plotted(package: PackageData, shown: Evidence) -> Drawings:
    """Return the drawings of spectra and of runs; none without motions."""
    from report.figures.charts import comparison as comparison_chart
    from report.figures.spectra import spectra as spectra_chart

    if not package.assessment.has_motions:
        return {}
    us_first = package.fmt.us_first
    roof = [part for part in shown.spectra if not part.is_ground]
    ground = [part for part in shown.spectra if part.is_ground]
    runs = list(zip(package.assessment.alike, shown.histories, strict=True))
    others_m = {case.array.id: case.array.design_m for case in shown.cases}
    drawings: dict[str, Sequence[Any]] = {
        "comparison": [
            comparison_chart(some, us_first, others_m)
            for some in _in_parts(package.assessment.alike, CHART_ROWS)
        ],
        "motions-spectra": [
            spectra_chart(parts) for parts in ((roof, ground) if ground else (roof,))
        ],
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
    from report.figures.history import RunPanel
    from report.figures.history import histories as draw_histories

    panels = [
        RunPanel(ranged([item.id for item in group]), motion, history)
        for group, followed in runs
        for motion, history in zip(group[0].motions, followed, strict=True)
        # One panel for each group: the run that its largest PRD is from.
        if motion is group[0].worst
    ]
    for some in _in_parts(panels, PANELS):
        yield draw_histories(some, us_first)


def _histories(
    array: ArrayAssessment, followed: Sequence[SlideHistory], us_first: bool
) -> Iterator[tuple[str, str]]:
    from report.figures.history import RunPanel, hodographs
    from report.figures.history import histories as draw_histories

    runs = zip(_in_parts(array.motions, PANELS), _in_parts(followed, PANELS), strict=True)
    for some, paths in runs:
        panels = [RunPanel("", *run) for run in zip(some, paths, strict=True)]
        paths_in_plan = hodographs(some, paths, us_first)
        yield draw_histories(panels, us_first), paths_in_plan
