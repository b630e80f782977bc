"""The sheet Design of results.xlsx: from the peaks to the design displacement and the verdicts.

Live formulas, each written with the value from `report.assessment.project`. Read
`report.results.xlsx`.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence

from xlsxwriter.worksheet import Worksheet

from report.assessment.arrays import ArrayAssessment, Route
from report.assessment.overrides import MEANING
from report.assessment.project import Assessment
from report.assessment.verdict import Verdict, worst
from report.results.directions import PeakRanges
from report.results.inputs import InputCells
from report.results.sheets import Pages, typed, write_headings
from report.sheet.schema import Direction
from report.words.units import NEWTONS_PER_POUND
from solver.model import INCH_M
from solver.rules.provisions import Basis, PrescriptiveBasis

_HEADINGS = (
    "Array", "S_DS [g]", "Factor [in]", "I_e in displacement", "Minimum [in]",
    "Prescriptive [in]", "Number of motions", "Mean PRD [in]", "Largest PRD [in]",
    "Analysis factor", "Computed [in]", "Floor / prescriptive", "Floor [in]", "Design [in]",
    "Design [mm]", "Design / prescriptive", "Design by Roofslip [in]", "Difference [in]", "Verdict",
    "Statistic", "Other requirements", "Electrical slack [in]", "Weight [lb]",
    "Interconnection required [lb]", "Interconnection provided [lb]",
)  # fmt: skip

_LIVE_ROWS = ("electrical_slack", "interconnection")
"""Ids of the requirements that follow here by formula."""


def write_design(
    pages: Pages,
    assessment: Assessment,
    peaks: PeakRanges,
    inputs: InputCells,
    results: Mapping[str, Sequence[str]],
) -> None:
    """Write the design displacement and the verdict of each array as formulas.

    Parameters
    ----------
    results : mapping of str to sequence of str
        For each array, the cells that hold OK, NG or none: its clearances and its row of linked
        blocks.
    """
    sheet = pages.sheet(
        "Design",
        "Design displacement",
        f"{assessment.rules.name}. From the sheets Peaks, any direction, and Inputs. Other "
        "requirements, those that need other runs or the plan, are those of the report."
        + (f" {MEANING}." if assessment.is_overridden else ""),
    )
    write_headings(pages, sheet, 3, _HEADINGS)
    for row, item in enumerate(assessment.arrays, start=4):
        _write_row(pages, sheet, row, assessment, item, peaks[item.id, Direction.ANY], inputs)
        _write_requirements(pages, sheet, row, assessment, item, inputs)
        verdict = assessment.array_verdict(item).word
        formula = _verdict(row + 1, results[item.id])
        sheet.write_formula(row, 18, formula, pages.plain, verdict)
    _write_verdict(pages, sheet, assessment)


def _write_verdict(pages: Pages, sheet: Worksheet, assessment: Assessment) -> None:
    """Write the verdict on the project from those on its arrays."""
    ids = {item.id for item in assessment.arrays}
    others = worst(
        [
            *(Verdict.OK if check.ok else Verdict.NG for check in assessment.building_checks),
            *(row.verdict for row in assessment.rows if row.subject not in ids),
        ]
    )
    sheet.write_string(2, 0, "Verdict", pages.head)
    sheet.write_string(2, 2, "Other", pages.head)
    sheet.write_string(2, 3, others.word, pages.plain)
    last = 4 + len(assessment.arrays)
    cells = ["D3", *(f"S{row}" for row in range(5, last + 1))]
    formula = f"=IF(OR({_any(cells, Verdict.NG)}),{_quoted(Verdict.NG)},"
    formula += f'IF(OR({_any(cells, Verdict.CONDITIONS)}),"{Verdict.CONDITIONS}",'
    sheet.write_formula(
        2, 1, f"{formula}{_quoted(Verdict.OK)}))", pages.head, assessment.verdict.value
    )


def _any(cells: Sequence[str], verdict: Verdict) -> str:
    return ",".join(f"{cell}={_quoted(verdict)}" for cell in cells)


def _quoted(verdict: Verdict) -> str:
    return f'"{verdict.word}"'


def _verdict(r: int, results: Sequence[str]) -> str:
    """Return the formula of the verdict on an array."""
    short = [f"AND(ISNUMBER(V{r}),V{r}<N{r})", f"AND(ISNUMBER(Y{r}),Y{r}<X{r})"]
    failed = [f"ISTEXT(N{r})", *short, _any([f"U{r}", *results], Verdict.NG)]
    failed += [_any(results, Verdict.NONE)] if results else []
    open_ = [f"ISTEXT(V{r})", f"ISTEXT(Y{r})", _any([f"U{r}"], Verdict.CONDITIONS)]
    return (
        f"=IF(OR({','.join(failed)}),{_quoted(Verdict.NG)},"
        f"IF(OR({','.join(open_)}),{_quoted(Verdict.CONDITIONS)},{_quoted(Verdict.OK)}))"
    )


def _write_row(
    pages: Pages,
    sheet: Worksheet,
    row: int,
    assessment: Assessment,
    item: ArrayAssessment,
    peaks: str,
    inputs: InputCells,
) -> None:
    rules, r = assessment.rules, row + 1
    prescriptive = item.prescriptive
    flat = prescriptive.governs is PrescriptiveBasis.LOW_CATEGORY
    sheet.write_string(row, 0, item.id)
    # The constant value for SDC A, B and C replaces the formula.
    factor_in = 0.0 if flat else rules["prescriptive_factor_in"]
    sheet.write_number(row, 2, typed(factor_in), pages.typed[1])
    if rules.importance_in_separation:
        sheet.write_number(row, 3, 1.0, pages.numbers[2])
    sheet.write_number(row, 4, typed(prescriptive.minimum_m / INCH_M), pages.typed[1])
    marks = _marks(item)
    for column, formula, value, decimals in _formulas(assessment, item, peaks, inputs, r):
        shown = pages.marked(pages.numbers[decimals], marks.get(column, ""))
        sheet.write_formula(row, column, formula, shown, value)
    sheet.write_formula(row, 19, _statistic(r, inputs), pages.plain, item.analysis.basis.value)
    if math.isnan(item.design_m):
        sheet.write_formula(row, 13, _design(item, r), pages.plain, "none")
        for column in (14, 15, 16):
            sheet.write_string(row, column, "none")
    else:
        shown = pages.marked(pages.numbers[2], item.design_mark)
        sheet.write_number(row, 16, item.design_m / INCH_M, shown)
    if math.isnan(item.analysis.mean_m):
        for column in (7, 8):
            sheet.write_string(row, column, "none")


def _marks(item: ArrayAssessment) -> Mapping[int, str]:
    """Return the marks of the numbers that an override or a departure changes, by column."""
    return {
        5: item.mark(lambda array: array.prescriptive.value_m),
        10: item.mark(lambda array: array.analysis.value_m),
        12: item.mark(lambda array: array.floor_m),
        **dict.fromkeys((13, 14, 15), item.design_mark),
    }


def _formulas(
    assessment: Assessment, item: ArrayAssessment, peaks: str, inputs: InputCells, r: int
) -> Iterator[tuple[int, str, float | str, int]]:
    """Yield column, formula, value and decimals."""
    site, analysis, inch = assessment.project.site, item.analysis, INCH_M
    rules, reviewed = assessment.rules, inputs["peer_reviewed"]
    yield 1, f"={inputs['s_ds_g']}", site.s_ds, 4
    if not rules.importance_in_separation:
        yield 3, f"={inputs['i_e']}", site.i_e, 2
    prescriptive = item.prescriptive.value_m
    yield 5, f"=MAX(C{r}*D{r}*MAX(B{r}-0.4,0)^2,E{r})", prescriptive / inch, 1
    yield 6, f"=COUNT({peaks})", analysis.n_motions, 0
    yield 9, f'=IF(T{r}="{Basis.MEAN.value}",1,{inputs["factor"]})', _factor(assessment, item), 2
    share = 0.0 if assessment.project.options.peer_reviewed else rules["analysis_floor"]
    yield 11, f'=IF({reviewed}="Yes",0,{inputs["floor"]})', share, 2
    yield 12, f"=L{r}*F{r}", item.floor_m / inch, 2
    if not math.isnan(analysis.mean_m):
        yield 7, f"=AVERAGE({peaks})", analysis.mean_m / inch, 2
        yield 8, f"=MAX({peaks})", analysis.largest_m / inch, 2
    value = "none" if math.isnan(analysis.value_m) else analysis.value_m / inch
    yield 10, _computed(item, r), value, 2
    if not math.isnan(item.design_m):
        yield 13, _design(item, r), item.design_m / inch, 2
        yield 14, f'=IF(ISTEXT(N{r}),"none",N{r}*25.4)', item.design_m * 1e3, 1
        yield 15, f'=IF(ISTEXT(N{r}),"none",N{r}/F{r})', item.ratio, 3
        yield 17, f'=IF(ISTEXT(N{r}),"none",N{r}-Q{r})', 0.0, 4


def _factor(assessment: Assessment, item: ArrayAssessment) -> float:
    """Return the analysis factor, that of the rule set also where there are too few motions."""
    return 1.0 if item.analysis.basis is Basis.MEAN else assessment.rules["analysis_factor"]


def _statistic(r: int, inputs: InputCells) -> str:
    """Return the formula of the statistic of the peaks."""
    asked, count = inputs["statistic"], f"G{r}"
    mean, largest, plain = (
        b.value for b in (Basis.MEAN_FACTORED, Basis.LARGEST_FACTORED, Basis.MEAN)
    )
    few = Basis.TOO_FEW.value
    by_rule = f'IF({count}>={inputs["mean_motions"]},"{mean}",{_enough(r, largest, inputs)})'
    asked_for = (
        f'IF({asked}="{mean}",IF({count}>={inputs["mean_motions"]},"{mean}","{few}"),'
        f'IF({asked}="{largest}",{_enough(r, largest, inputs)},'
        f'IF({count}>={inputs["plain_mean_motions"]},"{plain}","{few}")))'
    )
    return f'=IF({asked}="rule set",{by_rule},{asked_for})'


def _enough(r: int, largest: str, inputs: InputCells) -> str:
    few = Basis.TOO_FEW.value
    return f'IF(G{r}>={inputs["largest_motions"]},"{largest}","{few}")'


def _computed(item: ArrayAssessment, r: int) -> str:
    if math.isnan(item.analysis.mean_m):
        return '="none"'
    largest, few = Basis.LARGEST_FACTORED.value, Basis.TOO_FEW.value
    return f'=IF(T{r}="{few}","none",J{r}*IF(T{r}="{largest}",I{r},H{r}))'


def _design(item: ArrayAssessment, r: int) -> str:
    if math.isnan(item.analysis.mean_m):
        return '="none"'
    if item.route is Route.PRESCRIPTIVE:
        return f"=MAX(F{r},I{r})"
    return f'=IF(ISTEXT(K{r}),"none",MAX(K{r},M{r}))'


def _write_requirements(
    pages: Pages,
    sheet: Worksheet,
    row: int,
    assessment: Assessment,
    item: ArrayAssessment,
    inputs: InputCells,
) -> None:
    """Write slack and interconnection strength with their requirements, and all other rows."""
    r, pound = row + 1, NEWTONS_PER_POUND
    others = worst(
        [
            Verdict.OK if assessment.is_sound(item) else Verdict.NG,
            *(x.verdict for x in assessment.rows_of(item.id) if x.id not in _LIVE_ROWS),
        ]
    )
    sheet.write_string(row, 20, others.word)
    _write_given(pages, sheet, row, 21, item.array.slack_m, INCH_M, 1)
    _write_given(pages, sheet, row, 22, item.array.weight_n, pound, 0)
    strength = f"MAX({inputs['interconnection_sds']}*B{r},{inputs['interconnection_min']})"
    required = item.interconnection_n / pound
    shown = pages.marked(pages.numbers[0], item.mark(lambda array: array.interconnection_n))
    sheet.write_formula(row, 23, f"={strength}*W{r}/2", shown, required)
    _write_given(pages, sheet, row, 24, item.array.interconnection_n, pound, 0)


def _write_given(
    pages: Pages,
    sheet: Worksheet,
    row: int,
    column: int,
    value_si: float | None,
    unit: float,
    decimals: int,
) -> None:
    if value_si is None:
        sheet.write_string(row, column, "not given", pages.typed_text)
    else:
        sheet.write_number(row, column, typed(value_si / unit), pages.typed[decimals])
