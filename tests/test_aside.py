"""Work aside gives what it would give here, and leaves no process behind."""

from __future__ import annotations

import subprocess
import sys
import threading

import pytest

from report.aside import begin

LEFT = """
from report.aside import begin
begin(lambda: bytes(1_000_000))
raise SystemExit("the outcome is never asked for")
"""


def test_the_outcome_is_that_of_the_work():
    assert begin(lambda: {"large": bytes(1_000_000)})() == {"large": bytes(1_000_000)}


def test_work_that_fails_aside_is_done_here_where_its_error_can_be_seen():
    def work():
        raise ValueError("wrong")

    outcome = begin(work)
    with pytest.raises(ValueError, match="wrong"):
        outcome()


def test_beside_other_threads_the_work_is_done_here():
    done = threading.Event()
    thread = threading.Thread(target=done.wait)
    thread.start()
    work = object
    try:
        assert begin(work) is work
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
