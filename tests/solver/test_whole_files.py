"""A file is written whole or not at all."""

import os
import signal
import subprocess
import sys

import pytest

from places import ROOT
from solver import files
from solver.files import write_whole
from solver.model import InputError


@pytest.fixture
def path(tmp_path):
    return tmp_path / "a.csv"


def test_a_file_is_written_and_replaced(tmp_path, path):
    write_whole(path, b"1")
    write_whole(path, b"2")
    assert path.read_bytes() == b"2"
    assert [entry.name for entry in tmp_path.iterdir()] == ["a.csv"]
    umask = os.umask(0)
    os.umask(umask)
    assert path.stat().st_mode & 0o777 == 0o666 & ~umask


@pytest.mark.parametrize("kind", ["file", "folder", "dangling link"])
def test_what_exists_is_not_replaced_unless_asked_for(tmp_path, path, kind):
    if kind == "file":
        path.write_bytes(b"old")
    elif kind == "folder":
        path.mkdir()
    else:
        path.symlink_to(tmp_path / "elsewhere.csv")
    with pytest.raises(InputError, match="already exists; give another name"):
        write_whole(path, b"new", replace=False)
    assert not (tmp_path / "elsewhere.csv").exists()
    assert [entry.name for entry in tmp_path.iterdir()] == ["a.csv"]


def test_a_link_is_replaced_and_not_followed(tmp_path, path):
    target = tmp_path / "target.csv"
    target.write_bytes(b"old")
    path.symlink_to(target)
    write_whole(path, b"new")
    assert (target.read_bytes(), path.read_bytes()) == (b"old", b"new")


@pytest.mark.parametrize("replace", [True, False])
def test_a_full_disk_leaves_the_former_file_or_none(tmp_path, path, files_up_to, replace):
    if replace:
        path.write_bytes(b"old")
    told = r"a\.csv: cannot be written \(File too large"
    with files_up_to(100), pytest.raises(InputError, match=told):
        write_whole(path, b"new" * 100, replace=replace)
    assert [entry.read_bytes() for entry in tmp_path.iterdir()] == ([b"old"] if replace else [])


def test_a_name_that_is_too_long_is_an_input_error(tmp_path):
    with pytest.raises(InputError, match="File name too long"):
        write_whole(tmp_path / ("x" * 300), b"")


def refused(*_):
    raise PermissionError(1, "Operation not permitted")


def test_a_file_system_without_hard_links_is_written_to(path, monkeypatch):
    monkeypatch.setattr(os, "link", refused)
    write_whole(path, b"new", replace=False)
    assert path.read_bytes() == b"new"
    with pytest.raises(InputError, match="already exists"):
        write_whole(path, b"newer", replace=False)


# Begins to write and waits for ever with half a file.
WRITER = """
import os, sys, time
from pathlib import Path
from solver.files import write_whole
os.fsync = lambda file: (print(flush=True), time.sleep(1000))
write_whole(Path(sys.argv[1]), b"half")
"""


def test_what_a_killed_writer_left_is_swept_up_and_nothing_else(tmp_path):
    command = [sys.executable, "-c", WRITER, tmp_path / "b.csv"]
    writers = [subprocess.Popen(command, cwd=ROOT, stdout=subprocess.PIPE) for _ in range(2)]
    killed, living = writers
    for writer in writers:
        writer.stdout.readline()
    foreign = {".roofslip-notes.part", ".roofslip-0123456789abcdef.part.txt", "notes.part"}
    for name in foreign:
        (tmp_path / name).write_text("of the user")
    (tmp_path / ".roofslip-0123456789abcdef.part").symlink_to(tmp_path / "notes.part")
    killed.send_signal(signal.SIGKILL)
    killed.wait()
    before = set(os.listdir(tmp_path))
    write_whole(tmp_path / "a.csv", b"1")
    left = set(os.listdir(tmp_path))
    assert (len(before - left), left - before) == (1, {"a.csv"})
    assert foreign < left
    living.kill()
    living.wait()
    write_whole(tmp_path / "a.csv", b"2")
    assert set(os.listdir(tmp_path)) == foreign | {"a.csv", ".roofslip-0123456789abcdef.part"}
    for writer in writers:
        writer.stdout.close()


def test_a_file_that_is_swept_before_it_is_locked_is_begun_again(tmp_path, path, monkeypatch):
    swept, flock = [], files.fcntl.flock

    def late(file, how):
        if not swept:
            swept.extend(os.listdir(tmp_path))
            (tmp_path / swept[0]).unlink()
        flock(file, how)

    monkeypatch.setattr(files.fcntl, "flock", late)
    write_whole(path, b"1")
    assert len(swept) == 1
    assert os.listdir(tmp_path) == ["a.csv"]


def test_a_file_system_without_locks_is_written_to_and_not_swept(tmp_path, path, monkeypatch):
    monkeypatch.setattr(files.fcntl, "flock", refused)
    left = tmp_path / ".roofslip-0123456789abcdef.part"
    left.touch()
    write_whole(path, b"1")
    assert path.read_bytes() == b"1"
    assert left.exists()


def test_a_replaced_file_keeps_its_permissions(path):
    path.touch()
    path.chmod(0o640)
    write_whole(path, b"1")
    assert path.stat().st_mode & 0o777 == 0o640
