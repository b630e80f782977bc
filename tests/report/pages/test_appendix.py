"""The echo of the input, and the list of records."""

import math
from dataclasses import replace

import scenes
from printed import printed
from report.assessment.changes import NO_FORMER, Change, ChangeKind
from report.motions.components import RecordFile
from report.pages.registry import package_data
from report.sheet.read import EchoRow


def row(cell, label, typed="", value="—", unit="", unseen=""):
    return EchoRow(
        sheet="S", cell=cell, label=label, typed=typed, unit=unit, value=value, unseen=unseen
    )


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


def test_single_cells_stand_in_two_columns_with_their_units():
    made = table(
        row("B5", "S_S", "1.9575", "1.9575 g", "g"),
        row("B6", "S_1", "0.7", "0.7 g", "g"),
        row("B7", "Site class", "C", "C"),
    )
    assert [*made.cells] == [
        ("B5", "S_S", "1.9575 g", "B7", "Site class", "C"),
        ("B6", "S_1", "0.7 g", "", "", ""),
    ]


def test_a_cell_that_the_workbook_does_not_show_is_marked_with_how():
    made = table(
        row("B5", "S_S", "1.5", "1.5 g", "g", unseen="hidden"),
        row("B6", "S_1", "=B5/2 → 0.75", "0.75 g", "g", unseen="hidden, struck through"),
    )
    (cells,) = made.cells
    assert cells[2] == "1.5 g (hidden)"
    assert cells[5] == "=B5/2 → 0.75 g: 0.75 g (hidden, struck through)"


def test_a_column_of_which_one_cell_is_hidden_is_printed_row_by_row():
    made = table(
        row("B8", "ID", "A1", "A1"),
        row("C8", "Slack", "60", "1.524 m", "in"),
        row("B9", "ID", "A2", "A2", unseen="filtered out"),
        row("C9", "Slack", "60", "1.524 m", "in", unseen="filtered out"),
    )
    assert [*made.cells] == [
        ("8", "A1", "60"),
        ("9", "A2 (filtered out)", "60 (filtered out)"),
    ]


def test_cells_left_blank_share_a_note_with_their_defaults():
    made = table(
        row("B5", "Name", "A", "A"),
        row("B6", "Checked by"),
        row("B7", "Hazard basis", value="mapped values (default)"),
    )
    assert made.notes == ("Left blank: B6 Checked by; B7 Hazard basis = mapped values.",)


def test_a_table_of_the_workbook_stands_as_it_is_there():
    made = table(
        row("B8", "ID", "A1", "A1"),
        row("C8", "Weight", "100", "444.8 N", "lb"),
        row("D8", "Model", value="choose (default)"),
        row("B9", "ID", "A2", "A2"),
        row("C9", "Weight", "=2*C8", "889.6 N", "lb"),
        row("D9", "Model", value="choose (default)"),
    )
    assert made.headings == ("Row", "B ID", "C Weight [lb]")
    assert [*made.cells] == [
        ("8", "A1", "100"),
        ("9", "A2", "=2*C8: 889.6 N"),
    ]
    assert made.notes == ("Left blank: D Model = choose.",)


def test_a_column_blank_in_some_rows_shows_the_default_there():
    made = table(
        row("B8", "ID", "A1", "A1"),
        row("C8", "Model", "one axis", "one axis"),
        row("B9", "ID", "A2", "A2"),
        row("C9", "Model", value="choose (default)"),
    )
    assert [*made.cells] == [
        ("8", "A1", "one axis"),
        ("9", "A2", "choose (default)"),
    ]


ALIKE = (
    row("B8", "ID", "A1", "A1"),
    row("C8", "Slack", "60", "1.524 m", "in"),
    row("B9", "ID", "A2", "A2"),
    row("C9", "Slack", "60", "1.524 m", "in"),
)


def test_one_entry_in_every_row_is_printed_once():
    made = table(*ALIKE)
    assert [*made.cells] == [("8", "A1"), ("9", "A2")]
    assert made.notes == ("In every row: C Slack 60 in.",)


def test_an_entry_that_changed_stays_in_its_row():
    made = table(*ALIKE, changed={"S!C9"})
    assert [*made.cells] == [("8", "A1", "60"), ("9", "A2", "60")]
    assert (made.kinds, made.bold) == (("", "changed"), ("60",))


def test_the_cells_that_changed_are_bold_and_their_rows_marked():
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


def test_a_record_shows_its_format_and_what_was_noted():
    record = RecordFile(
        motion_id="M1",
        component="vertical",
        name="records/a.V2A | Up",
        sha256="ab" * 32,
        format="GeoNet V2A",
        npts=100,
        dt_s=0.02,
        peak_g=0.25,
        npts_trimmed=0,
        hold_s=math.nan,
        size=1000,
        spikes=(),
        others_g=0.25,
        notes=("uneven times were resampled",),
    )
    other = replace(record, motion_id="M2", npts=200, notes=())
    made = records(record)
    assert made.cells == (("M1", "vertical", "0.2500", "records/a.V2A | Up", "ab" * 32),)
    assert made.notes == (
        "Every record: Format GeoNet V2A, Samples 100, Step [s] 0.02.",
        "M1 vertical: uneven times were resampled",
    )
    made = records(record, other)
    assert made.column("Samples") == ["100", "200"]
    assert made.notes[0] == "Every record: Format GeoNet V2A, Step [s] 0.02."


def records(*files):
    done = scenes.package().assessment
    done = replace(done, shaking=replace(done.shaking, records=files))
    return printed(done, "records").table("Records as read")
