"""Elastic buildings of a few modes: period, damping and roof factor of each mode.

Contains no motions (`solver.building.roof`) and no mode shapes (`solver.building.beam`).
Read `building_of_periods` first.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from solver.building.beam import beam_modes, story_modes
from solver.model import Floats, InputError
from solver.records.record import read_only

BEAM_MODES = 40
"""Number of modes of a continuous beam; the roof factors of higher modes are below 0.04."""

LEAST_DAMPING, MOST_DAMPING = 0.01, 0.5
MOST_PERIOD_S = 10.0


@dataclass(frozen=True, slots=True, kw_only=True)
class Building:
    """An elastic building, as needed for the motion of its roof; arrays are read-only.

    Attributes
    ----------
    periods_s, damping : array, shape (n,)
        Period [s] and fraction of critical damping of each mode, the longest period first.
    roof_factors : array, shape (n,)
        Participation factor times mode shape at the roof, Gamma phi, of each mode.
    words : str
        Description for the reader.
    """

    periods_s: Floats
    damping: Floats
    roof_factors: Floats
    words: str

    def __repr__(self) -> str:
        return f"Building: {self.words}"


def building_of_periods(
    periods_s: Sequence[float],
    *,
    damping: Sequence[float] = (0.05,),
    alpha0: float = math.inf,
    stories: int = 0,
) -> Building:
    """Return a uniform building whose first modes have the given periods.

    The roof factors, and the ratios of the periods of higher modes to the last one given, are those
    of a beam in shear and bending (Miranda and Taghavi, J. Struct. Eng. 131 (2005) 203-211;
    `solver.building.beam`). With few stories the lumped floor masses matter: one story has a roof
    factor of 1, whereas the first mode of a continuous beam has up to 1.57.

    Parameters
    ----------
    periods_s : sequence of float
        Periods of the first mode or modes [s], the longest first.
    damping : sequence of float
        Fraction of critical damping of the first modes; the last value applies to all others.
    alpha0 : float
        Lateral stiffness ratio, see `solver.building.beam.beam_modes`; infinity: shear building.
    stories : int
        Number of equal stories with equal floor masses; 0 for a continuous beam.

    Returns
    -------
    Building

    Raises
    ------
    InputError
        For a value out of range.

    Examples
    --------
    >>> building_of_periods([0.5, 0.16], damping=[0.03, 0.05], stories=4)
    Building: 4 equal stories, in shear; period 0.5, 0.16 s; damping 3, 5 % of critical
    """
    _check_periods(periods_s, damping)
    modes = story_modes(alpha0, stories) if stories else beam_modes(alpha0, BEAM_MODES)
    ratios = modes.period_ratios
    given = np.array(periods_s[: ratios.size], dtype=np.float64)
    periods = np.append(given, given[-1] * ratios[given.size :] / ratios[given.size - 1])
    zeta = np.full(periods.size, float(damping[-1]))
    first = np.array(damping[: periods.size], dtype=np.float64)
    zeta[: first.size] = first
    return Building(
        periods_s=read_only(periods),
        damping=read_only(zeta),
        roof_factors=read_only(modes.factors[:, 0]),
        words=_words(given, damping, alpha0, stories),
    )


def building_of_modes(
    periods_s: Sequence[float], damping: Sequence[float], roof_factors: Sequence[float]
) -> Building:
    """Return a building from modes given by the user's own analysis.

    Parameters
    ----------
    periods_s, damping, roof_factors : sequence of float, of equal length
        As in `Building`; Gamma phi at the roof in the direction of the motion.

    Raises
    ------
    InputError
    """
    _check_periods(periods_s, damping)
    counts = {len(periods_s), len(damping), len(roof_factors)}
    if len(counts) > 1 or not np.isfinite(roof_factors).all():
        raise InputError("modes: give a period, a damping and a roof factor for each")
    total = sum(roof_factors)
    return Building(
        periods_s=read_only(np.array(periods_s)),
        damping=read_only(np.array(damping)),
        roof_factors=read_only(np.array(roof_factors)),
        words=f"{len(periods_s)} modes as given, sum of roof factors {total:.3f}",
    )


def _words(given: Floats, damping: Sequence[float], alpha0: float, stories: int) -> str:
    """Describe a uniform building."""
    periods = ", ".join(f"{period:.3g}" for period in given)
    ratios = ", ".join(f"{100.0 * value:.3g}" for value in damping)
    if stories == 1:
        kind = "one story"
    else:
        kind = "uniform" if stories == 0 else f"{stories} equal stories"
        kind += ", in shear" if math.isinf(alpha0) else ""
        kind += ", in bending" if alpha0 == 0.0 else ""
        if 0.0 < alpha0 < math.inf:
            kind += f", in shear and bending with a lateral stiffness ratio of {alpha0:.3g}"
    return f"{kind}; period {periods} s; damping {ratios} % of critical"


def _check_periods(periods_s: Sequence[float], damping: Sequence[float]) -> None:
    problems = []
    if not len(periods_s) or not len(damping):
        problems.append("building: give at least one period and one damping")
    for period in periods_s:
        if not 0.0 < period <= MOST_PERIOD_S:
            problems.append(f"period: found {period} s; give above 0 to {MOST_PERIOD_S:g} s")
    if any(after > before for before, after in pairwise(periods_s)):
        problems.append("periods: give the longest first")
    for value in damping:
        if not LEAST_DAMPING <= value <= MOST_DAMPING:
            problems.append(
                f"damping: found {value}; give a fraction of critical from {LEAST_DAMPING:g} to "
                f"{MOST_DAMPING:g}"
            )
    if problems:
        raise InputError(problems)
