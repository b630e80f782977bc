"""Channels of a file: how one is chosen, and what is told of its values."""

import math

import numpy as np
import pytest

from refused import refused
from solver.formats import read_motion_file
from solver.formats.channels import Channel, distinct, motion_file, offset_notes, peak_notes
from solver.formats.source import Source
from solver.model import InputError

pytestmark = pytest.mark.quick

G = 9.80665
SOURCE = Source(name="a.v2", lines=[], units="", dt_s=math.nan)


def made(*names, notes=()):
    channels = [
        Channel(name=name, dt_s=0.01, a_mps2=np.array([0.0, float(i)]), notes=notes)
        for i, name in enumerate(names, start=1)
    ]
    return motion_file(SOURCE, "made", channels, ["of the file"])


def test_a_channel_is_chosen_by_name_then_by_number():
    channels = made("CHAN  1: EW ", "CHAN  2: NS", "3: Up")
    assert channels.channel("chan 1:  ew").a_mps2[1] == 1.0
    assert channels.channel(" 2 ").name == "CHAN 2: NS"
    assert channels.channel("3").name == "3: Up"
    assert made("2", "1").channel("1").a_mps2[1] == 2.0
    assert made("180").channel().name == "180"
    assert made("").channel().name == "a.v2"


@pytest.mark.parametrize(
    ("names", "wanted", "problem"),
    [
        ("x y", "", "found several channels; give one by name or number: 1 x; 2 y"),
        *(
            ("x y", name, f"found no channel '{name}'; give one by name or number: 1 x; 2 y")
            for name in ("z", "3", "0", "-1")
        ),
        ("North Vertical", "vertcal",
         "found no channel 'vertcal'; did you mean 'Vertical'? Give one by name or number: "
         "1 North; 2 Vertical"),
    ],
)  # fmt: skip
def test_a_channel_that_is_not_there_is_refused_with_those_that_are(names, wanted, problem):
    assert refused(made(*names.split()).channel, wanted) == (f"a.v2: {problem}",)


def test_names_and_notes_of_channels_differ_and_long_lists_are_cut():
    (problem,) = refused(made(*(f"c{i}" for i in range(40))).channel, "roof")
    assert problem.endswith("30 c29; ... and 10 more")
    assert distinct(["x", " X", "", "x (2)", "x"]) == [
        "x", "X (2)", "channel 3", "x (2) (2)", "x (3)",
    ]  # fmt: skip
    assert made("x", notes=("odd",)).notes == ("of the file", "odd")
    assert made("x", "y", notes=("odd",)).notes == ("of the file", "x: odd", "y: odd")
    (problem,) = refused(made)
    assert problem.startswith("a.v2: found no acceleration in this made file; give a")
    short = Channel(name="x", dt_s=0.01, a_mps2=np.zeros(1), notes=())
    (problem,) = refused(motion_file, SOURCE, "made", [short])
    assert problem == "a.v2: found 1 sample; give at least 2"


def test_stated_peaks_and_offsets_are_told():
    a = np.array([0.0, -0.5 * G, 0.2 * G])
    assert peak_notes(SOURCE, 3, -0.5 * G, a) == ()
    assert peak_notes(SOURCE, 3, 0.504 * G, a) == ()
    assert peak_notes(SOURCE, 3, 0.6 * G, a) == (
        "the header states a peak of 0.6 g, the values reach 0.5 g",
    )
    for unknown in (0.0, math.nan, math.inf):
        assert peak_notes(SOURCE, 3, unknown, a) == ()
    for stated in (0.24 * G, 1.01 * G):
        with pytest.raises(InputError, match=r"a\.v2:4: the header states a peak of .* agree"):
            peak_notes(SOURCE, 3, stated, a)
    assert offset_notes(np.array([1.0, -1.0, 0.0])) == ()
    assert offset_notes(np.zeros(5)) == ()
    assert offset_notes(np.array([0.1 * G, -0.05 * G])) == (
        "uncorrected: the mean is 0.025 g, 25 % of the peak; it is not removed",
    )


def shaken(code, at=(20,), unit="g", peak=0.3):
    size = {"g": 1.0, "cm/s2": 981.0, "m/s2": 9.81}[unit]
    values = [f"{peak * size * math.sin(0.3 * k) * math.exp(-0.01 * k):.6f}" for k in range(300)]
    for index in at:
        values[index] = code
    return "\n".join(values) + "\n"


@pytest.mark.parametrize(
    ("code", "unit", "at"),
    [
        ("-999", "g", (20,)), ("-999.0", "g", (20, 21, 22)), ("9999", "cm/s2", (0,)),
        ("-9999.00", "cm/s2", (299,)), ("99999", "cm/s2", (7,)), ("999.99", "m/s2", (7, 90)),
        ("-999.25", "g", (7,)), ("-12345", "cm/s2", (7,)), ("32767", "cm/s2", (7,)),
        ("99.99", "g", (7,)), ("-99", "g", (7,)),
    ],
)  # fmt: skip
def test_a_code_for_missing_data_is_no_sample(tmp_path, code, unit, at):
    path = tmp_path / "a.txt"
    path.write_text(shaken(code, at, unit))
    (problem,) = refused(read_motion_file, path, units=unit, dt_s=0.01)
    shown = "99999" if code == "999.99" else f"{float(code):g}"  # the file may be of cm/s2
    assert f"a.txt: sample {at[0] + 1} is {shown} where no other exceeds" in problem
    assert "code for missing data" in problem


def test_codes_beside_shaking_and_gravity_are_told(tmp_path):
    path = tmp_path / "a.txt"
    for code, unit, peak in (("-999", "cm/s2", 0.05), ("-999", "g", 1.4)):
        path.write_text(shaken(code, unit=unit, peak=peak))
        (problem,) = refused(read_motion_file, path, units=unit, dt_s=0.01)
        assert "code for missing data" in problem
    path = tmp_path / "a.csv"
    rows = "".join(f"{k / 100},{0.1 * (-1) ** k},{1 - 0.1 * (-1) ** k}\n" for k in range(50))
    path.write_text(f"t_s,X_g,Z_g\n{rows}")
    assert read_motion_file(path).notes == ("Z: the mean is about 1 g: gravity is in it",)


@pytest.mark.parametrize(
    ("code", "unit", "peak"), [("-999", "cm/s2", 0.9), ("9.99", "m/s2", 0.9), ("1.5", "g", 0.3)]
)
def test_a_large_sample_that_shaking_may_have_is_one(tmp_path, code, unit, peak):
    path = tmp_path / "a.txt"
    path.write_text(shaken(code, unit=unit, peak=peak))
    assert read_motion_file(path, units=unit, dt_s=0.01).channels
