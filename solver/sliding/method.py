"""Definition of a one-axis method, the exact method, and lookup of the others by name.

`methods()["paper"]` is the algorithm of Eqs. 1-19 of the paper, with `substeps` as its knob, which
an accuracy study sweeps from coarse to fine.

Checks no input (`solver.sliding.arguments`), builds no results (`solver.sliding.one_axis`) and
integrates nothing itself (`solver.kernels.one_axis`). The other methods, in
`solver.rivals.methods`, are loaded on first use. Read `Method` first.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from importlib import import_module
from types import MappingProxyType
from typing import NamedTuple

import numpy as np

from solver.kernels import one_axis
from solver.model import Floats

_RIVALS = "solver.rivals.methods"


@dataclass(frozen=True, slots=True)
class AxisScene:
    """One block under one motion, checked, in the notation of the kernels.

    `ax` and `az` are read-only; `az` has shape (0,) without vertical shaking. `x` and `z` are the
    `one_axis.bounds` of `ax` and `az`.
    """

    ax: Floats
    x: Floats
    az: Floats
    z: Floats
    dt: float
    sn: float
    cs: float
    mu: float
    g: float
    scale: float


class Outcome(NamedTuple):
    """Result of a method, along the slope: [m], [m/s], [s].

    The largest speed and the events come from the exact kernel, the events only if a history is
    requested: time, number of the kind and s, shape (m, 3). NaN and none without it.
    """

    followed: bool
    s_max: float
    s_min: float
    s_end: float
    w_end: float
    t_peak: float
    n_stops: int
    w_max: float = math.nan
    events: Floats = np.empty((0, 3))


Parameters = Mapping[str, float]
# Runs a scene. An array of shape (2, n) is filled with s and s' at the samples; (2, 0) is not.
Follow = Callable[[AxisScene, Parameters, Floats], Outcome]


@dataclass(frozen=True, slots=True, kw_only=True)
class Method:
    """One method to compute the motion of the block.

    Attributes
    ----------
    name, title, label : str
        Key, title, and label in a legend.
    parameters : mapping
        Its parameters with their defaults.
    knob : str
        The parameter that controls its accuracy; empty if there is none.
    sweep : tuple of float
        Values of that parameter from coarse to fine.
    order : float
        Formal order of the error in the sub-step for smooth motion; NaN if there is none. With
        stick-slip events every order drops to first.
    takes_vertical : bool
    invalid_when : str
        Conditions in which it should not be used, as a sentence.
    source : str
    link_steps_per_radian : float
        In a sweep (`settings`), sub-steps for each radian omega dt of the link; 0 without a link.
    follow : callable
        Given the `AxisScene`, the parameters by name, and an array of shape (2, n) that it fills
        with displacement [m] and velocity [m/s] along the slope, or of shape (2, 0).
    """

    name: str
    title: str
    label: str
    parameters: Parameters
    knob: str
    sweep: tuple[float, ...]
    order: float
    takes_vertical: bool
    invalid_when: str
    source: str
    link_steps_per_radian: float = 0.0
    follow: Follow

    def settings(self, value: float, dt_s: float, g_mps2: float) -> dict[str, float]:
        """Return all parameters for one value of the knob, with the sub-steps that a link needs."""
        parameters = dict(self.parameters) | {self.knob: value}
        if self.link_steps_per_radian:
            # A sub-step is 1 / omega at most: beyond 2 / omega the explicit link is unstable.
            radians = link_frequency(parameters["stiffness_per_m"], g_mps2) * dt_s
            parameters["substeps"] = max(1, math.ceil(radians * self.link_steps_per_radian))
        return parameters


def link_frequency(stiffness_per_m: float, g_mps2: float) -> float:
    """Return omega = sqrt(g k) [rad/s] of a block on a link, k its stiffness over the weight."""
    return math.sqrt(g_mps2 * stiffness_per_m)


def minimum_normal(scene: AxisScene) -> tuple[float, float]:
    """Return the least N / (m g), and when N first falls below zero [s]; NaN if it never does."""
    c, (az, z) = scene, _vertical(scene)
    n_min_and_time: tuple[float, float] = one_axis.minimum_normal(
        c.ax, az, c.x, z, c.dt, c.sn, c.cs, c.g, c.scale
    )
    return n_min_and_time


def _vertical(scene: AxisScene) -> tuple[Floats | None, Floats | None]:
    """Return the vertical record and its bounds as the exact kernels take them."""
    return (scene.az, scene.z) if scene.az.size else (None, None)


def _run_exact(
    scene: AxisScene, events: Floats | None
) -> tuple[float, float, float, float, float, int, float, int]:
    c, (az, z) = scene, _vertical(scene)
    result: tuple[float, float, float, float, float, int, float, int] = one_axis.slide_exact(
        c.ax, az, c.x, z, c.dt, c.sn, c.cs, c.mu, c.g, c.scale, events
    )
    return result


def _exact(scene: AxisScene, _: Parameters, samples: Floats) -> Outcome:
    c, outcome = scene, Outcome(True, *_run_exact(scene, None)[:-1])
    if not samples.size:
        return outcome
    # A second run, of which the first has told the room: a slip before each stop, and one that may
    # go on at the end.
    rows = np.empty((2 * outcome.n_stops + 1, 3))
    events = rows[: _run_exact(scene, rows)[-1]]
    one_axis.fill_history(
        c.ax, _vertical(c)[0], c.dt, c.sn, c.cs, c.mu, c.g, c.scale, events, samples
    )
    # As the run has them, so that history and result agree to the last bit.
    samples[:, -1] = outcome.s_end, outcome.w_end
    return outcome._replace(events=events)


EXACT = Method(
    name="exact",
    title="Exact, event by event",
    label="exact",
    parameters=MappingProxyType({}),
    knob="",
    sweep=(),
    order=math.nan,
    takes_vertical=True,
    invalid_when="Never, if the model is one rigid block with one friction coefficient.",
    source="solver.kernels.one_axis.slide_exact: roots of the cubic motion between samples",
    follow=_exact,
)


def methods() -> Mapping[str, Method]:
    """Return every method by its name, the exact one first."""
    # Imported by name: the core must not import its extras (checked by import-linter).
    by_name: Mapping[str, Method] = import_module(_RIVALS).METHODS
    return by_name


_WHOLE = "a whole number of 1 or more"
_POSITIVE = "a finite number above 0"
_TOLERANCE = "a number from 1e-13 to 0.1"
# What each parameter accepts, in words and as a test.
WANTED: Mapping[str, tuple[str, Callable[[float], bool]]] = {
    "substeps": (_WHOLE, lambda v: v >= 1.0 and v.is_integer()),
    "stiffness_per_m": (_POSITIVE, lambda v: 0.0 < v < math.inf),
    "velocity_mps": (_POSITIVE, lambda v: 0.0 < v < math.inf),
    "tolerance": (_TOLERANCE, lambda v: 1e-13 <= v <= 0.1),
}

# What a parameter of a method of your own accepts.
ANY_NUMBER = ("a finite number", math.isfinite)
