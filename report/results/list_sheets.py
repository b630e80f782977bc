"""The lists of results.xlsx: runs, motions, records, spectra, adjacent items, checks, as printed.

Computes nothing. Read `report.results.xlsx`.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from operator import attrgetter

from report.assessment.assessment import Assessment
from report.assessment.checks.check import Check
from report.assessment.checks.sentence import alike, found_and_limit
from report.assessment.design.arrays import ArrayAssessment
from report.assessment.design.linked_blocks import LinkedRun
from report.assessment.support.response_spectra import Spectra
from report.motions.history import PreparedMotion
from report.motions.prepare import Shaking
from report.project.model.choices import Direction
from report.results.sheet_columns import (
    SheetColumn,
    SheetLayout,
    SheetRow,
    up_column,
    write_list,
    write_live,
    write_table,
)
from report.results.sheet_pages import Pages
from report.runs import MotionRun, OrientedRun
from report.text.units import G_MPS2, Rounding
from solver.model import Motion
from solver.records.measures import Measures
from solver.sliding.model_selection import Model


@dataclass(frozen=True, slots=True, kw_only=True)
class _Run:
    """A run of an array; without a displacement if it does not come to rest."""

    array: ArrayAssessment
    motion: MotionRun
    run: OrientedRun

    @property
    def over_mean(self) -> float:
        """PRD / mean of the array; NaN without one."""
        mean_m = self.array.analysis.mean_m
        return self.run.prd_m / mean_m if mean_m > 0.0 else math.nan


def polarity_text(run: OrientedRun | LinkedRun) -> str:
    """Return the polarity of a run as printed."""
    return "as recorded" if run.orientation.polarity > 0 else "reversed"


def _model(rung: int) -> str:
    return f"{rung}, {Model(rung).title}"


RUNS = SheetLayout(
    "Runs",
    (
        SheetColumn("array", "Array", lambda row: row.array.id),
        SheetColumn("motion", "Motion", lambda row: row.motion.motion.id),
        SheetColumn("along", "Component along slope", lambda row: row.run.orientation.component),
        SheetColumn("polarity", "Polarity", lambda row: polarity_text(row.run)),
        # By identity: two runs of a symmetric motion may be equal.
        SheetColumn("governs", "Governs",
            lambda row: "yes" if row.run is row.motion.governing else ""),
        SheetColumn("scale", "Scale", lambda row: row.run.scene.scale),
        SheetColumn("prd_m", "PRD [in]", lambda row: row.run.prd_m),
        SheetColumn("prd_m", "PRD [mm]", lambda row: row.run.prd_m),
        SheetColumn("over_mean", "PRD / mean", lambda row: row.over_mean),
        SheetColumn("residual_m", "Residual [in]", lambda row: row.run.result.residual_m),
        SheetColumn("residual_m", "Residual [mm]", lambda row: row.run.result.residual_m),
        SheetColumn("residual_across_m", "Residual cross-slope [in]",
            lambda row: row.run.result.residual_across_m),
        SheetColumn("down_m", "Downslope [in]", lambda row: row.run.excursion_m(Direction.DOWN)),
        SheetColumn("up_m", "Upslope [in]", lambda row: row.run.excursion_m(Direction.UP)),
        SheetColumn("across_m", "Cross-slope [in]",
            lambda row: row.run.excursion_m(Direction.ACROSS)),
        SheetColumn("t_prd_s", "Time of PRD [s]", lambda row: row.run.result.t_prd_s),
        SheetColumn("n_stops", "Stops", lambda row: row.run.result.n_stops),
        SheetColumn("peak_speed_mps", "Peak velocity [in/s]",
            lambda row: row.run.result.peak_speed_mps),
        SheetColumn("n_min_g", "Minimum N/W", lambda row: row.run.result.n_min_g),
        SheetColumn("friction_demand", "Friction demand",
            lambda row: row.run.solution.friction_demand),
        SheetColumn("rung", "Model", lambda row: _model(row.run.solution.model)),
        SheetColumn("reason", "Reason for model", lambda row: row.run.solution.reason),
        SheetColumn("next_rung", "More complete model",
            lambda row: _model(row.run.solution.next_model)),
        SheetColumn("next_effect_m", "Effect of more complete model [in]",
            lambda row: row.run.solution.next_effect_m),
        SheetColumn("error_m", "Error bound [in]", lambda row: row.run.result.error_m),
        SheetColumn("status", "Outcome", lambda row: row.run.result.status.sentence),
    ),
    key_columns=4,
)  # fmt: skip


@dataclass(frozen=True, slots=True, kw_only=True)
class _Component:
    """A component of a motion, processed and scaled, at the recording level."""

    motion: Motion
    prepared: PreparedMotion
    name: str
    measures: Measures


_MOTIONS = (
    SheetColumn("id", "Motion", lambda row: row.motion.id),
    SheetColumn("component", "Component", lambda row: row.name),
    SheetColumn("recorded_at", "Recorded at", lambda row: row.prepared.recorded_at),
    SheetColumn("processing", "Processing", lambda row: row.prepared.done),
    SheetColumn("scaling", "Scaling", lambda row: row.prepared.scaling),
    SheetColumn("scale", "Factor", lambda row: row.motion.scale),
    SheetColumn("pga_g", "PGA [g]", lambda row: row.measures.pga_mps2 / G_MPS2),
    SheetColumn("pgv_mps", "PGV [m/s]", lambda row: row.measures.pgv_mps),
    SheetColumn("pgd_m", "PGD [m]", lambda row: row.measures.pgd_m),
    SheetColumn("arias_mps", "Arias intensity [m/s]", lambda row: row.measures.arias_mps),
    SheetColumn("d5_95_s", "Duration 5-95% [s]", lambda row: row.measures.d5_95_s),
    SheetColumn("final_velocity_mps", "Final velocity [m/s]",
        lambda row: row.measures.final_velocity_mps),
    SheetColumn("final_displacement_m", "Final displacement [m]",
        lambda row: row.measures.final_displacement_m),
)  # fmt: skip

_RECORDS = (
    SheetColumn("motion", "Motion", attrgetter("motion_id")),
    SheetColumn("component", "Component", attrgetter("component")),
    SheetColumn("name", "Record", attrgetter("name")),
    SheetColumn("format", "Format", attrgetter("format")),
    SheetColumn("npts", "Samples", attrgetter("npts")),
    SheetColumn("dt_s", "Time step [s]", attrgetter("dt_s")),
    SheetColumn("peak_g", "Peak [g]", attrgetter("peak_g")),
    SheetColumn("sha256", "SHA-256", attrgetter("sha256")),
)  # fmt: skip


_NEIGHBORS = (
    SheetColumn("array", "Array", attrgetter("array")),
    SheetColumn("other", "Adjacent item", attrgetter("other")),
    SheetColumn("what", "Type", attrgetter("what")),
    SheetColumn("gap_m", "Distance in plan [in]", attrgetter("gap_m"), 1, rounding=Rounding.DOWN),
    up_column("reach_m", "Twice the design displacement [in]", attrgetter("reach_m"), 1),
    SheetColumn("given", "Clearance", attrgetter("numbers")),
    SheetColumn("cover", "Remark", attrgetter("cover")),
)  # fmt: skip


def write_lists(pages: Pages, assessment: Assessment, spectra: Sequence[Spectra]) -> None:
    """Write the runs, the components of the motions, the records, spectra and adjacent items."""
    shaking = assessment.shaking
    if assessment.has_motions:
        runs = []
        for item in assessment.arrays:
            for motion in item.motions:
                runs += [_Run(array=item, motion=motion, run=run) for run in motion.runs]
        write_list(pages, RUNS.sheet, RUNS.own, runs, RUNS.key_columns, is_printed=False)
        write_list(pages, "Motions", _MOTIONS, list(_components(shaking)), keys=2)
        write_list(pages, "Records", _RECORDS, shaking.records)
        write_table(pages, "Spectra", _spectra(spectra), is_printed=False)
    if assessment.neighbors:
        write_list(pages, "Adjacent items", _NEIGHBORS, assessment.neighbors)


def _components(shaking: Shaking) -> Iterator[_Component]:
    for motion, prepared in zip(shaking.motions, shaking.prepared, strict=True):
        for name, measures in prepared.measures.items():
            yield _Component(motion=motion, prepared=prepared, name=name, measures=measures)


@dataclass(frozen=True, slots=True, kw_only=True)
class _CheckTexts:
    """A check, or identical checks combined, with the printed values found and required."""

    check: Check
    found: str
    limit: str


_CHECKS = SheetLayout(
    "Requirements",
    (
        SheetColumn("subject", "Item", lambda row: row.check.subject or "Project"),
        SheetColumn("title", "Requirement", lambda row: row.check.title),
        SheetColumn("found", "Found", lambda row: row.found),
        SheetColumn("limit", "Required", lambda row: row.limit),
        SheetColumn("clause", "Basis", lambda row: row.check.clause),
        SheetColumn("verdict", "Verdict", lambda row: row.check.verdict),
        SheetColumn("to_close", "Action", lambda row: row.check.to_close),
    ),
)  # fmt: skip


def write_requirements(pages: Pages, assessment: Assessment) -> None:
    """Write the checks except clearances, which have a worksheet; identical ones are combined."""
    rows = []
    for check in alike(check for check in assessment.checks if check.id != "clearance"):
        found_text, limit = found_and_limit(check, assessment.project.us_first)
        rows.append(SheetRow(item=_CheckTexts(check=check, found=found_text, limit=limit)))
    write_live(
        pages,
        _CHECKS,
        rows,
        "Checks",
        "The verdict on the project and on each array is on the Summary worksheet.",
    )


def _spectra(spectra: Sequence[Spectra]) -> Mapping[str, Sequence[float]]:
    """Return one row for each period; targets and motions in columns, by component."""
    columns = {"Period [s]": spectra[0].periods_s.tolist()}
    for part in spectra:
        columns[f"{part.title}, target [g]"] = part.target_g.tolist()
        for name, row in zip(part.ids, part.sa_g, strict=True):
            columns[f"{part.title}, {name} [g]"] = row.tolist()
    return columns
