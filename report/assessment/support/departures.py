"""Where the mean of the motions misses its target."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from report.assessment.support.spectra import Spectra
from report.text.grouping import grouped_by

# Mean of the motions / target above which the motions are said to exceed it: in no code.
MOST_EXCESS = 1.30

# Mean of the motions / target below which the motions fall short: 1.00 to the digits printed.
LEAST_MEAN = 0.995


@dataclass(frozen=True, slots=True, kw_only=True)
class Departure:
    """The mean of the motions below its target, or far above it."""

    titles: tuple[str, ...]  # components that depart, the farthest first
    target: str
    ratio: float  # mean / target farthest from 1 in any component
    period_s: float  # at which it is [s]
    from_s: float  # shortest period at which any component is beyond the limit [s]
    to_s: float  # longest one [s]
    is_short: bool  # whether the motions fall short of the target
    maximum_excess: ClassVar[float] = MOST_EXCESS


def departures(spectra: Sequence[Spectra]) -> tuple[Departure, ...]:
    """Return where the mean of the motions misses its target, from 0.1 to 33.3 Hz, by target."""
    targets = grouped_by(spectra, lambda part: (part.is_ground, part.target.name))
    found = []
    for parts in targets.values():
        found += [_departure(parts, is_short=True), _departure(parts, is_short=False)]
    return tuple(departure for departure in found if departure is not None)


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
    beyond.sort(key=lambda found: float(farthest(found[1])), reverse=not is_short)
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
