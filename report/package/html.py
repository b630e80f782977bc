"""The calculation package as HTML: its pages and pictures in templates.

Runs nothing. The pages are those of `report.pages.registry`; read it first.
"""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Callable, Mapping, Sequence

from markupsafe import Markup

from report.assessment.changes import NO_FORMER, Changes
from report.assessment.evidence import Evidence, Plotted
from report.assessment.project import Assessment
from report.document.templates import rendered
from report.pages import method
from report.pages.cover import cover
from report.pages.front import letter
from report.pages.parts import PackageData
from report.pages.pictures import Drawings, draw_assessment, draw_plotted, draw_uncertainty
from report.pages.registry import LETTER, Content, package_data, pages_of, parts
from report.pages.symbols import with_symbols
from report.typeset.equations import Equations, formula
from report.typeset.pdf import TEMPLATES

_CONSTANT = re.compile(r"{% set latex %}((?:(?!{[{%]).)*){% endset %}")
"""An equation in a template, without anything to fill in."""


def typeset_ahead() -> None:
    """Typeset the equations that no project changes, so that `begin` need not."""
    for latex in _CONSTANT.findall((TEMPLATES / "method.html").read_text(encoding="utf-8")):
        formula(Markup(latex))  # as the template asks for it


def begin(assessment: Assessment, changes: Changes) -> tuple[Drawings, Equations]:
    """Draw what needs no evidence, and typeset the equations, which are all in one page."""
    package, equations = package_data(assessment, changes), Equations()
    _html(package, {"method": method.page(package)}, defaultdict(tuple), equations)
    return draw_assessment(package), equations


def plot(assessment: Assessment, changes: Changes, shown: Plotted) -> Drawings:
    """Draw most figures."""
    return draw_plotted(package_data(assessment, changes), shown)


def pages(
    assessment: Assessment,
    evidence: Evidence,
    changes: Changes = NO_FORMER,
    begun: tuple[Drawings, Equations] | None = None,
    plots: Drawings | None = None,
) -> str:
    """Return the calculation package as HTML, with what changed if a former one is named.

    Parameters
    ----------
    begun, plots : optional
        What `begin` and `plot` returned.
    """
    begun_drawings, equations = begun or begin(assessment, changes)
    package = package_data(assessment, changes)
    drawings = {
        **begun_drawings,
        **(plots or plot(assessment, changes, evidence)),
        **draw_uncertainty(package, evidence.uncertainty),
    }
    ids = (*_FRONT, *(page.id for page in pages_of(package.changes)))
    return _html(package, _content(package, evidence, ids), drawings, equations)


def part(package: PackageData, evidence: Evidence, id: str, drawings: Drawings) -> str:
    """Return one part of the package as HTML: `cover`, `contents`, `letter` or a page by its id."""
    return _html(package, _content(package, evidence, (id,)), drawings, Equations())


_FRONT: Mapping[str, Callable[[PackageData], Content]] = {
    "cover": cover,
    "contents": lambda _: {},
    "letter": letter,
}


def _content(package: PackageData, evidence: Evidence, ids: Sequence[str]) -> dict[str, Content]:
    pages = {page.id: page for page in pages_of(package.changes)}
    return {
        id: _FRONT[id](package) if id in _FRONT else pages[id].fill(package, evidence) for id in ids
    }


def _html(
    package: PackageData,
    content: Mapping[str, Content],
    drawings: Drawings,
    equations: Equations,
) -> str:
    listed = {part.id: part for part in (LETTER, *parts(package))}
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
