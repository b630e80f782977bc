"""Checks of the solver against independent results, one row for each value.

A block that nothing shakes slides 0.5 (g sin(theta) - mu g cos(theta)) t^2 down a slope of 7
degrees with mu = 0.1: 0.444 m in 2 s, which the solver gives to 1e-12.

Closed forms (`solver.verification.reference`), the paper's physical checks, the exact method
against 50-digit arithmetic, and every rival. Calls only `solver.slide` and `slide_history`.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import partial
from typing import Any, NamedTuple

import numpy as np
import pandas as pd

from solver.model import STANDARD_GRAVITY_MPS2, EventKind, Floats, SlideResult
from solver.records.record import Record
from solver.rivals.methods import METHODS
from solver.sliding.checked import slide, slide_history
from solver.spaces import NO_BREAK, equation, with_minus
from solver.verification import reference, study_cases
from solver.verification.evidence import ROUNDING, Verified, percent_of
from solver.verification.reference import Reference
from solver.verification.study_cases import Case, run, runnable_methods
from solver.verification.verification_motions import scale_to

# Gravity in the closed forms [m/s2], as in their printed values.
G = 9.81

PIECEWISE = "Closed-form integration of the piecewise-linear pulse; 0.01 s ramps"
"""Source of the checks with pulses."""

_DOWNSLOPE = "Downslope slip, horizontal", "m"


def slip_checks(
    id: str,
    source: str,
    problem: str,
    expected: SlideResult | Reference,
    result: SlideResult,
    tolerance: float = ROUNDING,
) -> Iterator[Verified]:
    """Yield the rows of PRD and residual."""
    # A residual may nearly cancel after meters of travel, so both errors are relative to the PRD.
    for quantity, known, value in (
        ("PRD", expected.prd_m, result.prd_m),
        ("Residual (error relative to the PRD)", expected.residual_m, result.residual_m),
    ):
        yield Verified(id, source, quantity, "m", problem, known, value, tolerance, expected.prd_m)


def trapezoid(peak: float, plateau: int, still: int) -> Floats:
    """Return a pulse: zero, `plateau` intervals at the peak between ramps, `still` ones at zero."""
    return np.concatenate([[0.0], np.full(plateau + 1, peak), np.zeros(still + 1)])


def closed_forms() -> Iterator[Verified]:
    """Verified against `solver.verification.reference`, all with g = 9.81 m/s2."""
    yield from _pulses_on_a_flat_roof()
    yield from _pulses_on_a_slope()
    yield from _half_sines()
    yield _harmonic()
    yield _free_slide("CF-7", 2.0)
    yield from _yield_accelerations()
    yield _self_locking()


def _pulses_on_a_flat_roof() -> Iterator[Verified]:
    # Newmark's pulse has no ramps; here each is so short that its effect is the tolerance.
    dt, ramps = 0.01, 3000
    newmark = f"Newmark, Geotechnique 15 (1965); each ramp is 1/{ramps} of the pulse"
    for a, mu, lasts in ((0.4, 0.1, 0.2), (0.5, 0.2, 0.3), (1.0, 0.4, 0.1)):
        name = f"{equation('A', a, 'g')} for {lasts:g} s, {equation('μ', mu)}, flat roof"
        plateau = round(lasts / dt)
        expected = reference.pulse_travel(a * G, mu * G, plateau * dt, dt)
        # If the roof accelerates toward -x, the block slips toward +x.
        result = slide(trapezoid(-a * G, plateau, 400), dt, slope_rad=0.0, mu=mu, g_mps2=G)
        pulse = f"Trapezoidal pulse {name}"
        yield Verified("CF-1", PIECEWISE, "PRD", "m", pulse, expected, result.prd_m)
        expected = (a * G * lasts) ** 2 / (2.0 * G * mu) * (1.0 - mu / a)
        ax = trapezoid(-a * G, ramps - 1, 10 * ramps)
        result = slide(ax, lasts / ramps, slope_rad=0.0, mu=mu, g_mps2=G)
        # A ramp shortens the slip by mu / A of its length; the factor 1.5 is a margin on that.
        tolerance = 1.5 * mu / a / ramps
        pulse = f"Rectangular pulse {name}"
        yield Verified("CF-2", newmark, "PRD", "m", pulse, expected, result.prd_m, tolerance)


def _pulses_on_a_slope() -> Iterator[Verified]:
    dt = 0.01
    row = partial(Verified, "CF-3", PIECEWISE, *_DOWNSLOPE)
    for degrees, mu, a, lasts in ((5, 0.4, 0.6, 0.3), (10, 0.5, 0.8, 0.15)):
        slope, plateau = math.radians(degrees), round(lasts / dt)
        for b in (0.0, -0.3, 0.3):
            drive, resist = reference.slope_pulse(slope, mu, a, b, G)
            expected = reference.pulse_travel(drive, resist, plateau * dt, dt) * math.cos(slope)
            ax, az = (trapezoid(peak * G, plateau, 900) for peak in (-a, b))
            result = slide(ax, dt, slope_rad=slope, mu=mu, az_mps2=az, g_mps2=G)
            name = (
                f"Trapezoidal pulse {equation('A', a, 'g')}, vertical {with_minus(b)}{NO_BREAK}g, "
            )
            name += f"for {lasts:g} s, {equation('μ', mu)}, slope {degrees} deg"
            yield row(name, expected, result.down_m)


def _half_sines() -> Iterator[Verified]:
    chords = "Closed-form integration of the sine; record sampled at 400 points"
    second = "Errors with 200 and 400 samples: linear interpolation is second order"
    for a, mu, freq in ((0.5, 0.2, 1.0), (0.8, 0.4, 2.0), (1.0, 0.1, 1.0)):
        expected = reference.half_sine_travel(a, mu, freq, G)
        name = (
            f"Half-sine pulse {equation('A', a, 'g')}, {freq:g} Hz, {equation('μ', mu)}, flat roof"
        )
        travels_m = []
        for steps in (100, 200, 400):
            dt = 0.5 / freq / steps
            pulse = a * G * np.sin(np.pi * np.arange(steps + 1) / steps)
            ax = np.concatenate([pulse, np.zeros(40 * steps)])
            travels_m.append(slide(ax, dt, slope_rad=0.0, mu=mu, g_mps2=G).prd_m)
        # Straight chords of a sine lose the share (step in radians)^2 / 12 of its area.
        tolerance = 2.0 * a / mu * (math.pi / 400) ** 2 / 12.0
        yield Verified("CF-4", chords, "PRD", "m", name, expected, travels_m[-1], tolerance)
        order = math.log2(abs(travels_m[1] - expected) / abs(travels_m[2] - expected))
        yield Verified("CF-5", second, "Order of convergence", "1", name, 2.0, order, 0.025)


def _harmonic() -> Verified:
    dt = 1.0 / 2000
    ax = 0.5 * G * np.sin(2.0 * np.pi * np.arange(80 * 2000 + 1) * dt)
    history = slide_history(ax, dt, slope_rad=0.0, mu=0.2, g_mps2=G)
    stops = [event.u_m for event in history.events if event.kind is EventKind.STOP]
    name = (
        f"Steady-state harmonic {equation('A', 0.5, 'g')}, 1 Hz, {equation('μ', 0.2)}, flat roof, "
    )
    return Verified(
        "CF-6",
        "(2 A / ω²) √(1 − (π η / 2)²), η = μ g / A; sampled at 0.0005 s",
        "Travel per half cycle",
        "m",
        f"{name}after 80 cycles",
        reference.harmonic_travel(0.5, 0.2, 1.0, G),
        abs(stops[-1] - stops[-2]) if len(stops) > 1 else math.nan,
        1e-5,
    )


def _free_slide(id: str, time_s: float) -> Verified:
    slope, mu = math.radians(7.0), 0.1
    steps = round(time_s / 0.01)
    result = slide(np.zeros(steps + 1), 0.01, slope_rad=slope, mu=mu, g_mps2=G)
    expected = reference.free_slide_travel(slope, mu, time_s, G) * math.cos(slope)
    name = f"No shaking, slope 7 deg, {equation('μ', mu)}: slides from rest for {time_s:g} s"
    source = "0.5 (g sin(θ) − μ g cos(θ)) t², the paper's physical check 2"
    return Verified(id, source, *_DOWNSLOPE, name, expected, result.down_m)


def _yield_accelerations() -> Iterator[Verified]:
    source = "−g tan(φ − θ) and g tan(φ + θ), φ = atan(μ); computed by bisection"
    row = partial(Verified, "CF-8", source, "Yield acceleration", "m/s²", tolerance=1e-9)
    for degrees, mu in ((0.0, 0.4), (4.0, 0.4), (-7.0, 0.2), (30.0, 1.0)):
        slope = math.radians(degrees)
        limits = reference.yield_accelerations(slope, mu, G)
        for way, limit in zip(("downslope", "upslope"), limits, strict=True):
            name = f"Slope {with_minus(degrees)} deg, {equation('μ', mu)}: onset of {way} slip"
            yield row(name, limit, _limit_by_bisection(slope, mu, limit))


def _limit_by_bisection(slope: float, mu: float, limit: float) -> float:
    """Return the least acceleration that moves the block; bisects from 0 to twice `limit`."""
    low, high = 0.0, 2.0 * limit
    # Halved 45 times: to 3e-14 of the limit, below the tolerance of 1e-9.
    for _ in range(45):
        middle = 0.5 * (low + high)
        ax = np.array([0.0, middle, 0.0])
        # A moving block stops within the record: the first value tried is the limit itself, and no
        # value exceeds 1.5 times the limit.
        moves = slide(ax, 0.5, slope_rad=slope, mu=mu, g_mps2=G).n_stops > 0
        low, high = (low, middle) if moves else (middle, high)
    return 0.5 * (low + high)


def _self_locking() -> Verified:
    ax = np.array([0.0, 50.0, 50.0, 50.0, 0.0])
    prd_m = slide(ax, 0.1, slope_rad=math.radians(60), mu=3.0, g_mps2=G).prd_m
    name = f"Self-locking: slope 60 deg, {equation('μ', 3)}, horizontal acceleration 50 m/s²"
    source = "μ sin(θ) ≥ cos(θ): no horizontal acceleration causes slip"
    return Verified("CF-9", source, "PRD", "m", name, 0.0, prd_m, 0.0)


def physical_checks(record: Record) -> Iterator[Verified]:
    """Run the four physical checks of the paper."""
    slope, dt = math.radians(30), 0.01
    row = partial(Verified, "PH-1", "Paper, Physical Checks (1): slope 30 deg, μ = 1", "PRD", "m")
    still = slide(np.zeros(500), dt, slope_rad=slope, mu=1.0, g_mps2=G)
    # A tolerance of zero: a block that does not move has no rounding error.
    yield row("No shaking: no slip", 0.0, still.prd_m, 0.0)
    drive, resist = reference.slope_pulse(slope, 1.0, 0.6, 0.0, G)
    expected = reference.pulse_travel(drive, resist, 0.3, dt) * math.cos(slope)
    loose = slide(trapezoid(-0.6 * G, 30, 900), dt, slope_rad=slope, mu=1.0, g_mps2=G)
    yield row(f"A pulse of 0.6{NO_BREAK}g for 0.3 s causes slip", expected, loose.prd_m)
    yield _free_slide("PH-2", 5.0)
    down, up = (run(record, Case(slope_deg, 0.4, 1.5)) for slope_deg in (4.0, -4.0))
    yield Verified(
        "PH-3",
        "Paper, Physical Checks (3): the deflections differ",
        "PRDs differ by more than 1% (1 = yes)",
        "1",
        f"Slopes 4 and −4 deg, {equation('μ', 0.4)}, {record.name}, {equation('PPA', 1.5, 'g')}",
        1.0,
        float(abs(down.prd_m - up.prd_m) > 0.01 * max(down.prd_m, up.prd_m)),
        0.0,
    )
    yield from _critical_friction()


def _critical_friction() -> Iterator[Verified]:
    slope, time_s = math.radians(0.5), 5.0
    source = "Paper, Physical Checks (4): sliding with 0.999 tan(θ), no slip at 1.000 tan(θ)"
    below, just = 0.999 * math.tan(slope), math.tan(slope)
    travel_m = reference.free_slide_travel(slope, below, time_s, G) * math.cos(slope)
    for factor, mu, expected, tolerance in (
        # sin - mu cos cancels to a thousandth of sin, which costs three digits.
        (0.999, below, travel_m, 1e-11),
        (1.0, just, 0.0, ROUNDING),
    ):
        result = slide(np.zeros(501), 0.01, slope_rad=slope, mu=mu, g_mps2=G)
        name = f"No shaking, slope 0.5 deg, μ{NO_BREAK}={NO_BREAK}{factor:.3f} tan(θ), 5 s"
        yield Verified("PH-4", source, "PRD", "m", name, expected, result.prd_m, tolerance)


CASES = (*study_cases.CASES[:4], Case(-7.0, 0.05, 1.0), Case(0.0, 0.0, 0.2))
"""Compared with 50 digits; the second and the fourth also with vertical shaking."""


class KnownBlock(NamedTuple):
    """A block whose motion is known to 50 digits."""

    name: str
    given: Mapping[str, Any]  # what `slide` takes
    exact: Reference


RANDOM, ROOF = "random records", "records of section 2"
"""The kinds of `rival_errors`."""


def _block(name: str, ax: Floats, az: Floats | None, **arguments: float) -> KnownBlock:
    vertical = None if az is None else az.tolist()
    known = {"g_mps2": STANDARD_GRAVITY_MPS2} | arguments
    exact = reference.slide(ax.tolist(), az_mps2=vertical, **known)
    return KnownBlock(name, {"ax_mps2": ax, "az_mps2": az, "units": "m/s2"} | known, exact)


def roof_blocks(record: Record) -> Iterator[KnownBlock]:
    """Yield `CASES` of a record."""
    ax = record.a_mps2
    for k, case in enumerate(CASES):
        place = {"dt_s": record.dt_s, "slope_rad": case.slope_rad, "mu": case.mu}
        shaken = [("", None), (", with vertical shaking", 0.3 * ax[::-1])]
        for suffix, az in shaken if k in (1, 3) else shaken[:1]:
            scale = scale_to(record, case.ppa_g)
            yield _block(f"{record.name}, {case}{suffix}", ax, az, scale=scale, **place)


def random_blocks() -> Iterator[KnownBlock]:
    """Yield blocks under noise of few samples, which stops and reverses them between samples."""
    # A fixed seed: every verification uses the same blocks.
    rng = np.random.default_rng(2003)
    for k in range(200):
        ax, az = rng.normal(0.0, 5.0, 8).round(1), rng.normal(0.0, 1.0, 8).round(1)
        place = {"slope_rad": math.radians(rng.integers(-4, 8)), "mu": 0.1 * rng.integers(1, 6)}
        yield _block(f"Random record {k}", ax, az if k % 2 else None, dt_s=0.02, **place)


def fifty_digits(blocks: Iterable[KnownBlock]) -> Iterator[Verified]:
    """Compare PRD and residual of the exact method with `reference`."""
    source = "Decimal arithmetic, Eqs. 12-18 of the paper; shares no code with the solver"
    for block in blocks:
        yield from slip_checks("DA-1", source, block.name, block.exact, slide(**block.given))


def rival_errors(kinds: Mapping[str, Sequence[KnownBlock]]) -> pd.DataFrame:
    """Run every method on every block that it accepts, and compare with `reference`.

    Returns
    -------
    DataFrame
        A row for each run: `method`, `motions`, which is the kind of the block, and `error [%]`,
        the larger of those of PRD and residual, see `percent_of`.
    """
    rows = []
    for method in runnable_methods():
        for kind, blocks in kinds.items():
            for _, arguments, exact in blocks:
                if arguments["az_mps2"] is None or method.takes_vertical:
                    result = slide(**arguments, method=method.name)
                    off = abs(result.prd_m - exact.prd_m), abs(result.residual_m - exact.residual_m)
                    error = float(percent_of(np.max(off), exact.prd_m))
                    rows.append({"method": method.name, "motions": kind, "error [%]": error})
    return pd.DataFrame(rows)


def claims(errors: pd.DataFrame) -> Iterator[Verified]:
    """Check that methods declared always valid have no error other than rounding."""
    source = "Decimal arithmetic, as DA-1: what section 4 says, never invalid, and as accurate"
    row = partial(Verified, "ME-2", source, "Largest error of PRD and residual", "1")
    runnable = runnable_methods()
    for method in METHODS.values():
        for kind in (RANDOM, ROOF) if method.invalid_when.startswith("Never") else ():
            own_errors = errors.loc[(errors["method"] == method.name) & (errors["motions"] == kind)]
            # A run without a result is NaN, which must not pass as a run without error.
            largest = 0.01 * own_errors["error [%]"].max(skipna=False)
            name, is_run = f"{method.title}: {kind}", method in runnable
            yield row(name, 0.0, largest if is_run else math.nan, is_run=is_run)
