"""Acceptance of the motions of an analysis: count, components, spectra, strong motion, correlation.

Owns the limits that are not on spectra; those are in `solver.records.spectrum_acceptance`. Changes
no motion and draws no verdict. Read `acceptance`.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations

from solver.model import Motion
from solver.records.measures import Strength, correlation, strength
from solver.records.record import Record
from solver.records.spectrum_acceptance import (
    COMPONENTS,
    SpectrumAt,
    spectrum_ratios,
    spectrum_rows,
)
from solver.rules.limit import Consequence, Limit, Measure

LEAST_MOTIONS = 3
STRONG_S = 20.0
MOST_CORRELATION = 0.3


@dataclass(frozen=True, slots=True, kw_only=True)
class MotionStrength:
    """Strong motion and correlations of one motion as run.

    Attributes
    ----------
    id : str
    hold_s : float
        Hold of the envelope of a generated motion [s]; NaN for a record.
    strengths : mapping of str to Strength
        By component: x and y horizontal, z vertical; only those that the motion has.
    correlations : mapping of str to float
        By pair of components, such as ``x-y``: coefficient at zero lag.
    """

    id: str
    hold_s: float
    strengths: Mapping[str, Strength]
    correlations: Mapping[str, float]

    @property
    def is_generated(self) -> bool:
        """Whether the motion states the hold of the envelope that it was generated with."""
        return not math.isnan(self.hold_s)


@dataclass(frozen=True, slots=True, kw_only=True)
class Acceptance:
    """The rows on the motions, and the measures behind them.

    Attributes
    ----------
    rows : tuple of Limit
    motions : tuple of MotionStrength
    """

    rows: tuple[Limit, ...]
    motions: tuple[MotionStrength, ...]

    @property
    def qualifies(self) -> bool:
        """Whether the motions satisfy every limit without which a value from analysis is NG."""
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
) -> Acceptance:
    """Compare motions as run, scaled, with the limits on motions for analysis.

    Count, components and strong motion: PV1-2012; correlation: AC156; spectra: `spectrum_rows`.
    A generated motion is one that states the hold of its envelope: the hold must be 20 s or more,
    and its components must not correlate. Of other motions the significant duration is a condition.

    Parameters
    ----------
    motions : sequence of Motion
        One or more.
    holds_s : sequence of float
        Hold of the envelope of each [s]; NaN for a record.
    horizontal, vertical : callable
        Target of x and y, and of z. Points without a target are not compared.

    Returns
    -------
    Acceptance
        Rows that do not apply are absent: spectra without a target, correlations of records.
    """
    found = tuple(motion_strength(*pair) for pair in zip(motions, holds_s, strict=True))
    rows = (
        _count(motions),
        _components(found),
        *spectrum_rows(spectrum_ratios(motions, horizontal, vertical)),
        *_strong_rows(found),
        *_correlation_row(found),
    )
    return Acceptance(rows=rows, motions=found)


def motion_strength(motion: Motion, hold_s: float) -> MotionStrength:
    """Measure the strong motion and the correlations of a motion as run."""
    records = {
        name: Record(name=name, dt_s=motion.dt_s, a_mps2=motion.scaled(a))
        for name, a in motion.components.items()
    }
    return MotionStrength(
        id=motion.id,
        hold_s=hold_s,
        strengths={name: strength(record) for name, record in records.items()},
        correlations={
            f"{name}-{other}": correlation(records[name], records[other])
            for name, other in combinations(records, 2)
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


def _components(found: Sequence[MotionStrength]) -> Limit:
    fewest = min(found, key=lambda motion: len(motion.strengths))
    missing = [name for name in COMPONENTS if name not in fewest.strengths]
    return Limit(
        title="Number of components of each motion: two horizontal and the vertical together",
        found=float(len(fewest.strengths)),
        limit=float(len(COMPONENTS)),
        is_at_least=True,
        worst=f"{fewest.id}, no {' and no '.join(missing)}" if missing else "",
        measure=Measure.COUNT,
    )


def _strong_rows(found: Sequence[MotionStrength]) -> Iterator[Limit]:
    holds = [(motion.hold_s, motion.id) for motion in found if motion.is_generated]
    if holds:
        title = "Strong motion of generated motions: hold of the envelope"
        yield _strong_row(title, holds, Consequence.NG)
    durations = [
        (measured.d5_95_s, f"{motion.id} {name}")
        for motion in found
        if not motion.is_generated
        for name, measured in motion.strengths.items()
    ]
    if durations:
        title = "Strong motion of records: D5-95 of each component"
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


def _correlation_row(found: Sequence[MotionStrength]) -> Iterator[Limit]:
    pairs = [
        (abs(value), f"{motion.id} {pair}")
        for motion in found
        if motion.is_generated
        for pair, value in motion.correlations.items()
    ]
    if pairs:
        value, worst = max(pairs)
        yield Limit(
            title="Correlation of two components of generated motions, absolute value",
            found=value,
            limit=MOST_CORRELATION,
            is_at_least=False,
            worst=worst,
        )
