"""The packages of the school, the campus and the incomplete warehouse say what their tables say."""

import importlib
import io
import json
import math
import re
import shutil
from dataclasses import dataclass
from zipfile import ZipFile

import numpy as np
import pytest
from openpyxl import load_workbook
from pypdf import PdfReader

import packages
import scenes
from places import ROOT
from printed import FRONT, IDS, printed
from report.making import make
from report.motions.history import targets
from report.motions.prepare import prepare
from report.pages.registry import PAGES
from report.sheet.reading.read import read
from report.sheet.schema import ProjectInput
from report.sheet.schema.choices import PackageEdition
from report.sheet.writing.template import write_template
from solver.formats import read_record
from solver.records.spectrum import response_spectrum

PROJECTS = ROOT / "projects"
G = 9.80665


@dataclass(frozen=True)
class Made:
    """What `roofslip report` printed and wrote."""

    terminal: str
    pdf: PdfReader
    results: dict
    book: object


def made(done):
    return Made(
        terminal=done.stdout,
        pdf=PdfReader(done.out / "calc-package.pdf"),
        results=json.loads((done.out / "results.json").read_text(encoding="utf-8")),
        book=load_workbook(done.out / "results.xlsx", data_only=True),
    )


def results_of_clearances(book):
    headings, *rows = book["Clearances"].iter_rows(min_row=4, values_only=True)
    return [row[headings.index("Verdict")] for row in rows if row[0]]


def page(name, key):
    return printed(scenes.shipped(name), key)


def test_the_required_separation_of_a_clearance_stands_in_four_places_at_most():
    """A3 to EAST of the example: beside the plan, in an equation, and to be measured."""
    given = scenes.shipped("example")
    (gap,) = (gap for gap in given.clearances if gap.clearance.object == "EAST")
    inches = f"{math.ceil(round(gap.required_m / 0.0254 * 10, 6)) / 10:.1f}"
    keys = [part.id for part in PAGES if part.edition is PackageEdition.PLAN_CHECK]
    lines = [line for key in keys for line in page("example", key).splitlines()]
    found = [
        line for line in lines if re.search(rf"(?<![\d.]){re.escape(inches)}(?![\d.]*\d)", line)
    ]
    assert 2 <= len(found) <= 4, found


@pytest.fixture(scope="module")
def school(tmp_path_factory):
    return made(packages.reported(tmp_path_factory, "school"))


@pytest.fixture(scope="module")
def campus(tmp_path_factory):
    return made(packages.reported(tmp_path_factory, "campus"))


@pytest.fixture(scope="module")
def conditions(tmp_path_factory):
    return made(packages.reported(tmp_path_factory, "conditions", by_script=True))


@pytest.fixture(scope="module")
def example(tmp_path_factory):
    return made(packages.reported(tmp_path_factory, "example", by_script=True))


def test_the_example_has_at_most_15_sheets_and_the_conditions_of_its_inputs(example):
    assert len(example.pdf.pages) <= 15
    conditions = {
        (row["subject"], row["title"])
        for row in example.results["requirements"]
        if row["verdict"] == "Condition"
    }
    beyond = "Friction beyond the velocities tested"
    repeats = "Wet and dry, three runs at each velocity"
    printout = "Source, date and printout of the seismic parameters"
    accepted = "Acceptance of SEAOC PV1-2012 by the jurisdiction"
    assert conditions == {
        ("", accepted),
        ("", printout),
        ("", repeats),
        *((name, beyond) for name in ("A1", "A2", "A3")),
    }
    assert example.results["verdict"] == "OK with conditions"
    inputs = page("example", "inputs")
    assert "entered, at or below the tests from 0.10 in/s (2.5 mm/s) to 4.00 in/s" in inputs
    assert inputs.line("Array A3 with μ = 0.40 at every velocity, all motions rerun")


def script(name):
    return importlib.import_module(f"projects.{name}.make")


# What the scripts make, against what is committed.


@pytest.mark.parametrize("name", ["example", "school", "campus", "conditions"])
def test_the_script_writes_the_workbook_again_byte_for_byte(name, tmp_path):
    """All but the file that says when it was written."""
    module = script(name)
    again = tmp_path / "input.xlsx"
    units = module.project().project.units_first
    module.write_template(again, units=units, example=module.project())
    with ZipFile(again) as made, ZipFile(PROJECTS / name / "input.xlsx") as committed:
        names = set(made.namelist())
        assert names == set(committed.namelist())
        for part in names - {"docProps/core.xml"}:
            assert made.read(part) == committed.read(part), part


@pytest.mark.parametrize(("name", "letters"), [("school", "xyz"), ("conditions", "x")])
@pytest.mark.nightly
def test_the_first_motion_is_reproduced_to_the_last_digit(name, letters):
    """One alone, to keep the test short; sines may differ in the last digit between machines."""
    motion = script(name).suite(1)[0]
    prefix = {"school": "GM1", "conditions": "RM1"}[name]
    for letter in letters:
        path = PROJECTS / name / "records" / f"{prefix}-{letter}.csv"
        committed = read_record(path, units="g").a_mps2
        assert np.abs(getattr(motion, letter).a_mps2 - committed).max() <= 3e-5 * G


@pytest.mark.parametrize(
    ("name", "prefix", "letters"),
    [
        ("example", "RM", "xyz"),
        ("school", "GM", "xyz"),
        ("campus", "GM", "xyz"),
        ("conditions", "RM", "x"),
    ],
)
@pytest.mark.quick
def test_the_folder_has_the_motions_and_nothing_else(name, prefix, letters):
    count = script(name).COUNT
    names = {path.name for path in (PROJECTS / name / "records").iterdir()}
    assert names == {f"{prefix}{n}-{axis}.csv" for n in range(1, count + 1) for axis in letters}


# The school.


def test_the_schools_roof_motions_reach_ac156_at_every_frequency():
    sheet = read(PROJECTS / "school" / "input.xlsx")
    shaking, goals = prepare(sheet), targets(sheet.project)
    freq = np.geomspace(0.1, 33.3, 60)
    for motion in shaking.motions:
        for a, target in (
            (motion.ax_mps2, goals.roof),
            (motion.ay_mps2, goals.roof),
            (motion.az_mps2, goals.vertical),
        ):
            spectrum = motion.scale * response_spectrum(a, motion.dt_s, 1 / freq) / G
            assert (spectrum / target.ordinates(1 / freq)).min() >= 0.90


@pytest.mark.nightly
def test_the_school_is_ok_in_the_same_word_everywhere(school):
    assert school.results["verdict"] == "OK with conditions"
    assert {array["verdict"] for array in school.results["arrays"]} == {"OK"}
    assert page("school", "summary").line(
        "OK with conditions All limits are satisfied or, where permitted, exceeded, and all clear"
    )
    rows = [line for line in school.terminal.splitlines() if re.match(r"A\d ", line)]
    assert len(rows) == 2
    assert all(line.endswith(" OK") for line in rows)
    assert "verdict: OK with conditions\n" in school.terminal
    assert results_of_clearances(school.book) == ["OK"] * 7


@pytest.mark.nightly
def test_the_schools_conditions_are_on_its_hazard_and_its_ground_motions(school):
    missed = [row for row in school.results["requirements"] if not row["is_satisfied"]]
    assert [row["id"] for row in missed] == ["hazard_source", "ground_motions"]
    assert {row["verdict"] for row in missed} == {"Condition"}
    for key in ("summary", "plan", "limits"):
        rows = [row for table in page("school", key).tables for row in table.cells]
        assert not any("NG" in row for row in rows)
        assert not any("Condition" in row for row in rows)
    for row in missed:
        assert page("school", "summary").line(f"{row['title']}: {row['found']}")


@pytest.mark.nightly
def test_the_schools_design_value_is_from_analysis_without_a_floor(school):
    array = school.results["arrays"][0]
    peaks = [peak["any_m"] for peak in array["peaks"]]
    assert array["design_governs"] == "analysis"
    assert array["design_m"] == pytest.approx(1.1 * sum(peaks) / len(peaks), rel=1e-12)
    assert array["floor_m"] == 0.0
    assert array["prescriptive_m"] == pytest.approx(24 * 0.0254)


@pytest.mark.nightly
def test_the_school_states_the_displacement_of_smaller_events_for_information(school):
    assert "by each of these factors: 0.50, 0.50." in page("school", "accuracy")
    sums = school.results["cumulative"]
    assert [item["array"] for item in sums] == ["A1", "A2"]
    assert all(item["largest_m"] > item["mean_m"] > 0.0 for item in sums)


@pytest.mark.nightly
def test_the_school_prints_si_units_first():
    assert not any(re.search(r"\d in \(\d+ mm\)", page("school", key)) for key in (*FRONT, *IDS))


# The campus.


@pytest.mark.quick
def test_the_campus_has_three_of_the_schools_records_byte_for_byte():
    for path in (PROJECTS / "campus" / "records").iterdir():
        assert path.read_bytes() == (PROJECTS / "school" / "records" / path.name).read_bytes()


@pytest.mark.nightly
def test_the_campus_is_ok_with_30_arrays_on_two_slopes_and_61_clearances(campus):
    arrays = campus.results["arrays"]
    assert [array["id"] for array in arrays] == [f"A{n}" for n in range(1, 31)]
    assert {round(array["slope_rad"], 4) for array in arrays} == {0.0200, 0.0400}
    assert "NG" not in {campus.results["verdict"], *(array["verdict"] for array in arrays)}
    assert results_of_clearances(campus.book) == ["OK"] * 61


@pytest.mark.nightly
def test_the_others_have_as_many_sheets_as_a_plan_checker_reads(school, conditions, campus):
    counts = [len(done.pdf.pages) for done in (school, conditions, campus)]
    assert all(count <= most for count, most in zip(counts, (14, 12, 18), strict=True))


def test_arrays_of_the_campus_that_share_their_runs_share_a_result_sheet():
    results = page("campus", "results")
    names = ("A1 to A8, A11 to A15", "A9, A10", "A16 to A23, A26 to A30", "A24, A25")
    for number, some in enumerate(names, start=1):
        assert results.line(f"## 11.{number} Arrays {some}")
    assert "## 11.5" not in results


# The incomplete warehouse.


@pytest.mark.nightly
def test_the_warehouse_is_ng_in_the_same_word_everywhere(conditions):
    verdicts = {"A1": "Condition", "A2": "NG"}
    words = {"A1": "Condition", "A2": "NG"}
    assert conditions.results["verdict"] == "NG"
    assert {a["id"]: a["verdict"] for a in conditions.results["arrays"]} == verdicts
    said = page("conditions", "summary").line(
        "NG Clearance A2 to RTU-1: 12.0 in (305 mm) provided;"
    )
    assert said.endswith(". Marked NG: 1 of 2 arrays, 1 of 6 clearances.")
    for name, verdict in words.items():
        line = next(x for x in conditions.terminal.splitlines() if x.startswith(f"{name} "))
        assert re.search(rf" {verdict}(: .+)?$", line)
    assert "verdict: NG\n" in conditions.terminal
    assert results_of_clearances(conditions.book) == ["OK", "NG", "OK", "OK", "OK", "OK"]


def test_nothing_that_is_missing_is_claimed():
    said = "\n".join(page("conditions", key) for key in (*FRONT, *IDS))
    claims = (
        "All limits and clearances are satisfied", "All limits of the analysis route are satisfied",
        "act together, along and across the slope", "7 of 7", "two axes with vertical act",
        "follow the target",
    )  # fmt: skip
    assert [claim for claim in claims if claim in said] == []


@pytest.mark.nightly
def test_the_prescriptive_value_serves_where_its_limits_hold(conditions):
    for array in conditions.results["arrays"]:
        assert array["design_governs"] == "prescriptive"
        assert array["design_m"] == pytest.approx(21.6 * 0.0254)


@pytest.mark.nightly
def test_friction_may_not_fall_below_the_limit_of_the_prescriptive_route(conditions):
    """The motions lack components: with less friction there is neither route."""
    margins = conditions.results["certainty"]["margins"]
    least = [row["least_mu"] for row in margins if row["clearance"] != "2"]
    assert least == [pytest.approx(0.40)] * 6


@pytest.mark.nightly
def test_one_array_with_one_clearance_has_at_most_12_sheets(tmp_path):
    given = read(PROJECTS / "example" / "input.xlsx").project.model_dump()
    first, gap = given["arrays"][:1], given["clearances"][1:2]
    near = [row for row in given["objects"] if row["id"] == gap[0]["object"]]
    project = ProjectInput.model_validate(
        given | {"arrays": first, "clearances": gap, "objects": near}
    )
    shutil.copytree(PROJECTS / "example" / "records", tmp_path / "records")
    write_template(tmp_path / "input.xlsx", units=project.project.units_first, example=project)
    _, _, made, _ = make(tmp_path / "input.xlsx", None, None, lambda _: None)
    assert len(PdfReader(io.BytesIO(made["calc-package.pdf"])).pages) <= 12
