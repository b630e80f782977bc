"""The calculation package as HTML: formatted strings and pictures in templates.

Runs nothing. The pages are those of `report.pages.registry`; read it first.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from concurrent.futures import Executor, Future
from typing import Any

from report.assessment.changes import NO_FORMER, Changes
from report.assessment.evidence import Evidence
from report.assessment.project import Assessment
from report.beside import SameProcess
from report.pages import front
from report.pages.cover import cover
from report.pages.letter import letter
from report.pages.parts import Line
from report.pages.pictures import Pictures, draw_assessment, draw_evidence
from report.pages.registry import package_data, pages_of, parts
from report.typeset.equations import formulas
from report.typeset.pdf import TEMPLATES


def begin(assessment: Assessment, changes: Changes, second: Executor) -> Future[Pictures]:
    """Begin with the pictures that need no evidence, while it is computed."""
    return second.submit(draw_assessment, package_data(assessment, changes))


def pages(
    assessment: Assessment,
    evidence: Evidence,
    changes: Changes = NO_FORMER,
    begun: Future[Pictures] | None = None,
    second: Executor | None = None,
) -> str:
    """Return the calculation package as HTML, with what changed if a former one is named.

    Parameters
    ----------
    begun : Future, optional
        What `begin` returned.
    second : Executor, optional
        Where it was begun: the equations are typeset there too.
    """
    second = second or SameProcess()
    begun = begun or begin(assessment, changes, second)
    package = package_data(assessment, changes)
    listed = parts(package)
    content = {page.id: page.fill(package, evidence) for page in pages_of(package)}
    equations = second.submit(formulas, sorted({line.latex for line in _lines(content)}))
    drawn_here = draw_evidence(package, evidence)
    return _html(
        {
            "css": (TEMPLATES / "package.css").read_text(encoding="utf-8"),
            "sheet": front.sheet(package),
            "cover": cover(package),
            "letter": letter(package),
            "parts": listed,
            "below": {subpart.id: subpart for part in listed for subpart in part.parts},
            "templates": {page.id: page.template for page in pages_of(package)},
            "ref": package.part,
            "equations": equations.result(),
            "pictures": {**begun.result(), **drawn_here},
            "content": content,
            **content,
        }
    )


def _lines(content: Any) -> Iterator[Line]:
    """Yield the steps of the calculation, wherever they stand in the content of the pages."""
    if isinstance(content, Line):
        yield content
    elif isinstance(content, Mapping):
        yield from _lines(tuple(content.values()))
    elif isinstance(content, list | tuple):
        for item in content:
            yield from _lines(item)


def _html(context: Mapping[str, Any]) -> str:
    from jinja2 import Environment, FileSystemLoader, StrictUndefined

    environment = Environment(
        loader=FileSystemLoader(TEMPLATES),
        undefined=StrictUndefined,
        autoescape=True,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    return environment.get_template("package.html").render(context)
