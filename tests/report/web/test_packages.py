"""Packages of a session, with processes that only wait."""

import asyncio
import errno
import sys
from asyncio.subprocess import PIPE
from dataclasses import replace
from pathlib import Path

import pytest

from report.making import Step
from report.web.maker import in_words, outcome
from report.web.packages import Packages, State
from report.web.sessions import Session
from solver.model import InputError

SESSION = Session(id="s", folder=Path("/nowhere"), used_s=0.0)


async def waiting(code):
    """Start a process that runs some Python in place of a package."""
    return await asyncio.create_subprocess_exec(
        sys.executable, "-I", "-S", "-c", code, stdout=PIPE, start_new_session=True
    )


def test_a_package_that_is_canceled_while_its_process_starts_leaves_no_process():
    started = []

    async def slow(package):
        await packages.cancel(package)
        started.append(await waiting("import time; time.sleep(60)"))
        return started[0]

    packages = Packages(slow)

    async def run():
        package = packages.begin(SESSION, Path("/nowhere/p/input.xlsx"), {})
        async with asyncio.timeout(20.0):
            while package.state is State.QUEUED or not started:
                await asyncio.sleep(0.01)
            await started[0].wait()
        await packages.stop()
        return package.state

    assert asyncio.run(run()) is State.CANCELED


def test_a_step_is_named_in_a_sentence_without_what_compiles():
    step = Step("running the motions", hint="the first run compiles the solver")
    assert str(step) == "running the motions (the first run compiles the solver)"
    assert in_words(step) == "Running the motions"
    long = replace(step, cost="about 3 minutes")
    assert in_words(long) == "Running the motions (about 3 minutes)"
    assert str(long) == "running the motions (about 3 minutes)"


def full():
    raise OSError(errno.ENOSPC, "No space left on device")


def full_folder():
    try:
        full()
    except OSError as error:
        raise InputError("/srv/out: cannot be written; choose another folder with --out") from error


@pytest.mark.parametrize("fails", [full, full_folder])
def test_a_full_disk_is_the_reason_that_a_package_failed(fails, capsys):
    assert outcome(fails)["message"].startswith("The disk of the server is full")
    assert capsys.readouterr().err == ""


def test_the_last_five_packages_of_a_session_are_kept():
    async def at_once(package):
        return await waiting("""print('{"stage": "done"}')""")

    async def run():
        packages = Packages(at_once)
        found = []
        for k in range(7):
            found.append(packages.begin(SESSION, Path(f"/nowhere/{k}/input.xlsx"), {}))
            while not found[-1].state.is_over:
                await asyncio.sleep(0.01)
        assert {one.state for one in found} == {State.DONE}
        return [packages.find(SESSION, one.ticket) is not None for one in found]

    assert asyncio.run(run()) == [False] * 2 + [True] * 5
