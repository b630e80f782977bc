"""The commands as a user or a script calls them."""

import json
import shutil
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner
from pypdf import PdfReader

import report.package.html
from places import ROOT
from report.cli.main import main
from sheets import make
from solver.model import Friction
from solver.sliding.checked import scene, slide
from solver.sliding.two_axes import run as run_in_two_axes

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


def test_new_writes_a_workbook_and_never_overwrites_one(tmp_path):
    first = run("new", tmp_path / "job")
    assert first.exit_code == 0
    assert (tmp_path / "job" / "records").is_dir()
    before = (tmp_path / "job" / "input.xlsx").read_bytes()
    second = run("new", tmp_path / "job", "--units", "SI")
    assert second.exit_code == 2
    assert "already exists" in second.output
    assert (tmp_path / "job" / "input.xlsx").read_bytes() == before


def test_check_finds_nothing_wrong_with_the_example():
    done = run("check", EXAMPLE)
    assert done.exit_code == 0
    assert "no problems found. 3 arrays, 6 clearances, 7 motions, S_DS 1.566 g" in done.output


def test_check_of_a_blank_workbook_names_every_cell_and_exits_2(tmp_path):
    run("new", tmp_path)
    done = run("check", tmp_path)
    assert done.exit_code == 2
    assert "Project!B5: project name is missing" in done.output
    assert "Arrays!B7: no array is given" in done.output


def test_check_of_a_missing_file_exits_2(tmp_path):
    assert run("check", tmp_path / "nothing").exit_code == 2
    assert run("check", Path(RECORD)).exit_code == 2


def test_an_internal_error_exits_1_with_the_traceback(tmp_path, monkeypatch):
    shutil.copytree(EXAMPLE, tmp_path / "job", ignore=shutil.ignore_patterns("out"))

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


def test_a_rigid_block_that_is_not_adequate_gives_a_warning(tmp_path):
    row = {"array": "A2", "friction": "0.30, 0.45, 0.60", "stiffness_n_per_m": 1e3}
    options = {"statistic": "rule set", "peer_reviewed": True}
    done = run("report", make(tmp_path, links=[row], options=options))
    assert done.exit_code == 0
    assert (
        "warning: one rigid block has not been shown to be adequate for array A2; see part 11"
        in done.output
    )
    (line,) = (text for text in done.output.splitlines() if text.startswith("A2 "))
    assert line.endswith("NG")
    results = json.loads((tmp_path / "out" / "results.json").read_text())
    assert results["ok"] is results["linked"][0]["rigid_is_enough"] is False
    assert results["linked"][0]["estimated_m"] > results["linked"][0]["design_m"] > 0.0
    pdf = PdfReader(tmp_path / "out" / "calc-package.pdf")
    text = " ".join(" ".join(page.extract_text() for page in pdf.pages).split())
    assert "Array A2: a row of linked blocks" in text
    assert "One rigid block has not been shown to be adequate" in text


@pytest.fixture(scope="module")
def reported(tmp_path_factory):
    """The example, reported from a folder of its own, as by a script."""
    job = tmp_path_factory.mktemp("example") / "job"
    shutil.copytree(EXAMPLE, job, ignore=shutil.ignore_patterns("out"))
    done = subprocess.run(
        [sys.executable, "-m", "report.cli", "report", str(job)],
        capture_output=True,
        text=True,
        check=True,
        cwd=ROOT,
        timeout=120,
    )
    return job, done


def test_report_prints_each_array_and_where_the_files_are(reported):
    job, done = reported
    lines = done.stdout.splitlines()
    assert lines[0].split("  ")[0] == "array"
    assert [line.split()[0] for line in lines[1:4]] == ["A1", "A2", "A3"]
    assert all("81.6 in (2070 mm)" in line for line in lines[1:4])
    assert all(line.endswith("OK") for line in lines[1:4])
    for name in ("calc-package.pdf", "results.xlsx", "results.json"):
        assert str(job / "out" / name) in lines
        assert (job / "out" / name).stat().st_size > 1000


def test_the_readme_shows_what_the_example_prints(reported):
    _, done = reported
    printed = "\n".join(done.stdout.splitlines()[:4])
    assert f"```\n{printed}\n```" in (ROOT / "README.md").read_text()


def test_progress_is_plain_lines_when_piped(reported):
    _, done = reported
    assert "\x1b" not in done.stderr
    assert "\r" not in done.stderr
    assert all(line.startswith("[") for line in done.stderr.splitlines())


def test_the_json_of_the_example_agrees_with_the_solver_run_by_hand(reported):
    job, _ = reported
    document = json.loads((job / "out" / "results.json").read_text())
    runs = [(array, run) for array in document["arrays"] for run in array["runs"]]
    assert len(runs) == 3 * 7 * 4
    for array, run_ in runs:
        columns = [
            np.loadtxt(
                job / "records" / f"{run_['motion']}-{letter}.csv", delimiter=",", skiprows=1
            )
            for letter in ("xyz" if run_["along"] == "record" else "yxz")
        ]
        ax, ay, az = (9.80665 * column[:, 1] for column in columns)
        ax *= run_["polarity"]
        about = {"slope_rad": array["slope_rad"], "mu": array["mu"], "az_mps2": az}
        if array["id"] == "A1":  # the workbook asks for one axis
            outcome = slide(ax, 0.005, **about)
        elif array["id"] == "A2":
            outcome = slide(ax, 0.005, ay_mps2=ay, **about)
        else:
            by_speed = Friction(mu_slow=0.4, mu_fast=0.5, rate_s_per_m=20.0, mu_static=0.4)
            run = scene(ax, 0.005, ay_mps2=ay, **about)
            outcome = run_in_two_axes(replace(run, friction=by_speed))
        assert run_["prd_m"] == pytest.approx(outcome.prd_m, rel=1e-12)
        assert run_["residual_m"] == pytest.approx(outcome.residual_m, rel=1e-12, abs=1e-15)
        assert run_["status"] == outcome.status
    for array in document["arrays"]:
        peaks = [
            max(r["prd_m"] for r in array["runs"] if r["motion"] == f"RM{k}") for k in range(1, 8)
        ]
        computed = 1.1 * sum(peaks) / 7
        floor = 0.5 * 60 * 0.0254 * (1.566 - 0.4) ** 2
        assert array["computed_m"] == pytest.approx(computed, rel=1e-12)
        assert array["design_m"] == pytest.approx(max(computed, floor), rel=1e-12)
