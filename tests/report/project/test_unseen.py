"""What is read though the workbook does not show it is a warning, with the cells."""

import re
from dataclasses import replace

import pytest
from openpyxl.styles import Font, PatternFill
from openpyxl.styles.colors import Color
from openpyxl.utils import coordinate_to_tuple, get_column_letter
from openpyxl.worksheet.cell_range import CellRange
from openpyxl.worksheet.filters import AutoFilter, FilterColumn, Filters

from fixtures import assessments
from fixtures.cells import cell as named
from fixtures.marks import by_day
from fixtures.pages import page_of
from fixtures.workbooks import (
    blank,
    cell_address,
    edit,
    findings_of,
    make,
    read_workbook,
    row_cells,
    type_into,
)
from report.assessment.precheck import findings
from report.project.model.input_rows import Place
from report.project.read.read import read
from report.project.read.unseen import Concealment, Unseen, warnings


def cell_of(name):
    """Sheet, column letter and row of a cell of `make`."""
    sheet, cell = cell_address(name).split("!")
    row, column = coordinate_to_tuple(cell)
    return sheet, get_column_letter(column), row


def has(text, *cells):
    """Whether the ranges of a text include cells."""
    ranges = [CellRange(area) for area in re.findall(r"[A-Z]+[0-9]+(?::[A-Z]+[0-9]+)?", text)]
    return all(any(cell in area for area in ranges) for cell in cells)


def hide_options(path, state):
    return edit(path, lambda book: setattr(book["Options"], "sheet_state", state))


@pytest.mark.parametrize(
    ("state", "said"),
    by_day(
        [("hidden", "hidden"), ("veryHidden", "hidden so that the menu of Excel does not list it")],
        1,
    ),
)
def test_an_override_on_a_hidden_sheet_is_a_warning(tmp_path, state, said):
    sheet, column, row = cell_of("Options/1/Value")
    ((name, _, text),) = findings_of(hide_options(make(tmp_path), state))
    assert name == f"hidden sheet {sheet}"
    assert text.startswith(f"the worksheet is {said}, but cells B")
    assert has(text, f"{column}{row}")
    assert text.endswith(" on it are used: unhide it, or clear the cells that you do not want")


def test_hidden_rows_and_columns_are_one_warning_with_their_cells(tmp_path):
    sheet, letter, row = cell_of("Arrays/A2/Friction coefficient")

    def change(book):
        book[sheet].row_dimensions[row].hidden = True
        book[sheet].column_dimensions[letter].hidden = True

    ((name, cell, text),) = findings_of(edit(make(tmp_path), change))
    assert name == f"hidden {sheet}"
    assert has(text, f"{letter}{row - 2}", f"{letter}{row - 1}", f"B{row}")  # with the heading
    assert not has(text, f"B{row - 1}")
    assert text.endswith(" are in hidden rows or columns but are used: unhide them, or clear the"
                         " cells that you do not want")  # fmt: skip
    assert cell.startswith(f"{sheet}!")


def test_a_cell_in_a_row_or_column_without_size_is_hidden(tmp_path):
    """Each on a sheet of its own."""
    places = ("Project/Project number", "Site/Structure height h/Unit",
              "Arrays/A1/Importance factor I_p", "Objects/RTU-1/Height")  # fmt: skip
    number, unit, factor, height = map(cell_of, places)

    def change(book):
        book["Project"].row_dimensions[number[2]].height = 0.75  # one pixel
        book["Site"].column_dimensions[unit[1]].hidden = True
        # As Excel saves it; what Roofslip itself types into a folded column, it unfolds.
        named(book, "Arrays/A1/Importance factor I_p").value = 1.5
        book["Objects"].column_dimensions[height[1]].width = 0.1

    for (name, _, text), (sheet, letter, row) in zip(
        findings_of(edit(make(tmp_path), change)), (number, unit, factor, height), strict=True
    ):
        assert name == f"hidden {sheet}"
        assert has(text, f"{letter}{row}")


def filter_table(book, sheet):
    table = next(iter(book[sheet].tables.values()))
    table.autoFilter = AutoFilter(ref=table.ref)
    table.autoFilter.filterColumn = [FilterColumn(colId=0, filters=Filters(filter=["A1"]))]


def filter_sheet(book, sheet):
    book[sheet].auto_filter.ref = next(iter(book[sheet].tables.values())).ref
    book[sheet].auto_filter.add_filter_column(0, ["A1"])


@pytest.mark.parametrize("change", by_day([filter_table, filter_sheet], 1))
def test_a_row_that_a_filter_hides_is_filtered_out(tmp_path, change):
    sheet, _, row = cell_of("Arrays/A2/ID")

    def hide(book):
        change(book, sheet)
        book[sheet].row_dimensions[row].hidden = True

    ((name, cell, text),) = findings_of(edit(make(tmp_path), hide))
    assert (name, cell) == (f"filtered out {sheet}", f"{sheet}!B{row}")
    assert "are in rows that a filter hides but are used: clear the filter, and delete" in text


def test_a_row_that_is_struck_through_is_a_warning_and_a_blank_one_is_none(tmp_path):
    path = make(tmp_path)
    sheet, letter, row = cell_of("Clearances/5/Fire pathway")

    def change(book):
        for number in (row, row + 1):
            for cell in book[sheet][number]:
                cell.font = Font(strike=True)

    text = (
        f"cells B{row}:{letter}{row} are struck through but are used: clear the cells that you do"
        " not want, and remove the strikethrough from the others"
    )
    assert findings_of(edit(path, change)) == [(f"struck through {sheet}", f"{sheet}!B{row}", text)]


def looking(path, look):
    """Give the friction coefficient of A1 another font, fill or number format."""

    def change(book):
        for name, value in look.items():
            setattr(named(book, "Arrays/A1/Friction coefficient"), name, value)

    return edit(path, change)


INVISIBLE = (
    {"font": Font(color="FFFFFF"), "fill": PatternFill("solid", start_color="FFFFFF")},
    {"font": Font(color="FFFDFB"), "fill": PatternFill()},
    {"font": Font(color=Color(theme=0)), "fill": PatternFill()},
    {"font": Font(color="FFF6CC")},  # that of the input cells
    {"fill": PatternFill("solid", start_color="000000")},
    {"number_format": ";;;"},
)
SEEN = (
    {"font": Font(color="FF0000")},
    {"font": Font(color=Color(theme=1)), "fill": PatternFill()},
    {"font": Font(color=Color(indexed=8)), "fill": PatternFill()},
    {"fill": PatternFill("darkGray", start_color="000000")},
)


@pytest.mark.parametrize("look", by_day(INVISIBLE, 1))
def test_a_number_that_cannot_be_seen_is_a_warning(tmp_path, look):
    ((name, place, text),) = findings_of(looking(make(tmp_path), look))
    sheet, _, cell = place.partition("!")
    assert (name, place) == (f"invisible {sheet}", cell_address("Arrays/A1/Friction coefficient"))
    assert text == (
        f"cell {cell} is invisible because of the text color or the number format but is used:"
        " change the format, or clear the cells that you do not want"
    )


def test_what_the_template_folds_and_unread_sheets_are_no_warnings(tmp_path):
    def change(book):
        for name in ("Provisions", "Tables", "Start", "Layers"):
            book[name].sheet_state = "hidden"
        assert any(c.hidden for c in book["Arrays"].column_dimensions.values())

    assert findings_of(edit(make(tmp_path), change)) == []
    assert read(blank(tmp_path / "blank.xlsx")).unseen == ()


@pytest.mark.parametrize("look", by_day(SEEN, 1))
def test_a_number_in_another_color_that_can_be_seen_is_no_warning(tmp_path, look):
    assert findings_of(looking(make(tmp_path), look)) == []


@pytest.mark.nightly
def test_a_warning_is_acknowledged_by_its_name_and_the_echo_marks_its_cells(tmp_path):
    rows = [{"warning": "Hidden  sheet options", "reason": "Kept from the client's view"}]
    path = hide_options(make(tmp_path, acknowledged=rows), "hidden")
    book = read_workbook(path)
    (found,) = findings(book.sheet.source, book.sheet.project, book.shaking)
    assert found.reason == "Kept from the client's view"
    sheet, _, _ = cell_of("Options/1/Value")
    done = replace(assessments.package().assessment, source=book.sheet.source)
    tables = [table for table in page_of(done, "echo").tables if table.title == sheet]
    assert "18 (hidden sheet)" in {cell for table in tables for row in table.cells for cell in row}
    assert not any(row.unseen for row in book.sheet.echo if row.sheet != sheet)


@pytest.mark.nightly
def test_a_pasted_record_on_a_hidden_sheet_is_one_warning_and_a_note_of_the_record(tmp_path):
    def change(book):
        sheet = book.create_sheet("Pasted")
        for row in range(1, 151):
            values = ["t [s]", "x [g]", "y [g]"] if row == 1 else [0.01 * row, 0.1, 0.2 / row]
            for column, value in enumerate(values, start=1):
                sheet.cell(row, column).value = value
        sheet.sheet_state = "hidden"
        sheet.row_dimensions[5].hidden = True

    path = edit(make(tmp_path), change)
    records = {"Horizontal record": "Pasted!x [g]", "Transverse record": "Pasted!y [g]"}
    book = read_workbook(type_into(path, row_cells("Motions/M1", records)))
    found = [f for f in findings(book.sheet.source, book.sheet.project, book.shaking) if f.id]
    ((name, text),) = [(f.id, f.text) for f in found if f.id.startswith("hidden")]
    assert name == "hidden sheet Pasted"
    assert "but cells A1:C150 on it are used" in text
    page = page_of(replace(assessments.package().assessment, shaking=book.shaking), "records")
    assert "M1 horizontal: cells A1:B150 on the Pasted worksheet: hidden sheet" in page


@pytest.mark.quick
def test_many_cells_are_named_by_their_first_ranges():
    cells = tuple((row, column) for row in range(8, 31, 2) for column in (2, 3))
    place, kind = Place("arrays", 0, "id"), Concealment.STRUCK
    scattered = Unseen(kind=kind, sheet="Arrays", state="visible", place=place, cells=cells)
    named = "B8:C8, B10:C10, B12:C12, B14:C14, B16:C16, B18:C18, B20:C20, B22:C22"
    assert scattered.words == f"cells {named} and 4 more ranges"
    pairs = tuple((row, column) for row in range(8, 31) for column in (2, 4))
    whole = replace(scattered, cells=pairs)
    (found,) = warnings([scattered, whole])
    assert found.text.startswith("cells B8:D8, B9, D9, B10:D10, B11, D11,")
    assert replace(whole, cells=whole.cells[::2]).words == "cells B8:B30"
