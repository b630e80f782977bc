"""`roofslip report` of several projects, of which some fail."""

import errno
import json
import math
import os
import shutil
from pathlib import Path

import pytest

import report.workers
from commands import printed, refused, run
from packages import unlaid
from report.cli import several
from report.cli.several import ReportOutcome
from report.workers import WorkerProcess
from sheets import at, make

pytestmark = pytest.mark.quick


@pytest.fixture
def processes(monkeypatch):
    """Have commands start processes, as they do outside the tests."""
    monkeypatch.setattr(report.workers, "WorkerProcess", WorkerProcess)


@pytest.mark.nightly
def test_a_project_that_fails_stops_no_other(tmp_path, processes):
    for name in ("one", "two"):
        make(tmp_path / name)
    (tmp_path / "two" / "records" / "x.csv").write_text("0.1\nabc\n0.2\n")
    done = run("report", tmp_path / "one", tmp_path / "two", tmp_path / "none", tmp_path / "one")
    assert done.exit_code == 2
    head, *rows = done.stdout.splitlines()
    assert head.split() == ["project", "verdict", "D/C", "time", "package"]
    assert [row.split()[0] for row in rows] == [str(tmp_path / n) for n in ("one", "two", "none")]
    assert "1 problem " in rows[1]
    assert "1 problem" in rows[2]
    assert (tmp_path / "one" / "out" / "calc-package.pdf").is_file()
    assert not (tmp_path / "two" / "out").exists()
    record = at("Motions/M1/Horizontal record")
    assert f"{tmp_path / 'two'}: {record}: horizontal record: x.csv:2: found 'abc'" in done.stderr
    assert f"{tmp_path / 'none'}: no such file" in done.stderr
    as_json = run("report", tmp_path / "none", tmp_path / "none", "--json")
    assert (as_json.exit_code, as_json.stderr) == (2, "")
    assert "no such file" in json.loads(as_json.stdout)["projects"][0]["errors"][0]


def outcome(**about):
    return ReportOutcome(source=Path("a"), **about)


def made_or_killed(source, _):
    if source.name == "killed":
        os._exit(9)
    return ReportOutcome(source=source, verdict="OK")


@pytest.mark.nightly
def test_a_process_that_is_killed_takes_no_other_project_with_it(processes, monkeypatch):
    monkeypatch.setattr(several, "package", made_or_killed)
    monkeypatch.setattr(os, "cpu_count", lambda: 1)
    first, killed, last = several.run([Path("a"), Path("killed"), Path("b")], quiet=True)
    assert (first.word, killed.word, last.word) == ("OK", "internal error", "OK")
    assert killed.internal.endswith("ended (exit code 9)")


@pytest.mark.parametrize("option", ["--out", "--since"])
def test_an_option_of_one_project_is_refused_for_several(option, tmp_path):
    told = " ".join(refused("report", tmp_path, tmp_path / "b", option, tmp_path / "c").split())
    assert "--out and --since are of one project; leave them out" in told
    assert not list(tmp_path.iterdir())


def test_where_no_process_can_be_started_one_project_at_a_time_is_advised(tmp_path, monkeypatch):
    def full(_):
        raise BlockingIOError(errno.EAGAIN, "Resource temporarily unavailable")

    monkeypatch.setattr(report.workers, "WorkerProcess", full)
    told = " ".join(refused("report", tmp_path / "a", tmp_path / "b").split())
    assert "(Resource temporarily unavailable)" in told
    assert "give one project at a time" in told


@pytest.mark.parametrize(
    ("outcomes", "fail_on_ng", "code"),
    [
        ([outcome(verdict="OK"), outcome(verdict="NG")], False, 0),
        ([outcome(verdict="OK"), outcome(verdict="NG")], True, 3),
        ([outcome(verdict="OK with conditions")], True, 3),
        ([outcome(verdict="NG"), outcome(problems=("wrong",))], True, 2),
        ([outcome(problems=("wrong",)), outcome(internal="Traceback")], False, 1),
    ],
)
def test_the_exit_code_is_that_of_the_worst(outcomes, fail_on_ng, code):
    assert several.exit_code(outcomes, fail_on_ng=fail_on_ng) == code


def test_json_has_a_schema_version_and_an_entry_for_each_project():
    wrong = "Arrays!C8: slope is 'x'; give a number"
    outcomes = [
        outcome(verdict="NG", ratios=(0.5, 1.25), package="a/out/calc-package.pdf", seconds=2.5),
        outcome(verdict="NG", ratios=(0.5, math.nan)),
        outcome(problems=(wrong,)),
    ]
    document = json.loads(json.dumps(several.document(outcomes)))
    first, second, third = document["projects"]
    assert document["schema_version"] == 1
    assert first == {
        "source": "a",
        "verdict": "NG",
        "demand_capacity": 1.25,
        "package": "a/out/calc-package.pdf",
        "errors": [],
        "is_internal_error": False,
        "seconds": 2.5,
    }
    assert second["demand_capacity"] is None
    assert (third["verdict"], third["errors"]) == (None, [wrong])


def test_an_internal_error_in_one_project_is_printed_with_its_traceback(monkeypatch):
    monkeypatch.setattr("report.making.make", lambda *_, **__: 1 / 0)
    done = several.package(Path("a"))
    assert done.word == "internal error"
    assert "ZeroDivisionError: division by zero" in done.internal


@pytest.mark.nightly
def test_workbooks_of_one_folder_are_written_to_folders_of_their_own(tmp_path):
    book = make(tmp_path)
    shutil.copy(book, tmp_path / "b.xlsx")
    with unlaid():
        printed("report", tmp_path)
        before = (tmp_path / "out" / "results.json").read_bytes()
        refused = run("report", tmp_path / "b.xlsx")
        done = run("report", tmp_path, tmp_path / "b.xlsx", book)
        assert (refused.exit_code, done.exit_code) == (2, 0)
        printed("report", tmp_path / "b.xlsx", "--out", tmp_path / "out" / "input")
    assert f"{tmp_path / 'out'}: has the results of input.xlsx, not of b.xlsx;" in refused.stderr
    assert "--out" in refused.stderr
    assert (tmp_path / "out" / "results.json").read_bytes() == before
    first = f"{tmp_path / 'out' / 'calc-package.pdf'} and 3 more are of an earlier run, "
    for told in (refused, done):
        (line,) = (line for line in told.stderr.splitlines() if line.startswith(first))
        assert line.endswith(", and not replaced")
    packages = [line.split()[-1] for line in done.stdout.splitlines()[1:]]
    assert packages == [str(tmp_path / "out" / n / "calc-package.pdf") for n in ("input", "b")]
    assert all(Path(package).is_file() for package in packages)
    b = json.loads((tmp_path / "out" / "b" / "results.json").read_bytes())
    assert b["workbook"]["name"] == "b.xlsx"


def test_a_project_with_an_error_names_the_files_of_its_earlier_run(tmp_path):
    make(tmp_path)
    (tmp_path / "out").mkdir()
    (tmp_path / "out" / "plan.dxf").write_text("earlier")
    (tmp_path / "records" / "x.csv").write_text("abc")
    told = run("report", tmp_path, tmp_path).stderr.splitlines()
    assert told[-1].startswith(f"{tmp_path / 'out' / 'plan.dxf'} is of an earlier run, 2")
