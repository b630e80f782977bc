"""The sheets of results.xlsx without formulas: Runs, Motions, Neighbors, Requirements and more.

Computes nothing. Read `report.results.xlsx`.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict
from typing import Annotated, ClassVar

from report.assessment.overrides import OVERRIDDEN
from report.assessment.precheck import limit_value
from report.assessment.project import Assessment
from report.assessment.spectra import Spectra
from report.entities.cells import Column
from report.entities.evidence import NeighborResult
from report.entities.motion import MotionResult, RecordResult, motion_result
from report.entities.requirement import RequirementRow, requirement_rows
from report.entities.run import RunResult, run_result
from report.entities.shown import Number
from report.motions.prepare import Shaking
from report.results.sheets import Pages, SheetRow, write_list, write_live, write_table
from report.sheet.schema.choices import Direction
from report.words.units import G_MPS2
from solver.rules.limit import Limit, Measure


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
        write_list(pages, RunRow.sheet, list(_runs(assessment)))
        write_list(pages, MotionRow.sheet, list(_motions(shaking)))
        write_list(pages, "Records", list(map(RecordResult.of, shaking.records)))
        write_table(pages, "Spectra", _spectra(spectra))
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
                row,
                component=name,
                pga_g=measures.pga_mps2 / G_MPS2,
                **asdict(measures),
            )


class RequirementLine(SheetRow, RequirementRow):
    """A requirement or a limit as a row of the sheet."""

    sheet: ClassVar[str] = "Requirements"


def write_requirements(pages: Pages, assessment: Assessment) -> None:
    """Write each requirement of the project and each limit of the rule set and on the motions."""
    write_live(
        pages,
        RequirementLine,
        list(map(RequirementLine.beside, _rows(assessment))),
        "Requirements and limits",
        "Satisfied or not. The verdict on the project and on each array is on the sheet Design.",
    )


def _rows(assessment: Assessment) -> Iterator[RequirementRow]:
    for check in assessment.building_checks:
        yield _limit(assessment, "Building", check)
    for item in assessment.arrays:
        for check in item.limits:
            yield _limit(assessment, item.id, check)
    for check in assessment.acceptance.rows:
        yield _limit(assessment, "Motions", check)
    yield from requirement_rows(assessment.rows)


def _limit(assessment: Assessment, item: str, row: Limit) -> RequirementRow:
    found, limit = (
        limit_value(row, value, assessment.project.us_first)
        if row.measure is Measure.LENGTH_M
        else f"{value:.6g} {row.measure.unit}".rstrip()
        for value in (row.found, row.limit)
    )
    is_excepted = row.passes_by_exception
    return RequirementRow(
        subject=item,
        title=row.title,
        found=found + (f" ({row.worst})" if row.worst else ""),
        limit=f"{row.sign} {limit}{OVERRIDDEN if row.provision.reason else ''}",
        basis=row.provision.clause,
        verdict=assessment.limit_verdict(row),
        remedy=f"over the limit, permitted: {row.provision.note}" if is_excepted else "",
    )


def _spectra(spectra: Sequence[Spectra]) -> Mapping[str, Sequence[float]]:
    """Return one row for each period; targets and motions in columns, by component."""
    columns = {"Period [s]": spectra[0].periods_s.tolist()}
    for part in spectra:
        columns[f"{part.title}, target [g]"] = part.target_g.tolist()
        for name, row in zip(part.ids, part.sa_g, strict=True):
            columns[f"{part.title}, {name} [g]"] = row.tolist()
    return columns
