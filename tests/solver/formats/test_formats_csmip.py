"""CSMIP volumes 1 and 2, and RENADIC. Oracle: the wave that the samples were made of."""

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


def problems_of(path: Path, **how: Any) -> tuple[str, ...]:
    with pytest.raises(InputError) as caught:
        read_motion_file(path, **how)
    return caught.value.problems


class TestVolume2:
    def test_accelerations_of_all_channels_are_taken(self) -> None:
        motion_file = read_motion_file(SAMPLES / "csmip-old.v2")
        assert motion_file.format == "CSMIP V2"
        assert motion_file.notes == ()
        assert [record.name for record in motion_file.channels] == [
            "CHAN 1: 360 DEG (STA CHN: 1) LOCATION: ROOF, NORTH WALL",
            "CHAN 2: UP (STA CHN: 2) LOCATION: ROOF, NORTH WALL",
        ]
        first, second = motion_file.channels
        assert (first.dt_s, second.dt_s) == (0.005, 0.005)
        assert first.a_mps2 == pytest.approx(WAVE / 100, rel=1e-14)
        assert second.a_mps2 == pytest.approx(-WAVE / 200, abs=0.51e-5)

    def test_touching_fields_are_cut_and_the_step_has_all_digits(self) -> None:
        record = read_motion_file(SAMPLES / "csmip-new.v2").channel()
        assert record.dt_s == 1 / 128
        assert record.a_mps2 == pytest.approx(1.5 * WAVE / 100, rel=1e-14)

    def test_a_step_within_the_rounding_of_the_heading_is_taken(self, altered: Any) -> None:
        path = altered("csmip-new.v2", ("  .0078125", "  .0000000"))
        assert read_motion_file(path).channel().dt_s == 0.008
        assert read_motion_file(path, dt_s=1 / 128).channel().dt_s == 1 / 128
        assert "but dt is 0.0086 s" in problems_of(path, dt_s=0.0086)[0]

    def test_a_rounded_step_that_contradicts_the_length_is_refused(self, altered: Any) -> None:
        long = altered("csmip-new.v2", ("  .0078125", "      .008"), ("  .1640625", "  .2640625"))
        (problem,) = problems_of(long)
        assert problem.startswith(
            "csmip-new.v2:38: the heading states 0.264062 s, the record lasts 0.168 s; give dt"
        )

    @pytest.mark.parametrize(
        ("changes", "expected"),
        [
            ([("    98.000", "  ********")], "47: found '********', a number too large for its"),
            ([("    98.000", "    wide  ")], "47: found 'wide'; give a number"),
            ([("    98.000", "    98,000")], "47: found '98,000'; give a number with a decimal"),
            ([("  -45.250\r\n", "  -45.250   1.0000\r\n")], "47: found 9 values; give 8"),
            ([("  -45.250\r\n", "\r\n")], "47: found 7 values; give 8"),
            ([("   21 POINTS OF ACCEL", "   22 POINTS OF ACCEL")], "46: states 22 values, found"),
            ([("   21 POINTS OF ACCEL", "   31 POINTS OF ACCEL")], "46: states 31 values, found"),
            ([("   21 POINTS OF ACCEL", "   16 POINTS OF ACCEL")], "46: states 16 values, found"),
            ([(" 21 POINTS OF ACCEL", " xx POINTS OF ACCEL")], "1: found no line ... POINTS OF"),
            ([("  .005 SEC.  (UNITS: CM/SEC/", "  .005 SEC.  (UNITS: CM/")], "46: found unit 'CM"),
            ([("(UNITS: CM/SEC/SEC)", "in cm/sec2. (free)")], "46: found format (free); give one"),
            ([("AT  .005 SEC.", "AT  .050 SEC.")], "46: found a step of 0.05 s and one of 0.005 s"),
            ([("  -123.456    CM", "  -923.456    CM")], "18: the header states a peak of 0.9417"),
        ],
    )
    def test_faults_are_told_with_their_line(
        self, altered: Any, changes: list[tuple[str, str]], expected: str
    ) -> None:
        (problem,) = problems_of(altered("csmip-old.v2", *changes))
        line, _, rest = expected.partition(":")
        assert problem.startswith(f"csmip-old.v2:{line}:")
        assert problem.split(": ", 1)[1].startswith(rest.strip())

    def test_faults_of_all_channels_are_told_together(self, altered: Any) -> None:
        text = (SAMPLES / "csmip-old.v2").read_text()
        path = altered("csmip-old.v2", ("   98.000", "   x8.000"), ("  -49.000", "  y49.000"))
        lines = text.splitlines()
        second = next(i for i, line in enumerate(lines) if "-49.000" in line) + 1
        assert problems_of(path) == (
            "csmip-old.v2:47: found 'x8.000'; give a number",
            f"csmip-old.v2:{second}: found 'y49.000'; give a number",
        )

    def test_a_file_cut_behind_its_accelerations_says_so(self, file: Any) -> None:
        text = (SAMPLES / "csmip-new.v2").read_text()
        motion_file = read_motion_file(file(text[: text.index("points of displ")]))
        assert motion_file.channel().a_mps2 == pytest.approx(1.5 * WAVE / 100, rel=1e-14)
        assert motion_file.notes[1:] == (
            "no end-of-data line (/&) follows the values: the file may be truncated",
        )

    def test_what_the_caller_says_must_agree(self) -> None:
        path = SAMPLES / "csmip-old.v2"
        assert len(read_motion_file(path, units="gal", dt_s=0.005).channels) == 2
        assert "the file is in CM/SEC/SEC but units are g" in problems_of(path, units="g")[0]
        assert (
            "the time step of the file is 0.005 s but dt is 0.02 s"
            in problems_of(path, dt_s=0.02)[0]
        )


class TestVolume1:
    def test_uneven_pairs_are_resampled(self) -> None:
        motion_file = read_motion_file(SAMPLES / "csmip-pairs.v1")
        assert motion_file.format == "CSMIP V1"
        record = motion_file.channel()
        assert record.name == "CHAN 1: 90 DEG (STA CHN: 1)"
        assert record.dt_s == 0.001
        t = [0.0, 0.012, 0.02, 0.033, 0.04, 0.052, 0.06, 0.071, 0.08, 0.092, 0.1, 0.111, 0.12]
        a = [0, 1.25, -2.5, 4.0, -6.125, 7.5, -5.25, 3.5, -2.0, 1.0, -0.5, 0.25, 0]
        expected = np.interp(np.arange(121) * 0.001, t, a) * G / 10
        assert record.a_mps2 == pytest.approx(expected, abs=1e-12)
        assert motion_file.notes[0].startswith("line 5 states 3 channels of the recorder, the file")
        assert motion_file.notes[1].startswith(
            "times are uneven, steps of 0.007 to 0.013 s: resampled"
        )
        assert motion_file.notes[2] == (
            "uncorrected: the mean is 0.0123 g, 1.6 % of the peak; it is not removed"
        )

    def test_even_values_under_their_own_format_are_read(self) -> None:
        motion_file = read_motion_file(SAMPLES / "csmip-even.raw")
        assert motion_file.format == "CSMIP V1"
        assert [record.name for record in motion_file.channels] == ["Chan 1: 360 Deg", "Chan 2: Up"]
        assert motion_file.channel("2").dt_s == 0.005
        assert motion_file.channel("1").a_mps2 == pytest.approx(WAVE / 1000 * G, abs=0.51e-6 * G)
        assert motion_file.channel("2").a_mps2 == pytest.approx(WAVE / 2000 * G, abs=0.51e-6 * G)

    def test_renadic_has_three_channels_in_tenths_of_g(self) -> None:
        motion_file = read_motion_file(SAMPLES / "renadic.v1")
        assert motion_file.format == "RENADIC V1"
        assert [record.name for record in motion_file.channels] == [
            "CHAN 1: L (STA CHN: 1)",
            "CHAN 2: V (STA CHN: 2)",
            "CHAN 3: T (STA CHN: 3)",
        ]
        assert {record.dt_s for record in motion_file.channels} == {0.005}
        for record, part in zip(motion_file.channels, (1, 2, 4), strict=True):
            expected = WAVE / 100 * G / part
            assert record.a_mps2 == pytest.approx(expected, abs=0.51e-4 * G)

    @pytest.mark.parametrize(
        ("name", "changes", "expected"),
        [
            (
                "renadic.v1",
                [("=     21", "=     26")],
                "11: states 52 values, found 42; give the",
            ),
            (
                "renadic.v1",
                [("=     21", "=     20")],
                "11: states 40 values, found more in line",
            ),
            (
                "renadic.v1",
                [("=     21", "=      1")],
                "11: states 2 values, found 10; correct the c",
            ),
            (
                "csmip-pairs.v1",
                [("=     13", "=      1")],
                "11: states 2 values, found 10; correct t",
            ),
            (
                "csmip-pairs.v1",
                [("=     13", "=      0")],
                "11: states 0 values; give at least 2",
            ),
            ("renadic.v1", [("NO. OF POINTS", "NO. OF THINGS")], "1: found no line NO. OF POINTS"),
            (
                "renadic.v1",
                [("ARE SEC AND G/10", "ARE UNKNOWN")],
                "1: found no line UNITS OF UNCOR",
            ),
            ("renadic.v1", [("AND G/10.", "AND VOLT.")], "12: found unit 'VOLT'; give an acceler"),
            ("renadic.v1", [("100.010  1.212", "100.010*******")], "28: found '*******', a number"),
            (
                "renadic.v1",
                [("100.010  1.212", "100.000  1.212")],
                "28: found time 100 s after 100",
            ),
            (
                "csmip-even.raw",
                [("at 200 pts/sec", "at 0 pts/sec")],
                "28: found 0 points per second",
            ),
            (
                "csmip-even.raw",
                [("(8f9.6)", "(free)")],
                "28: found 200 points per second in format",
            ),
            ("csmip-even.raw", [("units of g .", "units of v .")], "28: found unit 'v'; give an"),
            ("csmip-even.raw", [("   21 Acc", "   25 Acc")], "28: states 25 values, found 21; g"),
        ],
    )
    def test_faults_are_told_with_their_line(
        self, altered: Any, name: str, changes: list[tuple[str, str]], expected: str
    ) -> None:
        (problem,) = problems_of(altered(name, *changes))
        assert problem.startswith(f"{name}:{expected}")

    def test_spectra_are_refused(self, file: Any) -> None:
        content = "RESPONSE AND FOURIER AMPLITUDE SPECTRA\nCORRECTED ACCELEROGRAM\n"
        assert problems_of(file(content)) == (
            "roof.csv:1: found spectra; give a file of volume 1 or 2",
        )
