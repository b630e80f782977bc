"""What Excel 2016 asks of the written workbook, looked up in its parts."""

import re

import defusedxml.ElementTree
import pytest
from openpyxl import load_workbook
from pypdf import PdfReader

import sheets
from cells import cell
from recalculated import converted
from sheets import blank, make, type_into

MAIN = "{http://schemas.openxmlformats.org/spreadsheetml/2006/main}"
# Of Excel 2007 and later.
FUNCTIONS = {
    "ABS", "AND", "ATAN", "CHAR", "CODE", "COUNT", "COUNTA", "COUNTIF", "DEGREES", "FIND", "IF",
    "IFERROR", "INDEX", "ISBLANK", "ISNUMBER", "LEFT", "MATCH", "MAX", "MID", "MIN", "MOD", "N",
    "NA", "NOT", "OFFSET", "OR", "RADIANS", "ROUNDUP", "ROW", "ROWS", "SUBSTITUTE", "SUMPRODUCT",
    "TRIM", "UPPER",
}  # fmt: skip


@pytest.fixture(scope="module", params=["blank", "filled"])
def parts(request, tmp_path_factory):
    folder = tmp_path_factory.mktemp("parts")
    path = make(folder) if request.param == "filled" else blank(folder / "input.xlsx")
    return sheets.parts(path)


def elements(parts, tag, folder="xl/"):
    for name, data in parts.items():
        if name.startswith(folder) and name.endswith(".xml"):
            yield from defusedxml.ElementTree.fromstring(data).iter(f"{MAIN}{tag}")


def formulas(parts):
    """Every formula of cells, tables, names, formats and validations."""
    for tag in ("f", "calculatedColumnFormula", "definedName", "formula", "formula1", "formula2"):
        yield from (item.text or "" for item in elements(parts, tag))


def outside_quotes(formula):
    return re.sub(r'"[^"]*"', '""', formula)


def test_every_formula_is_of_excel_before_2016_with_defined_names(parts):
    assert {item.get("t") for item in elements(parts, "f")} == {None}
    texts = list(map(outside_quotes, formulas(parts)))
    assert {name for text in texts for name in re.findall(r"([A-Z]+)\(", text)} <= FUNCTIONS
    assert not any(re.search(r"\{|_xlfn|\[\d+\]", text) for text in texts)
    assert list(elements(parts, "sheetProtection")) == []
    assert not any("externalLink" in name for name in parts)
    names = {item.get("name") for item in elements(parts, "definedName")}
    used = {
        name
        for text in formulas(parts)
        for name in re.findall(r"\b(?:live|rule|unit|sdc|top)_\w+", outside_quotes(text))
    }
    assert used <= names


@pytest.mark.quick
def test_formulas_of_a_column_are_those_that_new_rows_get(parts):
    columns = list(elements(parts, "calculatedColumnFormula"))
    cells = {item.text for item in elements(parts, "f")}
    assert len(columns) > 10
    assert {column.text for column in columns} <= cells


@pytest.fixture(scope="module")
def printed(tmp_path_factory):
    """The text of each page of a workbook whose only row is an array's name, as printed."""
    folder = tmp_path_factory.mktemp("printed")
    path = type_into(blank(folder / "input.xlsx"), {"Arrays/1/ID": "A1"})
    (file,) = converted([path], folder, "pdf")
    return [page.extract_text() for page in PdfReader(file).pages]


@pytest.mark.nightly
def test_wide_tables_print_on_two_pages_with_their_first_columns(tmp_path, printed):
    book = load_workbook(blank(tmp_path / "input.xlsx"))
    assert [s.title for s in book if s.print_title_cols] == ["Arrays"]
    assert book["Arrays"].print_title_cols == "$A:$B"
    start = [text for text in printed if "Roofslip input workbook" in text]
    assert len(start) == 1
    assert "Macros are not" in start[0]  # the last note
    arrays = [text for text in printed if "One row for each array that" in text]
    assert len(arrays) == 2
    assert all("Allowed" in text and "ID" in text for text in arrays)
    assert "###" not in "".join(printed)


@pytest.mark.nightly
def test_rare_columns_are_folded_until_one_is_filled(tmp_path):
    empty = load_workbook(blank(tmp_path / "blank.xlsx"))
    rare = column(empty, "High-velocity friction")
    assert (rare.outlineLevel, rare.hidden) == (1, True)
    assert column(empty, "Weight").outlineLevel == 0
    filled = load_workbook(make(tmp_path, arrays=sheets.arrays(i_p=1.25)))
    assert not column(filled, "Importance factor I_p").hidden
    assert column(filled, "Kind of array").hidden


def column(book, heading):
    letter = cell(book, f"Arrays/heading/{heading}").column_letter
    return book["Arrays"].column_dimensions[letter]
