"""The spread of the motions' spectra, and what the limits of a study say of it."""

import dataclasses
import math

import numpy as np
import pytest

from report.study.basis_pages import limits
from report.study.run import planned, run_study
from report.study.spread import spectral_spread
from studied import motion
from test_study_read import given, write


def like(number, factor):
    return dataclasses.replace(motion(number), scale=factor)


def test_scaled_copies_of_a_motion_differ_by_the_spread_of_their_factors():
    factors = (0.5, 1.0, 1.7)
    found = spectral_spread([[like(1, factor) for factor in factors]])
    wanted = np.std(np.log(factors), ddof=1)
    assert found.median == pytest.approx(wanted, rel=1e-12)
    assert found.largest == pytest.approx(wanted, rel=1e-12)
    assert not found.is_one_spectrum


def test_copies_of_a_motion_are_one_spectrum_and_different_ones_are_not():
    assert spectral_spread([[like(1, 1.0), like(1, 1.05)]]).is_one_spectrum
    assert not spectral_spread([[motion(k) for k in range(4)]]).is_one_spectrum


def test_each_building_has_its_own_motions():
    one, two = [like(1, 1.0), like(1, 1.0)], [like(2, 1.0), like(2, 2.0)]
    assert spectral_spread([one, two]).largest == pytest.approx(np.log(2.0) / math.sqrt(2.0))


def test_one_motion_or_a_component_of_zeros_has_no_spread():
    zeros = dataclasses.replace(motion(1), ay_mps2=np.zeros(400))
    beside = dataclasses.replace(motion(2), ay_mps2=motion(3).ax_mps2)
    for motions in ([motion(1)], [zeros, beside]):
        found = spectral_spread([motions])
        assert not found.is_known
        assert not found.is_one_spectrum


@pytest.fixture(scope="module")
def results(tmp_path_factory):
    folder = write(tmp_path_factory.mktemp("spread"), given(study_arrays=()), motions=3)
    return run_study(planned(folder)[0], folder / "out")


def said(results, motions):
    spread = spectral_spread([motions])
    (block,) = limits(dataclasses.replace(results, spread=spread)).blocks
    return " ".join(block.items)


def test_the_limits_name_the_spread_and_call_it_small_only_where_it_is(results):
    alike = said(results, [like(1, 1.0), like(1, 1.02)])
    assert "almost no record-to-record spread: the 84th percentile does not contain" in alike
    assert "standard deviation of ln Sa of 0.015 in the median and 0.015 at most" in alike
    other = said(results, [motion(k) for k in range(4)])
    assert "differ by a standard deviation of ln Sa of" in other
    assert "almost no record-to-record spread" not in other
    assert "spectra of the" not in said(results, [motion(1)])


def test_the_limits_state_the_validation(results):
    assert "has not been validated against shake-table tests" in said(results, [motion(1)])
