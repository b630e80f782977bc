"""From ground to roof: the roof motion of an elastic building of a few modes.

A rigid building moves its roof as its ground; a soft one swings at its own period.

Computes the roof motion; `solver.building.structure` defines the building. Slides no blocks.
Read `to_roof` first, then `shaking_to_roof` for all components of a motion.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from solver.building.structure import Building
from solver.errors import raise_any
from solver.model import Floats, Motion
from solver.records.record import read_only
from solver.records.spectrum import refined

# All neglected modes together may change the roof acceleration by this fraction of its peak.
SHARE = 0.05

# A roof motion ends when its free vibration stays below this fraction of its peak.
RESTING_SHARE = 0.01

# Samples per period of the highest mode included (linear interpolation between them misses up to
# 1.2 % of its peaks), and the maximum number of steps per interval of the ground record.
FINENESS, MOST_STEPS = 20, 16


@dataclass(frozen=True, slots=True, kw_only=True)
class RoofMotion:
    """The absolute acceleration of a roof, and the modes included."""

    dt_s: float
    a_mps2: Floats  # absolute, read-only, shape (n,); longer than the ground record by `pad_s`
    pad_s: float  # duration of free vibration after the end of the ground record
    n_modes: int  # included, those of longest period
    shares: Floats  # largest contribution of each mode / peak of the roof with all modes
    left_out_share: float  # largest contribution of all neglected modes together / that peak
    ground_peak_mps2: float
    roof_peak_mps2: float
    building: Building

    @property
    def next_share(self) -> float:
        """Value of `shares` for the first neglected mode; 0 if none is neglected."""
        return float(self.shares[self.n_modes]) if self.n_modes < self.shares.size else 0.0


@dataclass(frozen=True, slots=True, kw_only=True)
class RoofShaking:
    """All components of a roof's motion, with one step and one length."""

    dt_s: float
    horizontal: tuple[RoofMotion, ...]
    vertical_mps2: Floats  # equal to that of the ground, read-only; shape (0,) for none


def to_roof(
    ground_mps2: ArrayLike, dt_s: float, building: Building, *, share: float = SHARE
) -> RoofMotion:
    """Return the motion of a building's roof under a ground motion, from rest.

        a_roof = a_ground + sum Gamma_i phi_i (A_i - a_ground)

    A_i is the absolute acceleration of an oscillator with the period and damping of mode i, exact
    at the samples for the linearly interpolated record (Nigam and Jennings, Bull. Seism. Soc. Am.
    59 (1969) 909-922). The number of modes is the smallest for which all others together stay below
    `share` of the roof's peak at all times. The neglected modes are treated as rigid: they follow
    the ground, with a weight of 1 - sum Gamma_i phi_i.

    Assumptions: the mass of the arrays is neglected, so their sliding does not affect the building.
    Each direction is independent: no torsion, no yielding, no soil-structure interaction, and a
    rigid roof diaphragm. The vertical motion of the roof equals that of the ground, see
    `shaking_to_roof`.

    The motion continues after the end of the ground record until the free vibration stays below
    `RESTING_SHARE` of the peak, because a block may still slide. The step is refined if the highest
    mode needs it, see `FINENESS`. A share of 0 includes every mode.
    """
    ground = _checked(ground_mps2, dt_s, share)
    cut = _cut(ground, dt_s, building, share)
    return _carried(ground, dt_s, building, cut, _steps(cut.n_modes, dt_s, building))


def roof_motion(
    ground_mps2: ArrayLike, dt_s: float, building: Building, *, share: float = SHARE
) -> Floats:
    """Return the roof's absolute acceleration [m/s2] at the ground's own samples; see `to_roof`."""
    motion = to_roof(ground_mps2, dt_s, building, share=share)
    return motion.a_mps2[:: round(dt_s / motion.dt_s)]


def shaking_to_roof(
    horizontal_mps2: Sequence[ArrayLike],
    vertical_mps2: ArrayLike,
    dt_s: float,
    buildings: Sequence[Building],
    *,
    share: float = SHARE,
) -> RoofShaking:
    """Return all components at the roof, with the smallest step and the greatest length of any.

    Each horizontal component has its own building. The vertical one, empty if there is none,
    changes only in step and length.
    """
    # Modes are chosen for each component by itself; step and length are then those of the neediest.
    grounds = [_checked(a, dt_s, share) for a in horizontal_mps2]
    pairs = list(zip(grounds, buildings, strict=True))
    cuts = [_cut(a, dt_s, building, share) for a, building in pairs]
    steps = max(
        (_steps(c.n_modes, dt_s, b) for c, b in zip(cuts, buildings, strict=True)), default=1
    )
    motions = [_carried(a, dt_s, b, c, steps) for (a, b), c in zip(pairs, cuts, strict=True)]
    vertical = np.asarray(vertical_mps2, dtype=np.float64)
    count = max([(vertical.size - 1) * steps + 1, *(motion.a_mps2.size for motion in motions)])
    if vertical.size:
        vertical = lengthened(vertical, math.ceil((count - 1) / steps) + 1)
        vertical = refined(vertical, steps)[:count]
    horizontal = []
    for motion in motions:
        pad_s = motion.pad_s + (count - motion.a_mps2.size) * motion.dt_s
        a = lengthened(motion.a_mps2, count)
        horizontal.append(replace(motion, a_mps2=a, pad_s=pad_s))
    return RoofShaking(
        dt_s=dt_s / steps, horizontal=tuple(horizontal), vertical_mps2=read_only(vertical)
    )


def at_roof(motion: Motion, building: Building, transverse: Building | None = None) -> Motion:
    """Return the motion of an elastic building's roof under a ground motion.

    The horizontal components are transferred through the modes of the building by exact oscillators
    (Nigam and Jennings, Bull. Seism. Soc. Am. 59 (1969) 909-922); the vertical one is unchanged.
    The free vibration after the ground motion is included, and the step is refined if a mode
    requires it.

    Parameters
    ----------
    motion : Motion
        At the ground.
    building : Building
        As `solver.building_of_periods` makes it, for the record along the slope.
    transverse : Building, optional
        For the transverse component; by default the same.

    Returns
    -------
    Motion
        With the same name and scale.

    Raises
    ------
    InputError
        If the motion has fewer than two samples or values that are not finite.

    Examples
    --------
    >>> from solver import building_of_periods, motion
    >>> ground = motion([0.0, 2.0, -2.0, 0.0], dt_s=0.02, id="pulse")
    >>> at_roof(ground, building_of_periods([0.3], stories=1))
    Motion: pulse, x, 442 samples of 0.01 s, scale 1
    """
    components = [motion.ax_mps2, motion.ay_mps2][: 1 + motion.has_transverse]
    buildings = [building, transverse or building][: len(components)]
    roof = shaking_to_roof(components, motion.az_mps2, motion.dt_s, buildings)
    x, *y = (record.a_mps2 for record in roof.horizontal)
    return replace(
        motion,
        source=f"{motion.source} at the roof of: {building.words}".strip(),
        dt_s=roof.dt_s,
        ax_mps2=x,
        ay_mps2=y[0] if y else motion.ay_mps2,
        az_mps2=roof.vertical_mps2,
    )


class _Cut(NamedTuple):
    """The modes included, and fractions as in `RoofMotion`."""

    n_modes: int
    shares: Floats
    left_out_share: float


def _cut(ground: Floats, dt_s: float, building: Building, share: float) -> _Cut:
    # Evaluated between samples as well, because the neglected modes have the shortest periods.
    steps = _steps(building.periods_s.size, dt_s, building)
    a = refined(lengthened(ground, ground.size + _free_samples(building, dt_s)), steps)
    parts = absolute_accelerations(a, dt_s / steps, building.periods_s, building.damping)
    # Gamma_i phi_i (A_i - a_ground)
    parts -= a[:, None]
    parts *= building.roof_factors
    # The peak with all modes, to which the neglected modes are compared.
    peak = float(np.abs(a + parts.sum(axis=1)).max())
    larger = np.maximum(parts.max(axis=0), -parts.min(axis=0))
    # Column n is the sum of all modes from n on. No column after the modes included is over the
    # limit.
    remaining = np.cumsum(parts[:, ::-1], axis=1, out=parts[:, ::-1])[:, ::-1]
    left_out = np.append(np.maximum(remaining.max(axis=0), -remaining.min(axis=0)), 0.0)
    over = np.flatnonzero(left_out > share * peak)
    n_modes = int(over[-1]) + 1 if over.size else 0
    # A record of zeros has no peak, and its shares are zero.
    per = 1.0 / peak if peak > 0.0 else 0.0
    return _Cut(n_modes, read_only(larger * per), float(left_out[n_modes]) * per)


def _carried(ground: Floats, dt_s: float, building: Building, cut: _Cut, steps: int) -> RoofMotion:
    """Return the roof motion with `steps` steps per interval of the ground record."""
    dt, taken, n = dt_s / steps, slice(cut.n_modes), (ground.size - 1) * steps + 1
    a = refined(lengthened(ground, ground.size + _free_samples(building, dt_s)), steps)
    factors = building.roof_factors[taken]
    modal = absolute_accelerations(a, dt, building.periods_s[taken], building.damping[taken])
    # a_ground (1 - sum Gamma phi) + sum Gamma phi A: what is left out moves with the ground.
    roof = a * (1.0 - factors.sum()) + modal @ factors
    top = float(np.abs(roof).max())
    (over,) = np.nonzero(np.abs(roof) > RESTING_SHARE * top)
    # One sample more, on which it is back within the share.
    end = min(max(n, int(over.max(initial=0)) + 2), roof.size)
    return RoofMotion(
        dt_s=dt,
        a_mps2=read_only(roof[:end]),
        pad_s=(end - n) * dt,
        n_modes=cut.n_modes,
        shares=cut.shares,
        left_out_share=cut.left_out_share,
        ground_peak_mps2=float(np.abs(ground).max()),
        roof_peak_mps2=top,
        building=building,
    )


def absolute_accelerations(
    a_mps2: ArrayLike, dt_s: float, periods_s: ArrayLike, damping: ArrayLike
) -> Floats:
    """Return absolute accelerations of oscillators, shape (n, m), one row per sample [m/s2]."""
    from solver.kernels import oscillator  # with the compiler, which a motion at the roof needs not

    a, zeta = read_only(a_mps2), read_only(damping)
    omega = read_only(2.0 * math.pi / np.asarray(periods_s, dtype=np.float64))
    accelerations = np.empty((a.size, omega.size))
    oscillator.histories(a, float(dt_s), omega, zeta, accelerations)
    return accelerations


def lengthened(a_mps2: ArrayLike, count: int) -> Floats:
    """Return a record extended with zeros to `count` samples, read-only."""
    a = np.asarray(a_mps2, dtype=np.float64)
    return read_only(np.append(a, np.zeros(max(count - a.size, 0))))


def _free_samples(building: Building, dt_s: float) -> int:
    """Samples in which the free vibration of every mode decays to `RESTING_SHARE`."""
    # exp(-zeta omega t) = RESTING_SHARE for the mode that decays slowest
    slowest = float((2.0 * math.pi * building.damping / building.periods_s).min())
    return math.ceil(-math.log(RESTING_SHARE) / slowest / dt_s)


def _steps(n_modes: int, dt_s: float, building: Building) -> int:
    """Steps per interval that the highest of the first `n_modes` modes needs."""
    if n_modes == 0:
        return 1
    fastest = float(building.periods_s[n_modes - 1])
    # Less a rounding, so that a period of 20 samples exactly needs no further step.
    return min(max(math.ceil(FINENESS * dt_s / fastest - 1e-9), 1), MOST_STEPS)


def _checked(ground_mps2: ArrayLike, dt_s: float, share: float) -> Floats:
    ground = np.asarray(ground_mps2, dtype=np.float64)
    problems = []
    if ground.ndim != 1 or ground.size < 2 or not np.isfinite(ground).all():
        problems.append("ground motion: use one column of two or more finite numbers")
    if not (math.isfinite(dt_s) and dt_s > 0.0):
        problems.append(f"time step dt is {dt_s!r}; use a number of seconds above 0")
    if not 0.0 <= share < 1.0:
        problems.append(f"limit on neglected modes is {share!r}; use 0 to below 1")
    raise_any(problems)
    return ground
