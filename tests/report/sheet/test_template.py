"""The input template: names, tables, help, formulas, marks, essential formatting."""

import pytest
from openpyxl import load_workbook
from openpyxl.utils import range_boundaries

from report.sheet.fields import entries
from report.sheet.schema import PROVISION_KEYS, SECTIONS, UnitsFirst, provision_name
from report.sheet.template import write_template
from sheets import make, project

SHEETS = [
    "Start", "Project", "Site", "Arrays", "Friction tests", "Objects", "Clearances", "Motions",
    "Building", "Spectrum", "Links", "Options", "Outlines",
    "Layers", "Acknowledged",
]  # fmt: skip


@pytest.fixture(scope="module", params=list(UnitsFirst))
def blank(request, tmp_path_factory):
    path = tmp_path_factory.mktemp("blank") / "input.xlsx"
    write_template(path, units=request.param)
    return request.param, load_workbook(path)


def tables(book):
    return {t.name: (s, t) for s in book.worksheets for t in s.tables.values()}


def validations(sheet):
    return list(sheet.data_validations.dataValidation)


def validation(sheet, cell):
    return next(rule for rule in validations(sheet) if cell in rule.sqref)


def test_sheets_are_in_working_order(blank):
    assert blank[1].sheetnames == [*SHEETS, "Provisions", "Tables"]


def test_every_single_field_has_a_defined_name(blank):
    names = blank[1].defined_names
    for section in SECTIONS:
        if not section.is_table:
            for entry in entries(section.model):
                assert section.cell_name(entry.name) in names
                assert (section.unit_name(entry.name) in names) == (entry.quantity is not None)


def test_every_table_has_its_name_and_twenty_blank_rows(blank):
    names = tables(blank[1])
    for section in SECTIONS:
        if section.is_table:
            sheet, table = names[section.table_name]
            left, top, right, bottom = range_boundaries(table.ref)
            assert bottom - top == 20
            cells = [c for row in sheet.iter_rows(top + 1, bottom, left, right) for c in row]
            assert all(cell.value is None or cell.data_type == "f" for cell in cells)


def test_headings_state_the_units_of_the_system(blank):
    units, book = blank
    sheet, table = tables(book)["arrays_table"]
    headings = [cell.value for cell in sheet[table.ref][0]]
    weight, size, plan = ("lb", "in", "ft") if units is UnitsFirst.US else ("kN", "mm", "m")
    for heading in (f"Weight [{weight}]", f"CG height [{size}]", f"x from [{plan}]"):
        assert heading in headings


def test_table_columns_are_named_as_their_headings(blank):
    for sheet, table in tables(blank[1]).values():
        headings = [cell.value for cell in sheet[table.ref][0]]
        assert headings == [column.name for column in table.tableColumns]
        assert table.autoFilter is None


def test_no_sheet_is_protected_so_that_its_tables_grow(blank):
    assert not any(sheet.protection.sheet for sheet in blank[1].worksheets)


def test_inputs_are_yellow_and_formulas_are_blue(blank):
    site = blank[1]["Site"]
    assert site["B5"].fill.start_color.rgb == "00FFF6CC"
    assert site["D13"].fill.start_color.rgb == "00E3EDF5"
    formulas = [c for sheet in blank[1] for row in sheet for c in row if c.data_type == "f"]
    others = [c for c in formulas if c.fill.start_color.rgb != "00E3EDF5"]
    # The lines at the top of the sheets, and the clauses of the panel.
    assert {c.coordinate for c in others if c.parent.title != "Site"} == {"A3"}
    assert {c.column_letter for c in others if c.parent.title == "Site"} == {"A", "E"}
    assert len(others) < len(formulas) / 10


def test_choices_are_dropdowns_with_a_message_and_an_alert(blank):
    rule = validation(blank[1]["Arrays"], "D8")
    assert rule.formula1 == '"degrees,percent,in/12"'
    assert rule.showInputMessage
    assert rule.showErrorMessage
    assert rule.prompt


def test_numbers_are_validated_against_their_range(blank):
    rule = validation(blank[1]["Arrays"], "E8")
    assert (rule.type, rule.operator, rule.formula1, rule.formula2) == (
        "decimal",
        "between",
        "0",
        "1.5",
    )
    assert "0 to 1.5" in rule.prompt


def test_clearances_offer_the_arrays_and_objects_but_accept_other_text(blank):
    sheet = blank[1]["Clearances"]
    assert validation(sheet, "B8").formula1 == "live_array_names"
    assert validation(sheet, "C8").formula1 == "live_names"
    assert not validation(sheet, "C8").showErrorMessage


def test_rows_of_linked_blocks_offer_the_arrays_and_have_their_units(blank):
    units, book = blank
    sheet, table = tables(book)["links_table"]
    headings = [cell.value for cell in sheet[table.ref][0]]
    unit = "lb/in" if units is UnitsFirst.US else "kN/m"
    assert headings == [
        "Status",
        "Array",
        "Block friction",
        f"Link stiffness [{unit}]",
        "Link damping",
    ]
    assert validation(sheet, "B8").formula1 == "live_array_names"
    assert [sheet[f"{c}6"].value for c in "CE"] == ["0.40, 0.45, 0.50", "0.02"]
    assert float(sheet["D6"].value) == (5000 if units is UnitsFirst.US else 876)


def test_overrides_offer_the_provisions(blank):
    book = blank[1]
    assert validation(book["Options"], "B35").formula1 == "rule_names"
    cells = book.defined_names["rule_names"].attr_text.partition("!")[2].replace("$", "")
    names = [row[0].value for row in book["Provisions"][cells]]
    assert names == [provision_name(key) for key in PROVISION_KEYS]


def test_no_cell_has_two_validations(blank):
    for sheet in blank[1].worksheets:
        areas = [area for rule in validations(sheet) for area in rule.sqref.ranges]
        for i, area in enumerate(areas):
            assert all(area.isdisjoint(other) for other in areas[i + 1 :])


def test_messages_satisfy_the_limits_of_excel(blank):
    for sheet in blank[1].worksheets:
        for rule in validations(sheet):
            assert len(rule.promptTitle) <= 32
            assert len(rule.prompt) <= 255
            assert len(rule.error) <= 225
            assert len(rule.error) > len(rule.errorTitle)
            assert rule.error != rule.prompt
            assert len(rule.formula1) <= 255


def test_headings_are_frozen_and_sheets_print_one_page_wide(blank):
    for name in SHEETS[1:]:
        sheet = blank[1][name]
        assert sheet.freeze_panes
        assert sheet.page_setup.orientation == "landscape"
        assert sheet.page_setup.fitToHeight == 0
        assert sheet.sheet_properties.pageSetUpPr.fitToPage


def test_defaults_are_filled_and_the_rest_is_blank(blank):
    units, book = blank
    assert book["Project"]["B13"].value == units
    assert book["Options"]["B5"].value == "rule set"
    assert book["Options"]["B6"].value == "No"
    assert all(book["Site"].cell(row, 2).value is None for row in range(5, 18))


def test_start_has_the_six_steps_a_picture_and_the_colors(blank):
    sheet = blank[1]["Start"]
    text = "\n".join(str(value) for row in sheet.values for value in row if value is not None)
    for part in ("roofslip check FOLDER", "roofslip report FOLDER", "records", "Colors"):
        assert part in text
    assert [sheet[f"A{row}"].value for row in range(4, 10)] == list("123456")
    (picture,) = sheet._images
    assert picture._data()[:4] == b"\x89PNG"


def test_values_of_a_project_are_written_in_the_units_of_the_sheets_without_rounding_error(
    tmp_path,
):
    us, si = (load_workbook(make(tmp_path / str(units), units))["Arrays"] for units in UnitsFirst)
    assert [us[f"{c}8"].value for c in "HIJKL"] == [42000, 9, 40, 20, 100]
    assert [si[f"{c}8"].value for c in "IJKL"] == [228.6, 1016, 6.096, 30.48]


def test_a_project_with_many_arrays_gets_a_larger_table(tmp_path):
    array = project().arrays[0].model_dump()
    arrays = [array | {"id": f"A{i}"} for i in range(40)]
    book = load_workbook(make(tmp_path, arrays=arrays, clearances=[]))
    assert book["Arrays"].tables["arrays_table"].ref == "A7:Z52"


def test_a_text_that_looks_like_a_formula_is_written_as_text(tmp_path):
    data = project().project.model_dump() | {"name": "=1+1", "client": "#N/A"}
    sheet = load_workbook(make(tmp_path, project=data))["Project"]
    assert (sheet["B5"].value, sheet["B5"].data_type) == ("=1+1", "s")


def test_a_page_of_a4_has_the_room_of_a_page_of_letter(blank):
    units, book = blank
    is_us = units is UnitsFirst.US
    wide, tall = (279.4, 215.9) if is_us else (297.0, 210.0)  # mm, landscape
    for sheet in book.worksheets:
        margins = sheet.page_margins
        assert sheet.page_setup.paperSize == (1 if is_us else 9)
        assert wide - 25.4 * (margins.left + margins.right) == pytest.approx(259.0, abs=0.3)
        assert tall - 25.4 * (margins.top + margins.bottom) == pytest.approx(190.6, abs=0.3)
