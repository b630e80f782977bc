"""What Excel 2016 asks of the written workbook, looked up in its parts."""

import re

import defusedxml.ElementTree
import pytest
from openpyxl import load_workbook
from openpyxl.utils.cell import coordinate_to_tuple
from pypdf import PdfReader

import sheets
from cells import cell
from recalculated import converted, recalculated_sheets
from report.sheet.reading.read import read
from report.sheet.schema.choices import UnitsFirst
from report.sheet.writing.marks import RED, VIOLET
from report.sheet.writing.needs import WRONG
from sheets import at, blank, edit, make, of, put, same, type_into

MAIN = "{http://schemas.openxmlformats.org/spreadsheetml/2006/main}"
# Of Excel 2007 and later, and ISFORMULA of 2013, which is written with this prefix.
PREFIXED = {"_xlfn.ISFORMULA"}
FUNCTIONS = {
    "ABS", "AND", "ATAN", "CELL", "CHAR", "CODE", "COUNT", "COUNTA", "COUNTIF", "DATEVALUE",
    "DEGREES", "EXACT", "FALSE", "FIND", "IF", "IFERROR", "INDEX", "INT", "ISERROR",
    "ISFORMULA", "ISLOGICAL", "ISNUMBER", "LEFT", "LEN", "LOWER", "MATCH", "MAX",
    "MID", "MIN", "MOD", "N", "NA", "NOT", "OFFSET", "OR", "RADIANS", "ROUNDUP", "ROW", "ROWS",
    "SUBSTITUTE", "SUM", "SUMIF", "SUMPRODUCT", "TRIM", "UPPER",
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


def test_no_formula_is_an_array_formula(parts):
    assert {item.get("t") for item in elements(parts, "f")} == {None}
    assert not any("{" in outside_quotes(text) for text in formulas(parts))


def test_every_function_was_in_excel_before_2016(parts):
    texts = list(map(outside_quotes, formulas(parts)))
    assert {name for text in texts for name in re.findall(r"([A-Z]+)\(", text)} <= FUNCTIONS
    prefixed = {name for text in texts for name in re.findall(r"_xlfn\.\w+", text)}
    assert prefixed <= PREFIXED
    assert not any(re.search(r"(?<!_xlfn\.)ISFORMULA", text) for text in texts)


def test_no_sheet_is_protected_and_nothing_refers_to_another_file(parts):
    assert list(elements(parts, "sheetProtection")) == []
    assert not any("externalLink" in name for name in parts)
    assert not any(re.search(r"\[\d+\]", outside_quotes(text)) for text in formulas(parts))


def test_formulas_of_a_column_are_those_that_new_rows_get(parts):
    columns = list(elements(parts, "calculatedColumnFormula"))
    cells = {item.text for item in elements(parts, "f")}
    assert len(columns) > 10
    assert {column.text for column in columns} <= cells


def test_every_name_used_is_defined(parts):
    names = {item.get("name") for item in elements(parts, "definedName")}
    used = {
        name
        for text in formulas(parts)
        for name in re.findall(r"\b(?:live|rule|unit|lacks|sdc|status)_\w+", outside_quotes(text))
    }
    assert used <= names


def half_filled(book):
    """What a person has typed: a project without date, an array without weight, odd values."""
    array = {"ID": "A1", "Slope": 2.0, "Slope unit": "degrees", "Friction coefficient": 0.9}
    put(book, of("Arrays/1", array | {"Construction": "Tray"}) | {"Arrays/2/ID": " "})
    put(book, of("Objects/1", {"ID": "NORTH", "Kind": "edge with parapet"}))
    put(book, of("Objects/2", {"ID": "RTU-1", "Kind": "fixed object", "x from": 5}))
    motion = {"ID": "M1", "Horizontal record": "records/x.csv", "Scaling": "PPA"}
    put(book, of("Motions/1", motion))
    put(book, {"Project/Project name": "Depot", "Options/Peer review": "Yes"})


def other_choices(book):
    fill(book, "Objects/{}/ID", "O1", "O2", "O3")
    fill(book, "Objects/{}/Kind", "chimney", "Fixed object ", "edge with parapet")
    put(book, {"Site/Rule set": "ASCE 7-10", "Site/Risk category": "II"})


def inserted_row(book):
    fill(book, "Objects/{}/ID", "A", "B")
    fill(book, "Objects/{}/Kind", "fixed object", "fixed object")
    fill(book, "Objects/{}/Height", 40, 40)
    put(book, {"Objects/2/Status": None})


def pasted_column(book):
    fill(book, "Motions/{}/ID", "M1", "M2")
    fill(book, "Motions/{}/Horizontal record", "Records!East", "records/m2.csv")


def mistyped_names(book):
    """The rules are computed in columns of their own."""
    fill(book, "Arrays/{}/ID", "A1", "A2", "A1 ")
    compute(book, ("Arrays/{}/ID", RED))
    fill(book, "Clearances/{}/Array", "A2", "A2", "A9")
    fill(book, "Clearances/{}/Object", "A1", "RTU1", "A1")
    compute(book, ("Clearances/{}/Array", RED), ("Clearances/{}/Object", RED))


def typed_over(book):
    """The rules of these cells are computed in columns of their own."""
    fill(book, "Arrays/{}/ID", "A1", "A2", "A3")
    compute(book, ("Arrays/{}/Slope in degrees", VIOLET))
    fill(book, "Arrays/{}/Slope in degrees", 3.5, None)
    put(book, {"Site/S_DS/Computed": 1.5})
    for name in SITE_COMPUTED:
        found = cell(book, name)
        beside = found.parent.cell(found.row, BESIDE)
        beside.value = "=" + rule_of(found.parent, found.coordinate, VIOLET)


def fill(book, name, *values):
    """Give the cells of that name, in the first rows of a table, their values."""
    put(book, {name.format(row): value for row, value in enumerate(values, start=1)})


BESIDE = 52
"""A column beside every table; the next ones are free as well."""

SITE_COMPUTED = ("Site/S_DS/Computed", "Site/Seismic design category/Computed")


def compute(book, *rules):
    """Compute rules of cells, named for any row and given by color, in three rows of a table."""
    for column, (name, color) in enumerate(rules, start=BESIDE):
        first = cell(book, name.format(1))
        rule = rule_of(first.parent, first.coordinate, color)
        for row in (first.row, first.row + 1, first.row + 2):
            of_row = re.sub(rf"(?<=[A-Z]){first.row}\b", str(row), rule)
            first.parent.cell(row, column).value = f"={of_row}"


def rule_of(sheet, coordinate, color):
    """Return the formula of the last conditional format that starts at a cell, by its fill."""
    return [
        rule.formula[0]
        for area in sheet.conditional_formatting
        if str(area.sqref).split(":")[0] == coordinate
        for rule in area.rules
        if rule.dxf.fill and rule.dxf.fill.start_color.rgb == f"00{color}"
    ][-1]


# Together where no change touches what another is asked about: a book takes a second.
BOOKS = (
    (half_filled,),
    (other_choices, pasted_column, mistyped_names),
    (inserted_row, typed_over),
    (),  # blank
)


@pytest.fixture(scope="module")
def computed(tmp_path_factory):
    """The sheets of blank workbooks by the change, as LibreOffice computes them at once."""
    folder = tmp_path_factory.mktemp("computed")
    paths = []
    for number, changes in enumerate(BOOKS):
        path = blank(folder / f"{number}.xlsx", UnitsFirst.US if changes else UnitsFirst.SI)
        if changes:
            edit(path, lambda book, all_=changes: [change(book) for change in all_])
        paths.append(path)
    books = recalculated_sheets(paths, folder)
    return {
        change: book
        for changes, book in zip(BOOKS, books, strict=True)
        for change in changes or [None]
    }


def value(book, name, column=None):
    """The value of a cell of a computed book, or of another column of its row."""
    sheet, place = at(name).split("!")
    row, own = coordinate_to_tuple(place)
    return book[sheet][row - 1][(column or own) - 1]


def state(book, title):
    """What a sheet says below its title."""
    return book[title][2][0]


def statuses(book, title, rows=3):
    return [value(book, f"{title}/{row}/Status") for row in range(1, rows + 1)]


def holds(book, name, column=BESIDE):
    """Whether the rule of a cell holds that is computed in a column of its row."""
    found = value(book, name, column)
    assert found in ("TRUE", "FALSE", 1.0, 0.0), found
    return found in ("TRUE", 1.0)


@pytest.mark.nightly
def test_a_half_filled_sheet_counts_what_is_missing(computed):
    book = computed[half_filled]
    wanted = {
        "Project": "4 cells missing",  # number, prepared by, date, revision
        "Arrays": "8 cells missing",  # weight, CG, spacing, four sides, downslope
        "Objects": "4 cells missing",
        "Motions": "1 cell missing",  # the PPA
        "Options": "4 cells missing",  # of the peer review
        "Clearances": "No cells missing",
        "Links": "No cells missing",
    }
    assert {title: state(book, title) for title in wanted} == wanted
    first, second = statuses(book, "Arrays", 2)
    assert first == 8
    assert second in (None, "")
    assert statuses(book, "Objects", 2) == [1, 3]  # height; three sides


@pytest.mark.nightly
def test_a_choice_that_is_none_of_the_list_is_no_complete_row(computed):
    book = computed[other_choices]
    # One wrong; capitals and blanks do not matter; no height.
    assert statuses(book, "Objects") == [-WRONG, 0, 1]
    assert state(book, "Objects") == "2 cells missing or wrong"
    assert state(book, "Site") == "7 cells missing or wrong"
    assert state(book, "Project") == "5 cells missing"


@pytest.mark.nightly
def test_an_inserted_row_without_formulas_counts_as_wrong(computed):
    assert state(computed[inserted_row], "Objects") == "1 cell missing or wrong"


@pytest.mark.nightly
def test_a_pasted_column_needs_its_units_and_time_step(computed):
    assert statuses(computed[pasted_column], "Motions", 2) == [2, 0]


@pytest.mark.nightly
def test_a_name_given_twice_and_one_that_is_unknown_turn_red(computed):
    book = computed[mistyped_names]
    rows = (1, 2, 3)
    assert [holds(book, f"Arrays/{row}/ID") for row in rows] == [True, False, True]
    found = [[holds(book, f"Clearances/{r}/Array", BESIDE + k) for k in (0, 1)] for r in rows]
    assert found == [[False, False], [False, True], [True, False]]


@pytest.mark.nightly
def test_a_computed_cell_that_was_typed_over_turns_violet(computed):
    book = computed[typed_over]
    # Typed over, blank, as it should be.
    assert [holds(book, f"Arrays/{row}/ID") for row in (1, 2, 3)] == [True, True, False]
    assert [holds(book, name) for name in SITE_COMPUTED] == [True, False]


@pytest.mark.nightly
def test_a_blank_sheet_asks_for_arrays_and_motions(computed):
    book = computed[None]
    for title in ("Arrays", "Motions"):
        assert state(book, title) == "Fill in at least one row"
    assert state(book, "Site") == "8 cells missing"  # seven, and a value for S_DS


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
    assert [s.title for s in book if s.page_setup.fitToWidth == 2] == ["Arrays"]
    assert book["Arrays"].print_title_cols == "$A:$B"
    start = [text for text in printed if "Roofslip input workbook" in text]
    assert len(start) == 1
    assert "Macros are not" in start[0]  # the last note
    arrays = [text for text in printed if "One row for each array that" in text]
    assert len(arrays) == 2
    assert all("Status" in text and "ID" in text for text in arrays)


@pytest.mark.nightly
def test_the_count_of_missing_cells_fits_its_column_in_print(printed):
    text = "".join(printed)
    assert "12 missing" in text
    assert "###" not in text


def test_nothing_is_read_from_the_answers(tmp_path):
    answers = {
        "Site/S_DS/Computed": 99.0,
        "Arrays/A1/Status": 7,
        "Arrays/A1/Slope in degrees": "oops",
        "Arrays/A2/Weight per area": -1,
        "Clearances/1/Neighbor": "like array",
        "Clearances/2/D/C, prescriptive": 0.01,
    }
    path = make(tmp_path)
    before = read(path)
    after = read(type_into(path, answers))
    assert same(after.project, before.project)
    assert after.echo == before.echo


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
