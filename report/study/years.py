"""Service life of an array: annual rates, and the displacement in 25 years.

A PRD that is exceeded once in 475 years in the mean is exceeded in 25 years with a probability of
1 - exp(-25/475) = 5.1%.

Supporting analysis, from which no value of a code follows. Read `years_of`.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import partial

import numpy as np

from report.project.read.years_file import ABOVE, ALWAYS, NEVER
from report.study.capacity_runs import curves_of
from report.study.study_plan import ArrayPlan, StudyPlan
from solver.model import Floats
from solver.studies.curves import first_allowed
from solver.studies.lives import (
    BELOW_UPLIFT,
    Draws,
    LifeStatistics,
    Responses,
    distances,
    draw,
    life_statistics,
    run_levels,
    settled_responses,
    uplift_intensity,
)
from solver.studies.predictive import Predictive
from solver.studies.rates import (
    HazardCurve,
    band,
    deaggregated,
    displacements_at,
    exceedance_rates,
    probability,
    realizations,
)
from solver.studies.runs import Runner

# Mean recurrence intervals [years].
RECURRENCES = (72.0, 475.0, 700.0, 975.0, 2475.0)

# Recurrence of the PRD that is compared with the clearance: as permit packages promise it.
VERDICT_YEARS = 700.0

# Permit packages promise the PRD of 700 years with that of smaller events over 25 years.
SPANS = (25.0, 50.0)
LIFE_YEARS = 25.0
# With so many, a probability of 5% has a standard error of 0.07%: sqrt(0.05 x 0.95 / 100,000).
LIVES = 100_000

# Limits from 0.1 mm on, evenly in the logarithm.
_LIMITS, _LEAST_LIMIT_M = 300, 1e-4
_BINS = 8


@dataclass(frozen=True, slots=True, kw_only=True)
class ArrayYears:
    """The rates and the lives of an array on a building; arrays of limits have the shape (m,)."""

    plan: ArrayPlan
    predicted: tuple[Predictive, ...]  # distribution of friction; empty without tests
    mus: tuple[float, ...]  # equally likely
    slip: float  # intensity at which the first motion slips with the least of them
    responses: Responses
    change: float  # of the results, by halving the steps of intensity
    limits_m: Floats
    rates: Floats  # at which a PRD exceeds the limits [1/year]
    rates_band: Floats  # its quantiles of `rates.BAND`, shape (2, m)
    prd_m: Floats  # of `RECURRENCES`; inf for none
    prd_band_m: Floats  # its quantiles, shape (2, 5)
    prd_by_mu_m: Floats  # of each coefficient alone, shape (frictions, 5)
    edges: Floats  # intensities, shape (n + 1,)
    shares: Floats  # of the rate at which the clearance is exceeded, shape (n,)
    lives: Mapping[str, Floats]  # `distances` by when the array is put back
    required_mu: float  # with it the PRD of `VERDICT_YEARS` is the clearance; inf or 0 beyond
    more_runs: float  # until it is the lowest of the predictive distribution; NaN without tests

    @property
    def clearance_rates(self) -> Floats:
        """Annual rate at which the clearance is exceeded, and its quantiles, shape (3,)."""
        # Exactly: `_by_run` has put the clearance among the limits.
        index = int(np.searchsorted(self.limits_m, self.plan.array.clearance_m))
        return np.array([self.rates[index], *self.rates_band[:, index]])

    @property
    def recurrences(self) -> list[tuple[float, ...]]:
        """Years, PRD and its quantiles [m] by mean recurrence interval."""
        return list(zip(RECURRENCES, self.prd_m, *self.prd_band_m, strict=True))

    @property
    def chances(self) -> Mapping[float, list[float]]:
        """Probability that the clearance is exceeded and its quantiles, by years of `SPANS`."""
        return {span: [probability(rate, span) for rate in self.clearance_rates] for span in SPANS}

    @property
    def bins(self) -> list[tuple[float, float, float]]:
        """Bounds of the intensity, and share of the rate."""
        return list(zip(self.edges[:-1], self.edges[1:], self.shares, strict=True))

    @property
    def statistics(self) -> Mapping[str, tuple[LifeStatistics, LifeStatistics]]:
        """Of the largest and the last distance, by when the array is put back."""
        measure = partial(life_statistics, clearance_m=self.plan.array.clearance_m)
        return {name: (measure(lives[0]), measure(lives[1])) for name, lives in self.lives.items()}


def years_of(plan: StudyPlan, curve: HazardCurve, array: ArrayPlan, runner: Runner) -> ArrayYears:
    """Return the rates and the lives of an array."""
    of_mat = plan.predicted.get(array.array.mat.casefold())
    predicted = (of_mat,) if of_mat else ()
    mus = predicted[0].quantiles if predicted else (array.mu,)
    slope_deg, motions = array.array.slope_deg, len(runner.campaign.motions[0])
    # The first coefficient is the least: below the intensity at which it slips nothing moves.
    slip = min(track.first_slip() for track in curves_of(runner, array, mus[0], slope_deg))
    tracks = runner.tracks[array.building]
    lifted = [uplift_intensity(track, math.radians(slope_deg)) for track in tracks]
    # A run beyond uplift has no value: such events count as beyond every limit.
    ends = np.minimum(curve.top, BELOW_UPLIFT * np.array(lifted))
    top = float(ends.max())
    # Where the array hardly slips the levels still need a range to be spaced over.
    low = min(max(slip, float(curve.intensity[0])), 0.5 * top)
    draws = draw(
        np.random.default_rng(array.seed), curve, low=low, top=top, runs=len(tracks),
        frictions=len(mus), years=LIFE_YEARS, lives=LIVES,
    )  # fmt: skip
    responses, change = settled_responses(
        partial(run_levels, tracks, math.radians(slope_deg), mus),
        low,
        ends,
        partial(_measured, curve, array, draws),
    )
    limits_m, by_run = _by_run(curve, array, responses)
    # Friction coefficients are quantiles of equal probability and runs are equally likely: a plain
    # mean of the rates.
    rates, years = by_run.mean(axis=(1, 2)), np.array(RECURRENCES)
    # The orientations of a motion are no motions of their own: the band draws motions alone.
    by_motion = by_run.reshape(*by_run.shape[:2], motions, -1).mean(axis=-1)
    drawn = realizations(by_motion, seed=array.seed)
    by_mu = displacements_at(limits_m, by_run.mean(axis=-1), years).T
    clearance_m, edges = array.array.clearance_m, np.geomspace(low, top, _BINS + 1)
    required = _required_mu(mus, by_mu[:, RECURRENCES.index(VERDICT_YEARS)], clearance_m)
    above = plan.input.hazard.recenter_m
    recenter = {NEVER: math.inf, **({ABOVE: above} if above else {}), ALWAYS: 0.0}
    return ArrayYears(
        plan=array,
        predicted=predicted,
        mus=mus,
        slip=slip,
        responses=responses,
        change=change,
        limits_m=limits_m,
        rates=rates,
        rates_band=band(drawn),
        prd_m=displacements_at(limits_m, rates, years),
        prd_band_m=band(displacements_at(limits_m, drawn, years)),
        prd_by_mu_m=by_mu,
        edges=edges,
        shares=deaggregated(curve, responses.levels, responses.prd_m, clearance_m, edges),
        lives={name: distances(draws, responses, above) for name, above in recenter.items()},
        required_mu=required,
        more_runs=predicted[0].more_runs(required) if predicted else math.nan,
    )


def _by_run(curve: HazardCurve, array: ArrayPlan, responses: Responses) -> tuple[Floats, Floats]:
    """Return limits, and the rates at which each run exceeds them, shape (limits, mus, runs)."""
    clearance_m = array.array.clearance_m
    top = max(float(np.nanmax(responses.prd_m, initial=0.0)), 2.0 * clearance_m)
    limits_m = np.concatenate([[0.0], np.geomspace(_LEAST_LIMIT_M, top, _LIMITS)])
    # With the clearance itself: its rate is then computed, not interpolated.
    limits_m = np.union1d(limits_m, clearance_m)
    return limits_m, exceedance_rates(curve, responses.levels, responses.prd_m, limits_m)


def _measured(curve: HazardCurve, array: ArrayPlan, draws: Draws, responses: Responses) -> Floats:
    """Return what must settle: the PRDs of the recurrences, and the 95% values of the lives."""
    limits_m, by_run = _by_run(curve, array, responses)
    prd_m = displacements_at(limits_m, by_run.mean(axis=(1, 2)), np.array(RECURRENCES))
    # Never put back: the distances that most events add up to.
    lives = distances(draws, responses, math.inf)
    return np.append(prd_m, [life_statistics(life, 0.0).p95_m for life in lives])


def _required_mu(mus: tuple[float, ...], prd_m: Floats, clearance_m: float) -> float:
    """Return the coefficient at which the PRD is the clearance; inf or 0 beyond those run."""
    if prd_m[0] <= clearance_m:
        return 0.0
    # No line leads from a PRD that is infinite: the next coefficient is the one that is known.
    known_m = np.where(np.isfinite(prd_m), prd_m, math.nan)
    required = first_allowed(np.array(mus), known_m, clearance_m)
    return math.inf if math.isnan(required) else required
