"""The echo of the input, and the list of records."""

import math

from report.motions.components import RecordFile
from report.pages import appendix
from report.sheet.read import EchoRow


def row(cell, label, typed="", value="—"):
    return EchoRow(sheet="S", cell=cell, label=label, typed=typed, unit="", value=value)


def lines(*rows):
    ((sheet, text),) = appendix.echo(rows)
    assert sheet == "S"
    return [" ".join(line.split()) for line in text.splitlines()[1:]]


def test_cells_left_blank_side_by_side_share_a_line_with_their_defaults():
    printed = lines(
        row("B8", "ID", "M1", "M1"),
        row("C8", "Keep from"),
        row("D8", "Baseline", value="none (default)"),
        row("E8", "Filter order", value="4 (default)"),
    )
    assert printed == [
        "B8 ID M1 M1",
        "C8:E8 Keep from to Filter order 3 cells left blank Baseline: none; Filter order: 4",
    ]


def test_columns_never_run_together():
    label = "Friction at speed to Model"
    ((_, text),) = appendix.echo((row("AA10:AB10", label, "x" * 80, "y" * 80),))
    first = text.splitlines()[1]
    assert first.startswith("AA10:AB10  Friction at speed to  ")
    assert "x  " in first


def test_two_blank_cells_keep_their_lines():
    assert len(lines(row("C8", "a"), row("D8", "b"))) == 2


def test_blank_cells_of_other_rows_and_columns_do_not_join():
    printed = lines(row("C8", "a"), row("D8", "b"), row("B9", "c"), row("C9", "d"))
    assert len(printed) == 4
    assert len(lines(row("B5", "a"), row("B6", "b"), row("B7", "c"))) == 1


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
