"""Friction as tested, the rows on it, and the section through an array."""

import re

import pytest

import scenes
import stand_in
from inputs import LB
from printed import printed
from report.assessment.requirement_rows import friction_rows
from report.assessment.requirement_rows import tested as series_of
from report.assessment.verdict import Verdict
from report.drawing.items import drawn_slope_deg
from report.figures.charts import friction_by_velocity
from report.figures.plan import array_section
from scenes import TESTS as REPORT
from solver.friction_tests import fit_law

pytestmark = pytest.mark.quick

AT = "at 1.00 in/s (25.4 mm/s)"
ON_FILE = "Friction test report stated"
STANDARD = "Tested to ASTM G115"
REPEATS = "Wet and dry, three runs at each velocity"
VELOCITIES = (0.0025, 0.0254, 0.0508, 0.1016)


def run(surface, number, mu, **changes):
    return {"surface": surface, "number": number, "mu": mu} | changes


def runs(dry=(0.60, 0.61, 0.62), wet=(0.46, 0.45, 0.47)):
    return [
        run(surface, k, mu, velocity_mps=0.0254)
        for surface, mus in (("dry", dry), ("wet", wet))
        for k, mu in enumerate(mus, start=1)
    ]


def page(**changes):
    return printed(scenes.package(**changes), "inputs")


def row(title, **changes):
    return next(r for r in friction_rows(stand_in.project(**changes)) if r.title == title)


APART = [run("dry", k, 0.6, velocity_mps=v) for k, v in enumerate(VELOCITIES[1:], 1)]
MORE = [run("dry", k, 0.6, velocity_mps=VELOCITIES[1]) for k in (4, 5)]
UNKNOWN = [run("wet", k, 0.46) for k in (1, 2, 3)]
OTHER_REPORT = run("wet", 1, 0.5, report="FT-9", velocity_mps=0.0254)


@pytest.mark.parametrize(
    ("title", "report", "given", "is_satisfied", "found"),
    [
        (ON_FILE, {}, [], True, "Example Laboratories; FT-118; 2025-06-12"),
        (ON_FILE, {"laboratory": ""}, [], False, "FT-118; 2025-06-12; laboratory not given"),
        (ON_FILE, {"report": ""}, [], False, "2025-06-12; report number not given"),
        (ON_FILE, {"date": None}, [], False, "FT-118; date not given"),
        (STANDARD, {}, [], True, "standard ASTM G115-10; accreditation ISO/IEC 17025, no. 1234.01"),
        (STANDARD, {"standard": "ASTM G115"}, [], True, "standard ASTM G115; accreditation ISO"),
        (STANDARD, {"standard": "astm g 115-10 (2018)"}, [], True, "standard astm"),
        (STANDARD, {"standard": "ASTM-G115"}, [], True, "standard ASTM-G115"),
        (STANDARD, {"standard": "ASTM D1894"}, [], False, "standard ASTM D1894"),
        (STANDARD, {"standard": "ASTM G1155"}, [], False, "standard ASTM G1155"),
        (STANDARD, {"standard": ""}, [], False, "standard not given; accreditation ISO"),
        (STANDARD, {"accreditation": ""}, [], False, "standard ASTM G115-10; accreditation not"),
        (REPEATS, {}, runs(), True, f"dry and wet 3 runs {AT}"),
        (REPEATS, {}, [], False, "no runs"),
        (REPEATS, {}, runs(wet=()), False, f"dry 3 runs {AT}, wet 0 runs"),
        (REPEATS, {}, runs(dry=(0.6, 0.6)), False, f"dry 2 runs {AT}, wet 3 runs {AT}"),
        (REPEATS, {}, runs(wet=(0.46,)), False, f"dry 3 runs {AT}, wet 1 run {AT}"),
        (REPEATS, {"report": ""}, [*runs(), OTHER_REPORT], False,
         f"report without a number: dry and wet 3 runs {AT}; report FT-9: dry 0 runs, wet 1 run"),
        (REPEATS, {}, [*runs(dry=()), *APART], False,
         "dry 1 run at each of 1.00, 2.00, 4.00 in/s (25.4, 50.8, 101.6 mm/s), wet 3 runs"),
        (REPEATS, {}, [*runs(dry=()), *APART, *MORE], False,
         f"dry 3 runs {AT}, 1 run at each of 2.00, 4.00 in/s (50.8,"),
        (REPEATS, {}, [*runs(wet=()), *UNKNOWN], False,
         f"dry 3 runs {AT}, wet 3 runs with velocity not given"),
    ],
)  # fmt: skip
def test_a_row_is_satisfied_by_what_its_report_and_its_runs_have(
    title, report, given, is_satisfied, found
):
    one = row(title, friction_tests=REPORT | report, friction_runs=given)
    assert one.is_satisfied is is_satisfied
    assert one.verdict is (Verdict.OK if is_satisfied else Verdict.CONDITION)
    assert found in one.found


def test_the_row_has_the_units_of_the_project():
    si = stand_in.project().project.model_dump() | {"units_first": "SI"}
    found = row(REPEATS, friction_runs=runs(), project=si).found
    assert found == "dry and wet 3 runs at 25.4 mm/s (1.00 in/s)"


def test_a_law_is_fitted_to_four_velocities_and_none_to_one_coefficient():
    law = {"mu": 0.38, "mu_fast": 0.46, "mu_rate_s_per_m": 20.0}
    arrays = [stand_in.array("A1", 0.5, **law)]
    friction = stand_in.project(arrays=arrays).arrays[0].friction
    wet = [run("wet", k, friction.at(v), velocity_mps=v) for k, v in enumerate(VELOCITIES, 1)]
    shown = printed(scenes.package(arrays=arrays, friction_runs=wet, clearances=[]), "inputs")
    assert "no dry runs are given" in shown
    assert shown.line("Wet, 4 velocities").startswith(
        "Wet, 4 velocities: fit μ = 0.380 at low and 0.460 at high velocity, rate 20.0 s/m;"
        " rms residual 0.0000, of one coefficient 0.0"
    )
    assert shown.line("Array A1: mean of μ(v) at the tested velocities")
    assert "Light: laws fitted" in shown
    data = stand_in.project(arrays=arrays, friction_runs=wet)
    (found,) = series_of(data)
    fit = fit_law([run.velocity_mps for run in found.runs], [run.mu for run in found.runs])
    svg = friction_by_velocity(found.runs, data.arrays, {found.surface: fit}, True)
    texts = words(svg)
    assert {"wet runs", "fit, wet", "A1: μ(v)", "Sliding velocity [in/s]"} <= set(texts)
    assert "dry runs" not in texts
    assert least_type_pt(svg) >= 8.5
    same = [run("dry", k, 0.6, velocity_mps=v) for k, v in enumerate(VELOCITIES, 1)]
    assert page(friction_runs=same).line(
        "Dry, 4 velocities: the runs do not determine a velocity-dependent law."
    )


def words(svg):
    return re.findall(r"<text[^>]*>([^<]*)</text>", svg)


def least_type_pt(svg):
    """Return the smallest type; Matplotlib writes 72 px to the inch, the unit of a point."""
    return min(float(size) for size in re.findall(r"font(?:-size)?:[^;']*?([\d.]+)px", svg))


@pytest.mark.parametrize("slope", [0.0, 2.0, 10.0, 40.0])
def test_the_section_states_its_dimensions_and_stays_on_the_sheet(slope):
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


def test_the_weight_is_over_the_plan_area_with_its_parts():
    array = stand_in.project().arrays[0]  # 42,000 lb on 80 ft x 60 ft
    assert array.weight_pa == pytest.approx(8.75 * 47.880259)
    parts = {"modules": 320, "module_weight_n": 75 * LB, "ballast_n": 18000 * LB}
    first, second, *others = stand_in.project().model_dump()["arrays"]
    arrays = [first | parts, second | parts | {"weight_n": 42100 * LB}, *others]
    text = page(arrays=arrays).line("Weight of modules with their racking")
    one = "320 × 75 lb (0.33 kN) + 18000 lb (80.07 kN)"
    assert text.endswith(
        f"and of ballast: A1 {one}; A2 {one} = 42000 lb (186.83 kN) (entered as above)."
    )


@pytest.mark.parametrize(("file", "is_on_file"), [("", False), ("ft-118.pdf", True)])
def test_a_friction_report_is_on_file_only_where_it_is_attached(file, is_on_file):
    found = row(ON_FILE.replace("stated", "on file") if file else ON_FILE,
                friction_tests=REPORT | {"report_file": file})  # fmt: skip
    assert found.is_satisfied
    assert found.found.endswith("; attached") is is_on_file
