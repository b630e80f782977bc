"""The oscillator against closed forms: a load that steps up stays, and one at rest."""

import math

import numpy as np
import pytest

from blocks import readonly
from solver.kernels import oscillator

pytestmark = pytest.mark.quick


@pytest.mark.parametrize("zeta", [0.0, 0.05, 0.3])
def test_a_sudden_load_overshoots_by_the_textbook_factor(zeta):
    n, dt, omega, load = 100, 0.01, 2.0 * math.pi, 3.0
    peak, at = np.zeros(1), np.zeros(1, dtype=np.int64)
    record = np.full(n, load)
    oscillator.peaks(readonly(record), dt, np.array([omega]), zeta, peak, at)
    kappa = math.sqrt(1.0 - zeta * zeta)
    # A. K. Chopra, Dynamics of Structures: step force, u_max = u_st (1 + exp(-pi zeta / kappa)).
    assert -peak[0] == pytest.approx(load * (1.0 + math.exp(-math.pi * zeta / kappa)), rel=1e-6)
    assert at[0] * dt == pytest.approx(0.5 / kappa, abs=dt)


def test_peaks_are_the_largest_of_all_cubics_between_the_samples():
    n, dt, zeta = 120, 0.01, 0.05
    a = np.random.default_rng(4).standard_normal(n)
    omega = np.concatenate([np.geomspace(0.5, 99.0, 18), [150.0]])
    peak, at = np.zeros(len(omega)), np.zeros(len(omega), dtype=np.int64)
    oscillator.peaks(readonly(a), dt, omega, zeta, peak, at)
    for k in range(len(omega)):
        value, sample = largest(a, dt, omega[k], zeta)
        assert peak[k] == pytest.approx(value, rel=1e-6)
        assert at[k] == sample


def largest(a, dt, omega, zeta):
    """Peak and step by the matrix exponential, and each cubic at 2,000 points."""
    p, vectors = omega * dt, of_a_step(omega * dt, zeta)
    s = np.linspace(0.0, 1.0, 2001) if p <= 1.0 else np.array([1.0])
    y = z = 0.0
    best, where = 0.0, 0
    for i in range(1, len(a)):
        moved, turned = (vectors @ [y, z, a[i - 1], (a[i] - a[i - 1]) / p])[:2]
        first, last = p * z, p * turned
        cubic = y + s * (first + s * (3 * (moved - y) - 2 * first - last
                                      + s * (first + last - 2 * (moved - y))))  # fmt: skip
        top = cubic[np.abs(cubic).argmax()]
        if abs(top) > abs(best) * (1.0 + 1e-9):
            best, where = top, i
        y, z = moved, turned
    return best, where


def of_a_step(p, zeta):
    """The matrix exponential of a step, of p in the time omega t."""
    # y' = z, z' = -y - 2 zeta z - a - r tau, and r are constants.
    rates = np.array([[0, 1, 0, 0], [-1, -2 * zeta, -1, 0], [0, 0, 0, 1], [0, 0, 0, 0.0]])
    return np.linalg.matrix_power(np.eye(4) + rates * p / 2**24, 2**24)


def test_crests_are_the_samples_that_exceed_their_neighbors_and_the_limit():
    n, dt, zeta = 200, 0.01, 0.05
    a = np.random.default_rng(5).standard_normal(n)
    omega, above = np.array([20.0, 60.0]), np.array([0.3, 0.5])
    which, where, values = oscillator.crests(readonly(a), dt, omega, zeta, above)
    expected = []
    for k, p in enumerate(omega * dt):
        vectors, y, z = of_a_step(p, zeta), [0.0], 0.0
        for i in range(1, n):
            moved, z = (vectors @ [y[-1], z, a[i - 1], (a[i] - a[i - 1]) / p])[:2]
            y.append(moved)
        far = np.abs(y)
        expected += [(k, i) for i in range(1, n - 1)
                     if far[i] > above[k] and far[i - 1] <= far[i] > far[i + 1]]  # fmt: skip
        own = which == k
        assert values[own] == pytest.approx(np.array(y)[where[own]], rel=1e-6)
    assert list(zip(which, where, strict=True)) == expected
    assert len(expected) > 10


def test_reversed_pulses_are_second_differences_of_the_response_to_a_ramp():
    n, zeta, radians, at = 400, 0.05, np.array([0.05, 0.4, 2.0]), np.array([399, 150, 0])
    out = np.zeros((3, n))
    begin = oscillator.reversed_pulses(radians, zeta, at, 1e-3, out)
    kappa = math.sqrt(1.0 - zeta**2)
    for k in range(3):
        w = radians[k] * np.arange(n + 1)
        h = np.exp(-zeta * w) * np.sin(kappa * w) / kappa
        once = 1.0 - np.exp(-zeta * w) * np.cos(kappa * w) - zeta * h
        ramp = np.append(0.0, w - h - 2.0 * zeta * once)
        pulse = np.diff(ramp, n=2) / -radians[k]
        filled = slice(begin[k], at[k] + 1)
        assert out[k, filled][::-1] == pytest.approx(pulse[: at[k] + 1 - begin[k]], abs=1e-12)
        assert not out[k, : begin[k]].any()
        assert not out[k, at[k] + 1 :].any()
    # exp(-0.05 * 0.4 * 346) = 1e-3
    assert list(begin) == [0, 0, 0]
    begin = oscillator.reversed_pulses(np.array([0.4]), zeta, np.array([399]), 1e-3, out[:1])
    assert begin[0] == 399 - 346
