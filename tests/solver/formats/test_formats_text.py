"""Text and csv. Oracle: hand-written files."""

import math

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from fixtures.errors import input_problems
from fixtures.spaces import spaced
from solver.formats import read_motion_file, read_record

pytestmark = pytest.mark.quick

G = 9.80665


def problems_of(path, **how):
    return input_problems(read_record, path, **({"units": "g"} | how))


@pytest.mark.parametrize(
    "content",
    [
        "0.00,0.1\n0.02,-0.2\n0.04,0.3\n",
        "0.00;0.1\n0.02;-0.2\n0.04;0.3",
        "0.00 , 0.1\n0.02 , -0.2\n0.04 , 0.3\n",
        "time_s,acceleration_g\n0.00,0.1\n0.02,-0.2\n0.04,0.3\n",
        "Time [s] Acceleration [g]\n0.00 0.1\n0.02 -0.2\n0.04 0.3\n",
        "# made by hand\n\n0.00,0.1\n0.02,-0.2  # trough\n\n0.04,0.3\n# end\n",
        "0.00,0.1\r0.02,-0.2\r0.04,0.3\r",
        "0.00,1e-1\n2E-2,-.2\n+0.04,3.e-1\n",
        "\ufefftime,acc\n0.00,0.1\n0.02,-0.2\n0.04,0.3\n",
        "time,acc\n0.00,0.1\n0.02,-0.2\n0.04,0.3\n".encode("utf-16"),
        "Zeit,Größe in g\n0.00,0.1\n0.02,-0.2\n0.04,0.3\n".encode("latin-1"),
        "time [ms],acc\n0,0.1\n20,-0.2\n40,0.3\n",
        # What programs add to a table changes no number.
        '"Time (s)","Acc (g)"\n"0.00","0.1"\n"0.02","-0.2"\n"0.04","0.3"\n',
        '"Time";"Acc, g"\r\n"0,00";"0,1"\r\n"0,02";"-0,2"\r\n"0,04";"0,3"\r\n',
        "sep=|\nt|a\n0.00|0.1\n0.02|-0.2\n0.04|0.3\n",
        "Time\tAcc\nms\tg\n0\t0.1\n20\t-0.2\n40\t0.3\n",
        "% t a\n! made by hand\n// g\n0.00 0.1\n0.02 -0.2\n0.04 0.3\n",
        "Zeit Beschl\n0,00 0,1\n0,02 -0,2\n0,04 0,3\n",
        "t,a\n0.00,0.1\n0.02,\u22120.2\n0.04,0.3\n",
        b"0.00,0.1\r\r\n0.02,-0.2\r\r\n0.04,0.3\r\r\n" + bytes(500),
    ],
)
def test_two_columns_read_alike_however_they_are_set(file, content):
    record = read_record(file(content), units="g")
    assert (record.name, record.dt_s) == ("roof.csv", 0.02)
    assert record.a_mps2.tolist() == [0.1 * G, -0.2 * G, 0.3 * G]


@pytest.mark.nightly
@settings(max_examples=300, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(
    values=st.lists(st.integers(-900, 900), min_size=3, max_size=40),
    mark=st.sampled_from([",", ";", "\t"]),
    is_quoted=st.booleans(),
    is_told=st.booleans(),
    has_last_mark=st.booleans(),
    units_row=st.booleans(),
    end=st.sampled_from(["\n", "\r\n", "\r\r\n"]),
)
def test_any_dialect_of_a_table_has_the_same_samples(
    file, values, mark, is_quoted, is_told, has_last_mark, units_row, end
):
    rows = [["Time", "Acc"], ["s", "m/s2"]] if units_row else [["Time [s]", "Acc [m/s2]"]]
    rows += [[f"{0.01 * k:.2f}", f"{value / 1000:.3f}"] for k, value in enumerate(values)]
    quote = '"' if is_quoted else ""
    lines = [mark.join(f"{quote}{field}{quote}" for field in row) for row in rows]
    top = [f"sep={mark}"] if is_told else []
    content = end.join([*top, *(line + mark * has_last_mark for line in lines), ""])
    record = read_record(file(content))
    assert record.dt_s == 0.01
    assert record.a_mps2.tolist() == [value / 1000 for value in values]


@pytest.mark.parametrize(
    ("content", "problem"),
    [
        # The third column has a heading and no values: it is not taken for a comma at the ends.
        ("t,a,b\n0,1,\n1,2,\n", "2: found ''; enter a number"),
        # Points and commas: which of them groups thousands is not said.
        ("t;a\n0;1.000\n1;0,5\n", "3: found '0,5'; enter a number with a decimal point"),
        ("t;a\n0;1,000\n1;2,500\n", "2: found '1,000'; enter a number with a decimal point"),
    ],
)
def test_what_may_mean_two_things_is_refused(file, content, problem):
    assert problems_of(file(content))[0] == f"roof.csv:{problem}"


ACROSS = "0.1 0.2 0.3\n0.4 0.5 0.6\n0.7\n"


def test_gravity_raw_counts_and_values_across_lines_are_read_as_told(file):
    expected = [k * G / 10 for k in range(1, 8)]
    commas = ACROSS.replace(" ", ", ").replace("\n", ",\n")
    for content in (ACROSS, commas, ACROSS.replace("0.6", "6.0D-01")):
        record = read_record(file(content), units="g", dt_s=0.01, values_per_line=3)
        assert record.a_mps2 == pytest.approx(expected, rel=1e-15)
    told = read_record(file(f"# number of points: 7, in g\n{ACROSS}"), dt_s=0.01)
    assert told.a_mps2 == pytest.approx(expected, rel=1e-15)
    peer = read_record(file(f"OpenSees\nNPTS= 7\n{ACROSS}"), units="g", dt_s=0.01)
    assert peer.a_mps2 == pytest.approx(expected, rel=1e-15)
    rows = "0,0.58,0.01,0.79\n1,0.62,-0.01,0.78\n"
    motion_file = read_motion_file(file(f"t_s,x_g,y_g,z_g\n{rows}"))
    assert spaced(motion_file.notes) == (
        "the means of the three add up to about 1 g because the records include gravity",
    )
    for heading in ("time_s,x_counts", "t,x"):
        record = read_record(file(f"{heading}\n0,100\n1,200\n"), response="50")
        assert record.a_mps2.tolist() == [2.0, 4.0]
    for how in ({"response": "50"}, {"response": "50", "units": "g"}):
        assert len(input_problems(read_record, file("time_s,x_g\n0,100\n1,200\n"), **how)) == 1


@pytest.mark.parametrize(
    ("content", "due", "problem"),
    [
        (ACROSS, 4, ":1: found 3 values; enter 4 as in every line but the last"),
        (
            ACROSS.replace(" 0.5", ""),
            3,
            ":2: found 2 values; enter 3 as in every line but the last",
        ),
        (ACROSS, -1, ": values per line is -1; enter 1, 2, ..."),
    ],
)
def test_a_line_of_another_number_of_values_is_refused(file, content, due, problem):
    problems = problems_of(file(content), dt_s=0.01, values_per_line=due)
    assert problems[0] == f"roof.csv{problem}"


@pytest.mark.parametrize("head", ["time_s,acc_g", "# in g\n0,0", "# units: g\n0,0"])
@pytest.mark.parametrize(("peak", "is_read"), [(10, True), (10.1, False), (571, False)])
def test_a_peak_that_no_roof_reaches_asks_for_the_unit(file, head, peak, is_read):
    path = file(f"{head}\n0.01,{-peak}\n0.02,3\n0.03,{0.6 * peak}\n")
    if is_read:
        assert read_record(path).a_mps2.min() == pytest.approx(-peak * G)
        return
    (problem,) = problems_of(path, units="")
    assert problem.startswith(f"roof.csv: the values reach {peak:g} g, which is more than")
    assert problem.endswith("are they in cm/s2? Enter the correct units, or correct the values")


# Values across the lines, of which no column rises, and what others write between them.
WAVED = [0.3 * math.sin(0.4 * k * k) for k in range(200)]


def lines_of(fields, per_line):
    rows = [fields[i : i + per_line] for i in range(0, len(fields), per_line)]
    return [" ".join(f"{field:.5f}" for field in row) for row in rows]


CARDS = [f"{line} {k}" for k, line in enumerate(lines_of(WAVED, 8), start=1)]
TIMED = [f"{0.01 * k:.2f} {line}" for k, line in enumerate(lines_of(WAVED, 3)[:-1])]
TIMES_AND_VALUES = [field for k in range(200) for field in (0.01 * k, WAVED[k])]
JITTER = [f"{0.01 * k + 2e-3 * (k % 3):.3f} {row}" for k, row in enumerate(lines_of(WAVED, 2))]


@pytest.mark.parametrize("last", [0, 1])
@pytest.mark.parametrize(
    ("rows", "due", "told"),
    [
        (TIMED, 4, "1"),
        (JITTER, 3, "1"),
        (JITTER[:12], 3, "1"),
        (TIMED[:5], 4, "1"),
        ([" ".join(row.split()[::-1]) for row in TIMED], 4, "4"),
        ([" ".join(row.split()[1::-1]) for row in TIMED], 2, "2"),
        ([f"{a} {b}" for a, b in zip(JITTER[::2], JITTER[1::2], strict=True)], 6, "1, 4"),
    ],
)
def test_where_a_column_rises_no_values_run_across_the_lines(file, rows, due, told, last):
    # The last line may have fewer, as some programs write it.
    content = "\n".join([*rows, *(["0.1"] * last)]) + "\n"
    for how in ({}, {"values_per_line": due}):
        (problem,) = problems_of(file(content), dt_s=0.01, **how)
        assert f"; times rise in column {told}: put each time first" in problem
        assert "per line" not in problem


@pytest.mark.parametrize("head", [[], ["Kobe in g"], ["# number of points: 200"], ["# NPTS 400"]])
@pytest.mark.parametrize("mark", [" ", ", "])
@pytest.mark.parametrize("kept", [50, 49.5])
def test_where_every_second_value_rises_evenly_they_are_pairs_of_time_and_value(
    file, head, mark, kept
):
    samples = int(4 * kept)
    rows = [row.replace(" ", mark) for row in lines_of(TIMES_AND_VALUES[: 2 * samples], 8)]
    if head and "number of points" in head[0]:
        head = [f"# number of points: {samples}"]
    if head and "NPTS" in head[0]:
        head = [f"# NPTS {2 * samples}"]
    path = file("\n".join([*head, *rows]) + "\n")
    for how in ({}, {"dt_s": 0.01}, {"values_per_line": 8}):
        motion_file = read_motion_file(path, units="g", **how)
        assert motion_file.channels[0].dt_s == 0.01
        expected = [G * value for value in WAVED[:samples]]
        assert motion_file.channels[0].a_mps2 == pytest.approx(expected, abs=1e-4)
        assert motion_file.notes == ("each line has 4 pairs of time and value",)


def test_a_line_of_pairs_that_is_there_twice_is_named(file):
    rows = lines_of(TIMES_AND_VALUES, 8)
    (problem,) = problems_of(file("\n".join([*rows, rows[49]]) + "\n"))
    assert problem.startswith("roof.csv:51: found time 1.96 s after 1.99 s, with a typical step of")


def test_what_the_message_on_a_column_that_counts_the_lines_advises_works(file):
    for rows, told in (
        (CARDS, "column 9 contains line numbers: delete it"),
        (
            [f"{k} {row}" for k, row in enumerate(CARDS)],
            "columns 1, 10 contain line numbers: delete",
        ),
    ):
        for how in ({}, {"values_per_line": len(rows[0].split())}):
            (problem,) = problems_of(file("\n".join(rows)), dt_s=0.01, **how)
            assert f"; {told}" in problem
            assert "--values-per-line 8" in problem


def test_two_tables_side_by_side_are_told(file):
    rows = [f"{0.01 * k:.2f} {a:.4f} {0.01 * k:.2f} {-a:.4f}" for k, a in enumerate(WAVED)]
    (problem,) = problems_of(file("\n".join(rows)))
    assert problem.endswith(
        "; columns 1 and 3 are the same: tables side by side; use only one of them"
    )
    heads = "time_s,a_g,time_s,b_g"
    (problem,) = problems_of(file("\n".join([heads, *(row.replace(" ", ",") for row in rows)])))
    assert problem == (
        "roof.csv: found times in columns 1 and 3: tables side by side; use only one of them"
    )


@pytest.mark.parametrize(("factor", "is_told"), [(981.0, True), (30.0, False)])
def test_a_column_that_reaches_many_times_the_others_is_noted(file, factor, is_told):
    rows = [f"{0.01 * k:.2f},{a:.5f},{factor * a:.4f},{a:.5f}" for k, a in enumerate(WAVED)]
    notes = read_motion_file(file("\n".join(["t_s,x,y,z", *rows, ""])), units="cm/s2").notes
    told = "y reaches 981 times the peaks of the others: is it in the same unit?"
    assert notes[:1] == ((told,) if is_told else ())


def test_what_the_message_on_values_across_the_lines_advises_works(file):
    without = file("\n".join(" ".join(card.split()[:-1]) for card in CARDS))
    (problem,) = problems_of(without, dt_s=0.01)
    due = int(problem.partition("--values-per-line ")[2].rstrip(")"))
    record = read_record(without, units="g", dt_s=0.01, values_per_line=due)
    assert record.a_mps2 == pytest.approx([G * value for value in WAVED], abs=1e-4)


@pytest.mark.parametrize(
    "number", [lambda k: k % 10 + 1, lambda k: 25 - k, lambda k: 7], ids=["anew", "down", "same"]
)
def test_a_column_of_whole_numbers_beside_decimals_is_no_value(file, number):
    rows = [f"{line} {number(k)}" for k, line in enumerate(lines_of(WAVED, 8))]
    (problem,) = problems_of(file("\n".join(rows)), dt_s=0.01, values_per_line=9)
    assert "column 9 contains line numbers: delete it; then" in problem


@pytest.mark.parametrize(
    ("above", "below", "line"),
    [
        (["200"], [], 1), (["200.0"], [], 1), (["200", "0.01"], [], 1), (["0.01", "200"], [], 2),
        (["El Centro", "200"], [], 2), ([], ["200"], 201), (["0.01"], [], 1),
    ],
)  # fmt: skip
def test_the_count_or_the_step_is_no_sample(file, above, below, line):
    column = [f"{100 * value:.3f}" for value in WAVED]
    path = file("\n".join([*above, *column, *below, ""]))
    (problem,) = problems_of(path, units="cm/s2", dt_s=0.01)
    told = f"roof.csv:{line}: found {'0.01' if line == 1 and above[0] == '0.01' else '200'}, the"
    assert problem.startswith(f"{told} step or the number of the other values; put # before it")


def test_zeros_before_a_pulse_are_values_across_the_lines(file):
    content = "0 0 0 0\n" * 30 + "0.1 0.3 0.2 0\n"
    assert len(read_record(file(content), units="g", dt_s=0.01, values_per_line=4).a_mps2) == 124


@pytest.mark.parametrize("content", ["1\n-2\n3\n", "acc\n1\n-2\n3", "# x\n 1\n\n-2 \n3"])
def test_one_column_takes_its_step_from_the_argument(file, content):
    record = read_record(file(content), units="m/s2", dt_s=0.005)
    assert record.dt_s == 0.005
    assert record.a_mps2.tolist() == [1.0, -2.0, 3.0]


@pytest.mark.parametrize(
    "heading",
    [
        "time_s,acc_gal\n",
        "t [s]; a (gal)\n",
        "Time (sec),Acceleration (CM/SEC/SEC)\n",
        "# t_s,acc_gal  San Francisco, 42nd floor, resampled in 1990\n",
        "# Roof, north wall\n# units: cm/s2\n",
        "# accelerations in units of gal.\n",
        "# by hand [cm/s²]\ntime,acc\n",
        "t/s;acc/gal\n",
        "Tiempo (seg);acc, gal\n",
        "time,cm/s2\n",
    ],
)
def test_units_in_a_heading_or_a_remark_are_taken(file, heading):
    separator = ";" if ";" in heading else "," if "," in heading.split("#")[0] else " "
    rows = f"0{separator}100\n1{separator}200\n"
    if "t_s,acc_gal  San" in heading:
        rows = "0,100\n1,200\n"
    for units in ("", "gal", "cm/s2"):
        record = read_record(file(heading + rows), units=units)
        assert record.a_mps2.tolist() == [1.0, 2.0]


TWO_UNITS = "# north wall\n# units: gal\ntime_s,acc_g\n0,1\n1,2\n"


def test_a_comment_that_may_mean_something_else_asks_nothing_where_units_are_said(file):
    for units, size in (("g", G), ("gal", 0.01), ("cm/s2", 0.01)):
        assert read_record(file(TWO_UNITS), units=units).a_mps2.tolist() == [size, 2.0 * size]
    for remark in ("converted from gal", "PGA [cm/s2] 300", "units: g or gal"):
        record = read_record(file(f"# {remark}\ntime_s,acc_g\n0,1\n1,2\n"))
        assert record.a_mps2.tolist() == [G, 2.0 * G]


def test_a_factor_in_a_remark_is_noted(file):
    for line, notes in (
        ("scale factor: 1.5", 1), ("Scaling factor = 1.0", 0), ("factor 2", 0), ("Scale: 1000", 1),
        ("Multiplier 9.81", 1), ("values x 1000", 1), ("scaled by 0.5", 1), ("Scaling 1:4", 1),
        ("1 g = 16384 LSB", 1), ("Normalised", 1), ("Station 3 x", 0), ("full scale, g", 0),
        ("raw counts", 1), ("ln(acc)", 1), ("divided by PGA", 1), ("2 V/g", 1), ("counts: 2", 0),
    ):  # fmt: skip
        assert len(read_motion_file(file(f"# {line}\ntime_s,acc_g\n0,1\n1,2\n")).notes) == notes


@pytest.mark.parametrize(
    ("line", "words"),
    [
        ("# Units: 1/1000 g", "1/1000 g"), ("in 1e-3 g", "1e-3 g"), ("unit = 10 cm/s2", "10 cm/s2"),
        ("# units of g*1000", "g*1000"), ("acc x 0.01 g", "0.01 g"), ("# in g x 100", "g x 100"),
        ("values in % of g", "% of g"),
    ],
)  # fmt: skip
def test_a_multiple_of_a_unit_above_the_numbers_is_no_unit(file, line, words):
    (problem,) = problems_of(file(f"{line}\n1\n-2\n"), dt_s=0.01)
    assert problem == (
        f"roof.csv:1: found {words!r}, a multiple of a unit; convert the values to a unit alone,"
        " and correct the line"
    )


@pytest.mark.parametrize(
    "heading",
    [
        "acc (g*1000)", "acc (1e-3 g)", "acc [g/1000]", "acc (g)/9.81", "acc*10 (g)", "10*acc_g",
        "acc_x1000_g", "acc (m/s2) x10", "acc (N/kg)", "acc (g^2/Hz)", "acc (-)", "acc/PGA",
        "acc (unitless)", "drift", "déplacement", "velocità", "位移", "energy", "Speed",
    ],
)  # fmt: skip
def test_a_heading_of_a_multiple_or_another_quantity_is_no_acceleration(file, heading):
    (problem,) = problems_of(file(f"time (s),{heading}\n0,1\n0.01,-2\n0.02,1\n"))
    assert problem.startswith((
        f"roof.csv: found no acceleration component next to {heading!r}, not an acc",
        f"roof.csv:1: found {heading.partition('(')[2].strip(')')!r}, a multiple of a unit; conv",
    ))  # fmt: skip


def test_a_factor_beside_the_unit_of_times_is_asked_about(file):
    (problem,) = problems_of(file("Time*100 (s),acc_g\n0,1\n1,-2\n2,1\n"))
    assert problem.startswith("roof.csv:1: found times in 'Time*100 (s)'; enter them in s, ms or")


def test_row_numbers_before_times_are_left_out(file):
    rows = "".join(f"{k},{0.01 * k:.2f},{(-1) ** k}\n" for k in range(12))
    for head in (",time_s,acc_g", '"","time_s","acc_g"', "No,Time (s),Acc (g)"):
        record = read_record(file(f"{head}\n{rows}"))
        assert (record.dt_s, len(record.a_mps2), record.a_mps2[1]) == (0.01, 12, -G)


PERIODS = (0.01, 0.02, 0.03, 0.05, 0.075, 0.1, 0.15, 0.2, 0.3, 0.5, 0.75, 1, 1.5, 2, 3, 5)


@pytest.mark.parametrize("head", ["", "# site 1\n", "iml,poe\n"])
@pytest.mark.parametrize("steps", ["widening", "even"])
def test_a_curve_without_a_heading_is_no_record(file, head, steps):
    periods = PERIODS if steps == "widening" else [0.1 * (k + 1) for k in range(16)]
    rows = "".join(f"{period:g},{0.3 / (1 + period):.4f}\n" for period in periods)
    (problem,) = problems_of(file(head + rows))
    assert problem == (
        f"roof.csv:{1 + bool(head)}: found no value below zero: this is a spectrum or a curve, not"
        " a record; use accelerations by time, or a heading such as time_s,acc_g if they are"
    )
    assert read_record(file(f"time_s,acc_g\n{rows}")).name == "roof.csv"


def test_a_column_without_a_value_below_zero_or_a_heading_is_no_record(file):
    column = "".join(f"{0.3 / (1 + k):.4f}\n" for k in range(16))
    (problem,) = problems_of(file(column), dt_s=0.01)
    assert problem.endswith("a heading such as acc_g if they are")
    assert len(read_record(file(f"acc_g\n{column}"), dt_s=0.01).a_mps2) == 16
    assert len(read_record(file("0\n" * 16), dt_s=0.01, units="g").a_mps2) == 16


@pytest.mark.parametrize(
    "remark",
    ["# dt = 0.005 s", "a_g  dt=5 ms", "# DT[s]=.005", "# time step: 5 ms", "# DT = 5 MSEC",
     "# dt_ms = 5", "# time step 0.005 s", "# sampling interval (sec) .005", "# fs = 0.2 kHz",
     "# Sampling rate 200 Hz", "# Sampling Freq(Hz) = 200", "# 2 time steps, dt: 5.0E-3 and more",
     "# time-step: 5 ms", "timestep = 0.005", "# Sampling: 200 Hz", "# SR: 200", "Δt = 0.005 s",
     "# rate 200 sps", "# sample rate 200", "# DELTA=0.005", "# interval: 0.005 s", "# 200 sps",
     "# digitized at 200 Hz", "# Equally spaced at .005 sec", "# 0.005 sec intervals",
     "# Samples per second: 200", "# 采样率: 200 Hz", "# Paso: 0.005 s",
     "# Low-pass 25 Hz, sampled at 200 Hz", "# dt = 0,005 s", "# dt=1/200 s",
     "# Sampling rate: 200,0 Hz", "# sampling rate = 0.005 sec",
     "# Sampling rate: 5 ms", "# fs = 200 s^-1", "# dt = 0.005 s, sampling rate 200 Hz"],
)  # fmt: skip
def test_a_remark_gives_the_step_or_the_rate_in_its_unit(file, remark):
    assert read_record(file(f"{remark}\n1\n2\n"), units="g").dt_s == 0.005


@pytest.mark.parametrize(
    "remark",
    ["# filtered at 25 Hz", "# delta = 34.5 km", "# Step 3: baseline corrected",
     "# interval 2 of 5", "# recorded 2024, 3 Hz corner", "# natural frequency 2.5 Hz",
     "# paso 3", "# delta: 12.5"],
)  # fmt: skip
def test_a_number_of_something_else_is_no_step(file, remark):
    assert read_record(file(f"{remark}\n1\n-2\n"), units="g", dt_s=0.005).dt_s == 0.005


@pytest.mark.parametrize(
    "remarks", ["# raw data: sampling rate 500 Hz\n# dt = 0.01 s\n", "# fs = 500, dt = 0.01\n"]
)
def test_of_two_steps_that_are_stated_the_one_that_is_given_counts(file, remarks):
    (problem,) = problems_of(file(f"{remarks}1\n2\n"))
    assert problem == (
        f"roof.csv:{remarks.count('#')}: found a step of 0.01 s and one of 0.002 s; enter the time"
        " step dt, or correct one of them"
    )
    for dt_s in (0.002, 0.01):
        assert read_record(file(f"{remarks}1\n2\n"), units="g", dt_s=dt_s).dt_s == dt_s
    # Times decide.
    assert read_record(file(f"{remarks}0,1\n0.01,2\n"), units="g").dt_s == 0.01


@pytest.mark.parametrize("remark", ["dt = 1,953 ms", "Sampling rate: 1,000 Hz"])
def test_a_comma_that_may_be_of_thousands_is_asked_about(file, remark):
    (problem,) = problems_of(file(f"# {remark}\n1\n2\n"))
    number = remark.split()[-2]
    assert problem == f"roof.csv:1: found '{number}'; enter a number with a decimal point"


def test_a_rate_whose_exponent_has_no_digits_is_read_without_it(file):
    assert read_record(file("# Sampling rate: 1e\n1\n2\n"), units="g").dt_s == 1.0


CHANNELS = "time_s,NS_g,EW [gal],UD_g,vel_cm/s\n0,1,2,3,9\n0.5,4,5,6,9\n"


def test_headings_and_comments_name_channels_with_their_units(file):
    motion_file = read_motion_file(file(CHANNELS))
    assert [record.name for record in motion_file.channels] == ["NS", "EW", "UD"]
    assert {record.dt_s for record in motion_file.channels} == {0.5}
    assert motion_file.channel("ew").a_mps2.tolist() == [0.02, 0.05]
    assert motion_file.channel("3").a_mps2.tolist() == [3 * G, 6 * G]
    assert motion_file.notes == ("column 'vel_cm/s' is ignored: it is not an acceleration",)
    named = read_motion_file(file("x_g,y_g\n1,2\n0,4\n"), dt_s=0.1)
    assert [record.name for record in named.channels] == ["x", "y"]
    plain = read_motion_file(file("x,y,z\n1,2,3\n0,4,5\n"), dt_s=0.1, units="m/s2")
    assert plain.channel("x").a_mps2.tolist() == [1.0, 0.0]
    motion_file = read_motion_file(file("# t  NS[g]  EW [g]\n0 1 2\n1 3 4\n"))
    assert motion_file.channel("ew").a_mps2.tolist() == [2 * G, 4 * G]
    # N and g are no index and no unit.
    content = "N,E\n0,1\n1,2\n0,3\n"
    assert len(read_motion_file(file(content), units="g", dt_s=0.1).channels) == 2
    motion_file = read_motion_file(file(LETTERS), units="gal")
    assert [record.name for record in motion_file.channels] == ["ch_f", "ch_g", "ch_h"]
    assert motion_file.channel("ch_g").a_mps2.tolist() == [0.02, 0.05]


LOGGER = "t [s];Acc x [m/s2];Acc y [m/s2];Acc z [m/s2];{};Temperature [°C];gyro_x [rad/s]\n"


@pytest.mark.parametrize("name", ["Absolute acceleration [m/s2]", "Betrag [m/s2]", "a4 [m/s2]"])
def test_a_logger_column_of_the_magnitude_is_named_and_left_out(file, name):
    rows = "0,00;2,0;-1,0;2,0;3,0;21,5;0,1\n0,01;6,0;-2,0;3,0;7,0;21,5;0,1\n"
    motion_file = read_motion_file(file(LOGGER.format(name) + rows))
    assert [record.a_mps2.tolist() for record in motion_file.channels] == [[2, 6], [-1, -2], [2, 3]]
    others = [f"column '{other}' is ignored: it is not an acceleration"
              for other in ("Temperature [°C]", "gyro_x [rad/s]")]  # fmt: skip
    magnitude = f"column '{name}' is ignored: it is the magnitude of a vector, not a component"
    assert motion_file.notes == (*others, magnitude)
    # A component that changes its sign is no magnitude.
    signed = read_record(file("t_s,Absolute acceleration [m/s2]\n0,1\n1,-2\n"))
    assert signed.a_mps2.tolist() == [1, -2]


LETTERS = "time_s,ch_f,ch_g,ch_h\n0,1,2,3\n1,4,5,6\n"


RAW = (
    "raw counts require the response of the instrument; enter it (motion"
    " convert --response), as StationXML for miniSEED and SAC, or as counts per m/s2"
)
NONE, WHICH = {"units": ""}, "the comment states gal, the heading 'acc_g' states g: which is it?"
REFUSED = {
    "no unit": ("time,acc\n0,100\n1,200\n", NONE,
        ": found no unit of acceleration; enter units, one of g, m/s2, cm/s2, mm/s2, gal, or a"
        " heading such as acc_g"),
    "a letter is no unit": (LETTERS, NONE,
        ": found no unit of acceleration; enter units, one of g, m/s2, cm/s2, mm/s2, gal, or a"
        " heading such as acc_g"),
    "another unit is given": ("# x\ntime_s,acc_gal\n0,100\n1,200\n", {},
        ":2: the file is in gal but units are g; enter the file's units, or none"),
    "two units": ("# in g\n# units: gal\n0,1\n1,2\n", NONE, ":2: found units g and gal;"
        " correct one of them"),
    "a comment contradicts": (TWO_UNITS, NONE,
        f":2: {WHICH} Correct one of them, or enter the units"),
    "a third unit": (TWO_UNITS, {"units": "m/s2"},
        f":2: {WHICH} Correct one of them, or enter the units"),
    "a remark has another step": ("# dt = 0.005\n1\n2\n", {"dt_s": 0.01},
        ":1: the time step of the file is 0.005 s but 0.01 s was entered; enter the time step"
        " of the file, or none"),
    "times have another step": ("0,1\n0.01,2\n", {"dt_s": 0.02},
        ":1: the time step of the file is 0.01 s but 0.02 s was entered; enter the time step"
        " of the file, or none"),
    "no channel is chosen": (CHANNELS, NONE,
        ": found several channels; use one by name or number: 1 NS; 2 EW; 3 UD"),
    "columns without times": ("x_g,y_g\n1,2\n0,4\n", {},
        ": found columns without times; enter the time step dt"),
    **{f"times in {unit}": (f"Time [{unit}],a_g\n0,1\n1,2\n", NONE,
        f":1: found times in '{unit}'; enter them in s, ms or min, such as time_s")
       for unit in ("us", "h", "samples", "UTC")},
    **{f"an index and dt {dt_s}": ("sample,a_g\n0,1\n1,2\n", NONE | {"dt_s": dt_s},
        ":1: found 'sample' over the first column; enter times in seconds, such as time_s, or"
        " delete the column and enter the time step dt")
       for dt_s in (math.nan, 0.005)},
    **{f"only {heading}": (f"time_s,{heading}\n0,1\n1,2\n", {},
        f": found no acceleration component next to '{heading}', not an acceleration: name one"
         " with a heading such as acc_g")
       for heading in ("vel_cm/s", "velocity_g", "velocity", "Disp. [gal]")},
    **{f"only a magnitude {name}": (f"time_s,{name} [g]\n0,1\n1,2\n", {},
        f": found no acceleration component next to '{name} [g]', the magnitude of a vector, not"
        " a component: name one with a heading such as acc_g")
       for name in ("Abs", "Resultant", "Vector sum", "|a|", "Total", "acc_mag", "aT", "SRSS")},
    **{f"raw counts {name}": (f"time_s,{name}\n0,1\n1,2\n", {},
        f":1: found unit 'counts': {RAW}") for name in ("x_counts", "EW (counts)")},
    **{f"a time of day {time}": (f"time,a_g\n{time},1\n{time},2\n", {},
        f":2: found {time!r}, a date or a time of day; enter seconds from the start in the first"
        " column, such as time_s")
       for time in ("10:11:12:130", "2024-03-05T10:11:12.5Z", "5/3/2024")},
    **{f"no unit of {name}": (f"{name},a_g\n" + "".join(f"{5 * k},0\n" for k in range(20)), {},
        f":1: found {name!r} with steps of 5; enter the unit of the times, such as time_s or"
        " time_ms") for name in ("time", "timestamp")},
    "a remark has half the step": ("# dt = 0.01\n1\n2\n", {"dt_s": 0.005},
        ":1: the time step of the file is 0.01 s but 0.005 s was entered; enter the time step"
        " of the file, or none"),
    "a remark has twice the step of rounded times": (
        "# dt = 0.01 s\ntime_s,a_g\n" + "".join(f"{0.005 * k:.2f},{k % 2}\n" for k in range(24)),
        {"dt_s": 0.005},
        ":1: states a step of 0.01 s, the times have 0.005 s; use a file in which they agree"),
    "a rate contradicts": ("# Sampling rate: 100 Hz\ntime_s,a_g\n0,1\n0.02,2\n", {},
        ":1: states a step of 0.01 s, the times have 0.02 s; use a file in which they agree"),
    "commas for thousands": ("t_s;a_gal\n0;1.5\n1;1,234.5\n", NONE,
        ":3: found '1,234.5'; enter a number without commas for thousands"),
    "only a heading with blanks": ("Time (sec)   Vel (m/s)\n0.0 0.0\n0.012 1.0\n0.02 2.0\n", {},
        ": found no acceleration component next to 'Vel (m/s)', not an acceleration: name one"
        " with a heading such as acc_g"),
}  # fmt: skip


@pytest.mark.parametrize(("content", "how", "problem"), REFUSED.values(), ids=REFUSED)
def test_what_cannot_be_or_contradicts_itself_is_refused(file, content, how, problem):
    assert problems_of(file(content), **how) == (f"roof.csv{problem}",)


@pytest.mark.parametrize(
    ("content", "expected"),
    [
        ("0,1\n0.1,abc\n", ["2: found 'abc'; enter a number"]),
        ("0,1\n0.1,NaN\n0.2,-inf\n", ["2: found 'NaN'; enter", "3: found '-inf'; enter"]),
        ("0,1\n0.1,1_0\n0.2,x\n", ["2: found '1_0'", "3: found 'x'"]),
        ("0 1\n0.1\n0.2 1 2\n", ["2: found 1 column; enter 2", "3: found 3 columns; enter 2"]),
        ("0,0;0,12\n0.1;2\n", ["1: found '0,0'; enter a number with a decimal point", "1: fou"]),
        ("a\n\n# x\n0,12\n0,13\n-0,11", ["4: found '0,12'; enter a number with a decimal"]),
        ("2 1\n1 2\n0 3\n", ["2: found time 1 s after 2 s", "3: found time 0 s after 1 s"]),
        ("065XXX010101\nCSMNC\n\n1 2\n", ["1: found '065XXX010101' where numbers were expected;"
                                          " the"]),
        ("word\nand some more\nin prose\n",
         ["2: found 'and some more' where numbers were expected; the"]),
        ("1994 Northridge\n0.1\n0.2\n",
         ["1: found '1994 Northridge' where numbers were expected; the file"]),
        ("SAP2000 v20\nFUNCTION  TH1\nTIME  VALUE\n0 1\n",
         ["2: found 'FUNCTION  TH1' where numbers were expected; the file is in no"]),
        ("model basic\ntimeSeries Path 1 -dt 0.01\n1 2\n", ["2: this looks like a program, which"]),
        ("<html>\n<body>\n", ["2: this looks like a web page, which is not supported; use the"
                              " record"]),
        ("TIMESERIES IU_X, 9 samples\n1 2 x\n", ["2: this looks like TSPAIR or SLIST of Earth"]),
        ("# dt = 5 us\n1\n2\n", ["1: found a step in us; enter it in s, ms or min"]),
        ("# dt = 5\n1\n2\n", [" the time step is 5 s; use a record with steps of 1e-06 to 1 s"]),
        ("# NPTS: 3\n1\n2\n", ["1: states 3 samples, found 2; use the complete file"]),
        ("1 0.1\n2 0.2\n3 0.1\n" + "".join(f"{k} 0\n" for k in range(4, 20)),
         ["1: found a first column with steps of 1; enter the unit of the times, such as time_s"]),
        *((f"{sign}   1.0e-03 *\n\n 0.1\n 0.2\n",
           ["1: found '1.0e-03 *', a factor for the numbers below it; multiply them all by it,"
            " and"])
          for sign in ("", "# ")),
        ("1 2 3\n4 5 6\n7\n", ["3: found 1 values after lines of 3: values across the lines, not"]),
        ("60 0.1\n1 2 3\n4 5 6\n7\n", ["1: states 60 values, found 7; use the complete file"]),
        (
            "100 7\n1\n2\n3\n",
            ["1: found 2 numbers above rows of 1; if they are not samples, put # be"],
        ),
        ("made motion\n0.01 7\n1\n2\n3\n", ["2: found 2 numbers above rows of 1; if they are no"]),
        ("0 1\n2 0\n" * 6,
         [" found 2 columns without a heading, and the first is no time: it fal"]),
        ("t,x,y,z\n0,1,2\n1,2,3\n", ["1: found 4 headings over 3 columns; enter one"]),
        ("n,t_s,x_g\n0,1,2\n1,2,3\n", [" found times in column 2; put them in the f"]),
        ("", [" no numbers found"]),
        ("0,1\n", [" found 1 sample; enter at least 2"]),
        ("1\n2\n", [" found one column, without times; enter the time step dt"]),
    ],
)  # fmt: skip
def test_each_line_at_fault_is_named_with_what_would_do(file, content, expected):
    starts = [f"roof.csv:{line}" for line in expected]
    problems = problems_of(file(content))
    assert [p[: len(s)] for p, s in zip(problems, starts, strict=True)] == starts


def test_many_faults_are_cut_short_and_counted_to_a_limit(file):
    problems = problems_of(file("0.1\n" + "x\n" * 37), dt_s=0.1)
    assert len(problems) == 11
    assert problems[9:] == ("roof.csv:11: found 'x'; enter a number", "... and 27 more")
    problems = problems_of(file("0.1\n" + "x\n" * 12_000), dt_s=0.1)
    assert problems[10:] == ("... and more than 10000 more",)


@pytest.mark.parametrize(
    ("head", "named"),
    [
        ("Frequency (Hz),Sa (g)", "'Frequency (Hz)', 'Sa (g)'"),
        ("Freq. [Hz]\tAmplitude", "'Freq. [Hz]'"),
        ("T (s),Sa (g)", "'Sa (g)'"),
        ("T,PSA_g,PSV", "'PSA_g', 'PSV'"),
    ],
)
def test_a_spectrum_is_no_record(file, head, named):
    separator = next((mark for mark in ",;\t" if mark in head), ",")
    width = head.count(separator) + 1
    rows = [separator.join([f"{0.1 * k:.1f}", *["0.3"] * (width - 1)]) for k in range(1, 40)]
    wanted = (
        f"roof.csv:1: found {named}: this is a spectrum, not a record; use accelerations by time"
    )
    assert problems_of(file("\n".join([head, *rows]) + "\n")) == (wanted,)


@pytest.mark.parametrize(
    "head",
    ["Time (s),EW (g),NS (g)", "t,Sensor 1,Sensor 2", "T (s),SA-X (g),UD (g)", "t_s,a_g,b_g"],
)
def test_a_record_is_no_spectrum(file, head):
    path = file(head + "\n0,0.1,0.2\n0.01,0.2,0.3\n0.02,0.1,0.1\n")
    assert read_motion_file(path, units="g").channels


def table_below(remark):
    return remark + "\n" + "".join(f"{0.1 * k:.1f} {0.3 + 0.01 * k:.2f}\n" for k in range(1, 40))


@pytest.mark.parametrize(
    "remark",
    [
        "# Pseudo-acceleration spectrum, 5% damping, g",
        "# Period (s), PSA (g)",
        "# T(s) Sa(g)",
        "Response spectra of the site",
        "% Frequency Hz FAS",
    ],
)
def test_a_line_above_the_numbers_tells_of_a_spectrum(file, remark):
    problems = problems_of(file(table_below(remark)))
    assert problems[0].startswith("roof.csv:1: found ")
    assert "spectrum, not a record; use accelerations by time" in problems[0]
    # Below the name of a spectrum, a record has values of both signs.
    assert read_record(file("# Matched to the response spectrum of the site\n0.1\n-0.2\n0.3\n"),
                       units="g", dt_s=0.01)  # fmt: skip


@pytest.mark.parametrize(
    ("title", "sign", "said"),
    [
        ("motion 3 in cm/s2", "-", "roof.csv:1: the file is in cm/s2 but units are g"),
        ("velocity motion", "-", "roof.csv:1: found velocity; use the file of acceleration"),
        ("motion 3", "", "roof.csv:3: found no value below zero: this is a spectrum or a curve"),
    ],
)
def test_a_title_above_count_and_step_tells_of_unit_and_quantity(file, title, sign, said):
    rows = "".join(f"{sign}0.0{k % 7 + 1}\n" for k in range(20))
    (problem,) = problems_of(file(f"{title}\n20 0.01\n{rows}"))
    assert problem.startswith(said)
    station = file("motion 3 (G)\n20 0.01\n" + "-0.1\n0.1\n" * 10)
    assert len(read_record(station, units="gal").a_mps2) == 20


@pytest.mark.parametrize("heading", ["Force (kN)", "Base shear [kips]", "p (kPa)", "V (lbf)"])
def test_a_column_of_forces_is_no_acceleration(file, heading):
    (problem,) = problems_of(file(f"time (s),{heading}\n0,0.1\n0.01,-0.2\n0.02,0.1\n"))
    assert problem.startswith(f"roof.csv: found no acceleration component next to '{heading}'")
    for name in ("x (N)", "EW [north]"):
        assert read_record(file(f"time (s),{name}\n0,1\n0.01,-2\n"), units="g").dt_s == 0.01


@pytest.mark.parametrize(
    ("remark", "named"),
    [
        ("# Velocity history, cm/s", "velocity"),
        ("# Displacement (cm)", "displacement"),
        ("Corrected ground velocity", "velocity"),
        ("# time, disp", "disp"),
        ("# UNITS: cm/s", "cm/s"),
        ("Displacement history", "displacement"),
        ("Velocidad (cm)", "velocidad"),
        ("# Vitesse", "vitesse"),
        ("Jerk", "jerk"),
    ],
)
def test_a_line_above_the_numbers_tells_of_another_quantity(file, remark, named):
    path = file(remark + "\n0.00 0.1\n0.01 -0.2\n0.02 0.3\n")
    (problem,) = problems_of(path)
    assert problem.startswith(f"roof.csv:1: found {named!r} but no acceleration; use "), problem
    head, _, rows = path.read_text().partition("\n")
    # A heading of accelerations decides.
    assert read_record(file(f"# {head}\ntime_s acc_g\n{rows}"))


def test_what_the_message_on_another_quantity_advises_works_for_one_column(file):
    (problem,) = problems_of(file("# Velocity history\n0.1\n-0.2\n0.3\n"), dt_s=0.01)
    heading = problem.partition("a heading such as ")[2].split()[0]
    advised = file(f"# Velocity history\n{heading}\n0.1\n-0.2\n0.3\n")
    assert read_record(advised, dt_s=0.01).a_mps2.tolist() == [0.1 * G, -0.2 * G, 0.3 * G]


@pytest.mark.parametrize(
    "remark",
    [
        "# shear wave velocity Vs30 300 m/s",
        "# peak velocity 30 cm/s, peak displacement 4 cm",
        "# Displacement = 4.1 cm",
        "# velocity pulse at 3 s",
        "# Units are in sec and g",
        "# velocity and displacement beside this acceleration",
    ],
)
def test_a_line_may_tell_of_velocity_beside_accelerations(file, remark):
    assert read_record(file(remark + "\n0.00 0.1\n0.01 -0.2\n0.02 0.3\n"), units="g")


@pytest.mark.parametrize("head", ["12 0.01\n", "12\t.0100\n", "DEEPSOIL in g\n12 0.01\n"])
def test_a_count_and_a_step_above_times_are_no_sample(file, head):
    rows = "".join(f"{0.01 * k:.2f} {0.1 * (-1) ** k:.1f}\n" for k in range(12))
    record = read_record(file(f"{head}{rows}"), units="g")
    assert (record.dt_s, len(record.a_mps2)) == (0.01, 12)
    place = head.count("\n")
    assert problems_of(file(f"{head}{rows}".replace("12", "12 0.02 #"))) == (
        f"roof.csv:{place}: states a step of 0.02 s, the times have 0.01 s; use a file in which"
        " they agree",
    )
    (problem,) = problems_of(file(f"{head}{rows}"[:-10]))
    assert problem.startswith(f"roof.csv:{place + 1}: found time 0 s after 12 s")
