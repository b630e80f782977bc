"""A row of the sheet has its tick where `roofslip check` accepts its cells, and only there."""

import pytest
from openpyxl import load_workbook
from openpyxl.utils.cell import coordinate_to_tuple

from cells import cell
from recalculated import recalculated_sheets
from sheets import at, edit, make, problems, type_into

ROWS = {"Arrays": 2, "Objects": 4, "Clearances": 5, "Motions": 3}

REFUSED = {
    "Arrays/1/Downslope direction": 400,
    "Arrays/2/Friction coefficient": "45%",
    "Objects/1/Kind": "chimney",
    "Objects/2/ID": "RTU-1",  # as that of the first row
    "Objects/3/Importance factor I_p": 2.0,
    "Clearances/1/Object": "RTU-9",
    "Clearances/2/Array": "a1",
    "Clearances/3/Provided clearance": -1.0,
    "Clearances/4/Provided clearance": "96 in",
    "Motions/1/Scaling": "PPA",
    "Motions/2/Horizontal record": None,
}
ALSO = {
    "Arrays/1/Slope": 50.0,
    "Arrays/2/High-velocity friction": 0.5,
    "Objects/1/x from": 500.0,
    "Motions/1/Polarity": "up",
    "Motions/2/ID": "M1",  # as that of the first row
}
NAMES = ("accepted", "refused", "refused-too", "percentage")


def shown_as_percent(book):
    cell(book, "Arrays/1/Friction coefficient").number_format = "0%"


def shown(sheets, title, row):
    sheet, place = at(f"{title}/{row}/Status").split("!")
    number, column = coordinate_to_tuple(place)
    return sheets[sheet][number - 1][column - 1]


@pytest.fixture(scope="module")
def spoiled(tmp_path_factory):
    """Four workbooks, one of them accepted, with their sheets as LibreOffice computes them."""
    folder = tmp_path_factory.mktemp("ticks")
    paths = [make(folder / name).rename(folder / name / f"{name}.xlsx") for name in NAMES]
    type_into(paths[1], REFUSED)
    type_into(paths[2], ALSO)
    edit(paths[3], shown_as_percent)
    return dict(zip(paths, recalculated_sheets(paths, folder), strict=True))


@pytest.mark.nightly("report/sheet/checking/conditions.py", "report/sheet/writing/needs.py")
def test_a_row_has_its_tick_where_check_finds_nothing_in_it(spoiled):
    for path, sheets in spoiled.items():
        lines = () if path.parent.name == "accepted" else problems(path)
        for title, count in ROWS.items():
            rows = range(1, count + 1)
            heads = coordinate_to_tuple(at(f"{title}/1/Status").split("!")[1])[0] - 1
            cells = [line.split(":")[0].split("!") for line in lines]
            refused = {
                coordinate_to_tuple(place)[0] - heads for name, place in cells if name == title
            }
            assert {row for row in rows if shown(sheets, title, row) != 0} == refused, lines


def test_formulas_are_no_longer_than_excel_permits(tmp_path):
    """Microsoft's specifications and limits of Excel: 8,192 characters."""
    book = load_workbook(make(tmp_path))
    texts = [c.value for sheet in book for row in sheet for c in row if c.data_type == "f"]
    texts += [name.attr_text for name in book.defined_names.values()]
    assert max(map(len, texts)) <= 8192
