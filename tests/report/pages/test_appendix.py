"""The echo of the input, and the list of records."""

import math

from report.motions.components import RecordFile
from report.pages import appendix
from report.sheet.read import EchoRow


def row(cell, label, typed="", value="—", unit=""):
    return EchoRow(sheet="S", cell=cell, label=label, typed=typed, unit=unit, value=value)


def table(*rows):
    ((sheet, (made,)),) = appendix.echo(rows)
    assert sheet == "S"
    return made


def test_single_cells_stand_in_two_columns_with_their_units():
    made = table(
        row("B5", "S_S", "1.9575", "1.9575 g", "g"),
        row("B6", "S_1", "0.7", "0.7 g", "g"),
        row("B7", "Site class", "C", "C"),
    )
    assert [line.cells for line in made.rows] == [
        ("B5", "S_S", "1.9575 g", "B7", "Site class", "C"),
        ("B6", "S_1", "0.7 g", "", "", ""),
    ]


def test_cells_left_blank_share_a_note_with_their_defaults():
    made = table(
        row("B5", "Name", "A", "A"),
        row("B6", "Checked by"),
        row("B7", "Hazard basis", value="mapped values (default)"),
    )
    assert made.notes == ("Left blank: B6 Checked by; B7 Hazard basis = mapped values.",)


def test_a_table_of_the_workbook_has_a_line_for_each_column():
    made = table(
        row("B8", "ID", "A1", "A1"),
        row("C8", "Weight", "100", "444.8 N", "lb"),
        row("D8", "Model", value="choose (default)"),
        row("B9", "ID", "A2", "A2"),
        row("C9", "Weight", "=2*C8", "889.6 N", "lb"),
        row("D9", "Model", value="choose (default)"),
    )
    assert [column.head for column in made.columns] == ["Column", "Field", "Unit", "Row 8", "Row 9"]
    assert [line.cells for line in made.rows] == [
        ("B", "ID", "", "A1", "A2"),
        ("C", "Weight", "lb", "100", "=2*C8: 889.6 N"),
    ]
    assert made.notes == ("Left blank: D Model = choose.",)


def test_a_column_blank_in_some_rows_shows_the_default_there():
    made = table(
        row("B8", "ID", "A1", "A1"),
        row("C8", "Model", "one axis", "one axis"),
        row("B9", "ID", "A2", "A2"),
        row("C9", "Model", value="choose (default)"),
    )
    assert made.rows[1].cells == ("C", "Model", "", "one axis", "choose (default)")


def test_every_cell_of_a_long_table_is_printed():
    rows = [
        row(f"{letter}{number}", letter, f"{letter}-{number}", "x")
        for number in range(8, 19)
        for letter in "BC"
    ]
    ((_, tables),) = appendix.echo(rows)
    printed = {cell for made in tables for line in made.rows for cell in line.cells}
    assert {echoed.typed for echoed in rows} <= printed
    assert len(tables) == 3


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
        hold_s=math.nan,
        notes=("uneven times were resampled",),
    )
    text = " ".join(appendix.records([record]).split())
    assert "M1 vertical 100 0.02 0.2500 records/a.V2A | Up GeoNet V2A " + "ab" * 32 in text
    assert "note: uneven times were resampled" in text
