"""Live formulas that were typed over are found; those that were not are left alone."""

import re

import pytest

import commands
from cells import address
from nightly import by_day
from places import DATA
from report.sheet.reading.archive import open_book
from report.sheet.schema.choices import UnitsFirst
from report.sheet.writing.filled import findings, overwritten
from sheets import at, edit, formula_cells, make, pack, parts, put, retitle, said, type_into


def lost(path):
    """Cells without their formula, as addresses."""
    return [item.position.address for item in overwritten(open_book(path))]


def formulas(path):
    """Every formula of a workbook by cell."""
    book = open_book(path)
    return {f"{t}!{c}": book.formula(t, c) for t, scan in book.scans.items() for c in scan.formulas}


@pytest.mark.parametrize("units", by_day(UnitsFirst, 1))
def test_every_blue_cell_of_a_new_workbook_that_loses_its_formula_is_named(tmp_path, units):
    path = make(tmp_path, units)
    assert lost(path) == []
    blue = formulas(path).keys()
    edit(path, lambda book: [setattr(one, "value", None) for one in formula_cells(book)])
    unmarked = {f"Start!F{row}" for row in range(8, 16)}  # clauses beside the panel
    assert set(lost(path)) == blue - unmarked
    assert len(blue) > 400


def typed_over(book):
    """What a person does: a value, nothing, a column that is deleted."""
    put(book, OVER)


RATIO = "Clearances/{}/D/C, prescriptive"
FACTOR = "Provisions/Factor on (S_DS - 0.4)^2 in the prescriptive displacement/In use"
OVER = {
    "Site/S_DS/Computed": 1.2,
    "Arrays/A1/Slope in degrees": None,
    RATIO.format(1): 0.5,
    RATIO.format(2): 0.5,
    RATIO.format(3): 0.5,
    FACTOR: 60,
    "Tables/Arrays: Support spacing": "=#REF!",
}


def test_each_cell_is_named_with_what_is_in_it_and_what_belongs_there(tmp_path):
    path = edit(make(tmp_path), typed_over)
    found = overwritten(open_book(path))
    assert tuple(item.position.address for item in found) == said(*OVER)
    texts = {item.cell: item.text for item in findings(found)}
    ratios = ":".join((at(RATIO.format(1)), at(RATIO.format(3)).partition("!")[2]))
    for place, words in {
        "Site/S_DS/Computed": "S_DS, computed, is 1.2, typed over its formula",
        "Arrays/A1/Slope in degrees": "is blank, and its formula is gone",
        ratios: "D/C, prescriptive (3 cells) is 0.5, typed",
    }.items():
        assert words in texts[at(place)]
    fresh = "copy it from a fresh workbook (roofslip new FOLDER)"
    assert all(text.endswith(fresh) for text in texts.values())
    warned = commands.printed("check", path)
    assert all(f"warning: {at(name)}: " in warned for name in ("Site/S_DS/Computed", FACTOR))


def test_a_renamed_sheet_other_units_and_new_rows_give_no_warning(tmp_path):
    def change(book):
        # As Excel does it: what refers to a heading or a sheet follows.
        book["Arrays"].title = "Our arrays"
        retitle(book, "Our arrays", "Weight", "Weight [kip]")
        for name in book.defined_names:
            defined = book.defined_names[name]
            defined.attr_text = defined.attr_text.replace("'Arrays'", "'Our arrays'")
        for found in formula_cells(book):
            text = str(found.value).replace("Weight '[lb']", "Weight '[kip']")
            found.value = text.replace("'Arrays'!", "'Our arrays'!")

    book = open_book(edit(make(tmp_path), change))
    assert overwritten(book) == ()


def test_a_formula_that_refers_to_a_deleted_column_is_named(tmp_path):
    def delete(book):
        for found in formula_cells(book):
            column = r"arrays_table\[+[^\[]*Slope in degrees\]+"
            found.value = re.sub(column, "#REF!", str(found.value))
        retitle(book, "Arrays", "Slope in degrees", "My column")

    path = edit(make(tmp_path), delete)
    texts = [item.text for item in findings(overwritten(open_book(path)))]
    assert any("refers to a column that is missing" in text for text in texts)


@pytest.mark.quick
def test_a_workbook_of_0_1_has_no_live_formulas():
    assert lost(DATA / "input-0.1.xlsx") == []


@pytest.mark.parametrize("name", by_day(["campus", "conditions", "example", "school"], 1))
def test_the_formulas_of_158bb098_are_no_reason_to_warn(tmp_path, name):
    path = tmp_path / "input.xlsx"
    path.write_bytes((DATA / "158bb098" / f"{name}.xlsx").read_bytes())
    assert lost(path) == []
    computed = address(path, "Site/S_DS/Computed")
    assert lost(type_into(path, {computed: 1.2})) == [computed]
    assert lost(type_into(path, {"Arrays/A1/Status": "done", "Start/Site": 3})) == [computed]


def test_a_color_that_a_program_saves_as_opaque_is_that_color(tmp_path):
    path = edit(make(tmp_path), typed_over)
    files = parts(path)
    assert b'rgb="00E3EDF5"' in files["xl/styles.xml"]
    files["xl/styles.xml"] = files["xl/styles.xml"].replace(b'rgb="00', b'rgb="FF')
    assert tuple(lost(pack(path, files))) == said(*OVER)
