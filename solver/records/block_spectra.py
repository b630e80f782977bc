"""Response spectra of all records with one time step at once, by matrix products.

Samples of 0, 4, -4, 0 m/s2 at 0.1 s have ordinates of 3.04 and 1.17 m/s2 at periods of 0.5 and 1 s,
as by `response_spectrum`, to 1e-12.

`solver.records.spectrum` is of one record, by a compiled kernel. What only compares spectra with a
target does not load the compiler, which takes longer than these. Read `together`.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from solver.model import Floats, Motion
from solver.records.spectrum import DAMPING, PEAK_FINENESS, steps_per_interval

# Samples of a block: states at the ends of blocks follow from each other, those within together.
_BLOCK = 32


def together(motions: Sequence[Motion], periods_s: Floats) -> list[list[Floats]]:
    """Return the spectra [m/s2] of the components of each motion, before its scale."""
    # Records of equal step and length share the same matrices and are processed together.
    alike: dict[tuple[float, int], list[Floats]] = {}
    for motion in motions:
        for a in motion.components.values():
            alike.setdefault((motion.dt_s, a.size), []).append(a)
    made = {
        (dt_s, size): iter(spectra(np.array(records), dt_s, periods_s))
        for (dt_s, size), records in alike.items()
    }
    return [
        [next(made[motion.dt_s, a.size]) for a in motion.components.values()] for motion in motions
    ]


def spectra(a_mps2: Floats, dt_s: float, periods_s: Floats) -> Floats:
    """Return the spectra of records, shape (c, n), as `response_spectrum` with 5% damping.

    The periods [s], shape (m,), are above 0. The spectra have the shape (c, m) [m/s2].
    """
    omega = 2.0 * math.pi / periods_s
    steps = steps_per_interval(dt_s, omega)
    ordinates = np.empty((len(a_mps2), omega.size))
    inputs, last_steps = _inputs(a_mps2)
    largest = np.abs(a_mps2).max(1)
    for step_count in np.unique(steps).tolist():
        (some,) = np.nonzero(steps == step_count)
        radians = omega[some] * dt_s / step_count
        responses = _responses(radians, step_count)
        states = _states(responses[:, -1], inputs[2:])
        for column, p, response, state in zip(some, radians, responses, states, strict=True):
            # The states at the starts of all blocks are known now, so the blocks are independent.
            inputs[:2] = state
            ordinates[:, column] = _peaks(response, p, inputs, last_steps * step_count, largest)
    return ordinates


def _inputs(a: Floats) -> tuple[Floats, int]:
    """Return what a block responds to, shape (2 + _BLOCK + 1, c, b), and the last one's intervals.

    Two rows for the state at its start, still zero, its samples, and the first of the next block.
    """
    records, samples = a.shape
    # Blocks share a sample: the last one of a block is the first of the next.
    count = max(math.ceil((samples - 1) / _BLOCK), 1)
    padded = np.zeros((records, count * _BLOCK + 1))
    padded[:, :samples] = a
    # A view of every 32nd window; no samples are copied.
    blocks = np.lib.stride_tricks.sliding_window_view(padded, _BLOCK + 1, axis=1)[:, ::_BLOCK]
    inputs = np.zeros((_BLOCK + 3, records, count))
    inputs[2:] = blocks.transpose(2, 0, 1)
    return inputs, samples - 1 - (count - 1) * _BLOCK


def _responses(p: Floats, steps: int) -> Floats:
    """Return y = omega^2 u and z = omega u' at each step of a block, for each of its inputs.

    Steps p [rad]; shape (m, 1 + steps * _BLOCK, 2, 2 + _BLOCK + 1).
    """
    free, from_start, from_end = _step(p)
    made = np.zeros((p.size, 1 + steps * _BLOCK, 2, _BLOCK + 3))
    # The oscillator is linear, so its response is a sum of responses to unit inputs.
    made[:, 0, 0, 0] = made[:, 0, 1, 1] = 1.0
    for i in range(steps * _BLOCK):
        made[:, i + 1] = free @ made[:, i]
        first = 2 + i // steps
        # The record is linear within an interval: each step uses fractions of the samples before
        # and after it.
        start, end = (i % steps) / steps, (i % steps + 1) / steps
        made[:, i + 1, :, first] += (1.0 - start) * from_start + (1.0 - end) * from_end
        made[:, i + 1, :, first + 1] += start * from_start + end * from_end
    return made


def _step(p: Floats) -> tuple[Floats, Floats, Floats]:
    """Return what a step makes of y and z, of the record before it and of the record after it.

    Nigam and Jennings, Bull. Seism. Soc. Am. 59 (1969) 909-922, from the impulse response h and its
    integrals as in `solver.kernels.oscillator`.
    """
    h, once, twice = np.zeros((3, p.size))
    zeta = DAMPING
    term, ahead, power = 0.0, 1.0, np.ones(p.size)
    # As many terms as in the kernel: below one radian the last one is below 2e-24 of the first.
    for k in range(24):
        h += term * power
        once += term * power * p / (k + 1)
        twice += term * power * p**2 / ((k + 1) * (k + 2))
        term, ahead, power = ahead, -2.0 * zeta * ahead - term, power * p / (k + 1)
    # From one radian on the closed forms lose no digits, and the series would need more terms.
    kappa, decay, is_long = math.sqrt(1.0 - zeta * zeta), np.exp(-zeta * p), p >= 1.0
    h = np.where(is_long, decay * np.sin(kappa * p) / kappa, h)
    slope = np.where(is_long, decay * np.cos(kappa * p) - zeta * h, 1.0 - once - 2.0 * zeta * h)
    once = np.where(is_long, 1.0 - slope - 2.0 * zeta * h, once)
    twice = np.where(is_long, p - h - 2.0 * zeta * once, twice)
    free = np.array([[1.0 - once, h], [-h, slope]]).transpose(2, 0, 1)
    before = np.array([twice / p - once, once / p - h]).T
    return free, before, -np.array([twice / p, once / p]).T


def _states(end: Floats, samples: Floats) -> Floats:
    """Return y and z at the start of each block, from rest, shape (m, 2, c, b)."""
    forced = np.tensordot(end[:, :, 2:], samples, 1)
    states = np.zeros_like(forced)
    # The only loop over time: one product for each block of 32 samples.
    for b in range(samples.shape[2] - 1):
        states[..., b + 1] = end[:, :, :2] @ states[..., b] + forced[..., b]
    return states


def _peaks(response: Floats, p: float, inputs: Floats, last_steps: int, largest: Floats) -> Floats:
    """Return the largest |y| of records, shape (c,), with `left` steps in their last block."""
    # The longest step, to a power of two, that is 1/16 of a period at most.
    stride = 2 ** int(math.log2(min(max(2.0 * math.pi / PEAK_FINENESS / p, 1.0), _BLOCK)))
    y = np.tensordot(response[stride::stride, 0], inputs, 1)
    # The last block is filled up with zeros: what moves after the end of the record does not count.
    y[last_steps // stride :, :, -1] = 0.0
    # The strides omit the state at the start of the block, which is `inputs[0]`.
    highest = np.maximum(np.abs(y, out=y).max(0), np.abs(inputs[0]))
    peaks: Floats = highest.max(1)
    # From one of these to the next the response bends by y'' = -y - 2 zeta y' - a, and so do the
    # cubics through its steps: only blocks as near to the peak as that are looked at closely.
    # Between two points a distance h apart, a curve exceeds both by at most h^2 max |y''| / 8. The
    # factor here is twice 1/8, because the sum omits the term 2 zeta y'.
    bend = 0.25 * (stride * p) ** 2 * (peaks + largest)
    near = highest >= (peaks - bend)[:, None]
    # The strides may miss the end of the record within the last block.
    near[:, -1] = True
    record, block = np.nonzero(near)
    y, z = (response @ inputs[:, record, block]).transpose(1, 0, 2)
    rate = p if p <= 1.0 else 0.0  # over a longer step the cubic would invent peaks
    tops = _tops(y[:-1], y[1:], rate * z[:-1], rate * z[1:])
    tops[last_steps:, block == near.shape[1] - 1] = 0.0
    np.maximum.at(peaks, record, tops.max(0))
    return peaks


def _tops(start: Floats, end: Floats, first: Floats, last: Floats) -> Floats:
    """Return the largest size of cubics between values with these slopes, the start left out."""
    rise = end - start
    bend, twist = 3.0 * rise - 2.0 * first - last, first + last - 2.0 * rise
    tops = np.abs(end)
    with np.errstate(divide="ignore", invalid="ignore"):
        q = -bend - np.copysign(np.sqrt(np.maximum(bend**2 - 3.0 * twist * first, 0.0)), bend)
        for s in (q / (3.0 * twist), first / q):
            values = np.abs(start + s * (first + s * (bend + s * twist)))
            tops = np.where((s > 0.0) & (s < 1.0) & (values > tops), values, tops)
    return tops
