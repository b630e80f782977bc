"""The sheets LinkRuns and Links of results.xlsx: rows of linked blocks against one rigid block.

Live formulas, each written with the value computed by `report.assessment.links`. Read
`report.results.xlsx`.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

import pandas as pd
from xlsxwriter.utility import xl_rowcol_to_cell
from xlsxwriter.worksheet import Worksheet

from report.assessment.links import LinkedArray
from report.assessment.project import Assessment
from report.results.sheets import STATISTIC_COLUMN, Pages, write_headings
from report.words.units import NEWTONS_PER_POUND
from solver.model import INCH_M
from solver.rules.provisions import Basis
from solver.sliding.least_model import DEFAULT

_RIGID, _ROW = "PRD, rigid [in]", "PRD, row [in]"
_HEADINGS = (
    "Array", "Mean, rigid [in]", "Largest, rigid [in]", "Mean, row [in]", "Largest, row [in]",
    "Analysis factor", "Rigid [in]", "Row [in]", "Ratio", "Computed [in]", "Floor [in]",
    "Design with links [in]", "Design used [in]", "Tolerance [in]", "Result",
    "With links by Roofslip [in]", "Difference [in]",
)  # fmt: skip


def link_runs_table(assessment: Assessment) -> pd.DataFrame:
    """One row for each run of an array that is compared with a row of linked blocks."""
    return pd.DataFrame(
        {
            "Array": linked_array.design.id,
            "Motion": motion.motion.id,
            "Component along slope": run.orientation.component,
            "Polarity": "as recorded" if run.orientation.polarity > 0 else "reversed",
            _RIGID: run.rigid.prd_m / INCH_M,
            _ROW: run.prd_m / INCH_M,
            "Block with largest PRD": "none" if math.isnan(run.prd_m) else str(run.block),
            "PRD of blocks, from the upslope end [in]": _listed(run.row.prd_m),
            "Largest link elongation [in]": run.row.stretch_m / INCH_M,
            "Largest link force [lb]": run.row.link_force
            * linked_array.block_n
            / NEWTONS_PER_POUND,
            "Error bound [in]": run.row.error_m / INCH_M,
            "Stops": run.row.n_stops,
            "Outcome": run.row.status.sentence,
        }
        for linked_array in assessment.linked
        for motion in linked_array.motions
        for run in motion.runs
    )


def _listed(places_m: tuple[float, ...]) -> str:
    if any(map(math.isnan, places_m)):
        return "none"
    return ", ".join(f"{place / INCH_M:.2f}" for place in places_m)


def link_cells(assessment: Assessment, array_id: str) -> Sequence[str]:
    """Return the cells of the results of an array as a row of linked blocks."""
    return [
        f"Links!$O${5 + count}"
        for count, linked in enumerate(assessment.linked)
        if linked.design.id == array_id
    ]


def write_links(pages: Pages, assessment: Assessment, runs: pd.DataFrame) -> None:
    """Write the effect of links on the design displacement of each array, from the sheet LinkRuns.

    The peaks of the motions are below the arrays.
    """
    sheet = pages.sheet(
        "Links",
        "Rows of linked blocks",
        "From the sheets LinkRuns and Design. Ratio: row / rigid, one axis. Design with links: "
        "max(max(1, ratio) x computed, floor).",
    )
    write_headings(pages, sheet, 3, _HEADINGS)
    top = 4 + len(assessment.linked) + 2
    for column, heading in enumerate(("Array", "Motion", _RIGID, _ROW)):
        sheet.write_string(top - 1, column, heading, pages.head)
    ranges = _write_peaks(pages, sheet, top, assessment, runs)
    ids = [item.id for item in assessment.arrays]
    for row, (linked_array, peaks) in enumerate(
        zip(assessment.linked, ranges, strict=True), start=4
    ):
        _write_row(pages, sheet, row, linked_array, peaks, 5 + ids.index(linked_array.design.id))


def _write_peaks(
    pages: Pages, sheet: Worksheet, row: int, assessment: Assessment, runs: pd.DataFrame
) -> Iterator[tuple[str, str]]:
    """Write the largest of all runs of each motion; yield the cells of each array."""
    columns, first = [list(runs.columns).index(name) for name in (_RIGID, _ROW)], 1
    for linked_array in assessment.linked:
        top = row
        for motion in linked_array.motions:
            last = first + len(motion.runs) - 1
            sheet.write_string(row, 0, linked_array.design.id)
            sheet.write_string(row, 1, motion.motion.id)
            for to, column, value in zip(
                (2, 3), columns, (motion.rigid_m, motion.linked_m), strict=True
            ):
                cells = f"LinkRuns!{_range(column, first, last)}"
                _write(pages, sheet, row, to, f"=MAX({cells})", value / INCH_M)
            row, first = row + 1, last + 1
        yield _range(2, top, row - 1), _range(3, top, row - 1)


def _range(column: int, first: int, last: int) -> str:
    return f"{xl_rowcol_to_cell(first, column)}:{xl_rowcol_to_cell(last, column)}"


def _write_row(
    pages: Pages,
    sheet: Worksheet,
    row: int,
    linked_array: LinkedArray,
    peaks: tuple[str, str],
    design_row: int,
) -> None:
    inch, r, d = INCH_M, row + 1, design_row
    rigid, linked = linked_array.rigid, linked_array.linked
    design, estimated = linked_array.design, linked_array.estimated_m
    sheet.write_string(row, 0, design.id)
    if not math.isfinite(estimated):
        sheet.write_string(row, 11, "none")
        sheet.write_string(row, 14, "NG")
        return
    largest = f'Design!{STATISTIC_COLUMN}{d}="{Basis.LARGEST_FACTORED.value}"'
    ratio = f"=H{r}/G{r}" if rigid.value_m > 0.0 else "=1"
    bound = DEFAULT.bound_m(design.design_m)
    for column, formula, value in (
        (1, f"=AVERAGE({peaks[0]})", rigid.mean_m / inch),
        (2, f"=MAX({peaks[0]})", rigid.largest_m / inch),
        (3, f"=AVERAGE({peaks[1]})", linked.mean_m / inch),
        (4, f"=MAX({peaks[1]})", linked.largest_m / inch),
        (5, f"=Design!J{d}", rigid.factor),
        (6, f"=F{r}*IF({largest},C{r},B{r})", rigid.value_m / inch),
        (7, f"=F{r}*IF({largest},E{r},D{r})", linked.value_m / inch),
        (8, ratio, linked_array.ratio),
        (9, _computed(linked_array, d), linked_array.value_m / inch),
        (10, f"=Design!M{d}", design.floor_m / inch),
        (11, f"=MAX(MAX(1,I{r})*J{r},K{r})", estimated / inch),
        (12, f"=Design!N{d}", design.design_m / inch),
        (13, f"=MAX({DEFAULT.matters_m}/{INCH_M},{DEFAULT.matters_share}*M{r})", bound / inch),
        (16, f"=L{r}-P{r}", 0.0),
    ):
        _write(pages, sheet, row, column, formula, value, 4 if column == 16 else 3)
    sheet.write_number(row, 15, estimated / inch, pages.numbers[3])
    if linked_array.is_final and design.is_permitted:
        verdict = "OK" if linked_array.is_rigid_enough else "NG"
        sheet.write_formula(row, 14, f'=IF(L{r}<=M{r}+N{r},"OK","NG")', pages.plain, verdict)
    else:
        sheet.write_string(row, 14, "NG")


def _computed(linked_array: LinkedArray, design_row: int) -> str:
    """Return the value from analysis, as a number if it differs from the value for design."""
    is_used = linked_array.value_m == linked_array.design.analysis.value_m
    return f"=Design!K{design_row}" if is_used else f"={linked_array.value_m / INCH_M!r}"


def _write(
    pages: Pages,
    sheet: Worksheet,
    row: int,
    column: int,
    formula: str,
    value: float,
    decimals: int = 3,
) -> None:
    if math.isnan(value):
        sheet.write_string(row, column, "none")
    else:
        sheet.write_formula(row, column, formula, pages.numbers[decimals], value)
