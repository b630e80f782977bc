"""Commands in a folder that a stranger made: nothing outside is touched, nothing hangs."""

import errno
import os
import signal
import subprocess
import sys
import time
from itertools import product
from pathlib import Path

import pytest

from fixtures import commands, records, workbooks
from fixtures.dxf import BOX_FT, Sketch
from fixtures.folders import KINDS, occupied, state
from fixtures.marks import by_day
from fixtures.paths import ROOT
from report.project.read.read import read
from report.project.write.filled import changing
from solver.file_writing import LOCK


@pytest.fixture(autouse=True)
def quick_without_a_hang(monkeypatch):
    """Motions of sines at once; a command that opens a pipe would wait for ever."""
    monkeypatch.setattr(
        "report.suite.suite_files.make_suite", lambda *_, count, **__: records.suite(count)
    )
    signal.alarm(120)
    yield
    signal.alarm(0)


@pytest.fixture
def folder(tmp_path):
    """A project, and beside it what the commands are given."""
    for axis in "xyz":
        records.write_record(tmp_path / "library" / f"KJM-{axis}.csv", dt_s=0.02, count=300)
    sketch = Sketch()
    sketch.ring("PV", BOX_FT, "A9")
    sketch.saved(tmp_path)
    x, y = (sum(pair) / 2 for pair in (X, Y))
    (tmp_path / "map.csv").write_text(f"x,y,blocks\n{x},{y},100\n")
    workbooks.make(tmp_path / "job", clearances=workbooks.project().clearances[:1])
    return tmp_path / "job"


A1 = workbooks.project().arrays[0].shape
X, Y = (A1.x_from_m, A1.x_to_m), (A1.y_from_m, A1.y_to_m)


WRITERS = {
    "motion rows": lambda job: (job.parent / "library", job, "--at", "roof"),
    "motion suite": lambda job: (job / "made", "--into", job, "--count", 1),
    "plan clearances": lambda job: (job,),
    "plan ballast": lambda job: (job.parent / "map.csv", job, "--units", "m", "--block-weight", 32,
                                 "lb", "--replace"),
    "plan read": lambda job: (job.parent / "roof.dxf", job, "--layer", "PV=array"),
}  # fmt: skip
"""Every command that changes the workbook, with its arguments."""


def writes(name, job):
    return (*name.split(), *WRITERS[name](job))


@pytest.mark.parametrize("writer", by_day(WRITERS, 2))
def test_a_workbook_that_is_a_link_is_not_written_through(folder, writer):
    outside = folder.parent / "theirs.xlsx"
    (folder / "input.xlsx").rename(outside)
    (folder / "input.xlsx").symlink_to(outside)
    before = state(folder.parent)
    told = commands.errors_of(*writes(writer, folder))
    assert f"{folder / 'input.xlsx'}: is a link to {outside}, and is not written to" in told
    assert state(folder.parent) == before


@pytest.mark.parametrize("writer", by_day(WRITERS, 1))
def test_a_workbook_that_the_user_gave_may_be_a_link_and_is_kept_as_it_was(folder, writer):
    link = folder / "given.xlsx"
    link.symlink_to(folder / "input.xlsx")
    before = (folder / "input.xlsx").read_bytes()
    (folder / "input.before.xlsx").write_bytes(b"of the command before")
    words = [link if word == folder else word for word in writes(writer, folder)]
    commands.stdout_of(*words)
    assert link.is_symlink()
    assert (folder / "input.xlsx").read_bytes() != before
    assert (folder / "input.before.xlsx").read_bytes() == before
    names = {"given.xlsx", "input.xlsx", "input.before.xlsx", "records", "made"}
    assert {path.name for path in folder.iterdir()} <= names


@pytest.mark.parametrize("lock", by_day(["~$input.xlsx", ".~lock.input.xlsx#"], 1))
@pytest.mark.parametrize("writer", by_day(WRITERS, 1))
def test_a_workbook_that_a_program_has_open_is_not_changed(folder, writer, lock):
    (folder / lock).write_bytes(b"")
    before = state(folder.parent)
    told = commands.errors_of(*writes(writer, folder))
    assert f"{folder / lock} exists, so a program has the workbook open; close it there" in told
    assert "delete this file if no program has it open" in told
    assert state(folder.parent) == before
    (folder / lock).unlink()
    commands.stdout_of(*writes(writer, folder))


PLACES = ("input.before.xlsx", LOCK, "records/KJM-x.csv", "records")


@pytest.mark.parametrize(
    ("place", "kind"),
    by_day([pair for pair in product(PLACES, KINDS) if pair != ("records", "folder")], 3),
)
def test_nothing_is_written_through_what_is_in_a_place(folder, place, kind):
    outside = folder.parent / "outside"
    if place != "records":
        outside.write_bytes(b"theirs")
    occupied(folder / place, kind, outside)
    before = state(folder.parent)
    told = commands.errors_of(*writes("motion rows", folder))
    where = {"link": str(outside), "dangling link": "nowhere", "device": os.devnull}
    assert f"{folder / place}: is a" in told
    assert where.get(kind, kind) in told
    assert state(folder.parent) == before


@pytest.mark.parametrize("kind", by_day(["link", "dangling link", "pipe", "device"], 2))
@pytest.mark.parametrize(
    "place", by_day(["out", "out/calc-package.pdf", "out/roofslip.sha256", f"out/{LOCK}"], 1)
)
def test_a_report_is_not_written_through_what_is_in_its_place(folder, place, kind, monkeypatch):
    (folder / place).parent.mkdir(exist_ok=True)
    occupied(folder / place, kind, folder.parent / "library")
    before = state(folder.parent)
    monkeypatch.setattr("report.making.lay_out", lambda *_: b"%PDF")
    told = commands.errors_of("report", folder)
    assert f"{folder / place}: is a" in told
    assert state(folder.parent) == before


@pytest.mark.quick
def test_other_outputs_are_not_written_through_a_link(tmp_path, monkeypatch):
    outside = tmp_path / "outside"
    outside.mkdir()
    (tmp_path / "new").mkdir()
    for name in ("out", "new/records"):
        (tmp_path / name).symlink_to(outside)
    monkeypatch.chdir(tmp_path)
    assert f"out: is a link to {outside}" in commands.errors_of("verify", "--quick")
    for more in ((), ("--example",), ("--study",)):
        told = commands.errors_of("new", tmp_path / "new", *more)
        assert f"records: is a link to {outside}" in told
    (tmp_path / "a.pdf").write_bytes(b"%PDF")
    (tmp_path / "a-signed.pdf").symlink_to(tmp_path / "nowhere")
    told = commands.errors_of("sign", tmp_path / "a.pdf", "--p12", tmp_path / "a.pdf")
    assert f"a-signed.pdf: is a link to {tmp_path / 'nowhere'}" in told
    assert list(outside.iterdir()) == []
    assert [path.name for path in (tmp_path / "new").iterdir()] == ["records"]


@pytest.mark.parametrize("more", [(), ("--example",), ("--study",)])
def test_a_new_project_on_a_full_disk_says_so_and_leaves_nothing(tmp_path, monkeypatch, more):
    flushed = []

    def full(file):
        flushed.append(file)
        if len(flushed) == (5 if more == ("--example",) else 1):
            raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(os, "fsync", full)
    told = commands.errors_of("new", tmp_path / "deep" / "new", *more)
    assert "cannot be written (No space left on device). No file was changed" in told
    assert list(tmp_path.iterdir()) == []


@pytest.mark.nightly
def test_a_plan_with_its_clearances_is_one_write(folder, monkeypatch):
    before, replaced, rename = len(read(folder).inputs["arrays"]), [], os.replace

    def renamed(source, target):
        replaced.append(Path(target).name)
        rename(source, target)

    monkeypatch.setattr(os, "replace", renamed)
    commands.stdout_of(*writes("plan read", folder))
    assert replaced == ["input.before.xlsx", "input.xlsx"]
    assert len(read(folder).inputs["arrays"]) == before + 1


HOLDS_S = 3.0

ROWS = """
import sys
from report.cli.main import main
print(flush=True)
main(sys.argv[1:])
"""


@pytest.mark.nightly
def test_of_two_commands_at_once_none_loses_a_row(folder):
    command = [sys.executable, "-c", ROWS, *map(str, writes("motion rows", folder))]
    with subprocess.Popen(command, cwd=ROOT, stdout=subprocess.PIPE) as other:
        with changing(folder) as change:
            other.stdout.readline()
            time.sleep(HOLDS_S)  # in which the other one reads, if it does not wait
            change.put("arrays", change.rows("arrays", "id", "A1")[0], {"mu": 0.123})
            change.fill_in(replace=True)
        other.stdout.read()
        assert other.wait() == 0
    data = read(folder).project
    assert (data.motions[-1].id, data.arrays[0].mu) == ("KJM", 0.123)
