"""Response spectra of the motions as run, their target, and deviations of the mean from it.

A mean of 0.98 of the target at 2 s falls short of it; one of 1.40 times the target exceeds it.

Draws nothing and prints nothing: `report.figures` and `report.pages.motions` do.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from report.assessment.assessment import Assessment
from report.motions.history import TargetSpectrum
from report.project.model.choices import RecordedAt
from report.text.grouping import grouped_by
from report.text.units import G_MPS2
from solver.model import Floats, Motion
from solver.records.acceptance import POINTS_HZ, spectrum_mps2
from solver.records.record import Record
from solver.records.spectrum import response_spectrum

# 0.77 s is the corner of AC156, 1.3 Hz.
PRINTED_S = (0.03, 0.1, 0.2, 0.5, 0.77, 1.0, 2.0, 5.0, 10.0)
# The points of the limits on spectra, so that a page says one thing of them; and printed periods.
PERIODS_S: Floats = np.unique(np.concatenate([1.0 / POINTS_HZ, PRINTED_S[1:]]))
# Spectra at these are there already, from the limits on motions.
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
        # `argmin` would return the first NaN, of a period where the target is not given.
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


# Mean of the motions / target above which the motions are said to exceed it: in no code.
MOST_EXCESS = 1.30

# Mean of the motions / target below which the motions fall short: 1.00 to the digits printed.
LEAST_MEAN = 0.995


@dataclass(frozen=True, slots=True, kw_only=True)
class Departure:
    """The mean of the motions where it is below its target, or far above it."""

    titles: tuple[str, ...]  # components that depart, the farthest first
    target: str
    ratio: float  # mean / target farthest from 1 in any component
    period_s: float  # at which it is [s]
    from_s: float  # shortest period at which any component is beyond the limit [s]
    to_s: float  # longest one [s]
    is_short: bool  # whether the motions fall short of the target
    maximum_excess: ClassVar[float] = MOST_EXCESS


def departures(spectra: Sequence[Spectra]) -> tuple[Departure, ...]:
    """Return deviations of the mean of the motions from its target, 0.1 to 33.3 Hz, by target."""
    targets = grouped_by(spectra, lambda part: (part.is_ground, part.target.name))
    missed = []
    for parts in targets.values():
        missed += [_departure(parts, is_short=True), _departure(parts, is_short=False)]
    return tuple(departure for departure in missed if departure is not None)


def _departure(parts: Sequence[Spectra], *, is_short: bool) -> Departure | None:
    beyond = []
    for part in parts:
        ratio = part.mean_g / part.target_g  # NaN without a target: beyond no limit
        is_beyond = ratio < LEAST_MEAN if is_short else ratio > MOST_EXCESS
        if is_beyond.any():
            beyond.append((part, np.where(is_beyond, ratio, np.nan)))
    if not beyond:
        return None
    farthest = np.nanmin if is_short else np.nanmax
    beyond.sort(key=lambda item: float(farthest(item[1])), reverse=not is_short)
    worst, ratio = beyond[0]
    index = int(np.flatnonzero(ratio == farthest(ratio))[0])
    periods = np.concatenate([part.periods_s[np.isfinite(ratio)] for part, ratio in beyond])
    return Departure(
        titles=tuple(part.title for part, _ in beyond),
        target=worst.target.name,
        ratio=float(ratio[index]),
        period_s=float(worst.periods_s[index]),
        from_s=float(periods.min()),
        to_s=float(periods.max()),
        is_short=is_short,
    )
