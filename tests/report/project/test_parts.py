"""Cells are changed within the parts of a workbook; nothing else of it changes."""

import io
import itertools
import re

import numpy as np
import pytest
from lxml import etree
from openpyxl import load_workbook
from openpyxl.utils import coordinate_to_tuple, range_boundaries

from fixtures.cells import cell
from fixtures.marks import by_day
from fixtures.workbooks import cell_address, edit, make, pack, parts
from report.project.read.archive import open_book
from report.project.read.changed_cells import changed
from report.project.read.positions import CellPosition
from report.project.read.read import read
from report.project.write import style
from report.project.write.filled import WorkbookChange
from solver.errors import InputError

DRAWING = b"<a/>"  # whatever it is, it stays


def place(name):
    """The position of a cell."""
    sheet, coordinate = cell_address(name).split("!")
    return CellPosition(sheet, *coordinate_to_tuple(coordinate))


WEIGHT, BELOW, HEIGHT, REPORT = (
    f"Arrays/{name}"
    for name in ("A1/Weight", "A2/Weight", "A1/CG height", "A2/Friction test report")
)


def named(name):
    """The address of a cell within its sheet, as it is in the part."""
    return cell_address(name).partition("!")[2].encode()


def without(sheet, *names):
    """Return the XML of a sheet in one form, without what some cells hold."""
    root = etree.fromstring(sheet)
    addresses = {named(name).decode() for name in names}
    for one in root.iter("{*}c"):
        if one.get("r") in addresses:
            del one[:]
            one.attrib.pop("t", None)
    return etree.tostring(root, method="c14n")


def whole(*names):
    """A pattern of cells in their part."""
    return rb'<c r="(%b)"[^>]*>.*?</c>' % b"|".join(map(named, names))


def opened(data):
    return load_workbook(io.BytesIO(data))


def after(path, cells):
    """The bytes of a workbook once its cells are changed."""
    return changed(path.read_bytes(), cells)


@pytest.fixture
def book(tmp_path):
    """The project with a formula that has a value, and a sketch on the sheet Arrays."""
    path = make(tmp_path)
    files = parts(path)
    name = next(n for n, c in files.items() if b"A2" in c and b"worksheet" in c and b"Tray" in c)
    former = re.search(whole(WEIGHT), files[name])[0]
    look = re.search(rb's="\d+"', former)[0]
    formula = b'<c r="%b" %b><f>21000*2</f><v>42000</v></c>' % (named(WEIGHT), look)
    files[name] = files[name].replace(former, formula)
    files["xl/drawings/drawing9.xml"] = DRAWING
    files["xl/workbook.xml"] = files["xl/workbook.xml"].replace(b' fullCalcOnLoad="1"', b"")
    files["xl/calcChain.xml"] = b'<calcChain><c r="%b" i="4"/></calcChain>' % named(WEIGHT)
    files["[Content_Types].xml"] = files["[Content_Types].xml"].replace(
        b"</Types>", b'<Override PartName="/xl/calcChain.xml" ContentType="x/y"/></Types>'
    )
    return pack(path, files), name


def test_only_the_changed_cells_change(book):
    path, name = book
    old, was = parts(path), load_workbook(path)
    typed = {HEIGHT: 12.5, REPORT: "Tray & <co>"}
    data = after(path, {place(name): value for name, value in typed.items()})
    new, now = parts(io.BytesIO(data)), opened(data)
    assert old.keys() == new.keys()
    assert {part for part in old if old[part] != new[part]} == {name, "xl/workbook.xml"}
    assert without(new[name], *typed) == without(old[name], *typed)
    assert b"<f>21000*2</f><v>42000</v>" in new[name]
    for key, value in typed.items():
        it, before = cell(now, key), cell(was, key)
        assert (it.value, it.number_format) == (value, before.number_format)
        assert it.fill.fgColor.rgb == before.fill.fgColor.rgb
    assert b'fullCalcOnLoad="1"' in new["xl/workbook.xml"]


@pytest.mark.quick
def test_a_formula_that_is_replaced_leaves_the_order_of_computation(book):
    path, name = book
    new = parts(io.BytesIO(after(path, {place(WEIGHT): 41000})))
    assert "xl/calcChain.xml" not in new
    assert b"calcChain" not in new["[Content_Types].xml"]
    assert b"21000*2" not in new[name]


@pytest.mark.parametrize(("row", "column"), [(8, 50), (400, 3), (1, 28)])
def test_a_cell_that_is_not_there_is_added_in_order(book, row, column):
    path, name = book
    cells = {CellPosition("Arrays", row, column): "new", CellPosition("Arrays", 399, 3): 1}
    data = after(path, cells)
    assert opened(data)["Arrays"].cell(row, column).value == "new"
    found = re.findall(rb"<(?:row|c)\b[^>]*?\br=\"([A-Z]*)(\d+)\"", parts(io.BytesIO(data))[name])
    rows = [int(number) for letters, number in found if not letters]
    assert rows == sorted(set(rows))
    for row in set(rows):
        columns = [(len(c), c) for c, number in found if c and int(number) == row]
        assert columns == sorted(set(columns))


def test_cells_and_rows_are_added_on_a_sheet_that_has_none(book):
    path, _ = book
    edit(path, lambda opened: opened.create_sheet("Blank"))
    places = itertools.product((2, 5), (3, 1))
    cells = {CellPosition("Blank", row, column): row * column for row, column in places}
    found = opened(after(path, cells))["Blank"]
    assert {at: found.cell(at.row, at.column).value for at in cells} == cells


def test_numbers_are_written_and_a_folded_column_shown_where_it_is_filled(book):
    values = {HEIGHT: 3, "Arrays/A2/CG height": 2.5, "Arrays/A1/x to": np.float64(0.1),
              "Arrays/A2/x to": 1e-12, WEIGHT: None}  # fmt: skip
    now = opened(after(book[0], {place(name): value for name, value in values.items()}))
    for name, value in values.items():
        it = cell(now, name)
        assert (it.value, it.fill.fgColor.rgb) == (value, style.INPUT_FILL.fgColor.rgb)
    path, _ = book
    first, *others = folded(load_workbook(path))
    row = place("Clearances/1/Array").row
    at_column = CellPosition("Clearances", row, first.start)
    assert folded(opened(after(path, {at_column: 1.0}))) == others
    assert first in folded(opened(after(path, {at_column: None})))


def test_a_table_grows_to_the_rows_below_it(tmp_path):
    path = make(tmp_path)
    cells = {place(f"Objects/{row}/ID"): f"X{row}" for row in range(19, 28)}
    books = (load_workbook(path), opened(after(path, cells)))
    was, now = (book["Objects"].tables["objects_table"].ref for book in books)
    *corner, bottom = range_boundaries(was)
    assert range_boundaries(now) == (*corner, bottom + 7)
    assert max(position.row for position in cells) == bottom + 7


@pytest.mark.quick
def test_a_shared_formula_and_a_sheet_that_is_not_there_are_refused(book):
    path, name = book
    files = parts(path)
    first, below = named(WEIGHT), named(BELOW)
    shared = b'<f t="shared" ref="%b:%b" si="0">1</f>' % (first, below)
    again = b'<c r="%b"><f t="shared" si="0"/><v>1</v></c>' % below
    files[name] = files[name].replace(b"<f>21000*2</f>", shared)
    files[name] = re.sub(whole(BELOW), again, files[name])
    with pytest.raises(InputError, match=cell_address(f"<{WEIGHT}>: shares its formula")):
        after(pack(path, files), {place(WEIGHT): 1.0})
    with pytest.raises(InputError, match="Nowhere: the worksheet is missing"):
        after(book[0], {CellPosition("Nowhere", 1, 1): 1.0})


@pytest.mark.parametrize("entity", ['"ha"', 'SYSTEM "file:///etc/passwd"'])
def test_a_part_with_a_document_type_is_refused(book, entity):
    path, name = book
    files = parts(path)
    head, _, body = files[name].partition(b"<worksheet")
    doctype = f"<!DOCTYPE worksheet [<!ENTITY a {entity}>]>".encode()
    files[name] = head + doctype + b"<worksheet" + body.replace(b"Tray", b"&a;", 1)
    with pytest.raises(InputError, match="Arrays: has a document type"):
        after(pack(path, files), {place(WEIGHT): 1.0})


def folded(book):
    """The groups of columns of the clearances that are hidden."""
    columns = book["Clearances"].column_dimensions.values()
    return [range(one.min, one.max + 1) for one in columns if one.hidden]


@pytest.mark.parametrize(
    "name", by_day(["=1+1", "{=1+1}", "+1", "@A1", "http://a.test", "_x0041_b", "#N/A", "1e3"], 1)
)
def test_a_text_is_read_back_as_it_was_written_whatever_it_looks_like(tmp_path, name):
    path = make(tmp_path)
    path.write_bytes(changed(path.read_bytes(), {place("Arrays/A1/ID"): name}))
    at_id = place("Arrays/A1/ID")
    assert load_workbook(path)["Arrays"][at_id.cell].data_type == "s"
    assert read(path).inputs["arrays"][0]["id"] == name
    assert WorkbookChange(open_book(path)).rows("arrays", "id", name) == [at_id.row]
