"""Spectra of records and motions as tables: those of the arrays."""

import numpy as np
import pytest

import solver
from solver import InputError, Record
from solver.records.spectrum import PERIODS_S, response_spectrum

pytestmark = pytest.mark.quick

PERIODS = [0.0, 0.3, 1.0]


def test_the_spectrum_of_a_record_has_its_name(noise):
    record = Record(name="RM1", dt_s=0.01, a_mps2=noise)
    frame = solver.spectrum(record, PERIODS, damping=0.02).to_frame()
    assert frame.index.name == "period_s"
    assert frame.index.tolist() == PERIODS
    np.testing.assert_array_equal(frame["RM1"], response_spectrum(noise, 0.01, PERIODS, 0.02))


def test_the_spectra_of_a_motion_are_those_of_its_components_scaled(noise):
    motion = solver.motion(noise, az_mps2=0.5 * noise, dt_s=0.01, scale=2.0)
    found = solver.spectrum(motion, PERIODS)
    assert list(found.sa_mps2) == ["x", "z"]
    np.testing.assert_allclose(found.sa_mps2["x"], 2.0 * response_spectrum(noise, 0.01, PERIODS))
    np.testing.assert_allclose(found.sa_mps2["x"], 2.0 * found.sa_mps2["z"])
    peaks = (found.sa_mps2[name].max() for name in "xz")
    told = ", ".join(
        f"{name} up to {peak:.3g} m/s2" for name, peak in zip("xz", peaks, strict=True)
    )
    assert repr(found) == f"ResponseSpectrum: 3 periods, 5 %; {told}"


def test_periods_are_those_of_the_module_where_none_are_given(noise):
    found = solver.spectrum(Record(name="a", dt_s=0.01, a_mps2=noise[:200]))
    assert found.periods_s.tolist() == PERIODS_S.tolist()
    with pytest.raises(InputError, match="periods: give one column"):
        solver.spectrum(Record(name="a", dt_s=0.01, a_mps2=noise), [-1.0])
