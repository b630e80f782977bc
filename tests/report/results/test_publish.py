"""Outputs are written as one set, also by killed runs and by two runs at once.

The reader of the stamp here is independent: hashlib, and the format of sha256sum.
"""

import hashlib
import os
import random
import shutil
import signal
import subprocess
import sys
import threading
import time

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


def test_files_are_published_together(tmp_path):
    publish({"a.txt": b"1", "b.txt": b"2"}, tmp_path / "out")
    assert names_in(tmp_path / "out") == ["a.txt", "b.txt", STAMP]
    publish({"a.txt": b"3", "b.txt": b"4"}, tmp_path / "out")
    assert (tmp_path / "out" / "a.txt").read_bytes() == b"3"


def test_a_locked_file_changes_nothing_and_is_named(tmp_path, monkeypatch):
    publish({"a.txt": b"old a"}, tmp_path)
    replace = os.replace

    def opened(source, target):
        if str(target).endswith("c.txt"):
            raise PermissionError(13, "Permission denied")
        replace(source, target)

    monkeypatch.setattr(os, "replace", opened)
    with pytest.raises(InputError, match=r"c\.txt: cannot be replaced .*close it"):
        publish({"a.txt": b"new a", "b.txt": b"new b", "c.txt": b"new c"}, tmp_path)
    assert names_in(tmp_path) == ["a.txt", STAMP]
    assert (tmp_path / "a.txt").read_bytes() == b"old a"
    assert is_whole(tmp_path)


@pytest.mark.parametrize("at", ["forward.json", "a.txt", "b.txt", STAMP])
def test_ctrl_c_while_files_are_replaced_leaves_one_whole_set(tmp_path, monkeypatch, at):
    publish({"a.txt": b"old a", "b.txt": b"old b"}, tmp_path)
    replace, interrupts = os.replace, [KeyboardInterrupt]

    def interrupted(source, target):
        if str(target).endswith(at) and interrupts:
            raise interrupts.pop()
        replace(source, target)

    monkeypatch.setattr(os, "replace", interrupted)
    with pytest.raises(KeyboardInterrupt):
        publish({"a.txt": b"new a", "b.txt": b"new b"}, tmp_path)
    assert names_in(tmp_path) == ["a.txt", "b.txt", STAMP]
    assert is_whole(tmp_path)
    found = {(tmp_path / name).read_bytes()[:3] for name in ("a.txt", "b.txt")}
    assert found == {b"old" if at == "forward.json" else b"new"}


def test_a_folder_in_place_of_a_file_is_reported(tmp_path):
    (tmp_path / "a.txt").mkdir()
    with pytest.raises(InputError, match=r"a\.txt: cannot be replaced"):
        publish({"a.txt": b"1"}, tmp_path)
    assert (tmp_path / "a.txt").is_dir()


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
    arguments = [sys.executable, "-c", WRITER, str(folder), str(start), str(step)]
    arguments.append(str(pause_s))
    return subprocess.Popen(arguments, stdout=subprocess.PIPE)


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
        child.send_signal(signal.SIGKILL)
        child.wait()
        child.stdout.close()
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
def test_a_run_killed_after_any_rename_is_finished_by_the_next(tmp_path, monkeypatch, step):
    publish({"a.txt": b"old a", "b.txt": b"old b"}, tmp_path)
    left, replace = [step], os.replace

    class Killed(BaseException):
        pass

    def counted(source, target):
        left[0] -= 1
        if left[0] <= 0:  # nothing is done from there on
            raise Killed
        replace(source, target)

    monkeypatch.setattr(os, "replace", counted)
    try:
        publish({"a.txt": b"new a", "b.txt": b"new b", "c.txt": b"new c"}, tmp_path)
    except Killed:
        monkeypatch.undo()
        finish(tmp_path)
    else:
        assert step > 5
        monkeypatch.undo()
    assert is_whole(tmp_path)
    contents = {name: (tmp_path / name).read_bytes() for name in ("a.txt", "b.txt")}
    if step == 1:  # the journal was not in place
        assert contents == {"a.txt": b"old a", "b.txt": b"old b"}
        assert not (tmp_path / "c.txt").exists()
    else:
        assert contents == {"a.txt": b"new a", "b.txt": b"new b"}
        assert (tmp_path / "c.txt").read_bytes() == b"new c"


def test_a_set_half_put_back_is_put_back_by_the_next_run(tmp_path, monkeypatch):
    publish({"a.txt": b"old a", "b.txt": b"old b", "c.txt": b"old c"}, tmp_path)
    replace = os.replace

    class Killed(BaseException):
        pass

    def failing(source, target):
        if str(target) == str(tmp_path / "c.txt"):
            raise PermissionError(13, "Permission denied")
        if str(target) == str(tmp_path / "b.txt") and "old" in str(source):
            raise Killed
        replace(source, target)

    monkeypatch.setattr(os, "replace", failing)
    with pytest.raises(Killed):
        publish({"a.txt": b"new a", "b.txt": b"new b", "c.txt": b"new c"}, tmp_path)
    monkeypatch.undo()
    assert not is_whole(tmp_path)
    finish(tmp_path)
    assert is_whole(tmp_path)
    assert (tmp_path / "a.txt").read_bytes() == b"old a"


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
        child.kill()
        child.wait()
        child.stdout.close()
    finish(tmp_path)
    assert is_whole(tmp_path)
    assert len(seen) > 2


def test_a_run_waits_for_the_lock_of_another_and_then_says_so(tmp_path):
    with locked(tmp_path):
        errors = []

        def second():
            try:
                publish({"a.txt": b"1"}, tmp_path, wait_s=0.2)
            except InputError as error:
                errors.append(str(error))

        other = threading.Thread(target=second)
        other.start()
        other.join()
    assert len(errors) == 1
    assert "another run has been writing there" in errors[0]
    assert not (tmp_path / "a.txt").exists()


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
