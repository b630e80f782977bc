# mypy: allow-untyped-defs, allow-untyped-decorators
"""The methods that the exact one is held against, jitted: each as the field knows it.

Never raises, knows no units but SI; numpy and numba only. Read `solver.methods` for what each one
is, and `solver.kernels` for the exact one.

Letters, as in the paper (Predicted Slip of Ballasted Solar Arrays, Eqs. 1-19), those of
`solver.kernels` and:
    a_p, a_x  horizontal acceleration of the plane and of the block                  [m/s2]
    u_p, u_x  their displacements; u = u_x - u_p                                     [m]
    v_p, v_x  their velocities; dv = v_x - v_p                                       [m/s]
"""

import numpy as np
from numba import njit

# Outcome codes; `solver.solve` maps them to `Status`.
FOLLOWED = 0
UPLIFTED = 1


@njit(cache=True)
def slide_paper(ax, dt, sn, cs, mu, g, scale, substeps, history):
    """Follow the paper's own algorithm: constant acceleration over each of `substeps` sub-steps.

    Equation by equation, sign(0) = 0 included (Eq. 13), so that the first sub-step of a slip has
    no friction. First order in dt / substeps.

    Returns
    -------
    tuple
        Code, u = u_x - u_p at its largest, at its least, at the end, its rate at the end, time
        of the largest |u|, number of stops, time of uplift.
    """
    tn = sn / cs
    step = dt / substeps
    v_p = u_p = v_x = u_x = dv = dv_before = 0.0  # Eq. 19
    u_max = u_min = u_peak = t_peak = 0.0
    n_stops = 0
    for k in range((ax.size - 1) * substeps):
        i, j = k // substeps, k % substeps
        a_p = scale * (ax[i] + (ax[i + 1] - ax[i]) * (j / substeps))
        if history.shape[1] > 0 and j == 0:
            history[0, i], history[1, i] = u_x - u_p, dv
        slow = dv == 0.0 or dv * dv_before < 0.0
        if dv * dv_before < 0.0:
            n_stops += 1
        normal = g * cs + a_p * sn
        # Eqs. 6, 8, 9
        if slow and abs(a_p * cs - g * sn) < mu * abs(normal):
            v_x, a_x, dv = v_p, a_p, 0.0
        else:
            sign = 1.0 if dv > 0.0 else (-1.0 if dv < 0.0 else 0.0)
            a_k = sn - mu * sign * cs  # Eq. 13
            b_k = cs + mu * sign * sn  # Eq. 15
            c_k = g + a_p * tn  # Eq. 16
            normal = c_k / (a_k * tn + b_k)  # Eq. 17, N / m
            a_x = normal * a_k  # Eq. 18
        if normal < 0.0:
            return UPLIFTED, np.nan, np.nan, np.nan, np.nan, np.nan, n_stops, k * step
        u_p += v_p * step + 0.5 * a_p * step * step
        v_p += a_p * step
        u_x += v_x * step + 0.5 * a_x * step * step
        v_x += a_x * step
        dv_before, dv = dv, v_x - v_p
        u = u_x - u_p
        if abs(u) > abs(u_peak):
            u_peak, t_peak = u, (k + 1) * step
        u_max, u_min = max(u_max, u), min(u_min, u)
    if history.shape[1] > 0:
        history[0, -1], history[1, -1] = u_x - u_p, dv
    return FOLLOWED, u_max, u_min, u_x - u_p, dv, t_peak, n_stops, np.nan
