"""A block in two axes by fixed steps of constant acceleration, jitted: how it is done at first try.

Never raises, knows no units but SI; numpy and numba only. Letters as in `solver.kernels.two_axes`,
whose rival this is. Read `slide_fixed`.
"""

import math

from numba import njit


@njit(cache=True)
def slide_fixed(g, dt, cs, substeps, holds):
    """Follow G and mu N, rows of g, shape (n, 3), with so many steps in each interval.

    Friction is mu N v / |v| at the beginning of a step, nothing at rest. With `holds` a block whose
    velocity turns by more than a right angle in a step, while friction could hold it, is at rest,
    until |G| > mu N at the beginning of a step: what the paper does in one axis.

    Returns
    -------
    tuple
        PRD at the ends of steps, place at the end (in plan), speed there.
    """
    h = dt / substeps
    sx = sy = vx = vy = prd = 0.0
    for i in range(g.shape[0] - 1):
        for j in range(substeps):
            part = j / substeps
            gx = g[i, 0] + (g[i + 1, 0] - g[i, 0]) * part
            gy = g[i, 1] + (g[i + 1, 1] - g[i, 1]) * part
            c = g[i, 2] + (g[i + 1, 2] - g[i, 2]) * part
            w, pull = math.sqrt(vx * vx + vy * vy), math.sqrt(gx * gx + gy * gy)
            if w > 0.0:
                ax, ay = gx - c * vx / w, gy - c * vy / w
            elif not holds:
                ax, ay = gx, gy
            elif pull > c:
                ax, ay = gx * (1.0 - c / pull), gy * (1.0 - c / pull)
            else:
                continue
            nx, ny = vx + ax * h, vy + ay * h
            sx, sy = sx + 0.5 * (vx + nx) * h, sy + 0.5 * (vy + ny) * h
            stops = holds and w > 0.0 and nx * vx + ny * vy <= 0.0 and pull <= c
            vx, vy = (0.0, 0.0) if stops else (nx, ny)
            prd = max(prd, math.sqrt(cs * cs * sx * sx + sy * sy))
    return prd, cs * sx, sy, math.sqrt(cs * cs * vx * vx + vy * vy)
