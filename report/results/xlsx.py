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

from report.assessment.project import Assessment
from report.assessment.spectra import Spectra
from report.motions.prepare import Shaking
from report.results.design import write_design
from report.results.directions import write_directions, write_peaks
from report.results.gaps import result_cells, write_clearances
from report.results.inputs import write_inputs
from report.results.links import link_cells, link_runs_table, write_links
from report.results.requirements import write_requirements
from report.results.sheets import DIRECTION_HEADINGS, Pages, print_on_letter
from report.sheet.schema import Direction
from report.words.units import G_MPS2
from solver.model import INCH_M


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
        sheets = ("Design", "Inputs", "Directions", "Clearances", "Requirements", "Peaks", *linked)
        for name in sheets:
            workbook.add_worksheet(name)
        _write_table(writer, runs, "Runs", pages)
        _write_table(writer, _motions_table(assessment.shaking), "Motions", pages)
        _write_table(writer, _records_table(assessment.shaking), "Records", pages)
        _write_table(writer, _spectra_table(spectra), "Spectra", pages)
        peaks = write_peaks(pages, assessment, runs)
        inputs = write_inputs(pages, assessment)
        results = {
            item.id: [*result_cells(assessment)[item.id], *link_cells(assessment, item.id)]
            for item in assessment.arrays
        }
        write_design(pages, assessment, peaks, inputs, results)
        write_requirements(pages, assessment)
        if assessment.linked:
            link_runs = link_runs_table(assessment)
            _write_table(writer, link_runs, "LinkRuns", pages)
            write_links(pages, assessment, link_runs)
        design_cells = write_directions(pages, assessment, peaks)
        write_clearances(pages, assessment, design_cells, inputs)
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
            "Component along slope": run.orientation.component,
            "Polarity": "as recorded" if run.orientation.polarity > 0 else "reversed",
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
            "Largest velocity [in/s]": run.result.peak_speed_mps / INCH_M,
            "Minimum N/(m g)": run.result.n_min_g,
            "Friction demand": run.solution.friction_demand,
            "Model": f"{int(run.solution.model)}, {run.solution.model.title}",
            "Reason": run.solution.reason,
            "Next model": f"{int(run.solution.next_model)}, {run.solution.next_model.title}",
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
    print_on_letter(sheet, 0)
    for column, heading in enumerate(table.columns):
        values = [str(heading)] if table.empty else [str(heading), *map(str, table[heading][:50])]
        is_number = pd.api.types.is_float_dtype(table[heading])
        width = 11 if is_number else min(max(map(len, values)) + 2, 66)
        sheet.set_column(column, column, width, pages.numbers[3] if is_number else None)
        sheet.write_string(0, column, str(heading), pages.head)
