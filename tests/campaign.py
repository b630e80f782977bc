"""Calls a function in a child process that is ended where a call takes too long.

A compiled loop hears no signal and no exception: only another process can end it. Read `campaign`.
"""

import multiprocessing as mp
import time
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from solver.model import Friction, coulomb
from solver.records.record import read_only
from solver.rivals.methods import NO_RECORD
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

    `prepare` is called first, by each child. Results come in batches: those that a child had not
    sent when it was ended are made again.
    """
    context, ended = mp.get_context("spawn"), []
    while len(ended) < len(calls):
        at, (here, there) = context.Value("q", -1), context.Pipe(duplex=False)
        left, before = calls[len(ended) :], len(ended)
        child = context.Process(
            target=_child, args=(prepare, function, left, at, there), daemon=True
        )
        child.start()
        there.close()
        stuck = _receive(here, at, ended, limit_s)
        child.kill()
        child.join()
        if stuck >= 0:
            lost = calls[len(ended) : before + stuck]
            ended += campaign(function, lost, limit_s, prepare) if lost else []
            ended.append(Ended(calls[before + stuck], None, "hangs or dies"))
    return ended


def _receive(here, at, ended, limit_s):
    """Receive results until the child is done (-1), or its call number n takes too long (n)."""
    last, since = -1, time.monotonic()
    while True:
        if here.poll(0.1):
            try:
                batch = here.recv()
            except EOFError:
                return max(at.value, 0)
            if batch is None:
                return -1
            ended += batch
        if at.value != last:
            last, since = at.value, time.monotonic()
        elif time.monotonic() - since > (limit_s if last >= 0 else START_S):
            return max(last, 0)


def _child(prepare, function, calls, at, there):
    prepare()
    batch = []
    for position, arguments in enumerate(calls):
        at.value = position
        try:
            batch.append(Ended(arguments, function(*arguments), ""))
        except Exception as error:
            batch.append(Ended(arguments, None, f"{type(error).__name__}: {error}"))
        if len(batch) == BATCH:
            there.send(batch)
            batch = []
    there.send(batch)
    there.send(None)
