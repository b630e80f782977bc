"""GeoNet V1A and V2A. Oracle: the wave that the samples were made of."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from places import DATA
from solver.formats import read_motion_file
from solver.model import InputError

SAMPLES = DATA / "motions"
# fmt: off
WAVE = np.array([0.25, -1.5, 12.125, -34.5, 98, -123.456, 77.125, -45.25, 30.5, -20, 15.75, -9.5,
                 6.25, -4, 2.5, -1.25, 0.75, -0.5, 0.25, -0.125, 0])
# fmt: on


def problems_of(path: Path, **how: Any) -> tuple[str, ...]:
    with pytest.raises(InputError) as caught:
        read_motion_file(path, **how)
    return caught.value.problems


def test_corrected_accelerations_of_three_components_are_taken() -> None:
    motion_file = read_motion_file(SAMPLES / "geonet.v2a")
    assert motion_file.format == "GeoNet V2A"
    assert motion_file.notes == ()
    assert [record.name for record in motion_file.channels] == [
        "Component N28W Longitudinal Accelerometer Axis",
        "Component S62W Transverse Accelerometer Axis",
        "Component Up Vertical Accelerometer Axis",
    ]
    assert {record.dt_s for record in motion_file.channels} == {0.02}
    for record, part in zip(motion_file.channels, (1, 2, 4), strict=True):
        assert record.a_mps2 == pytest.approx(WAVE / 100 / part, abs=1.01e-4)


def test_uncorrected_readings_keep_their_offset() -> None:
    motion_file = read_motion_file(SAMPLES / "geonet.v1a")
    assert motion_file.format == "GeoNet V1A"
    record = motion_file.channel("component n28w")
    assert record.dt_s == 0.005
    assert record.a_mps2 == pytest.approx(WAVE / 100 - 0.006, abs=1.01e-4)


def test_readings_in_another_unit_than_one_are_scaled(altered: Any) -> None:
    path = altered("geonet.v1a", ("units of 1.00 mm/s/s", "units of 0.80 mm/s/s"))
    a_mps2 = read_motion_file(path).channel("1").a_mps2
    assert a_mps2 == pytest.approx(0.8 * (WAVE / 100 - 0.006), abs=1.01e-4)


@pytest.mark.parametrize(
    ("changes", "expected"),
    [
        ([("   121.2", "  121,2 ")], "27: found '121,2'; give a number with a decimal point"),
        ([("   121.2", "********")], "27: found '********', a number too large for its columns"),
        ([(" at 0.020 sec inter", " at 0.010 sec inter")], "11: found a step of 0.01 s and one of"),
        ([("mm/s/s at", "mm/s at")], "14: found unit 'mm/s'; give an acceleration in g, m/s2"),
        ([("Acceleration:", "Accel:")], "14: found no line Acceleration: peak ... mm/s/s; give"),
    ],
)
def test_faults_are_told_with_their_line(
    altered: Any, changes: list[tuple[str, str]], expected: str
) -> None:
    (problem,) = problems_of(altered("geonet.v2a", *changes))
    assert problem.startswith(f"geonet.v2a:{expected}")


def test_counts_must_hold(altered: Any, file: Any) -> None:
    text = (SAMPLES / "geonet.v1a").read_text()
    line = next(line for line in text.splitlines() if line.startswith("      21"))
    for count, reached in (("22", "21"), ("20", "more in line 29")):
        changed = line[:24] + count.rjust(8) + line[32:]
        (problem,) = problems_of(altered("geonet.v1a", (line, changed)))
        assert problem.startswith(f"geonet.v1a:20: states {count} values, found {reached}")
    changed = line[:24] + "       0" + line[32:]
    assert problems_of(altered("geonet.v1a", (line, changed))) == (
        "geonet.v1a:20: states 0 values; give at least 2",
    )
    changed = line[:24] + "    none" + line[32:]
    (problem,) = problems_of(altered("geonet.v1a", (line, changed)))
    assert problem.startswith("geonet.v1a:20: found no number of accelerations; give the whole")


def test_a_cut_file_is_told(file: Any) -> None:
    lines = (SAMPLES / "geonet.v2a").read_text().splitlines()
    cut = read_motion_file(file("\n".join(lines[:-4])))
    assert cut.notes == (
        "Component Up Vertical Accelerometer Axis: velocities or displacements are incomplete: the"
        " file may be truncated",
    )
    (problem,) = problems_of(file("\n".join(lines[:97])))
    assert problem == "roof.csv:90: states 21 values, found 10; give the whole file"
    (problem,) = problems_of(file("\n".join(lines[:70])))
    assert problem == (
        "roof.csv:36: found the heading of component 2, the last one, where the format has 3"
        " components; give the whole file"
    )


def test_a_peak_of_the_heading_that_is_twice_that_of_the_values_is_refused(altered: Any) -> None:
    heading = " -1234.6  0.0000  0.0000  0.0000  0.0000 -1234.6"
    (problem,) = problems_of(altered("geonet.v2a", (heading, heading[:-7] + "-9234.6")))
    assert problem.startswith("geonet.v2a:24: the header states a peak of 0.9417 g, the values")


def test_what_the_caller_says_must_agree() -> None:
    path = SAMPLES / "geonet.v2a"
    assert len(read_motion_file(path, units="mm/s2", dt_s=0.02).channels) == 3
    assert "the file is in mm/s/s but units are g" in problems_of(path, units="g")[0]
    assert (
        "the time step of the file is 0.02 s but dt is 0.005 s" in problems_of(path, dt_s=0.005)[0]
    )
