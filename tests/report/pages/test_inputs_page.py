"""Site with its equations, friction as tested, and the section through an array."""

import re

import pytest

from fixtures import assessments, projects
from fixtures.assessments import TESTS as REPORT
from fixtures.pages import page_of
from fixtures.project_parts import LB
from fixtures.spaces import spaced
from report.assessment.checks.friction_evidence import of_tests
from report.assessment.design.tested_friction import tested as series_of
from report.assessment.design.verdict import Verdict
from report.drawing.drawn_slope import drawn_slope_deg
from report.figures.charts import friction_by_velocity
from report.figures.plan_figure import array_section
from solver.friction_tests import fit_law

AT = "at 1.00 in/s (25.4 mm/s)"
ON_FILE = "Friction test report"
STANDARD = "Friction test standard"
REPEATS = "Friction test repeats"
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
    return page_of(assessments.package(**changes), "inputs")


def row(title, **changes):
    return next(r for r in of_tests(projects.project(**changes)) if r.title == title)


APART = [run("dry", k, 0.6, velocity_mps=v) for k, v in enumerate(VELOCITIES[1:], 1)]
MORE = [run("dry", k, 0.6, velocity_mps=VELOCITIES[1]) for k in (4, 5)]
UNKNOWN = [run("wet", k, 0.46) for k in (1, 2, 3)]
OTHER_REPORT = run("wet", 1, 0.5, report="FT-9", velocity_mps=0.0254)


@pytest.mark.quick
@pytest.mark.parametrize(
    ("title", "report", "given", "is_satisfied", "found"),
    [
        (ON_FILE, {}, [], True, "Example Laboratories; FT-118; 2025-06-12"),
        (ON_FILE, {"laboratory": ""}, [], False, "FT-118; 2025-06-12; laboratory missing"),
        (STANDARD, {}, [], True, "standard ASTM G115-10; accreditation ISO/IEC 17025, no. 1234.01"),
        (STANDARD, {"standard": "astm g 115-10 (2018)"}, [], True, "standard astm"),
        (STANDARD, {"standard": "ASTM D1894"}, [], False, "standard ASTM D1894"),
        (STANDARD, {"standard": ""}, [], False, "standard not entered; accreditation ISO"),
        (STANDARD, {"accreditation": ""}, [], False, "standard ASTM G115-10; accreditation not"),
        (REPEATS, {}, runs(), True, f"dry and wet: 3 runs {AT}"),
        (REPEATS, {}, [], False, "no runs"),
        (REPEATS, {}, runs(dry=(0.6, 0.6)), False, f"dry: 2 runs {AT}, wet: 3 runs {AT}"),
        (REPEATS, {"report": ""}, [*runs(), OTHER_REPORT], False,
         f"report without a number, dry and wet: 3 runs {AT}; report FT-9, dry: 0 runs, wet: 1"
         " run"),
        (REPEATS, {}, [*runs(dry=()), *APART], False,
         "dry: 1 run at each of 1.00, 2.00, 4.00 in/s (25.4, 50.8, 101.6 mm/s), wet: 3 runs"),
        (REPEATS, {}, [*runs(dry=()), *APART, *MORE], False,
         f"dry: 3 runs {AT}, 1 run at each of 2.00, 4.00 in/s (50.8,"),
        (REPEATS, {}, [*runs(wet=()), *UNKNOWN], False,
         f"dry: 3 runs {AT}, wet: 3 runs with velocity not entered"),
    ],
)  # fmt: skip
def test_a_row_is_satisfied_by_what_its_report_and_its_runs_have(
    title, report, given, is_satisfied, found
):
    one = row(title, friction_tests=REPORT | report, friction_runs=given)
    assert one.is_satisfied is is_satisfied
    assert one.verdict is (Verdict.OK if is_satisfied else Verdict.CONDITION)
    assert found in spaced(one.found)


@pytest.mark.quick
def test_the_row_has_the_units_of_the_project():
    si = projects.project().project.model_dump() | {"units_first": "SI"}
    found = row(REPEATS, friction_runs=runs(), project=si).found
    assert spaced(found) == "dry and wet: 3 runs at 25.4 mm/s (1.00 in/s)"


def test_a_law_is_fitted_to_four_velocities_and_none_to_one_coefficient():
    law = {"mu": 0.38, "mu_fast": 0.46, "mu_rate_s_per_m": 20.0}
    arrays = [projects.array("A1", 0.5, **law)]
    friction = projects.project(arrays=arrays).arrays[0].friction
    wet = [run("wet", k, friction.at(v), velocity_mps=v) for k, v in enumerate(VELOCITIES, 1)]
    shown = page_of(assessments.package(arrays=arrays, friction_runs=wet, clearances=[]), "inputs")
    assert "no dry runs are entered" in shown
    assert shown.line("Wet, 4 velocities").startswith(
        "Wet, 4 velocities: fit μ = 0.380 at low and 0.460 at high velocity, rate 20.0 s/m;"
        " rms residual 0.0000 (0.0"
    )
    assert shown.line("Array A1: mean of μ(v) at the tested velocities")
    assert "Light lines: fitted" in shown
    data = projects.project(arrays=arrays, friction_runs=wet)
    (found,) = series_of(data)
    fit = fit_law([run.velocity_mps for run in found.runs], [run.mu for run in found.runs])
    svg = friction_by_velocity(found.runs, data.arrays, {found.surface: fit}, True)
    texts = words(svg)
    assert {"wet runs", "fit, wet", "A1: μ(v)", "Sliding velocity [in/s]"} <= set(texts)
    assert "dry runs" not in texts
    same = [run("dry", k, 0.6, velocity_mps=v) for k, v in enumerate(VELOCITIES, 1)]
    assert page(friction_runs=same).line(
        "Dry, 4 velocities: the runs do not determine a velocity-dependent coefficient."
    )


def words(svg):
    return re.findall(r"<text[^>]*>([^<]*)</text>", svg)


@pytest.mark.parametrize("slope", [0.0, 2.0, 10.0, 40.0])
def test_the_section_states_its_dimensions(slope):
    array = projects.project(arrays=[projects.array("A1", slope)]).arrays[0]
    svg = array_section(array, True)
    texts = words(svg)
    for text in (
        "c = 9.0 in (229 mm)", "b = 40.0 in (1016 mm)", "W = 42000 lb (186.83 kN)", "μ = 0.45",
        f"θ = {slope:.2f}°", "N", "μ N", "W + m a", "−m a",
    ):  # fmt: skip
        assert text in spaced(texts)
    assert drawn_slope_deg(array) == pytest.approx(min(max(slope, 8.0), 15.0))


@pytest.mark.quick
def test_the_weight_is_over_the_plan_area_with_its_parts():
    array = projects.project().arrays[0]  # 42,000 lb on 80 ft x 60 ft
    assert array.weight_pa == pytest.approx(8.75 * 47.880259)
    parts = {"modules": 320, "module_weight_n": 75 * LB, "ballast_n": 18000 * LB}
    first, second, *others = projects.project().model_dump()["arrays"]
    arrays = [first | parts, second | parts | {"weight_n": 42100 * LB}, *others]
    text = page(arrays=arrays).line("Weight of modules with their racking")
    one = "320 × 75 lb (0.33 kN) + 18000 lb (80.07 kN)"
    assert text.endswith(
        f"and of ballast: A1 {one}; A2 {one} = 42000 lb (186.83 kN) (entered as above)."
    )


@pytest.mark.quick
@pytest.mark.parametrize(("file", "is_on_file"), [("", False), ("ft-118.pdf", True)])
def test_a_friction_report_is_on_file_only_where_it_is_attached(file, is_on_file):
    found = row(ON_FILE.replace("stated", "on file") if file else ON_FILE,
                friction_tests=REPORT | {"report_file": file})  # fmt: skip
    assert found.is_satisfied
    assert found.found.endswith("; attached") is is_on_file


BLANK = dict.fromkeys(
    ("s_s_g", "s_1_g", "f_a", "f_v", "s_ms_g", "s_m1_g", "s_ds_g", "s_d1_g", "site_class")
)
FT = projects.FOOT


def package(sections=None, **site):
    """A package of one array, its site given by `site` alone."""
    usual = {"arrays": [projects.array("A1", 1.0)], "objects": [], "clearances": []}
    shaking = assessments.motions(3, seconds=3.0)
    return assessments.package(
        shaking, site=projects.site(**BLANK | site), **usual | (sections or {})
    )


def table(made):
    return page_of(made, "inputs").table("8.1 Site and seismic parameters")


def rows(made):
    """Rows by their symbol, or by their description where they have none; the last of each name."""
    return {row["Symbol"] or row["Description"]: row for row in table(made).rows}


def values(made):
    return {name: row["Value"] for name, row in rows(made).items()}


def forces(made):
    """The component force with its limits."""
    every = (row for row in table(made).rows if row["Symbol"] == "Fp/Wp")
    return [(row["Value"], row["Source"]) for row in every]


def sources(made):
    """How each spectral acceleration of the site follows, by its symbol."""
    return {name: row["Source"] for name, row in rows(made).items() if re.match("S[MD][S1]", name)}


def worked_out(source):
    """The result of the numbers that a source ends with."""
    numbers = source.rpartition(" = ")[2]
    return eval(numbers.replace("×", "*").replace(" g", ""))


CATEGORY = "Seismic design category from these values"
FULL = {
    "s_s_g": 1.271,
    "f_a": 1.2,
    "s_1_g": 0.455,
    "f_v": 1.845,
    "site_class": "D",
    "force_factor": 1.0,
    "force_divisor": 1.5,
    "structure_height_m": 30 * FT,
    "roof_height_m": 30 * FT,
    "hazard_source": "ASCE 7 Hazard Tool",
    "hazard_date": "2026-02-20",
    "hazard": "exception of 11.4.8",
}


@pytest.fixture(scope="module")
def full():
    return package({"target": {"t_l_s": 8.0}}, **FULL)


@pytest.mark.quick
def test_the_values_are_those_of_a_permit_sheet_or_category_e_near_a_fault(full):
    """Permit sheet of provisions.md: S_S 1.271, F_a 1.2, S_1 0.455, F_v 1.845, h 30 ft."""
    found = values(full)
    assert [found[name] for name in ("SMS", "SDS", "SM1", "SD1", "Ta", "TS")] == [
        "1.525 g", "1.017 g", "0.839 g", "0.560 g", "0.256 s", "0.550 s",
    ]  # fmt: skip
    assert found[CATEGORY] == found["SDC"] == "D"
    assert (
        rows(full)[CATEGORY]["Source"]
        == "the most severe of D (short period), D (1 s), S1 below 0.75 g"
    )
    assert "not entered" not in found.values()
    found = rows(package(s_ds_g=1.5, s_1_g=0.8, sdc="E"))
    assert found[CATEGORY]["Source"] == (
        "the most severe of D (short period), SD1 not entered, E (S1)"
    )
    assert found[CATEGORY]["Value"] == found["SDC"]["Value"] == "E"
    confirmed = values(package(s_ds_g=1.5, s_1_g=0.8, s_d1_g=0.9, sdc="E"))
    assert confirmed[CATEGORY] == confirmed["SDC"] == "E"


def test_equations_and_periods_follow_what_is_given(full):
    row = rows(full)["Ta"]
    assert row["Description"] == "Approximate period, all other structural systems"
    assert row["Source"] == "assumed"
    row = rows(package({"building": {"structure": "steel moment frame"}}, **FULL))["Ta"]
    # 0.028 x 30^0.8
    assert (row["Value"], row["Source"]) == ("0.425 s", "computed")
    assert values(package({"building": {"period_s": 0.62}}, **FULL))["T1"] == "0.620 s"
    computed = {
        "SMS": "computed: Fa SS = 1.200 × 1.271 g",
        "SM1": "computed: Fv S1 = 1.845 × 0.455 g",
        "SDS": "computed: 2/3 SMS = 2/3 × 1.525 g",
        "SD1": "computed: 2/3 SM1 = 2/3 × 0.839 g",
    }
    assert sources(full) == computed
    for name, clause in (("SMS", "4"), ("SM1", "4"), ("SDS", "5"), ("SD1", "5")):
        row = rows(full)[name]
        value_g = float(row["Value"].removesuffix(" g"))
        assert worked_out(row["Source"]) == pytest.approx(value_g, abs=1.1e-3)
        assert row["Reference"] == f"ASCE 7-16 11.4.{clause}"
    assert sources(package(**FULL | {"s_ds_g": 1.017})) == computed | {"SDS": "input"}
    assert sources(package(s_ds_g=1.0)) == {
        "SMS": "computed: 1.5 SDS = 1.5 × 1.000 g", "SM1": "—", "SDS": "input", "SD1": "—",
    }  # fmt: skip


@pytest.mark.quick
def test_the_force_and_its_factors_are_those_of_a_permit_sheet():
    """Permit sheet of provisions.md: h 35 ft, S_DS 1.0504, a_p 1, R_p 1.5."""
    height = {"structure_height_m": 35 * FT, "roof_height_m": 35 * FT}
    made = package(s_ds_g=1.0504, force_factor=1.0, force_divisor=1.5, **height)
    assert forces(made) == [("0.840", "computed (lower limit 0.315, upper limit 1.681)")]
    assert values(made)["Ta"] == "0.288 s"
    arrays = [projects.array("A1", 1.0, i_p=1.5), projects.array("A2", 1.0, x=120)]
    made = package({"arrays": arrays}, s_ds_g=1.0, force_factor=1.0, force_divisor=1.5)
    assert values(made)["Ip"] == "1.00 to 1.50"
    assert "limit 2.400" in forces(made)[0][1]  # 1.6 x S_DS x the larger I_p


@pytest.mark.quick
def test_asce_7_22_has_no_site_coefficients_and_its_own_clauses():
    made = package(
        rule_set="ASCE 7-22",
        s_ms_g=2.4,
        s_m1_g=1.2,
        site_class="CD",
        force_factor=1.4,
        force_divisor=1.5,
    )
    found = rows(made)
    assert not {"Fa", "Fv", "ap", "Rp"} & found.keys()
    assert (found["CAR"]["Value"], found["Rpo"]["Value"]) == ("1.40", "1.50")
    assert (found["SDS"]["Value"], found["SDS"]["Reference"]) == ("1.600 g", "ASCE 7-22 11.4.4")
    assert not any("7-16" in row["Reference"] for row in found.values())
    assert sources(made) == {
        "SMS": "input",
        "SM1": "input",
        "SDS": "computed: 2/3 SMS = 2/3 × 2.400 g",
        "SD1": "computed: 2/3 SM1 = 2/3 × 1.200 g",
    }
    # 0.4 S_DS H_f / R_mu C_AR / R_po with H_f = 3.5 at the roof and R_mu = 1.3
    ((force, _),) = forces(made)
    assert float(force) == pytest.approx(0.4 * 1.6 * 3.5 / 1.3 * 1.4 / 1.5, abs=6e-4)
