"""The computed roof motion, compared with buildings whose ground and roof were recorded.

A beam with the period, damping and stiffness ratio that fit the recorded floors best carries the
recorded ground motion to the roof: the result is compared with the record there.

Reads the given records and fits a beam; draws nothing.
Read `recorded_buildings`, then `compare`; `building_checks` has the closed forms.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import lru_cache
from itertools import product
from pathlib import Path
from typing import NamedTuple

import numpy as np

from solver.building.roof import RoofMotion, absolute_accelerations, to_roof
from solver.building.structure import (
    MOST_ALPHA0,
    MOST_DAMPING,
    Building,
    Modes,
    beam_modes,
    building_of_modes,
    building_of_periods,
)
from solver.errors import InputError
from solver.formats import read_record
from solver.model import STANDARD_GRAVITY_MPS2, Floats
from solver.records.spectrum import response_spectrum
from solver.rules.hazard import FOOT_M, approximate_period_s
from solver.sliding.checked import slide
from solver.verification.evidence import RoofComparison, RoofPrediction
from solver.verification.study_cases import best_of, unexplained

# Modes of the beam; further modes do not change the floor motions noticeably.
MODES = 12

# The coarse grid; periods are 4 % apart, less than the width of a resonance peak.
DAMPINGS, ALPHAS = (0.02, 0.05, 0.12), (0.0, 2.0, 6.0, 15.0, 40.0)

_PERIOD_STEP, _LAST_STEP = 0.04, 1e-4

_Point = tuple[float, float, float]


class Identified(NamedTuple):
    """The uniform beam whose floor motions fit the recorded ones best.

    `unexplained` is the sum of squares of the difference over that of the recorded motions.
    """

    period_s: float
    damping: float
    alpha0: float
    unexplained: float

    def building(self) -> Building:
        """Return the beam."""
        return building_of_periods([self.period_s], damping=[self.damping], alpha0=self.alpha0)


def identify(
    ground_mps2: Floats,
    dt_s: float,
    heights: tuple[float, ...],
    floors_mps2: Floats,
    periods_s: tuple[float, float],
) -> Identified:
    """Return the beam with the least sum of squares: grid search, then shrinking steps.

    The ground, shape (n,), and the floors, (n, m), are recorded in one direction over the same
    time; the m heights are relative to that of the building, and the periods the ends of the grid.
    """

    def misfit(point: _Point) -> float:
        period_s, damping, alpha0 = _plain(point)
        modes = _beam(alpha0, heights)
        zeta = np.full(MODES, damping)
        responses = absolute_accelerations(ground_mps2, dt_s, period_s * modes.period_ratios, zeta)
        # The neglected modes move with the ground, as in `solver.building.roof`.
        rigid = 1.0 - modes.factors.sum(axis=0)
        return unexplained(responses @ modes.factors + ground_mps2[:, None] * rigid, floors_mps2)

    # Logarithms of all three: misfits depend on ratios; 1 + alpha0, which may be zero.
    steps = int(np.log(periods_s[1] / periods_s[0]) / _PERIOD_STEP) + 2
    grid = product(np.log(np.geomspace(*periods_s, steps)), np.log(DAMPINGS), np.log1p(ALPHAS))
    # The grid first: a descent alone ends in the nearest of several minima.
    smallest, best = _descend(misfit, *best_of(misfit, grid))
    return Identified(*_plain(best), smallest)


def _plain(point: _Point) -> _Point:
    """Return period, damping and ratio of a point of the search (logarithms), within bounds."""
    period, damping, alpha0 = np.exp(point)
    return (
        float(period),
        float(min(damping, MOST_DAMPING)),
        float(min(max(alpha0 - 1.0, 0.0), MOST_ALPHA0)),
    )


def _descend(
    misfit: Callable[[_Point], float], minimum: float, best: _Point
) -> tuple[float, _Point]:
    """Step to the best adjacent point on each axis; halve the steps if none is better."""
    # Half the grid spacing in the period; the grid is coarse in damping and stiffness ratio.
    reach = np.array([_PERIOD_STEP / 2.0, 0.4, 0.4])
    while reach[0] > _LAST_STEP:
        around: list[_Point] = []
        for move in np.diag(reach):
            around += (tuple(best + move), tuple(best - move))
        nearby, point = best_of(misfit, around)
        if nearby < minimum:
            minimum, best = nearby, point
        else:
            reach /= 2.0
    return minimum, best


# The grid uses the same few stiffness ratios at every period.
@lru_cache(maxsize=256)
def _beam(alpha0: float, heights: tuple[float, ...]) -> Modes:
    return beam_modes(alpha0, MODES, heights)


SPECTRUM_S = np.geomspace(0.05, 8.0, 89)
"""Periods of the compared spectra, twelve or more per octave [s]."""

BANDS_S = ((0.05, 0.2), (0.2, 0.5), (0.5, 1.0), (1.0, 2.0), (2.0, 4.0), (4.0, 8.0))

# Both signs of the slope are run; the recorded roof motion is scaled to this peak.
SLOPE_DEG, MUS, PPA_G = 2.0, (0.1, 0.2, 0.3, 0.4), 1.0

CODE_DAMPING = 0.05
# Middle of the usual stiffness ratios of moment frames, see `solver.building.structure`.
FRAME_ALPHA0 = 12.5

BY_HEIGHT = "approximate period from height, no measurement"
"""Name of the prediction that needs no measurement of the building."""

RIGID = building_of_modes([0.1], [0.05], [0.0])
"""A rigid building: its roof motion equals the ground motion."""


@dataclass(frozen=True, slots=True, kw_only=True)
class FloorRecords:
    """Motions of one building in one direction, over the same time; the last column is the roof."""

    title: str
    description: str
    is_recorded: bool  # in an earthquake; otherwise computed
    dt_s: float
    ground_mps2: Floats  # shape (n,)
    floors_mps2: Floats  # shape (n, m)
    floors: tuple[str, ...]  # their ordinal numbers
    heights: tuple[float, ...]  # relative to the height of the building
    code_period_s: float  # approximate period from type and height [s]; NaN for none
    search_s: tuple[float, float]  # search range of the first period [s]


def recorded_buildings(folder: Path) -> tuple[FloorRecords, ...]:
    """Return the buildings whose records are in a folder.

    The one known building is ``roof_575_market``: 575 Market Street, San Francisco, in the 1989
    Loma Prieta earthquake, from the U.S. Geological Survey, as text of time [s] and
    acceleration [g].

    Raises `InputError` if the folder has no known building, or a record is missing or cannot be
    read.
    """
    market = folder / "roof_575_market"
    if not market.is_dir():
        raise InputError(f"{folder}: no subfolder roof_575_market; use a folder that contains it")
    return (_market_street(market),)


def _market_street(folder: Path) -> FloorRecords:
    """Azimuth 135 of ground, 25th and 42nd floors; the ground instrument points to azimuth 315."""
    names = ("k_315", "i_135", "c_135")
    records = [
        read_record(folder / f"SF575Market_LomaPrieta_{name}.csv", units="g") for name in names
    ]
    # The three records have different lengths; a common start is assumed (see the description).
    n = min(record.a_mps2.size for record in records)
    ground, *floors = (record.a_mps2[:n] for record in records)
    code_period_s = approximate_period_s("steel moment frame", 573.0 * FOOT_M)
    return FloorRecords(
        title="575 Market Street, San Francisco, Loma Prieta 1989",
        description="The building is a steel frame of 1975 with an assumed height of 573 ft "
        "(175 m). Instruments of the U.S. Geological Survey recorded the ground floor and the "
        "25th and 42nd floors. Azimuth 135 is compared; it is the only horizontal direction "
        "recorded at the ground. The records start during the shaking and cover 0.1 to 25 Hz; a "
        "common start time is assumed. The 42nd floor represents the roof, and the 25th floor "
        "represents 25/42 of the height.",
        is_recorded=True,
        dt_s=records[0].dt_s,
        ground_mps2=-ground,
        floors_mps2=np.stack(floors, axis=1),
        floors=("25th", "42nd"),
        heights=(25.0 / 42.0, 1.0),
        code_period_s=code_period_s,
        search_s=(0.5 * code_period_s, 2.0 * code_period_s),
    )


def compare(records: FloorRecords) -> RoofComparison:
    """Predict the roof motion from the ground motion and compare it with the record."""
    ground, dt, roof = records.ground_mps2, records.dt_s, records.floors_mps2[:, -1]
    # One scale for all, by the recorded roof: a prediction with a lower peak is not raised to it.
    scale = PPA_G * STANDARD_GRAVITY_MPS2 / float(np.abs(roof).max())
    comparison = RoofComparison(
        title=records.title,
        description=records.description,
        is_recorded=records.is_recorded,
        dt_s=dt,
        roof_mps2=roof,
        periods_s=SPECTRUM_S,
        ground_sa_mps2=response_spectrum(ground, dt, SPECTRUM_S),
        roof_sa_mps2=response_spectrum(roof, dt, SPECTRUM_S),
        bands_s=BANDS_S,
        slope_deg=SLOPE_DEG,
        scale=scale,
        mus=np.array(MUS),
        prd_m=_slips(roof, dt, scale),
        predictions=(),
    )
    motions = [
        (name, properties, to_roof(ground, dt, properties.building()))
        for name, properties in _properties(records)
    ]
    unknown = Identified(math.nan, math.nan, math.nan, math.nan)
    alone = "ground motion applied at the roof, no building"
    motions.append((alone, unknown, to_roof(ground, dt, RIGID)))
    return replace(
        comparison, predictions=tuple(_predicted(comparison, *motion) for motion in motions)
    )


def _properties(records: FloorRecords) -> Iterator[tuple[str, Identified]]:
    """Properties fitted to all floors, to all but the roof, from height, and with code damping."""
    fits = []
    for count in range(len(records.floors), 0, -1):
        heights, floors = records.heights[:count], records.floors_mps2[:, :count]
        fits.append(identify(records.ground_mps2, records.dt_s, heights, floors, records.search_s))
        several = "s" if count > 1 else ""
        yield f"fitted to the {' and '.join(records.floors[:count])} floor{several}", fits[-1]
    if not math.isnan(records.code_period_s):
        yield BY_HEIGHT, Identified(records.code_period_s, CODE_DAMPING, FRAME_ALPHA0, math.nan)
        with_code_damping = fits[0]._replace(damping=CODE_DAMPING)
        yield f"first fit, but with {100 * CODE_DAMPING:g}% damping", with_code_damping


def _predicted(
    comparison: RoofComparison, name: str, properties: Identified, motion: RoofMotion
) -> RoofPrediction:
    # The computed motion outlasts the record; only the recorded duration can be compared.
    a = motion.a_mps2[:: round(comparison.dt_s / motion.dt_s)][: comparison.roof_mps2.size]
    sa = response_spectrum(a, comparison.dt_s, SPECTRUM_S)
    logs = np.log(sa / comparison.roof_sa_mps2)
    bands = [logs[(low <= SPECTRUM_S) & (high >= SPECTRUM_S)] for low, high in BANDS_S]
    return RoofPrediction(
        name=name,
        period_s=properties.period_s,
        damping=properties.damping,
        alpha0=properties.alpha0,
        n_modes=motion.n_modes,
        left_out_share=motion.left_out_share,
        unexplained=unexplained(a, comparison.roof_mps2),
        peak_mps2=float(np.abs(a).max()),
        sa_mps2=sa,
        band_ratios=np.exp([band.mean() for band in bands]),
        band_scatters=np.array([band.std() for band in bands]),
        a_mps2=a,
        prd_m=_slips(a, comparison.dt_s, comparison.scale),
    )


def _slips(a: Floats, dt_s: float, scale: float) -> Floats:
    """PRD for each friction coefficient, the larger of both signs of the slope."""
    slopes = (math.radians(SLOPE_DEG), -math.radians(SLOPE_DEG))
    return np.array(
        [
            max(slide(a, dt_s, slope_rad=slope, mu=mu, scale=scale).prd_m for slope in slopes)
            for mu in MUS
        ]
    )
