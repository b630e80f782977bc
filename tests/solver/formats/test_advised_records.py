"""What the refusal of a record says would do, does. Oracle: the samples that made each file."""

import gzip
import io
import json
import re
import zipfile
from ast import literal_eval
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import pytest
from openpyxl import Workbook

from fixtures.errors import input_problems
from fixtures.marks import by_day
from solver.formats import read_record

G = 9.80665
DT_S = 0.01
COUNT = 200
# Each odd sample is the mean of its neighbors: what lies between the others is then known.
_EVEN = np.round(0.3 * np.sin(0.11 * np.arange(101)) * np.exp(-0.01 * np.arange(101)), 4)
TRUTH_G = np.interp(np.arange(COUNT), np.arange(0, 202, 2), _EVEN)
V = [f"{value:.6f}" for value in TRUTH_G]
GAL = [f"{100.0 * G * value:.4f}" for value in TRUTH_G]
T = [f"{DT_S * k:.2f}" for k in range(COUNT)]


@dataclass(frozen=True)
class Kind:
    """A file that is refused, what its message advises, and the file and options by that."""

    content: str | bytes
    advice: str  # a pattern; a number that it has as a group is that of an option
    followed: str | bytes = ""  # the file as advised; the same where options are
    given: Mapping[str, Any] = field(default_factory=dict)
    then: Mapping[str, Any] = field(default_factory=dict)  # "1" for the number of the advice


def lines(*rows):
    return "".join(f"{row}\n" for row in rows)


def table(*columns, head="", mark=","):
    return lines(*([head] if head else []), *(mark.join(row) for row in zip(*columns, strict=True)))


def across(values, per_line, head=(), *, numbered=False):
    starts = range(0, len(values), per_line)
    rows = ["  ".join(values[k : k + per_line]) for k in starts]
    return lines(*head, *(f"{row}  {k}" if numbered else row for k, row in enumerate(rows, 1)))


def zipped(name, text):
    with zipfile.ZipFile(buffer := io.BytesIO(), "w") as file:
        file.writestr(name, text)
    return buffer.getvalue()


def workbook(*columns, head):
    book = Workbook()
    for row in (head, *zip(*columns, strict=True)):
        book.active.append([float(cell) if cell[-1].isdigit() else cell for cell in row])
    book.save(buffer := io.BytesIO())
    return buffer.getvalue()


def array_of(values):
    np.save(buffer := io.BytesIO(), values)
    return buffer.getvalue()


IN_G, STEP = {"units": "g"}, {"dt_s": DT_S}
BOTH = IN_G | STEP
PLAIN = table(T, V, head="time_s,acc_g")
COLUMN = lines(*V)
PEER = ("PEER STRONG MOTION DATABASE RECORD", "Made, 1/1/01, MADE STATION, 090",
        "ACCELERATION TIME SERIES IN UNITS OF G")  # fmt: skip
NPTS = f"NPTS=  {COUNT}, DT=   .0100 SEC"
GAPS = [k for k in range(COUNT) if k % 10 != 5]
UNEVEN = table([T[k] for k in GAPS], [V[k] for k in GAPS], head="time_s,acc_g")
SWAPPED = [*range(50), 51, 50, *range(52, COUNT)]

KINDS = {
    "one column without a unit": Kind(COLUMN, "enter units, one of g,", given=STEP, then=BOTH),
    "a heading without a unit": Kind(
        table(T, V, head="time,acc"), "or a heading such as acc_g", table(T, V, head="time,acc_g")
    ),
    "one column without a step": Kind(COLUMN, "enter the time step dt", given=IN_G, then=BOTH),
    "another unit given": Kind(
        PLAIN, "enter the file's units, or none", given={"units": "m/s2"}
    ),
    "another step given": Kind(
        PLAIN, "enter the time step of the file, or none", given={"dt_s": 0.02}
    ),
    "a step of zero": Kind(COLUMN, "enter a number of seconds above 0",
                           given=IN_G | {"dt_s": 0.0}, then=BOTH),
    "a unit in other letters": Kind(COLUMN, "enter one of g, m/s2, cm/s2",
                                    given=STEP | {"units": "G's"}, then=BOTH),
    "values across the lines": Kind(
        across(V, 7), r"--values-per-line (\d+)", given=BOTH, then=BOTH | {"values_per_line": "1"}
    ),
    "times in the second column": Kind(
        table(V, T, head="acc_g,time_s"), "put them in the first, and once", PLAIN
    ),
    "numbers of samples for times, deleted": Kind(
        table(map(str, range(COUNT)), V, head="n,acc_g"),
        "or delete the column and enter the time step",
        lines("acc_g", *V), then=STEP,
    ),
    "numbers of samples for times": Kind(
        table(map(str, range(COUNT)), V, head="n,acc_g"),
        "enter times in seconds, such as time_s", PLAIN,
    ),
    "numbers of samples without a heading": Kind(
        table(map(str, range(COUNT)), V, mark=" "), "or delete the column if it contains sample"
                                                    " numbers",
        COLUMN, given=IN_G, then=BOTH,
    ),
    "lines with their numbers": Kind(
        across(V, 8, numbered=True),
        r"column 9 contains line numbers: delete it; .*--values-per-line (\d+)", across(V, 8),
        given=BOTH, then=BOTH | {"values_per_line": "1"},
    ),
    "lines with numbers that begin anew": Kind(
        lines(*(f"{row}  {k % 5}" for k, row in enumerate(across(V, 8).splitlines()))),
        r"column 9 contains line numbers: delete it; .*--values-per-line (\d+)", across(V, 8),
        given=BOTH | {"values_per_line": 9}, then=BOTH | {"values_per_line": "1"},
    ),
    "a count above a column": Kind(
        lines("200", *GAL), "put # before it", lines("# 200", *GAL),
        given={"units": "gal", **STEP}, then={"units": "gal", **STEP},
    ),
    "lines with their numbers before times": Kind(
        table(map(str, range(COUNT)), T, V, mark=" "), "column 1 contains line numbers: delete it",
        table(T, V, mark=" "), given=IN_G, then=IN_G,
    ),
    "line numbers before lines of times": Kind(
        lines(*(f"{k}  {'  '.join(f'{t}  {v}' for t, v in row)}" for k, row in enumerate(
            zip(*[iter(zip(T, V, strict=True))] * 4, strict=True), 1))),
        "column 1 contains line numbers: delete it; then times rise in column 1, 3, 5, 7: put"
        " each time"
        " first on a line with its values, below a heading such as time_s,x_g,y_g$",
        table(T, V, head="time_s,x_g"), given=IN_G,
    ),
    "tables side by side": Kind(
        table(T, V, T, GAL, mark=" "), "tables side by side; use only one of them",
        table(T, V, mark=" "), given=IN_G, then=IN_G,
    ),
    "rounded times": Kind(
        table([f"{float(t):.1f}" for t in T], V, head="time_s,acc_g"),
        r"enter the time step dt, such as ([\d.]+)", then={"dt_s": "1"},
    ),
    "times in microseconds": Kind(
        table([f"{10_000 * k}" for k in range(COUNT)], V, head="time_us,acc_g"),
        "enter them in s, ms or min, such as time_s", PLAIN,
    ),
    "milliseconds without a unit": Kind(
        table([f"{10 * k}" for k in range(COUNT)], V, head="time,acc_g"),
        "enter the unit of the times, such as time_s or time_ms",
        table([f"{10 * k}" for k in range(COUNT)], V, head="time_ms,acc_g"),
    ),
    "uneven times and a step": Kind(UNEVEN, "omit it, and the record is resampled", given=STEP),
    "times that fall": Kind(
        table([T[k] for k in SWAPPED], [V[k] for k in SWAPPED], head="time_s,acc_g"),
        "enter increasing times", PLAIN,
    ),
    "three columns without a heading": Kind(
        table(T, V, GAL, mark=" "), "heading such as time_s,x_g,y_g",
        table(T, V, GAL, head="time_s,x_g,y_cm/s2"), then={"channel": "x"},
    ),
    "fewer headings than columns": Kind(
        table(T, V, GAL, head="time_s,x_g"), "enter one for each",
        table(T, V, GAL, head="time_s,x_g,y_cm/s2"), then={"channel": "x"},
    ),
    "one of two channels": Kind(
        table(T, V, GAL, head="time_s,x_g,y_cm/s2"), "one by name or number", then={"channel": "x"}
    ),
    "a factor above the numbers": Kind(
        lines("2.0 *", *(f"{value / 2.0:.8f}" for value in TRUTH_G)),
        "multiply them all by it, and delete the line", COLUMN, given=BOTH, then=BOTH,
    ),
    "numbers above a column": Kind(
        lines("7.5 0.3 3.1") + COLUMN, "put # before them, and enter the time step",
        lines("# 7.5 0.3 3.1") + COLUMN, given=BOTH, then=BOTH,
    ),
    "times of day": Kind(
        table([f"12:30:{DT_S * k:05.2f}" for k in range(COUNT)], V, head="time,acc_g"),
        "enter seconds from the start in the first column, such as time_s", PLAIN,
    ),
    "a text that says velocity": Kind(
        lines("# velocity", *V), "or a heading such as acc_g if the values are accelerations",
        lines("# velocity", "acc_g", *V), given=BOTH, then=STEP,
    ),
    "a decimal comma": Kind(
        table(T, [value.replace(".", ",") for value in V], mark=" "),
        "enter a number with a decimal point", table(T, V, mark=" "), given=IN_G, then=IN_G,
    ),
    "a column with decimal commas": Kind(
        lines(*(value.replace(".", ",") for value in V)), "enter a number with a decimal point",
        COLUMN, given=BOTH, then=BOTH,
    ),
    "commas for thousands": Kind(
        table(T, [f"{10.0 * float(value):,.3f}" for value in GAL], head="time_s a_mm/s2", mark=" "),
        "enter a number without commas for thousands",
        table(T, [f"{10.0 * float(value):.3f}" for value in GAL], head="time_s a_mm/s2", mark=" "),
    ),
    "no number": Kind(
        lines("nan", *V[1:]), "enter a number", COLUMN, given=BOTH, then=BOTH
    ),
    "a code for missing data": Kind(
        lines("-999.0", *V[1:]), "use a record without gaps", COLUMN, given=BOTH, then=BOTH
    ),
    "two units": Kind(
        lines("# Units: gal", "acc_g", *V), "or enter the units", given=STEP, then=BOTH
    ),
    "two units, one corrected": Kind(
        lines("# Units: gal", "acc_g", *V), "Correct one of them", lines("# Units: g", "acc_g", *V),
        given=STEP, then=STEP,
    ),
    "gal below a heading in g": Kind(
        table(T, GAL, head="time_s,acc_g"), r"are they in cm/s2\? Enter the correct units",
        table(T, GAL, head="time_s,acc_cm/s2"),
    ),
    "a count of more": Kind(
        lines("# NPTS = 300", *V), "use the complete file", lines("# NPTS = 200", *V),
        given=BOTH, then=BOTH,
    ),
    "a count of fewer": Kind(
        lines("# NPTS = 100", *V), "correct the count", lines("# NPTS = 200", *V),
        given=BOTH, then=BOTH,
    ),
    "a last line without its end": Kind(
        lines(*V[:-1]) + V[-1][:5], "use the complete file", COLUMN, given=BOTH, then=BOTH
    ),
    "a step of hours": Kind(
        lines("# dt = 0.01 h", *V), "enter it in s, ms or min", lines("# dt = 0.01 s", *V),
        given=IN_G, then=IN_G,
    ),
    "a step that the times deny": Kind(
        lines("# dt = 0.02 s") + PLAIN, "use a file in which they agree",
        lines("# dt = 0.01 s") + PLAIN,
    ),
    "a row of fewer columns": Kind(
        PLAIN.replace(f"0.50,{V[50]}", "0.50"), "enter 2 as in the first row", PLAIN
    ),
    "text of no format": Kind(
        lines("station made", "1st of 3") + COLUMN, "put # before every other line of text",
        lines("# station made", "# 1st of 3") + COLUMN, given=BOTH, then=BOTH,
    ),
    "JSON": Kind(
        json.dumps({"time": [*map(float, T)], "acc": [*map(float, V)]}, indent=0),
        "write its values as columns below a heading such as time_s,x_g,y_g",
        table(T, V, head="time_s,x_g"),
    ),
    "XML on one line": Kind(
        f"<record dt='0.01' unit='g'>{' '.join(V[:20])}</record>", "use the record itself", PLAIN
    ),
    "XML on one long line": Kind(
        f"<?xml version='1.0'?><record>{' '.join(V)}</record>", "use the record itself", PLAIN
    ),
    "a time series of OpenSees": Kind(
        lines(f"timeSeries Path 1 -dt {DT_S} -factor 9.80665 -values {{", *V, "}"),
        "use the file of values that it reads", COLUMN, then=BOTH,
    ),
    "a time series of OpenSees on one line": Kind(
        f"timeSeries Path 1 -dt {DT_S} -values {{{' '.join(V)}}}",
        "or write its values as columns below a heading such as time_s,x_g,y_g",
        table(T, V, head="time_s,x_g"),
    ),
    "a zip": Kind(zipped("record.csv", PLAIN), "unpack it", PLAIN),
    "a gzip": Kind(gzip.compress(PLAIN.encode()), "unpack it", PLAIN),
    "a workbook": Kind(
        workbook(T, V, head=("time_s", "acc_g")), "save its worksheet as CSV", PLAIN
    ),
    "a NumPy array": Kind(
        array_of(TRUTH_G), "write its values as columns below a heading such as time_s,x_g,y_g",
        table(T, V, head="time_s,x_g"),
    ),
    "raw counts": Kind(
        table(T, [f"{1e5 * G * value:.0f}" for value in TRUTH_G], head="time_s,acc_counts"),
        "or as counts per m/s2", then={"response": "100000"},
    ),
    "a response of accelerations": Kind(
        PLAIN, "omit the response", given={"response": "100000"}
    ),
    "units and a response": Kind(
        COLUMN, "use only one of them", given=BOTH | {"response": "100000"}, then=BOTH
    ),
    "an AT2 without its step": Kind(
        across(V, 5, (*PEER, f"NPTS= {COUNT}")), "enter the time step dt", then=STEP
    ),
    "an AT2 whose count is no number": Kind(
        across(V, 5, (*PEER, "NPTS= many, DT= .0100 SEC")),
        "enter the count and the step as in NPTS=  4000, DT=   .0100 SEC",
        across(V, 5, (*PEER, NPTS)),
    ),
    "an AT2 of fewer values": Kind(
        across(V[:150], 5, (*PEER, NPTS)), "use the complete file", across(V, 5, (*PEER, NPTS))
    ),
    "an AT2 of more values": Kind(
        across(V, 5, (*PEER, NPTS.replace("200", "150"))), "correct the count",
        across(V, 5, (*PEER, NPTS)),
    ),
    "an AT2 of velocity": Kind(
        across(V, 5, (*PEER[:2], "VELOCITY TIME SERIES IN UNITS OF CM/S", NPTS)),
        "use the file of acceleration", across(V, 5, (*PEER, NPTS)),
    ),
    "a line too long": Kind(
        "  ".join(V), "enter at most 1000", across(V, 20),
        given=BOTH, then=BOTH | {"values_per_line": 20},
    ),
    "a step of milliseconds": Kind(
        COLUMN, "use a record with steps of", given=IN_G | {"dt_s": 10.0}, then=BOTH
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", by_day(KINDS, 12))
def test_what_the_refusal_of_a_record_says_would_do_does(file, name):
    kind = KINDS[name]
    said = "\n".join(map(str, input_problems(read_record, file(kind.content), **kind.given)))
    advised = re.search(kind.advice, said)
    assert advised, said
    then = {key: literal_eval(advised[1]) if value == "1" else value
            for key, value in kind.then.items()}  # fmt: skip
    record = read_record(file(kind.followed or kind.content), **then)
    assert record.dt_s == pytest.approx(DT_S, rel=1e-12)
    assert record.a_mps2 == pytest.approx(G * TRUTH_G, abs=1e-5)
