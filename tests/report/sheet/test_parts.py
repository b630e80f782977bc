"""Cells are changed within the parts of a workbook; nothing else of it changes."""

import io
import re
import zipfile

import numpy as np
import pytest
from openpyxl import load_workbook
from openpyxl.utils import coordinate_to_tuple

from report.sheet import style
from report.sheet.parts import changed, write_cells
from report.sheet.positions import CellPosition
from sheets import make
from solver.model import InputError

DRAWING = (
    b'<xdr:wsDr xmlns:xdr="http://schemas.openxmlformats.org/drawingml/2006/spreadsheetDrawing">'
    b"</xdr:wsDr>"
)


def at(sheet, cell):
    """A position from an address."""
    return CellPosition(sheet, *coordinate_to_tuple(cell))


def parts(data):
    with zipfile.ZipFile(io.BytesIO(data)) as archive:
        return {name: archive.read(name) for name in archive.namelist()}


@pytest.fixture
def book(tmp_path):
    """The project with a formula that has a value, and a sketch on the sheet Arrays."""
    path = make(tmp_path)
    files = parts(path.read_bytes())
    name = next(n for n, c in files.items() if b"A2" in c and b"worksheet" in c and b"Tray" in c)
    cell = re.search(rb'<c r="H8"[^>]*>.*?</c>', files[name])[0]
    style = re.search(rb's="\d+"', cell)[0]
    formula = b'<c r="H8" ' + style + b"><f>21000*2</f><v>42000</v></c>"
    files[name] = files[name].replace(cell, formula)
    files["xl/drawings/drawing9.xml"] = DRAWING
    files["xl/workbook.xml"] = files["xl/workbook.xml"].replace(b' fullCalcOnLoad="1"', b"")
    files["xl/calcChain.xml"] = b'<calcChain><c r="H8" i="4"/></calcChain>'
    files["[Content_Types].xml"] = files["[Content_Types].xml"].replace(
        b"</Types>", b'<Override PartName="/xl/calcChain.xml" ContentType="x/y"/></Types>'
    )
    with zipfile.ZipFile(path, "w") as archive:
        for part, content in files.items():
            archive.writestr(part, content)
    return path, name


def test_only_the_changed_cells_change(book):
    path, name = book
    before = path.read_bytes()
    after = changed(before, {at("Arrays", "I8"): 12.5, at("Arrays", "F9"): "Tray & <co>"})
    old, new = parts(before), parts(after)
    assert old.keys() == new.keys()
    assert {part for part in old if old[part] != new[part]} == {name, "xl/workbook.xml"}
    undone = re.sub(rb'<c r="(I8|F9)"[^>]*>.*?</c>', rb"<\1>", new[name])
    assert undone == re.sub(rb'<c r="(I8|F9)"[^>]*>.*?</c>', rb"<\1>", old[name])
    assert b"<f>21000*2</f><v>42000</v>" in new[name]
    sheet = load_workbook(io.BytesIO(after))["Arrays"]
    assert sheet["I8"].value == 12.5
    assert sheet["F9"].value == "Tray & <co>"
    was = load_workbook(path)["Arrays"]
    for cell in ("I8", "F9"):
        assert sheet[cell].number_format == was[cell].number_format
        assert sheet[cell].fill.fgColor.rgb == was[cell].fill.fgColor.rgb
    assert b'fullCalcOnLoad="1"' in new["xl/workbook.xml"]


def test_a_formula_that_is_replaced_leaves_the_order_of_computation(book):
    path, name = book
    after = parts(changed(path.read_bytes(), {at("Arrays", "H8"): 41000}))
    assert "xl/calcChain.xml" not in after
    assert b"calcChain" not in after["[Content_Types].xml"]
    assert b"21000*2" not in after[name]


@pytest.mark.parametrize("cell", ["Z8", "C400", "AB1"])
def test_a_cell_that_is_not_there_is_added_in_order(book, cell):
    path, name = book
    after = changed(path.read_bytes(), {at("Arrays", cell): "new", at("Arrays", "C399"): 1})
    assert load_workbook(io.BytesIO(after))["Arrays"][cell].value == "new"
    found = re.findall(rb"<(?:row|c)\b[^>]*?\br=\"([A-Z]*)(\d+)\"", parts(after)[name])
    rows = [int(number) for letters, number in found if not letters]
    assert rows == sorted(set(rows))
    for row in set(rows):
        columns = [(len(c), c) for c, number in found if c and int(number) == row]
        assert columns == sorted(set(columns))


@pytest.mark.parametrize("number", [3, 2.5, np.float64(0.1), 1e-12])
def test_any_number_is_written_as_one(book, number):
    path, _ = book
    after = changed(path.read_bytes(), {at("Arrays", "I8"): number})
    assert load_workbook(io.BytesIO(after))["Arrays"]["I8"].value == number


def test_a_cell_is_cleared_and_keeps_its_format(book):
    path, _ = book
    after = load_workbook(io.BytesIO(changed(path.read_bytes(), {at("Arrays", "I8"): None})))
    assert after["Arrays"]["I8"].value is None
    assert after["Arrays"]["I8"].fill.fgColor.rgb == style.INPUT_FILL.fgColor.rgb


def test_a_table_grows_to_the_rows_below_it(tmp_path):
    path = make(tmp_path)
    cells = {at("Objects", f"B{row}"): f"X{row}" for row in range(26, 35)}
    after = load_workbook(io.BytesIO(changed(path.read_bytes(), cells)))
    before = load_workbook(path)["Objects"].tables["objects_table"].ref
    grown = after["Objects"].tables["objects_table"].ref
    assert before.endswith("27")
    assert grown == before.removesuffix("27") + "34"


def test_a_shared_formula_is_refused(book):
    path, name = book
    files = parts(path.read_bytes())
    shared = files[name].replace(b"<f>21000*2</f>", b'<f t="shared" ref="H8:H9" si="0">1</f>')
    below = b'<c r="H9"><f t="shared" si="0"/><v>1</v></c>'
    files[name] = re.sub(rb'<c r="H9"[^>]*>.*?</c>', below, shared)
    with zipfile.ZipFile(path, "w") as archive:
        for part, content in files.items():
            archive.writestr(part, content)
    with pytest.raises(InputError, match="Arrays!H8: shares its formula"):
        write_cells(path, {at("Arrays", "H8"): 1.0})


def test_a_sheet_that_is_not_there_is_refused(tmp_path):
    with pytest.raises(InputError, match="Nowhere: the sheet is missing"):
        write_cells(make(tmp_path), {at("Nowhere", "A1"): 1.0})


def test_a_file_that_cannot_be_written_stays_as_it_was(tmp_path, monkeypatch):
    path = make(tmp_path)
    before = path.read_bytes()

    def full(*_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("os.replace", full)
    with pytest.raises(InputError, match="cannot be written"):
        write_cells(path, {at("Arrays", "I8"): 1.0})
    assert path.read_bytes() == before
    assert [p.name for p in tmp_path.iterdir() if p.name.startswith(".")] == []


def test_a_folded_column_that_is_filled_is_shown_and_the_others_stay_folded(book):
    path, _ = book
    sheet = load_workbook(path)["Clearances"]
    groups = [range(one.min, one.max + 1) for one in sheet.column_dimensions.values() if one.hidden]
    first, *others = groups
    data = changed(path.read_bytes(), {CellPosition("Clearances", 8, first.start): 1.0})
    after = load_workbook(io.BytesIO(data))["Clearances"].column_dimensions
    hidden = {
        column for one in after.values() if one.hidden for column in range(one.min, one.max + 1)
    }
    assert hidden == {column for group in others for column in group}
    blank = changed(path.read_bytes(), {CellPosition("Clearances", 8, first.start): None})
    still = load_workbook(io.BytesIO(blank))["Clearances"].column_dimensions
    assert any(one.hidden and one.min == first.start for one in still.values())
