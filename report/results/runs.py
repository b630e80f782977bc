"""The sheets Runs, Motions and Records of results.xlsx: one row for each.

Computes nothing. Read `report.results.xlsx`.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import asdict
from typing import Annotated, ClassVar

from report.assessment.project import Assessment
from report.entities.cells import Column
from report.entities.motion import MotionResult, motion_result
from report.entities.run import RunResult, run_result
from report.entities.shown import Number
from report.motions.prepare import Shaking
from report.results.sheets import SheetRow
from report.sheet.schema import Direction
from report.words.units import G_MPS2


class RunRow(SheetRow, RunResult):
    """A run of an array; without a displacement where it does not come to rest."""

    sheet: ClassVar[str] = "Runs"
    across: ClassVar[str] = (
        "array motion along polarity governs scale prd_m over_mean residual_m residual_across_m"
        " down_m up_m across_m t_prd_s n_stops peak_speed_mps n_min_g friction_demand rung reason"
        " next_rung next_effect_m error_m status"
    )

    array: Annotated[str, Column("Array")]
    governs: Annotated[str, Column("Governs")]
    over_mean: Annotated[Number, Column("PRD / mean")]


class MotionRow(SheetRow, MotionResult):
    """A component of a motion, processed and scaled, at the recording level."""

    sheet: ClassVar[str] = "Motions"
    across: ClassVar[str] = "id component"

    component: Annotated[str, Column("Component")]
    pga_g: Annotated[float, Column("PGA [g]")]
    pgv_mps: Annotated[float, Column("PGV [m/s]")]
    pgd_m: Annotated[float, Column("PGD [m]")]
    arias_mps: Annotated[float, Column("Arias intensity [m/s]")]
    d5_95_s: Annotated[float, Column("Duration 5-95 % [s]")]
    final_velocity_mps: Annotated[float, Column("Velocity at end [m/s]")]
    final_displacement_m: Annotated[float, Column("Displacement at end [m]")]


def run_rows(assessment: Assessment) -> Iterator[RunRow]:
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


def motion_rows(shaking: Shaking) -> Iterator[MotionRow]:
    """Yield the components of each motion."""
    for motion, prepared in zip(shaking.motions, shaking.prepared, strict=True):
        row = motion_result(motion, prepared)
        for name, measures in row.components.items():
            yield MotionRow.beside(
                row,
                component=name,
                pga_g=measures.pga_mps2 / G_MPS2,
                **asdict(measures),
            )
