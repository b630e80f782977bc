"""Friction as tested, the rows on it, and the section through an array."""

import datetime as dt
import re

import pytest

import stand_in
from report.assessment.friction_rows import friction_rows
from report.figures.section import array_section, drawn_slope_deg
from report.pages import friction_tests, section
from report.pages.pictures import load_charts
from report.pages.registry import package_data

REPORT = {
    "laboratory": "Example Laboratories",
    "accreditation": "ISO/IEC 17025, no. 1234.01",
    "standard": "ASTM G115-10",
    "report": "FT-118",
    "date": dt.date(2025, 6, 12),
    "membrane": "TPO, 60 mil",
    "support": "EPDM pad",
}
VELOCITIES = (0.0025, 0.0254, 0.0508, 0.1016)


@pytest.fixture(scope="module")
def assessment():
    return stand_in.assessed(stand_in.book(shaking=stand_in.motions(3, seconds=8.0)))


@pytest.fixture
def package(assessment):
    """Return the package of a project with other inputs; no test here depends on a run."""

    def made(**changes):
        data = stand_in.project(**changes)
        return _Package(assessment, data)

    return made


class _Package:
    """The package of an assessment with another input."""

    def __init__(self, assessment, data):
        self._package, self.data = package_data(assessment), data
        self.fmt = self._package.fmt

    @property
    def governing(self):
        return self._package.governing


def run(surface, number, mu, **changes):
    return {"surface": surface, "number": number, "mu": mu} | changes


def runs(dry=(0.60, 0.61, 0.62), wet=(0.46, 0.45, 0.47)):
    return [
        *(run("dry", k, mu, velocity_mps=0.0254) for k, mu in enumerate(dry, start=1)),
        *(run("wet", k, mu, mu_static=mu + 0.04) for k, mu in enumerate(wet, start=1)),
    ]


def rows(**changes):
    return {row.title: row for row in friction_rows(stand_in.project(**changes))}


def test_a_complete_report_satisfies_every_row():
    found = rows(friction_tests=REPORT, friction_runs=runs())
    assert [row.is_satisfied for row in found.values()] == [True] * 3
    assert [row.found for row in found.values()] == [
        "Example Laboratories; FT-118; 2025-06-12",
        "standard ASTM G115-10; accreditation ISO/IEC 17025, no. 1234.01",
        "dry 3 runs, wet 3 runs",
    ]


def test_a_workbook_without_tests_satisfies_no_row_and_says_so(package):
    found = rows()
    assert [row.is_satisfied for row in found.values()] == [False] * 3
    assert [row.found for row in found.values()] == [
        "not given", "standard not given; accreditation not given", "no runs",
    ]  # fmt: skip
    page = friction_tests.page(package())
    assert not page["is_reported"]
    assert page["runs"].rows == ()
    assert page["sentences"][0] == (
        "Not given: laboratory, accreditation, standard, report number, report date, membrane,"
        " support material."
    )
    assert page["sentences"][1].startswith("The workbook gives no runs of friction tests")
    assert friction_tests.picture(package()) == ()


@pytest.mark.parametrize("field", ["laboratory", "report", "date"])
def test_a_report_without_its_identity_is_not_on_file(field):
    row = rows(friction_tests=REPORT | {field: None if field == "date" else ""})
    one = row["Friction test report on file"]
    assert not one.is_satisfied
    name = {"report": "report number"}.get(field, field)
    assert one.found.endswith(f"; {name} not given")


@pytest.mark.parametrize(
    ("standard", "is_satisfied"),
    [
        ("ASTM G115", True),
        ("astm g 115-10 (2018)", True),
        ("ASTM-G115", True),
        ("ASTM D1894", False),
        ("ASTM G1155", False),
        ("", False),
    ],
)
def test_the_standard_is_recognized(standard, is_satisfied):
    found = rows(friction_tests=REPORT | {"standard": standard})["Tested to ASTM G115"]
    assert found.is_satisfied is is_satisfied


def test_a_laboratory_without_accreditation_does_not_satisfy_the_standard():
    found = rows(friction_tests=REPORT | {"accreditation": ""})["Tested to ASTM G115"]
    assert (found.is_satisfied, found.found) == (
        False, "standard ASTM G115-10; accreditation not given",
    )  # fmt: skip


@pytest.mark.parametrize(
    ("given", "found"),
    [
        (runs(wet=()), "dry 3 runs, wet 0 runs"),
        (runs(dry=(0.6, 0.6)), "dry 2 runs, wet 3 runs"),
        (runs(wet=(0.46,)), "dry 3 runs, wet 1 run"),
        (
            [*runs(), run("wet", 1, 0.5, report="FT-9")],
            "report without a number: dry 3 runs, wet 3 runs; report FT-9: dry 0 runs, wet 1 run",
        ),
    ],
)
def test_fewer_than_three_runs_in_a_condition_leave_the_row_unsatisfied(given, found):
    row = rows(friction_runs=given)["Wet and dry, three runs each"]
    assert (row.is_satisfied, row.found) == (False, found)


def test_runs_and_means_are_in_the_table_and_the_smaller_mean_is_said_to_govern(package):
    arrays = [stand_in.array("A1", 0.5, mu=0.46), stand_in.array("A2", 2.0, mu=0.40)]
    page = friction_tests.page(
        package(arrays=arrays, friction_tests=REPORT, friction_runs=runs(dry=(0.60, 0.61)))
    )
    cells = [row.cells for row in page["runs"].rows]
    assert cells[0] == ("FT-118", "dry", "1", "1.00", "25.4", "0.600", "—")
    assert (cells[2][0].text, *cells[2][1:]) == ("Mean, dry, 2 runs", "0.605", "—")
    assert (cells[-1][0].text, *cells[-1][1:]) == ("Mean, wet, 3 runs", "0.460", "0.500")
    assert page["sentences"] == (
        "Kinetic mean 0.605 dry (2 runs), 0.460 wet (3 runs); the smaller, 0.460 wet, governs.",
        "Dry: 2 runs given, 3 required.",
        "Array A1: μ = 0.460, equal to the tested mean 0.460 (wet).",
        "Array A2: μ = 0.400, 0.060 below the tested mean 0.460 (wet).",
        "Conditions: not satisfied are “Wet and dry, three runs each”.",
    )


def test_a_law_is_fitted_to_four_velocities_and_drawn(package):
    load_charts()
    law = stand_in.project(
        arrays=[stand_in.array("A1", 0.5, mu=0.38, mu_fast=0.46, mu_rate_s_per_m=20.0)]
    ).arrays[0]
    wet = [run("wet", k, law.friction.at(v), velocity_mps=v) for k, v in enumerate(VELOCITIES, 1)]
    made = package(arrays=[law.model_dump()], friction_tests=REPORT, friction_runs=wet)
    said = " ".join(friction_tests.page(made)["sentences"])
    assert "Kinetic mean" in said
    assert "no dry runs are given" in said
    assert (
        "Wet, 4 velocities: least squares gives 0.380 at low velocity, 0.460 at high velocity and"
        " a rate of 20.0 s/m. Root mean square residual 0.0000, with one coefficient instead 0.0"
        in said
    )
    assert "Array A1: mean of μ(v) at the tested velocities" in said
    (drawn,) = friction_tests.picture(made)
    texts = words(drawn.svg)
    assert {"wet runs", "fit, wet", "A1: μ(v)", "Sliding velocity [in/s]"} <= set(texts)
    assert "dry runs" not in texts
    assert "Dashed: laws fitted" in drawn.caption
    assert drawn.svg == friction_tests.picture(made)[0].svg
    assert least_type_pt(drawn.svg) >= 8.5


def test_runs_on_one_coefficient_determine_no_law(package):
    same = [run("dry", k, 0.6, velocity_mps=v) for k, v in enumerate(VELOCITIES, 1)]
    said = friction_tests.page(package(friction_runs=same))["sentences"]
    assert "Dry, 4 velocities: the runs do not determine a velocity-dependent law." in said


def words(svg):
    return re.findall(r"<text[^>]*>([^<]*)</text>", svg)


def least_type_pt(svg):
    """Return the smallest type; Matplotlib writes 72 px to the inch, the unit of a point."""
    return min(float(size) for size in re.findall(r"font(?:-size)?:[^;']*?([\d.]+)px", svg))


@pytest.mark.parametrize("slope", [0.0, 2.0, 10.0, 40.0])
def test_the_section_states_its_dimensions_and_stays_on_the_sheet(slope):
    load_charts()
    array = stand_in.project(arrays=[stand_in.array("A1", slope)]).arrays[0]
    svg = array_section(array, True)
    texts = words(svg)
    for text in (
        "c = 9.0 in (229 mm)", "b = 40.0 in (1016 mm)", "W = 42000 lb (186.83 kN)", "μ = 0.450",
        f"θ = {slope:.2f}°", "N", "μ N", "W + m a", "−m a",
    ):  # fmt: skip
        assert text in texts
    assert least_type_pt(svg) >= 8.5
    spots = re.findall(r'<text[^>]*transform="[^"]*translate\(([\d.-]+) ([\d.-]+)\)', svg)
    spots += re.findall(r'<text[^>]*? x="([\d.-]+)" y="([\d.-]+)"', svg)
    width, height = map(float, re.search(r'viewBox="0 0 ([\d.]+) ([\d.]+)"', svg).groups())
    assert len(spots) >= len(texts)
    assert all(0 <= float(x) <= width and 8 <= float(y) <= height for x, y in spots)
    assert drawn_slope_deg(array) == pytest.approx(min(max(slope, 8.0), 15.0))


def test_the_caption_gives_the_weight_over_the_plan_area(assessment):
    load_charts()
    made = package_data(assessment)
    caption = section.picture(made).caption
    # 42,000 lb on 80 ft x 60 ft.
    assert section.weight_per_area_pa(made.governing.array) == pytest.approx(8.75 * 47.880259)
    assert "W over plan area: 8.8 psf (0.42 kPa); other arrays 8.8 psf." in caption
    assert "Ballast for wind by others." in caption
    assert "The roof is drawn at 8° instead of" in caption
