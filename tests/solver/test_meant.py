"""A path that is not there is asked about, if one nearly fits."""

import shutil

import pytest
from click.testing import CliRunner

from places import ROOT
from report.cli.main import main
from solver.meant import meant


@pytest.fixture
def folder(tmp_path):
    (tmp_path / "project" / "records").mkdir(parents=True)
    (tmp_path / "project" / "records" / "RM1-x.csv").write_text("0.1\n")
    (tmp_path / "project" / "results.json").write_text("{}")
    return tmp_path


@pytest.mark.parametrize(
    ("given", "found"),
    [
        ("project/records/RM1_x.csv", "project/records/RM1-x.csv"),
        ("projetc/records/RM1-x.csv", "project/records/RM1-x.csv"),
        ("projetc/records/none.csv", "project"),
        ("PROJECT/result.json", "project"),
        ("project/result.json", "project/results.json"),
    ],
)
def test_a_path_that_nearly_fits_is_named(folder, given, found):
    assert meant(folder / given) == f"did you mean '{folder / found}'?"


@pytest.mark.parametrize("given", ["elsewhere/x", "project/records/RM1-x.csv", "a" * 300])
def test_nothing_is_asked_where_nothing_is_near_or_the_path_is_there(folder, given):
    assert meant(folder / given) == ""


@pytest.mark.parametrize(
    "arguments",
    [
        ["check", "projetc"],
        ["motion", "info", "projetc"],
        ["verify-package", "projetc"],
        ["plan", "read", "projetc", "project"],
        ["report", "project", "--since", "projetc"],
        ["motion", "suite", "out", "--code", "asce7-16", "--target", "projetc"],
    ],
)
def test_each_command_asks_about_a_path_that_nearly_fits(folder, monkeypatch, arguments):
    shutil.copy(ROOT / "projects" / "example" / "input.xlsx", folder / "project")
    monkeypatch.chdir(folder)
    done = CliRunner().invoke(main, arguments)
    assert done.exit_code == 2
    assert "did you mean 'project'?" in done.output
