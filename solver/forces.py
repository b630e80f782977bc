"""Forces on a block at the samples: driving acceleration and normal force.

A roof of 2 degrees that accelerates 2.94 m/s2 upslope drives a block of 1 kg with 3.28 N downslope
and presses it with 9.70 N: it slides where mu is below 0.34.

Integrates no motion (`solver.sliding` does) and checks no input. Read `forces`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from solver.kernels import two_axes as kernel
from solver.model import Floats, Scene


@dataclass(frozen=True, slots=True, kw_only=True)
class Forces:
    """Forces per unit mass at the samples; each varies linearly between samples.

    Attributes
    ----------
    down_mps2, across_mps2 : array, shape (n,)
        Driving acceleration G = ((g + az) sin theta - ax cos theta, -ay), downslope and cross-slope
        [m/s2]; friction must resist it for the block to stay at rest.
    normal_mps2 : array, shape (n,)
        N / m = (g + az) cos theta + ax sin theta [m/s2].
    """

    down_mps2: Floats
    across_mps2: Floats
    normal_mps2: Floats


def friction_demand(scene: Scene) -> float:
    """Return the largest |G| / N; inf if the normal force is zero or negative at a sample.

    The maximum is at a sample: between samples the point G / N moves along a straight line.
    """
    sn, cs = math.sin(scene.slope_rad), math.cos(scene.slope_rad)
    demand: float = kernel.friction_demand(*components(scene), sn, cs, scene.g_mps2, scene.scale)
    return demand


def components(scene: Scene) -> tuple[Floats, Floats, Floats]:
    """Return the record along, across and up [m/s2]; zeros for missing components."""
    across, up = (
        record if record.size else _still(scene.ax_mps2.size)
        for record in (scene.ay_mps2, scene.az_mps2)
    )
    return scene.ax_mps2, across, up


# The runs of a project have few different lengths, so the zeros are created once per length.
@lru_cache(8)
def _still(size: int) -> Floats:
    still = np.zeros(size)
    still.setflags(write=False)  # as all records are: for another array numba compiles once more
    return still


def forces(scene: Scene) -> Forces:
    """Return the forces on a block (Eqs. 6-9 of the paper, with vertical acceleration added)."""
    ax, ay, az = map(scene.scaled, components(scene))
    # The roof's acceleration acts on the block as a force the other way, beside gravity.
    down = (scene.g_mps2 + az) * math.sin(scene.slope_rad) - ax * math.cos(scene.slope_rad)
    return Forces(down_mps2=down, across_mps2=-ay, normal_mps2=normal_mps2(scene))


def normal_mps2(scene: Scene) -> Floats:
    """Return N / m alone [m/s2], shape (n,)."""
    ax, _, az = components(scene)
    # Eq. 6 of the paper, where az is zero.
    gravity = scene.g_mps2 + scene.scaled(az)
    return gravity * math.cos(scene.slope_rad) + scene.scaled(ax) * math.sin(scene.slope_rad)
