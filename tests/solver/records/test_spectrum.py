"""Records and spectra. Oracles: files read back, closed forms, matrix exponentials."""

import itertools
import math
from functools import partial

import mpmath
import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

import solver
from fixtures.blocks import record
from fixtures.errors import input_problems
from modal_oracle import psa_g
from solver.errors import InputError
from solver.formats import read_record
from solver.records import spectrum
from solver.records.record import UNITS, Record, record_from_values, write_record
from solver.records.spectrum import PERIODS_S, design_spectrum, factor_to_target, response_spectrum
from solver.rules.ac156 import ac156_vertical, target_sa_g

G = 9.80665

motions = st.lists(st.floats(-20.0, 20.0, width=32), min_size=2, max_size=40).map(np.array)


class TestPastedValues:
    @pytest.mark.quick
    def test_pasted_values_make_the_record_of_a_file_or_are_named_by_their_place(self, file):
        values = [0.1, None, "0,2", math.nan, 3, True, 10**400]
        problems = input_problems(record_from_values, "Motions!D", values, units="g", dt_s=0.01)
        assert [problem.split(";")[0] for problem in problems] == [
            "Motions!D: value 2 is None",
            "Motions!D: value 3 is '0,2'",
            "Motions!D: value 4 is nan",
            "Motions!D: value 6 is True",
            "Motions!D: value 7 is 1000000000000000000000000000...0",
        ]
        (problem,) = input_problems(record_from_values, "M1", [1.0], units="g", dt_s=0.01)
        assert "enter at least 2 values" in problem
        pasted = record_from_values("M1", np.array([1.0, 2.5]), units="g", dt_s=0.5)
        filed = read_record(file("0,1\n0.5,2.5\n"), units="g")
        assert pasted.dt_s == filed.dt_s
        assert pasted.a_mps2.tolist() == filed.a_mps2.tolist()


class TestWriting:
    @pytest.fixture
    def path(self, tmp_path):
        return tmp_path / "m1.csv"

    @pytest.mark.parametrize("dt_s", [0.005, 0.02, 1 / 128, 1 / 3])
    def test_a_rounded_record_comes_back_bit_for_bit(self, path, dt_s):
        counts = np.random.default_rng(1).integers(-150_000, 150_000, 500)
        given = record(counts / 1e5 * G, dt_s)
        write_record(path, given)
        back = read_record(path, units="g")
        assert np.array_equal(back.a_mps2, given.a_mps2)
        assert back.dt_s == pytest.approx(dt_s, rel=1e-9)

    def test_the_file_is_plain_csv_without_idle_decimals(self, path):
        write_record(path, record(np.array([0.0, -1e-9, 0.25]) * G, 0.005))
        expected = b"time_s,acceleration_g\n0.000,0.00000\n0.005,0.00000\n0.010,0.25000\n"
        assert path.read_bytes() == expected
        write_record(path, record(np.array([0.0, 0.25, -0.125]) * G), within=1e-9)
        rows = ["0.00,0.00000", "0.01,0.25000", "0.02,-0.12500"]
        assert path.read_text().splitlines()[1:] == rows

    @pytest.mark.parametrize("unit", sorted(UNITS))
    def test_any_unit_keeps_a_hundred_thousandth_of_g(self, path, unit):
        values = np.random.default_rng(2).normal(0.0, 3.0, 200)
        write_record(path, record(values), unit)
        assert np.abs(read_record(path, units=unit).a_mps2 - values).max() < 1e-5 * G

    @pytest.mark.parametrize("peak_g", [1e-12, 3e-4, 0.7, 1.0, 9.9])
    def test_a_record_of_any_size_is_kept_to_the_part_of_its_peak_asked_for(self, path, peak_g):
        values = np.random.default_rng(3).uniform(-1.0, 1.0, 300) * peak_g * G
        write_record(path, record(values), within=1e-9)
        back = read_record(path, units="g").a_mps2
        assert np.abs(back - values).max() <= 1.001e-9 * np.abs(values).max()


def exact_states(a, dt, omega, damping):
    """State u, u' at the samples, by a 40-digit matrix exponential of the whole system.

    The system is u, u', acceleration now and its rate in the interval.
    """
    system = mpmath.matrix(
        [[0, 1, 0, 0], [-(omega**2), -2 * damping * omega, -1, 0], [0, 0, 0, 1], [0] * 4]
    )
    step = mpmath.expm(system * dt, method="taylor")
    states = [(mpmath.mpf(0), mpmath.mpf(0))]
    for now, then in itertools.pairwise(map(mpmath.mpf, a)):
        states.append(tuple((step * mpmath.matrix([*states[-1], now, (then - now) / dt]))[:2]))
    return states


def top_of_cubic(h, start, end):
    """Largest |u| of the cubic with the values and slopes of both ends."""
    (u, v), (w, x) = start, end
    p, q = 3 * (w - u) - (2 * v + x) * h, (v + x) * h - 2 * (w - u)
    places = [mpmath.mpf(1)]
    if q:
        root = mpmath.sqrt(mpmath.mpc(p * p - 3 * q * v * h))
        places += [s.real for s in ((root - p) / (3 * q), (-root - p) / (3 * q)) if not s.imag]
    return max(abs(u + s * (v * h + s * (p + s * q))) for s in places if 0 < s <= 1)


def exact_psa(a, dt, period, damping):
    """Largest omega^2 |u|, on cubics through exact states where a step is up to a radian."""
    with mpmath.workdps(40):
        w, h = 2 * mpmath.pi / mpmath.mpf(period), mpmath.mpf(dt)
        states = exact_states(a, h, w, mpmath.mpf(damping))
        peak = max(abs(u) for u, _ in states)
        if w * h <= 1:
            peak = max(peak, *(top_of_cubic(h, *ends) for ends in itertools.pairwise(states)))
        return float(w * w * peak)


class TestSpectrum:
    @pytest.mark.parametrize("damping", [0.0, 0.05, 0.7, 0.99])
    def test_it_agrees_with_matrix_exponentials_to_rounding(self, damping):
        a = np.random.default_rng(3).normal(0.0, 2.0, 40)
        periods = [1e-3, 0.02, 0.0314159, 0.0628, 0.0629, 0.1, 0.5, 3.0, 50.0, 1e4, 1e8]
        steps = [min(2 ** math.ceil(math.log2(max(0.16 / each, 1.0))), 16) for each in periods]
        expected = [
            exact_psa(spectrum.refined(a, n).tolist(), 0.01 / n, period, damping)
            for n, period in zip(steps, periods, strict=True)
        ]
        got = response_spectrum(a, 0.01, periods, damping)
        assert got == pytest.approx(expected, rel=2e-13)

    @given(motions)
    def test_period_zero_is_the_peak_acceleration(self, a):
        near, at = response_spectrum(a, 0.01, [1e-9, 0.0])
        assert at == np.abs(a).max()
        assert response_spectrum(a, 0.01, [5e-324])[0] == at
        seen = spectrum.refined(a, spectrum.PEAK_STEPS)[1:]
        assert near == pytest.approx(np.abs(seen).max(), rel=1e-5, abs=1e-6)
        assert response_spectrum(np.zeros(10), 0.01, [0.0, 0.1, 1.0]).tolist() == [0.0] * 3

    @given(motions)
    @example(a=np.array([1.0, -2.0]))
    def test_samples_put_between_the_samples_change_nothing(self, a):
        half = np.arange(2 * len(a) - 1) / 2.0
        finer = np.interp(half, np.arange(len(a)), a)
        for period in (0.01, 0.03, 0.4, 7.0):
            (coarse,) = response_spectrum(a, 0.01, [period])
            # A cubic of a step of p radians is off by p^4/384 of the oscillator's acceleration,
            # which counts in the first steps, where its displacement is still small.
            p = 2.0 * math.pi * min(0.01 / period, 1.0 / 16.0)
            off = 2.0 * p**4 / 384.0 * float(np.abs(a).max())
            (fine,) = response_spectrum(finer, 0.005, [period])
            assert fine == pytest.approx(coarse, rel=2e-4, abs=off)

    @pytest.mark.parametrize("period_s", [0.02, 0.05, 0.1, 0.3, 1.2, 5.0])
    def test_peaks_between_samples_are_seen(self, period_s):
        rng = np.random.default_rng(8)
        for _ in range(20):
            a = rng.normal(0.0, 1.0, 300)
            (peak,) = response_spectrum(a, 0.02, [period_s]) / G
            (true,) = psa_g(a, 0.02, [1.0 / period_s], places=4000)
            assert peak == pytest.approx(true, rel=2e-4)

    @pytest.mark.parametrize(
        ("how", "expected"),
        [
            ({"a_mps2": [1.0, math.nan]}, "acceleration: enter one column of finite numbers"),
            ({"a_mps2": [[1.0, 2.0]]}, "acceleration: enter one column"),
            ({"a_mps2": []}, "acceleration: enter one column"),
            ({"dt_s": 0.0}, "time step dt is 0.0; enter a number of seconds above 0"),
            ({"periods_s": [-1.0]}, "periods: enter one column of numbers of seconds, 0 or above"),
            ({"periods_s": [math.nan]}, "periods: enter one column"),
            ({"damping": 1.0}, "damping is 1.0; enter a fraction from 0 to below 1"),
        ],
    )
    @pytest.mark.quick
    def test_impossible_arguments_are_refused(self, how, expected):
        arguments = {"a_mps2": [0.0, 1.0], "dt_s": 0.1, "periods_s": [1.0]} | how
        assert input_problems(response_spectrum, **arguments)[0].startswith(expected)


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
        with pytest.raises(InputError, match="enter two periods above 0, the second longer"):
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
        problems = input_problems(design_spectrum, s_ds_g=0.0, s_d1_g=-1.0, t_l_s=math.nan)
        assert problems == (
            "S_DS is 0 g; enter a number above 0",
            "S_D1 is -1 g; enter a number above 0",
            "T_L is nan s; enter a number above 0",
        )
        (problem,) = input_problems(design_spectrum, s_ds_g=1.2, s_d1_g=0.6, t_l_s=0.4)
        assert "T_L is 0.4 s; enter more than T_S = 0.5 s" in problem


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
    assert repr(found) == f"ResponseSpectrum: 3 periods, 5%; {told}"
    found = solver.spectrum(Record(name="a", dt_s=0.01, a_mps2=noise[:200]))
    assert found.periods_s.tolist() == PERIODS_S.tolist()
    with pytest.raises(InputError, match="periods: enter one column"):
        solver.spectrum(Record(name="a", dt_s=0.01, a_mps2=noise), [-1.0])
