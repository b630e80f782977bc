"""`roofslip watch`: what counts as a save, a workbook that is not finished, and a round after each.

Every process and thread that a test starts is ended by it.
"""

import os
import shutil
import signal
import subprocess
import sys
import threading
import time
from contextlib import contextmanager, suppress

import pytest

from fixtures.cells import address
from fixtures.commands import errors_of, hearing, run
from fixtures.marks import by_day
from fixtures.packages import unlaid
from fixtures.paths import ROOT, TESTS
from fixtures.workbooks import make, type_into
from report.cli.console import INTERRUPTED
from report.cli.file_watcher import file_stamps, report_again, settled
from report.results.publish import OUTPUTS

pytestmark = pytest.mark.quick

WAIT_S = 240.0
SCRIPT = os.environ | {"PYTHONPATH": f"{ROOT}{os.pathsep}{TESTS}"}
FRICTION = "Arrays/1/Friction coefficient"
PROVIDED = "Clearances/1/Provided clearance"


def copied_back(path):
    """As from a backup, with its time."""
    path.write_bytes(b"backup")
    os.utime(path, (1e9, 1e9))


@pytest.mark.parametrize(
    "change",
    [
        copied_back,
        lambda path: path.write_bytes(b"before2"),
        lambda path: (path.parent / "records" / "z.csv").unlink(),
        lambda path: (path.parent / "records" / "m1-x.csv").write_text("0.1"),
    ],
)
def test_a_save_is_a_file_that_is_new_changed_or_gone(tmp_path, change):
    path, record = tmp_path / "input.xlsx", tmp_path / "records" / "z.csv"
    record.parent.mkdir()
    for each in (path, record):
        each.write_bytes(b"before")
    before = file_stamps(tmp_path)
    change(path)
    assert file_stamps(tmp_path) != before


@pytest.mark.parametrize(
    "name",
    ["~$input.xlsx", ".~lock.input.xlsx#", "input.xlsx~", "5A1B2C00.tmp", "out/calc-package.pdf",
     "out/b/results.json", "out/roofslip.sha256", "out/.roofslip-a1.part"],
)  # fmt: skip
def test_locks_temporary_files_and_outputs_are_no_save(tmp_path, name):
    (tmp_path / "input.xlsx").write_bytes(b"before")
    before = file_stamps(tmp_path)
    (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
    (tmp_path / name).write_bytes(b"new")
    assert file_stamps(tmp_path) == before


def later(seconds, action):
    timer = threading.Timer(seconds, action)
    timer.start()
    return timer


@pytest.fixture
def patient(monkeypatch):
    """As long as a busy machine needs."""
    monkeypatch.setattr("report.cli.file_watcher.MAX_POLLS", 200)


@pytest.mark.nightly
def test_a_save_in_several_steps_is_one(tmp_path, patient):
    """As a copy from elsewhere does it, with a pause in the middle."""
    path = make(tmp_path)
    record = tmp_path / "records" / "z.csv"
    whole = record.read_text()
    timers = [later(0.1 * k, lambda k=k: record.write_text(whole[: 40 * k])) for k in range(1, 8)]
    seen = settled(path)
    for timer in timers:
        timer.join()
    assert seen == file_stamps(tmp_path)
    assert record.read_text() == whole[:280]


@pytest.mark.parametrize("start", by_day(["half saved", "gone", "empty"], 1))
def test_a_workbook_that_is_not_finished_is_read_again(tmp_path, patient, start):
    path = make(tmp_path)
    whole = path.read_bytes()
    if start == "gone":
        path.unlink()
    else:
        path.write_bytes(whole[: len(whole) // 2] if start == "half saved" else b"")
    timer = later(0.9, lambda: path.write_bytes(whole))
    began = time.monotonic()
    seen = settled(path)
    timer.join()
    assert 0.8 < time.monotonic() - began < 60.0
    assert seen == file_stamps(tmp_path)


def test_a_workbook_that_is_not_there_is_an_error_at_once(tmp_path):
    assert "no such file" in errors_of("watch", tmp_path / "none.xlsx")
    assert "a folder without input.xlsx" in errors_of("watch", tmp_path)


@pytest.mark.nightly
def test_a_round_says_what_changed_up_to_a_number(tmp_path, capsys, monkeypatch):
    monkeypatch.setattr("report.cli.file_watcher.MAX_CHANGES", 1)
    path = make(tmp_path)
    with unlaid():
        results = report_again(path, None, b"")
        first = capsys.readouterr().out
        again = report_again(path, None, results)
        second = capsys.readouterr().out.splitlines()
        report_again(type_into(path, {FRICTION: 0.5, PROVIDED: 31.0}), None, again)
    third = capsys.readouterr().out.splitlines()
    assert "since the last report" not in first
    assert second[-1] == "changes since the last report: 0"
    assert third[-1].endswith(f" {address(path, FRICTION)}: 0.45 -> 0.5")
    assert int(third[-2].removeprefix("changes since the last report: ")) > 1


UNLAID = """
from fixtures.packages import unlaid
from report.cli.main import main

with unlaid(): main()
"""


@contextmanager
def watching(folder):
    """Yield a function that waits for a line of the command in a process of its own.

    Its packages are not laid out.
    """
    command = [sys.executable, "-u", "-c", UNLAID, "watch", str(folder)]
    with subprocess.Popen(
        command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, env=SCRIPT,
        preexec_fn=hearing(signal.SIGINT),
    ) as process:  # fmt: skip
        too_long = later(WAIT_S, process.kill)

        def until(start):
            told = []
            for line in process.stdout:
                told.append(line)
                if line.startswith(start):
                    return line
            raise AssertionError(f"no line starts with '{start}':\n{''.join(told)}")

        try:
            yield until
            process.send_signal(signal.SIGINT)
            assert process.wait(20) == INTERRUPTED
        finally:
            too_long.cancel()
            process.kill()


@pytest.mark.nightly
def test_each_save_gives_a_round_that_says_what_changed(tmp_path):
    path, record = make(tmp_path), tmp_path / "records" / "z.csv"
    with watching(tmp_path) as until:
        until("watching ")
        whole = type_into(path, {FRICTION: 0.5}).read_bytes()
        path.write_bytes(whole[: len(whole) // 2])
        time.sleep(0.5)
        path.write_bytes(whole)
        until("changes since the last report: ")
        assert f" {address(path, FRICTION)}: 0.45 -> 0.5" in until("  ")
        until("watching ")
        record.write_text(record.read_text() + "0.0\n")
        until("  M1 vertical: records/z.csv")
        until("watching ")
        # A mistake is printed, and the watch goes on.
        path.write_bytes(b"")
        until(f"{path}: 1 error")


def test_an_interrupt_that_python_drops_ends_the_watch(tmp_path, monkeypatch):
    """As in a finalizer that the collection of garbage runs."""
    rounds = []

    def drop_interrupt():
        rounds.append("collected")
        if len(rounds) > 1:
            raise KeyboardInterrupt
        with suppress(KeyboardInterrupt):
            signal.raise_signal(signal.SIGINT)

    path = make(tmp_path)
    path.write_bytes(b"")
    monkeypatch.setattr("report.cli.file_watcher.gc.collect", drop_interrupt)
    monkeypatch.setattr("report.cli.file_watcher.file_stamps", lambda _: {len(rounds)})
    monkeypatch.setattr("report.cli.file_watcher.MAX_POLLS", 1)
    timer = later(20.0, lambda: rounds.append("saved"))
    done = run("watch", tmp_path)
    timer.cancel()
    assert done.exit_code == INTERRUPTED
    assert rounds == ["collected"]


def outputs(folder):
    return {name: (folder / "out" / name).read_bytes() for name in OUTPUTS}


@pytest.mark.nightly
def test_a_later_round_gives_the_files_of_a_fresh_process(tmp_path):
    path, copy = make(tmp_path / "warm"), tmp_path / "fresh"
    with unlaid():
        report_again(path, None, b"")
    type_into(path, {FRICTION: 0.5})
    shutil.copytree(tmp_path / "warm", copy, ignore=shutil.ignore_patterns("out"))
    report_again(path, None, b"")
    command = [sys.executable, "-m", "report.cli", "report", copy, "--quiet"]
    subprocess.run(command, check=True, env=SCRIPT, timeout=WAIT_S)
    assert outputs(tmp_path / "warm") == outputs(copy)
