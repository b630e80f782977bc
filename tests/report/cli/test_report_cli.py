"""`roofslip report`: of several projects, what it puts on record, its progress on a terminal."""

import datetime as dt
import json
import math
import os
import shutil
import sys
import time
import warnings
from pathlib import Path

import pytest

from fixtures import assessments
from fixtures.cells import address
from fixtures.commands import errors_of, run, stdout_of
from fixtures.marks import by_day
from fixtures.packages import unlaid
from fixtures.paths import ROOT
from fixtures.project_parts import SITE
from fixtures.workbooks import cell_address, edit, make, type_into
from report.cli import several_packages
from report.cli.progress import Progress
from report.cli.several_packages import ReportOutcome
from report.cli.streams import show_warnings
from report.making import make as make_package
from report.motions.prepare import prepare
from report.project.check.covered import outdated, to_record
from report.project.read.archive import open_book
from report.project.read.read import read
from report.proof.opened_package import opened


@pytest.mark.nightly
def test_a_project_that_fails_stops_no_other(tmp_path):
    for name in ("one", "two"):
        make(tmp_path / name)
    (tmp_path / "two" / "records" / "x.csv").write_text("0.1\nabc\n0.2\n")
    done = run("report", tmp_path / "one", tmp_path / "two", tmp_path / "none", tmp_path / "one")
    assert done.exit_code == 2
    head, *rows = done.stdout.splitlines()
    assert head.split() == ["project", "verdict", "D/C", "time", "package"]
    assert [row.split()[0] for row in rows] == [str(tmp_path / n) for n in ("one", "two", "none")]
    assert "1 error " in rows[1]
    assert "1 error" in rows[2]
    assert (tmp_path / "one" / "out" / "calc-package.pdf").is_file()
    assert not (tmp_path / "two" / "out").exists()
    record = cell_address("Motions/M1/Horizontal record")
    assert f"{tmp_path / 'two'}: 1 error:\n  {record}: horizontal record: " in done.stderr
    assert "x.csv:2: found 'abc'" in done.stderr
    assert f"{tmp_path / 'none'}: 1 error:\n  no such file" in done.stderr
    as_json = run("report", tmp_path / "none", tmp_path / "none", "--json")
    assert (as_json.exit_code, as_json.stderr) == (2, "")
    assert "no such file" in json.loads(as_json.stdout)["projects"][0]["errors"][0]


def outcome(**about):
    return ReportOutcome(source="a", **about)


@pytest.mark.parametrize("option", ["--out", "--since"])
def test_an_option_of_one_project_is_refused_for_several(option, tmp_path):
    told = " ".join(errors_of("report", tmp_path, tmp_path / "b", option, tmp_path / "c").split())
    assert "--out and --since are of one project; leave them out" in told
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize(
    ("outcomes", "fail_on_ng", "code"),
    [
        ([outcome(verdict="OK"), outcome(verdict="NG")], False, 0),
        ([outcome(verdict="OK"), outcome(verdict="NG")], True, 3),
        ([outcome(verdict="OK with conditions")], True, 3),
        ([outcome(verdict="NG"), outcome(errors=("wrong",))], True, 2),
        ([outcome(errors=("wrong",)), outcome(is_internal_error=True)], False, 1),
    ],
)
def test_the_exit_code_is_that_of_the_worst(outcomes, fail_on_ng, code):
    assert several_packages.exit_code(outcomes, fail_on_ng=fail_on_ng) == code


def test_json_has_a_schema_version_and_an_entry_for_each_project():
    wrong = "Arrays!C8: slope is 'x'; enter a number"
    outcomes = [
        outcome(
            verdict="NG",
            demand_capacity=several_packages.largest((0.5, 1.25)),
            package="a/out/calc-package.pdf",
            seconds=2.5,
        ),
        outcome(verdict="NG", demand_capacity=several_packages.largest((0.5, math.nan, 2.0))),
        outcome(errors=(wrong,)),
    ]
    document = json.loads(json.dumps(several_packages.document(outcomes)))
    first, second, third = document["projects"]
    assert document["schema_version"] == 1
    assert first == {
        "source": "a", "verdict": "NG", "demand_capacity": 1.25, "seconds": 2.5,
        "package": "a/out/calc-package.pdf", "errors": [], "is_internal_error": False,
    }  # fmt: skip
    assert second["demand_capacity"] is None
    assert (third["verdict"], third["errors"]) == (None, [wrong])


def test_an_internal_error_in_one_project_is_printed_with_its_traceback(monkeypatch):
    monkeypatch.setattr("report.cli.several_packages.make", lambda *_, **__: 1 / 0)
    done = run("report", "a", "b", "--json")
    assert done.exit_code == 1
    projects = json.loads(done.stdout)["projects"]
    assert [project["is_internal_error"] for project in projects] == [True, True]
    for name in ("a", "b"):
        assert f"{name}: Traceback " in done.stderr
    assert done.stderr.count("ZeroDivisionError: division by zero") == 2


@pytest.mark.nightly
def test_workbooks_of_one_folder_are_written_to_folders_of_their_own(tmp_path):
    book = make(tmp_path)
    shutil.copy(book, tmp_path / "b.xlsx")
    with unlaid():
        stdout_of("report", tmp_path)
        before = (tmp_path / "out" / "results.json").read_bytes()
        refused = run("report", tmp_path / "b.xlsx")
        done = run("report", tmp_path, tmp_path / "b.xlsx", book)
        assert (refused.exit_code, done.exit_code) == (2, 0)
        stdout_of("report", tmp_path / "b.xlsx", "--out", tmp_path / "out" / "input")
    assert (
        f"{tmp_path / 'out'}: contains the results of input.xlsx, not of b.xlsx;"
    ) in refused.stderr
    assert "--out" in refused.stderr
    assert (tmp_path / "out" / "results.json").read_bytes() == before
    first = f"{tmp_path / 'out' / 'calc-package.pdf'} and 4 more are from an earlier run ("
    for told in (refused, done):
        (line,) = (line for line in told.stderr.splitlines() if line.startswith(first))
        assert line.endswith(") and were not replaced")
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
    assert told[-1].startswith(f"{tmp_path / 'out' / 'plan.dxf'} is from an earlier run (2")


PLACES = "<Site/Seismic parameters covered>, <Options/Review covered>"


def confirmed(folder: Path, **changes) -> Path:
    """A project with a hazard and a peer review that have dates."""
    options = assessments.REVIEW | {"peer_letter": ""}
    site = SITE | {"hazard_source": "Hazard Tool", "hazard_date": dt.date(2026, 2, 20)}
    return make(folder, **{"site": site, "options": options} | changes)


@pytest.mark.parametrize("name", by_day(assessments.SHIPPED, 1))
@pytest.mark.quick
def test_a_shipped_project_has_on_record_what_its_confirmations_cover(name):
    sheet = read(ROOT / "projects" / name)
    hashes = prepare(sheet).hashes
    assert to_record(sheet.project, hashes) == {}
    assert outdated(sheet.project, hashes).outdated == {}


@pytest.mark.nightly
def test_the_example_in_si_has_on_record_what_its_confirmations_cover(tmp_path):
    stdout_of("new", tmp_path, "--example", "--units", "SI")
    sheet = read(tmp_path)
    assert sheet.project.site.hazard_covered
    assert to_record(sheet.project, prepare(sheet).hashes) == {}


@pytest.mark.nightly
def test_report_puts_a_confirmation_on_record_once_and_attaches_the_workbook_with_it(tmp_path):
    path = confirmed(tmp_path)
    says = open_book(path).calculation
    output = stdout_of("report", path)
    assert (
        f"{path}: {cell_address(PLACES)}: the confirmed inputs were recorded" in output.splitlines()
    )
    sheet = read(path)
    assert sheet.project.site.hazard_covered.startswith("2026-02-20: Site ")
    assert sheet.project.options.peer_covered.startswith("2026-03-01: Site ")
    assert open_book(path).calculation == says
    files = {file.name for file in tmp_path.iterdir() if not file.name.startswith(".")}
    assert files == {"input.xlsx", "records", "out"}  # no copy: the former one may still be needed
    package = opened((tmp_path / "out" / "calc-package.pdf").read_bytes())
    (workbook,) = package.manifest.of_kind("workbook")
    assert workbook.sha256 == sheet.sha256
    stdout_of("verify-package", tmp_path / "out" / "calc-package.pdf")

    # What changes is named, and the record stays until there is a new date.
    type_into(path, {"Arrays/A1/Friction coefficient": 0.4})
    before = path.read_bytes()
    (tmp_path / "records" / "z.csv").write_text("acc_g\n" + "0.1\n" * 200)
    output = stdout_of("report", path)
    (line,) = (line for line in output.splitlines() if "dated before" in line)
    said = "Date of the peer review: 2026-03-01, dated before these inputs changed: "
    assert line.startswith(f"condition: {said}worksheets Arrays, Motions.")
    assert path.read_bytes() == before
    assert "on record" not in output


@pytest.mark.nightly
def test_a_workbook_that_is_not_to_be_written_stays_as_it_is(tmp_path, monkeypatch):
    path = confirmed(tmp_path)
    before, usual = path.read_bytes(), os.access
    monkeypatch.setattr(os, "access", lambda at, mode: Path(at) != path and usual(at, mode))
    lines = []
    make_package(path, None, None, lambda _: None, on_record=lines.append)
    assert path.read_bytes() == before
    (line,) = lines
    assert line.endswith("not recorded: the workbook is read-only, or was saved in the meantime")
    monkeypatch.undo()
    path = confirmed(tmp_path)
    beside = path.with_name("~$input.xlsx")
    beside.touch()
    before = path.read_bytes()
    output = stdout_of("report", path)
    assert path.read_bytes() == before
    (line,) = (line for line in output.splitlines() if "not recorded" in line)
    assert line.startswith(
        f"{path}: {cell_address(PLACES)}: the confirmed inputs were not recorded: "
    )
    assert "a program has the workbook open" in line
    stdout_of("verify-package", tmp_path / "out" / "calc-package.pdf")
    beside.unlink()

    for label in ("Site/Seismic parameters covered", "Options/Review covered"):
        sheet, cell = address(before, label).split("!")
        type_into(path, {f"{sheet}!A{cell[1:]}": None})

    def without_names(book):
        for name in ("site_hazard_covered", "options_peer_covered"):
            del book.defined_names[name]

    earlier = edit(path, without_names).read_bytes()
    output = errors_of("report", path)
    # Workbooks before 0.3.0, which have no such cells, are not read.
    for field in ("Site: seismic parameters covered", "Options: review covered"):
        assert f"{field} is missing" in output
    assert "on record" not in output
    assert path.read_bytes() == earlier


@pytest.fixture
def terminal(monkeypatch):
    """A function that takes the captured output for that of a terminal."""
    return lambda: monkeypatch.setattr(sys.stderr, "isatty", lambda: True)


def test_a_bar_grows_with_each_step_and_is_cleared_or_never_there(terminal, capsys):
    terminal()
    with Progress(4) as progress:
        for step in ("reading", "running", "writing"):
            progress(step)
    shown = capsys.readouterr().err.split("\r\x1b[2K")
    bars = ["[" + "#" * full + "." * (20 - full) for full in (0, 5, 10)]
    assert [line.partition("]")[0] for line in shown] == ["", *bars, ""]
    assert shown[2].endswith(" s  running")
    terminal()
    with Progress() as progress:
        progress("reading")
    shown = capsys.readouterr().err
    assert "reading" in shown
    assert "[" not in shown.replace("\x1b[", "")
    terminal()
    with Progress(2, quiet=True) as progress:
        progress("reading")
    assert capsys.readouterr().err == ""


def shown_at(seconds, monkeypatch, capsys, progress):
    """The lines that a terminal shows of steps that begin at these times."""
    now = iter(seconds)
    monkeypatch.setattr("report.cli.progress.time.monotonic", lambda: next(now))
    made = progress()
    for number in range(len(seconds) - 1):
        made(f"step {number}")
    return capsys.readouterr().err.split("\r\x1b[2K")[1:]


def test_the_time_left_follows_from_what_is_done_by_shares_of_steps(terminal, monkeypatch, capsys):
    terminal()
    times = (0.0, 1.0, 3.0, 320.0)
    lines = shown_at(times, monkeypatch, capsys, lambda: Progress(4))
    assert [line.partition("] ")[2] for line in lines] == [
        " 1.0 s  step 0",
        " 3.0 s, 9 s left  step 1",
        "320.0 s, 5 min left  step 2",
    ]
    terminal()
    lines = shown_at((0.0, 0.0, 9.0), monkeypatch, capsys, lambda: Progress((3, 1)))
    assert lines[1] == "[" + "#" * 15 + "." * 5 + "]  9.0 s, 3 s left  step 1"
    terminal()
    monkeypatch.setenv("COLUMNS", "30")
    lines = shown_at((0.0, 0.0), monkeypatch, capsys, lambda: Progress(4))
    assert lines == ["[" + "." * 20 + "]  0.0 s"]


@pytest.mark.nightly
def test_the_line_is_written_again_while_a_step_lasts(terminal, capsys):
    terminal()
    with Progress(2) as progress:
        progress("running")
        time.sleep(1.5)
    *lines, cleared = capsys.readouterr().err.split("\r\x1b[2K")[1:]
    assert len(lines) >= 2
    assert all(line.endswith("  running") for line in lines)
    assert cleared == ""


def test_elsewhere_plain_lines_start_after_a_second_and_a_warning_is_one(monkeypatch, capsys):
    now = iter((0.0, 0.9, 1.5))
    monkeypatch.setattr("report.cli.progress.time.monotonic", lambda: next(now))
    progress = Progress(2)
    progress("reading")
    progress("running")
    assert capsys.readouterr().err == "[ 1.5 s] running\n"
    monkeypatch.setattr(warnings, "showwarning", lambda *_, **__: print("to developers"))
    show_warnings()
    warnings.showwarning(UserWarning("cannot be\x1bkept"), UserWarning, "cache.py", 49)
    warnings.showwarning(DeprecationWarning("old"), DeprecationWarning, "other.py", 1)
    shown = capsys.readouterr()
    assert shown.err == "warning: cannot be?kept\n"
    assert shown.out == "to developers\n"
