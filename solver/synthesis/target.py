"""Target spectra, and how closely a motion matches one.

Knows no code rules: targets are given as corner points, linear on log-log axes and constant beyond.
Read `solver.synthesis.suite` next.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from solver.model import Floats
from solver.records.record import UNITS, Record
from solver.records.spectrum import response_spectrum
from solver.rules.spectra import Target, target_sa_g

DAMPING = 0.05
BAND_HZ = (0.3, 33.3)
"""Band over which a target must be given."""

LONGEST_HZ = 0.1
"""Lowest frequency of the comparison with a target that is given to there."""

GRIDS = 100
"""Grids of 1/6 octave, shifted against each other, on all of which a component is accepted."""

_KNEE_HZ = 1.3

LEAST, GREATEST, MEAN_OFF = 1.00, 1.30, 0.07
"""Accepted ratios to the target on `shifted_grids` over the matched band: smallest, largest, and
largest difference of the mean from 1.
"""


@dataclass(frozen=True, slots=True, kw_only=True)
class SpectrumFit:
    """How closely a motion matches its target.

    Attributes
    ----------
    freq_hz, target_g, achieved_g : array, shape (m,)
        Frequencies [Hz], target and pseudo-spectral acceleration of the motion [g].
    """

    freq_hz: Floats
    target_g: Floats
    achieved_g: Floats

    @property
    def ratio(self) -> Floats:
        """Achieved over target."""
        return self.achieved_g / self.target_g

    @property
    def minimum(self) -> float:
        """Smallest ratio."""
        return float(self.ratio.min())

    @property
    def maximum(self) -> float:
        """Largest ratio."""
        return float(self.ratio.max())

    @property
    def mean(self) -> float:
        """Mean ratio, with equal weight for every frequency."""
        return float(self.ratio.mean())


def lowest_hz(target: Target) -> float:
    """Lowest frequency [Hz] of the comparison with a target: 0.1 Hz, or where it begins."""
    return max(min(float(target[0][0]), BAND_HZ[0]), LONGEST_HZ)


def band(per_octave: int, low_hz: float) -> Floats:
    """Frequencies [Hz] from the lowest to 33.3 Hz, `per_octave` to an octave, with both ends."""
    high_hz = BAND_HZ[1]
    steps = np.arange(math.floor(per_octave * math.log2(high_hz / low_hz)) + 1)
    return np.append(low_hz * 2.0 ** (steps / per_octave), high_hz)


def shifted_grids(low_hz: float) -> Floats:
    """Frequencies [Hz] of `GRIDS` grids of 1/6 octave, one through 1.3 Hz, up to 33.3 Hz.

    A laboratory may lay its points of 1/6 octave anywhere.
    """
    first, last = (6 * GRIDS * math.log2(hz / _KNEE_HZ) for hz in (low_hz, BAND_HZ[1]))
    return _KNEE_HZ * 2.0 ** (np.arange(math.ceil(first), math.floor(last) + 1) / (6 * GRIDS))


def spectrum_fit(record: Record, target: Target, freq_hz: Floats | None = None) -> SpectrumFit:
    """Compare a record with its target, by default at 1/12 octave from `lowest_hz` to 33.3 Hz."""
    freq_hz = band(12, lowest_hz(target)) if freq_hz is None else freq_hz
    achieved = response_spectrum(record.a_mps2, record.dt_s, 1.0 / freq_hz, DAMPING) / UNITS["g"]
    return SpectrumFit(freq_hz=freq_hz, target_g=target_sa_g(target, freq_hz), achieved_g=achieved)


def keeps(fit: SpectrumFit) -> bool:
    """Whether a fit is within `LEAST`, `GREATEST` and `MEAN_OFF`."""
    return fit.minimum >= LEAST and fit.maximum <= GREATEST and abs(fit.mean - 1.0) <= MEAN_OFF


def target_problems(target: Target) -> list[str]:
    """Return the errors of a target."""
    freq_hz, sa_g = (np.asarray(column, dtype=np.float64) for column in target)
    problems = []
    if freq_hz.ndim != 1 or freq_hz.shape != sa_g.shape or len(freq_hz) < 2:
        problems.append("target spectrum: give as many accelerations as frequencies, at least 2")
    elif not (freq_hz[0] > 0.0 and np.all(np.diff(freq_hz) > 0.0) and np.isfinite(freq_hz[-1])):
        problems.append("target spectrum: give increasing frequencies above 0 [Hz]")
    if not np.all((sa_g > 0.0) & np.isfinite(sa_g)):
        problems.append("target spectrum: give accelerations above 0 [g]")
    return problems
