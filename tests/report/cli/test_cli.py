"""The commands as a user or a script calls them."""

import json
import re
import shutil
import subprocess
import sys
from pathlib import Path
from zipfile import ZipFile

import numpy as np
import pytest
from click.testing import CliRunner

import packages
import report.package.html
from places import ROOT
from report.cli.main import main
from report.cli.terminal import Progress
from sheets import at, make, project

EXAMPLE = ROOT / "projects" / "example"
RECORD = str(EXAMPLE / "records" / "RM1-x.csv")


def run(*arguments):
    return CliRunner().invoke(main, [str(item) for item in arguments])


def test_help_names_the_commands_and_imports_nothing_heavy():
    code = (
        "import sys; from report.cli.main import main; main(['--help'], standalone_mode=False); "
        "print(sorted({'numpy', 'numba', 'pandas', 'openpyxl', 'matplotlib'} & set(sys.modules)))"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.splitlines()[-1] == "[]"
    for command in ("new", "check", "motion", "report", "slide", "verify"):
        assert f"\n  {command} " in done.stdout


def test_what_only_the_second_process_needs_is_not_loaded_with_the_tasks_for_it():
    code = (
        "import sys, report.drawing.dxf, report.package.html, report.results.tables; "
        "print(sorted({'ezdxf', 'matplotlib', 'pandas', 'ziamath'} & set(sys.modules)))"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.splitlines() == ["[]"]


def test_report_never_replaces_its_own_workbook(tmp_path):
    book = make(tmp_path).rename(tmp_path / "results.xlsx")
    before = book.read_bytes()
    (tmp_path / "link").symlink_to(tmp_path)
    for out in (tmp_path, tmp_path / "records" / "..", tmp_path / "link"):
        done = run("report", book, "--out", out)
        assert done.exit_code == 2
        assert "is an input of this run, and would be replaced by its results.xlsx" in done.output
    assert book.read_bytes() == before


def test_new_does_not_write_through_a_dangling_link(tmp_path):
    (tmp_path / "input.xlsx").symlink_to(tmp_path / "elsewhere.xlsx")
    done = run("new", tmp_path)
    assert done.exit_code == 2
    assert "already exists" in done.output
    assert not (tmp_path / "elsewhere.xlsx").exists()


@pytest.mark.nightly
def test_new_example_writes_the_example_of_the_projects(tmp_path, monkeypatch):
    bars = []

    class Kept(Progress):
        def __exit__(self, *about):
            bars.append((self._done, self._steps))
            super().__exit__(*about)

    monkeypatch.setattr("report.cli.report.Progress", Kept)
    done = run("new", "--example", tmp_path / "job")
    assert done.exit_code == 0, done.output
    assert bars == [(7, 7)]
    made, committed = tmp_path / "job", ROOT / "projects" / "example"
    names = {path.relative_to(made) for path in made.rglob("*.*")}
    assert len(names) == 22
    for name in names - {Path("input.xlsx")}:
        if (made / name).read_bytes() == (committed / name).read_bytes():
            continue
        one, other = (np.loadtxt(f / name, delimiter=",", skiprows=2) for f in (made, committed))
        assert np.abs(one - other).max() <= 3e-5  # sines may differ in the last digit
    with ZipFile(made / "input.xlsx") as one, ZipFile(committed / "input.xlsx") as other:
        parts = [part for part in one.namelist() if part.endswith(".xml")]
        for part in set(parts) - {"docProps/core.xml"}:
            assert one.read(part) == other.read(part), part
    assert "no errors, 1 warning" in run("check", made).output


def test_new_example_overwrites_no_records(tmp_path):
    (tmp_path / "records").mkdir()
    (tmp_path / "records" / "mine.csv").write_text("0,0")
    done = run("new", "--example", tmp_path)
    assert done.exit_code == 2
    assert "records: is not empty; choose another folder" in done.output
    assert not (tmp_path / "input.xlsx").exists()


def test_new_writes_a_workbook_and_never_overwrites_one(tmp_path):
    first = run("new", tmp_path / "job")
    assert first.exit_code == 0
    assert (tmp_path / "job" / "records").is_dir()
    before = (tmp_path / "job" / "input.xlsx").read_bytes()
    second = run("new", tmp_path / "job", "--units", "si")
    assert second.exit_code == 2
    assert "already exists" in second.output
    assert (tmp_path / "job" / "input.xlsx").read_bytes() == before


def test_check_finds_no_error_in_the_example_but_friction_tests_without_repeats():
    done = run("check", EXAMPLE)
    assert done.exit_code == 0
    counts = "no errors, 1 warning. 3 arrays, 6 clearances, 7 motions, S_DS 1.566 g"
    assert counts in done.output
    assert "three runs at each velocity" in done.output


def test_check_of_a_blank_workbook_names_every_cell_and_exits_2(tmp_path):
    run("new", tmp_path)
    done = run("check", tmp_path)
    assert done.exit_code == 2
    assert at("<Project/Project name>: project name is missing") in done.output
    assert at("<Arrays/heading/ID>: no array is given") in done.output


def test_check_of_a_missing_file_exits_2(tmp_path):
    assert run("check", tmp_path / "nothing").exit_code == 2
    assert run("check", Path(RECORD)).exit_code == 2


def test_an_internal_error_exits_1_with_the_traceback(tmp_path, monkeypatch):
    make(tmp_path / "job")

    def broken(*_):
        raise RuntimeError("internal error")

    monkeypatch.setattr(report.package.html, "pages", broken)
    done = run("report", tmp_path / "job")
    assert done.exit_code == 1
    assert isinstance(done.exception, RuntimeError)
    assert not (tmp_path / "job" / "out").exists()


def test_a_failed_run_leaves_the_older_package(tmp_path):
    shutil.copytree(EXAMPLE, tmp_path / "job", ignore=shutil.ignore_patterns("out"))
    out = tmp_path / "job" / "out"
    out.mkdir()
    (out / "calc-package.pdf").write_bytes(b"older")
    (tmp_path / "job" / "records" / "RM3-x.csv").write_text("time_s,acceleration_g\n0,abc\n")
    done = run("report", tmp_path / "job")
    assert done.exit_code == 2
    assert "RM3-x.csv" in done.output
    assert [p.read_bytes() for p in out.iterdir()] == [b"older"]


@pytest.mark.nightly("report/assessment/links.py")
def test_a_rigid_block_that_is_not_adequate_is_ng(tmp_path):
    row = {"array": "A2", "friction": "0.30, 0.45, 0.60", "stiffness_n_per_m": 1e3}
    options = {"statistic": "rule set", "peer_reviewed": True}
    given = project().model_dump()
    # Padded, so that every run comes to rest; too steep for the prescriptive route.
    motions = [motion | {"pad_s": 20.0} for motion in given["motions"]]
    arrays = [array | {"slope_value": 7.0} for array in given["arrays"]]
    changes = {"links": [row], "options": options, "motions": motions, "arrays": arrays}
    with packages.unlaid():
        done = run("report", make(tmp_path, **changes))
    assert done.exit_code == 0
    assert (
        "NG: one rigid block has not been shown to be adequate for array A2; see part 12"
        in done.output
    )
    (line,) = (text for text in done.output.splitlines() if text.startswith("A2 "))
    assert line.endswith("NG: limits on the motions and 5 more")  # the block, four clearances
    results = json.loads((tmp_path / "out" / "results.json").read_text())
    assert results["verdict"] == "NG"
    assert results["linked"][0]["rigid_is_enough"] is False
    assert results["linked"][0]["estimated_m"] > results["linked"][0]["design_m"] > 0.0
    text = packages.words((tmp_path / "out" / "calc-package.pdf").read_text(encoding="utf-8"))
    assert "Array A2: a row of linked blocks" in text
    assert "One rigid block has not been shown to be adequate" in text


@pytest.mark.nightly("report/results/", "report/cli/report.py")
def test_since_a_former_revision_the_terminal_counts_and_the_package_lists(tmp_path):
    with packages.unlaid():
        first = run("report", make(tmp_path))
    assert first.exit_code == 0
    assert "since revision" not in first.output
    former = tmp_path / "issued.json"
    former.write_bytes((tmp_path / "out" / "results.json").read_bytes())
    given = project().model_dump()
    arrays = [given["arrays"][0] | {"mu": 0.33}, *given["arrays"][1:]]
    with packages.unlaid():
        done = run("report", make(tmp_path, arrays=arrays), "--since", former)
    assert done.exit_code == 0, done.output
    (line,) = (text for text in done.output.splitlines() if text.startswith("since revision"))
    assert line.startswith("since revision 1: ")
    assert "input 1," in line
    (letter,) = re.findall(r"; see appendix ([A-Z]) of the package$", line)
    text = packages.words((tmp_path / "out" / "calc-package.pdf").read_text(encoding="utf-8"))
    assert f"{letter} Changes since revision 1" in text
    assert "Friction coefficient" in text
    assert "of another project" not in done.output
    document = json.loads(former.read_text(encoding="utf-8"))
    document["input"]["project"] |= {"name": "Elsewhere", "number": "99-1"}
    former.write_text(json.dumps(document), encoding="utf-8")
    with packages.unlaid():
        done = run("report", make(tmp_path, arrays=arrays), "--since", former)
    assert "--since is of another project: 99-1, Elsewhere; check that it is" in done.output


def test_a_damaged_former_revision_is_an_input_error_before_anything_runs(tmp_path):
    former = tmp_path / "issued.json"
    former.write_bytes(b'{"schema_version": 2, "arr')
    done = run("report", tmp_path / "no-such-project", "--since", former)
    assert done.exit_code == 2
    assert "issued.json: is no results.json or is damaged" in done.output
    assert not (tmp_path / "out").exists()
