"""The calculation package as HTML: its pages and pictures in templates.

Runs nothing. The pages are those of `report.pages.registry`; read it first.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import Executor, Future
from dataclasses import dataclass, replace

from report.assessment.changes import NO_FORMER, Changes
from report.assessment.evidence import Evidence, Plotted
from report.assessment.project import Assessment
from report.document.templates import rendered
from report.pages import method
from report.pages.cover import cover
from report.pages.front import letter
from report.pages.parts import PackageData
from report.pages.pictures import Drawings, draw_assessment, draw_plotted, draw_uncertainty
from report.pages.registry import Content, package_data, pages_of, parts
from report.pages.symbols import with_symbols
from report.typeset.equations import Equations
from report.typeset.pdf import TEMPLATES
from report.workers import SameProcess


@dataclass(frozen=True, slots=True, kw_only=True)
class PendingPictures:
    """What is drawn and typeset beside the computation.

    Attributes
    ----------
    package : PackageData
        What the worker is given; nothing else may use it, because it caches what it is asked for.
    """

    package: PackageData
    worker: Executor
    pictures: tuple[Future[Drawings], ...]
    equations: Future[Equations]

    def plot(self, shown: Plotted) -> PendingPictures:
        """Begin with most figures."""
        drawn = self.worker.submit(draw_plotted, self.package, shown)
        return replace(self, pictures=(*self.pictures, drawn))


def begin(assessment: Assessment, changes: Changes, worker: Executor) -> PendingPictures:
    """Begin with what needs no evidence, while it is computed."""
    package = package_data(assessment, changes)
    return PendingPictures(
        package=package,
        worker=worker,
        pictures=(worker.submit(draw_assessment, package),),
        equations=worker.submit(_typeset, package),
    )


def _typeset(package: PackageData) -> Equations:
    """Return the equations of the method, which are found by printing its page."""
    equations = Equations()
    _html(package, {"method": method.page(package)}, defaultdict(tuple), equations)
    return equations


def pages(
    assessment: Assessment,
    evidence: Evidence,
    changes: Changes = NO_FORMER,
    pending: PendingPictures | None = None,
) -> str:
    """Return the calculation package as HTML, with what changed if a former one is named.

    Parameters
    ----------
    pending : PendingPictures, optional
        What `begin` returned, and then its `plot`.
    """
    pending = pending or begin(assessment, changes, SameProcess()).plot(evidence)
    drawn = (
        *pending.pictures,
        pending.worker.submit(draw_uncertainty, pending.package, evidence.uncertainty),
    )
    package = package_data(assessment, changes)
    ids = (*_FRONT, *(page.id for page in pages_of(package)))
    content = _content(package, evidence, ids)
    drawings = {id: some for done in drawn for id, some in done.result().items()}
    return _html(package, content, drawings, pending.equations.result())


def part(package: PackageData, evidence: Evidence, id: str, drawings: Drawings) -> str:
    """Return one part of the package as HTML: `cover`, `contents`, `letter` or a page by its id."""
    return _html(package, _content(package, evidence, (id,)), drawings, Equations())


_FRONT: Mapping[str, Callable[[PackageData], Content]] = {
    "cover": cover,
    "contents": lambda _: {},
    "letter": letter,
}


def _content(package: PackageData, evidence: Evidence, ids: Sequence[str]) -> dict[str, Content]:
    pages = {page.id: page for page in pages_of(package)}
    return {
        id: _FRONT[id](package) if id in _FRONT else pages[id].fill(package, evidence) for id in ids
    }


def _html(
    package: PackageData,
    content: Mapping[str, Content],
    drawings: Drawings,
    equations: Equations,
) -> str:
    listed = {part.id: part for part in parts(package)}
    context = {
        "p": package,
        "with_symbols": with_symbols,
        "css": (TEMPLATES / "package.css").read_text(encoding="utf-8"),
        "parts": tuple(listed.values()),
        "below": {subpart.id: subpart for part in listed.values() for subpart in part.parts},
        "shown": [(f"{id}.html", listed.get(id)) for id in content],
        "ref": package.part,
        "equations": equations,
        "drawings": drawings,
        "content": content,
    }
    return rendered(TEMPLATES, "package.html", {**context, **content})
