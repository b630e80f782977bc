"""Motions of three components for the comparison of models: generated, or recorded in a folder.

Runs nothing. Read `own_triples`, then `scene_of`.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np

from solver.formats import read_motion_file
from solver.model import (
    STANDARD_GRAVITY_MPS2,
    Friction,
    HorizontalComponent,
    InputError,
    Motion,
    Orientation,
    Scene,
)
from solver.records.record import Record, read_only
from solver.rivals.methods import NO_RECORD
from solver.sliding.checked import motion
from solver.verification.scenes import Case, own_suite, strongest

RECORDED = "recorded"
"""Source of the motions recorded in earthquakes; the others are generated."""

AS_RECORDED = Orientation(component=HorizontalComponent.RECORD, polarity=1)

_UP = ("up", "v", "ud", "vertical", "vert", "z")
"""Words in a channel's name that mark the vertical component."""


def scale_to(triple: Motion, ppa_g: float) -> float:
    """Return the factor that scales the larger horizontal peak to `ppa_g` [g]."""
    peak = max(float(np.abs(a).max()) for a in (triple.ax_mps2, triple.ay_mps2))
    return ppa_g * STANDARD_GRAVITY_MPS2 / peak


def scene_of(
    triple: Motion,
    case: Case,
    friction: Friction,
    orientation: Orientation = AS_RECORDED,
    *,
    second: bool = True,
    vertical: bool = True,
) -> Scene:
    """Return a case of a motion with all components, or without the second or vertical."""
    scene = triple.scene(orientation, slope_rad=case.slope_rad, friction=friction)
    return replace(
        scene,
        ay_mps2=scene.ay_mps2 if second else NO_RECORD,
        az_mps2=scene.az_mps2 if vertical else NO_RECORD,
        scale=scale_to(triple, case.ppa_g),
    )


def cut(triple: Motion, samples: int) -> Motion:
    """Return the `samples` consecutive samples with the most horizontal energy."""
    part = strongest(triple.ax_mps2**2 + triple.ay_mps2**2, samples)
    x, y, z = (read_only(a[part]) for a in triple.components.values())
    name = f"{triple.id}, strongest {(samples - 1) * triple.dt_s:g} s"
    return replace(triple, id=name, ax_mps2=x, ay_mps2=y, az_mps2=z)


def own_triples(quick: bool) -> tuple[Motion, ...]:
    """Return the project's generated motions, whose components match AC156 spectra."""
    return tuple(
        motion(*made.components, id=made.x.name.removesuffix("-x"), source="generated")
        for made in own_suite(quick)
    )


def recorded_triples(folder: Path) -> tuple[Motion, ...]:
    """Return the motions of all files below a folder that hold three components.

    Two horizontal components and one named up or vertical; files that cannot be read or have
    other channels are skipped.
    """
    triples = (_triple(path) for path in sorted(folder.rglob("*")) if path.is_file())
    return tuple(triple for triple in triples if triple is not None)


def _triple(path: Path) -> Motion | None:
    try:
        channels = read_motion_file(path).channels
        up = [channel for channel in channels if _is_vertical(channel)]
        level = [channel for channel in channels if not _is_vertical(channel)]
        if len(up) != 1 or len(level) != 2:
            return None
        return motion(*level, *up, id=path.stem, source=RECORDED)
    except InputError:
        return None


def _is_vertical(channel: Record) -> bool:
    words = channel.name.lower().replace(":", " ").replace("(", " ").split()
    return any(word in _UP for word in words)
