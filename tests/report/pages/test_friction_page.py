"""Friction as tested, the rows on it, and the section through an array."""

import datetime as dt
import re

import pytest

import stand_in
from report.assessment.friction_rows import friction_rows
from report.assessment.verdict import Verdict
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
AT = "at 1.00 in/s (25.4 mm/s)"
ENTERED = f"entered, at or below the tests {AT}"
REPEATS = "Wet and dry, three runs at each velocity"
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

    @property
    def assessment(self):
        return self._package.assessment


def run(surface, number, mu, **changes):
    return {"surface": surface, "number": number, "mu": mu} | changes


def runs(dry=(0.60, 0.61, 0.62), wet=(0.46, 0.45, 0.47)):
    return [
        *(run("dry", k, mu, velocity_mps=0.0254) for k, mu in enumerate(dry, start=1)),
        *(
            run("wet", k, mu, velocity_mps=0.0254, mu_static=mu + 0.04)
            for k, mu in enumerate(wet, start=1)
        ),
    ]


def rows(**changes):
    return {row.title: row for row in friction_rows(stand_in.project(**changes))}


def test_a_complete_report_satisfies_every_row():
    found = rows(friction_tests=REPORT, friction_runs=runs())
    assert [row.is_satisfied for row in found.values()] == [True] * 3
    assert [row.found for row in found.values()] == [
        "Example Laboratories; FT-118; 2025-06-12",
        "standard ASTM G115-10; accreditation ISO/IEC 17025, no. 1234.01",
        f"dry and wet 3 runs {AT}",
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
        (runs(wet=()), f"dry 3 runs {AT}, wet 0 runs"),
        (runs(dry=(0.6, 0.6)), f"dry 2 runs {AT}, wet 3 runs {AT}"),
        (runs(wet=(0.46,)), f"dry 3 runs {AT}, wet 1 run {AT}"),
        (
            [*runs(), run("wet", 1, 0.5, report="FT-9", velocity_mps=0.0254)],
            f"report without a number: dry and wet 3 runs {AT}; report FT-9: dry 0 runs, "
            f"wet 1 run {AT}",
        ),
    ],
)
def test_fewer_than_three_runs_in_a_condition_leave_the_row_unsatisfied(given, found):
    row = rows(friction_runs=given)[REPEATS]
    assert (row.is_satisfied, row.found) == (False, found)


def test_runs_at_three_velocities_are_no_repeats():
    apart = [run("dry", k, 0.6, velocity_mps=v) for k, v in enumerate(VELOCITIES[1:], 1)]
    row = rows(friction_runs=[*runs(dry=()), *apart])[REPEATS]
    assert not row.is_satisfied
    assert row.verdict is Verdict.CONDITIONS
    assert row.found == (
        "dry 1 run at each of 1.00, 2.00, 4.00 in/s (25.4, 50.8, 101.6 mm/s), "
        f"wet 3 runs {AT}"
    )  # fmt: skip
    more = [run("dry", k, 0.6, velocity_mps=VELOCITIES[1]) for k in (4, 5)]
    some = rows(friction_runs=[*runs(dry=()), *apart, *more])[REPEATS]
    assert not some.is_satisfied
    assert some.found.startswith(f"dry 3 runs {AT}, 1 run at each of 2.00, 4.00 in/s (50.8,")


def test_runs_without_a_velocity_are_not_shown_to_be_repeats():
    unknown = [run("wet", k, 0.46) for k in (1, 2, 3)]
    row = rows(friction_runs=[*runs(wet=()), *unknown])[REPEATS]
    assert (row.is_satisfied, row.found) == (
        False, f"dry 3 runs {AT}, wet 3 runs with velocity not given",
    )  # fmt: skip


def test_the_row_has_the_units_of_the_project():
    data = stand_in.project(friction_runs=runs())
    si = data.model_copy(update={"project": data.project.model_copy(update={"units_first": "SI"})})
    row = {row.title: row for row in friction_rows(si)}[REPEATS]
    assert row.found == "dry and wet 3 runs at 25.4 mm/s (1.00 in/s)"


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
        f"Dry: 2 runs {AT}; 3 at each velocity are required.",
        f"Array A1: μ = 0.460, equal to the tested mean 0.460 (wet); {ENTERED}.",
        f"Array A2: μ = 0.400, 0.060 below the tested mean 0.460 (wet); {ENTERED}.",
        "Conditions: not satisfied are “Wet and dry, three runs at each velocity”.",
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


def test_arrays_that_compare_alike_are_said_together(package):
    said = friction_tests.page(package(friction_runs=runs()))["sentences"]
    assert f"Arrays A1, A2: μ = 0.450, 0.010 below the tested mean 0.460 (wet); {ENTERED}." in said


def test_velocities_are_beside_those_tested_and_beside_them_the_low_velocity_coefficient_alone():
    law = stand_in.array("A3", 3.0, mu=0.30, mu_fast=0.46, mu_rate_s_per_m=20.0, x=20, y=90)
    low = {"surface": "wet", "number": 4, "mu": 0.40, "velocity_mps": 0.0025}
    data = stand_in.project(
        arrays=[stand_in.array("A1", 0.5, mu=0.40), law],
        clearances=[stand_in.clearance("A1", "RTU-1", 2.0), stand_in.clearance("A3", "T-1", 2.0)],
        friction_runs=[*runs(), low],
    )
    assessed = stand_in.assess_input(data, stand_in.motions(3, seconds=8.0))
    page = friction_tests.page(package_data(assessed))
    first, second = (row.cells for row in page["velocities"].rows)
    assert (first[:2], first[-3:-1]) == (("A1", "0.40"), ("0.400", "0.400"))
    assert first[-1].striptags() == "OK"
    assert (second[:2], second[-3:-1]) == (
        ("A3", "0.30 to 0.46, by velocity"), ("0.460", "0.400"),
    )  # fmt: skip
    assert second[-1].striptags() == "OK with conditions"
    assert second[2] == f"{assessed.arrays[1].fastest_mps / 0.0254:.2f}"
    assert second[4:6] == ("1.00", "25.4")
    (alone,) = assessed.low_velocity.arrays
    assert page["alone"] == [
        "Array A3 with μ = 0.30 at every velocity, all motions rerun: design displacement "
        f"{_both(alone.design_m)} instead of {_both(assessed.arrays[1].design_m)}."
    ]
    assert [row.cells[:3] for row in page["alone_gaps"].rows] == [("2", "A3", "T-1")]
    assert "“Friction beyond the velocities tested”." in page["sentences"][-1]


def _both(value_m):
    return f"{value_m / 0.0254:.1f} in ({value_m * 1e3:.0f} mm)"


def test_without_tests_the_velocities_stand_alone(assessment):
    page = friction_tests.page(package_data(assessment))
    for row, item in zip(page["velocities"].rows, assessment.arrays, strict=True):
        assert row.cells[2] == f"{item.fastest_mps / 0.0254:.2f}"
        assert row.cells[4:] == ("no runs", "no runs", "—", "—", "not compared")
    assert (page["alone"], page["alone_gaps"]) == ([], None)


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
        "c = 9.0 in (229 mm)", "b = 40.0 in (1016 mm)", "W = 42000 lb (186.83 kN)", "μ = 0.45",
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
