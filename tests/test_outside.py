"""Whatever its files are called, a command writes to the project, its outputs and its own folder.

`outside` tells every other place that Python is asked to write to, rename or remove.
"""

import io
import os
import sys
import tempfile
import zipfile

import pytest

from fixtures import commands, records, workbooks
from fixtures.dxf import BOX_FT, Sketch
from fixtures.file_changes import changes_within
from fixtures.marks import nightly
from report.motions.stored import unpack
from solver.errors import InputError

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="its folders have no such names")

# Each is a folder above, a device or another name to some system.
NAMES = ("..", ". ", ".. ", "...", "con", "a\\..\\..\\b", "name ", "x:y", ".", "-")


@pytest.fixture
def private(tmp_path, monkeypatch):
    """Where temporary files are, with one of somebody else."""
    folder = tmp_path / "tmp"
    for axis in "xyz":
        records.write_record(folder / "theirs" / f"KJM-{axis}.csv", dt_s=0.02, count=300)
    monkeypatch.setattr(tempfile, "tempdir", str(folder))
    monkeypatch.chdir(tmp_path)
    return folder


def zipped(path, *names):
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        for name in names:
            archive.writestr(
                name, records.write_record(path.parent / "one.csv", 0.02, 300).read_text()
            )
    return path


@pytest.mark.parametrize("name", NAMES)
def test_a_zip_of_any_name_gives_only_its_own_records(tmp_path, private, name):
    path = zipped(tmp_path / f"{name}.zip", *(f"M-{axis}.csv" for axis in "xyz"))
    with changes_within(private):
        told = commands.stdout_of("motion", "rows", path)
    assert "KJM" not in told
    assert told.count("M-x.csv") == 1
    assert sorted(entry.name for entry in private.iterdir()) == ["theirs"]


@pytest.mark.parametrize("name", NAMES[:6])
def test_a_workbook_of_any_name_leaves_the_results_of_others(tmp_path, private, name):
    job = workbooks.make(tmp_path / "job").parent
    for path in (job / f"{name}.xlsx", job / "b.xlsx"):
        path.write_bytes(b"no workbook")
    theirs = job / "results.json"
    theirs.write_text("{}")
    with changes_within(job / "out", private):
        told = commands.errors_of("report", job / f"{name}.xlsx", job / "b.xlsx")
    assert theirs.read_text() == "{}"
    assert "; rename it" in told or "; rename the file" in told


def test_two_workbooks_with_one_folder_do_not_replace_each_other(tmp_path, private):
    job = workbooks.make(tmp_path / "job").parent
    for name in ("a.xlsx", "b.xlsx"):
        (job / name).write_bytes((job / "input.xlsx").read_bytes())
    other = job / "out" / "a" / "results.json"
    other.parent.mkdir(parents=True)
    other.write_text('{"workbook": {"name": "a.XLSX"}}')
    (job / "b.xlsx").write_bytes(b"no workbook")
    told = commands.errors_of("report", job / "a.xlsx", job / "b.xlsx")
    assert "contains the results of a.XLSX, not of a.xlsx" in told
    assert other.read_text() == '{"workbook": {"name": "a.XLSX"}}'


COMMANDS = [
    ("new", "new", "--example"),
    nightly(("check", "job")),
    ("motion", "rows", "set.zip", "job", "--at", "roof"),
    nightly(("plan", "read", "roof.dxf", "job", "--layer", "PV=array")),
    nightly(("plan", "clearances", "job")),
    nightly(("motion", "suite", "job/made", "--into", "job", "--count", 1)),
    nightly(("report", "job", "--out", "out")),
]


@pytest.mark.parametrize("words", [pytest.param(case) if type(case) is tuple else
                                   pytest.param(case.values, marks=case.marks)
                                   for case in COMMANDS], ids=lambda words: words[0])  # fmt: skip
def test_a_command_writes_nowhere_else(tmp_path, private, monkeypatch, words):
    monkeypatch.setattr(
        "report.suite.suite_files.make_suite", lambda *_, count, **__: records.suite(count)
    )
    workbooks.make(tmp_path / "job")
    sketch = Sketch()
    sketch.ring("PV", BOX_FT, "A9")
    sketch.saved(tmp_path)
    zipped(tmp_path / "set.zip", *(f"M-{axis}.csv" for axis in "xyz"))
    with changes_within(private, *(tmp_path / name for name in ("job", "new", "out"))):
        commands.run(*words)


def test_a_change_outside_is_told(tmp_path):
    def change():
        (tmp_path / "inside").mkdir()
        (tmp_path / "inside" / ".." / "theirs").write_text("")

    with pytest.raises(AssertionError), changes_within(tmp_path / "inside"):
        change()


def test_zips_in_a_zip_have_one_limit_together_and_one_level(tmp_path, monkeypatch):
    def packed(**members):
        with zipfile.ZipFile(data := io.BytesIO(), "w", zipfile.ZIP_DEFLATED) as archive:
            for name, content in members.items():
                archive.writestr(name, content)
        return data.getvalue()

    station = packed(**{"a.csv": bytes(900_000)})
    whole = tmp_path / "whole.zip"
    whole.write_bytes(packed(**{f"{k}.zip": station for k in range(4)}))
    unpack(whole, tmp_path / "all")
    assert len(list((tmp_path / "all").rglob("a.csv"))) == 4
    monkeypatch.setattr("report.motions.stored.MOST_STORED", 3_000_000)
    with pytest.raises(InputError, match="more than 3 MB"):
        unpack(whole, tmp_path / "less")
    deep = station
    for _ in range(12):
        deep = packed(**{"in.zip": deep})
    whole.write_bytes(deep)
    unpack(whole, tmp_path / "deep")
    assert [os.fspath(p.relative_to(tmp_path / "deep")) for p in (tmp_path / "deep").rglob("*.*")
            ] == ["in.zip", "in/in.zip"]  # fmt: skip


def test_a_zip_of_a_million_entries_is_refused_before_they_are_read(tmp_path):
    entry = b"PK\x01\x02" + bytes(42)
    # The record at the end states one.
    end = b"PK\x05\x06" + bytes(4) + b"\1\0\1\0" + (46_000_000).to_bytes(4, "little") + bytes(6)
    path = tmp_path / "many.zip"
    path.write_bytes(entry * 1_000_000 + end)
    assert "has 1,000,000 parts, more than 2,000" in commands.errors_of("motion", "rows", path)
    path = path.rename(tmp_path / "many.xlsx")
    assert "has 1,000,000 parts, more than 2,000" in commands.errors_of("check", path)
