"""Packages of the page, with processes that only wait."""

import asyncio
import errno
from concurrent.futures import Executor, Future
from pathlib import Path

import pytest

from report.steps import Step
from report.web.worker import Packages, State, in_words, made
from solver.errors import DefectError, InputError

pytestmark = pytest.mark.quick


class Making(Executor):
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
    monkeypatch.setattr("report.web.worker.begun", lambda *_: process)

    async def run():
        packages = Packages()
        package = packages.begin("example", Path("/nowhere/p/input.xlsx"), {})
        # Another tab gets the one that is made.
        assert packages.begin("example", Path("/nowhere/q/input.xlsx"), {}) is package
        async with asyncio.timeout(20.0):
            while package.worker is None:
                await asyncio.sleep(0.01)
            packages.cancel()
        await packages.stop()
        assert packages.last("example") is None
        return package.state, package.words, process.result.done()

    assert asyncio.run(run()) == (State.CANCELED, "The package was canceled.", True)


def test_a_package_is_the_last_of_what_is_open_alone(monkeypatch):
    class AtOnce(Executor):
        """A process that makes a package at once."""

        def submit(self, fn, *args):
            done = Future()
            done.set_result("")
            return done

    monkeypatch.setattr("report.web.worker.begun", lambda *_: AtOnce())

    async def run():
        packages = Packages()
        made = []
        for opened in ("example", "upload-1", "example"):
            made.append(packages.begin(opened, Path("/nowhere/p/input.xlsx"), {}))
            await asyncio.sleep(0.01)
        assert {one.state for one in made} == {State.DONE}
        assert packages.last("upload-2") is None
        return [made.index(packages.last(opened)) for opened in ("example", "upload-1")]

    assert asyncio.run(run()) == [2, 1]


def test_a_step_is_named_in_a_sentence_without_what_compiles():
    step = Step("running the motions", hint="the first run compiles the solver")
    assert str(step) == "running the motions (the first run compiles the solver)"
    assert in_words(step) == "Running the motions"


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
    assert made(Path("p/input.xlsx"), Path("p/out")).startswith("The disk is full")
    assert capsys.readouterr().err == ""
