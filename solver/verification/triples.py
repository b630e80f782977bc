"""Motions of three components for the comparison of models: generated, or recorded in a folder.

Runs nothing. Read `own_triples`, then `Triple.scene`.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from solver.formats import read_motion_file
from solver.model import STANDARD_GRAVITY_MPS2, Floats, Friction, InputError, Orientation, Scene
from solver.records.record import Record, read_only
from solver.rivals.methods import NO_RECORD
from solver.verification.scenes import Case, own_suite, strongest

_UP = ("up", "v", "ud", "vertical", "vert", "z")
"""Words in a channel's name that mark the vertical component."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Triple:
    """Two horizontal components and the vertical one, over the same time."""

    name: str
    is_recorded: bool  # in an earthquake; otherwise generated
    dt_s: float
    # shape (n,): read-only [m/s2]
    x_mps2: Floats
    y_mps2: Floats
    z_mps2: Floats

    def turned(self, orientation: Orientation) -> Triple:
        """Return the motion at an orientation: components along and across the slope."""
        x, y = (
            (self.y_mps2, self.x_mps2) if orientation.is_transverse else (self.x_mps2, self.y_mps2)
        )
        return replace(self, x_mps2=read_only(orientation.polarity * x), y_mps2=y)

    def scale_to(self, ppa_g: float) -> float:
        """Return the factor that scales the larger horizontal peak to `ppa_g` [g]."""
        peak = max(float(np.abs(a).max()) for a in (self.x_mps2, self.y_mps2))
        return ppa_g * STANDARD_GRAVITY_MPS2 / peak

    def scene(
        self, case: Case, friction: Friction, *, second: bool = True, vertical: bool = True
    ) -> Scene:
        """Return a case of this motion with all components, or without the second or vertical."""
        return Scene(
            ax_mps2=self.x_mps2,
            ay_mps2=self.y_mps2 if second else NO_RECORD,
            az_mps2=self.z_mps2 if vertical else NO_RECORD,
            dt_s=self.dt_s,
            slope_rad=case.slope_rad,
            friction=friction,
            scale=self.scale_to(case.ppa_g),
            g_mps2=STANDARD_GRAVITY_MPS2,
        )

    def cut(self, samples: int) -> Triple:
        """Return the `samples` consecutive samples with the most horizontal energy."""
        part = strongest(self.x_mps2**2 + self.y_mps2**2, samples)
        x, y, z = (read_only(a[part]) for a in (self.x_mps2, self.y_mps2, self.z_mps2))
        name = f"{self.name}, strongest {(samples - 1) * self.dt_s:g} s"
        return replace(self, name=name, x_mps2=x, y_mps2=y, z_mps2=z)


def own_triples(quick: bool) -> tuple[Triple, ...]:
    """Return the project's generated motions, whose components match AC156 spectra."""
    return tuple(
        Triple(
            name=motion.x.name.removesuffix("-x"),
            is_recorded=False,
            dt_s=motion.x.dt_s,
            x_mps2=motion.x.a_mps2,
            y_mps2=motion.y.a_mps2,
            z_mps2=motion.z.a_mps2,
        )
        for motion in own_suite(quick)
    )


def recorded_triples(folder: Path) -> tuple[Triple, ...]:
    """Return the motions of all files below a folder that hold three components.

    Two horizontal components and one named up or vertical; files that cannot be read or have
    other channels are skipped.
    """
    triples = (_triple(path) for path in sorted(folder.rglob("*")) if path.is_file())
    return tuple(triple for triple in triples if triple is not None)


def _triple(path: Path) -> Triple | None:
    try:
        channels = read_motion_file(path).channels
    except InputError:
        return None
    up = [channel for channel in channels if _is_vertical(channel)]
    level = [channel for channel in channels if not _is_vertical(channel)]
    if len(up) != 1 or len(level) != 2:
        return None
    return Triple(
        name=path.stem,
        is_recorded=True,
        dt_s=up[0].dt_s,
        x_mps2=level[0].a_mps2,
        y_mps2=level[1].a_mps2,
        z_mps2=up[0].a_mps2,
    )


def _is_vertical(channel: Record) -> bool:
    words = channel.name.lower().replace(":", " ").replace("(", " ").split()
    return any(word in _UP for word in words)
