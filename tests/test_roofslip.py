"""`import roofslip` offers what `solver` and `report` do, and no file of the reader hides them."""

import os
import re
import shutil
import subprocess
import sys

import pytest

import report
import roofslip
import solver
from places import ROOT

pytestmark = pytest.mark.quick

SLID = (
    "import roofslip; print(roofslip.slide([0, 4, -4, 0, 0, 0], 0.1, slope_rad=0, mu=0.2).status)"
)


def run(folder, program):
    """Run a program in a folder, whose modules it finds first."""
    path = [folder, ROOT]
    told = f"import sys; sys.path[:0] = {list(map(str, path))}; {program}"
    command = [sys.executable, "-P", "-c", told]
    return subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)


def test_a_hidden_package_is_named_and_every_public_name_offered(tmp_path):
    assert set(dir(roofslip)) == {*solver.__all__, *report.__all__}
    for package in (solver, report):
        for name in package.__all__:
            assert getattr(roofslip, name) is getattr(package, name), name
    (tmp_path / "solver.py").write_text("")
    done = run(tmp_path, f"import solver; {SLID}")
    assert f"{tmp_path / 'solver.py'} is loaded and hides a package of Roofslip" in done.stderr
    assert done.returncode == 1


@pytest.mark.nightly
def test_a_file_beside_a_notebook_hides_neither_package(tmp_path):
    for name in ("solver", "report"):
        (tmp_path / f"{name}.py").write_text("raise SystemExit('the wrong one')\n")
    assert "the wrong one" in run(tmp_path, "import solver").stderr
    assert run(tmp_path, SLID).stdout == "ok\n"


def test_the_launcher_looks_for_no_package_where_it_is_called():
    calls = re.findall(
        r'"\$venv/bin/python" (?:-P )?(?:-m|"\$venv)', (ROOT / "roofslip").read_text()
    )
    assert len(calls) == 3
    assert all(" -P " in call for call in calls)
    assert '"$venv/bin/roofslip" "$@"' in (ROOT / "roofslip").read_text()


STUB = """#!/bin/sh
echo "$PWD: ${PYTHONPATH-no path}" >>"$(dirname -- "$0")/seen"
exit STATUS
"""


def launcher(tmp_path, name="copy", stamp=""):
    """A copy of the launcher with tools that only note how they are called."""
    folder = tmp_path / name
    bin_ = folder / ".venv" / "bin"
    bin_.mkdir(parents=True)
    for file in ("roofslip", "pyproject.toml", "requirements.lock"):
        shutil.copy(ROOT / file, folder)
    for tool in TOOLS:
        (bin_ / tool).write_text(NOTING)
        (bin_ / tool).chmod(0o755)
    (folder / ".venv" / ".set-up-from").write_text(stamp)
    return folder


TOOLS = (
    "uv", "python", "apt-get", "ldconfig", "ruff", "codespell", "oxlint", "mypy", "lint-imports",
    "hadolint", "pytest", "coverage",
)  # fmt: skip


NOTING = """#!/bin/sh
echo "$(basename -- "$0") $*" >>"$(dirname -- "$0")/seen"
"""


def calls_of(folder, program, *words, status=0):
    path = f"{folder / '.venv' / 'bin'}:{os.environ['PATH']}"
    command = [program, *(words or ("check", "x"))]
    done = subprocess.run(command, env={"PATH": path}, capture_output=True, check=False)
    assert done.returncode == status, done.stderr
    return (folder / ".venv" / "bin" / "seen").read_text().splitlines()


def test_the_launcher_follows_its_own_link(tmp_path):
    folder = launcher(tmp_path)
    (tmp_path / "bin").mkdir()
    (tmp_path / "bin" / "one").symlink_to("two")
    (tmp_path / "bin" / "two").symlink_to("../copy/roofslip")
    assert calls_of(folder, tmp_path / "bin" / "one")[-1] == (
        f"python -P {folder}/.venv/bin/roofslip check x"
    )


@pytest.mark.parametrize(
    ("words", "status", "said"),
    [
        (["stdy", "x"], 2, "no such command 'stdy'; "),
        (["study", "no.xlsx"], 1, "no.xlsx: no such file or folder"),
        (["report", "projects", "--jbos=2"], 2, "no such option '--jbos'; see "),
        (["motion", "rows", "x", "--without"], 0, ""),
    ],
)
def test_the_launcher_checks_arguments_before_it_installs_anything(tmp_path, words, status, said):
    folder = launcher(tmp_path)
    shutil.copytree(ROOT / "docs", folder / "docs", ignore=shutil.ignore_patterns("pictures"))
    (folder / "projects").mkdir()
    path = f"{folder / '.venv' / 'bin'}:{os.environ['PATH']}"
    done = subprocess.run(
        [folder / "roofslip", *words], cwd=folder, env={"PATH": path}, capture_output=True,
        text=True, check=False,
    )  # fmt: skip
    assert (done.returncode, said in done.stderr) == (status, True)
    seen = folder / ".venv" / "bin" / "seen"
    assert seen.exists() == (status == 0)


def test_an_environment_that_was_copied_is_made_anew_where_it_is(tmp_path):
    folder = launcher(tmp_path)
    first = calls_of(folder, folder / "roofslip")
    assert any(call.startswith("uv venv --quiet --clear") for call in first)
    assert calls_of(folder, folder / "roofslip")[len(first) :] == [
        f"python -P {folder}/.venv/bin/roofslip check x"
    ]
    other = launcher(tmp_path, "other", stamp=(folder / ".venv" / ".set-up-from").read_text())
    calls = calls_of(other, other / "roofslip")
    assert any(call.startswith("uv venv --quiet --clear") for call in calls)
    assert any(call.endswith(f"-e {other}") for call in calls)


@pytest.mark.parametrize(
    ("words", "chosen"),
    [
        ([], "-m not nightly"),
        (["--quick"], "-m quick and not nightly"),
        (["-x", "tests/solver"], "-x tests/solver"),
        (["--nightly", "tests/solver"], "-m nightly tests/solver"),
    ],
)
def test_the_launcher_runs_the_tests_of_a_path_a_day_or_a_minute(tmp_path, words, chosen):
    folder = launcher(tmp_path)
    assert calls_of(folder, folder / "roofslip", "test", *words)[-1] == (
        f"pytest --numprocesses 2 --dist worksteal {chosen}"
    )


@pytest.mark.parametrize("part", ["run", "report", "none"])
def test_the_night_fails_where_a_test_or_the_coverage_does(tmp_path, part):
    folder = launcher(tmp_path)
    coverage = folder / ".venv" / "bin" / "coverage"
    coverage.write_text(f'{NOTING}[ "$1" != {part} ]\n')
    calls = calls_of(folder, folder / "roofslip", "test", "--nightly", status=int(part != "none"))
    done = [call.split()[1] for call in calls if call.startswith("coverage ")]
    assert done == ["erase", "run", "run", "combine", "report", "report"]
    assert calls[-1] == "coverage report"


def test_the_launcher_takes_nothing_from_where_it_is_called(tmp_path):
    """Tools of the set-up take modules and settings of the current folder, and so does a path."""
    folder, here = launcher(tmp_path), tmp_path / "here"
    here.mkdir()
    bin_ = folder / ".venv" / "bin"

    def called(status):
        for name in ("uv", "python"):
            (bin_ / name).write_text(STUB.replace("STATUS", str(status)))
        environment = {"PATH": f"{bin_}:{os.environ['PATH']}", "PYTHONPATH": f"{ROOT}:"}
        command = [folder / "roofslip", "check", "x"]
        done = subprocess.run(command, cwd=here, env=environment, capture_output=True, check=False)
        assert (done.returncode == 0) == (status == 0), done.stderr
        return (bin_ / "seen").read_text().splitlines()

    assert set(called(1)) == {f"{folder}: no path"}
    *set_up, last = called(0)
    assert (set(set_up), last) == ({f"{folder}: no path"}, f"{here}: no path")


@pytest.mark.parametrize("tool", ["ruff", "oxlint", "mypy", "lint-imports"])
def test_what_a_linter_finds_ends_the_tests(tmp_path, tool):
    folder = launcher(tmp_path)
    calls_of(folder, folder / "roofslip", "test")
    failing = folder / ".venv" / "bin" / tool
    failing.write_text(f"{NOTING}exit 1\n")
    before = len(calls_of(folder, folder / "roofslip", "test", status=1))
    assert calls_of(folder, folder / "roofslip", "test", status=1)[before:][-1].startswith(tool)
