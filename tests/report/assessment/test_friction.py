"""The friction of arrays in words, where it comes from, and inputs with other friction."""

import pytest

import stand_in
from report.assessment.friction import at_low_velocity, mu_words, mus_words
from report.assessment.requirement_rows import basis_words
from solver.model import Friction, coulomb

pytestmark = pytest.mark.quick

LAW = {"mu": 0.40, "mu_fast": 0.50, "mu_rate_s_per_m": 20.0}


def law(slow, fast, rate, static=None):
    static = slow if static is None else static
    return Friction(mu_slow=slow, mu_fast=fast, rate_s_per_m=rate, mu_static=static)


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


def test_arrays_of_one_friction_and_the_low_velocity_coefficient_are_said():
    alike = [stand_in.array("A1", 0.5), stand_in.array("A2", 2.0)]
    data = stand_in.project(arrays=[*alike, stand_in.array("A3", 3.0, **LAW)])
    assert mus_words(data.arrays) == "A1, A2: 0.45; A3: 0.40 to 0.50, by velocity"
    assert mus_words(data.arrays[2:]) == "A3: 0.40 to 0.50, by velocity"
    given = stand_in.project(arrays=[stand_in.array("A1", 3.0, mu_static=0.48, **LAW)]).arrays[0]
    assert at_low_velocity(given).friction == coulomb(0.40)
    assert at_low_velocity(given).slope_rad == given.slope_rad


FITTED = law(0.40, 0.50, 20.0)
VELOCITIES = (0.0025, 0.0254, 0.0508, 0.1016)
RANGE = "from 0.10 in/s (2.5 mm/s) to 4.00 in/s (101.6 mm/s)"


def runs(mus, velocities=VELOCITIES):
    return [
        {"surface": "wet", "number": k, "mu": mu, "velocity_mps": v}
        for k, (mu, v) in enumerate(zip(mus, velocities, strict=True), start=1)
    ]


def constant(mu):
    return {"mu": mu, "mu_fast": None, "rate": None}


def basis(given, mu=FITTED.mu_slow, mu_fast=FITTED.mu_fast, rate=FITTED.rate_s_per_m):
    law = {"mu": mu, "mu_fast": mu_fast, "mu_rate_s_per_m": rate}
    data = stand_in.project(arrays=[stand_in.array("A1", 1.0, **law)], friction_runs=given)
    return basis_words(data, data.arrays[0])


ON_FITTED = runs([FITTED.at(v) for v in VELOCITIES])
NEAR = runs((0.457, 0.495, 0.525, 0.527))  # mean 0.501


@pytest.mark.parametrize(
    ("given", "law", "says"),
    [
        (ON_FITTED, {}, "as tested: the fit of the wet runs"),
        (ON_FITTED, {"mu": 0.396, "mu_fast": 0.504}, "as tested: the fit of the wet runs"),
        (ON_FITTED, {"mu": 0.39}, "entered, at or below the tests"),
        (ON_FITTED, {"mu_fast": 0.48}, "entered, at or below the tests"),
        (runs([FITTED.at(v) + 0.05 for v in VELOCITIES]), {}, "entered, at or below the tests"),
        (NEAR, constant(0.45), "entered, at or below the tests"),
        (NEAR, constant(0.48), "entered, on average at or below the tests"),
        (NEAR, constant(0.501), "entered, on average at or below the tests"),
        (NEAR, constant(0.504), "entered, on average within 0.005 of the tests"),
    ],
)
def test_the_fit_alone_is_as_tested_and_one_coefficient_is_entered(given, law, says):
    assert basis(given, **law) == f"{says} {RANGE}"


@pytest.mark.parametrize(
    ("given", "law", "says"),
    [
        (runs([FITTED.at(v) for v in VELOCITIES[:3]], VELOCITIES[:3]), {},
         "entered, at or below the tests from 0.10 in/s (2.5 mm/s) to 2.00 in/s (50.8 mm/s)"),
        (runs((0.5,), (0.0254,)), constant(0.45),
         "entered, at or below the tests at 1.00 in/s (25.4 mm/s)"),
        (runs((0.5,), (None,)), constant(0.45),
         "entered, at or below the tests (velocities not given)"),
        ([], {}, "entered; no runs of friction tests are given"),
    ],
    ids=["too few velocities for a fit", "one velocity", "no velocity", "no runs"],
)  # fmt: skip
def test_the_velocities_of_the_tests_are_said_as_far_as_they_are_given(given, law, says):
    assert basis(given, **law) == says
