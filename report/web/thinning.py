"""Which samples a moving plan or a path needs: few enough to draw, and every peak among them."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from solver.model import Floats

Indices = NDArray[np.intp]


def peaks_kept(values: Floats, maximum: int) -> Indices:
    """Return the samples of at most `maximum` that have the smallest and largest value of a part.

    The history is divided into equal parts; its ends stay. NaN is neither small nor large.
    """
    n = len(values)
    if n <= maximum:
        return np.arange(n)
    size = math.ceil(n / (maximum // 2 - 1))
    parts = -(-n // size)
    padded = np.full(parts * size, np.nan)
    padded[:n] = values
    lost = np.isnan(padded)
    low = np.where(lost, math.inf, padded).reshape(parts, size).argmin(axis=1)
    high = np.where(lost, -math.inf, padded).reshape(parts, size).argmax(axis=1)
    starts = np.arange(parts) * size
    kept = np.unique([0, n - 1, *(starts + low), *(starts + high)])
    return kept[kept < n]


def beside(times_s: Floats, dt_s: float, n: int) -> Indices:
    """Return the samples before and after each of the times."""
    at = np.floor(times_s / dt_s).astype(np.intp)
    return np.unique(np.clip(np.concatenate([at, at + 1]), 0, n - 1))
