"""Response spectra of the motions as run, with their target.

Draws nothing and prints nothing: `report.figures` and `report.pages.motions` do.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from report.assessment.assessment import Assessment
from report.motions.history import TargetSpectrum
from report.project.model.choices import RecordedAt
from report.text.units import G_MPS2
from solver.model import Floats, Motion
from solver.records.acceptance import POINTS_HZ, spectrum_mps2
from solver.records.record import Record
from solver.records.spectrum import response_spectrum

PRINTED_S = (0.03, 0.1, 0.2, 0.5, 0.77, 1.0, 2.0, 5.0, 10.0)
# The points of the limits on spectra, so that a page says one thing of them; and printed periods.
PERIODS_S: Floats = np.unique(np.concatenate([1.0 / POINTS_HZ, PRINTED_S[1:]]))
_IS_POINT = np.isin(PERIODS_S, 1.0 / POINTS_HZ)


@dataclass(frozen=True, slots=True, kw_only=True)
class Spectra:
    """Response spectra of one component [g] of all motions, over periods [s]."""

    ids: tuple[str, ...]
    periods_s: Floats  # shape (m,)
    sa_g: Floats  # shape (n, m)
    target: TargetSpectrum
    title: str
    is_ground: bool

    @property
    def mean_g(self) -> Floats:
        """Mean over the motions."""
        return np.asarray(self.sa_g.mean(axis=0))

    @property
    def target_g(self) -> Floats:
        """Ordinates of the target at the periods; NaN where not given."""
        return self.target.ordinates(self.periods_s)

    @property
    def lowest(self) -> tuple[float, str, float]:
        """Smallest ratio of a motion to the target, its id and period [s]; inf without a target."""
        ratio = self.sa_g / self.target_g
        ratio = np.where(np.isnan(ratio), np.inf, ratio)
        motion, index = np.unravel_index(ratio.argmin(), ratio.shape)
        return float(ratio[motion, index]), self.ids[motion], float(self.periods_s[index])


def spectra(assessment: Assessment) -> tuple[Spectra, ...]:
    """Return the spectra of each component that occurs: at the roof, then on the ground."""
    goals, motions = assessment.targets, assessment.shaking.motions
    ground = [
        prepared
        for prepared in assessment.shaking.prepared
        if prepared.recorded_at is RecordedAt.GROUND
    ]
    at_roof = (
        ("Horizontal", goals.roof, [_scaled(m, m.ax_mps2) for m in motions]),
        ("Transverse", goals.roof, [_scaled(m, m.ay_mps2) for m in motions if m.has_transverse]),
        ("Vertical", goals.vertical, [_scaled(m, m.az_mps2) for m in motions if m.has_vertical]),
    )
    below = (
        (f"Ground, {name}", goals.ground, [s.scaled[name] for s in ground if name in s.scaled])
        for name in ("horizontal", "transverse")
    )
    parts = [*((*part, False) for part in at_roof), *((*part, True) for part in below)]
    return tuple(
        Spectra(
            ids=tuple(record.name for record in records),
            periods_s=PERIODS_S,
            sa_g=np.array([_ordinates(record.a_mps2, record.dt_s) for record in records]) / G_MPS2,
            target=target,
            title=title,
            is_ground=is_ground,
        )
        for title, target, records, is_ground in parts
        if records
    )


def _scaled(motion: Motion, a_mps2: Floats) -> Record:
    return Record(name=motion.id, dt_s=motion.dt_s, a_mps2=motion.scaled(a_mps2))


def _ordinates(a_mps2: Floats, dt_s: float) -> Floats:
    ordinates = np.empty(PERIODS_S.size)
    # The limits have been checked at the same points, of the record before it is scaled.
    ordinates[_IS_POINT] = spectrum_mps2(a_mps2.tobytes(), dt_s)[::-1]
    ordinates[~_IS_POINT] = response_spectrum(a_mps2, dt_s, PERIODS_S[~_IS_POINT])
    return ordinates
