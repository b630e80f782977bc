"""Where the mean of the motions misses its target."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from report.assessment.support.spectra import Spectra

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
    places = dict.fromkeys((part.is_ground, part.target.name) for part in spectra)
    rows = (
        _departure([s for s in spectra if (s.is_ground, s.target.name) == place], is_short)
        for place in places
        for is_short in (True, False)
    )
    return tuple(each for each in rows if each is not None)


def _departure(parts: Sequence[Spectra], is_short: bool) -> Departure | None:
    ratios = [(part, part.mean_g / part.target_g) for part in parts]
    beyond = [
        (part, np.where(is_beyond, ratio, np.nan))
        for part, ratio in ratios  # NaN without a target: beyond no limit
        if (is_beyond := ratio < LEAST_MEAN if is_short else ratio > MOST_EXCESS).any()
    ]
    if not beyond:
        return None
    farthest = np.nanmin if is_short else np.nanmax
    beyond.sort(key=lambda each: float(farthest(each[1])), reverse=not is_short)
    worst, ratio = beyond[0]
    at = int(np.flatnonzero(ratio == farthest(ratio))[0])
    periods = np.concatenate([part.periods_s[np.isfinite(ratio)] for part, ratio in beyond])
    return Departure(
        titles=tuple(part.title for part, _ in beyond),
        target=worst.target.name,
        ratio=float(ratio[at]),
        period_s=float(worst.periods_s[at]),
        from_s=float(periods.min()),
        to_s=float(periods.max()),
        is_short=is_short,
    )
