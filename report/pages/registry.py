"""The pages of the package in order: title, and function that fills it.

To add a page, add it here with the function that fills it, and a template with its id. Parts refer
to each other by id (`PackageData.part`). Read `PAGES`.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

from report.assessment.assessment import Assessment
from report.assessment.revision_changes import NO_FORMER, Changes
from report.assessment.support.evidence import Evidence
from report.document.sections import Part
from report.pages import (
    accuracy,
    basis,
    changes,
    comparison,
    echo,
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
    """Return the function that fills a page without evidence."""
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
    Page("permit", "Displacements and separations", _alone(permit.page)),
    Page("permit-plan", "Roof plan and schedule of clearances", _alone(plan.page)),
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
    """Return an assessment with the part numbers, and the changes since a previous revision.

    Without an edition, that of the Options worksheet.
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
