"""results.xlsx: the tables, and live formulas from the peaks to the separations.

Computes nothing: each formula is written with the value from `report.assessment.project`, and that
value is repeated beside it as a number, so that a checker can trace, change and compare it.
"""

from __future__ import annotations

import datetime as dt
import io
import math
from collections.abc import Sequence
from typing import Any

import pandas as pd
from xlsxwriter.workbook import Workbook
from xlsxwriter.worksheet import Worksheet

from report.assessment.arrays import ArrayAssessment, Route
from report.assessment.clearances import ClearanceCheck
from report.assessment.project import Assessment
from report.assessment.spectra import Spectra
from report.motions.prepare import Shaking
from report.results.directions import DirectionCells, PeakRanges, write_directions, write_peaks
from report.results.links import link_runs_table, write_links
from report.results.requirements import write_requirements
from report.results.sheets import DIRECTION_HEADINGS, Pages, write_headings
from report.sheet.schema import Direction
from report.words.units import G_MPS2
from solver.model import INCH_M
from solver.rules.provisions import Basis, PrescriptiveBasis


def results_xlsx(assessment: Assessment, spectra: Sequence[Spectra]) -> bytes:
    """Return the tables as a workbook, with live formulas from the peaks to the separations."""
    buffer = io.BytesIO()
    # Text from an untrusted workbook stays text, even if it starts with =.
    options = {"strings_to_formulas": False, "strings_to_urls": False, "nan_inf_to_errors": True}
    with pd.ExcelWriter(buffer, engine="xlsxwriter", engine_kwargs={"options": options}) as writer:
        workbook: Workbook = writer.book
        pages = Pages(workbook)
        runs = _runs_table(assessment)
        linked = ("Links",) if assessment.linked else ()
        for name in ("Design", "Directions", "Clearances", "Requirements", "Peaks", *linked):
            workbook.add_worksheet(name)
        _write_table(writer, runs, "Runs", pages)
        _write_table(writer, _motions_table(assessment.shaking), "Motions", pages)
        _write_table(writer, _records_table(assessment.shaking), "Records", pages)
        _write_table(writer, _spectra_table(spectra), "Spectra", pages)
        peaks = write_peaks(pages, assessment, runs)
        _write_design(pages, assessment, peaks)
        write_requirements(pages, assessment)
        if assessment.linked:
            link_runs = link_runs_table(assessment)
            _write_table(writer, link_runs, "LinkRuns", pages)
            write_links(pages, assessment, link_runs)
        _write_clearances(pages, assessment, write_directions(pages, assessment, peaks))
        workbook.set_calc_mode("auto")
        # Two runs give the same bytes: the date is that of the project, not the current date.
        workbook.set_properties(
            {"created": dt.datetime.combine(assessment.project.project.date, dt.time())}
        )
    return buffer.getvalue()


def _runs_table(assessment: Assessment) -> pd.DataFrame:
    """One row for each array, motion and run, arrays together."""
    return pd.DataFrame(
        {
            "Array": item.id,
            "Motion": motion.motion.id,
            "Component along slope": run.heading.component,
            "Polarity": "as recorded" if run.heading.sign > 0 else "reversed",
            "Governs": "yes" if run is motion.governing else "",
            "Scale": motion.motion.scale,
            "PRD [in]": run.prd_m / INCH_M,
            "PRD [mm]": run.prd_m * 1e3,
            "PRD / mean": _over(run.prd_m, item.analysis.mean_m),
            "Residual [in]": run.result.residual_m / INCH_M,
            "Residual [mm]": run.result.residual_m * 1e3,
            "Residual cross-slope [in]": run.result.residual_across_m / INCH_M,
            **{
                DIRECTION_HEADINGS[direction]: run.excursion_m(direction) / INCH_M
                for direction in (Direction.DOWN, Direction.UP, Direction.ACROSS)
            },
            "Time of PRD [s]": run.result.t_prd_s,
            "Stops": run.result.n_stops,
            "Minimum N/(m g)": run.result.n_min_g,
            "Friction demand": run.solution.friction_demand,
            "Model": f"{int(run.solution.rung)}, {run.solution.rung.title}",
            "Reason": run.solution.reason,
            "Next model": f"{int(run.solution.next_rung)}, {run.solution.next_rung.title}",
            "Effect of next model [in]": run.solution.next_effect_m / INCH_M,
            "Error bound [in]": run.result.error_m / INCH_M,
            "Outcome": run.result.status.sentence,
        }
        for item in assessment.arrays
        for motion in item.motions
        for run in motion.runs
    )


def _over(value: float, mean: float) -> float:
    return value / mean if mean > 0.0 else math.nan


def _records_table(shaking: Shaking) -> pd.DataFrame:
    return pd.DataFrame(
        {
            "Motion": record.motion_id,
            "Component": record.component,
            "Record": record.name,
            "Format": record.format,
            "Samples": record.npts,
            "Time step [s]": record.dt_s,
            "Peak [g]": record.peak_g,
            "SHA-256": record.sha256,
        }
        for record in shaking.records
    )


def _motions_table(shaking: Shaking) -> pd.DataFrame:
    """One row for each component of a motion, processed and scaled, at the recording level."""
    return pd.DataFrame(
        {
            "Motion": motion.id,
            "Component": name,
            "Recorded at": prepared.recorded_at.value,
            "Processing": prepared.done,
            "Scaling": prepared.scaling,
            "Factor": motion.scale,
            "PGA [g]": values.pga_mps2 / G_MPS2,
            "PGV [m/s]": values.pgv_mps,
            "PGD [m]": values.pgd_m,
            "Arias intensity [m/s]": values.arias_mps,
            "Duration 5-95 % [s]": values.d5_95_s,
            "Velocity at end [m/s]": values.final_velocity_mps,
            "Displacement at end [m]": values.final_displacement_m,
        }
        for motion, prepared in zip(shaking.motions, shaking.prepared, strict=True)
        for name, values in prepared.measures.items()
    )


def _spectra_table(spectra: Sequence[Spectra]) -> pd.DataFrame:
    """One row for each period; targets and motions in columns, by component."""
    columns = {"Period [s]": spectra[0].periods_s}
    for part in spectra:
        columns[f"{part.title}, target [g]"] = part.target_g
        columns |= {
            f"{part.title}, {name} [g]": row for name, row in zip(part.ids, part.sa_g, strict=True)
        }
    return pd.DataFrame(columns)


def _write_table(writer: Any, table: pd.DataFrame, name: str, pages: Pages) -> None:
    table.to_excel(writer, sheet_name=name, index=False, na_rep="none")
    sheet: Worksheet = writer.sheets[name]
    sheet.freeze_panes(1, 0)
    for column, heading in enumerate(table.columns):
        values = [str(heading)] if table.empty else [str(heading), *map(str, table[heading][:50])]
        is_number = pd.api.types.is_float_dtype(table[heading])
        width = 11 if is_number else min(max(map(len, values)) + 2, 66)
        sheet.set_column(column, column, width, pages.numbers[3] if is_number else None)
        sheet.write_string(0, column, str(heading), pages.head)


_DESIGN_HEADINGS = (
    "Array", "S_DS [g]", "Factor [in]", "I_e in displacement", "Minimum [in]",
    "Prescriptive [in]", "Number of motions", "Mean PRD [in]", "Largest PRD [in]",
    "Analysis factor", "Computed [in]", "Floor / prescriptive", "Floor [in]", "Design [in]",
    "Design [mm]", "Design / prescriptive", "Design by Roofslip [in]", "Difference [in]", "Verdict",
)  # fmt: skip


def _write_design(pages: Pages, assessment: Assessment, peaks: PeakRanges) -> None:
    """Write the design displacement of each array as formulas."""
    sheet = pages.sheet(
        "Design",
        "Design displacement",
        f"{assessment.rules.name}. From the sheet Peaks, any direction. Change a number to see "
        "its effect. The sheet Directions continues from here.",
    )
    sheet.write_string(2, 0, "Verdict", pages.head)
    sheet.write_string(2, 1, assessment.verdict.value, pages.head)
    write_headings(pages, sheet, 3, _DESIGN_HEADINGS)
    for row, item in enumerate(assessment.arrays, start=4):
        peak_range = peaks[item.id, Direction.ANY]
        _write_design_row(pages, sheet, row, assessment, item, peak_range)


def _write_design_row(
    pages: Pages,
    sheet: Worksheet,
    row: int,
    assessment: Assessment,
    item: ArrayAssessment,
    peaks: str,
) -> None:
    rules, analysis, prescriptive = assessment.rules, item.analysis, item.prescriptive
    flat = prescriptive.governs is PrescriptiveBasis.LOW_CATEGORY
    importance = 1.0 if rules.importance_in_separation else assessment.project.site.i_e
    r = row + 1
    statistic = "I" if analysis.basis is Basis.LARGEST_FACTORED else "H"
    floor_share = 0.0 if assessment.project.options.peer_reviewed else rules["analysis_floor"]
    governing = f"F{r},I{r}" if item.route is Route.PRESCRIPTIVE else f"K{r},M{r}"
    no_value = math.isnan(item.design_m)
    inch = INCH_M
    sheet.write_string(row, 0, item.id)
    sheet.write_string(row, 18, assessment.array_verdict(item).value)
    sheet.write_number(row, 1, assessment.project.site.s_ds, pages.numbers[4])
    # The constant value for SDC A, B and C replaces the formula.
    sheet.write_number(row, 2, 0.0 if flat else rules["prescriptive_factor_in"], pages.numbers[1])
    sheet.write_number(row, 3, importance, pages.numbers[2])
    sheet.write_number(row, 4, prescriptive.minimum_m / inch, pages.numbers[1])
    formulas: list[tuple[int, str, float, int]] = [
        (5, f"=MAX(C{r}*D{r}*MAX(B{r}-0.4,0)^2,E{r})", prescriptive.value_m / inch, 1),
        (6, f"=COUNT({peaks})", analysis.n_motions, 1),
        (7, f"=AVERAGE({peaks})", analysis.mean_m / inch, 2),
        (8, f"=MAX({peaks})", analysis.largest_m / inch, 2),
        (12, f"=L{r}*F{r}", item.floor_m / inch, 2),
    ]
    if no_value:
        formulas = [formulas[0], formulas[4]]
        for column in (7, 8, 10, 13, 14, 15):
            sheet.write_string(row, column, "none")
    else:
        formulas += [
            (13, f"=MAX({governing})", item.design_m / inch, 2),
            (14, f"=N{r}*25.4", item.design_m * 1e3, 1),
            (15, f"=N{r}/F{r}", item.ratio, 3),
            (17, f"=N{r}-Q{r}", 0.0, 4),
        ]
        if math.isnan(analysis.value_m):
            sheet.write_string(row, 10, "none")
        else:
            formulas.append((10, f"=J{r}*{statistic}{r}", analysis.value_m / inch, 2))
        sheet.write_number(row, 16, item.design_m / inch, pages.numbers[2])
    sheet.write_number(row, 9, analysis.factor, pages.numbers[2])
    sheet.write_number(row, 11, floor_share, pages.numbers[2])
    for column, formula, value, decimals in formulas:
        sheet.write_formula(row, column, formula, pages.numbers[decimals], value)


_CLEARANCE_HEADINGS = (
    "Array", "Object", "Direction", "Condition", "Governing array, direction", "Design [in]",
    "Factor", "Minimum [in]", "Required [in]", "Required [mm]", "Provided [in]", "D/C", "Result",
    "Required by Roofslip [in]", "Difference [in]",
)  # fmt: skip


def _write_clearances(pages: Pages, assessment: Assessment, design_cells: DirectionCells) -> None:
    sheet = pages.sheet(
        "Clearances",
        "Clearances",
        f"{assessment.rules.name}. The factor includes I_e if the rule set applies it here.",
    )
    write_headings(pages, sheet, 3, _CLEARANCE_HEADINGS)
    for row, item in enumerate(assessment.clearances, start=4):
        _write_clearance_row(pages, sheet, row, assessment, item, design_cells)


def _write_clearance_row(
    pages: Pages,
    sheet: Worksheet,
    row: int,
    assessment: Assessment,
    item: ClearanceCheck,
    design_cells: DirectionCells,
) -> None:
    clearance, inch, r = item.clearance, INCH_M, row + 1
    texts = (
        clearance.array, clearance.object, clearance.direction, item.neighbor,
        f"{item.governing_array}, {item.governing_direction.value}",
    )  # fmt: skip
    for column, text in enumerate(texts):
        sheet.write_string(row, column, text)
    sheet.write_number(row, 6, item.factor, pages.numbers[2])
    sheet.write_number(row, 7, item.least_m / inch, pages.numbers[1])
    sheet.write_number(row, 10, clearance.provided_m / inch, pages.numbers[1])
    if math.isnan(item.required_m):
        for column in (5, 8, 9, 11):
            sheet.write_string(row, column, "none")
        sheet.write_string(row, 12, "NG")
        return
    design = design_cells[item.governing_array, item.governing_direction]
    numbers = [
        (5, f"={design}", item.design_m / inch, 2),
        (8, f"=MAX(F{r}*G{r},H{r})", item.required_m / inch, 2),
        (9, f"=I{r}*25.4", item.required_m * 1e3, 1),
        (14, f"=I{r}-N{r}", 0.0, 4),
    ]
    if clearance.provided_m > 0.0:
        numbers.append((11, f"=I{r}/K{r}", item.demand_capacity, 3))
    for column, formula, value, decimals in numbers:
        sheet.write_formula(row, column, formula, pages.numbers[decimals], value)
    result = "OK" if item.ok else "NG"
    sheet.write_formula(row, 12, f'=IF(I{r}<=K{r},"OK","NG")', pages.plain, result)
    sheet.write_number(row, 13, item.required_m / inch, pages.numbers[2])
