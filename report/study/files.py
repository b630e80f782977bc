"""Every file of a study but its runs, as finished bytes. Read `study_files`."""

from __future__ import annotations

from collections.abc import Mapping

from markupsafe import Markup

from report.document.sections import filled
from report.document.templates import rendered
from report.figures.base import load_fonts
from report.study.exports import export_files
from report.study.pages import sections
from report.study.results import StudyResults
from report.study.tables import curves_csv, study_xlsx
from report.study.words import context
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
    given = context(results)
    cover = {
        "css": Markup((TEMPLATES / "package.css").read_text(encoding="utf-8")),
        "sections": list(filled(TEMPLATES, sections(results), given)),
    }
    return rendered(TEMPLATES, "study.html", given | cover)
