"""Rows on motions. Oracles: a spectrum by complex modes, closed forms of energy and correlation."""

import math
import pickle
from dataclasses import replace

import numpy as np
import pytest

from fixtures.spaces import spaced
from modal_oracle import psa_g
from solver.model import Motion
from solver.records.acceptance import POINTS_HZ, acceptance
from solver.records.record import read_only
from solver.rules.limit import PROGRAM, Consequence, Limit

G = 9.80665
DT_S, N = 0.02, 301


def motion(name="M1", seed=1, **changes):
    draw = np.random.default_rng(seed)
    sides = {f"a{axis}_mps2": read_only(draw.standard_normal(N)) for axis in "xyz"}
    return Motion(
        **{"id": name, "source": "", "dt_s": DT_S, "scale": 1.0, "signs": (1,)} | sides | changes
    )


NO_Y, NO_Z = {"ay_mps2": np.empty(0)}, {"az_mps2": np.empty(0)}


def modal_g(a_mps2):
    """5% damped spectrum at the points, by another method."""
    return psa_g(a_mps2, DT_S, POINTS_HZ)


def below(spectrum_g, ratios, usual=1.2):
    """Target that a spectrum is `usual` times, but other ratios at some of the points."""
    ratio = np.array([ratios.get(k, usual) for k in range(len(POINTS_HZ))])

    def at(freq_hz):
        assert np.array_equal(freq_hz, POINTS_HZ)
        return spectrum_g / ratio

    return at


def nothing(freq_hz):
    return np.full(freq_hz.shape, math.nan)


def accepted(*motions, holds_s=None, target=nothing, upward=nothing):
    """Acceptance of records, or of generated motions with these holds of the envelope."""
    return acceptance(motions, holds_s or [math.nan] * len(motions), target, upward)


def only(found, words):
    (row,) = (row for row in found.rows if words in spaced(row.title))
    return row


@pytest.fixture(scope="module")
def alone():
    return motion(**NO_Y, **NO_Z)


@pytest.fixture(scope="module")
def spectrum_g(alone):
    return modal_g(alone.ax_mps2)


class TestSpectrum:
    @pytest.mark.quick
    def test_the_points_lie_at_most_1_24_octave_apart_from_end_to_end(self):
        assert POINTS_HZ[[0, 92, -1]] == pytest.approx([0.1, 1.3, 33.3], rel=1e-12)
        assert len(POINTS_HZ) == 93 + 117 - 1
        assert (
            1 / 25 < np.diff(np.log2(POINTS_HZ)).min() < np.diff(np.log2(POINTS_HZ)).max() < 1 / 24
        )
        made = Limit(title="", found=1.0, limit=1.0, is_at_least=True, provision=PROGRAM)
        assert pickle.loads(pickle.dumps(made)).is_program_limit

    def test_each_row_finds_its_worst_point(self, alone, spectrum_g):
        # 92 is 1.3 Hz, which is a point of both bands; 158 is the last point below 8.3 Hz. Of the
        # others 156, 160, 176 and 200 are of the set of 92, 1/6 octave or a multiple of it apart.
        ratios = {2: 0.93, 100: 0.95, 156: 0.97, 160: 0.91, 176: 0.99, 200: 0.98}
        found = accepted(alone, target=below(spectrum_g, ratios))
        for words, value, worst_at, satisfied, is_program_limit in (
            ("0.1 to 1.3 Hz, each component", 0.93, 2, True, True),
            ("0.1 to 1.3 Hz, mean of the motions", 0.93, None, False, True),
            ("1.3 to 33.3 Hz, each component", 0.91, 160, True, False),
            ("Consecutive 1/6-octave points", 2.0, 160, False, False),
            (", 1.3 to 8.3 Hz", 2.0, None, True, False),
            (", 8.3 to 33.3 Hz", 3.0, 160, False, False),
        ):
            row = only(found, words)
            assert row.found == pytest.approx(value, rel=1e-4)
            assert (row.ok, row.is_program_limit) == (satisfied, is_program_limit)
            worst = worst_at and f"M1 x, {POINTS_HZ[worst_at]:.3g} Hz"
            assert worst_at is None or spaced(row.worst) == worst
        assert only(found, "Consecutive").limit == 1.0
        spectral = [row for row in found.rows if "target" in row.title]
        assert len(spectral) == 6
        assert {row.consequence for row in spectral} == {Consequence.NG}

    @pytest.mark.parametrize(("ratio", "ok"), [(0.899, False), (0.901, True)])
    def test_a_single_point_may_fall_to_nine_tenths(self, alone, spectrum_g, ratio, ok):
        found = accepted(alone, target=below(spectrum_g, {121: ratio}))
        assert only(found, "1.3 to 33.3 Hz, each").ok is ok
        assert only(found, "Consecutive").ok
        assert only(found, ", 1.3 to 8.3 Hz").found == 1.0

    def test_points_count_a_sixth_of_an_octave_apart_wherever_the_first_lies(
        self, alone, spectrum_g
    ):
        # Two octaves above 1.3 Hz, and 1/6 octave farther: between the points of 1/6 octave.
        for first in (93, 94, 95):
            target = below(spectrum_g, {first: 0.99, first + 4: 0.99, first + 20: 0.99})
            found = accepted(alone, target=target)
            assert only(found, "Consecutive").found == 2.0
            assert only(found, ", 1.3 to 8.3 Hz").found == 3.0
        target = below(spectrum_g, dict.fromkeys((120, 121, 122, 123), 0.95))
        found = accepted(alone, target=target)
        assert only(found, "Consecutive").found == only(found, ", 1.3 to 8.3 Hz").found == 1.0

    def test_one_motion_may_be_low_and_the_vertical_has_its_own_target(self, spectrum_g):
        one, other = (motion(f"M{k}", k, **NO_Y, **NO_Z) for k in (1, 2))
        # The other motion is scaled up, so that the mean at the point is (0.95 + r) / 2 or more.
        target = below(modal_g(one.ax_mps2), {40: 0.95})
        ratio = modal_g(other.ax_mps2) / target(POINTS_HZ)
        scale = 1.06 / ratio[:93].min()
        found = accepted(one, replace(other, scale=scale), target=target)
        assert only(found, "0.1 to 1.3 Hz, each").found == pytest.approx(0.95, rel=1e-4)
        mean = only(found, "mean of the motions")
        each = np.mean([1.2 * np.ones(209), scale * ratio], axis=0)
        each[40] = 0.5 * (0.95 + scale * ratio[40])
        assert mean.found == pytest.approx(each[:93].min(), rel=1e-4)
        assert mean.ok
        assert mean.worst.startswith("mean of x")
        made = motion(az_mps2=motion().ax_mps2, **NO_Y)
        found = accepted(made, target=below(spectrum_g, {}), upward=below(spectrum_g, {121: 0.5}))
        assert spaced(only(found, "1.3 to 33.3 Hz, each").worst) == f"M1 z, {POINTS_HZ[121]:.3g} Hz"

    def test_points_without_a_target_are_not_compared_and_the_row_says_so(self, alone, spectrum_g):
        full = below(spectrum_g, {4: 0.5, 32: 0.93})

        def shorter(freq_hz):
            return np.where(freq_hz >= 0.2, full(freq_hz), math.nan)

        found = accepted(alone, target=shorter)
        low = only(found, "0.1 to 1.3 Hz as far as the target is given, each")
        assert low.found == pytest.approx(0.93, rel=1e-4)
        assert only(found, "1.3 to 33.3 Hz, each").ok
        assert not any("target" in row.title for row in accepted(alone).rows)


def test_three_motions_of_all_components_are_enough():
    several = [motion(f"M{k}", k) for k in (1, 2, 3)]
    for count, ok in ((2, False), (3, True)):
        found = accepted(*several[:count])
        row = only(found, "Number of motions")
        assert (row.found, row.limit, row.ok) == (count, 3.0, ok)
        assert row.consequence is Consequence.NG
    full = motion("M1")
    for changes, words, count in (
        ({}, "", 3),
        (NO_Z, "M2, no z", 2),
        (NO_Y | NO_Z, "M2, no y and no z", 1),
    ):
        row = only(accepted(full, motion("M2", 2, **changes)), "Components")
        assert (row.found, row.worst, row.ok) == (count, words, count == 3)


class TestStrongMotion:
    def test_of_records_the_significant_duration_counts_and_a_miss_is_a_condition(self):
        # A constant acceleration has nine tenths of its energy in nine tenths of its duration.
        steady = read_only(np.full(N, 4.0))
        record = motion(ax_mps2=steady, ay_mps2=steady, az_mps2=steady, dt_s=0.1, scale=0.5)
        found = accepted(record)
        row = only(found, "records")
        assert row.found == pytest.approx(27.0, rel=1e-12)
        assert row.ok
        # pi / (2 g) times a^2 times the duration, 4 m2/s4 and 30 s.
        strong = found.motions[0].strengths["x"]
        assert strong.arias_mps == pytest.approx(math.pi / (2.0 * G) * 120.0, rel=1e-12)
        short = accepted(replace(record, dt_s=0.07))
        row = only(short, "records")
        assert row.found == pytest.approx(18.9, rel=1e-12)
        assert (row.ok, row.measure, row.consequence) == (False, "s", Consequence.CONDITION)
        assert short.missed[-1] is row

    @pytest.mark.parametrize(("hold_s", "ok"), [(20.0, True), (19.9, False)])
    @pytest.mark.quick
    def test_of_generated_motions_the_hold_of_the_envelope_counts(self, hold_s, ok):
        both = [motion("M1"), motion("M2", 2)]
        found = accepted(*both, holds_s=[30.0, hold_s])
        row = only(found, "generated motions (hold")
        assert (row.found, row.worst, row.ok) == (hold_s, "M2", ok)
        assert row.consequence is Consequence.NG
        assert not any("records" in row.title for row in found.rows)


class TestCorrelation:
    @pytest.mark.parametrize(("share", "ok"), [(0.29, True), (-0.29, True), (-0.31, False)])
    def test_components_of_generated_motions_must_not_correlate(self, share, ok):
        # Waves of whole cycles over the N samples are orthogonal and of zero mean.
        turns = 2.0 * np.pi * np.arange(N) / N
        one, other, third = (np.sin(k * turns) for k in (5, 7, 11))
        mixed = share * one + math.sqrt(1.0 - share**2) * other
        made = motion(ax_mps2=one, ay_mps2=third, az_mps2=mixed, scale=-3.0)
        found = accepted(made, holds_s=[20.0])
        assert found.motions[0].correlations == pytest.approx(
            {"x-y": 0.0, "x-z": share, "y-z": 0.0}, abs=1e-12
        )
        row = only(found, "Correlation")
        assert row.found == pytest.approx(abs(share), rel=1e-12)
        assert (row.worst, row.ok, row.consequence) == ("M1 x-z", ok, Consequence.NG)

    def test_correlations_of_records_are_not_limited_and_zeros_have_none(self):
        found = accepted(motion(ay_mps2=motion().ax_mps2))
        assert found.motions[0].correlations["x-y"] == pytest.approx(1.0, rel=1e-12)
        assert not any("Correlation" in row.title for row in found.rows)
        found = accepted(motion(ay_mps2=np.zeros(N)), holds_s=[20.0])
        assert found.motions[0].correlations["x-y"] == 0.0
