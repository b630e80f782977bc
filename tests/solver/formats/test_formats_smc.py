"""SMC of the U.S. Geological Survey. Oracle: the wave that the samples were made of."""

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
WAVE = np.array([0.25, -1.5, 12.125, -34.5, 98, -123.46, 77.125, -45.25, 30.5, -20, 15.75, -9.5,
                 6.25, -4, 2.5, -1.25, 0.75, -0.5, 0.25, -0.125, 0])
UNEVEN = np.array([(0, 0), (0.012, 12.5), (0.02, -25), (0.033, 40), (0.04, -61.25), (0.052, 75),
                   (0.06, -52.5), (0.071, 35), (0.08, -20), (0.092, 10), (0.1, -5), (0.111, 2.5),
                   (0.12, 0)])
# fmt: on


def problems_of(path: Path, **how: Any) -> tuple[str, ...]:
    with pytest.raises(InputError) as caught:
        read_motion_file(path, **how)
    return caught.value.problems


def test_a_corrected_file_is_read() -> None:
    motion_file = read_motion_file(SAMPLES / "smc-corrected.smc")
    assert motion_file.format == "USGS SMC"
    assert motion_file.notes == ()
    record = motion_file.channel()
    assert (record.name, record.dt_s) == ("up", 0.005)
    assert record.a_mps2 == pytest.approx(WAVE / 100, rel=1e-14)


def test_an_uncorrected_even_file_keeps_its_offset_and_says_so() -> None:
    motion_file = read_motion_file(SAMPLES / "smc-even.smc")
    record = motion_file.channel()
    assert (record.name, record.dt_s) == ("90", 0.01)
    assert record.a_mps2 == pytest.approx((0.25 * WAVE + 1.0) / 100, abs=1.01e-5)
    assert motion_file.notes == (
        "uncorrected: the mean is 0.00106 g, 3.5 % of the peak; it is not removed",
    )


def test_uneven_pairs_with_a_short_line_are_resampled() -> None:
    motion_file = read_motion_file(SAMPLES / "smc-uneven.smc")
    record = motion_file.channel()
    assert (record.name, record.dt_s) == ("45", 0.001)
    expected = np.interp(np.arange(121) * 0.001, *UNEVEN.T) / 100
    assert record.a_mps2 == pytest.approx(expected, abs=1e-13)
    assert motion_file.notes[0].startswith(
        "times are uneven, steps of 0.007 to 0.013 s: resampled at"
    )


def test_a_file_that_counts_its_pairs_is_read_alike(altered: Any) -> None:
    path = altered("smc-uneven.smc", ("        26    -32768", "        13    -32768"))
    given = read_motion_file(SAMPLES / "smc-uneven.smc").channel()
    assert np.array_equal(read_motion_file(path).channel().a_mps2, given.a_mps2)


def test_a_flagged_record_says_so(altered: Any) -> None:
    path = altered("smc-corrected.smc", ("        21    -32768", "        21         1"))
    assert read_motion_file(path).notes == (
        "the heading flags a problem with this record: read its comments",
    )


@pytest.mark.parametrize(
    ("name", "changes", "expected"),
    [
        ("smc-corrected.smc", [(" 1.2125E+1", " *********")], "30: found '*********', a nu"),
        ("smc-corrected.smc", [(" 1.2125E+1", " 1.21x5E+1")], "30: found '1.21x5E+1'; give a num"),
        ("smc-corrected.smc", [("        21  ", "        22  ")], "14: states 22 values, f"),
        ("smc-corrected.smc", [("        21  ", "        16  ")], "14: states 16 values, f"),
        ("smc-corrected.smc", [("        21  ", "    -32768  ")], "14: found no number of values"),
        ("smc-corrected.smc", [("         2\r", "    -32768\r")], "13: found no number of li"),
        ("smc-corrected.smc", [("         2\r", "         3\r")], "30: found a line without | am"),
        ("smc-corrected.smc", [("-0.1234600E+03", "-0.9234600E+03")], "23: the header states a pe"),
        ("smc-uneven.smc", [("        26  ", "        28  ")], "14: states 28 values, found 26;"),
        ("smc-uneven.smc", [(" 1.2500E+1", "          ")], "30: found ''; give a number"),
        ("smc-uneven.smc", [(" 2.0000E-2", " 1.2000E-2")], "30: found time 0.012 s after 0.012 s,"),
        ("smc-uneven.smc", [("-6.1250E+1", "          ")], "14: states 26 values, found 25; g"),
        ("smc-uneven.smc", [("-6.1250E+1", "          "), ("        26  ", "        25  ")],
         "31: found 1 values; give pairs of time and acceleration"),
    ],
)  # fmt: skip
def test_faults_are_told_with_their_line(
    altered: Any, name: str, changes: list[tuple[str, str]], expected: str
) -> None:
    (problem,) = problems_of(altered(name, *changes))
    assert problem.startswith(f"{name}:{expected}")


@pytest.mark.parametrize("kind", ["3 VELOCITY", "4 DISPLACEMENT", "5 RESPONSE SPECTRA"])
def test_other_quantities_are_refused(altered: Any, kind: str) -> None:
    (problem,) = problems_of(altered("smc-corrected.smc", ("2 CORRECTED ACCELEROGRAM", kind)))
    assert problem.startswith("smc-corrected.smc:1: found ")
    assert problem.endswith("; give a file of acceleration")


def test_what_the_caller_says_must_agree() -> None:
    path = SAMPLES / "smc-corrected.smc"
    assert read_motion_file(path, units="gal", dt_s=0.005).channel().dt_s == 0.005
    assert "the file is in cm/s2 but units are mm/s2" in problems_of(path, units="mm/s2")[0]
    assert (
        "the time step of the file is 0.005 s but dt is 0.01 s" in problems_of(path, dt_s=0.01)[0]
    )
