"""No text of a new workbook is longer than its cell shows."""

import pytest
from openpyxl import load_workbook
from openpyxl.utils import get_column_letter

from projects.example.make import project
from report.drawing.items import TYPE_PT, width_in
from report.sheet.schema.choices import UnitsFirst
from report.sheet.writing.template import write_template

# Excel with Calibri 11: 7 px a unit of width and 5 px beside it, at 96 px an inch; 3 px an indent
# of each step; lines of 1.22 times the size. Source Sans is 2 to 3 % wider than Calibri.
UNIT_IN, BESIDE_IN, INDENT_IN, LINE = 7 / 96, 5 / 96, 9 / 96, 1.22
DEFAULT_ROW_PT, DEFAULT_WIDTH = 15.0, 8.43


@pytest.fixture(scope="module", params=["US", "SI", "example"])
def book(request, tmp_path_factory):
    path = tmp_path_factory.mktemp("whole") / "input.xlsx"
    is_example = request.param == "example"
    units = UnitsFirst.US if is_example else UnitsFirst(request.param)
    write_template(path, units=units, example=project() if is_example else None)
    return load_workbook(path)


def wide_in(sheet, column):
    """The width of a column; of merged cells it is that of all of them."""
    dimension = sheet.column_dimensions.get(get_column_letter(column))
    return (dimension.width if dimension else DEFAULT_WIDTH) * UNIT_IN


def size_in(cell, text):
    return width_in(text, is_bold=bool(cell.font.b)) * cell.font.sz / TYPE_PT


def lines(cell, wide):
    """How many lines a cell breaks its text into, between words and after hyphens and slashes."""
    count, line = 1, ""
    for word in str(cell.value).split(" "):
        tried = f"{line} {word}".strip()
        if line and size_in(cell, tried) > wide:
            count, tried = count + 1, word
        line = tried
    return count


def lost(book):
    """Cells whose text is cut: taller than the row, wider than the column, or over a neighbor."""
    for sheet in book:
        merged = {area.coord.split(":")[0]: area for area in sheet.merged_cells.ranges}
        for cell in (cell for row in sheet for cell in row if isinstance(cell.value, str)):
            is_hidden = sheet.column_dimensions[cell.column_letter].hidden
            if cell.data_type == "f" or is_hidden:
                continue
            area = merged.get(cell.coordinate)
            columns = range(area.min_col, area.max_col + 1) if area else [cell.column]
            wide = sum(wide_in(sheet, c) for c in columns) - BESIDE_IN
            wide -= INDENT_IN * cell.alignment.indent
            if cell.alignment.wrap_text:
                tall = lines(cell, wide) * LINE * cell.font.sz
                widest = max(size_in(cell, word) for word in cell.value.split())
                if tall > (sheet.row_dimensions[cell.row].height or DEFAULT_ROW_PT) + 0.5:
                    yield f"{sheet.title}!{cell.coordinate} is too tall: {cell.value}"
                elif widest > wide:
                    yield f"{sheet.title}!{cell.coordinate} has a word too wide: {cell.value}"
                continue
            beside, at = cell.column + 1, wide
            while at < size_in(cell, cell.value):
                if sheet.cell(cell.row, beside).value is not None:
                    yield f"{sheet.title}!{cell.coordinate} runs into its neighbor: {cell.value}"
                    break
                at, beside = at + wide_in(sheet, beside), beside + 1


def test_no_text_is_cut(book):
    assert list(lost(book)) == []


@pytest.mark.quick
def test_no_message_is_cut(book):
    """At 255 characters an input message would be, and an error alert at 225."""
    rules = [rule for sheet in book for rule in sheet.data_validations.dataValidation]
    assert len(rules) > 100
    assert [rule.prompt for rule in rules if not rule.prompt.endswith((".", ")"))] == []
    assert [rule.error for rule in rules if rule.error.endswith("…")] == []
