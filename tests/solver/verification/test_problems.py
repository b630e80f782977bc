"""The closed forms against the figures printed for them."""

import math

import pytest

from solver.verification.problems import (
    half_sine_travel,
    harmonic_travel,
    pulse_travel,
    slope_pulse,
    yield_accelerations,
)

G = 9.81


@pytest.mark.parametrize(
    ("amplitude", "mu", "duration", "expected"),
    [(0.4, 0.1, 0.2, 0.235440), (0.5, 0.2, 0.3, 0.331087), (1.0, 0.4, 0.1, 0.073575)],
)
def test_newmarks_rectangular_pulse(amplitude, mu, duration, expected):
    speed = amplitude * G * duration
    newmark = speed**2 / (2 * G * mu) * (1 - mu / amplitude)
    travel_m = pulse_travel(amplitude * G, mu * G, duration, 0.0)
    assert travel_m == pytest.approx(newmark, rel=1e-14)
    assert travel_m == pytest.approx(expected, abs=1e-6)


@pytest.mark.parametrize(
    ("amplitude", "mu", "freq", "expected"),
    [(0.5, 0.2, 1.0, 0.280945), (0.8, 0.4, 2.0, 0.067791), (1.0, 0.1, 1.0, 4.214008)],
)
def test_the_half_sine_pulse(amplitude, mu, freq, expected):
    assert half_sine_travel(amplitude, mu, freq, G) == pytest.approx(expected, abs=1e-6)


def test_the_steady_harmonic():
    assert harmonic_travel(0.5, 0.2, 1.0, G) == pytest.approx(0.193314, abs=1e-6)


@pytest.mark.parametrize(
    ("degrees", "mu", "horizontal", "vertical", "duration", "expected"),
    [
        (5, 0.4, 0.6, 0.0, 0.3, 0.269578),
        (10, 0.5, 0.8, 0.0, 0.15, 0.159855),
        (5, 0.4, 0.6, -0.3, 0.3, 0.404575),
        (5, 0.4, 0.6, 0.3, 0.3, 0.159320),
    ],
)
def test_a_pulse_on_a_slope(degrees, mu, horizontal, vertical, duration, expected):
    drive, resist = slope_pulse(math.radians(degrees), mu, horizontal, vertical, G)
    assert pulse_travel(drive, resist, duration, 0.0) == pytest.approx(expected, abs=1e-6)


def test_yield_accelerations_are_symmetric_on_a_flat_roof_and_lock_on_a_steep_one():
    down, up = yield_accelerations(0.0, 0.4, G)
    assert down == pytest.approx(-0.4 * G)
    assert up == pytest.approx(0.4 * G)
    assert yield_accelerations(math.radians(60), 0.7, G)[1] == math.inf
