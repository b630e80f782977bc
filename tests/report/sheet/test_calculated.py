"""A workbook that was saved before its formulas were calculated is a warning."""

import re
from xml.sax.saxutils import unescape

import pytest

import commands
from cells import address
from report.sheet.reading.archive import open_book
from report.sheet.reading.positions import CellPosition
from report.sheet.writing.filled import filled
from sheets import edit, formula_cells, make, pack, parts, saved_by_libreoffice, told


def saying(path, attributes):
    """Let a workbook say how it was calculated."""
    book = re.sub(rb"<calcPr[^>]*/>", b"<calcPr %b/>" % attributes, parts(path)["xl/workbook.xml"])
    return pack(path, parts(path) | {"xl/workbook.xml": book})


@pytest.fixture
def saved(tmp_path):
    return saved_by_libreoffice(tmp_path)


def typed(path):
    """The cells of `saved` in which formulas were typed."""
    return [address(path, f"Arrays/{array}/Friction coefficient") for array in ("A1", "A2")]


CALCULATE = "calculate it (F9; in LibreOffice Ctrl+Shift+F9) and save it"
MANUAL = b'calcId="191029" calcMode="manual" calcCompleted="0"'


@pytest.mark.quick
def test_formulas_that_manual_calculation_left_are_named(saved):
    first, second = typed(saved)
    assert told(saying(saved, MANUAL)) == [(
        "calculation", first,
        "the workbook was saved before its formulas were calculated (calculation is manual), and"
        f" {first}, {second} may show former values: {CALCULATE}",
    )]  # fmt: skip


@pytest.mark.quick
def test_a_calculation_that_was_stopped_is_a_warning_without_manual_mode(saved):
    ((_, _, text),) = told(saying(saved, b'calcCompleted="false"'))
    assert text.startswith("the workbook was saved before its formulas were calculated, and Arrays")


@pytest.mark.quick
def test_a_workbook_whose_values_were_changed_from_outside_asks_to_be_calculated(saved):
    ((name, _, text),) = told(saved)  # the names of its records were
    assert name == "calculation"
    first, _ = typed(saved)
    assert text.startswith(f"the workbook asks to be calculated when it is opened, and {first},")


@pytest.mark.parametrize(
    "says",
    [b"", b'calcMode="manual"', b'calcMode="manual" calcCompleted="1"', b'fullCalcOnLoad="0"'],
)
def test_a_workbook_that_was_calculated_is_no_warning(saved, says):
    assert told(saying(saved, says)) == []


def test_computed_cells_alone_are_a_warning_in_manual_mode_and_none_in_a_fresh_workbook(tmp_path):
    path = make(tmp_path)
    assert told(path) == []  # it asks to be calculated when it is opened
    assert told(saying(path, MANUAL)) == [(
        "calculation", "Project",
        "the workbook was saved before its formulas were calculated (calculation is manual), and"
        f" its computed cells may show former values: {CALCULATE}",
    )]  # fmt: skip


def test_a_workbook_without_formulas_has_none_that_was_not_calculated(tmp_path):
    def without(book):
        for sheet in book.worksheets:
            for table in sheet.tables.values():
                for column in table.tableColumns:
                    column.calculatedColumnFormula = None
        for cell in formula_cells(book):
            cell.value = None

    assert told(saying(edit(make(tmp_path), without), MANUAL)) == []


FIRST, SECOND = CellPosition("Arrays", 8, 5), CellPosition("Arrays", 9, 5)


def valued(path, formulas, at, value):
    """The values of cells, once a command has written another, in a workbook with such formulas."""
    files = parts(path)
    for name in files:
        for cell, formula in formulas.items():
            old = rb'(<c r="%b"[^>]*><f[^>]*>)(?:0.4\+0.05|E8)(?=<)' % cell.cell.encode()
            files[name] = re.sub(old, rb"\g<1>%b" % formula.encode(), files[name])
    book = filled(open_book(pack(path, files)), {at: value})
    path.write_bytes(book.data)
    assert [book.formula("Arrays", cell.cell) for cell in formulas] == [
        f"={unescape(formula)}" for formula in formulas.values()
    ]
    return [book.book["Arrays"][cell.cell].value for cell in formulas]


MAY_REFER = (
    "E8", "SUM($E$7:$E$8)", "'Arrays'!E8+0", "arrays!E8", "SUM(E:E)", 'INDIRECT("E"&amp;8)',
    "OFFSET(E7,1,0)", "TABLE()", "SUM(E7:INDEX(C7:C9,2))", "a_name", "SUM(arrays_table[Slope])",
    "SUM(Arrays:Site!E8)",
)  # fmt: skip
OTHERS = ("0.4+0.05", "C8+D9*0", "Site!E8+0.45", "SUM(E80:E88)+0.45")


@pytest.mark.parametrize("formula", [*MAY_REFER, *OTHERS])
def test_a_command_takes_the_value_of_a_formula_that_may_refer_to_what_it_wrote(saved, formula):
    kept = 0.45 if formula in OTHERS else None
    assert valued(saved, {SECOND: formula}, FIRST, 0.5) == [kept]


def test_a_formula_of_a_formula_loses_its_value_and_check_and_report_refuse_alike(saved):
    slope = CellPosition("Arrays", 8, 3)
    assert valued(saved, {FIRST: "C8*0.9", SECOND: "E8"}, slope, 0.6) == [None, None]
    check, report = (commands.refused(name, saved) for name in ("check", "report"))
    assert check == report
    for cell, formula in ((FIRST, "C8*0.9"), (SECOND, "E8")):
        assert f"{cell.address}: friction coefficient is a formula with no saved value" in check
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


@pytest.mark.parametrize("name", OUTSIDE)
def test_links_to_elsewhere_are_named(tmp_path, name):
    path = make(tmp_path)
    pack(path, parts(path) | {f"xl/links/{part}.xml": xml for part, xml in OUTSIDE[name].items()})
    assert told(path) == [elsewhere(name)]


def elsewhere(name):
    text = f"the workbook takes values from elsewhere ({name}), of which the saved ones are read:"
    return "outside", "Project", f"{text} type the values instead"


@pytest.mark.parametrize(
    "formula",
    ["=cmd|'/c calc'!A0", "='cmd'|'/c calc'!A0", '=DDE("soffice","a.ods","A1")', "=1+rtd (1,2)",
     '=WEBSERVICE("http://a.test")'],
)  # fmt: skip
def test_formulas_that_fetch_are_named_wherever_they_are(tmp_path, formula):
    path = make(tmp_path)
    edit(path, lambda book: book["Site"].cell(90, 60, formula))
    assert elsewhere(formula) in told(path)


def test_a_bar_in_a_text_and_a_link_of_a_cell_fetch_nothing(tmp_path):
    formula = """="a|b"&'Ar|rays'!A1&"it's|" """
    assert not told(edit(make(tmp_path), lambda book: book["Site"].cell(90, 60, formula)))

    def linked(book):
        book["Arrays"]["A1"].hyperlink = "http://a.test"

    assert not told(edit(make(tmp_path), linked))
