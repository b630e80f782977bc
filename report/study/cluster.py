"""Runs the batches of a study on an existing Dask cluster; each is returned and stored here."""

from __future__ import annotations

import warnings
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from report.study.manifest import program, version_differences
from report.study.optional_packages import DASK, optional_package
from report.study.parquet_parts import OnDone, keep, made_part, mixed
from solver.errors import InputError
from solver.studies.campaign import Campaign
from solver.studies.runs import Runner

TIMEOUT_S = 10.0
# Of a part whose worker died: the scheduler gives it to another one.
RETRIES = 2


@contextmanager
def connected(address: str, manifest: Mapping[str, Any]) -> Iterator[Any]:
    """Yield a client of a cluster whose workers agree with this program.

    Raises `InputError` if no scheduler answers, it has no worker, or a worker has other versions.
    """
    distributed = optional_package(DASK)
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


def _check_workers(client: Any, address: str, versions_here: Mapping[str, str]) -> None:
    # Another version of the solver, or of numpy or numba, may round otherwise: rows of one study
    # would not be of one program.
    versions_of_workers = client.run(program, on_error="return")
    if not versions_of_workers:
        raise InputError(
            f"--scheduler {address}: has no worker; start some with: dask worker {address}"
        )
    problems = []
    for worker, versions in sorted(versions_of_workers.items()):
        if not isinstance(versions, dict):
            problems.append(f"worker {worker}: cannot import this program ({versions})")
            continue
        differences = version_differences(versions, versions_here)
        if differences:
            problems.append(f"worker {worker}: has {differences}")
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
    """Run parts on a cluster; sign and keep each here as it comes back."""
    # The records are the result of a task, as the parts are: with a worker that dies both are lost,
    # and both are computed again by another one.
    with warnings.catch_warnings():
        # The campaign has the records in it: it is large, and is sent once.
        warnings.filterwarnings("ignore", "Sending large graph", UserWarning)
        runner = client.submit(Runner, campaign, pure=False)
        parts = [
            client.submit(made_part, runner, number, identity, names, pure=False, retries=RETRIES)
            for number in mixed(missing)
        ]
    for part in optional_package(DASK).as_completed(parts, loop=client.loop):
        on_done(keep(folder, part.result(), key))
        # Kept here: the cluster may forget it.
        part.release()
