"""A ballast map gives arrays their ballast weight and center of gravity; wrong lines are listed."""

from functools import partial

import numpy as np
import pytest

from fixtures.commands import output_of
from fixtures.errors import input_problems
from fixtures.project_parts import FT, LB
from fixtures.spaces import spaced
from fixtures.workbooks import arrays, edit, make, problems, project, type_into
from report.drawing_read.ballast import MAX_BYTES, center_of_gravity, loads, read_map, repeated
from report.project.check.plausible import implausible
from report.project.model.shapes import Polygon, Rectangle
from report.project.read.read import read

pytestmark = pytest.mark.quick


@pytest.mark.parametrize(
    ("content", "wanted"),
    [
        ("", ["line 1: found none or several of x, y, blocks; enter x, y and blocks once each"]),
        ("x,x,y,blocks\n", ["line 1: found none or several of x; enter x, y and blocks once each"]),
        ("x,y,blocks\n1,2,3\n\na,,1\n", ["line 4: x is 'a'; enter a number",
                                         "line 4: y is ''; enter a number"]),
        ("x,y,blocks\n1,inf,2.5\n1,2,-1\n1,2,1e9\n", [
            "line 2: y is 'inf'; enter a number",
            *(f"line {row}: blocks is {found}; enter a whole number from 0 to 10,000"
              for row, found in ((2, "2.5"), (3, "-1"), (4, "1e+09"))),
        ]),
        ("x [m],y [ft],blocks\n", ["line 1: the heading is 'y [ft]', but --units states another"
                                   " unit; enter the unit of x and y"]),
        ("x,y,blocks [lb]\n1,2,64\n", ["line 1: the heading is 'blocks [lb]'; enter the number of"
                                      " blocks below blocks"]),
        ("x,y,blocks\n22,5,18,2\n1,2,3,\n", [
            "line 2: 4 values, 3 headings; enter a heading for each column, and decimal points or"
            " semicolons"
        ]),
        (b"x,y,blocks\n\xff\n", ["not a CSV file in UTF-8 or UTF-16; save it as one"]),
        ("x,y,blocks\n" + "1,2,3\n" * 20_000, ["20,001 lines, more than 20,000; combine "
                                               "neighboring blocks"]),
        (b" " * (MAX_BYTES + 1), ["larger than 5 MB; keep only the columns x, y, blocks"]),
    ],
)  # fmt: skip
def test_a_wrong_map_is_refused_with_every_line(file, content, wanted):
    assert list(input_problems(read_map, file(content), 1.0)) == wanted


def test_a_map_is_read_in_its_unit_with_the_separator_that_it_says(file):
    path = file("\ufeffRow, Blocks ,X,y\nR1,2,10,20\n\nR2,0,1.5,-2\n")
    assert read_map(path, FT).tolist() == [[2, 10 * FT, 20 * FT, 2], [4, 1.5 * FT, -2 * FT, 0]]
    path = file("sep=;\nx;y;blocks\n\u22121,500;2;3\n")
    assert read_map(path, 1.0).tolist() == [[3, -1.5, 2.0, 3]]


@pytest.mark.parametrize(
    "content",
    [
        "x;y;blocks\n35,125;155;2\n",
        "x_ft;y ft;Number of blocks\n35.125;155;2\n",
        "\ufeffx\ty\tblocks\n35.125\t155\t2\n".encode("utf-16-be"),
        'x [feet],y [foot],blocks,note\n35.125,155,2,"a; b"\n',
    ],
)
def test_a_map_is_read_with_the_separators_of_spreadsheets(file, content):
    assert read_map(file(content), FT).tolist() == [[2, pytest.approx(35.125 * FT), 155 * FT, 2]]


def test_lines_that_are_equal_to_an_earlier_one_are_found(file):
    path = file("x,y,blocks,note\n1,2,3,a\n1,2,4,\n1.0,2,3,b\n1,2,0,\n1,2,0,\n1,2,3,c\n")
    assert repeated(read_map(path, FT)) == [4, 7]


def test_the_center_of_gravity_is_that_of_blocks_and_modules():
    l_shape = Polygon(((0, 0), (6, 0), (6, 2), (2, 2), (2, 4), (0, 4)))  # 12 m2 and 4 m2
    rows = np.array([(2, 1, 1, 3), (3, 5, 1, 1), (4, 3, 3, 7), (5, 20, 20, 2), (6, 50, 50, 0.0)])
    found, outside = loads(rows, {"A1": l_shape, "A2": Rectangle(10, 30, 10, 30),
                                  "A3": Rectangle(100, 101, 0, 1)})  # fmt: skip
    assert outside == [4]  # in the notch; no blocks lie at line 6
    assert found.keys() == {"A1", "A2"}
    load = found["A1"]
    assert (load.blocks, load.center) == (4, (2.0, 1.0))
    assert load.centroid == pytest.approx(((12 * 3 + 4 * 1) / 16, (12 * 1 + 4 * 3) / 16))
    assert center_of_gravity(load, 100.0, 0.0) == pytest.approx(load.center)
    assert center_of_gravity(load, 100.0, 300.0) == pytest.approx(
        ((2.0 + 3 * 2.5) / 4, (1.0 + 3 * 1.5) / 4)
    )


PARTS = {"modules": 320, "module_weight_n": 75 * LB, "ballast_n": 18000 * LB}


ran = partial(output_of, "plan", "ballast")


@pytest.mark.nightly
def test_the_ballast_weight_is_filled_in_and_gives_the_weight(tmp_path):
    book = make(tmp_path, arrays=arrays(modules=320, module_weight_n=75 * LB))
    type_into(book, {"Arrays/A1/Weight": None})
    assert problems(book) == (
        "Arrays!K8: weight is missing; enter it, or modules, module weight and ballast weight",
    )
    path = tmp_path / "map.csv"
    path.write_text(
        "x,y,blocks\n40,30,300\n80,60,200\n500,0,1\n500,0,1\n"
    )  # A1 is 20 to 100, 15 to 75 ft
    words = (path, book, "--units", "ft", "--block-weight", 32, "lb")
    output = ran(*words)
    # 16,000 lb at 56, 42 ft and 24,000 lb at 60, 45 ft.
    assert "A1: 500 blocks, 16000 lb (71.17 kN); center of gravity of ballast and 320 mod" in output
    assert " at x 58.40 ft (17.80 m), y 43.80 ft (13.35 m); from the centroid" in output
    assert "outline −1.60 ft (−0.49 m) in x, −1.20 ft (−0.37 m) in y" in output
    assert "A2: no blocks" in output
    assert "outside all arrays: 2 lines of the map: 4, 5" in output
    assert "equal to an earlier line and counted again: 1 line of the map: 5; delete" in output
    sheet = read(book)
    assert sheet.project.arrays[0].weight_n == pytest.approx(40000 * LB)
    (echoed,) = (row for row in sheet.echo if row.cell == "K8" and row.label == "Weight")
    assert (echoed.typed, spaced(echoed.value)) == ("", "177929 N (computed)")
    assert "the ballast weight of A1 is already filled in; use --replace to overwrite it" in ran(
        *words, exit_code=2
    )
    ran(*words, "--replace")
    path.write_text("x,y,blocks\n12.192,12.192,300\n18.288,14.630,200\n")  # in m
    refused = ran(*words, "--replace", exit_code=2)
    assert (
        "no ballast block of the map is inside an array on the plan; use the --units of the map"
        in refused
    )
    assert "A1: 500 blocks, 16000 lb" in ran(*words[:3], "m", *words[4:], "--replace")


@pytest.mark.nightly
def test_ballast_of_an_array_without_blocks_is_taken_out_with_replace(tmp_path):
    book = make(tmp_path, arrays=arrays(**PARTS))
    path = tmp_path / "map.csv"
    path.write_text("x,y,blocks\n40,30,300\n")  # on A1 alone
    words = (path, book, "--units", "ft", "--block-weight", 32, "lb")
    type_into(book, {"Arrays/A1/Ballast weight": None, "Arrays/A1/Weight": None,
                     "Arrays/A2/Ballast weight": 18000})  # fmt: skip
    assert (
        "A2: no blocks; the entered weight, 18000 lb (80.07 kN), is kept; use --replace to"
        " delete it"
    ) in ran(*words)
    assert read(book).inputs["arrays"][1]["ballast_n"] == pytest.approx(18000 * LB)
    assert "A2: no blocks; the entered weight, 18000 lb (80.07 kN), was deleted" in ran(
        *words, "--replace"
    )
    assert read(book).inputs["arrays"][1]["ballast_n"] is None


def test_a_workbook_without_the_column_is_refused_with_what_to_do(tmp_path):
    book = make(tmp_path)
    path = tmp_path / "map.csv"
    path.write_text("x,y,blocks\n40,30,300\n")
    edit(book, lambda found: retitled(found, "Ballast weight [lb]"))
    output = ran(path, book, "--units", "ft", "--block-weight", 32, "lb", exit_code=2)
    assert "heading 'Ballast weight' is missing" in output


def retitled(book, heading):
    (head,) = (cell for row in book["Arrays"] for cell in row if cell.value == heading)
    head.value = ""


@pytest.mark.parametrize(
    ("weight", "said"),
    [
        (42000, ""),  # as the parts
        (42400, ""),  # rounded
        (43000, "weight is 43000 lb (191.27 kN), but 320 modules and the ballast weigh 42000 lb"
                " (186.83 kN), a difference of more than 1%; correct one of them"),
    ],
)  # fmt: skip
def test_a_weight_that_differs_from_that_of_its_parts_is_a_finding(weight, said):
    data = project(arrays=arrays(weight_n=weight * LB, **PARTS))
    found = [one.text for one in implausible(data) if one.id == "weight of modules A1"]
    assert spaced(found) == [said] * bool(said)
