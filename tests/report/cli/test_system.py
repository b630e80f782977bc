"""What the system refuses, and what a terminal may be shown: exit code 2, never a traceback."""

import pytest

from commands import printed, refused
from places import ROOT
from report.cli.several import package
from report.cli.terminal import plain
from sheets import at, edit, make, type_into

pytestmark = pytest.mark.quick

RECORD = ROOT / "projects" / "example" / "records" / "RM1-x.csv"
LONG = "x" * 300
TOO_LONG = "File name too long"


@pytest.mark.parametrize(
    "arguments",
    [
        ["check", LONG],
        ["report", LONG],
        ["new", LONG],
        ["watch", LONG],
        ["motion", "info", LONG],
        ["motion", "convert", RECORD, LONG],
        ["motion", "info", RECORD, "--plot", f"{LONG}.svg"],
        ["slide", LONG, "--slope-deg", 2, "--mu", 0.5],
    ],
)
def test_a_name_that_is_too_long_is_an_input_error(arguments, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert TOO_LONG in refused(*arguments)
    assert list(tmp_path.iterdir()) == []


def test_names_that_are_too_long_are_refused_before_the_run(tmp_path):
    (problem,) = map(str, package(tmp_path / LONG).problems)
    assert f"the system refuses it ({TOO_LONG})" in problem
    told = refused("report", make(tmp_path), "--out", tmp_path / LONG)
    assert TOO_LONG in told
    assert "running" not in told


def test_odd_letters_and_long_values_are_shown_short(tmp_path):
    assert plain("a\x1b[31m\u202eb\u2066c\u2028d\x9be") == "a?[31m?b?c?d?e"
    assert plain("μ is 0.5 — 屋上") == "μ is 0.5 — 屋上"
    assert len(plain("9" * 10_000)) < 2010
    named = tmp_path / "a\u202eb\x1b[31m.csv"
    named.write_text("abc\n")
    for command in (["motion", "info"], ["check"], ["report"]):
        assert not set("\u202e\x1b") & set(refused(*command, named))
    told = refused("check", type_into(make(tmp_path), {"Arrays/A1/CG height": 10**400}))
    line = f"<Arrays/A1/CG height>: CG height is 1{'0' * 58}…; give a number of more than 0"
    assert at(line) in told
    assert max(map(len, told.splitlines())) < 300


def test_a_name_defined_off_the_sheet_is_no_name(tmp_path):
    def change(book):
        name = next(name for name in book.defined_names if name.startswith("site_"))
        book.defined_names[name].attr_text = "'Site'!$ZZZ$9999999"

    printed("check", edit(make(tmp_path), change))


@pytest.mark.parametrize(("largest", "shown"), [("1e100", "1e+100"), ("1e4", "1e+04")])
def test_accelerations_of_no_earthquake_are_refused(largest, shown, tmp_path):
    path = tmp_path / "a.csv"
    path.write_text(f"{largest}\n-1\n0\n")
    told = refused("motion", "info", path, "--units", "g", "--dt", 0.01)
    assert f"the values reach {shown} g; give a record of at most 1000 g" in told


@pytest.mark.parametrize("dt_s", [4e307, 1e200, 11.0, 1e-9])
def test_steps_of_no_accelerogram_are_refused(dt_s, tmp_path):
    path = tmp_path / "a.csv"
    path.write_text("0.1\n-0.1\n0\n")
    assert "time step" in refused("motion", "info", path, "--units", "g", "--dt", dt_s)
