"""results.json: the assessment and its evidence in SI units.

Computes nothing: the numbers come from `report.assessment.project`.
"""

from __future__ import annotations

import json
import math
from collections.abc import Iterable, Mapping
from dataclasses import asdict
from importlib.metadata import version
from typing import Any

from report.assessment.arrays import ArrayAssessment
from report.assessment.clearances import ClearanceCheck
from report.assessment.evidence import Evidence
from report.assessment.foresight import findings
from report.assessment.friction import mu_words
from report.assessment.links import LinkedArray
from report.assessment.project import Assessment
from report.assessment.runs import HeadingRun, MotionRun
from report.motions.components import RecordFile
from report.motions.history import PreparedMotion
from report.results.evidence import acceptance, certainty, cumulative, neighbor, remedy
from report.sheet.findings import Finding, located
from report.sheet.schema import Direction
from solver.building.roof import RoofMotion
from solver.model import Motion
from solver.rules.provisions import Check
from solver.sliding.tipping import Tipping
from solver.sliding.uplift import Uplift

SCHEMA_VERSION = 2
"""Raised where a key of results.json changes its name or meaning; 0.1 wrote none."""


def results_json(assessment: Assessment, evidence: Evidence) -> bytes:
    """Return everything as JSON in SI, with units in the keys and null for no value."""
    sheet, shaking, project = assessment.sheet, assessment.shaking, assessment.project
    document = {
        "schema_version": SCHEMA_VERSION,
        "roofslip_version": version("roofslip"),
        "workbook": {"name": sheet.path.name, "sha256": sheet.sha256},
        "records": [_record(record) for record in shaking.records],
        "motions": [_motion(*pair) for pair in zip(shaking.motions, shaking.prepared, strict=True)],
        "input": project.model_dump(mode="json"),
        "s_ds_g": project.site.s_ds,
        "sdc_is_confirmed": not project.site.sdc_lacks,
        "rule_set": assessment.rules.name,
        "verdict": assessment.verdict,
        "warnings": list(assessment.warnings),
        "findings": [_finding(*pair) for pair in _located_findings(assessment)],
        "building_checks": [_check(check) for check in assessment.building_checks],
        "requirements": [asdict(row) | {"verdict": row.verdict} for row in assessment.rows],
        "arrays": [_array(assessment, item) for item in assessment.arrays],
        "clearances": [_clearance(item) for item in assessment.clearances],
        "low_velocity": {
            "arrays": [_alone(item) for item in assessment.low_velocity.arrays],
            "clearances": [_clearance(gap) for gap in assessment.low_velocity.clearances.values()],
        },
        "linked": [_linked(item) for item in assessment.linked],
        "acceptance": [acceptance(row) for row in assessment.acceptance.rows],
        "neighbors": [neighbor(item) for item in assessment.neighbors],
        "remedies": [remedy(item) for item in evidence.remedies],
        "certainty": certainty(evidence.certainty),
        "cumulative": [cumulative(item) for item in evidence.cumulative],
    }
    return json.dumps(_nan_to_none(document), indent=1, ensure_ascii=False).encode() + b"\n"


def _located_findings(assessment: Assessment) -> Iterable[tuple[Finding, str]]:
    found = findings(assessment.sheet, assessment.shaking)
    return zip(found, located(found, assessment.sheet.addresses), strict=True)


def _finding(finding: Finding, cell: str) -> dict[str, Any]:
    return {
        "level": finding.level,
        "id": finding.id,
        "cell": cell,
        "text": finding.text,
        "reason": finding.reason,
    }


def _record(record: RecordFile) -> dict[str, Any]:
    return {
        "motion": record.motion_id,
        "component": record.component,
        "name": record.name,
        "format": record.format,
        "notes": list(record.notes),
        "sha256": record.sha256,
        "npts": record.npts,
        "dt_s": record.dt_s,
        "peak_g": record.peak_g,
    }


def _motion(motion: Motion, prepared: PreparedMotion) -> dict[str, Any]:
    return {
        "id": motion.id,
        "recorded_at": prepared.recorded_at,
        "processing": prepared.done,
        "scaling": prepared.scaling,
        "scale": motion.scale,
        "dt_s": motion.dt_s,
        "npts": len(motion.ax_mps2),
        "components": {name: asdict(values) for name, values in prepared.measures.items()},
        "building": {name: _roof(roof) for name, roof in prepared.roof.items()},
    }


def _roof(roof: RoofMotion) -> dict[str, Any]:
    return {
        "words": roof.building.words,
        "n_modes": roof.n_modes,
        "next_mode_share": roof.next_share,
        "left_out_share": roof.left_out_share,
        "ground_peak_mps2": roof.ground_peak_mps2,
        "roof_peak_mps2": roof.roof_peak_mps2,
        "pad_s": roof.pad_s,
    }


def _array(assessment: Assessment, item: ArrayAssessment) -> dict[str, Any]:
    return {
        "id": item.id,
        "verdict": assessment.array_verdict(item),
        "slope_rad": item.array.slope_rad,
        "mu": item.array.mu,
        "friction": asdict(item.array.friction),
        "friction_as_run": mu_words(item.array.friction),
        **_design(item),
        "model_asked_for": item.array.model,
        "model_is_enough": item.is_model_enough,
        "directions": {direction: _direction(item, direction) for direction in item.directions},
        "peaks": [_peaks(motion) for motion in item.motions],
        "peak_speed_mps": item.fastest_mps,
        "interconnection_n": item.interconnection_n,
        "tipping": _tipping(item.tipping),
        "uplift": _uplift(item.uplift),
        "route": item.route,
        "checks": [_check(check) for check in item.checks],
        "analysis_checks": [_check(check) for check in item.analysis_checks],
        "prescriptive_checks": [_check(check) for check in item.prescriptive_checks],
        "runs": [_run(motion, run) for motion in item.motions for run in motion.runs],
    }


def _design(item: ArrayAssessment) -> dict[str, Any]:
    return {
        "computed_m": item.analysis.value_m,
        "computed_basis": item.analysis.basis,
        "mean_prd_m": item.analysis.mean_m,
        "largest_prd_m": item.analysis.largest_m,
        "prd_variation": item.variation,
        "prescriptive_m": item.prescriptive.value_m,
        "prescriptive_governs": item.prescriptive.governs,
        "floor_m": item.floor_m,
        "design_m": item.design_m,
        "design_is_overridden": bool(item.design_mark),
        "design_governs": item.governs,
        "design_permitted": item.is_permitted,
    }


def _alone(item: ArrayAssessment) -> dict[str, Any]:
    """Return an array with its low-velocity coefficient alone."""
    return {"id": item.id, "mu": item.array.mu, **_design(item)}


def _direction(item: ArrayAssessment, direction: Direction) -> dict[str, Any]:
    analysis = item.directions[direction]
    return {
        "mean_m": analysis.mean_m,
        "largest_m": analysis.largest_m,
        "computed_m": analysis.value_m,
        "design_m": item.directional_m(direction),
        "design_by_chosen_model_m": item.chosen_toward_m(direction),
    }


def _peaks(motion: MotionRun) -> dict[str, Any]:
    peaks = {f"{direction.value}_m": motion.peak_m(direction) for direction in Direction}
    return {"motion": motion.motion.id, **peaks}


def _tipping(item: Tipping) -> dict[str, Any]:
    return {
        "demand": item.demand,
        "capacity": item.capacity,
        "held_ratio": item.at_rest_ratio,
        "sliding_ratio": item.sliding_ratio,
        "ok": item.is_ok,
    }


def _uplift(item: Uplift) -> dict[str, Any]:
    return {
        "n_min_g": item.n_min_g,
        "t_first_s": item.t_first_s,
        "duration_s": item.duration_s,
        "times": item.times,
    }


def _run(motion: MotionRun, run: HeadingRun) -> dict[str, Any]:
    return {
        "motion": motion.motion.id,
        "along": run.heading.component,
        "polarity": run.heading.sign,
        "scale": motion.motion.scale,
        "dt_s": motion.motion.dt_s,
        **asdict(run.result),
        "rung": int(run.solution.rung),
        "model": run.solution.rung.title,
        "reason": run.solution.reason,
        "next_rung": int(run.solution.next_rung),
        "next_effect_m": run.solution.next_effect_m,
        "error_m": run.result.error_m,
        "friction_demand": run.solution.friction_demand,
    }


def _clearance(item: ClearanceCheck) -> dict[str, Any]:
    return {
        "array": item.clearance.array,
        "object": item.clearance.object,
        "direction": item.clearance.direction,
        "neighbor": item.neighbor,
        "governing_array": item.governing_array,
        "governing_direction": item.governing_direction,
        "design_m": item.design_m,
        "importance": item.importance,
        "factor": item.factor,
        "required_m": item.required_m,
        "required_is_overridden": bool(item.mark),
        "provided_m": item.clearance.provided_m,
        "demand_capacity": item.demand_capacity,
        "verdict": item.verdict,
    }


def _linked(item: LinkedArray) -> dict[str, Any]:
    return {
        "array": item.design.id,
        "mus": item.row.mus,
        "stiffness_n_per_m": item.links.stiffness_n_per_m,
        "damping_ratio": item.links.damping_ratio,
        "rigid_one_axis_m": item.rigid.value_m,
        "linked_one_axis_m": item.linked.value_m,
        "ratio": item.ratio,
        "design_m": item.design.design_m,
        "estimated_m": item.estimated_m,
        "link_force_n": item.link_force_n,
        "rigid_is_enough": item.is_rigid_enough,
        "runs": [
            {
                "motion": motion.motion.id,
                "along": run.heading.component,
                "polarity": run.heading.sign,
                "status": run.row.status,
                "rigid_status": run.rigid.status,
                "rigid_prd_m": run.rigid.prd_m,
                "prd_m": run.row.prd_m,
                "residual_m": run.row.residual_m,
                "stretch_m": run.row.stretch_m,
                "link_force_n": run.row.link_force * item.block_n,
                "error_m": run.row.error_m,
                "n_stops": run.row.n_stops,
            }
            for motion in item.motions
            for run in motion.runs
        ],
    }


def _check(check: Check) -> dict[str, Any]:
    unit = {"deg": "_deg", "m": "_m", "count": "", "": ""}[check.measure]
    return {
        "title": check.title,
        f"found{unit}": check.value,
        f"limit{unit}": check.limit,
        "clause": check.provision.clause,
        "is_overridden": bool(check.provision.reason),
        "ok": check.ok,
        "by_exception": check.passes_by_exception,
    }


def _nan_to_none(value: Any) -> Any:
    """Return the document with null for every NaN or infinity, which JSON does not have."""
    if isinstance(value, float):
        return value if math.isfinite(value) else None
    if isinstance(value, Mapping):
        return {key: _nan_to_none(item) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [_nan_to_none(item) for item in value]
    return value
