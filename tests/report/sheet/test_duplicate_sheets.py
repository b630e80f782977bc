"""A sheet that is like another one, and ignored, is named."""

import pytest
from openpyxl.worksheet.table import Table

from sheets import at, edit, make, told


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
