"""The Summary worksheet of results.xlsx, same as sheet 1 of the package.

The verdicts and the governing clearance are formulas of the yellow cells; the rest is from the
package. Read `write_summary`.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from operator import itemgetter

from xlsxwriter.worksheet import Worksheet

from report.assessment.assessment import Assessment
from report.assessment.causes import largest
from report.assessment.checks.check import Check
from report.assessment.checks.sentence import found_and_limit
from report.assessment.design.verdict import Verdict, worst
from report.provenance.package_sources import fingerprint
from report.results.clearances_sheet import GAPS, GapRow
from report.results.design_sheet import DESIGN, DesignRow, any_of
from report.results.sheet_columns import Cells, written
from report.results.sheet_pages import LINE_PT, TOP, Pages, lines_of
from report.text.units import ratio

# What a cell holds: a text, a number, or a formula with its value.
_Value = str | float | tuple[str, str | float]

_OF_ARRAYS = (
    "Array", "Procedure", "Analysis [in]", "Prescriptive [in]", "Design [in]", "Cause", "Verdict",
)  # fmt: skip
_OF_GAPS = ("Governing clearance", "Type", "Provided [in]", "Required [in]", "D/C", "", "All")
_OF_CHECKS = (
    "Governing checks",
    "Item",
    "Found",
    "Required",
    "Ratio",
    "Section",
    "Verdict",
)
_OF_OPEN = ("Not satisfied", "Item", "Found", "Required", "Action by", "Action", "Verdict")
_WIDTHS = (26, 26, 24, 22, 13, 26, 12)  # [letters]
_NOTE = (
    "Same as sheet 1 of the calculation package. Verdicts, displacements and the governing "
    "clearance are recalculated from the yellow cells of the Inputs, Design and Clearances "
    "worksheets; other values are not. Spectra, runs and unrounded values do not print."
)


def write_summary(
    pages: Pages, assessment: Assessment, designs: Sequence[DesignRow], gaps: Sequence[GapRow]
) -> None:
    """Write the head, the arrays, the governing checks and unsatisfied ones.

    From the rows of the Design and Clearances worksheets.
    """
    # Added first, to be in front (`xlsx`), and written last: its cells refer to those of the
    # others.
    sheet: Worksheet = pages.workbook.get_worksheet_by_name("Summary")
    for index, width in enumerate(_WIDTHS):
        sheet.set_column(index, index, width)
    sheet.write_string(0, 0, "Seismic displacement of rooftop solar arrays: summary", pages.title)
    sheet.merge_range(1, 0, 1, len(_WIDTHS) - 1, _NOTE, pages.note)
    sheet.set_row(1, LINE_PT * lines_of(_NOTE, sum(_WIDTHS)))
    arrays = [_array(row, place) for place, row in enumerate(designs, start=TOP)]
    tables: list[tuple[Sequence[str], Sequence[Sequence[_Value]]]] = [
        ((), _head(assessment, len(designs))),
        (_OF_ARRAYS, arrays),
        (_OF_GAPS, [_gap(gaps)] if gaps else []),
        (_OF_CHECKS, list(_governing(assessment))),
        (_OF_OPEN, list(_open(assessment))),
    ]
    top = 3
    for heads, rows in filter(itemgetter(1), tables):
        sheet.write_row(top, 0, heads, pages.head)
        for row, values in enumerate(rows, start=top + bool(heads)):
            _write_row(pages, sheet, row, values, heads)
        top += bool(heads) + len(rows) + 1
    pages.on_paper(sheet)
    sheet.set_portrait()
    pages.mark_verdicts(sheet, top, len(_WIDTHS))
    # One page wide; 0 is as many tall as it takes.
    sheet.fit_to_pages(1, 0)


def _write_row(
    pages: Pages, sheet: Worksheet, row: int, values: Sequence[_Value], heads: Sequence[str]
) -> None:
    tall = 1
    for column, value in enumerate(values):
        formula, text = value if isinstance(value, tuple) else ("", written(value))
        look = pages.text
        if not isinstance(text, str):
            look = pages.lengths if heads[column].endswith("[in]") else pages.ratios
        if formula:
            sheet.write_formula(row, column, formula, look, text)
        else:
            sheet.write(row, column, text, look)
        tall = max(tall, lines_of(str(text), _WIDTHS[column] - 2))
    sheet.set_row(row, LINE_PT * tall)


def _head(assessment: Assessment, n_arrays: int) -> Sequence[Sequence[_Value]]:
    """Return the rows of the project, the last two with the verdict and its basis."""
    project, site = assessment.project.project, assessment.project.site
    # What is of no array has no formula on the Design worksheet: the project's verdict takes it
    # from here.
    of_project = worst(check.verdict for check in assessment.checks if not check.arrays)
    rows: list[Sequence[_Value]] = [
        ("Project", project.name),
        ("Project number", project.number),
        ("Revision", project.revision),
        ("Date", str(project.date)),
        ("Prepared by", project.prepared_by),
        ("Checked by", project.checked_by or "not yet checked"),
        ("Hash", fingerprint(assessment.source, assessment.shaking)),
        ("Rule set", assessment.rules.name),
        ("S_DS, SDC", f"{site.s_ds:.3f} g, {site.sdc_text}"),
    ]
    cells = [Cells(DESIGN, TOP + count).verdict for count in range(n_arrays)]
    cells.append(f"B{len(rows) + 4}")  # the next row, below title, note and a blank one
    formula = (
        f'=IF(OR({any_of(cells, Verdict.NG)}),"{Verdict.NG}",'
        f'IF(OR({any_of(cells, Verdict.CONDITION)}),"{Verdict.CONDITIONS}","{Verdict.OK}"))'
    )
    return (
        *rows,
        ("Building, motions and documents", of_project.value),
        ("Verdict", (formula, assessment.verdict.value)),
    )


def _array(row: DesignRow, place: int) -> Sequence[_Value]:
    """Return an array with its displacements, rounded as on the Design worksheet."""
    cells = Cells(DESIGN, place)
    lengths = [
        (f"={cells.printed(name)}", DESIGN.printed(row, name))
        for name in ("computed_m", "prescriptive_m", "design_m")
    ]
    verdict = (f"={cells.verdict}", row.verdict.value)
    return (row.item.id, row.item.route.value, *lengths, row.cause, verdict)


def _gap(rows: Sequence[GapRow]) -> Sequence[_Value]:
    """Return the clearance with the largest D/C, and the verdict on all."""
    cells = Cells(GAPS, TOP, TOP + len(rows) - 1)
    ratios = [GAPS.printed(row, "demand_capacity") for row in rows]
    known = [item for item in ratios if not isinstance(item, str)]
    verdicts = [row.gap.verdict for row in rows]
    of_all = next((v for v in (Verdict.NG, Verdict.NONE) if v in verdicts), Verdict.OK)
    formula = (
        f'=IF(COUNTIF({cells.verdict},"{Verdict.NG}")>0,"{Verdict.NG}",'
        f'IF(COUNTIF({cells.verdict},"{Verdict.NONE}")>0,"{Verdict.NONE}","{Verdict.OK}"))'
    )
    if not known:
        return ("none has a required separation", "", "", "", "", "", (formula, of_all.value))
    # Of equal ones the first, as MATCH finds it.
    worst_place = ratios.index(max(known))
    place = f"MATCH(MAX({cells.demand_capacity}),{cells.demand_capacity},0)"

    def found(name: str) -> _Value:
        return f"=INDEX({cells.printed(name)},{place})", GAPS.printed(rows[worst_place], name)

    array, across = (f"INDEX({cells.printed(name)},{place})" for name in ("array", "object"))
    between = f'={array}&" to "&{across}', " to ".join(rows[worst_place].gap.between)
    names = ("neighbor", "provided_m", "required_m", "demand_capacity")
    return (between, *map(found, names), "", (formula, of_all.value))


def _governing(assessment: Assessment) -> Iterator[Sequence[_Value]]:
    """Yield the satisfied check with the largest ratio of each type except clearances."""
    for check in largest(assessment):
        if check.id != "clearance":
            rounded = float(ratio(check.ratio))
            yield (*_said(assessment, check), rounded, check.clause, check.verdict.value)


def _open(assessment: Assessment) -> Iterator[Sequence[_Value]]:
    """Yield unsatisfied checks, with who must act and the action."""
    for check in assessment.open:
        yield (*_said(assessment, check), check.actor, check.to_close, check.verdict.value)


def _said(assessment: Assessment, check: Check) -> tuple[str, str, str, str]:
    return (
        check.title,
        check.subject or "project",
        *found_and_limit(check, assessment.project.us_first),
    )
