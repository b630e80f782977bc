"""From ground to roof: an elastic building of a few modes between a ground motion and its roof.

Owns periods, damping and the roof's motion; shapes of modes are `solver.beam`'s. Slides nothing.
Read `to_roof` first, then `building_of_periods` for where a building comes from.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike

from solver import kernels
from solver.beam import MOST_STOREYS, Modes, beam_modes, check_alpha0, storey_modes
from solver.model import Floats, InputError

BEAM_MODES = 40
"""Modes of a building without storeys; beyond them each roof factor is under 0.04."""

SHARE = 0.05
"""All modes left out together may change the roof acceleration by this share of its peak."""

RESTING_SHARE = 0.01
"""A roof motion ends where its free vibration stays below this share of its peak."""

LEAST_DAMPING, MOST_DAMPING = 0.01, 0.5
MOST_PERIOD_S = 10.0


@dataclass(frozen=True, slots=True, kw_only=True)
class Building:
    """An elastic building, as far as its roof feels the ground; arrays are read-only.

    Attributes
    ----------
    periods_s, damping : array, shape (n,)
        Of each mode, the longest period first [s]; fraction of critical damping.
    roof_factors : array, shape (n,)
        Participation factor times shape at the roof, Gamma phi, of each.
    words : str
        How it was made, for a reader.
    """

    periods_s: Floats
    damping: Floats
    roof_factors: Floats
    words: str


@dataclass(frozen=True, slots=True, kw_only=True)
class RoofMotion:
    """The absolute acceleration of a roof, and what the model was cut to.

    Attributes
    ----------
    dt_s : float
    a_mps2 : array, shape (n,)
        [m/s2], read-only; longer than the ground's by `pad_s`.
    pad_s : float
        Time that the free vibration goes on after the ground's record [s].
    n_modes : int
        Modes in it, the slowest ones.
    shares : array, shape (m,)
        Largest contribution of each mode of the building, over the roof's peak with all of them.
    left_out_share : float
        Largest contribution of all modes that are left out, together, over that peak.
    ground_peak_mps2, roof_peak_mps2 : float
    building : Building
    """

    dt_s: float
    a_mps2: Floats
    pad_s: float
    n_modes: int
    shares: Floats
    left_out_share: float
    ground_peak_mps2: float
    roof_peak_mps2: float
    building: Building

    @property
    def next_share(self) -> float:
        """Share of the first mode that is left out; 0 where none is."""
        return float(self.shares[self.n_modes]) if self.n_modes < self.shares.size else 0.0


def to_roof(
    ground_mps2: ArrayLike, dt_s: float, building: Building, *, share: float = SHARE
) -> RoofMotion:
    """Return the motion of a building's roof under a ground motion, from rest.

        a_roof = a_ground + sum Gamma_i phi_i (A_i - a_ground)

    A_i being the absolute acceleration of an oscillator of the mode's period and damping, exact at
    the samples of the linearly interpolated record (Nigam and Jennings, Bull. Seism. Soc. Am. 59
    (1969) 909-922). As few modes are taken as bring all others together under `share` of the
    roof's peak at every instant; what is left out follows the ground as if it were rigid, a weight
    of 1 - sum Gamma_i phi_i.

    The mass of the arrays is neglected: what slides does not act back on the building. One
    direction at a time: no torsion, no yielding, no soil below, a roof that is stiff in its plane.
    The vertical motion is taken to pass unchanged from ground to roof, and is not a matter of this
    function; `lengthened` brings it to the same length.

    The motion goes on after the ground's until the free vibration stays below `RESTING_SHARE` of
    the peak, because a block may still slide then.

    Parameters
    ----------
    ground_mps2 : array_like, shape (n,)
        Horizontal acceleration of the ground [m/s2], n >= 2.
    dt_s : float
        Sampling interval [s], > 0.
    share : float
        In [0, 1); 0 takes every mode.

    Raises
    ------
    InputError
    """
    ground = np.asarray(ground_mps2, dtype=np.float64)
    _check_motion(ground, dt_s, share)
    a = lengthened(ground, ground.size + _free_samples(building, dt_s))
    parts = absolute_accelerations(a, dt_s, building.periods_s, building.damping)
    parts -= a[:, None]
    parts *= building.roof_factors
    peak = float(np.abs(a + parts.sum(axis=1)).max())
    # Column n: all modes from n on together. Few enough: no later column is over the limit.
    rest = np.cumsum(parts[:, ::-1], axis=1)[:, ::-1]
    left_out = np.append(np.abs(rest).max(axis=0), 0.0)
    over = np.flatnonzero(left_out > share * peak)
    n_modes = int(over[-1]) + 1 if over.size else 0
    roof = a + parts[:, :n_modes].sum(axis=1)
    top = float(np.abs(roof).max())
    end = max(ground.size, _last_over(roof, RESTING_SHARE * top) + 2)
    per = 1.0 / peak if peak > 0.0 else 0.0
    return RoofMotion(
        dt_s=dt_s,
        a_mps2=_read_only(roof[:end]),
        pad_s=(min(end, roof.size) - ground.size) * dt_s,
        n_modes=n_modes,
        shares=_read_only(np.abs(parts).max(axis=0) * per),
        left_out_share=float(left_out[n_modes]) * per,
        ground_peak_mps2=float(np.abs(ground).max()),
        roof_peak_mps2=top,
        building=building,
    )


def roof_motion(ground_mps2: ArrayLike, dt_s: float, building: Building) -> Floats:
    """Return the roof's absolute acceleration [m/s2] alone; see `to_roof`."""
    return to_roof(ground_mps2, dt_s, building).a_mps2


def absolute_accelerations(
    a_mps2: ArrayLike, dt_s: float, periods_s: ArrayLike, damping: ArrayLike
) -> Floats:
    """Return absolute accelerations of oscillators, shape (n, m): a row for each sample [m/s2]."""
    a, zeta = _read_only(a_mps2), _read_only(damping)
    omega = _read_only(2.0 * math.pi / np.asarray(periods_s, dtype=np.float64))
    found = np.empty((a.size, omega.size))
    kernels.oscillator_histories(a, float(dt_s), omega, zeta, found)
    return found


def lengthened(a_mps2: ArrayLike, count: int) -> Floats:
    """Return a record with zeros after it up to so many samples, read-only."""
    a = np.asarray(a_mps2, dtype=np.float64)
    return _read_only(np.append(a, np.zeros(max(count - a.size, 0))))


def building_of_periods(
    periods_s: Sequence[float],
    *,
    damping: Sequence[float] = (0.05,),
    alpha0: float = math.inf,
    storeys: int = 0,
) -> Building:
    """Return a uniform building whose first modes have the given periods.

    Roof factors, and the periods of higher modes over the last one given, are those of
    `solver.beam`. With few storeys the floors' masses matter: one storey has a roof factor of 1,
    where a beam without storeys has up to 1.57.

    Parameters
    ----------
    periods_s : sequence of float
        Of the first mode or modes [s], falling.
    damping : sequence of float
        Fraction of critical damping of the first modes; the last value holds for all others.
    alpha0 : float
        Lateral stiffness ratio, see `solver.beam.beam_modes`; infinite: shear building.
    storeys : int
        Equal storeys with equal floor masses; 0 for a beam.

    Raises
    ------
    InputError
    """
    _check_periods(periods_s, damping)
    modes = _modes(alpha0, storeys)
    ratios = modes.period_ratios
    given = np.array(periods_s[: ratios.size], dtype=np.float64)
    periods = np.append(given, given[-1] * ratios[given.size :] / ratios[given.size - 1])
    zeta = np.full(periods.size, float(damping[-1]))
    first = np.array(damping[: periods.size], dtype=np.float64)
    zeta[: first.size] = first
    return Building(
        periods_s=_read_only(periods),
        damping=_read_only(zeta),
        roof_factors=_read_only(modes.factors[:, 0]),
        words=_words(given, damping, alpha0, storeys),
    )


def building_of_modes(
    periods_s: Sequence[float], damping: Sequence[float], roof_factors: Sequence[float]
) -> Building:
    """Return a building from the modes of an analysis of it.

    Parameters
    ----------
    periods_s, damping, roof_factors : sequence of float, equally long
        As in `Building`; Gamma phi at the roof, in the direction of the motion.

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
        periods_s=_read_only(periods_s),
        damping=_read_only(damping),
        roof_factors=_read_only(roof_factors),
        words=f"{len(periods_s)} modes as given, roof factors adding up to {total:.3f}",
    )


def _modes(alpha0: float, storeys: int) -> Modes:
    check_alpha0(alpha0)
    if storeys == 0:
        return beam_modes(alpha0, BEAM_MODES)
    if not 1 <= storeys <= MOST_STOREYS:
        raise InputError(
            f"storeys: found {storeys}; give a whole number from 1 to {MOST_STOREYS}, 0 for a beam"
        )
    return storey_modes(alpha0, storeys)


def _words(given: Floats, damping: Sequence[float], alpha0: float, storeys: int) -> str:
    """Return how a uniform building was made."""
    periods = ", ".join(f"{period:.3g}" for period in given)
    ratios = ", ".join(f"{100.0 * value:.3g}" for value in damping)
    if storeys == 1:
        kind = "one storey"
    else:
        kind = "uniform" if storeys == 0 else f"{storeys} equal storeys"
        kind += ", in shear" if math.isinf(alpha0) else ""
        kind += ", in bending" if alpha0 == 0.0 else ""
        if 0.0 < alpha0 < math.inf:
            kind += f", in shear and bending with a lateral stiffness ratio of {alpha0:.3g}"
    return f"{kind}; period {periods} s; damping {ratios} % of critical"


def _free_samples(building: Building, dt_s: float) -> int:
    """Samples in which the free vibration of every mode falls to `RESTING_SHARE` of itself."""
    slowest = float((2.0 * math.pi * building.damping / building.periods_s).min())
    return math.ceil(-math.log(RESTING_SHARE) / slowest / dt_s)


def _last_over(a: Floats, limit: float) -> int:
    over = np.flatnonzero(np.abs(a) > limit)
    return int(over[-1]) if over.size else 0


def _read_only(values: ArrayLike) -> Floats:
    # numba compiles a second version for writable arrays, so kernels see read-only ones only.
    array = np.ascontiguousarray(values, dtype=np.float64).view()
    array.setflags(write=False)
    return array


def _check_motion(ground: Floats, dt_s: float, share: float) -> None:
    problems = []
    if ground.ndim != 1 or ground.size < 2 or not np.isfinite(ground).all():
        problems.append("ground motion: give one column of two or more finite numbers")
    if not (math.isfinite(dt_s) and dt_s > 0.0):
        problems.append(f"time step dt is {dt_s!r}; give a number of seconds above 0")
    if not 0.0 <= share < 1.0:
        problems.append(f"share of modes left out is {share!r}; give 0 to below 1")
    if problems:
        raise InputError(problems)


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
