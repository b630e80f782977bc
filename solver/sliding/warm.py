"""Run at set-up, so that the first report does not wait for the kernels to compile.

`python -m solver.sliding.warm constant law` compiles everything that a report needs and caches it
on disk.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Mapping

import numpy as np

from solver.forces import friction_demand
from solver.model import Friction, Scene, coulomb
from solver.records.spectrum import response_spectrum
from solver.sliding import two_axes
from solver.sliding.checked import history, scene, slide, solve

_DT_S = 0.02
# Strong enough to slip: a block that stays at rest would call few of the kernels.
_SHAKING = 6.0 * np.sin(np.arange(40) * 0.9)
_VARYING = Friction(mu_slow=0.3, mu_fast=0.4, mu_static=0.35, rate_s_per_m=20.0)


def _shaken(friction: Friction) -> Scene:
    """Return a block under a motion of three components."""
    return scene(
        _SHAKING, _DT_S, slope_rad=0.03, mu=friction, ay_mps2=_SHAKING[::-1], az_mps2=0.1 * _SHAKING
    )


def constant_friction() -> None:
    """Two axes, and one, with constant friction."""
    shaken = _shaken(coulomb(0.3))
    history(shaken, solve(shaken))
    friction_demand(shaken)  # which tipping is computed from
    slide(_SHAKING, _DT_S, slope_rad=0.03, mu=0.3, az_mps2=0.1 * _SHAKING)


def friction_law() -> None:
    """Two axes with a friction law, without the parts compiled by the other; response spectra."""
    two_axes.follow(_shaken(_VARYING))
    response_spectrum(_SHAKING, _DT_S, [0.5, 1.0])


# About equal in time, so that two processes finish together.
PARTS: Mapping[str, Callable[[], None]] = {"constant": constant_friction, "law": friction_law}

if __name__ == "__main__":
    for part in sys.argv[1:]:
        PARTS[part]()
