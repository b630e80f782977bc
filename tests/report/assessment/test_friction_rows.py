"""Where the friction of an array comes from, in words."""

import pytest

import stand_in
from report.assessment.friction_rows import basis_words
from solver.model import Friction

LAW = Friction(mu_slow=0.40, mu_fast=0.50, rate_s_per_m=20.0, mu_static=0.40)
VELOCITIES = (0.0025, 0.0254, 0.0508, 0.1016)
RANGE = "from 0.10 in/s (2.5 mm/s) to 4.00 in/s (101.6 mm/s)"


def runs(mus, velocities=VELOCITIES):
    return [
        {"surface": "wet", "number": k, "mu": mu, "velocity_mps": v}
        for k, (mu, v) in enumerate(zip(mus, velocities, strict=True), start=1)
    ]


def basis(given, mu=LAW.mu_slow, mu_fast=LAW.mu_fast, rate=LAW.rate_s_per_m):
    law = {"mu": mu, "mu_fast": mu_fast, "mu_rate_s_per_m": rate}
    data = stand_in.project(arrays=[stand_in.array("A1", 1.0, **law)], friction_runs=given)
    return basis_words(data, data.arrays[0])


def test_the_fit_of_the_runs_alone_is_as_tested():
    on_law = runs([LAW.at(v) for v in VELOCITIES])
    assert basis(on_law) == f"as tested: the fit of the wet runs {RANGE}"
    assert basis(on_law, mu=0.396, mu_fast=0.504) == f"as tested: the fit of the wet runs {RANGE}"
    assert basis(on_law, mu=0.39) == f"entered, at or below the tests {RANGE}"
    assert basis(on_law, mu_fast=0.48) == f"entered, at or below the tests {RANGE}"
    above = runs([LAW.at(v) + 0.05 for v in VELOCITIES])
    assert basis(above) == f"entered, at or below the tests {RANGE}"


def test_too_few_velocities_for_a_fit_are_no_fit():
    on_law = runs([LAW.at(v) for v in VELOCITIES[:3]], VELOCITIES[:3])
    assert basis(on_law) == (
        "entered, at or below the tests from 0.10 in/s (2.5 mm/s) to 2.00 in/s (50.8 mm/s)"
    )


@pytest.mark.parametrize(
    ("mu", "says"),
    [
        (0.45, "entered, at or below the tests"),
        (0.48, "entered, on average at or below the tests"),
        (0.501, "entered, on average at or below the tests"),
        (0.504, "entered, on average within 0.005 of the tests"),
    ],
)
def test_one_coefficient_is_entered_however_near_the_mean_it_is(mu, says):
    given = runs((0.457, 0.495, 0.525, 0.527))  # mean 0.501
    assert basis(given, mu, None, None) == f"{says} {RANGE}"


def test_the_velocities_of_the_tests_are_said_as_far_as_they_are_given():
    assert basis(runs((0.5,), (0.0254,)), 0.45, None, None) == (
        "entered, at or below the tests at 1.00 in/s (25.4 mm/s)"
    )
    unknown = [{"surface": "wet", "number": 1, "mu": 0.5}]
    assert basis(unknown, 0.45, None, None) == (
        "entered, at or below the tests (velocities not given)"
    )
    assert basis([]) == "entered; no runs of friction tests are given"
