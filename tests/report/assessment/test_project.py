"""The checks against the rule set; a missing value never passes."""

import math
import re
import statistics
from dataclasses import replace

import numpy as np
import pytest

import scenes
import stand_in
from report.assessment.arrays import DesignBasis
from report.assessment.evidence import support
from report.assessment.verdict import Verdict
from report.sheet.schema import Direction
from solver.model import Status
from solver.rules.provisions import Basis
from solver.sliding import least_model
from solver.sliding.checked import slide
from solver.sliding.least_model import Rung


def motions(count=7, seconds=12.0, **changes):
    """Half a second less for a run of seven."""
    return scenes.motions(count, seconds, **changes)


G = 9.80665


def assessed(shaking=None, **changes):
    return scenes.package(shaking or motions(), **changes).assessment


def resting(count=7, **changes):
    """Motions too weak to move anything."""
    return motions(count, peak_g=0.05, vertical_peak_g=0.01, **changes)


def lifting():
    """A motion whose vertical component lifts the array."""
    ax = np.zeros(400)
    az = np.concatenate([np.zeros(200), np.full(200, -1.2 * G)])
    return stand_in.motion("UP", ax, az)


@pytest.fixture(scope="module")
def done():
    return assessed()


def slid(motion, along, across, slope_deg, mu):
    return slide(
        along,
        motion.dt_s,
        slope_rad=math.radians(slope_deg),
        mu=mu,
        ay_mps2=across,
        az_mps2=motion.az_mps2,
    )


def four(motion, slope_deg, mu):
    """The four combinations that are run, each by the solver itself."""
    pairs = ((motion.ax_mps2, motion.ay_mps2), (motion.ay_mps2, motion.ax_mps2))
    return [slid(motion, s * x, y, slope_deg, mu) for x, y in pairs for s in (1, -1)]


def test_each_motion_is_governed_by_its_worst_component_and_polarity(done):
    item = done.arrays[1]
    peaks = [max(r.prd_m for r in four(motion, 2.0, 0.45)) for motion in motions()]
    assert [run.governing.result.prd_m for run in item.motions] == peaks
    assert item.analysis.mean_m == pytest.approx(sum(peaks) / 7)
    assert item.analysis.value_m == pytest.approx(1.1 * sum(peaks) / 7)
    assert item.worst.governing.result.prd_m == max(peaks)


def test_reversing_the_component_across_mirrors_the_motion_and_changes_no_displacement():
    for motion in motions(2, seconds=12.0):
        for along, across in (
            (motion.ax_mps2, motion.ay_mps2),
            (-motion.ay_mps2, motion.ax_mps2),
        ):
            first = slid(motion, along, across, 3.0, 0.4)
            other = slid(motion, along, -across, 3.0, 0.4)
            assert first.across_m > 0.0
            for name in ("prd_m", "down_m", "up_m", "across_m", "residual_m", "t_prd_s"):
                assert getattr(first, name) == pytest.approx(getattr(other, name), rel=1e-11)
            assert first.residual_across_m == pytest.approx(-other.residual_across_m, rel=1e-10)


def test_each_direction_has_the_farthest_of_all_runs_of_each_motion(done):
    item = done.arrays[2]
    by_motion = [four(motion, 3.0, 0.55) for motion in motions()]
    for direction, name in (("down", "down_m"), ("up", "up_m"), ("across", "across_m")):
        peaks = [max(getattr(r, name) for r in results) for results in by_motion]
        assert [m.peak_m(Direction(direction)) for m in item.motions] == peaks
        value = item.directions[Direction(direction)].value_m
        assert value == pytest.approx(1.1 * sum(peaks) / 7)
        assert item.directional_m(Direction(direction)) == max(value, item.floor_m)


def test_a_reversed_motion_is_the_motion_on_the_opposite_slope(done):
    motion = motions()[0]
    reversed_ = done.arrays[2].motions[0].runs[1].result
    opposite = slid(motion, motion.ax_mps2, motion.ay_mps2, -3.0, 0.55)
    assert reversed_.prd_m == pytest.approx(opposite.prd_m, rel=1e-9)
    assert reversed_.down_m == pytest.approx(opposite.up_m, rel=1e-6)


def test_a_requested_model_is_run_and_compared_with_the_adequate_one():
    arrays = [
        stand_in.array("A1", 2.0, model="one axis with vertical"),
        stand_in.array("A2", 2.0, x=120),
    ]
    for reviewed in (False, True):
        done = assessed(
            arrays=arrays, objects=[], clearances=[], options={"peer_reviewed": reviewed}
        )
        asked, free = done.arrays
        assert {r.solution.rung for m in asked.motions for r in m.runs} == {Rung.ONE_AXIS_VERTICAL}
        assert asked.chosen == free.directions
        assert asked.analysis.value_m < free.analysis.value_m
        assert free.is_model_enough
        enough = free.design_m <= asked.design_m
        assert asked.is_model_enough is enough
        assert done.verdict.is_permitted is enough


def test_friction_by_speed_reaches_the_solver():
    arrays = [stand_in.array("A1", 2.0, mu=0.4, mu_fast=0.5, mu_rate_s_per_m=20.0)]
    done = assessed(motions(3, seconds=8.0), arrays=arrays, objects=[], clearances=[])
    constant = assessed(
        motions(3, seconds=8.0),
        arrays=[stand_in.array("A1", 2.0, mu=0.4)],
        objects=[],
        clearances=[],
    )
    runs = [run for m in done.arrays[0].motions for run in m.runs]
    assert {run.solution.rung for run in runs} == {Rung.SPEED_FRICTION}
    assert done.arrays[0].analysis.mean_m < constant.arrays[0].analysis.mean_m


def test_a_fixed_polarity_runs_once():
    motion = replace(motions()[0], signs=(-1,))
    done = assessed((motion,) * 3)
    runs = done.arrays[0].motions[0].runs
    assert [run.heading.name for run in runs] == ["record −", "transverse −"]


def test_without_a_transverse_component_the_record_alone_is_run():
    motion = replace(motions()[0], ay_mps2=np.empty(0))
    done = assessed((motion,) * 3)
    runs = done.arrays[0].motions[0].runs
    assert [run.heading.name for run in runs] == ["record +", "record −"]


def test_swapping_the_horizontal_components_changes_names_alone():
    given = motions(3, seconds=8.0)
    swapped = [replace(m, ax_mps2=m.ay_mps2, ay_mps2=m.ax_mps2) for m in given]
    first, other = assessed(given), assessed(swapped)
    for a, b in zip(first.arrays[1].motions, other.arrays[1].motions, strict=True):
        assert a.governing.result == b.governing.result
        assert a.governing.heading.swapped is not b.governing.heading.swapped
        assert np.array_equal(a.history().u_m, b.history().u_m)
        assert a.history().result == a.governing.result


def test_the_variation_is_that_of_the_peaks(done):
    item = done.arrays[1]
    peaks = [run.governing.result.prd_m for run in item.motions]
    assert item.variation == pytest.approx(statistics.stdev(peaks) / statistics.mean(peaks))
    assert math.isnan(assessed(motions(1)).arrays[0].variation)


def test_the_floor_governs_unless_peer_reviewed():
    for reviewed, governs in ((False, "floor"), (True, "analysis")):
        done = assessed(resting(), options={"peer_reviewed": reviewed})
        item = done.arrays[0]
        assert item.governs == governs
        assert item.design_m == (0.0 if reviewed else 0.5 * item.prescriptive.value_m)


def test_uplift_withholds_the_displacement_and_fails_every_clearance():
    done = assessed((*motions(6), lifting()))
    item = done.arrays[0]
    assert item.worst.motion.id == "UP"
    assert item.worst.governing.result.status is Status.UPLIFT
    assert math.isnan(item.design_m)
    assert item.governs == "none"
    assert not any(gap.ok for gap in done.clearances)
    assert not done.verdict.is_permitted
    assert any("normal force falls below zero" in line and "(at " in line for line in done.warnings)


def test_a_run_without_a_result_withholds_the_displacement(monkeypatch):
    monkeypatch.setattr("solver.sliding.two_axes._MOST_STEPS", 10)
    monkeypatch.setattr("solver.sliding.two_axes._MOST_STEPS_OF_SAMPLE", 0)
    done = stand_in.assess_input(stand_in.project(), motions(3))
    item = done.arrays[0]
    assert item.worst.governing.result.status is Status.STEP_LIMIT
    assert math.isnan(item.design_m)
    assert not any(gap.ok for gap in done.clearances)
    assert not done.verdict.is_permitted
    assert any("the run exceeded the limit on time steps" in line for line in done.warnings)


def test_two_motions_are_too_few():
    done = assessed(motions(2))
    item = done.arrays[0]
    assert item.analysis.basis is Basis.TOO_FEW
    assert item.governs is DesignBasis.PRESCRIPTIVE
    assert item.design_m == item.prescriptive.value_m


def test_without_either_route_there_is_no_value():
    steep = stand_in.array("A1", 4.0)
    done = assessed(motions(2), arrays=[steep], clearances=[])
    assert done.arrays[0].governs is DesignBasis.NO_VALUE
    assert done.array_verdict(done.arrays[0]) is Verdict.NG


def test_the_prescriptive_route_takes_no_less_than_a_computed_displacement():
    done = assessed(motions(2, seconds=30.0, peak_g=6.0, vertical_peak_g=0.1), clearances=[])
    for item in done.arrays:
        largest = max(run.governing.prd_m for run in item.motions)
        assert item.design_m == max(item.prescriptive.value_m, largest)
    assert any(item.design_m > item.prescriptive.value_m for item in done.arrays)


def test_too_few_motions_for_a_chosen_statistic_are_never_ok():
    steep = stand_in.array("A1", 4.0)
    done = assessed(motions(5), arrays=[steep], options={"statistic": "mean"}, clearances=[])
    assert math.isnan(done.arrays[0].design_m)
    assert not done.verdict.is_permitted


def test_a_motion_that_ends_while_sliding_is_warned_of():
    ax = np.concatenate([np.zeros(100), np.full(100, -12.0)])
    cut = stand_in.motion("CUT", ax, signs=(1,))
    done = assessed((*motions(6), cut))
    assert any("CUT" in line and "still sliding" in line for line in done.warnings)
    assert all(math.isnan(item.design_m) for item in done.arrays)
    assert not done.verdict.is_permitted


def test_runs_that_never_stop_are_one_sentence_with_their_count_and_us_speed():
    ax = np.concatenate([np.zeros(100), np.full(100, -12.0)])
    cut = [stand_in.motion(f"CUT{k}", ax, signs=(1,)) for k in range(11)]
    arrays = [stand_in.array("A1", 0.0), stand_in.array("A2", 0.0, x=120)]
    (line,) = assessed(cut, arrays=arrays, objects=[], clearances=[]).warnings
    # From rest, (12 - 0.45 g) m/s2 over 99 whole intervals of 0.01 s, and half the first.
    speed = (12.0 - 0.45 * 9.80665) * 0.99
    found = re.fullmatch(
        r"Arrays A1, A2, 22 runs of 11 motions: still sliding at the end of the record: the "
        r"displacement is not final \(at (\d+\.\d\d) in/s \(\d+\.\d mm/s\)\)\.",
        line,
    )
    assert float(found[1]) * 0.0254 == pytest.approx(speed, rel=0.01)


def test_a_limit_of_the_building_fails_the_whole():
    assert not assessed(site=stand_in.site(risk_category="IV", i_e=1.5)).verdict.is_permitted
    assert not assessed(site=stand_in.site(stories=7)).verdict.is_permitted


def test_an_override_changes_the_result_and_is_kept_with_its_reason():
    change = {"provision": "separation_fixed", "value": 1.5, "reason": "plan check comment 4"}
    done = assessed(overrides=[change])
    assert done.clearances[1].factor == 1.5
    assert done.rules.values["separation_fixed"].reason == "plan check comment 4"


def test_arrays_of_one_slope_friction_and_model_share_their_runs(monkeypatch):
    solved = []
    solve = least_model.solve
    monkeypatch.setattr(least_model, "solve", lambda *call: solved.append(call) or solve(*call))
    given = motions(3, seconds=8.0)

    def found(*rows):
        solved.clear()
        gaps = [stand_in.clearance(row["id"], "RTU-1", 7 * stand_in.FOOT) for row in rows]
        options = {"peer_reviewed": True}
        data = stand_in.project(arrays=list(rows), clearances=gaps, options=options)
        return stand_in.assess_input(data, given)

    def runs_of(assessment):
        support(assessment)
        return len(solved)

    one, other = stand_in.array("A1", 1.0, x=0), stand_in.array("A2", 1.0, x=120)
    turned = other | {"downslope_deg": 90.0, "weight_n": 1e4}
    both = found(one, turned)
    first, second = both.arrays
    assert first.motions == second.motions
    assert runs_of(both) == runs_of(found(one))
    for changes in ({"mu": 0.44}, {"slope_value": 3.9}, {"model": "one axis"}, {"mu_fast": 0.5}):
        apart, (single,) = found(one, other | changes), found(other | changes).arrays
        assert apart.arrays[1].motions[0] is not apart.arrays[0].motions[0]
        assert apart.arrays[1].design_m == single.design_m
