"""From markup to PDF: what is refused, letters without a font, equations."""

import io
import os
import subprocess
import sys
from xml.etree import ElementTree

import pytest
from pypdf import PdfReader

from fixtures.commands import errors_of
from fixtures.workbooks import cell_address, make, type_into
from report.typeset.equations import data_uri, formula, fraction, symbol
from report.typeset.letters import undrawable
from report.typeset.pdf import lay_out
from solver.errors import DefectError


def page(body):
    return (
        "<html lang='en-US'><head><title>T</title><style>@font-face { font-family: 'Source Sans 3';"
        " src: url('shipped:/fonts/SourceSans3-Regular.ttf') } p { font-family: 'Source Sans 3' }"
        f"</style></head><body>{body}</body></html>"
    )


@pytest.mark.parametrize(
    ("body", "word"),
    [
        pytest.param("<p>\N{HIRAGANA LETTER A}</p>", "notdef", id="a glyph that no font has"),
        pytest.param("<p style='shade: red'>a</p>", "shade", id="an unknown property"),
        pytest.param("<img src='{}' alt='a'/>", "http", id="an address of the network"),
        pytest.param("<img src='shipped:/../pyproject.toml' alt='a'/>", "outside", id="a file"),
        pytest.param("<img src='file:///etc/hostname' alt='a'/>", "file:", id="a local file"),
    ],
)
def test_what_the_renderer_warns_of_is_an_internal_error(body, word):
    with pytest.raises(DefectError, match=word):
        lay_out(page(body.format("http" + "://127.0.0.1/a.png")))


def test_a_picture_is_drawn_with_its_words_and_broken_markup_is_an_error():
    svg = (
        '<svg xmlns="http://www.w3.org/2000/svg" width="144pt" height="72pt" viewBox="0 0 144 72">'
        '<text x="70" y="30" style="font: 9px \'Source Sans 3\'">Array A2</text></svg>'
    )
    pdf = lay_out(page(f"<img src='{data_uri(svg)}' alt='A chart'/>"))
    assert "Array A2" in PdfReader(io.BytesIO(pdf)).pages[0].extract_text()
    with pytest.raises(ElementTree.ParseError):
        lay_out('<html lang="en-US"><title>T</title><p>One page of text.</html>')


def test_no_line_ends_within_a_ratio_or_a_unit_and_a_reader_finds_them_as_they_are():
    sentence = "<p style='width: {}pt'>clearance (D/C 1.15) at 0.00 mm/s (0.00 in/s), least N/W</p>"
    pdf = lay_out(page("".join(sentence.format(width) for width in range(40, 130, 2))))
    text = "\n".join(sheet.extract_text() for sheet in PdfReader(io.BytesIO(pdf)).pages)
    assert "/\n" not in text
    assert text.count("D/C") == text.count("mm/s") == text.count("in/s") == text.count("N/W") == 45


PROGRAM = """
import gc, sys
from report.typeset.pdf import lay_out
gc.disable()  # files of fonts do not wait for a collection
assert lay_out(sys.argv[1]).startswith(b"%PDF")
gc.freeze()
"""


@pytest.mark.nightly
def test_a_process_that_laid_out_a_document_ends_without_a_word_and_leaves_no_fonts(tmp_path):
    done = subprocess.run(
        [sys.executable, "-c", PROGRAM, page("<p>a</p>")],
        env=os.environ | {"TMPDIR": str(tmp_path)},
        capture_output=True,
        text=True,
        check=True,
    )
    assert done.stderr == ""
    assert list(tmp_path.iterdir()) == []


def test_a_formula_is_one_outline_with_its_bars_and_a_symbol_has_its_subscript():
    made = formula(r"\Delta=\frac{1}{n}\sum_{i=1}^{n}\mathrm{PRD}_i")
    assert made["svg"].count("<path") == 1
    assert "<use" not in made["svg"]
    assert "<text" not in made["svg"]
    with_bar, without = formula(r"\frac{a}{b}"), formula(r"ab")
    assert "h" in with_bar["svg"].split(' d="')[1].split('"')[0]
    assert "h" not in without["svg"].split(' d="')[1].split('"')[0]
    short, long = formula("N"), formula(r"N=m g\cos\theta")
    assert 0 < short["width_pt"] < long["width_pt"]
    assert short["height_pt"] > 0
    assert "&lt;b&gt;" in fraction("<b>", "2")
    assert "<b>" not in fraction("1", "<b>")
    assert symbol("z") == "<i>z</i>"
    assert symbol("a_<b>") == "<i>a</i><sub>&lt;b&gt;</sub>"


@pytest.fixture
def fonts(tmp_path, monkeypatch):
    """A function that gives the machine an `fc-list` with one more letter; it counts its calls.

    What the machine has said of a letter is kept: each test asks for letters of its own.
    """
    calls = tmp_path / "calls"

    def have(letter=""):
        known = f":charset={ord(letter):x}" if letter else "none"
        program = tmp_path / "bin" / "fc-list"
        program.parent.mkdir()
        answer = f'[ "$1" = {known} ] && echo A Font'
        program.write_text(f"#!/bin/sh\necho asked >> {calls}\n{answer}\nexit 0\n")
        program.chmod(0o755)
        monkeypatch.setenv("PATH", str(program.parent))
        return lambda: calls.read_text().count("asked") if calls.exists() else 0

    return have


@pytest.mark.quick
def test_letters_of_a_package_or_else_of_a_font_of_the_machine_can_be_drawn(fonts):
    asked = fonts("倉")
    assert undrawable("Alameda Warehouse, 3° slope, ½ in, μ = 0.45 — Łódź, Ωδ") == ""
    assert asked() == 0
    assert undrawable("倉庫倉") == "庫"
    assert asked() == 2


@pytest.mark.quick
def test_without_fontconfig_only_the_letters_of_a_package_can_be_drawn(monkeypatch, tmp_path):
    monkeypatch.setenv("PATH", str(tmp_path))
    assert undrawable("屋a根屋") == "屋根"


NUMBER, ID = "Project/Project number", "Motions/M1/ID"
NO_FONT = "no font of this machine has 棟 (U+68DF); install one that does, or use other"


@pytest.mark.parametrize(
    ("command", "cell", "typed", "line"),
    [
        ("report", NUMBER, "棟 7", NO_FONT),
        ("check", ID, "蔵1", "the font of the figures does not have 蔵 (U+8535); write"),
    ],
)
def test_a_cell_with_letters_without_a_font_is_named(tmp_path, fonts, command, cell, typed, line):
    """An ID is in the figures, whose font is the only one there."""
    fonts("蔵")
    told = errors_of(command, type_into(make(tmp_path), {cell: typed}))
    assert cell_address(f"<{cell}>: {line}") in told
    assert not (tmp_path / "out").exists()


@pytest.mark.skipif(sys.platform != "linux", reason="other systems have no such names")
@pytest.mark.parametrize(("command", "name"), [("check", b"a\x01.xlsx"), ("report", b"a\xff.xlsx")])
def test_a_file_name_that_cannot_be_printed_is_refused_before_the_runs(tmp_path, command, name):
    book = make(tmp_path).rename(tmp_path / os.fsdecode(name))
    told = errors_of(command, book)
    assert "the file name: no font of this machine has" in told
    assert "rename the workbook" in told
