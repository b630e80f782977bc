"""The friction of arrays in words, and inputs with other friction."""

import pytest

import stand_in
from report.assessment.friction import at_low_velocity, mu_words, mus_words
from solver.model import Friction, coulomb

pytestmark = pytest.mark.quick

LAW = {"mu": 0.40, "mu_fast": 0.50, "mu_rate_s_per_m": 20.0}


def law(slow, fast, rate, static=None):
    return Friction(
        mu_slow=slow, mu_fast=fast, rate_s_per_m=rate, mu_static=slow if static is None else static
    )


@pytest.mark.parametrize(
    ("friction", "words"),
    [
        (coulomb(0.5), "0.50"),
        (coulomb(0.475), "0.475"),
        (law(0.4, 0.5, 20.0), "0.40 to 0.50, by velocity"),
        (law(0.5, 0.425, 20.0), "0.50 to 0.425, by velocity"),
        (law(0.4, 0.5, 20.0, 0.45), "0.40 to 0.50, by velocity, 0.45 at rest"),
        (law(0.4, 0.4, 0.0, 0.45), "0.40, 0.45 at rest"),
        (law(0.4, 0.5, 0.0), "0.40"),
    ],
)
def test_friction_is_said_as_it_was_run(friction, words):
    assert mu_words(friction) == words


def test_arrays_of_one_friction_are_said_together():
    alike = [stand_in.array("A1", 0.5), stand_in.array("A2", 2.0)]
    data = stand_in.project(arrays=[*alike, stand_in.array("A3", 3.0, **LAW)])
    assert mus_words(data.arrays) == "A1, A2: 0.45; A3: 0.40 to 0.50, by velocity"
    assert mus_words(data.arrays[2:]) == "A3: 0.40 to 0.50, by velocity"


def test_the_low_velocity_coefficient_alone_is_constant_friction():
    given = stand_in.project(arrays=[stand_in.array("A1", 3.0, mu_static=0.48, **LAW)]).arrays[0]
    assert at_low_velocity(given).friction == coulomb(0.40)
    assert at_low_velocity(given).slope_rad == given.slope_rad
