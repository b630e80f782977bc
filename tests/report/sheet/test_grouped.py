"""Equal errors of many cells are one line with their count, on the terminal and on the page."""

import json

from click.testing import CliRunner

from report.cli.main import main
from report.sheet.grouped import grouped
from report.web.problems import problems
from sheets import at, make, said, type_into

WRONG = "friction coefficient is 'wet'; give a number from 0 to 1.5"
OTHER = "weight is 0; give a number of more than 0 [lb]"


def test_1500_equal_errors_are_one_line_with_their_count():
    lines = [f"Arrays!E{row}: {WRONG}" for row in range(8, 1508)]
    (line,) = grouped(lines)
    assert line.line == f"Arrays!E8, Arrays!E9, Arrays!E10 and 1,497 more: {WRONG}"
    assert line.cells[-1] == "E1507"


def test_errors_that_differ_stay_apart_in_their_order():
    lines = ["no such file", f"Arrays!E8: {WRONG}", f"Arrays!H8: {OTHER}", f"Arrays!E9: {WRONG}",
             f"Objects!E8: {WRONG}", "no such file"]  # fmt: skip
    together = f"Arrays!E8, Arrays!E9: {WRONG}"
    assert [each.line for each in grouped(lines)] == [lines[0], together, lines[2], *lines[4:]]


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


def test_the_page_shows_the_cells_with_the_row_of_the_first(tmp_path):
    cells = said(*WET)
    path = type_into(make(tmp_path), WET)
    (found,) = problems(path, [f"{cell}: {WRONG}" for cell in cells])
    first, second = (cell.partition("!")[2] for cell in cells)
    assert (found["cell"], found["cells"]) == (first, f"{first}, {second}")
    assert found["text"] == f"{', '.join(cells)}: {WRONG}"
    assert found["row"]["cells"][found["row"]["at"]] == "wet"
