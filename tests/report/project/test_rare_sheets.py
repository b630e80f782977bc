"""The sheets Friction tests, Links and Outlines: reading and error messages."""

import math

import pytest
from openpyxl import load_workbook

from fixtures import project_parts
from fixtures.assessments import TESTS
from fixtures.cells import cell
from fixtures.marks import by_day
from fixtures.project_parts import FT, INCH, LB, NO_SIDES, SIDES, clearance, sides
from fixtures.workbooks import (
    arrays,
    cell_address,
    make,
    problems,
    project,
    read_workbook,
    row_cells,
    same,
    type_into,
    with_addresses,
)
from report.project.model.array import Links, coefficients
from report.project.model.choices import UnitsFirst
from report.project.model.roof import ROOF
from report.project.model.shapes import Polygon, Rectangle
from report.project.read.read import read
from solver.sliding.row import MOST_STEPS, minimum_steps

SHEET = "Friction tests"


def run(surface, number, mu, **changes):
    return {"surface": surface, "number": number, "mu": mu} | changes


def runs(dry=(0.60, 0.61, 0.62), wet=(0.46, 0.45, 0.47)):
    return [
        *(run("dry", k, mu, velocity_mps=1.0 * INCH) for k, mu in enumerate(dry, start=1)),
        *(run("wet", k, mu, mu_static=mu + 0.04) for k, mu in enumerate(wet, start=1)),
    ]


@pytest.fixture
def path(tmp_path):
    return make(tmp_path, friction_tests=TESTS, friction_runs=runs())


@pytest.mark.parametrize("units", by_day(UnitsFirst, 1))
def test_runs_and_links_are_read_in_the_units_of_the_sheet(tmp_path, units):
    rows = {"friction_runs": runs(), "links": [project_parts.links("A1", "0.40, 0.45, 0.50", 5000)]}
    path = make(tmp_path, units, friction_tests=TESTS, **rows)
    opened = load_workbook(path)
    velocity, stiffness = (1.0, 5000) if units is UnitsFirst.US else (25.4, 5 * LB / INCH)
    assert cell(opened, f"{SHEET}/1/Velocity").value == pytest.approx(velocity)
    assert cell(opened, "Links/1/Link stiffness").value == pytest.approx(stiffness)
    note = cell(opened, f"{SHEET}/Laboratory/Note").column_letter
    assert not opened[SHEET].column_dimensions[note].hidden  # by a rare column of the table below
    workbook = read_workbook(path).input
    assert same(workbook, project(friction_tests=TESTS, **rows))
    assert workbook.links[0].mus == (0.4, 0.45, 0.5)
    first, *_, last = [row.run("FT-118") for row in workbook.friction_runs]
    assert (first.report, first.surface, first.mu) == ("FT-118", "dry", 0.60)
    assert first.velocity_mps == pytest.approx(INCH)
    assert first.mu_static != first.mu_static
    assert last.velocity_mps != last.velocity_mps
    assert last.mu_static == pytest.approx(0.51)


MU = "Arrays/{}/Friction coefficient"


def test_coefficients_above_the_tested_means_are_reported(tmp_path):
    path = make(tmp_path, arrays=arrays(mu=0.50), friction_tests=TESTS, friction_runs=runs())
    assert problems(path) == with_addresses(
        f"{MU.format('A1')} is 0.5; the tested mean is 0.46 (wet, 3 runs from"
        f" <{SHEET}/4/Kinetic coefficient>); enter 0.46 or less"
    )
    assert read_workbook(type_into(path, {MU.format("A1"): 0.46})).input
    # They are not compared while a run cannot be read.
    (line,) = problems(type_into(path, {f"{SHEET}/1/Kinetic coefficient": "x"}))
    assert line.startswith(*with_addresses(f"{SHEET}/1/Kinetic coefficient is 'x'"))
    path = make(tmp_path, arrays=arrays(mu_static=0.52), friction_runs=runs())
    assert problems(path) == with_addresses(
        "Arrays/A1/Static friction is 0.52; the tested value is 0.5 (wet); enter 0.5 or less"
    )


@pytest.mark.nightly
def test_one_run_is_compared_and_rounding_is_allowed(tmp_path):
    path = make(tmp_path, arrays=arrays(mu=0.4651), friction_runs=runs())
    assert len(problems(path)) == 1
    assert read_workbook(type_into(path, {MU.format("A1"): 0.4649})).input
    path = make(tmp_path, friction_runs=runs(dry=(), wet=(0.44,)))
    assert tuple(line.split(";")[0] for line in problems(path)) == with_addresses(
        *(f"{MU.format(array)} is 0.45" for array in ("A1", "A2"))
    )


def test_a_run_number_counts_at_each_velocity_anew(tmp_path):
    """As the table of a laboratory has them: runs 1 to 3 at 1 in/s, and 1 to 3 at 10 in/s."""
    table = [run("dry", k, 0.6, velocity_mps=v * INCH) for v in (1.0, 10.0) for k in (1, 2, 3)]
    path = make(tmp_path, friction_tests=TESTS, friction_runs=table)
    assert len(read_workbook(path).input.friction_runs) == 6
    assert problems(type_into(path, {f"{SHEET}/4/Velocity": 1.0})) == with_addresses(
        f"{SHEET}/4/Run is 1, dry, already entered at <{SHEET}/1/Run>; enter another number"
    )


@pytest.mark.nightly
def test_a_law_is_compared_at_the_tested_velocities(tmp_path):
    first, second = arrays(mu=0.40, mu_fast=0.60, mu_rate_s_per_m=30.0)
    both = [first, second | {"mu": 0.3}]

    def tested(velocity_mps):
        runs = [run("dry", k, 0.41, velocity_mps=velocity_mps) for k in (1, 2, 3)]
        return make(tmp_path / str(velocity_mps), arrays=both, friction_runs=runs)

    assert read_workbook(tested(1e-4)).input
    for velocity_mps in (1.0, None):
        assert problems(tested(velocity_mps)) == with_addresses(
            f"<{MU.format('A1')}>: friction coefficient averages 0.6 at the tested velocities; the"
            f" tested mean is 0.41 (dry, 3 runs from <{SHEET}/1/Kinetic coefficient>); reduce it"
        )


G = 9.80665
WANTED = "enter 2 to 20 coefficients from 0 to 1.5 with decimal points, such as 0.40, 0.45, 0.50"


def row_of(array="A1", friction="0.40, 0.45, 0.50", lb_in=5000, **changes):
    return project_parts.links(array, friction, lb_in, **changes)


@pytest.fixture
def linked(tmp_path):
    return make(tmp_path, links=[row_of(damping_ratio=0.02), row_of("A2")])


@pytest.mark.quick
def test_the_row_of_blocks_and_its_coefficients_are_those_typed():
    row = Links(**row_of(damping_ratio=0.02)).row(42000 * LB)
    mass, k = 42000 * LB / G / 3, 5000 * LB / INCH
    assert row.mus == (0.4, 0.45, 0.5)
    assert row.weights == (1 / 3,) * 3
    assert row.stiffness_per_s2 == pytest.approx(k / mass)
    assert row.damping_per_s == pytest.approx(2 * 0.02 * math.sqrt(k * mass) / mass)
    assert coefficients("0.40, 0.45") == (0.4, 0.45)
    assert coefficients(" .4 ,0.45,1.5") == (0.4, 0.45, 1.5)
    assert coefficients(", ".join(["0.0"] * 20)) == (0.0,) * 20


@pytest.mark.parametrize(
    "text", ["0.40", "0,40, 0,45", "0.4, 0.45,", "0.4 0.45", "-0.4, 0.5", "0.4, 1.6", "0.4, nan",
             "٠.٤, 0.5", "1e-1, 0.5", ", ".join(["0.4"] * 21)]
)  # fmt: skip
@pytest.mark.quick
def test_text_that_is_not_a_list_of_coefficients_is_refused(text):
    assert coefficients(text) == ()


RANGE = "enter a range that includes it, or change it"
# In one workbook: each cell, what is typed there, and how the line goes on after `its label is `.
CELLS = [
    {"Links/1/Array": ("a1", "'a1', which is not in Arrays; did you mean 'A1'?"),
     "Links/1/Block friction": ("0.40; 0.45", f"'0.40; 0.45'; {WANTED}"),
     "Links/2/Block friction": (
         "0.40, 0.42",
         f"'0.40, 0.42', all values below the 0.45 at <Arrays/A2/Friction coefficient>; {RANGE}")},
    {"Links/1/Block friction": (
         "0.50, 0.55",
         f"'0.50, 0.55', all values above the 0.45 at <Arrays/A1/Friction coefficient>; {RANGE}"),
     "Links/2/Array": ("A1", "'A1', already entered at <Links/1/Array>; delete one")},
]  # fmt: skip


@pytest.mark.parametrize("cells", by_day(CELLS, 1))
def test_what_contradicts_the_arrays_is_named_with_what_to_give(linked, cells):
    reported = problems(type_into(linked, {name: typed for name, (typed, _) in cells.items()}))
    assert reported == with_addresses(*(f"{name} is {line}" for name, (_, line) in cells.items()))


@pytest.mark.parametrize(
    "friction", by_day([{"mu_fast": 0.5, "mu_rate_s_per_m": 20}, {"mu_static": 0.5}], 1)
)
def test_a_row_takes_one_coefficient_for_each_block(tmp_path, friction):
    linked = make(tmp_path, arrays=arrays(**friction), links=[row_of(), row_of("A2")])
    assert problems(linked) == with_addresses(
        "Links/1/Array is 'A1', which has high-velocity or static friction; leave both"
        " blank on the Arrays worksheet, or delete this row"
    )


@pytest.mark.nightly
def test_links_that_are_too_stiff_are_reported_with_a_stiffness_that_is_accepted(tmp_path):
    given = [row_of(lb_in=5e12, damping_ratio=1.0), row_of("A2", lb_in=4e12, damping_ratio=0.5)]
    linked = make(tmp_path, links=given)
    wanted = ("5e+12 lb/in (8.8e+11 kN/m), too stiff to", "4e+12 lb/in")
    for row, (stiffness, line) in enumerate(zip(wanted, problems(linked), strict=True), start=1):
        name = f"Links/{row}/Link stiffness"
        assert line.startswith(cell_address(f"<{name}>: link stiffness is {stiffness}"))
        type_into(linked, {name: float(line.split("enter ")[1].split(" lb/in")[0])})
    book = read_workbook(linked)
    seconds = sum(len(m.orientations) * m.dt_s * len(m.ax_mps2) for m in book.motions)
    for row in book.input.links:
        steps = minimum_steps(row.row(42000 * LB), seconds)
        assert 0.9 * MOST_STEPS < steps <= MOST_STEPS


L_FT = ((20, 15), (100, 15), (100, 45), (60, 45), (60, 75), (20, 75))
ROOF_FT = ((0, -1), (300, -1), (300, 121), (150, 121), (150, 140), (0, 140))


def vertices(name, points):
    return [{"name": name, "x_m": x * FT, "y_m": y * FT} for x, y in points]


def outlined(points=L_FT, *, roof=(), clearances=()):
    """Changes to the project: A1 by an outline."""
    return {
        "arrays": arrays(**NO_SIDES),
        "outlines": [*vertices("A1", points), *vertices(ROOF, roof)],
        "clearances": list(clearances),
    }


def in_meters(points):
    return [pytest.approx((x * FT, y * FT)) for x, y in points]


ROOF_SIDES = dict(zip(SIDES, (0.0, 300 * FT, 0.0, 120 * FT), strict=True))


@pytest.mark.nightly
def test_a_rectangular_roof_is_read_back_as_written_and_without_one_north_is_up(tmp_path):
    roof = ROOF_SIDES | {"north_deg": 60.0}
    data = read_workbook(make(tmp_path, roof=roof)).input
    assert same(data, project(roof=roof))
    assert data.roof.placed.x_to_m == pytest.approx(300 * FT)
    bare = read_workbook(make(tmp_path)).input.roof
    assert (bare.placed, bare.north_deg) == (None, 90.0)


@pytest.mark.parametrize("units", by_day(list(UnitsFirst), 1))
def test_outlines_are_read_back_as_written(tmp_path, units):
    changes = outlined(roof=ROOF_FT)
    data = read_workbook(make(tmp_path, units, **changes)).input
    assert same(data, project(**changes))
    assert list(data.arrays[0].shape.points) == in_meters(L_FT)
    assert isinstance(data.arrays[1].shape, Rectangle)
    assert list(data.roof.placed.points) == in_meters(ROOF_FT)


def test_outlines_are_read_in_either_direction_and_refused_in_two_places(tmp_path):
    backwards = (*L_FT[::-1], L_FT[-1])
    data = read_workbook(make(tmp_path, **outlined(backwards))).input
    first, *rest = L_FT[::-1]
    assert list(data.arrays[0].shape.points) == in_meters([first, *rest[::-1]])
    here, before = "<Outlines/5/Outline of>", "<Outlines/3/Outline of>"
    line = f"the outline of 'A1' continues here after {before}; keep all its rows together"
    assert cell_address(f"{here}: {line}") in changed(tmp_path, {"4/Outline of": "A2"})


def changed(tmp_path, cells):
    """The problems of a workbook with an outline of A1, after cells of it are typed."""
    return problems(type_into(make(tmp_path, **outlined()), row_cells("Outlines", cells)))


FIRST = "<Outlines/1/Outline of>"


def test_an_unknown_name_is_told_by_its_cell(tmp_path):
    found = changed(tmp_path, {f"{row}/Outline of": "A11" for row in range(1, 7)})
    assert found[-1] == cell_address(
        f"{FIRST}: outline of 'A11', which is not in Arrays or Objects; did you mean 'A1'?"
    )
    assert found[0].endswith(
        "x from is missing; enter all four sides of the rectangle, or an outline on the"
        " Outlines worksheet"
    )


BEYOND_TWO = {f"{row}/{head}": None for head in ("Outline of", "x", "y") for row in range(3, 7)}
NO_NUMBER = "<Outlines/2/y>: y is "


@pytest.mark.parametrize(
    ("typed", "begin", "end"),
    by_day([
        (BEYOND_TWO, f"{FIRST}: A1 has 2 vertices", "; enter at least 3, one per row"),
        ({"2/x": 30, "2/y": 90},  # across the upper side
         f"{FIRST}: outline of A1 touches or crosses itself near x ",
         "; enter its vertices in order, each only once"),
        ({"2/y": "nan"}, NO_NUMBER, "; enter a number [ft]"),
        ({"2/y": None}, NO_NUMBER, "; enter a number [ft]"),
    ], 1),
)  # fmt: skip
def test_what_is_no_outline_is_told_by_its_cell(tmp_path, typed, begin, end):
    (line,) = changed(tmp_path, typed)
    assert line.startswith(cell_address(begin))
    assert line.endswith(end)


ROOF_AS_ID = project().objects[0].model_dump() | {"id": "Roof"}
NOTCHED = ((0, 0), (300, 0), (300, 60), (80, 60), (80, 100), (0, 100))


@pytest.mark.parametrize(
    ("changes", "words"),
    by_day([
        (outlined() | {"arrays": arrays()},
         f": x from is entered, and A1 has an outline at {FIRST}; leave the four sides blank, or"
         " delete the outline"),
        (outlined(roof=ROOF_FT) | {"objects": [ROOF_AS_ID]},
         "<Outlines/7/Outline of>: outline of 'roof', which is also the ID of an array or object;"
         " enter another ID for it"),
        # A1, an L, is beside the notch, which A2 spans.
        (outlined(roof=NOTCHED), "A2 is outside the roof near x "),
        (outlined(roof=NOTCHED), "or the outline of the roof at <Outlines/7/Outline of>"),
        (outlined() | {"arrays": arrays(**NO_SIDES)[:1], "roof": ROOF_SIDES | {"y_to_m": 74 * FT}},
         f"{FIRST}: A1 is outside the roof near x "),
    ], 1),
)  # fmt: skip
def test_what_contradicts_an_outline_is_told_by_its_cell(tmp_path, changes, words):
    (line,) = problems(make(tmp_path, **changes))
    assert cell_address(words) in line


def test_a_clearance_is_compared_with_the_gap_to_the_outline(tmp_path):
    # RTU-1 stands in the notch of A1: 10 ft from one leg, 5 ft from the other.
    unit = project().objects[0].model_dump() | sides(70, 80, 50, 60)
    row = clearance("A1", "RTU-1", 5 * FT)
    path = make(tmp_path, **outlined(clearances=[row]) | {"objects": [unit]})
    assert read(path).problems == ()
    (found,) = problems(type_into(path, {"Clearances/1/Provided clearance": 72}))
    assert "A1 and RTU-1 are 60.0 in (1524 mm) apart on the plan" in found
    assert found.endswith(
        cell_address(
            f"reduce it, or correct the outlines in {FIRST} and <Objects/RTU-1/x from:y to>"
        )
    )


@pytest.mark.quick
def test_an_object_may_have_an_outline_and_an_array_needs_a_place():
    item = project().objects[1].model_dump()
    data = project(objects=[item], clearances=[], outlines=vertices("old", L_FT))
    assert isinstance(data.objects[0].placed, Polygon)
    assert {row.name for row in data.outlines} == {"OLD"}
    changes = outlined() | {"outlines": []}
    with pytest.raises(ValueError, match="no rectangle or outline for A1"):
        project(**changes)
