"""The checks against the rule set; a missing value never passes."""

import math
import re
import statistics
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from fixtures import assessments, project_parts, projects
from fixtures.single_runs import slides
from fixtures.spaces import spaced
from report import assess_project
from report.assessment.checks.displacement import run_checks
from report.assessment.design.arrays import DesignBasis, assess_array
from report.assessment.design.verdict import Verdict
from report.assessment.support.evidence import support
from report.project.model.choices import Direction
from report.runs import motion_run
from solver.errors import InputError
from solver.model import Status
from solver.rules.provisions import Basis
from solver.sliding import model_selection
from solver.sliding.model_selection import Model

PEER = project_parts.REVIEW
STEEP = [projects.array("A1", 4.0)]
SHORT = assessments.motions()
SEVEN = assessments.motions(7, 12.0)  # half a second less than those of eight seconds
RESTING = assessments.motions(7, 12.0, peak_g=0.05, vertical_peak_g=0.01)
CUT = np.concatenate([np.zeros(100), np.full(100, -12.0)])
"""Accelerations [m/s2] that end while an array slides."""


def assessed(shaking=SEVEN, **changes):
    return assessments.package(shaking, **changes).assessment


def alone(shaking=SEVEN, **changes):
    """An assessment of arrays without clearances."""
    return assessed(shaking, objects=[], clearances=[], **changes)


@pytest.fixture(scope="module")
def done():
    return assessed()


def stated(slope_deg, mu):
    return SimpleNamespace(slope_rad=math.radians(slope_deg), mu=mu)


def test_each_motion_and_direction_has_the_farthest_of_all_runs(done):
    item = done.arrays[1]
    peaks = [max(run.prd_m for run in slides(motion, stated(2.0, 0.45))) for motion in SEVEN]
    assert [run.governing.result.prd_m for run in item.motions] == peaks
    assert item.analysis.mean_m == pytest.approx(sum(peaks) / 7)
    assert item.analysis.value_m == pytest.approx(1.1 * sum(peaks) / 7)
    assert item.worst.governing.result.prd_m == max(peaks)
    assert item.variation == pytest.approx(statistics.stdev(peaks) / statistics.mean(peaks))
    item = done.arrays[2]
    by_motion = [slides(motion, stated(3.0, 0.55)) for motion in SEVEN]
    for direction, name in (
        ("downslope", "down_m"),
        ("upslope", "up_m"),
        ("cross-slope", "across_m"),
    ):
        peaks = [max(getattr(r, name) for r in results) for results in by_motion]
        assert [m.peak_m(Direction(direction)) for m in item.motions] == peaks


def test_the_floor_governs_unless_reviewed_and_friction_by_speed_is_solved():
    law = {"mu_fast": 0.5, "mu_rate_s_per_m": 20.0}
    by_speed, constant = (
        alone(SHORT, arrays=[projects.array("A1", 2.0, mu=0.4, **given)]).arrays[0]
        for given in (law, {})
    )
    models = {run.solution.model for motion in by_speed.motions for run in motion.runs}
    assert models == {Model.SPEED_FRICTION}
    assert by_speed.analysis.mean_m < constant.analysis.mean_m
    for reviewed, governs in ((False, "floor"), (True, "analysis")):
        item = assessed(RESTING, options=project_parts.REVIEW | {"peer_reviewed": reviewed}).arrays[
            0
        ]
        assert item.governs == governs
        assert item.design_m == (0.0 if reviewed else 0.5 * item.prescriptive.value_m)


@pytest.mark.parametrize(
    ("changes", "names"),
    [({"signs": (-1,)}, ["record −", "transverse −"]),
     ({"ay_mps2": np.empty(0)}, ["record +", "record −"])],
    ids=["a fixed polarity", "no transverse component"],
)  # fmt: skip
def test_only_the_headings_that_a_motion_has_are_run(changes, names):
    done = alone((replace(SHORT[0], **changes),) * 3)
    assert [run.orientation.name for run in done.arrays[0].motions[0].runs] == names


def test_swapping_the_horizontal_components_changes_names_alone():
    swapped = [replace(m, ax_mps2=m.ay_mps2, ay_mps2=m.ax_mps2) for m in SHORT]
    first, other = assessed(SHORT), assessed(swapped)
    for a, b in zip(first.arrays[1].motions, other.arrays[1].motions, strict=True):
        assert a.governing.result == b.governing.result
        assert a.governing.orientation.is_transverse is not b.governing.orientation.is_transverse
        assert np.array_equal(a.history().u_m, b.history().u_m)
        assert a.history().result == a.governing.result


def test_uplift_withholds_the_displacement_and_fails_every_clearance():
    done = assessed((*SEVEN[:6], projects.lifting()))
    item = done.arrays[0]
    assert item.worst.motion.id == "UP"
    assert item.worst.governing.result.status is Status.UPLIFT
    assert math.isnan(item.design_m)
    assert item.governs == "none"
    assert not any(gap.ok for gap in done.clearances)
    assert not done.verdict.is_permitted
    assert any(
        "normal force falls below zero, from " in check.found and not check.is_satisfied
        for check in done.checks
        if check.id == "runs"
    )


@pytest.mark.parametrize("status", [one for one in Status if one is not Status.OK])
def test_a_run_without_a_final_displacement_withholds_that_of_its_array(done, status):
    first, *others = done.arrays[0].motions
    run, *rest = first.runs
    result = replace(run.result, status=status)
    lost = replace(run, solution=replace(run.solution, result=result))
    runs = (motion_run(first.motion, [lost, *rest]), *others)
    item = assess_array(done.project, done.rules, done.arrays[0].array, runs, motions_qualify=True)
    assert item.worst.governing is lost
    assert math.isnan(item.design_m)
    (check,) = run_checks(item, us_first=True)
    assert (check.verdict, check.note) == (Verdict.NG, "M1")
    assert check.found.startswith(f"1 of {len(item.runs)} runs: {status.sentence.split(':')[0]}")


@pytest.mark.quick
def test_two_motions_are_too_few_and_without_either_route_there_is_no_value():
    item = assessed(SEVEN[:2]).arrays[0]
    assert item.analysis.basis is Basis.TOO_FEW
    assert item.governs is DesignBasis.PRESCRIPTIVE
    assert item.design_m == item.prescriptive.value_m
    done = alone(SEVEN[:2], arrays=STEEP)
    assert done.arrays[0].governs is DesignBasis.NO_VALUE
    assert done.array_verdict(done.arrays[0]) is Verdict.NG
    assert math.isnan(alone(SEVEN[:1]).arrays[0].variation)


def test_too_few_motions_are_never_ok_and_runs_bound_the_prescriptive_route():
    done = alone(SEVEN[:5], arrays=STEEP, options={"statistic": "mean"})
    assert math.isnan(done.arrays[0].design_m)
    assert not done.verdict.is_permitted
    done = alone(assessments.motions(2, 30.0, peak_g=6.0, vertical_peak_g=0.1))
    for item in done.arrays:
        largest = max(run.governing.prd_m for run in item.motions)
        assert item.design_m == max(item.prescriptive.value_m, largest)
    assert any(item.design_m > item.prescriptive.value_m for item in done.arrays)


def test_runs_that_never_stop_are_one_sentence_with_their_count_and_us_speed():
    cut = [projects.motion(f"CUT{k}", CUT, signs=(1,)) for k in range(11)]
    arrays = [projects.array("A1", 0.0), projects.array("A2", 0.0, x=120)]
    (found,) = (check for check in alone(cut, arrays=arrays).open if check.id == "runs")
    # From rest, (12 - 0.45 g) m/s2 over 99 whole intervals of 0.01 s, and half the first.
    speed = (12.0 - 0.45 * 9.80665) * 0.99
    assert (found.subject, found.note, found.limit) == ("A1, A2", "", "all")
    found = re.fullmatch(
        r"11 of 11 runs: still sliding at the end of the record, at (\d+\.\d\d) in/s "
        r"\(\d+\.\d mm/s\); CUT0 to CUT10",
        spaced(found.found),
    )
    assert float(found[1]) * 0.0254 == pytest.approx(speed, rel=0.01)


def test_arrays_of_one_slope_friction_and_model_share_their_runs(monkeypatch):
    solved = []
    solve = model_selection.solve
    monkeypatch.setattr(model_selection, "solve", lambda *call: solved.append(call) or solve(*call))

    def found(*rows):
        solved.clear()
        gaps = [projects.clearance(row["id"], "RTU-1", 7 * projects.FOOT) for row in rows]
        data = projects.project(arrays=list(rows), clearances=gaps, options=PEER)
        return projects.assess_input(data, SHORT)

    def runs_of(assessment):
        support(assessment)
        return len(solved)

    one, other = projects.array("A1", 1.0, x=0), projects.array("A2", 1.0, x=120)
    turned = other | {"downslope_deg": 90.0, "weight_n": 1e4}
    both = found(one, turned)
    first, second = both.arrays
    assert first.motions == second.motions
    assert runs_of(both) == runs_of(found(one))
    for changes in ({"mu": 0.44}, {"slope_value": 3.9}, {"mu_fast": 0.5}):
        apart, (single,) = found(one, other | changes), found(other | changes).arrays
        assert apart.arrays[1].design_m == single.design_m


@pytest.mark.quick
def test_a_project_that_is_not_there_is_an_input_error_in_python(tmp_path):
    with pytest.raises(InputError, match="no such file; use a workbook"):
        assess_project(tmp_path / "gone.xlsx")
