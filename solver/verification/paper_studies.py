"""The studies of the paper on any record: Figs. 5 to 12.

Runs only; values read from the curves are in `evidence`. Source: "Predicted Slip of Ballasted Solar
Arrays on Angled Roofs due to Seismic Motion".
"""

from __future__ import annotations

import math

import numpy as np

from solver.model import Floats
from solver.records.record import Record
from solver.rivals.methods import METHODS
from solver.sliding.sweep import sweep
from solver.verification.evidence import (
    Convergence,
    DesignCurves,
    LinkComparison,
    percent_of,
    percent_off,
)
from solver.verification.scenes import scale_to
from solver.verification.study import grid, history, minimum_seconds, prepared, run
from solver.verification.workprecision import timed

CONVERGENCE_CASES = grid((-7.0, -4.0, 0.0, 4.0, 7.0), (0.0, 0.1, 0.5), (0.0, 0.18, 1.0, 1.44))
"""The 60 scenarios of Fig. 5."""

SUBSTEPS = (1, 2, 4, 8, 16, 32, 64, 128, 256)

LINK_PER_M = 1e5
LINK_STEP_S = 0.001
"""The link of the paper's SAP 2000 model, 100 N/mm for a weight of 1 N, and its sub-step."""

LINK_PPA_G = 1.0
LINK_MUS = {
    0.0: (0.02, 0.05, 0.1, 0.15, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7),
    4.0: (0.1, 0.2, 0.3, 0.4, 0.5, 0.6),
}
"""Friction coefficients of Figs. 7 and 9, by slope [deg]."""

SLOPES_DEG = np.arange(0.0, 7.25, 0.5)
MUS = np.linspace(0.1, 0.8, 15)
PPAS_G = np.linspace(0.0, 1.5, 16)


def convergence(record: Record) -> Convergence:
    """Run the paper's method in its 60 scenarios with 1 to 256 sub-steps (Fig. 5)."""
    method = METHODS["paper"]
    residual = np.empty((len(CONVERGENCE_CASES), len(SUBSTEPS)))
    exact, prd = np.empty((2, len(CONVERGENCE_CASES)))
    seconds = np.empty_like(residual)
    for i, case in enumerate(CONVERGENCE_CASES):
        result = run(record, case)
        exact[i], prd[i] = result.residual_m, result.prd_m
        scene = prepared(record, case)
        for j, substeps in enumerate(SUBSTEPS):
            parameters = {"substeps": substeps}
            residual[i, j] = run(record, case, "paper", substeps=substeps).residual_m
            seconds[i, j] = timed(method, scene, parameters)
    off = percent_off(residual, exact[:, None])
    off_m = np.abs(residual - exact[:, None])
    return Convergence(
        record=record.name,
        scenarios=len(CONVERGENCE_CASES),
        substeps=SUBSTEPS,
        largest_error_exact_percent=off.max(axis=0),
        largest_error_p256_percent=percent_off(residual, residual[:, -1:]).max(axis=0),
        largest_error_of_prd_percent=percent_of(off_m, prd[:, None]).max(axis=0),
        worst_cases=tuple(str(CONVERGENCE_CASES[i]) for i in off.argmax(axis=0)),
        longest_seconds=seconds.max(axis=0),
    )


def link_comparison(record: Record, slope_deg: float) -> LinkComparison:
    """Compare the exact method with the paper's link (Figs. 6 to 9)."""
    mus = np.array(LINK_MUS[slope_deg])
    cases = grid([slope_deg], mus.tolist(), [LINK_PPA_G])
    substeps = math.ceil(record.dt_s / LINK_STEP_S - 1e-9)
    link = {"stiffness_per_m": LINK_PER_M, "substeps": substeps}
    pairs = [(run(record, c), run(record, c, "penalty-explicit", **link)) for c in cases]
    prd = np.array([[result.prd_m for result in pair] for pair in pairs])
    rrd = np.array([[abs(result.residual_m) for result in pair] for pair in pairs])
    off = percent_off(rrd[:, 0], rrd[:, 1])
    followed = off[np.isfinite(off)]
    worst = int(np.nan_to_num(off, nan=-1.0).argmax())
    exact = history(record, cases[worst], "exact")
    linked = history(record, cases[worst], "penalty-explicit", **link)
    return LinkComparison(
        record=record.name,
        slope_deg=slope_deg,
        ppa_g=LINK_PPA_G,
        mus=mus,
        prd_exact_m=prd[:, 0],
        prd_link_m=prd[:, 1],
        rrd_exact_m=rrd[:, 0],
        rrd_link_m=rrd[:, 1],
        history_mu=float(mus[worst]),
        history_t_s=exact.t_s,
        history_exact_m=exact.u_m,
        history_link_m=linked.u_m,
        worst_percent=float(followed.max()) if followed.size else math.nan,
        mean_percent=float(followed.mean()) if followed.size else math.nan,
    )


def design_curves(record: Record) -> DesignCurves:
    """Run the paper's 6,960 cases; return the larger of both signs of the slope (Figs. 10-12)."""
    both = np.concatenate([-SLOPES_DEG[:0:-1], SLOPES_DEG])

    def all_runs() -> Floats:
        return sweep(
            record.a_mps2,
            record.dt_s,
            slopes_rad=np.radians(both),
            mus=MUS,
            scales=PPAS_G * scale_to(record, 1.0),
        ).prd_m

    prd_m, seconds = all_runs(), minimum_seconds(all_runs, enough_s=1.0)
    flat = SLOPES_DEG.size - 1
    return DesignCurves(
        record=record.name,
        runs=prd_m.size,
        seconds=seconds,
        slopes_deg=SLOPES_DEG,
        mus=MUS,
        ppas_g=PPAS_G,
        prd_m=np.fmax(prd_m[flat:], prd_m[flat::-1]),
    )
