"""User-defined target spectra: sheets and CSV files, and their input errors."""

from pathlib import Path

import numpy as np
import pytest
from openpyxl import Workbook

from report.suite.target_table import MAX_ROWS, read_target
from solver.model import InputError

pytestmark = pytest.mark.quick

ROWS = [("Period [s]", "Horizontal [g]", "Vertical [g]")] + [
    (period, 1.0 / (1.0 + period), 0.5) for period in (0.02, 0.1, 0.5, 1.0, 4.0)
]


def book(tmp_path, rows, *, title="Target", others=("Notes",)):
    workbook = Workbook()
    sheet = workbook.active
    sheet.title = title
    for row in rows:
        sheet.append(row)
    for name in others:
        workbook.create_sheet(name)
    path = tmp_path / "spectra.xlsx"
    workbook.save(path)
    return path


def text(tmp_path, content):
    path = tmp_path / "target.csv"
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    return str(path)


def problems(named):
    with pytest.raises(InputError) as caught:
        read_target(str(named))
    return caught.value.problems


def test_a_sheet_is_read_by_its_headings_in_any_order_of_rows_and_columns(tmp_path):
    title = ("Site-specific", None, None, None)
    rows = [title, ("note", "Vertical (g)", "T [s]", "SA [g]")]
    rows += [("x", row[2], row[0], row[1]) for row in ROWS[3:] + ROWS[1:3]]
    target = read_target(f"{book(tmp_path, rows)}!target")
    assert target.source == "spectra.xlsx!Target"
    period = np.array([4.0, 1.0, 0.5, 0.1, 0.02])
    assert target.freq_hz == pytest.approx(1.0 / period, rel=1e-12)
    assert target.horizontal_g == pytest.approx(1.0 / (1.0 + period), rel=1e-12)
    assert target.vertical_g.tolist() == [0.5] * 5
    assert target.has_vertical


@pytest.mark.parametrize("separator", [",", ";", "\t"])
def test_csv_of_frequencies_is_read_without_a_vertical(tmp_path, separator):
    lines = ["frequency_hz,horizontal_g", "0.1,0.2", "", "1.3,2", "33.3,1.2"]
    content = "\ufeff" + "\r\n".join(lines).replace(",", separator)
    path = text(tmp_path, content)
    target = read_target(path)
    Path(path).write_bytes(content.encode("utf-16-le"))  # as Excel's Unicode text
    assert read_target(path).freq_hz.tolist() == target.freq_hz.tolist()
    assert target.freq_hz.tolist() == [0.1, 1.3, 33.3]
    assert target.horizontal_g.tolist() == [0.2, 2.0, 1.2]
    assert not target.has_vertical
    # A comma is decimal where a semicolon separates.
    lines = ["frequency;horizontal", "0,1;0,2", "1,3;1,234", "33,3;1,2"]
    assert read_target(text(tmp_path, "\n".join(lines))).horizontal_g.tolist() == [0.2, 1.234, 1.2]


def test_every_invalid_cell_is_reported_by_its_address(tmp_path):
    rows = [list(row) for row in ROWS]
    rows[1][1] = "1,5,0"
    rows[2][2] = None
    rows[3][0] = 0
    rows[4][1] = True
    rows[5][2] = 250
    assert problems(f"{book(tmp_path, rows)}!Target") == (
        "Target!A4: period is 0; give a number from 0.001 to 1000 [s]",
        "Target!B2: horizontal is '1,5,0'; give a number greater than 0 [g]",
        "Target!B5: horizontal is TRUE, a logical value; give a number greater than 0 [g]",
        "Target!C3: vertical is blank; give a number greater than 0",
        "Target!C6: vertical is 250; give a number from 1e-06 to 100 [g]",
    )
    rows = [list(row) for row in ROWS]
    rows[1][1] = "=1+1"  # a formula that was never computed
    (problem,) = problems(f"{book(tmp_path, rows)}!Target")
    assert problem.startswith("Target!B2: horizontal ")
    assert "=1+1" in problem


def test_lines_of_csv_are_reported_by_their_number(tmp_path):
    content = "frequency [Hz],horizontal [g]\n0.1,0.2\n1,x\n50\n"
    assert problems(text(tmp_path, content)) == (
        "target.csv:3: horizontal is 'x'; give a number greater than 0 [g]",
        "target.csv:4: horizontal is blank; give a number greater than 0",
    )


@pytest.mark.parametrize(
    ("heading", "expected"),
    [
        ("period [ms],horizontal [g]", "target.csv:1: is 'period [ms]'; give period [s]"),
        ("period [s],horizontal [m/s2]", "is 'horizontal [m/s2]'; give horizontal [g]"),
        ("period [s],sa [g],sa [g]", "target.csv:1: a second horizontal column; delete one"),
        ("period,frequency,sa", "both frequency and period; delete one of them"),
        ("a,b", "target.csv: no row of headings in the first 10 rows; give frequency [Hz]"),
        ("period [s],vertical [g]", "no row of headings"),
    ],
)
def test_ambiguous_headings_are_rejected(tmp_path, heading, expected):
    reported = problems(text(tmp_path, heading + "\n0.01,1,1\n5,1,1\n"))
    assert any(expected in problem for problem in reported)


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        ("", "has no rows of numbers; give at least 2"),
        ("0.1,1\n", "has 1 row of numbers; give at least 2"),
        ("0.1,1\n50,1\n50,2\n", "50 Hz (0.02 s) appears twice"),
        ("0.5,1\n50,1\n", "covers 0.5 to 50 Hz; give 0.3 to 33.3 Hz (periods from 0.03"),
        ("0.1,1\n20,1\n", "covers 0.1 to 20 Hz"),
    ],
)
def test_a_table_too_short_is_rejected(tmp_path, body, expected):
    (problem,) = problems(text(tmp_path, "frequency [Hz],horizontal [g]\n" + body))
    assert expected in problem


def test_periods_printed_to_two_decimals_reach_the_band(tmp_path):
    target = read_target(text(tmp_path, "period [s],horizontal [g]\n0.03,1\n3.33,0.3\n"))
    assert target.freq_hz.tolist() == [1 / 3.33, 1 / 0.03]


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("!Nothing", "spectra.xlsx: has no sheet 'Nothing'; give one of 'Target', 'Notes'"),
        ("", "spectra.xlsx: has 2 sheets; give spectra.xlsx!Sheet, one of 'Target', 'Notes'"),
        ("!Notes", "spectra.xlsx!Notes: no row of headings"),
    ],
)
def test_a_sheet_that_is_not_there_is_reported_and_the_only_one_needs_no_name(
    tmp_path, name, expected
):
    (problem,) = problems(f"{book(tmp_path, ROWS)}{name}")
    assert expected in problem
    assert read_target(str(book(tmp_path, ROWS, others=()))).source == "spectra.xlsx!Target"


def test_far_away_cells_and_long_files_are_rejected(tmp_path):
    path = book(tmp_path, [*ROWS, *[(None,)] * (MAX_ROWS + 10), (1.0,)])
    (problem,) = problems(f"{path}!Target")
    assert f"Target!A{MAX_ROWS + 17}: contains data beyond row" in problem
    long = "period,sa\n" + "1,1\n" * (MAX_ROWS + 10)
    assert f"give at most {MAX_ROWS} rows" in problems(text(tmp_path, long))[0]


@pytest.mark.parametrize(
    ("name", "content", "expected"),
    [
        ("target.csv", b"\x00\x01", "not a text file"),
        ("target.csv", b'period,"sa\n', "not CSV"),
        ("target.csv", b"x" * 1001, "found a line of 1001 characters; give at most 1000"),
        ("spectra.xlsx", b"PK nonsense", "not a workbook, or truncated"),
        ("none.csv", None, "no such file"),
        ("none.xlsx", None, "no such file"),
    ],
)
def test_a_file_that_is_not_a_table_is_reported(tmp_path, name, content, expected):
    if content is not None:
        (tmp_path / name).write_bytes(content)
    named = f"{tmp_path / name}{'!Target' if name.endswith('xlsx') else ''}"
    assert expected in problems(named)[0]
