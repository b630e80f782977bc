"""Which request of the page is answered, and what becomes of jobs whose process is lost."""

import asyncio
import os
import stat
import time
from multiprocessing import active_children

import pytest

from report.web import session as sessions
from report.web.processes import WorkerProcess
from report.web.session import (
    EXAMPLE,
    EXAMPLE_NAME,
    Asked,
    ClosedError,
    LostError,
    Session,
    StaleError,
)


def nothing():
    """Prepare a process that loads nothing."""


def echo(job):
    """Answer with the job itself, after the seconds that it says; end where it says so."""
    time.sleep(job.get("seconds", 0))
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
    """A function that runs a script at a session, whose processes are all ended after it."""
    monkeypatch.setattr(sessions, "begun", lambda _: Echoing(nothing))

    def run(script):
        others = processes()

        async def whole():
            session = Session(tmp_path)
            try:
                return await asyncio.wait_for(script(session), 60.0)
            finally:
                await session.stop()
                assert processes() == others

        return asyncio.run(whole())

    return run


def processes():
    """Numbers of the processes that this one has started."""
    return {child.pid for child in active_children()}


def ask(session, name, n=0, *, moving=False, values=0, kind="assess", page="p", **job):
    """Begin to ask; the answer has the name."""
    asked = Asked(page=page, n=n, moving=moving, values={"friction": values})
    return asyncio.create_task(session.ask({"do": kind, "name": name, **job}, asked))


async def became(*tasks):
    """Return the name in each answer, or the kind of its error."""
    found = await asyncio.gather(*tasks, return_exceptions=True)
    return [each["name"] if isinstance(each, dict) else type(each) for each in found]


async def busy(session, *, moving=False):
    """Keep a process busy."""
    task = ask(session, "busy", page="other", moving=moving, seconds=0.6)
    await asyncio.sleep(0.2)
    return task


def test_of_the_requests_of_a_page_only_the_newest_is_answered_in_whatever_order_they_come(done):
    async def script(session):
        first = await busy(session)
        waiting = [ask(session, f"n{n}", n) for n in (1, 2, 7, 6)]
        other = ask(session, "another page", 1, page="q")
        # A script that numbers nothing gets every answer.
        script = [ask(session, f"script {v}", values=v, page="") for v in (1, 2)]
        return await became(first, *waiting, other, *script)

    newest = ["busy", StaleError, StaleError, "n7", StaleError, "another page"]
    assert done(script) == [*newest, "script 1", "script 2"]


def test_what_a_newer_request_replaces_ends_before_its_turn(done):
    """A browser sends no more than six requests to a server at once."""

    async def script(session):
        slow = ask(session, "slow", page="q", seconds=20.0)
        await asyncio.sleep(0)
        stale = ask(session, "former", 1)
        newer = ask(session, "newer", 2)
        return await became(stale), slow.done(), newer.done()

    assert done(script) == ([StaleError], False, False)


@pytest.mark.nightly
def test_a_move_gets_the_reference_of_the_last_complete_answer_about_what_is_open(done):
    async def script(session):
        session.open(session.folder / "a" / "input.xlsx", "a")
        before = await ask(session, "move", moving=True)
        for reference in ("first", "last"):
            await ask(session, "full", page="", gives=reference)
        after = await ask(session, "move", page="q", moving=True)
        session.open(session.folder / "b" / "input.xlsx", "b")
        other = await ask(session, "move", page="r", moving=True)
        return [each["reference"] for each in (before, after, other)]

    assert done(script) == [{}, "last", {}]


@pytest.mark.nightly
def test_a_move_ends_what_waits_at_the_values_before_and_not_what_is_asked_at_its_own(done):
    async def script(session):
        first = await busy(session)
        former = [ask(session, "full", 1), ask(session, "contour", 2, kind="contour")]
        move = ask(session, "move", 3, moving=True, values=1)
        ahead = ask(session, "ahead", 4, values=1)
        return await became(first, *former, move, ahead)

    assert done(script) == ["busy", StaleError, StaleError, "move", "ahead"]


@pytest.mark.nightly
def test_the_full_model_asked_first_waits_on_beside_the_provisional_answer_of_its_values(done):
    async def script(session):
        first = await busy(session)
        step, move = (
            ask(session, "step", 1, values=1),
            ask(session, "move", 2, moving=True, values=1),
        )
        return await became(first, step, move)

    assert done(script) == ["busy", "step", "move"]


@pytest.mark.nightly
def test_one_process_stays_free_for_sliders_that_move(done):
    async def script(session):
        slow = ask(session, "slow", seconds=20.0)
        moving = await became(ask(session, "moving", 1, moving=True))
        return moving, slow.done()

    assert done(script) == (["moving"], False)


@pytest.mark.nightly
def test_a_move_goes_to_the_process_that_is_free(done):
    async def script(session):
        slow = ask(session, "slow", page="q", moving=True, seconds=20.0)
        await asyncio.sleep(0)
        moving = await became(ask(session, "moving", 1, moving=True))
        return moving, slow.done()

    assert done(script) == (["moving"], False)


@pytest.mark.nightly
def test_a_job_whose_process_ends_is_tried_once_more_and_then_lost(done):
    others = processes()

    async def script(session):
        before = await became(ask(session, "before"))
        first = processes() - others
        lost = await became(ask(session, "fatal", ends=True), ask(session, "after it", page="q"))
        return before, lost, first & processes()

    assert done(script) == (["before"], [LostError, "after it"], set())


@pytest.mark.nightly
def test_a_job_that_takes_too_long_is_stopped_and_says_so(done, monkeypatch):
    monkeypatch.setattr(sessions, "LONGEST_S", 0.3)

    async def script(session):
        with pytest.raises(LostError) as lost:
            await ask(session, "slow", seconds=30)
        monkeypatch.setattr(sessions, "LONGEST_S", 30.0)
        return str(lost.value), await became(ask(session, "quick"))

    assert done(script) == ("This took longer than 0 s and was stopped.", ["quick"])


@pytest.mark.nightly
def test_the_first_job_of_a_process_may_take_longer(done, monkeypatch):
    """Where the solver is not compiled yet it takes minutes; ended before, it would never start."""
    monkeypatch.setattr(sessions, "LONGEST_S", 0.001)  # no process starts within it
    others = processes()

    async def script(session):
        session.start()
        await asyncio.sleep(0)  # it starts the first process without waiting for anything
        first = processes() - others
        assert first
        monkeypatch.setattr(sessions, "LONGEST_S", 30.0)
        return await became(ask(session, "after it")), first - processes()

    assert done(script) == (["after it"], set())


def test_where_no_process_starts_no_job_waits_and_the_next_one_is_answered_once_one_does(
    done, monkeypatch
):
    starts = sessions.begun

    def fail(_):
        raise OSError("no process left")

    async def script(session):
        monkeypatch.setattr(sessions, "begun", fail)
        lost = await became(ask(session, "a"))
        monkeypatch.setattr(sessions, "begun", starts)
        return lost, await became(ask(session, "b"))

    assert done(script) == ([LostError], ["b"])


@pytest.mark.quick
def test_projects_stay_open_beside_each_other_until_there_are_too_many(tmp_path, monkeypatch):
    monkeypatch.setattr(sessions, "MOST_OPEN", 2)
    session = Session(tmp_path)
    assert session.opened == session.named("a") == "example"
    folders = [session.new_folder() for _ in range(3)]
    for name, folder in zip("abc", folders, strict=True):
        session.open(folder / "project" / "input.xlsx", name)
        assert session.opened == folder.name
    assert [folder.exists() for folder in folders] == [False, True, True]
    assert session.named("b") == folders[1].name
    assert session.named("a") == folders[2].name  # closed: the one opened last
    assert session.workbook(folders[1].name) == folders[1] / "project" / "input.xlsx"
    with pytest.raises(ClosedError):
        session.workbook(folders[0].name)
    assert session.workbook("example") == EXAMPLE


@pytest.mark.quick
def test_an_upload_has_a_folder_where_that_of_the_server_was_removed(tmp_path):
    session = Session(tmp_path / "served")
    assert session.new_folder().is_dir()
    assert os.name == "nt" or stat.S_IMODE(session.folder.stat().st_mode) == 0o700


def test_the_address_of_the_example_is_known_before_anyone_opens_it(tmp_path, monkeypatch):
    async def answer(*_, longest_s):
        return {"answer": {"project": {"id": "0123456789ab"}}}

    session = Session(tmp_path)
    monkeypatch.setattr(session, "_answer", answer)
    asyncio.run(session._warm())
    session.open(tmp_path / "upload-1" / "input.xlsx", "another")
    assert session.named("another") == "upload-1"
    assert session.named("0123456789ab") == EXAMPLE_NAME
