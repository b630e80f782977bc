"""A study run and published: the report, the tables and the exports. Read `make_study`."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from contextlib import ExitStack
from pathlib import Path
from typing import Any

from markupsafe import Markup

from report.document.sections import Section, filled, section
from report.document.templates import rendered
from report.pages.marks import UNVERIFIED
from report.pages.symbols import with_symbols
from report.project.read.years_file import SUPPORTING, YEARS
from report.results.publish import publish
from report.study.allowed_answers import allowed
from report.study.design_curves import curves
from report.study.exports import LIBRARY, export_files
from report.study.formula_section import formula
from report.study.fragility_section import fragility
from report.study.page_parts import basis, limits
from report.study.prescribed import compare, prescribed
from report.study.run_study import RUNS, run_study
from report.study.sentences import design, headline
from report.study.study_plan import StudyPlan
from report.study.study_results import StudyResults
from report.study.study_tables import curves_csv, study_xlsx
from report.study.years_section import sheets, years, years_json
from report.text.letter_case import capitalized
from report.typeset.pdf import TEMPLATES, lay_out
from solver.file_checks import check_plain
from solver.file_writing import add_folder, locked

TABLE = "study.xlsx"


def make_study(
    plan: StudyPlan, folder: Path, progress: Callable[[str], None], **options: Any
) -> tuple[StudyResults, Mapping[str, bytes]]:
    """Run a study and publish its files; another run to the same folder waits until it ends.

    Options are those of `report.study.run_study.run_study`.
    """
    runs = folder / RUNS
    check_plain(runs, folder, is_folder=True)
    with ExitStack() as undo:
        # Where nothing ran, as with no cluster, nothing new stays.
        add_folder(runs, undo)
        with locked(runs):
            results = run_study(plan, folder, progress=progress, **options)
            progress("writing the report")
            files = study_files(results)
            publish(files, folder)
            # Those of an earlier study would pass for results of this one.
            for name in (LIBRARY, YEARS):
                if name not in files:
                    (folder / name).unlink(missing_ok=True)
        undo.pop_all()
    return results, files


def study_files(results: StudyResults) -> Mapping[str, bytes]:
    """Return the report, the tables and the exports of a study by file name."""
    return {
        "study.pdf": lay_out(study_html(results)),
        "curves.csv": curves_csv(results),
        TABLE: study_xlsx(results, sheets(results) if results.years else ()),
        **({YEARS: years_json(results)} if results.years else {}),
        **export_files(results),
    }


def study_html(results: StudyResults) -> str:
    """Return the report as HTML, before layout."""
    study, manifest = results.plan.input.study, results.manifest
    program, date = manifest["program"], study.date.isoformat()
    libraries = ", ".join(f"{name} {program[name]}" for name in ("python", "numpy", "numba"))
    identity = manifest["identity"][:16]
    facts = (
        ("Prepared by", study.prepared_by or "not stated"),
        ("Date", date),
        ("Runs", f"{manifest['rows']:,}"),
        ("Program", f"Roofslip, version {program['roofslip']}; {libraries}"),
        ("Study", identity),
    )
    pages = list(filled(TEMPLATES, sections(results), {"with_symbols": with_symbols}))
    content = {
        "css": Markup((TEMPLATES / "package.css").read_text(encoding="utf-8")),
        "title": study.title,
        "date": date,
        "version": program["roofslip"],
        "identity": identity,
        "supporting": SUPPORTING if results.years else "",
        "about": facts,
        "parts": [part for part, _ in pages],
        "sections": pages,
    }
    return rendered(TEMPLATES, "study.html", content)


def sections(results: StudyResults) -> tuple[Section, ...]:
    """Return all sections except the cover and the contents."""
    allowed_m = results.plan.input.study.allowed_m
    first = section(
        "study/results",
        "Results",
        headline=[with_symbols(capitalized(line)) for line in headline(results)],
        design=with_symbols(design(results.plan.design_rule)),
        unverified=UNVERIFIED,
    )
    listed = [first, basis(results)]
    for b in range(len(results.plan.motions.buildings)):
        listed.append(curves(results, b))
        if allowed_m:
            listed.append(allowed(results, b, allowed_m))
        listed.append(formula(results, b))
        listed += [prescribed(results, b, comparison) for comparison in compare(results, b)]
    listed += [fragility(results, comparison) for comparison in results.arrays]
    listed += [years(results, comparison) for comparison in results.years]
    return (*listed, limits(results))
