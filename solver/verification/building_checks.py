"""Checks of the computed roof motion: oscillators, modes, a whole building, identification.

The roof of a shear building of one story has a factor of 1 in its first mode, of two stories 1.171.

Returns the same rows as `checks`; expected values come from closed forms, from finite elements and
from direct integration of all floors of a building. Read `building_checks`.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import islice

import numpy as np

from solver.building.roof import absolute_accelerations, roof_motion
from solver.building.structure import (
    Modes,
    beam_modes,
    building_of_periods,
    floor_stiffness,
    story_modes,
)
from solver.model import Floats
from solver.records.record import Record
from solver.spaces import NO_BREAK, equation
from solver.verification.building import FloorRecords
from solver.verification.evidence import ROUNDING, RoofComparison, Verified

STORIES, PERIOD_S, DAMPING, ALPHA0 = 24, 1.2, 0.04, 6.0
"""The model building."""

# gamma and sigma of a clamped-free beam: Blevins, Formulas for Natural Frequency (1979), 8-1.
_BENDING = ((1.875104069, 0.734095514), (4.694091133, 1.018467319), (7.854757438, 0.999224497))


def building_checks(made: FloorRecords, comparison: RoofComparison) -> Iterator[Verified]:
    """Run the checks, including those of the model building's comparison."""
    yield from _steps()
    yield from _steady_waves()
    yield from _limits()
    yield from _coupled()
    yield from _sums()
    yield from _stories()
    yield _whole_building(made)
    yield from _identified(comparison)


def made_building(ground: Record) -> FloorRecords:
    """Return the floor motions of a building with equal stories, integrated directly."""
    floors = _stepped(ground.a_mps2, ground.dt_s)
    levels = (STORIES // 2, STORIES)
    return FloorRecords(
        title=f"Model building of {STORIES} stories",
        description=f"The model building has {STORIES} equal stories that deform in shear and "
        f"bending, a first period of {PERIOD_S:g}{NO_BREAK}s, {100 * DAMPING:g}% damping "
        f"in every mode and a lateral stiffness ratio of {ALPHA0:g}. The ground motion is "
        f"{ground.name}. The "
        "floor motions are computed by direct integration of the full system, without modal "
        "superposition, so that the modal solution and the fit have an independent reference.",
        is_recorded=False,
        dt_s=ground.dt_s,
        ground_mps2=ground.a_mps2,
        floors_mps2=floors[:, [level - 1 for level in levels]],
        floors=tuple(f"{level}th" for level in levels),
        # A uniform beam half a story taller has nearly the same modes.
        heights=tuple(level / (STORIES + 0.5) for level in levels),
        code_period_s=math.nan,
        search_s=(0.5 * PERIOD_S, 2.0 * PERIOD_S),
    )


def _stepped(a: Floats, dt: float) -> Floats:
    """Absolute accelerations of all floors, unit masses, ground motion linear between samples."""
    # One matrix exponential advances the floors' displacements and velocities, the ground
    # acceleration and its slope.
    stiff = floor_stiffness(ALPHA0, STORIES)
    squares, shapes = np.linalg.eigh(stiff)
    squares *= (2.0 * math.pi / PERIOD_S) ** 2 / squares[0]
    stiff = (shapes * squares) @ shapes.T
    # The same damping ratio in every mode; Rayleigh damping would have it at only two periods.
    damp = (shapes * (2.0 * DAMPING * np.sqrt(squares))) @ shapes.T
    n = 2 * STORIES
    rate = np.zeros((n + 2, n + 2))
    rate[:STORIES, STORIES:n] = np.eye(STORIES)
    rate[STORIES:n, :n] = np.hstack([-stiff, -damp])
    rate[STORIES:n, n] = -1.0
    rate[n, n + 1] = 1.0
    step = _exponential(rate * dt)
    state, accelerations = np.zeros(n), np.zeros((a.size, STORIES))
    for i in range(1, a.size):
        slope = (a[i] - a[i - 1]) / dt
        state = step[:n, :n] @ state + step[:n, n] * a[i - 1] + step[:n, n + 1] * slope
        accelerations[i] = rate[STORIES:n, :n] @ state
    return accelerations


def _exponential(matrix: Floats) -> Floats:
    """Matrix exponential by power series, scaling and squaring."""
    # The norm is 1/8 at most after the halvings: 15 terms of the series leave rounding alone.
    halvings = max(0, math.ceil(math.log2(float(np.abs(matrix).sum(axis=1).max()))) + 3)
    part = matrix / 2.0**halvings
    term = total = np.eye(len(matrix))
    for k in range(1, 16):
        term = term @ part / k
        total = total + term
    for _ in range(halvings):
        total = total @ total
    return total


def _steps() -> Iterator[Verified]:
    source = "Oscillator of period T: 1 − exp(−D t) (cos(W t) − D / W sin(W t)) at t = 1.37 s; "
    source += "D = ζ ω, W = damped frequency"
    for period_s, zeta in ((0.9, 0.03), (0.05, 0.2), (6.0, 0.005)):
        t, w = 1.37, 2.0 * math.pi / period_s
        kappa = math.sqrt(1.0 - zeta**2)
        wave = math.cos(kappa * w * t) - zeta / kappa * math.sin(kappa * w * t)
        expected = 1.0 - math.exp(-zeta * w * t) * wave
        peak = float(absolute_accelerations(np.ones(138), 0.01, [period_s], [zeta])[-1, 0])
        name = f"Unit step, {equation('T', period_s, 's')}, {equation('ζ', zeta)}"
        yield Verified("RM-1", source, "Acceleration", "m/s²", name, expected, peak)


def _steady_waves() -> Iterator[Verified]:
    dt, period_s, zeta = 0.001, 0.5, 0.1
    source = "Transmissibility √((1 + d) / ((1 − r²)² + d)), d = (2 ζ r)²; one story, "
    source += "damping ratio 0.1, step 0.001 s"
    building = building_of_periods([period_s], damping=[zeta], stories=1)
    for ratio in (0.5, 1.0, 2.0):
        w = ratio * 2.0 * math.pi / period_s
        wave = np.sin(w * dt * np.arange(round(20.0 / dt)))
        roof = roof_motion(wave, dt, building)[: wave.size]
        damped = (2.0 * zeta * ratio) ** 2
        expected = math.sqrt((1.0 + damped) / ((1.0 - ratio**2) ** 2 + damped))
        # The last second: after 19 s the transient is below 1e-10 of its beginning.
        amplitude = float(np.abs(roof[-round(1.0 / dt) :]).max())
        name = f"Harmonic, frequency ratio {equation('r', ratio)}"
        # Linear interpolation at 0.001 s reduces a sine of 4 Hz, the highest frequency here, by
        # 5e-5.
        yield Verified("RM-2", source, "Roof / ground", "1", name, expected, amplitude, 1e-4)


def _limits() -> Iterator[Verified]:
    table = "Blevins (1979), Table 8-1: ratios of squared γ, and 4 σ / γ"
    closed = "Shear beam: 2 n − 1, and 4 / ((2 n − 1) π) with alternating sign"
    bending, shear = beam_modes(0.0, 3), beam_modes(math.inf, 3)
    first = _BENDING[0][0]
    for n, (gamma, sigma) in enumerate(_BENDING, start=1):
        sign, odd = (-1) ** (n - 1), 2.0 * n - 1.0
        ratio, factor = (gamma / first) ** 2, sign * 4.0 * sigma / gamma
        yield from _mode("RM-3", table, "Cantilever in bending", bending, n, ratio, factor, 1e-8)
        factor = sign * 4.0 / (odd * math.pi)
        yield from _mode("RM-4", closed, "Cantilever in shear", shear, n, odd, factor, ROUNDING)


def _coupled() -> Iterator[Verified]:
    source = "64 cubic finite elements with consistent mass"
    for alpha0 in (2.0, 12.0):
        name, modes = f"Cantilever, stiffness ratio {alpha0:g}", beam_modes(alpha0, 3)
        expected = zip(*_finite_elements(alpha0), strict=True)
        for n, (ratio, factor) in enumerate(islice(expected, 3), start=1):
            yield from _mode("RM-5", source, name, modes, n, ratio, factor, 1e-5)


def _mode(
    id: str,
    source: str,
    problem: str,
    modes: Modes,
    n: int,
    ratio: float,
    factor: float,
    tolerance: float,
) -> Iterator[Verified]:
    """Yield the rows of a mode: period ratio, 1 by definition for the first, and factor."""
    name = f"{problem}, mode {n}"
    if n > 1:
        computed = float(1.0 / modes.period_ratios[n - 1])
        yield Verified(id, source, "Period ratio T1 / Tn", "1", name, ratio, computed, tolerance)
    computed = float(modes.factors[n - 1, 0])
    yield Verified(id, source, "Roof factor", "1", name, factor, computed, tolerance)


def _finite_elements(alpha0: float, count: int = 64) -> tuple[list[float], list[float]]:
    """Frequencies of the modes over the first frequency, and roof factors, of all modes."""
    size = 1.0 / count
    scale = np.array([1.0, size, 1.0, size])
    turned = np.outer(scale, scale)
    bending = np.array([[12, 6, -12, 6], [6, 4, -6, 2], [-12, -6, 12, -6], [6, 2, -6, 4]]) / size**3
    # The shear beam resists the slope of the same deflection, as a tension does: its matrix is that
    # of a tension (Clough and Penzien, Dynamics of Structures, geometric stiffness).
    shear = np.array([[36, 3, -36, 3], [3, 4, -3, -1], [-36, -3, 36, -3], [3, -1, -3, 4]])
    mass = np.array(
        [[156, 22, 54, -13], [22, 4, 13, -3], [54, 13, 156, -22], [-13, -3, -22, 4]]
    ) * (size / 420.0)
    stiff, heavy = np.zeros((2, 2 * count + 2, 2 * count + 2))
    for k in range(0, 2 * count, 2):
        part = slice(k, k + 4)
        stiff[part, part] += (bending + alpha0**2 * shear / (30.0 * size)) * turned
        heavy[part, part] += mass * turned
    rigid = (heavy @ np.tile([1.0, 0.0], count + 1))[2:]
    # The base is clamped: no deflection and no slope.
    stiff, heavy = stiff[2:, 2:], heavy[2:, 2:]
    # With the root of the mass the problem of two matrices is one of a symmetric matrix.
    root = np.linalg.inv(np.linalg.cholesky(heavy))
    squares, shapes = np.linalg.eigh(root @ stiff @ root.T)
    shapes = root.T @ shapes
    # The second to last is the deflection of the top, the last one its slope.
    return np.sqrt(squares / squares[0]).tolist(), (rigid @ shapes * shapes[-2]).tolist()


def _sums() -> Iterator[Verified]:
    source = "1, the limit of a rigid building; mean of the sums of 399 and 400 modes"
    for alpha0, kind in (
        (0.0, " in bending"),
        (6.0, ", stiffness ratio 6"),
        (math.inf, " in shear"),
    ):
        # Roof factors alternate in sign and their sums alternate about the limit, so a mean of two
        # sums is closer to it.
        sums = np.cumsum(beam_modes(alpha0, 400).factors[:, 0])
        total, name = float(0.5 * (sums[-1] + sums[-2])), f"Cantilever{kind}, all modes"
        yield Verified("RM-6", source, "Sum of roof factors", "1", name, 1.0, total, 1e-4)


def _stories() -> Iterator[Verified]:
    source = "Mode shape sin((2 n − 1) π k / (2 N + 1)) at floor k"
    for stories in (1, 2, 5):
        angle = math.pi / (2.0 * stories + 1.0)
        shape = np.sin(angle * np.arange(1, stories + 1))
        expected = float(shape.sum() * shape[-1] / (shape**2).sum())
        factor = float(story_modes(math.inf, stories).factors[0, 0])
        name = f"Shear building, stories: {stories}, first mode"
        yield Verified("RM-7", source, "Roof factor", "1", name, expected, factor, 1e-9)


def _whole_building(made: FloorRecords) -> Verified:
    building = building_of_periods([PERIOD_S], damping=[DAMPING], alpha0=ALPHA0, stories=STORIES)
    roof = roof_motion(made.ground_mps2, made.dt_s, building, share=0.0)
    stepped = made.floors_mps2[:, -1]
    off = float(np.abs(roof[: stepped.size] - stepped).max() / np.abs(stepped).max())
    name = "Model building, all modes"
    source = "Direct integration of all floors by one matrix exponential"
    return Verified("RM-8", source, "Largest difference / peak", "1", name, 0.0, off, 1e-7)


def _identified(comparison: RoofComparison) -> Iterator[Verified]:
    best, name = comparison.predictions[0], "Model building, fitted"
    source = "Properties of the model building, as a beam half a story taller; fitted to two floors"
    # alpha0 = H sqrt(GA / EI) of a beam that is half a story taller.
    ratio = ALPHA0 * (1.0 + 0.5 / STORIES)
    for quantity, unit, expected, computed, tolerance in (
        ("First period", "s", PERIOD_S, best.period_s, 0.005),
        ("Damping", "1", DAMPING, best.damping, 0.02),
        ("Lateral stiffness ratio", "1", ratio, best.alpha0, 0.025),
        ("Unexplained fraction", "1", 0.0, best.unexplained, 0.01),
    ):
        yield Verified("RM-9", source, quantity, unit, name, expected, computed, tolerance)
