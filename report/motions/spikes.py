"""Samples far above all others: a digit too many, a code for a missing value, a loose contact.

Of 0.1, 0.2, 9.3, 0.3 g the third is one. Shaking rises to its peak over several samples.
"""

from __future__ import annotations

import numpy as np

from solver.model import Floats

# Samples far above all others are a digit, a sign of a missing value or a loose contact.
# Smallest spike / largest other sample: shaking rises to its peak over several samples.
FACTOR = 3.0

MOST = 10

LEAST_SAMPLES_FOR_EACH = 100


def spikes(a: Floats) -> tuple[tuple[int, ...], float]:
    """Return the indexes of the spikes of a record, and the largest magnitude of the others."""
    # At most `MOST` samples, and at most one in `LEAST_SAMPLES_FOR_EACH`, each of which is more
    # than `FACTOR` times any sample that is none.
    size = np.abs(a)
    count_allowed = min(MOST, len(a) // LEAST_SAMPLES_FOR_EACH)
    # Stable: of equal samples the first is named, on every machine.
    largest = np.argsort(-size, kind="stable")[: count_allowed + 1]
    for count in range(1, count_allowed + 1):
        if size[largest[count - 1]] > FACTOR * size[largest[count]]:
            return tuple(sorted(map(int, largest[:count]))), float(size[largest[count]])
    return (), float(size.max(initial=0.0))
