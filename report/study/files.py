"""Every file of a study but its runs, as finished bytes. Read `study_files`."""

from __future__ import annotations

from collections.abc import Mapping

from markupsafe import Markup

from report.document.templates import rendered
from report.figures.base import load_fonts
from report.study.blocks import numbered
from report.pages.symbols import with_symbols
from report.study.exports import export_files
from report.study.pages import sections
from report.study.results import StudyResults
from report.study.tables import curves_csv, study_xlsx
from report.typeset.pdf import TEMPLATES, lay_out

TABLE = "study.xlsx"


def study_files(results: StudyResults) -> Mapping[str, bytes]:
    """Return the report, the tables and the exports of a study by file name.

    Raises
    ------
    DefectError
        Where the renderer complains.
    """
    load_fonts(TEMPLATES / "fonts")
    return {
        "study.pdf": lay_out(study_html(results)),
        "curves.csv": curves_csv(results),
        TABLE: study_xlsx(results),
        **export_files(results),
    }


def study_html(results: StudyResults) -> str:
    """Return the report as HTML, before layout."""
    manifest, study = results.manifest, results.plan.input.study
    program = manifest["program"]
    parts = sections(results)
    context = {
        "with_symbols": with_symbols,
        "css": Markup((TEMPLATES / "package.css").read_text(encoding="utf-8")),
        "title": study.title,
        "prepared_by": study.prepared_by or "not stated",
        "date": study.date.isoformat(),
        "version": program["roofslip"],
        "libraries": ", ".join(f"{name} {program[name]}" for name in ("python", "numpy", "numba")),
        "identity": manifest["identity"][:16],
        "runs": f"{manifest['rows']:,}",
        "sections": list(zip(numbered(parts), parts, strict=True)),
        "pictures": {},
    }
    return rendered(TEMPLATES, "study.html", context)
