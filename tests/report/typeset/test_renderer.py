"""The renderer is loaded without processes and writes each stream once; any version will do."""

import io
import re
import subprocess
import sys
import zlib
from types import SimpleNamespace
from xml.etree import ElementTree

import pydyf
import pytest
from pypdf import PdfReader

import packages
import stand_in
from report.typeset import renderer
from report.typeset.finish import LEVEL, finish
from report.typeset.pdf import draw_ahead, lay_out, pictures
from report.typeset.renderer import TRIED

PROGRAM = """
import subprocess
def refuse(*args, **kwargs):
    raise AssertionError(f"a process was started: {args}")
subprocess.Popen.__init__ = refuse
from ctypes.util import find_library
from report.typeset.renderer import load
load()
import ctypes.util, weasyprint
assert ctypes.util.find_library is find_library
"""


@pytest.mark.skipif(sys.platform != "linux", reason="other systems need to be asked")
def test_the_renderer_is_loaded_without_asking_a_compiler():
    subprocess.run([sys.executable, "-c", PROGRAM], check=True, timeout=60)


def test_streams_of_a_document_are_compressed_once(monkeypatch):
    once: list[bytes] = []
    compress = zlib.compress

    def counted(data: bytes, level: int) -> bytes:
        assert level == LEVEL
        once.append(data)
        return compress(data, level)

    monkeypatch.setattr(zlib, "compress", counted)
    others: list[int] = []
    compressor = zlib.compressobj

    def opened(level: int):
        others.append(level)
        return compressor(level)

    monkeypatch.setattr(zlib, "compressobj", opened)
    html = '<html lang="en-US"><title>T</title><p>One page of text.</p></html>'
    assert b"One page of text" not in lay_out(html)
    assert len(set(once)) == len(once) >= 3  # the page, its color profile and a font
    # The list of objects for the identifier and in the file; their places.
    assert len(others) == 3


UNTRIED = {"weasyprint": "0.1", "pydyf": "0.1"}


def words(pdf):
    return [page.extract_text() for page in PdfReader(io.BytesIO(pdf)).pages]


@pytest.mark.nightly("report/typeset/")
def test_a_renderer_that_was_not_tried_sets_the_same_pages(monkeypatch):
    html = stand_in.html(stand_in.book(shaking=stand_in.motions(1, seconds=8.0)))
    drawn = packages.drawn_ahead(html)
    tried = words(lay_out(html, drawn))
    monkeypatch.setattr(renderer, "TRIED", UNTRIED)
    assert draw_ahead(pictures(html)) == {}
    assert words(lay_out(html)) == tried
    # Nor does it matter if only this process has it.
    assert words(lay_out(html, drawn)) == tried


OTHERS = {"weasyprint": "97.6", "pydyf": "0.85.3"}


@pytest.mark.nightly("report/typeset/")
def test_a_report_with_a_renderer_that_was_not_tried_has_the_same_words_and_results(
    tmp_path_factory,
):
    versions = " ".join(f"{name}={version}" for name, version in OTHERS.items())
    found = packages.of_other_versions(tmp_path_factory, "conditions", versions)
    usual = packages.reported(tmp_path_factory, "conditions").out / "calc-package.pdf"

    assert any("weasyprint 97.6" in text for text in words(found))
    pages = [_of_these_versions(text) for text in words(found)]
    assert pages == [_of_these_versions(text) for text in words(usual.read_bytes())]
    assert _results(found) == _results(usual.read_bytes())


def _of_these_versions(text):
    """Return words with the versions of here, and no hash of the list of all versions."""
    for name, version in OTHERS.items():
        text = text.replace(f"{name} {version}", f"{name} {TRIED[name]}")
    return re.sub("SHA-256 [0-9a-f]{64}", "SHA-256", text)


def _results(pdf):
    return PdfReader(io.BytesIO(pdf)).attachments["results.json"]


def test_what_cannot_be_completed_in_another_renderers_pdf_is_said(monkeypatch):
    document = SimpleNamespace(pages=[])
    with pytest.raises(KeyError):
        finish(document, pydyf.PDF(), [])
    monkeypatch.setattr(renderer, "TRIED", UNTRIED)
    with pytest.warns(UserWarning, match="the PDF lacks the claim to be PDF/UA-1: WeasyPrint"):
        finish(document, pydyf.PDF(), [])


def test_broken_markup_is_an_error_and_not_mended():
    with pytest.raises(ElementTree.ParseError):
        lay_out('<html lang="en-US"><title>T</title><p>One page of text.</html>')
