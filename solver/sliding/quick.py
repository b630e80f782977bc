"""Fast path of `slide` for one record, a slope and a friction coefficient that are plainly valid.

    record of `read_record`, mu = 0.4, a slope of 2 degrees:  a quarter of the time with all checks,
    two fifths where its array can be written to, so that no bounds are kept

Reports no errors: for anything else it returns None, and `solver.sliding.arguments` then finds
every fault. Bit-identical to the full path.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from solver.kernels import one_axis as kernel
from solver.model import Floats, SlideResult
from solver.records.record import Record, read_only
from solver.sliding import one_axis
from solver.sliding.arguments import is_in_range
from solver.sliding.method import Outcome

# No other type, not one derived: a boolean is an int, and is refused by the checks.
_NUMBERS = {float, np.float64, int}
_ROOM = 64  # records that are kept: a few suites


class _Prepared(NamedTuple):
    """Data common to all runs of a record, and the record itself, so that its id is not reused."""

    record: Record
    a_mps2: Floats
    bounds: Floats
    peak_mps2: float
    lasts_s: float


_kept: dict[int, _Prepared] = {}


def quick_slide(
    record: Record, slope_rad: float, mu: float, scale: float, g_mps2: float
) -> SlideResult | None:
    """Return the run of a record in one axis by the exact method; None if it needs the checks."""
    if not {type(slope_rad), type(mu), type(scale), type(g_mps2)} <= _NUMBERS:
        return None
    if not (abs(slope_rad) < math.pi / 2 and 0.0 <= mu < math.inf and g_mps2 > 0.0):
        return None
    # By identity: a hash of the samples would take longer than the run.
    known = _kept.get(id(record)) or _prepared(record)
    if known is None:
        return None
    _, a, x, peak_mps2, lasts_s = known
    largest_mps2, dt = (abs(scale) * peak_mps2 + g_mps2) * (1.0 + mu), record.dt_s
    # Also false for a factor or a gravity that is not finite.
    if not is_in_range(largest_mps2, dt, lasts_s):
        return None
    n_min_g, cs, error_m, *run = kernel.slide_checked(
        a, None, x, None, dt, slope_rad, mu, g_mps2, scale
    )
    outcome = Outcome(True, *run)
    if n_min_g < 0.0 or not outcome.s_max - outcome.s_min < math.inf:
        return None
    return one_axis.result_of(outcome, cs, n_min_g, error_m)


def _prepared(record: Record) -> _Prepared | None:
    """Return a record with its bounds, cached if it is read-only; None if it is unusual."""
    a, dt = record.a_mps2, record.dt_s
    if not (type(a) is np.ndarray and a.dtype == np.float64 and a.ndim == 1 and a.size > 1):
        return None
    if not (a.flags.c_contiguous and type(dt) in _NUMBERS and 0.0 < dt < math.inf):
        return None
    samples = read_only(a)
    x = kernel.bounds(samples)
    # The last column is that of the whole record. Samples that are not finite make it so, or NaN.
    peak = float(max(-x[0, -1], x[1, -1]))
    if not peak < math.inf or not np.isfinite(samples).all():
        return None
    prepared = _Prepared(record, samples, x, peak, (a.size - 1) * dt)
    # A view may change with the array that it is of.
    if not a.flags.writeable and a.base is None:
        if len(_kept) >= _ROOM:
            _kept.clear()
        _kept[id(record)] = prepared
    return prepared
