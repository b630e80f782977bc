"""A block in two axes by fixed steps of constant acceleration, jitted: the straightforward method.

Never raises, knows no units but SI; numpy and numba only. For comparison with
`solver.kernels.two_axes`; letters as there. Read `slide_fixed`.
"""

import math

from numba import njit

from solver.kernels.compiler import KEPT


@njit(cache=KEPT)
def slide_fixed(g, dt, cs, substeps, holds):
    """Solve the motion under G and mu N with `substeps` steps in each interval.

    g has shape (n, 3): Gx, Gy and mu N at the samples [m/s2]. Friction is mu N v / |v| at the
    beginning of a step, and zero at rest. With `holds`, a block comes to rest if its velocity turns
    by 90 deg or more in a step while mu N >= |G|, and stays at rest until |G| > mu N at the
    beginning of a step, as the paper does in one axis.

    Returns
    -------
    tuple
        PRD at the ends of steps, position in plan at the end (x, y), speed at the end.
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
