"""Annual rates of displacement and lives of a roof: closed forms and independent simulations."""

import dataclasses
import math

import numpy as np
import pytest
from scipy.special import ndtr, ndtri

from fixtures.campaigns import motion
from fixtures.marks import by_day
from solver import solve
from solver.kernels import lives as kernel
from solver.model import coulomb
from solver.studies.campaign import Campaign, grid
from solver.studies.lives import (
    BELOW_UPLIFT,
    RESPONSES,
    Draws,
    Responses,
    distances,
    draw,
    life_statistics,
    run_levels,
    settled_responses,
    uplift_intensity,
)
from solver.studies.rates import (
    LEAST_RATE,
    HazardCurve,
    band,
    contributions,
    deaggregated,
    displacements_at,
    exceedance_rates,
    probability,
    realizations,
)
from solver.studies.runs import SETTINGS, Runner

K0, K = 0.002, 2.5


def power(low=1e-3, high=1e3, **more):
    """A hazard of K0 x^-K."""
    x = np.array([low, high])
    return HazardCurve(intensity=x, rate=K0 * x**-K, **more)


def cornell(median, beta):
    """Rate at which a lognormal capacity is exceeded (Cornell et al. 2002, Eq. 7)."""
    return K0 * median**-K * math.exp(0.5 * (K * beta) ** 2)


@pytest.mark.parametrize(("median", "beta"), by_day([(0.8, 0.2), (1.3, 0.4)], 1))
def test_lognormal_capacities_of_many_motions_have_the_rate_of_cornell(median, beta):
    n = 4000
    capacities = median * np.exp(beta * ndtri((np.arange(n) + 0.5) / n))
    levels = np.geomspace(0.05, 40.0, 1500)
    # A PRD that is twice the intensity over the capacity exceeds 2 m where the capacity is reached.
    prd_m = 2.0 * levels / capacities[:, None]
    (rate,) = exceedance_rates(power(), levels, prd_m, np.array([2.0])).mean(axis=1)
    assert rate == pytest.approx(cornell(median, beta), rel=1e-3)


@pytest.mark.parametrize("beta", [0.1, 0.4, 0.6])
def test_a_dispersion_of_the_events_has_the_rate_of_cornell(beta):
    levels = np.array([0.01, 1.0, 100.0])
    prd_m = np.array([[0.01, 1.0, 100.0]])
    (rate,) = exceedance_rates(power(beta=beta), levels, prd_m, np.array([1.0]))
    assert rate[0] == pytest.approx(cornell(1.0, beta), rel=1e-3)


def test_a_prd_that_falls_again_counts_where_it_is_larger():
    levels, prd_m = np.array([1.0, 2.0, 3.0, 4.0]), np.array([[0.0, 1.0, 0.0, 2.0]])
    curve = power()
    found = contributions(curve, levels, curve.at(levels), prd_m, 0.5)[0]
    edges = curve.at(np.array([1.5, 2.0, 2.5, 3.25, 4.0]))
    assert found == pytest.approx(
        [edges[0] - edges[1], edges[1] - edges[2], edges[3] - edges[4], edges[4]], rel=1e-12
    )


def test_runs_without_a_value_exceed_every_limit_from_the_level_below_on():
    levels = np.array([1.0, 2.0, 3.0, 4.0])
    prd_m = np.array([[0.1, 0.2, np.nan, np.nan], [np.nan, 0.2, 0.3, 0.4]])
    rate = power().at(levels)
    first, second = exceedance_rates(power(), levels, prd_m, np.array([10.0]))[0]
    assert first == pytest.approx(rate[1], rel=1e-12)
    assert second == pytest.approx(rate[0] - rate[1] + rate[3], rel=1e-12)


def test_a_curve_that_ends_leaves_its_last_rate_to_every_limit():
    ended = HazardCurve(intensity=np.array([0.1, 1.0]), rate=np.array([0.1, 0.001]))
    assert ended.is_ended
    assert ended.top == 1.0
    levels = np.array([0.1, 1.0])
    limits = np.linspace(0.0, 1.0, 201)
    rates = exceedance_rates(ended, levels, np.array([[0.0, 0.5]]), limits).mean(axis=1)
    assert rates[-1] == pytest.approx(0.001)
    found = displacements_at(limits, rates, np.array([5.0, 475.0, 975.0, 2475.0]))
    assert found[0] == 0.0
    assert 0.0 < found[1] < found[2] <= 0.5
    assert found[3] == math.inf


def test_a_long_curve_is_run_to_the_least_rate():
    assert power().at(np.array([power().top]))[0] == pytest.approx(LEAST_RATE, rel=1e-3)
    assert not power().is_ended


def test_displacements_of_a_recurrence_are_exceeded_once_in_it():
    levels = np.geomspace(0.2, 20.0, 60)
    prd_m = 0.3 * (levels - 0.2) ** 1.5
    limits = np.concatenate([[0.0], np.geomspace(1e-4, 20.0, 300)])
    rates = exceedance_rates(power(), levels, prd_m[None], limits)[:, 0]
    years = np.array([72.0, 475.0, 700.0, 2475.0])
    found = displacements_at(limits, rates, years)
    exact = exceedance_rates(power(), levels, prd_m[None], found)[:, 0]
    assert exact == pytest.approx(1.0 / years, rel=2e-3)


def test_shares_are_of_the_site_and_sum_to_one():
    levels = np.geomspace(0.05, 20.0, 400)
    prd_m = levels[None].copy()
    edges = np.geomspace(0.02, 60.0, 50)
    plain = deaggregated(power(), levels, prd_m, 1.0, edges)
    assert plain.sum() == pytest.approx(1.0)
    assert plain[edges[1:] < 0.95] == pytest.approx(0.0, abs=1e-12)
    # Of a power law the mean of ln x of events with x e > 1 is that of the rate, less k beta^2.
    spread = deaggregated(power(beta=0.4), levels, prd_m, 1.0, edges)
    middles = np.log(np.sqrt(edges[1:] * edges[:-1]))
    assert spread @ middles == pytest.approx(1.0 / K - K * 0.4**2, abs=0.03)


@pytest.mark.parametrize("end", [10.0, 3.0])
def test_shares_with_a_dispersion_are_those_of_a_quadrature(end):
    """The PRD exceeds 1 m at intensities above 2 and the block lifts off above 4."""
    x, beta = np.array([0.1, end]), 0.4
    curve = HazardCurve(intensity=x, rate=1e-3 * x**-2.0, beta=beta)
    levels, edges = np.geomspace(0.5, min(4.0, end), 65), np.geomspace(0.5, min(4.0, end), 9)
    prd_m = np.where(levels > 2.0, 3.0, levels / 2.0)
    found = deaggregated(curve, levels, prd_m, 1.0, edges)
    events = np.geomspace(0.1, end, 400_001)
    middles, rate = np.sqrt(events[1:] * events[:-1]), -np.diff(1e-3 * events**-2.0)
    crossing = np.interp(1.0, prd_m, levels)
    exceeding = rate * ndtr(np.log(middles / crossing) / beta)
    inside = np.clip(middles, edges[0] * (1.0 + 1e-12), edges[-1] * (1.0 - 1e-12))
    expected = np.histogram(inside, edges, weights=exceeding)[0]
    # Events beyond the end of the curve exceed every limit, whatever their factor.
    expected[-1] += curve.rate[-1]
    assert found == pytest.approx(expected / expected.sum(), abs=2e-4)


def test_bands_hold_what_friction_and_motions_might_have_been():
    rates = np.zeros((2, 5, 8))
    rates[0] = np.array([1.0, 2.0, 3.0, 4.0, 5.0])[:, None]
    rates[1, :, :4] = 2.0
    found = band(realizations(rates, seed=1))
    assert found[:, 0].tolist() == [1.0, 5.0]
    # Of eight motions with 0 or 2, the mean has the standard deviation sqrt(1/8).
    assert found[:, 1] == pytest.approx([1.0 - 8**-0.5, 1.0 + 8**-0.5], abs=0.16)


def test_a_rate_of_one_in_the_years_is_exceeded_in_63_percent():
    assert probability(1.0 / 50.0, 50.0) == pytest.approx(1.0 - math.exp(-1.0), rel=1e-14)


LEVELS = np.geomspace(0.2, 8.0, 65)
CURVE = HazardCurve(intensity=np.array([0.01, 100.0]), rate=0.02 * np.array([0.01, 100.0]) ** -2.0)
YEARS = 25.0


def responses(frictions=2, runs=6, *, is_plane=True):
    """Displacements that grow with intensity, in several directions."""
    rng = np.random.default_rng(3)
    size = rng.uniform(0.5, 1.5, (frictions, runs, 1)) * 0.1 * (LEVELS - 0.2) ** 1.3
    values = np.zeros((frictions, runs, LEVELS.size, 6))
    angle = rng.uniform(-np.pi, np.pi, (frictions, runs, 1)) if is_plane else 0.0
    down, up = size * rng.uniform(0.3, 1.0, (2, frictions, runs, 1))
    values[..., kernel.DOWN], values[..., kernel.UP] = down, up
    values[..., kernel.ACROSS] = size * np.abs(np.sin(angle))
    values[..., kernel.RESIDUAL] = 0.8 * down * np.cos(angle) - (0.5 * up if not is_plane else 0.0)
    values[..., kernel.RESIDUAL_ACROSS] = 0.7 * size * np.sin(angle)
    # The PRD of a path is at most the distance of a corner of the rectangle around it.
    corner = np.hypot(np.maximum(down, up), values[..., kernel.ACROSS])
    values[..., kernel.PRD] = 0.9 * corner if is_plane else np.maximum(down, up)
    return Responses(levels=np.tile(LEVELS, (runs, 1)), values=values)


def drawn(rng=None, *, runs=6, frictions=2, lives=100_000, years=YEARS):
    rng = rng or np.random.default_rng(1)
    low, top = LEVELS[0], LEVELS[-1]
    return draw(
        rng, CURVE, low=low, top=top, runs=runs, frictions=frictions, years=years, lives=lives
    )


def in_numpy(draws, given, recenter_m):
    """The largest and the last distance of each life, event by event over all lives at once."""
    counts = np.diff(draws.first)
    place, largest = np.zeros((counts.size, 2)), np.zeros(counts.size)
    for number in range(counts.max()):
        alive = np.flatnonzero(counts > number)
        event = draws.first[alive] + number
        of = given.values[draws.friction[alive], draws.run[event]]
        at = np.array(
            [
                [np.interp(x, LEVELS, rows[:, k]) for k in range(6)]
                for x, rows in zip(draws.intensity[event], of, strict=True)
            ]
        )
        prd, down, up, across, along, sideways = at.T
        here = place[alive]
        box = np.stack([np.abs(here[:, 0] + down), np.abs(here[:, 0] - up)]).max(axis=0)
        corner = np.sqrt(box**2 + (np.abs(here[:, 1]) + across) ** 2)
        far = np.minimum(np.sqrt((here**2).sum(axis=1)) + prd, corner)
        far[~np.isfinite(draws.intensity[event])] = np.inf
        largest[alive] = np.maximum(largest[alive], far)
        here = here + np.stack([along, draws.side[event] * sideways], axis=1)
        here[np.sqrt((here**2).sum(axis=1)) > recenter_m] = 0.0
        place[alive] = here
    last = np.sqrt((place**2).sum(axis=1))
    last[np.isinf(largest)] = np.inf
    return np.stack([largest, last])


@pytest.mark.parametrize(
    ("recenter_m", "is_plane"), [(math.inf, True), (0.15, True), (0.0, True), (math.inf, False)]
)
def test_a_simulation_in_numpy_has_the_same_lives(recenter_m, is_plane):
    draws, given = drawn(lives=600), responses(is_plane=is_plane)
    assert np.isinf(draws.intensity).any() or np.diff(draws.first).max() > 10
    expected = in_numpy(draws, given, recenter_m)
    assert distances(draws, given, recenter_m) == pytest.approx(expected, rel=1e-12)


def test_one_event_alone_has_the_displacements_of_the_hazard_curve():
    given = responses()
    limits = np.array([0.05, 0.2, 0.6])
    rates = exceedance_rates(CURVE, LEVELS, given.prd_m, limits).mean(axis=(1, 2))
    draws = drawn()
    one = np.arange(draws.intensity.size + 1)
    each = Draws(
        first=one,
        friction=np.repeat(draws.friction, np.diff(draws.first)),
        run=draws.run,
        side=draws.side,
        intensity=draws.intensity,
    )
    for recenter_m in (math.inf, 0.0):
        largest, _ = distances(each, given, recenter_m)
        share = (largest[:, None] > limits).mean(axis=0)
        expected = rates / CURVE.at(LEVELS[:1])[0]
        assert (np.abs(share - expected) < 4.0 * np.sqrt(expected / largest.size)).all()


def test_equal_events_have_the_mean_of_a_renewal_process():
    """Put back after every third event: by the roots of unity of a Poisson number modulo 3."""
    values = np.zeros((1, 1, LEVELS.size, 6))
    values[..., [kernel.PRD, kernel.DOWN, kernel.RESIDUAL]] = 0.1
    draws = drawn(runs=1, frictions=1, lives=400_000, years=2.0)
    _, last = distances(draws, Responses(levels=LEVELS[None], values=values), 0.25)
    mean_events = 2.0 * CURVE.at(LEVELS[:1])[0]
    roots = np.exp(2j * np.pi * np.arange(3) / 3)
    of_rest = [(np.exp(mean_events * (roots - 1.0)) * roots**-j).mean().real for j in range(3)]
    # What is beyond the levels counts as without a value, once in 40,000 events.
    known = np.isfinite(last)
    assert last[known].mean() == pytest.approx(0.1 * of_rest[1] + 0.2 * of_rest[2], rel=5e-3)
    # Without re-centering each event adds its residual (Wald).
    _, last = distances(draws, Responses(levels=LEVELS[None], values=values), math.inf)
    assert last[known].mean() == pytest.approx(0.1 * mean_events, rel=5e-3)


def test_an_event_without_a_value_leaves_its_life_without_a_distance():
    given = responses()
    given.values[0, :, 40:] = np.nan
    draws = drawn()
    found = distances(draws, given, 0.0)
    has_event = np.diff(draws.first) > 0
    worst = np.maximum.reduceat(np.append(draws.intensity, 0.0), draws.first[:-1])
    lost = has_event & (draws.friction == 0) & (worst > LEVELS[39])
    assert np.isinf(found[:, lost & np.isfinite(worst)]).all()
    statistics = life_statistics(found[0], 0.1)
    assert statistics.without_value == pytest.approx(np.isinf(found[0]).mean(), abs=1e-12)
    assert statistics.beyond >= statistics.without_value > 0.0
    # As the 95 % value of a share above 5 %: that of the others would be too small.
    assert statistics.mean_m == math.inf


def test_responses_are_those_of_single_runs():
    given = Campaign(motions=((motion(1, "xyz"),),), cases=grid(1, [0.0], [0.3], [1.0]))
    tracks, levels = Runner(given).tracks[0], np.array([0.4, 0.9])
    found = run_levels(tracks, 0.03, [0.3, 0.4], np.tile(levels, (4, 1)))
    assert found.shape == (2, 4, 2, 6)
    orientation = given.motions[0][0].orientations[2]
    one = dataclasses.replace(given.motions[0][0], scale=0.9)
    scene = one.scene(orientation, slope_rad=0.03, friction=coulomb(0.4))
    single = solve(scene, SETTINGS).result
    assert found[1, 2, 1].tolist() == [getattr(single, name) for name in RESPONSES]
    assert np.abs(found[..., kernel.RESIDUAL_ACROSS]).max() > 0.0


def test_a_block_lifts_off_from_its_intensity_on():
    given = Campaign(motions=((motion(1, "xz"),),), cases=grid(1, [0.0], [0.3], [1.0]))
    track = Runner(given).tracks[0][0]
    most = uplift_intensity(track, 0.05)
    runs = [
        solve(
            dataclasses.replace(given.motions[0][0], scale=share * most).scene(
                given.motions[0][0].orientations[0], slope_rad=0.05, friction=coulomb(0.3)
            )
        ).result.status.name
        for share in (0.999, 1.001)
    ]
    assert runs[0] != "UPLIFT"
    assert runs[1] == "UPLIFT"
    ends = np.array([[BELOW_UPLIFT * most, BELOW_UPLIFT * most, 1.001 * most]])
    found = run_levels([track], 0.05, [0.3], ends)[0, 0]
    assert np.isfinite(found[0]).all()
    assert (found[0] == found[1]).all()
    assert np.isnan(found[2]).all()
    level = Campaign(motions=((motion(1, "x"),),), cases=grid(1, [0.0], [0.3], [1.0]))
    assert uplift_intensity(Runner(level).tracks[0][0], 0.0) == math.inf


def test_levels_are_halved_until_the_results_settle():
    calls = []

    def run(levels):
        calls.append(levels.shape[1])
        return np.repeat((levels**3)[None, :, :, None], 6, axis=3)

    def measured(given):
        middle = np.interp(2.345, given.levels[0], given.prd_m[0, 0])
        return np.array([middle, 0.0, math.inf])

    given, change = settled_responses(run, 0.01, np.array([100.0, 30.0]), measured)
    assert calls == [17, 16, 32]
    assert given.levels.shape == (2, 65)
    assert given.levels[1].max() == 30.0
    assert change < 0.005
    assert given.prd_m[0] == pytest.approx(given.levels**3, rel=1e-12)


def test_a_run_that_ends_exceeds_every_limit_from_its_end_on():
    """Not from the level below it: the intensity of uplift is known."""
    ends = np.array([100.0, 3.0])
    levels = np.minimum(np.geomspace(0.2, 100.0, 12), ends[:, None])
    values = np.repeat((0.1 * levels)[None, :, :, None], 6, axis=3)
    given = Responses(levels=levels, values=values)
    first, second = exceedance_rates(CURVE, levels, given.prd_m, np.array([0.25, 9.0]))[:, 0].T
    assert first == pytest.approx(CURVE.at(np.array([2.5, 90.0])), rel=1e-12)
    assert second == pytest.approx(CURVE.at(np.array([2.5, 3.0])), rel=1e-12)
    each = np.arange(5)
    draws = Draws(first=each, friction=np.zeros(4, dtype=int), run=np.array([0, 1, 0, 1]),
                  side=np.ones(4), intensity=np.array([3.1, 3.1, 2.9, 2.9]))  # fmt: skip
    largest, _ = distances(draws, given, math.inf)
    assert largest == pytest.approx([0.31, math.inf, 0.29, 0.29], rel=1e-12)
