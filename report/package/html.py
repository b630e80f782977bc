"""The calculation package: finished strings and pictures, placed by the templates, as HTML.

Runs nothing. The pages are made in `report.pages`; read `report.pages.parts` first.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from report.assessment.evidence import Evidence
from report.assessment.project import Assessment
from report.pages import accuracy as accuracy_page
from report.pages import appendix, checks, demand, front, inputs, method, model, motions, results
from report.pages.parts import PackageData, Part
from report.pages.pictures import draw_assessment, draw_evidence
from report.typeset.pdf import TEMPLATES


def pages(assessment: Assessment, evidence: Evidence) -> str:
    """Return the calculation package as HTML: finished strings and pictures; runs nothing."""
    package = PackageData(assessment=assessment)
    pictures = {**draw_assessment(package), **draw_evidence(package, evidence)}
    return _html({**_words(package, evidence), "pictures": pictures})


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


def _words(package: PackageData, evidence: Evidence) -> Mapping[str, Any]:
    """Return what the templates place, all but the pictures."""
    governing, sheet = package.governing, package.assessment.sheet
    shaking = package.assessment.shaking
    return {
        "css": (TEMPLATES / "package.css").read_text(encoding="utf-8"),
        "sheet": front.sheet(package),
        "cover": front.cover(package),
        "parts": parts(package),
        "summary": front.summary(package),
        "basis": front.basis(package),
        "inputs": inputs.inputs(package),
        "motions": motions.page(
            package,
            shaking.motions,
            shaking.prepared,
            shaking.records,
            evidence.spectra,
            evidence.highpass,
        ),
        "method": {
            "array": governing.array.id,
            "demand": demand.demand_lines(package),
            "motion": method.motion_lines(governing),
            "prescriptive": method.prescriptive_line(package, governing),
            "design": method.design_lines(package, governing),
            "separation": method.separation_line(package),
            "interconnection": method.interconnection_line(package, governing),
        },
        "results": [results.array_results(package, one) for one in package.assessment.arrays],
        "comparison": results.comparison(package),
        "clearances": checks.clearances(package),
        "limits": checks.limits(package),
        "provisions": checks.provisions(package),
        "model": model.page(package),
        "accuracy": accuracy_page.page(package, evidence.accuracy),
        "appendix": {
            "echo": appendix.echo(sheet.echo),
            "records": appendix.records(shaking.records),
            "software": appendix.software(),
            "method": appendix.METHOD,
            "workbook": sheet.path.name,
            "sha256": sheet.sha256,
        },
    }


def parts(package: PackageData) -> tuple[Part, ...]:
    """Return the parts of the package in order, as the contents list them."""
    titles: tuple[tuple[str, str, tuple[str, ...]], ...] = (
        ("summary", "Summary", ()),
        ("basis", "Basis and limits of the method", ()),
        ("inputs", "Inputs", ("Site and seismic parameters", "Arrays and objects", "Roof plan")),
        ("motions", "Roof motions", motions.titles(package)),
        (
            "method",
            "Method and equations",
            ("Seismic demand", "Motion of an array", "Design displacement", "Separations"),
        ),
        ("results", "Results", tuple(f"Array {one.array.id}" for one in package.assessment.arrays)),
        ("comparison", "Comparison with the prescriptive displacement", ()),
        ("clearances", "Clearances", ()),
        ("limits", "Limits and interconnection strength", ()),
        ("provisions", "Provisions and overrides", ()),
        ("model", "Model used", ()),
        ("accuracy", "Accuracy and sensitivity", ()),
    )
    numbered = [
        Part(id=name, number=str(count), title=title, parts=_below(name, str(count), below))
        for count, (name, title, below) in enumerate(titles, start=1)
    ]
    appendices = [
        Part(id="echo", number="A", title="Input echo"),
        Part(id="records", number="B", title="Records and software"),
    ]
    return (*numbered, *appendices)


def _below(name: str, number: str, titles: Sequence[str]) -> tuple[Part, ...]:
    return tuple(
        Part(id=f"{name}-{count}", number=f"{number}.{count}", title=title)
        for count, title in enumerate(titles, start=1)
    )
