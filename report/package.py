"""The calculation package: finished strings and pictures, placed by the templates, as a PDF.

Computes no physics and reads no code rule. The pages are made in `report.pages`; read
`report.pages.parts` first.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

from report.accuracy import accuracy
from report.beyond import beyond_corners
from report.equations import formula
from report.findings import Findings
from report.garbage import no_collections
from report.pages import accuracy as accuracy_page
from report.pages import appendix, checks, demand, front, inputs, method, model, motions, results
from report.pages.parts import Part, Scene
from report.pages.pictures import draw_assessment, draw_findings, load_charts
from report.pdf import TEMPLATES, html_to_pdf, load_renderer
from report.sheet.workbook import InputBook

Stage = Callable[[str], None]
Words = Mapping[str, Any]


def load() -> None:
    """Load what draws and lays out, which takes its time: while something else is waited for."""
    load_charts()
    load_renderer()
    formula("N")  # loads the typesetter and its font


def render(
    scene: Scene, find: Callable[[], Findings], words: Callable[[], Words], tell: Stage
) -> bytes:
    """Return the calculation package as a PDF.

    Parameters
    ----------
    scene : Scene
    find, words : callable
        Give what `report.findings.find` and then `words` give, asked when they are needed.
    tell : callable
        Called with "figures", "pages" and "pdf" as each of them begins.

    Raises
    ------
    DefectError
        Where the renderer complains.
    """
    with no_collections():
        tell("figures")
        pictures = {**draw_assessment(scene), **draw_findings(scene, find())}
        tell("pages")
        html = _html({**words(), "pictures": pictures})
        tell("pdf")
        return html_to_pdf(html)


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


def words(book: InputBook, scene: Scene, found: Findings) -> Words:
    """Return what the templates place, all but the pictures; runs all motions twice more."""
    governing = scene.governing
    beyond = beyond_corners(book.input.motions, book.stories, governing)
    sureness = accuracy(book.input, book.motions, scene.assessment, found.rivals)
    return {
        "css": (TEMPLATES / "package.css").read_text(encoding="utf-8"),
        "sheet": front.sheet(scene),
        "cover": front.cover(scene),
        "parts": parts(scene),
        "summary": front.summary(scene),
        "basis": front.basis(scene),
        "inputs": inputs.inputs(scene),
        "motions": motions.page(
            scene, book.motions, book.stories, book.records, found.spectra, beyond
        ),
        "method": {
            "array": governing.array.id,
            "demand": demand.demand_lines(scene),
            "motion": method.motion_lines(governing),
            "prescriptive": method.prescriptive_line(scene, governing),
            "design": method.design_lines(scene, governing),
            "separation": method.separation_line(scene),
            "interconnection": method.interconnection_line(scene, governing),
        },
        "results": [results.array_results(scene, one) for one in scene.assessment.arrays],
        "comparison": results.comparison(scene),
        "clearances": checks.clearances(scene),
        "limits": checks.limits(scene),
        "provisions": checks.provisions(scene),
        "model": model.page(scene),
        "accuracy": accuracy_page.page(scene, sureness),
        "appendix": {
            "echo": appendix.echo(book.echo),
            "records": appendix.records(book.records),
            "software": appendix.software(),
            "method": appendix.METHOD,
            "workbook": book.path.name,
            "sha256": book.sha256,
        },
    }


def parts(scene: Scene) -> tuple[Part, ...]:
    """Return the parts of the package in order, as the contents list them."""
    titles: tuple[tuple[str, str, tuple[str, ...]], ...] = (
        ("summary", "Summary", ()),
        ("basis", "Basis and limits of the method", ()),
        ("inputs", "Inputs", ("Site and seismic parameters", "Arrays and objects", "Roof plan")),
        ("motions", "Roof motions", motions.titles(scene)),
        (
            "method",
            "Method and equations",
            ("Seismic demand", "Motion of an array", "Design displacement", "Separations"),
        ),
        ("results", "Results", tuple(f"Array {one.array.id}" for one in scene.assessment.arrays)),
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
