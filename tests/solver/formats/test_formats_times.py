"""Columns of times. Oracle: records made at a known step, and straight lines."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fixtures.errors import input_problems
from fixtures.spaces import spaced
from solver.formats import read_motion_file, read_record
from solver.formats.source import Source
from solver.formats.times import LOSS, is_even, sampled

pytestmark = pytest.mark.quick

SOURCE = Source(name="a.csv", lines=[], units="g", dt_s=float("nan"))


def share_said(note):
    """By which part of the peak a sample is moved, as a note says."""
    return float(spaced(note).split("more than ")[1].split("%")[0]) / 100.0


class TestEvenTimes:
    @pytest.mark.parametrize(
        ("dt_s", "places", "n"),
        [(0.005, 3, 6001), (0.005, 9, 10), (1 / 128, 3, 4000), (1 / 256, 4, 999), (0.025, 2, 800)],
    )
    def test_times_rounded_as_printed_give_the_whole_step(self, file, dt_s, places, n):
        text = "".join(f"{i * dt_s:.{places}f},-0.1\n" for i in range(n))
        motion_file = read_motion_file(file(text), units="g")
        assert motion_file.notes == ()
        record = motion_file.channel()
        assert (record.dt_s, len(record.a_mps2)) == (dt_s, n)

    def test_times_of_single_precision_or_from_anywhere_are_even_enough(self, file):
        times = np.float32(0.01) * np.arange(3000, dtype=np.float32)
        text = "".join(f"{float(t)!r} -0.1\n" for t in times)
        assert read_record(file(text), units="g").dt_s == pytest.approx(0.01, rel=1e-6)
        assert read_record(file("-0.5,1\n-0.25,2\n0,3\n"), units="g").dt_s == 0.25
        text = "".join(f"{i / 120:.3f},-0.1\n" for i in range(50))
        assert read_record(file(text), units="g", dt_s=1 / 120).dt_s == 1 / 120
        assert is_even(np.array([0.0, 0.5, 1.0]))
        assert not is_even(np.array([1.0, 0.5, 0.0]))


class TestRoundedTimes:
    @pytest.mark.parametrize(
        ("dt_s", "places", "n"),
        [(0.005, 2, 200), (0.005, 2, 4001), (0.004, 2, 77), (1 / 128, 2, 900), (1 / 120, 2, 3000),
         (0.0002, 3, 5000), (0.0025, 2, 60)],
    )  # fmt: skip
    def test_times_that_stand_twice_take_the_step_that_is_said(self, file, dt_s, places, n):
        text = "".join(f"{i * dt_s:.{places}f},{i % 7 - 3}\n" for i in range(n))
        (problem,) = input_problems(read_motion_file, file(text), units="m/s2")
        told = f"roof.csv: the times are rounded to {10**-places:g} s, {n - 1} steps over "
        assert problem.startswith(told)
        advised = float(problem.split("such as ")[1])
        assert advised == pytest.approx(dt_s, rel=1e-8)
        motion_file = read_motion_file(file(text), units="m/s2", dt_s=advised)
        assert motion_file.channel().dt_s == advised
        assert motion_file.channel().a_mps2.tolist() == [i % 7 - 3 for i in range(n)]
        assert "a missing sample would not be noticed" in motion_file.notes[0]
        assert input_problems(read_motion_file, file(text), units="m/s2", dt_s=1.1 * dt_s) == (
            problem,
        )

    def test_one_time_that_is_there_twice_is_a_fault(self, file):
        text = "".join(f"{0.01 * (i - (i > 50)):.2f},-1\n" for i in range(100))
        (problem,) = input_problems(read_motion_file, file(text), units="g", dt_s=0.01)
        assert problem.startswith("roof.csv:52: found time 0.5 s after 0.5 s, with a typical")


class TestUnevenTimes:
    def test_coarser_grids_lose_nothing_and_peaks_are_kept_or_their_loss_told(self):
        t = np.array([0.0, 0.02, 0.03, 0.07, 0.08, 0.09])
        a = np.array([[0.0, 1.0, -2.0, 0.5, 3.0, 0.0]])
        dt_s, columns, notes = sampled(SOURCE, t, a, int)
        assert dt_s == 0.01
        expected = [0.0, 0.5, 1.0, -2.0, -1.375, -0.75, -0.125, 0.5, 3.0, 0.0]
        assert columns[0].tolist() == pytest.approx(expected, abs=1e-12)
        assert spaced(notes) == (
            "times are uneven, steps of 0.01 to 0.04 s: resampled at 0.01 s by linear"
            " interpolation, which changes no sample",
        )
        dt_s, columns, notes = sampled(SOURCE, np.array([0.0, 0.1, 0.15]), np.zeros((1, 3)), int)
        assert dt_s == 0.05
        assert columns.tolist() == [[0.0] * 4]
        t = np.r_[np.arange(0, 100) * 0.01, 1.0037, 1.0081 + np.arange(0, 100) * 0.01]
        a = 5.0 * (np.arange(201)[None, :] == 100)
        dt_s, columns, notes = sampled(SOURCE, t, a, int)
        assert np.abs(columns).max() >= 5.0 * (1.0 - LOSS)
        assert dt_s < 0.01
        t = np.r_[np.arange(0, 100) * 0.01, 0.9900101, 1.0 + np.arange(0, 100) * 0.01]
        a = 5.0 * (np.arange(201)[None, :] == 100)
        _, _, (note,) = sampled(SOURCE, t, a, int)
        assert 0.5 < share_said(note) <= 1.0

    @given(
        st.lists(st.tuples(st.floats(0.002, 0.05), st.floats(-1.0, 1.0)), min_size=20, max_size=60)
    )
    def test_no_sample_is_moved_by_more_than_the_note_says(self, steps):
        t = np.cumsum([step for step, _ in steps])
        a = np.array([value for _, value in steps])
        dt_s, columns, notes = sampled(SOURCE, t, a[None, :], int)
        if not notes:
            return
        even = t[0] + dt_s * np.arange(columns.shape[1])
        moved = np.abs(np.interp(t, even, columns[0]) - a).max()
        said = share_said(notes[0] + " more than 0%")
        assert moved <= (1.05 * said + 1e-9) * np.abs(a).max()
        finest = dt_s <= np.median(np.diff(t)) / 80.0
        assert said <= LOSS or finest
        assert abs(even[-1] - t[-1]) < dt_s * (1.0 + 1e-6)

    @pytest.mark.parametrize("gap", [1, 500, 998])
    def test_a_lost_sample_is_a_straight_line(self, file, gap):
        rows = [f"{i / 100:.2f},{i % 7 - 3}\n" for i in range(1000) if i != gap]
        motion_file = read_motion_file(file("".join(rows)), units="m/s2")
        dt_s, a = motion_file.channel().dt_s, motion_file.channel().a_mps2
        assert (dt_s, len(a)) == (0.01, 1000)
        assert a[gap] == pytest.approx((a[gap - 1] + a[gap + 1]) / 2.0)
        assert "times are uneven, steps of 0.01 to 0.02 s" in spaced(motion_file.notes[0])

    def test_gaps_are_told_and_drifting_steps_and_all_columns_resampled(self, file):
        t = [i / 100 + 2.0 * (i // 20) for i in range(120)]
        motion_file = read_motion_file(file("".join(f"{x:.2f},-1\n" for x in t)), units="g")
        assert motion_file.notes[1] == (
            "roof.csv:21: no samples between 0.19 and 2.2 s: interpolated linearly"
        )
        assert len(motion_file.notes) == 5
        assert motion_file.notes[-1] == "... and 2 more gaps"
        text = "".join(f"{0.01 * i + 1e-6 * i * i:.7f},{-i}\n" for i in range(90))
        record = read_record(file(text), units="m/s2")
        t = record.dt_s * np.arange(len(record.a_mps2))
        i = (-0.01 + np.sqrt(1e-4 + 4e-6 * t)) / 2e-6
        assert -record.a_mps2[:-1] == pytest.approx(i[:-1], abs=1e-4 * 90)
        motion_file = read_motion_file(file("t_s,x_g,y_g\n0,0,1\n1,1,0\n3,3,2\n"))
        assert [len(record.a_mps2) for record in motion_file.channels] == [4, 4]
        assert motion_file.channel("y").a_mps2.tolist() == pytest.approx(
            [9.80665, 0, 9.80665, 19.6133]
        )

    def test_uneven_times_agree_with_no_step_and_grow_to_a_limit(self, file):
        assert input_problems(read_record, file("0 1\n1 2\n3 4\n"), units="g", dt_s=1.0) == (
            "roof.csv: found uneven times but the entered time step is 1 s; omit it, and the"
            " record is resampled",
        )
        path = file("0 1\n1e-6 2\n2e-6 3\n3e-6 4\n1e9 5\n")
        (problem,) = input_problems(read_record, path, units="g")
        assert problem.endswith("use a record of at most 2,000,000 steps")
        record = read_record(file("0 1\n1 2\n2 1\n3 2\n1999999 3\n"), units="g")
        assert (record.dt_s, record.a_mps2.size) == (1.0, 2_000_000)
