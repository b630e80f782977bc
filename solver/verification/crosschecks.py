"""Checks of the exact method against 50-digit arithmetic and symmetries, and of every rival.

Returns the same rows as `checks`; the expected values come from `reference`, from a second run
that must agree, or from a closed form.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping

import numpy as np

from solver.model import STANDARD_GRAVITY_MPS2, SlideResult
from solver.records.record import Record
from solver.rivals.methods import METHODS, Method, link_frequency
from solver.sliding.checked import slide, slide_history
from solver.verification import problems, reference, scenes
from solver.verification.checks import PIECEWISE, G, slip_checks, trapezoid
from solver.verification.evidence import Check
from solver.verification.scenes import Case, is_runnable, scale_to

CASES = (*scenes.CASES[:4], Case(-7.0, 0.05, 1.0), Case(0.0, 0.0, 0.2))
"""Compared with 50 digits; the second and the fourth also with vertical shaking."""


def fifty_digits(record: Record) -> Iterator[Check]:
    """Compare PRD and residual with `reference`."""
    source = "Decimal arithmetic, Eqs. 12-18 of the paper; shares no code with the solver"
    ax, dt = record.a_mps2, record.dt_s
    for k, case in enumerate(CASES):
        slope, mu, scale = case.slope_rad, case.mu, scale_to(record, case.ppa_g)
        shaken = [("", None), (", with vertical shaking", 0.3 * ax[::-1])]
        for more, az in shaken if k in (1, 3) else shaken[:1]:
            exact = reference.slide(
                ax.tolist(),
                dt,
                slope_rad=slope,
                mu=mu,
                az_mps2=None if az is None else az.tolist(),
                scale=scale,
                g_mps2=STANDARD_GRAVITY_MPS2,
            )
            result = slide(ax, dt, slope_rad=slope, mu=mu, az_mps2=az, scale=scale)
            yield from slip_checks("DA-1", source, f"{record.name}, {case}{more}", exact, result)


def symmetries(record: Record) -> Iterator[Check]:
    """Run scenes whose results follow from those of others."""
    case = Case(3.0, 0.25, 1.0)
    ax, dt, scale = record.a_mps2, record.dt_s, scale_to(record, case.ppa_g)
    slope, mu, g = case.slope_rad, case.mu, STANDARD_GRAVITY_MPS2
    plain = slide(ax, dt, slope_rad=slope, mu=mu, scale=scale)
    mirrored = slide(-ax, dt, slope_rad=-slope, mu=mu, scale=scale)
    fine = np.interp(np.arange(2 * ax.size - 1) / 2, np.arange(ax.size), ax)
    finer = slide(fine, dt / 2, slope_rad=slope, mu=mu, scale=scale)
    twice = slide(ax, dt, slope_rad=slope, mu=mu, scale=2 * scale, g_mps2=2 * g)
    slow = slide(ax, 2 * dt, slope_rad=slope, mu=mu, scale=scale)
    prd_m, name = plain.prd_m, f"{record.name}, {case}"

    def row(id: str, problem: str, source: str, times: float, found: SlideResult) -> Check:
        expected = times * prd_m
        return Check(id, source, "PRD", "m", f"{problem}: {name}", expected, found.prd_m)

    mirror, same = "Slope and record mirrored", "identical to the last bit"
    yield Check("SY-1", f"PRD {same}", "PRD", "m", f"{mirror}: {name}", prd_m, mirrored.prd_m, 0.0)
    yield Check(
        "SY-1",
        f"Residual of opposite sign, {same}",
        "Residual",
        "m",
        f"{mirror}, residual: {name}",
        -plain.residual_m,
        mirrored.residual_m,
        0.0,
    )
    added = "Samples added by linear interpolation"
    yield row("SY-2", added, "The displacement is unchanged", 1.0, finer)
    yield row("SY-3", "Gravity and record doubled", "Displacements are doubled", 2.0, twice)
    yield row("SY-4", "Time step doubled", "Displacements are multiplied by four", 4.0, slow)
    yield _energy(record, case)


def _energy(record: Record, case: Case) -> Check:
    """Compare the work of friction with that of gravity and shaking, summed over the history."""
    parts = 32
    n = record.a_mps2.size
    ax = np.interp(np.arange((n - 1) * parts + 1) / parts, np.arange(n), record.a_mps2)
    ax *= scale_to(record, case.ppa_g)
    dt = record.dt_s / parts
    history = slide_history(ax, dt, slope_rad=case.slope_rad, mu=case.mu)
    sine, cosine = math.sin(case.slope_rad), math.cos(case.slope_rad)
    v = history.v_mps / cosine
    g = STANDARD_GRAVITY_MPS2
    friction = case.mu * (g * cosine + ax * sine) * np.abs(v)
    drive = (g * sine - ax * cosine) * v
    return Check(
        "SY-5",
        "Work of gravity and shaking less kinetic energy; summed at 32 points per interval",
        "Work of friction per unit mass",
        "J/kg",
        f"Energy balance: {record.name}, {case}",
        float(drive.sum() * dt - v[-1] ** 2 / 2),
        float(friction.sum() * dt),
        1e-4,
    )


def rivals() -> Iterator[Check]:
    """Compare every method with one closed form, each within its own tolerance."""
    dt, plateau, a, mu = 0.01, 20, 0.4, 0.1
    expected = problems.pulse_travel(a * G, mu * G, plateau * dt, dt)
    ax = trapezoid(a * G, plateau, 150)
    for method in METHODS.values():
        if not is_runnable(method.name):
            continue
        result = slide(
            ax, dt, slope_rad=0.0, mu=mu, g_mps2=G, method=method.name, units="m/s2",
            **_fine(method, dt),
        )  # fmt: skip
        name = f"{method.title}: pulse A = {a:g} g for 0.2 s, mu = {mu:g}, flat roof"
        yield Check("ME-1", PIECEWISE, "PRD", "m", name, expected, result.prd_m, method.ceiling)


def _fine(method: Method, dt_s: float) -> Mapping[str, float]:
    """Return fine settings; those of a link lie well within its stability limit."""
    if method.link_steps_per_radian:
        substeps = 100
        omega = 0.5 * substeps / dt_s
        stiffness = (omega / link_frequency(1.0, G)) ** 2
        return {"stiffness_per_m": stiffness, "substeps": substeps}
    if method.name == "regularized":
        return {"velocity_mps": 1e-3, "tolerance": 1e-6}
    return {}
