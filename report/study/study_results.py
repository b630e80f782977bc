"""The results of a study from its parts: curves, fragilities, exceedances and the fitted formula.

Three motions with PRDs of 0.20, 0.30 and 0.40 m have a mean of 0.30 m; by PV1-2012 their value from
analysis is 1.1 x 0.40 = 0.44 m.

Reads one part at a time; runs the capacities of the motions. Read `results_of`.
"""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, fields
from itertools import product
from pathlib import Path
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from report.study.capacity_runs import SHARES, SpectralSpread, array_capacities, spectral_spread
from report.study.parquet_parts import Done, peaks, read_part
from report.study.study_input import NoValue
from report.study.study_plan import ArrayPlan, StudyPlan
from report.study.years import ArrayYears, years_of
from report.text.units import G_MPS2, round_down, round_up
from solver.errors import InputError
from solver.model import Floats
from solver.studies.curves import Fit, Statistics, first_allowed, fit_prd, statistics
from solver.studies.fragility import Fragility, fragility
from solver.studies.runs import Runner
from solver.studies.uncertainty import Bar, Exceedance, exceedance, tornado

_T = TypeVar("_T")

MEAN = "mean PRD"
# Beside the design displacement.
STATISTICS = (MEAN, "84th percentile of the PRD", "largest PRD")

# Decimals of answers [deg for slopes]: rounded to the safe side.
FRICTION_DECIMALS, SLOPE_DECIMALS = 2, 1


@dataclass(frozen=True, slots=True, kw_only=True)
class LimitState:
    """A limit state of an array with its fragility."""

    name: str  # such as LS2
    words: str
    limit_m: float  # PRD above which it is exceeded; 0 for the beginning of slip
    fragility: Fragility
    effects: Mapping[str, float]  # dispersion by names of `ArrayPlan.shifts`; NaN for none


@dataclass(frozen=True, slots=True, kw_only=True)
class ArrayStudyResult:
    """The results of one array on one building."""

    plan: ArrayPlan
    states: tuple[LimitState, ...]
    exceedances: tuple[Exceedance, ...]  # of the clearance; empty without an intensity at the site
    bars: tuple[Bar, ...]
    center_m: float  # mean PRD with all variables at their centers; NaN without that intensity
    capacity_runs: int


@dataclass(frozen=True, kw_only=True)
class StudyResults:
    """The results of a study; those of the grid have the shape of its four axes, NaN for none."""

    plan: StudyPlan
    manifest: Mapping[str, Any]  # of the finished runs
    curves: Statistics
    analysis_m: Floats  # value from analysis
    design_m: Floats
    spread: SpectralSpread  # of the motions' spectra
    # Mean peak horizontal acceleration at the roof for an intensity of 1, by building.
    ppa_g: Floats
    fits: tuple[Fit | str, ...]  # by building; a text says why there is none
    arrays: tuple[ArrayStudyResult, ...]
    years: tuple[ArrayYears, ...]  # in the order of the arrays; empty without a hazard curve
    allow_matched: bool  # fragilities without a record-to-record dispersion are exported

    @property
    def displacements(self) -> Mapping[str, Floats]:
        """The design displacement and the statistics of the PRD, by name."""
        c = self.curves
        statistics = zip(STATISTICS, (c.mean_m, c.p84_m, c.largest_m), strict=True)
        return {self.plan.design_rule.name: self.design_m, **dict(statistics)}

    @property
    def capacity_runs(self) -> int:
        """Runs for the capacities, beside those of the cases."""
        return sum(array.capacity_runs for array in self.arrays)

    @property
    def leading(self) -> str:
        """Name of the displacement of curves and answers: the mean where none is for design."""
        rule = self.plan.design_rule
        return rule.name if rule.has_value else MEAN

    def minimum_frictions(self, building: int, name: str, allowed_m: float) -> Floats:
        """Return the least friction by slope and intensity, rounded up; NaN for none of the study.

        From it on, no friction of the study has a displacement above the allowed one.
        """
        mus = np.array(self.plan.input.mus)
        # Rounded up, unless none of the study is between.
        return self._answers(
            building, name, mus, 1, allowed_m,
            lambda mu: min(round_up(mu, FRICTION_DECIMALS), float(mus[-1])),
        )  # fmt: skip

    def largest_slopes(self, building: int, name: str, allowed_m: float) -> Floats:
        """Return the largest slope [deg], rounded down, by friction and intensity; NaN for none.

        Up to it, no slope of the study has a displacement above the allowed one.
        """
        slopes = np.array(self.plan.input.slopes_deg)
        # Rounded down, unless none of the study is between.
        return self._answers(
            building, name, slopes[::-1], 0, allowed_m,
            lambda slope: max(round_down(slope, SLOPE_DECIMALS), float(slopes[0])),
        )  # fmt: skip

    def _answers(
        self, building: int, name: str, values: Floats, axis: int, allowed_m: float,
        rounded: Callable[[float], float],
    ) -> Floats:  # fmt: skip
        def answer(prd_m: Floats) -> float:
            first = first_allowed(values, prd_m, allowed_m)
            # A value of the study was run as it is: rounded, it would be one that was not.
            return first if first in values else rounded(first)

        # Slopes are looked at from the steepest on: their displacements are turned as they are.
        prd_m = self.displacements[name][building]
        return np.apply_along_axis(answer, axis, prd_m if axis else prd_m[::-1])


def results_of(
    plan: StudyPlan,
    folder: Path,
    done: Mapping[int, Done],
    manifest: Mapping[str, Any],
    *,
    allow_matched: bool,
    progress: Callable[[str], None],
) -> StudyResults:
    """Return the results of a study whose parts are all there."""
    progress("computing the curves")
    campaign = plan.campaign
    on_grid = math.prod(plan.shape)
    on_curves: list[Statistics] = []
    prds: list[Floats] = []
    slips: list[NDArray[np.bool_]] = []
    for number, part in enumerate(campaign.parts):
        prd, slip = peaks(read_part(folder, done[number]), campaign)
        # The grid comes first; one part may hold its last cases and the first of the arrays.
        cut = min(max(on_grid - part.start, 0), part.stop - part.start)
        on_curves.append(statistics(prd[:cut]))
        prds.append(prd[cut:])
        slips.append(slip[cut:])
    names = [field.name for field in fields(Statistics)]
    merged = {name: np.concatenate([getattr(s, name) for s in on_curves]) for name in names}
    curves = Statistics(**{name: values.reshape(plan.shape) for name, values in merged.items()})
    # Of the arrays alone: the grid of a large study, motion by motion, would fill the memory.
    prd, slip = np.concatenate(prds), np.concatenate(slips)
    # Motions are scaled to an intensity of 1, whatever its measure: the formula needs their peaks.
    ppa = np.array(
        [
            np.mean([np.abs(m.scaled(m.ax_mps2)).max() / G_MPS2 for m in motions])
            for motions in plan.motions.motions
        ]
    )
    analysis = plan.design_rule.analysis_m(curves)
    runner = Runner(campaign)
    return StudyResults(
        plan=plan,
        manifest=manifest,
        curves=curves,
        analysis_m=analysis,
        design_m=plan.design_rule.design_m(curves),
        spread=spectral_spread(plan.motions.motions),
        ppa_g=ppa,
        fits=tuple(_fit(plan, analysis[b], float(ppa[b])) for b in range(plan.shape[0])),
        arrays=tuple(
            _array(plan, array, runner, prd, slip, on_grid)
            for array in _metered("capacities of arrays", plan.arrays, progress)
        ),
        years=tuple(
            years_of(plan, curve, array, runner)
            for curve, array in _metered(
                "rates in years", list(product(plan.hazard, plan.arrays)), progress
            )
        ),
        allow_matched=allow_matched,
    )


def _metered(noun: str, items: Sequence[_T], progress: Callable[[str], None]) -> Iterator[_T]:
    """Yield items, and say how many are done and the time left at their rate."""
    started = time.monotonic()
    for done, item in enumerate(items):
        left_s = (time.monotonic() - started) * (len(items) - done) / max(done, 1)
        remaining = f", {left_s:.0f} s left" if done else ""
        progress(f"computing the {noun}: {done} of {len(items)}{remaining}")
        yield item


def _fit(plan: StudyPlan, analysis_m: Floats, ppa_g: float) -> Fit | str:
    study_input = plan.input
    if not plan.design_rule.has_value:
        return "there are too few motions for an analysis displacement"
    slopes, mus, levels = np.meshgrid(
        np.radians(study_input.slopes_deg), study_input.mus, study_input.intensities, indexing="ij"
    )
    try:
        return fit_prd(slopes.ravel(), mus.ravel(), levels.ravel(), analysis_m.ravel(), ppa_g=ppa_g)
    except InputError as error:
        # The formula is for convenience: without it the study is whole, and says why there is
        # none.
        return error.parts[0].text


def _array(
    plan: StudyPlan,
    array: ArrayPlan,
    runner: Runner,
    prd: Floats,
    slip: NDArray[np.bool_],
    offset: int,
) -> ArrayStudyResult:
    def of(cases: slice) -> slice:
        return slice(cases.start - offset, cases.stop - offset)

    study, clearance = plan.input.study, array.array.clearance_m
    # From a row for each level to one for each motion: capacities are those of a motion over its
    # levels.
    peaks_m, slips = prd[of(array.fragility)].T, slip[of(array.fragility)].T
    lost = np.isnan(peaks_m)
    counts = ~lost if study.no_value is NoValue.CENSORED else np.ones_like(lost)
    reaches = array.array.reaches or "the object or edge"
    words = ("slip begins", "half the clearance is used", f"{reaches} is reached")
    capacities, effects, runs = array_capacities(plan, array, runner, peaks_m)
    states = [
        LimitState(
            name=f"LS{k + 1}",
            words=words[k],
            limit_m=share * clearance,
            fragility=fragility(
                np.array(plan.input.intensities),
                # A run without a value exceeds every limit; whether it counts is `counts`.
                ~(peaks_m <= share * clearance) if share else slips | lost,
                counts,
                capacities[k],
                seed=array.seed,
            ),
            effects=effects[k],
        )
        for k, share in enumerate(SHARES)
    ]
    exceedances: tuple[Exceedance, ...] = ()
    bars: tuple[Bar, ...] = ()
    center = math.nan
    if array.samples.stop > array.samples.start:
        exceedances = (exceedance(prd[of(array.samples)], clearance, seed=array.seed),)
        means = prd[of(array.bars)].mean(axis=1)
        # The first case of the chart has all variables at their centers.
        bars, center = tornado(array.spreads, means), float(means[0])
    return ArrayStudyResult(
        plan=array,
        states=tuple(states),
        exceedances=exceedances,
        bars=bars,
        center_m=center,
        capacity_runs=runs,
    )
