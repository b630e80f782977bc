"""Spectra of the motions of an analysis against their target, as rows with limits.

Owns the frequencies at which spectra are compared. Knows no code spectrum (`solver.rules.spectra`).
Read `spectrum_ratios`, then `spectrum_rows`.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from solver.model import Floats, Motion
from solver.records.record import UNITS, read_only
from solver.records.spectrum import response_spectrum
from solver.rules.limit import MOTIONS, PROGRAM, Limit, Measure
from solver.rules.rulesets import Provision

COMPONENTS = ("x", "y", "z")
"""Names of the components of a motion: two horizontal ones and the vertical."""

LEAST_RATIO = 0.90
FULL_RATIO = 1.00
MOST_IN_A_ROW = 1
MOST_DIPS = 2

_LOW, _KNEE, _PLATEAU, _HIGH = 0.1, 1.3, 8.3, 33.3

N_SETS = 4
"""Sets of points 1/6 octave apart among those of AC156, each shifted by a quarter of that."""

# At most 1/24 octave apart, so that both ends of each band are points.
N_SLIDING, N_AC156 = 93, 117

POINTS_HZ: Floats = np.concatenate(
    [np.geomspace(_LOW, _KNEE, N_SLIDING), np.geomspace(_KNEE, _HIGH, N_AC156)[1:]]
)
"""Frequencies at which spectra are compared [Hz]: 93 from 0.1 to 1.3 Hz, 117 from there to 33.3."""

_PLACE = np.arange(len(POINTS_HZ))
_IS_SLIDING, _IS_AC156 = _PLACE < N_SLIDING, _PLACE >= N_SLIDING - 1
_IS_SLOW = _IS_AC156 & (POINTS_HZ <= _PLATEAU)
_IS_FAST = POINTS_HZ > _PLATEAU

_KEPT = 128  # spectra; up to five of each motion

SpectrumAt = Callable[[Floats], Floats]
"""Target acceleration [g] at frequencies [Hz], 5 % damping; NaN where there is no target."""


@dataclass(frozen=True, slots=True, kw_only=True)
class SpectrumRatio:
    """Spectrum of one component over its target.

    Attributes
    ----------
    motion, component : str
    ratio : array, shape (209,)
        At `POINTS_HZ`; NaN where there is no target.
    """

    motion: str
    component: str
    ratio: Floats

    def among(self, points: NDArray[np.bool_]) -> tuple[Floats, Floats]:
        """Return the frequencies [Hz] with a target among some points, and the ratios there."""
        given = points & np.isfinite(self.ratio)
        return POINTS_HZ[given], self.ratio[given]

    def minimum(self, points: NDArray[np.bool_]) -> tuple[float, str]:
        """Return the smallest ratio among some points, and where it is."""
        freq_hz, ratio = self.among(points)
        at = int(ratio.argmin())
        return float(ratio[at]), self._at(freq_hz[at])

    def dips(self, points: NDArray[np.bool_]) -> tuple[int, str]:
        """Return the number of points below 1.00 among some, and where the lowest is."""
        _, ratio = self.among(points)
        count = int((ratio < FULL_RATIO).sum())
        return count, self.minimum(points)[1] if count else ""

    def longest_dip(self, points: NDArray[np.bool_]) -> tuple[int, str]:
        """Return the most neighboring points below 1.00 among some, and where they end."""
        longest, length, where = 0, 0, ""
        for freq_hz, ratio in zip(*self.among(points), strict=True):
            length = length + 1 if ratio < FULL_RATIO else 0
            if length > longest:
                longest, where = length, self._at(freq_hz)
        return longest, where

    def _at(self, freq_hz: float) -> str:
        return f"{self.motion} {self.component}, {freq_hz:.3g} Hz"


def spectrum_ratios(
    motions: Sequence[Motion], horizontal: SpectrumAt, vertical: SpectrumAt
) -> tuple[SpectrumRatio, ...]:
    """Return the spectra of all components as run over their targets: of x and y, and of z."""
    targets = zip(COMPONENTS, (horizontal, horizontal, vertical), strict=True)
    goals = {name: np.asarray(target(POINTS_HZ)) for name, target in targets}
    return tuple(
        SpectrumRatio(
            motion=motion.id,
            component=name,
            ratio=np.abs(motion.scaled(spectrum_mps2(a.tobytes(), motion.dt_s) / UNITS["g"]))
            / goals[name],
        )
        for motion in motions
        for name, a in motion.components.items()
    )


@lru_cache(_KEPT)
def spectrum_mps2(record: bytes, dt_s: float) -> Floats:
    """Return a record's spectrum at `POINTS_HZ`, computed once for all that is compared with it."""
    return read_only(response_spectrum(np.frombuffer(record), dt_s, 1.0 / POINTS_HZ))


def spectrum_rows(ratios: Sequence[SpectrumRatio]) -> Iterator[Limit]:
    """Yield the rows on spectra, each with its worst component; none without a target.

    From 1.3 to 33.3 Hz the acceptance of AC156 as a test laboratory reads it: every point at 0.90
    of the target or more; of points 1/6 octave apart, no two neighbors below 1.00, at most two
    points below 1.00 to 8.3 Hz and two above. It holds wherever the first of these points lies:
    each of the `N_SETS` sets is counted for itself. From 0.1 to 1.3 Hz, where sliding is driven,
    our own: every component at 0.90 of the target or more, the mean of the motions at 1.00 or more.
    """
    if found := _compared(ratios, _IS_AC156):
        band = f"1.3 to 33.3 Hz{_extent(found, _IS_AC156)}"
        title = f"Spectrum / target at {N_AC156} points, {band}, each component"
        yield _least(title, found, _IS_AC156)
        title = f"Neighboring 1/6-octave points below 1.00 of the target, {band}"
        sets = _sets(_IS_AC156)
        yield _most(title, MOST_IN_A_ROW, [each.longest_dip(s) for each in found for s in sets])
    for points, band in ((_IS_SLOW, "1.3 to 8.3 Hz"), (_IS_FAST, "8.3 to 33.3 Hz")):
        if found := _compared(ratios, points):
            title = f"1/6-octave points below 1.00 of the target, {band}{_extent(found, points)}"
            yield _most(title, MOST_DIPS, [each.dips(s) for each in found for s in _sets(points)])
    if found := _compared(ratios, _IS_SLIDING):
        band = f"0.1 to 1.3 Hz{_extent(found, _IS_SLIDING)}"
        title = f"Spectrum / target at {N_SLIDING} points, {band}, each component"
        yield _least(title, found, _IS_SLIDING, provision=PROGRAM)
        title = f"Spectrum / target at {N_SLIDING} points, {band}, mean of the motions"
        yield _least(title, _means(found), _IS_SLIDING, FULL_RATIO, provision=PROGRAM)


def _sets(points: NDArray[np.bool_]) -> Sequence[NDArray[np.bool_]]:
    """Return the points of each set with 1/6 octave between neighbors among some points."""
    return [points & (k == (_PLACE - N_SLIDING + 1) % N_SETS) for k in range(N_SETS)]


def _compared(
    ratios: Sequence[SpectrumRatio], points: NDArray[np.bool_]
) -> Sequence[SpectrumRatio]:
    """Return the components that have a target at any of the points."""
    return [each for each in ratios if each.among(points)[0].size]


def _extent(ratios: Sequence[SpectrumRatio], points: NDArray[np.bool_]) -> str:
    """Say if the target is not given at all of the points."""
    is_whole = all(np.isfinite(each.ratio[points]).all() for each in ratios)
    return "" if is_whole else " as far as the target is given"


def _least(
    title: str,
    ratios: Sequence[SpectrumRatio],
    points: NDArray[np.bool_],
    limit: float = LEAST_RATIO,
    *,
    provision: Provision = MOTIONS,
) -> Limit:
    found, worst = min(each.minimum(points) for each in ratios)
    return Limit(
        title=title,
        found=found,
        limit=limit,
        is_at_least=True,
        worst=worst,
        provision=provision,
        is_ratio_to_target=True,
    )


def _most(title: str, limit: int, counts: Sequence[tuple[int, str]]) -> Limit:
    count, worst = max(counts, key=lambda found: found[0])
    return Limit(
        title=title,
        found=float(count),
        limit=float(limit),
        is_at_least=False,
        worst=worst,
        measure=Measure.COUNT,
    )


def _means(ratios: Sequence[SpectrumRatio]) -> Sequence[SpectrumRatio]:
    """Return the mean over the motions for each component that occurs."""
    by_name = {
        name: [each.ratio for each in ratios if each.component == name] for name in COMPONENTS
    }
    return [
        SpectrumRatio(motion="mean of", component=name, ratio=np.mean(found, axis=0))
        for name, found in by_name.items()
        if found
    ]
