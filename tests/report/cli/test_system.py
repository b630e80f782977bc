"""What the system refuses, and what a terminal may be shown: exit code 2, never a traceback."""

import os
import subprocess
import sys

import pytest
from click.testing import CliRunner

from places import ROOT
from report.cli.main import main
from report.cli.terminal import plain
from sheets import at, edit, make, type_into

RECORD = ROOT / "projects" / "example" / "records" / "RM1-x.csv"
LONG = "x" * 300


def run(*arguments):
    return CliRunner().invoke(main, [str(item) for item in arguments])


@pytest.mark.parametrize(
    "arguments",
    [
        ["check", LONG],
        ["report", LONG],
        ["new", LONG],
        ["motion", "info", LONG],
        ["motion", "convert", RECORD, LONG],
        ["motion", "info", RECORD, "--plot", f"{LONG}.svg"],
        ["slide", LONG, "--slope-deg", 2, "--mu", 0.5],
    ],
)
def test_a_name_that_is_too_long_is_an_input_error(arguments, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    done = run(*arguments)
    assert done.exit_code == 2
    assert "File name too long" in done.output
    assert list(tmp_path.iterdir()) == []


def test_an_output_folder_with_too_long_a_name_is_refused_before_the_run(tmp_path):
    done = run("report", make(tmp_path), "--out", tmp_path / LONG)
    assert done.exit_code == 2
    assert "File name too long" in done.output
    assert "running" not in done.output


@pytest.mark.parametrize("arguments", [["check", "x"], ["new", "x"], ["motion", "info", "x"]])
def test_a_working_folder_that_is_gone_is_an_input_error(arguments, tmp_path):
    gone = tmp_path / "gone"
    gone.mkdir()
    code = (
        "import os, sys; os.rmdir(os.getcwd()); from report.cli.main import main; "
        f"main({arguments!r})"
    )
    environment = os.environ | {"PYTHONPATH": str(ROOT)}
    done = subprocess.run(
        [sys.executable, "-P", "-c", code],
        cwd=gone,
        env=environment,
        capture_output=True,
        text=True,
    )
    assert done.returncode == 2
    assert "Traceback" not in done.stderr


@pytest.mark.nightly("report/cli/terminal.py")
def test_without_a_standard_error_the_exit_code_is_the_same(tmp_path):
    code = (
        "import os, sys; os.close(2); sys.stderr = None; from report.cli.main import main; main()"
    )
    environment = os.environ | {"PYTHONPATH": str(ROOT)}
    for arguments, expected in (
        (["check", str(tmp_path / "none")], 2),
        (["motion", "info", str(RECORD)], 0),
        (["motion", "suite", str(tmp_path / "made"), "--sds", "9", "--code", "pv1"], 2),
    ):
        done = subprocess.run(
            [sys.executable, "-c", code, *arguments], env=environment, stdout=subprocess.PIPE
        )
        assert done.returncode == expected


def test_a_terminal_is_shown_no_control_characters_and_no_endless_line(tmp_path):
    assert plain("a\x1b[31m\u202eb\u2066c\u2028d\x9be") == "a?[31m?b?c?d?e"
    assert plain("μ is 0.5 — 屋上") == "μ is 0.5 — 屋上"
    assert len(plain("9" * 10_000)) < 2010
    named = tmp_path / "a\u202eb\x1b[31m.csv"
    named.write_text("abc\n")
    for arguments in (["motion", "info", named], ["check", named], ["report", named]):
        done = run(*arguments)
        assert done.exit_code == 2
        assert not set("\u202e\x1b") & set(done.output)


def test_a_value_of_four_hundred_digits_is_refused_and_not_echoed_whole(tmp_path):
    book = type_into(make(tmp_path), {"Arrays/A1/CG height": 10**400})
    done = run("check", book)
    assert done.exit_code == 2
    line = f"<Arrays/A1/CG height>: CG height is 1{'0' * 58}…; give a number of more than 0"
    assert at(line) in done.output
    assert max(map(len, done.output.splitlines())) < 300


def test_a_start_time_beyond_all_records_is_refused(tmp_path):
    name = "Motions/M1/Start time"
    book = type_into(make(tmp_path), {name: 4e307})
    done = run("check", book)
    assert done.exit_code == 2
    assert at(name) in done.output


def test_a_name_defined_off_the_sheet_is_no_name(tmp_path):
    def change(book):
        name = next(name for name in book.defined_names if name.startswith("site_"))
        book.defined_names[name].attr_text = "'Site'!$ZZZ$9999999"

    assert run("check", edit(make(tmp_path), change)).exit_code == 0


@pytest.mark.parametrize("s_ds", ["1e-9", "0", "-1", "nan", "1e300"])
def test_a_suite_for_no_earthquake_is_refused_at_once(s_ds, tmp_path):
    done = run("motion", "suite", tmp_path / "made", "--sds", s_ds, "--code", "asce7-16")
    assert done.exit_code == 2
    assert not (tmp_path / "made").exists()


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("1e100\n-1e100\n0\n", "the values reach 1e+100 g; give a record of at most 1000 g"),
        ("1e4\n-1\n0\n", "the values reach 1e+04 g; give a record of at most 1000 g"),
    ],
)
def test_accelerations_of_no_earthquake_are_refused(text, words, tmp_path):
    path = tmp_path / "a.csv"
    path.write_text(text)
    done = run("motion", "info", path, "--units", "g", "--dt", 0.01)
    assert done.exit_code == 2
    assert words in done.output


@pytest.mark.parametrize("dt_s", [4e307, 1e200, 11.0, 1e-9])
def test_steps_of_no_accelerogram_are_refused(dt_s, tmp_path):
    path = tmp_path / "a.csv"
    path.write_text("0.1\n-0.1\n0\n")
    done = run("motion", "info", path, "--units", "g", "--dt", dt_s)
    assert done.exit_code == 2
    assert "time step" in done.output
