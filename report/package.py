"""The calculation package: finished strings and pictures, placed by the templates, as a PDF.

Computes no physics and reads no code rule. The pages are made in `report.pages_*`; read
`report.pages_parts` first.
"""

from __future__ import annotations

import gc
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from typing import Any

from report import (
    pages_appendix,
    pages_checks,
    pages_front,
    pages_inputs,
    pages_method,
    pages_motions,
    pages_results,
)
from report.assess import Assessment
from report.pages_figures import begin, draw
from report.pages_parts import Part, Scene
from report.pdf import TEMPLATES, html_to_pdf, load_renderer
from report.spectra import Spectra, spectra
from report.workbook import InputBook

Stage = Callable[[str], None]


def render(book: InputBook, assessment: Assessment, on_stage: Stage | None = None) -> bytes:
    """Return the calculation package as a PDF.

    Parameters
    ----------
    book : InputBook
    assessment : Assessment
        Of this very book.
    on_stage : callable, optional
        Called with "figures", "pages" and "pdf" as each of them begins.

    Raises
    ------
    DefectError
        Where the renderer complains.
    """
    with _no_collections():
        return _render(book, assessment, on_stage or (lambda stage: None))


def _render(book: InputBook, assessment: Assessment, tell: Stage) -> bytes:
    scene = Scene(data=book.input, assessment=assessment)
    tell("figures")
    found = spectra(assessment, book.motions)
    pictures = begin(lambda: draw(scene, found))
    tell("pages")
    context = _context(book, scene, found)
    load_renderer()
    html = _html({**context, "pictures": pictures()})
    tell("pdf")
    return html_to_pdf(html)


@contextmanager
def _no_collections() -> Iterator[None]:
    """Look for no garbage: among a million live boxes the search takes a third of the time."""
    was_enabled = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if was_enabled:
            gc.enable()


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


def _context(book: InputBook, scene: Scene, found: Sequence[Spectra]) -> Mapping[str, Any]:
    governing = scene.governing
    return {
        "css": (TEMPLATES / "package.css").read_text(encoding="utf-8"),
        "sheet": pages_front.sheet(scene),
        "cover": pages_front.cover(scene),
        "parts": parts(scene.assessment),
        "summary": pages_front.summary(scene),
        "basis": pages_front.basis(scene),
        "inputs": pages_inputs.inputs(scene),
        "motions": pages_motions.page(scene, book.motions, found),
        "method": {
            "array": governing.array.id,
            "demand": pages_method.demand_lines(scene),
            "motion": pages_method.motion_lines(governing),
            "prescriptive": pages_method.prescriptive_line(scene, governing),
            "design": pages_method.design_lines(scene, governing),
            "separation": pages_method.separation_line(scene),
            "interconnection": pages_method.interconnection_line(scene, governing),
        },
        "results": [pages_results.array_results(scene, one) for one in scene.assessment.arrays],
        "comparison": pages_results.comparison(scene),
        "clearances": pages_checks.clearances(scene),
        "limits": pages_checks.limits(scene),
        "provisions": pages_checks.provisions(scene),
        "appendix": {
            "echo": pages_appendix.echo(book.echo),
            "records": pages_appendix.records(book.records),
            "software": pages_appendix.software(),
            "method": pages_appendix.METHOD,
            "workbook": book.path.name,
            "sha256": book.sha256,
        },
    }


def parts(assessment: Assessment) -> tuple[Part, ...]:
    """Return the parts of the package in order, as the contents list them."""
    titles: tuple[tuple[str, str, tuple[str, ...]], ...] = (
        ("summary", "Summary", ()),
        ("basis", "Basis and limits of the method", ()),
        ("inputs", "Inputs", ("Site and seismic parameters", "Arrays and objects", "Roof plan")),
        ("motions", "Roof motions", ("Motions", "Response spectra")),
        (
            "method",
            "Method and equations",
            ("Seismic demand", "Motion of an array", "Design displacement", "Separations"),
        ),
        ("results", "Results", tuple(f"Array {one.array.id}" for one in assessment.arrays)),
        ("comparison", "Comparison with the prescriptive displacement", ()),
        ("clearances", "Clearances", ()),
        ("limits", "Limits and interconnection strength", ()),
        ("provisions", "Provisions and overrides", ()),
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
