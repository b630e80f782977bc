"""Rows of linked blocks in the workbook: reading and error messages."""

import math

import pytest
from openpyxl import load_workbook
from pydantic import ValidationError

import inputs
from cells import cell
from inputs import INCH, LB
from report.sheet.schema.choices import UnitsFirst
from report.sheet.schema.motions import Links, coefficients
from sheets import arrays, at, edit, make, problems, read_workbook, said, type_into
from solver.sliding.row import MOST_STEPS, minimum_steps

G = 9.80665
WANTED = "give 2 to 20 coefficients from 0 to 1.5 with decimal points, such as 0.40, 0.45, 0.50"


def links(array="A1", friction="0.40, 0.45, 0.50", lb_in=5000, **changes):
    return inputs.links(array, friction, lb_in, **changes)


@pytest.fixture
def path(tmp_path):
    return make(tmp_path, links=[links(damping_ratio=0.02), links("A2")])


@pytest.mark.nightly
def test_a_row_is_read_in_the_units_of_the_sheet(tmp_path):
    for units in UnitsFirst:
        path = make(tmp_path / str(units), units, links=[links(damping_ratio=0.02)])
        typed = cell(load_workbook(path), "Links/1/Link stiffness").value
        assert typed == pytest.approx(5000 if units is UnitsFirst.US else 5 * LB / INCH)
        (row,) = read_workbook(path).input.links
        assert row.mus == (0.4, 0.45, 0.5)
        assert row.stiffness_n_per_m == pytest.approx(5000 * LB / INCH)
        assert row.damping_ratio == 0.02


@pytest.mark.quick
def test_the_row_of_blocks_and_its_coefficients_are_those_typed():
    row = Links(**links(damping_ratio=0.02)).row(42000 * LB)
    mass, k = 42000 * LB / G / 3, 5000 * LB / INCH
    assert row.mus == (0.4, 0.45, 0.5)
    assert row.weights == (1 / 3,) * 3
    assert row.stiffness_per_s2 == pytest.approx(k / mass)
    assert row.damping_per_s == pytest.approx(2 * 0.02 * math.sqrt(k * mass) / mass)
    assert coefficients("0.40, 0.45") == (0.4, 0.45)
    assert coefficients(" .4 ,0.45,1.5") == (0.4, 0.45, 1.5)
    assert coefficients(", ".join(["0.0"] * 20)) == (0.0,) * 20


NO_LISTS = [
    "0.40", "0.40; 0.45", "0,40, 0,45", "0,1, 0,1", "0.4, 0.45,", "0.4 0.45", "0.4, x", "-0.4, 0.5",
    "0.4, 1.6", "0.4, nan", "٠.٤, 0.5", "1e-1, 0.5", ", ".join(["0.4"] * 21),
]  # fmt: skip


@pytest.mark.parametrize("text", NO_LISTS)
@pytest.mark.quick
def test_text_that_is_not_a_list_of_coefficients_is_refused(text):
    assert coefficients(text) == ()
    with pytest.raises(ValidationError, match="2 to 20 blocks"):
        Links(**links(friction=text))


RANGE = "give a range that includes it, or change it"
# In one workbook: each cell, what is typed there, and how the line goes on after `its label is `.
CELLS = [
    {"Links/1/Array": ("a1", "'a1', which is not in Arrays; did you mean 'A1'?"),
     "Links/1/Block friction": ("0.40; 0.45", f"'0.40; 0.45'; {WANTED}"),
     "Links/2/Block friction": (
         "0.40, 0.42",
         f"'0.40, 0.42', all below the 0.45 at <Arrays/A2/Friction coefficient>; {RANGE}")},
    {"Links/1/Block friction": (
         "0.50, 0.55",
         f"'0.50, 0.55', all above the 0.45 at <Arrays/A1/Friction coefficient>; {RANGE}"),
     "Links/2/Array": ("A1", "'A1', already given at <Links/1/Array>; delete one")},
]  # fmt: skip


@pytest.mark.parametrize("cells", CELLS)
def test_what_contradicts_the_arrays_is_named_with_what_to_give(path, cells):
    reported = problems(type_into(path, {name: typed for name, (typed, _) in cells.items()}))
    assert reported == said(*(f"{name} is {line}" for name, (_, line) in cells.items()))


@pytest.mark.parametrize("friction", [{"mu_fast": 0.5, "mu_rate_s_per_m": 20}, {"mu_static": 0.5}])
def test_a_row_takes_one_coefficient_for_each_block(tmp_path, friction):
    path = make(tmp_path, arrays=arrays(**friction), links=[links(), links("A2")])
    assert problems(path) == said(
        "Links/1/Array is 'A1', which has high-velocity or static friction; leave both"
        " blank on the sheet Arrays, or delete this row"
    )


def test_links_of_missing_arrays_are_not_reported_twice(path):
    (line,) = problems(edit(path, lambda book: book.remove(book["Arrays"])))
    assert line.startswith("Arrays: the sheet is missing")


@pytest.mark.nightly
def test_links_that_are_too_stiff_are_reported_with_a_stiffness_that_is_accepted(tmp_path):
    given = [links(lb_in=5e12, damping_ratio=1.0), links("A2", lb_in=4e12, damping_ratio=0.5)]
    path = make(tmp_path, links=given)
    wanted = ("5e+12 lb/in (8.8e+11 kN/m), too stiff to", "4e+12 lb/in")
    for row, (stiffness, line) in enumerate(zip(wanted, problems(path), strict=True), start=1):
        name = f"Links/{row}/Link stiffness"
        assert line.startswith(at(f"<{name}>: link stiffness is {stiffness}"))
        type_into(path, {name: float(line.split("give ")[1].split(" lb/in")[0])})
    book = read_workbook(path)
    seconds = sum(len(m.orientations) * m.dt_s * len(m.ax_mps2) for m in book.motions)
    for row in book.input.links:
        steps = minimum_steps(row.row(42000 * LB), seconds)
        assert 0.9 * MOST_STEPS < steps <= MOST_STEPS
