"""Text and csv. Oracle: hand-written files."""

import math

import numpy as np
import pytest

from solver.formats import read_motion_file, read_record
from solver.model import InputError

G = 9.80665


def problems_of(path, **how):
    with pytest.raises(InputError) as caught:
        read_record(path, **({"units": "g"} | how))
    return caught.value.problems


class TestOneAndTwoColumns:
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
            "Zeit,Größe in g\n0.00,0.1\n0.02,-0.2\n0.04,0.3\n".encode("latin-1"),
            "0.00,0.1\r\n0.02,-0.2\r\n0.04,0.3\r\n\x1a\x1a\x1a",
            "time [ms],acc\n0,0.1\n20,-0.2\n40,0.3\n",
        ],
    )
    def test_two_columns_read_alike_however_they_are_set(self, file, content):
        record = read_record(file(content), units="g")
        assert record.name == "roof.csv"
        assert record.dt_s == 0.02
        assert record.a_mps2.tolist() == [0.1 * G, -0.2 * G, 0.3 * G]

    @pytest.mark.parametrize("content", ["1\n-2\n3\n", "acc\n1\n-2\n3", "# x\n 1\n\n-2 \n3"])
    def test_one_column_takes_its_step_from_the_argument(self, file, content):
        record = read_record(file(content), units="m/s2", dt_s=0.005)
        assert record.dt_s == 0.005
        assert record.a_mps2.tolist() == [1.0, -2.0, 3.0]

    def test_a_record_is_frozen_to_its_samples(self, file):
        record = read_record(file("0,0\n1,0\n"), units="g")
        assert not record.a_mps2.flags.writeable
        assert record.a_mps2.dtype == np.float64
        with pytest.raises(ValueError, match="read-only"):
            record.a_mps2[0] = 1.0


class TestUnits:
    @pytest.mark.parametrize(
        ("unit", "size"), [("m/s2", 1), ("cm/s2", 0.01), ("gal", 0.01), ("mm/s2", 0.001)]
    )
    def test_given_units_are_converted(self, file, unit, size):
        record = read_record(file("0,100\n1,200\n"), units=unit)
        assert record.a_mps2.tolist() == pytest.approx([100 * size, 200 * size], rel=1e-15)

    @pytest.mark.parametrize(
        "heading",
        [
            "time_s,acc_gal\n",
            "t [s],a [cm/s2]\n",
            "t [s]; a (gal)\n",
            "Time (sec),Acceleration (CM/SEC/SEC)\n",
            "t,a in cm/s^2\n",
            "t a_cm/s2\n",
            "t_s,a_cm_s2\n",
            "t_s,a_cmps2\n",
            "# t_s,acc_gal  San Francisco, 42nd floor, resampled in 1990\n",
            "# Roof, north wall\n# units: cm/s2\n",
            "# accelerations in units of gal.\n",
            "# by hand [cm/s²]\ntime,acc\n",
        ],
    )
    def test_units_in_a_heading_or_a_remark_are_taken(self, file, heading):
        separator = ";" if ";" in heading else "," if "," in heading.split("#")[0] else " "
        rows = f"0{separator}100\n1{separator}200\n"
        if "t_s,acc_gal  San" in heading:
            rows = "0,100\n1,200\n"
        for units in ("", "gal", "cm/s2"):
            record = read_record(file(heading + rows), units=units)
            assert record.a_mps2.tolist() == [1.0, 2.0]

    def test_units_are_asked_for_where_a_file_does_not_say(self, file):
        (problem,) = problems_of(file("time,acc\n0,100\n1,200\n"), units="")
        assert problem == (
            "roof.csv: found no unit of acceleration; give units, one of g, m/s2, cm/s2, mm/s2,"
            " gal, or a heading such as acc_g"
        )

    def test_units_that_a_heading_contradicts_are_refused(self, file):
        (problem,) = problems_of(file("# x\ntime_s,acc_gal\n0,100\n1,200\n"), units="g")
        assert problem == (
            "roof.csv:2: the file is in gal but units are g; give the units of the file, or none"
        )

    def test_two_units_in_one_heading_are_refused(self, file):
        (problem,) = problems_of(file("# in g\n# units: gal\n0,1\n1,2\n"), units="")
        assert problem == "roof.csv:2: found units g and gal; give one"

    @pytest.mark.parametrize("heading", ["vel_cm/s", "velocity_g", "velocity", "Disp. [gal]"])
    def test_velocities_and_displacements_are_no_accelerations(self, file, heading):
        (problem,) = problems_of(file(f"time_s,{heading}\n0,1\n1,2\n"))
        assert problem == (
            f"roof.csv: found no column of accelerations beside '{heading}'; give one a heading"
            " such as acc_g"
        )

    def test_a_comment_that_contradicts_the_heading_is_a_question(self, file):
        content = "# north wall\n# units: gal\ntime_s,acc_g\n0,1\n1,2\n"
        (problem,) = problems_of(file(content), units="")
        assert problem == (
            "roof.csv:2: the comment states gal, the heading 'acc_g' states g: which is it?"
            " Correct one of them, or give the units"
        )
        for units, size in (("g", G), ("gal", 0.01), ("cm/s2", 0.01)):
            assert read_record(file(content), units=units).a_mps2.tolist() == [size, 2.0 * size]
        (problem,) = problems_of(file(content), units="m/s2")
        assert problem.startswith("roof.csv:2: the comment states gal, the heading 'acc_g'")

    @pytest.mark.parametrize("remark", ["converted from gal", "PGA [cm/s2] 300", "units: g or gal"])
    def test_a_comment_that_may_mean_something_else_asks_nothing(self, file, remark):
        record = read_record(file(f"# {remark}\ntime_s,acc_g\n0,1\n1,2\n"))
        assert record.a_mps2.tolist() == [G, 2.0 * G]


class TestStep:
    @pytest.mark.parametrize("remark", ["# dt = 0.005 s", "a_g  dt=5 ms", "# dt_s: 5e-3"])
    def test_a_step_that_a_remark_states_is_taken(self, file, remark):
        assert read_record(file(f"{remark}\n1\n2\n"), units="g").dt_s == 0.005

    def test_a_step_that_a_remark_contradicts_is_refused(self, file):
        (problem,) = problems_of(file("# dt = 0.005\n1\n2\n"), dt_s=0.01)
        assert problem == (
            "roof.csv:1: the time step of the file is 0.005 s but dt is 0.01 s; give the dt of the"
            " file, or none"
        )

    def test_a_given_step_that_disagrees_with_the_times_is_refused(self, file):
        (problem,) = problems_of(file("0,1\n0.01,2\n"), dt_s=0.02)
        assert problem == (
            "roof.csv: the time step in the file is 0.01 s but dt is 0.02 s; omit dt, or correct"
            " one of them"
        )

    def test_times_in_minutes_are_converted(self, file):
        content = "Time [min],a_g\n0,1\n0.001,2\n0.002,3\n"
        assert read_record(file(content)).dt_s == pytest.approx(0.06)

    @pytest.mark.parametrize("unit", ["us", "h", "samples", "UTC"])
    def test_times_in_an_unknown_unit_are_refused(self, file, unit):
        (problem,) = problems_of(file(f"Time [{unit}],a_g\n0,1\n1,2\n"), units="")
        assert problem == (
            f"roof.csv:1: found times in '{unit}'; give them in s, ms or min, such as time_s"
        )

    @pytest.mark.parametrize("dt_s", [math.nan, 0.005])
    def test_an_index_is_no_time(self, file, dt_s):
        (problem,) = problems_of(file("sample,a_g\n0,1\n1,2\n"), units="", dt_s=dt_s)
        assert problem == (
            "roof.csv:1: found 'sample' over the first column; give times in seconds, such as"
            " time_s, or delete the column and give the time step dt"
        )

    def test_a_component_to_the_north_is_no_index(self, file):
        content = "N,E\n0,1\n1,2\n0,3\n"
        assert len(read_motion_file(file(content), units="g", dt_s=0.1).channels) == 2


class TestSeveralColumns:
    CONTENT = "time_s,NS_g,EW [gal],UD_g,vel_cm/s\n0,1,2,3,9\n0.5,4,5,6,9\n"

    def test_headings_name_channels_and_each_has_its_unit(self, file):
        motion_file = read_motion_file(file(self.CONTENT))
        assert [record.name for record in motion_file.channels] == ["NS", "EW", "UD"]
        assert {record.dt_s for record in motion_file.channels} == {0.5}
        assert motion_file.channel("ew").a_mps2.tolist() == [0.02, 0.05]
        assert motion_file.channel("3").a_mps2.tolist() == [3 * G, 6 * G]
        assert motion_file.notes == ("column 'vel_cm/s' is ignored: it is not an acceleration",)

    def test_a_channel_must_be_chosen(self, file):
        (problem,) = problems_of(file(self.CONTENT), units="")
        assert problem == (
            "roof.csv: found several channels; give one by name or number: 1 NS; 2 EW; 3 UD"
        )
        (problem,) = problems_of(file(self.CONTENT), units="", channel="roof")
        assert problem.startswith("roof.csv: found no channel 'roof'; give one by name")

    def test_a_letter_g_among_letters_is_no_unit(self, file):
        content = "time_s,ch_f,ch_g,ch_h\n0,1,2,3\n1,4,5,6\n"
        motion_file = read_motion_file(file(content), units="gal")
        assert [record.name for record in motion_file.channels] == ["ch_f", "ch_g", "ch_h"]
        assert motion_file.channel("ch_g").a_mps2.tolist() == [0.02, 0.05]
        assert "found no unit" in problems_of(file(content), units="")[0]

    def test_columns_without_times_take_the_step_from_the_argument(self, file):
        named = read_motion_file(file("x_g,y_g\n1,2\n0,4\n"), dt_s=0.1)
        assert [record.name for record in named.channels] == ["x", "y"]
        plain = read_motion_file(file("x,y,z\n1,2,3\n0,4,5\n"), dt_s=0.1, units="m/s2")
        assert plain.channel("x").a_mps2.tolist() == [1.0, 0.0]
        (problem,) = problems_of(file("x_g,y_g\n1,2\n0,4\n"))
        assert problem == "roof.csv: found columns without times; give the time step dt"

    def test_a_comment_may_name_the_columns(self, file):
        motion_file = read_motion_file(file("# t  NS[g]  EW [g]\n0 1 2\n1 3 4\n"))
        assert motion_file.channel("ew").a_mps2.tolist() == [2 * G, 4 * G]

    @pytest.mark.parametrize(
        ("content", "expected"),
        [
            ("0 1 2\n0.1 3 4\n", "roof.csv:1: found 3 columns without a heading; give one that"),
            ("t,x,y,z\n0,1,2\n1,2,3\n", "roof.csv:1: found 4 headings over 3 columns; give one"),
            ("n,t_s,x_g\n0,1,2\n1,2,3\n", "roof.csv: found times in column 2; give them in the"),
            ("t_s,x_g,y_g\n0,1,2\n1,2\n", "roof.csv:3: found 2 columns; give 3 as in the first"),
        ],
    )
    def test_columns_that_make_no_sense_are_refused(self, file, content, expected):
        (problem,) = problems_of(file(content))
        assert problem.startswith(expected)

    def test_channels_of_one_name_are_told_apart(self, file):
        motion_file = read_motion_file(file("t_s,x_g,X_g,_g\n0,1,2,3\n1,4,5,6\n"))
        assert [record.name for record in motion_file.channels] == ["x", "X (2)", "channel 3"]


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
            ("0,1\n0.1,****\n", ["2: found '****', a number too large for its columns; give a"]),
            ("0 1\n0.1\n0.2 1 2\n", ["2: found 1 column; give 2", "3: found 3 columns; give 2"]),
            ("0,0;0,12\n0.1;2\n", ["1: found '0,0'; give a number with a decimal point", "1: fou"]),
            ("0.1 0,12\n0.2 0,13\n", ["1: found '0,12'; give a number with a dec", "2: found"]),
            ("a\n\n# x\n0,12\n0,13\n-0,11", ["4: found '0,12'; give a number with a decimal"]),
            ("2 1\n1 2\n0 3\n", ["2: found time 1 s after 2 s", "3: found time 0 s after 1 s"]),
            ("0 1\n0 2\n", ["2: found time 0 s after 0 s"]),
            ("0 1\n1e-320 2\n", ["2: found time 9.99989e-321 s after 0 s"]),
            ("0 1\n" + "1" * 1200 + " 2\n", ["2: found a line of 1202 characters; give at"]),
            ("a word\nand some more\nin prose\n", ["2: found 'and'; give a number", "2: f", "2"]),
        ],
    )
    def test_each_line_at_fault_is_named_with_what_would_do(self, file, content, expected):
        problems = problems_of(file(content))
        starts = [f"roof.csv:{line}" for line in expected]
        assert [p[: len(s)] for p, s in zip(problems, starts, strict=False)] == starts

    @pytest.mark.parametrize(
        ("content", "expected"),
        [
            ("", "found no numbers"),
            ("# nothing\n\n", "found no numbers"),
            ("time,acc\n", "found no numbers"),
            ("0,1\n", "found 1 sample; give at least 2"),
            ("1\n2\n", "found one column, without times; give the time step dt"),
        ],
    )
    def test_a_file_without_a_record_is_refused(self, file, content, expected):
        (problem,) = problems_of(file(content))
        assert problem.startswith(f"roof.csv: {expected}")

    def test_many_faults_are_cut_short_and_counted(self, file):
        problems = problems_of(file("0.1\n" + "x\n" * 37), dt_s=0.1)
        assert len(problems) == 11
        assert problems[9:] == ("roof.csv:11: found 'x'; give a number", "... and 27 more")

    def test_countless_faults_are_not_counted_to_the_end(self, file):
        problems = problems_of(file("0.1\n" + "x\n" * 12_000), dt_s=0.1)
        assert problems[10:] == ("... and more than 10000 more",)

    def test_times_and_velocities_are_no_accelerations(self, file):
        (problem,) = problems_of(file("Time (sec)   Vel (m/s)\n0.0 0.0\n0.012 1.0\n0.02 2.0\n"))
        assert problem.startswith("roof.csv: found no column of accelerations beside 'Vel (m/s)'")
