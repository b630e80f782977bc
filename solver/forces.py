"""What a plane hands to a block at the samples: driving acceleration and normal force.

Follows no motion (`solver.kernels.one_axis`, `solver.kernels.two_axes`, `solver.kernels.row` do)
and checks no input. Read `forces`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from solver.model import Floats, Scene


@dataclass(frozen=True, slots=True, kw_only=True)
class Forces:
    """Forces on a unit of mass at the samples; each is a straight line between them.

    Attributes
    ----------
    down_mps2, across_mps2 : array, shape (n,)
        Driving acceleration G = ((g + az) sin theta - ax cos theta, -ay), down the slope and
        across it [m/s2]; what friction has to hold.
    normal_mps2 : array, shape (n,)
        N / m = (g + az) cos theta + ax sin theta [m/s2].
    """

    down_mps2: Floats
    across_mps2: Floats
    normal_mps2: Floats

    @property
    def friction_demand(self) -> float:
        """Largest |G| / N; inf where the normal force vanishes.

        Between samples it is less: G / N runs along a straight line there.
        """
        if np.min(self.normal_mps2) <= 0.0:
            return math.inf
        return float(np.max(np.hypot(self.down_mps2, self.across_mps2) / self.normal_mps2))


def forces(scene: Scene) -> Forces:
    """Return what the plane hands to a block (Eqs. 6-9 of the paper, with the vertical added)."""
    sn, cs = math.sin(scene.slope_rad), math.cos(scene.slope_rad)
    ax = scene.scale * scene.ax_mps2
    gravity = scene.g_mps2 + (scene.scale * scene.az_mps2 if scene.az_mps2.size else 0.0 * ax)
    across = -scene.scale * scene.ay_mps2 if scene.ay_mps2.size else 0.0 * ax
    return Forces(
        down_mps2=gravity * sn - ax * cs,
        across_mps2=across,
        normal_mps2=gravity * cs + ax * sn,
    )
