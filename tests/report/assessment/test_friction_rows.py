"""Where the friction of an array comes from, in words."""

import pytest

import stand_in
from report.assessment.requirement_rows import basis_words
from solver.model import Friction

pytestmark = pytest.mark.quick

LAW = Friction(mu_slow=0.40, mu_fast=0.50, rate_s_per_m=20.0, mu_static=0.40)
VELOCITIES = (0.0025, 0.0254, 0.0508, 0.1016)
RANGE = "from 0.10 in/s (2.5 mm/s) to 4.00 in/s (101.6 mm/s)"


def runs(mus, velocities=VELOCITIES):
    return [
        {"surface": "wet", "number": k, "mu": mu, "velocity_mps": v}
        for k, (mu, v) in enumerate(zip(mus, velocities, strict=True), start=1)
    ]


def constant(mu):
    return {"mu": mu, "mu_fast": None, "rate": None}


def basis(given, mu=LAW.mu_slow, mu_fast=LAW.mu_fast, rate=LAW.rate_s_per_m):
    law = {"mu": mu, "mu_fast": mu_fast, "mu_rate_s_per_m": rate}
    data = stand_in.project(arrays=[stand_in.array("A1", 1.0, **law)], friction_runs=given)
    return basis_words(data, data.arrays[0])


ON_LAW = runs([LAW.at(v) for v in VELOCITIES])
NEAR = runs((0.457, 0.495, 0.525, 0.527))  # mean 0.501


@pytest.mark.parametrize(
    ("given", "law", "says"),
    [
        (ON_LAW, {}, "as tested: the fit of the wet runs"),
        (ON_LAW, {"mu": 0.396, "mu_fast": 0.504}, "as tested: the fit of the wet runs"),
        (ON_LAW, {"mu": 0.39}, "entered, at or below the tests"),
        (ON_LAW, {"mu_fast": 0.48}, "entered, at or below the tests"),
        (runs([LAW.at(v) + 0.05 for v in VELOCITIES]), {}, "entered, at or below the tests"),
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
        (runs([LAW.at(v) for v in VELOCITIES[:3]], VELOCITIES[:3]), {},
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
