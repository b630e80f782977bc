"""Live formulas that were typed over are found and restored; those that were not are left alone."""

import re
import zipfile

import pytest
from click.testing import CliRunner

from places import DATA
from report.cli.main import main
from report.sheet.archive import open_book
from report.sheet.live import findings, live_formulas, overwritten
from report.sheet.schema import UnitsFirst
from report.sheet.spelling import canonical, moved
from sheets import blank, edit, make, type_into


def lost(path):
    """Cells without their formula, as addresses."""
    return [item.position.address for item in overwritten(open_book(path))]


def said(path):
    """The warnings by cell."""
    return {item.cell: item.text for item in findings(overwritten(open_book(path)))}


def check(*arguments):
    return CliRunner().invoke(main, ["check", *map(str, arguments)])


def formulas(path):
    """Every formula of a workbook by cell."""
    return formulas_of(open_book(path))


def formulas_of(book):
    return {f"{t}!{c}": book.formula(t, c) for t, scan in book.scans.items() for c in scan.formulas}


@pytest.mark.parametrize("units", list(UnitsFirst))
@pytest.mark.parametrize("is_filled", [False, True])
@pytest.mark.by_day(2)
def test_every_formula_of_a_new_workbook_is_watched_and_as_it_should_be(tmp_path, units, is_filled):
    path = make(tmp_path, units) if is_filled else blank(tmp_path / "input.xlsx", units)
    book = open_book(path)
    watched = {at.address: text for at, text in live_formulas(book).items()}
    assert watched == formulas_of(book)
    assert overwritten(book) == ()


def typed_over(book):
    """What a person does: a value, nothing, a formula of his own, one copied from elsewhere."""
    site, arrays, clearances = book["Site"], book["Arrays"], book["Clearances"]
    site["D13"] = 1.2
    arrays["A8"] = None
    clearances["F9"] = "=B9&C9"
    clearances["I8"], clearances["I9"], clearances["I10"] = 0.5, 0.5, "=H8"
    book["Provisions"]["C6"] = 60
    book["Tables"]["B82"] = "=#REF!"
    arrays["A3"] = "done"
    book["Start"]["E15"] = clearances["H8"].value


OVER = [
    "Start!E15", "Site!D13", "Arrays!A3", "Arrays!A8", "Clearances!F9", "Clearances!I8",
    "Clearances!I9", "Clearances!I10", "Provisions!C6", "Tables!B82",
]  # fmt: skip


def test_each_cell_is_named_with_what_is_in_it_and_what_belongs_there(tmp_path):
    found = overwritten(open_book(edit(make(tmp_path), typed_over)))
    assert [item.position.address for item in found] == OVER
    texts = {item.cell: item.text for item in findings(found)}
    assert texts["Site!D13"].startswith("S_DS, computed, is 1.2, typed over its formula =IF(ISNUM")
    assert "is blank, and its formula is gone: =IF(SUMPRODUCT" in texts["Arrays!A8"]
    assert texts["Clearances!F9"].startswith("Neighbor is =B9&C9, and its formula is =IFERROR(IF")
    assert texts["Clearances!I8:I10"].startswith("D/C, prescriptive (3 cells) is 0.5, typed")
    assert all(text.endswith("; roofslip check --repair restores it") for text in texts.values())


def test_check_warns_and_repair_restores_every_formula_to_the_letter(tmp_path):
    path = make(tmp_path)
    before = formulas(path)
    edit(path, typed_over)
    warned = check(path)
    assert warned.exit_code == 0
    for cell in ("Site!D13", "Clearances!I8:I10", "Provisions!C6", "Start!E15"):
        assert f"warning: {cell}: " in warned.output
    repaired = check("--repair", path)
    assert repaired.exit_code == 0
    assert repaired.output.startswith(f"{len(OVER)} formulas restored: {', '.join(OVER)}\n")
    assert "--repair" not in repaired.output
    assert formulas(path) == before
    whole = path.read_bytes()
    assert check("--repair", path).output.startswith("0 formulas restored\n")
    assert path.read_bytes() == whole


def parts(path):
    with zipfile.ZipFile(path) as archive:
        return {name: archive.read(name) for name in archive.namelist()}


def test_repair_changes_the_one_cell_and_keeps_its_format(tmp_path):
    path = make(tmp_path)
    type_into(path, {"Site!D13": 1.2})
    old = parts(path)
    assert check("--repair", "--quiet", path).output == ""
    new = parts(path)
    assert {name for name in old if old[name] != new[name]} == {"xl/worksheets/sheet3.xml"}
    cell = rb'<c r="D13"([^>]*)>.*?</c>'
    sheet = "xl/worksheets/sheet3.xml"
    assert re.sub(cell, b"", old[sheet]) == re.sub(cell, b"", new[sheet])
    style = [
        re.search(rb's="\d+"', re.search(cell, data)[1])[0] for data in (old[sheet], new[sheet])
    ]
    assert style[0] == style[1]


def test_a_renamed_sheet_other_units_and_new_rows_give_no_warning(tmp_path):
    def change(book):
        # As Excel does it: what refers to a heading or a sheet follows.
        book["Arrays"].title = "Our arrays"
        arrays = book["Our arrays"]
        arrays["H7"] = "Weight [kip]"
        arrays.tables["arrays_table"].tableColumns[7].name = "Weight [kip]"
        for name in book.defined_names:
            defined = book.defined_names[name]
            defined.attr_text = defined.attr_text.replace("'Arrays'", "'Our arrays'")
        for sheet in book:
            for cell in (cell for row in sheet.iter_rows() for cell in row):
                if cell.data_type == "f":
                    text = str(cell.value).replace("Weight '[lb']", "Weight '[kip']")
                    cell.value = text.replace("'Arrays'!", "'Our arrays'!")

    book = open_book(edit(make(tmp_path), change))
    assert overwritten(book) == ()
    assert len(live_formulas(book)) == len(formulas_of(book))


def test_a_formula_that_is_moved_refers_to_the_rows_where_it_is():
    formula = '=INDEX($E6:$L6,1,MATCH(a1_x,rule_sets,0))+Arrays!$H$7&"A1"&t[[#This Row],[B2]]'
    after = '=INDEX($E10:$L10,1,MATCH(a1_x,rule_sets,0))+Arrays!$H$7&"A1"&t[[#This Row],[B2]]'
    assert moved(formula, 4) == after
    assert moved(after, -4) == formula


def test_a_formula_that_refers_to_a_deleted_column_is_named_and_not_repaired(tmp_path):
    def delete(book):
        for sheet in book:
            for cell in (cell for row in sheet.iter_rows() for cell in row):
                if cell.data_type == "f" and "Slope in degrees" in str(cell.value):
                    cell.value = re.sub(
                        r"arrays_table\[+[^\[]*Slope in degrees\]+", "#REF!", cell.value
                    )
        book["Arrays"]["R7"] = "My column"
        book["Arrays"].tables["arrays_table"].tableColumns[17].name = "My column"

    path = edit(make(tmp_path), delete)
    texts = said(path)
    assert any("refers to a column that is missing" in text for text in texts.values())
    before = path.read_bytes()
    assert check("--repair", path).output.startswith("0 formulas restored\n")
    assert path.read_bytes() == before


def test_a_workbook_of_0_1_has_no_live_formulas():
    assert lost(DATA / "input-0.1.xlsx") == []


def test_a_wrong_formula_filled_down_is_repaired_although_the_cells_share_it(tmp_path):
    path = make(tmp_path)
    before = formulas(path)
    files = parts(path)
    name = "xl/worksheets/sheet7.xml"
    for row, formula in (
        ("8", '<f t="shared" ref="I8:I9" si="0">H8*2</f>'),
        ("9", '<f t="shared" si="0"/>'),
    ):
        new = f'<c r="I{row}" t="n">{formula}<v>1</v></c>'.encode()
        files[name], count = re.subn(rb'<c r="I%b"[^>]*>.*?</c>' % row.encode(), new, files[name])
        assert count == 1
    with zipfile.ZipFile(path, "w") as archive:
        for part, content in files.items():
            archive.writestr(part, content)
    assert lost(path) == ["Clearances!I8", "Clearances!I9"]
    assert check("--repair", path).output.startswith("2 formulas restored")
    assert formulas(path) == before


@pytest.mark.parametrize(
    ("one", "other"),
    [
        ("=SUM(a_table[Status])", "=SUM(a_table[[Status]])"),
        ("=x*0.000000001", "=x*1E-9"),
        ("=x/47.88025898033584", "=X / 47.8802589803358"),
        ("='Arrays'!$H$7", "=Arrays!H7"),
        ("=t[[#This Row],[Weight '[lb']]]", "=t[[#this row], [Weight '[lb']]]"),
    ],
)
def test_two_spellings_of_a_formula_are_the_same(one, other):
    assert canonical(one) == canonical(other)


@pytest.mark.parametrize(
    ("one", "other"),
    [
        ('=IF(a="D",1,2)', '=IF(a="d",1,2)'),
        ("=A1+B1", "=A1+B2"),
        ("=x*1.0001", "=x"),
        ("=t[[#This Row],[a]]", "=t[[#This Row],[b]]"),
        ("=t[a]", "=t[[a]:[b]]"),
    ],
)
def test_two_formulas_are_not_the_same(one, other):
    assert canonical(one) != canonical(other)
