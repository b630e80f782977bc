"""Motions of three components: made ones, and those that a folder holds."""

import shutil

import numpy as np
import pytest

from places import RECORDS, SAMPLES
from solver.verification.study import (
    RECORDED,
    cut,
    own_records,
    own_triples,
    recorded_triples,
    triple_scale,
)

pytestmark = pytest.mark.quick


@pytest.fixture(scope="module")
def own():
    (only,) = own_triples(True)
    return only


def test_the_own_motions_are_those_of_the_records(own):
    assert np.shares_memory(own.ax_mps2, own_records(True)[0].a_mps2)
    assert own.source != RECORDED
    assert not np.array_equal(own.ax_mps2, own.ay_mps2)


def test_a_scene_has_the_larger_horizontal_peak_and_one_factor_for_all(own):
    scale = triple_scale(own, 0.5)
    peaks = [np.abs(a).max() * scale for a in (own.ax_mps2, own.ay_mps2)]
    assert max(peaks) == pytest.approx(0.5 * 9.80665)


def test_a_part_is_the_strongest_and_sampled_alike(own):
    part = cut(own, 101)
    assert part.ax_mps2.size == part.ay_mps2.size == part.az_mps2.size == 101
    assert not part.ax_mps2.flags.writeable
    energy = np.sum(part.ax_mps2**2 + part.ay_mps2**2)
    assert energy >= np.sum((own.ax_mps2**2 + own.ay_mps2**2)[:101])


def test_files_of_three_components_are_found_and_what_is_not_one_is_passed_over(tmp_path):
    (tmp_path / "below").mkdir()
    for path in SAMPLES.iterdir():
        shutil.copy(path, tmp_path / "below" / path.name)
    (tmp_path / "notes.txt").write_text("no motion")
    triples = recorded_triples(tmp_path)
    assert triples
    assert all(triple.source == RECORDED for triple in triples)
    assert all(
        triple.ax_mps2.size == triple.ay_mps2.size == triple.az_mps2.size for triple in triples
    )


def test_the_vertical_is_told_by_its_name_wherever_it_stands():
    if not RECORDS.is_dir():
        pytest.skip("the real records are not here")
    triples = {triple.id: triple for triple in recorded_triples(RECORDS)}
    assert np.abs(triples["20161113_110259_WTMC_20"].az_mps2).max() == pytest.approx(
        18.02, abs=0.01
    )
    assert np.abs(triples["llolleo1002271"].az_mps2).max() == pytest.approx(6.88, abs=0.01)
