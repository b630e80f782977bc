"""K-NET and KiK-net. Oracle: the wave that the samples were made of, as counts."""

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
                 6.25, -4, 2.5, -1.25, 0.75, -0.5, 0.25, -0.125])
# fmt: on


def problems_of(path: Path, **how: Any) -> tuple[str, ...]:
    with pytest.raises(InputError) as caught:
        read_motion_file(path, **how)
    return caught.value.problems


def test_counts_are_scaled_and_their_offset_is_kept() -> None:
    motion_file = read_motion_file(SAMPLES / "knet.ns")
    assert motion_file.format == "K-NET"
    record = motion_file.channel()
    assert (record.name, record.dt_s) == ("N-S", 0.01)
    counts = 13186 + np.round(200 * WAVE)
    assert record.a_mps2 == pytest.approx(counts * 3920 / 6182761 / 100, rel=1e-14)
    assert motion_file.notes == (
        "uncorrected: the mean is 0.00855 g, 40 % of the peak; it is not removed",
    )


def test_kik_net_channels_are_named_by_direction_and_place() -> None:
    motion_file = read_motion_file(SAMPLES / "kiknet.ew1")
    assert motion_file.format == "KiK-net"
    record = motion_file.channel()
    assert (record.name, record.dt_s) == ("EW1", 0.005)
    counts = -2471 + np.round(100 * WAVE)
    assert record.a_mps2 == pytest.approx(counts * 2000 / 8388608 / 100, rel=1e-14)
    assert motion_file.notes[1] == "the sensor is in the borehole, not at the surface"


def test_a_sensor_at_the_surface_needs_no_note(altered: Any) -> None:
    motion_file = read_motion_file(
        altered("kiknet.ew1", ("Dir.              2", "Dir.              6"))
    )
    assert motion_file.channel().name == "UD2"
    assert len(motion_file.notes) == 1


def test_the_peak_may_be_named_without_a_point(altered: Any) -> None:
    path = altered("knet.ns", ("Max. Acc. (gal)   ", "Max Acc. (gal)    "))
    assert read_motion_file(path).channel().name == "N-S"


@pytest.mark.parametrize(
    ("changes", "expected"),
    [
        ([("   15611", "   1561x")], ":18: found '1561x'; give a number"),
        ([("Duration Time(s)  0.2", "Duration Time(s)  0.3")], ":12: states 30 values, found 20"),
        ([("Duration Time(s)  0.2", "Duration Time(s)  0.1")], ":12: states 10 values, found 20"),
        ([("100Hz", "0Hz")], ":11: found '0Hz'; give a number above 0"),
        ([("100Hz", "unknown")], ":11: found 'unknown'; give a number above 0"),
        ([("3920(gal)/6182761", "3920/6182761")], ":14: found '3920/6182761'; give a scale as 39"),
        ([("3920(gal)/6182761", "3920(gal)/0")], ":14: found '3920(gal)/0'; give a scale as 392"),
        ([("(gal)/61", "(kin)/61")], ":14: found unit 'kin'; give an acceleration in g, m/s2"),
        ([("6182761", "618276")], ":15: the header states a peak of 0.01599 g, the values reach"),
        ([("Memo.", "Remark")], ": found no line Memo.; give the whole heading"),
        ([("Dir.", "Direct")], ": found no line Dir.; give the whole heading"),
    ],
)
def test_faults_are_told_with_their_line(
    altered: Any, changes: list[tuple[str, str]], expected: str
) -> None:
    (problem,) = problems_of(altered("knet.ns", *changes))
    assert problem.startswith(f"knet.ns{expected}")


def test_what_the_caller_says_must_agree() -> None:
    path = SAMPLES / "knet.ns"
    assert read_motion_file(path, units="gal", dt_s=0.01).channel().dt_s == 0.01
    assert "the file is in gal but units are g" in problems_of(path, units="g")[0]
    assert "the time step of the file is 0.01 s but dt is 0.02 s" in problems_of(path, dt_s=0.02)[0]
