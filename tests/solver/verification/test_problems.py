"""The closed forms against the figures printed for them."""

import math

import pytest

from solver.verification.reference import (
    half_sine_travel,
    harmonic_travel,
    pulse_travel,
    slope_pulse,
    yield_accelerations,
)

pytestmark = pytest.mark.quick

G = 9.81


def slope_travel(degrees, mu, horizontal, vertical, duration):
    drive, resist = slope_pulse(math.radians(degrees), mu, horizontal, vertical, G)
    return pulse_travel(drive, resist, duration, 0.0)


@pytest.mark.parametrize(
    ("travel", "given", "expected_m"),
    [
        (half_sine_travel, (0.5, 0.2, 1.0, G), 0.280945),
        (half_sine_travel, (0.8, 0.4, 2.0, G), 0.067791),
        (half_sine_travel, (1.0, 0.1, 1.0, G), 4.214008),
        (harmonic_travel, (0.5, 0.2, 1.0, G), 0.193314),
        (slope_travel, (5, 0.4, 0.6, 0.0, 0.3), 0.269578),
        (slope_travel, (10, 0.5, 0.8, 0.0, 0.15), 0.159855),
        (slope_travel, (5, 0.4, 0.6, -0.3, 0.3), 0.404575),
        (slope_travel, (5, 0.4, 0.6, 0.3, 0.3), 0.159320),
        # Newmark's rectangular pulse: A g, mu g, its length, and no ramp.
        (pulse_travel, (0.4 * G, 0.1 * G, 0.2, 0.0), 0.235440),
        (pulse_travel, (0.5 * G, 0.2 * G, 0.3, 0.0), 0.331087),
        (pulse_travel, (1.0 * G, 0.4 * G, 0.1, 0.0), 0.073575),
    ],
)
def test_travels_are_those_printed(travel, given, expected_m):
    assert travel(*given) == pytest.approx(expected_m, abs=1e-6)


def test_yield_accelerations_are_symmetric_on_a_flat_roof_and_lock_on_a_steep_one():
    assert yield_accelerations(0.0, 0.4, G) == pytest.approx((-0.4 * G, 0.4 * G))
    assert yield_accelerations(math.radians(60), 0.7, G)[1] == math.inf
