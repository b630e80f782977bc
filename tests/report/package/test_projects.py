"""The shipped projects are those of their scripts, and their packages say what their tables say."""

import importlib
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

from fixtures import altered_projects, assessments, packages
from fixtures.marks import by_day
from fixtures.pages import FRONT, IDS, page_of
from fixtures.paths import ROOT
from fixtures.workbooks import read_workbook
from projects.rows import write_document
from report.assessment.design.verdict import Verdict
from report.making import make
from report.motions.history import targets
from report.motions.prepare import prepare
from report.pages.registry import PAGES
from report.project.model import ProjectInput
from report.project.model.choices import PackageEdition
from report.project.read.read import read
from report.project.write.template import write_template
from solver.formats import read_record
from solver.friction_tests import series
from solver.records.spectrum import response_spectrum
from solver.rules.ac156 import ac156_horizontal, ac156_vertical
from solver.rules.hazard import EDITIONS
from solver.synthesis.suite import make_suite

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
    return page_of(assessments.shipped(name), key)


def test_the_required_separation_of_a_clearance_stands_in_four_places_at_most():
    """A3 to EAST of the example: beside the plan, in an equation, and to be measured."""
    given = assessments.shipped("example")
    (gap,) = (gap for gap in given.clearances if gap.clearance.object == "EAST")
    inches = re.escape(f"{math.ceil(round(gap.required_m / 0.0254 * 10, 6)) / 10:.1f}")
    keys = [part.id for part in PAGES if part.edition is PackageEdition.PLAN_CHECK]
    lines = [line for key in keys for line in page("example", key).splitlines()]
    found = [line for line in lines if re.search(rf"(?<![\d.]){inches}(?![\d.]*\d)", line)]
    assert 2 <= len(found) <= 4, found


@pytest.mark.nightly
def test_one_array_with_one_clearance_has_at_most_14_sheets(tmp_path):
    given = read(PROJECTS / "example" / "input.xlsx").project.model_dump()
    first, gap = given["arrays"][:1], given["clearances"][1:2]
    near = [row for row in given["objects"] if row["id"] == gap[0]["object"]]
    project = ProjectInput.model_validate(
        given | {"arrays": first, "clearances": gap, "objects": near}
    )
    for name in ("records", "documents"):
        shutil.copytree(PROJECTS / "example" / name, tmp_path / name)
    write_template(tmp_path / "input.xlsx", units=project.project.units_first, example=project)
    make(tmp_path / "input.xlsx", tmp_path / "out", None, lambda _: None)
    assert len(PdfReader(tmp_path / "out" / "calc-package.pdf").pages) <= 14


@pytest.fixture(scope="module")
def school(tmp_path_factory):
    return made(packages.reported(tmp_path_factory, "school"))


@pytest.fixture(scope="module")
def campus(tmp_path_factory):
    return made(packages.reported(tmp_path_factory, "campus"))


@pytest.fixture(scope="module")
def conditions(tmp_path_factory):
    return made(packages.reported(tmp_path_factory, "conditions", packages.by_script))


@pytest.fixture(scope="module")
def example(tmp_path_factory):
    return made(packages.reported(tmp_path_factory, "example", packages.by_script))


def test_the_example_is_plainly_ok_and_its_first_sheet_says_what_other_inputs_come_to(
    tmp_path_factory,
):
    done = packages.reported(tmp_path_factory, "example", packages.results_alone)
    results = json.loads((done.out / "results.json").read_text(encoding="utf-8"))
    assert results["verdict"] == "OK"
    assert {row["verdict"] for row in results["checks"]} == {"OK"}
    lines = done.stdout.splitlines()
    assert [line.split()[-1] for line in lines[1:4]] == ["OK"] * 3
    assert not re.search("condition|warning|note|NG", done.stdout)
    inputs, first = page("example", "inputs"), page("example", "summary")
    assert "entered, at or below the tested values from 0.10 in/s (2.5 mm/s) to 8.00 in/s" in inputs
    assert inputs.line(
        "With μ = 0.40 at all velocities (all motions rerun), the design displacement of A3"
    )
    assert re.search(r"All \d+ checks are satisfied\.\n", first)
    assert "Under ASCE 7-16 13.6.12, with the same motions and SDS: NG, fire pathway" in first
    assert "clearance A1 to RTU-1 (D/C 1.36)" in first
    assert "velocities (A3: 0.40): NG, electrical slack of A3 (D/C 1.34)" in first


def test_the_friction_tests_of_the_example_are_complete_and_reach_a_tenth_of_its_velocities():
    done = assessments.shipped("example")
    report = done.project.friction_tests.report
    for item in done.arrays:
        for tests in series(row.run(report) for row in done.project.friction_runs):
            assert all(len(repeats.runs) == 3 for repeats in tests.repeats)
            assert 10.0 * tests.velocity_mps >= item.fastest_mps
            assert tests.minimum_mu >= item.array.friction.mu_fast


def test_each_document_of_the_example_says_that_it_is_one_and_has_the_values_of_the_workbook():
    given = assessments.shipped("example")
    folder, site = PROJECTS / "example", given.project.site
    texts = {
        document.label: PdfReader(folder / document.path).pages[0].extract_text()
        for document in given.source.documents
    }
    assert set(texts) == {
        "Printout of seismic parameters",
        "Letter of acceptance",
        "Test report file",
    }
    assert all(text.startswith("EXAMPLE, IN PLACE OF ") for text in texts.values())
    found = re.findall(
        r"^([SF]_\w+) +([\d.]+)", texts["Printout of seismic parameters"], re.MULTILINE
    )
    values = {"S_S": site.s_s_g, "S_1": site.s_1_g, "F_a": site.f_a, "F_v": site.f_v,
              "S_MS": site.parameters.s_ms, "S_M1": site.parameters.s_m1, "S_DS": site.s_ds,
              "S_D1": site.s_d1}  # fmt: skip
    assert {symbol: float(value) for symbol, value in found} == pytest.approx(values, abs=5e-5)
    assert f"{site.rule_set} is accepted" in texts["Letter of acceptance"]
    rows = re.findall(r"^(dry|wet) +(\d+) +([\d.]+) +([\d.]+)", texts["Test report file"], re.M)
    assert [(row[0], int(row[1]), float(row[3])) for row in rows] == [
        (run.surface, run.number, run.mu) for run in given.project.friction_runs
    ]


def test_without_its_evidence_the_example_has_a_condition_for_each_part_of_it():
    done = altered_projects.assessed("little evidence")
    assert done.verdict is Verdict.CONDITIONS
    assert {(check.id, check.subject) for check in done.open} == {
        *((id, "") for id in ("rule_set", "hazard_source", "friction_tests")),
        ("friction_velocity", "A1 to A3"),
    }


def script(name):
    return importlib.import_module(f"projects.{name}.make")


# What the scripts make, against what is committed.


@pytest.mark.parametrize("name", by_day(["example", "school", "campus", "conditions"], 1))
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


@pytest.mark.quick
def test_the_script_writes_the_documents_of_the_example_again_byte_for_byte(tmp_path):
    made = script("example").documents(script("example").project())
    files = (PROJECTS / "example" / "documents").iterdir()
    assert {f"documents/{path.name}" for path in files} == made.keys()
    for name, lines in made.items():
        write_document(tmp_path / name, lines)
        assert (tmp_path / name).read_bytes() == (PROJECTS / "example" / name).read_bytes()


@pytest.mark.parametrize("name", ["example", "school", "campus", "conditions"])
@pytest.mark.quick
def test_the_folder_has_the_motions_and_nothing_else(name):
    prefix = "RM" if name in ("example", "conditions") else "GM"
    letters = "x" if name == "conditions" else "xyz"
    numbers = range(1, script(name).COUNT + 1)
    names = {path.name for path in (PROJECTS / name / "records").iterdir()}
    assert names == {f"{prefix}{n}-{axis}.csv" for n in numbers for axis in letters}


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
def test_the_school_is_ok_everywhere_with_two_conditions_by_analysis_without_a_floor(school):
    assert school.results["verdict"] == "OK with conditions"
    assert {array["verdict"] for array in school.results["arrays"]} == {"OK"}
    rows = [line for line in school.terminal.splitlines() if re.match(r"A\d ", line)]
    assert len(rows) == 2
    assert all(line.endswith(" OK") for line in rows)
    assert "verdict: OK with conditions, largest D/C " in school.terminal
    assert results_of_clearances(school.book) == ["OK"] * 7
    missed = [row for row in school.results["checks"] if row["verdict"] not in ("OK", "note")]
    assert [row["id"] for row in missed] == ["hazard_source", "ground_motions"]
    assert {row["verdict"] for row in missed} == {"Condition"}
    array = school.results["arrays"][0]
    peaks = [peak["any_m"] for peak in array["peaks"]]
    assert array["design_governs"] == "analysis"
    assert array["design_m"] == pytest.approx(1.1 * sum(peaks) / len(peaks), rel=1e-12)
    assert array["floor_m"] == 0.0
    assert array["prescriptive_m"] == pytest.approx(24 * 0.0254)
    # Smaller events are for information.
    sums = school.results["cumulative"]
    assert [item["array"] for item in sums] == ["A1", "A2"]
    assert all(item["largest_m"] > item["mean_m"] > 0.0 for item in sums)


# The campus.


@pytest.mark.quick
def test_the_campus_has_three_of_the_schools_records_byte_for_byte():
    for path in (PROJECTS / "campus" / "records").iterdir():
        assert path.read_bytes() == (PROJECTS / "school" / "records" / path.name).read_bytes()


@pytest.mark.nightly
def test_the_campus_is_ok_and_none_has_more_sheets_than_are_read(
    campus, school, conditions, example
):
    arrays = campus.results["arrays"]
    assert [array["id"] for array in arrays] == [f"A{n}" for n in range(1, 31)]
    assert {round(array["slope_rad"], 4) for array in arrays} == {0.0200, 0.0400}
    assert "NG" not in {campus.results["verdict"], *(array["verdict"] for array in arrays)}
    assert results_of_clearances(campus.book) == ["OK"] * 61
    counts = [len(done.pdf.pages) for done in (school, conditions, campus, example)]
    assert all(count <= most for count, most in zip(counts, (15, 13, 18, 16), strict=True))


# The incomplete warehouse.


@pytest.mark.nightly
def test_the_warehouse_is_ng_everywhere_by_the_prescriptive_value(conditions):
    verdicts = {"A1": "Condition", "A2": "NG"}
    assert conditions.results["verdict"] == "NG"
    assert {a["id"]: a["verdict"] for a in conditions.results["arrays"]} == verdicts
    for name, verdict in verdicts.items():
        line = next(x for x in conditions.terminal.splitlines() if x.startswith(f"{name} "))
        assert re.search(rf" {verdict}(: .+)?$", line)
    assert "verdict: NG, largest D/C 1.80; " in conditions.terminal
    assert results_of_clearances(conditions.book) == ["OK", "NG", "OK", "OK", "OK", "OK"]
    for array in conditions.results["arrays"]:
        assert array["design_governs"] == "prescriptive"
        assert array["design_m"] == pytest.approx(21.6 * 0.0254)
    # The motions lack components: with less friction there is neither route.
    margins = conditions.results["certainty"]["margins"]
    least = [row["least_mu"] for row in margins if row["clearance"] != "2"]
    assert least == [pytest.approx(0.40)] * 6


def test_nothing_that_is_missing_is_claimed():
    said = "\n".join(page("conditions", key) for key in (*FRONT, *IDS))
    claims = (
        "All limits and clearances are satisfied",
        "All limits of the analysis procedure are satisfied",
        "act together, along and across the slope", "7 of 7", "two axes with vertical act",
        "follow the target",
    )  # fmt: skip
    assert [claim for claim in claims if claim in said] == []


# The records of the example.


@pytest.fixture(scope="module")
def records():
    """Return the three records of each motion, as committed."""
    folder = PROJECTS / "example" / "records"
    return [
        [read_record(folder / f"RM{number}-{axis}.csv", units="g") for axis in "xyz"]
        for number in range(1, script("example").COUNT + 1)
    ]


@pytest.fixture(scope="module")
def spectra():
    """Return the spectra that x, y and z follow."""
    s_ds_g = script("example").S_DS_G
    across = ac156_horizontal(EDITIONS["ASCE 7-16"], s_ds_g=s_ds_g, z_over_h=1.0)
    return across, across, ac156_vertical(s_ds_g=s_ds_g)


@pytest.mark.nightly
def test_the_first_motion_of_the_example_is_reproduced_to_the_last_digit(records, spectra):
    across, _, upward = ((part.freq_hz, part.sa_g) for part in spectra)
    again = make_suite(across, upward, count=1, seed=script("example").SEED)[0]
    for made, committed in zip(again.components, records[0], strict=True):
        assert np.abs(made.a_mps2 - committed.a_mps2).max() <= 3e-5 * G


@pytest.mark.quick
def test_every_record_is_run_alone_rests_at_its_end_and_matches_ac156(records, spectra):
    book = read_workbook(PROJECTS / "example")
    for motion, (x, y, z) in zip(book.motions, records, strict=True):
        assert np.array_equal(motion.ax_mps2, x.a_mps2)
        assert np.array_equal(motion.ay_mps2, y.a_mps2)
        assert np.array_equal(motion.az_mps2, z.a_mps2)
    together = np.corrcoef([record.a_mps2 for motion in records for record in motion])
    assert np.abs(together - np.eye(len(together))).max() <= 0.3
    for motion in records:
        for record in motion:
            whole = [round(a) for a in (record.a_mps2 / 9.80665 * 1e5).tolist()]
            assert whole[0] == whole[-1] == sum(whole) == 0
            assert sum(n * k for n, k in enumerate(whole)) == 0
    freq = 0.3 * 2.0 ** (np.arange(82) / 12)
    for motion in records:
        for record, target in zip(motion, spectra, strict=True):
            spectrum = response_spectrum(record.a_mps2, record.dt_s, 1 / freq) / 9.80665
            ratio = spectrum / target.at(freq)
            assert ratio.min() >= 0.90
            assert ratio.max() <= 1.30
            assert 1.0 <= ratio.mean() <= 1.07
