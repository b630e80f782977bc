"""Work aside gives what it would give here, and leaves no process behind."""

from __future__ import annotations

import os
import subprocess
import sys
import threading

import pytest

from report.aside import begin
from report.pages.parts import Picture

HERE = os.getpid()
LEFT = """
from report.aside import begin
begin(lambda: [bytes(1_000_000)])
raise SystemExit("the outcome is never asked for")
"""


def pictures_of(name):
    return {name: [Picture(svg="<svg/>", caption=name, alt=name)]}


def test_the_outcomes_are_those_of_the_work_in_their_order():
    found = begin(lambda: [{"large": bytes(1_000_000)}, pictures_of("plan")])
    assert list(found) == [{"large": bytes(1_000_000)}, pictures_of("plan")]


def test_an_outcome_can_be_had_before_the_work_goes_on():
    def work():
        yield "first"
        yield os.read(answers, 9).decode()

    answers, tell = os.pipe()
    found = begin(work)
    assert next(found) == "first"
    os.write(tell, b"answered")
    assert list(found) == ["answered"]
    os.close(answers)
    os.close(tell)


def test_work_that_fails_aside_is_done_here_where_its_error_can_be_seen():
    def work():
        yield "first"
        raise ValueError("wrong")

    found = begin(work)
    assert next(found) == "first"
    with pytest.raises(ValueError, match="wrong"):
        next(found)


def test_work_that_fails_aside_alone_is_finished_here():
    def work():
        yield os.getpid() == HERE
        if os.getpid() != HERE:
            raise RuntimeError("lost")
        yield os.getpid() == HERE

    assert list(begin(work)) == [False, True]


def test_an_outcome_cut_off_on_its_way_is_made_here():
    def work():
        yield os.getpid() == HERE
        yield Torn()

    found = begin(work)
    assert next(found) is False
    assert isinstance(next(found), Torn)


class Torn:
    """Ends the other process while it is handed over."""

    def __getstate__(self):
        if os.getpid() != HERE:
            os._exit(1)
        return {}


def test_beside_other_threads_the_work_is_done_here():
    done = threading.Event()
    thread = threading.Thread(target=done.wait)
    thread.start()
    try:
        assert list(begin(lambda: [os.getpid()])) == [HERE]
    finally:
        done.set()
        thread.join()


def test_a_copy_whose_outcome_is_never_asked_for_ends_with_the_process():
    # The copy holds the pipe of standard error: `run` waits until it ends.
    found = subprocess.run(
        [sys.executable, "-c", LEFT], capture_output=True, text=True, timeout=20, check=False
    )
    assert found.returncode == 1
    assert found.stderr.strip() == "the outcome is never asked for"
