"""Records pasted into a column of the workbook: what is beside them must agree."""

import numpy as np
import pytest

from nightly import by_day
from sheets import at, edit, make, problems, read_workbook, said, type_into

RECORD = "Motions/M2/Horizontal record"


def pasted(values, header="North", name="Pasted!North"):
    """Return the cells of a pasted column that M2 uses."""
    below = {f"Pasted!B{row}": value for row, value in enumerate(values, start=4)}
    return {"Pasted!B3": header, RECORD: name} | below


def timed(times, header="time_s"):
    """Return the cells of such a column with times beside it."""
    beside = {f"Pasted!A{row}": time for row, time in enumerate(times, start=4)}
    return pasted([0.1] * len(times)) | {"Pasted!A3": header} | beside


@pytest.fixture(scope="module")
def with_sheet(tmp_path_factory):
    """The bytes of the usual workbook with a sheet Pasted."""
    path = make(tmp_path_factory.mktemp("pasted"))
    return edit(path, lambda book: book.create_sheet("Pasted").append(["laboratory"])).read_bytes()


@pytest.fixture
def paste(tmp_path, with_sheet):
    """A function that types cells into such a workbook beside its records, and returns its path."""

    def type_cells(cells):
        path = make(tmp_path)
        path.write_bytes(with_sheet)
        return type_into(path, cells)

    return type_cells


@pytest.mark.parametrize("name", ["Pasted!North", "pasted!north", "'Pasted'!North"])
def test_a_pasted_column_is_a_record(paste, name):
    book = read_workbook(paste(pasted([0.1, "0.2", -0.3, 0] * 26, name=name)))
    expected = np.array([0.1, 0.2, -0.3, 0] * 26) * 9.80665
    assert book.motions[1].ax_mps2 == pytest.approx(expected)
    assert (book.records[2].name, book.records[2].npts) == (name, 104)


@pytest.mark.parametrize(
    ("header", "per_row"), [("time_s", 0.01), ("t [ms]", 10.0), ("Time [min]", 0.01 / 60.0)]
)
def test_a_pasted_column_agrees_with_the_times_and_units_beside_it(paste, header, per_row):
    cells = timed([per_row * i for i in range(104)], header)
    name = {"Pasted!B3": "North [g]", RECORD: "Pasted!North [g]"}
    assert read_workbook(paste(cells | name)).records[2].npts == 104


BLANK = "is blank, beside or above values; fill it in, or delete its row"
PASTED = f"<{RECORD}>: horizontal record:"


@pytest.mark.parametrize(
    ("cell", "code", "line"),
    [("B6", '0.0" m/s²"', "0.1, shown in m/s²"), ("A6", '0.00" ms"', "0.02, shown in ms")],
)
def test_a_pasted_column_is_shown_in_its_units(paste, cell, code, line):
    cells = timed([0.01 * i for i in range(104)], "t [s]")
    path = edit(paste(cells), lambda book: setattr(book["Pasted"][cell], "number_format", code))
    line = at(f"{PASTED} Pasted!{cell} is {line} by its number format")
    assert problems(path)[0].startswith(line)


def test_a_pasted_column_may_be_shown_with_its_units(paste):
    def change(book):
        for row in range(4, 108):
            book["Pasted"][f"A{row}"].number_format = '0.00" s"'
            book["Pasted"][f"B{row}"].number_format = '0.0000" g"'

    read_workbook(edit(paste(timed([0.01 * i for i in range(104)], "t [s]")), change))


@pytest.mark.parametrize(
    ("cells", "lines"),
    by_day([
        (pasted([0.1, "abc", 0.2]), ["Pasted!B5 is 'abc'; give a number"]),
        (pasted([0.1, "nan", 0.2]), ["Pasted!B5 is 'nan'; give a number"]),
        (pasted([0.1, "#N/A", 0.2]),
         ["Pasted!B5 is #N/A; correct the formula, or type a value"]),
        (pasted([0.1, None, 0.2]), [f"Pasted!B5 {BLANK}"]),
        (pasted(["x"] * 8),
         [*(f"Pasted!B{row} is 'x'; give a number" for row in range(4, 9)),
          "... and 3 more cells"]),
        (pasted([0.1, 0.2], header="East"),
         ["sheet 'Pasted' has no heading 'North' in its first 10 rows; write it above the"
          " column"]),
        (pasted([0.1, 0.2], name="Elsewhere!North"),
         ["'Elsewhere!North' names no sheet of this workbook; give Sheet!Header, or a file"]),
        (pasted([0.1, 0.2], header="North [m/s2]", name="Pasted!North [m/s2]"),
         ["Pasted!B3 is 'North [m/s2]', but the record units are g; correct one of them"]),
        (pasted([0.1, 0.2], header="North [km/s2]", name="Pasted!North [km/s2]"),
         ["Pasted!B3 is 'North [km/s2]', which is no acceleration by time; give the column of"
          " one"]),
        (pasted([0.1, 0.2], header="PSA [g]", name="Pasted!PSA [g]"),
         ["Pasted!B3 is 'PSA [g]', which is no acceleration by time; give the column of one"]),
        (pasted([0.1, 0.2], header="Total [g]", name="Pasted!Total [g]"),
         ["Pasted!B3 is 'Total [g]', the magnitude of a vector; give a component"]),
        (pasted([0.1, -999, 0.2]),
         ["Pasted!North: sample 2 is -999 where no other exceeds 0.2 g: it is a code for missing"
          " data; give a record without gaps"]),
        (timed([0.0, 0.02, 0.04, 0.06]),
         ["Pasted!A3 has times at a step of 0.02 s, but the time step is 0.01 s; correct one of"
          " them"]),
        (timed([0.0, 0.01, 0.02, 0.05]),
         ["Pasted!A7 is 0.05 s, 0.03 s after the row above it, but the typical step is 0.01 s; fill"
          " in the missing rows, or give the record as a file, which is resampled"]),
        (timed([0.0, 0.01, 0.01, 0.02]),
         ["Pasted!A6: found time 0.01 s after 0.01 s, with a typical step of 0.01 s; give"
          " increasing times"]),
        (timed([0.0, None, 0.02, 0.03]), [f"Pasted!A5 {BLANK}"]),
        (timed([0.0, 1.0, 2.0, 3.0], header="Time [h]"),
         ["Pasted!A3 is 'Time [h]'; give times in s, ms or min"]),
        (pasted([0.1, 0.2]) | {"Motions/M2/Time step": None},
         ["'Pasted!North' is a pasted column; give its time step"]),
        (pasted([0.1, 0.2]) | {"Pasted!D2": "North"},
         ["heading 'North' appears at Pasted!D2 and Pasted!B3; rename one"]),
        (pasted([0.1, 0.2]) | {"Pasted!B300000": 1},
         ["Pasted!B300000 contains data more than 200,000 rows below the heading; clear it, or give"
          " the record as a file"]),
    ], 5),
)  # fmt: skip
def test_a_pasted_column_is_refused_by_its_cell(paste, cells, lines):
    assert problems(paste(cells)) == said(*(f"{PASTED} {line}" for line in lines))


@pytest.mark.quick
def test_gals_of_a_pasted_column_are_cm_s2(paste):
    cells = pasted([100.0, -200.0] * 51) | {"Motions/M2/Record units": "gal"}
    motion = read_workbook(paste(cells)).motions[1]
    assert motion.ax_mps2.tolist() == [1.0, -2.0] * 51
