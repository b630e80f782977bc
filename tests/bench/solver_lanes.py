"""Whether cases side by side in vector lanes are faster than one after the other.

Run from the top: .venv/bin/python tests/bench/solver_lanes.py [RECORD.csv ...] The exact method for
LANES cases at once, in explicit vectors. The cases are sorted by what they yield at, so that
neighbors slip together, and go through the record in lockstep: past what is quiet for all, sample
by sample without branches while no lane has an event, and where one has, all events of the interval
at once. Prints the speed beside `one_axis.slide_exact`, over the grid and the records of
`solver_speed`, and the largest difference in s relative to the PRD.
"""

import math
import statistics

import numpy as np
from numba import njit
from solver_speed import GRID, G, seconds, suites
from solver_vectors import LANES, count, floats, gather, lane, least, most, root, where, whole

from solver.formats import read_record
from solver.kernels import one_axis

ROUNDING = 1e-11
LEAST_PRD_M = 1e-9
PUSH = (1.0, 0.0, 0.0)


@njit(forceinline=True)
def onset(q_0, q_1, tau, dt):
    rises = where(q_1 <= 0.0, floats(dt), most(q_0 / (q_0 - q_1) * dt, tau))
    return where(q_0 <= 0.0, rises, where(q_0 + (q_1 - q_0) / dt * tau > 0.0, tau, floats(dt)))


@njit
def slide_lanes(ax, x, dt, cases, first, out):
    """Rows of cases: weights of 1 and a in the push down and up, and the resting band."""
    last, rate, half, zero, unity = ax.size - 1, 1.0 / dt, 0.5 * dt, floats(0.0), floats(1.0)
    own = whole(first)
    d_0, d_1, u_0 = gather(cases[0], own), gather(cases[1], own), gather(cases[2], own)
    u_1, low, high = gather(cases[3], own), gather(cases[4], own), gather(cases[5], own)
    band = cases[4, first], cases[5, first]
    for k in range(LANES):
        band = max(band[0], lane(low, k)), min(band[1], lane(high, k))
    w = s = s_max = s_min = sigma = tau = q = gained = total = q_first = start = zero
    c_0 = c_1 = k_0 = k_1 = zero
    rest, i = zero <= 0.0, 0
    while i < last:
        if count(rest) == LANES:
            i = max(one_axis._next_push(PUSH, PUSH, band, ax, None, x, None, i) - 1, i)
            if i >= last:
                break
        # A lane at rest has no push, so that its sums stay zero.
        a_1 = ax[np.uintp(i + 1)]
        middle, q_1 = gained + q, k_0 - k_1 * a_1
        more = middle + q_1
        calm = (rest & (low <= a_1) & (a_1 <= high)) | (~rest & (least(middle, more) + w > 0.0))
        if count(calm) == LANES and i > 0:
            total, gained, q, i = total + gained, more, q_1, i + 1
            continue
        acts, a_0, here = ~(calm & (floats(i) > 0.0)), ax[np.uintp(i)], floats(float(i))
        fresh = acts & acts
        over = acts & ~rest
        way = ((here - start) * w + (total + gained * 0.5) + (q_first - q) / 6.0) * dt
        s, w = where(over, s + sigma * way, s), where(over, w + gained, w)
        total, gained, q, tau = total + gained, more, q_1, zero
        rest = rest & ~acts
        while count(acts) > 0:
            still = acts & ~(w > 0.0)
            t_down = onset(d_0 - d_1 * a_0, d_0 - d_1 * a_1, tau, dt)
            t_up = onset(u_0 - u_1 * a_0, u_0 - u_1 * a_1, tau, dt)
            rises, tau = t_up < t_down, where(still, least(t_up, t_down), tau)
            c_0 = where(still, where(rises, u_0, d_0), c_0)
            c_1 = where(still, where(rises, u_1, d_1), c_1)
            sigma = where(still, where(rises, zero - 1.0, unity), sigma)
            rests = still & ~(tau < dt)
            rest, acts = rest | rests, acts & ~rests
            q_0, r = c_0 - c_1 * a_0, c_1 * ((a_0 - a_1) * rate)
            p, h = q_0 + r * tau, zero + dt - tau
            p = where(still, most(p, zero), p)
            w_end, inner = w + h * (p + r * h * 0.5), p * p - r * 2.0 * w
            dips = (r > 0.0) & (p < 0.0) & (zero - p < r * h) & ~(inner < 0.0)
            runs = ((w_end > 0.0) & ~dips) | (still & ~(r < 0.0))
            falls, deep = p < 0.0, root(most(inner, zero))
            step = where(falls, w * 2.0, p + deep) / where(falls, deep - p, zero - r)
            step = where(runs, h, least(step, h))
            s = where(acts, s + sigma * (step * (w + step * (p * 0.5 + step * (r / 6.0)))), s)
            w = where(acts, where(runs, w_end, zero), w)
            t = where(tau + step > tau, tau + step, tau * (1.0 + 2.3e-16) + one_axis.TINY)
            acts = acts & ~runs
            tau = where(acts, t, tau)
            s_max, s_min = where(acts, most(s_max, s), s_max), where(acts, least(s_min, s), s_min)
        k_0 = where(fresh, where(rest, zero, c_0 * half), k_0)
        k_1 = where(fresh, where(rest, zero, c_1 * half), k_1)
        q, gained = where(fresh, k_0 - k_1 * a_1, q), where(fresh, zero, gained)
        total, start = where(fresh, zero, total), where(fresh, here + 1.0, start)
        q_first, w, i = where(fresh, q, q_first), where(rest, zero, w), i + 1
    way = ((floats(float(last)) - start) * w + (total + gained * 0.5) + (q_first - q) / 6.0) * dt
    s = where(rest, s, s + sigma * way)
    for k in range(LANES):
        out[first + k, 0], out[first + k, 1] = lane(most(s_max, s), k), lane(least(s_min, s), k)
        out[first + k, 2] = lane(s, k)


@njit
def fill_cases(grid, peak, cases):
    for k in range(grid.shape[0]):
        sn, cs, mu = math.sin(grid[k, 0]), math.cos(grid[k, 0]), grid[k, 1]
        down = (sn - mu * cs) * G, 0.0, (cs + mu * sn) * grid[k, 2] * G / peak
        up = (-sn - mu * cs) * G, 0.0, (mu * sn - cs) * grid[k, 2] * G / peak
        cases[0, k], cases[1, k], cases[2, k], cases[3, k] = down[0], down[2], up[0], up[2]
        cases[4, k], cases[5, k] = one_axis._resting_band(down, up)


@njit
def run_all(ax, x, dt, cases, out):
    for first in range(0, out.shape[0], LANES):
        slide_lanes(ax, x, dt, cases, first, out)


def run_lanes(ax, x, dt, peak, out):
    """All cases of the grid, LANES at a time; the last is repeated up to a full vector."""
    cases = np.empty((6, len(GRID)))
    fill_cases(GRID, peak, cases)
    near, far = np.sort(np.abs(cases[4:]), axis=0)
    steps = np.round(20.0 * np.log(np.maximum(near, 1e-3)))
    order = np.lexsort((far, steps, -cases[4] < cases[5]))
    order = np.append(order, np.repeat(order[-1:], -len(GRID) % LANES))
    outcomes = np.empty((len(order), 3))
    run_all(ax, x, dt, np.ascontiguousarray(cases[:, order]), outcomes)
    out[order] = outcomes


@njit
def run_one_by_one(ax, x, dt, peak, grid, out):
    for k in range(grid.shape[0]):
        sn, cs, scale = math.sin(grid[k, 0]), math.cos(grid[k, 0]), grid[k, 2] * G / peak
        outcome = one_axis.slide_exact(ax, None, x, None, dt, sn, cs, grid[k, 1], G, scale, None)
        out[k, 0], out[k, 1], out[k, 2] = outcome[0], outcome[1], outcome[2]


def measure(path):
    """Return the time of a run [s], one by one and in lanes, and the largest difference."""
    record = read_record(path, units="g")
    ax = record.a_mps2
    given = ax, one_axis.bounds(ax), record.dt_s, float(np.abs(ax).max())
    scalar, lanes = np.empty((2, len(GRID), 3))
    times = seconds(lambda: run_one_by_one(*given, GRID, scalar), lambda: run_lanes(*given, lanes))
    prd = np.maximum(np.maximum(scalar[:, 0], -scalar[:, 1]), LEAST_PRD_M)
    difference = float((np.abs(lanes - scalar) / prd[:, None]).max())
    if not difference < ROUNDING:
        raise SystemExit(f"{path.name}: the lanes differ by {difference:.1e} of the PRD")
    return *(taken / len(GRID) for taken in times), difference


def main():
    headings = ("one by one us", "in lanes us", "speed-up", "difference")
    print(f"{f'{LANES} lanes':32}" + "".join(f"{heading:>15}" for heading in headings))
    for name, paths in suites().items():
        logs = []
        for path in paths:
            scalar, lanes, difference = measure(path)
            logs.append(math.log(scalar / lanes))
            figures = f"{scalar * 1e6:15.2f}{lanes * 1e6:15.2f}{scalar / lanes:15.2f}"
            print(f"{path.stem:32}{figures}{difference:15.0e}")
        print(f"{name + ', geometric mean':62}{math.exp(statistics.mean(logs)):15.2f}")


if __name__ == "__main__":
    main()
