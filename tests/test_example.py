"""The example is what its script makes."""

import importlib.util
from pathlib import Path

import numpy as np
import pytest

from report.sheet.workbook import read_workbook
from solver.motion import response_spectrum
from solver.provisions import RULE_SETS, ac156_horizontal, ac156_vertical

EXAMPLE = Path(__file__).resolve().parents[1] / "projects" / "example"


@pytest.fixture(scope="module")
def make():
    spec = importlib.util.spec_from_file_location("make", EXAMPLE / "make.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.fixture(scope="module")
def book():
    return read_workbook(EXAMPLE)


def test_the_workbook_holds_the_project_that_the_script_describes(make, book):
    expected = make.example().model_dump()
    found = book.input.model_dump()
    assert found.keys() == expected.keys()
    assert dict(flatten(found)) == dict(flatten(expected))


def flatten(tree, path=""):
    """Yield every value of nested dicts and sequences with its path, floats to 9 digits."""
    if isinstance(tree, dict):
        for key, value in tree.items():
            yield from flatten(value, f"{path}/{key}")
    elif isinstance(tree, (list, tuple)):
        for index, value in enumerate(tree):
            yield from flatten(value, f"{path}/{index}")
    else:
        yield path, float(f"{tree:.9g}") if isinstance(tree, float) else tree


def test_the_first_record_is_made_again_bit_for_bit_up_to_its_last_digit(make, book):
    """One of seven keeps the test short; other machines' sines may differ in the last digit."""
    across = ac156_horizontal(RULE_SETS["SEAOC PV1-2012"], s_ds_g=make.S_DS_G, z_over_h=1.0)
    upward = ac156_vertical(s_ds_g=make.S_DS_G)
    again = make.make_suite(
        (across.freq_hz, across.sa_g), (upward.freq_hz, upward.sa_g), count=1, seed=make.SEED
    )[0]
    first = book.motions[0]
    for record, committed in ((again.x, first.ax_mps2), (again.z, first.az_mps2)):
        assert np.abs(record.a_mps2 - committed).max() <= 3e-5 * 9.80665


def test_every_record_keeps_to_the_ac156_spectrum_at_the_roof(make, book):
    freq = 0.3 * 2.0 ** (np.arange(82) / 12)
    targets = (
        ac156_horizontal(RULE_SETS["SEAOC PV1-2012"], s_ds_g=make.S_DS_G, z_over_h=1.0),
        ac156_vertical(s_ds_g=make.S_DS_G),
    )
    assert len(book.motions) == make.COUNT
    for motion in book.motions:
        for record, target in zip((motion.ax_mps2, motion.az_mps2), targets, strict=True):
            ratio = response_spectrum(record, motion.dt_s, 1 / freq) / 9.80665 / target.at(freq)
            assert ratio.min() >= 0.90
            assert ratio.max() <= 1.30
            assert ratio.mean() == pytest.approx(1.0, abs=0.05)


def test_no_motion_leaves_the_roof_moving(book):
    for motion in book.motions:
        for record in (motion.ax_mps2, motion.az_mps2):
            velocity = np.cumsum(record) * motion.dt_s
            assert abs(velocity[-1]) < 0.01 * np.abs(velocity).max()
