"""Sheets, columns and cells that are missing, merged, or there twice are named."""

import pytest
from openpyxl.utils import coordinate_to_tuple, get_column_letter
from openpyxl.worksheet.table import Table

from cells import cell
from sheets import at, edit, make, problems, said, told


def copied(book, title):
    """Copy a sheet as Excel does: with a table of another name."""
    sheet = book.copy_worksheet(book[title])
    for table in book[title].tables.values():
        sheet.add_table(Table(displayName=f"{table.name}2", ref=table.ref))
    return sheet


@pytest.mark.quick
def test_a_copied_sheet_is_ignored_with_a_warning(tmp_path):
    path = edit(make(tmp_path), lambda book: copied(book, "Arrays"))
    ((name, cell, text),) = told(path)
    assert (name, cell) == ("copy Arrays Copy", at("Arrays/heading/ID"))
    assert text == (
        "sheets 'Arrays' and 'Arrays Copy' both have the labels of Arrays; 'Arrays' is read,"
        " and 'Arrays Copy' is ignored: delete the one that is not meant"
    )


def test_the_warning_names_the_sheet_that_is_read_whatever_its_title(tmp_path):
    def change(book):
        copy = copied(book, "Arrays")
        book["Arrays"].title = "old"
        copy.title = "Arrays"

    ((name, cell, text),) = told(edit(make(tmp_path), change))
    assert (name, cell) == ("copy Arrays", at("Arrays/heading/ID").replace("Arrays", "old"))
    assert "'old' is read, and 'Arrays' is ignored" in text


@pytest.mark.parametrize("title", ["Site", "Options"])
@pytest.mark.nightly
def test_a_sheet_of_several_parts_is_named_once(tmp_path, title):
    ((name, _, _),) = told(edit(make(tmp_path), lambda book: copied(book, title)))
    assert name == f"copy {title} Copy"


def test_a_sheet_with_some_of_the_headings_is_no_copy(tmp_path):
    def change(book):
        book.create_sheet("Notes").append(["ID", "Slope", "x [g]", "y [g]", "Period [s]"])

    assert told(edit(make(tmp_path), change)) == []


FRESH = "copy it from a fresh workbook (roofslip new FOLDER)"


def remove(sheet):
    return lambda book: book.remove(book[sheet])


def forget_number(book):
    del book.defined_names["project_number"]
    number = cell(book, "Project/Project number")
    number.offset(column=-1).value = None


NO_TABLE = "no table {0}_table and no row of its headings"
# What is changed in a workbook, and the resulting line.
EDITED = [
    # It takes no other table for its own.
    *((remove(sheet),
       f"{sheet}: the sheet is missing: {NO_TABLE.format(sheet.lower())}; {FRESH}")
      for sheet in ("Arrays", "Objects")),
    (remove("Site"),
     f"Site: the sheet is missing, or all labels of Site and building; {FRESH}\n"
     "Site: long-period transition T_L is missing (no name target_t_l_s and no label 'Long-period"
     f" transition T_L'); {FRESH}"),
    (forget_number,
     "Project: project number is missing (no name project_number and no label 'Project number');"
     f" {FRESH}"),
    # A required column is pointed at where it was.
    (lambda book: book["Arrays"].delete_cols(cell(book, "Arrays/A1/Weight").column),
     "<Arrays/heading/Weight>: heading 'Weight' is missing; write it here in its own column, or"
     f" {FRESH}"),
]  # fmt: skip


@pytest.mark.parametrize(("change", "line"), EDITED, ids=[line[:40] for _, line in EDITED])
def test_what_is_missing_is_reported_once(tmp_path, change, line):
    assert problems(edit(make(tmp_path), change)) == said(*line.splitlines())


@pytest.mark.parametrize(
    ("name", "to"),
    [("Arrays/A1/Friction test report", (1, 0)), ("Site/Structure height h", (1, 0)),
     ("Site/Structure height h", (0, 1)), ("Site/Structure height h", (0, -1))],
    ids=["table", "below", "unit", "label"],
)  # fmt: skip
def test_merged_cells_of_a_table_or_over_a_single_field_are_reported(tmp_path, name, to):
    sheet, first = at(name).split("!")
    row, column = coordinate_to_tuple(first)
    (top, bottom), (left, right) = (sorted((0, step)) for step in to)
    corners = ((row + top, column + left), (row + bottom, column + right))
    cells = ":".join(f"{get_column_letter(across)}{down}" for down, across in corners)
    path = edit(make(tmp_path), lambda book: book[sheet].merge_cells(cells))
    assert problems(path) == (f"{sheet}!{cells}: cells are merged; unmerge them",)
