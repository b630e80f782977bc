"""Packages of a session, with processes that only wait."""

import asyncio
import errno
from concurrent.futures import Future
from dataclasses import replace
from pathlib import Path

import pytest

from processes import SameProcess
from report.making import Step
from report.web.packages import Packages, State
from report.web.sessions import Session
from report.web.worker import in_words, made
from solver.model import DefectError, InputError

SESSION = Session(id="s", folder=Path("/nowhere"), used_s=0.0)


class Making(SameProcess):
    """A process that makes a package until it is ended."""

    def __init__(self):
        self.result = Future()

    def submit(self, fn, *args):
        return self.result

    def shutdown(self, wait=True):
        if not self.result.done():
            self.result.set_exception(DefectError("ended"))


def test_a_package_that_is_canceled_while_it_is_made_leaves_no_process(monkeypatch):
    process = Making()
    monkeypatch.setattr("report.web.packages.making", lambda *_: process)

    async def run():
        packages = Packages()
        package = packages.begin(SESSION, Path("/nowhere/p/input.xlsx"), {})
        async with asyncio.timeout(20.0):
            while package.worker is None:
                await asyncio.sleep(0.01)
            await packages.cancel(package)
        await packages.stop()
        return package.state, package.words, process.result.done()

    assert asyncio.run(run()) == (State.CANCELED, "The package was canceled.", True)


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
def test_a_full_disk_is_the_reason_that_a_package_failed(fails, capsys, monkeypatch):
    monkeypatch.setattr("report.making.make", lambda *_: fails())
    assert made(Path("p/input.xlsx"), Path("p/out")).startswith("The disk of the server is full")
    assert capsys.readouterr().err == ""


def test_the_last_five_packages_of_a_session_are_kept(monkeypatch):
    class AtOnce(SameProcess):
        """A process that makes a package at once."""

        def submit(self, fn, *args):
            return super().submit(str)

    monkeypatch.setattr("report.web.packages.making", lambda *_: AtOnce())

    async def run():
        packages = Packages()
        found = []
        for k in range(7):
            found.append(packages.begin(SESSION, Path(f"/nowhere/{k}/input.xlsx"), {}))
            while not found[-1].state.is_over:
                await asyncio.sleep(0.01)
        assert {one.state for one in found} == {State.DONE}
        return [packages.find(SESSION, one.ticket) is not None for one in found]

    assert asyncio.run(run()) == [False] * 2 + [True] * 5
