"""Outputs are written as one set, also by killed runs and by two runs at once.

The reader of the stamp here is independent: hashlib, and the format of sha256sum.
"""

import hashlib
import os
import random
import shutil
import subprocess
import sys
import time
from contextlib import contextmanager

import pytest

from report.results.publish import STAMP, check_apart, finish, locked, publish
from solver.model import InputError


def names_in(folder):
    return sorted(path.name for path in folder.iterdir())


def is_whole(folder):
    """Whether all files agree with the stamp."""
    lines = (folder / STAMP).read_text().splitlines()
    pairs = [line.split("  ", 1) for line in lines]
    return all(
        hashlib.sha256((folder / name).read_bytes()).hexdigest() == digest for digest, name in pairs
    )


@pytest.fixture
def before_each_replacement(monkeypatch):
    """A context in which a function is called before each replacement, with its two paths."""
    replace = os.replace

    @contextmanager
    def calling(function):
        def replaced(source, target):
            function(str(source), str(target))
            replace(source, target)

        with monkeypatch.context() as patch:
            patch.setattr(os, "replace", replaced)
            yield

    return calling


class Killed(BaseException):
    """The end of a process at one moment."""


OLD = {"a.txt": b"old a", "b.txt": b"old b"}
NEW = {"a.txt": b"new a", "b.txt": b"new b", "c.txt": b"new c"}


def contents(folder):
    return {path.name: path.read_bytes() for path in folder.glob("*.txt") if path.is_file()}


def test_files_are_published_together(tmp_path):
    publish(OLD, tmp_path / "out")
    assert names_in(tmp_path / "out") == ["a.txt", "b.txt", STAMP]
    publish(NEW, tmp_path / "out")
    assert contents(tmp_path / "out") == NEW


def test_a_file_that_cannot_be_replaced_changes_nothing_and_is_named(tmp_path):
    publish(OLD, tmp_path)
    (tmp_path / "c.txt").mkdir()
    with pytest.raises(InputError, match=r"c\.txt: cannot be replaced .*close it"):
        publish(NEW, tmp_path)
    assert names_in(tmp_path) == ["a.txt", "b.txt", "c.txt", STAMP]
    assert contents(tmp_path) == OLD
    assert is_whole(tmp_path)


@pytest.mark.parametrize("at", ["forward.json", "a.txt", "b.txt", STAMP])
def test_ctrl_c_while_files_are_replaced_leaves_one_whole_set(
    tmp_path, before_each_replacement, at
):
    publish(OLD, tmp_path)
    interrupts = [KeyboardInterrupt]

    def interrupted(_, target):
        if target.endswith(at) and interrupts:
            raise interrupts.pop()

    with before_each_replacement(interrupted), pytest.raises(KeyboardInterrupt):
        publish(NEW, tmp_path)
    assert contents(tmp_path) == (OLD if at == "forward.json" else NEW)
    assert names_in(tmp_path) == [*sorted(contents(tmp_path)), STAMP]
    assert is_whole(tmp_path)


def test_a_folder_that_cannot_be_created_is_reported(tmp_path):
    (tmp_path / "out").write_text("a file")
    with pytest.raises(InputError, match=r"out: cannot be written .*--out"):
        publish({"a.txt": b"1"}, tmp_path / "out")


def test_a_full_disk_leaves_the_old_package(tmp_path, files_up_to):
    publish({"a.txt": b"old"}, tmp_path)
    with files_up_to(1000), pytest.raises(InputError, match="File too large"):
        publish({"b.txt": b"new", "a.txt": b"new" * 1000}, tmp_path)
    assert names_in(tmp_path) == ["a.txt", STAMP]
    assert (tmp_path / "a.txt").read_bytes() == b"old"


def test_the_stamp_is_what_sha256sum_reads(tmp_path):
    publish({"a.txt": b"1", "sub/b.txt": b"2"}, tmp_path)
    tool = shutil.which("sha256sum")
    if tool is None:
        pytest.skip("no sha256sum here")
    done = subprocess.run([tool, "-c", STAMP], cwd=tmp_path, capture_output=True, text=True)
    assert done.stdout.splitlines() == ["a.txt: OK", "sub/b.txt: OK"]


# Publishes numbered sets of four files without end; a set is whole or it is told by the stamp.
WRITER = """
import sys, time
from pathlib import Path
from report.results.publish import publish
start, step, pause_s = int(sys.argv[2]), int(sys.argv[3]), float(sys.argv[4])
for n in range(start, 10**6, step):
    files = {f"{k}.txt": f"{n} {k}\\n".encode() * 20_000 for k in "abc"}
    publish(files | {"sub/d.txt": b"%d" % n}, Path(sys.argv[1]))
    print(n, flush=True)
    time.sleep(pause_s)
"""


def writer(folder, start, step, pause_s=0.0):
    words = map(str, (folder, start, step, pause_s))
    return subprocess.Popen([sys.executable, "-c", WRITER, *words], stdout=subprocess.PIPE)


def end(child):
    child.kill()
    child.wait()
    child.stdout.close()


def numbers_of(folder):
    """Numbers of the sets that the files are of, without the stamp."""
    names = [folder / f"{k}.txt" for k in "abc"] + [folder / "sub" / "d.txt"]
    return {path.read_bytes().split()[0] for path in names}


def test_a_run_killed_at_any_moment_leaves_the_old_set_or_the_new_one(tmp_path):
    rng = random.Random(1)
    (tmp_path / "user.txt").write_text("of the user")
    (tmp_path / ".roofslip-notes").mkdir()
    (tmp_path / ".roofslip-notes" / "mine.txt").write_text("of the user")
    for trial in range(4):
        child = writer(tmp_path, 1000 * trial, 1)
        child.stdout.readline()
        time.sleep(rng.uniform(0.0, 0.02))
        end(child)
        # A reader who checks the stamp never takes a mixture for a set.
        assert not is_whole(tmp_path) or len(numbers_of(tmp_path)) == 1
        finish(tmp_path)
        assert is_whole(tmp_path)
        assert len(numbers_of(tmp_path)) == 1
    publish({"e.txt": b"5"}, tmp_path)
    left = [name for name in names_in(tmp_path) if name.startswith(".")]
    assert left == [".roofslip-notes"]
    assert (tmp_path / "user.txt").read_text() == "of the user"
    assert (tmp_path / ".roofslip-notes" / "mine.txt").read_text() == "of the user"


@pytest.mark.parametrize("step", range(1, 12))
def test_a_run_killed_after_any_rename_is_finished_by_the_next(
    tmp_path, before_each_replacement, step
):
    publish(OLD, tmp_path)
    left = [step]

    def counted(*_):
        left[0] -= 1
        if left[0] <= 0:  # nothing is done from there on
            raise Killed

    try:
        with before_each_replacement(counted):
            publish(NEW, tmp_path)
    except Killed:
        finish(tmp_path)
    else:
        assert step > 5
    assert is_whole(tmp_path)
    # The first one puts the journal in place.
    assert contents(tmp_path) == (OLD if step == 1 else NEW)


def test_a_set_half_put_back_is_put_back_by_the_next_run(tmp_path, before_each_replacement):
    former = OLD | {"c.txt": b"old c"}
    publish(former, tmp_path)

    def failing(source, target):
        if target == str(tmp_path / "c.txt"):
            raise PermissionError(13, "Permission denied")
        if target == str(tmp_path / "b.txt") and "old" in source:
            raise Killed

    with before_each_replacement(failing), pytest.raises(Killed):
        publish(NEW, tmp_path)
    assert not is_whole(tmp_path)
    finish(tmp_path)
    assert is_whole(tmp_path)
    assert contents(tmp_path) == former


def test_two_runs_at_once_never_mix_their_sets(tmp_path):
    children = [writer(tmp_path, start, 2, 0.05) for start in (0, 1)]
    for child in children:
        child.stdout.readline()
    until = time.monotonic() + 1.0
    seen = set()
    while time.monotonic() < until:
        before = (tmp_path / STAMP).read_bytes()
        numbers, whole = numbers_of(tmp_path), is_whole(tmp_path)
        if whole and (tmp_path / STAMP).read_bytes() == before:
            assert len(numbers) == 1
            seen |= numbers
    for child in children:
        end(child)
    finish(tmp_path)
    assert is_whole(tmp_path)
    assert len(seen) > 2


def test_a_run_waits_for_the_lock_of_another_and_then_says_so(tmp_path, monkeypatch):
    monkeypatch.setattr("report.results.publish.WAIT_S", 0.2)
    words = "another run has been writing there for 0.2 s"
    with locked(tmp_path), pytest.raises(InputError, match=words):
        publish(OLD, tmp_path)
    assert contents(tmp_path) == {}


@pytest.mark.parametrize("way", ["the same", "another spelling", "a link", "a hard link"])
def test_an_input_is_not_replaced_by_an_output(tmp_path, way):
    (tmp_path / "job").mkdir()
    book = tmp_path / "job" / "results.xlsx"
    book.write_bytes(b"input")
    folder, path = book.parent, book
    if way == "another spelling":
        folder = tmp_path / "job" / ".." / "job"
    elif way == "a link":
        folder = tmp_path / "linked"
        folder.symlink_to(book.parent)
    elif way == "a hard link":
        path = tmp_path / "input.xlsx"
        os.link(book, path)
    with pytest.raises(InputError, match=r"is an input of this run, and would be replaced by its"):
        check_apart(["results.xlsx"], folder, [path])
    check_apart(["results.xlsx"], tmp_path, [path])
