"""Output files of a verification: PDF, CSV and charts.

Read `report.manual.sections` next.
"""

from __future__ import annotations

import datetime as dt
from collections.abc import Callable, Mapping

from markupsafe import Markup

from report.document.templates import rendered
from report.figures.base import load_fonts
from report.manual.blocks import ManualSection, numbered
from report.manual.front import extent, passed, verdict_line
from report.manual.machine import Machine, this_machine
from report.manual.sections import sections
from report.manual.table import verification_csv
from report.typeset.pdf import TEMPLATES, lay_out
from report.words.validation import validation
from solver.verification.evidence import Verification


def files(
    verification: Verification, date: dt.date, on_stage: Callable[[str], None]
) -> Mapping[str, bytes]:
    """Return the manual, its table and its charts by file name.

    Raises
    ------
    DefectError
        Where the renderer complains.
    """
    machine = this_machine()
    load_fonts(TEMPLATES / "fonts")
    on_stage("Drawing the charts")
    parts = sections(verification, machine)
    on_stage("Laying out the manual")
    pdf = lay_out(manual_html(verification, parts, machine, date))
    charts = [chart for part in parts for block in part.blocks for chart in block.charts]
    return {
        "verification.pdf": pdf,
        "verification.csv": verification_csv(verification),
        **{f"charts/{chart.name}.svg": chart.picture.svg.encode() for chart in charts},
    }


def manual_html(
    verification: Verification, parts: tuple[ManualSection, ...], machine: Machine, date: dt.date
) -> str:
    """Return the manual as HTML, before layout."""
    styles = (TEMPLATES / name for name in ("package.css", "verification.css"))
    context: dict[str, object] = {
        "css": Markup("\n".join(path.read_text(encoding="utf-8") for path in styles)),
        "version": dict(machine.rows)["Roofslip"],
        "date": date.isoformat(),
        "kind": "quick" if verification.quick else "full",
        "extent": extent(verification),
        "verdict": verdict_line(verification),
        "validation": validation(verification.tables),
        "checks": passed(verification.checks),
        "machine": machine.line,
        "libraries": ", ".join(
            f"{name} {version}" for name, version in machine.rows[1:] if name in _ON_COVER
        ),
        "sections": list(zip(numbered(parts), parts, strict=True)),
        "pictures": {},
    }
    return rendered(TEMPLATES, "verification.html", context)


_ON_COVER = ("Python", "numpy", "numba")
