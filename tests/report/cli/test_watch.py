"""`roofslip watch`: what counts as a save, a workbook that is not finished, and a round after each.

Every process and thread that a test starts is ended by it.
"""

import gc
import os
import shutil
import signal
import subprocess
import sys
import threading
import time
import zipfile
from contextlib import contextmanager
from itertools import islice
from pathlib import Path

import pytest

import report.typeset.pdf
from cells import address
from commands import hearing, printed, run
from packages import unlaid
from places import ROOT, TESTS
from report.cli.terminal import INTERRUPTED
from report.cli.watch import Round, is_input, saves, settle
from report.making import OUTPUTS
from report.memoized import clear
from sheets import make, type_into
from solver.model import InputError
from solver.sliding import least_model

WAIT_S = 240.0
SCRIPT = os.environ | {"PYTHONPATH": f"{ROOT}{os.pathsep}{TESTS}"}
FRICTION = "Arrays/1/Friction coefficient"


@pytest.mark.parametrize(
    ("name", "counts"),
    [
        ("input.xlsx", True),
        ("records/m1-x.csv", True),
        ("~$input.xlsx", False),
        (".~lock.input.xlsx#", False),
        ("input.xlsx~", False),
        ("5A1B2C00.tmp", False),
        (".roofslip-a1/calc-package.pdf", True),  # of the output folder, which is left out whole
    ],
)
def test_locks_and_temporary_files_are_no_save(name, counts):
    assert is_input(Path(name)) is counts


def begun(path):
    """The saves beside a workbook, once they are watched."""
    found = saves(path, path.parent / "out")
    next(found)
    return found


def copied_back(path, record):
    """As from a backup, with its time."""
    path.write_bytes(b"backup")
    os.utime(path, (1e9, 1e9))


def removed(path, record):
    record.unlink()


def saved_alike(path, record):
    path.write_bytes(path.read_bytes())
    record.touch()


def packaged(path, record):
    (path.parent / "new").mkdir()
    (path.parent / "out").mkdir()
    (path.parent / "out" / "calc-package.pdf").write_bytes(b"%PDF")


@pytest.mark.parametrize(
    ("change", "named"),
    [
        (copied_back, ["input.xlsx"]),
        (removed, ["records/z.csv"]),
        (saved_alike, []),
        (packaged, []),
    ],
)
def test_a_save_is_a_file_with_other_content(tmp_path, monkeypatch, change, named):
    monkeypatch.setattr("report.cli.watch.SETTLE_S", 0.0)
    path, record = tmp_path / "input.xlsx", tmp_path / "records" / "z.csv"
    record.parent.mkdir()
    for each in (path, record):
        each.write_bytes(b"before")
    found = begun(path)
    change(path, record)
    assert next(filter(None, islice(found, 4)), []) == named
    path.write_bytes(b"after it")
    assert next(filter(None, found)) == ["input.xlsx"]


def test_a_save_in_several_steps_is_one(tmp_path):
    """As Excel does it: a temporary file, then another name; here with a pause in the middle."""
    path = make(tmp_path)
    whole = type_into(path, {FRICTION: 0.5}).read_bytes()
    found = begun(path)
    temporary = tmp_path / "5A1B2C00"
    temporary.write_bytes(whole[:1000])
    timer = later(0.5, lambda: (temporary.write_bytes(whole + b"0"), temporary.replace(path)))
    named = list(filter(None, islice(found, 6)))
    timer.join()
    assert named == [["input.xlsx"]]


def test_a_workbook_that_shrinks_while_it_is_read_is_read_again(tmp_path, monkeypatch):
    monkeypatch.setattr("report.cli.watch.SETTLE_S", 60.0)
    path = make(tmp_path)
    whole, looks = path.read_bytes(), []
    read = zipfile.ZipFile.testzip

    def shrinking(archive):
        looks.append(archive)
        largest = max(archive.infolist(), key=lambda part: part.compress_size)
        end = largest.header_offset + largest.compress_size // 2
        path.write_bytes(whole[:end] if len(looks) == 1 else whole)
        return read(archive)

    monkeypatch.setattr(zipfile.ZipFile, "testzip", shrinking)
    timer = later(0.5, lambda: path.write_bytes(whole))
    settle(path)
    timer.join()
    assert len(looks) == 2


def test_a_round_with_a_problem_says_that_the_files_are_of_an_earlier_run(
    tmp_path, capsys, monkeypatch
):
    monkeypatch.setattr("report.cli.watch.SETTLE_S", 0.0)
    path, folder = tmp_path / "input.xlsx", tmp_path / "out"
    path.write_bytes(b"half")
    round_ = Round(path, None)
    try:
        assert not round_.run()
        first = capsys.readouterr().err
        folder.mkdir()
        (folder / "calc-package.pdf").write_bytes(b"%PDF")
        assert not round_.run()
    finally:
        clear()
    told = capsys.readouterr().err.splitlines()
    assert told[0] == f"{path}: 1 problem found."
    assert told[-1].startswith(f"{folder / 'calc-package.pdf'} is of an earlier run, 2")
    assert told[-1].endswith(", and not replaced")
    assert "earlier run" not in first


def later(seconds, action):
    timer = threading.Timer(seconds, action)
    timer.start()
    return timer


@pytest.mark.parametrize("start", ["half saved", "gone", "empty"])
def test_a_workbook_that_is_not_finished_is_read_again(tmp_path, monkeypatch, start):
    monkeypatch.setattr("report.cli.watch.SETTLE_S", 60.0)
    path = make(tmp_path)
    whole = path.read_bytes()
    if start == "gone":
        path.unlink()
    else:
        path.write_bytes(whole[: len(whole) // 2] if start == "half saved" else b"")
    timer = later(0.5, lambda: path.write_bytes(whole))
    began = time.monotonic()
    settle(path)
    timer.join()
    assert 0.4 < time.monotonic() - began < 60.0


def test_a_workbook_that_stays_away_is_an_error(tmp_path, monkeypatch):
    monkeypatch.setattr("report.cli.watch.SETTLE_S", 0.4)
    with pytest.raises(InputError, match="no such file"):
        settle(tmp_path / "input.xlsx")


def test_once_ends_after_one_round(tmp_path):
    with zipfile.ZipFile(tmp_path / "input.xlsx", "w") as archive:
        archive.writestr("notes.txt", "no workbook")
    refused = run("watch", "--once", tmp_path)
    assert refused.exit_code == 2
    assert "1 problem found" in refused.stderr
    make(tmp_path)
    with unlaid():
        assert "watching" not in printed("watch", "--once", tmp_path)
    assert (tmp_path / "out" / "calc-package.pdf").is_file()


UNLAID = """
from packages import unlaid
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


class Interrupting:
    """A cycle whose collection has Ctrl+C come within a finalizer, where Python drops it."""

    def __init__(self):
        self.itself = self

    def __del__(self):
        os.kill(os.getpid(), signal.SIGINT)


@pytest.mark.nightly("report/cli/watch.py")
def test_ctrl_c_while_a_round_is_swept_ends_the_watch(tmp_path):
    gc.disable()
    try:
        Interrupting()
        with pytest.raises(KeyboardInterrupt):
            Round(tmp_path, tmp_path).sweep()
    finally:
        gc.enable()


@pytest.mark.nightly("report/cli/watch.py")
def test_each_save_gives_a_round_that_says_what_changed(tmp_path):
    path, record = make(tmp_path), tmp_path / "records" / "z.csv"
    with watching(tmp_path) as until:
        until("watching ")
        whole = type_into(path, {FRICTION: 0.5}).read_bytes()
        path.write_bytes(whole[: len(whole) // 2])
        time.sleep(0.5)
        path.write_bytes(whole)
        assert f"({address(path, FRICTION)}): 0.45 -> 0.5" in until("changed: ")
        until(str(tmp_path / "out"))
        record.write_text(record.read_text() + "0.0\n")
        # A save of the workbook that came meanwhile may be named with it.
        until("changed: M1 vertical: records/z.csv")
        until(str(tmp_path / "out"))
        # A mistake is printed, and the watch goes on.
        path.write_bytes(b"")
        until(f"{path}: 1 problem")


REPORTS = """
import sys
from contextlib import nullcontext
from packages import unlaid
from report.cli.main import main

for folder in sys.argv[1:]:
    with nullcontext() if folder == sys.argv[-1] else unlaid():
        main(["report", folder, "--quiet"], standalone_mode=False)
"""


def fresh(folders):
    """Report each folder in one process that keeps nothing, the last one laid out."""
    command = [sys.executable, "-c", REPORTS, *map(str, folders)]
    subprocess.run(command, check=True, env=SCRIPT, timeout=WAIT_S)
    return [outputs(folder / "out") for folder in folders]


def outputs(folder):
    return {name: (folder / name).read_bytes() for name in OUTPUTS}


@pytest.mark.nightly
def test_a_warm_round_runs_what_changed_and_gives_the_files_of_a_fresh_process(
    tmp_path, monkeypatch, capsys
):
    """The package of the last round is laid out."""
    runs, copies, warm = [], [], []
    solve = least_model.solve
    monkeypatch.setattr(least_model, "solve", lambda *call: runs.append(call) or solve(*call))
    folder = tmp_path / "warm"
    path, vertical = make(folder), folder / "records" / "z.csv"

    def counted(round_, name):
        runs.clear()
        copies.append(tmp_path / name)
        shutil.copytree(folder, copies[-1], ignore=shutil.ignore_patterns("out"))
        assert round_.run()
        warm.append(outputs(folder / "out"))
        return len(runs)

    try:
        round_ = Round(path, folder / "out")
        with monkeypatch.context() as patch:
            patch.setattr(report.typeset.pdf, "lay_out", lambda html, *_: html.encode())
            assert round_.run()
            all_runs = len(runs)
            type_into(path, {"Clearances/1/Provided clearance": 31.0})
            none = counted(round_, "clearance")
            type_into(path, {FRICTION: 0.5})
            some = counted(round_, "friction")
        vertical.write_text("0.001\n" + vertical.read_text().partition("\n")[2])
        others = counted(round_, "record")
        round_.sweep()
    finally:
        clear()
    assert warm == fresh(copies)
    assert warm[-1]["calc-package.pdf"].startswith(b"%PDF")
    assert none == 0
    assert 0 < some < all_runs
    assert 0 < others < all_runs
    assert len({files["calc-package.pdf"] for files in warm}) == 3
    # The verdict is printed before the package is made.
    told = capsys.readouterr().out.splitlines()
    assert told.index("verdict: NG") < next(i for i, s in enumerate(told) if ": written in" in s)
