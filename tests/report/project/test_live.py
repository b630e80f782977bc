"""Live formulas that were typed over, that were not calculated, or that LibreOffice saved."""

import re
from xml.sax.saxutils import unescape

import pytest
from openpyxl import load_workbook

from fixtures import commands, workbooks
from fixtures.cells import address, cell
from fixtures.libreoffice import converted
from fixtures.marks import by_day
from fixtures.paths import DATA
from fixtures.workbooks import (
    edit,
    findings_of,
    formula_cells,
    make,
    pack,
    parts,
    put,
    retitle,
    type_into,
    with_addresses,
)
from report.project.model.choices import UnitsFirst
from report.project.read.archive import open_book
from report.project.read.positions import CellPosition
from report.project.read.read import read
from report.project.write.filled import filled
from report.project.write.overwritten import formula_findings as findings
from report.project.write.overwritten import overwritten


def lost(path):
    """Cells without their formula, as addresses."""
    return [item.position.address for item in overwritten(open_book(path))]


def formulas(path):
    """Every formula of a workbook by cell."""
    book = open_book(path)
    return {f"{t}!{c}": book.formula(t, c) for t, scan in book.scans.items() for c in scan.formulas}


@pytest.mark.nightly
@pytest.mark.parametrize("units", by_day(UnitsFirst, 1))
def test_every_blue_cell_of_a_new_workbook_that_loses_its_formula_is_named(tmp_path, units):
    path = make(tmp_path, units)
    assert lost(path) == []
    blue = formulas(path).keys()
    edit(path, lambda book: [setattr(one, "value", None) for one in formula_cells(book)])
    assert set(lost(path)) == blue
    assert len(blue) > 150


def typed_over(book):
    """What a person does: a value, nothing, a column that is deleted."""
    put(book, OVER)


RATIO = "Clearances/{}/D/C, prescriptive"
NEIGHBOR = "Clearances/1/Type"
FACTOR = "Provisions/Prescriptive displacement / (S_DS - 0.4)^2/In use"
OVER = {
    "Site/S_DS/Computed": 1.2,
    "Arrays/A1/Array type": None,
    NEIGHBOR: "=#REF!",
    RATIO.format(1): 0.5,
    RATIO.format(2): 0.5,
    RATIO.format(3): 0.5,
    FACTOR: 60,
}


def test_each_cell_is_named_with_what_is_in_it_and_what_belongs_there(tmp_path):
    path = edit(make(tmp_path), typed_over)
    found = overwritten(open_book(path))
    assert tuple(item.position.address for item in found) == with_addresses(*OVER)
    texts = {item.cell: item.text for item in findings(found)}
    ratios = ":".join(
        (
            workbooks.cell_address(RATIO.format(1)),
            workbooks.cell_address(RATIO.format(3)).partition("!")[2],
        )
    )
    for place, words in {
        "Site/S_DS/Computed": "the formula of S_DS, computed, was overwritten with 1.2",
        "Arrays/A1/Array type": "is blank, and its formula is gone",
        ratios: "D/C, prescriptive (3 cells) was overwritten with 0.5",
    }.items():
        assert words in texts[workbooks.cell_address(place)]
    fresh = "copy it from a new workbook (roofslip new FOLDER)"
    assert all(text.endswith(fresh) for text in texts.values())
    warned = commands.stdout_of("check", path)
    assert all(
        f"warning: {workbooks.cell_address(name)}: " in warned
        for name in ("Site/S_DS/Computed", FACTOR)
    )


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
            column = r"clearances_table\[+D/C, prescriptive\]+"
            found.value = re.sub(column, "#REF!", str(found.value))
        retitle(book, "Clearances", "D/C, prescriptive", "My column")

    path = edit(make(tmp_path), delete)
    texts = [item.text for item in findings(overwritten(open_book(path)))]
    assert any("refers to a column that is missing" in text for text in texts)


@pytest.mark.parametrize("name", by_day(["campus", "conditions", "example", "school"], 1))
def test_the_formulas_of_earlier_workbooks_are_no_reason_to_warn(tmp_path, name):
    path = tmp_path / "input.xlsx"
    path.write_bytes((DATA / "0.3.0" / f"{name}.xlsx").read_bytes())
    assert lost(path) == []
    computed = address(path, "Site/S_DS/Computed")
    assert lost(type_into(path, {computed: 1.2})) == [computed]


def test_a_color_that_a_program_saves_as_opaque_is_that_color(tmp_path):
    path = edit(make(tmp_path), typed_over)
    files = parts(path)
    assert b'rgb="00E3EDF5"' in files["xl/styles.xml"]
    files["xl/styles.xml"] = files["xl/styles.xml"].replace(b'rgb="00', b'rgb="FF')
    assert tuple(lost(pack(path, files))) == with_addresses(*OVER)


def saying(path, attributes):
    """Let a workbook say how it was calculated."""
    book = re.sub(rb"<calcPr[^>]*/>", b"<calcPr %b/>" % attributes, parts(path)["xl/workbook.xml"])
    return pack(path, parts(path) | {"xl/workbook.xml": book})


@pytest.fixture
def saved(tmp_path):
    return workbooks.saved_by_libreoffice(tmp_path)


def typed_formulas(path):
    """The cells of `saved` in which formulas were typed."""
    return [address(path, f"Arrays/{array}/Friction coefficient") for array in ("A1", "A2")]


CALCULATE = "calculate it (F9; in LibreOffice Ctrl+Shift+F9) and save it"
MANUAL = b'calcId="191029" calcMode="manual" calcCompleted="0"'


@pytest.mark.quick
def test_formulas_that_are_not_calculated_since_are_named(saved):
    first, second = typed_formulas(saved)
    ((name, _, text),) = findings_of(saved)  # the names of its records were changed
    assert name == "calculation"
    assert text.startswith(f"the workbook is set to recalculate when it is opened, and {first},")
    assert findings_of(saying(saved, MANUAL)) == [(
        "calculation", first,
        "the workbook was saved before its formulas were calculated (calculation is manual), and"
        f" {first}, {second} may show previous values: {CALCULATE}",
    )]  # fmt: skip
    ((_, _, text),) = findings_of(saying(saved, b'calcCompleted="false"'))
    assert text.startswith("the workbook was saved before its formulas were calculated, and Arrays")


@pytest.mark.parametrize(
    "says",
    [b"", b'calcMode="manual"', b'calcMode="manual" calcCompleted="1"', b'fullCalcOnLoad="0"'],
)
def test_a_workbook_that_was_calculated_is_no_warning(saved, says):
    assert findings_of(saying(saved, says)) == []


def test_computed_cells_alone_are_a_warning_in_manual_mode_and_none_in_a_fresh_workbook(tmp_path):
    path = make(tmp_path)
    assert findings_of(path) == []  # it asks to be calculated when it is opened
    assert findings_of(saying(path, MANUAL)) == [(
        "calculation", "Project",
        "the workbook was saved before its formulas were calculated (calculation is manual), and"
        f" its computed cells may show previous values: {CALCULATE}",
    )]  # fmt: skip


FIRST, SECOND = CellPosition("Arrays", 8, 5), CellPosition("Arrays", 9, 5)


def valued(path, formulas, at, value):
    """The values of cells, once a command has written another, in a workbook with such formulas."""
    files = parts(path)
    for name in files:
        for place, formula in formulas.items():
            old = rb'(<c r="%b"[^>]*><f[^>]*>)(?:0.4\+0.05|E8)(?=<)' % place.cell.encode()
            files[name] = re.sub(old, rb"\g<1>%b" % formula.encode(), files[name])
    book = filled(open_book(pack(path, files)), {at: value})
    path.write_bytes(book.data)
    assert [book.formula("Arrays", place.cell) for place in formulas] == [
        f"={unescape(formula)}" for formula in formulas.values()
    ]
    return [book.book["Arrays"][place.cell].value for place in formulas]


MAY_REFER = (
    "E8", "SUM($E$7:$E$8)", "'Arrays'!E8+0", "arrays!E8", "SUM(E:E)", 'INDIRECT("E"&amp;8)',
    "OFFSET(E7,1,0)", "TABLE()", "SUM(E7:INDEX(C7:C9,2))", "a_name", "SUM(arrays_table[Slope])",
    "SUM(Arrays:Site!E8)",
)  # fmt: skip
OTHERS = ("0.4+0.05", "C8+D9*0", "Site!E8+0.45", "SUM(E80:E88)+0.45")


@pytest.mark.parametrize("formula", by_day([*MAY_REFER, *OTHERS], 6))
def test_a_command_takes_the_value_of_a_formula_that_may_refer_to_what_it_wrote(saved, formula):
    kept = 0.45 if formula in OTHERS else None
    assert valued(saved, {SECOND: formula}, FIRST, 0.5) == [kept]


def test_a_formula_of_a_formula_loses_its_value_and_check_and_report_agree(saved, monkeypatch):
    monkeypatch.setattr("report.cli.progress.time.monotonic", lambda: 0.0)  # prints no progress
    slope = CellPosition("Arrays", 8, 3)
    assert valued(saved, {FIRST: "C8*0.9", SECOND: "E8"}, slope, 0.6) == [None, None]
    check, report = (commands.errors_of(name, saved) for name in ("check", "report"))
    assert check == report
    for place, formula in ((FIRST, "C8*0.9"), (SECOND, "E8")):
        assert f"{place.address}: friction coefficient is a formula with no saved value" in check
        assert f"(={formula}); open the workbook in Excel or LibreOffice and save it" in check


LINK = (
    b'<externalLink xmlns="http://schemas.openxmlformats.org/spreadsheetml/2006/main">%b'
    b"</externalLink>"
)
TARGET = (
    b'<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships">'
    b'<Relationship Id="rId1" Target="%b" TargetMode="External" Type="http://x/%b"/></Relationships>'
)
OUTSIDE = {
    "DDE cmd|/c calc": {"link": LINK % b'<ddeLink ddeService="cmd" ddeTopic="/c calc"/>'},
    "file:///C:/other.xlsx": {
        "_rels/link": TARGET % (b"file:///C:/other.xlsx", b"externalLinkPath")},
    "http://a.test/b.doc": {
        "link": LINK % b'<oleLink progId="Word"/>',
        "_rels/link": TARGET % (b"http://a.test/b.doc", b"oleObject")},
    "connection Query": {"link": b'<connections><connection name="Query"/></connections>'},
}  # fmt: skip


@pytest.mark.parametrize("name", by_day(OUTSIDE, 1))
def test_links_to_elsewhere_are_named(tmp_path, name):
    path = make(tmp_path)
    pack(path, parts(path) | {f"xl/links/{part}.xml": xml for part, xml in OUTSIDE[name].items()})
    assert findings_of(path) == [elsewhere(name)]


def elsewhere(name):
    text = f"the workbook refers to other sources ({name}), whose saved values are used:"
    return "outside", "Project", f"{text} type the values instead"


@pytest.mark.parametrize(
    "formula",
    by_day(["=cmd|'/c calc'!A0", "='cmd'|'/c calc'!A0", '=DDE("soffice","a.ods","A1")',
            "=1+rtd (1,2)", '=WEBSERVICE("http://a.test")'], 1),
)  # fmt: skip
def test_formulas_that_fetch_are_named_wherever_they_are(tmp_path, formula):
    path = make(tmp_path)
    edit(path, lambda book: book["Site"].cell(90, 60, formula))
    assert elsewhere(formula) in findings_of(path)


@pytest.mark.nightly
def test_a_bar_in_a_text_and_a_link_of_a_cell_fetch_nothing(tmp_path):
    formula = """="a|b"&'Ar|rays'!A1&"it's|" """
    assert not findings_of(edit(make(tmp_path), lambda book: book["Site"].cell(90, 60, formula)))

    def linked(book):
        book["Arrays"]["A1"].hyperlink = "http://a.test"

    assert not findings_of(edit(make(tmp_path), linked))


WEIGHT = "Arrays/A1/Weight"


@pytest.fixture(scope="module")
def all_saved(tmp_path_factory):
    """Workbooks by name, beside their records, as LibreOffice saves them in one start."""
    folder = tmp_path_factory.mktemp("saved")
    filled = type_into(make(folder), {WEIGHT: "=21000*2"}).rename(folder / "filled.xlsx")
    empty = workbooks.blank(folder / "blank.xlsx", UnitsFirst.SI)
    paths = converted([filled, empty], folder)
    (paths[0].parent / "records").symlink_to(folder / "records")
    return {path.stem: path for path in paths}


@pytest.mark.nightly
def test_what_libreoffice_saved_is_read_and_changed(all_saved):
    """With formulas as LibreOffice writes them, and the value of one that was typed."""
    assert workbooks.same(read(all_saved["filled"]).project, workbooks.project())
    book = all_saved["filled"].with_name("changed.xlsx")
    book.write_bytes(all_saved["filled"].read_bytes())
    before = read(book).project
    assert cell(load_workbook(book), WEIGHT).value == "=21000*2"
    after = read(type_into(book, {"Arrays/A1/x to": 99.0}))
    assert after.problems == ()
    first = after.project.arrays[0]
    assert first.x_to_m == pytest.approx(99 * 0.3048)
    assert first.weight_n == before.arrays[0].weight_n == pytest.approx(42000 * 4.4482216152605)
    assert after.project.arrays[1] == before.arrays[1]


@pytest.mark.nightly
def test_a_saved_book_gives_no_warning_but_of_what_is_typed_over(all_saved, tmp_path):
    book = all_saved["filled"]
    assert formulas(book) != formulas(make(tmp_path))  # it spells some of them in another way
    assert lost(all_saved["blank"]) == lost(book) == []
    for name in all_saved:
        sheet = read(all_saved[name])
        assert (sheet.unseen, sheet.warnings) == ((), ()), name
    spoiled = book.with_name("spoiled.xlsx")
    spoiled.write_bytes(book.read_bytes())
    assert tuple(lost(edit(spoiled, typed_over))) == with_addresses(*OVER)
