"""Measures of a record. Oracles: closed forms, SciPy's quadrature and polynomials, mpmath."""

import math

import mpmath
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.interpolate import PPoly

from solver.records.measures import measures, velocity_displacement
from solver.records.record import Record

G = 9.80665

motions = st.lists(st.floats(-20.0, 20.0, width=16), min_size=2, max_size=30).map(np.array)


def record(values, dt_s=0.01):
    return Record(name="r", dt_s=dt_s, a_mps2=np.asarray(values, dtype=float))


def pieces(a, dt):
    """Acceleration as a piecewise polynomial, from its samples."""
    return PPoly(np.array([np.diff(a) / dt, a[:-1]]), dt * np.arange(len(a)))


def largest(curve, end):
    """Largest |value| of a piecewise polynomial: at its ends, breaks and stationary points."""
    still = curve.derivative().roots(discontinuity=False, extrapolate=False)
    points = np.concatenate([curve.x, still[np.isfinite(still)]])
    return np.abs(curve(points[(points >= 0.0) & (points <= end)])).max()


def test_a_ramp_gives_its_closed_forms():
    # a = 3 t for 2 s.
    measured = measures(record(3.0 * 0.01 * np.arange(201)))
    assert measured.pga_mps2 == pytest.approx(6.0, rel=1e-13)
    assert measured.pgv_mps == measured.final_velocity_mps == pytest.approx(6.0, rel=1e-13)
    assert measured.pgd_m == measured.final_displacement_m == pytest.approx(4.0, rel=1e-13)
    assert measured.arias_mps == pytest.approx(math.pi / (2 * G) * 9.0 * 8.0 / 3.0, rel=1e-13)
    # The integral of a^2 goes with t^3.
    expected = 2.0 * (math.cbrt(0.95) - math.cbrt(0.05))
    assert measured.d5_95_s == pytest.approx(expected, rel=1e-13)


def test_a_constant_acceleration_gives_its_closed_forms():
    measured = measures(record(np.full(101, -2.0)))
    assert measured.final_velocity_mps == pytest.approx(-2.0, rel=1e-13)
    assert measured.final_displacement_m == pytest.approx(-1.0, rel=1e-13)
    assert measured.arias_mps == pytest.approx(math.pi / (2 * G) * 4.0, rel=1e-13)
    assert measured.d5_95_s == pytest.approx(0.9, rel=1e-13)


def test_peaks_between_samples_are_found():
    # Down in one interval from 1 to -3: v = t - 2 t^2 peaks at 1/4, d = t^2 / 2 - 2 t^3 / 3 at 1/2.
    measured = measures(record([1.0, -3.0], dt_s=1.0))
    assert measured.pgv_mps == pytest.approx(1.0, rel=1e-15)
    assert measured.final_velocity_mps == pytest.approx(-1.0, rel=1e-15)
    assert measured.final_displacement_m == pytest.approx(-1.0 / 6.0, rel=1e-14)
    assert measured.pgd_m == pytest.approx(1.0 / 6.0, rel=1e-14)
    # From 1 to -2: the velocity turns at 1/3, the displacement at 2/3, inside.
    measured = measures(record([1.0, -2.0, 0.0], dt_s=1.0))
    assert measured.pgv_mps == pytest.approx(1.5, rel=1e-15)
    back = measures(record([1.0, -2.0], dt_s=1.0))
    assert back.pgv_mps == pytest.approx(0.5, rel=1e-15)
    assert back.pgd_m == pytest.approx(2.0 / 27.0, rel=1e-14)
    assert back.final_displacement_m == pytest.approx(0.0, abs=1e-16)
    inside = measures(record([1.0, -1.0], dt_s=1.0))
    assert inside.pgv_mps == pytest.approx(0.25, rel=1e-15)


def test_a_fine_sine_comes_near_the_closed_form_of_the_sine():
    # a = sin(2 pi t) for 3 s: v = (1 - cos) / 2 pi, d = t / 2 pi - sin / 4 pi^2.
    t = np.arange(30001) * 1e-4
    measured = measures(record(np.sin(2 * np.pi * t), dt_s=1e-4))
    assert measured.pgv_mps == pytest.approx(1.0 / math.pi, rel=1e-7)
    assert measured.final_velocity_mps == pytest.approx(0.0, abs=1e-14)
    assert measured.pgd_m == pytest.approx(3.0 / (2.0 * math.pi), rel=1e-7)
    assert measured.arias_mps == pytest.approx(math.pi / (2 * G) * 1.5, rel=1e-7)


def test_a_pulse_gives_its_closed_forms():
    # A triangle of 1 m/s2 over 0.2 s, then one of -1: velocity back to zero, displacement kept.
    up = [0.0, 0.5, 1.0, 0.5, 0.0]
    measured = measures(record([*up, *(-np.array(up[1:])), 0.0], dt_s=0.05))
    assert measured.pgv_mps == pytest.approx(0.1, rel=1e-14)
    assert measured.final_velocity_mps == pytest.approx(0.0, abs=1e-16)
    assert measured.final_displacement_m == pytest.approx(0.1 * 0.2, rel=1e-13)
    assert measured.arias_mps == pytest.approx(math.pi / (2 * G) * 2 * 0.2 / 3, rel=1e-13)
    # A quarter of a triangle's integral from its foot goes with (t / 0.1)^3 / 2.
    early = 0.1 * math.cbrt(0.05 * 2 * 2)
    assert measured.d5_95_s == pytest.approx(0.4 - 2 * early, rel=1e-13)


def test_a_record_of_zeros_has_no_duration():
    measured = measures(record(np.zeros(50)))
    assert (measured.pga_mps2, measured.pgv_mps, measured.pgd_m) == (0.0, 0.0, 0.0)
    assert (measured.arias_mps, measured.d5_95_s) == (0.0, 0.0)


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
    assert measured.arias_mps == pytest.approx(math.pi / (2 * G) * float(total(end)), rel=1e-12)
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
