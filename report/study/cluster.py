"""The parts of a study on an existing Dask cluster; each comes back and is kept here.

The workers need no common folder. Read `connected`, then `run_on_cluster`.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from itertools import islice
from pathlib import Path
from typing import Any

from report.study.extra import DASK, extra
from report.study.manifest import program, unlike
from report.study.parts import OnDone, costliest_first, keep, made_part
from solver.model import InputError
from solver.studies.campaign import Campaign
from solver.studies.runs import Runner

TIMEOUT_S = 10.0
"""How long a scheduler may take to answer [s]."""

ROUNDS = 4
"""How often a part is sent out: a worker that dies may take the records of others with it."""

_AHEAD = 2
"""Parts sent out for each thread of the cluster: no thread waits, and few results do."""


@contextmanager
def connected(address: str, manifest: Mapping[str, Any]) -> Iterator[Any]:
    """Yield a client of a cluster whose workers agree with this program.

    Raises
    ------
    InputError
        If no scheduler answers, it has no worker, or a worker has other versions.
    """
    distributed = extra(DASK)
    try:
        client = distributed.Client(address, timeout=TIMEOUT_S, set_as_default=False)
    except (OSError, ValueError, TypeError, RuntimeError) as error:
        raise InputError(
            f"--scheduler {address}: no Dask scheduler answers within {TIMEOUT_S:g} s "
            f"({type(error).__name__}); start one with: dask scheduler, and workers with: dask "
            f"worker {address}"
        ) from error
    try:
        _check_workers(client, address, manifest["program"])
        yield client
    finally:
        client.close()


def _check_workers(client: Any, address: str, here: Mapping[str, str]) -> None:
    there = client.run(program, on_error="return")
    if not there:
        raise InputError(
            f"--scheduler {address}: has no worker; start some with: dask worker {address}"
        )
    problems = []
    for worker, found in sorted(there.items()):
        if not isinstance(found, dict):
            problems.append(f"worker {worker}: cannot import this program ({found})")
        elif off := unlike(found, here):
            problems.append(f"worker {worker}: has {off}")
    if problems:
        raise InputError([*problems, "install the same versions on every worker, then try again"])


def run_on_cluster(
    client: Any,
    folder: Path,
    campaign: Campaign,
    identity: str,
    names: Sequence[str],
    missing: Sequence[int],
    key: bytes,
    on_done: OnDone,
) -> None:
    """Run parts on a cluster; sign and keep each here as it comes back.

    Raises
    ------
    Exception
        Of a part that fails in every round.
    """
    left = list(missing)
    errors: list[BaseException] = []
    for turn in range(ROUNDS):
        errors = []
        for number, outcome in _sent(client, campaign, identity, names, left, turn):
            if isinstance(outcome, BaseException):
                errors.append(outcome)
                continue
            on_done(keep(folder, outcome, key))
            left.remove(number)
        if not left:
            return
    raise errors[0]


def _sent(
    client: Any,
    campaign: Campaign,
    identity: str,
    names: Sequence[str],
    numbers: Sequence[int],
    turn: int,
) -> Iterator[tuple[int, Any]]:
    """Yield each part with its outcome, or with the error that ended it."""
    waiting = iter(costliest_first(campaign, numbers))
    runner = client.scatter(Runner(campaign), broadcast=True, hash=False)
    sent: dict[Any, int] = {}

    def send(count: int) -> list[Any]:
        futures = []
        for number in islice(waiting, count):
            key = f"part-{number}-{turn}-{identity[:16]}"
            futures.append(
                client.submit(made_part, runner, number, identity, names, key=key, retries=2)
            )
            sent[futures[-1]] = number
        return futures

    threads = sum(client.nthreads().values())
    ahead = send(_AHEAD * max(1, threads))
    completed = extra(DASK).as_completed(ahead, loop=client.loop)
    for future in completed:
        number = sent.pop(future)
        try:
            yield number, future.result()
        except Exception as error:  # whatever a worker raises, or its death
            yield number, error
        future.release()
        for more in send(1):
            completed.add(more)
