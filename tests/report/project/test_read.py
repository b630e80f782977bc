"""Reading an input workbook: the project is recovered for any arrangement of the sheets."""

import datetime as dt
import hashlib
import re

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from openpyxl import load_workbook
from openpyxl.chart import BarChart, Reference
from openpyxl.utils import coordinate_to_tuple, get_column_letter, range_boundaries
from openpyxl.worksheet.table import Table

from fixtures.cells import address, cell
from fixtures.marks import by_day
from fixtures.project_parts import FT, INCH
from fixtures.spaces import spaced
from fixtures.workbooks import (
    cell_address,
    edit,
    findings_of,
    make,
    problems,
    project,
    read_workbook,
    row_cells,
    same,
    type_into,
    with_addresses,
)
from fixtures.workbooks import saved_by_libreoffice as by_libreoffice
from report.assessment.precheck import findings
from report.project.model.choices import Polarity, SlopeUnit, UnitsFirst
from report.project.model.options import Options
from report.project.write.template import write_template


@pytest.fixture(params=list(UnitsFirst))
def path(request, tmp_path):
    return make(tmp_path, request.param)


def test_a_project_is_read_as_written_and_every_cell_echoed(path):
    before = path.read_bytes()
    book = read_workbook(path.parent)  # a folder is read as its input workbook
    assert same(book.input, project())
    assert (book.path, book.sha256) == (path, hashlib.sha256(before).hexdigest())
    assert path.read_bytes() == before
    book = read_workbook(path)
    rows = echo(book)
    assert len(rows) == len(book.echo)
    weight = rows[cell_address("Arrays/A1/Weight")]
    assert spaced((weight.label, weight.value)) == ("Weight", "186825 N")
    assert (weight.typed, weight.unit) in [("42000", "lb"), ("186.825307841", "kN")]
    names = ("Site/S_1", "Objects/OLD/Height", "Options/Peer review")
    assert spaced([rows[cell_address(name)].value for name in names]) == ["0.7 g", "—", "Yes"]


letters = st.characters(exclude_categories=["Cc", "Cf", "Cs", "Cn", "Zs", "Zl", "Zp"])
texts = st.text(letters, min_size=1, max_size=12)
lengths = st.floats(0.01, 1000)


@st.composite
def inputs(draw):
    """Projects of any values that the checks let pass."""
    base = project()
    array = base.arrays[0].model_dump()
    names = draw(st.lists(texts, min_size=1, max_size=3, unique_by=str.casefold))
    arrays = [
        array
        | {
            "id": name,
            "slope_value": draw(st.floats(0, 11.9)),
            "slope_unit": draw(st.sampled_from(SlopeUnit)),
            "mu": draw(st.floats(0, 1.5)),
            "weight_n": draw(st.floats(1, 1e7)),
            "cg_height_m": draw(lengths),
            "x_to_m": array["x_from_m"] + draw(lengths),
            "y_from_m": 10.0 * row,
            "y_to_m": 10.0 * row + 5.0,
            "construction": draw(texts),
        }
        for row, name in enumerate(names)
    ]
    motion = base.motions[0].model_dump() | {
        "scaling": draw(st.sampled_from(["factor", "PPA"])),
        "scale_value": draw(st.floats(0.01, 100)),
        "polarity": draw(st.sampled_from(Polarity)),
        "source": draw(st.just("") | texts),
    }
    head = base.project.model_dump() | {
        "name": draw(texts),
        "date": draw(st.dates(dt.date(2000, 1, 2), dt.date(2100, 1, 1))),
        "units_first": draw(st.sampled_from(UnitsFirst)),
    }
    changes = {"project": head, "arrays": arrays, "motions": [motion], "clearances": []}
    return project(**changes, objects=[])


@pytest.mark.parametrize("examples", [1, pytest.param(30, marks=pytest.mark.nightly)])
def test_every_valid_project_is_recovered_from_the_workbook(tmp_path, examples):
    path = make(tmp_path)

    @settings(max_examples=examples)
    @given(data=inputs(), units=st.sampled_from(UnitsFirst))
    def recovered(data, units):
        write_template(path, units=units, example=data)
        assert same(read_workbook(path).input, data)

    recovered()


# Changes that users make. openpyxl moves neither names nor tables, so they are moved here as Excel
# does.


def move(table, *, rows=0, columns=0):
    left, top, right, bottom = range_boundaries(table.ref)
    first, last = (get_column_letter(column + columns) for column in (left, right))
    table.ref = f"{first}{top + rows}:{last}{bottom + rows}"


def shift(book, title, rows):
    """Insert rows at the top of a sheet."""
    sheet = book[title]
    sheet.insert_rows(1, rows)
    for table in sheet.tables.values():
        move(table, rows=rows)
    fixed = re.compile(rf"'?{re.escape(title)}'?!\$[A-Z]+\$\d+(:\$[A-Z]+\$\d+)?")

    def moved(cells):
        return re.sub(r"(?<=\$)\d+", lambda row: str(int(row[0]) + rows), cells[0])

    for name in book.defined_names.values():
        name.attr_text = fixed.sub(moved, name.attr_text)


def rename(book, old, new):
    book[old].title = new
    for name in book.defined_names.values():
        name.attr_text = name.attr_text.replace(f"'{old}'!", f"'{new}'!")


def swap(book, title, first, second, rows):
    """Exchange the headings and rows of two columns of a table."""
    heads = [cell(book, f"{title}/heading/{heading}") for heading in (first, second)]
    for row in range(rows + 1):
        a, b = (head.offset(row=row) for head in heads)
        a.value, b.value = b.value, a.value
        a.number_format, b.number_format = b.number_format, a.number_format
    i, j = (head.column - 1 for head in heads)
    columns = next(iter(book[title].tables.values())).tableColumns
    columns[i].name, columns[j].name = columns[j].name, columns[i].name


def move_table(book, title, columns, rows):
    sheet = book[title]
    table = next(iter(sheet.tables.values()))
    sheet.move_range(table.ref, rows=rows, cols=columns)
    move(table, rows=rows, columns=columns)


def move_second_array(book, rows):
    first, last = (cell(book, f"Arrays/A2/{end}") for end in ("ID", "Downslope direction"))
    first.parent.move_range(f"{first.coordinate}:{last.coordinate}", rows=rows)


def as_by_numbers(book):
    """Rename each sheet as Numbers does, without names and tables, and split one by its tables."""
    book.defined_names.clear()
    heading = cell(book, "Options/heading/Provision")
    other = book.create_sheet("Options - Table 1-1")
    for row in heading.parent.iter_rows(min_row=heading.row):
        for found in row:
            other[found.coordinate].value, found.value = found.value, None
    for sheet in book.worksheets:
        sheet.tables.clear()
        if sheet is not other:
            sheet.title = f"{sheet.title} - Table 1"
    book.create_sheet("Export Summary", 0)["A1"] = "This document was exported from Numbers."


# Together where each can be told apart: no two move the same table or forget what finds it.
CHANGES = {
    "a table without heading row": lambda book: setattr(
        book["Arrays"].tables["arrays_table"], "headerRowCount", 0),
    "rows inserted above, sheets renamed": lambda book: [
        *(shift(book, s, 3) for s in ("Site", "Arrays", "Project")),
        *(rename(book, s, f"My {s}") for s in ("Site", "Arrays"))],
    "sheets reordered and hidden, a name in other capitals": lambda book: [
        book.move_sheet("Motions", -5), setattr(book["Arrays"], "sheet_state", "hidden"),
        setattr(book["Arrays"].tables["arrays_table"], "displayName", "ARRAYS_TABLE")],
    "columns reordered, blank rows between": lambda book: [
        swap(book, "Arrays", "Slope", "Weight", 3), move_second_array(book, 7)],
    "table moved": lambda book: move_table(book, "Arrays", 4, 10),
    "tables forgotten": lambda book: [sheet.tables.clear() for sheet in book.worksheets],
    "names forgotten": lambda book: book.defined_names.clear(),
    "exported by Numbers": as_by_numbers,
    "rows typed below the table": lambda book: move_second_array(book, 30),
}  # fmt: skip


@pytest.mark.parametrize("change", by_day(CHANGES.values(), 1), ids=CHANGES)
def test_arrangement_does_not_matter(tmp_path, change):
    assert same(read_workbook(edit(make(tmp_path), change)).input, project())


@pytest.mark.parametrize("title", ["PV layers", "Notes"])
def test_a_rare_sheet_that_is_renamed_by_hand_is_read_by_its_headings(tmp_path, title):
    layers = [{"layer": "PV-1", "kind": "array"}]
    path = make(tmp_path, layers=layers)
    wanted = read_workbook(path).inputs["layers"]

    def renamed(book):
        book["Layers"].tables.clear()
        rename(book, "Layers", title)

    assert read_workbook(edit(path, renamed)).inputs["layers"] == wanted
    assert [row["layer"] for row in wanted] == ["PV-1"]


SPELLINGS = {
    "heading in capitals": ("Arrays/heading/Friction coefficient", " FRICTION\ncoefficient *"),
    "choices in capitals": ("Arrays/A1/Slope unit", " Degrees "),
    "a number as a text": ("Project/Revision", 1),
    "a logical value for a yes": ("Options/Peer review", True),
    "notes in a computed column": ("Arrays/A2/Array type", "ask the client"),
    "another value in a computed cell": ("Site/S_DS/Computed", 99.0),
    "no width at the ends of a text": ("Motions/M1/ID", "\ufeffM1\u200b \u200b"),
    "no unit where none can be chosen": ("Site/S_DS/Unit", None),
    "a unit in capitals": ("Building/Period T1/Unit", " S "),
    "notes far to the right": ("Arrays!GR9", "ask the client"),  # the last column that is allowed
}


def test_spelling_and_notes_do_not_matter_and_units_are_followed(tmp_path):
    """All in one workbook: each is in a cell that no other depends on."""
    path = type_into(make(tmp_path), dict(SPELLINGS.values()))
    assert same(read_workbook(path).input, project())
    cells = row_cells("Arrays/heading", {"CG height": "CG height [mm]", "Weight": "Weight [kg]"})
    cells |= row_cells("Arrays/A1", {"CG height": 250, "Weight": 1000}) | {"Arrays/A2/CG height": 1}
    cells |= {"Site/Structure height h": 12, "Site/Structure height h/Unit": "m"}
    data = read_workbook(type_into(make(tmp_path), cells)).input
    assert data.arrays[0].cg_height_m == pytest.approx(0.25)
    assert data.arrays[0].weight_n == pytest.approx(9806.65)
    assert data.site.structure_height_m == pytest.approx(12)
    assert data.site.roof_height_m == pytest.approx(36 * FT)


def test_a_fire_pathway_is_a_width_or_none_or_not_answered(tmp_path):
    typed = {1: "None ", 2: 0, 3: "36", 4: 48, 5: None}
    cells = {f"Clearances/{row}/Fire pathway": value for row, value in typed.items()}
    book = read_workbook(type_into(make(tmp_path), cells))
    widths = [row.pathway_m for row in book.input.clearances]
    assert widths == [0.0, 0.0, pytest.approx(36 * INCH), pytest.approx(48 * INCH), None]
    shown = [echo(book)[cell_address(name)].value for name in cells]
    assert (shown[:2], shown[4]) == (["none", "none"], "—")
    # None is no width that is too small, and is written as the word.
    assert not [
        found
        for found in findings(book.sheet.source, book.sheet.project, book.shaking)
        if "pathway" in found.text
    ]
    written = load_workbook(make(tmp_path / "again", clearances=book.input.clearances))
    assert cell(written, "Clearances/1/Fire pathway").value == "none"


def test_what_is_blank_or_absent_takes_its_default(tmp_path):
    statistic = "Options/Design value statistic"
    blank = (statistic, "Options/Peer review", "Motions/M2/Polarity")
    book = read_workbook(type_into(make(tmp_path), dict.fromkeys(blank)))
    assert book.input.options == Options()
    assert book.input.motions[1].polarity is Polarity.BOTH
    row = echo(book)[cell_address(statistic)]
    assert (row.typed, row.value) == ("", "per rule set (default)")

    # `test_earlier` has the cells that earlier workbooks lack.
    def change(book):
        for title in ("Spectrum", "Links", "Friction tests", "Outlines"):
            book.remove(book[title])

    assert same(read_workbook(edit(make(tmp_path), change)).input, project())


def test_an_unknown_heading_is_listed_in_the_echo(tmp_path):
    def note(book):
        sheet, row = book["Arrays"], cell(book, "Arrays/heading/ID").row
        beside = sheet.max_column + 1
        sheet.cell(row, beside).value, sheet.cell(row + 1, beside).value = "Color", "black"

    book = read_workbook(edit(make(tmp_path), note))
    (row,) = [row for row in book.echo if row.value.startswith("not an input")]
    assert (row.sheet, row.label) == ("Arrays", "column 'Color'")
    assert load_workbook(book.path)["Arrays"][row.cell].value == "Color"


def echo(book):
    """The echoed rows by the addresses of their cells."""
    return {f"{row.sheet}!{row.cell}": row for row in book.echo}


# openpyxl saves no values of formulas, so LibreOffice saved these.
@pytest.mark.quick
def test_a_workbook_saved_by_libreoffice_reads_the_same_and_shows_its_formulas(tmp_path):
    saved = by_libreoffice(tmp_path)
    book = read_workbook(saved)
    # Saved before one cell, and before a blank one for a fire pathway was no answer.
    site = project().site.model_copy(update={"roof_evaluation": ""})
    rows = [row.model_copy(update={"pathway_m": None}) for row in project().clearances]
    assert same(book.input, project(clearances=rows).model_copy(update={"site": site}))
    first, second = (address(saved, f"Arrays/{name}/Friction coefficient") for name in ("A1", "A2"))
    assert echo(book)[first].typed == "=0.4+0.05 → 0.45"
    assert echo(book)[second].typed == f"={first.partition('!')[2]} → 0.45"


@pytest.mark.parametrize(
    ("name", "text"),
    [("Slope", "\u200b0.5"), ("Slope", "0.5\u200b"), ("Slope unit", "degrees\ufeff")],
)
def test_characters_of_no_width_around_a_number_or_a_choice_do_not_count(tmp_path, name, text):
    path = type_into(make(tmp_path), {f"Arrays/A1/{name}": text})
    assert same(read_workbook(path).input, project())


def test_characters_of_no_width_in_a_heading_or_a_label_do_not_count(tmp_path):
    path = make(tmp_path)

    def change(book):
        cell(book, "Arrays/heading/CG height").value = "CG\u200b height\ufeff [in\u200b]"
        cell(book, "Arrays/heading/Slope").value = "\u2060Slope"

    assert same(read_workbook(edit(path, change)).input, project())


@pytest.mark.parametrize("is_own_sheet", [False, True])
def test_a_workbook_with_a_chart_reads_the_same(tmp_path, is_own_sheet):
    def with_chart(book):
        chart, arrays = BarChart(), book["Arrays"]
        chart.add_data(Reference(arrays, min_col=3, min_row=7, max_row=9), titles_from_data=True)
        (book.create_chartsheet("Chart1") if is_own_sheet else arrays).add_chart(chart)

    path = edit(make(tmp_path), with_chart)
    assert same(read_workbook(path).input, project())
    assert findings_of(path) == []


@pytest.mark.parametrize(
    ("cells", "shown"),
    [({"Objects!B6": "RTU-9"}, "RTU-9"), ({"Objects!B6": "RTU-9", "Objects!D6": 50}, "RTU-9"),
     ({"Objects!D6": 50}, "50")],
)  # fmt: skip
def test_a_row_that_is_typed_over_the_example_is_named(tmp_path, cells, shown):
    path = type_into(make(tmp_path), cells)
    assert same(read_workbook(path).input, project())
    assert findings_of(path) == [(
        "example Objects", next(iter(cells)),
        f"the row Example has {shown}, and is not read: enter your values below the headings",
    )]  # fmt: skip


def copied(book, title):
    """Copy a sheet as Excel does: with a table of another name."""
    sheet = book.copy_worksheet(book[title])
    for table in book[title].tables.values():
        sheet.add_table(Table(displayName=f"{table.name}2", ref=table.ref))
    return sheet


def test_a_copied_sheet_is_ignored_with_a_warning(tmp_path):
    path = edit(make(tmp_path), lambda book: copied(book, "Arrays"))
    ((name, cell, text),) = findings_of(path)
    assert (name, cell) == ("copy Arrays Copy", cell_address("Arrays/heading/ID"))
    assert text == (
        "worksheets 'Arrays' and 'Arrays Copy' both have the labels of Arrays; 'Arrays' is read,"
        " and 'Arrays Copy' is ignored: delete the one that you do not want"
    )
    ((name, _, _),) = findings_of(edit(make(tmp_path), lambda book: copied(book, "Options")))
    assert name == "copy Options Copy"  # of several parts, named once


def test_a_sheet_with_some_of_the_headings_is_no_copy(tmp_path):
    def change(book):
        book.create_sheet("Notes").append(["ID", "Slope", "x [g]", "y [g]", "Period [s]"])

    assert findings_of(edit(make(tmp_path), change)) == []


FRESH = "copy it from a new workbook (roofslip new FOLDER)"


def remove(sheet):
    return lambda book: book.remove(book[sheet])


def forget_number(book):
    del book.defined_names["project_number"]
    number = cell(book, "Project/Project number")
    number.offset(column=-1).value = None


NO_TABLE = "no table {0}_table and no row of its headings"
# What is changed in a workbook, and the resulting line.
EDITED = [
    # It takes no other table for its own.
    *((remove(sheet),
       f"{sheet}: the worksheet is missing: {NO_TABLE.format(sheet.lower())}; {FRESH}")
      for sheet in ("Arrays", "Objects")),
    (remove("Site"),
     f"Site: the worksheet is missing, or all labels of Site and building; {FRESH}\n"
     "Site: long-period transition T_L is missing (no name target_t_l_s and no label 'Long-period"
     f" transition T_L'); {FRESH}"),
    (forget_number,
     "Project: project number is missing (no name project_number and no label 'Project number');"
     f" {FRESH}"),
    # A required column is pointed at where it was.
    (lambda book: book["Arrays"].delete_cols(cell(book, "Arrays/A1/Weight").column),
     "<Arrays/heading/Weight>: heading 'Weight' is missing; write it here in its own column, or"
     f" {FRESH}"),
]  # fmt: skip


@pytest.mark.parametrize(
    ("change", "line"), by_day(EDITED, 1), ids=[line[:40] for _, line in EDITED]
)
def test_what_is_missing_is_reported_once(tmp_path, change, line):
    assert problems(edit(make(tmp_path), change)) == with_addresses(*line.splitlines())


def test_another_workbook_is_told_in_one_line_not_as_missing_worksheets(tmp_path):
    def foreign(book):
        book.remove(book["Project"])
        book.remove(book["Site"])

    (line,) = problems(edit(make(tmp_path), foreign))
    assert line.startswith("not an input workbook: the worksheets Project and Site are missing;")


@pytest.mark.parametrize(
    ("name", "to"),
    by_day([("Arrays/A1/Friction test report", (1, 0)), ("Site/Structure height h", (1, 0)),
            ("Site/Structure height h", (0, 1)), ("Site/Structure height h", (0, -1))], 1),
    ids=["table", "below", "unit", "label"],
)  # fmt: skip
def test_merged_cells_of_a_table_or_over_a_single_field_are_reported(tmp_path, name, to):
    sheet, first = cell_address(name).split("!")
    row, column = coordinate_to_tuple(first)
    (top, bottom), (left, right) = (sorted((0, step)) for step in to)
    corners = ((row + top, column + left), (row + bottom, column + right))
    cells = ":".join(f"{get_column_letter(across)}{down}" for down, across in corners)
    path = edit(make(tmp_path), lambda book: book[sheet].merge_cells(cells))
    assert problems(path) == (f"{sheet}!{cells}: cells are merged; unmerge them",)
