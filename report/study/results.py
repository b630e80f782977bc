"""The results of a study from its parts: curves, fragilities, chances and the fitted formula.

Reads one part at a time. Read `results_of`.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from report.study.parts import Done, peaks, read_part
from report.study.plan import ArrayPlan, StudyPlan
from report.study.schema import NoValue
from report.words.units import G_MPS2
from solver.model import Floats, InputError
from solver.studies.curves import Statistics, largest_slope, least_friction, statistics
from solver.studies.fit import Fit, fit_prd
from solver.studies.fragility import Fragility, fragility
from solver.studies.uncertainty import Bar, Chance, exceedance, tornado

STATISTICS = ("mean", "84th percentile", "largest")


@dataclass(frozen=True, slots=True, kw_only=True)
class LimitState:
    """A limit state of an array with its fragility.

    Attributes
    ----------
    name, words : str
        Such as LS2, and what it is.
    limit_m : float
        PRD above which it is exceeded [m]; 0 for the beginning of slip.
    fragility : Fragility
    """

    name: str
    words: str
    limit_m: float
    fragility: Fragility


@dataclass(frozen=True, slots=True, kw_only=True)
class ArrayResult:
    """The results of one array on one building.

    Attributes
    ----------
    plan : ArrayPlan
    states : tuple of LimitState
    chances : tuple of Chance
        That the clearance is exceeded at the site; empty without an intensity there.
    bars : tuple of Bar
    center_m : float
        Mean PRD with all variables at their centers [m]; NaN without an intensity at the site.
    """

    plan: ArrayPlan
    states: tuple[LimitState, ...]
    chances: tuple[Chance, ...]
    bars: tuple[Bar, ...]
    center_m: float


@dataclass(frozen=True, kw_only=True)
class StudyResults:
    """The results of a study.

    Attributes
    ----------
    plan : StudyPlan
    manifest : mapping
        Of the finished runs.
    curves : Statistics
        Of shape (buildings, slopes, frictions, intensities).
    ppa_g : array, shape (buildings,)
        Mean peak horizontal acceleration at the roof for an intensity of 1 [g].
    fits : tuple of Fit or str
        By building; a text says why there is none.
    arrays : tuple of ArrayResult
    """

    plan: StudyPlan
    manifest: Mapping[str, Any]
    curves: Statistics
    ppa_g: Floats
    fits: tuple[Fit | str, ...]
    arrays: tuple[ArrayResult, ...]

    def statistic(self, name: str) -> Floats:
        """Return a statistic of the grid by its name."""
        c = self.curves
        return dict(zip(STATISTICS, (c.mean_m, c.p84_m, c.largest_m), strict=True))[name]

    def least_frictions(self, building: int, name: str, allowed_m: float) -> Floats:
        """Return the least friction by slope and intensity; NaN for none of the study."""
        values, mus = self.statistic(name)[building], np.array(self.plan.input.mus)
        slopes, _, levels = values.shape
        return np.array(
            [
                [least_friction(mus, values[s, :, x], allowed_m) for x in range(levels)]
                for s in range(slopes)
            ]
        )

    def largest_slopes(self, building: int, name: str, allowed_m: float) -> Floats:
        """Return the largest slope [deg] by friction and intensity; NaN for none of the study."""
        values, slopes = self.statistic(name)[building], np.array(self.plan.input.slopes_deg)
        _, mus, levels = values.shape
        return np.array(
            [
                [largest_slope(slopes, values[:, m, x], allowed_m) for x in range(levels)]
                for m in range(mus)
            ]
        )


def results_of(
    plan: StudyPlan, folder: Path, done: Mapping[int, Done], manifest: Mapping[str, Any]
) -> StudyResults:
    """Return the results of a study whose parts are all there."""
    campaign = plan.campaign
    on_grid = math.prod(plan.shape)
    columns: list[list[Any]] = [[], [], [], []]
    kept: list[Floats] = []
    slips: list[NDArray[np.bool_]] = []
    for number, part in enumerate(campaign.parts):
        found = peaks(read_part(folder, done[number]), campaign)
        cut = min(max(on_grid - part.start, 0), part.stop - part.start)
        one = statistics(found.prd_m[:cut])
        for column, values in zip(
            columns, (one.mean_m, one.p84_m, one.largest_m, one.without_value), strict=True
        ):
            column.append(values)
        kept.append(found.prd_m[cut:])
        slips.append(found.slips[cut:])
    mean, p84, largest, lost = (np.concatenate(c).reshape(plan.shape) for c in columns)
    curves = Statistics(mean_m=mean, p84_m=p84, largest_m=largest, without_value=lost)
    prd, slip = np.concatenate(kept), np.concatenate(slips)
    ppa = np.array(
        [
            np.mean([np.abs(m.ax_mps2).max() * m.scale / G_MPS2 for m in motions])
            for motions in plan.motions.motions
        ]
    )
    return StudyResults(
        plan=plan,
        manifest=manifest,
        curves=curves,
        ppa_g=ppa,
        fits=tuple(_fit(plan, curves.mean_m[b], float(ppa[b])) for b in range(plan.shape[0])),
        arrays=tuple(
            _array(plan, array, prd, slip, on_grid, number)
            for number, array in enumerate(plan.arrays)
        ),
    )


def _fit(plan: StudyPlan, mean_m: Floats, ppa_g: float) -> Fit | str:
    given = plan.input
    slopes, mus, levels = np.meshgrid(
        np.radians(given.slopes_deg), given.mus, given.intensities, indexing="ij"
    )
    try:
        return fit_prd(slopes.ravel(), mus.ravel(), levels.ravel(), mean_m.ravel(), ppa_g=ppa_g)
    except InputError as error:
        return error.problems[0]


def _array(
    plan: StudyPlan,
    array: ArrayPlan,
    prd: Floats,
    slip: NDArray[np.bool_],
    offset: int,
    number: int,
) -> ArrayResult:
    def of(cases: slice) -> slice:
        return slice(cases.start - offset, cases.stop - offset)

    study, clearance = plan.input.study, array.array.clearance_m
    seed = study.seed + 1000 * number
    peaks_m, slips = prd[of(array.fragility)].T, slip[of(array.fragility)].T
    lost = np.isnan(peaks_m)
    counts = ~lost if study.no_value is NoValue.CENSORED else np.ones_like(lost)
    levels = np.array(plan.input.intensities)
    states = [
        LimitState(
            name="LS1",
            words="slip begins",
            limit_m=0.0,
            fragility=fragility(levels, slips | lost, counts, seed=seed),
        )
    ]
    reaches = array.array.reaches or "the object or edge"
    for name, share, words in (
        ("LS2", 0.5, "half the clearance is used"),
        ("LS3", 1.0, f"{reaches} is reached"),
    ):
        exceeds = ~(peaks_m <= share * clearance)
        states.append(
            LimitState(
                name=name,
                words=words,
                limit_m=share * clearance,
                fragility=fragility(levels, exceeds, counts, seed=seed),
            )
        )
    chances: tuple[Chance, ...] = ()
    bars: tuple[Bar, ...] = ()
    center = math.nan
    if array.samples.stop > array.samples.start:
        chances = (exceedance(prd[of(array.samples)], clearance, seed=seed),)
        means = prd[of(array.bars)].mean(axis=1)
        bars, center = tornado(array.spreads, means), float(means[0])
    return ArrayResult(
        plan=array, states=tuple(states), chances=chances, bars=bars, center_m=center
    )
