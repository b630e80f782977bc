"""The pages of the package in order: title, and function that fills it.

To add a page, add it here with the function that fills it, and a template with its id. Parts refer
to each other by id (`PackageData.part`). Read `PAGES`.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

from report.assessment.changes import NO_FORMER, Changes
from report.assessment.evidence import Evidence
from report.assessment.project import Assessment
from report.document.blocks import Part
from report.pages import (
    accuracy,
    appendix,
    changes,
    clearances,
    cumulative,
    front,
    inputs,
    limits,
    method,
    model,
    motions,
    provisions,
    results,
    symbols,
    uncertainty,
)
from report.pages.parts import PackageData

Content = Mapping[str, Any]
Below = tuple[tuple[str, str], ...]


def _nothing_below(_: PackageData) -> Below:
    return ()


@dataclass(frozen=True, slots=True, kw_only=True)
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
    """

    id: str
    title: str
    fill: Callable[[PackageData, Evidence], Content]
    below: Callable[[PackageData], Below] = _nothing_below
    is_appendix: bool = False


PAGES = (
    Page(
        id="summary",
        title="Summary",
        fill=lambda package, evidence: front.summary(package, evidence.remedies, evidence.spectra),
    ),
    Page(
        id="plan",
        title="Roof plan",
        fill=lambda package, _: front.plan(package),
    ),
    Page(
        id="basis",
        title="Basis and limits of the method",
        fill=lambda package, evidence: front.basis(package, evidence.uncertainty),
    ),
    Page(
        id="inputs",
        title="Inputs",
        fill=lambda package, _: inputs.inputs(package),
        below=inputs.below,
    ),
    Page(
        id="motions",
        title="Roof motions",
        fill=motions.page,
        below=motions.below,
    ),
    Page(
        id="method",
        title="Method and equations",
        fill=lambda package, _: method.page(package),
        below=method.below,
    ),
    Page(
        id="results",
        title="Results",
        fill=results.page,
        below=results.below,
    ),
    Page(
        id="comparison",
        title="Comparison with the prescriptive displacement",
        fill=lambda package, _: results.comparison(package),
    ),
    Page(
        id="clearances",
        title="Clearances",
        fill=lambda package, evidence: clearances.clearances(package, evidence.remedies),
    ),
    Page(
        id="limits",
        title="Limits and interconnection strength",
        fill=lambda package, _: limits.limits(package),
    ),
    Page(
        id="provisions",
        title="Provisions and overrides",
        fill=lambda package, _: provisions.provisions(package),
    ),
    Page(
        id="model",
        title="Model used",
        fill=lambda package, _: model.page(package),
    ),
    Page(
        id="accuracy",
        title="Accuracy and sensitivity",
        fill=lambda package, evidence: accuracy.page(package, evidence.accuracy),
    ),
    Page(
        id="how-sure",
        title="How sure",
        fill=lambda package, evidence: (
            uncertainty.page(package, evidence.uncertainty)
            | cumulative.page(package, evidence.cumulative)
        ),
    ),
    Page(
        id="echo",
        title="Input echo",
        fill=lambda package, _: appendix.echo_page(package),
        is_appendix=True,
    ),
    Page(
        id="records",
        title="Records and software",
        fill=lambda package, _: appendix.records_page(package),
        is_appendix=True,
    ),
    Page(
        id="symbols",
        title="Symbols and references",
        fill=lambda package, _: symbols.page(package),
        is_appendix=True,
    ),
)


CHANGES = Page(
    id="changes",
    title="Changes",
    fill=lambda package, _: changes.page(package),
    is_appendix=True,
)
"""The last appendix, so that the other parts have the same numbers in every revision."""


def pages_of(package: PackageData) -> tuple[Page, ...]:
    """Return the pages of a package: with the changes only where they are asked for."""
    return _pages(package.changes)


def _pages(since: Changes) -> tuple[Page, ...]:
    return (*PAGES, replace(CHANGES, title=changes.title(since))) if since.is_asked_for else PAGES


def package_data(assessment: Assessment, since: Changes = NO_FORMER) -> PackageData:
    """Return an assessment with the part numbers, and what changed since a former revision."""
    return PackageData(assessment=assessment, numbers=_numbers(_pages(since)), changes=since)


def _numbers(pages: Sequence[Page]) -> Mapping[str, str]:
    body = [page.id for page in pages if not page.is_appendix]
    appendices = [page.id for page in pages if page.is_appendix]
    return {name: str(count) for count, name in enumerate(body, start=1)} | {
        name: chr(ord("A") + count) for count, name in enumerate(appendices)
    }


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
        for page in pages_of(package)
    )
