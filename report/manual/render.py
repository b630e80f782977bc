"""Output files of a verification: PDF, CSV and charts.

Read `report.manual.sections` next.
"""

from __future__ import annotations

import datetime as dt
from collections.abc import Callable, Mapping, Sequence
from typing import Any

from markupsafe import Markup

import solver.building.roof
from report.document.sections import Section, filled
from report.document.templates import rendered
from report.figures.base import load_fonts
from report.manual.machine import this_machine
from report.manual.sections import sections
from report.manual.summary import judged
from report.manual.table import verification_csv
from report.pages.symbols import with_symbols
from report.typeset.pdf import TEMPLATES, lay_out
from report.words.validation import validation
from solver.verification import model_evidence, model_study, shake_table, static_study
from solver.verification.evidence import Verification

_CONSTANTS = {
    "building_rules": solver.building.roof,
    "model_evidence": model_evidence,
    "model_study": model_study,
    "shake_table": shake_table,
    "static_study": static_study,
}
"""Modules whose constants the templates print."""


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
    charts = {name: svg for part in parts for name, svg in part.charts.items()}
    return {
        "verification.pdf": pdf,
        "verification.csv": verification_csv(verification),
        **{f"charts/{name}.svg": svg.encode() for name, svg in charts.items()},
    }


def manual_html(
    verification: Verification, parts: Sequence[Section], machine: Mapping[str, str], date: dt.date
) -> str:
    """Return the manual as HTML, before layout."""
    styles = (TEMPLATES / name for name in ("package.css", "verification.css"))
    context: dict[str, Any] = _CONSTANTS | {
        "v": verification,
        "with_symbols": with_symbols,
        "verdict": judged(verification.passed and len(verification.checks) > 0),
        "n_passed": sum(row.passed for row in verification.checks),
        "validation": validation(verification.tables),
        "version": machine["Roofslip"],
    }
    cover = {
        "css": Markup("\n".join(path.read_text(encoding="utf-8") for path in styles)),
        "date": date.isoformat(),
        "machine": machine,
        "sections": list(filled(TEMPLATES, parts, context)),
    }
    return rendered(TEMPLATES, "verification.html", context | cover)
