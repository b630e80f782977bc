"""Records and spectra. Oracles: hand-written files, closed forms, matrix exponentials."""

from __future__ import annotations

import csv
import itertools
import math
from pathlib import Path
from typing import Any

import mpmath
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from solver import kernels, motion
from solver.model import InputError
from solver.motion import Record, read_record, record_from_values, response_spectrum, write_record

G = 9.80665
RECORDS = Path(__file__).resolve().parents[2] / "shared" / "records"

motions = st.lists(st.floats(-20.0, 20.0, width=32), min_size=2, max_size=40).map(np.array)


def manifest() -> list[dict[str, str]]:
    """Rows of the folder of real records, none where the folder is not present."""
    path = RECORDS / "MANIFEST.csv"
    if not path.is_file():
        return []
    return list(csv.DictReader(path.read_text(encoding="utf-8").splitlines()))


def columns_of(*formats: str) -> list[Any]:
    rows = [row for row in manifest() if row["format"] in formats]
    skipped = pytest.param(None, marks=pytest.mark.skip(reason="folder of real records absent"))
    return [pytest.param(row, id=row["file"]) for row in rows] or [skipped]


@pytest.fixture
def file(tmp_path: Path) -> Any:
    def write(content: str | bytes, name: str = "roof.csv") -> Path:
        path = tmp_path / name
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        return path

    return write


def problems_of(path: Path, **how: Any) -> tuple[str, ...]:
    with pytest.raises(InputError) as caught:
        read_record(path, **({"units": "g"} | how))
    return caught.value.problems


class TestReading:
    @pytest.mark.parametrize(
        "content",
        [
            "0.00,0.1\n0.02,-0.2\n0.04,0.3\n",
            "0.00;0.1\n0.02;-0.2\n0.04;0.3",
            "0.00\t0.1\n0.02\t-0.2\n0.04\t0.3\n",
            "  0.00   0.1\n  0.02  -0.2\n  0.04   0.3\n",
            "0.00 , 0.1\n0.02 , -0.2\n0.04 , 0.3\n",
            "time_s,acceleration_g\n0.00,0.1\n0.02,-0.2\n0.04,0.3\n",
            "Time [s] Acceleration [g]\n0.00 0.1\n0.02 -0.2\n0.04 0.3\n",
            "# made by hand\n\n0.00,0.1\n0.02,-0.2  # trough\n\n0.04,0.3\n# end\n",
            "0.00,0.1\r\n0.02,-0.2\r\n0.04,0.3\r\n",
            "0.00,0.1\r0.02,-0.2\r0.04,0.3\r",
            "0.00,1e-1\n2E-2,-.2\n+0.04,3.e-1\n",
            "\ufefftime,acc\n0.00,0.1\n0.02,-0.2\n0.04,0.3\n",
            "time,acc\n0.00,0.1\n0.02,-0.2\n0.04,0.3\n".encode("utf-16"),
            "Zeit,a in m/s²\n0.00,0.1\n0.02,-0.2\n0.04,0.3\n".encode("latin-1"),
        ],
    )
    def test_two_columns_read_alike_however_they_are_set(
        self, file: Any, content: str | bytes
    ) -> None:
        record = read_record(file(content), units="g")
        assert record.name == "roof.csv"
        assert record.dt_s == 0.02
        assert record.a_mps2.tolist() == [0.1 * G, -0.2 * G, 0.3 * G]

    @pytest.mark.parametrize("content", ["1\n-2\n3\n", "acc\n1\n-2\n3", "# x\n 1\n\n-2 \n3"])
    def test_one_column_takes_its_step_from_the_argument(self, file: Any, content: str) -> None:
        record = read_record(file(content), units="m/s2", dt_s=0.005)
        assert record.dt_s == 0.005
        assert record.a_mps2.tolist() == [1.0, -2.0, 3.0]

    @pytest.mark.parametrize(("unit", "size"), [("m/s2", 1), ("cm/s2", 0.01), ("mm/s2", 0.001)])
    def test_units_are_converted(self, file: Any, unit: str, size: float) -> None:
        record = read_record(file("0,100\n1,200\n"), units=unit)
        assert record.a_mps2.tolist() == pytest.approx([100 * size, 200 * size], rel=1e-15)

    def test_a_record_is_frozen_to_its_samples(self, file: Any) -> None:
        record = read_record(file("0,0\n1,0\n"), units="g")
        assert not record.a_mps2.flags.writeable
        assert record.a_mps2.dtype == np.float64
        with pytest.raises(ValueError, match="read-only"):
            record.a_mps2[0] = 1.0

    @pytest.mark.parametrize(
        ("dt_s", "places", "n"),
        [(0.005, 3, 6001), (0.005, 9, 10), (1 / 128, 3, 4000), (1 / 256, 4, 999), (0.025, 2, 800)],
    )
    def test_times_rounded_as_printed_give_the_whole_step(
        self, file: Any, dt_s: float, places: int, n: int
    ) -> None:
        text = "".join(f"{i * dt_s:.{places}f},0.1\n" for i in range(n))
        assert read_record(file(text), units="g").dt_s == dt_s

    def test_times_of_single_precision_are_even_enough(self, file: Any) -> None:
        times = np.float32(0.01) * np.arange(3000, dtype=np.float32)
        text = "".join(f"{float(t)!r} 0.1\n" for t in times)
        assert read_record(file(text), units="g").dt_s == pytest.approx(0.01, rel=1e-6)

    def test_times_may_start_anywhere(self, file: Any) -> None:
        assert read_record(file("-0.5,1\n-0.25,2\n0,3\n"), units="g").dt_s == 0.25

    def test_a_given_step_that_agrees_is_kept(self, file: Any) -> None:
        text = "".join(f"{i / 120:.3f},0.1\n" for i in range(50))
        assert read_record(file(text), units="g", dt_s=1 / 120).dt_s == 1 / 120

    @pytest.mark.parametrize("row", columns_of("plain column", "csv"))
    def test_real_records_have_the_step_count_and_peak_of_the_manifest(
        self, row: dict[str, str]
    ) -> None:
        step = float(row["dt_s"]) if row["format"] == "plain column" else None
        record = read_record(RECORDS / row["file"], units="g", dt_s=step)
        assert record.dt_s == float(row["dt_s"])
        assert len(record.a_mps2) == int(row["npts"])
        assert np.abs(record.a_mps2).max() / G == pytest.approx(float(row["pga_g"]), rel=1e-4)


class TestFaults:
    @pytest.mark.parametrize(
        ("content", "expected"),
        [
            ("0,1\n0.1,abc\n", ["2: found 'abc'; give a number"]),
            ("0,1\n0.1,NaN\n0.2,-inf\n", ["2: found 'NaN'; give", "3: found '-inf'; give"]),
            ("nan,1\n0.1,2\n", ["1: found 'nan'; give a number"]),
            ("t,a\n0,1\n0.1,1e999\n", ["3: found '1e999'; give a number"]),
            ("0,1\n0.1,\n", ["2: found ''; give a number"]),
            ("0,1\n0.1,1_0\n0.2,x\n", ["2: found '1_0'", "3: found 'x'"]),
            ("0 1\n0.1\n0.2 1 2\n", ["2: found 1 column; give 2", "3: found 3 columns; give 2"]),
            ("0 1 2\n0.1 3 4\n", ["1: found 3 columns; give one (acc"]),
            ("0,0;0,12\n0.1;2\n", ["1: found '0,0'; give a number with a decimal point", "1: fou"]),
            ("0.1 0,12\n0.2 0,13\n", ["1: found '0,12'; give a number with a dec", "2: found"]),
            ("a\n\n# x\n0,12\n0,13\n-0,11", ["4: found '0,12'; give a number with a decimal"]),
            ("0 1\n1 2\n2 3\n4 4\n5 5", ["4: found time 4 s after 2 s, the usual step being 1 s"]),
            ("2 1\n1 2\n0 3\n", ["2: found time 1 s after 2 s", "3: found time 0 s after 1 s"]),
            ("0 1\n0 2\n", ["2: found time 0 s after 0 s"]),
            ("0 1\n1e-320 2\n", ["2: found time 9.99989e-321 s after 0 s"]),
            ("0 1\n" + "1" * 1200 + " 2\n", ["2: found a line of 1202 characters; give at"]),
        ],
    )
    def test_each_line_at_fault_is_named_with_what_would_do(
        self, file: Any, content: str, expected: list[str]
    ) -> None:
        problems = problems_of(file(content))
        starts = [f"roof.csv:{line}" for line in expected]
        assert [p[: len(s)] for p, s in zip(problems, starts, strict=True)] == starts

    @pytest.mark.parametrize(
        ("content", "expected"),
        [
            ("", "found no numbers"),
            ("# nothing\n\n", "found no numbers"),
            ("time,acc\n", "found no numbers"),
            ("0,1\n", "found 1 sample; give at least 2"),
            ("1\n2\n", "found one column, without times; give the time step dt"),
            (b"\x89PNG\r\n\x1a\n\x00", "not a text file"),
            (b"\xff\xfe\x00", "not a text file"),
        ],
    )
    def test_a_file_without_a_record_is_refused(
        self, file: Any, content: str | bytes, expected: str
    ) -> None:
        (problem,) = problems_of(file(content))
        assert problem.startswith(f"roof.csv: {expected}")

    def test_what_is_not_a_file_is_refused(self, tmp_path: Path) -> None:
        assert problems_of(tmp_path / "none.csv")[0].startswith("none.csv: no such file")
        assert problems_of(tmp_path)[0].startswith(f"{tmp_path.name}: not a file")

    def test_a_file_that_may_not_be_opened_says_why(
        self, file: Any, monkeypatch: pytest.MonkeyPatch
    ) -> None:
        def refuse(path: Path) -> bytes:
            raise PermissionError(13, "Permission denied")

        monkeypatch.setattr(Path, "read_bytes", refuse)
        assert problems_of(file("0,1\n")) == ("roof.csv: cannot be read (Permission denied)",)

    def test_a_file_beyond_the_size_cap_is_not_opened(
        self, file: Any, monkeypatch: pytest.MonkeyPatch
    ) -> None:
        monkeypatch.setattr(motion, "MAX_BYTES", 3)
        assert problems_of(file("0,1\n1,1\n"))[0].endswith("give at most 0 MB")

    def test_many_faults_are_cut_short_and_counted(self, file: Any) -> None:
        problems = problems_of(file("0.1\n" + "x\n" * 37), dt_s=0.1)
        assert len(problems) == 11
        assert problems[9:] == ("roof.csv:11: found 'x'; give a number", "... and 27 more")

    @pytest.mark.parametrize("gap", [1, 500, 998])
    def test_a_lost_sample_is_found_at_its_line(self, file: Any, gap: int) -> None:
        rows = [f"{i / 100:.2f},0.1\n" for i in range(1000) if i != gap]
        (problem,) = problems_of(file("".join(rows)))
        assert problem.startswith(f"roof.csv:{gap + 1}: found time {(gap + 1) / 100:g} s after")

    def test_a_step_that_drifts_is_refused(self, file: Any) -> None:
        text = "".join(f"{0.01 * i + 1e-6 * i * i:.7f},0.1\n" for i in range(200))
        (problem,) = problems_of(file(text))
        assert "give even, rising times" in problem

    def test_a_given_step_that_disagrees_is_refused(self, file: Any) -> None:
        (problem,) = problems_of(file("0,1\n0.01,2\n"), dt_s=0.02)
        assert problem == "roof.csv: the times step by 0.01 s but dt is 0.02 s; give one of them"

    @pytest.mark.parametrize("dt_s", [0.0, -0.01, math.nan, math.inf])
    def test_unknown_units_and_impossible_steps_are_refused_together(
        self, file: Any, dt_s: float
    ) -> None:
        problems = problems_of(file("0,1\n"), units="gal", dt_s=dt_s)
        assert problems[0] == "roof.csv: unit is 'gal'; give one of g, m/s2, cm/s2, mm/s2"
        assert problems[1].startswith(f"roof.csv: time step dt is {dt_s!r}; give a number")

    def test_pasted_values_at_fault_are_named_by_their_place(self) -> None:
        values = [0.1, None, "0,2", math.nan, 3, True, 10**400]
        with pytest.raises(InputError) as caught:
            record_from_values("Motions!D", values, units="g", dt_s=0.01)
        assert [p.split(";")[0] for p in caught.value.problems] == [
            "Motions!D: value 2 is None",
            "Motions!D: value 3 is '0,2'",
            "Motions!D: value 4 is nan",
            "Motions!D: value 6 is True",
            "Motions!D: value 7 is 1000000000000000000000000000...0",
        ]

    def test_pasted_values_need_two_samples(self) -> None:
        with pytest.raises(InputError, match="give at least 2 values"):
            record_from_values("M1", [1.0], units="g", dt_s=0.01)


def test_pasted_values_make_the_record_that_a_file_makes(file: Any) -> None:
    pasted = record_from_values("M1", np.array([1.0, 2.5]), units="g", dt_s=0.5)
    filed = read_record(file("0,1\n0.5,2.5\n"), units="g")
    assert pasted.dt_s == filed.dt_s
    assert pasted.a_mps2.tolist() == filed.a_mps2.tolist()


class TestWriting:
    @pytest.mark.parametrize("dt_s", [0.005, 0.02, 1 / 128, 1 / 3])
    def test_a_rounded_record_comes_back_bit_for_bit(self, tmp_path: Path, dt_s: float) -> None:
        counts = np.random.default_rng(1).integers(-150_000, 150_000, 500)
        record = Record(name="M1", dt_s=dt_s, a_mps2=counts / 1e5 * G)
        write_record(tmp_path / "m1.csv", record)
        back = read_record(tmp_path / "m1.csv", units="g")
        assert np.array_equal(back.a_mps2, record.a_mps2)
        assert back.dt_s == pytest.approx(dt_s, rel=1e-9)

    def test_the_file_is_plain_csv_with_a_heading(self, tmp_path: Path) -> None:
        record = Record(name="M1", dt_s=0.005, a_mps2=np.array([0.0, -1e-9, 0.25]) * G)
        write_record(tmp_path / "m1.csv", record)
        expected = b"time_s,acceleration_g\n0.000,0.00000\n0.005,0.00000\n0.010,0.25000\n"
        assert (tmp_path / "m1.csv").read_bytes() == expected

    @pytest.mark.parametrize("unit", sorted(motion.UNITS))
    def test_any_unit_keeps_a_hundred_thousandth_of_g(self, tmp_path: Path, unit: str) -> None:
        values = np.random.default_rng(2).normal(0.0, 3.0, 200)
        write_record(tmp_path / "a.csv", Record(name="a", dt_s=0.01, a_mps2=values), unit)
        back = read_record(tmp_path / "a.csv", units=unit).a_mps2
        assert np.abs(back - values).max() < 1e-5 * G

    @pytest.mark.parametrize("peak_g", [1e-12, 3e-4, 0.7, 1.0, 12.0])
    def test_a_record_of_any_size_is_kept_to_the_part_of_its_peak_asked_for(
        self, tmp_path: Path, peak_g: float
    ) -> None:
        values = np.random.default_rng(3).uniform(-1.0, 1.0, 300) * peak_g * G
        path = tmp_path / "a.csv"
        write_record(path, Record(name="a", dt_s=0.01, a_mps2=values), within=1e-9)
        back = read_record(path, units="g").a_mps2
        assert np.abs(back - values).max() <= 1.001e-9 * np.abs(values).max()

    def test_no_decimals_are_printed_that_say_nothing(self, tmp_path: Path) -> None:
        values = np.array([0.0, 0.25, -0.125]) * G
        write_record(tmp_path / "a.csv", Record(name="a", dt_s=0.01, a_mps2=values), within=1e-9)
        assert (tmp_path / "a.csv").read_text().splitlines()[1:] == [
            "0.00,0.00000",
            "0.01,0.25000",
            "0.02,-0.12500",
        ]


def exact_psa(a: list[float], dt: float, period: float, damping: float) -> float:
    """Largest omega^2 |u| at the samples, by a 40-digit matrix exponential of the whole system.

    State: u, u', acceleration now and its rate in the interval.
    """
    with mpmath.workdps(40):
        w = 2 * mpmath.pi / mpmath.mpf(period)
        system = mpmath.matrix(
            [[0, 1, 0, 0], [-w * w, -2 * mpmath.mpf(damping) * w, -1, 0], [0, 0, 0, 1], [0] * 4]
        )
        step = mpmath.expm(system * mpmath.mpf(dt), method="taylor")
        u, v, peak = mpmath.mpf(0), mpmath.mpf(0), mpmath.mpf(0)
        for now, then in itertools.pairwise(a):
            rate = (mpmath.mpf(then) - mpmath.mpf(now)) / mpmath.mpf(dt)
            u, v = (step * mpmath.matrix([u, v, now, rate]))[:2]
            peak = max(peak, abs(u))
        return float(w * w * peak)


class TestSpectrum:
    @pytest.mark.parametrize("damping", [0.0, 0.05, 0.7, 0.99])
    def test_it_agrees_with_matrix_exponentials_to_rounding(self, damping: float) -> None:
        a = np.random.default_rng(3).normal(0.0, 2.0, 40)
        periods = [1e-3, 0.02, 0.0314159, 0.0628, 0.0629, 0.1, 0.5, 3.0, 50.0, 1e4, 1e8]
        expected = [exact_psa(a.tolist(), 0.01, period, damping) for period in periods]
        got = response_spectrum(a, 0.01, periods, damping)
        assert got == pytest.approx(expected, rel=2e-13)

    def test_a_suddenly_applied_acceleration_is_doubled_without_damping(self) -> None:
        # omega^2 u = -a (1 - cos omega t), largest at t = T/2: a sample for T = 0.2.
        a = np.full(101, 3.0)
        assert response_spectrum(a, 0.01, [0.2], 0.0) == pytest.approx([6.0], rel=1e-13)

    def test_a_ramp_is_followed_in_closed_form(self) -> None:
        # omega^2 u = -r (t - sin(omega t) / omega) without damping.
        t = 0.01 * np.arange(300)
        w = 2.0 * np.pi / np.array([0.05, 0.7, 9.0])
        expected = np.abs(5.0 * (t - np.sin(np.outer(w, t)) / w[:, None])).max(axis=1)
        got = response_spectrum(5.0 * t, 0.01, 2.0 * np.pi / w, 0.0)
        assert got == pytest.approx(expected, rel=1e-12)

    def test_resonance_grows_towards_one_over_twice_the_damping(self) -> None:
        t = 0.002 * np.arange(10_000)
        (psa,) = response_spectrum(np.sin(2.0 * np.pi * t), 0.002, [1.0], 0.05)
        assert psa == pytest.approx(10.0 * (1.0 - math.exp(-0.05 * 2.0 * math.pi * 20)), rel=2e-3)

    def test_very_long_periods_feel_the_displacement_of_the_ground(self) -> None:
        a = np.random.default_rng(4).normal(0.0, 1.0, 60)
        # Twice integrated by hand: exact for straight lines between samples.
        velocity = np.r_[0.0, np.cumsum(0.5 * (a[1:] + a[:-1]) * 0.02)]
        gain = velocity[:-1] * 0.02 + (2.0 * a[:-1] + a[1:]) * 0.02**2 / 6.0
        displacement = np.abs(np.cumsum(gain)).max()
        periods = np.array([1e6, 1e9])
        got = response_spectrum(a, 0.02, periods) * (periods / (2.0 * np.pi)) ** 2
        assert got == pytest.approx([displacement] * 2, rel=1e-5)

    @given(motions)
    def test_period_zero_is_the_peak_acceleration(self, a: Any) -> None:
        near, at = response_spectrum(a, 0.01, [1e-9, 0.0])
        assert at == np.abs(a).max()
        assert response_spectrum(a, 0.01, [5e-324])[0] == at
        assert near == pytest.approx(np.abs(a[1:]).max(), rel=1e-5, abs=1e-6)

    @given(motions, st.floats(-50.0, 50.0))
    def test_it_scales_with_the_record_whatever_its_sign(self, a: Any, factor: float) -> None:
        periods = [0.0, 0.03, 0.4, 7.0]
        expected = abs(factor) * response_spectrum(a, 0.01, periods)
        assert response_spectrum(factor * a, 0.01, periods) == pytest.approx(expected, abs=1e-12)

    @given(motions)
    def test_samples_put_between_the_samples_only_add_peaks(self, a: Any) -> None:
        half = np.arange(2 * len(a) - 1) / 2.0
        finer = np.interp(half, np.arange(len(a)), a)
        periods = [0.03, 0.4, 7.0]
        coarse = response_spectrum(a, 0.01, periods)
        assert np.all(response_spectrum(finer, 0.005, periods) >= coarse * (1 - 1e-12) - 1e-12)

    def test_it_takes_time_and_period_in_proportion(self) -> None:
        a = np.random.default_rng(5).normal(0.0, 1.0, 100)
        slow = response_spectrum(a, 0.08, [0.8, 16.0])
        assert slow == pytest.approx(response_spectrum(a, 0.01, [0.1, 2.0]), rel=1e-13)

    def test_a_record_at_rest_has_no_spectrum(self) -> None:
        assert response_spectrum(np.zeros(10), 0.01, [0.0, 0.1, 1.0]).tolist() == [0.0] * 3

    def test_the_kernel_says_with_which_sign_and_when_the_peak_is(self) -> None:
        a = np.r_[0.0, 1.0, np.zeros(200)]
        peak, at = np.empty(1), np.empty(1, dtype=np.int64)
        kernels.oscillator_peaks(motion._read_only(a), 0.01, np.array([2 * np.pi]), 0.0, peak, at)
        # A push of 0.01 m/s about t = 0.01 s: u = -0.01 sin(w t) / w, first trough at T/4.
        assert at.tolist() == [26]
        assert peak == pytest.approx([-0.01 * 2.0 * np.pi], rel=1e-3)

    @pytest.mark.parametrize(
        ("how", "expected"),
        [
            ({"a_mps2": [1.0, math.nan]}, "acceleration: give one column of finite numbers"),
            ({"a_mps2": [[1.0, 2.0]]}, "acceleration: give one column"),
            ({"a_mps2": []}, "acceleration: give one column"),
            ({"dt_s": 0.0}, "time step dt is 0.0; give a number of seconds above 0"),
            ({"periods_s": [-1.0]}, "periods: give one column of numbers of seconds, 0 or above"),
            ({"periods_s": [math.nan]}, "periods: give one column"),
            ({"damping": 1.0}, "damping is 1.0; give a fraction from 0 to below 1"),
        ],
    )
    def test_impossible_arguments_are_refused(self, how: dict[str, Any], expected: str) -> None:
        arguments: dict[str, Any] = {"a_mps2": [0.0, 1.0], "dt_s": 0.1, "periods_s": [1.0]} | how
        with pytest.raises(InputError) as caught:
            response_spectrum(**arguments)
        assert caught.value.problems[0].startswith(expected)
