"""From records to motions as run: processing, scaling, the building response, and the targets."""

import math
import pickle
from dataclasses import replace

import numpy as np
import pytest

import stand_in
from report.motions.components import Components, processing_of
from report.motions.history import ac156, first_period_s, shake, targets
from report.sheet.schema.choices import RecordedAt
from report.sheet.schema.motions import MotionInput
from solver.building.roof import shaking_to_roof
from solver.building.structure import building_of_periods
from solver.records.measures import measures
from solver.records.processing import Processing, process
from solver.records.record import Record
from solver.records.spectrum import response_spectrum
from solver.rules.hazard import EDITIONS, Tail, ac156_horizontal, ac156_vertical

pytestmark = pytest.mark.quick

G = 9.80665
GROUND = {"recorded_at": "ground"}


def row(**changes):
    return {"id": "M1", "record": "x", "transverse": "y", "vertical": "z"} | changes


FIELDS = ("record", "transverse", "vertical")


def components(motion):
    return (motion.ax_mps2, motion.ay_mps2, motion.az_mps2)


def records(count=3, seconds=6.0):
    """Components of one motion, by the fields of the sheet."""
    (given,) = stand_in.motions(1, seconds=seconds, peak_g=0.6)
    return {
        field: Record(name=field, dt_s=given.dt_s, a_mps2=a)
        for field, a in zip(FIELDS[:count], components(given), strict=False)
    }


def shaken(records, data_changes=None, unfiltered=None, **changes):
    data = stand_in.project(motions=[row(**changes)], **(data_changes or {}))
    given = Components(files=(), records=records, unfiltered=unfiltered or {}, whole={})
    (pair,) = shake(data, [given])
    return pair


def test_a_roof_motion_is_as_recorded_or_scaled_to_its_peak_with_its_drift():
    given = records()
    motion, prepared = shaken(given)
    assert motion.scale == 1.0
    for a, record in zip(components(motion), given.values(), strict=True):
        assert np.array_equal(a, record.a_mps2)
    assert (prepared.done, prepared.scaling, prepared.roof) == ("as recorded", "as recorded", {})
    motion, prepared = shaken(records(), scaling="PPA", scale_value=1.25)
    assert motion.scale * np.abs(motion.ax_mps2).max() == pytest.approx(1.25 * G, rel=1e-12)
    assert prepared.scaling == "PPA 1.25 g"
    assert prepared.scaled["vertical"].a_mps2 == pytest.approx(motion.scale * motion.az_mps2)
    drifting = {f: replace(r, a_mps2=r.a_mps2 + 0.02) for f, r in records().items()}
    _, prepared = shaken(drifting, scaling="factor", scale_value=2.0)
    scaled = replace(drifting["record"], a_mps2=2.0 * drifting["record"].a_mps2)
    assert prepared.measures["horizontal"] == measures(scaled)


def log_ratio(motion, target, periods_s):
    """Mean of ln(spectrum / target) of the geometric mean of both horizontal components."""
    logs = [
        np.log(response_spectrum(motion.scale * a, motion.dt_s, periods_s) / G)
        for a in (motion.ax_mps2, motion.ay_mps2)
    ]
    return float((np.mean(logs, axis=0) - np.log(target.at(1 / periods_s))).mean())


@pytest.mark.parametrize(("start", "end"), [(0.2, 5.0), (0.5, 2.0)])
def test_a_motion_scaled_to_the_target_matches_it_over_the_scaling_periods(start, end):
    data = {"target": {"from_s": start, "to_s": end}}
    motion, prepared = shaken(records(), data, scaling="target spectrum")
    target = stand_in.assessed(stand_in.book(shaking=(motion,) * 3)).targets.roof
    assert log_ratio(motion, target, np.geomspace(start, end, 400)) == pytest.approx(0, abs=2e-3)
    assert prepared.scaling == f"target, {start:g} to {end:g} s"


def test_a_ground_motion_goes_through_the_building_scaled_where_it_was_recorded():
    given = records()
    building = {"period_s": 0.62, "transverse_s": 0.5, "damping_percent": 3.0}
    motion, prepared = shaken(given, {"building": building}, **GROUND)
    buildings = [building_of_periods([t], damping=(0.03,), stories=1) for t in (0.62, 0.5)]
    wanted = shaking_to_roof(
        [given["record"].a_mps2, given["transverse"].a_mps2],
        given["vertical"].a_mps2,
        given["record"].dt_s,
        buildings,
    )
    assert motion.dt_s == wanted.dt_s
    across = [roof.a_mps2 for roof in wanted.horizontal]
    for a, other in zip(components(motion), (*across, wanted.vertical_mps2), strict=True):
        assert np.array_equal(a, other)
    assert list(prepared.roof) == ["horizontal", "transverse"]
    given = records()
    building = {"building": {"period_s": 0.62}}
    motion, prepared = shaken(given, building, scaling="PPA", scale_value=0.5, **GROUND)
    peak = np.abs(given["record"].a_mps2).max()
    assert motion.scale * peak == pytest.approx(0.5 * G)
    assert prepared.measures["horizontal"].pga_mps2 == pytest.approx(0.5 * G)
    assert prepared.roof["horizontal"].ground_peak_mps2 == pytest.approx(peak)
    motion, _ = shaken(records(1), {"building": {"period_s": 0.4}}, **GROUND)
    assert (motion.has_transverse, motion.has_vertical) == (False, False)


def test_processing_and_the_period_follow_their_cells():
    height_ft = 36.0
    for building, period in (
        ({"period_s": 0.7, "structure": "other"}, 0.7),
        ({"structure": "other"}, 0.02 * height_ft**0.75),
        ({"structure": "steel moment frame"}, 0.028 * height_ft**0.8),
    ):
        assert first_period_s(stand_in.project(building=building)) == pytest.approx(period)
    assert math.isnan(first_period_s(stand_in.project()))
    asked = {"from_s": 1.0, "to_s": 5.0, "highpass_hz": 0.2, "lowpass_hz": 20.0, "order": 6}
    asked |= {"pad_s": 3.0}
    typed = MotionInput(**row(**asked, baseline="quadratic", new_dt_s=0.0025))
    assert processing_of(typed) == Processing(**asked, baseline=2, dt_s=0.0025)
    degrees = {"none": -1, "mean": 0, "linear": 1, "quadratic": 2, "cubic": 3}
    for name, degree in degrees.items():
        assert processing_of(MotionInput(**row(baseline=name))).baseline == degree
    record = records()["record"]
    assert processing_of(MotionInput(**row())) == Processing()
    assert np.array_equal(process(record, Processing()).a_mps2, record.a_mps2)


def test_the_motion_without_its_high_pass_has_the_same_factor():
    given = records()
    cut = {field: replace(r, a_mps2=0.5 * r.a_mps2) for field, r in given.items()}
    motion, prepared = shaken(cut, None, given, scaling="PPA", scale_value=1.0, highpass_hz=0.2)
    (bare,) = prepared.unfiltered
    assert bare.scale == motion.scale
    assert np.array_equal(bare.ax_mps2, given["record"].a_mps2)


POINTS = [(0.05, 1.0, 0.5), (0.5, 2.0, 0.8), (4.0, 0.2, 0.1)]
PERIODS = np.array([0.04, 0.05, 0.3, 0.5, 1.0, 4.0, 5.0])


ON_GROUND = [{"id": "M1", "record": "records/m1-x.csv", "recorded_at": "ground"}]


def made(**changes):
    return targets(stand_in.project(**{"spectrum": []} | changes))


def own(*, with_vertical=True):
    return [
        {"period_s": t, "horizontal_g": h, "vertical_g": v if with_vertical else None}
        for t, h, v in reversed(POINTS)
    ]


def across_of(tail):
    return ac156_horizontal(EDITIONS["ASCE 7-16"], s_ds_g=1.566, z_over_h=1.0, **tail)


def test_the_target_at_the_roof_has_the_tail_of_the_sheet():
    goals, across = made(), across_of({})
    upward = ac156_vertical(s_ds_g=1.566)
    inside = PERIODS[PERIODS <= 10.0]
    assert goals.roof.name == "AC156"
    assert np.array_equal(goals.roof.ordinates(inside), across.at(1 / inside))
    assert np.array_equal(goals.vertical.ordinates(inside), upward.at(1 / inside))
    data = stand_in.project(target={"tail": "1/T"}, spectrum=[])
    wanted = across_of({"tail": Tail.RECIPROCAL})
    assert np.array_equal(ac156(data)[0].sa_g, wanted.sa_g)
    assert np.array_equal(targets(data).roof.at(np.array([0.2])), wanted.at(np.array([0.2])))


def test_the_project_spectrum_applies_at_the_roof_or_at_the_ground():
    goals = made(spectrum=own())
    assert goals.roof.name == goals.vertical.name == "project-specific"
    for t, across, upward in POINTS:
        assert goals.roof.ordinates(np.array([t])) == pytest.approx([across])
        assert goals.vertical.ordinates(np.array([t])) == pytest.approx([upward])
    # Interpolated on log-log axes, and undefined beyond.
    middle = math.sqrt(0.5 * 4.0)
    assert goals.roof.ordinates(np.array([middle])) == pytest.approx([math.sqrt(2.0 * 0.2)])
    assert np.isnan(goals.roof.ordinates(PERIODS)).tolist() == [True, *[False] * 5, True]
    goals = made(spectrum=own(with_vertical=False))
    assert (goals.roof.name, goals.vertical.name) == ("project-specific", "AC156")
    goals = made(spectrum=own(), motions=ON_GROUND)
    assert (goals.roof.name, goals.ground.name) == ("AC156", "project-specific")
    assert goals.horizontal(RecordedAt.GROUND) is goals.ground
    assert goals.horizontal(RecordedAt.ROOF) is goals.roof


def test_on_the_ground_the_target_is_the_design_spectrum_where_t_l_is_given():
    ground = made(motions=ON_GROUND, target={"t_l_s": 8.0}).ground
    s_d1 = 2.0 / 3.0 * 1.7 * 0.70
    wanted = [1.566, s_d1 / 2.0, s_d1 * 8.0 / 10.0**2]
    assert ground.ordinates(np.array([0.3, 2.0, 10.0])) == pytest.approx(wanted)
    assert ground.name == "ASCE 7 design spectrum"
    ground = made(motions=ON_GROUND).ground
    assert ground.name == ""
    assert np.isnan(ground.ordinates(PERIODS)).all()


@pytest.mark.parametrize("changes", [{}, {"target": {"t_l_s": 8.0}}, {"spectrum": own()}])
def test_targets_can_be_pickled(changes):
    goals = made(motions=ON_GROUND, **changes)
    handed = pickle.loads(pickle.dumps(goals))
    for name in ("roof", "vertical", "ground"):
        here, there = getattr(goals, name), getattr(handed, name)
        assert np.array_equal(here.ordinates(PERIODS), there.ordinates(PERIODS), equal_nan=True)
