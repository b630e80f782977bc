"""A file is written whole or not at all."""

import os
import re
import subprocess
import sys
from contextlib import contextmanager

import pytest

from places import ROOT
from solver.files import LOCK, locked, write_all, write_whole
from solver.model import InputError
from stranger import LINKS, MODES, PIPES, SENTENCES, not_on_windows, occupied

pytestmark = pytest.mark.quick


@pytest.fixture
def path(tmp_path):
    return tmp_path / "a.csv"


def test_a_file_is_written_in_one_and_of_two_names_in_one(tmp_path, path):
    write_whole(path, b"1")
    write_whole(path, b"2")
    assert path.read_bytes() == b"2"
    assert [entry.name for entry in tmp_path.iterdir()] == ["a.csv"]
    umask = os.umask(0)
    os.umask(umask)
    assert path.stat().st_mode & 0o777 == 0o666 & ~umask
    path.write_bytes(b"old")
    os.link(path, tmp_path / "other")
    write_all({"a.csv": b"new"}, tmp_path)
    assert (path.read_bytes(), (tmp_path / "other").read_bytes()) == (b"new", b"old")


@not_on_windows(LINKS)
def test_a_link_that_the_user_gave_is_followed(tmp_path, path):
    target = tmp_path / "target.csv"
    target.write_bytes(b"old")
    path.symlink_to(target)
    write_whole(path, b"new")
    assert path.is_symlink()
    assert target.read_bytes() == b"new"


def in_any(name):
    """Return an expression for a name with the separator of any system."""
    return re.escape(name).replace("/", r"[/\\]")


TOLD = {
    "link": "is a link to .*/outside",
    "dangling link": "is a link to .*/nowhere",
    "device": "is a link to /dev/null",
    "pipe": "is a pipe or a device",
    "folder": "is a folder, not a file",
}


@pytest.mark.parametrize("kind", TOLD)
@pytest.mark.parametrize("name", ["b.csv", "sub/b.csv"])
def test_nothing_is_written_through_what_is_in_the_place_of_a_file(tmp_path, kind, name):
    outside, folder = tmp_path / "outside", tmp_path / "here"
    (folder / "sub").mkdir(parents=True)
    outside.write_bytes(b"old")
    (folder / "a.csv").write_bytes(b"old")
    occupied(folder / name, kind, outside)
    with pytest.raises(InputError, match=rf"{in_any(name)}: {TOLD[kind]}.*; move it away"):
        write_all({"a.csv": b"new", name: b"new"}, folder)
    assert sorted(os.listdir(tmp_path)) == ["here", "outside"]
    assert outside.read_bytes() == (folder / "a.csv").read_bytes() == b"old"
    assert not list(folder.rglob(".*"))


@pytest.mark.parametrize("kind", [pytest.param("link", marks=not_on_windows(LINKS)), "file"])
def test_nothing_is_written_through_what_is_in_the_place_of_a_folder(tmp_path, kind):
    (tmp_path / "outside").mkdir()
    here = tmp_path / "here"
    here.mkdir()
    if kind == "link":
        (here / "sub").symlink_to(tmp_path / "outside")
    else:
        (here / "sub").write_bytes(b"")
    told = "is a link to .*/outside" if kind == "link" else "is a file, not a folder"
    with pytest.raises(InputError, match=rf"{in_any('here/sub')}: {told}"):
        write_all({"sub/deep/a.csv": b"new"}, here)
    assert os.listdir(tmp_path / "outside") == []


@not_on_windows(LINKS)
def test_a_folder_that_the_user_gave_may_be_a_link(tmp_path):
    (tmp_path / "real").mkdir()
    (tmp_path / "given").symlink_to(tmp_path / "real")
    write_all({"sub/a.csv": b"new"}, tmp_path / "given")
    assert (tmp_path / "real" / "sub" / "a.csv").read_bytes() == b"new"


@pytest.mark.parametrize("name", ["a.csv", "b.csv", "sub/d.csv", "c.csv"])
@pytest.mark.parametrize("has_links", [True, False])
@pytest.mark.parametrize("is_new", [True, False])
def test_of_a_set_that_cannot_be_written_nothing_is(tmp_path, monkeypatch, name, has_links, is_new):
    before = {} if is_new else dict.fromkeys(("a.csv", "b.csv", "c.csv"), b"old")
    folder, failures, rename = tmp_path / "here", [1], os.replace
    if before:
        write_all(before, folder)

    def renamed(source, target):
        if target == folder / name and failures:
            failures.pop()
            refused()
        rename(source, target)

    if not has_links:
        monkeypatch.setattr(os, "link", refused)
    monkeypatch.setattr("solver.files.PAUSES_S", ())
    monkeypatch.setattr(os, "replace", renamed)
    told = "cannot be written .*not permitted.*in other programs. No file was changed"
    with pytest.raises(InputError, match=f"{in_any(name)}: {told}"):
        write_all(dict.fromkeys(("a.csv", "b.csv", "sub/d.csv", "c.csv"), b"new"), folder)
    assert {path.name: path.read_bytes() for path in folder.glob("*")} == before
    assert folder.exists() is not is_new


@pytest.fixture
def refusing(monkeypatch):
    """A function that has renames to a name refused some times, as Windows does to open files."""
    rename = os.replace

    def refuse(name, times):
        left = [name] * times

        def renamed(source, target):
            if target.name in left:
                left.remove(target.name)
                refused()
            rename(source, target)

        monkeypatch.setattr(os, "replace", renamed)

    return refuse


def test_of_a_set_with_a_file_that_stays_open_elsewhere_nothing_is_changed(tmp_path, refusing):
    before, after = (dict.fromkeys(("a.csv", "b.csv"), text) for text in (b"old", b"new"))
    write_all(before, tmp_path)
    refusing("b.csv", 99)
    told = r"b\.csv: cannot be written .*; close it in other programs. No file was changed"
    with pytest.raises(InputError, match=told):
        write_all(after, tmp_path)
    assert {path.name: path.read_bytes() for path in tmp_path.iterdir()} == before


def test_a_file_that_is_open_elsewhere_for_a_moment_is_replaced(path, refusing, monkeypatch):
    monkeypatch.setattr("solver.files.PAUSES_S", (0.0, 0.0))
    refusing("a.csv", 2)
    write_whole(path, b"new")
    assert path.read_bytes() == b"new"


def test_a_second_process_waits_for_the_first_and_then_says_so(tmp_path, monkeypatch):
    monkeypatch.setattr("solver.files.WAIT_S", 0.2)
    with locked(tmp_path):
        with pytest.raises(InputError, match=r"another command has been writing there for 0\.2 s"):
            locked(tmp_path).__enter__()
        with locked_elsewhere(tmp_path) as other:
            assert other.poll() is None  # it waits
    with locked(tmp_path):
        pass
    assert os.listdir(tmp_path) == []


@contextmanager
def locked_elsewhere(folder):
    """A process that takes the lock of a folder once it can."""
    script = "import sys; from pathlib import Path; from solver.files import locked\n"
    script += "print(flush=True)\nwith locked(Path(sys.argv[1])): print(flush=True)"
    command = [sys.executable, "-c", script, str(folder)]
    with subprocess.Popen(command, cwd=ROOT, stdout=subprocess.PIPE) as child:
        child.stdout.readline()
        yield child
        child.kill()


@pytest.mark.parametrize("kind", [*TOLD, "hard link"])
def test_a_lock_is_not_opened_through_what_is_in_its_place(tmp_path, kind):
    outside, folder = tmp_path / "outside", tmp_path / "here"
    folder.mkdir()
    outside.write_bytes(b"old")
    occupied(folder / LOCK, kind, outside)
    told = TOLD.get(kind, "is also the file of another name")
    with pytest.raises(InputError, match=rf"{LOCK}: {told}"):
        locked(folder).__enter__()
    assert outside.read_bytes() == b"old"


def test_a_lock_that_a_killed_process_left_holds_nobody_up(tmp_path):
    (tmp_path / LOCK).touch()
    with locked(tmp_path):
        pass
    assert os.listdir(tmp_path) == []


@pytest.mark.parametrize("former", [b"old", b""])
def test_a_full_disk_leaves_the_former_file_or_none(tmp_path, path, files_up_to, former):
    if former:
        path.write_bytes(former)
    told = r"a\.csv: cannot be written \(File too large"
    with files_up_to(100), pytest.raises(InputError, match=told):
        write_whole(path, b"new" * 100)
    assert [entry.read_bytes() for entry in tmp_path.iterdir()] == ([former] if former else [])


@not_on_windows(SENTENCES)
def test_a_name_that_is_too_long_is_an_input_error(tmp_path):
    with pytest.raises(InputError, match="File name too long"):
        write_whole(tmp_path / ("x" * 300), b"")


def refused(*_):
    raise PermissionError(1, "Operation not permitted")


@not_on_windows(PIPES)
def test_only_names_that_are_written_are_touched(tmp_path, path):
    left = tmp_path / ".roofslip-0123456789abcdef.part"
    os.mkfifo(left)
    kept = {".roofslip-fedcba9876543210.part": "of the user", ".roofslip-notes.part": "mine"}
    for name, text in kept.items():
        (tmp_path / name).write_text(text)
    write_whole(path, b"1")
    assert left.is_fifo()
    assert {name: (tmp_path / name).read_text() for name in kept} == kept
    assert set(os.listdir(tmp_path)) == {"a.csv", left.name, *kept}


@not_on_windows(MODES)
def test_a_replaced_file_keeps_its_permissions(path):
    path.touch()
    path.chmod(0o640)
    write_whole(path, b"1")
    assert path.stat().st_mode & 0o777 == 0o640
