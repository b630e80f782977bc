"""A file is written whole or not at all; of a path that is not there, one near is named."""

import os
import re
import shutil
import subprocess
import sys
from contextlib import contextmanager

import pytest
from click.testing import CliRunner

from fixtures import commands
from fixtures.folders import LINKS, PIPES, SENTENCES, not_on_windows, occupied
from fixtures.growth import grows_faster
from fixtures.paths import ROOT
from report.cli.main import main
from solver.errors import InputError
from solver.file_checks import within
from solver.file_writing import LOCK, locked, write_all, write_whole
from solver.suggestions import meant, nearest

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
    path.chmod(0o640)
    write_all({"a.csv": b"new"}, tmp_path)
    assert (path.read_bytes(), (tmp_path / "other").read_bytes()) == (b"new", b"old")
    if sys.platform != "win32":
        assert path.stat().st_mode & 0o777 == 0o640


@not_on_windows(LINKS)
def test_a_link_that_the_user_gave_is_followed(tmp_path, path):
    target = tmp_path / "target.csv"
    target.write_bytes(b"old")
    path.symlink_to(target)
    write_whole(path, b"new")
    assert path.is_symlink()
    assert target.read_bytes() == b"new"
    (tmp_path / "real").mkdir()
    (tmp_path / "given").symlink_to(tmp_path / "real")
    write_all({"sub/a.csv": b"new"}, tmp_path / "given")
    assert (tmp_path / "real" / "sub" / "a.csv").read_bytes() == b"new"


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
    monkeypatch.setattr("solver.file_writing.PAUSES_S", ())
    monkeypatch.setattr(os, "replace", renamed)
    told = "cannot be written .*not permitted.*in other programs. No file was changed"
    with pytest.raises(InputError, match=f"{in_any(name)}: {told}"):
        write_all(dict.fromkeys(("a.csv", "b.csv", "sub/d.csv", "c.csv"), b"new"), folder)
    assert {path.name: path.read_bytes() for path in folder.glob("*")} == before
    assert folder.exists() is not is_new


def test_a_file_that_is_open_elsewhere_for_a_moment_is_replaced(path, monkeypatch):
    left, rename = [1, 2], os.replace

    def renamed(source, target):
        if left:
            left.pop()
            refused()  # as Windows does to open files
        rename(source, target)

    monkeypatch.setattr("solver.file_writing.PAUSES_S", (0.0, 0.0))
    monkeypatch.setattr(os, "replace", renamed)
    write_whole(path, b"new")
    assert path.read_bytes() == b"new"


def test_a_second_process_waits_for_the_first_and_then_says_so(tmp_path, monkeypatch):
    monkeypatch.setattr("solver.file_writing.WAIT_S", 0.2)
    with locked(tmp_path):
        with pytest.raises(InputError, match=r"another command has been writing there for 0\.2 s"):
            locked(tmp_path).__enter__()
        with locked_elsewhere(tmp_path) as other:
            assert other.poll() is None  # it waits
    (tmp_path / LOCK).touch()  # as a killed process leaves it
    with locked(tmp_path):
        pass
    assert os.listdir(tmp_path) == []


@contextmanager
def locked_elsewhere(folder):
    """A process that takes the lock of a folder once it can."""
    script = "import sys; from pathlib import Path; from solver.file_writing import locked\n"
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


@pytest.fixture
def folder(tmp_path):
    (tmp_path / "project" / "records").mkdir(parents=True)
    (tmp_path / "project" / "records" / "RM1-x.csv").write_text("0.1\n")
    (tmp_path / "project" / "results.json").write_text("{}")
    return tmp_path


@pytest.mark.parametrize(
    ("given", "found"),
    [
        ("project/records/RM1_x.csv", "project/records/RM1-x.csv"),
        ("projetc/records/RM1-x.csv", "project/records/RM1-x.csv"),
        ("projetc/records/none.csv", "project"),
        ("project/result.json", "project/results.json"),
    ],
)
def test_a_path_that_nearly_fits_is_named(folder, given, found):
    assert meant(folder / given) == f"did you mean '{folder / found}'?"
    for other in ("elsewhere/x", "project/records/RM1-x.csv", "a" * 300):
        assert meant(folder / other) == ""


@pytest.mark.parametrize(
    "arguments",
    [
        ["check", "projetc"],
        ["plan", "read", "projetc", "project"],
        ["motion", "suite", "out", "--code", "asce7-16", "--target", "projetc"],
    ],
)
def test_each_command_asks_about_a_path_that_nearly_fits(folder, monkeypatch, arguments):
    shutil.copy(ROOT / "projects" / "example" / "input.xlsx", folder / "project")
    monkeypatch.chdir(folder)
    done = CliRunner().invoke(main, arguments)
    assert done.exit_code == 2
    assert "did you mean 'project'?" in done.output


@pytest.mark.parametrize(
    ("value", "names", "found"),
    [
        ("RTU-1", ["RTU 1", "RTU-3", "RTU-2"], "RTU 1"),
        ("a1", ["A01", "A11", "A2"], "A01"),
        ("RTU-1", ["RTU-2", "RTU-3"], ""),  # a tie
        ("Skylite", ["Skylight", "RTU"], "Skylight"),
        ("x", [], ""),
    ],
)
def test_names_are_compared_without_blanks_hyphens_and_leading_zeros_first(value, names, found):
    assert nearest(value, names) == found
    assert nearest(value, names[::-1]) == found


def test_names_that_are_near_are_found_free_and_among_many():
    names = [f"RM{k}-x.csv" for k in range(1, 4)]
    assert nearest("RM-x.csv", names) == ""
    assert nearest("RM-x.csv", names, taken=["RM2-x.csv", "RM3-x.csv"]) == "RM1-x.csv"
    assert nearest("RM-x.csv", names, taken=["RM3-x.csv"]) == ""
    names = [f"{k:02}{'x' * 60}" for k in range(100)]
    assert nearest(f"98{'x' * 59}y", names) == names[98]


def test_the_lock_file_of_a_workbook_is_never_meant(tmp_path):
    for name in ("My Project.xlsx", "~$input.xlsx", "~$My Project.xlsx", ".~lock.input.xlsx#"):
        (tmp_path / name).write_bytes(b"")
    assert f"did you mean '{tmp_path / 'My Project.xlsx'}'?" in commands.errors_of(
        "check", tmp_path
    )
    (tmp_path / "other.xlsx").write_bytes(b"")
    asked = commands.errors_of("check", tmp_path)
    both = f"did you mean '{tmp_path / 'My Project.xlsx'}' or '{tmp_path / 'other.xlsx'}'?"
    assert both in asked
    assert "lock.input" not in asked
    assert "~$" not in asked


@pytest.mark.nightly
def test_as_many_wrong_names_as_there_are_names_take_time_as_their_number():
    def suggested(count):
        names = [f"{'ab' * 18}{k}" for k in range(count)]
        return [nearest(f"{'ba' * 18}{k}", names) for k in range(count)]

    assert not grows_faster(suggested, lambda count: count, 40)


@pytest.mark.parametrize(
    ("name", "wrong"),
    [
        ("../x.csv", "'../x.csv' is not a path within a folder; rename the file"),
        ("out/..", "'out/..' is not a path within a folder; rename the file"),
        ("p/con.txt", "'p/con.txt' is not allowed: Windows reserves the name 'con.txt'; rename it"),
        ("a" * 201, "'aaa.*' is too long; shorten its name"),
        ("/".join("abcdefghi"), "'a/b.*' is more than 7 folders deep; move it up"),
        ("a:b.csv", r"'a\?b.csv' has a character that Windows does not allow in a name"),
    ],
)
def test_what_is_wrong_with_a_name_from_elsewhere_is_said(tmp_path, name, wrong):
    with pytest.raises(InputError, match=f"^{wrong}"):
        within(tmp_path, name)


def test_a_name_from_elsewhere_has_a_place_below_its_folder(tmp_path):
    assert within(tmp_path, "records\\m1-x.csv") == tmp_path / "records" / "m1-x.csv"
