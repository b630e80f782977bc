"""The commands as a user or a script calls them: help, `new`, `check`, `report`, `doctor`."""

import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace
from zipfile import ZipFile

import click
import pytest
from click.testing import CliRunner
from openpyxl import load_workbook

from fixtures import packages, project_parts
from fixtures.commands import errors_of, run, stdout_of
from fixtures.marks import by_day
from fixtures.paths import ROOT
from fixtures.workbooks import arrays, cell_address, make, project
from report.cli.console import color_choice, colored
from report.cli.installation_check import NATIVE
from report.cli.main import main
from report.results.publish import STAMP
from report.text.command_line import as_typed

EXAMPLE = ROOT / "projects" / "example"
MANY = (
    "numpy", "numba", "pandas", "openpyxl", "matplotlib", "ezdxf", "ziamath",
    "ctypes", "importlib.metadata", "tomllib",
)  # fmt: skip


def loaded_by(code):
    """What Python prints, and which modules that are slow to load it has then loaded."""
    code += f"; import sys; print(*sorted({set(MANY)} & set(sys.modules)))"
    command = [sys.executable, "-c", code]
    # Coverage, which the tests of the night start in each process, loads modules of its own.
    plain = {name: value for name, value in os.environ.items() if not name.startswith("COVERAGE")}
    done = subprocess.run(command, capture_output=True, text=True, check=True, env=plain)
    *told, loaded = done.stdout.splitlines()
    return "\n".join(told), set(loaded.split())


@pytest.mark.quick
def test_help_and_errors_wait_for_nothing_heavy(tmp_path):
    code = "from report.cli.main import main; main(['--help'], standalone_mode=False)"
    told, loaded = loaded_by(code)
    assert not loaded
    for command in ("new", "check", "motion", "report", "slide", "verify"):
        assert f"\n  {command} " in told
    code = f"from report.cli.main import main; main(['check', {str(tmp_path)!r}])"
    code = f"import contextlib\nwith contextlib.suppress(SystemExit): {code}\nprint()"
    _, loaded = loaded_by(code)
    assert loaded
    assert not loaded & {"numba", "pandas", "matplotlib"}


def test_new_writes_a_workbook_or_the_example_and_never_overwrites_one(tmp_path):
    stdout_of("new", tmp_path / "job")
    assert (tmp_path / "job" / "records").is_dir()
    book = tmp_path / "job" / "input.xlsx"
    before = book.read_bytes()
    assert "already exists" in errors_of("new", tmp_path / "job", "--units", "si")
    assert book.read_bytes() == before
    (tmp_path / "input.xlsx").symlink_to(tmp_path / "elsewhere.xlsx")
    assert "already exists" in errors_of("new", tmp_path)
    assert not (tmp_path / "elsewhere.xlsx").exists()
    (tmp_path / "job" / "records" / "mine.csv").write_text("0,0")
    book.unlink()
    told = errors_of("new", "--example", tmp_path / "job")
    assert "records: is not empty; choose another folder" in told
    assert not book.exists()
    made = tmp_path / "example"
    stdout_of("new", "--example", made)
    names = {path.relative_to(made) for path in made.rglob("*.*")}
    assert len(names) == 25  # the workbook, 21 records and three documents
    for name in names - {Path("input.xlsx")}:
        assert (made / name).read_bytes() == (EXAMPLE / name).read_bytes()
    with ZipFile(made / "input.xlsx") as one, ZipFile(EXAMPLE / "input.xlsx") as other:
        parts = [part for part in one.namelist() if part.endswith(".xml")]
        for part in set(parts) - {"docProps/core.xml"}:
            assert one.read(part) == other.read(part), part
    told = stdout_of("check", made)
    assert "no errors. 3 arrays, 6 clearances, 7 motions, S_DS 1.566 g" in told


def test_input_errors_and_failed_runs_leave_the_older_package(tmp_path, monkeypatch):
    stdout_of("new", tmp_path)
    told = errors_of("check", tmp_path)
    assert cell_address("<Project/Project name>: project name is missing") in told
    assert cell_address("<Arrays/heading/ID>: no array is entered") in told
    former = tmp_path / "issued.json"
    former.write_bytes(b'{"schema_version": 2, "arr')
    told = errors_of("report", tmp_path / "no-such-project", "--since", former)
    assert "issued.json: not a results.json file, or damaged" in told
    assert not (tmp_path / "out").exists()
    monkeypatch.setattr("report.making.pages", lambda *_: 1 / 0)
    done = run("report", make(tmp_path))
    assert done.exit_code == 1
    assert isinstance(done.exception, ZeroDivisionError)
    assert not (tmp_path / "out").exists()
    book, out = make(tmp_path), tmp_path / "out"
    out.mkdir()
    (out / "calc-package.pdf").write_bytes(b"older")
    (tmp_path / "records" / "x3.csv").write_text("time_s,acceleration_g\n0,abc\n")
    told = errors_of("report", book)
    assert "x3.csv" in told
    assert f"{out / 'calc-package.pdf'} is from an earlier run (" in told
    assert [path.read_bytes() for path in out.iterdir()] == [b"older"]


def test_the_file_for_a_browser_is_left_out_and_that_of_a_run_before_goes(tmp_path):
    book, file = make(tmp_path), tmp_path / "out" / "calc-package.html"
    with packages.unlaid(), packages.undrawn():
        assert str(file) in stdout_of("report", book)
        assert file.read_bytes().startswith(b"<!DOCTYPE html>")
        assert "calc-package.html" in (tmp_path / "out" / STAMP).read_text()
        assert str(file) not in stdout_of("report", book, "--no-page")
    assert not file.exists()
    assert "calc-package.html" not in (tmp_path / "out" / STAMP).read_text()


@pytest.mark.nightly
def test_a_rigid_block_that_is_not_adequate_is_ng(tmp_path):
    given = project().model_dump()
    shutil.copy(ROOT / "projects" / "school" / "peer-review.pdf", tmp_path)
    # Padded, so that every run comes to rest; too steep for the prescriptive route.
    book = make(
        tmp_path,
        links=[{"array": "A2", "friction": "0.30, 0.45, 0.60", "stiffness_n_per_m": 1e3}],
        options={"statistic": "per rule set", **project_parts.REVIEW},
        motions=[motion | {"pad_s": 20.0} for motion in given["motions"]],
        arrays=[array | {"slope_value": 7.0} for array in given["arrays"]],
    )
    with packages.unlaid():
        told = stdout_of("report", book)
    assert "NG: Design displacement as a row of linked blocks, A2: " in told
    results = json.loads((tmp_path / "out" / "results.json").read_text())
    (row,) = results["linked"]
    assert results["verdict"] == "NG"
    assert row["rigid_is_enough"] is False
    assert row["estimated_m"] > row["design_m"] > 0.0


@pytest.mark.nightly
def test_since_a_former_revision_the_terminal_counts_and_the_package_lists(tmp_path):
    former = tmp_path / "issued.json"
    with packages.unlaid():
        assert "since revision" not in stdout_of("report", make(tmp_path))
        former.write_bytes((tmp_path / "out" / "results.json").read_bytes())
        book = make(tmp_path, arrays=arrays(mu=0.33))
        told = stdout_of("report", book, "--since", former)
        words = packages.words((tmp_path / "out" / "calc-package.pdf").read_text(encoding="utf-8"))
        document = json.loads(former.read_text(encoding="utf-8"))
        document["input"]["project"] |= {"name": "Elsewhere", "number": "99-1"}
        former.write_text(json.dumps(document), encoding="utf-8")
        of_another = stdout_of("report", book, "--since", former)
    (line,) = (text for text in told.splitlines() if text.startswith("since revision"))
    assert line.startswith("since revision 1: ")
    assert "input 1," in line
    assert line.endswith("; the package lists them after its summary")
    assert words.index("Changes since revision 1") < words.index("2 Comparison with the")
    assert "Friction coefficient" in words
    assert "of another project" not in told
    assert "file is from another project: 99-1, Elsewhere; check that it is" in of_another


VERDICT = "\x1b[31m\x1b[1mNG\x1b[0m"


@pytest.mark.quick
def test_the_help_lists_every_command_under_a_title_with_its_whole_first_sentence():
    lines = stdout_of("--help").splitlines()
    titles = [line[:-1] for line in lines if re.fullmatch(r"[A-Z]\w+:", line)]
    assert titles == [
        "Options",
        "Package",
        "Workbook",
        "Motions",
        "Studies",
        "Trust",
        "Installation",
    ]
    words = " ".join(" ".join(lines).split())
    for name, command in main.every().items():
        first = " ".join(command.help.partition("\n\n")[0].split())
        assert f" {name} {first}" in words
    for group in ("motion", "plan"):
        assert "..." not in stdout_of(group, "--help").replace("[ARGS]...", "")


def on_a_terminal(*words, env=None):
    """What a command prints where its output keeps its colors, as on a terminal."""
    return CliRunner(env=env).invoke(main, [str(word) for word in words], color=True).stdout


def test_levels_and_verdicts_are_colored_on_a_terminal_alone(tmp_path):
    book = make(tmp_path)
    assert "\x1b[33mwarning\x1b[0m: " in on_a_terminal("check", book)
    assert "\x1b" not in stdout_of("check", book)
    assert colored("A1  0.8 in  NG: slope") == f"A1  0.8 in  {VERDICT}: slope"
    assert click.unstyle(colored("verdict: OK with conditions")) == "verdict: OK with conditions"
    assert colored("verdict: OK with conditions").count("\x1b[33m") == 1
    assert colored("a warning: TONG, BOOK, NORTH") == "a warning: TONG, BOOK, NORTH"


def test_a_reader_may_want_no_color(monkeypatch):
    monkeypatch.delenv("NO_COLOR", raising=False)
    monkeypatch.setenv("TERM", "xterm")
    assert color_choice() is None
    for name, value in (("NO_COLOR", "1"), ("TERM", "dumb")):
        with monkeypatch.context() as patch:
            patch.setenv(name, value)
            assert color_choice() is False


@pytest.mark.parametrize("shell", ["bash", "zsh", "fish"])
@pytest.mark.quick
def test_completion_prints_the_script_of_a_shell(shell):
    script = stdout_of("completion", shell)
    assert "_ROOFSLIP_COMPLETE" in script
    assert f"{shell}_complete" in script


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (("rreport",), "No such command 'rreport'. Did you mean 'report'?"),
        (("plan", "rread"), "No such command 'rread'. Did you mean 'read'?"),
        (("report", "x", "--fail-on"), "Did you mean"),
        (("sign", "README.md", "--p12", "READNE.md"),
         "'READNE.md' does not exist; did you mean 'README.md'?"),
        (("check", "projects/exaample"), "did you mean 'projects/example'?"),
    ],
)  # fmt: skip
def test_a_word_that_is_not_known_is_answered_with_the_nearest(monkeypatch, words, told):
    monkeypatch.chdir(ROOT)
    for group in (main, main.every()["plan"]):
        monkeypatch.setattr(group, "commands", {})  # none is loaded yet, as in a terminal
    assert told in errors_of(*words)


@pytest.mark.parametrize("typed", by_day(["./roofslip", "'my programs/roofslip'"], 1))
def test_the_command_is_called_as_the_reader_typed_it(tmp_path, monkeypatch, typed):
    monkeypatch.setenv("ROOFSLIP_COMMAND", typed.strip("'"))
    assert f"then run: {typed} check {tmp_path}" in stdout_of("new", tmp_path)
    told = stdout_of("check", make(tmp_path / "filled"))
    assert told.splitlines()[-1].startswith(f"Next: {typed} report ")
    assert as_typed("Run roofslip check FOLDER.") == f"Run {typed} check FOLDER."
    assert as_typed("of Roofslip, roofslip.pdf") == "of Roofslip, roofslip.pdf"
    book = load_workbook(tmp_path / "input.xlsx", read_only=True)
    start = "\n".join(str(cell) for row in book["Start"].values for cell in row)
    assert f"Run {typed} check FOLDER to list" in start


@pytest.mark.nightly
def test_doctor_looks_for_a_package_by_its_name_without_bounds_and_for_no_extra(monkeypatch):
    wanted = ["numpy>=1.0,<99", "nobody; extra == 'web'"]
    monkeypatch.setattr("report.cli.installation_check.requires", lambda _: wanted)
    told = stdout_of("doctor")
    assert re.search(r"^numpy +\d", told, re.MULTILINE)
    assert "nobody" not in told


@pytest.mark.nightly
def test_with_everything_installed_it_says_so():
    told = stdout_of("doctor")
    lines = told.splitlines()
    names = [line.split("  ")[0] for line in lines]
    assert {"Python", "cores", "numpy", "weasyprint", "fontconfig", "test run"} <= set(names)
    assert any(re.match(r"test page +[\d,]+ bytes", line) for line in lines)
    # 0.1 g x 0.8^2 / 6, in closed form.
    assert any(line.startswith("test run") and "0.104604267 m" in line for line in lines)
    assert lines[-1] == "Everything needed to create a package is installed."


def test_missing_packages_and_libraries_are_named(monkeypatch):
    monkeypatch.setitem(NATIVE, "no-such-library", "libnone0")
    done = run("doctor")
    assert done.exit_code == 1
    assert done.stderr == "Error: no-such-library: install it: sudo apt-get install libnone0\n"
    assert re.search(r"no-such-library +missing", done.stdout)
    assert "Everything" not in done.stdout
    needed = ["numpy", "no-such-package", "other-package; extra == 'sign'"]
    monkeypatch.setattr("report.cli.installation_check.requires", lambda _: needed)
    done = run("doctor")
    assert done.exit_code == 1
    assert "no-such-package: run ./roofslip, which installs it" in done.stderr
    assert "other-package" not in done.output


def test_a_broken_renderer_or_solver_is_a_finding(monkeypatch):
    def broken(_):
        raise OSError("cannot load library 'libpango-1.0-0'")

    monkeypatch.setattr("report.typeset.pdf.lay_out", broken)
    done = run("doctor")
    assert re.search(r"test page +fails: cannot load library 'libpango-1.0-0'", done.stdout)
    assert done.stderr == (
        "Error: test page: install what is missing above, or reinstall the program\n"
    )
    monkeypatch.setattr("solver.sliding.checked.slide", lambda *_, **__: SimpleNamespace(prd_m=0.1))
    done = run("doctor")
    assert done.exit_code == 1
    assert re.search(r"test run +fails: 0\.100000000 m", done.stdout)
    assert done.stderr.startswith("Error: test run: delete .venv and run ./roofslip again")
