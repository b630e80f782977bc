"""Bounds of the effect of cross-slope shaking, in one pass over the record, jitted.

Samples of 0, 4, -4, 0 m/s2 at 0.1 s move a block with mu = 0.2 on a flat roof 4.9 mm. A hundredth
of them across changes that by 0.001 mm; the bound is 2.8 mm, and falls in proportion to ay.

Follows no motion (`one_axis` and `two_axes` do). Never raises, knows no units but SI; numpy and
numba only. Letters as in `two_axes`, which
`tests/solver/kernels/test_cross_slope_kernel.py` compares its bounds with.
"""

import math

import numpy as np
from numba import njit

from solver.kernels.compiler import KEPT

SIXTH = 1.0 / 6.0

# An effect of this many times the share of the path so far does not come below it any more: the
# rest of the record is not read. Only the time that is spared depends on it.
HOPELESS = 10.0


# Less than 1 by more than the relative rounding error of the square of a ratio of forces.
NEARLY = 1.0 - 1e-12


@njit(cache=KEPT, nogil=True, error_model="numpy")
def first_slip(ax, ay, az, sn, cs, hold, g, scale):
    """First sample at which |G| / N exceeds `hold`, or N is not above zero; their number if none.

    To the last bit where `two_axes.friction_demand`, which reads every sample, says so.
    """
    least = NEARLY * hold * hold
    for i in range(ax.size):
        along, weight = scale * ax[i], g + scale * az[i]
        normal, down, across = weight * cs + along * sn, weight * sn - along * cs, scale * ay[i]
        if not normal > 0.0:
            return i
        # The ratio is needed only near the coefficient: products, which are faster, tell.
        near = down * down + across * across >= least * (normal * normal)
        if near and math.hypot(down, across) / normal > hold:
            return i
    return ax.size


@njit(cache=KEPT, nogil=True, error_model="numpy")
def cross_slope_effect(ax, ay, az, dt, sn, cs, mu, g, scale, matters, share, first):
    """Bound the change of any displacement by ay [m]; inf where the bound would not be small.

    Before sample `first` the block is at rest.

    Small is at most `matters` [m], or `share` of the farthest that the block can slide.
    Friction is monotone, so two blocks of one normal force under the drives G and (Gx, 0) differ in
    velocity by v with d|v|/dt <= |ay|, and by no more than the sum of their speeds. The speed of
    either is at most w with dw/dt = |G| - mu N, and not below zero: both rest where w is zero.
    """
    effect = travel = apart = w = 0.0
    push = side = 0.0
    sixth = dt * dt * SIXTH
    # The slip begins within the interval that ends at `first`.
    begin = max(first - 1, 0)
    for i in range(begin, ax.size):
        along, weight = scale * ax[i], g + scale * az[i]
        down, across = weight * sn - along * cs, abs(scale * ay[i])
        before, before_side, side = push, side, across
        push = math.sqrt(down * down + across * across) - mu * (weight * cs + along * sn)
        if i == begin or (w == 0.0 and push <= 0.0 and before <= 0.0):
            continue
        # Both rates are convex between samples, so no more than linear. What a rate below zero
        # takes away counts at the end of the interval, and slip that begins within it as at once.
        rise, rise_before = max(push, 0.0), max(before, 0.0)
        way = dt * w + sixth * (2.0 * rise_before + rise)
        effect += min(dt * apart + sixth * (2.0 * before_side + side), 2.0 * way)
        travel += way
        # The second term: a block that stops within the interval may slip again before its end.
        w = max(w + 0.5 * dt * (before + push), 0.5 * dt * rise)
        apart = min(apart + 0.5 * dt * (before_side + side), 2.0 * w)
        if effect > max(matters, HOPELESS * share * travel):
            return np.inf
    return effect if effect <= max(matters, share * travel) else np.inf
