"""Lives of a few events whose distances are known by hand."""

import math

import numpy as np
import pytest

from solver.kernels.lives import live

pytestmark = pytest.mark.quick

NEVER = math.inf
# Half-way from level 0 to 1: PRD 5, 4 down, 1 up and 2 across, residuals 3 down and 2 across.
RESPONSES = np.array([[[[4.0, 3.0, 1.0, 2.0, 2.0, 2.0], [6.0, 5.0, 1.0, 2.0, 4.0, 2.0],
                        [np.nan] * 6]]])  # fmt: skip


def lived(levels, sides, recenter=NEVER):
    """Return the largest and the last distance of one life of events half-way between levels."""
    out, only = np.empty((2, 1)), np.zeros(1, dtype=np.int64)
    run, level = np.zeros(len(levels), dtype=np.int64), np.array(levels, dtype=np.int64)
    first, weight = np.array([0, len(levels)]), np.full(len(levels), 0.5)
    live(first, only, run, level, weight, np.array(sides), RESPONSES, recenter, out)
    return tuple(out[:, 0])


def test_places_add_until_an_array_is_put_back():
    # Its PRD of 5, or the corner of 4 down and 2 across, which is nearer.
    assert lived([0], [1.0]) == pytest.approx((math.hypot(4.0, 2.0), math.hypot(3.0, 2.0)))
    largest, last = lived([0, 0], [1.0, -1.0])
    assert last == pytest.approx(6.0)
    # From (3, 2): the PRD from there, or the corner (3 + 4, 2 + 2).
    assert largest == pytest.approx(min(math.hypot(3.0, 2.0) + 5.0, math.hypot(7.0, 4.0)))
    assert lived([0, 0], [1.0, 1.0], recenter=3.0) == pytest.approx((math.hypot(4.0, 2.0), 0.0))
    assert lived([], []) == (0.0, 0.0)


@pytest.mark.parametrize("levels", [[-1], [1], [0, -1]])
def test_an_event_without_a_response_has_no_distance(levels):
    assert lived(levels, [1.0] * len(levels)) == (math.inf, math.inf)
