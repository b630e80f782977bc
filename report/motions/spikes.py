"""Samples far above all others of a record: a digit, a sign of a missing value, a loose contact.

Decides nothing: `report.motions.plausible` asks about them. Read `spikes`.
"""

from __future__ import annotations

import numpy as np

from solver.model import Floats

FACTOR = 3.0
"""Smallest spike / largest other sample: shaking rises to its peak over several samples."""

MOST = 10
LEAST_SAMPLES_FOR_EACH = 100


def spikes(a: Floats) -> tuple[tuple[int, ...], float]:
    """Return the indexes of the spikes of a record, and the largest magnitude of the others.

    Spikes are at most `MOST` samples, and at most one in `LEAST_SAMPLES_FOR_EACH`, each of which
    is more than `FACTOR` times any sample that is none.

    Parameters
    ----------
    a : array, shape (n,)
    """
    size = np.abs(a)
    most = min(MOST, len(a) // LEAST_SAMPLES_FOR_EACH)
    largest = np.argsort(-size, kind="stable")[: most + 1]
    for count in range(1, most + 1):
        if size[largest[count - 1]] > FACTOR * size[largest[count]]:
            return tuple(sorted(map(int, largest[:count]))), float(size[largest[count]])
    return (), float(size.max(initial=0.0))
