"""What Excel 2016 asks of the written workbook, looked up in its parts."""

import re
from zipfile import ZipFile

import defusedxml.ElementTree
import pytest
from openpyxl import load_workbook
from openpyxl.utils.cell import coordinate_to_tuple
from pypdf import PdfReader
from recalculated import converted, recalculated_sheets

from report.sheet.fields import Place
from report.sheet.marks import AMBER, VIOLET
from report.sheet.read import read
from report.sheet.schema import UnitsFirst
from sheets import blank, edit, make, project, same, type_into

MAIN = "{http://schemas.openxmlformats.org/spreadsheetml/2006/main}"
# Of Excel 2007 and later, and ISFORMULA of 2013, which is written with this prefix.
PREFIXED = {"_xlfn.ISFORMULA"}
FUNCTIONS = {
    "ABS", "AND", "ATAN", "CHAR", "CODE", "COUNT", "COUNTA", "COUNTIF", "DEGREES", "FALSE", "FIND",
    "IF", "IFERROR", "INDEX", "ISERROR", "ISFORMULA", "ISNUMBER", "LEFT", "LOWER", "MATCH", "MAX",
    "MID", "MIN", "MOD", "N", "NA", "NOT", "OFFSET", "OR", "RADIANS", "ROUNDUP", "ROW", "ROWS",
    "SUBSTITUTE", "SUM", "SUMIF", "SUMPRODUCT", "TRIM", "UPPER",
}  # fmt: skip


@pytest.fixture(scope="module", params=["blank", "filled"])
def parts(request, tmp_path_factory):
    folder = tmp_path_factory.mktemp("parts")
    path = make(folder) if request.param == "filled" else blank(folder / "input.xlsx")
    with ZipFile(path) as archive:
        return {name: archive.read(name) for name in archive.namelist()}


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
    used = {
        name for text in formulas(parts) for name in re.findall(r"([A-Z]+)\(", outside_quotes(text))
    }
    assert used <= FUNCTIONS
    prefixed = {name for text in formulas(parts) for name in re.findall(r"_xlfn\.\w+", text)}
    assert prefixed <= PREFIXED
    assert not any(re.search(r"(?<!_xlfn\.)ISFORMULA", text) for text in formulas(parts))


def test_no_sheet_is_protected_and_nothing_refers_to_another_file(parts):
    assert list(elements(parts, "sheetProtection")) == []
    assert not any("externalLink" in name for name in parts)
    assert not any(re.search(r"\[\d+\]", outside_quotes(text)) for text in formulas(parts))


def test_texts_of_validations_and_formats_are_short_enough(parts):
    for item in elements(parts, "dataValidation"):
        assert len(item.get("promptTitle")) <= 32
        assert len(item.get("prompt")) < 256
        assert len(item.get("error")) < 226
        for text in (child.text for child in item):
            assert len(text) < 256
    for rule in elements(parts, "cfRule"):
        for formula in rule:
            assert len(formula.text) < 256


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
        for name in re.findall(r"\b(?:live|rule|unit|lacks|sdc)_\w+", outside_quotes(text))
    }
    assert used <= names


def half_filled(book):
    """What a person has typed: a project without date, an array without weight, odd values."""
    book["Project"]["B5"] = "Depot"
    arrays = book["Arrays"]
    for cell, value in {"B8": "A1", "C8": 2.0, "D8": "degrees", "E8": 0.9, "G8": "Tray"}.items():
        arrays[cell] = value
    arrays["B9"] = " "
    objects = book["Objects"]
    objects["B8"], objects["C8"] = "NORTH", "edge with parapet"
    objects["B9"], objects["C9"], objects["E9"] = "RTU-1", "fixed object", 5
    motions = book["Motions"]
    motions["B8"], motions["C8"], motions["H8"] = "M1", "records/x.csv", "PPA"
    book["Options"]["B6"] = "Yes"


def other_choices(book):
    objects, site = book["Objects"], book["Site"]
    for row, kind in ((8, "chimney"), (9, "Fixed object "), (10, "edge with parapet")):
        objects[f"B{row}"], objects[f"C{row}"] = f"O{row}", kind
    site["B5"], site["B6"] = "ASCE 7-10", "II"


def inserted_row(book):
    for row, name in ((8, "A"), (9, "B")):
        for letter, value in zip("BCD", (name, "fixed object", 40), strict=True):
            book["Objects"][f"{letter}{row}"] = value
    book["Objects"]["A9"] = None


def pasted_column(book):
    book["Motions"]["B8"], book["Motions"]["C8"] = "M1", "Records!East"
    book["Motions"]["B9"], book["Motions"]["C9"] = "M2", "records/m2.csv"


def mistyped_names(book):
    """The rules are computed in cells of their own."""
    arrays, clearances = book["Arrays"], book["Clearances"]
    for row, name in ((8, "A1"), (9, "A2"), (10, "A1 ")):
        arrays[f"B{row}"] = name
        twice = rule_of(arrays, "B8", AMBER)
        arrays[f"AZ{row}"] = "=" + re.sub(r"\$B8\b", f"$B{row}", twice)
    for row, (array, other) in enumerate((("A2", "A1"), ("A2", "RTU1"), ("A9", "A1")), start=8):
        clearances[f"B{row}"], clearances[f"C{row}"] = array, other
        for cell, of in (("AY", "B"), ("AZ", "C")):
            unknown = rule_of(clearances, f"{of}8", AMBER)
            clearances[f"{cell}{row}"] = "=" + unknown.replace("8", str(row))


def typed_over(book):
    """The rules of three cells are computed in cells of their own."""
    arrays, site = book["Arrays"], book["Site"]
    typed = rule_of(arrays, "R8", VIOLET)
    for row, name in ((8, "A1"), (9, "A2"), (10, "A3")):
        arrays[f"B{row}"] = name
        arrays[f"AZ{row}"] = "=" + typed.replace("8", str(row))
    arrays["R8"], arrays["R9"] = 3.5, None
    site["D13"] = 1.5
    for cell, of in (("H13", "D13"), ("H14", "D14")):
        site[cell] = "=" + rule_of(site, of, VIOLET)


def rule_of(sheet, cell, color):
    """Return the formula of the conditional format whose range starts at a cell, by its fill."""
    return next(
        rule.formula[0]
        for area in sheet.conditional_formatting
        if str(area.sqref).split(":")[0] == cell
        for rule in area.rules
        if rule.dxf.fill and rule.dxf.fill.start_color.rgb == f"00{color}"
    )


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


def at(sheet, cell):
    """The value of a cell of a computed sheet."""
    row, column = coordinate_to_tuple(cell)
    return sheet[row - 1][column - 1]


def holds(sheet, cell):
    """Whether the rule that is computed in a cell holds."""
    value = at(sheet, cell)
    assert value in ("TRUE", "FALSE", 1.0, 0.0), value
    return value in ("TRUE", 1.0)


@pytest.mark.nightly
def test_a_half_filled_sheet_counts_what_is_missing(computed):
    book = computed[half_filled]
    said = {title: at(sheet, "A3") for title, sheet in book.items()}
    assert said["Project"] == "4 cells missing"  # number, prepared by, date, revision
    assert said["Arrays"] == "8 cells missing"  # weight, CG, spacing, four sides, downslope
    assert at(book["Arrays"], "A8") == 8
    assert at(book["Arrays"], "A9") in (None, "")
    assert [at(book["Objects"], f"A{row}") for row in (8, 9)] == [1, 3]  # height; three sides
    assert said["Objects"] == "4 cells missing"
    assert said["Motions"] == "1 cell missing"  # the PPA
    assert said["Options"] == "3 cells missing"  # of the peer review
    assert said["Clearances"] == said["Links"] == "No cells missing"


@pytest.mark.nightly
def test_a_choice_that_is_none_of_the_list_is_no_complete_row(computed):
    book = computed[other_choices]
    status = [at(book["Objects"], f"A{row}") for row in (8, 9, 10)]
    assert status == [-1, 0, 1]  # one wrong; capitals and blanks do not matter; no height
    assert at(book["Objects"], "A3") == "2 cells missing or wrong"
    assert at(book["Site"], "A3") == "7 cells missing or wrong"
    assert at(book["Project"], "A3") == "5 cells missing"


@pytest.mark.nightly
def test_an_inserted_row_without_formulas_counts_as_wrong(computed):
    assert at(computed[inserted_row]["Objects"], "A3") == "1 cell missing or wrong"


@pytest.mark.nightly
def test_a_pasted_column_needs_its_units_and_time_step(computed):
    motions = computed[pasted_column]["Motions"]
    assert [at(motions, f"A{row}") for row in (8, 9)] == [2, 0]


@pytest.mark.nightly
def test_a_name_given_twice_and_one_that_is_unknown_turn_amber(computed):
    book = computed[mistyped_names]
    found = [holds(book["Arrays"], f"AZ{row}") for row in (8, 9, 10)]
    assert found == [True, False, True]
    found = [[holds(book["Clearances"], f"{c}{r}") for c in ("AY", "AZ")] for r in (8, 9, 10)]
    assert found == [[False, False], [False, True], [True, False]]


@pytest.mark.nightly
def test_a_computed_cell_that_was_typed_over_turns_violet(computed):
    book = computed[typed_over]
    found = [holds(book["Arrays"], f"AZ{row}") for row in (8, 9, 10)]
    assert found == [True, True, False]  # typed over, blank, as it should be
    assert [holds(book["Site"], cell) for cell in ("H13", "H14")] == [True, False]


@pytest.mark.nightly
def test_a_blank_sheet_asks_for_arrays_and_motions(computed):
    book = computed[None]
    for title in ("Arrays", "Motions"):
        assert at(book[title], "A3") == "Fill in at least one row"
    assert at(book["Site"], "A3") == "8 cells missing"  # seven, and a value for S_DS


@pytest.fixture(scope="module")
def printed(tmp_path_factory):
    """The text of each page of a workbook whose only row is an array's name, as printed."""
    folder = tmp_path_factory.mktemp("printed")
    path = type_into(blank(folder / "input.xlsx"), {"Arrays!B8": "A1"})
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
        "Site!D13": 99.0, "Arrays!A8": 7, "Arrays!R8": "oops", "Arrays!S9": -1,
        "Clearances!F8": "like array", "Clearances!I9": 0.01,
    }  # fmt: skip
    path = make(tmp_path)
    before = read(path)
    after = read(type_into(path, answers))
    assert same(after.project, before.project)
    assert after.echo == before.echo


def test_a_row_that_has_formulas_only_is_blank(tmp_path):
    sheet = read(make(tmp_path))
    assert len(sheet.project.arrays) == 2
    assert Place("arrays", 2, "id") not in sheet.addresses


def test_a_second_reading_and_writing_keeps_formulas_marks_and_names(tmp_path):
    path = make(tmp_path)
    before = load_workbook(path)
    before.save(tmp_path / "again.xlsx")
    after = load_workbook(tmp_path / "again.xlsx")
    assert set(after.defined_names) == set(before.defined_names)
    assert after["Arrays"]["A8"].value == before["Arrays"]["A8"].value
    for name in ("Arrays", "Site"):
        assert len(after[name].conditional_formatting) == len(before[name].conditional_formatting)
    assert len(after["Start"]._images) == 1


def test_rare_columns_are_folded_until_one_is_filled(tmp_path):
    sheet = load_workbook(blank(tmp_path / "blank.xlsx"))["Arrays"]
    letters = {c.value: c.column_letter for c in sheet[7]}
    rare = sheet.column_dimensions[letters["High-velocity friction"]]
    assert (rare.outlineLevel, rare.hidden) == (1, True)
    assert sheet.column_dimensions[letters["Weight [lb]"]].outlineLevel == 0
    arrays = [row.model_dump() | {"i_p": 1.25} for row in project().arrays]
    filled = load_workbook(make(tmp_path, arrays=arrays))["Arrays"]
    assert not filled.column_dimensions[letters["Importance factor I_p"]].hidden
    assert filled.column_dimensions[letters["Kind of array"]].hidden
