"""The studies of the paper on any record: Figs. 5 to 12.

60 scenarios with 1 to 256 sub-steps are the 540 runs of Fig. 5; Figs. 10 to 12 take 6,960.

Runs only; values read from the curves are in `evidence`. Source: "Predicted Slip of Ballasted Solar
Arrays on Angled Roofs due to Seismic Motion".
"""

from __future__ import annotations

import math

import numpy as np
import pandas as pd

from solver.model import Floats
from solver.records.record import Record
from solver.rivals.methods import METHODS
from solver.studies.sweep import sweep
from solver.verification.evidence import DesignCurves, LinkComparison, percent_of, percent_off
from solver.verification.study_cases import clocked, grid, history, prepared, run
from solver.verification.verification_motions import scale_to
from solver.verification.workprecision import timed

CONVERGENCE_CASES = grid((-7.0, -4.0, 0.0, 4.0, 7.0), (0.0, 0.1, 0.5), (0.0, 0.18, 1.0, 1.44))
"""The 60 scenarios of Fig. 5."""

SUBSTEPS = (1, 2, 4, 8, 16, 32, 64, 128, 256)

LINK_PER_M = 1e5
# The link of the paper's SAP 2000 model, 100 N/mm for a weight of 1 N, and its sub-step.
LINK_STEP_S = 0.001

LINK_PPA_G = 1.0
LINK_MUS = {
    0.0: (0.02, 0.05, 0.1, 0.15, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7),
    4.0: (0.1, 0.2, 0.3, 0.4, 0.5, 0.6),
}
"""Friction coefficients of Figs. 7 and 9, by slope [deg]."""

# With both signs these are 29 slopes; with 15 coefficients and 16 peak accelerations, 6,960 runs as
# in the paper.
SLOPES_DEG = np.arange(0.0, 7.25, 0.5)
MUS = np.linspace(0.1, 0.8, 15)
PPAS_G = np.linspace(0.0, 1.5, 16)


def convergence(record: Record) -> pd.DataFrame:
    """Run the paper's method in its 60 scenarios with 1 to 256 sub-steps (Fig. 5).

    Returns
    -------
    DataFrame
        A row for each number of sub-steps: the errors of the residual that are largest over the
        scenarios, see `percent_off`, against the exact method and against the last number, as in
        the paper (0 there); the first with its scenario, and in percent of the PRD, because an
        error in percent of the residual is not meaningful where a block returns to within a
        millimeter of its start; and the longest time of one run [s].
    """
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
    return pd.DataFrame(
        {
            "exact_percent": off.max(axis=0),
            # The paper's measure: its best estimate is the run with 256 sub-steps.
            "finest_percent": percent_off(residual, residual[:, -1:]).max(axis=0),
            "prd_percent": percent_of(off_m, prd[:, None]).max(axis=0),
            "worst_case": [str(CONVERGENCE_CASES[i]) for i in off.argmax(axis=0)],
            "seconds": seconds.max(axis=0),
        },
        index=SUBSTEPS,
    )


def link_comparison(record: Record, slope_deg: float) -> LinkComparison:
    """Compare the exact method with the paper's link (Figs. 6 to 9)."""
    cases = grid([slope_deg], LINK_MUS[slope_deg], [LINK_PPA_G])
    # The quotient may be just above a whole number because of rounding.
    substeps = math.ceil(record.dt_s / LINK_STEP_S - 1e-9)
    link = {"stiffness_per_m": LINK_PER_M, "substeps": substeps}
    runs_m = pd.DataFrame(index=LINK_MUS[slope_deg])
    for name, method, parameters in (("exact", "exact", {}), ("link", "penalty-explicit", link)):
        results = [run(record, case, method, **parameters) for case in cases]
        runs_m[f"PRD, {name}"] = [result.prd_m for result in results]
        runs_m[f"RRD, {name}"] = [abs(result.residual_m) for result in results]
    off = percent_off(runs_m["RRD, exact"].to_numpy(), runs_m["RRD, link"].to_numpy())
    followed = off[np.isfinite(off)]
    # A run that diverged has no difference: it is never the worst.
    worst = int(np.nan_to_num(off, nan=-1.0).argmax())
    exact = history(record, cases[worst], "exact")
    linked = history(record, cases[worst], "penalty-explicit", **link)
    return LinkComparison(
        record=record.name,
        slope_deg=slope_deg,
        ppa_g=LINK_PPA_G,
        runs_m=runs_m,
        history_mu=cases[worst].mu,
        history_m=pd.DataFrame({"exact": exact.u_m, "link": linked.u_m}, index=exact.t_s),
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

    all_runs()  # compiled before it is timed
    prd_m, seconds = clocked(all_runs)
    flat = SLOPES_DEG.size - 1
    return DesignCurves(
        record=record.name,
        runs=prd_m.size,
        seconds=seconds,
        slopes_deg=SLOPES_DEG,
        mus=MUS,
        ppas_g=PPAS_G,
        # The negative slopes in the order of their size.
        prd_m=np.fmax(prd_m[flat:], prd_m[flat::-1]),
    )
