"""The packages of the school and of the incomplete warehouse say what their tables say."""

import importlib.util
import json
import re
from dataclasses import dataclass
from zipfile import ZipFile

import numpy as np
import pytest
from openpyxl import load_workbook
from pypdf import PdfReader

import packages
from places import ROOT
from report.motions.prepare import prepare
from report.motions.targets import targets
from report.sheet.read import read
from sheets import same
from solver.formats import read_record
from solver.records.spectrum import response_spectrum

PROJECTS = ROOT / "projects"
G = 9.80665


@dataclass(frozen=True)
class Made:
    """What `roofslip report` printed and wrote."""

    terminal: str
    pages: tuple[str, ...]
    results: dict
    book: object
    filled: tuple[float, ...]

    @property
    def whole(self):
        return " ".join(self.pages)

    def part(self, title):
        """The pages of a part, from its heading to the next part's."""
        number = int(title.split()[0])
        starts = [i for i, page in enumerate(self.pages) if i > 1 and title in page]
        following = re.compile(rf"(?:^|in part \d+ )(?:{number + 1}|A) [A-Z]")
        start = starts[0]
        text = self.pages[start]
        text = text[text.index(title) :]
        for page in self.pages[start + 1 :]:
            if following.match(page):
                break
            text += " " + page
        after = re.search(rf" {number + 1} [A-Z][a-z]+ [a-z]", text)
        return text[: after.start()] if after else text


def read_page(page):
    """The words of a sheet, and how much of it is above its lowest line, foot and head left out."""
    heights = []

    def note(text, matrix, at, *_):
        if text.strip():
            heights.append(at[4] * matrix[1] + at[5] * matrix[3] + matrix[5])

    words = " ".join(page.extract_text(visitor_text=note).split())
    top, bottom = float(page.mediabox.height) - 0.9 * 72, 0.95 * 72
    return words, (top - min(y for y in heights if bottom < y < top)) / (top - bottom)


def made(done):
    out = done.out
    pages = PdfReader(out / "calc-package.pdf").pages
    words, filled = zip(*map(read_page, pages), strict=True)
    return Made(
        terminal=done.stdout,
        pages=words,
        results=json.loads((out / "results.json").read_text(encoding="utf-8")),
        book=load_workbook(out / "results.xlsx", data_only=True),
        filled=filled,
    )


@pytest.fixture(scope="module")
def school(tmp_path_factory):
    return made(packages.reported(tmp_path_factory, "school"))


@pytest.fixture(scope="module")
def conditions(tmp_path_factory):
    return made(packages.reported(tmp_path_factory, "conditions", by_script=True))


@pytest.fixture(scope="module")
def example(tmp_path_factory):
    return made(packages.reported(tmp_path_factory, "example", by_script=True))


def test_the_example_has_at_most_29_sheets(example):
    assert len(example.pages) <= 29


def test_the_friction_of_the_example_is_said_as_it_was_run_wherever_it_is_said(example):
    law = "0.40 to 0.50, by velocity"
    assert f"A3: μ {law}; design displacement" in example.pages[0]
    letter = next(page for page in example.pages if page.startswith("Letter of results"))
    assert f"A3 {law}" in letter
    for part in ("1 Summary", "2 Roof plan", "9 Clearances"):
        assert law in example.part(part), part
    assert "μ 0.40 " not in example.whole.replace(f"μ {law}", "")


def test_the_example_has_the_conditions_that_its_friction_tests_leave(example):
    conditions = {
        (row["subject"], row["title"])
        for row in example.results["requirements"]
        if row["verdict"] == "OK with conditions"
    }
    beyond = "Friction beyond the velocities tested"
    repeats = "Wet and dry, three runs at each velocity"
    assert conditions == {("", repeats), ("A1", beyond), ("A2", beyond), ("A3", beyond)}
    assert example.results["verdict"] == "OK with conditions"
    inputs = example.part("4 Inputs")
    assert "entered, at or below the tests from 0.10 in/s (2.5 mm/s) to 4.00 in/s" in inputs
    assert "Array A3 with μ = 0.40 at every velocity, all motions rerun" in inputs


@pytest.mark.parametrize("name", ["example", "school", "conditions"])
@pytest.mark.nightly
def test_no_sheet_but_the_letter_and_the_last_is_under_three_fifths_full(name, request):
    sheets = request.getfixturevalue(name)
    titled = zip(sheets.pages[:-1], sheets.filled[:-1], strict=True)
    assert all(share > 0.6 for text, share in titled if "Letter of results" not in text[:120])


def script(name):
    spec = importlib.util.spec_from_file_location(f"make_{name}", PROJECTS / name / "make.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


# What the scripts make, against what is committed.


@pytest.mark.parametrize("name", ["school", "conditions"])
def test_the_workbook_has_the_project_of_the_script(name):
    assert same(read(PROJECTS / name / "input.xlsx").project, script(name).project())


@pytest.mark.parametrize("name", ["school", "conditions"])
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
    ("name", "prefix", "letters"), [("school", "GM", "xyz"), ("conditions", "RM", "x")]
)
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


def test_the_school_is_ok_in_the_same_word_everywhere(school):
    assert school.results["verdict"] == "OK"
    assert {array["verdict"] for array in school.results["arrays"]} == {"OK"}
    assert "1 Summary OK All limits and clearances are satisfied" in school.part("1 Summary")
    rows = [line for line in school.terminal.splitlines() if re.match(r"A\d ", line)]
    assert len(rows) == 2
    assert all(line.endswith(" OK") for line in rows)
    assert "verdict: OK\n" in school.terminal
    results = [row[12].value for row in school.book["Clearances"].iter_rows(min_row=5)]
    assert [value for value in results if value] == ["OK"] * 7


def test_the_school_has_no_condition(school):
    assert all(row["is_satisfied"] for row in school.results["requirements"])
    for title in ("1 Summary", "9 Clearances", "10 Limits and interconnection strength"):
        assert "OK with conditions" not in school.part(title)
    assert "Conditions and requirements not satisfied" not in school.whole
    assert " NG " not in school.part("10 Limits and interconnection strength")


def test_the_schools_slope_is_beyond_the_prescriptive_and_within_the_ibc(school):
    comparison = school.part("8 Comparison")
    assert "the prescriptive route is not permitted (Roof slope, prescriptive route)" in comparison
    limits = school.part("10 Limits")
    ibc, _, asce = limits.partition("Roof slope, analysis route 3.58° (6.2 %) > ")
    assert "Roof slope, any ballasted system 3.58° (6.2 %) ≤ 4.76° (8.3 %)† IBC 1613.3† OK" in ibc
    assert asce.startswith("2.86° (5.0 %)† ASCE 7-16 13.6.12† permitted* ")
    assert (
        "* ASCE 7-16 13.6.12† permits roofs over 2.86° (5.0 %)† by analysis in SDC A, B, C with "
        "peer review. SDC C; reviewed by Reviewer of record, NM S0000, 2026-11-16. IBC 1613.3† "
        "limits the slope as well, in a row of its own."
    ) in limits
    reason = "permitted over 2.86° (5.0 %)†: SDC C, analysis peer reviewed"
    assert f"Roof slope (arrays A1, A2) {reason}" in school.part("1 Summary")
    assert "in SDC A, B, C it may be exceeded with peer review†" in school.part("11 Provisions")


def test_the_schools_design_value_is_from_analysis_without_a_floor(school):
    array = school.results["arrays"][0]
    peaks = [peak["any_m"] for peak in array["peaks"]]
    assert array["design_governs"] == "analysis"
    assert array["design_m"] == pytest.approx(1.1 * sum(peaks) / len(peaks), rel=1e-12)
    assert array["floor_m"] == 0.0
    assert array["prescriptive_m"] == pytest.approx(24 * 0.0254)
    assert "no floor applies because the analysis is peer reviewed" in school.whole


def test_the_school_has_three_components_and_says_so_with_counts(school):
    basis = school.part("3 Basis")
    assert "7 of 7 motions have a second horizontal component, 7 of 7 a vertical" in basis
    assert "ground records transferred through the building" in basis
    assert "two axes with vertical" in school.part("12 Model used")


def test_the_school_states_the_displacement_of_smaller_events_for_information(school):
    text = school.part("14 How sure")
    assert "once more by each of these factors: 0.50, 0.50." in text
    assert "Cumulative displacement over the motions, for information" in text
    sums = school.results["cumulative"]
    assert [item["array"] for item in sums] == ["A1", "A2"]
    assert all(item["largest_m"] > item["mean_m"] > 0.0 for item in sums)
    assert "part 14 adds those of the Options sheet" in school.part("3 Basis")


def test_the_schools_building_and_its_ground_motions_are_described(school):
    motions = school.part("5 Roof motions")
    assert "Ct hx = 0.02 × 27.90.75 = 0.243 s" in motions
    assert "2 equal stories, in shear" in motions
    assert motions.count("Factor 1.6: AFLX at the roof / at grade") == 7
    # The ground motions exceed the design spectrum at long periods, and the table shows how much.
    assert re.search(r"Ground, horizontal 7 \d\.\d\d \d\.\d\d [3-5]\.\d\d [78]\.\d\d", motions)


def test_the_school_says_in_words_where_its_motions_exceed_their_targets(school):
    """The building amplifies short periods; the ground motions were made for long ones."""
    for title in ("1 Summary", "5 Roof motions"):
        text = school.part(title)
        for place, target in (("Transverse", "AC156"), ("Ground, transverse", "ASCE 7 design")):
            found = re.search(
                rf"{place} \(.{{0,8}}horizontal likewise\): the mean of the motions reaches "
                rf"(\d\.\d\d) times the target \({target}[^;]*\) at [\d.]+ Hz; it exceeds 1.30 "
                r"times the target from [\d.]+ to [\d.]+ Hz",
                text,
            )
            assert 7.0 < float(found[1]) < 9.0
        assert "not reduced" in text
        assert "below the target" not in text


def test_the_school_prints_si_units_first(school):
    assert "299 mm (11.8 in)" in school.part("1 Summary")
    assert not re.search(r"\d in \(\d+ mm\)", school.whole)


def test_the_schools_friction_is_as_tested(school):
    inputs = school.part("4 Inputs")
    assert "Kinetic mean 0.550 dry (3 runs), 0.500 wet (3 runs)" in inputs
    assert "Arrays A1, A2: μ = 0.500, equal to the tested mean 0.500 (wet); entered, at" in inputs


# The incomplete warehouse.


def test_the_warehouse_is_ng_in_the_same_word_everywhere(conditions):
    verdicts = {"A1": "OK with conditions", "A2": "NG"}
    assert conditions.results["verdict"] == "NG"
    assert {a["id"]: a["verdict"] for a in conditions.results["arrays"]} == verdicts
    summary = conditions.part("1 Summary")
    assert "1 Summary NG Marked NG: 1 of 2 arrays, 1 of 6 clearances." in summary
    for name, verdict in verdicts.items():
        line = next(x for x in conditions.terminal.splitlines() if x.startswith(f"{name} "))
        assert re.search(rf" {verdict}(: .+)?$", line)
    assert "verdict: NG\n" in conditions.terminal
    results = [row[12].value for row in conditions.book["Clearances"].iter_rows(min_row=5)]
    assert [value for value in results if value] == ["OK", "NG", "OK", "OK", "OK", "OK"]


@pytest.mark.parametrize(
    "sentence",
    [
        "Friction test report on file: not given; required: laboratory, report number, date. "
        "Obtain the friction test report",
        "Tested to ASTM G115: standard not given; accreditation not given",
        "Wet and dry, three runs at each velocity: no runs",
        "two horizontal and the vertical together: 1 (RM1, no y and no z); required: ≥ 3. The "
        "design displacements are prescriptive; the analysis is for information.",
        "array A1, Largest plan dimension between fire lanes: 160.00 ft (48.77 m); required: ≤ "
        "150.00 ft (45.72 m). Divide the array by a fire lane",
        "array A1, Interconnection strength provided: not given; required: ≥ 2107 lb (9.37 kN)",
        "array A2, Interconnection strength provided: not given; required: ≥ 1609 lb (7.16 kN)",
        "array A1, Electrical slack provided: not given",
        "array A2, Electrical slack provided: not given",
    ],
)
def test_the_summary_names_each_condition_with_what_follows(conditions, sentence):
    assert sentence in conditions.part("1 Summary")


def test_nothing_that_is_missing_is_claimed(conditions):
    whole = conditions.whole
    for claim in (
        "All limits and clearances are satisfied",
        "All limits of the analysis route are satisfied",
        "act together, along and across the slope",
        "7 of 7",
        "two axes with vertical act",
        "follow the target",
    ):
        assert claim not in whole, claim
    model = conditions.part("12 Model used")
    assert "1, one axis 8 of 8" in model
    assert "No motion has a second horizontal component" in model


def test_the_basis_says_what_the_motions_lack_and_which_route_is_taken(conditions):
    basis = conditions.part("3 Basis")
    assert "0 of 4 motions have a second horizontal component, 0 of 4 a vertical" in basis
    assert "the motion has one horizontal component, and its angle is not varied" in basis
    assert "All limits of the prescriptive route are satisfied (part 10)" in basis
    assert "the floor in part 8 is not used: the design displacements are prescriptive" in basis


def test_the_prescriptive_value_serves_where_its_limits_hold(conditions):
    for array in conditions.results["arrays"]:
        assert array["design_governs"] == "prescriptive"
        assert array["design_m"] == pytest.approx(21.6 * 0.0254)
    assert "governed by: prescriptive" in conditions.part("1 Summary")
    comparison = conditions.part("8 Comparison")
    for name in ("A1", "A2"):
        assert (
            f"Array {name}: the prescriptive route is taken; the analysis route is not permitted "
            "(Number of components of each motion: two horizontal and the vertical together)."
        ) in comparison


def test_the_row_on_components_is_ng_in_the_part_on_motions(conditions):
    motions = conditions.part("5 Roof motions")
    row = "two horizontal and the vertical together 1 ≥ 3 RM1, no y and no z NG"
    assert row in motions
    assert "none none" in motions


def test_the_inputs_say_that_no_friction_test_is_given(conditions):
    inputs = conditions.part("4 Inputs")
    assert "The workbook gives no runs of friction tests" in inputs
    assert re.search(r"A1 1\.19 2\.1 270 0\.50 not given Ballasted tray", inputs)


def test_the_clearance_that_fails_says_what_would_do(conditions):
    gaps = conditions.part("9 Clearances")
    assert re.search(r"2 A2 RTU-1 fixed object, across .* 21\.6 549 12\.0 305 1\.80 NG", gaps)
    assert "2 Provided separation 12.0 in (305 mm) ≥ 21.6 in (549 mm) exact" in gaps
    assert "none: the prescriptive displacement alone requires more than is provided" in gaps
    assert "and the floor" not in gaps


def test_friction_may_not_fall_below_the_limit_of_the_prescriptive_route(conditions):
    """The motions lack components: with less friction there is neither route."""
    margins = conditions.results["certainty"]["margins"]
    least = [row["least_mu"] for row in margins if row["clearance"] != "2"]
    assert least == [pytest.approx(0.40)] * 6


def test_the_limits_have_a_row_for_each_that_is_not_given(conditions):
    limits = conditions.part("10 Limits")
    assert limits.count("not given ≥ 21.6 in (549 mm) design displacement OK with conditions") == 2
    assert "160.00 ft (48.77 m) ≤ 150.00 ft (45.72 m) fire code† OK with conditions" in limits
