"""Which job goes next, and what becomes of jobs whose process is lost; with processes that echo."""

import asyncio
import os
import time
from concurrent.futures import Executor, Future
from multiprocessing import active_children

from report.web.workers import JobOrigin, LostError, Rank, StaleError, Workers
from report.workers import WorkerProcess


def nothing():
    """Prepare a process that loads nothing."""


def echo(job):
    """Answer with the job itself, after the seconds that it says; end where it says so."""
    time.sleep(job.get("seconds", 0))
    if job.get("ends"):
        os._exit(1)
    return job


class Echoing(WorkerProcess):
    """A process that echoes, whatever it is asked to do."""

    def submit(self, fn, job):
        return super().submit(echo, job)


def echoing(is_quick):
    return Echoing(nothing, is_trusted=False)


def processes():
    """Numbers of the processes that this one has started."""
    return {child.pid for child in active_children()}


def done(number, script, first=None):
    """Run a script with so many processes, which are all ended after it."""
    others = processes()

    async def run():
        pool = Workers(number, echoing)
        pool.start(first or {})
        try:
            return await asyncio.wait_for(script(pool), 60.0)
        finally:
            await pool.stop()
            assert processes() == others

    return asyncio.run(run())


class Answering(Executor):
    """A process without a system, whose answer arrives when a test says."""

    pid, is_ended = 1, False

    def __init__(self):
        self.answer = Future()

    def submit(self, fn, job):
        return self.answer

    def shutdown(self, wait=True):
        self.is_ended = True


def test_an_answer_that_comes_with_the_end_does_not_keep_the_processes():
    async def run():
        process = Answering()
        pool = Workers(1, lambda is_quick: process)
        pool.start({})
        await asyncio.sleep(0.1)
        process.answer.set_result({})
        async with asyncio.timeout(5.0):
            await pool.stop()
        return process.is_ended

    assert asyncio.run(run())


def ask(pool, name, rank=Rank.AT_REST, key="p", number=1, **job):
    place = JobOrigin((key, "assess"), number)
    return asyncio.create_task(pool.ask({"name": name, "values": name, **job}, rank, place))


async def gathered(*tasks):
    """What becomes of tasks, errors among it."""
    return await asyncio.gather(*tasks, return_exceptions=True)


async def busy(pool):
    """Keep a process busy."""
    task = ask(pool, "busy", Rank.MOVING, key="busy", seconds=0.6)
    await asyncio.sleep(0.2)
    return task


def test_of_the_jobs_of_a_page_only_the_newest_waits_in_whatever_order_they_come():
    async def script(pool):
        running = await busy(pool)
        waiting = [ask(pool, f"n{n}", number=n) for n in (1, 2, 3, 7)]
        await asyncio.sleep(0)
        late = ask(pool, "n6", number=6)
        other = ask(pool, "other page", number=1, key="q")
        return await gathered(running, late, *waiting, other)

    _, *stale, newest, other = done(1, script)
    assert [type(each) for each in stale] == [StaleError] * 4
    assert (newest["name"], other["name"]) == ("n7", "other page")


def test_a_move_ends_what_waits_and_the_full_model_asked_ahead_does_not_end_the_move():
    async def script(pool):
        running = await busy(pool)
        jobs = [("before", Rank.AT_REST), ("move", Rank.MOVING), ("ahead", Rank.AT_REST)]
        tasks = [ask(pool, name, rank, number=n) for n, (name, rank) in enumerate(jobs)]
        await asyncio.sleep(0)
        late = ask(pool, "late", number=0)
        return await gathered(running, late, *tasks)

    _, late, before, move, ahead = done(1, script)
    assert {type(late), type(before)} == {StaleError}
    assert (move["name"], ahead["name"]) == ("move", "ahead")


def test_the_full_model_asked_first_waits_on_beside_the_provisional_answer_of_its_values():
    async def script(pool):
        running = await busy(pool)
        jobs = [("step", Rank.AT_REST), ("meanwhile", Rank.MOVING)]
        tasks = [
            ask(pool, name, rank, number=n, values=1) for n, (name, rank) in enumerate(jobs, 1)
        ]
        return await gathered(running, *tasks)

    assert [each["name"] for each in done(1, script)] == ["busy", "step", "meanwhile"]


def test_quick_jobs_go_first_and_equal_ones_in_order():
    async def script(pool):
        order = []
        running = await busy(pool)
        ranks = [Rank.READ, Rank.VIEW, Rank.AT_REST, Rank.MOVING, Rank.MOVING]
        tasks = [ask(pool, rank.name, rank, key=str(k)) for k, rank in enumerate(ranks)]
        for k, task in enumerate(tasks):
            task.add_done_callback(lambda _, k=k: order.append(k))
        await asyncio.gather(running, *tasks)
        return order

    assert done(1, script) == [3, 4, 2, 1, 0]


def test_the_process_kept_free_starts_once_another_has_its_first_answer():
    async def script(pool):
        await asyncio.sleep(0.2)
        alone = len(processes() - others)
        await ask(pool, "after it")
        await asyncio.sleep(0.1)
        return alone, len(processes() - others)

    others = processes()
    assert done(2, script, first={"seconds": 0.5}) == (1, 2)


def test_one_process_stays_free_for_sliders_that_move():
    async def script(pool):
        ranks = (Rank.READ, Rank.AT_REST, Rank.VIEW)
        slow = [ask(pool, "slow", rank, key=rank.name, seconds=20.0) for rank in ranks]
        moving = await ask(pool, "moving", Rank.MOVING)
        return moving["name"], [each.done() for each in slow]

    assert done(2, script) == ("moving", [False, False, False])


def test_a_job_whose_process_ends_is_tried_once_more_and_then_lost():
    async def script(pool):
        first = processes() - others
        (lost,) = await gathered(ask(pool, "fatal", ends=True))
        again = await ask(pool, "after it", number=2)
        return lost, again["name"], first & processes()

    others = processes()
    lost, again, left = done(1, script)
    assert isinstance(lost, LostError)
    assert (again, left) == ("after it", set())


def test_a_job_that_takes_too_long_is_stopped_and_says_so(monkeypatch):
    monkeypatch.setattr("report.web.workers.LONGEST_S", 0.3)

    async def script(pool):
        (lost,) = await gathered(ask(pool, "slow", seconds=30))
        return lost, (await ask(pool, "quick", number=2))["name"]

    lost, quick = done(1, script)
    assert str(lost) == "This took longer than 0 s and was stopped."
    assert quick == "quick"


def test_the_first_job_of_a_process_may_take_longer(monkeypatch):
    """Where the solver is not compiled yet it takes minutes; ended before, it would never start."""
    monkeypatch.setattr("report.web.workers.LONGEST_S", 1.0)

    async def script(pool):
        return (await ask(pool, "after it"))["name"]

    assert done(1, script, first={"seconds": 1.5}) == "after it"


def test_an_answer_is_a_line_whatever_is_in_it():
    text = "a line\u2028 another\n\x00 \u00e9"

    async def script(pool):
        return await ask(pool, text)

    assert done(1, script)["name"] == text


def test_where_no_process_starts_no_job_waits_and_the_next_one_is_answered_once_one_does(capsys):
    failing = [OSError("no process left")]

    def start(is_quick):
        if failing:
            raise failing.pop()
        return echoing(is_quick)

    async def run():
        pool = Workers(1, start)
        pool.start({})
        lost = await asyncio.wait_for(gathered(ask(pool, "a")), 10.0)
        again = await asyncio.wait_for(ask(pool, "b"), 30.0)
        await pool.stop()
        return lost, again

    (lost,), again = asyncio.run(run())
    assert isinstance(lost, LostError)
    assert again["name"] == "b"
    assert capsys.readouterr().err.count("OSError: no process left") == 1
