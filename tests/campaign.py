"""Calls a function in a child process that is ended where a call takes too long.

A compiled loop hears no signal and no exception: only another process can end it. Read `campaign`.
"""

import multiprocessing as mp
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from solver.model import Friction, coulomb
from solver.records.record import NO_RECORD, read_only
from solver.sliding.two_axes import follow
from solver.verification.random_pairs import pair
from solver.verification.study import flat_scene

LIMIT_S = 5.0
"""Of a call; the longest pair of runs takes a tenth of it."""

START_S = 120.0
"""For a child to start, compile and load."""

BATCH = 200


@dataclass(frozen=True)
class Ended:
    """A call and how it ended: with an outcome, or in words what went wrong."""

    arguments: tuple
    outcome: Any
    trouble: str


def run_pair(kind, index):
    """Run a pair of random scenes."""
    return pair(kind, index).run()


def warm_up():
    """Compile or load what pairs need: two axes with and without vertical, and both laws."""
    push = read_only(np.array([0.0, 5.0, -5.0, 0.0]))
    scene = flat_scene(push, push, 0.01, coulomb(0.2))
    law = Friction(mu_slow=0.2, mu_fast=0.3, rate_s_per_m=1.0, mu_static=0.2)
    for friction in (scene.friction, law):
        for az in (NO_RECORD, push):
            follow(replace(scene, friction=friction, az_mps2=az))


def campaign(function, calls, limit_s=LIMIT_S, prepare=warm_up):
    """Call a function of a module with each tuple of arguments; return how each call ended.

    `prepare` is called first, by each child. Where a batch does not end in time, its calls are made
    again one by one.
    """
    ended, pool = [], None
    batches = [calls[k : k + BATCH] for k in range(0, len(calls), BATCH)]
    while batches:
        batch = batches.pop(0)
        try:
            pool = pool or _started(prepare, function)
            many_s = limit_s * (1 if len(batch) == 1 else 10)
            ended += pool.apply_async(_run, (function, batch)).get(many_s)
            continue
        except mp.TimeoutError:
            pool.terminate()
            pool = None
        if len(batch) == 1:
            ended.append(Ended(batch[0], None, "hangs or dies"))
        else:
            batches[:0] = [[call] for call in batch]
    if pool:
        pool.terminate()
    return ended


def _started(prepare, function):
    """Return a pool of one child that is prepared and has loaded the module of the function."""
    pool = mp.get_context("spawn").Pool(1)
    pool.apply_async(prepare).get(START_S)
    pool.apply_async(_run, (function, [])).get(START_S)
    return pool


def _run(function, calls):
    ended = []
    for arguments in calls:
        try:
            ended.append(Ended(arguments, function(*arguments), ""))
        except Exception as error:
            ended.append(Ended(arguments, None, f"{type(error).__name__}: {error}"))
    return ended
