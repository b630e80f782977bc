"""Event sequences over the service life of a roof, jitted.

Two events with a PRD of 0.4 m downslope and a residual of 0.3 m move an array up to 0.7 m from its
installed position, and leave it at 0.6 m.

Samples no events and runs no record; both are inputs. numpy and numba only. `in_numpy` in
`tests/solver/studies/test_rates.py` is the same without the compiler.
"""

import math

import numpy as np
from numba import njit

from solver.kernels.compiler import KEPT

PRD, DOWN, UP, ACROSS, RESIDUAL, RESIDUAL_ACROSS = range(6)


@njit(cache=KEPT, nogil=True)
def live(first, friction, run, level, weight, side, responses, recenter, out):
    """Follow event sequences: the largest and the last distance from the installed location.

    During an event the array is at most its PRD farther than before, and nowhere beyond the
    rectangle of its excursions: the smaller distance counts. In one axis and from the installed
    place that is the exact one; otherwise an upper bound.

    `out`, shape (2, lives), is filled with both distances [m]; inf where an event has no response.
    """
    # first, friction, run, side: as `solver.studies.lives.Draws` has them. level, weight: the level
    # below the intensity, -1 without a response, and the place between it and the next, 0 to 1.
    # responses: NaN for none, shape (frictions, runs, levels, 6) [m]. recenter: the distance above
    # which the array is put back after an event [m]; inf: never.
    at = np.empty(6)
    for life in range(friction.size):
        x = y = largest = 0.0
        for event in range(first[life], first[life + 1]):
            low = level[event]
            # Of an event without a response nothing is known: the life counts as beyond every
            # limit.
            if low < 0:
                largest = math.inf
                break
            of_run = responses[friction[life], run[event]]
            for k in range(6):
                at[k] = of_run[low, k] + weight[event] * (of_run[low + 1, k] - of_run[low, k])
            if math.isnan(at[PRD]):
                largest = math.inf
                break
            along = max(abs(x + at[DOWN]), abs(x - at[UP]))
            corner = math.hypot(along, abs(y) + at[ACROSS])
            largest = max(largest, min(math.hypot(x, y) + at[PRD], corner))
            x += at[RESIDUAL]
            y += side[event] * at[RESIDUAL_ACROSS]
            if math.hypot(x, y) > recenter:
                x = y = 0.0
        out[0, life] = largest
        out[1, life] = math.inf if math.isinf(largest) else math.hypot(x, y)
