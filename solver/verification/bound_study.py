"""Differences of random pairs of runs in two axes, relative to their bounds.

Read `bound_ratios`; `random_pairs` generates the pairs.
"""

from __future__ import annotations

from functools import cache

import numpy as np

from solver.verification.model_evidence import BoundRatios
from solver.verification.random_pairs import KINDS, UNBOUNDED, pair

PAIRS = (40, 1000)
"""Number of pairs of each kind, quick and full."""

_PRINTED = {
    "N to zero": "normal force near zero",
    "friction by speed": "velocity-dependent friction",
}


@cache
def bound_ratios(*, quick: bool) -> tuple[BoundRatios, ...]:
    """Run the first pairs of every kind that has a bound."""
    return tuple(_of_kind(kind, PAIRS[not quick]) for kind in KINDS if kind not in UNBOUNDED)


def _of_kind(kind: str, count: int) -> BoundRatios:
    outcomes = []
    for index in range(count):
        try:
            outcomes.append(pair(kind, index).run())
        except ArithmeticError:
            continue
    moved = [outcome.ratio for outcome in outcomes if outcome.prd_m > 0.0]
    return BoundRatios(
        kind=_PRINTED.get(kind, kind),
        n_pairs=count,
        n_unanswered=count - len(outcomes),
        ratios=np.sort(np.array(moved)),
    )
