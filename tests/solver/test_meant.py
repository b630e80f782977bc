"""A path that is not there is asked about, if one nearly fits."""

import shutil
import sys

import pytest
from click.testing import CliRunner

import commands
from growth import grows_faster
from places import ROOT
from report.cli.main import main
from solver.suggestions import meant, nearest

pytestmark = pytest.mark.quick


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
        pytest.param(
            "PROJECT/result.json",
            "project",
            marks=pytest.mark.skipif(sys.platform == "win32", reason="PROJECT is the same folder"),
        ),
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


@pytest.mark.parametrize(
    ("value", "names", "found"),
    [
        ("RTU-1", ["RTU 1", "RTU-3", "RTU-2"], "RTU 1"),
        ("a1", ["A01", "A11", "A2"], "A01"),
        ("RM_1", ["RM-01", "RM-10"], "RM-01"),
        ("RTU-1", ["RTU-2", "RTU-3"], ""),  # a tie
        ("A-1", ["A 1", "A1"], ""),
        ("Skylite", ["Skylight", "RTU"], "Skylight"),
        ("x", [], ""),
    ],
)
def test_names_are_compared_without_blanks_hyphens_and_leading_zeros_first(value, names, found):
    assert nearest(value, names) == found
    assert nearest(value, names[::-1]) == found


def test_names_that_are_near_are_found_free_and_among_many():
    names = [f"RM{k}-x.csv" for k in range(1, 4)]
    assert nearest("RM-x.csv", names) == ""
    assert nearest("RM-x.csv", names, taken=["RM2-x.csv", "RM3-x.csv"]) == "RM1-x.csv"
    assert nearest("RM-x.csv", names, taken=["RM3-x.csv"]) == ""
    names = [f"{k:02}{'x' * 60}" for k in range(100)]
    assert nearest(f"98{'x' * 59}y", names) == names[98]


def test_the_lock_file_of_a_workbook_is_never_meant(tmp_path):
    for name in ("My Project.xlsx", "~$input.xlsx", "~$My Project.xlsx", ".~lock.input.xlsx#"):
        (tmp_path / name).write_bytes(b"")
    assert f"did you mean '{tmp_path / 'My Project.xlsx'}'?" in commands.refused("check", tmp_path)
    (tmp_path / "other.xlsx").write_bytes(b"")
    assert "did you mean" not in commands.refused("check", tmp_path)


@pytest.mark.nightly
def test_as_many_wrong_names_as_there_are_names_take_time_as_their_number():
    def suggested(count):
        names = [f"{'ab' * 18}{k}" for k in range(count)]
        return [nearest(f"{'ba' * 18}{k}", names) for k in range(count)]

    assert not grows_faster(suggested, lambda count: count, 40)
