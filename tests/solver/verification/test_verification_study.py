"""What the studies share: combinations, scenes, runs, times, misfits, and motions of three axes."""

import math
import shutil

import numpy as np
import pytest

from blocks import readonly
from places import RECORDS, SAMPLES
from solver.model import HorizontalComponent, Orientation, coulomb
from solver.sliding import one_axis
from solver.sliding.checked import motion, slide
from solver.verification import study
from solver.verification.study import AS_RECORDED, Case, near_fault_pulse, scale_to, shortened

pytestmark = pytest.mark.quick

X, Y, Z = map(readonly, ([0, 6, -6, 0], [0, 1, 2, 0], [0, 1, -1, 0]))
MADE = motion(X, Y, Z, dt_s=0.1, id="made")


def test_a_grid_has_every_combination_once_the_ppa_fastest():
    wanted = (0.0, 0.3, 0.5), (0.0, 0.3, 1.0), (2.0, 0.3, 0.5), (2.0, 0.3, 1.0)
    found = study.grid((0.0, 2.0), (0.3,), (0.5, 1.0))
    assert found == tuple(Case(*values) for values in wanted)


def test_scenes_are_those_of_each_motion_in_turn_scaled_to_the_case():
    turned = Orientation(component=HorizontalComponent.TRANSVERSE, polarity=-1)
    scenes = study.scenes_of([MADE], study.MODEL_CASES, (AS_RECORDED, turned))
    assert [scene.friction.mu_slow for scene in scenes] == [0.3, 0.4, 0.5] * 2
    assert scenes[0].ax_mps2.tolist() == X.tolist()
    assert scenes[3].ax_mps2.tolist() == (-Y).tolist()
    assert scenes[3].ay_mps2.tolist() == X.tolist()
    assert scenes[2].scale == scenes[5].scale == pytest.approx(1.5 * 9.80665 / 6.0)


def test_a_second_component_fades_and_is_gone_at_zero():
    (scene,) = study.scenes_of([MADE], study.MODEL_CASES[:1])
    assert study.faded(scene, 0.5).ay_mps2.tolist() == [0.0, 0.5, 1.0, 0.0]
    assert study.faded(scene, 0.0).ay_mps2.size == 0


def test_in_two_axes_each_scene_takes_the_law_of_its_own_friction():
    push = np.array([0.0, 5.0, -5.0, 0.0])
    half, whole, double = (
        study.flat_scene(push, 0.0 * push, 0.1, coulomb(mu)) for mu in (0.05, 0.1, 0.2)
    )
    halved = study.plane_prds([whole, double], lambda mu: coulomb(0.5 * mu), study.TIGHT)
    by_hand = [one_axis.run(scene).prd_m for scene in (half, whole)]
    assert halved == pytest.approx(by_hand, rel=1e-9)
    assert halved[0] > halved[1] > 0.0


def test_a_run_and_its_history_are_those_of_a_slide():
    record, case = shortened(near_fault_pulse(), 2.0), Case(4.0, 0.2, 0.5)
    by = {"method": "paper", "substeps": 4}
    place = {"slope_rad": math.radians(4.0), "mu": 0.2, "scale": scale_to(record, 0.5)}
    direct = slide(record.a_mps2, record.dt_s, **place, **by)
    assert direct.prd_m > 0.0
    assert study.run(record, case, **by).prd_m == direct.prd_m
    assert study.history(record, case, **by).u_m[-1] == direct.residual_m
    assert study.run(record, case).prd_m == study.run(record, case, "exact").prd_m


def test_repeats_end_early_where_they_take_long():
    calls = []
    study.minimum_seconds(lambda: calls.append(0), enough_s=0.0)
    assert len(calls) == 1
    study.minimum_seconds(lambda: calls.append(0), enough_s=60.0)
    assert len(calls) == 1 + study.REPEATS


def test_the_least_time_is_that_of_the_fastest_repeat(monkeypatch):
    ticks = iter([0.0, 3.0, 10.0, 11.0, 20.0, 22.0, 30.0, 34.0, 40.0, 45.0])
    monkeypatch.setattr(study.time, "perf_counter", lambda: next(ticks))
    assert study.minimum_seconds(lambda: None, enough_s=60.0) == 1.0


def test_the_best_point_is_the_first_of_the_least():
    assert study.best_of(lambda x: (x - 1) ** 2, [3, 2, 0, 5]) == (1, 2)


# Motions of three components


@pytest.fixture(scope="module")
def own():
    (only,) = study.own_triples(True)
    return only


def test_the_own_motions_are_those_of_the_records(own):
    assert np.shares_memory(own.ax_mps2, study.own_records(True)[0].a_mps2)
    assert own.source != study.RECORDED
    assert not np.array_equal(own.ax_mps2, own.ay_mps2)


def test_a_scene_has_the_larger_horizontal_peak_and_one_factor_for_all(own):
    scale = study.triple_scale(own, 0.5)
    peaks = [np.abs(a).max() * scale for a in (own.ax_mps2, own.ay_mps2)]
    assert max(peaks) == pytest.approx(0.5 * 9.80665)


def test_a_part_is_the_strongest_and_sampled_alike(own):
    part = study.cut(own, 101)
    assert part.ax_mps2.size == part.ay_mps2.size == part.az_mps2.size == 101
    assert not part.ax_mps2.flags.writeable
    energy = np.sum(part.ax_mps2**2 + part.ay_mps2**2)
    assert energy >= np.sum((own.ax_mps2**2 + own.ay_mps2**2)[:101])


def test_files_of_three_components_are_found_and_what_is_not_one_is_passed_over(tmp_path):
    (tmp_path / "below").mkdir()
    for path in SAMPLES.iterdir():
        shutil.copy(path, tmp_path / "below" / path.name)
    (tmp_path / "notes.txt").write_text("no motion")
    triples = study.recorded_triples(tmp_path)
    assert triples
    assert all(triple.source == study.RECORDED for triple in triples)
    assert all(
        triple.ax_mps2.size == triple.ay_mps2.size == triple.az_mps2.size for triple in triples
    )


def test_the_vertical_is_told_by_its_name_wherever_it_stands():
    if not RECORDS.is_dir():
        pytest.skip("the real records are not here")
    triples = {triple.id: triple for triple in study.recorded_triples(RECORDS)}
    assert np.abs(triples["20161113_110259_WTMC_20"].az_mps2).max() == pytest.approx(
        18.02, abs=0.01
    )
    assert np.abs(triples["llolleo1002271"].az_mps2).max() == pytest.approx(6.88, abs=0.01)
