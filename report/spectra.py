"""Response spectra of the motions as run, with the target that they are held against.

Draws nothing and prints nothing: `report.figures` and `report.pages.motions` do.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from report.assess import Assessment
from report.units import G_MPS2
from solver.model import Floats, Motion
from solver.motion import response_spectrum
from solver.provisions import RequiredSpectrum

PRINTED_S = (0.03, 0.1, 0.2, 0.5, 0.77, 1.0, 2.0, 5.0, 10.0)
BAND_HZ = 0.3 * 2.0 ** (np.arange(82) / 12.0)  # 1/12 octaves to 32.3 Hz
# From the last corner of AC156 to its first: the band, beyond it coarser, and what is printed.
PERIODS_S: Floats = np.unique(
    np.concatenate([1.0 / BAND_HZ, np.geomspace(3.6, 9.3, 10), [1 / 33.3], PRINTED_S[1:]])
)


@dataclass(frozen=True, slots=True, kw_only=True)
class Spectra:
    """Response spectra of one component [g] of all motions, over periods [s].

    Attributes
    ----------
    periods_s : array, shape (m,)
    sa_g : array, shape (n, m)
    """

    ids: tuple[str, ...]
    periods_s: Floats
    sa_g: Floats
    target: RequiredSpectrum
    title: str

    @property
    def mean_g(self) -> Floats:
        """Mean over the motions."""
        return np.asarray(self.sa_g.mean(axis=0))

    @property
    def target_g(self) -> Floats:
        """Ordinates of the target at the periods."""
        return self.target.at(1.0 / self.periods_s)

    @property
    def in_band(self) -> NDArray[np.bool_]:
        """Whether a period lies in the band that a matched motion keeps to."""
        return np.isin(self.periods_s, 1.0 / BAND_HZ)


def spectra(assessment: Assessment, motions: Sequence[Motion]) -> tuple[Spectra, ...]:
    """Return the spectra of each component that any motion has."""
    across, upward = assessment.horizontal_target, assessment.vertical_target
    parts = (
        ("Horizontal", across, [(motion, motion.ax_mps2) for motion in motions]),
        ("Transverse", across, [(m, m.ay_mps2) for m in motions if m.has_transverse]),
        ("Vertical", upward, [(m, m.az_mps2) for m in motions if m.has_vertical]),
    )
    return tuple(_spectra(title, target, rows) for title, target, rows in parts if rows)


def _spectra(
    title: str, target: RequiredSpectrum, rows: Sequence[tuple[Motion, Floats]]
) -> Spectra:
    found = [
        response_spectrum(a_mps2 * motion.scale, motion.dt_s, PERIODS_S) for motion, a_mps2 in rows
    ]
    return Spectra(
        ids=tuple(motion.id for motion, _ in rows),
        periods_s=PERIODS_S,
        sa_g=np.array(found) / G_MPS2,
        target=target,
        title=title,
    )
