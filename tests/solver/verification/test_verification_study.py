"""What the studies share, checks of the models, and model against model."""

import math
import shutil
from dataclasses import replace

import numpy as np
import pytest

from fixtures.blocks import readonly
from fixtures.paths import RECORDS, SAMPLES
from solver.model import STANDARD_GRAVITY_MPS2, HorizontalComponent, Orientation, coulomb
from solver.records.record import read_only
from solver.sliding import one_axis, two_axes
from solver.sliding.checked import motion, slide
from solver.verification import model_checks, model_study, study_cases, verification_motions
from solver.verification.evidence import (
    HELD,
    LEAST_M,
    OVER_SLOW,
    OVER_STATIC,
    SECOND,
    SECTIONS,
    SOFT,
    STIFF,
    WORST,
    ModelChange,
)
from solver.verification.study_cases import AS_RECORDED, Case
from solver.verification.verification_motions import (
    near_fault_pulse,
    own_triples,
    scale_to,
    shortened,
    triple_scale,
)

X, Y, Z = map(readonly, ([0, 6, -6, 0], [0, 1, 2, 0], [0, 1, -1, 0]))
MADE = motion(X, Y, Z, dt_s=0.1, id="made")


@pytest.mark.quick
def test_scenes_are_those_of_each_motion_in_turn_scaled_to_the_case():
    turned = Orientation(component=HorizontalComponent.TRANSVERSE, polarity=-1)
    scenes = study_cases.scenes_of([MADE], study_cases.MODEL_CASES, (AS_RECORDED, turned))
    assert [scene.friction.mu_slow for scene in scenes] == [0.3, 0.4, 0.5] * 2
    assert scenes[0].ax_mps2.tolist() == X.tolist()
    assert scenes[3].ax_mps2.tolist() == (-Y).tolist()
    assert scenes[3].ay_mps2.tolist() == X.tolist()
    assert scenes[2].scale == scenes[5].scale == pytest.approx(1.5 * 9.80665 / 6.0)
    (scene,) = study_cases.scenes_of([MADE], study_cases.MODEL_CASES[:1])
    assert study_cases.faded(scene, 0.5).ay_mps2.tolist() == [0.0, 0.5, 1.0, 0.0]
    assert study_cases.faded(scene, 0.0).ay_mps2.size == 0
    wanted = (0.0, 0.3, 0.5), (0.0, 0.3, 1.0), (2.0, 0.3, 0.5), (2.0, 0.3, 1.0)
    found = study_cases.grid((0.0, 2.0), (0.3,), (0.5, 1.0))
    assert found == tuple(Case(*values) for values in wanted)


@pytest.mark.quick
def test_runs_are_those_of_a_slide_and_of_the_law_of_their_own_friction():
    push = np.array([0.0, 5.0, -5.0, 0.0])
    half, whole, double = (
        study_cases.flat_scene(push, 0.0 * push, 0.1, coulomb(mu)) for mu in (0.05, 0.1, 0.2)
    )
    halved = study_cases.plane_prds(
        [whole, double], lambda mu: coulomb(0.5 * mu), study_cases.TIGHT
    )
    by_hand = [one_axis.run(scene).prd_m for scene in (half, whole)]
    assert halved == pytest.approx(by_hand, rel=1e-9)
    assert halved[0] > halved[1] > 0.0
    record, case = shortened(near_fault_pulse(), 2.0), Case(4.0, 0.2, 0.5)
    by = {"method": "paper", "substeps": 4}
    place = {"slope_rad": math.radians(4.0), "mu": 0.2, "scale": scale_to(record, 0.5)}
    direct = slide(record.a_mps2, record.dt_s, **place, **by)
    assert direct.prd_m > 0.0
    assert study_cases.run(record, case, **by).prd_m == direct.prd_m
    assert study_cases.history(record, case, **by).u_m[-1] == direct.residual_m
    assert study_cases.run(record, case).prd_m == study_cases.run(record, case, "exact").prd_m


@pytest.mark.quick
def test_a_long_run_is_timed_once_and_the_least_of_the_repeats_of_a_short_one_counts(monkeypatch):
    calls, ticks = [], iter([0.0, 3.0])
    monkeypatch.setattr(study_cases, "CLOCK", lambda: next(ticks))
    assert study_cases.processor_seconds(lambda: calls.append(0)) == 3.0
    assert len(calls) == 1
    ticks = iter([0.0, 0.01, 1.0, 1.03, 2.0, 2.02, 3.0, 3.04, 4.0, 4.05, 5.0, 5.06])
    assert study_cases.processor_seconds(lambda: calls.append(0)) == pytest.approx(0.02)
    assert len(calls) == 1 + 1 + study_cases.REPEATS


@pytest.mark.quick
def test_the_best_point_is_the_first_of_the_least():
    assert study_cases.best_of(lambda x: (x - 1) ** 2, [3, 2, 0, 5]) == (1, 2)


# Motions of three components


@pytest.fixture(scope="module")
def own():
    (only,) = verification_motions.own_triples(True)
    return only


@pytest.mark.quick
def test_own_and_recorded_motions_have_one_factor_and_a_part_is_the_strongest(own, tmp_path):
    assert np.shares_memory(own.ax_mps2, verification_motions.own_records(True)[0].a_mps2)
    assert own.source != verification_motions.RECORDED
    assert not np.array_equal(own.ax_mps2, own.ay_mps2)
    scale = verification_motions.triple_scale(own, 0.5)
    peaks = [np.abs(a).max() * scale for a in (own.ax_mps2, own.ay_mps2)]
    assert max(peaks) == pytest.approx(0.5 * 9.80665)
    part = verification_motions.cut(own, 101)
    assert part.ax_mps2.size == part.ay_mps2.size == part.az_mps2.size == 101
    assert not part.ax_mps2.flags.writeable
    energy = np.sum(part.ax_mps2**2 + part.ay_mps2**2)
    assert energy >= np.sum((own.ax_mps2**2 + own.ay_mps2**2)[:101])
    (tmp_path / "below").mkdir()
    for path in SAMPLES.iterdir():
        shutil.copy(path, tmp_path / "below" / path.name)
    (tmp_path / "notes.txt").write_text("no motion")
    triples = verification_motions.recorded_triples(tmp_path)
    assert triples
    assert all(triple.source == verification_motions.RECORDED for triple in triples)
    assert all(
        triple.ax_mps2.size == triple.ay_mps2.size == triple.az_mps2.size for triple in triples
    )


def test_the_vertical_is_told_by_its_name_wherever_it_stands():
    if not RECORDS.is_dir():
        pytest.skip("the real records are not here")
    triples = {triple.id: triple for triple in verification_motions.recorded_triples(RECORDS)}
    assert np.abs(triples["20161113_110259_WTMC_20"].az_mps2).max() == pytest.approx(
        18.02, abs=0.01
    )
    assert np.abs(triples["llolleo1002271"].az_mps2).max() == pytest.approx(6.88, abs=0.01)


@pytest.fixture(scope="module")
def rows():
    return list(model_checks.model_checks(own_triples(True), quick=True))


def test_every_check_passes_each_model_is_chosen_and_every_tolerance_met(rows):
    assert len(rows) >= 25
    assert [row for row in rows if not row.passed] == []
    assert {row.section for row in rows} == {SECTIONS["TA"]}
    assert [row.computed for row in rows if row.quantity == "Model chosen"] == [0, 1, 2, 3, 4]
    met = [row for row in rows if row.problem.startswith("Tolerance of")]
    assert [row.tolerance for row in met] == [1e-4, 1e-6, 1e-8, 1e-10]
    assert all(0.0 < row.computed <= row.tolerance for row in met)


def test_a_solver_that_is_off_by_a_millionth_fails(monkeypatch):
    true = two_axes.run

    def off(*args):
        result = true(*args)
        return replace(result, prd_m=result.prd_m * (1.0 + 1e-6))

    monkeypatch.setattr(two_axes, "run", off)
    failed = [
        row for row in model_checks.model_checks(own_triples(True), quick=True) if not row.passed
    ]
    assert any(row.problem.startswith("No cross-slope") for row in failed)
    assert any(row.problem.startswith("One component rotated") for row in failed)


def test_a_motion_whose_vertical_lifts_the_block_is_left_out():
    (triple,) = own_triples(True)
    lifting = replace(triple, id="lifting", az_mps2=read_only(9.0 * triple.az_mps2))
    rows = model_checks.model_checks((triple, lifting), quick=True)
    assert not any("lifting" in row.problem for row in rows)


@pytest.fixture(scope="module")
def compared():
    return model_study.study(own_triples(True), quick=True)


def test_every_run_is_counted_and_a_ratio_is_that_of_two_slides(compared):
    assert compared.n_runs == 2 * 2 * 2 * 4
    for change in compared.changes[:8]:
        is_worst = change.name == WORST  # of a motion, not of a run
        count = compared.n_runs // 4 if is_worst else compared.n_runs - compared.n_uplift
        assert change.ratios.size + change.n_small == count
        assert np.all(np.diff(change.ratios) >= 0.0)
    (triple,) = own_triples(True)
    scene = {"slope_rad": 0.0, "mu": 0.3, "scale": triple_scale(triple, 1.5)}
    alone = slide(triple.ax_mps2, triple.dt_s, az_mps2=triple.az_mps2, **scene)
    both = slide(triple, **scene)
    assert min(alone.prd_m, both.prd_m) > LEAST_M
    ratio = both.prd_m / alone.prd_m
    assert np.abs(compared.named(SECOND).ratios - ratio).min() == pytest.approx(0.0, abs=1e-9)


@pytest.mark.quick
def test_models_differ_as_they_should(compared):
    """One axis underestimates, friction at rest changes little, stiff rows move as rigid arrays."""
    assert min(compared.named(name).median for name in (SECOND, WORST)) > 1.0
    assert compared.named(OVER_SLOW).median < 1.0
    assert compared.largest_error <= 1e-6
    held, over_static = compared.named(HELD), compared.named(OVER_STATIC)
    assert held.ratios.size + held.n_small == compared.n_runs
    assert abs(held.median - 1.0) < 0.1
    assert over_static.median > 1.5
    stiff, soft = compared.named(STIFF), compared.named(SOFT)
    assert stiff.ratios.size + stiff.n_small == compared.n_runs // 8
    assert 1.0 < stiff.median < 1.1
    assert 1.0 < soft.median < 1.1
    assert model_study.row_of(0.4, 1e-3, 9.81).mean_mu == pytest.approx(0.4)
    change = ModelChange(name="x", ratios=np.array([0.5, 1.5, 2.0]), n_small=0, maximum_m=0.0)
    assert (change.median, change.at(0.0), change.at(100.0)) == (1.5, 0.5, 2.0)
    assert change.share_above_one == pytest.approx(2.0 / 3.0)


@pytest.mark.quick
def test_lifted_runs_are_counted_and_not_compared():
    (triple,) = own_triples(True)
    lifting = replace(triple, az_mps2=read_only(20.0 * triple.az_mps2))
    compared = model_study.study((lifting,), quick=True)
    assert compared.n_uplift == compared.n_runs
    assert all(change.ratios.size == 0 and math.isnan(change.median) for change in compared.changes)
    assert math.isnan(compared.largest_error)


@pytest.mark.quick
def test_a_push_between_kinetic_and_static_holds_in_one_axis_alone():
    pushed = model_study.pushed()
    alone_m, faint_m, *pushed_m = pushed["end_m"]
    # v falls from its speed at 0.06 s with the push and friction: v^2 / 2a, before that a ramp.
    scene = model_study.pushed_scene(0.0, model_study.JUMPING)
    history = two_axes.run_history(scene)
    braking = (model_study.PUSHED_BACK_G + 0.4) * STANDARD_GRAVITY_MPS2
    stops = history.u_m[6] + history.v_mps[6] ** 2 / (2.0 * braking)
    assert [alone_m, faint_m] == pytest.approx([stops] * 2, rel=1e-9)
    assert min(pushed_m) > 50.0 * alone_m
    # What two tolerances do not agree on is told.
    assert pushed["error_m"].iloc[2] > pushed_m[0]
    falling = pushed["falling_end_m"].tolist()
    assert falling == pytest.approx([falling[0]] * len(falling), rel=1e-3)
    assert one_axis.run(model_study.pushed_scene(0.0, coulomb(0.4))).prd_m > 0.5
