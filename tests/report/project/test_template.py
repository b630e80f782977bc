"""The input template: names, tables, help, formulas, marks, and what Excel 2016 asks of it."""

import re

import defusedxml.ElementTree
import pytest
from openpyxl import load_workbook
from openpyxl.utils import get_column_letter, range_boundaries
from pypdf import PdfReader

from fixtures import workbooks
from fixtures.cells import address, cell
from fixtures.libreoffice import converted
from fixtures.marks import by_day
from fixtures.workbooks import arrays, blank, formula_cells, make, project, type_into
from projects.example.make import project as example
from report.drawing.paper_items import TYPE_PT, width_in
from report.project.model.choices import UnitsFirst
from report.project.model.overrides import provision_name
from report.project.read.read import read
from report.project.workbook import SECTIONS
from report.project.write.template import write_template
from solver.rules.rulesets import ALLOWED

SHEETS = [
    "Start", "Project", "Site", "Building", "Arrays", "Friction tests", "Objects", "Clearances",
    "Motions", "Spectrum", "Links", "Options", "Outlines", "Layers", "Acknowledged",
]  # fmt: skip
RARE = {"Spectrum", "Links", "Outlines", "Layers", "Acknowledged"}


@pytest.fixture(scope="module", params=by_day(list(UnitsFirst), 1))
def fresh(request, tmp_path_factory):
    path = tmp_path_factory.mktemp("blank") / "input.xlsx"
    write_template(path, units=request.param)
    return load_workbook(path)


@pytest.fixture
def is_us(fresh):
    return cell(fresh, "Site/Structure height h/Unit").value == "ft"


def tables(book):
    return {t.name: (s, t) for s in book.worksheets for t in s.tables.values()}


def validations(sheet):
    return list(sheet.data_validations.dataValidation)


def validation(book, name):
    sheet, place = address(book, name).split("!")
    return next(rule for rule in validations(book[sheet]) if place in rule.sqref)


def test_sheets_names_and_tables_are_complete(fresh):
    assert fresh.sheetnames == [*SHEETS, "Provisions", "Tables"]
    names, blocks = fresh.defined_names, [part for part in SECTIONS if not part.is_table]
    for section, entry in ((part, entry) for part in blocks for entry in part.entries):
        assert section.cell_name(entry.name) in names
        assert (section.unit_name(entry.name) in names) == (entry.quantity is not None)
    names = tables(fresh)
    for section in SECTIONS:
        if section.is_table:
            sheet, table = names[section.table_name]
            left, top, right, bottom = range_boundaries(table.ref)
            assert bottom - top == (20 if top == 7 else 6)
            cells = [c for row in sheet.iter_rows(top + 1, bottom, left, right) for c in row]
            assert all(c.value is None or c.data_type == "f" for c in cells)
    for sheet, table in tables(fresh).values():
        headings = [head.value for head in sheet[table.ref][0]]
        assert headings == [column.name for column in table.tableColumns]
        assert table.autoFilter is None


def test_headings_defaults_and_paper_are_those_of_the_system(fresh, is_us):
    sheet, table = tables(fresh)["arrays_table"]
    headings = [head.value for head in sheet[table.ref][0]]
    weight, size, plan = ("lb", "in", "ft") if is_us else ("kN", "mm", "m")
    assert {f"Weight [{weight}]", f"CG height [{size}]", f"x from [{plan}]"} <= {*headings}
    sheet, table = tables(fresh)["links_table"]
    unit, example = ("lb/in", "5000") if is_us else ("kN/m", "876")
    heads = sheet[table.ref][0]
    examples = {head.value: str(head.offset(row=-1).value) for head in heads}
    wanted = {"Array": "A1", "Block friction": "0.40, 0.45, 0.50"}
    wanted |= {f"Link stiffness [{unit}]": example, "Link damping": "0.02"}
    assert list(examples.items()) == list(wanted.items())
    assert validation(fresh, "Links/1/Array").formula1 == "array_names"
    assert cell(fresh, "Project/Primary units").value == ("US" if is_us else "SI")
    assert cell(fresh, "Options/Design value statistic").value == "per rule set"
    assert cell(fresh, "Options/Peer review").value == "No"
    labels = ("Rule set", "Seismic design category")
    first, last = (cell(fresh, f"Site/{label}").row for label in labels)
    assert all(fresh["Site"].cell(row, 2).value is None for row in range(first, last + 1))
    wide, tall = (279.4, 215.9) if is_us else (297.0, 210.0)  # mm, landscape
    for sheet in fresh.worksheets:
        margins = sheet.page_margins
        assert sheet.page_setup.paperSize == (1 if is_us else 9)
        assert wide - 25.4 * (margins.left + margins.right) == pytest.approx(259.0, abs=0.3)
        assert tall - 25.4 * (margins.top + margins.bottom) == pytest.approx(190.6, abs=0.3)


def test_inputs_are_yellow_until_filled_and_formulas_blue(fresh):
    for name, color in (("Site/Rule set", "00FFF6CC"), ("Site/S_DS/Computed", "00E3EDF5")):
        assert cell(fresh, name).fill.start_color.rgb == color
    formulas = formula_cells(fresh)
    assert {c.fill.start_color.rgb for c in formulas} == {"00E3EDF5"}
    for name in ("Site/Rule set", "Site/Fire pathway width/Unit", "Arrays/1/ID", "Arrays/20/Slope"):
        at = cell(fresh, name)
        areas = [a for a in at.parent.conditional_formatting if at.coordinate in a.sqref]
        ((first, rule),) = [(str(a.sqref).split(":")[0], a.rules[0]) for a in areas]
        assert rule.formula == [f"NOT(ISBLANK({first}))"]
        assert rule.dxf.fill.start_color.rgb == "00FFFFFF"


def test_start_says_the_steps_and_links_every_sheet(fresh):
    sheet = fresh["Start"]
    text = "\n".join(str(value) for row in sheet.values for value in row if value is not None)
    for part in ("roofslip check FOLDER", "roofslip report FOLDER", "records", "Colors"):
        assert part in text
    assert "Run roofslip check FOLDER to list missing and incorrect entries" in text
    links = {c.value for row in sheet for c in row if c.hyperlink}
    assert {link.removesuffix(" (seldom used)") for link in links} == {*SHEETS[1:]}
    assert {link.partition(" (")[0] for link in links if "seldom" in link} == RARE
    tops = [fresh.defined_names[c.hyperlink.location] for row in sheet for c in row if c.hyperlink]
    assert {top.attr_text.partition("!")[2] for top in tops} == {"$A$1"}
    assert [row[0] for row in sheet.values if str(row[0]).isdecimal()] == list("123456")
    (picture,) = sheet._images
    assert picture._data()[:4] == b"\x89PNG"


def test_validations_offer_choices_and_ranges(fresh):
    rule = validation(fresh, "Arrays/1/Slope unit")
    assert rule.formula1 == '"degrees,percent,in/12"'
    assert rule.prompt
    assert (rule.showInputMessage, rule.showErrorMessage) == (True, True)
    rule = validation(fresh, "Arrays/1/Friction coefficient")
    assert (rule.type, rule.operator) == ("decimal", "between")
    assert (rule.formula1, rule.formula2) == ("0", "1.5")
    assert "0 to 1.5" in rule.prompt
    of_object = validation(fresh, "Clearances/1/Object")
    assert validation(fresh, "Clearances/1/Array").formula1 == "array_names"
    assert (of_object.formula1, of_object.showErrorMessage) == ("object_names", False)
    assert validation(fresh, "Options/1/Provision").formula1 == "rule_names"
    cells = fresh.defined_names["rule_names"].attr_text.partition("!")[2].replace("$", "")
    names = [row[0].value for row in fresh["Provisions"][cells]]
    assert names == [provision_name(key) for key in ALLOWED]


def test_no_cell_has_two_validations_and_all_fits_excel(fresh):
    for sheet in fresh.worksheets:
        areas = [area for rule in validations(sheet) for area in rule.sqref.ranges]
        for i, area in enumerate(areas):
            assert all(area.isdisjoint(other) for other in areas[i + 1 :])
        for rule in validations(sheet):
            assert len(rule.promptTitle) <= 32
            assert len(rule.prompt) <= 255
            assert len(rule.errorTitle) < len(rule.error) <= 225
            assert rule.error != rule.prompt
            assert all(len(text or "") <= 255 for text in (rule.formula1, rule.formula2))
    texts = [str(c.value) for c in formula_cells(fresh)]
    texts += [name.attr_text for name in fresh.defined_names.values()]
    assert max(map(len, texts)) <= 8192


def test_headings_are_frozen_and_rare_sheets_hidden(fresh, tmp_path):
    assert all(fresh[name].freeze_panes for name in SHEETS[1:])
    setups = [sheet.page_setup for sheet in fresh.worksheets]
    assert {(setup.orientation, setup.scale) for setup in setups} == {("landscape", 55)}
    # Another zoom would follow from these.
    assert {fit for setup in setups for fit in (setup.fitToWidth, setup.fitToHeight)} == {None}
    hidden = {sheet.title for sheet in fresh.worksheets if sheet.sheet_state == "hidden"}
    assert hidden == RARE | {"Tables"}
    rows = [{"period_s": t, "horizontal_g": 1.0} for t in (0.1, 1.0)]
    path = make(tmp_path, spectrum=rows)
    assert load_workbook(path)["Spectrum"].sheet_state == "visible"


def test_a_filled_workbook_shows_hidden_sheets_grows_tables_and_keeps_texts(tmp_path):
    path = type_into(make(tmp_path), {"Layers/1/Layer": "PV", "Layers/1/Content": "array"})
    states = {sheet.title: sheet.sheet_state for sheet in load_workbook(path).worksheets}
    assert (states["Layers"], states["Outlines"]) == ("visible", "hidden")
    assert read(path).unseen == ()
    rows = [arrays(id=f"A{i}")[0] for i in range(40)]
    book = load_workbook(make(tmp_path, arrays=rows, clearances=[]))
    _, first, _, last = range_boundaries(book["Arrays"].tables["arrays_table"].ref)
    assert last - first == 45
    data = project().project.model_dump() | {"name": "=1+1", "client": "#N/A"}
    name = cell(load_workbook(make(tmp_path, project=data)), "Project/Project name")
    assert (name.value, name.data_type) == ("=1+1", "s")


@pytest.mark.quick
def test_values_are_written_in_the_units_of_the_sheets_without_rounding_error(tmp_path):
    us, si = (load_workbook(make(tmp_path / str(units), units)) for units in UnitsFirst)
    for heading, in_us, in_si in (("CG height", 9, 228.6), ("Support spacing", 40, 1016),
                                  ("x from", 20, 6.096), ("x to", 100, 30.48)):  # fmt: skip
        name = f"Arrays/A1/{heading}"
        assert (cell(us, name).value, cell(si, name).value) == (in_us, in_si)
    assert cell(us, "Arrays/A1/Weight").value == 42000


MAIN = "{http://schemas.openxmlformats.org/spreadsheetml/2006/main}"
# Of Excel 2007 and later.
FUNCTIONS = {
    "AND", "ATAN", "COUNT", "COUNTA", "COUNTIF", "DEGREES", "FORECAST", "IF", "IFERROR", "INDEX",
    "ISBLANK", "LEFT", "LOOKUP", "MATCH", "MAX", "MOD", "N", "NOT", "OFFSET", "OR", "ROUND",
    "ROUNDUP", "SUMPRODUCT", "TRIM", "UPPER", "VLOOKUP",
}  # fmt: skip


@pytest.fixture(scope="module", params=by_day(["blank", "filled"], 1))
def parts(request, tmp_path_factory):
    folder = tmp_path_factory.mktemp("parts")
    path = make(folder) if request.param == "filled" else blank(folder / "input.xlsx")
    return workbooks.parts(path)


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
    assert len(columns) == 6
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
@pytest.mark.parametrize("units", UnitsFirst)
def test_the_example_prints_on_thirteen_sheets(tmp_path, units):
    path = tmp_path / "input.xlsx"
    write_template(path, units=units, example=example())
    (file,) = converted([path], tmp_path, "pdf")
    # Site takes two, with the place of the project and the loads of an existing building.
    assert len(PdfReader(file).pages) <= 13


@pytest.mark.nightly
def test_rare_columns_are_folded_until_one_is_filled(tmp_path):
    empty = load_workbook(blank(tmp_path / "blank.xlsx"))
    rare = column(empty, "High-velocity friction")
    assert (rare.outlineLevel, rare.hidden) == (1, True)
    assert column(empty, "Weight").outlineLevel == 0
    filled = load_workbook(make(tmp_path, arrays=workbooks.arrays(i_p=1.25)))
    assert not column(filled, "Importance factor I_p").hidden
    assert column(filled, "Array type").hidden


def column(book, heading):
    letter = cell(book, f"Arrays/heading/{heading}").column_letter
    return book["Arrays"].column_dimensions[letter]


# Excel with Calibri 11: 7 px a unit of width and 5 px beside it, at 96 px an inch; 3 px an indent
# of each step; lines of 1.22 times the size. Source Sans is 2 to 3 % wider than Calibri.
UNIT_IN, BESIDE_IN, INDENT_IN, LINE = 7 / 96, 5 / 96, 9 / 96, 1.22
DEFAULT_ROW_PT, DEFAULT_WIDTH = 15.0, 8.43


@pytest.fixture(scope="module", params=by_day(["US", "SI", "example"], 1))
def book(request, tmp_path_factory):
    path = tmp_path_factory.mktemp("whole") / "input.xlsx"
    is_example = request.param == "example"
    units = UnitsFirst.US if is_example else UnitsFirst(request.param)
    write_template(path, units=units, example=example() if is_example else None)
    return load_workbook(path)


def wide_in(sheet, column):
    """The width of a column; of merged cells it is that of all of them."""
    dimension = sheet.column_dimensions.get(get_column_letter(column))
    return (dimension.width if dimension else DEFAULT_WIDTH) * UNIT_IN


def size_in(found, text):
    return width_in(text, is_bold=bool(found.font.b)) * found.font.sz / TYPE_PT


def n_lines(found, wide):
    """How many lines a cell breaks its text into, between words and after hyphens and slashes."""
    if size_in(found, found.value) <= wide:
        return 1
    count, line = 1, ""
    for word in found.value.split(" "):
        tried = f"{line} {word}".strip()
        if line and size_in(found, tried) > wide:
            count, tried = count + 1, word
        line = tried
    return count


def lost(book):
    """Cells whose text is cut: taller than the row, wider than the column, or over a neighbor."""
    for sheet in book:
        merged = {area.coord.split(":")[0]: area for area in sheet.merged_cells.ranges}
        for found in (found for row in sheet for found in row if isinstance(found.value, str)):
            is_hidden = sheet.column_dimensions[found.column_letter].hidden
            if found.data_type == "f" or is_hidden:
                continue
            area = merged.get(found.coordinate)
            columns = range(area.min_col, area.max_col + 1) if area else [found.column]
            wide = sum(wide_in(sheet, c) for c in columns) - BESIDE_IN
            wide -= INDENT_IN * found.alignment.indent
            if found.alignment.wrap_text:
                tall = n_lines(found, wide) * LINE * found.font.sz
                widest = max(size_in(found, word) for word in found.value.split())
                if tall > (sheet.row_dimensions[found.row].height or DEFAULT_ROW_PT) + 0.5:
                    yield f"{sheet.title}!{found.coordinate} is too tall: {found.value}"
                elif widest > wide:
                    yield f"{sheet.title}!{found.coordinate} has a word too wide: {found.value}"
                continue
            beside, at = found.column + 1, wide
            while at < size_in(found, found.value):
                if sheet.cell(found.row, beside).value is not None:
                    yield f"{sheet.title}!{found.coordinate} runs into its neighbor: {found.value}"
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
