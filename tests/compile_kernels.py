"""Compiles the kernels that tests of every day run and set-up does not.

Two processes of tests would compile each of them twice. Their parts are compiled side by side, each
kernel once; `tests/run.sh` does it before the tests. A kernel that is called with other types than
here is compiled by the test that calls it.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Mapping

import numpy as np

import solver
from solver.building.roof import absolute_accelerations
from solver.kernels import runge_kutta
from solver.rivals.methods import METHODS
from solver.sliding.row import BlockRow, row_history, slide_row
from solver.studies.lives import Draws, Responses, distances
from solver.verification.study_cases import samples_of

DT_S = 0.02
SHAKING = 6.0 * np.sin(np.arange(40) * 0.9)
ROOF = {"slope_rad": 0.03, "mu": 0.3}


def of_one_axis() -> None:
    """Each method, a history, sweeps."""
    for name, method in METHODS.items():
        vertical = {"az_mps2": 0.1 * SHAKING} if method.takes_vertical else {}
        for more in ({}, vertical):
            solver.slide(SHAKING, DT_S, **ROOF, **more, method=name)
    solver.slide_history(SHAKING, DT_S, **ROOF)
    for vertical in (None, 0.1 * SHAKING):
        solver.sweep(SHAKING, DT_S, slopes_rad=0.03, mus=0.3, scales=1.0, az_mps2=vertical)


def of_more() -> None:
    """A row of blocks, two axes by Runge-Kutta, lives of an array, oscillators of a building."""
    scene = solver.scene(SHAKING, DT_S, **ROOF)
    row = BlockRow(mus=(0.3, 0.4), stiffness_per_s2=1e3)
    slide_row(scene, row)
    row_history(scene, row)
    rows = samples_of(solver.scene(SHAKING, DT_S, **ROOF, ay_mps2=SHAKING))
    runge_kutta.slide_plane(rows, DT_S, 1.0, 5, 1e-6)
    absolute_accelerations(SHAKING, DT_S, [0.2, 0.5], [0.05, 0.05])
    one = np.zeros(1, dtype=np.int64)
    draws = Draws(
        first=np.array([0, 1]), friction=one, run=one, side=np.ones(1), intensity=np.ones(1)
    )
    responses = Responses(levels=np.array([[0.5, 2.0, 2.0]]), values=np.zeros((1, 1, 3, 6)))
    distances(draws, responses, np.inf)


# About equal in time; each new method of `solver.rivals.methods` is in the first.
PARTS: Mapping[str, Callable[[], None]] = {"axis": of_one_axis, "more": of_more}


if __name__ == "__main__":
    for part in sys.argv[1:]:
        PARTS[part]()
