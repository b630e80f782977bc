"""The capacities of an array, and how friction and slope disperse them: runs of their own.

A motion that slides the array 12 in at 0.62 g and 24 in at 0.90 g has, beside a clearance of 24 in,
a capacity of 0.62 g at half of it and of 0.90 g at all of it.

Fits medians alone; `solver.studies.fragility` fits the rest. Read `array_capacities`.

How much the spectra of the motions of a study differ from record to record.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from report.study.study_input import NoValue
from report.study.study_plan import ArrayPlan, Shift, StudyPlan
from solver.model import Floats, Motion
from solver.records.acceptance import LEAST_RATIO, POINTS_HZ
from solver.records.spectrum import response_spectrum
from solver.studies.capacity import COARSE_SCAN, Capacities, Curve, capacities, maximum_searches
from solver.studies.fragility import first_order_beta, fit_lognormal
from solver.studies.runs import Runner

# Limits on the PRD of a motion, as shares of the clearance; 0 is the beginning of slip.
SHARES = (0.0, 0.5, 1.0)


def array_capacities(
    plan: StudyPlan, array: ArrayPlan, runner: Runner, peaks_m: Floats
) -> tuple[tuple[Capacities, ...], list[dict[str, float]], int]:
    """Return the capacities of an array for each of `SHARES`, what disperses them, and its runs.

    `peaks_m` are the PRDs of its fragility, which were run before, shape (motions, levels).
    The dispersions due to friction and slope have the names of `ArrayPlan.shifts`.
    """
    levels = np.array(plan.input.intensities)
    curves = curves_of(runner, array, array.mu, array.array.slope_deg)
    for curve, peaks in zip(curves, peaks_m, strict=True):
        # The search begins with the runs that the fragility has: of projects/study 8,012 runs
        # became 7,356.
        curve.known.update(zip(levels.tolist(), peaks.tolist(), strict=True))
    capacities = _searched(plan, array, curves, levels)
    searches = [capacities]
    medians = _medians(capacities)
    effects: list[dict[str, float]] = [{} for _ in SHARES]
    for name, shifts in array.shifts.items():
        around = [medians, medians]
        # Without a median at the center none is dispersed: the runs would be in vain.
        if not np.isnan(medians).all():
            shifted = [_shifted(plan, array, runner, shift) for shift in shifts]
            searches += shifted
            around = [_medians(states) for states in shifted]
        for effect, median, low, high in zip(effects, medians, *around, strict=True):
            effect[name] = first_order_beta(median, (low, high))
    return capacities, effects, sum(int(states[0].runs.sum()) for states in searches)


def maximum_runs(plan: StudyPlan, array: ArrayPlan) -> int:
    """Return the maximum number of runs for the capacities of an array."""
    levels = np.array(plan.input.intensities)
    searched = maximum_searches(SHARES, levels)
    # One standard deviation below and above, and the highest intensity alone, as `_shifted` runs
    # them.
    searched += 2 * len(array.shifts) * maximum_searches(SHARES, levels[-1:], COARSE_SCAN)
    return searched * len(plan.campaign.columns)


def curves_of(runner: Runner, array: ArrayPlan, mu: float, slope_deg: float) -> list[Curve]:
    """Return the PRD of each motion over intensity, on the building of an array."""
    columns, tracks = runner.campaign.columns, runner.tracks[array.building]
    return [
        Curve(
            tracks=[t for (motion, _), t in zip(columns, tracks, strict=True) if motion == number],
            slope_rad=math.radians(slope_deg),
            mu=mu,
        )
        for number in range(len(runner.campaign.motions[0]))
    ]


def _searched(
    plan: StudyPlan, array: ArrayPlan, curves: Sequence[Curve], levels: Floats, **search: Any
) -> tuple[Capacities, ...]:
    """Return the capacities of curves for each of `SHARES`."""
    return capacities(
        curves,
        [share * array.array.clearance_m for share in SHARES],
        levels,
        is_censoring=plan.input.study.no_value is NoValue.CENSORED,
        **search,
    )


def _shifted(
    plan: StudyPlan, array: ArrayPlan, runner: Runner, shift: Shift
) -> tuple[Capacities, ...]:
    """Return the capacities at another friction or slope."""
    # A block that yields later than at the center is searched that much farther: otherwise fewer
    # motions would reach a limit.
    later = _yield(*shift) / _yield(array.mu, array.array.slope_deg)
    top = np.array([max(1.0, later) * plan.input.intensities[-1]])
    curves = curves_of(runner, array, *shift)
    return _searched(plan, array, curves, top, steps=COARSE_SCAN, to_end=False)


def _medians(states: Sequence[Capacities]) -> list[float]:
    return [fit_lognormal(capacities).theta for capacities in states]


def _yield(mu: float, slope_deg: float) -> float:
    """Return the acceleration / g at which a block begins to slide down a slope [deg]."""
    # a_y / g = tan(phi - theta), phi = arctan mu: as `a_down` of the package.
    return math.tan(math.atan(mu) - math.radians(slope_deg))


# About 14 of the frequencies at which spectra are compared with a target [Hz].
FREQ_HZ = POINTS_HZ[:: len(POINTS_HZ) // 13]


@dataclass(frozen=True, slots=True, kw_only=True)
class SpectralSpread:
    """Standard deviation of ln Sa between the motions, over frequencies, components and buildings.

    NaN for a single motion, or one with a component of zeros.
    """

    median: float
    largest: float

    @property
    def is_known(self) -> bool:
        """Whether there is any."""
        return not math.isnan(self.largest)

    @property
    def is_one_spectrum(self) -> bool:
        """Whether the motions differ by less than motions matched to one spectrum may."""
        # Motions matched to one spectrum may be 10 % below it: a spread within that is no scatter
        # of records.
        return self.median < 1.0 - LEAST_RATIO


def spectral_spread(buildings: Sequence[Sequence[Motion]]) -> SpectralSpread:
    """Return the spread of the motions at the roof of each building, as they are scaled."""
    deviations = np.concatenate([_deviations(motions) for motions in buildings])
    if not np.isfinite(deviations).all():
        return SpectralSpread(median=math.nan, largest=math.nan)
    return SpectralSpread(median=float(np.median(deviations)), largest=float(deviations.max()))


def _deviations(motions: Sequence[Motion]) -> Floats:
    """Return the standard deviation of ln Sa at each frequency of each component."""
    if len(motions) < 2:
        return np.array([math.nan])
    spectra_of_motions = []
    for motion in motions:
        of_components = []
        for a_mps2 in motion.components.values():
            spectrum = response_spectrum(a_mps2, motion.dt_s, 1.0 / FREQ_HZ)
            of_components.append(motion.scaled(spectrum))
        spectra_of_motions.append(of_components)
    spectra = np.array(spectra_of_motions)
    # A component of zeros has no logarithm: the spread is then not known. By n - 1 (ddof), since
    # the motions are a sample.
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.asarray(np.log(spectra).std(axis=0, ddof=1).ravel())
