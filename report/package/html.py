"""The calculation package as HTML: formatted strings and pictures in templates.

Runs nothing. The pages are those of `report.pages.registry`; read it first.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from report.assessment.evidence import Evidence
from report.assessment.project import Assessment
from report.pages import front
from report.pages.cover import cover
from report.pages.letter import letter
from report.pages.pictures import draw_assessment, draw_evidence
from report.pages.registry import PAGES, package_data, parts
from report.typeset.pdf import TEMPLATES


def pages(assessment: Assessment, evidence: Evidence) -> str:
    """Return the calculation package as HTML."""
    package = package_data(assessment)
    listed = parts(package)
    content = {page.id: page.fill(package, evidence) for page in PAGES}
    return _html(
        {
            "css": (TEMPLATES / "package.css").read_text(encoding="utf-8"),
            "sheet": front.sheet(package),
            "cover": cover(package),
            "letter": letter(package),
            "parts": listed,
            "below": {subpart.id: subpart for part in listed for subpart in part.parts},
            "templates": {page.id: page.template for page in PAGES},
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
