"""The rows that a workbook lacks are those that a package would name, at the distance in plan."""

import datetime as dt
import math
import shutil
from types import SimpleNamespace

import pytest
from click.testing import CliRunner
from hypothesis import given, settings
from hypothesis import strategies as st
from openpyxl import load_workbook

from fixtures import project_parts, projects
from fixtures.cells import cell
from fixtures.marks import by_day
from fixtures.paths import ROOT
from fixtures.project_parts import FT, INCH, clearance, roof_object, sides
from fixtures.spaces import spaced
from fixtures.workbooks import (
    SECTIONS,
    cell_address,
    different,
    edit,
    make,
    parts,
    problems,
    put,
    type_into,
)
from report.assessment.assess import assess
from report.assessment.plan.missing_rows import missing_rows
from report.assessment.plan.neighbors import direction_of, pairs_before_runs
from report.assessment.precheck import missing_clearances
from report.cli import clearance_rows
from report.cli.main import main
from report.motions.prepare import prepare
from report.project.model.choices import ClearanceSource, Direction, ObjectKind, UnitsFirst
from report.project.read.read import read
from solver.rules.rulesets import RULE_SETS

HEADING = "Clearances/heading/Clearance source"
PLACED = [row for row in SECTIONS["objects"] if row["id"] != "OLD"]
BARE = {"clearances": [], "objects": PLACED}


def run(*words, exit_code=0):
    done = CliRunner().invoke(main, [*map(str, words)])
    assert done.exit_code == exit_code, done.output
    return done.output


def fill(folder):
    return run("plan", "clearances", folder)


def without_rows(name, folder):
    """A copy of a shipped project with nothing on the sheet Clearances."""
    shutil.copytree(ROOT / "projects" / name, folder)
    sheet = read(folder)
    typed = {a: None for p, a in sheet.addresses.items() if p.section == "clearances" and p.field}
    assert typed
    type_into(sheet.path, typed)
    return folder


@pytest.mark.parametrize("name", by_day(["school", "example", "campus"], 1))
def test_a_shipped_project_without_rows_has_none_missing_after_the_command(tmp_path, name):
    folder = without_rows(name, tmp_path / name)
    was = read(ROOT / "projects" / name).project.clearances
    before = "pairs within reach have no row" in run("check", folder)
    fill(folder)
    sheet = read(folder)
    rows = sheet.project.clearances
    assert before is bool(rows)
    assert {frozenset((row.array, row.object)) for row in rows} <= {
        frozenset((row.array, row.object)) for row in was
    }
    assert {row.source for row in rows} <= {ClearanceSource.DRAWING}
    done = assess(sheet, prepare(sheet))
    assert not [near for near in done.pairs if near.is_missing]


@pytest.mark.nightly
def test_the_example_gets_the_rows_that_an_engineer_gave_it(tmp_path):
    fill(without_rows("example", tmp_path / "example"))
    found, given = (
        read(path).project.clearances for path in (tmp_path / "example", ROOT / "projects/example")
    )
    assert [row.model_copy(update={"source": None, "pathway_m": None}) for row in found] == [
        row.model_copy(update={"pathway_m": None}) for row in given
    ]


_SIDE = st.integers(1, 60)
_PLACE = st.tuples(st.integers(0, 300), st.integers(0, 200), _SIDE, _SIDE)


@settings(max_examples=25)
@given(
    places=st.lists(_PLACE, min_size=3, max_size=7),
    rule_set=st.sampled_from(sorted(RULE_SETS)),
    s_ds_g=st.sampled_from([0.3, 1.0, 1.6]),
    kinds=st.lists(st.sampled_from(list(ObjectKind)), min_size=7, max_size=7),
)
def test_before_runs_a_random_plan_has_every_pair_that_its_package_lists(
    places, rule_set, s_ds_g, kinds
):
    boxes = [sides(x, x + wide, y, y + tall) for x, y, wide, tall in places]
    arrays = [project_parts.array(f"A{n}", 0.5) | box for n, box in enumerate(boxes[:2])]
    objects = [
        roof_object(f"O{n}", kind, height=0.5) | box
        for n, (box, kind) in enumerate(zip(boxes[2:], kinds, strict=False))
    ]
    site = projects.site(rule_set=rule_set, s_ds_g=s_ds_g)
    data = projects.project(arrays=arrays, objects=objects, clearances=[], site=site)
    done = projects.assess_input(data, MOTIONS)
    before = {near.names: near for near in pairs_before_runs(data, {})}
    assert all(
        array.permitted_m <= near.reach_m / 2 + 1e-9
        for near in before.values()
        for array in done.arrays
        if array.is_permitted
    )
    named = {near.names for near in done.pairs if near.is_missing}
    assert named <= {name for name, near in before.items() if near.is_missing}


MOTIONS = projects.motions(3, seconds=6.0, peak_g=0.3)


@pytest.mark.quick
def test_pairs_within_twice_a_larger_analysis_are_those_of_the_package():
    strong = projects.motions(3, seconds=6.0, peak_g=2.0)
    far = roof_object("FAR", "fixed object", height=0.5) | sides(60, 70, 0, 60)
    far["x_from_m"] = 60 * FT + 0.35  # within 2 x 198 mm of the runs, not 2 x 152 mm
    arrays, site = [project_parts.array("A1", 0.5) | sides(0, 60, 0, 60)], projects.site(s_ds_g=0.3)
    data = projects.project(arrays=arrays, objects=[far], clearances=[], site=site)
    done = projects.assess_input(data, strong)
    named = {near.names for near in done.pairs if near.is_missing}
    assert "A1 to FAR" in named
    assert "A1 to FAR" not in {near.names for near in pairs_before_runs(data, {}) if near.is_near}
    after = pairs_before_runs(data, {}, done.arrays)
    assert named <= {near.names for near in after if near.is_missing}


@pytest.mark.parametrize(
    ("designs_m", "reach", "basis"),
    by_day([
        ({"A1": 2.1, "A2": math.nan}, "165.4 in (4200 mm)", "the design displacement of A1"),
        ({"A1": 1.0, "A2": math.nan}, "163.2 in (4144 mm)",
         "the prescriptive displacement, which no design displacement exceeds"),
    ], 1),
)  # fmt: skip
def test_the_reach_of_the_runs_is_taken_and_named(tmp_path, monkeypatch, designs_m, reach, basis):
    def ran(*_):
        rows = [SimpleNamespace(id=name, permitted_m=m) for name, m in designs_m.items()]
        return SimpleNamespace(arrays=rows)

    monkeypatch.setattr(clearance_rows, "assess", ran)
    make(tmp_path, **BARE)
    assert f"kept; reach {reach}, twice {basis}\n" in fill(tmp_path)


def test_motions_run_where_they_can_and_else_the_reason_is_given(tmp_path):
    path = type_into(make(tmp_path), {"Clearances/1/Provided clearance": 400})
    assert problems(path)
    output = fill(tmp_path)
    assert "not run" not in output
    assert "twice the prescriptive displacement, which no design displacement exceeds" in output
    path = make(tmp_path, **BARE)
    (tmp_path / "records" / "x2.csv").unlink()
    output = fill(tmp_path)
    assert cell_address("cannot run the motions: <Motions/M2/Horizontal record>: ") in output
    assert "reach 163.2 in (4144 mm), twice the prescriptive displacement\n" in output
    assert len(read(path).inputs["clearances"]) == 2


@pytest.mark.nightly
def test_rows_that_stand_are_kept_and_said_where_they_differ(tmp_path):
    rows = [clearance("A1", "A2", 120 * INCH, "cross-slope"), clearance("A2", "RTU-1", 50 * INCH)]
    path = make(tmp_path, objects=PLACED, clearances=rows)
    type_into(path, {"Clearances/2/Object": "GONE", "Clearances/1/Provided clearance": 130})
    output = fill(tmp_path)
    wanted = "<Clearances/1/Provided clearance>: A1 to A2: 130.0 in (3302 mm) entered, 120.0 in"
    assert cell_address(wanted) in output
    assert "A2 to RTU-1, upslope, 60.0 in (1524 mm)" in output
    assert "2 kept" in output
    inputs = read(path).inputs["clearances"]
    assert [row["object"] for row in inputs[:2]] == ["A2", "GONE"]
    assert inputs[0]["provided_m"] == pytest.approx(130 * INCH)
    assert inputs[0].get("source") is None
    again = path.read_bytes()
    assert "0 clearances added" in fill(tmp_path)
    assert path.read_bytes() == again


@pytest.mark.nightly
def test_rows_from_the_drawing_are_renewed_and_typed_ones_stay(tmp_path):
    path = make(tmp_path, **BARE)
    fill(tmp_path)
    sheet = read(path)
    before = {(row.array, row.object): row for row in sheet.project.clearances}
    assert before["A1", "A2"].provided_m == pytest.approx(120 * INCH)
    typed = {(row.array, row.object): k for k, row in enumerate(sheet.project.clearances, start=1)}
    row = typed["A2", "RTU-1"]
    type_into(path, {"Arrays/A2/x from": 113, f"Clearances/{row}/Clearance source": "measured",
                     f"Clearances/{row}/Provided clearance": 55})  # fmt: skip
    output = fill(tmp_path)
    after = {(row.array, row.object): row for row in read(path).project.clearances}
    assert after["A1", "A2"].provided_m == pytest.approx(156 * INCH)
    assert after["A2", "RTU-1"].provided_m == pytest.approx(55 * INCH)
    where = f"<Clearances/{typed['A1', 'A2']}/Provided clearance>"
    differs = "A1 to A2: cross-slope, 120.0 in (3048 mm); now cross-slope, 156.0 in (3962 mm)"
    assert cell_address(f"{where}: {differs}") in output
    assert "0 clearances added, 1 renewed, 1 kept" in output


def test_the_direction_is_that_of_the_plan_and_only_the_sheet_clearances_changes(tmp_path):
    path = make(tmp_path, **BARE)
    rows = {"Clearances/1/Array": "A2", "Clearances/1/Object": "A1",
            "Clearances/1/Direction": "any", "Clearances/1/Provided clearance": 1,
            "Clearances/1/Clearance source": "drawing"}  # fmt: skip
    type_into(path, rows)
    fill(tmp_path)
    first = read(path).project.clearances[0]
    assert (first.array, first.object, first.direction) == ("A2", "A1", Direction.ACROSS)
    assert first.provided_m == pytest.approx(120 * INCH)
    path = make(tmp_path, **BARE)
    before = parts(path)
    fill(tmp_path)
    assert len(different(before, parts(path))) <= 3


@pytest.mark.parametrize("units", by_day(UnitsFirst, 1))
@pytest.mark.parametrize("gap_in", by_day([60.0, 60.04999, 59.999999, 0.03], 1))
def test_a_distance_is_rounded_down_in_the_unit_of_its_column(tmp_path, units, gap_in):
    near = roof_object("R", "fixed object") | sides(0, 10, 20, 30)
    near |= {"x_to_m": 20 * FT - gap_in * INCH}  # A1 begins at 20 ft
    path = make(tmp_path, units, clearances=[], objects=[near],
                project=project_parts.HEAD | {"units_first": units})  # fmt: skip
    fill(tmp_path)
    (row,) = (row for row in read(path).project.clearances if row.object == "R")
    step_m = 0.1 * INCH if units.is_us else 0.001
    assert gap_in * INCH - step_m < row.provided_m <= gap_in * INCH + 1e-9
    assert row.provided_m / step_m == pytest.approx(round(row.provided_m / step_m), abs=1e-6)


@pytest.mark.parametrize(
    ("downslope_deg", "place", "direction"),
    [
        (270.0, sides(30, 40, 0, 10), Direction.DOWN),
        (0.0, sides(30, 40, 0, 10), Direction.ACROSS),
        (270.0, sides(110, 120, 80, 90), Direction.ANY),  # at a corner
        (300.0, sides(30, 40, 0, 10), Direction.ANY),
        (270.0, sides(20, 100, 0, 15), Direction.ANY),  # no distance
    ],
)
@pytest.mark.quick
def test_a_direction_is_that_of_the_whole_distance_or_any(downslope_deg, place, direction):
    unit = roof_object("R", "fixed object") | place
    data = projects.project(arrays=[project_parts.array("A1", 0.5)], objects=[unit], clearances=[])
    (near,) = pairs_before_runs(data, {})
    assert direction_of(near, downslope_deg) is direction


@pytest.mark.nightly
def test_motions_may_be_missing_and_nothing_else(tmp_path):
    path = make(tmp_path, **BARE)
    type_into(path, dict.fromkeys(("Motions/M1/ID", "Motions/M2/Horizontal record")))
    assert problems(path)
    _, lines = missing_rows(read(path))
    assert spaced(lines[-1]).startswith("2 clearances added, 0 kept; reach 163.2 in (4144 mm)")
    type_into(path, {"Arrays/A1/Weight": None, "Site/S_DS": None})
    output = run("plan", "clearances", tmp_path, exit_code=2)
    assert cell_address("<Arrays/A1/Weight>: weight is missing") in output
    assert "S_DS" in output
    assert "Motions!" not in output


@pytest.mark.nightly
def test_bare_edges_and_overlaps_are_said_and_not_written(tmp_path):
    inside = roof_object("IN", "edge without parapet", 30, 40, 20, 30)
    roof = sides(15, 300, 0, 120)
    path = make(
        tmp_path,
        clearances=[],
        objects=[inside, roof_object("OLD", "array of different construction")],
        roof=roof,
    )
    output = fill(tmp_path)
    assert "not added: A1 to the west edge of the roof, 60.0 in (1524 mm); correct" in output
    assert "not added: A1 to IN, −120.0 in (−3048 mm); correct the plan" in output
    assert "IN" not in {row.object for row in read(path).project.clearances}


@pytest.mark.nightly
def test_a_workbook_without_the_column_is_refused_as_it_is_until_it_has_the_heading(tmp_path):
    path = make(tmp_path, **BARE)
    edit(path, lambda book: put(book, {HEADING: None}))
    where = cell_address(HEADING)
    before = path.read_bytes()
    assert not any(row.source for row in read(path).project.clearances)
    output = run("plan", "clearances", tmp_path, exit_code=2)
    assert (
        cell_address("<Clearances/heading/Array>: heading 'Clearance source' is missing; copy it")
        in output
    )
    assert path.read_bytes() == before
    type_into(path, {where: "Clearance source"})
    fill(tmp_path)
    assert {row.source for row in read(path).project.clearances} == {ClearanceSource.DRAWING}
    assert cell(load_workbook(path), HEADING).value == "Clearance source"


def test_a_name_without_a_date_confirms_nothing(tmp_path):
    label = "Project/Drawing distances confirmed"
    (problem,) = problems(type_into(make(tmp_path), {f"{label} by": "MT"}))
    assert problem == cell_address(
        f"<{label} on>: drawing distances confirmed on is missing; enter who confirmed the drawing"
        " distances and when, or neither"
    )


@pytest.mark.nightly
def test_check_names_the_pairs_without_a_row_before_any_run(tmp_path):
    path = make(tmp_path, **BARE)
    sheet = read(path)
    (found,) = missing_clearances(sheet)
    assert spaced(found.text).startswith(
        "2 of 2 pairs within reach have no row: A2 to RTU-1 60.0 in (1524 mm), A1 to A2 120.0 in"
        " (3048 mm). Reach before any run: twice the prescriptive displacement, 163.2 in (4144 mm)"
    )
    # As it is pasted, it runs.
    command = found.text.partition(" Run ")[2].removesuffix(", or add the rows")
    assert command == f"roofslip plan clearances {path}"
    fill(tmp_path)
    assert not list(missing_clearances(read(path)))


CONFIRMED = {
    **project_parts.project(**SECTIONS).project.model_dump(),
    "drawing_confirmed_by": "RG",
    "drawing_confirmed_date": dt.date(2025, 11, 18),
    "drawing_covered": "2025-11-18: Clearances 3f2a91",
}


@pytest.mark.nightly
def test_confirmed_distances_stay_until_other_ones_are_written(tmp_path):
    path = make(tmp_path, **BARE, project=CONFIRMED)
    said = cell_address(
        "<Project/Drawing distances confirmed by>, <Project/Drawing distances confirmed on>,"
        " <Project/Drawing distances covered>: 'Drawing distances confirmed by RG, 2025-11-18'"
        " was cleared: distances from the drawing have changed; confirm them again"
    )
    assert said in fill(tmp_path).splitlines()
    issue = read(path).project.project
    assert (issue.drawing_confirmed_by, issue.drawing_confirmed_date) == ("", None)
    assert issue.drawing_covered == ""
    rows = [row.model_dump() for row in read(tmp_path).project.clearances]
    make(tmp_path, clearances=rows, objects=PLACED, project=CONFIRMED)
    assert "is taken out" not in fill(tmp_path)
