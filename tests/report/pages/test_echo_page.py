"""The echo of the input."""

from dataclasses import replace

import pytest

import scenes
from printed import printed
from report.assessment.project import NO_FORMER, Change, ChangeKind
from report.pages.registry import package_data
from report.sheet.reading.read import EchoRow

pytestmark = pytest.mark.quick


def row(cell, label, typed="", value="", unit="", unseen=""):
    return EchoRow(
        sheet="S", cell=cell, label=label, typed=typed, unit=unit, value=value or typed or "—",
        unseen=unseen,
    )  # fmt: skip


def echo(*rows, changed=()):
    """The page of an echo, where cells at some addresses changed."""
    done = scenes.package().assessment
    done = replace(done, sheet=replace(done.sheet, echo=rows))
    items = (
        Change(kind=ChangeKind.INPUT, title="", before="", now="", cell=cell) for cell in changed
    )
    since = replace(NO_FORMER, revision="0", items=tuple(items))
    return printed(package_data(done, since), "echo")


def table(*rows, **changed):
    (made,) = echo(*rows, **changed).tables
    assert made.title == "S"
    return made


IDS = row("B8", "ID", "A1"), row("B9", "ID", "A2")
ALIKE = (IDS[0], row("C8", "Slack", "60", "1.524 m", "in"),
         IDS[1], row("C9", "Slack", "60", "1.524 m", "in"))  # fmt: skip


@pytest.mark.parametrize(
    ("rows", "cells", "notes"),
    [
        pytest.param(
            (row("B5", "S_S", "1.9575", "1.9575 g", "g"), row("B6", "S_1", "0.7", "0.7 g", "g"),
             row("B7", "Site class", "C")),
            [("B5", "S_S", "1.9575 g", "B7", "Site class", "C"),
             ("B6", "S_1", "0.7 g", "", "", "")],
            (),
            id="single cells stand in two columns with their units",
        ),
        pytest.param(
            (row("B5", "S_S", "1.5", "1.5 g", "g", unseen="hidden"),
             row("B6", "S_1", "=B5/2 → 0.75", "0.75 g", "g", unseen="hidden, struck through")),
            [("B5", "S_S", "1.5 g (hidden)",
              "B6", "S_1", "=B5/2 → 0.75 g: 0.75 g (hidden, struck through)")],
            (),
            id="a cell that the workbook does not show is marked with how",
        ),
        pytest.param(
            (*ALIKE[:2], *(replace(one, unseen="filtered out") for one in ALIKE[2:])),
            [("8", "A1", "60"), ("9", "A2 (filtered out)", "60 (filtered out)")],
            (),
            id="a column of which one cell is hidden is printed row by row",
        ),
        pytest.param(
            (row("B5", "Name", "A"), row("B6", "Checked by"),
             row("B7", "Hazard basis", value="mapped values (default)")),
            [("B5", "Name", "A", "", "", "")],
            ("Left blank: B6 Checked by; B7 Hazard basis = mapped values.",),
            id="cells left blank share a note with their defaults",
        ),
        pytest.param(
            (IDS[0], row("C8", "Weight", "100", "444.8 N", "lb"),
             row("D8", "Model", value="choose (default)"),
             IDS[1], row("C9", "Weight", "=2*C8", "889.6 N", "lb"),
             row("D9", "Model", value="choose (default)")),
            [("8", "A1", "100"), ("9", "A2", "=2*C8: 889.6 N")],
            ("Left blank: D Model = choose.",),
            id="a table of the workbook stands as it is there",
        ),
        pytest.param(
            (IDS[0], row("C8", "Model", "one axis"),
             IDS[1], row("C9", "Model", value="choose (default)")),
            [("8", "A1", "one axis"), ("9", "A2", "choose (default)")],
            (),
            id="a column blank in some rows shows the default there",
        ),
        pytest.param(
            ALIKE,
            [("8", "A1"), ("9", "A2")],
            ("In every row: C Slack 60 in.",),
            id="one entry in every row is printed once",
        ),
    ],
)  # fmt: skip
def test_cells_are_printed_as_they_were_entered(rows, cells, notes):
    made = table(*rows)
    assert [*made.cells] == cells
    assert made.notes == notes


def test_changed_cells_stay_in_their_rows_and_are_bold():
    made = table(*ALIKE, changed={"S!C9"})
    assert made.headings == ("Row", "B ID", "C Slack [in]")
    assert [*made.cells] == [("8", "A1", "60"), ("9", "A2", "60")]
    assert (made.kinds, made.bold) == (("", "changed"), ("60",))
    blank = (row("B7", "B7", value="3 (default)"), row("B8", "B8"))
    made = table(row("B5", "B5", "1", "1"), row("B6", "B6", "2", "2"), *blank,
                 changed={"S!B6", "S!B7", "T!B5"})  # fmt: skip
    assert [*made.cells] == [
        ("B5", "B5", "1", "B7", "B7", "3 (default)"), ("B6", "B6", "2", "", "", ""),
    ]  # fmt: skip
    assert (made.kinds, made.bold) == (("changed", "changed"), ("3 (default)", "2"))
    assert made.notes == ("Left blank: B8 B8.",)
    cells = (row("B8", "B", "a"), row("C8", "C", "<i>"), row("B9", "B", "b"), row("C9", "C", "d"))
    made = table(*cells, changed={"S!C8"})
    assert (made.kinds, made.bold) == (("changed", ""), ("<i>",))


def test_every_cell_of_a_wide_table_is_printed_beside_its_name():
    letters = "BCDEFGHIJKLM"
    rows = [
        row(f"{letter}{number}", f"{letter} of some length", f"{letter}-entry-{number}", "x")
        for number in range(8, 19)
        for letter in letters
    ]
    tables = echo(*rows).tables
    printed_cells = {cell for made in tables for line in made.cells for cell in line}
    assert {echoed.typed for echoed in rows} <= printed_cells
    assert len(tables) > 1
    assert {made.headings[1] for made in tables} == {"B B of some length"}
