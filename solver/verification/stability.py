"""Maps of error over two parameters, where methods diverge, stall or lose accuracy; and cases in
which the problem itself is sensitive to the last digits of the friction coefficient.

Runs only. A failed run is a failed cell and is never omitted. See `solver.rivals.methods` for the
limits.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence

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

_SUB_STEP = "Sub-step [s]"

_Cell = Sequence[tuple[Case, Mapping[str, float]]]
"""Runs: a case and the parameters of the method."""


def maps(record: Record, *, quick: bool) -> Iterator[StabilityMap]:
    """Compute all maps on one record."""
    part = shortened(record, 10.0)
    yield from (
        link_map(part, name, quick=quick) for name in ("penalty-explicit", "penalty-implicit")
    )
    for name in ("paper", "linear"):  # "adaptive" gives the same results as "paper"
        yield from near_rest_maps(part, name, quick=quick)
    if is_runnable("regularized"):
        yield tolerance_map(shortened(record, 1.0), quick=quick)


def link_map(record: Record, name: str, *, quick: bool) -> StabilityMap:
    """Map sub-step against link stiffness, with the stability limit 2 / omega of the explicit."""
    stiffness = np.geomspace(1e2, 1e8, 13 if quick else 25)
    substeps = np.unique(np.geomspace(1, 512, 10 if quick else 24).round().astype(int))[::-1]
    cases = CASES[:2] if quick else CASES[:3]
    cells = [
        [
            [(case, {"stiffness_per_m": k, "substeps": count}) for case in cases]
            for k in stiffness.tolist()
        ]
        for count in substeps.tolist()
    ]
    return StabilityMap(
        title=f"{METHODS[name].title}: sub-step against stiffness",
        note=f"{record.name}. Line: 2 / ω with ω = √(g k). Above the line the explicit link is "
        "unstable, and the iterations of the implicit link may alternate between stick and slip. "
        "At the left, a soft link elongates by μ / k.",
        x_label="Stiffness per unit weight [1/m]",
        x=stiffness,
        y_label=_SUB_STEP,
        y=record.dt_s / substeps,
        error_percent=_errors(record, name, cells),
        limit=np.array([2.0 / link_frequency(k, STANDARD_GRAVITY_MPS2) for k in stiffness]),
    )


def near_rest_maps(record: Record, name: str, *, quick: bool) -> Iterator[StabilityMap]:
    """Map sub-step against slope and against friction, near the limit of free sliding."""
    slopes = SLOPE_DEG + np.linspace(-2.0, 2.0, 17 if quick else 41)
    mus = CRITICAL_MU * np.linspace(0.5, 2.0, 16 if quick else 46)
    substeps = 2 ** np.arange(8, -1, -2 if quick else -1)
    still = (
        f"μ = tan {SLOPE_DEG:g}°, PPA = {PPA_G:g} g. Line: θ = atan μ; on steeper slopes the block "
        "cannot stay at rest."
    )
    loose = (
        f"θ = {SLOPE_DEG:g}°, PPA = {PPA_G:g} g. Line: μ = tan θ; with less friction the block "
        "cannot stay at rest."
    )
    at_slopes = [Case(slope_deg, CRITICAL_MU, PPA_G) for slope_deg in slopes.tolist()]
    at_mus = [Case(SLOPE_DEG, mu, PPA_G) for mu in mus.tolist()]
    for what, label, x, limit, cases, note in (
        ("slope", "Slope [deg]", slopes, SLOPE_DEG, at_slopes, still),
        ("friction", "Friction coefficient", mus, CRITICAL_MU, at_mus, loose),
    ):
        cells = [[[(case, {"substeps": count})] for case in cases] for count in substeps.tolist()]
        yield StabilityMap(
            title=f"{METHODS[name].title}: sub-step against {what}",
            note=f"{record.name}. {note}",
            x_label=label,
            x=x,
            y_label=_SUB_STEP,
            y=record.dt_s / substeps,
            error_percent=_errors(record, name, cells),
            x_mark=limit,
            x_log=False,
        )


def tolerance_map(record: Record, *, quick: bool) -> StabilityMap:
    """Map the tolerance of the regularized method over its velocity v_0."""
    velocities = np.geomspace(1e-3, 1.0, 4) if quick else np.geomspace(1e-4, 1.0, 9)
    tolerances = np.geomspace(1e-2, 1e-5, 4) if quick else np.geomspace(1e-2, 1e-8, 7)
    case, name = CASES[1], "regularized"
    cells = [
        [[(case, {"velocity_mps": v, "tolerance": tolerance})] for v in velocities.tolist()]
        for tolerance in tolerances.tolist()
    ]
    return StabilityMap(
        title=f"{METHODS[name].title}: tolerance against velocity",
        note=f"{record.name}. {case}. At the right, the block creeps where it should stick; a "
        "tighter tolerance does not reduce this error.",
        x_label="Velocity v₀ [m/s]",
        x=velocities,
        y_label="Relative tolerance",
        y=tolerances,
        error_percent=_errors(record, name, cells),
    )


def _errors(record: Record, name: str, cells: Sequence[Sequence[_Cell]]) -> Floats:
    """Return the largest error of the runs of each cell; a run without a result fails the cell."""
    return np.array([[_largest_error(record, name, cell) for cell in row] for row in cells])


def _largest_error(record: Record, name: str, cell: _Cell) -> float:
    prd_m = [run(record, case, name, **parameters).prd_m for case, parameters in cell]
    exact_m = [run(record, case).prd_m for case, _ in cell]
    return float(percent_off(np.array(prd_m), np.array(exact_m)).max())


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
        prd_m, less_m, more_m = sweep(
            record.a_mps2,
            record.dt_s,
            slopes_rad=math.radians(SLOPE_DEG),
            mus=np.concatenate([mu, mu * (1.0 - change), mu * (1.0 + change)]),
            scales=scale_to(record, ppa_g),
        ).prd_m.reshape(3, mu.size)
        yield Conditioning(
            title=title,
            note=note,
            record=record.name,
            slope_deg=SLOPE_DEG,
            ppa_g=ppa_g,
            mu=mu,
            prd_m=prd_m,
            change_percent=np.maximum(percent_off(less_m, prd_m), percent_off(more_m, prd_m)),
        )
