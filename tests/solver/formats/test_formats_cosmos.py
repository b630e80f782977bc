"""COSMOS V1.20. Oracle: the wave that the samples were made of."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from places import DATA
from solver.formats import read_motion_file
from solver.model import InputError

G = 9.80665
SAMPLES = DATA / "motions"
# fmt: off
WAVE = np.array([0.25, -1.5, 12.125, -34.5, 98, -123.456, 77.125, -45.25, 30.5, -20, 15.75, -9.5,
                 6.25, -4, 2.5, -1.25, 0.75, -0.5, 0.25, -0.125, 0])
# fmt: on


# A file may hold one channel of a recorder, so this is no error.
OF_TWO = (
    "line 7 states 2 channels of the recorder, the file has 1: the others are in other files, or"
    " the file is truncated"
)


def problems_of(path: Path, **how: Any) -> tuple[str, ...]:
    with pytest.raises(InputError) as caught:
        read_motion_file(path, **how)
    return caught.value.problems


def test_one_value_to_a_line_and_the_step_of_the_series() -> None:
    motion_file = read_motion_file(SAMPLES / "cosmos.v2c")
    assert motion_file.format == "COSMOS V1.20"
    assert motion_file.notes == (OF_TWO,)
    record = motion_file.channel()
    assert record.name == "Sta Chan 1: 360 deg (Rcrdr Chan 1) Location: Roof"
    # Milliseconds of the series, not the step of the record it was made of.
    assert record.dt_s == 0.0078125
    assert record.a_mps2 == pytest.approx(WAVE / 100, rel=1e-14)


def test_accelerations_of_several_channels_are_taken_whatever_their_format() -> None:
    motion_file = read_motion_file(SAMPLES / "cosmos.v1c")
    assert [record.name for record in motion_file.channels] == [
        "Sta Chan 1: 360 deg (Rcrdr Chan 1) Location: Roof",
        "Sta Chan 2: Up (Rcrdr Chan 2) Location: Roof",
    ]
    assert [record.dt_s for record in motion_file.channels] == [0.01, 0.01]
    assert motion_file.channel("1").a_mps2 == pytest.approx(WAVE / 1000 * G, abs=0.51e-5 * G)
    assert motion_file.channel("2").a_mps2 == pytest.approx(WAVE / 2000 * G, abs=1.01e-5 * G)


@pytest.mark.parametrize(
    ("unit", "size"),
    [
        ("cm/sec2(04)", 0.01),
        ("cm/s^2 (4)", 0.01),
        ("cm/s^2", 0.01),
        ("gal (10)", 0.01),
        ("(04)", 0.01),
        ("in/sec2(07)", 0.0254),
        ("mg(11)", G / 1000),
    ],
)
def test_units_are_named_coded_or_both(altered: Any, unit: str, size: float) -> None:
    # The peak of the real heading is in the unit of the values.
    path = altered("cosmos.v2c", ("cm/sec2(04)", unit))
    assert read_motion_file(path).channel().a_mps2 == pytest.approx(WAVE * size, rel=1e-14)


def test_a_format_that_ends_in_a_letter_is_understood(altered: Any) -> None:
    path = altered("cosmos.v2c", ("(1E15.6)", "(1F15.6E)"))
    assert read_motion_file(path).channel().a_mps2 == pytest.approx(WAVE / 100, rel=1e-14)


def test_a_file_without_its_last_line_says_so(altered: Any) -> None:
    motion_file = read_motion_file(
        altered("cosmos.v2c", ("End-of-data for Chan  1 acceleration", ""))
    )
    assert motion_file.notes == (
        OF_TWO,
        "no end-of-data line follows the values: the file may be truncated",
    )


@pytest.mark.parametrize(
    ("changes", "expected"),
    [
        ([("1.212500e+01", "********")], "52: found '********', a number too large for its col"),
        ([("1.212500e+01", "twelve")], "52: found 'twelve'; give a number"),
        ([("   21 accel", "   22 accel")], "49: states 22 values, found 21; give the whole"),
        ([("   21 accel", "   20 accel")], "49: states 20 values, found more in line"),
        ([("(1E15.6)", "(free)")], "49: found format (free); give one as (8F10.3)"),
        ([("cm/sec2(04)", "counts(50)")], "49: found unit 'counts', code 50; give a file of acc"),
        ([("cm/sec2(04)", "counts")], "49: found unit 'counts'; give an acceleration in g, m/s2"),
        ([("cm/sec2(04)", "g(04)")], "49: found unit 'g' with code 4, which is cm/s2; give a"),
        ([("approx  0 secs", "approx  9 secs")], "49: states about 9 s, count times step is 0.16"),
        ([("Real-header", "Some")], "1: found no block ... Real-header values follow ...; give"),
        ([("-123.456000", "-923.456000")], "38: the header states a peak of 0.9417 g, the values"),
        ([("Corrected accel", "Raw accel")], "1: found raw counts; give a file of uncorrected"),
        ([("       7.812500", "       0.000000"), ("       0.005000", "       0.000000")],
         "26: found no time step; give dt"),
    ],
)  # fmt: skip
def test_faults_are_told_with_their_line(
    altered: Any, changes: list[tuple[str, str]], expected: str
) -> None:
    (problem,) = problems_of(altered("cosmos.v2c", *changes))
    assert problem.startswith(f"cosmos.v2c:{expected}")


def test_a_step_that_no_heading_has_may_be_given(altered: Any) -> None:
    unknown = ("    -999.000000", "    -999.000000")
    steps = [("       7.812500", unknown[1]), ("       0.005000", unknown[1])]
    path = altered("cosmos.v2c", *steps)
    assert problems_of(path, dt_s=0.01) == (
        "cosmos.v2c:38: the heading states 0.164062 s, the record lasts 0.21 s; give dt with more"
        " digits, or a file whose headings agree",
    )
    path = altered("cosmos.v2c", *steps, ("       0.164062", unknown[1]))
    assert read_motion_file(path, dt_s=0.01).channel().dt_s == 0.01


def test_a_file_of_velocity_alone_is_refused(altered: Any) -> None:
    path = altered("cosmos.v2c", ("21 acceleration pts", "21 velocity pts"))
    assert problems_of(path) == (
        "cosmos.v2c: found no acceleration in this COSMOS V1.20 file; give a file of acceleration",
    )


def test_faults_of_all_channels_are_told_together(altered: Any) -> None:
    path = altered("cosmos.v1c", ("    .01213", "    .0121x"), ("  .00606", "  .0060y"))
    assert [problem.split(": ")[1] for problem in problems_of(path)] == [
        "found '.0121x'; give a number",
        "found '.0060y'; give a number",
    ]


def test_a_file_of_countless_series_is_refused(file: Any) -> None:
    heading = "Corrected acceleration    (Format v01.20 with 13 text lines)\n"
    series = "2 acceleration pts, approx 0 secs, units=g(02),Format=(8F10.3)\n"
    (problem,) = problems_of(file(heading + series * 2000))
    assert problem == "roof.csv: found 2000 channels; give at most 1000 in a file"


def test_what_the_caller_says_must_agree() -> None:
    path = SAMPLES / "cosmos.v2c"
    assert read_motion_file(path, units="cm/s2", dt_s=1 / 128).channel().dt_s == 1 / 128
    assert "the file is in cm/sec2 but units are g" in problems_of(path, units="g")[0]
    assert (
        "the time step of the file is 0.0078125 s but dt is 0.01" in problems_of(path, dt_s=0.01)[0]
    )
