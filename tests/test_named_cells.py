"""Cells that tests name by sheet, row and heading."""

import pytest
from openpyxl import Workbook
from openpyxl.worksheet.table import Table

from cells import address, addressed

pytestmark = pytest.mark.quick

ROOF = (("", "Value", "Unit"), ("Height *", 3, "ft"), ("Ratio a / b", 2), ("Below",),
        ("Status", "ID", "x from [ft]", "x to [ft]"), (1, "A", 0, 9), (1, "B", 9, 20))  # fmt: skip
RESULTS = (("Verdict", "OK"), ("ID", "Design [in]", "Design [mm]", "Verdict"), ("A", 1, 25.4, "OK"))


@pytest.fixture(scope="module")
def book():
    """A table with a column of statuses below two single cells, and a sheet without tables."""
    made = Workbook()
    del made["Sheet"]
    for title, lines in (("Roof", ROOF), ("Results", RESULTS)):
        sheet = made.create_sheet(title)
        for line in lines:
            sheet.append(line)
    made["Roof"].add_table(Table(displayName="roofs", ref="A5:D8"))
    return made


@pytest.mark.parametrize(
    ("name", "wanted"),
    [("Roof/A/x from", "Roof!C6"), ("Roof/2/x to", "Roof!D7"), ("Roof/3/ID", "Roof!B8"),
     ("Roof/heading/x to", "Roof!D5"), ("Roof/B/x from:x to", "Roof!C7:D7"),
     ("Roof/Height", "Roof!B2"), ("Roof/Height/Unit", "Roof!C2"), ("Roof/Ratio a / b", "Roof!B3"),
     ("Results/A/Verdict", "Results!D3"), ("Results/1/Design [mm]", "Results!C3"),
     ("Results/Verdict", "Results!B1")],
)  # fmt: skip
def test_a_cell_is_found_by_what_is_printed_beside_and_above_it(book, name, wanted):
    assert address(book, name) == wanted
    assert address(book, wanted) == wanted
    assert addressed(book, f"<{name}>: x < 3 ft/s") == f"{wanted}: x < 3 ft/s"


@pytest.mark.parametrize(
    ("name", "known"),
    [("Rood/A/x to", "sheet: .*; there are Roof, Results"), ("Roof/C/x to", "row: .*; .* A, B"),
     ("Roof/A/y", "heading: .*; .*x from"), ("Roof/Width", "label: .*; .*Height"),
     ("Results/A/Design", "heading: .*; .*Design .mm")],
)  # fmt: skip
def test_a_name_of_no_cell_or_of_several_is_an_error_that_lists_what_is_there(book, name, known):
    with pytest.raises(LookupError, match=f"no such {known}"):
        address(book, name)
