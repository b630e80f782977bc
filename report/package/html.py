"""The calculation package as HTML: formatted strings and pictures in templates.

Runs nothing. The pages are those of `report.pages.registry`; read it first.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from report.assessment.changes import NO_FORMER, Changes
from report.assessment.evidence import Evidence
from report.assessment.project import Assessment
from report.pages import front
from report.pages.cover import cover
from report.pages.letter import letter
from report.pages.pictures import draw_assessment, draw_evidence
from report.pages.registry import package_data, pages_of, parts
from report.typeset.pdf import TEMPLATES


def pages(assessment: Assessment, evidence: Evidence, changes: Changes = NO_FORMER) -> str:
    """Return the calculation package as HTML, with what changed if a former one is named."""
    package = package_data(assessment, changes)
    listed = parts(package)
    content = {page.id: page.fill(package, evidence) for page in pages_of(package)}
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
            "pictures": {**draw_assessment(package), **draw_evidence(package, evidence)},
            "content": content,
            **content,
        }
    )


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
