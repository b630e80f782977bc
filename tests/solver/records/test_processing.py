"""Processing of records. Oracles: SciPy's filters and polynomials, sines, the solver itself."""

import math

import numpy as np
import pytest
from scipy import signal

from blocks import record
from refused import refused
from solver.records.measures import measures
from solver.records.processing import Processing, process, process_together
from solver.sliding.checked import slide

pytestmark = pytest.mark.quick

G = 9.80665


def wave(hz, seconds, dt_s=0.01):
    return np.sin(2 * np.pi * hz * dt_s * np.arange(round(seconds / dt_s) + 1))


def burst(hz, seconds=400.0, dt_s=0.01):
    """A sine that swells and fades, so that next to nothing is left of it at the ends."""
    t = dt_s * np.arange(round(seconds / dt_s) + 1)
    return np.sin(2 * np.pi * hz * t) * np.exp(-0.5 * ((t - seconds / 2) / (seconds / 16)) ** 2)


def test_the_defaults_leave_the_record_and_steps_come_in_order(noise):
    source = record(noise, name="N1")
    processed = process(source, Processing())
    assert np.array_equal(processed.a_mps2, noise)
    assert (processed.dt_s, processed.name) == (0.01, "N1")
    assert not processed.a_mps2.flags.writeable
    assert noise.flags.writeable
    stepped, whole = record(noise), {}
    for step in (
        {"from_s": 1.0, "to_s": 18.0},
        {"baseline": 1},
        {"highpass_hz": 0.2, "lowpass_hz": 20.0, "order": 3},
        {"dt_s": 0.005},
        {"pad_s": 2.0},
    ):
        whole |= step
        stepped = process(stepped, Processing(**step))
    assert np.array_equal(process(record(noise), Processing(**whole)).a_mps2, stepped.a_mps2)


@pytest.mark.parametrize(
    ("from_s", "to_s", "kept"),
    [
        pytest.param(0.1, 0.3, range(10, 31), id="samples at the bounds"),
        pytest.param(0.101, 0.309, range(11, 31), id="bounds between samples"),
        pytest.param(0.9, 1e9, range(90, 101), id="an end after the record"),
    ],
)
def test_a_record_is_cut_to_the_samples_within_the_bounds(from_s, to_s, kept):
    processed = process(record(np.arange(101.0)), Processing(from_s=from_s, to_s=to_s))
    assert processed.a_mps2.tolist() == list(kept)


class TestBaseline:
    @pytest.mark.parametrize("degree", range(9))
    def test_a_polynomial_is_taken_off_whole(self, degree):
        x = np.linspace(0.0, 1.0, 500)
        drift = np.polyval(np.random.default_rng(degree).normal(size=degree + 1), x)
        a_mps2 = process(record(drift), Processing(baseline=degree)).a_mps2
        assert np.abs(a_mps2).max() < 1e-12 * np.abs(drift).max()

    @pytest.mark.parametrize("degree", range(6))
    def test_what_is_left_is_least_squares_as_by_another_fit(self, noise, degree):
        t = 0.01 * np.arange(len(noise))
        fitted = np.polynomial.Polynomial.fit(t, noise, degree)
        a_mps2 = process(record(noise), Processing(baseline=degree)).a_mps2
        assert a_mps2 == pytest.approx(noise - fitted(t), abs=1e-11)

    def test_the_mean_is_that_of_what_is_kept(self):
        a = np.concatenate([np.full(100, 5.0), wave(1.0, 3.0)])
        a_mps2 = process(record(a), Processing(from_s=1.0, baseline=0)).a_mps2
        assert a_mps2 == pytest.approx(a[100:] - a[100:].mean(), abs=1e-14)


class TestFilters:
    @pytest.mark.parametrize("order", [2, 3, 4, 8])
    @pytest.mark.parametrize("kind", ["high", "low"])
    def test_the_gain_is_that_of_a_butterworth_filter_without_its_phase(self, kind, order):
        impulse = np.zeros(2001)
        impulse[1000] = 1.0
        filtered = process(
            record(impulse), Processing(**{f"{kind}pass_hz": 1.0}, order=order)
        ).a_mps2
        assert filtered == pytest.approx(filtered[::-1], abs=1e-15)
        freq_hz = np.fft.rfftfreq(len(filtered), 0.01)
        filter_ = signal.butter(order, 2 * np.pi, kind, analog=True)
        _, response = signal.freqs(*filter_, 2 * np.pi * freq_hz)
        assert np.abs(np.fft.rfft(filtered)) == pytest.approx(np.abs(response), abs=1e-13)

    def test_the_zeros_have_the_length_that_is_said_and_stay(self, noise):
        for highpass_hz, zeros in ((0.1, 6000), (0.0, 24)):
            settings = Processing(highpass_hz=highpass_hz, lowpass_hz=25.0, order=4)
            assert len(process(record(noise), settings).a_mps2) == len(noise) + 2 * zeros

    @pytest.mark.parametrize("order", [2, 3, 4, 6, 8])
    @pytest.mark.parametrize("corner_hz", [0.05, 0.1, 0.5])
    def test_a_high_pass_leaves_no_drift(self, noise, order, corner_hz):
        # An offset as of an instrument: 0.16 m/s after 20 s.
        drifting = noise + 0.008
        assert measures(record(drifting)).final_displacement_m > 1.0
        processed = process(record(drifting), Processing(highpass_hz=corner_hz, order=order))
        left = measures(processed)
        assert abs(left.final_velocity_mps) < 1e-7 * left.pgv_mps
        # Where the order is odd the spectrum has a corner at zero, which dies away more slowly.
        limit = 2e-3 if order % 2 else 2e-5
        assert abs(left.final_displacement_m) < limit * left.pgd_m

    def test_a_high_pass_leaves_no_drift_in_real_records(self, real_records):
        for a, dt_s in real_records.values():
            left = measures(process(record(a, dt_s), Processing(baseline=0, highpass_hz=0.1)))
            assert abs(left.final_velocity_mps) < 1e-9 * left.pgv_mps
            assert abs(left.final_displacement_m) < 1e-5 * left.pgd_m


class TestResampling:
    @pytest.mark.parametrize("parts", [2, 3, 7])
    def test_a_finer_step_that_divides_the_old_one_changes_no_answer(self, noise, parts):
        finer = process(record(noise), Processing(dt_s=0.01 / parts))
        assert len(finer.a_mps2) == parts * (len(noise) - 1) + 1
        assert np.array_equal(finer.a_mps2[::parts], noise)
        result = slide(noise, 0.01, slope_rad=0.03, mu=0.2)
        other = slide(finer.a_mps2, finer.dt_s, slope_rad=0.03, mu=0.2)
        assert other.prd_m == pytest.approx(result.prd_m, rel=1e-11)
        assert other.residual_m == pytest.approx(result.residual_m, rel=1e-10)

    def test_any_finer_step_lies_on_straight_lines_and_the_same_changes_nothing(self, noise):
        finer = process(record(noise), Processing(dt_s=0.0073))
        t = 0.0073 * np.arange(len(finer.a_mps2))
        assert t[-1] <= 0.01 * (len(noise) - 1) < t[-1] + 0.0073
        assert finer.a_mps2 == pytest.approx(np.interp(t, 0.01 * np.arange(len(noise)), noise))
        assert np.array_equal(process(record(noise), Processing(dt_s=0.01)).a_mps2, noise)

    @pytest.mark.parametrize("new_s", [0.02, 0.03, 0.05, 0.025, 0.0137])
    def test_a_coarser_step_keeps_what_it_can_hold(self, new_s):
        a = burst(3.0, 60.0) + burst(0.4, 60.0)
        processed = process(record(a), Processing(dt_s=new_s))
        t = new_s * np.arange(len(processed.a_mps2))
        assert t[-1] <= 60.0 + 1e-9 < t[-1] + new_s + 2e-9
        exact = np.sin(2 * np.pi * 3.0 * t) + np.sin(2 * np.pi * 0.4 * t)
        exact *= np.exp(-0.5 * ((t - 30.0) / 3.75) ** 2)
        assert np.abs(processed.a_mps2 - exact).max() < 3e-4

    @pytest.mark.parametrize("new_s", [0.02, 0.025, 0.05])
    def test_a_coarser_step_makes_no_false_long_periods(self, new_s):
        # Above the new Nyquist frequency, which is 25 Hz at most: read off bare, it would alias.
        a = burst(0.5 / new_s * 1.06 + 2.0, 60.0)
        assert np.abs(a[:: round(new_s / 0.01)]).max() > 0.9
        assert np.abs(process(record(a), Processing(dt_s=new_s)).a_mps2).max() < 1e-6


def test_zeros_are_added_and_all_problems_said_at_once():
    processed = process(record(np.ones(11), dt_s=0.1), Processing(pad_s=1.05))
    assert processed.a_mps2.tolist() == [1.0] * 11 + [0.0] * 11
    wrong = Processing(from_s=-1.0, baseline=99, highpass_hz=-1.0, order=0, dt_s=-1.0)
    assert len(wrong.problems()) == 5
    assert Processing().problems() == ()


class TestTogether:
    def test_components_keep_one_length_and_others_are_named(self, noise):
        settings = Processing(from_s=0.5, baseline=2, highpass_hz=0.13, dt_s=0.007, pad_s=1.0)
        parts = [record(noise * k, name=f"r{k}") for k in (1, 2, 3)]
        processed = process_together(parts, settings)
        assert {len(part.a_mps2) for part in processed} == {len(processed[0].a_mps2)}
        assert [part.name for part in processed] == ["r1", "r2", "r3"]
        assert np.array_equal(processed[0].a_mps2, process(parts[0], settings).a_mps2)
        parts = [record(noise, name="x"), record(noise[1:], name="y"), record(noise, 0.02, "z")]
        like_x = "but x has 2000 of 0.01 s; give components of one length and step"
        assert refused(process_together, parts, Processing()) == (
            f"y: 1999 samples of 0.01 s, {like_x}",
            f"z: 2000 samples of 0.02 s, {like_x}",
        )


def test_words_say_everything_that_is_done():
    assert Processing().words() == "as recorded"
    assert Processing(baseline=0, highpass_hz=0.1).words() == (
        "mean removed; high-pass 0.1 Hz, order 4, zero phase; pads of 60 s before and after are "
        "kept"
    )
    assert Processing(
        from_s=2.0, to_s=30.5, baseline=1, highpass_hz=0.25, lowpass_hz=25.0, order=2, dt_s=0.005,
        pad_s=10.0,
    ).words() == (
        "cut to 2 s to 30.5 s; straight line removed; high-pass 0.25 Hz, order 2, zero phase; "
        "low-pass 25 Hz, order 2, zero phase; pads of 12 s before and after are kept; resampled at "
        "0.005 s; 10 s of zeros added at the end"
    )  # fmt: skip
    assert Processing(from_s=3.0, baseline=5).words() == (
        "cut to 3 s to the end; polynomial of degree 5 removed"
    )


@pytest.mark.parametrize(
    ("settings", "message"),
    [
        ({"from_s": -1.0}, "r: cut from -1 s to inf s; give two times"),
        ({"from_s": math.nan}, "r: cut from nan s to inf s"),
        ({"from_s": 20.0}, "leaves 0 samples of a record of 19.99 s; give a longer part"),
        ({"to_s": 0.05, "baseline": 5}, "leaves 6 samples of a record of 19.99 s"),
        ({"baseline": 9}, "degree of the baseline is 9; give 0 (mean) to 8, or -1 for none"),
        ({"highpass_hz": -0.1}, "high-pass corner is -0.1 Hz; give a frequency, 0 for none"),
        ({"highpass_hz": 50.0}, "high-pass corner is 50 Hz; give less than 50 Hz, half"),
        ({"highpass_hz": 5.0, "lowpass_hz": 2.0}, "give a low-pass above the high-pass"),
        ({"highpass_hz": 0.1, "order": 1}, "filter order is 1; give 2 to 12"),
        ({"dt_s": -0.1}, "new time step: -0.1 s; give a number of seconds, 0 for none"),
        ({"dt_s": 30.0}, "new time step is 30 s; give less than the 19.99 s of the record"),
        ({"pad_s": math.nan}, "zeros at the end: nan s; give a number of seconds"),
        ({"pad_s": 1e9}, "gives 1e+11 samples; give a larger step, higher corners or fewer"),
        ({"highpass_hz": 1e-6}, "gives 1.2e+09 samples"),
        ({"dt_s": 1e-7}, "gives 2e+08 samples"),
    ],
)  # fmt: skip
def test_what_makes_no_sense_is_said(noise, settings, message):
    assert message in "\n".join(refused(process, record(noise), Processing(**settings)))
