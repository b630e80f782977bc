"""Slips of a run, and the forces on the block that slides, as its model has them.

Integrates nothing and finds no event: both come from the solver. Read `run_forces`.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from report.runs import OrientedRun
from solver.forces import Forces, forces
from solver.model import Event, EventKind, Floats, Scene, SlideHistory
from solver.records.record import NO_RECORD
from solver.sliding import model_selection
from solver.sliding.model_selection import Model

Slip = tuple[Event, Event]
"""Begin and end of a slip."""


def run_forces(
    run: OrientedRun, history: SlideHistory, slips: Sequence[Slip]
) -> tuple[Floats, Floats, Floats]:
    """Return N / W, required friction |G| / N and friction used F / N at the samples, as modeled.

    While the block slips, the friction used is the coefficient at its speed along the surface; at
    rest it is the demand. NaN where the normal force is zero or negative, and the friction used
    also where the run gives no displacement.
    """
    scene = _modeled(run)
    acting = forces(scene)
    demand = _demand_at(acting, np.arange(acting.normal_mps2.size, dtype=np.float64))
    across = history.across_mps if history.across_mps.size else 0.0
    # The history is in plan: along the slope it is longer by 1 / cos θ.
    speed = np.hypot(history.v_mps / math.cos(scene.slope_rad), across)
    law = scene.friction
    # μ(v) = μ_fast − (μ_fast − μ_slow) exp(−r v), as in `solver.model.Friction`.
    drop = law.mu_fast - law.mu_slow
    sliding = law.mu_fast - drop * np.exp(-law.rate_s_per_m * speed)
    used = np.where(during(slips, history.t_s), sliding, demand)
    used[np.isnan(demand) | np.isnan(history.u_m)] = math.nan
    return acting.normal_mps2 / scene.g_mps2, demand, used


def with_jumps(run: OrientedRun, used: Floats, events: Sequence[Event]) -> tuple[Floats, Floats]:
    """Return the friction used with its jumps where a slip begins and ends, between samples.

    Returns
    -------
    tuple of array, shape (k,)
        Numbers of samples, ascending, and values; a jump has two values at one number.
    """
    law, dt_s = _modeled(run).friction, run.scene.dt_s
    samples = np.arange(used.size)
    jumps = np.array([event.t_s for event in events]) / dt_s
    # Where the block turns back at once, the demand is above what friction can give at rest.
    at_rest = np.minimum(_demand_at(forces(_modeled(run)), jumps), law.mu_static)
    begins = [event.kind is EventKind.SLIP for event in events]
    # Slip begins from the demand at rest and ends at no speed, with the slow coefficient.
    before = np.where(begins, at_rest, law.mu_slow)
    after = np.where(begins, law.mu_slow, at_rest)
    i, v = np.concatenate([samples, jumps, jumps]), np.concatenate([used, before, after])
    # Stable: of two values at one number the one before the jump stays first.
    order = np.argsort(i, kind="stable")
    return i[order], v[order]


def _demand_at(acting: Forces, places: Floats) -> Floats:
    """Return the friction demand between samples, where forces are linear; NaN without contact."""
    samples = np.arange(acting.normal_mps2.size)
    down, across, normal = (
        np.interp(places, samples, force)
        for force in (acting.down_mps2, acting.across_mps2, acting.normal_mps2)
    )
    demand = np.full(normal.size, math.nan)
    np.divide(np.hypot(down, across), normal, out=demand, where=normal > 0.0)
    return demand


def _modeled(run: OrientedRun) -> Scene:
    """Return the scene of a run without the components that its model neglects."""
    model = run.solution.model
    scene = model_selection.as_run(run.scene, model)
    if model in (Model.ONE_AXIS, Model.ONE_AXIS_VERTICAL):
        return replace(scene, ay_mps2=NO_RECORD)
    return scene


def during(slips: Sequence[Slip], t_s: Floats) -> NDArray[np.bool_]:
    """Return at which times the block slips, ends included."""
    begun = np.searchsorted([begin.t_s for begin, _ in slips], t_s, side="right")
    ended = np.searchsorted([end.t_s for _, end in slips], t_s, side="left")
    return np.asarray(begun > ended)


def slips_of(history: SlideHistory) -> list[Slip]:
    """Return each slip with its end; a last one without a stop lasts to the end of the record."""
    slips: list[Slip] = []
    begun: list[Event] = []
    for event in history.events:
        if event.kind is EventKind.SLIP:
            begun.append(event)
        else:
            slips.append((begun.pop(), event))
    across = history.across_m[-1] if history.across_m.size else 0.0
    last = Event(float(history.t_s[-1]), EventKind.STOP, float(history.u_m[-1]), float(across))
    return slips + [(event, last) for event in begun]
