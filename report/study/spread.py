"""How much the spectra of the motions of a study differ from record to record."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from solver.model import Floats, Motion
from solver.records.spectrum import response_spectrum
from solver.records.spectrum_acceptance import LEAST_RATIO, POINTS_HZ

FREQ_HZ = POINTS_HZ[:: len(POINTS_HZ) // 13]
"""About 14 of the frequencies at which spectra are compared with a target [Hz]."""


@dataclass(frozen=True, slots=True, kw_only=True)
class SpectralSpread:
    """Standard deviation of ln Sa between the motions, over frequencies, components and buildings.

    Attributes
    ----------
    median, largest : float
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
        return self.median < 1.0 - LEAST_RATIO

    @property
    def is_record_to_record(self) -> bool:
        """Whether the motions are known to differ by more than those matched to one spectrum."""
        return self.is_known and not self.is_one_spectrum


def spectral_spread(buildings: Sequence[Sequence[Motion]]) -> SpectralSpread:
    """Return the spread of the motions at the roof of each building, as they are scaled."""
    found = np.concatenate([_deviations(motions) for motions in buildings])
    if not np.isfinite(found).all():
        return SpectralSpread(median=math.nan, largest=math.nan)
    return SpectralSpread(median=float(np.median(found)), largest=float(found.max()))


def _deviations(motions: Sequence[Motion]) -> Floats:
    """Return the standard deviation of ln Sa at each frequency of each component."""
    if len(motions) < 2:
        return np.array([math.nan])
    spectra = np.array(
        [
            [motion.scaled(response_spectrum(a, motion.dt_s, 1.0 / FREQ_HZ)) for a in parts]
            for motion in motions
            for parts in [motion.components.values()]
        ]
    )
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.asarray(np.log(spectra).std(axis=0, ddof=1).ravel())
