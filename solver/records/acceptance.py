"""Acceptance criteria for the motions of an analysis: each limit, with the worst motion.

Motions at 0.95 of their target satisfy the limit of 0.90 for each of them, and miss that of 1.00
for their mean from 0.1 to 1.3 Hz, where sliding is driven.

Changes no motion and gives no verdict. Read `acceptance`.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from itertools import combinations, product

import numpy as np
from numpy.typing import NDArray

from solver.model import Floats, Motion
from solver.records.measures import Strength, correlation, strength
from solver.records.record import UNITS, Record, read_only
from solver.records.spectrum import response_spectrum
from solver.rules.limit import MOTIONS, PROGRAM, Consequence, Limit, Measure
from solver.rules.rulesets import Provision
from solver.spaces import NO_BREAK

# Names of the components of a motion: two horizontal ones and the vertical.
COMPONENTS = ("x", "y", "z")

# AC156 as a test laboratory reads it: see `spectrum_rows`.
LEAST_RATIO = 0.90
FULL_RATIO = 1.00
MOST_IN_A_ROW = 1
MOST_DIPS = 2

# Corners of the spectrum of AC156 [Hz].
_LOW, _KNEE, _PLATEAU, _HIGH = 0.1, 1.3, 8.3, 33.3

# Sets of points 1/6 octave apart among those of AC156, each shifted by a quarter of that.
N_SETS = 4

# At most 1/24 octave apart, so that both ends of each band are points.
# Each is a multiple of `N_SETS` plus one, so that one set includes both ends.
N_SLIDING, N_AC156 = 93, 117

# The knee is a point of both bands, once.
# Frequencies at which spectra are compared [Hz]: 93 from 0.1 to 1.3 Hz, 117 from there to 33.3.
POINTS_HZ: Floats = np.concatenate(
    [np.geomspace(_LOW, _KNEE, N_SLIDING), np.geomspace(_KNEE, _HIGH, N_AC156)[1:]]
)

_PLACE = np.arange(len(POINTS_HZ))
_IS_SLIDING, _IS_AC156 = _PLACE < N_SLIDING, _PLACE >= N_SLIDING - 1
_IS_SLOW = _IS_AC156 & (POINTS_HZ <= _PLATEAU)
_IS_FAST = POINTS_HZ > _PLATEAU

_KEPT = 128  # spectra; up to five of each motion

# Spectra [m/s2] at `POINTS_HZ` of the components of each motion, before its scale.
SpectraOf = Callable[[Sequence[Motion]], Sequence[Sequence[Floats]]]

# Target acceleration [g] at frequencies [Hz], 5 % damping; NaN where there is no target.
SpectrumAt = Callable[[Floats], Floats]


@dataclass(frozen=True, slots=True, kw_only=True)
class SpectrumRatio:
    """Spectrum of one component over its target."""

    motion: str
    component: str
    ratio: Floats  # shape (209,), at `POINTS_HZ`; NaN where there is no target

    def among(self, points: NDArray[np.bool_]) -> tuple[Floats, Floats]:
        """Return the frequencies [Hz] with a target among given points, and the ratios there."""
        finite = points & np.isfinite(self.ratio)
        return POINTS_HZ[finite], self.ratio[finite]

    def minimum(self, points: NDArray[np.bool_]) -> tuple[float, str]:
        """Return the smallest ratio among given points, and its location."""
        freq_hz, ratio = self.among(points)
        lowest = int(ratio.argmin())
        return float(ratio[lowest]), self._at(freq_hz[lowest])

    def dips(self, points: NDArray[np.bool_]) -> tuple[int, str]:
        """Return the number of points below 1.00 among given ones, and the lowest of them."""
        _, ratio = self.among(points)
        count = int((ratio < FULL_RATIO).sum())
        return count, self.minimum(points)[1] if count else ""

    def longest_dip(self, points: NDArray[np.bool_]) -> tuple[int, str]:
        """Return the longest run of points below 1.00 among given ones, and its end."""
        longest, length, where = 0, 0, ""
        for freq_hz, ratio in zip(*self.among(points), strict=True):
            length = length + 1 if ratio < FULL_RATIO else 0
            if length > longest:
                longest, where = length, self._at(freq_hz)
        return longest, where

    def _at(self, freq_hz: float) -> str:
        return f"{self.motion} {self.component}, {freq_hz:.3g}{NO_BREAK}Hz"


def spectrum_ratios(
    motions: Sequence[Motion], horizontal: SpectrumAt, vertical: SpectrumAt, spectra_of: SpectraOf
) -> tuple[SpectrumRatio, ...]:
    """Return the spectra of all components as run over their targets: of x and y, and of z."""
    targets = zip(COMPONENTS, (horizontal, horizontal, vertical), strict=True)
    goals = {name: np.asarray(target(POINTS_HZ)) for name, target in targets}
    ratios: list[SpectrumRatio] = []
    for motion, spectra in zip(motions, spectra_of(motions), strict=True):
        for name, spectrum in zip(motion.components, spectra, strict=True):
            # A factor may be negative, which reverses the motion; its spectrum is the same.
            ratio = np.abs(motion.scaled(spectrum / UNITS["g"])) / goals[name]
            ratios.append(SpectrumRatio(motion=motion.id, component=name, ratio=ratio))
    return tuple(ratios)


def one_by_one(motions: Sequence[Motion]) -> Sequence[Sequence[Floats]]:
    """Return spectra by the compiled kernel; each is cached."""
    return [
        [spectrum_mps2(a.tobytes(), motion.dt_s) for a in motion.components.values()]
        for motion in motions
    ]


# Keyed by the bytes of the record, because arrays are not hashable.
@lru_cache(_KEPT)
def spectrum_mps2(record: bytes, dt_s: float) -> Floats:
    """Return a record's spectrum at `POINTS_HZ`, computed once for all comparisons."""
    return read_only(response_spectrum(np.frombuffer(record), dt_s, 1.0 / POINTS_HZ))


def spectrum_rows(ratios: Sequence[SpectrumRatio]) -> Iterator[Limit]:
    """Yield the rows on spectra, each with its worst component; none without a target.

    From 1.3 to 33.3 Hz the acceptance of AC156 as a test laboratory reads it: every point at 0.90
    of the target or more; of points 1/6 octave apart, no two neighbors below 1.00, at most two
    points below 1.00 to 8.3 Hz and two above. It holds wherever the first of these points lies:
    each of the `N_SETS` sets is counted for itself. From 0.1 to 1.3 Hz, where sliding is driven,
    our own: every component at 0.90 of the target or more, the mean of the motions at 1.00 or more.
    """
    if rows := _compared(ratios, _IS_AC156):
        band = f"1.3 to 33.3{NO_BREAK}Hz{_extent(rows, _IS_AC156)}"
        title = f"Spectrum / target at {N_AC156} points, {band}, each component"
        yield _least(title, rows, _IS_AC156)
        title = f"Consecutive 1/6-octave points below the target, {band}"
        sets = _sets(_IS_AC156)
        dips = [row.longest_dip(points) for row, points in product(rows, sets)]
        yield _most(title, MOST_IN_A_ROW, dips)
    for points, ends in ((_IS_SLOW, "1.3 to 8.3"), (_IS_FAST, "8.3 to 33.3")):
        if rows := _compared(ratios, points):
            band = f"{ends}{NO_BREAK}Hz{_extent(rows, points)}"
            title = f"1/6-octave points below the target, {band}"
            dips = [row.dips(which) for row, which in product(rows, _sets(points))]
            yield _most(title, MOST_DIPS, dips)
    if rows := _compared(ratios, _IS_SLIDING):
        band = f"0.1 to 1.3{NO_BREAK}Hz{_extent(rows, _IS_SLIDING)}"
        title = f"Spectrum / target at {N_SLIDING} points, {band}, each component"
        # AC156 has no acceptance below 1.3 Hz, where sliding is driven: these two are limits of
        # this program.
        yield _least(title, rows, _IS_SLIDING, provision=PROGRAM)
        title = f"Spectrum / target at {N_SLIDING} points, {band}, mean of the motions"
        yield _least(title, _means(rows), _IS_SLIDING, FULL_RATIO, provision=PROGRAM)


def _sets(points: NDArray[np.bool_]) -> Sequence[NDArray[np.bool_]]:
    """Return the points of each set with 1/6 octave between neighbors among some points."""
    # Counted from the knee, the first point of the band of AC156.
    return [points & (k == (_PLACE - N_SLIDING + 1) % N_SETS) for k in range(N_SETS)]


def _compared(
    ratios: Sequence[SpectrumRatio], points: NDArray[np.bool_]
) -> Sequence[SpectrumRatio]:
    """Return the components that have a target at any of the points."""
    return [ratio for ratio in ratios if ratio.among(points)[0].size]


def _extent(ratios: Sequence[SpectrumRatio], points: NDArray[np.bool_]) -> str:
    """State if the target is not defined at all of the points."""
    is_whole = all(np.isfinite(ratio.ratio[points]).all() for ratio in ratios)
    return "" if is_whole else " as far as the target is given"


def _least(
    title: str,
    ratios: Sequence[SpectrumRatio],
    points: NDArray[np.bool_],
    limit: float = LEAST_RATIO,
    *,
    provision: Provision = MOTIONS,
) -> Limit:
    # Of equal ratios the first name, so that the row is the same every time.
    lowest, worst = min(ratio.minimum(points) for ratio in ratios)
    return Limit(
        title=title,
        found=lowest,
        limit=limit,
        is_at_least=True,
        worst=worst,
        provision=provision,
        is_ratio_to_target=True,
    )


def _most(title: str, limit: int, counts: Sequence[tuple[int, str]]) -> Limit:
    # Of equal counts the first, so that the row is the same every time.
    count, worst = max(counts, key=lambda counted: counted[0])
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
        name: [ratio.ratio for ratio in ratios if ratio.component == name] for name in COMPONENTS
    }
    return [
        SpectrumRatio(motion="mean of", component=name, ratio=np.mean(means, axis=0))
        for name, means in by_name.items()
        if means
    ]


# PV1-2012: number of motions and length of the strong motion [s]. AC156: correlation.
LEAST_MOTIONS = 3
STRONG_S = 20.0
MOST_CORRELATION = 0.3


@dataclass(frozen=True, slots=True, kw_only=True)
class MotionStrength:
    """Strong motion and correlations of one motion as run."""

    id: str
    hold_s: float  # of the envelope of a generated motion; NaN for a record
    strengths: Mapping[str, Strength]  # by component: only those that the motion has
    correlations: Mapping[str, float]  # by pair, such as ``x-y``: coefficient at zero lag

    @property
    def is_generated(self) -> bool:
        """Whether the motion states the hold of the envelope that it was generated with."""
        return not math.isnan(self.hold_s)


@dataclass(frozen=True, slots=True, kw_only=True)
class Acceptance:
    """The checks of the motions, and the measures that they are based on."""

    rows: tuple[Limit, ...]
    motions: tuple[MotionStrength, ...]

    @property
    def qualifies(self) -> bool:
        """Whether the motions satisfy every limit required for an analysis displacement."""
        return not any(row.consequence is Consequence.NG for row in self.missed)

    @property
    def missed(self) -> tuple[Limit, ...]:
        """The rows that are not satisfied."""
        return tuple(row for row in self.rows if not row.ok)


def acceptance(
    motions: Sequence[Motion],
    holds_s: Sequence[float],
    horizontal: SpectrumAt,
    vertical: SpectrumAt,
    spectra_of: SpectraOf = one_by_one,
) -> Acceptance:
    """Compare motions as run, scaled, with the limits on motions for analysis.

    Count, components and strong motion: PV1-2012; correlation: AC156; spectra: `spectrum_rows`.
    A generated motion is one that states the hold of its envelope: the hold must be 20 s or more,
    and its components must not correlate. Of other motions the significant duration is a condition.

    Holds are in [s], NaN for a record; the targets are those of x and y, and of z. Rows that do not
    apply are absent: spectra without a target, correlations of records.
    """
    strengths = tuple(motion_strength(*pair) for pair in zip(motions, holds_s, strict=True))
    rows = (
        _count(motions),
        _components(strengths),
        *spectrum_rows(spectrum_ratios(motions, horizontal, vertical, spectra_of)),
        *_strong_rows(strengths),
        *_correlation_row(strengths),
    )
    return Acceptance(rows=rows, motions=strengths)


def motion_strength(motion: Motion, hold_s: float) -> MotionStrength:
    """Measure the strong motion and the correlations of a motion as run."""
    # The scale changes the Arias intensity, but no duration or correlation.
    records = {
        name: Record(name=name, dt_s=motion.dt_s, a_mps2=motion.scaled(a))
        for name, a in motion.components.items()
    }
    return MotionStrength(
        id=motion.id,
        hold_s=hold_s,
        strengths={name: strength(record) for name, record in records.items()},
        correlations={
            f"{name}-{second}": correlation(records[name], records[second])
            for name, second in combinations(records, 2)
        },
    )


def _count(motions: Sequence[Motion]) -> Limit:
    return Limit(
        title="Number of motions",
        found=float(len(motions)),
        limit=float(LEAST_MOTIONS),
        is_at_least=True,
        measure=Measure.COUNT,
    )


def _components(strengths: Sequence[MotionStrength]) -> Limit:
    fewest = min(strengths, key=lambda motion: len(motion.strengths))
    missing = [name for name in COMPONENTS if name not in fewest.strengths]
    return Limit(
        title="Components per motion, two horizontal and one vertical",
        found=float(len(fewest.strengths)),
        limit=float(len(COMPONENTS)),
        is_at_least=True,
        worst=f"{fewest.id}, no {' and no '.join(missing)}" if missing else "",
        measure=Measure.COUNT,
    )


def _strong_rows(strengths: Sequence[MotionStrength]) -> Iterator[Limit]:
    holds = [(motion.hold_s, motion.id) for motion in strengths if motion.is_generated]
    if holds:
        title = "Strong-motion duration of generated motions (hold time)"
        yield _strong_row(title, holds, Consequence.NG)
    durations: list[tuple[float, str]] = []
    for motion in strengths:
        if not motion.is_generated:
            measured = motion.strengths.items()
            durations += [(measure.d5_95_s, f"{motion.id} {name}") for name, measure in measured]
    if durations:
        title = "Strong-motion duration of records (D5-95 of each component)"
        yield _strong_row(title, durations, Consequence.CONDITION)


def _strong_row(
    title: str, durations: Sequence[tuple[float, str]], consequence: Consequence
) -> Limit:
    shortest_s, worst = min(durations)
    return Limit(
        title=title,
        found=shortest_s,
        limit=STRONG_S,
        measure=Measure.TIME_S,
        is_at_least=True,
        worst=worst,
        consequence=consequence,
    )


def _correlation_row(strengths: Sequence[MotionStrength]) -> Iterator[Limit]:
    pairs: list[tuple[float, str]] = []
    for motion in strengths:
        if motion.is_generated:
            correlations = motion.correlations.items()
            pairs += [(abs(value), f"{motion.id} {pair}") for pair, value in correlations]
    if pairs:
        value, worst = max(pairs)
        yield Limit(
            title="Correlation of two components of generated motions, absolute value",
            found=value,
            limit=MOST_CORRELATION,
            is_at_least=False,
            worst=worst,
        )
