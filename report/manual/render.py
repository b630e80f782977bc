"""Output files of a verification: PDF, CSV and charts.

Read `sections` and `report.manual.summary` next.
"""

from __future__ import annotations

import datetime as dt
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import pandas as pd
from markupsafe import Markup

import solver.building.roof
from report.document.sections import Section, filled, section
from report.document.templates import rendered
from report.manual.building import building
from report.manual.machine import this_machine
from report.manual.models import models
from report.manual.precision import work
from report.manual.robustness import conditioning, stability
from report.manual.shake_table import shake_table
from report.manual.studies import convergence, curves, links
from report.manual.summary import judged, summary
from report.manual.tables import checks, peers
from report.pages.symbols import with_symbols
from report.typeset.pdf import TEMPLATES, lay_out
from report.words.formats import csv_text
from report.words.validation import validation
from solver.rivals.methods import METHODS
from solver.verification import model_evidence, model_study, static_study
from solver.verification import shake_table as accepted
from solver.verification.evidence import Verification
from solver.verification.features import statuses

_CONSTANTS = {
    "building_rules": solver.building.roof,
    "model_evidence": model_evidence,
    "model_study": model_study,
    "shake_table": accepted,
    "static_study": static_study,
}
"""Modules whose constants the templates print."""

_CHECK = (
    "id", "section", "problem", "source", "quantity", "unit", "expected", "computed", "error",
    "tolerance",
)  # fmt: skip
_OF_TWO_AXES = ["method", "parameters", "case", "time per run [s]", "PRD error [%]"]
"""Columns of the table: of a check, and of a run in two axes."""


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
    on_stage("Drawing the charts")
    parts = sections(verification)
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
        "judged": judged,
        "with_symbols": with_symbols,
        "verdict": judged(verification.passed and len(verification.checks) > 0),
        "n_passed": sum(row.passed for row in verification.checks),
        "features": statuses(verification.checks, verification.tables),
        "validation": validation(verification.tables),
        "machine": machine,
        "version": machine["Roofslip"],
    }
    cover = {
        "css": Markup("\n".join(path.read_text(encoding="utf-8") for path in styles)),
        "date": date.isoformat(),
        "sections": list(filled(TEMPLATES, parts, context)),
    }
    return rendered(TEMPLATES, "verification.html", context | cover)


def sections(verification: Verification) -> tuple[Section, ...]:
    """Return all sections except cover and contents."""
    return (
        summary(verification),
        section("manual/scope", "Scope and terms"),
        checks(verification),
        section("manual/methods", "Methods compared", methods=tuple(METHODS.values())),
        work(verification),
        stability(verification),
        convergence(verification),
        links(verification),
        curves(verification),
        conditioning(verification),
        building(verification),
        *((models(verification),) if verification.models else ()),
        shake_table(verification),
        section("manual/features", "Status of each feature"),
        section("manual/known-errors", "Known errors of released versions"),
        *((peers(verification.peers),) if verification.peers else ()),
        section("manual/software", "Software and machine"),
    )


def verification_csv(verification: Verification) -> bytes:
    """Return one table: checks, runs, runs in two axes; a cell that does not apply is empty."""
    rows = [{name: getattr(row, name) for name in _CHECK} for row in verification.checks]
    passed = ["yes" if row.passed else "no" for row in verification.checks]
    found = pd.DataFrame(rows).assign(passed=passed)
    found = found.rename(columns={name: f"{name} [-]" for name in ("error", "tolerance")})
    parts = [("check", found), ("run", verification.work.drop(columns="setting"))]
    parts += [("run in two axes", evidence.work[_OF_TWO_AXES]) for evidence in verification.models]
    kinds, frames = zip(*parts, strict=True)
    table = pd.concat(frames, keys=kinds, names=["kind", None]).reset_index("kind")
    cells = table.astype(object).where(table.notna(), None)
    return csv_text([table.columns, *cells.itertuples(index=False)]).encode()
