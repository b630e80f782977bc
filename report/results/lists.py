"""The sheets of results.xlsx without formulas: Runs, Motions, Neighbors, Requirements and more.

Computes nothing. Read `report.results.xlsx`.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict
from typing import Annotated, ClassVar

from report.assessment.checks.check import Check, alike, found_and_limit
from report.assessment.links import LinkedArray
from report.assessment.project import Assessment
from report.assessment.spectra import Spectra
from report.assessment.verdict import Verdict
from report.entities.evidence import LinkedResult, LinkedRunResult, NeighborResult, linked_result
from report.entities.motion import MotionResult, RecordResult, RunResult, motion_result, run_result
from report.entities.shown import Column, Number, columns_of, up_column
from report.motions.prepare import Shaking
from report.project.model.choices import Direction
from report.results.sheets import (
    LINE_PT,
    TOP,
    Cells,
    Pages,
    SheetRow,
    fixed,
    printed_columns,
    write_list,
    write_live,
    write_rows,
    write_table,
)
from report.text.units import G_MPS2
from solver.model import INCH_M
from solver.sliding.least_model import DEFAULT


class RunRow(SheetRow, RunResult):
    """A run of an array; without a displacement where it does not come to rest."""

    sheet: ClassVar[str] = "Runs"
    across: ClassVar[str] = (
        "array motion along polarity governs scale prd_m over_mean residual_m residual_across_m"
        " down_m up_m across_m t_prd_s n_stops peak_speed_mps n_min_g friction_demand rung reason"
        " next_rung next_effect_m error_m status"
    )
    key_columns: ClassVar[int] = 4

    array: Annotated[str, Column("Array")]
    governs: Annotated[str, Column("Governs")]
    over_mean: Annotated[Number, Column("PRD / mean")]


class MotionRow(SheetRow, MotionResult):
    """A component of a motion, processed and scaled, at the recording level."""

    sheet: ClassVar[str] = "Motions"
    across: ClassVar[str] = "id component"
    key_columns: ClassVar[int] = 2

    component: Annotated[str, Column("Component")]
    pga_g: Annotated[float, Column("PGA [g]")]
    pgv_mps: Annotated[float, Column("PGV [m/s]")]
    pgd_m: Annotated[float, Column("PGD [m]")]
    arias_mps: Annotated[float, Column("Arias intensity [m/s]")]
    d5_95_s: Annotated[float, Column("Duration 5-95 % [s]")]
    final_velocity_mps: Annotated[float, Column("Velocity at end [m/s]")]
    final_displacement_m: Annotated[float, Column("Displacement at end [m]")]


def write_lists(pages: Pages, assessment: Assessment, spectra: Sequence[Spectra]) -> None:
    """Write the runs, the components of the motions, the records, spectra and neighbors."""
    shaking = assessment.shaking
    if assessment.has_motions:
        write_list(pages, RunRow.sheet, list(_runs(assessment)), is_printed=False)
        write_list(pages, MotionRow.sheet, list(_motions(shaking)))
        write_list(pages, "Records", list(map(RecordResult.of, shaking.records)))
        write_table(pages, "Spectra", _spectra(spectra), is_printed=False)
    if assessment.neighbors:
        write_list(pages, "Neighbors", list(map(NeighborResult.of, assessment.neighbors)))


def _runs(assessment: Assessment) -> Iterator[RunRow]:
    """Yield the runs of each motion, arrays together."""
    for item in assessment.arrays:
        mean_m = item.analysis.mean_m
        for motion in item.motions:
            for run in motion.runs:
                yield RunRow.beside(
                    run_result(motion, run),
                    array=item.id,
                    # By identity: two runs of a symmetric motion may be equal.
                    governs="yes" if run is motion.governing else "",
                    over_mean=run.prd_m / mean_m if mean_m > 0.0 else math.nan,
                    prd_m=run.prd_m,
                    down_m=run.excursion_m(Direction.DOWN),
                    up_m=run.excursion_m(Direction.UP),
                    across_m=run.excursion_m(Direction.ACROSS),
                )


def _motions(shaking: Shaking) -> Iterator[MotionRow]:
    for motion, prepared in zip(shaking.motions, shaking.prepared, strict=True):
        row = motion_result(motion, prepared)
        for name, measures in row.components.items():
            yield MotionRow.beside(
                row, component=name, pga_g=measures.pga_mps2 / G_MPS2, **asdict(measures)
            )


class CheckRow(SheetRow):
    """A check as a row of the sheet, or checks that ask the same."""

    sheet: ClassVar[str] = "Requirements"

    subject: Annotated[str, Column("Item")]
    title: Annotated[str, Column("Requirement")]
    found: Annotated[str, Column("Found")]
    limit: Annotated[str, Column("Required")]
    clause: Annotated[str, Column("Basis")]
    verdict: Annotated[Verdict, Column("Verdict")]
    to_close: Annotated[str, Column("What must be done")]


def write_requirements(pages: Pages, assessment: Assessment) -> None:
    """Write the checks but the clearances, which have a sheet; those that ask the same as one."""
    others = alike(check for check in assessment.checks if check.id != "clearance")
    rows = [_check_row(check, assessment.project.us_first) for check in others]
    write_live(
        pages,
        CheckRow,
        rows,
        "Checks",
        "Satisfied or not. The verdict on the project and on each array is on the sheet Summary.",
    )


def _check_row(check: Check, us_first: bool) -> CheckRow:
    found, limit = found_and_limit(check, us_first)
    return CheckRow.of(check, subject=check.subject or "Project", found=found, limit=limit)


def _spectra(spectra: Sequence[Spectra]) -> Mapping[str, Sequence[float]]:
    """Return one row for each period; targets and motions in columns, by component."""
    columns = {"Period [s]": spectra[0].periods_s.tolist()}
    for part in spectra:
        columns[f"{part.title}, target [g]"] = part.target_g.tolist()
        for name, row in zip(part.ids, part.sa_g, strict=True):
            columns[f"{part.title}, {name} [g]"] = row.tolist()
    return columns


_TOLERANCE = f"=MAX({DEFAULT.matters_m}/{INCH_M},{DEFAULT.matters_share}*{{design_m}})"
_DIFFERENCE = "={estimated_m}-{by_roofslip_m}"
_RESULT = '=IF({estimated_m}<={design_m}+{tolerance_m},"OK","NG")'


class LinkRunRow(SheetRow, LinkedRunResult):
    """A run as a row of blocks, and as one block."""

    sheet: ClassVar[str] = "LinkRuns"
    across: ClassVar[str] = (
        "array motion along polarity rigid_prd_m largest_m block prd_m stretch_m link_force_n"
        " error_m n_stops status"
    )
    key_columns: ClassVar[int] = 4

    array: Annotated[str, Column("Array")]
    largest_m: Annotated[Number, Column("PRD, row [in]")]
    block: Annotated[str, Column("Block with largest PRD")]


class LinkPeakRow(SheetRow):
    """The largest of all runs of a motion, below the arrays."""

    sheet: ClassVar[str] = "Links"

    array: Annotated[str, Column("Array")]
    motion: Annotated[str, Column("Motion")]
    rigid_m: Annotated[Number, Column("PRD, rigid [in]", 3, "=MAX({runs.rigid_prd_m})")]
    row_m: Annotated[Number, Column("PRD, row [in]", 3, "=MAX({runs.largest_m})")]


class LinkRow(SheetRow, LinkedResult):
    """The effect of links on the design displacement of an array."""

    sheet: ClassVar[str] = "Links"
    across: ClassVar[str] = (
        "array rigid_mean_m rigid_largest_m row_mean_m row_largest_m factor rigid_one_axis_m"
        " linked_one_axis_m ratio computed_m floor_m estimated_m design_m tolerance_m result"
        " by_roofslip_m difference"
    )
    last_printed: ClassVar[str] = "difference"

    rigid_mean_m: Annotated[Number, Column("Mean, rigid [in]", 3, "=AVERAGE({peaks.rigid_m})")]
    rigid_largest_m: Annotated[Number, Column("Largest, rigid [in]", 3, "=MAX({peaks.rigid_m})")]
    row_mean_m: Annotated[Number, Column("Mean, row [in]", 3, "=AVERAGE({peaks.row_m})")]
    row_largest_m: Annotated[Number, Column("Largest, row [in]", 3, "=MAX({peaks.row_m})")]
    factor: Annotated[float, Column("Analysis factor", 3, "={design.analysis_factor}")]
    computed_m: Annotated[Number, up_column("Computed [in]", 1, "={design.computed_m}")]
    floor_m: Annotated[float, up_column("Floor [in]", 1, "={design.floor_m}")]
    tolerance_m: Annotated[Number, Column("Tolerance [in]", 3, _TOLERANCE)]
    result: Annotated[str, Column("Verdict", formula=_RESULT)]
    by_roofslip_m: Annotated[Number, up_column("With links by Roofslip [in]", 1)]
    difference: Annotated[float, Column("Difference [in]", 4, _DIFFERENCE)] = 0.0


# What the row of an array has whose blocks do not come to rest.
_WITHOUT_VALUE = {"array", "estimated_m", "result"}


def link_run_rows(assessment: Assessment) -> Iterator[LinkRunRow]:
    """Yield each run of an array that is compared with a row of linked blocks."""
    for linked in assessment.linked:
        runs = [run for motion in linked.motions for run in motion.runs]
        for run, result in zip(runs, linked_result(linked).runs, strict=True):
            yield LinkRunRow.beside(
                result,
                array=linked.design.id,
                largest_m=run.prd_m,
                block="none" if math.isnan(run.prd_m) else str(run.block),
            )


def link_cells(assessment: Assessment, array_id: str) -> Sequence[str]:
    """Return the cells of the results of an array as a row of linked blocks."""
    return [
        fixed(LinkRow, "result", row)
        for row, linked in enumerate(assessment.linked, start=TOP)
        if linked.design.id == array_id
    ]


def write_links(pages: Pages, assessment: Assessment, designs: Mapping[str, Cells]) -> None:
    """Write the effect of links on the design displacement of each array, from sheet LinkRuns."""
    # Of the peaks of the motions, below the arrays.
    top = TOP + len(assessment.linked) + 2
    rows: list[LinkRow] = []
    peaks: list[LinkPeakRow] = []
    first_run = 2
    for linked in assessment.linked:
        first = top + len(peaks)
        for motion in linked.motions:
            runs = Cells(LinkRunRow, first_run, first_run + len(motion.runs) - 1)
            first_run += len(motion.runs)
            peaks.append(
                LinkPeakRow(
                    refs={"runs": runs},
                    array=linked.design.id,
                    motion=motion.motion.id,
                    rigid_m=motion.rigid_m,
                    row_m=motion.linked_m,
                )
            )
        of_array = Cells(LinkPeakRow, first, top + len(peaks) - 1, is_here=True)
        rows.append(_row(linked, {"peaks": of_array, "design": designs[linked.design.id]}))
    sheet = write_live(
        pages,
        LinkRow,
        rows,
        "Rows of linked blocks",
        "From the sheets LinkRuns and Design. Ratio: row / rigid, one axis. Design with links: "
        "max(max(1, ratio) x computed, floor).",
    )
    headings = [heading for _, heading, _ in columns_of(LinkPeakRow)]
    sheet.write_row(top - 2, 0, headings, pages.head)
    sheet.set_row(top - 2, 3 * LINE_PT)
    sheet.print_area(0, 0, top + len(peaks) - 2, printed_columns(LinkRow) - 1)
    write_rows(pages, sheet, top, peaks)


def _row(linked: LinkedArray, refs: Mapping[str, Cells]) -> LinkRow:
    design, rigid, row = linked.design, linked.rigid, linked.linked
    has_value = math.isfinite(linked.estimated_m)
    is_enough = has_value and linked.is_rigid_enough
    formulas = {}
    # A row that rests beside a block that rests: the ratio is 1, not 0 / 0.
    if not rigid.value_m > 0.0:
        formulas["ratio"] = "=1"
    if not (has_value and linked.is_final and design.is_permitted):
        formulas["result"] = ""
    names = {name for name, _, _ in columns_of(LinkRow)}
    return LinkRow.beside(
        linked_result(linked),
        refs=refs,
        formulas=formulas,
        blanks=set() if has_value else names - _WITHOUT_VALUE,
        # Without bound where the blocks slide and the single one does not.
        estimated_m=linked.estimated_m if has_value else math.nan,
        rigid_mean_m=rigid.mean_m,
        rigid_largest_m=rigid.largest_m,
        row_mean_m=row.mean_m,
        row_largest_m=row.largest_m,
        factor=rigid.factor,
        computed_m=design.analysis.value_m,
        floor_m=design.floor_m,
        tolerance_m=DEFAULT.bound_m(design.design_m),
        result="OK" if is_enough else "NG",
        by_roofslip_m=linked.estimated_m,
    )
