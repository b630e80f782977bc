"""Measures and processing. Oracles: closed forms, SciPy, mpmath, the solver itself."""

import math

import mpmath
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy import signal
from scipy.interpolate import PPoly

from fixtures.blocks import record
from fixtures.errors import input_problems
from fixtures.spaces import spaced
from solver.records.measures import measures, velocity_displacement
from solver.records.processing import Processing, process, process_together
from solver.sliding.checked import slide

pytestmark = pytest.mark.quick

G = 9.80665

motions = st.lists(st.floats(-20.0, 20.0, width=16), min_size=2, max_size=30).map(np.array)


def pieces(a, dt):
    """Acceleration as a piecewise polynomial, from its samples."""
    return PPoly(np.array([np.diff(a) / dt, a[:-1]]), dt * np.arange(len(a)))


def largest(curve, end):
    """Largest |value| of a piecewise polynomial: at its ends, breaks and stationary points."""
    still = curve.derivative().roots(discontinuity=False, extrapolate=False)
    points = np.concatenate([curve.x, still[np.isfinite(still)]])
    return np.abs(curve(points[(points >= 0.0) & (points <= end)])).max()


UP = np.array([0.0, 0.5, 1.0, 0.5, 0.0])
SINE = np.sin(2.0 * np.pi * np.arange(30001) * 1e-4)
ARIAS = math.pi / (2.0 * G)
CLOSED_FORMS = {
    # The integral of a^2 goes with t^3.
    "a ramp of 3 t for 2 s": (3.0 * 0.01 * np.arange(201), 0.01, 1e-13, {
        "pga_mps2": 6.0, "pgv_mps": 6.0, "final_velocity_mps": 6.0, "pgd_m": 4.0,
        "final_displacement_m": 4.0, "arias_mps": ARIAS * 9.0 * 8.0 / 3.0,
        "d5_95_s": 2.0 * (math.cbrt(0.95) - math.cbrt(0.05)),
    }),
    "a constant acceleration": (np.full(101, -2.0), 0.01, 1e-13, {
        "final_velocity_mps": -2.0, "final_displacement_m": -1.0, "arias_mps": ARIAS * 4.0,
        "d5_95_s": 0.9,
    }),
    # v = t - 2 t^2 peaks at 1/4, d = t^2 / 2 - 2 t^3 / 3 at 1/2.
    "down in one interval from 1 to -3": ([1.0, -3.0], 1.0, 1e-14, {
        "final_displacement_m": -1.0 / 6.0, "pgd_m": 1.0 / 6.0,
    }),
    "the velocity of it": ([1.0, -3.0], 1.0, 1e-15, {"pgv_mps": 1.0, "final_velocity_mps": -1.0}),
    # The velocity turns at 1/3, the displacement at 2/3, inside.
    "from 1 to -2 and to rest": ([1.0, -2.0, 0.0], 1.0, 1e-15, {"pgv_mps": 1.5}),
    "from 1 to -2": ([1.0, -2.0], 1.0, 1e-15, {"pgv_mps": 0.5, "final_displacement_m": 0.0}),
    "the displacement of it": ([1.0, -2.0], 1.0, 1e-14, {"pgd_m": 2.0 / 27.0}),
    "from 1 to -1": ([1.0, -1.0], 1.0, 1e-15, {"pgv_mps": 0.25}),
    # v = (1 - cos) / 2 pi, d = t / 2 pi - sin / 4 pi^2.
    "sin(2 pi t) for 3 s": (SINE, 1e-4, 1e-7, {
        "pgv_mps": 1.0 / math.pi, "pgd_m": 3.0 / (2.0 * math.pi), "arias_mps": ARIAS * 1.5,
    }),
    "the end of it": (SINE, 1e-4, 1e-11, {"final_velocity_mps": 0.0}),
    # Velocity back to zero, displacement kept. A quarter of a triangle's integral from its foot
    # goes with (t / 0.1)^3 / 2.
    "triangles of 1 m/s2 over 0.2 s, up and down": ([*UP, *-UP[1:], 0.0], 0.05, 1e-13, {
        "final_velocity_mps": 0.0, "final_displacement_m": 0.1 * 0.2,
        "arias_mps": ARIAS * 2 * 0.2 / 3, "d5_95_s": 0.4 - 2 * 0.1 * math.cbrt(0.05 * 2 * 2),
    }),
    "the velocity of them": ([*UP, *-UP[1:], 0.0], 0.05, 1e-14, {"pgv_mps": 0.1}),
    "nothing": (np.zeros(50), 0.01, 0.0, dict.fromkeys(
        ("pga_mps2", "pgv_mps", "pgd_m", "arias_mps", "d5_95_s"), 0.0)),
}  # fmt: skip


@pytest.mark.parametrize(
    ("values", "dt_s", "rel", "wanted"), CLOSED_FORMS.values(), ids=CLOSED_FORMS
)
def test_measures_are_those_of_closed_forms(values, dt_s, rel, wanted):
    measured = measures(record(values, dt_s))
    found = {name: getattr(measured, name) for name in wanted}
    assert found == pytest.approx(wanted, rel=rel, abs=1e-3 * rel)


def test_leading_and_trailing_zeros_do_not_change_the_duration():
    wave = np.concatenate([[0.0], np.sin(np.arange(99.0)), [0.0]])
    bare = measures(record(wave)).d5_95_s
    padded = measures(record([*np.zeros(70), *wave, *np.zeros(70)])).d5_95_s
    assert padded == pytest.approx(bare, rel=1e-12)


@given(motions)
def test_peaks_agree_with_roots_of_piecewise_polynomials(a):
    curve = pieces(a, 0.01)
    v, d = curve.antiderivative(), curve.antiderivative(2)
    end = 0.01 * (len(a) - 1)
    measured = measures(record(a))
    size = np.abs(a).max()
    assert measured.pgv_mps == pytest.approx(largest(v, end), rel=1e-10, abs=1e-13 * size)
    assert measured.pgd_m == pytest.approx(largest(d, end), rel=1e-10, abs=1e-15 * size)
    assert measured.final_velocity_mps == pytest.approx(float(v(end)), rel=1e-11, abs=1e-13 * size)
    assert measured.final_displacement_m == pytest.approx(
        float(d(end)), rel=1e-10, abs=1e-15 * size
    )


@given(motions)
def test_duration_is_between_the_times_of_the_shares_by_bisection(a):
    measured = measures(record(a))
    if np.abs(a).max() == 0.0:
        return
    # The square of the acceleration, and its integral, as polynomials of SciPy.
    r, start = np.diff(a) / 0.01, a[:-1]
    squared = PPoly(np.array([r * r, 2 * r * start, start * start]), 0.01 * np.arange(len(a)))
    total = squared.antiderivative()
    end = 0.01 * (len(a) - 1)
    assert measured.arias_mps == pytest.approx(ARIAS * float(total(end)), rel=1e-12)
    times = []
    for share in (0.05, 0.95):
        low, high = 0.0, end
        for _ in range(80):
            middle = 0.5 * (low + high)
            low, high = (middle, high) if total(middle) < share * total(end) else (low, middle)
        times.append(low)
    # A time is no better known than the integral is steep there.
    assert measured.d5_95_s == pytest.approx(times[1] - times[0], abs=1e-6)


def test_a_long_record_agrees_with_fifty_digits(noise):
    dt = mpmath.mpf("0.01")
    v = d = mpmath.mpf(0)
    with mpmath.workdps(50):
        for now, then in zip(noise[:-1].tolist(), noise[1:].tolist(), strict=True):
            now, then = mpmath.mpf(now), mpmath.mpf(then)
            d += v * dt + dt * dt * (2 * now + then) / 6
            v += dt * (now + then) / 2
    measured = measures(record(noise))
    assert measured.final_velocity_mps == pytest.approx(float(v), abs=1e-14)
    assert measured.final_displacement_m == pytest.approx(float(d), abs=1e-13)
    speed, place = velocity_displacement(record(noise))
    assert (speed[-1], place[-1]) == (measured.final_velocity_mps, measured.final_displacement_m)


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
    for highpass_hz, zeros in ((0.1, 6000), (0.0, 24)):
        settings = Processing(highpass_hz=highpass_hz, lowpass_hz=25.0, order=4)
        assert len(process(record(noise), settings).a_mps2) == len(noise) + 2 * zeros


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


@pytest.mark.parametrize("degree", range(9))
def test_what_is_left_is_least_squares_as_by_another_fit(noise, degree):
    t = 0.01 * np.arange(len(noise))
    fitted = np.polynomial.Polynomial.fit(t, noise, degree)
    a_mps2 = process(record(noise), Processing(baseline=degree)).a_mps2
    assert a_mps2 == pytest.approx(noise - fitted(t), abs=1e-11)


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


def test_components_keep_one_length_and_others_are_named(noise):
    settings = Processing(from_s=0.5, baseline=2, highpass_hz=0.13, dt_s=0.007, pad_s=1.0)
    parts = [record(noise * k, name=f"r{k}") for k in (1, 2, 3)]
    processed = process_together(parts, settings)
    assert {len(part.a_mps2) for part in processed} == {len(processed[0].a_mps2)}
    assert [part.name for part in processed] == ["r1", "r2", "r3"]
    assert np.array_equal(processed[0].a_mps2, process(parts[0], settings).a_mps2)
    parts = [record(noise, name="x"), record(noise[1:], name="y"), record(noise, 0.02, "z")]
    like_x = "but x has 2000 of 0.01 s; use components of one length and step"
    assert input_problems(process_together, parts, Processing()) == (
        f"y: 1999 samples of 0.01 s, {like_x}",
        f"z: 2000 samples of 0.02 s, {like_x}",
    )


def test_words_say_everything_that_is_done_and_problems_at_once():
    assert Processing().words() == "as recorded"
    assert spaced(Processing(
        from_s=2.0, to_s=30.5, baseline=1, highpass_hz=0.25, lowpass_hz=25.0, order=2, dt_s=0.005,
        pad_s=10.0,
    ).words()) == (
        "cut to 2 s to 30.5 s; straight line removed; high-pass 0.25 Hz, order 2, zero phase; "
        "low-pass 25 Hz, order 2, zero phase; pads of 12 s before and after are kept; resampled at "
        "0.005 s; 10 s of zeros added at the end"
    )  # fmt: skip
    processed = process(record(np.ones(11), dt_s=0.1), Processing(pad_s=1.05))
    assert processed.a_mps2.tolist() == [1.0] * 11 + [0.0] * 11
    wrong = Processing(from_s=-1.0, baseline=99, highpass_hz=-1.0, order=0, dt_s=-1.0)
    assert len(wrong.problems()) == 5
    assert Processing().problems() == ()


@pytest.mark.parametrize(
    ("settings", "message"),
    [
        ({"from_s": -1.0}, "r: cut from -1 s to inf s; enter two times"),
        ({"from_s": 20.0}, "leaves 0 samples of a record of 19.99 s; use a longer part"),
        ({"baseline": 9}, "degree of the baseline is 9; enter 0 (mean) to 8, or -1 for none"),
        ({"highpass_hz": 50.0}, "high-pass corner is 50 Hz; enter less than 50 Hz, half"),
        ({"highpass_hz": 5.0, "lowpass_hz": 2.0}, "enter a low-pass above the high-pass"),
        ({"highpass_hz": 0.1, "order": 1}, "filter order is 1; enter 2 to 12"),
        ({"dt_s": 30.0}, "new time step is 30 s; enter less than the 19.99 s of the record"),
        ({"pad_s": 1e9}, "gives 1e+11 samples; use a larger step, higher corners or fewer"),
    ],
)  # fmt: skip
def test_what_makes_no_sense_is_said(noise, settings, message):
    assert message in "\n".join(input_problems(process, record(noise), Processing(**settings)))
