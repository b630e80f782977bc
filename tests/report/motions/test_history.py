"""From records to motions as run: bounds, doubles, spikes, scaling, the building, the targets."""

import math
import pickle
from dataclasses import replace

import numpy as np
import pytest

from fixtures import projects
from fixtures.marks import by_day
from fixtures.project_parts import motion
from fixtures.spaces import spaced
from fixtures.workbooks import cell_address, make, problems, read_workbook
from report.motions.components import FACTOR, Components, processing_of, spikes
from report.motions.history import ac156, first_period_s, shake, targets
from report.motions.prepare import MAX_BESIDE_FAULTS, MAX_TOGETHER, MOST_FAULTS
from report.project.model.choices import RecordedAt
from report.project.model.motion_input import MotionInput
from solver.building.roof import shaking_to_roof
from solver.building.structure import building_of_periods
from solver.records.measures import measures
from solver.records.processing import Processing
from solver.records.record import Record
from solver.records.spectrum import response_spectrum
from solver.rules.ac156 import Tail, ac156_horizontal, ac156_vertical
from solver.rules.hazard import EDITIONS

G = 9.80665
GROUND = {"recorded_at": "ground"}


def row(**changes):
    return {"id": "M1", "record": "x", "transverse": "y", "vertical": "z"} | changes


def components(motion):
    return (motion.ax_mps2, motion.ay_mps2, motion.az_mps2)


def records(count=3, seconds=6.0):
    """Components of one motion, by the fields of the sheet."""
    (given,) = projects.motions(1, seconds=seconds, peak_g=0.6)
    fields = ("record", "transverse", "vertical")[:count]
    return {
        field: Record(name=field, dt_s=given.dt_s, a_mps2=a)
        for field, a in zip(fields, components(given), strict=False)
    }


def shaken(records, data_changes=None, unfiltered=None, **changes):
    data = projects.project(motions=[row(**changes)], **(data_changes or {}))
    given = Components(files=(), records=records, unfiltered=unfiltered or {}, whole={})
    (pair,) = shake(data, [given])
    return pair


@pytest.mark.quick
def test_a_roof_motion_is_as_recorded_or_scaled_to_its_peak_with_its_drift_and_unfiltered():
    given = records()
    motion, prepared = shaken(given)
    assert motion.scale == 1.0
    for a, record in zip(components(motion), given.values(), strict=True):
        assert np.array_equal(a, record.a_mps2)
    assert (prepared.done, prepared.scaling, prepared.roof) == ("as recorded", "as recorded", {})
    motion, prepared = shaken(records(), scaling="PPA", scale_value=1.25)
    assert motion.scale * np.abs(motion.ax_mps2).max() == pytest.approx(1.25 * G, rel=1e-12)
    assert spaced(prepared.scaling) == "PPA 1.25 g"
    assert prepared.scaled["vertical"].a_mps2 == pytest.approx(motion.scale * motion.az_mps2)
    drifting = {f: replace(r, a_mps2=r.a_mps2 + 0.02) for f, r in records().items()}
    _, prepared = shaken(drifting, scaling="factor", scale_value=2.0)
    scaled = replace(drifting["record"], a_mps2=2.0 * drifting["record"].a_mps2)
    assert prepared.measures["horizontal"] == measures(scaled)
    given = records()
    cut = {field: replace(r, a_mps2=0.5 * r.a_mps2) for field, r in given.items()}
    motion, prepared = shaken(cut, None, given, scaling="PPA", scale_value=1.0, highpass_hz=0.2)
    (bare,) = prepared.unfiltered
    assert bare.scale == motion.scale
    assert np.array_equal(bare.ax_mps2, given["record"].a_mps2)


def log_ratio(motion, target, periods_s):
    """Mean of ln(spectrum / target) of the geometric mean of both horizontal components."""
    logs = [
        np.log(response_spectrum(motion.scale * a, motion.dt_s, periods_s) / G)
        for a in (motion.ax_mps2, motion.ay_mps2)
    ]
    return float((np.mean(logs, axis=0) - np.log(target.at(1 / periods_s))).mean())


@pytest.mark.quick
@pytest.mark.parametrize(("start", "end"), [(0.2, 5.0), (0.5, 2.0)])
def test_a_motion_scaled_to_the_target_matches_it_over_the_scaling_periods(start, end):
    data = {"target": {"from_s": start, "to_s": end}}
    motion, prepared = shaken(records(), data, scaling="target spectrum")
    target = projects.assessed(projects.book(shaking=(motion,) * 3)).targets.roof
    assert log_ratio(motion, target, np.geomspace(start, end, 400)) == pytest.approx(0, abs=2e-3)
    assert spaced(prepared.scaling) == f"target, {start:g} to {end:g} s"


@pytest.mark.quick
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


@pytest.mark.quick
def test_processing_and_the_period_follow_their_cells():
    height_ft = 36.0
    for building, period in (
        ({"period_s": 0.7, "structure": "other"}, 0.7),
        ({"structure": "other"}, 0.02 * height_ft**0.75),
        ({"structure": "steel moment frame"}, 0.028 * height_ft**0.8),
    ):
        assert first_period_s(projects.project(building=building)) == pytest.approx(period)
    assert math.isnan(first_period_s(projects.project()))
    asked = {"from_s": 1.0, "to_s": 5.0, "highpass_hz": 0.2, "lowpass_hz": 20.0, "order": 6}
    asked |= {"pad_s": 3.0}
    typed = MotionInput(**row(**asked, baseline="quadratic", new_dt_s=0.0025))
    assert processing_of(typed) == Processing(**asked, baseline=2, dt_s=0.0025)
    degrees = {"none": -1, "mean": 0, "linear": 1, "quadratic": 2, "cubic": 3}
    for name, degree in degrees.items():
        assert processing_of(MotionInput(**row(baseline=name))).baseline == degree
    assert processing_of(MotionInput(**row())) == Processing()


POINTS = [(0.05, 1.0, 0.5), (0.5, 2.0, 0.8), (4.0, 0.2, 0.1)]
PERIODS = np.array([0.04, 0.05, 0.3, 0.5, 1.0, 4.0, 5.0])


ON_GROUND = [{"id": "M1", "record": "records/m1-x.csv", "recorded_at": "ground"}]


def made(**changes):
    return targets(projects.project(**{"spectrum": []} | changes))


def own(*, with_vertical=True):
    return [
        {"period_s": t, "horizontal_g": h, "vertical_g": v if with_vertical else None}
        for t, h, v in reversed(POINTS)
    ]


def across_of(tail):
    return ac156_horizontal(EDITIONS["ASCE 7-16"], s_ds_g=1.566, z_over_h=1.0, **tail)


@pytest.mark.quick
def test_targets_at_the_roof_and_on_the_ground_are_those_of_code_and_project():
    goals, across = made(), across_of({})
    upward = ac156_vertical(s_ds_g=1.566)
    inside = PERIODS[PERIODS <= 10.0]
    assert goals.roof.name == "AC156"
    assert np.array_equal(goals.roof.ordinates(inside), across.at(1 / inside))
    assert np.array_equal(goals.vertical.ordinates(inside), upward.at(1 / inside))
    data = projects.project(target={"tail": "1/T"}, spectrum=[])
    wanted = across_of({"tail": Tail.RECIPROCAL})
    assert np.array_equal(ac156(data)[0].sa_g, wanted.sa_g)
    assert np.array_equal(targets(data).roof.at(np.array([0.2])), wanted.at(np.array([0.2])))
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
    ground = made(motions=ON_GROUND, target={"t_l_s": 8.0}).ground
    s_d1 = 2.0 / 3.0 * 1.7 * 0.70
    wanted = [1.566, s_d1 / 2.0, s_d1 * 8.0 / 10.0**2]
    assert ground.ordinates(np.array([0.3, 2.0, 10.0])) == pytest.approx(wanted)
    assert ground.name == "ASCE 7 design spectrum"
    ground = made(motions=ON_GROUND).ground
    assert ground.name == ""
    assert np.isnan(ground.ordinates(PERIODS)).all()


@pytest.mark.quick
@pytest.mark.parametrize("changes", [{}, {"target": {"t_l_s": 8.0}}, {"spectrum": own()}])
def test_targets_can_be_pickled(changes):
    goals = made(motions=ON_GROUND, **changes)
    handed = pickle.loads(pickle.dumps(goals))
    for name in ("roof", "vertical", "ground"):
        here, there = getattr(goals, name), getattr(handed, name)
        assert np.array_equal(here.ordinates(PERIODS), there.ordinates(PERIODS), equal_nan=True)


NO_TEXT = "not a text file; use text or CSV"
TOO_MUCH = (
    "the records up to this row exceed 64 MB in total; use fewer motions, or convert the records"
    " (roofslip motion convert --help)"
)


NOT_READ = "the records from here on were not read; first correct the rows above"


def grown(path, together, names):
    """What is reported once the last of these records, made no record, has them reach a size."""
    *before, last = (path.parent / "records" / f"{name}.csv" for name in names)
    with last.open("wb") as file:
        file.truncate(together - sum(other.stat().st_size for other in before))
    return problems(path)


def test_records_of_too_many_bytes_are_refused_by_cell_and_of_fewer_once_one_is_at_fault(tmp_path):
    path, names = make(tmp_path), ("x", "z", "x2", "x3")
    last = cell_address("<Motions/M3/Horizontal record>: ")
    read = (f"{last}horizontal record: x3.csv: {NO_TEXT}",)
    assert grown(path, MAX_TOGETHER, names) == read
    assert grown(path, MAX_TOGETHER + 1, names) == (last + TOO_MUCH,)
    path, names = make(tmp_path), ("x", "z", "x2")
    (path.parent / "records" / "x.csv").write_text("0.1\nabc\n0.2\n")
    wrong = cell_address(
        "<Motions/M1/Horizontal record>: horizontal record: x.csv:2: found 'abc'; enter a number"
    )
    read = cell_address(f"<Motions/M2/Horizontal record>: horizontal record: x2.csv: {NO_TEXT}")
    second, third = (cell_address(f"<Motions/M{k}/Horizontal record>: ") + NOT_READ for k in (2, 3))
    assert grown(path, MAX_BESIDE_FAULTS, names) == (wrong, read, third)
    assert grown(path, MAX_BESIDE_FAULTS + 1, names) == (wrong, second)


@pytest.mark.nightly
def test_of_many_motions_whose_records_are_missing_the_first_hundred_are_told(tmp_path):
    lost = [motion(f"M{k}", f"lost{k}") for k in range(2 * MOST_FAULTS)]
    *told, last = problems(make(tmp_path, motions=lost))
    assert len(told) == MOST_FAULTS + 1
    assert f"'records/lost{MOST_FAULTS}.csv' does not exist" in told[-1]
    assert last == f"Motions!C{8 + len(told)}: {NOT_READ}"


A = np.random.default_rng(7).normal(size=(4, 400)).round(5)


def book(folder, *motions, **records):
    """A workbook of motions, and of records in g at 0.01 s."""
    rows = [
        {"id": f"M{i}", "units": "g", "dt_s": 0.01, **motion}
        for i, motion in enumerate(motions, start=1)
    ]
    path = make(folder, motions=rows)
    for name, samples in records.items():
        text = "".join(f"{sample:.5f}\n" for sample in samples)
        (folder / "records" / f"{name}.csv").write_text(text)
    return path


def taking(x, y="", **others):
    transverse = {"transverse": f"records/{y}.csv"} if y else {}
    return {"record": f"records/{x}.csv", **transverse, **others}


AGAIN = (
    "<Motions/M2/Horizontal record>: horizontal record repeats the horizontal record at"
    " <Motions/M1/Horizontal record> (equal samples, apart from scale and sign): M2 is M1 again;"
    " enter each motion once"
)
TRANSVERSE = "record repeats the transverse record at <Motions/M1/Transverse record>"
CASES = {
    "the same file": (
        [taking("a", "b"), taking("a", "b", scaling="factor", scale_value=2.0)],
        {"a": A[0], "b": A[1]}, AGAIN),
    **{f"a copy under another name, times {factor}": (
        [taking(name) for name in "abc"], {"a": A[0], "b": A[1], "c": factor * A[0]},
        AGAIN.replace("M2", "M3")) for factor in (1.0, -0.37)},
    "swapped components": (
        [taking("a", "b"), taking("c", "d")], {"a": A[0], "b": A[1], "c": A[1], "d": A[0]},
        f"<Motions/M2/Horizontal record>: horizontal {TRANSVERSE}"),
    "one component in common": (
        [taking("a", "b"), taking("c", "b")], {"a": A[0], "b": A[1], "c": A[2]},
        f"<Motions/M2/Transverse record>: transverse {TRANSVERSE}"),
    "other filters": ([taking("a"), taking("a", highpass_hz=0.2)], {"a": A[0]}, AGAIN),
    "parts that overlap": (
        [taking("a", to_s=2.0), taking("a", from_s=1.9)], {"a": A[0]},
        AGAIN.partition(" at ")[0]),
}  # fmt: skip


@pytest.mark.parametrize("name", by_day(CASES, 1))
def test_a_motion_that_is_given_again_is_refused_with_both_cells(tmp_path, name):
    motions, records, line = CASES[name]
    (problem,) = problems(book(tmp_path, *motions, **records))
    assert problem.startswith(cell_address(line))


@pytest.mark.nightly
def test_zeros_a_vertical_in_common_and_parts_that_do_not_overlap_are_no_repetition(tmp_path):
    zeros = np.zeros(400)
    path = book(tmp_path, taking("a", "z"), taking("b", "z"), a=A[0], b=A[1], z=zeros)
    assert len(read_workbook(path).motions) == 2
    motions = [taking(name, vertical="records/z.csv") for name in "ab"]
    assert len(read_workbook(book(tmp_path, *motions, a=A[0], b=A[1], z=A[2])).motions) == 2
    first, second = taking("a", to_s=2.0), taking("a", from_s=2.0)
    assert len(read_workbook(book(tmp_path, first, second, a=A[0])).motions) == 2


def sine(count=1000):
    return np.sin(0.1 * np.arange(count))


@pytest.mark.quick
def test_only_few_samples_above_the_factor_are_spikes():
    assert spikes(sine())[0] == ()
    assert spikes(np.random.default_rng(1).normal(size=3000))[0] == ()
    assert spikes(np.zeros(1000)) == ((), 0.0)
    a = sine()
    a[100:111] = 99.99
    assert spikes(a)[0] == ()
    assert spikes(np.array([*np.ones(98), 99.99]))[0] == ()
    assert spikes(np.array([*np.ones(99), 99.99])) == ((99,), 1.0)
    assert spikes(np.array([*np.ones(99), FACTOR]))[0] == ()
    assert spikes(np.array([*np.ones(99), np.nextafter(FACTOR, 9.0)]))[0] == (99,)


@pytest.mark.quick
@pytest.mark.parametrize("at", [(0,), (999,), (3, 500), tuple(range(100, 110))])
def test_spikes_of_either_sign_are_found(at):
    a = sine()
    a[list(at)] = [99.99 * (-1) ** i for i in at]
    others = np.delete(a, at)
    assert spikes(a) == (at, float(np.abs(others).max()))
