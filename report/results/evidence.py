"""What results.json has of the evidence: what would do, how sure, neighbors, limits on motions.

Computes nothing. Read `remedy`, `certainty`, `neighbor` and `acceptance`, each one key.
"""

from __future__ import annotations

from typing import Any

from report.assessment.certainty import Certainty, Margin
from report.assessment.cumulative import Cumulative
from report.assessment.neighbors import PlanNeighbor
from report.assessment.remedies import Remedy, RemedyKind
from solver.records.acceptance_row import AcceptanceRow

_UNITS = {RemedyKind.FRICTION: "", RemedyKind.SEPARATION: "_m", RemedyKind.S_DS: "_g"}


def remedy(item: Remedy) -> dict[str, Any]:
    """Return a remedy, with the unit of its quantity in the keys."""
    unit = _UNITS[item.kind]
    return {
        "quantity": item.kind,
        "clearance": f"{item.clearance}" if item.clearance else None,
        "array": item.array,
        "exists": item.exists,
        f"given{unit}": item.given,
        f"value{unit}": item.value,
        f"resolution{unit}": item.resolution,
        f"verified{unit}": item.verified,
        "n_values": item.n_values,
        "basis": item.basis,
    }


def certainty(item: Certainty) -> dict[str, Any]:
    """Return the grid over friction and slope, the margins, and the directions that are not run."""
    surface = item.surface
    return {
        "surface": {
            "array": surface.array.id,
            "mus": surface.mus.tolist(),
            "slopes_rad": surface.slopes_rad.tolist(),
            "mean_prd_m": surface.mean_m.tolist(),
            "n_unfinished": surface.n_unfinished,
            "n_runs": surface.n_runs,
        },
        "margins": [_margin(margin) for margin in item.margins],
        "angles": {
            "motion": item.motion.motion.id,
            "prd_m": item.motion.governing.result.prd_m,
            "turned": [
                {
                    "angle_deg": run.angle_deg,
                    "prd_m": run.result.prd_m,
                    "status": run.result.status,
                }
                for run in item.turned
            ],
            "vertical_reversed_prd_m": item.reversed_m,
        },
    }


def _margin(item: Margin) -> dict[str, Any]:
    return {
        "clearance": f"{item.number}",
        "array": item.array.id,
        "mu": item.array.array.mu,
        "least_mu": item.least_mu,
        "lowest_mu_tried": item.lowest_tried,
        "is_beyond": item.is_beyond,
        "required_m": item.required_m,
    }


def cumulative(item: Cumulative) -> dict[str, Any]:
    """Return the sums of the PRDs of the design event and of the smaller ones, by motion."""
    motions = [run.motion.id for run in item.array.motions]
    return {
        "array": item.array.id,
        "sums_m": dict(zip(motions, item.sums_m, strict=True)),
        "mean_m": item.mean_m,
        "largest_m": item.largest_m,
    }


def neighbor(item: PlanNeighbor) -> dict[str, Any]:
    """Return what the plan shows near an array, and the clearances that contradict it."""
    return {
        "array": item.array,
        "other": item.other,
        "kind": item.kind,
        "gap_m": item.gap_m,
        "reach_m": item.reach_m,
        "is_missing": item.is_missing,
        "add_to": item.to_add,
        "given": [{"cell": row.cell, "provided_m": row.clearance.provided_m} for row in item.given],
        "contradictions": [row.cell for row in item.contradictions],
    }


def acceptance(row: AcceptanceRow) -> dict[str, Any]:
    """Return a limit on the motions, with the unit in the keys."""
    unit = "_s" if row.unit == "s" else ""
    return {
        "title": row.title,
        f"found{unit}": row.found,
        f"limit{unit}": row.limit,
        "is_at_least": row.is_at_least,
        "worst": row.worst,
        "is_in_no_code": row.is_ours,
        "ok": row.satisfied,
        "consequence": row.consequence,
    }
