"""The pages of the package in order: title, and function that fills it.

To add a page, add it here with the function that fills it, and a template with its id. Parts refer
to each other by id (`PackageData.part`). Read `PAGES`.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

from report.assessment.evidence import Evidence
from report.assessment.project import NO_FORMER, Assessment, Changes
from report.document.templates import Part
from report.pages import (
    acceptance,
    accuracy,
    echo,
    front,
    inputs,
    limits,
    method,
    model,
    motions,
    results,
    symbols,
)
from report.pages.parts import PackageData
from report.sheet.schema.choices import PackageEdition

Content = Mapping[str, Any]
Fill = Callable[[PackageData, Evidence], Content]
Below = tuple[tuple[str, str], ...]


@dataclass(frozen=True, slots=True)
class Page:
    """A part of the package.

    Attributes
    ----------
    id, title : str
        Anchor and heading in the package; the id is also the name of the template and of the
        content in it.
    fill : callable
        Returns the content for the template.
    below : callable
        Returns the ids and titles of the parts below it.
    is_appendix : bool
        Whether it is an appendix, numbered by a letter.
    edition : PackageEdition
        Complete: in the complete edition alone.
    """

    id: str
    title: str
    fill: Fill
    below: Callable[[PackageData], Below] = lambda _: ()
    is_appendix: bool = False
    edition: PackageEdition = PackageEdition.PLAN_CHECK


def _alone(fill: Callable[[PackageData], Content]) -> Fill:
    """Return what fills a page that needs no evidence."""
    return lambda package, _: fill(package)


def _complete(id: str, title: str, fill: Fill) -> Page:
    """Return an appendix of the complete edition."""
    return Page(id, title, fill, is_appendix=True, edition=PackageEdition.COMPLETE)


PAGES = (
    Page("summary", "Summary", front.summary),
    Page("comparison", "Comparison with the prescriptive displacement", front.comparison),
    Page("plan", "Roof plan and schedule of clearances", _alone(limits.plan)),
    Page("basis", "Basis and limits of the method", _alone(front.basis)),
    Page("model", "Model used", _alone(model.page)),
    Page("limits", "Limits and requirements", _alone(limits.limits)),
    Page("provisions", "Provisions and overrides", _alone(limits.provisions)),
    Page("inputs", "Inputs", _alone(inputs.inputs), inputs.below),
    Page("motions", "Roof motions", motions.page, motions.below),
    Page("method", "Equations", _alone(method.page), method.below),
    Page("results", "Results", results.page, results.below),
    Page("accuracy", "Accuracy and sensitivity", accuracy.page),
    Page("records", "Records, software and references", _alone(acceptance.page), is_appendix=True),
    Page("notes", "Notes for the construction documents", lambda *_: {}, is_appendix=True),
    _complete("echo", "Input echo", _alone(echo.page)),
    _complete("hashes", "Hashes of the records", _alone(acceptance.hashes)),
    _complete("spectra", "Table of spectra", motions.spectra),
    _complete("histories", "Histories and paths", results.histories),
    _complete("symbols", "Symbols", _alone(symbols.page)),
)

OF_MOTIONS = frozenset(
    {"motions", "results", "comparison", "model", "accuracy", "hashes", "spectra", "histories"}
)
"""Pages that need runs: a package without motions does not have them."""

LETTER = Part(id="letter", number="", title="Letter of results", parts=())
"""Before the first page, without a number."""

CHANGES = Page("changes", "Changes", _alone(front.page))
"""After the summary, without a number: the other parts have the same in every revision."""


def pages_of(
    edition: PackageEdition, since: Changes, *, has_motions: bool = True
) -> tuple[Page, ...]:
    """Return the pages of a package: with the changes only where they are asked for."""
    left_out = frozenset() if has_motions else OF_MOTIONS
    editions = PackageEdition.PLAN_CHECK, edition
    pages = tuple(page for page in PAGES if page.edition in editions and page.id not in left_out)
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

    Parameters
    ----------
    edition : PackageEdition, optional
        By the sheet Options if not given.
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
