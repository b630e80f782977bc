"""The calculation package as HTML: its pages and pictures in templates.

Runs nothing. The pages are those of `report.pages.registry`; read it first.
"""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Callable, Mapping, Sequence

from markupsafe import Markup

from report.assessment.changes import NO_FORMER, Changes
from report.assessment.evidence import Evidence
from report.assessment.project import Assessment
from report.document.templates import rendered
from report.pages import method
from report.pages.cover import cover
from report.pages.front import letter
from report.pages.parts import PackageData
from report.pages.pictures import (
    Draw,
    Drawings,
    at_once,
    draw_assessment,
    draw_plotted,
    draw_uncertainty,
)
from report.pages.registry import LETTER, Content, package_data, pages_of, parts
from report.pages.symbols import with_symbols
from report.typeset.equations import Equations, formula
from report.typeset.pdf import TEMPLATES

_CONSTANT = re.compile(r"{% set latex %}((?:(?!{[{%]).)*){% endset %}")
"""An equation in a template, without anything to fill in."""


def typeset_ahead() -> None:
    """Typeset the equations that no project changes, so that `equations` need not."""
    for latex in _CONSTANT.findall((TEMPLATES / "method.html").read_text(encoding="utf-8")):
        formula(Markup(latex))  # as the template asks for it


def equations(assessment: Assessment, changes: Changes) -> Equations:
    """Typeset the equations, which are all in one page that needs no evidence."""
    package, found = package_data(assessment, changes), Equations()
    _html(package, {"method": method.page(package)}, defaultdict(tuple), found)
    return found


def pages(
    assessment: Assessment,
    evidence: Evidence,
    changes: Changes = NO_FORMER,
    typeset: Equations | None = None,
    draw: Draw = at_once,
) -> str:
    """Return the calculation package as HTML, with what changed if a former one is named.

    Parameters
    ----------
    typeset : optional
        What `equations` returned.
    draw : optional
        Draws each picture, or names it.
    """
    package = package_data(assessment, changes)
    drawings = {
        **draw_assessment(package, draw),
        **draw_plotted(package, evidence, draw),
        **draw_uncertainty(package, evidence.uncertainty, draw),
    }
    ids = (*_FRONT, *(page.id for page in pages_of(package.changes)))
    return _html(package, _content(package, evidence, ids), drawings, typeset or Equations())


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
