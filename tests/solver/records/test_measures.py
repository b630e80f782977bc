"""Measures of a record. Oracles: closed forms, SciPy's quadrature and polynomials, mpmath."""

import math

import mpmath
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.interpolate import PPoly

from blocks import record
from solver.records.measures import measures, velocity_displacement

pytestmark = pytest.mark.quick

G = 9.80665

motions = st.lists(st.floats(-20.0, 20.0, width=16), min_size=2, max_size=30).map(np.array)


def pieces(a, dt):
    """Acceleration as a piecewise polynomial, from its samples."""
    return PPoly(np.array([np.diff(a) / dt, a[:-1]]), dt * np.arange(len(a)))


def largest(curve, end):
    """Largest |value| of a piecewise polynomial: at its ends, breaks and stationary points."""
    still = curve.derivative().roots(discontinuity=False, extrapolate=False)
    points = np.concatenate([curve.x, still[np.isfinite(still)]])
    return np.abs(curve(points[(points >= 0.0) & (points <= end)])).max()


UP = np.array([0.0, 0.5, 1.0, 0.5, 0.0])
SINE = np.sin(2.0 * np.pi * np.arange(30001) * 1e-4)
ARIAS = math.pi / (2.0 * G)
CLOSED_FORMS = {
    # The integral of a^2 goes with t^3.
    "a ramp of 3 t for 2 s": (3.0 * 0.01 * np.arange(201), 0.01, 1e-13, {
        "pga_mps2": 6.0, "pgv_mps": 6.0, "final_velocity_mps": 6.0, "pgd_m": 4.0,
        "final_displacement_m": 4.0, "arias_mps": ARIAS * 9.0 * 8.0 / 3.0,
        "d5_95_s": 2.0 * (math.cbrt(0.95) - math.cbrt(0.05)),
    }),
    "a constant acceleration": (np.full(101, -2.0), 0.01, 1e-13, {
        "final_velocity_mps": -2.0, "final_displacement_m": -1.0, "arias_mps": ARIAS * 4.0,
        "d5_95_s": 0.9,
    }),
    # v = t - 2 t^2 peaks at 1/4, d = t^2 / 2 - 2 t^3 / 3 at 1/2.
    "down in one interval from 1 to -3": ([1.0, -3.0], 1.0, 1e-14, {
        "final_displacement_m": -1.0 / 6.0, "pgd_m": 1.0 / 6.0,
    }),
    "the velocity of it": ([1.0, -3.0], 1.0, 1e-15, {"pgv_mps": 1.0, "final_velocity_mps": -1.0}),
    # The velocity turns at 1/3, the displacement at 2/3, inside.
    "from 1 to -2 and to rest": ([1.0, -2.0, 0.0], 1.0, 1e-15, {"pgv_mps": 1.5}),
    "from 1 to -2": ([1.0, -2.0], 1.0, 1e-15, {"pgv_mps": 0.5, "final_displacement_m": 0.0}),
    "the displacement of it": ([1.0, -2.0], 1.0, 1e-14, {"pgd_m": 2.0 / 27.0}),
    "from 1 to -1": ([1.0, -1.0], 1.0, 1e-15, {"pgv_mps": 0.25}),
    # v = (1 - cos) / 2 pi, d = t / 2 pi - sin / 4 pi^2.
    "sin(2 pi t) for 3 s": (SINE, 1e-4, 1e-7, {
        "pgv_mps": 1.0 / math.pi, "pgd_m": 3.0 / (2.0 * math.pi), "arias_mps": ARIAS * 1.5,
    }),
    "the end of it": (SINE, 1e-4, 1e-11, {"final_velocity_mps": 0.0}),
    # Velocity back to zero, displacement kept. A quarter of a triangle's integral from its foot
    # goes with (t / 0.1)^3 / 2.
    "triangles of 1 m/s2 over 0.2 s, up and down": ([*UP, *-UP[1:], 0.0], 0.05, 1e-13, {
        "final_velocity_mps": 0.0, "final_displacement_m": 0.1 * 0.2,
        "arias_mps": ARIAS * 2 * 0.2 / 3, "d5_95_s": 0.4 - 2 * 0.1 * math.cbrt(0.05 * 2 * 2),
    }),
    "the velocity of them": ([*UP, *-UP[1:], 0.0], 0.05, 1e-14, {"pgv_mps": 0.1}),
    "nothing": (np.zeros(50), 0.01, 0.0, dict.fromkeys(
        ("pga_mps2", "pgv_mps", "pgd_m", "arias_mps", "d5_95_s"), 0.0)),
}  # fmt: skip


@pytest.mark.parametrize(
    ("values", "dt_s", "rel", "wanted"), CLOSED_FORMS.values(), ids=CLOSED_FORMS
)
def test_measures_are_those_of_closed_forms(values, dt_s, rel, wanted):
    measured = measures(record(values, dt_s))
    found = {name: getattr(measured, name) for name in wanted}
    assert found == pytest.approx(wanted, rel=rel, abs=1e-3 * rel)


def test_leading_and_trailing_zeros_do_not_change_the_duration():
    wave = np.concatenate([[0.0], np.sin(np.arange(99.0)), [0.0]])
    bare = measures(record(wave)).d5_95_s
    padded = measures(record([*np.zeros(70), *wave, *np.zeros(70)])).d5_95_s
    assert padded == pytest.approx(bare, rel=1e-12)


@given(motions)
def test_peaks_agree_with_roots_of_piecewise_polynomials(a):
    curve = pieces(a, 0.01)
    v, d = curve.antiderivative(), curve.antiderivative(2)
    end = 0.01 * (len(a) - 1)
    measured = measures(record(a))
    size = np.abs(a).max()
    assert measured.pgv_mps == pytest.approx(largest(v, end), rel=1e-10, abs=1e-13 * size)
    assert measured.pgd_m == pytest.approx(largest(d, end), rel=1e-10, abs=1e-15 * size)
    assert measured.final_velocity_mps == pytest.approx(float(v(end)), rel=1e-11, abs=1e-13 * size)
    assert measured.final_displacement_m == pytest.approx(
        float(d(end)), rel=1e-10, abs=1e-15 * size
    )


@given(motions)
def test_duration_is_between_the_times_of_the_shares_by_bisection(a):
    measured = measures(record(a))
    if np.abs(a).max() == 0.0:
        return
    # The square of the acceleration, and its integral, as polynomials of SciPy.
    r, start = np.diff(a) / 0.01, a[:-1]
    squared = PPoly(np.array([r * r, 2 * r * start, start * start]), 0.01 * np.arange(len(a)))
    total = squared.antiderivative()
    end = 0.01 * (len(a) - 1)
    assert measured.arias_mps == pytest.approx(ARIAS * float(total(end)), rel=1e-12)
    times = []
    for share in (0.05, 0.95):
        low, high = 0.0, end
        for _ in range(80):
            middle = 0.5 * (low + high)
            low, high = (middle, high) if total(middle) < share * total(end) else (low, middle)
        times.append(low)
    # A time is no better known than the integral is steep there.
    assert measured.d5_95_s == pytest.approx(times[1] - times[0], abs=1e-6)


def test_a_long_record_agrees_with_fifty_digits(noise):
    dt = mpmath.mpf("0.01")
    v = d = mpmath.mpf(0)
    with mpmath.workdps(50):
        for now, then in zip(noise[:-1].tolist(), noise[1:].tolist(), strict=True):
            now, then = mpmath.mpf(now), mpmath.mpf(then)
            d += v * dt + dt * dt * (2 * now + then) / 6
            v += dt * (now + then) / 2
    measured = measures(record(noise))
    assert measured.final_velocity_mps == pytest.approx(float(v), abs=1e-14)
    assert measured.final_displacement_m == pytest.approx(float(d), abs=1e-13)
    speed, place = velocity_displacement(record(noise))
    assert (speed[-1], place[-1]) == (measured.final_velocity_mps, measured.final_displacement_m)
