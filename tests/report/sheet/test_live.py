"""Live formulas that were typed over are found and restored; those that were not are left alone."""

import re

import pytest
from click.testing import CliRunner

from cells import cell
from places import DATA
from recalculated import recalculated_sheets
from report.cli.main import main
from report.sheet.reading.archive import open_book
from report.sheet.reading.formula_text import canonical, moved
from report.sheet.schema.choices import UnitsFirst
from report.sheet.writing.live import findings, live_formulas, overwritten
from sheets import at, blank, edit, formula_cells, make, pack, parts, put, retitle, said, type_into


def lost(path):
    """Cells without their formula, as addresses."""
    return [item.position.address for item in overwritten(open_book(path))]


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
    watched = {place.address: text for place, text in live_formulas(book).items()}
    assert watched == formulas_of(book)
    assert overwritten(book) == ()


def typed_over(book):
    """What a person does: a value, nothing, a formula of his own, one copied from elsewhere."""
    other = cell(book, "Clearances/1/Required, prescriptive").value
    put(book, OVER | {"Start/Friction tests": other})


WRONG_CELLS = {"Arrays/A1/Weight": None, "Clearances/1/Object": "nowhere"}
RATIO = "Clearances/{}/D/C, prescriptive"
FACTOR = "Provisions/Factor on (S_DS - 0.4)^2 in the prescriptive displacement/In use"
OVER = {
    "Start/Friction tests": None,
    "Site/S_DS/Computed": 1.2,
    "Arrays!A3": "done",  # the state of the sheet, below its title
    "Arrays/A1/Status": None,
    "Clearances/2/Neighbor": "=B9&C9",
    RATIO.format(1): 0.5,
    RATIO.format(2): 0.5,
    RATIO.format(3): "=H8",
    FACTOR: 60,
    "Tables/Arrays: Support spacing": "=#REF!",
}


def test_each_cell_is_named_with_what_is_in_it_and_what_belongs_there(tmp_path):
    path = edit(make(tmp_path), typed_over)
    found = overwritten(open_book(path))
    assert tuple(item.position.address for item in found) == said(*OVER)
    texts = {item.cell: item.text for item in findings(found, path)}
    ratios = ":".join((at(RATIO.format(1)), at(RATIO.format(3)).partition("!")[2]))
    for place, words in {
        "Site/S_DS/Computed": "S_DS, computed, is 1.2, typed over its formula =IF(ISNUM",
        "Arrays/A1/Status": "is blank, and its formula is gone: =status_arrays;",
        "Clearances/2/Neighbor": "Neighbor is =B9&C9, and its formula is =IFERROR(IF",
        ratios: "D/C, prescriptive (3 cells) is 0.5, typed",
    }.items():
        assert words in texts[at(place)]
    restores = f"; roofslip check --repair {path} restores it"
    assert all(text.endswith(restores) for text in texts.values())


def test_check_warns_and_repair_restores_every_formula_to_the_letter(tmp_path):
    path = make(tmp_path)
    before = formulas(path)
    edit(path, typed_over)
    warned = check(path)
    assert warned.exit_code == 0
    for name in ("Site/S_DS/Computed", FACTOR, "Start/Friction tests"):
        assert f"warning: {at(name)}: " in warned.output
    repaired = check("--repair", path)
    assert repaired.exit_code == 0
    assert repaired.output.startswith(f"{len(OVER)} formulas restored: {', '.join(said(*OVER))}\n")
    assert "--repair" not in repaired.output
    assert formulas(path) == before
    whole = path.read_bytes()
    assert check("--repair", path).output.startswith("0 formulas restored\n")
    assert path.read_bytes() == whole


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
    assert len(live_formulas(book)) == len(formulas_of(book))


def test_a_formula_that_is_moved_refers_to_the_rows_where_it_is():
    formula = '=INDEX($E6:$L6,1,MATCH(a1_x,rule_sets,0))+Arrays!$H$7&"A1"&t[[#This Row],[B2]]'
    after = '=INDEX($E10:$L10,1,MATCH(a1_x,rule_sets,0))+Arrays!$H$7&"A1"&t[[#This Row],[B2]]'
    assert moved(formula, 4) == after
    assert moved(after, -4) == formula


@pytest.mark.parametrize("formula", ["='Outlines'!$#REF!$0", "=}})", "=A1[", '="a', "="])
def test_a_formula_that_no_program_reads_stays_as_it_is(formula):
    assert canonical(formula) == moved(formula, 4) == formula


def test_a_formula_that_refers_to_a_deleted_column_is_named_and_not_repaired(tmp_path):
    def delete(book):
        for found in formula_cells(book):
            column = r"arrays_table\[+[^\[]*Slope in degrees\]+"
            found.value = re.sub(column, "#REF!", str(found.value))
        retitle(book, "Arrays", "Slope in degrees", "My column")

    path = edit(make(tmp_path), delete)
    texts = [item.text for item in findings(overwritten(open_book(path)), path)]
    assert any("refers to a column that is missing" in text for text in texts)
    before = path.read_bytes()
    assert check("--repair", path).output.startswith("0 formulas restored\n")
    assert path.read_bytes() == before


def test_a_workbook_of_0_1_has_no_live_formulas():
    assert lost(DATA / "input-0.1.xlsx") == []


def as_before(book):
    """Take the names of whether a cell is wrong, and count as a workbook did that lacked them."""
    for name in [n for n in book.defined_names if n.startswith(("wrong_", "undecided_"))]:
        del book.defined_names[name]
    put(book, {"Start/Project": "=2-2", "Motions!A3": '="No cells missing"'})


def test_a_workbook_keeps_the_formulas_of_its_version_without_a_warning(tmp_path):
    path = edit(make(tmp_path), as_before)
    assert lost(path) == []
    assert lost(type_into(path, {"Clearances/1/Neighbor": "mine"})) == [at("Clearances/1/Neighbor")]


def as_of_0_2(book):
    """Give each row the long formula of its status, in place of the name."""
    names = [name for name in book.defined_names if name.startswith("status_")]
    for found in formula_cells(book):
        if str(found.value).removeprefix("=") in names:
            found.value = '=IF(SUMPRODUCT(--(TRIM(A1:B1)<>""))=0,"",0)'
    for name in names:
        del book.defined_names[name]


def test_the_status_formulas_of_0_2_are_others_and_repair_writes_those_of_today(tmp_path):
    path = edit(make(tmp_path), as_of_0_2)
    assert said("Arrays/A1/Status")[0] in lost(path)
    assert "--repair" in check(path).output
    check("--repair", path)
    assert lost(path) == []


@pytest.mark.nightly("report/sheet/writing/needs.py", "report/sheet/writing/live.py")
def test_a_repaired_workbook_of_0_2_shows_the_ticks_of_today(tmp_path):
    given = WRONG_CELLS | {"Arrays/A2/Downslope direction": 400}
    now, was = (type_into(make(tmp_path / name), given) for name in ("now", "was"))
    check("--repair", edit(was, as_of_0_2))
    old, new = tmp_path / "old.xlsx", tmp_path / "new.xlsx"
    old.write_bytes(was.read_bytes())
    new.write_bytes(now.read_bytes())
    first, second = recalculated_sheets([old, new], tmp_path)
    assert first["Arrays"] == second["Arrays"]
    assert first["Clearances"] == second["Clearances"]
    assert first["Start"] == second["Start"]


def test_a_wrong_formula_filled_down_is_repaired_although_the_cells_share_it(tmp_path):
    path = make(tmp_path)
    before = formulas(path)
    files = parts(path)
    name = "xl/worksheets/sheet7.xml"
    places = said(RATIO.format(1), RATIO.format(2))
    first, second = (place.partition("!")[2] for place in places)
    for at_cell, formula in (
        (first, f'<f t="shared" ref="{first}:{second}" si="0">H8*2</f>'),
        (second, '<f t="shared" si="0"/>'),
    ):
        new = f'<c r="{at_cell}" t="n">{formula}<v>1</v></c>'.encode()
        old = rb'<c r="%b"[^>]*>.*?</c>' % at_cell.encode()
        files[name], count = re.subn(old, new, files[name])
        assert count == 1
    assert tuple(lost(pack(path, files))) == places
    assert check("--repair", path).output.startswith("2 formulas restored")
    assert formulas(path) == before


@pytest.mark.parametrize(
    ("one", "other", "is_same"),
    [
        ("=SUM(a_table[Status])", "=SUM(a_table[[Status]])", True),
        ("=x*0.000000001", "=x*1E-9", True),
        ("=x/47.88025898033584", "=X / 47.8802589803358", True),
        ("='Arrays'!$H$7", "=Arrays!H7", True),
        ("=t[[#This Row],[Weight '[lb']]]", "=t[[#this row], [Weight '[lb']]]", True),
        ('=IF(a="D",1,2)', '=IF(a="d",1,2)', False),
        ("=A1+B1", "=A1+B2", False),
        ("=x*1.0001", "=x", False),
        ("=t[[#This Row],[a]]", "=t[[#This Row],[b]]", False),
        ("=t[a]", "=t[[a]:[b]]", False),
    ],
)
def test_formulas_are_the_same_whatever_their_spelling(one, other, is_same):
    assert (canonical(one) == canonical(other)) is is_same
