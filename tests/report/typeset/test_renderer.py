"""The renderer is loaded without processes, sets each line and writes each stream once."""

import subprocess
import sys
import zlib

import pytest

from report.typeset.pdf import lay_out
from report.typeset.renderer import LEVEL

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
        once.append(data)
        return compress(data, level)

    monkeypatch.setattr(zlib, "compress", counted)
    twice: list[int] = []
    compressor = zlib.compressobj

    def opened(level: int):
        twice.append(level)
        return compressor(level)

    monkeypatch.setattr(zlib, "compressobj", opened)
    html = '<html lang="en-US"><title>T</title><p>One page of text.</p></html>'
    assert b"One page of text" not in lay_out(html)
    assert len(set(once)) == len(once) >= 3  # the page, its color profile and a font
    # The list of objects for the identifier and in the file; their places.
    assert twice == [LEVEL] * 3


WORDS = """<html lang="en-US"><head><title>T</title><style>
@font-face { font-family: "Source Sans 3"; src: url("shipped:/fonts/SourceSans3-Regular.ttf"); }
p { font-family: "Source Sans 3"; {} }
</style></head><body><p>{}</p></body></html>"""


@pytest.mark.parametrize("style", ["", "text-align: justify", "letter-spacing: 2pt"])
def test_lines_that_are_kept_are_painted_as_if_they_were_set_again(monkeypatch, style):
    from weasyprint.text.line_break import Layout

    html = WORDS.replace("{}", style, 1).replace("{}", "Ballast moves, and comes to rest. " * 20)
    set_lines, setup = [], Layout.setup
    monkeypatch.setattr(Layout, "setup", lambda *about: set_lines.append(1) or setup(*about))
    kept, n_kept = lay_out(html), len(set_lines)

    def reactivate(self, style):
        self.setup(style)
        self.set_text(self.text, justify=True)

    monkeypatch.setattr(Layout, "reactivate", reactivate)
    assert lay_out(html) == kept
    assert len(set_lines) > 2 * n_kept
