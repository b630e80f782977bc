"""Live formulas that were typed over are found; those that were not are left alone."""

import re

import pytest
from click.testing import CliRunner

from cells import cell
from places import DATA
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
    put(book, OVER | {"Clearances/4/Neighbor": other})


RATIO = "Clearances/{}/D/C, prescriptive"
FACTOR = "Provisions/Factor on (S_DS - 0.4)^2 in the prescriptive displacement/In use"
OVER = {
    "Site/S_DS/Computed": 1.2,
    "Arrays/A1/Slope in degrees": None,
    "Clearances/2/Neighbor": "=B9&C9",
    "Clearances/4/Neighbor": None,
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
    texts = {item.cell: item.text for item in findings(found)}
    ratios = ":".join((at(RATIO.format(1)), at(RATIO.format(3)).partition("!")[2]))
    for place, words in {
        "Site/S_DS/Computed": "S_DS, computed, is 1.2, typed over its formula =IF(ISNUM",
        "Arrays/A1/Slope in degrees": "is blank, and its formula is gone: =IFERROR(",
        "Clearances/2/Neighbor": "Neighbor is =B9&C9, which is not its formula =IFERROR(IF",
        ratios: "D/C, prescriptive (3 cells) is 0.5, typed",
    }.items():
        assert words in texts[at(place)]
    assert all(
        text.endswith("; copy it from a fresh workbook (roofslip new FOLDER)")
        for text in texts.values()
    )


def test_check_warns_of_each(tmp_path):
    path = edit(make(tmp_path), typed_over)
    warned = check(path)
    assert warned.exit_code == 0
    for name in ("Site/S_DS/Computed", FACTOR):
        assert f"warning: {at(name)}: " in warned.output


def test_repair_is_answered_with_what_takes_its_place(tmp_path):
    path = make(tmp_path)
    before = path.read_bytes()
    done = check("--repair", path)
    assert done.exit_code == 2
    assert "copy it from a fresh workbook (roofslip new FOLDER)" in " ".join(done.output.split())
    assert path.read_bytes() == before


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


def test_a_formula_that_refers_to_a_deleted_column_is_named(tmp_path):
    def delete(book):
        for found in formula_cells(book):
            column = r"arrays_table\[+[^\[]*Slope in degrees\]+"
            found.value = re.sub(column, "#REF!", str(found.value))
        retitle(book, "Arrays", "Slope in degrees", "My column")

    path = edit(make(tmp_path), delete)
    texts = [item.text for item in findings(overwritten(open_book(path)))]
    assert any("refers to a column that is missing" in text for text in texts)


def test_a_workbook_of_0_1_has_no_live_formulas():
    assert lost(DATA / "input-0.1.xlsx") == []


def as_before(book):
    """Have a formula of an earlier version where that of today refers to a name that came later."""
    del book.defined_names["live_s_m1"]
    put(book, {"Site/S_D1/Computed": "=2-2"})


def test_a_workbook_keeps_the_formulas_of_its_version_without_a_warning(tmp_path):
    path = edit(make(tmp_path), as_before)
    assert lost(path) == []
    assert lost(type_into(path, {"Clearances/1/Neighbor": "mine"})) == [at("Clearances/1/Neighbor")]


@pytest.mark.parametrize("name", ["campus", "conditions", "example", "school"])
def test_the_formulas_of_158bb098_are_no_reason_to_warn(tmp_path, name):
    path = tmp_path / "input.xlsx"
    path.write_bytes((DATA / "158bb098" / f"{name}.xlsx").read_bytes())
    assert lost(path) == []
    assert lost(type_into(path, {"Site/S_DS/Computed": 1.2})) == [at("Site/S_DS/Computed")]
    assert lost(type_into(path, {"Arrays/A1/Status": "done", "Start/Site": 3})) == [
        at("Site/S_DS/Computed")
    ]


def test_a_wrong_formula_filled_down_is_found_although_the_cells_share_it(tmp_path):
    path = make(tmp_path)
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
