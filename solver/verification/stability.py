"""Maps of error over two parameters, where methods diverge, stall or lose accuracy; and cases in
which the problem itself is sensitive to the last digits of the friction coefficient.

Runs only. A failed run is a failed cell and is never omitted. See `solver.rivals.methods` for the
limits.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping

import numpy as np

from solver.model import STANDARD_GRAVITY_MPS2, Floats
from solver.records.record import Record
from solver.rivals.methods import METHODS, link_frequency
from solver.sliding.sweep import sweep
from solver.verification.evidence import Conditioning, StabilityMap, percent_off
from solver.verification.scenes import CASES, Case, is_runnable, scale_to, shortened
from solver.verification.study import run

SLOPE_DEG = 4.0
CRITICAL_MU = math.tan(math.radians(SLOPE_DEG))
"""Least friction without slip on an unshaken roof of that slope."""

PPA_G = 0.3
"""PPA of the maps near the critical friction, where the block both sticks and slips."""

_Run = tuple[Case, Mapping[str, float]]


def maps(record: Record, *, quick: bool) -> Iterator[StabilityMap]:
    """Compute all maps on one record."""
    part = shortened(record, 10.0)
    yield from (
        link_map(part, name, quick=quick) for name in ("penalty-explicit", "penalty-implicit")
    )
    for name in ("paper", "linear"):  # "adaptive" gives the same results as "paper"
        yield slope_map(part, name, quick=quick)
        yield friction_map(part, name, quick=quick)
    if is_runnable("regularized"):
        yield tolerance_map(shortened(record, 1.0), quick=quick)


def link_map(record: Record, name: str, *, quick: bool) -> StabilityMap:
    """Map sub-step against link stiffness, with the stability limit 2 / omega of the explicit."""
    stiffness = np.geomspace(1e2, 1e8, 13 if quick else 25)
    substeps = np.unique(np.geomspace(1, 512, 10 if quick else 24).round().astype(int))[::-1]
    cases = CASES[:2] if quick else CASES[:3]
    note = (
        "Line: 2 / ω with ω = √(g k). Above the line the explicit link is unstable, and the "
        "iterations of the implicit link may alternate between stick and slip. At the left, a "
        "soft link elongates by μ / k."
    )
    return _map(
        record,
        name,
        lambda k, h: [
            (case, {"stiffness_per_m": k, "substeps": round(record.dt_s / h)}) for case in cases
        ],
        title=f"{METHODS[name].title}: sub-step against stiffness",
        note=note,
        x_label="Stiffness per unit weight [1/m]",
        x=stiffness,
        y_label="Sub-step [s]",
        y=record.dt_s / substeps,
        limit=np.array([2.0 / link_frequency(k, STANDARD_GRAVITY_MPS2) for k in stiffness]),
        x_mark=math.nan,
        x_log=True,
    )


def slope_map(record: Record, name: str, *, quick: bool) -> StabilityMap:
    """Map sub-step against slopes near the friction angle, where free sliding begins."""
    slopes = SLOPE_DEG + np.linspace(-2.0, 2.0, 17 if quick else 41)
    return _map(
        record,
        name,
        lambda slope, h: [_near(record, h, float(slope), CRITICAL_MU)],
        title=f"{METHODS[name].title}: sub-step against slope",
        note=f"μ = tan {SLOPE_DEG:g}°, PPA = {PPA_G:g} g. Line: θ = atan μ; on steeper slopes the "
        "block cannot stay at rest.",
        x_label="Slope [deg]",
        x=slopes,
        y_label="Sub-step [s]",
        y=_steps(record, quick),
        limit=np.empty(0),
        x_mark=SLOPE_DEG,
        x_log=False,
    )


def friction_map(record: Record, name: str, *, quick: bool) -> StabilityMap:
    """Map sub-step against friction coefficients near the tangent of the slope."""
    mus = CRITICAL_MU * np.linspace(0.5, 2.0, 16 if quick else 46)
    return _map(
        record,
        name,
        lambda mu, h: [_near(record, h, SLOPE_DEG, float(mu))],
        title=f"{METHODS[name].title}: sub-step against friction",
        note=f"θ = {SLOPE_DEG:g}°, PPA = {PPA_G:g} g. Line: μ = tan θ; with less friction the "
        "block cannot stay at rest.",
        x_label="Friction coefficient",
        x=mus,
        y_label="Sub-step [s]",
        y=_steps(record, quick),
        limit=np.empty(0),
        x_mark=CRITICAL_MU,
        x_log=False,
    )


def tolerance_map(record: Record, *, quick: bool) -> StabilityMap:
    """Map the tolerance of the regularized method over its velocity v_0."""
    velocities = np.geomspace(1e-3, 1.0, 4) if quick else np.geomspace(1e-4, 1.0, 9)
    tolerances = np.geomspace(1e-2, 1e-5, 4) if quick else np.geomspace(1e-2, 1e-8, 7)
    case = CASES[1]
    return _map(
        record,
        "regularized",
        lambda v, tolerance: [(case, {"velocity_mps": v, "tolerance": tolerance})],
        title=f"{METHODS['regularized'].title}: tolerance against velocity",
        note=f"{case}. At the right, the block creeps where it should stick; a tighter tolerance "
        "does not reduce this error.",
        x_label="Velocity v₀ [m/s]",
        x=velocities,
        y_label="Relative tolerance",
        y=tolerances,
        limit=np.empty(0),
        x_mark=math.nan,
        x_log=True,
    )


def _steps(record: Record, quick: bool) -> Floats:
    substeps = 2.0 ** np.arange(8, -1, -2 if quick else -1)
    return np.asarray(record.dt_s / substeps, dtype=np.float64)


def _near(record: Record, step_s: float, slope_deg: float, mu: float) -> _Run:
    return Case(slope_deg, mu, PPA_G), {"substeps": round(record.dt_s / step_s)}


def _map(
    record: Record,
    name: str,
    runs: Callable[[float, float], list[_Run]],
    *,
    title: str,
    note: str,
    x_label: str,
    x: Floats,
    y_label: str,
    y: Floats,
    limit: Floats,
    x_mark: float,
    x_log: bool,
) -> StabilityMap:
    """Return the largest error of the runs of each cell; a run without a result fails the cell."""
    error = np.array([[_largest_error(record, name, runs(a, b)) for a in x] for b in y])
    return StabilityMap(
        title=title,
        note=f"{record.name}. {note}",
        x_label=x_label,
        x=x,
        y_label=y_label,
        y=y,
        error_percent=error,
        failed=np.isnan(error),
        limit=limit,
        x_mark=x_mark,
        x_log=x_log,
        y_log=True,
    )


def _largest_error(record: Record, name: str, runs: list[_Run]) -> float:
    prd_m = [run(record, case, name, **parameters).prd_m for case, parameters in runs]
    exact = [run(record, case).prd_m for case, _ in runs]
    return float(percent_off(np.array(prd_m), np.array(exact)).max())


def conditioning(record: Record, *, quick: bool) -> Iterator[Conditioning]:
    """Compute the change of the exact PRD for small changes of the friction coefficient."""
    count = 60 if quick else 240
    # Toward the critical friction from both sides, to within a millionth of it.
    near = CRITICAL_MU * (1.0 + np.geomspace(1e-6, 0.5, count // 2))
    below = 2.0 * CRITICAL_MU - near[::-1]
    both = np.concatenate([below, near])
    wide = np.linspace(0.02, 0.8, count)
    still = "Without shaking the block slides freely if μ < tan θ and stays at rest if μ > tan θ. "
    still += "At the limit the result depends on the last digits of μ, for every method."
    shaken = "With shaking, a change in the 9th digit of μ changes the PRD by a similarly small "
    shaken += "share, except where a slip barely occurs."
    design = "This is the effect of 5 % more or less friction on the PRD."
    for title, note, ppa_g, change, mu in (
        ("μ changed by 10⁻⁹, no shaking", still, 0.0, 1e-9, both),
        ("μ changed by 10⁻⁹, shaking, μ near tan θ", shaken, PPA_G, 1e-9, both),
        ("μ changed by 10⁻⁹, shaking", shaken, 1.0, 1e-9, wide),
        ("μ changed by 5 %, shaking", design, 1.0, 0.05, wide),
    ):
        yield _conditioning(record, ppa_g, change, mu, title, note)


def _conditioning(
    record: Record, ppa_g: float, change: float, mu: Floats, title: str, note: str
) -> Conditioning:
    mus = np.concatenate([mu, mu * (1.0 - change), mu * (1.0 + change)])
    prds_m = sweep(
        record.a_mps2,
        record.dt_s,
        slopes_rad=math.radians(SLOPE_DEG),
        mus=mus,
        scales=scale_to(record, ppa_g),
    ).prd_m
    prd, less, more = prds_m.reshape(3, mu.size)
    return Conditioning(
        title=title,
        note=note,
        record=record.name,
        slope_deg=SLOPE_DEG,
        ppa_g=ppa_g,
        relative_change=change,
        mu=mu,
        prd_m=prd,
        change_percent=np.maximum(percent_off(less, prd), percent_off(more, prd)),
    )
