"""Made motions. Oracles: an oscillator in modal form, whole-number sums, the code's own corners."""

import math
from functools import partial
from threading import Event

import numba
import numpy as np
import pytest

from modal import psa_g
from nightly import by_day
from solver.formats import read_motion_file, read_record
from solver.model import InputError, Motion
from solver.records.acceptance import acceptance
from solver.records.record import Record, write_record
from solver.rules.hazard import target_sa_g
from solver.synthesis import matching, suite
from solver.synthesis.matching import make_frame, spectrum_fit
from solver.synthesis.suite import NOISE, make_suite, synthesize

pytestmark = pytest.mark.skipif(
    numba.config.DISABLE_JIT, reason="each motion takes minutes without compiled kernels"
)

G = 9.80665
BAND = 0.3 * 2.0 ** (np.arange(82) / 12.0)


def corners(flexible_g, rigid_g):
    sa_g = np.array([0.1 * flexible_g, flexible_g, flexible_g, rigid_g])
    return np.array([0.1, 1.3, 8.3, 33.3]), sa_g


HORIZONTAL, VERTICAL = corners(1.6 * 1.566, 1.2 * 1.566), corners(0.67 * 1.566, 0.27 * 1.566)


def rng(seed):
    return np.random.Generator(np.random.PCG64(seed))


def psa_over(record, wanted, freq_hz):
    """Spectrum over the target, by another method."""
    return psa_g(record.a_mps2, record.dt_s, freq_hz) / target_sa_g(wanted, freq_hz)


def counts(record):
    """Samples in whole hundred-thousandths of g."""
    return [round(a) for a in (record.a_mps2 / G * 1e5).tolist()]


@pytest.fixture(scope="module", params=[range(3), range(10)], ids=["three", "ten"])
def suites(request):
    return [make_suite(HORIZONTAL, VERTICAL, count=1, seed=seed)[0] for seed in request.param]


@pytest.fixture(scope="module")
def components(suites):
    targets = HORIZONTAL, HORIZONTAL, VERTICAL
    return [pair for motion in suites for pair in zip(motion.components, targets, strict=True)]


@pytest.mark.nightly
class TestSuite:
    def test_components_keep_to_targets_peaks_and_durations(self, components):
        # The fit itself is held against another way in `TestFit`.
        for record, wanted in components:
            fit = spectrum_fit(record, wanted)
            assert fit.minimum >= 1.0
            assert fit.maximum <= 1.30
            assert 1.0 <= fit.mean <= 1.07
        for record, (_, sa_g) in components:
            assert np.abs(record.a_mps2).max() / G == pytest.approx(sa_g[-1], rel=0.3)
        for record, _ in components:
            assert (record.dt_s, len(record.a_mps2)) == (0.005, 6001)
            energy = np.cumsum(record.a_mps2**2)
            strong = np.searchsorted(energy, [0.05 * energy[-1], 0.95 * energy[-1]])
            assert 19.99 < 0.005 * (strong[1] - strong[0]) < 24.0
            assert energy[400] < 0.02 * energy[-1] > energy[-1] - energy[-401]

    @pytest.mark.parametrize("count", [2, 6])
    def test_no_point_of_a_sixth_of_an_octave_is_below_the_target_wherever_the_first_lies(
        self, components, count
    ):
        # 100 grids; another routine finds the same.
        shift = np.arange(100) / 600.0
        freq_hz = 1.3 * 2.0 ** (np.arange(-22, 28) / 6.0 + shift[:, None]).ravel()
        for record, wanted in components[:count]:
            ratio = psa_over(record, wanted, freq_hz)
            assert 1.0 <= ratio.min() < 1.003
            assert ratio.max() <= 1.3

    def test_the_suite_that_failed_between_the_points_keeps_every_row_on_every_grid(self):
        # 1.3 x 2^(k/6) Hz: 4 of 18 components were below the target at 2.6 and 2.92 Hz.
        across, upward = corners(1.6 * 1.7, 0.4 * 1.7 * 2.25 / 1.3), corners(0.67 * 1.7, 0.27 * 1.7)
        (made,) = make_suite(across, upward, count=1, seed=99002)
        freq_hz = 1.3 * 2.0 ** (np.arange(28) / 6.0)
        for record, wanted in zip(made.components, (across, across, upward), strict=True):
            assert psa_over(record, wanted, freq_hz).min() >= 1.0

    def test_suites_satisfy_every_row_of_the_acceptance(self, suites):
        about = {"source": "", "dt_s": suites[0].x.dt_s, "scale": 1.0, "signs": (1, -1)}
        names = ("ax_mps2", "ay_mps2", "az_mps2")
        motions = [
            Motion(id=f"M{k}", **about, **dict(zip(names, sides, strict=True)))
            for k, sides in enumerate([r.a_mps2 for r in one.components] for one in suites)
        ]
        holds = [one.hold_s for one in suites]
        across, upward = (partial(target_sa_g, wanted) for wanted in (HORIZONTAL, VERTICAL))
        for part in (slice(0, 3), slice(-3, None), slice(0, None)):
            found = acceptance(motions[part], holds[part], across, upward)
            assert len(found.rows) == 10
            assert found.missed == ()
            # As if they were records.
            other = acceptance(motions[part], [math.nan] * len(motions[part]), across, upward)
            assert other.missed == ()

    def test_the_ground_ends_at_zero_and_does_not_wander(self, components):
        # Straight lines between samples that begin and end at zero: velocity is proportional to
        # the sum of the samples, displacement to the sum of their moments about the end.
        for record, _ in components:
            whole = counts(record)
            assert whole[0] == whole[-1] == 0
            assert sum(whole) == 0
            assert sum(n * k for n, k in enumerate(whole)) == 0
        for record, (freq_hz, sa_g) in components:
            velocity = np.cumsum(record.a_mps2) * record.dt_s
            displacement = np.cumsum(velocity) * record.dt_s
            longest = sa_g[0] * G / (2.0 * np.pi * freq_hz[0]) ** 2
            assert np.abs(displacement).max() < longest

    def test_motions_are_independent_and_those_of_their_seed(self, suites):
        for motion in suites:
            together = np.corrcoef([record.a_mps2 for record in motion.components])
            xy, xz, yz = together[0, 1], together[0, 2], together[1, 2]
            assert motion.correlations == pytest.approx((xy, xz, yz), rel=1e-9)
            assert max(map(abs, motion.correlations)) <= 0.3
        again = make_suite(HORIZONTAL, VERTICAL, count=2, seed=1)
        for component, other in zip(again[0].components, suites[1].components, strict=True):
            assert np.array_equal(component.a_mps2, other.a_mps2)
        names = [record.name for record in again[1].components]
        assert names == ["motion-02-x", "motion-02-y", "motion-02-z"]
        assert not np.array_equal(again[1].x.a_mps2, again[0].x.a_mps2)
        first, second = suites[:2]
        assert abs(np.corrcoef(first.x.a_mps2, second.x.a_mps2)[0, 1]) < 0.3

    def test_what_is_written_is_what_was_checked(self, suites, tmp_path):
        for record in suites[0].components:
            path = tmp_path / f"{record.name}.csv"
            write_record(path, record, hold_s=suites[0].hold_s)
            assert read_motion_file(path).hold_s == 20.0
            back = read_record(path)
            assert back.dt_s == record.dt_s
            assert np.array_equal(back.a_mps2, record.a_mps2)
            assert path.stat().st_size < 100_000
            assert not record.a_mps2.flags.writeable

    @pytest.mark.parametrize(("count", "seed"), [(0, 1), (1, -1)])
    def test_impossible_counts_and_seeds_are_refused(self, count, seed):
        with pytest.raises(InputError, match="give at least 1 and at least 0"):
            make_suite(HORIZONTAL, VERTICAL, count=count, seed=seed)


class TestMaking:
    def test_motions_are_told_as_they_end_and_returned_by_number(self, monkeypatch):
        def late_first(frame, seed, rng, name, unlike=()):
            if name == "motion-01-x":
                assert others_made.wait(20.0)
            return Record(name=name, dt_s=0.01, a_mps2=np.zeros(3)), "noise"

        def tell(words):
            told.append(words)
            if words.startswith("1 of"):
                others_made.set()

        told, others_made = [], Event()
        monkeypatch.setattr(suite, "THREADS", 2)
        monkeypatch.setattr(suite, "synthesize", late_first)
        made = make_suite(HORIZONTAL, VERTICAL, count=3, seed=1, progress=tell)
        assert told == [f"{done} of 3 motions made" for done in range(4)]
        assert [motion.x.name for motion in made] == [f"motion-0{k}-x" for k in (1, 2, 3)]

    def test_a_motion_that_cannot_be_made_ends_the_suite(self, monkeypatch):
        def missed(frame, seed, rng, name, unlike=()):
            begun.append(name)
            raise InputError("20 motions all miss the target")

        begun = []
        monkeypatch.setattr(suite, "THREADS", 1)
        monkeypatch.setattr(suite, "synthesize", missed)
        with pytest.raises(InputError, match="all miss the target"):
            make_suite(HORIZONTAL, VERTICAL, count=50, seed=1)
        assert len(begun) < 50


class TestSynthesis:
    @pytest.mark.parametrize(
        ("dt_s", "duration_s"), by_day([(0.01, 20.0), (0.0025, 12.0), (0.005, 60.0)], 1)
    )
    def test_a_long_period_tail_is_met_at_other_samplings(self, dt_s, duration_s):
        # 1/T beyond 0.77 s, then flat and falling.
        tail = np.array([0.1, 1.0 / 0.77, 8.3, 33.3]), np.array([0.077, 1.0, 1.0, 0.75])
        record, _ = synthesize(make_frame(tail, dt_s, duration_s), NOISE, rng(1), "tail")
        assert len(record.a_mps2) == round(duration_s / dt_s) + 1
        ratio = psa_over(record, tail, BAND)
        assert 0.9 <= ratio.min() <= ratio.max() <= 1.3

    @pytest.mark.nightly
    def test_low_periods_are_flat_and_a_motion_like_another_drawn_again(self):
        flat = np.array([2.0, 20.0]), np.array([1.0, 1.0])
        record, _ = synthesize(make_frame(flat, 0.01, 20.0), NOISE, rng(1), "flat")
        assert psa_over(record, flat, BAND[:24]) == pytest.approx(1.0, abs=0.1)
        frame = make_frame(HORIZONTAL, 0.01, 12.0)
        first, again = (synthesize(frame, NOISE, rng(1), "x")[0] for _ in range(2))
        assert np.array_equal(again.a_mps2, first.a_mps2)
        second, _ = synthesize(frame, NOISE, rng(1), "x", unlike=(first,))
        assert abs(np.corrcoef(first.a_mps2, second.a_mps2)[0, 1]) <= 0.3

    @pytest.mark.nightly
    def test_a_target_out_of_reach_is_told(self, monkeypatch):
        monkeypatch.setattr(suite, "DRAWS", 2)
        monkeypatch.setattr(matching, "LEAST", 1.5)
        with pytest.raises(
            InputError,
            match=r"x: 2 motions of 12 s all miss .*; the closest has 1\.00 to 1\.\d\d times",
        ):
            synthesize(make_frame(HORIZONTAL, 0.01, 12.0), NOISE, rng(1), "x")

    @pytest.mark.parametrize(
        ("how", "expected"),
        [
            ({"target": ([1.0], [1.0])}, "as many accelerations as frequencies"),
            ({"target": ([1.0, 2.0], [1.0, 1.0, 1.0])}, "as many accelerations as frequencies"),
            ({"target": ([2.0, 1.0], [1.0, 1.0])}, "give increasing frequencies above 0"),
            ({"target": ([0.0, 1.0], [1.0, 1.0])}, "give increasing frequencies above 0"),
            ({"target": ([1.0, 2.0], [1.0, -1.0])}, "give accelerations above 0"),
            ({"target": ([1.0, 2.0], [1.0, np.nan])}, "give accelerations above 0"),
            ({"dt_s": 0.02}, "time step dt is 0.02; give 0.001 to 0.01 s"),
            ({"duration_s": 5.0}, "duration is 5.0; give from 10 s to 60,000 time steps"),
            ({"duration_s": np.inf}, "duration is inf; give from 10 s"),
        ],
    )
    @pytest.mark.quick
    def test_impossible_arguments_are_refused(self, how, expected):
        usual = {"target": HORIZONTAL, "dt_s": 0.005, "duration_s": 30.0}
        with pytest.raises(InputError, match=expected):
            make_frame(**(usual | how))


@pytest.fixture(scope="module")
def record():
    return synthesize(make_frame(HORIZONTAL, 0.005, 12.0), NOISE, rng(1), "x")[0]


class TestFit:
    def test_a_fit_compares_the_spectrum_with_the_target_over_the_band(self, record):
        fit = spectrum_fit(record, HORIZONTAL)
        assert fit.freq_hz[:-1] == pytest.approx(0.1 * 2.0 ** (np.arange(101) / 12.0), rel=1e-12)
        assert fit.freq_hz[-1] == 33.3
        ratio = psa_over(record, HORIZONTAL, fit.freq_hz)
        assert fit.ratio == pytest.approx(ratio, rel=1e-4)
        ratios = fit.minimum, fit.mean, fit.maximum
        assert ratios == pytest.approx((ratio.min(), ratio.mean(), ratio.max()), rel=1e-4)
