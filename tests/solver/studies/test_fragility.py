"""Capacities against dense scans; fragilities against theory and other optimizers."""

import dataclasses
import math

import numpy as np
import pytest
from scipy.optimize import brentq, minimize, minimize_scalar
from scipy.stats import goodness_of_fit, norm

from fixtures.campaigns import frozen, motion
from fixtures.marks import by_day
from solver import solve
from solver.model import coulomb
from solver.studies.campaign import Campaign, grid
from solver.studies.capacity import ACCURACY, Capacities, Curve, capacities
from solver.studies.fragility import (
    deviance,
    fit_lognormal,
    fit_normals,
    fragility,
    inverse_mills,
    lilliefors,
    lilliefors_critical,
    lilliefors_p,
    log_likelihood,
)
from solver.studies.runs import Runner

G = 9.80665
LEVELS = np.linspace(0.2, 2.4, 12)


def curve_of(one, slope_deg, mu):
    """The curve of a motion, prepared as a study prepares it."""
    slope = math.radians(slope_deg)
    runner = Runner(Campaign(motions=((one,),), cases=grid(1, [slope], [mu], [1.0])))
    return Curve(tracks=runner.tracks[0], slope_rad=slope, mu=mu)


def scenes(one, slope_deg, mu):
    place = {"slope_rad": math.radians(slope_deg), "friction": coulomb(mu)}
    return [one.scene(orientation, **place) for orientation in one.orientations]


def single(one, slope_deg, mu, x):
    """PRD of single runs, the largest of the orientations; NaN for none."""
    scaled = dataclasses.replace(one, scale=one.scale * x)
    found = [solve(scene).result for scene in scenes(scaled, slope_deg, mu)]
    return max(r.prd_m for r in found) if all(r.status == "ok" for r in found) else math.nan


def searched(curve, limit, levels=LEVELS, *, is_censoring=False):
    """The capacity of one curve for one limit."""
    (found,) = capacities([curve], [limit], levels, is_censoring=is_censoring)
    return found


def is_just_below(found, exact):
    return found.intensity[0] <= exact <= found.intensity[0] * (1.0 + 1.1 * ACCURACY)


@pytest.mark.parametrize(
    ("letters", "slope", "mu", "limit"),
    [("x", 2.0, 0.3, 0.02), ("x", 0.0, 0.5, 0.01), ("xz", 2.0, 0.4, 0.05), ("xz", 6.0, 0.3, 0.1)],
)
@pytest.mark.parametrize("number", by_day(range(2), 1))
def test_one_axis_capacity_is_the_first_of_a_dense_scan(letters, slope, mu, limit, number):
    curve = curve_of(motion(number, letters), slope, mu)
    found = searched(curve, limit)
    x = np.linspace(1e-4, LEVELS[-1], 24_000)
    beyond = x[~(curve.prd_m(x) <= limit)]
    if not beyond.size:
        assert (found.is_censored[0], found.intensity[0]) == (True, LEVELS[-1])
        return
    assert not found.is_censored[0]
    at = found.intensity[0]
    assert beyond[0] - (x[1] - x[0]) - ACCURACY * at <= at < beyond[0]
    assert single(motion(number, letters), slope, mu, at) <= limit
    assert not single(motion(number, letters), slope, mu, at * (1.0 + 1.1 * ACCURACY)) <= limit


@pytest.mark.quick
def test_two_axes_capacity_is_bracketed_by_single_runs_and_none_before_it_exceeds():
    one = motion(1, "xyz")
    at = searched(curve_of(one, 2.0, 0.4), 0.05).intensity[0]
    assert LEVELS[0] < at < LEVELS[-1]
    assert single(one, 2.0, 0.4, at) <= 0.05 < single(one, 2.0, 0.4, at * (1.0 + 1.1 * ACCURACY))
    assert all(single(one, 2.0, 0.4, x) <= 0.05 for x in np.linspace(0.05, at, 15))


@pytest.mark.parametrize("number", by_day(range(4), 1))
@pytest.mark.parametrize("limit", [0.02, 0.1])
def test_orientations_that_decide_nothing_are_not_run(number, limit):
    """With censoring every orientation is run, as one without a value might end the search."""
    one, levels = motion(number, "xyz"), LEVELS[:-2]  # beyond, a motion lifts the block off
    few, every = (
        searched(curve_of(one, 2.0, 0.4), limit, levels, is_censoring=each)
        for each in (False, True)
    )
    assert not np.isnan(curve_of(one, 2.0, 0.4).prd_m(levels)).any()
    for name in ("intensity", "is_censored", "end", "falls"):
        assert getattr(few, name) == getattr(every, name)
    assert few.runs < 0.7 * every.runs


class Formula:
    """A curve in closed form whose slip begins at a tenth of an intensity."""

    def __init__(self, formula):
        self.known, self.formula = {}, formula

    @property
    def runs(self):
        return len(self.known)

    def prd_m(self, intensity, _limit=math.inf):
        self.known.update(zip(intensity.tolist(), self.formula(intensity), strict=True))
        return self.formula(intensity)

    def first_slip(self):
        return 0.1


@pytest.mark.parametrize("center", np.linspace(0.9, 0.95, 7))
def test_a_curve_that_falls_again_counts_the_first_crossing_and_says_so(center):
    """A peak between two levels that are both below the limit, and a rise beyond both."""

    def prd(x):
        return 0.05 * x + 0.02 * np.exp(-(((x - center) / 0.03) ** 2))

    limit = 0.05 * center + 0.0195
    exact = brentq(lambda x: prd(x) - limit, center - 0.06, center)
    coarse = np.array([0.8, 1.05, 2.4])
    assert (prd(coarse) <= limit).tolist() == [True, True, False]
    found = searched(Formula(prd), limit, coarse)
    assert found.falls[0]
    assert is_just_below(found, exact)


@pytest.mark.parametrize("letters", by_day(["x", "xz", "xyz"], 2))
@pytest.mark.parametrize(("slope", "mu"), [(0.0, 0.3), (3.0, 0.5)])
def test_slip_begins_where_the_forces_at_a_sample_reach_the_cone(letters, slope, mu):
    """Per sample a quadratic in the intensity, |shear|^2 = (mu N)^2, solved in closed form."""
    one = motion(2, letters)
    sn, cs = math.sin(math.radians(slope)), math.cos(math.radians(slope))
    least = math.inf
    for scene in scenes(one, slope, mu):
        ax, zero = scene.ax_mps2, np.zeros_like(scene.ax_mps2)
        ay, az = (a if a.size else zero for a in (scene.ay_mps2, scene.az_mps2))
        # Shear t0 + x t1 and normal force n0 + x n1 per mass; both orientations have both signs.
        t0, n0 = G * sn, G * cs
        for sign in (1.0, -1.0):
            t1, n1 = az * sn - sign * ax * cs, az * cs + sign * ax * sn
            a = t1**2 + ay**2 - (mu * n1) ** 2
            b = 2.0 * (t0 * t1 - mu**2 * n0 * n1)
            c = t0**2 - (mu * n0) ** 2
            roots = np.concatenate(
                [np.roots(row) for row in np.stack([a, b, c + zero], axis=-1) if np.any(row[:2])]
            )
            real = roots.real[(np.abs(roots.imag) < 1e-12) & (roots.real > 0.0)]
            least = min(least, float(real.min()))
    found = searched(curve_of(one, slope, mu), 0.0)
    assert found.intensity[0] == pytest.approx(least, rel=1e-9)
    assert not found.is_censored[0]


@pytest.mark.quick
def test_a_run_without_a_value_is_an_exceedance_or_censors_its_motion():
    one = motion(1, "xz")
    curve, levels = curve_of(one, 2.0, 0.6), np.linspace(0.5, 12.0, 24)
    exceeding, censored = (
        searched(curve, 1e6, levels, is_censoring=is_censoring) for is_censoring in (False, True)
    )
    assert (exceeding.is_censored[0], censored.is_censored[0]) == (False, True)
    assert exceeding.intensity == censored.intensity
    at = float(censored.intensity[0])
    assert math.isfinite(single(one, 2.0, 0.6, at))
    assert math.isnan(single(one, 2.0, 0.6, at * (1.0 + 1.1 * ACCURACY)))


def test_a_record_of_zeros_and_a_slope_beyond_friction_have_the_ends_of_the_range():
    still = dataclasses.replace(motion(1), ax_mps2=frozen(np.zeros(400)))
    for limit in (0.0, 0.1):
        found = searched(curve_of(still, 2.0, 0.4), limit)
        assert (found.intensity[0], found.is_censored[0]) == (LEVELS[-1], True)
        sliding = searched(curve_of(motion(1), 30.0, 0.4), limit)
        assert sliding.intensity[0] == pytest.approx(0.0, abs=ACCURACY)


@pytest.mark.parametrize("most", [0, 1, 3, 5])
@pytest.mark.quick
def test_a_search_that_may_run_no_more_takes_the_capacity_from_below(monkeypatch, most):
    monkeypatch.setattr("solver.studies.capacity.MOST_CLOSER", most)
    curve, levels = Formula(lambda x: 0.08 * x * x), np.array([3.0])
    (found,) = capacities([curve], [0.5], levels, is_censoring=False, steps=12)
    assert found.runs[0] == 12 + most
    assert 2.0 < found.intensity[0] < 2.5 * (1.0 - ACCURACY)
    assert not found.falls[0]


@pytest.mark.parametrize("limits", [[0.5], [0.1, 0.5], [0.5, 40.0]])
@pytest.mark.parametrize("greatest", [3.0, 7.0])
def test_a_search_that_ends_at_the_last_limit_finds_the_same_in_fewer_runs(limits, greatest):
    def prd(x):
        return np.where(x > 6.0, math.nan, 0.08 * x * x + 0.03 * np.sin(9.0 * x))

    searches = [
        capacities([Formula(prd)], limits, np.array([greatest]), is_censoring=True, to_end=to_end)
        for to_end in (True, False)
    ]
    for whole, ended in zip(*searches, strict=True):
        assert ended.intensity == whole.intensity
        assert ended.is_censored == whole.is_censored
        assert (ended.runs < whole.runs) == (greatest > 6.0 or limits[-1] < 40.0)


def test_intensities_that_were_run_before_are_not_run_again():
    """A level of the study is the same run as one of the search."""
    first, again = (Formula(lambda x: 0.08 * x * x) for _ in range(2))
    levels = np.array([1.0, 2.0, 3.0])
    again.prd_m(levels)
    (alone,), (after,) = (
        capacities([one], [0.5], levels, is_censoring=False) for one in (first, again)
    )
    assert after.intensity == alone.intensity
    assert after.runs == alone.runs - levels.size


GRID = np.geomspace(0.25, 4.0, 20)


def known(capacity, end=math.inf):
    """Capacities that are censored at an intensity."""
    return Capacities(
        intensity=np.minimum(capacity, end),
        is_censored=capacity > end,
        end=np.full(capacity.size, min(end, 1e9)),
        falls=np.zeros(capacity.size, dtype=bool),
        runs=np.zeros(capacity.size, dtype=int),
    )


def drawn(rng, motions, beta, end=math.inf, theta=1.0):
    """Capacities of a lognormal, of a generator or a seed."""
    rng = np.random.default_rng(rng)
    return known(theta * np.exp(beta * rng.standard_normal(motions)), end)


def fitted(found, seed=1):
    exceeds = found.intensity[:, None] < GRID
    return fragility(GRID, exceeds, np.ones_like(exceeds), found, seed=seed)


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.quick
def test_the_likelihood_of_censored_capacities_is_largest_as_another_optimizer_finds(seed):
    rng = np.random.default_rng(seed)
    found = drawn(rng, 12, 0.3, rng.uniform(0.9, 1.3))

    def less(p):
        z = (np.log(found.intensity) - p[0]) / math.exp(p[1])
        return -np.sum(np.where(found.is_censored, norm.logsf(z), norm.logpdf(z) - p[1]))

    finely = {"xatol": 1e-9, "fatol": 1e-12}
    best = minimize(less, (0.0, -1.0), method="Nelder-Mead", options=finely)
    one = fit_lognormal(found)
    assert (math.log(one.theta), math.log(one.beta)) == pytest.approx(best.x, abs=1e-6)


def test_the_exact_intervals_of_seven_capacities():
    """Tables: t(0.95, 6) = 1.9432, chi-square(0.05, 6) = 1.6354 and (0.95, 6) = 12.5916."""
    found = fitted(drawn(4, 7, 0.2))
    logs = np.log(found.capacities.intensity)
    far = 1.9432 * logs.std(ddof=1) / math.sqrt(7)
    wanted = logs.mean() - far, logs.mean() + far
    assert np.log(found.theta_range) == pytest.approx(wanted, abs=1e-5)
    sums = ((logs - logs.mean()) ** 2).sum()
    wanted = math.sqrt(sums / 12.5916), math.sqrt(sums / 1.6354)
    assert found.beta_range == pytest.approx(wanted, rel=1e-4)


@pytest.mark.parametrize("values", [[1.0, 1.0, 1.0], [0.0, 1.0, 2.0], [1.0]], ids=str)
def test_capacities_that_determine_no_lognormal_give_none(values):
    found = fitted(known(np.array(values)))
    assert not found.fitted.is_known
    assert all(map(math.isnan, (found.fitted.beta, *found.theta_range, *found.beta_range)))


def held(motions, beta, end, sets):
    """Fractions of sets whose intervals hold the median and beta, of those that have any."""
    rng, inside = np.random.default_rng(20), []
    for seed in range(sets):
        one = fitted(drawn(rng, motions, beta, end), seed=seed)
        if one.fitted.is_known:
            (low, high), (least, most) = one.theta_range, one.beta_range
            inside.append([low <= 1.0 <= high, least <= beta <= most])
    return np.mean(inside, axis=0)


@pytest.mark.parametrize("beta", by_day([0.05, 0.2, 0.4], 1))
@pytest.mark.parametrize("motions", by_day([7, 20, 40], 1))
def test_the_intervals_hold_the_truth_in_88_to_92_percent_of_sets(motions, beta):
    share = held(motions, beta, math.inf, 2000)
    assert ((share >= 0.88) & (share <= 0.92)).all(), share


@pytest.mark.nightly
@pytest.mark.parametrize(("motions", "beyond"), [(7, 0.1), (20, 0.25), (40, 0.25), (40, 0.5)])
def test_the_intervals_of_censored_capacities_hold_it_about_as_often(motions, beyond):
    """400 sets: 0.90 within three standard errors of 0.015."""
    share = held(motions, 0.2, math.exp(0.2 * norm.isf(beyond)), 400)
    assert (np.abs(share - 0.9) <= 0.045).all(), share


def test_the_same_seed_gives_the_same_interval():
    found = drawn(1, 20, 0.4, 1.3)
    one, two = (fitted(found, seed=5) for _ in range(2))
    assert (one.theta_range, one.beta_range) == (two.theta_range, two.beta_range)


@pytest.mark.quick
def test_a_censored_run_is_in_no_count_and_is_stated():
    found = drawn(3, 45, 0.4)
    exceeds = found.intensity[:, None] <= GRID
    counts = np.ones_like(exceeds)
    counts[4, -1] = counts[9, -1] = False
    one = fragility(GRID, exceeds, counts, found, seed=1)
    assert (one.censored, one.counted[0], one.counted[-1]) == (2, 45, 43)
    assert one.exceeded[-1] <= 43


def test_the_p_value_is_that_of_another_simulation():
    for seed in (1, 2, 3):
        found = fitted(drawn(seed, 12, 0.3))
        logs = np.log(found.capacities.intensity)
        other = goodness_of_fit(norm, logs, statistic="ks", n_mc_samples=4000, rng=seed)
        assert float(lilliefors(logs)) == pytest.approx(other.statistic, rel=1e-9)
        assert found.p_value == pytest.approx(other.pvalue, abs=0.03)


@pytest.mark.parametrize(("motions", "critical"), [(7, 0.3041), (10, 0.2616), (20, 0.1920)])
def test_the_p_value_is_5_percent_at_the_critical_values_of_molin_and_abdi(motions, critical):
    assert lilliefors_p(critical, motions) == pytest.approx(0.05, abs=0.006)
    assert lilliefors_critical(motions) == pytest.approx(critical, rel=0.015)


@pytest.mark.quick
def test_a_set_of_two_groups_is_no_lognormal_and_a_censored_one_has_no_p_value():
    groups = np.concatenate([np.linspace(0.5, 0.51, 10), np.linspace(2.0, 2.02, 10)])
    assert fitted(known(groups)).p_value < 0.001
    assert math.isnan(fitted(drawn(1, 20, 0.3, 1.0)).p_value)


SETS = [
    ([0.1, -0.3, 0.2, 0.4, 0.4], [0, 0, 0, 1, 1]),
    ([0.1, -0.3, 0.2, 0.5, 0.4], [0, 0, 0, 0, 0]),
    ([-2.0, 3.0, -1.9, -1.8, 9.0, 9.0, 9.0], [0, 0, 1, 1, 1, 1, 1]),
    ([0.0, 0.01, 5.0, 5.0, 5.0, 5.0], [0, 0, 1, 1, 1, 1]),
    ([0.1, 0.1, 0.4], [0, 0, 1]),
    ([0.1, 0.2], [0, 1]),
]


ARRAYS = [(np.array([values]), np.array([flags], dtype=bool)) for values, flags in SETS]


@pytest.mark.parametrize("one", ARRAYS[4:])
def test_fewer_than_two_different_values_determine_none(one):
    found = fit_normals(*one)
    assert np.isnan([found.mean, found.deviation, found.of_mean, found.of_log]).all()


def test_standard_errors_of_uncensored_values_are_those_of_theory():
    found = fit_normals(*ARRAYS[1])
    assert found.of_mean == pytest.approx(found.deviation / math.sqrt(5), rel=1e-12)
    assert found.of_log == pytest.approx(1.0 / math.sqrt(10), rel=1e-12)


@pytest.mark.parametrize("one", ARRAYS[:4])
@pytest.mark.parametrize("off", [-1.5, 0.0, 0.7, 4.0])
def test_the_likelihood_of_a_mean_is_largest_as_another_optimizer_finds(one, off):
    y, flags = one

    def less(log_deviation, mean):
        z = (y - mean) / math.exp(log_deviation)
        return -np.sum(np.where(flags, norm.logsf(z), norm.logpdf(z) - log_deviation))

    found = fit_normals(y, flags)
    mean = float(found.mean[0])
    best = minimize_scalar(less, args=(mean + off,), bounds=(-8, 8), options={"xatol": 1e-10})
    own = less(math.log(found.deviation[0]), mean)
    assert log_likelihood(y, flags, found.mean, 1.0 / found.deviation) == pytest.approx(-own)
    assert deviance(y, flags, mean + off, found)[0] == pytest.approx(
        2.0 * (best.fun - own), abs=1e-8
    )


def test_tails_are_finite_far_out():
    for z in (-40.0, -30.0, 0.0, 40.0):
        assert np.isfinite(inverse_mills(z))
    assert inverse_mills(-1e4) == pytest.approx(1e4, rel=1e-7)


def test_rows_without_a_fit_are_nan():
    y, flags = np.array([[0.0, 1.0, 2.0], [1.0, 1.0, 1.0]]), np.zeros((2, 3), dtype=bool)
    found = fit_normals(y, flags)
    assert found.mean[0] == 1.0
    deviances = deviance(y, flags, 1.0, found)
    assert deviances[0] == pytest.approx(0.0, abs=1e-12)
    assert np.isnan([found.mean[1], found.of_mean[1], deviances[1]]).all()
