"""Which request of the page is answered, and what becomes of jobs whose process is lost."""

import asyncio
import os
import time
from multiprocessing import active_children

import pytest

from report.web import session as desks
from report.web.session import Asked, Desk, LostError, StaleError
from report.workers import WorkerProcess


def nothing():
    """Prepare a process that loads nothing."""


def echo(job):
    """Answer with the job itself, after the seconds that it says; end where it says so."""
    time.sleep(job.get("seconds", 2.5 if job["do"] == "state" else 0))
    if job.get("ends"):
        os._exit(1)
    given = {"reference": job["gives"]} if "gives" in job else {}
    return {"answer": job, **given}


class Echoing(WorkerProcess):
    """A process that echoes, whatever it is asked to do."""

    def submit(self, fn, job):
        return super().submit(echo, job)


@pytest.fixture
def done(tmp_path, monkeypatch):
    """A function that runs a script at a desk, whose processes are all ended after it."""
    monkeypatch.setattr(desks, "computing", lambda _: Echoing(nothing, is_trusted=False))

    def run(script):
        others = processes()

        async def whole():
            desk = Desk(tmp_path)
            try:
                return await asyncio.wait_for(script(desk), 60.0)
            finally:
                await desk.stop()
                assert processes() == others

        return asyncio.run(whole())

    return run


def processes():
    """Numbers of the processes that this one has started."""
    return {child.pid for child in active_children()}


def ask(desk, name, n=0, *, moving=False, values=0, kind="assess", page="p", **job):
    """Begin to ask; the answer has the name."""
    asked = Asked(page=page, n=n, moving=moving, values={"friction": values})
    return asyncio.create_task(desk.ask({"do": kind, "name": name, **job}, asked))


async def became(*tasks):
    """Return the name in each answer, or the kind of its error."""
    found = await asyncio.gather(*tasks, return_exceptions=True)
    return [each["name"] if isinstance(each, dict) else type(each) for each in found]


async def busy(desk, *, moving=False):
    """Keep a process busy."""
    task = ask(desk, "busy", page="other", moving=moving, seconds=0.6)
    await asyncio.sleep(0.2)
    return task


def test_of_the_requests_of_a_page_only_the_newest_is_answered_in_whatever_order_they_come(done):
    async def script(desk):
        first = await busy(desk)
        waiting = [ask(desk, f"n{n}", n) for n in (1, 2, 7, 6)]
        return await became(first, *waiting, ask(desk, "another page", 1, page="q"))

    assert done(script) == ["busy", StaleError, StaleError, "n7", StaleError, "another page"]


def test_what_a_newer_request_replaces_ends_before_its_turn(done):
    """A browser sends no more than six requests to a server at once."""

    async def script(desk):
        slow = ask(desk, "slow", page="q", seconds=20.0)
        await asyncio.sleep(0)
        stale = ask(desk, "former", 1)
        newer = ask(desk, "newer", 2)
        return await became(stale), slow.done(), newer.done()

    assert done(script) == ([StaleError], False, False)


@pytest.mark.nightly
def test_a_move_gets_the_reference_of_the_last_complete_answer_about_what_is_open(done):
    async def script(desk):
        desk.workbook = desk.folder / "input.xlsx"
        before = await ask(desk, "move", moving=True)
        for reference in ("first", "last"):
            await ask(desk, "full", page="", gives=reference)
        after = await ask(desk, "move", page="q", moving=True)
        desk.workbook = desk.folder / "other.xlsx"
        other = await ask(desk, "move", page="r", moving=True)
        return [each["reference"] for each in (before, after, other)]

    assert done(script) == [{}, "last", {}]


def test_a_script_that_numbers_nothing_gets_every_answer(done):
    async def script(desk):
        return await became(*(ask(desk, f"{v}", values=v, page="") for v in (1, 2)))

    assert done(script) == ["1", "2"]


@pytest.mark.nightly
def test_a_move_ends_what_waits_at_the_values_before_and_not_what_is_asked_at_its_own(done):
    async def script(desk):
        first = await busy(desk)
        former = [ask(desk, "full", 1), ask(desk, "contour", 2, kind="contour")]
        move = ask(desk, "move", 3, moving=True, values=1)
        ahead = ask(desk, "ahead", 4, values=1)
        return await became(first, *former, move, ahead)

    assert done(script) == ["busy", StaleError, StaleError, "move", "ahead"]


@pytest.mark.nightly
def test_the_full_model_asked_first_waits_on_beside_the_provisional_answer_of_its_values(done):
    async def script(desk):
        first = await busy(desk)
        step, move = ask(desk, "step", 1, values=1), ask(desk, "move", 2, moving=True, values=1)
        return await became(first, step, move)

    assert done(script) == ["busy", "step", "move"]


@pytest.mark.nightly
def test_one_process_stays_free_for_sliders_that_move(done):
    async def script(desk):
        slow = ask(desk, "slow", seconds=20.0)
        moving = await became(ask(desk, "moving", 1, moving=True))
        return moving, slow.done()

    assert done(script) == (["moving"], False)


@pytest.mark.nightly
def test_a_move_goes_to_the_process_that_is_free(done):
    async def script(desk):
        slow = ask(desk, "slow", page="q", moving=True, seconds=20.0)
        await asyncio.sleep(0)
        moving = await became(ask(desk, "moving", 1, moving=True))
        return moving, slow.done()

    assert done(script) == (["moving"], False)


@pytest.mark.nightly
def test_a_job_whose_process_ends_is_tried_once_more_and_then_lost(done):
    others = processes()

    async def script(desk):
        before = await became(ask(desk, "before"))
        first = processes() - others
        lost = await became(ask(desk, "fatal", ends=True), ask(desk, "after it", page="q"))
        return before, lost, first & processes()

    assert done(script) == (["before"], [LostError, "after it"], set())


@pytest.mark.nightly
def test_a_job_that_takes_too_long_is_stopped_and_says_so(done, monkeypatch):
    monkeypatch.setattr(desks, "LONGEST_S", 0.3)

    async def script(desk):
        with pytest.raises(LostError) as lost:
            await ask(desk, "slow", seconds=30)
        monkeypatch.setattr(desks, "LONGEST_S", 30.0)
        return str(lost.value), await became(ask(desk, "quick"))

    assert done(script) == ("This took longer than 0 s and was stopped.", ["quick"])


@pytest.mark.nightly
def test_the_first_job_of_a_process_may_take_longer(done, monkeypatch):
    """Where the solver is not compiled yet it takes minutes; ended before, it would never start."""
    monkeypatch.setattr(desks, "LONGEST_S", 2.0)

    async def script(desk):
        desk.start()
        await asyncio.sleep(0.1)
        return await became(ask(desk, "after it"))

    assert done(script) == ["after it"]


def test_where_no_process_starts_no_job_waits_and_the_next_one_is_answered_once_one_does(
    done, monkeypatch
):
    starts = desks.computing

    def fail(_):
        raise OSError("no process left")

    async def script(desk):
        monkeypatch.setattr(desks, "computing", fail)
        lost = await became(ask(desk, "a"))
        monkeypatch.setattr(desks, "computing", starts)
        return lost, await became(ask(desk, "b"))

    assert done(script) == ([LostError], ["b"])


@pytest.mark.quick
def test_an_upload_replaces_the_files_of_the_one_before(tmp_path):
    desk = Desk(tmp_path)
    assert desk.opened == "example"
    before, after = desk.new_folder(), desk.new_folder()
    assert [desk.is_newest(each) for each in (before, after)] == [False, True]
    desk.open(before / "project" / "input.xlsx")
    assert desk.opened == before.name
    desk.open(after / "input.xlsx")
    assert desk.opened == after.name
    assert [each.exists() for each in (before, after)] == [False, True]
    assert not desk.is_newest(after)
