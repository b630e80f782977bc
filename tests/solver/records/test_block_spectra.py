"""Spectra by products of matrices. Oracle: the compiled kernel, one record at a time."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import solver
from solver.records.acceptance import POINTS_HZ
from solver.records.block_spectra import spectra, together
from solver.records.spectrum import response_spectrum

PERIODS_S = 1.0 / POINTS_HZ

records = st.lists(st.floats(-20.0, 20.0, width=32), min_size=1, max_size=100).map(np.array)


@given(records, st.sampled_from([0.001, 0.005, 1 / 128, 0.02, 0.05, 0.1, 1.0]))
def test_a_record_of_few_samples_has_the_spectra_of_the_kernel(a, dt_s):
    expected = response_spectrum(a, dt_s, PERIODS_S)
    found = spectra(np.array([a, -2.0 * a]), dt_s, PERIODS_S)
    noise = 1e-13 * np.abs(a).max()
    np.testing.assert_allclose(found, [expected, 2.0 * expected], rtol=1e-11, atol=noise)


@pytest.mark.quick
def test_components_of_motions_of_any_steps_and_lengths_have_their_own_spectra(noise):
    motions = [
        solver.motion(noise, az_mps2=0.5 * noise, dt_s=0.01),
        solver.motion(noise[::-1], ay_mps2=noise, dt_s=0.005),
        solver.motion(noise[:-7], az_mps2=noise[7:], dt_s=0.01, scale=2.0),
    ]
    found = together(motions, PERIODS_S)
    for motion, parts in zip(motions, found, strict=True):
        expected = [
            response_spectrum(a, motion.dt_s, PERIODS_S) for a in motion.components.values()
        ]
        np.testing.assert_allclose(parts, expected, rtol=1e-12)
