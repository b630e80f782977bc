"""Equal errors of many cells are one line with their count, on the terminal and on the page."""

import json
import pickle

import pytest
from click.testing import CliRunner

from report.cli.main import main
from report.sheet.checking.findings import grouped
from report.sheet.reading.read import read
from report.web.jobs import problems
from sheets import at, make, said, type_into
from solver.model import InputError, Problem

pytestmark = pytest.mark.quick

IS_WET, NUMBER = "friction coefficient is 'wet'", "give a number from 0 to 1.5"
WRONG = f"{IS_WET}; {NUMBER}"
OTHER = "weight is 0; give a number of more than 0 [lb]"


def test_equal_errors_are_one_line_and_others_stay_apart():
    (line,) = grouped(Problem(IS_WET, NUMBER, f"Arrays!E{row}") for row in range(8, 1508))
    assert line.line == f"Arrays!E8, Arrays!E9, Arrays!E10 and 1,497 more: {WRONG}"
    assert line.cells[-1] == "E1507"
    first, second, elsewhere = (
        Problem(IS_WET, NUMBER, cell) for cell in ("Arrays!E8", "Arrays!E9", "Objects!E8")
    )
    no_file, weight = Problem("no such file"), Problem.of(OTHER).at("Arrays!H8")
    lines = [each.line for each in grouped([no_file, first, weight, second, elsewhere, no_file])]
    apart = list(map(str, (no_file, weight, elsewhere, no_file)))
    assert lines == [apart[0], f"Arrays!E8, Arrays!E9: {WRONG}", *apart[1:]]


MU = "Arrays/{}/Friction coefficient"
WET = {MU.format("A1"): "wet", MU.format("A2"): "wet"}


def test_check_prints_one_line_and_counts_all(tmp_path):
    path = type_into(make(tmp_path), WET | {"Arrays/A1/Weight": 0})
    done = CliRunner().invoke(main, ["check", str(path)])
    assert done.exit_code == 2
    # After a second, a slow machine says what it does.
    head, *lines = (line for line in done.stderr.splitlines() if not line.startswith("["))
    assert head == f"{path}: 3 problems found."
    assert lines == [f"  {', '.join(said(*WET))}: {WRONG}", at(f"  <Arrays/A1/Weight>: {OTHER}")]
    data = json.loads(CliRunner().invoke(main, ["check", str(path), "--json"]).stdout)
    assert len(data["errors"]) == 3


def refused(path):
    """The error of a workbook."""
    with pytest.raises(InputError) as caught:
        _ = read(path).project
    return caught.value


def test_typed_semicolons_and_problems_without_a_cell_are_shown_on_the_page(tmp_path):
    path = type_into(make(tmp_path), {MU.format("A1"): "wet; dry"})
    (found,) = problems(path, refused(path))
    assert (found["found"], found["remedy"]) == ("friction coefficient is 'wet; dry'", NUMBER)
    error = InputError([Problem("one row is given", "give two", "Spectrum"), "no file; give one"])
    found = problems(tmp_path / "none.xlsx", error)
    shown = [(each["found"], each["remedy"]) for each in found]
    assert shown == [("Spectrum: one row is given", "give two"), ("no file", "give one")]
    assert error.problems == ("Spectrum: one row is given; give two", "no file; give one")
    assert pickle.loads(pickle.dumps(error)).parts == error.parts


@pytest.mark.nightly
def test_the_page_shows_the_cells_with_the_row_of_the_first(tmp_path):
    cells = said(*WET)
    path = type_into(make(tmp_path), WET)
    (found,) = problems(path, refused(path))
    first, second = (cell.partition("!")[2] for cell in cells)
    assert (found["cell"], found["cells"]) == (first, f"{first}, {second}")
    assert found["text"] == f"{', '.join(cells)}: {WRONG}"
    assert found["row"]["cells"][found["row"]["at"]] == "wet"
