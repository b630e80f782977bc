"""The files of a verification: the manual as PDF, its table as CSV, its charts. Read `files`."""

from __future__ import annotations

import datetime as dt
import os
import platform
from collections.abc import Callable, Mapping, Sequence

import pandas as pd
from markupsafe import Markup

from report.document.columns import words
from report.document.sections import Section, filled, section
from report.document.tables import grouped, headed
from report.document.templates import rendered
from report.manual.check_sections import checks, features, outcome, passed, summary
from report.manual.measured_buildings import building, models
from report.manual.paper_sections import convergence, curves, links
from report.manual.precision import methods, work
from report.manual.stability_sections import conditioning, stability
from report.pages.symbols import with_symbols
from report.provenance.known_errors import known_errors
from report.provenance.package_sources import installed, processor
from report.provenance.release import version
from report.text.counts import numbered
from report.text.csv_text import csv_text
from report.text.grouping import grouped_by
from report.text.names import joined
from report.text.units import NO_BREAK
from report.text.validation import NOT_VALIDATED
from report.typeset.pdf import TEMPLATES, lay_out
from solver.verification.evidence import Verification
from solver.verification.workprecision import RUN, SINGLE, TIME

_LIBRARIES = ("numpy", "numba", "llvmlite", "scipy", "pandas", "matplotlib", "jinja2", "weasyprint")


def this_machine() -> dict[str, str]:
    """Return labels with versions or descriptions."""
    # Without names of persons, hosts or paths: the manual is handed on.
    return {
        "Roofslip": version(),
        "Python": platform.python_version(),
        **{name: installed(name) for name in _LIBRARIES},
        "Processor": processor(),
        "Cores": str(os.cpu_count() or 1),
        "System": f"{platform.system()} {platform.release()}, {platform.machine()}",
    }


# Columns of the table: of a check, and of a run in two axes.
_CHECK = (
    "id", "section", "problem", "source", "quantity", "unit", "expected", "computed", "error",
    "tolerance",
)  # fmt: skip
_OF_TWO_AXES = ["method", "parameters", *RUN, TIME, SINGLE, "residual error [%]"]


def files(
    verification: Verification, date: dt.date, on_stage: Callable[[str], None]
) -> Mapping[str, bytes]:
    """Return the manual, its table and its charts by file name."""
    machine = this_machine()
    on_stage("Drawing the charts")
    parts = sections(verification)
    on_stage("Laying out the manual")
    pdf = lay_out(manual_html(verification, parts, machine, date))
    charts: dict[str, str] = {}
    for part in parts:
        charts |= part.charts
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
    versions = headed(("Item", 1), ("Version or description", 3), rows=machine.items())
    context = {"with_symbols": with_symbols, "versions": versions}
    pages = list(filled(TEMPLATES, parts, context))
    n_passed, extent = passed(verification), "quick" if verification.quick else "full"
    n_motions = sum(len(evidence.study.motions) for evidence in verification.models)
    records = numbered(len(verification.records), "record")
    buildings = numbered(len(verification.roofs) - 1, "recorded building")
    ran = f"{records} of one component, {numbered(n_motions, 'motion')} of three and {buildings}"
    libraries = ", ".join(f"{name} {machine[name]}" for name in ("Python", "numpy", "numba"))
    cover = {
        "css": Markup("\n".join(path.read_text(encoding="utf-8") for path in styles)),
        "title": f"Roofslip {machine['Roofslip']}: verification manual",
        "version": machine["Roofslip"],
        "date": date.isoformat(),
        "extent": extent,
        "passed": n_passed,
        "outcome": outcome(verification),
        "about": (
            ("Program", f"Roofslip, version {machine['Roofslip']}"),
            ("Date of the run", date.isoformat()),
            ("Extent", f"{extent}: {ran}"),
            ("Validation", NOT_VALIDATED),
            ("Libraries", libraries),
            ("Machine", f"{machine['Processor']}, {machine['Cores']} cores, {machine['System']}"),
        ),
        "contents": [part for part, _ in pages],
        "sections": pages,
    }
    return rendered(TEMPLATES, "verification.html", cover)


def sections(verification: Verification) -> tuple[Section, ...]:
    """Return all sections except cover and contents."""
    # The first roof is the model building, in every run; further ones come with --records.
    has_records = len(verification.roofs) > 1 or any(
        evidence.study.n_recorded for evidence in verification.models
    )
    return (
        summary(verification),
        scope(verification),
        checks(verification),
        methods(verification),
        work(verification),
        stability(verification),
        convergence(verification),
        links(verification),
        curves(verification),
        conditioning(verification),
        building(verification),
        *((models(verification),) if verification.models else ()),
        features(verification),
        errors_by_version(),
        section(
            "manual/software",
            "Software and machine",
            quick=verification.quick,
            has_records=has_records,
        ),
    )


def scope(verification: Verification) -> Section:
    """Return what is verified, the terms and the records."""
    studies = []
    for study in (evidence.study for evidence in verification.models):
        n_made = len(study.motions) - study.n_recorded
        count, recorded = numbered(len(study.motions), "motion"), study.motions[n_made:]
        studies.append(
            (count, joined(study.motions[:n_made]), joined(recorded) if recorded else "")
        )
    return section(
        "manual/scope",
        "Scope and terms",
        n_records=numbered(len(verification.records), "record"),
        records=verification.records,
        studies=studies,
        buildings=[roof.title for roof in verification.roofs[1:]],
    )


_ERRORS = (
    (words("Error", 3.2), lambda error: error.error),
    (words("Effect", 2.5), lambda error: error.effect),
    (words("Corrective action", 2.7), lambda error: error.action),
)


def errors_by_version() -> Section:
    """Return the known errors, under the last version that has them."""
    by_version = grouped_by(known_errors(), lambda error: error.until).items()
    return section(
        "manual/known-errors",
        "Known errors of earlier versions",
        errors=grouped(
            {f"Through version {until}: {len(known)} errors": known for until, known in by_version},
            _ERRORS,
        ),
    )


def verification_csv(verification: Verification) -> bytes:
    """Return one table: checks, runs, runs in two axes; a cell that does not apply is empty."""
    rows = [{name: getattr(row, name) for name in _CHECK} for row in verification.checks]
    passed = ["yes" if row.passed else "no" for row in verification.checks]
    frame = pd.DataFrame(rows).assign(passed=passed)
    frame = frame.rename(columns={name: f"{name} [-]" for name in ("error", "tolerance")})
    # A setting is a number whose meaning differs by method; the column of parameters has it in
    # words.
    parts = [("check", frame), ("run", verification.work.drop(columns="setting"))]
    parts += [("run in two axes", evidence.work[_OF_TWO_AXES]) for evidence in verification.models]
    kinds, frames = zip(*parts, strict=True)
    table = pd.concat(frames, keys=kinds, names=["kind", None]).reset_index("kind")
    # None is an empty cell; NaN would be a word. Spaces are ordinary ones outside of pages.
    cells = table.astype(object).where(table.notna(), None).replace(NO_BREAK, " ", regex=True)
    return csv_text([table.columns, *cells.itertuples(index=False)]).encode()
