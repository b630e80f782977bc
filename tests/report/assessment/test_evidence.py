"""Other buildings, smaller events, other inputs and what an analysis could save, against runs."""

import math
from dataclasses import replace

import numpy as np
import pytest

from fixtures import assessments, project_parts, projects
from fixtures.marks import by_day
from fixtures.pages import page_of
from fixtures.single_runs import prd_m
from fixtures.spaces import spaced
from fixtures.workbooks import cell_address, make, problems, read_workbook, type_into
from report.assessment.design.routes import Route
from report.assessment.design.verdict import Verdict
from report.assessment.support.analysis_saving import saving
from report.assessment.support.evidence import support
from report.assessment.support.further_runs import building_variations, cumulative
from report.assessment.support.input_cases import building_case, cases
from report.pages.marks import Marks
from report.pages.saving import saving_words
from report.project.model.overrides import Override
from report.text.unit_format import UnitFormat
from solver import at_roof, building_of_periods
from solver.sliding.model_selection import DEFAULT

T1_S, T2_S, FACTOR = 0.5, 0.16, 1.4
BUILDING = {"period_s": T1_S, "period_2_s": T2_S, "damping_percent": 3.0}
GROUND = assessments.motions(3, peak_g=0.5)
PLACES = ("ground", "ground", "roof")


@pytest.fixture(scope="module")
def made():
    rows = [
        {"id": f"M{k}", "record": "x", "transverse": "y", "vertical": "z"}
        | {"recorded_at": place, "scaling": "factor", "scale_value": FACTOR}
        for k, place in enumerate(PLACES, start=1)
    ]
    data = projects.project(motions=rows, building=BUILDING, options=assessments.REVIEW)
    done = projects.assessed(assessments.grounded(data, GROUND, transverse=True))
    return done, building_variations(done)


def alone(motion, building, place):
    """Return a motion as the solver has it at the roof of a building, from scaled records."""
    names = ("ax_mps2", "ay_mps2", "az_mps2")
    ground = replace(motion, **{name: FACTOR * getattr(motion, name) for name in names})
    return at_roof(ground, building) if place == "ground" else ground


@pytest.mark.parametrize(
    ("row", "factor", "damping"), [(0, 1.0, 3), (1, 0.8, 3), (2, 1.2, 3), (3, 1.0, 2), (5, 1.0, 7)]
)
@pytest.mark.quick
def test_a_variation_is_that_of_separate_runs_through_such_a_building(made, row, factor, damping):
    done, found = made
    building = building_of_periods(
        [factor * T1_S, factor * T2_S], damping=(damping / 100,), stories=done.project.site.stories
    )
    array = done.governing.array
    peaks = [
        prd_m(alone(motion, building, place), array)
        for motion, place in zip(GROUND, PLACES, strict=True)
    ]
    (varied, value), bound = found[row], max(map(DEFAULT.bound_m, peaks))
    assert varied.period_s == pytest.approx(factor * T1_S)
    assert varied.damping_percent == damping
    assert value.mean_m == pytest.approx(np.mean(peaks), abs=bound)
    assert value.largest_m == pytest.approx(max(peaks), abs=bound)
    assert value.value_m == 1.1 * value.largest_m  # of three motions


@pytest.mark.quick
def test_the_building_as_used_is_first_and_is_that_of_the_design(made):
    done, found = made
    assert found[0][1] is done.governing.analysis
    assert len({value.mean_m for _, value in found}) == 6  # of four dampings one is used


def test_the_slowest_building_is_made_no_slower_and_without_ground_motions_none_is_varied():
    rows = [{"id": f"M{k}", "record": "x", "recorded_at": "ground"} for k in (1, 2, 3)]
    data = projects.project(motions=rows, building={"period_s": 10.0})
    found = building_variations(projects.assessed(assessments.grounded(data, GROUND)))
    assert [building.period_s for building, _ in found[:4]] == [10.0, 8.0, 10.0, 10.0]
    assert building_variations(assessments.package().assessment) == ()


FACTORS = "0.50, 0.50, 0.25"
G = 9.80665
CELL = "Options/Smaller events"


def with_events(events=FACTORS, found=None, **changes):
    options = {**project_parts.REVIEW, "smaller_events": events}
    return assessments.package(found, options=options, **changes).assessment


def scaled(motion, factor):
    records = ("ax_mps2", "ay_mps2", "az_mps2")
    return replace(motion, **{name: factor * getattr(motion, name) for name in records})


def test_sums_are_those_of_separate_runs_and_carry_the_factor():
    for item in cumulative(with_events()):
        for motion, total in zip(assessments.motions(), item.sums_m.values(), strict=True):
            events = [scaled(motion, factor) for factor in (1.0, 0.5, 0.5, 0.25)]
            peaks = [prd_m(event, item.array.array) for event in events]
            assert abs(total - sum(peaks)) <= sum(map(DEFAULT.bound_m, peaks))
        assert item.mean_m == pytest.approx(np.mean(list(item.sums_m.values())))
        assert item.largest_m == max(item.sums_m.values())
    # Three motions: 1.1 times the largest, which is what a sum is compared with.
    done = with_events()
    table = page_of(done, "accuracy").table("Cumulative displacement over the motions")
    for item, row in zip(cumulative(done), table.cells, strict=True):
        shown = [f"{math.ceil(1100.0 * length_m - 1e-6)}"
                 for length_m in (item.mean_m, item.largest_m)]  # fmt: skip
        assert [row[2], row[4]] == shown


@pytest.mark.nightly
@pytest.mark.quick
def test_a_rectangular_pulse_gives_the_closed_form():
    """A level block under one pulse slides v^2 / 2 (1/(mu g) - 1/a) (Newmark 1965)."""
    mu, seconds, dt = 0.45, 0.5, 0.001
    pulse = np.zeros(4001)
    pulse[1000:1500] = 1.0 * G
    motion = projects.motion("P", pulse, dt_s=dt, signs=(1,))
    level = [projects.array("A1", 0.0, mu=mu)]
    (item,) = cumulative(with_events("0.60", (motion,), arrays=level, objects=[], clearances=[]))
    closed = sum((a * seconds) ** 2 / 2 * (1 / (mu * G) - 1 / a) for a in (G, 0.6 * G))
    assert item.sums_m[motion.id] == pytest.approx(closed, rel=3e-3)


@pytest.mark.quick
def test_smaller_events_are_off_or_without_a_sum_where_a_run_has_no_value():
    first = cumulative(with_events())[0]
    assert math.isnan(replace(first, sums_m={"M1": 1.0, "M2": math.nan}).largest_m)
    assert cumulative(with_events("")) == ()


@pytest.mark.parametrize("typed", by_day(["0.5, 1.2", "0.0", "0,5", ", ".join(["0.5"] * 21)], 1))
def test_factors_are_read_from_the_sheet_and_refused_by_cell_outside_of_the_range(tmp_path, typed):
    path = type_into(make(tmp_path), {CELL: FACTORS})
    assert read_workbook(path).input.options.smaller_factors == (0.5, 0.5, 0.25)
    (line,) = problems(type_into(path, {CELL: typed}))
    assert line.startswith(cell_address(CELL))
    assert "enter up to 20 factors with decimal points, above 0.0 and up to 1.0" in line


LAW = {"mu": 0.20, "mu_fast": 0.45, "mu_rate_s_per_m": 20.0}
ROWS = [
    {"id": f"M{k}", "record": "x", "transverse": "y", "recorded_at": "ground", "scaling": "factor"}
    | {"scale_value": 1.4}
    for k in range(1, 4)
]


def assessed(provided_m, **changes):
    gaps = [projects.clearance("A1", "RTU-1", provided_m)]
    given = {
        "arrays": [projects.array("A1", 2.0)],
        "clearances": gaps,
        "options": assessments.REVIEW,
    }
    return assessments.package(assessments.motions(3), **given | changes).assessment


def by_velocity(provided_m):
    return assessed(provided_m, arrays=[projects.array("A1", 2.0, **LAW)])


@pytest.fixture(scope="module")
def alone_m():
    """The design displacement with the low-velocity coefficient, of a project of its own."""
    return assessed(9.0, arrays=[projects.array("A1", 2.0, mu=0.20)]).arrays[0].design_m


def test_the_low_velocity_coefficient_is_a_case_where_the_slack_is_then_too_short(alone_m):
    def by_velocity_with(slack_m):
        return support(assessed(9.0, arrays=[projects.array("A1", 2.0, slack_m=slack_m, **LAW)]))

    (case,) = by_velocity_with(0.99 * alone_m).cases
    assert case.words(us_first=True).endswith(", NG: electrical slack (D/C 1.02).")
    assert by_velocity_with(1.01 * alone_m).cases == ()


@pytest.mark.quick
def test_the_low_velocity_coefficient_is_a_case_only_where_it_changes_something(alone_m):
    done = by_velocity(0.99 * alone_m)
    assert done.clearances[0].ok
    (case,) = support(done).cases
    assert case.array.design_m == pytest.approx(alone_m)
    assert [gap.verdict for gap in case.short] == [Verdict.NG]
    words = case.words(us_first=True)
    assert words.startswith("With μ = 0.20 at all velocities, A1: design displacement ")
    assert ", NG: clearance A1 to RTU-1 (D/C " in words
    done = by_velocity(1.01 * alone_m)
    assert done.arrays[0].prescriptive.value_m > alone_m
    assert support(done).cases == ()
    below = replace(done.arrays[0].prescriptive, value_m=0.99 * alone_m)
    slow = done.low_velocity
    exceeded = replace(slow, arrays=(replace(slow.arrays[0], prescriptive=below),))
    (case,) = cases(replace(done, low_velocity=exceeded), ())
    assert case.words(us_first=False).endswith(", its clearance OK.")


@pytest.fixture(scope="module")
def grounded():
    building = {"period_s": 0.5, "damping_percent": 5.0}
    data = projects.project(
        arrays=[projects.array("A1", 2.0)],
        clearances=[projects.clearance("A1", "RTU-1", 2.0)],
        motions=ROWS,
        building=building,
        options=assessments.REVIEW,
    )
    done = projects.assessed(
        assessments.grounded(data, assessments.motions(3, peak_g=0.5), transverse=True)
    )
    array = done.arrays[0]
    limits = replace(array.limits, route=Route.ANALYSIS)
    by_analysis = {"limits": limits, "is_permitted": True, "floor_m": 0.0}
    array = replace(array, design_m=array.analysis.value_m, **by_analysis)
    return replace(done, arrays=(array,)), support(done)


@pytest.mark.quick
def test_the_building_case_is_the_farthest_or_one_without_a_value_where_it_matters(grounded):
    done, evidence = grounded
    building, value = max(evidence.building[1:], key=lambda pair: pair[1].value_m)
    assert value.value_m > done.arrays[0].design_m
    case = building_case(done, evidence.building)
    assert case.array.design_m == value.value_m  # peer reviewed: no floor
    assert case.gaps[0].required_m == pytest.approx(value.value_m * case.gaps[0].factor)
    if building.damping_percent == 5.0:
        assert case.changed == f"{building.period_s:.2f} s as the period of the building"
    else:
        assert spaced(case.changed) == f"{building.damping_percent:.1f}% building damping"
    used, (building, value), *others = evidence.building
    lifting = building, replace(value, value_m=math.nan)
    for order in ((lifting, *others), (*others, lifting)):
        (case,) = cases(done, (used, *order))
        assert math.isnan(case.array.design_m)
        assert ": no design displacement" in case.words(us_first=True)
    assert building_case(done, ()) is None
    assert building_case(done, (used, used)) is None


PRESCRIPTIVE_M = 60 * 0.0254 * (1.566 - 0.4) ** 2


def with_inputs(*, slopes=(), **sections):
    """The example without motions, with other slopes of its arrays and other sections."""
    given = assessments.without_motions()
    arrays = list(given.project.arrays)
    for k, slope in enumerate(slopes):
        arrays[k] = arrays[k].model_copy(update={"slope_value": slope})
    project = given.project.changed(arrays=tuple(arrays), **sections)
    return projects.assessed_anew(given, project)


def said(given):
    return saving_words(saving(given), Marks(given), UnitFormat(given.project.us_first))


def test_the_floor_satisfies_clearances_that_it_does_not_exceed():
    found = saving(assessments.without_motions())
    assert found.prescriptive_m == pytest.approx(PRESCRIPTIVE_M, rel=1e-4)
    assert found.floor_m == pytest.approx(0.5 * PRESCRIPTIVE_M, rel=1e-4)
    # A1 to RTU-1 48 in, A3 to RTU-2 60, to PV-OLD 72 and to EAST 120 in; 40.8, and 61.2 to the edge
    assert (found.n_short, found.n_satisfied) == (4, 4)
    assert (found.ids, found.others) == (["A1", "A2", "A3"], [])
    given = assessments.without_motions()
    rows = list(given.project.clearances)
    rows[1] = rows[1].model_copy(update={"provided_m": 40.0 * 0.0254})
    found = saving(with_inputs(clearances=tuple(rows)))
    assert (found.n_short, found.n_satisfied) == (4, 3)


def test_steep_roofs_and_a_whole_floor_leave_nothing_to_save():
    given = with_inputs(slopes=[8.0])
    assert (saving(given).ids, saving(given).others) == (["A2", "A3"], ["A1"])
    assert said(given).endswith(
        "The roof slope exceeds the limit for an analysis (PV1-2012†) under array A1."
    )
    text = said(with_inputs(slopes=[8.0, 8.0, 8.0]))
    assert text == (
        "An analysis is not permitted, because the roof slope under all arrays exceeds its limit "
        "(PV1-2012†)."
    )
    site = assessments.without_motions().project.site
    low = type(site)(**site.model_dump() | {"rule_set": "ASCE 7-16", "sdc": "C"})
    text = said(with_inputs(slopes=[4.0, 4.0, 4.0], site=low))
    assert text.startswith("An analysis is not permitted without peer review, because ")
    override = Override(provision="analysis_floor", value=1.0, reason="Agreed on 2026-02-10")
    text = said(with_inputs(overrides=(override,)))
    assert spaced(text).startswith(
        "Without peer review, an analysis would not reduce it: the floor is 100%"
    )
