"""Spectra as tables, and scaling to a target. Oracles: closed forms, a record as its own target."""

import math
from functools import partial

import numpy as np
import pytest

import solver
from blocks import record
from refused import refused
from solver.model import InputError
from solver.records.record import Record
from solver.records.spectrum import (
    PERIODS_S,
    design_spectrum,
    factor_to_target,
    response_spectrum,
)
from solver.rules.hazard import ac156_vertical, target_sa_g

pytestmark = pytest.mark.quick

G = 9.80665
LEVEL = partial(target_sa_g, (np.array([0.1, 100.0]), np.array([1.0, 1.0])))


def own_spectrum(a):
    return lambda freq: response_spectrum(a, 0.01, 1.0 / freq) / G


class TestFactor:
    @pytest.mark.parametrize("scale", [0.01, 0.5, 1.0, 3.7])
    def test_a_scaled_copy_of_a_record_on_target_gives_the_factor(self, noise, scale):
        factor = factor_to_target([record(noise / scale)], own_spectrum(noise), (0.1, 3.0))
        assert factor == pytest.approx(scale, rel=1e-12)

    def test_components_count_by_their_mean_logarithm_on_target(self, noise):
        pair = [record(noise / 2.0), record(noise / 8.0)]
        factor = factor_to_target(pair, own_spectrum(noise), (0.1, 3.0))
        assert factor == pytest.approx(4.0, rel=1e-12)
        target = ac156_vertical(s_ds_g=1.2).at
        factor = factor_to_target([record(noise)], target, (0.2, 2.0))
        periods = np.geomspace(0.2, 2.0, 101)
        off = np.log(factor * response_spectrum(noise, 0.01, periods) / G / target(1.0 / periods))
        assert off.mean() == pytest.approx(0.0, abs=1e-12)
        # The target e times too high over a third of the octaves raises the factor by e^(1/3).
        plain = own_spectrum(noise)
        raised = lambda freq: plain(freq) * np.where(1.0 / freq < 0.2, math.e, 1.0)  # noqa: E731
        factor = factor_to_target([record(noise)], raised, (0.1, 0.8))
        assert math.log(factor) == pytest.approx(1.0 / 3.0, abs=0.01)
        with pytest.raises(InputError, match="quiet: is zero throughout; it cannot be scaled"):
            factor_to_target([record(noise), record(np.zeros(9), name="quiet")], LEVEL, (0.2, 2.0))

    @pytest.mark.parametrize("range_s", [(0.0, 1.0), (1.0, 1.0), (2.0, 1.0), (math.nan, 1.0)])
    def test_a_range_that_is_none_is_refused(self, noise, range_s):
        with pytest.raises(InputError, match="give two periods above 0, the second longer"):
            factor_to_target([record(noise)], LEVEL, range_s)


def test_corner_points_are_joined_on_log_log_axes():
    target = np.array([1.0, 100.0]), np.array([0.1, 10.0])
    freq = np.array([0.2, 1.0, 10.0, 31.6227766, 100.0, 500.0])
    assert target_sa_g(target, freq) == pytest.approx(
        [0.1, 0.1, 1.0, 3.16227766, 10.0, 10.0], rel=1e-9
    )


class TestDesignSpectrum:
    # S_DS 1.2, S_D1 0.6: T_S 0.5 s, T_0 0.1 s.
    @pytest.mark.parametrize(
        ("period_s", "sa_g"),
        [(0.0, 0.48), (0.05, 1.2 * 0.7), (0.1, 1.2), (0.3, 1.2), (0.5, 1.2), (1.0, 0.6),
         (4.0, 0.15), (8.0, 0.075), (16.0, 0.01875), (math.inf, 0.0)],
    )  # fmt: skip
    def test_ordinates_by_hand(self, period_s, sa_g):
        target = design_spectrum(s_ds_g=1.2, s_d1_g=0.6, t_l_s=8.0)
        freq = np.array([1.0 / period_s if period_s else math.inf])
        assert target(freq) == pytest.approx([sa_g], rel=1e-13)

    def test_a_design_spectrum_is_continuous_and_what_cannot_be_named(self):
        target = design_spectrum(s_ds_g=1.566, s_d1_g=0.83, t_l_s=6.0)
        for period in (0.2 * 0.83 / 1.566, 0.83 / 1.566, 6.0):
            below, above = target(1.0 / (period * np.array([1 - 1e-9, 1 + 1e-9])))
            assert below == pytest.approx(above, rel=1e-8)
        problems = refused(design_spectrum, s_ds_g=0.0, s_d1_g=-1.0, t_l_s=math.nan)
        assert problems == (
            "S_DS is 0 g; give a number above 0",
            "S_D1 is -1 g; give a number above 0",
            "T_L is nan s; give a number above 0",
        )
        (problem,) = refused(design_spectrum, s_ds_g=1.2, s_d1_g=0.6, t_l_s=0.4)
        assert "T_L is 0.4 s; give more than T_S = 0.5 s" in problem


PERIODS = [0.0, 0.3, 1.0]


def test_spectra_have_names_periods_and_scaled_components(noise):
    record = Record(name="RM1", dt_s=0.01, a_mps2=noise)
    frame = solver.spectrum(record, PERIODS, damping=0.02).to_frame()
    assert frame.index.name == "period_s"
    assert frame.index.tolist() == PERIODS
    np.testing.assert_array_equal(frame["RM1"], response_spectrum(noise, 0.01, PERIODS, 0.02))
    motion = solver.motion(noise, az_mps2=0.5 * noise, dt_s=0.01, scale=2.0)
    found = solver.spectrum(motion, PERIODS)
    assert list(found.sa_mps2) == ["x", "z"]
    np.testing.assert_allclose(found.sa_mps2["x"], 2.0 * response_spectrum(noise, 0.01, PERIODS))
    np.testing.assert_allclose(found.sa_mps2["x"], 2.0 * found.sa_mps2["z"])
    peaks = (found.sa_mps2[name].max() for name in "xz")
    told = ", ".join(
        f"{name} up to {peak:.3g} m/s2" for name, peak in zip("xz", peaks, strict=True)
    )
    assert repr(found) == f"ResponseSpectrum: 3 periods, 5 %; {told}"
    found = solver.spectrum(Record(name="a", dt_s=0.01, a_mps2=noise[:200]))
    assert found.periods_s.tolist() == PERIODS_S.tolist()
    with pytest.raises(InputError, match="periods: give one column"):
        solver.spectrum(Record(name="a", dt_s=0.01, a_mps2=noise), [-1.0])
