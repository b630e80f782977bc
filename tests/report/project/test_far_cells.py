"""A formatted cell without content at the end of a sheet costs nothing, and changes nothing."""

import re

import pytest
from openpyxl.worksheet.worksheet import Worksheet

from fixtures import commands
from fixtures.workbooks import edit, make, pack, parts, problems, type_into
from report.project.read.archive import open_book
from report.project.read.scan import LAST_COLUMN, LAST_ROW
from report.project.write.overwritten import overwritten
from report.project.write.style import put_answer

ENDS = ((LAST_ROW, 1), (1, LAST_COLUMN), (LAST_ROW, LAST_COLUMN))
MOST_LOOKS = 300_000
"""Cells that a command may look at; up to the last of a sheet they are 17,179,869,184."""


def formatted(book):
    """What Ctrl+A and a format of the last cells leaves."""
    for sheet in book:
        for row, column in ENDS:
            sheet.cell(row, column).number_format = "0.00"


@pytest.fixture
def few_looks(monkeypatch):
    looked, usual = [], Worksheet.cell

    def cell(*place, **more):
        looked.append(place)
        assert len(looked) < MOST_LOOKS
        return usual(*place, **more)

    monkeypatch.setattr(Worksheet, "cell", cell)


MISSING = {"Motions/M1/Horizontal record": "records/nosuch.csv"}
COMMANDS = {
    "check": ("check", "PROJECT"),
    "clearances": ("plan", "clearances", "PROJECT"),
    "records": ("motion", "rows", "RECORDS", "PROJECT", "--at", "roof", "--units", "g",
                "--dt", "0.01"),
}  # fmt: skip


@pytest.mark.nightly
@pytest.mark.parametrize("name", COMMANDS)
def test_a_command_looks_only_at_cells_that_are_there(tmp_path, few_looks, name):
    ends = []
    for folder in (tmp_path / "plain", tmp_path / "far"):
        path = make(folder)
        for axis in "xyz":
            (folder / f"E-{axis}.csv").write_text((folder / "records/x.csv").read_text())
        if folder.name == "far":
            edit(path, formatted)
        places = {"PROJECT": path, "RECORDS": folder}
        done = commands.run(*(places.get(word, word) for word in COMMANDS[name]))
        told = re.sub(r"\b(plain|far)\b", "", done.output)
        ends.append((done.exit_code, re.sub(r"\[.*? s\] .*\n", "", told)))
    assert ends[0] == ends[1]
    assert ends[0][0] == 0


def test_a_record_that_is_missing_is_told_at_once(tmp_path, few_looks):
    path = edit(type_into(make(tmp_path), MISSING), formatted)
    assert "'records/nosuch.csv' does not exist" in problems(path)[0]


def test_a_blue_cell_without_content_is_told_wherever_it_is(tmp_path, few_looks):
    def change(book):
        put_answer(book["Site"].cell(LAST_ROW, LAST_COLUMN), "1")
        book["Site"].cell(LAST_ROW, LAST_COLUMN).value = None

    lost = overwritten(open_book(edit(make(tmp_path), change)))
    assert [item.position.address for item in lost] == ["Site!XFD1048576"]


@pytest.mark.parametrize("row", ['<row r="0"><c r="A0"/></row>', '<row r="-9"><c/></row>',
                                 '<row r="1048577"><c r="A1048577"/></row>',
                                 '<row r="9999"><c r="XFE9999"/></row>'])  # fmt: skip
def test_a_cell_beyond_the_ends_of_a_sheet_is_refused(tmp_path, row):
    path, name = make(tmp_path), "xl/worksheets/sheet4.xml"
    content = parts(path)
    content[name] = content[name].replace(b"</sheetData>", row.encode() + b"</sheetData>")
    again = "open it in Excel or LibreOffice and save it again"
    assert problems(pack(path, content)) == (f"damaged at {name}; {again}",)
