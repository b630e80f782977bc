"""Every file of a study but its runs, as finished bytes. Read `study_files`."""

from __future__ import annotations

from collections.abc import Mapping

from markupsafe import Markup

from report.document.templates import Section, filled, rendered, section
from report.project.read.study_years import YEARS
from report.study.array_page import fragility, sheets, years, years_json
from report.study.curves import allowed, compare, curves, prescribed
from report.study.exports import export_files
from report.study.page_parts import basis, formula, limits
from report.study.results import StudyResults
from report.study.tables import curves_csv, study_xlsx
from report.study.wording import context, headline
from report.typeset.pdf import TEMPLATES, lay_out

TABLE = "study.xlsx"


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
    words = context(results)
    cover = {
        "css": Markup((TEMPLATES / "package.css").read_text(encoding="utf-8")),
        "sections": list(filled(TEMPLATES, sections(results), words)),
    }
    return rendered(TEMPLATES, "study.html", words | cover)


def sections(results: StudyResults) -> tuple[Section, ...]:
    """Return all sections except the cover and the contents."""
    allowed_m = results.plan.input.study.allowed_m
    first = section("study/results", "Results", headline=headline(results))
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
