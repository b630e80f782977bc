"""Files that are not workbooks, or are malicious, are rejected early with the reason."""

import contextlib
import io
import os
import pickle
import re
import zipfile

import pytest
from openpyxl import DEFUSEDXML, LXML, load_workbook

from report.sheet import archive, scan
from report.sheet.archive import open_book
from sheets import edit, make, problems, project, read_workbook, same
from solver.model import InputError

SAVE_AS = "save it as .xlsx (Excel Workbook)"
REOPEN = "open it in Excel or LibreOffice and save it again"
OLE = b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1" + bytes(600)


def zipped(**members: bytes | str) -> bytes:
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w", zipfile.ZIP_DEFLATED) as file:
        for name, data in members.items():
            file.writestr(name, data)
    return buffer.getvalue()


def rewritten(path, name, change):
    """Change one part of a workbook as bytes; a part that is not there is empty before."""
    with zipfile.ZipFile(path) as file:
        members = {item: file.read(item) for item in file.namelist()}
    members[name] = change(members.get(name, b""))
    path.write_bytes(zipped(**members))
    return path


def sheet_part(path, title):
    with zipfile.ZipFile(path) as file:
        return dict(archive.sheet_parts(file))[title]


def test_an_open_workbook_reaches_another_process_without_its_cells(tmp_path):
    book = open_book(make(tmp_path))
    sent = pickle.dumps(book)
    assert len(sent) < 10_000
    arrived = pickle.loads(sent)
    assert (arrived.path, arrived.sha256) == (book.path, book.sha256)
    assert arrived.scans == {}


def test_openpyxl_reads_with_the_parser_of_python():
    assert not LXML  # also where it is installed
    assert not DEFUSEDXML  # in Python itself: the scan has refused entities by then


@pytest.mark.parametrize(
    ("content", "line"),
    [
        (b"", "empty file; start again from a fresh workbook (roofslip new)"),
        (b"name,number\n", f"not a workbook, or truncated; {REOPEN}"),
        (b"PK\x03\x04" + bytes(50), f"not a workbook, or truncated; {REOPEN}"),
        (OLE, f"an old Excel workbook (.xls) by its content; {SAVE_AS}"),
        (
            OLE + "EncryptedPackage".encode("utf-16-le"),
            "protected with a password; save it without one",
        ),
        (zipped(), f"a zip archive, but not a workbook; {SAVE_AS}"),
        (zipped(**{"a.txt": "a"}), f"a zip archive, but not a workbook; {SAVE_AS}"),
        (
            zipped(mimetype="x", **{"content.xml": "<a/>"}),
            f"an OpenDocument sheet (.ods) by its content; {SAVE_AS}",
        ),
        (
            zipped(**{"xl/workbook.bin": b"x"}),
            f"a binary Excel workbook (.xlsb) by its content; {SAVE_AS}",
        ),
    ],
)
def test_a_file_that_is_not_a_workbook_is_identified_by_its_content(tmp_path, content, line):
    path = tmp_path / "input.xlsx"
    path.write_bytes(content)
    assert problems(path) == (line,)


@pytest.mark.parametrize(
    ("name", "kind"),
    [
        ("input.xls", "an old Excel workbook (.xls)"),
        ("input.XLSM", "a workbook with macros (.XLSM)"),
        ("input.ods", "an OpenDocument sheet (.ods)"),
        ("input.csv", "a text file (.csv)"),
        ("input.pdf", "not a workbook file name (.pdf)"),
        ("input", "not a workbook file name (no extension)"),
    ],
)
def test_a_file_name_that_is_not_a_workbook_is_rejected(tmp_path, name, kind):
    path = make(tmp_path).rename(tmp_path / name)
    assert problems(path) == (f"{kind}; {SAVE_AS}",)


def test_macros_under_another_name_are_rejected(tmp_path):
    path = rewritten(make(tmp_path), "xl/vbaProject.bin", lambda old: b"macro")
    assert problems(path) == (f"a workbook with macros; {SAVE_AS}",)


def test_a_macro_workbook_by_its_types_is_rejected(tmp_path):
    path = rewritten(
        make(tmp_path),
        "[Content_Types].xml",
        lambda old: old.replace(b"spreadsheetml.sheet.main", b"sheet.macroEnabled.main"),
    )
    assert problems(path) == (f"a workbook with macros; {SAVE_AS}",)


def test_a_missing_file_is_reported(tmp_path):
    wanted = "give a workbook, or a folder that holds input.xlsx"
    assert problems(tmp_path / "none.xlsx") == (f"no such file; {wanted}",)
    assert problems(tmp_path) == (f"no such file; {wanted}",)
    os.mkfifo(tmp_path / "input.xlsx")
    assert problems(tmp_path) == (f"not a file; {wanted}",)


def test_a_truncated_file_is_reported(tmp_path):
    path = make(tmp_path)
    path.write_bytes(path.read_bytes()[:-2000])
    assert problems(path) == (f"not a workbook, or truncated; {REOPEN}",)


def test_a_file_with_changed_bytes_is_reported(tmp_path):
    path = make(tmp_path)
    data = bytearray(path.read_bytes())
    data[200:240] = bytes(40)
    path.write_bytes(data)
    assert problems(path)[0].endswith(REOPEN)


def test_damaged_files_are_read_or_rejected_but_never_crash(tmp_path):
    path = make(tmp_path)
    data = path.read_bytes()
    step = len(data) // 25
    for at in range(step, len(data), step):
        path.write_bytes(data[:at] + bytes([data[at] ^ 0x55]) + data[at + 1 :])
        with contextlib.suppress(InputError):
            read_workbook(path)


def test_a_zip_bomb_is_rejected_by_its_directory(tmp_path):
    path = rewritten(make(tmp_path), "xl/media/zeros.bin", lambda old: bytes(60_000_000))
    assert problems(path)[0].startswith(
        "unpacks to 61 MB, more than 100 MB in total or 50 MB in one"
    )


def test_a_part_with_an_excessive_compression_ratio_is_rejected(tmp_path):
    path = rewritten(make(tmp_path), "xl/media/zeros.bin", lambda old: bytes(40_000_000))
    assert problems(path) == (f"unpacks to more than 200 times its size; {REOPEN}",)


def test_a_false_size_in_the_directory_has_no_effect(tmp_path):
    path = rewritten(make(tmp_path), "xl/sharedStrings.xml", lambda old: old + b" " * 10_000_000)
    data = path.read_bytes()
    with zipfile.ZipFile(path) as file:
        stated = file.getinfo("xl/sharedStrings.xml").file_size.to_bytes(4, "little")
    path.write_bytes(data.replace(stated, (1000).to_bytes(4, "little")))
    assert problems(path)[0].startswith("damaged at xl/sharedStrings.xml")


def test_a_workbook_of_too_many_parts_is_rejected(tmp_path):
    path = make(tmp_path)
    with zipfile.ZipFile(path, "a") as file:
        for number in range(2000):
            file.writestr(f"xl/part{number}", "")
    assert problems(path)[0].startswith("has 2")


def test_a_workbook_larger_than_any_input_is_rejected(tmp_path):
    path = tmp_path / "input.xlsx"
    with path.open("wb") as file:
        file.truncate(101_000_000)
    assert problems(path) == ("larger than 100 MB; keep records in files beside it",)


LAUGHS = """<!DOCTYPE x [<!ENTITY a "ha"><!ENTITY b "&a;&a;&a;&a;">]>"""
OUTSIDE = """<!DOCTYPE x [<!ENTITY a SYSTEM "file:///etc/passwd">]>"""


@pytest.mark.parametrize("before", ["", " " * 300])
@pytest.mark.parametrize("encoding", ["utf-8", "utf-16"])
@pytest.mark.parametrize("declaration", [LAUGHS, OUTSIDE])
@pytest.mark.parametrize("part", ["xl/sharedStrings.xml", "xl/styles.xml", "xl/odd.bin"])
def test_xml_entities_are_rejected(tmp_path, declaration, encoding, before, part):
    text = f"{before}{declaration}<x>&a;</x>"
    path = rewritten(make(tmp_path), part, lambda old: text.encode(encoding))
    assert problems(path) == (f"contains XML entity declarations at {part}; {REOPEN}",)


def test_parts_that_are_no_xml_are_left_alone(tmp_path):
    path = rewritten(make(tmp_path), "xl/media/image9.png", lambda old: b"\x89PNG\r\n\x1a\n<")
    open_book(path)


def test_a_table_that_does_not_say_where_it_is_is_found_by_its_headings(tmp_path):
    path = make(tmp_path)
    with zipfile.ZipFile(path) as file:
        tables = [name for name in file.namelist() if "/tables/" in name]
    for name in tables:
        rewritten(path, name, lambda part: re.sub(rb'(<table [^>]*?) ref="[^"]*"', rb"\1", part))
    assert same(read_workbook(path).input, project())


def test_damaged_xml_is_reported_by_its_part(tmp_path):
    path = rewritten(make(tmp_path), "xl/styles.xml", lambda old: old[:-50])
    assert problems(path) == (f"damaged at xl/styles.xml; {REOPEN}",)


@pytest.mark.parametrize("part", ["xl/workbook.xml", "xl/_rels/workbook.xml.rels"])
def test_a_prefix_without_a_namespace_is_reported_by_its_part(tmp_path, part):
    path = rewritten(make(tmp_path), part, lambda data: data.replace(b"<sheet ", b"<x:sheet ", 1)
                     .replace(b"<Relationship ", b"<x:Relationship ", 1))  # fmt: skip
    assert problems(path) == (f"damaged at {part}; {REOPEN}",)


def test_an_unknown_encoding_is_reported_by_its_part(tmp_path):
    path = rewritten(
        make(tmp_path), "xl/styles.xml", lambda old: b'<?xml version="1.0" encoding="none"?><a/>'
    )
    assert problems(path) == (f"damaged at xl/styles.xml; {REOPEN}",)


def test_a_workbook_that_openpyxl_cannot_read_is_reported(tmp_path):
    path = rewritten(make(tmp_path), "xl/styles.xml", lambda old: b"<styleSheet/>")
    (line,) = problems(path)
    assert line.startswith("damaged (")
    assert line.endswith(REOPEN)


def test_a_value_in_the_last_cell_of_a_table_sheet_is_reported_at_once(tmp_path):
    path = edit(make(tmp_path), lambda book: book["Arrays"].__setitem__("XFD1048576", 1))
    assert problems(path) == (
        "Arrays!XFD1048576: contains data more than 2000 rows below the headings; clear it",
        "Arrays!XFD1048576: contains data beyond column GR; clear it",
    )


def test_a_value_in_the_last_cell_of_another_sheet_is_ignored(tmp_path):
    def change(book):
        book.create_sheet("Notes")["XFD1048576"] = 1

    assert read_workbook(edit(make(tmp_path), change)).motions


def test_a_value_far_below_single_fields_is_ignored(tmp_path):
    path = edit(make(tmp_path), lambda book: book["Site"].__setitem__("XFD1048576", 1))
    assert read_workbook(path).motions


@pytest.mark.parametrize(
    "xml",
    [
        b'<mergeCells count="1"><mergeCell ref="A30:XFD1048576"/></mergeCells>',
        b'<mergeCells count="1"><mergeCell ref="A:XFD"/></mergeCells>',
        b'<hyperlinks><hyperlink ref="A30:XFD1048576" location="x"/></hyperlinks>',
    ],
)
def test_a_range_over_a_whole_sheet_is_rejected_before_it_is_made(tmp_path, xml):
    path = make(tmp_path)
    part = sheet_part(path, "Site")
    rewritten(path, part, lambda old: old.replace(b"<dataValidations", xml + b"<dataValidations"))
    (line,) = problems(path)
    assert line.startswith(f"{part}: merged cells or links over A")


def test_a_workbook_of_too_many_cells_is_rejected(tmp_path, monkeypatch):
    monkeypatch.setattr(scan, "MAX_CELLS", 500)
    assert problems(make(tmp_path))[0].endswith(
        "more than 500 cells and rows; keep records in files beside it"
    )


def test_a_table_that_claims_the_whole_sheet_costs_nothing(tmp_path):
    def change(book):
        book["Arrays"].tables["arrays_table"].ref = "B7:O1048576"

    assert read_workbook(edit(make(tmp_path), change)).motions


def test_a_field_with_a_broken_name_is_found_by_its_label(tmp_path):
    def change(book):
        book.defined_names["project_name"].attr_text = "Project!#REF!"
        book.defined_names["site_i_e"].attr_text = "Gone!$B$5"
        book.defined_names["site_s_1_g"].attr_text = "Site!$A:$XFD"
        book.defined_names["site_sdc"].attr_text = "Site!$B$0"
        book.defined_names["site_stories"].attr_text = '"'

    assert read_workbook(edit(make(tmp_path), change)).input.project.name == "Alameda Warehouse"


def test_a_formula_is_kept_beside_the_value_that_was_saved(tmp_path):
    path = edit(make(tmp_path), lambda book: book["Project"].__setitem__("H5", "=1+1"))
    book = open_book(path)
    assert book.formula("Project", "H5") == "=1+1"
    assert book.formula("Project", "H6") == ""
    assert book.book["Project"]["H5"].value is None


SHEET = b"""<worksheet xmlns="http://schemas.openxmlformats.org/spreadsheetml/2006/main"><sheetData>
<row r="1"><c r="A1"><f t="shared" ref="A1:A2" si="0">B1*$C$1</f><v>1</v></c></row>
<row r="2"><c r="A2"><f t="shared" si="0"/><v>2</v></c></row>
<row r="3"><c r="A3"><f t="array" ref="A3">SUM(B1:B2*2)</f><v>3</v></c></row>
<row r="4"><c r="A4"><f t="dataTable" ref="A4:A5"/><v>4</v></c></row>
<row><c/><c><f>1+\n1</f><v>5</v></c></row></sheetData></worksheet>"""


def test_formulas_of_every_kind_are_those_that_openpyxl_reads(tmp_path):
    path = make(tmp_path)
    rewritten(path, sheet_part(path, "Project"), lambda old: SHEET)
    typed = load_workbook(path)["Project"]
    book = open_book(path)
    texts = [book.formula("Project", f"A{row}") for row in range(1, 5)]
    assert texts == ["=B1*$C$1", "=B2*$C$1", "=SUM(B1:B2*2)", "=TABLE()"]
    assert texts[:2] == [typed["A1"].value, typed["A2"].value]
    assert texts[2] == typed["A3"].value.text
    assert book.formula("Project", "B5") == typed["B5"].value == "=1+\n1"


def relations(path, change):
    return rewritten(path, "xl/_rels/workbook.xml.rels", change)


def arrays_target(path):
    """The name of the part of sheet Arrays, relative to the workbook's folder."""
    return sheet_part(path, "Arrays").removeprefix("xl/").encode()


@pytest.mark.parametrize("prefix", [b"./", b"../xl/", b"../xl/./", b"/xl/"])
@pytest.mark.by_day(1)
def test_a_part_is_found_by_every_legal_spelling_of_its_target(tmp_path, prefix):
    path = make(tmp_path)
    target = arrays_target(path)
    relations(path, lambda old: re.sub(rb"(/xl/|)" + target, prefix + target, old))
    assert [array.id for array in read_workbook(path).input.arrays] == ["A1", "A2"]
    far = edit(path, lambda book: book["Arrays"].__setitem__("XFD1048576", 1))
    assert problems(far)[0].startswith("Arrays!XFD1048576: contains data more than")


@pytest.mark.parametrize("prefix", [b"/xl/./", b"/./xl/", b"/xl/worksheets/../"])
def test_a_part_is_found_where_openpyxl_keeps_the_dots_of_its_target(tmp_path, prefix):
    path = make(tmp_path)
    target = arrays_target(path)
    relations(path, lambda old: re.sub(rb"(/xl/|)" + target, prefix + target, old))
    assert prefix + target in zipfile.ZipFile(path).read("xl/_rels/workbook.xml.rels")
    assert [array.id for array in read_workbook(path).input.arrays] == ["A1", "A2"]


@pytest.mark.parametrize(
    "spelled",
    [lambda name: name.upper(), lambda name: name.replace(b"s", b"%73"), lambda name: b"gone.xml"],
)
@pytest.mark.parametrize("title", ["Arrays", "Clearances", "Building", "Spectrum", "Links"])
def test_a_sheet_whose_part_is_not_there_is_refused_by_name(tmp_path, spelled, title):
    path = make(tmp_path)
    target = sheet_part(path, title).removeprefix("xl/").encode()
    relations(path, lambda old: old.replace(target, spelled(target)))
    (line,) = problems(path)
    assert line.startswith(f"sheet '{title}': its part ")
    assert line.endswith(f" is missing; {REOPEN}")


def test_a_sheet_without_a_part_is_refused_by_name(tmp_path):
    path = rewritten(
        make(tmp_path),
        "xl/workbook.xml",
        lambda old: re.sub(rb'(<sheet [^>]*)r:id="[^"]*"', rb"\1", old),
    )
    assert problems(path)[0].endswith(f"its part (no name) is missing; {REOPEN}")


def test_two_sheets_of_one_name_are_refused(tmp_path):
    path = rewritten(
        make(tmp_path),
        "xl/workbook.xml",
        lambda old: old.replace(b'name="Links"', b'name="arrays"'),
    )
    assert problems(path) == ("two sheets have the name 'arrays'; rename one",)


@pytest.mark.parametrize("encoding", ["utf-16-be", "utf-16-le", "utf-16"])
def test_a_part_is_scanned_in_every_encoding(tmp_path, encoding):
    path = make(tmp_path)
    part = sheet_part(path, "Arrays")
    far = edit(path, lambda book: book["Arrays"].__setitem__("XFD1048576", 1))
    rewritten(far, part, lambda old: re.sub(r"^<\?xml.*?\?>", "", old.decode()).encode(encoding))
    assert problems(far)[0].startswith("Arrays!XFD1048576: contains data more than")


def test_entities_are_refused_in_utf_16_without_a_mark(tmp_path):
    text = '<!DOCTYPE x [<!ENTITY a "ha">]><x>&a;</x>'.encode("utf-16-be")
    for part in ("xl/workbook.xml", "xl/_rels/workbook.xml.rels", "xl/comments1.bin"):
        path = rewritten(make(tmp_path), part, lambda old: text)
        assert problems(path) == (f"contains XML entity declarations at {part}; {REOPEN}",)


def test_a_large_merge_in_another_encoding_is_refused_before_it_is_made(tmp_path):
    path = make(tmp_path)
    merge = '<mergeCells count="1"><mergeCell ref="G30:XFD1048576"/></mergeCells>'

    def change(old):
        text = re.sub(r"^<\?xml.*?\?>", "", old.decode())
        return text.replace("<dataValidations", merge + "<dataValidations").encode("utf-16-be")

    part = sheet_part(path, "Site")
    (line,) = problems(rewritten(path, part, change))
    assert line.startswith(f"{part}: merged cells or links over G30:XFD1048576")


def test_comments_and_formats_are_bounded_before_they_are_made(tmp_path, monkeypatch):
    monkeypatch.setattr(scan, "MAX_OTHERS", 50)
    assert "more than 50 comments, formats and the like" in problems(make(tmp_path))[0]


def test_tags_are_counted_before_anything_is_parsed(tmp_path, monkeypatch):
    monkeypatch.setattr(scan, "MAX_TAGS", 100)
    monkeypatch.setattr(scan, "_walk", lambda *_: pytest.fail("parsed"))
    (line,) = problems(make(tmp_path))
    assert line.endswith(" XML tags, more than 100; keep records in files beside it")


def test_strict_workbooks_are_refused_by_name(tmp_path):
    strict = b"http://purl.oclc.org/ooxml/spreadsheetml/main"
    main = b"http://schemas.openxmlformats.org/spreadsheetml/2006/main"
    path = rewritten(make(tmp_path), "xl/workbook.xml", lambda old: old.replace(main, strict))
    assert problems(path) == (
        "a Strict Open XML workbook; save it as Excel Workbook (.xlsx), not Strict",
    )


def test_a_formula_longer_than_excel_allows_is_refused_by_cell(tmp_path):
    path = make(tmp_path)
    part = sheet_part(path, "Project")
    longest = SHEET.replace(b"B1*$C$1", b"B1" + b"+1" * 4095)
    rewritten(path, part, lambda old: longest)
    assert open_book(path).formula("Project", "A2") == "=B2" + "+1" * 4095
    rewritten(path, part, lambda old: longest.replace(b"B1+1", b"B1+1+11"))
    assert problems(path) == (
        f"{part}: the formula in A1 has more than 8,192 characters; shorten it",
    )


def test_formats_of_too_many_areas_are_refused_before_they_are_made(tmp_path, monkeypatch):
    monkeypatch.setattr(scan, "MAX_OTHERS", 5000)
    path = make(tmp_path)
    part = sheet_part(path, "Site")
    assert read_workbook(path)
    areas = " ".join(f"A{row}" for row in range(1, 5001)).encode()
    xml = b'<conditionalFormatting sqref="' + areas + b'"/>'
    rewritten(path, part, lambda old: old.replace(b"<dataValidations", xml + b"<dataValidations"))
    assert "more than 5,000 comments, formats and the like" in problems(path)[0]
