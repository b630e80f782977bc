"""Files that are not workbooks, or are malicious, are rejected early with the reason."""

import contextlib
import io
import os
import re
import subprocess
import sys
import zipfile
from functools import partial

import pytest
from openpyxl import DEFUSEDXML, LXML, load_workbook

from fixtures.cells import address, cell
from fixtures.marks import by_day
from fixtures.paths import ROOT
from fixtures.workbooks import (
    cell_address,
    edit,
    make,
    parts,
    problems,
    project,
    read_workbook,
    same,
)
from report.project.read.archive import open_book, sheet_parts
from report.project.read.read import read
from report.project.read.scan import MAX_CELLS, MAX_OTHERS, MAX_TAGS
from solver.errors import InputError

SAVE_AS = "save it as .xlsx (Excel Workbook)"
REOPEN = "open it in Excel or LibreOffice and save it again"
OLE = b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1" + bytes(600)


def zipped(**members: bytes | str) -> bytes:
    with zipfile.ZipFile(buffer := io.BytesIO(), "w", zipfile.ZIP_DEFLATED) as file:
        for name, data in members.items():
            file.writestr(name, data)
    return buffer.getvalue()


def rewritten(path, name, change):
    """Change one part of a workbook as bytes; a part that is not there is empty before."""
    members = parts(path)
    members[name] = change(members.get(name, b""))
    path.write_bytes(zipped(**members))
    return path


def sheet_part(path, title):
    with zipfile.ZipFile(path) as file:
        return dict(sheet_parts(file))[title]


@pytest.mark.quick
def test_openpyxl_reads_with_the_parser_of_python():
    assert not LXML  # also where it is installed
    assert not DEFUSEDXML  # in Python itself: the scan has refused entities by then


def test_a_notebook_that_loaded_openpyxl_first_reads_the_same_project():
    # As pandas does when it reads a workbook; openpyxl then parses with lxml.
    lines = (
        "import openpyxl, roofslip",
        "assert openpyxl.LXML",
        "print(repr(roofslip.read_project('projects/conditions').project))",
    )
    environment = {k: v for k, v in os.environ.items() if not k.startswith("OPENPYXL")}
    done = subprocess.run(
        [sys.executable, "-c", "; ".join(lines)],
        cwd=ROOT, env=environment, capture_output=True, text=True, check=True,
    )  # fmt: skip
    assert done.stdout.strip() == repr(read(ROOT / "projects/conditions").project)


TRUNCATED = f"not a workbook, or truncated; {REOPEN}"


@pytest.mark.parametrize(
    ("content", "line"),
    [
        (b"", "empty file; start again with a new workbook (roofslip new FOLDER)"),
        (b"name,number\n", TRUNCATED),
        (b"PK\x03\x04" + bytes(50), TRUNCATED),
        (OLE, f"an old Excel workbook (.xls) by its content; {SAVE_AS}"),
        (OLE + "EncryptedPackage".encode("utf-16-le"),
         "protected with a password; save it without a password"),
        (zipped(), f"a zip archive, but not a workbook; {SAVE_AS}"),
        (zipped(**{"a.txt": "a"}), f"a zip archive, but not a workbook; {SAVE_AS}"),
        (zipped(mimetype="x", **{"content.xml": "<a/>"}),
         f"an OpenDocument spreadsheet (.ods) by its content; {SAVE_AS}"),
        (zipped(**{"xl/workbook.bin": b"x"}),
         f"a binary Excel workbook (.xlsb) by its content; {SAVE_AS}"),
    ],
)  # fmt: skip
def test_a_file_that_is_not_a_workbook_is_identified_by_its_content(tmp_path, content, line):
    path = tmp_path / "input.xlsx"
    path.write_bytes(content)
    assert problems(path) == (line,)


@pytest.mark.parametrize(
    ("name", "kind"),
    [("input.csv", "a text file (.csv)"), ("input.XLSM", "a workbook with macros (.XLSM)"),
     ("input", "not a workbook file name (no extension)")],
)  # fmt: skip
def test_a_file_name_that_is_not_a_workbook_is_rejected(tmp_path, name, kind):
    path = make(tmp_path).rename(tmp_path / name)
    assert problems(path) == (f"{kind}; {SAVE_AS}",)


BOOK, RELATIONS, STYLES = "xl/workbook.xml", "xl/_rels/workbook.xml.rels", "xl/styles.xml"
BESIDE = "keep records in files next to it"
OTHERS = (
    f"xl/odd.xml: more than {MAX_OTHERS:,} comments, formats and the like; copy the inputs into a"
    " new workbook (roofslip new FOLDER)"
)


def to(content):
    """Give a part this content."""
    return lambda old: content


def replaced(old, new):
    return lambda content: content.replace(old, new)


# The part of a workbook that is changed, how, and the line.
SPOILED = {
    "macros under another name": (
        "xl/vbaProject.bin", to(b"macro"), f"a workbook with macros; {SAVE_AS}"),
    "macros by the types": (
        "[Content_Types].xml",
        replaced(b"spreadsheetml.sheet.main", b"sheet.macroEnabled.main"),
        f"a workbook with macros; {SAVE_AS}"),
    "strict": (
        BOOK,
        replaced(b"http://schemas.openxmlformats.org/spreadsheetml/2006/main",
                 b"http://purl.oclc.org/ooxml/spreadsheetml/main"),
        "a Strict Open XML workbook; save it as Excel Workbook (.xlsx), not Strict"),
    "a bomb by its directory": (
        "xl/media/zeros.bin", to(bytes(60_000_000)),
        f"unpacks to 60 MB, more than 100 MB in total or 50 MB in one part; {BESIDE}"),
    "a bomb by its ratio": (
        "xl/media/zeros.bin", to(bytes(40_000_000)),
        f"unpacks to more than 200 times its size; {REOPEN}"),
    "damaged": (STYLES, lambda old: old[:-50], f"damaged at {STYLES}; {REOPEN}"),
    "an unknown encoding": (
        STYLES, to(b'<?xml version="1.0" encoding="none"?><a/>'), f"damaged at {STYLES}; {REOPEN}"),
    "a prefix without a namespace": (
        BOOK, replaced(b"<sheet ", b"<x:sheet "), f"damaged at {BOOK}; {REOPEN}"),
    "two sheets of one name": (
        BOOK, replaced(b'name="Links"', b'name="arrays"'),
        "two worksheets have the name 'arrays'; rename one"),
    "a sheet without a part": (
        BOOK, lambda old: re.sub(rb'(<sheet [^>]*name="Links"[^>]*)r:id="[^"]*"', rb"\1", old),
        f"worksheet 'Links': its part (no name) is missing; {REOPEN}"),
    "cells": (
        "xl/odd.xml", to(b"<a>" + b"<c/>" * MAX_CELLS + b"</a>"),
        f"xl/odd.xml: more than {MAX_CELLS:,} cells and rows; {BESIDE}"),
    "comments": ("xl/odd.xml", to(b"<a>" + b"<b/>" * MAX_OTHERS + b"</a>"), OTHERS),
    "areas of a format": (
        "xl/odd.xml", to(b'<a sqref="%b"/>' % b" ".join([b"A1"] * MAX_OTHERS)), OTHERS),
}  # fmt: skip


@pytest.mark.parametrize("name", by_day(SPOILED, 5))
def test_a_workbook_with_a_spoiled_part_is_refused(tmp_path, name):
    part, change, line = SPOILED[name]
    assert problems(rewritten(make(tmp_path), part, change)) == (line,)


def test_harmless_parts_are_left_alone(tmp_path):
    """As every workbook of SheetJS has one."""
    default = b'<Default Extension="bin" ContentType="application/vnd.ms-excel.sheet.binary.'
    more = replaced(b"<Override", default + b'macroEnabled.main"/><Override')
    path = rewritten(make(tmp_path), "[Content_Types].xml", more)
    assert same(read_workbook(path).input, project())
    open_book(rewritten(make(tmp_path), "xl/media/image9.png", to(b"\x89PNG\r\n\x1a\n<")))


def test_tags_are_counted_before_anything_is_parsed(tmp_path):
    (line,) = problems(rewritten(make(tmp_path), "xl/no.xml", to(b"<" * MAX_TAGS)))
    assert line.endswith(f" XML tags, more than {MAX_TAGS:,}; {BESIDE}")


@pytest.mark.quick
@pytest.mark.parametrize(
    ("there", "asked", "told"),
    [
        ("job/Input.XLSX", "job", "did you mean '{}/job/Input.XLSX'?"),
        ("job/input.xls", "job", "'{}/job/input.xls' is an old Excel workbook; " + SAVE_AS),
        ("job/My Project.xlsx", "job", "did you mean '{}/job/My Project.xlsx'?"),
        ("job/input.xlsx", "job/records", "did you mean '{}/job/input.xlsx'?"),
        ("job/input.xlsx", "job/out", "did you mean '{}/job/input.xlsx'?"),
        ("job/A 101.xlsx", "job/roof.xlsx", "did you mean '{}/job/A 101.xlsx'?"),
        ("job.xlsx", "job", "did you mean '{}/job.xlsx'?"),
        ("job/~$input.xlsx", "job",
         "use a workbook, or a folder that contains input.xlsx"),
    ],
)  # fmt: skip
def test_a_workbook_that_is_there_is_suggested(tmp_path, there, asked, told):
    (tmp_path / "job" / "records").mkdir(parents=True)
    (tmp_path / "job" / "out").mkdir()
    (tmp_path / "job" / "out" / "results.xlsx").write_bytes(b"")
    (tmp_path / there).write_bytes(b"")
    lacks = "no such file" if asked.endswith(".xlsx") else "a folder without input.xlsx"
    assert problems(tmp_path / asked) == (f"{lacks}; {told.format(tmp_path)}",)


def test_a_missing_file_is_reported(tmp_path):
    wanted = "use a workbook, or a folder that contains input.xlsx"
    assert problems(tmp_path / "none.xlsx") == (f"no such file; {wanted}",)
    assert problems(tmp_path) == (f"a folder without input.xlsx; {wanted}",)
    os.mkfifo(tmp_path / "input.xlsx")
    assert problems(tmp_path) == (f"not a file; {wanted}",)


def test_odd_bytes_in_a_file_are_told_and_never_crash(tmp_path):
    path = make(tmp_path)
    data = path.read_bytes()
    path.write_bytes(data[:-2000])
    assert problems(path) == (TRUNCATED,)
    step = len(data) // 25
    for cut in range(step, len(data), step):
        path.write_bytes(data[:cut] + bytes([data[cut] ^ 0x55]) + data[cut + 1 :])
        with contextlib.suppress(InputError):
            read_workbook(path)


@pytest.mark.quick
def test_a_false_size_in_the_directory_has_no_effect(tmp_path):
    path = rewritten(make(tmp_path), "xl/sharedStrings.xml", lambda old: old + b" " * 10_000_000)
    data = path.read_bytes()
    with zipfile.ZipFile(path) as file:
        stated = file.getinfo("xl/sharedStrings.xml").file_size.to_bytes(4, "little")
    path.write_bytes(data.replace(stated, (1000).to_bytes(4, "little")))
    assert problems(path)[0].startswith("damaged at xl/sharedStrings.xml")


def test_a_workbook_of_too_many_parts_or_bytes_is_rejected(tmp_path):
    path = make(tmp_path)
    with zipfile.ZipFile(path, "a") as file:
        for number in range(2000):
            file.writestr(f"xl/part{number}", "")
    assert problems(path)[0].startswith("has 2")
    path = tmp_path / "input.xlsx"
    with path.open("wb") as file:
        file.truncate(101_000_000)
    assert problems(path) == ("larger than 100 MB; keep records in files next to it",)


LAUGHS = """<!DOCTYPE x [<!ENTITY a "ha"><!ENTITY b "&a;&a;&a;&a;">]>"""
OUTSIDE = """<!DOCTYPE x [<!ENTITY a SYSTEM "file:///etc/passwd">]>"""


@pytest.mark.parametrize("before", by_day(["", " " * 300], 1))
@pytest.mark.parametrize("encoding", by_day(["utf-8", "utf-16", "utf-16-be"], 2))
@pytest.mark.parametrize(
    ("part", "declaration"),
    [("xl/sharedStrings.xml", LAUGHS), ("xl/odd.bin", OUTSIDE), (BOOK, LAUGHS),
     (RELATIONS, OUTSIDE)],
)  # fmt: skip
def test_xml_entities_are_rejected(tmp_path, part, declaration, encoding, before):
    text = f"{before}{declaration}<x>&a;</x>".encode(encoding)
    path = rewritten(make(tmp_path), part, to(text))
    assert problems(path) == (f"contains XML entity declarations at {part}; {REOPEN}",)


@pytest.mark.parametrize(
    ("old", "new"),
    [(rb'<col ([^>]*)min="\d+"', rb'<col \1min="0"'), (rb"<pageMargins ", rb'<pageMargins a="1" '),
     (rb'<pane [^>]*state="frozen"', rb'<pane state="odd"')],
)  # fmt: skip
def test_what_openpyxl_says_reaches_nobody(tmp_path, old, new):
    path = make(tmp_path)
    part = sheet_part(path, "Arrays")
    assert re.search(old, parts(path)[part])
    (line,) = problems(rewritten(path, part, lambda xml: re.sub(old, new, xml, count=1)))
    assert line in (f"damaged, or not as Excel writes it; {REOPEN}", f"damaged at {part}; {REOPEN}")


def test_a_cell_or_a_name_that_the_file_has_twice_is_refused(tmp_path):
    path = make(tmp_path)
    name = cell_address("Options/1/Value")
    sheet, coordinate = name.split("!")
    cells = rb'<c r="%b"[^>]*?(?:/>|>.*?</c>)' % coordinate.encode()
    again = partial(re.sub, cells, rb"\g<0>\g<0>")
    assert problems(rewritten(path, sheet_part(path, sheet), again)) == (
        f"{name}: the file has this cell twice; {REOPEN}",
    )
    name = rb'<definedName name="site_s_ds_g"[^>]*>[^<]*</definedName>'
    path = rewritten(make(tmp_path), BOOK, partial(re.sub, name, rb"\g<0>\g<0>"))
    assert problems(path) == (f"the file contains the name site_s_ds_g twice; {REOPEN}",)


def far_away(book):
    book["Arrays"]["XFD1048576"] = 1


def test_a_value_in_the_last_cell_of_a_table_sheet_is_reported_at_once(tmp_path):
    assert problems(edit(make(tmp_path), far_away)) == (
        "Arrays!XFD1048576: contains data more than 2000 rows below the headings; clear it",
        "Arrays!XFD1048576: contains data beyond column GR; clear it",
    )


def test_what_is_odd_and_harmless_is_read_all_the_same(tmp_path):
    """All in one workbook: no two are on the same part of a sheet."""

    def change(book):
        book.create_sheet("Notes")["XFD1048576"] = 1
        book["Site"]["XFD1048576"] = 1  # far below single fields
        book["Arrays"].tables["arrays_table"].ref = "B7:O1048576"
        # An optional column that is blank is not there.
        book["Motions"].delete_cols(cell(book, "Motions/M1/Zero padding").column)
        name = cell(book, "Project/Project name")
        beside = name.offset(column=3).coordinate
        name.parent.merge_cells(f"{name.coordinate}:{beside}")
        # These fields are found by their labels.
        for field, text in {
            "project_name": "Project!#REF!", "site_i_e": "Gone!$B$5", "site_stories": '"',
            "site_s_1_g": "Site!$A:$XFD", "site_sdc": "Site!$B$0",
        }.items():  # fmt: skip
            book.defined_names[field].attr_text = text

    assert same(read_workbook(edit(make(tmp_path), change)).input, project())


MERGED = b'<mergeCells count="1"><mergeCell ref="%b"/></mergeCells>'
LINKED = b'<hyperlinks><hyperlink ref="A30:XFD1048576" location="x"/></hyperlinks>'


@pytest.mark.parametrize("xml", [MERGED % b"A30:XFD1048576", MERGED % b"A:XFD", LINKED])
@pytest.mark.quick
def test_a_range_over_a_whole_sheet_is_rejected_before_it_is_made(tmp_path, xml):
    path = make(tmp_path)
    part = sheet_part(path, "Site")
    wide = replaced(b"<dataValidations", xml + b"<dataValidations")
    (line,) = problems(rewritten(path, part, wide))
    assert line.startswith(f"{part}: merged cells or links over A")


def with_formula(part, place, typed, path):
    """Return a workbook whose cell has a formula, typed as a text or not, and a saved value."""
    cell = place.partition("!")[2]
    found = rf'<c r="{cell}"[^>]*?(?:/>|>.*?</c>)'
    made = f'<c r="{cell}"{typed}</c>'
    return rewritten(path, part, lambda data: re.sub(found, made, data.decode(), count=1).encode())


@pytest.mark.parametrize("saved", ["<v></v>", "<v/>"])
def test_a_formula_whose_value_is_an_empty_text_is_a_blank_cell(tmp_path, saved):
    path = make(tmp_path)
    blank, needed = (address(path, f"Arrays/A1/{name}") for name in ("Electrical slack", "Slope"))
    part, typed = sheet_part(path, "Arrays"), f' t="str"><f>IF(1=1,"",5)</f>{saved}'
    book = read_workbook(path := with_formula(part, blank, typed, path))
    assert book.input.arrays[0].slack_m is None
    path = with_formula(part, needed, typed, path)
    assert problems(path) == (f"{needed}: slope is missing; enter a number of 0 or more",)


@pytest.mark.parametrize("saved", ["<v></v>", "<v/>", ""])
def test_a_formula_that_was_never_computed_is_refused(tmp_path, saved):
    path = make(tmp_path)
    blank = address(path, "Arrays/A1/Electrical slack")
    path = with_formula(sheet_part(path, "Arrays"), blank, f"><f>40+20</f>{saved}", path)
    (line,) = problems(path)
    assert "is a formula with no saved value (=40+20)" in line


SHEET = b"""<worksheet xmlns="http://schemas.openxmlformats.org/spreadsheetml/2006/main"><sheetData>
<row r="1"><c r="A1"><f t="shared" ref="A1:A2" si="0">B1*$C$1</f><v>1</v></c></row>
<row r="2"><c r="A2"><f t="shared" si="0"/><v>2</v></c></row>
<row r="3"><c r="A3"><f t="array" ref="A3">SUM(B1:B2*2)</f><v>3</v></c></row>
<row r="4"><c r="A4"><f t="dataTable" ref="A4:A5"/><v>4</v></c></row>
<row><c/><c><f>1+\n1</f><v>5</v></c></row></sheetData></worksheet>"""


def test_formulas_are_those_that_openpyxl_reads_up_to_their_longest(tmp_path):
    path = make(tmp_path)
    rewritten(path, sheet_part(path, "Project"), to(SHEET))
    typed = load_workbook(path)["Project"]
    book = open_book(path)
    texts = [book.formula("Project", f"A{row}") for row in range(1, 5)]
    assert texts == ["=B1*$C$1", "=B2*$C$1", "=SUM(B1:B2*2)", "=TABLE()"]
    assert texts[:2] == [typed["A1"].value, typed["A2"].value]
    assert texts[2] == typed["A3"].value.text
    assert book.formula("Project", "B5") == typed["B5"].value == "=1+\n1"
    path = make(tmp_path)
    part = sheet_part(path, "Project")
    longest = SHEET.replace(b"B1*$C$1", b"B1" + b"+1" * 4095)
    rewritten(path, part, to(longest))
    assert open_book(path).formula("Project", "A2") == "=B2" + "+1" * 4095
    longer = to(longest.replace(b"B1+1", b"B1+1+11"))
    assert problems(rewritten(path, part, longer)) == (
        f"{part}: the formula in A1 has more than 8,192 characters; shorten it",
    )


def spelled(path, prefix):
    """Spell the target of the sheet Arrays with a prefix."""
    target = sheet_part(path, "Arrays").removeprefix("xl/").encode()
    spell = partial(re.sub, rb"(/xl/|)" + target, prefix + target)
    assert prefix + target in parts(rewritten(path, RELATIONS, spell))[RELATIONS]
    return path


@pytest.mark.parametrize("prefix", by_day([b"./", b"../xl/", b"../xl/./", b"/xl/"], 1))
def test_a_part_is_found_by_every_legal_spelling_of_its_target(tmp_path, prefix):
    path = spelled(make(tmp_path), prefix)
    assert [array.id for array in read_workbook(path).input.arrays] == ["A1", "A2"]
    assert problems(edit(path, far_away))[0].startswith("Arrays!XFD1048576: contains data more")


@pytest.mark.parametrize("change", [bytes.upper, replaced(b"s", b"%73"), to(b"gone.xml")])
@pytest.mark.parametrize(
    "title", by_day(["Arrays", "Clearances", "Building", "Spectrum", "Links"], 2)
)
def test_a_sheet_whose_part_is_not_there_is_refused_by_name(tmp_path, change, title):
    path = make(tmp_path)
    target = sheet_part(path, title).removeprefix("xl/").encode()
    (line,) = problems(rewritten(path, RELATIONS, replaced(target, change(target))))
    assert line.startswith(f"worksheet '{title}': its part ")
    assert line.endswith(f" is missing; {REOPEN}")


@pytest.mark.parametrize("encoding", by_day(["utf-16-be", "utf-16-le", "utf-16"], 1))
def test_a_part_is_scanned_in_every_encoding(tmp_path, encoding):
    path = edit(make(tmp_path), far_away)
    undeclared = partial(re.sub, rb"^<\?xml.*?\?>", b"")
    part = sheet_part(path, "Arrays")
    rewritten(path, part, lambda old: undeclared(old).decode().encode(encoding))
    assert problems(path)[0].startswith("Arrays!XFD1048576: contains data more than")
