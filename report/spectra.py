"""Response spectra of the motions as run, with the target that they are held against.

Draws nothing and prints nothing: `report.figures` and `report.pages.motions` do.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from report.assess import Assessment
from report.units import G_MPS2
from solver.model import Floats, Motion
from solver.motion import response_spectrum
from solver.provisions import RequiredSpectrum

PRINTED_S = (0.03, 0.1, 0.2, 0.5, 0.77, 1.0, 2.0, 5.0, 10.0)
# From the last corner of AC156 to its first, the printed ones among them.
PERIODS_S: Floats = np.unique(np.concatenate([np.geomspace(1 / 33.3, 10.0, 48), PRINTED_S[1:]]))


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


def spectra(assessment: Assessment, motions: Sequence[Motion]) -> tuple[Spectra, ...]:
    """Return the spectra of both components; those without a vertical one are left out there."""
    upright = [motion for motion in motions if motion.has_vertical]
    across = _spectra(motions, "Horizontal", assessment.horizontal_target)
    return (
        (across, _spectra(upright, "Vertical", assessment.vertical_target))
        if upright
        else (across,)
    )


def _spectra(motions: Sequence[Motion], name: str, target: RequiredSpectrum) -> Spectra:
    rows = [
        response_spectrum(
            (motion.az_mps2 if name == "Vertical" else motion.ax_mps2) * motion.scale,
            motion.dt_s,
            PERIODS_S,
        )
        / G_MPS2
        for motion in motions
    ]
    return Spectra(
        ids=tuple(motion.id for motion in motions),
        periods_s=PERIODS_S,
        sa_g=np.array(rows),
        target=target,
        title=name,
    )
