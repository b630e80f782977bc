"""Spectra of the motions as run, and how the page on motions sums them up."""

from dataclasses import replace

import numpy as np
import pytest

import stand_in
from report.pages import motions as page
from report.spectra import BAND_HZ, spectra
from solver.motion import response_spectrum

G = 9.80665


@pytest.fixture(scope="module")
def assessment():
    return stand_in.assessed(stand_in.book(found=stand_in.motions(3, seconds=8.0)))


def given():
    return [replace(motion, scale=0.5) for motion in stand_in.motions(3, seconds=8.0)]


def test_all_three_components_are_taken_as_run(assessment):
    motions = given()
    found = spectra(assessment, motions)
    assert [part.title for part in found] == ["Horizontal", "Transverse", "Vertical"]
    for part, name in zip(found, ("ax_mps2", "ay_mps2", "az_mps2"), strict=True):
        for motion, row in zip(motions, part.sa_g, strict=True):
            alone = response_spectrum(0.5 * getattr(motion, name), motion.dt_s, part.periods_s)
            assert row == pytest.approx(alone / G, rel=1e-12)
    assert found[0].target is found[1].target is assessment.horizontal_target
    assert found[2].target is assessment.vertical_target


def test_motions_without_a_component_are_left_out_there(assessment):
    first, second, third = given()
    bare = [replace(first, ay_mps2=np.empty(0), az_mps2=np.empty(0)), second, third]
    found = spectra(assessment, bare)
    assert [part.ids for part in found] == [("M1", "M2", "M3"), ("M2", "M3"), ("M2", "M3")]
    assert [part.title for part in spectra(assessment, bare[:1])] == ["Horizontal"]


def test_the_band_is_that_of_matched_motions_in_twelfths_of_an_octave(assessment):
    part = spectra(assessment, given())[0]
    band = np.sort(1.0 / part.periods_s[part.in_band])
    assert band == pytest.approx(BAND_HZ)
    assert band[1:] / band[:-1] == pytest.approx(2.0 ** (1 / 12))
    assert (band[0], band[-1]) == pytest.approx((0.3, 32.3), abs=0.05)


def test_the_table_names_the_motion_and_period_of_the_extremes(assessment):
    motions = given()
    part = spectra(assessment, motions)[1]
    (row,) = page.achieved_table([part]).rows
    least, of_least, largest, of_largest = row.cells[-4:]
    ratios = {
        (motion.id, freq): response_spectrum(
            0.5 * motion.ay_mps2, motion.dt_s, np.array([1 / freq])
        )[0]
        / G
        / assessment.horizontal_target.at(np.array([freq]))[0]
        for motion in motions
        for freq in BAND_HZ
    }
    for text, where, pick in ((least, of_least, min), (largest, of_largest, max)):
        name, freq = pick(ratios, key=ratios.get)
        assert text == f"{ratios[name, freq]:.2f}"
        assert where == f"{name}, {1 / freq:.2f} s"


def test_ratios_of_the_ordinates_are_those_of_mean_and_single_motions(assessment):
    part = spectra(assessment, given())[0]
    target, mean, over, least, largest = page.spectrum_table(part).rows
    at = int(np.argmin(np.abs(part.periods_s - 1.0)))
    column = 1 + page.PRINTED_S.index(1.0)
    assert target.cells[column] == f"{part.target_g[at]:.3f}"
    assert mean.cells[column] == f"{part.sa_g[:, at].mean():.3f}"
    for row, fold in ((over, np.mean), (least, np.min), (largest, np.max)):
        assert row.cells[column] == f"{fold(part.sa_g[:, at]) / part.target_g[at]:.2f}"
