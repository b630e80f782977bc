"""PEER AT2. Oracle: the numbers of a hand-made file, typed again."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from places import DATA
from solver.formats import read_motion_file
from solver.model import InputError

G = 9.80665
SAMPLES = DATA / "motions"
VALUES = [0.001, -0.0025, 0.125, 0.25, -0.5, 0.0625, -0.03125]

HEADING = """PEER STRONG MOTION DATABASE RECORD. PROCESSING BY HAND.
MADE-UP VALLEY 01/02/03 0405, NO SUCH SCHOOL, 180
ACCELERATION TIME HISTORY IN UNITS OF G. FILTER POINTS: HP=0.1 Hz LP=40.0 Hz
"""


def problems_of(path: Path, **how: Any) -> tuple[str, ...]:
    with pytest.raises(InputError) as caught:
        read_motion_file(path, **how)
    return caught.value.problems


@pytest.mark.parametrize("name", ["peer-nga.at2", "peer-old.at2"])
def test_both_styles_of_heading_read_alike(name: str) -> None:
    motion_file = read_motion_file(SAMPLES / name)
    assert motion_file.format == "PEER AT2"
    assert motion_file.notes == ()
    record = motion_file.channel()
    assert record.name == "180"
    assert record.dt_s == 0.005
    assert record.a_mps2.tolist() == [value * G for value in VALUES]


@pytest.mark.parametrize(
    "line",
    [
        "NPTS=  3, DT=   .0100 SEC",
        "NPTS=  3, DT= .01000 SEC,",
        "npts=3,dt=0.01",
        "NPTS = 3 DT = 1.0E-2",
        "    3    0.0100    NPTS, DT",
        "3, .01 NPTS, DT",
    ],
)
def test_count_and_step_are_found_however_they_are_set(file: Any, line: str) -> None:
    record = read_motion_file(file(f"{HEADING}{line}\n .1E+00 -.2D+00\n3.\n\n")).channel()
    assert record.dt_s == 0.01
    assert record.a_mps2.tolist() == [0.1 * G, -0.2 * G, 3.0 * G]


def test_a_file_named_as_text_is_known_by_its_content(file: Any) -> None:
    content = (SAMPLES / "peer-nga.at2").read_text()
    assert read_motion_file(file(content, "a.txt")).format == "PEER AT2"


def test_units_are_asked_for_only_where_the_heading_has_none(file: Any) -> None:
    bare = "SOMETHING\nELSE\n\nNPTS= 2, DT= .01 SEC\n1 2\n"
    assert problems_of(file(bare))[0].startswith("roof.csv: found no unit of acceleration; give")
    assert read_motion_file(file(bare), units="gal").channel().a_mps2.tolist() == [0.01, 0.02]
    assert read_motion_file(file(bare), units="gal").channel().name == "roof.csv"


@pytest.mark.parametrize(
    ("line", "values", "expected"),
    [
        ("NPTS= 4, DT= .01 SEC", "1 2 3", "4: states 4 values, found 3; give the whole file"),
        ("NPTS= 2, DT= .01 SEC", "1 2 3", "4: states 2 values, found 3; correct the count"),
        ("NPTS= 3, DT= SEC", "1 2 3", "4: found no time step; give dt"),
        ("NPTS= 3, DT= 0.0 SEC", "1 2 3", "4: found time step 0 s; give a number above 0"),
        ("NPTS: 3", "1 2 3", "4: found 'NPTS: 3'; give the count and the step as in NPTS="),
        ("NPTS= 3, DT= .01 SEC", "1 wide 3", "5: found 'wide'; give a number"),
        ("NPTS= 3, DT= .01 SEC", "1 ***** 3", "5: found '*****', a number too large for its"),
        ("NPTS= 3, DT= .01 SEC", "1 1_0 3", "5: found '1_0'; give a number"),
        ("NPTS= 3, DT= .01 SEC", "1 nan 3", "5: found 'nan'; give a number"),
        ("NPTS= 1, DT= .01 SEC", "1", "4: states 1 value; give at least 2"),
        ("NPTS= 0, DT= .01 SEC", "", "4: states 0 values; give at least 2"),
    ],
)
def test_faults_are_told_with_their_line(file: Any, line: str, values: str, expected: str) -> None:
    (problem,) = problems_of(file(f"{HEADING}{line}\n{values}\n"))
    assert problem.startswith(f"roof.csv:{expected}")


def test_a_step_that_the_heading_lacks_may_be_given(file: Any) -> None:
    path = file(f"{HEADING}NPTS= 3, DT= SEC\n1 2 3\n")
    assert read_motion_file(path, dt_s=0.02).channel().dt_s == 0.02


def test_a_file_of_velocity_is_refused(file: Any) -> None:
    content = "PEER\nX, Y, 1\nVELOCITY TIME HISTORY IN UNITS OF CM/S\nNPTS= 2, DT= .01 SEC\n1 2\n"
    assert problems_of(file(content)) == (
        "roof.csv:3: found velocity; give the file of acceleration",
    )


def test_units_and_step_that_contradict_the_heading_are_refused() -> None:
    path = SAMPLES / "peer-nga.at2"
    assert problems_of(path, units="m/s2") == (
        "peer-nga.at2:3: the file is in G but units are m/s2; give the units of the file, or none",
    )
    assert problems_of(path, dt_s=0.01) == (
        "peer-nga.at2:4: the time step of the file is 0.005 s but dt is 0.01 s; give the dt of the"
        " file, or none",
    )
    assert read_motion_file(path, units="g", dt_s=0.005).channel().dt_s == 0.005
