"""Compiles the kernels that a report runs, so that the first report does not wait for them.

Set-up runs both parts, each in a process of its own: `python -m solver.sliding.compiled PART`. What
one axis needs without a vertical component is compiled when it first occurs. Read `PARTS`.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Mapping

import numpy as np

from solver.model import Friction, coulomb
from solver.records.spectrum import response_spectrum
from solver.rivals.methods import METHODS
from solver.sliding.checked import history, scene, slide, solve

_DT_S = 0.02
_SHAKING = 6.0 * np.sin(np.arange(40) * 0.9)
_VARYING = Friction(mu_slow=0.3, mu_fast=0.4, mu_static=0.35, rate_s_per_m=20.0)


def _plane(friction: Friction) -> None:
    """Solve and follow a motion of three components."""
    shaken = scene(
        _SHAKING,
        _DT_S,
        slope_rad=0.03,
        mu=friction,
        ay_mps2=_SHAKING[::-1],
        az_mps2=0.1 * _SHAKING,
    )
    history(shaken, solve(shaken))


def constant_friction() -> None:
    """Two axes, and one, with constant friction."""
    _plane(coulomb(0.3))
    slide(_SHAKING, _DT_S, slope_rad=0.03, mu=0.3, az_mps2=0.1 * _SHAKING)


def the_rest() -> None:
    """Two axes with a friction law, response spectra, and the other methods but the slowest."""
    _plane(_VARYING)
    response_spectrum(_SHAKING, _DT_S, [0.5, 1.0])
    for name in METHODS.keys() - {"exact", "regularized", "paper"}:
        slide(_SHAKING, _DT_S, slope_rad=0.03, mu=0.3, az_mps2=0.1 * _SHAKING, method=name)


PARTS: Mapping[str, Callable[[], None]] = {
    "constant": constant_friction,
    "rest": the_rest,
}
"""About equal in time, so that two processes finish together."""


if __name__ == "__main__":
    PARTS[sys.argv[1]]()
