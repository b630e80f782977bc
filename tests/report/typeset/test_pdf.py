"""The PDF of a document: broken markup refused, nothing left."""

import io
import os
import subprocess
import sys
from xml.etree import ElementTree

import pytest
from pypdf import PdfReader

from report.typeset.equations import data_uri
from report.typeset.pdf import lay_out
from solver.model import DefectError

pytestmark = pytest.mark.quick


def page(body):
    return (
        "<html lang='en-US'><head><title>T</title><style>@font-face { font-family: 'Source Sans 3';"
        " src: url('shipped:/fonts/SourceSans3-Regular.ttf') } p { font-family: 'Source Sans 3' }"
        f"</style></head><body>{body}</body></html>"
    )


def test_broken_markup_is_an_error_and_not_mended():
    with pytest.raises(ElementTree.ParseError):
        lay_out('<html lang="en-US"><title>T</title><p>One page of text.</html>')


@pytest.mark.parametrize(
    ("body", "word"),
    [
        pytest.param("<p>\N{HIRAGANA LETTER A}</p>", "notdef", id="a glyph that no font has"),
        pytest.param("<p style='shade: red'>a</p>", "shade", id="an unknown property"),
        pytest.param("<img src='{}' alt='a'/>", "http", id="an address of the network"),
        pytest.param("<img src='shipped:/../pyproject.toml' alt='a'/>", "outside", id="a file"),
        pytest.param("<img src='file:///etc/hostname' alt='a'/>", "file:", id="a local file"),
        pytest.param("<img src='x.png' alt='a'/>", "x.png", id="a relative address"),
    ],
)
def test_what_the_renderer_warns_of_is_an_internal_error(body, word):
    with pytest.raises(DefectError, match=word):
        lay_out(page(body.format("http" + "://127.0.0.1/a.png")))


def test_a_picture_is_drawn_with_its_words():
    svg = (
        '<svg xmlns="http://www.w3.org/2000/svg" width="144pt" height="72pt" viewBox="0 0 144 72">'
        '<text x="70" y="30" style="font: 9px \'Source Sans 3\'">Array A2</text></svg>'
    )
    pdf = lay_out(page(f"<img src='{data_uri(svg)}' alt='A chart'/>"))
    assert "Array A2" in PdfReader(io.BytesIO(pdf)).pages[0].extract_text()


PROGRAM = """
import gc, sys
from report.typeset.pdf import lay_out
gc.disable()  # as commands do
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
