"""Maps of error over two parameters, where methods diverge, stall or lose accuracy.

A link of 1e5 / m is unstable for sub-steps above 2 / sqrt(g k) = 2.02 ms: a line in its map.

Runs only. A failed run is a failed cell and is never omitted. See `solver.rivals.methods` for the
limits.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from functools import partial

import numpy as np

from solver.model import STANDARD_GRAVITY_MPS2, Floats, Friction
from solver.records.record import Record
from solver.rivals.methods import METHODS
from solver.sliding import checked, two_axes
from solver.sliding.method import link_frequency
from solver.verification.evidence import StabilityMap, percent_off
from solver.verification.study_cases import CASES, Case, run
from solver.verification.verification_motions import scale_to, shortened

SLOPE_DEG = 4.0
# Least friction without slip on an unshaken roof of that slope.
CRITICAL_MU = math.tan(math.radians(SLOPE_DEG))

# PPA of the maps near the critical friction, where the block both sticks and slips.
PPA_G = 0.3

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
    yield from step_limit_maps(shortened(record, 3.0), quick=quick)


def link_map(record: Record, name: str, *, quick: bool) -> StabilityMap:
    """Map sub-step against link stiffness, with the stability limit 2 / omega of the explicit."""
    stiffness = np.geomspace(1e2, 1e8, 13 if quick else 25)
    # Whole numbers: of the rounded ones the first would be there twice.
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
        title=f"{METHODS[name].title}:\nsub-step against stiffness",
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
    # From 256 sub-steps to 1, as in the paper's convergence study.
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
    for quantity, label, x, limit, cases, note in (
        ("slope", "Slope [deg]", slopes, SLOPE_DEG, at_slopes, still),
        ("friction", "Friction coefficient", mus, CRITICAL_MU, at_mus, loose),
    ):
        cells = [[[(case, {"substeps": count})] for case in cases] for count in substeps.tolist()]
        yield StabilityMap(
            title=f"{METHODS[name].title}:\nsub-step against {quantity}",
            note=f"{record.name}. {note}",
            x_label=label,
            x=x,
            y_label=_SUB_STEP,
            y=record.dt_s / substeps,
            error_percent=_errors(record, name, cells),
            x_mark=limit,
            x_log=False,
        )


def step_limit_maps(record: Record, *, quick: bool) -> Iterator[StabilityMap]:
    """Map where two axes end without a result: sampling interval against rate of friction laws."""
    # Up to a law that reaches its final coefficient within a few nanometers per second.
    rates = np.geomspace(1e1, 1e9, 9 if quick else 17)
    steps_s = np.geomspace(0.5, 0.005, 3 if quick else 9)
    case, fast = CASES[0], 1.5
    for way, slow_share, fast_share in (("rises", 1.0, fast), ("falls", fast, 1.0)):
        slow, last = slow_share * case.mu, fast_share * case.mu
        of_rate = partial(Friction, mu_slow=slow, mu_fast=last, mu_static=slow)
        laws = [of_rate(rate_s_per_m=rate) for rate in rates.tolist()]
        yield StabilityMap(
            title=f"This program in two axes:\nsampling interval against rate, μ {way}",
            note=f"{record.name}, its samples at other intervals. {case.slope_deg:g}°, μ from "
            f"{slow:g} at rest to {last:g}, PPA = {case.ppa_g:g} g. Shading: the stated error. "
            "Hatched: the run exceeds its limit on steps.",
            x_label="Rate of the friction law [s/m]",
            x=rates,
            y_label="Sampling interval [s]",
            y=steps_s,
            error_percent=np.array(
                [
                    [_stated_percent(record, case, law, dt) for law in laws]
                    for dt in steps_s.tolist()
                ]
            ),
        )


def _stated_percent(record: Record, case: Case, law: Friction, dt_s: float) -> float:
    """Return the error that a run in two axes states, in percent; NaN of one without a result."""
    scale = scale_to(record, case.ppa_g)
    scene = checked.scene(record.a_mps2, dt_s, slope_rad=case.slope_rad, mu=law, scale=scale)
    result = two_axes.run(scene)
    return float(percent_off(result.prd_m + result.error_m, result.prd_m))


def _errors(record: Record, name: str, cells: Sequence[Sequence[_Cell]]) -> Floats:
    """Return the largest error of the runs of each cell; a run without a result fails the cell."""
    return np.array([[_largest_error(record, name, cell) for cell in row] for row in cells])


def _largest_error(record: Record, name: str, cell: _Cell) -> float:
    prd_m = [run(record, case, name, **parameters).prd_m for case, parameters in cell]
    # A failed run is NaN, which `max` of NumPy returns as the error of the cell.
    exact_m = [run(record, case).prd_m for case, _ in cell]
    return float(percent_off(np.array(prd_m), np.array(exact_m)).max())
