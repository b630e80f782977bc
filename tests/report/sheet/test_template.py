"""The input template: names, tables, help, formulas, marks, essential formatting."""

import pytest
from openpyxl import load_workbook
from openpyxl.utils import range_boundaries

from cells import address, cell
from report.sheet.reading.read import read
from report.sheet.schema import SECTIONS, provision_name
from report.sheet.schema.choices import UnitsFirst
from report.sheet.schema.fields import entries
from report.sheet.writing.template import write_template
from sheets import arrays, formula_cells, make, project, type_into
from solver.rules.provisions import OVERRIDABLE

SHEETS = [
    "Start", "Project", "Site", "Building", "Arrays", "Friction tests", "Objects", "Clearances",
    "Motions", "Spectrum", "Links", "Options", "Outlines", "Layers", "Acknowledged",
]  # fmt: skip
RARE = {"Spectrum", "Links", "Outlines", "Layers", "Acknowledged"}


@pytest.fixture(scope="module", params=list(UnitsFirst))
def blank(request, tmp_path_factory):
    path = tmp_path_factory.mktemp("blank") / "input.xlsx"
    write_template(path, units=request.param)
    return load_workbook(path)


@pytest.fixture
def is_us(blank):
    return cell(blank, "Site/Structure height h/Unit").value == "ft"


def tables(book):
    return {t.name: (s, t) for s in book.worksheets for t in s.tables.values()}


def validations(sheet):
    return list(sheet.data_validations.dataValidation)


def validation(book, name):
    sheet, place = address(book, name).split("!")
    return next(rule for rule in validations(book[sheet]) if place in rule.sqref)


def test_sheets_names_and_tables_are_complete(blank):
    assert blank.sheetnames == [*SHEETS, "Provisions", "Tables"]
    names, blocks = blank.defined_names, [part for part in SECTIONS if not part.is_table]
    for section, entry in ((part, entry) for part in blocks for entry in entries(part.model)):
        assert section.cell_name(entry.name) in names
        assert (section.unit_name(entry.name) in names) == (entry.quantity is not None)
    names = tables(blank)
    for section in SECTIONS:
        if section.is_table:
            sheet, table = names[section.table_name]
            left, top, right, bottom = range_boundaries(table.ref)
            assert bottom - top == (20 if top == 7 else 6)
            cells = [c for row in sheet.iter_rows(top + 1, bottom, left, right) for c in row]
            assert all(c.value is None or c.data_type == "f" for c in cells)
    for sheet, table in tables(blank).values():
        headings = [head.value for head in sheet[table.ref][0]]
        assert headings == [column.name for column in table.tableColumns]
        assert table.autoFilter is None


def test_headings_defaults_and_paper_are_those_of_the_system(blank, is_us):
    sheet, table = tables(blank)["arrays_table"]
    headings = [head.value for head in sheet[table.ref][0]]
    weight, size, plan = ("lb", "in", "ft") if is_us else ("kN", "mm", "m")
    assert {f"Weight [{weight}]", f"CG height [{size}]", f"x from [{plan}]"} <= {*headings}
    sheet, table = tables(blank)["links_table"]
    unit, example = ("lb/in", "5000") if is_us else ("kN/m", "876")
    heads = sheet[table.ref][0]
    examples = {head.value: str(head.offset(row=-1).value) for head in heads}
    wanted = {"Array": "A1", "Block friction": "0.40, 0.45, 0.50"}
    wanted |= {f"Link stiffness [{unit}]": example, "Link damping": "0.02"}
    assert list(examples.items()) == list(wanted.items())
    assert validation(blank, "Links/1/Array").formula1 == "live_array_names"
    assert cell(blank, "Project/Primary units").value == ("US" if is_us else "SI")
    assert cell(blank, "Options/Design value statistic").value == "rule set"
    assert cell(blank, "Options/Peer review").value == "No"
    labels = ("Rule set", "Seismic design category")
    first, last = (cell(blank, f"Site/{label}").row for label in labels)
    assert all(blank["Site"].cell(row, 2).value is None for row in range(first, last + 1))
    wide, tall = (279.4, 215.9) if is_us else (297.0, 210.0)  # mm, landscape
    for sheet in blank.worksheets:
        margins = sheet.page_margins
        assert sheet.page_setup.paperSize == (1 if is_us else 9)
        assert wide - 25.4 * (margins.left + margins.right) == pytest.approx(259.0, abs=0.3)
        assert tall - 25.4 * (margins.top + margins.bottom) == pytest.approx(190.6, abs=0.3)


def test_inputs_are_yellow_until_filled_and_formulas_blue(blank):
    for name, color in (("Site/Rule set", "00FFF6CC"), ("Site/S_DS/Computed", "00E3EDF5")):
        assert cell(blank, name).fill.start_color.rgb == color
    formulas = formula_cells(blank)
    others = [c for c in formulas if c.fill.start_color.rgb != "00E3EDF5"]
    # The clauses of the panel.
    assert {(c.parent.title, c.column_letter) for c in others} == {("Start", "F")}
    assert len(others) < len(formulas) / 10
    for name in ("Site/Rule set", "Site/Fire lane width/Unit", "Arrays/1/ID", "Arrays/20/Slope"):
        at = cell(blank, name)
        areas = [a for a in at.parent.conditional_formatting if at.coordinate in a.sqref]
        ((first, rule),) = [(str(a.sqref).split(":")[0], a.rules[0]) for a in areas]
        assert rule.formula == [f"NOT(ISBLANK({first}))"]
        assert rule.dxf.fill.start_color.rgb == "00FFFFFF"


def test_start_and_the_hazard_cells_are_in_the_order_of_work(blank):
    first = cell(blank, "Site/Edition of ASCE 7").row
    labels = [str(blank["Site"].cell(row, 1).value) for row in range(first, first + 13)]
    assert [label.removesuffix(" *") for label in labels] == [
        "Edition of ASCE 7", "Risk category", "Site class", "S_S", "S_1", "F_a", "F_v", "S_MS",
        "S_M1", "S_DS", "S_D1", "Long-period transition T_L", "Importance factor I_e",
    ]  # fmt: skip
    sheet = blank["Start"]
    text = "\n".join(str(value) for row in sheet.values for value in row if value is not None)
    for part in ("roofslip check FOLDER", "roofslip report FOLDER", "records", "Colors"):
        assert part in text
    assert "Run roofslip check FOLDER, which finds what is missing or wrong" in text
    links = {c.value for row in sheet for c in row if c.hyperlink}
    assert {link.removesuffix(", rarely needed") for link in links} == {*SHEETS[1:]}
    assert {link.partition(",")[0] for link in links if "rarely" in link} == RARE
    tops = [blank.defined_names[c.hyperlink.location] for row in sheet for c in row if c.hyperlink]
    assert {top.attr_text.partition("!")[2] for top in tops} == {"$A$1"}
    assert [row[0] for row in sheet.values if str(row[0]).isdecimal()] == list("123456")
    (picture,) = sheet._images
    assert picture._data()[:4] == b"\x89PNG"


def test_validations_offer_choices_and_ranges(blank):
    rule = validation(blank, "Arrays/1/Slope unit")
    assert rule.formula1 == '"degrees,percent,in/12"'
    assert rule.prompt
    assert (rule.showInputMessage, rule.showErrorMessage) == (True, True)
    rule = validation(blank, "Arrays/1/Friction coefficient")
    assert (rule.type, rule.operator) == ("decimal", "between")
    assert (rule.formula1, rule.formula2) == ("0", "1.5")
    assert "0 to 1.5" in rule.prompt
    of_object = validation(blank, "Clearances/1/Object")
    assert validation(blank, "Clearances/1/Array").formula1 == "live_array_names"
    assert (of_object.formula1, of_object.showErrorMessage) == ("live_names", False)
    assert validation(blank, "Options/1/Provision").formula1 == "rule_names"
    cells = blank.defined_names["rule_names"].attr_text.partition("!")[2].replace("$", "")
    names = [row[0].value for row in blank["Provisions"][cells]]
    assert names == [provision_name(key) for key in OVERRIDABLE]


def test_no_cell_has_two_validations_and_all_fits_excel(blank):
    for sheet in blank.worksheets:
        areas = [area for rule in validations(sheet) for area in rule.sqref.ranges]
        for i, area in enumerate(areas):
            assert all(area.isdisjoint(other) for other in areas[i + 1 :])
    for sheet in blank.worksheets:
        for rule in validations(sheet):
            assert len(rule.promptTitle) <= 32
            assert len(rule.prompt) <= 255
            assert len(rule.errorTitle) < len(rule.error) <= 225
            assert rule.error != rule.prompt
            assert all(len(text or "") <= 255 for text in (rule.formula1, rule.formula2))
    texts = [str(c.value) for c in formula_cells(blank)]
    texts += [name.attr_text for name in blank.defined_names.values()]
    assert max(map(len, texts)) <= 8192


def test_headings_are_frozen_and_rare_sheets_hidden(blank, tmp_path):
    assert all(blank[name].freeze_panes for name in SHEETS[1:])
    setups = [sheet.page_setup for sheet in blank.worksheets]
    assert {(setup.orientation, setup.scale) for setup in setups} == {("landscape", 55)}
    # Another zoom would follow from these.
    assert {fit for setup in setups for fit in (setup.fitToWidth, setup.fitToHeight)} == {None}
    hidden = {sheet.title for sheet in blank.worksheets if sheet.sheet_state == "hidden"}
    assert hidden == RARE | {"Tables"}
    rows = [{"period_s": t, "horizontal_g": 1.0} for t in (0.1, 1.0)]
    path = make(tmp_path, spectrum=rows)
    assert load_workbook(path)["Spectrum"].sheet_state == "visible"


def test_a_filled_workbook_shows_hidden_sheets_grows_tables_and_keeps_texts(tmp_path):
    path = type_into(make(tmp_path), {"Layers/1/Layer": "PV", "Layers/1/Drawn on it": "array"})
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
