"""Outputs are written as one set, also by killed runs; the stamp is read by hashlib here."""

import errno
import hashlib
import os
import shutil
import signal
import subprocess
import sys

import pytest

import report.results.publish
from fixtures.marks import by_day
from fixtures.paths import ROOT
from report.results.publish import (
    STAMP,
    check_apart,
    check_of_workbook,
    output_folder,
    publish,
    warn_if_mixed,
)
from solver.errors import InputError
from solver.file_writing import locked


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
    """A function that has another one called before each replacement, with its two paths."""
    replace = os.replace

    def call(function):
        def replaced(source, target):
            function(str(source), str(target))
            replace(source, target)

        monkeypatch.setattr(os, "replace", replaced)

    return call


OLD = {"a.txt": b"old a", "b.txt": b"old b"}
NEW = {"a.txt": b"new a", "b.txt": b"new b", "c.txt": b"new c"}


def contents(folder):
    return {path.name: path.read_bytes() for path in folder.glob("*.txt") if path.is_file()}


def test_a_file_that_cannot_be_replaced_changes_nothing_and_is_named(tmp_path):
    publish(OLD, tmp_path)
    (tmp_path / "c.txt").mkdir()
    with pytest.raises(InputError, match=r"c\.txt: is a folder"), pytest.warns(match="says: c.txt"):
        publish(NEW, tmp_path)
    assert names_in(tmp_path) == ["a.txt", "b.txt", "c.txt", STAMP]
    assert contents(tmp_path) == OLD
    assert is_whole(tmp_path)


def test_what_a_set_no_longer_has_is_removed_unless_it_was_changed(tmp_path):
    names = ("a.txt", "b.txt", "c.txt", "other.txt")
    publish(NEW, tmp_path, names)
    (tmp_path / "other.txt").write_bytes(b"of the user")
    with pytest.warns(match=r"says: other\.txt"):
        publish(OLD, tmp_path, names)
    assert contents(tmp_path) == {**OLD, "other.txt": b"of the user"}
    publish(NEW, tmp_path, ("a.txt", "b.txt", "c.txt"))
    (tmp_path / "c.txt").write_bytes(b"changed")
    with pytest.warns(match=r"says: c\.txt"):
        publish(OLD, tmp_path, ("a.txt", "b.txt", "c.txt"))
    assert contents(tmp_path)["c.txt"] == b"changed"


@pytest.mark.parametrize("at", ["a.txt", "b.txt", STAMP])
def test_ctrl_c_while_files_are_replaced_leaves_one_whole_set(
    tmp_path, before_each_replacement, at
):
    publish(OLD, tmp_path)
    interrupts = [KeyboardInterrupt]

    def interrupted(_, target):
        if target.endswith(at) and interrupts:
            raise interrupts.pop()

    before_each_replacement(interrupted)
    with pytest.raises(KeyboardInterrupt):
        publish(NEW, tmp_path)
    assert contents(tmp_path) == OLD
    assert names_in(tmp_path) == [*sorted(contents(tmp_path)), STAMP]
    assert is_whole(tmp_path)


def test_the_stamp_is_one_of_sha256sum(tmp_path):
    tool = shutil.which("sha256sum")
    if tool is None:
        pytest.skip("no sha256sum here")
    publish({"a.txt": b"1", "sub/b.txt": b"2"}, tmp_path)
    done = subprocess.run([tool, "-c", STAMP], cwd=tmp_path, capture_output=True, text=True)
    assert done.stdout.splitlines() == ["a.txt: OK", "sub/b.txt: OK"]


def test_a_full_disk_leaves_the_old_package(tmp_path, files_up_to):
    publish({"a.txt": b"old"}, tmp_path)
    with files_up_to(1000), pytest.raises(InputError, match="File too large"):
        publish({"b.txt": b"new", "a.txt": b"new" * 1000}, tmp_path)
    assert names_in(tmp_path) == ["a.txt", STAMP]
    assert (tmp_path / "a.txt").read_bytes() == b"old"


@pytest.mark.parametrize("before", [OLD, {}], ids=["", "first run"])
@pytest.mark.parametrize("stop", by_day(["a.txt", "b.txt", "c.txt", STAMP], 2))
def test_a_set_cut_off_before_any_replacement_is_told_and_made_whole_by_the_next(
    tmp_path, before, stop
):
    if before:
        publish(before, tmp_path)
    assert writer_killed_at(tmp_path, stop).returncode == -signal.SIGKILL
    parts = [name for name in names_in(tmp_path) if name.endswith(".part")]
    if stop == "a.txt":
        publish(NEW, tmp_path)
    else:
        mixed = {"b.txt": "a.txt", "c.txt": "a.txt, b.txt", STAMP: "a.txt, b.txt, c.txt"}[stop]
        with pytest.warns(
            match=rf"not as {STAMP} says: {mixed}; a run was interrupted, or"
            r" files were"
        ):
            publish(NEW, tmp_path)
    assert contents(tmp_path) == NEW
    assert is_whole(tmp_path)
    # Only names that are written are touched: what was staged stays, hidden.
    assert [name for name in names_in(tmp_path) if name.startswith(".")] == parts


CUT_OFF = """
import os, signal, sys
from pathlib import Path
from report.results.publish import publish
rename = os.replace
def renamed(source, target):
    if Path(target).name == sys.argv[2]:
        os.kill(os.getpid(), signal.SIGKILL)
    rename(source, target)
os.replace = renamed
publish({"a.txt": b"new a", "b.txt": b"new b", "c.txt": b"new c"}, Path(sys.argv[1]))
"""


def writer_killed_at(folder, name):
    command = [sys.executable, "-c", CUT_OFF, str(folder), name]
    return subprocess.run(command, cwd=ROOT, check=False)


@pytest.mark.parametrize("name", ["a.txt", STAMP])
@pytest.mark.parametrize("kind", ["pipe", "link", "endless"])
@pytest.mark.quick
def test_what_is_no_file_is_not_read_for_the_stamp(tmp_path, kind, name):
    publish(OLD, tmp_path)
    path = tmp_path / name
    path.unlink()
    if kind == "pipe":
        os.mkfifo(path)
    elif kind == "link":
        (tmp_path / "same").write_bytes(OLD["a.txt"])
        path.symlink_to("same")
    else:
        with path.open("wb") as file:
            file.truncate(10**13)  # without a block on the disk
    with pytest.warns(match="a.txt"):
        warn_if_mixed(tmp_path, OLD)


def test_a_usual_folder_is_refused_where_it_is_a_link_and_one_that_is_given_is_not(tmp_path):
    (tmp_path / "elsewhere").mkdir()
    (tmp_path / "out").symlink_to(tmp_path / "elsewhere")
    for usual in ("out", "out/study"):
        with pytest.raises(InputError, match=r"out: is a link to .*/elsewhere, and is not written"):
            output_folder(None, tmp_path, usual)
    assert output_folder(tmp_path / "out", tmp_path, "out") == tmp_path / "out"
    (tmp_path / "out" / "b.txt").symlink_to(tmp_path)
    with pytest.raises(InputError, match=r"out/b.txt: is a link"):
        output_folder(tmp_path / "out", tmp_path, "out", ["a.txt", "b.txt"])


def test_a_folder_that_cannot_be_made_is_refused_before_anything_is_computed(tmp_path, monkeypatch):
    assert output_folder(tmp_path / "a" / "b", tmp_path, "out") == tmp_path / "a" / "b"
    assert not (tmp_path / "a").exists()

    def full(*_, **__):
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    monkeypatch.setattr(report.results.publish, "TemporaryFile", full)
    with pytest.raises(InputError, match=r"a: cannot be written .*another folder with --out"):
        output_folder(tmp_path / "a", tmp_path, "out")
    assert not (tmp_path / "a").exists()


def test_a_run_waits_for_the_lock_of_another_and_then_says_so(tmp_path, monkeypatch):
    monkeypatch.setattr("solver.file_writing.WAIT_S", 0.2)
    words = "another command has been writing there for 0.2 s"
    with locked(tmp_path), pytest.raises(InputError, match=words):
        publish(OLD, tmp_path)
    assert contents(tmp_path) == {}


def test_the_lock_is_held_until_the_last_file_is_replaced(
    tmp_path, monkeypatch, before_each_replacement
):
    monkeypatch.setattr("solver.file_writing.WAIT_S", 0.0)
    held = []

    def another(_, target):
        with pytest.raises(InputError, match="another command has been writing"), locked(tmp_path):
            pass
        held.append(target)

    before_each_replacement(another)
    publish(NEW, tmp_path)
    assert [name.rpartition("/")[2] for name in held] == [*NEW, STAMP]


@pytest.mark.parametrize("way", ["another spelling", "a link", "a hard link"])
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
    with pytest.raises(InputError, match=r"is an input of this run and would be replaced by its"):
        check_apart(["results.xlsx"], folder, [path])
    check_apart(["results.xlsx"], tmp_path, [path])


@pytest.mark.quick
def test_results_of_another_workbook_are_not_replaced_and_those_that_name_none_are_of_none(
    tmp_path,
):
    for content in (None, b"", b"[1]", b'{"workbook": "a.xlsx"}', b'{"workbook": {"name": 1}}'):
        if content is not None:
            (tmp_path / "results.json").write_bytes(content)
        check_of_workbook(tmp_path, "results.json", "b.xlsx")
    (tmp_path / "results.json").write_bytes(b'{"workbook": {"name": "a.xlsx"}}')
    check_of_workbook(tmp_path, "results.json", "a.xlsx")
    with pytest.raises(InputError, match=r"the results of a\.xlsx, not of b\.xlsx; .* --out, or"):
        check_of_workbook(tmp_path, "results.json", "b.xlsx")
