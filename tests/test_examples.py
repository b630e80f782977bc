"""The examples of the docs run as scripts in a folder of their own, and open as notebooks."""

import os
import runpy
import subprocess
import sys
from importlib.util import module_from_spec, spec_from_file_location

import pytest
from dlml._tabular import load_tabular
from matplotlib import pyplot

from nightly import nightly
from places import ROOT

EXAMPLES = ROOT / "docs" / "examples"
LONG = {"suite", "workbook", "varied", "own_method"}


def listed():
    """Return the names in the order of the docs."""
    spec = spec_from_file_location("make_examples", ROOT / "docs" / "make.py")
    make = module_from_spec(spec)
    spec.loader.exec_module(make)
    return make.EXAMPLES


@pytest.mark.filterwarnings("ignore::pandas.errors.Pandas4Warning")  # of dlml
@pytest.mark.parametrize("name", [nightly(n) if n in LONG else n for n in listed()])
def test_an_example_runs_and_saves_what_it_shows(name, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("MPLBACKEND", "agg")
    runpy.run_path(str(EXAMPLES / f"{name}.py"))
    pyplot.close("all")
    assert capsys.readouterr().out
    (picture,) = tmp_path.glob("*.png")
    assert picture.stat().st_size > 5_000
    if name == "fragility":
        (row,) = load_tabular(tmp_path / "fragility.csv").to_dict("records")
        assert row["LS1", "Family"] == "lognormal"
        assert 0.0 < row["LS1", "Theta_0"] < row["LS2", "Theta_0"]


@pytest.mark.nightly
@pytest.mark.parametrize("name", listed())
def test_an_example_needs_no_extra_but_where_the_page_says_so(name, tmp_path):
    extras = ["distributed", "pyarrow", "scipy", "starlette", "xarray"]
    program = f"import runpy, sys; sys.modules |= dict.fromkeys({extras}); "
    program += "runpy.run_path(sys.argv[1])"
    done = subprocess.run(
        [sys.executable, "-c", program, str(EXAMPLES / f"{name}.py")],
        cwd=tmp_path,
        env=os.environ | {"MPLBACKEND": "agg"},
        capture_output=True,
        text=True,
        check=False,
    )
    page = (ROOT / "docs" / "examples.md").read_text()
    assert (done.returncode != 0) == (f"`{name}.py` needs SciPy" in page), done.stderr


@pytest.mark.parametrize("name", listed())
@pytest.mark.quick
def test_an_example_is_cells_of_words_and_code(name):
    text = (EXAMPLES / f"{name}.py").read_text()
    cells = text.split("# %%")
    assert cells[0] == ""
    assert cells[1].startswith(" [markdown]\n# # ")
    words = [cell for cell in cells[1:] if cell.startswith(" [markdown]\n")]
    assert len(words) > 1
    assert all(line.startswith("#") for cell in words for line in cell.splitlines()[1:] if line)
    for cell in set(cells[1:]) - set(words):
        compile(cell, name, "exec")


@pytest.mark.quick
def test_every_example_is_listed():
    assert {path.stem for path in EXAMPLES.glob("*.py")} == set(listed())
    assert len(listed()) == 11
