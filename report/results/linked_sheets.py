"""The Links and LinkRuns worksheets of results.xlsx: an array as a row and as one block."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from report.assessment.assessment import Assessment
from report.assessment.design.linked_blocks import LinkedArray, LinkedMotion, LinkedRun
from report.results.list_sheets import polarity_text
from report.results.sheet_columns import (
    Cells,
    SheetColumn,
    SheetLayout,
    SheetRow,
    up_column,
    write_list,
    write_live,
    write_rows,
)
from report.results.sheet_pages import LINE_PT, TOP, Pages
from report.text.unit_format import NO_VALUE
from solver.model import INCH_M
from solver.rules.provisions import Basis
from solver.sliding.model_selection import DEFAULT

# Whether the design displacement follows from the largest peak.
_TAKES_LARGEST = f'{{design.statistic}}="{Basis.LARGEST_FACTORED.value}"'
_RIGID = f"={{factor}}*IF({_TAKES_LARGEST},{{rigid_largest_m}},{{rigid_mean_m}})"
_ROW = f"={{factor}}*IF({_TAKES_LARGEST},{{row_largest_m}},{{row_mean_m}})"
# Links never lower a design displacement: a ratio below 1 counts as 1.
_DESIGN = "=MAX(MAX(1,{ratio})*{computed_m},{floor_m})"
# As `Settings.bound_m` of the model selection.
_TOLERANCE = f"=MAX({DEFAULT.matters_m}/{INCH_M},{DEFAULT.matters_share}*{{design_m}})"
_DIFFERENCE = "={estimated_m}-{by_roofslip_m}"
_RESULT = '=IF({estimated_m}<={design_m}+{tolerance_m},"OK","NG")'


@dataclass(frozen=True, slots=True, kw_only=True)
class _LinkRun:
    """A run of an array as a row of blocks, and as one block."""

    linked: LinkedArray
    motion: LinkedMotion
    run: LinkedRun


def _listed(places_m: Sequence[float]) -> str:
    if any(map(math.isnan, places_m)):
        return NO_VALUE
    return ", ".join(f"{place / INCH_M:.2f}" for place in places_m)


LINK_RUNS = SheetLayout(
    "LinkRuns",
    (
        SheetColumn("array", "Array", lambda row: row.linked.design.id),
        SheetColumn("motion", "Motion", lambda row: row.motion.motion.id),
        SheetColumn("along", "Component along slope", lambda row: row.run.orientation.component),
        SheetColumn("polarity", "Polarity", lambda row: polarity_text(row.run)),
        SheetColumn("rigid_prd_m", "PRD, rigid [in]", lambda row: row.run.rigid.prd_m),
        SheetColumn("largest_m", "PRD, row [in]", lambda row: row.run.prd_m),
        SheetColumn("block", "Block with largest PRD",
            lambda row: NO_VALUE if math.isnan(row.run.prd_m) else str(row.run.block)),
        # In inches as a text: the unit in the heading converts no text.
        SheetColumn("prd_m", "PRD of blocks, from the upslope end [in]",
            lambda row: _listed(row.run.row.prd_m)),
        SheetColumn("stretch_m", "Largest link elongation [in]", lambda row: row.run.row.stretch_m),
        SheetColumn("link_force_n", "Largest link force [lb]",
            lambda row: row.run.row.link_force * row.linked.block_n),
        SheetColumn("error_m", "Error bound [in]", lambda row: row.run.row.error_m),
        SheetColumn("n_stops", "Stops", lambda row: row.run.row.n_stops),
        SheetColumn("status", "Outcome", lambda row: row.run.row.status.sentence),
    ),
    key_columns=4,
)  # fmt: skip


@dataclass(frozen=True, slots=True, kw_only=True)
class _LinkPeak:
    """The largest of all runs of a motion, below the arrays."""

    linked: LinkedArray
    motion: LinkedMotion


_LINK_PEAKS = SheetLayout(
    "Links",
    (
        SheetColumn("array", "Array", lambda row: row.linked.design.id),
        SheetColumn("motion", "Motion", lambda row: row.motion.motion.id),
        SheetColumn("rigid_m", "PRD, rigid [in]", lambda row: row.motion.rigid_m, 3,
            "=MAX({runs.rigid_prd_m})"),
        SheetColumn("row_m", "PRD, row [in]", lambda row: row.motion.linked_m, 3,
            "=MAX({runs.largest_m})"),
    ),
)  # fmt: skip


def _estimated_m(linked: LinkedArray) -> float:
    """Return the design displacement with links; NaN without bound."""
    # Without bound where the blocks slide and the single one does not.
    return linked.estimated_m if math.isfinite(linked.estimated_m) else math.nan


def _result(linked: LinkedArray) -> str:
    is_enough = math.isfinite(linked.estimated_m) and linked.is_rigid_enough
    return "OK" if is_enough else "NG"


_LINKS = SheetLayout(
    "Links",
    (
        SheetColumn("array", "Array", lambda row: row.design.id),
        SheetColumn("rigid_mean_m", "Mean, rigid [in]", lambda row: row.rigid.mean_m, 3,
            "=AVERAGE({peaks.rigid_m})"),
        SheetColumn("rigid_largest_m", "Largest, rigid [in]", lambda row: row.rigid.largest_m, 3,
            "=MAX({peaks.rigid_m})"),
        SheetColumn("row_mean_m", "Mean, row [in]", lambda row: row.linked.mean_m, 3,
            "=AVERAGE({peaks.row_m})"),
        SheetColumn("row_largest_m", "Largest, row [in]", lambda row: row.linked.largest_m, 3,
            "=MAX({peaks.row_m})"),
        SheetColumn("factor", "Analysis factor", lambda row: row.rigid.factor, 3,
            "={design.analysis_factor}"),
        up_column("rigid_one_axis_m", "Rigid [in]", lambda row: row.rigid.value_m, 1, _RIGID),
        up_column("linked_one_axis_m", "Row [in]", lambda row: row.linked.value_m, 1, _ROW),
        up_column("ratio", "Ratio", lambda row: row.ratio, 3,
            "={linked_one_axis_m}/{rigid_one_axis_m}"),
        up_column("computed_m", "Analysis [in]", lambda row: row.design.analysis.value_m, 1,
            "={design.computed_m}"),
        up_column("floor_m", "Floor [in]", lambda row: row.design.floor_m, 1, "={design.floor_m}"),
        up_column("estimated_m", "Design with links [in]", _estimated_m, 1, _DESIGN),
        up_column("design_m", "Design used [in]", lambda row: row.design.design_m, 1,
            "={design.design_m}"),
        SheetColumn("tolerance_m", "Tolerance [in]",
            lambda row: DEFAULT.bound_m(row.design.design_m), 3, _TOLERANCE),
        SheetColumn("result", "Verdict", _result, formula=_RESULT),
        up_column("by_roofslip_m", "With links, as reported [in]", lambda row: row.estimated_m, 1),
        SheetColumn("difference", "Difference [in]", lambda _: 0.0, 4, _DIFFERENCE),
    ),
    last_printed="difference",
)  # fmt: skip


# What the row of an array has whose blocks do not come to rest.
_WITHOUT_VALUE = {"array", "estimated_m", "result"}


def write_link_runs(pages: Pages, assessment: Assessment) -> None:
    """Write each run of the arrays that are compared with a row of linked blocks."""
    runs = []
    for linked in assessment.linked:
        for motion in linked.motions:
            runs += [_LinkRun(linked=linked, motion=motion, run=run) for run in motion.runs]
    keys = LINK_RUNS.key_columns
    write_list(pages, LINK_RUNS.sheet, LINK_RUNS.own, runs, keys, is_printed=False)


def link_cells(assessment: Assessment, array_id: str) -> Sequence[str]:
    """Return the cells of the results of an array as a row of linked blocks."""
    return [
        _LINKS.fixed("result", row)
        for row, linked in enumerate(assessment.linked, start=TOP)
        if linked.design.id == array_id
    ]


def write_links(pages: Pages, assessment: Assessment, designs: Mapping[str, Cells]) -> None:
    """Write the effect of links on the design displacement of each array, from sheet LinkRuns."""
    # Of the peaks of the motions, below the arrays.
    top = TOP + len(assessment.linked) + 2
    rows: list[SheetRow] = []
    peaks: list[SheetRow] = []
    # Below the row of headings of the LinkRuns worksheet, in the order in which it lists them.
    first_run = 2
    for linked in assessment.linked:
        first = top + len(peaks)
        for motion in linked.motions:
            runs = Cells(LINK_RUNS, first_run, first_run + len(motion.runs) - 1)
            first_run += len(motion.runs)
            peak = _LinkPeak(linked=linked, motion=motion)
            peaks.append(SheetRow(item=peak, refs={"runs": runs}))
        of_array = Cells(_LINK_PEAKS, first, top + len(peaks) - 1, is_here=True)
        rows.append(_row(linked, {"peaks": of_array, "design": designs[linked.design.id]}))
    sheet = write_live(
        pages,
        _LINKS,
        rows,
        "Rows of linked blocks",
        "From the LinkRuns and Design worksheets. Ratio: row / rigid, one axis. Design with links: "
        "max(max(1, ratio) x computed, floor).",
    )
    sheet.write_row(top - 2, 0, [column.head for column in _LINK_PEAKS.own], pages.head)
    sheet.set_row(top - 2, 3 * LINE_PT)
    # Again: the sheet was laid out for the arrays alone, before the peaks stood below them.
    sheet.print_area(0, 0, top + len(peaks) - 2, (_LINKS.n_printed or 0) - 1)
    write_rows(pages, sheet, _LINK_PEAKS, top, peaks)


def _row(linked: LinkedArray, refs: Mapping[str, Cells]) -> SheetRow:
    has_value = math.isfinite(linked.estimated_m)
    formulas = {}
    # A row that rests beside a block that rests: the ratio is 1, not 0 / 0.
    if not linked.rigid.value_m > 0.0:
        formulas["ratio"] = "=1"
    if not (has_value and linked.is_final and linked.design.is_permitted):
        formulas["result"] = ""
    names = {column.name for column in _LINKS.own}
    return SheetRow(
        item=linked,
        refs=refs,
        formulas=formulas,
        blanks=set() if has_value else names - _WITHOUT_VALUE,
    )
