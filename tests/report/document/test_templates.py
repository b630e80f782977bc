"""Compiled templates are kept between processes, and a template that changed is compiled again."""

import subprocess
import sys

import pytest

from places import ROOT

pytestmark = pytest.mark.nightly

PRINT = """
import sys
from pathlib import Path
sys.dont_write_bytecode = False
from report.document.templates import rendered
print(rendered(Path({folder!r}), "page.html", {{"x": 2.345}}))
"""


@pytest.fixture
def kept():
    """Return the files of compiled templates that are new; the test leaves none."""
    folder = ROOT / "report" / "document" / "__pycache__"
    folder.mkdir(exist_ok=True)
    before = set(folder.glob("template-*.cache"))
    yield lambda: set(folder.glob("template-*.cache")) - before
    for path in set(folder.glob("template-*.cache")) - before:
        path.unlink()


def printed(folder):
    words = [sys.executable, "-c", PRINT.format(folder=str(folder))]
    done = subprocess.run(words, cwd=ROOT, capture_output=True, text=True, check=True)
    return done.stdout


def test_a_template_that_changed_is_compiled_again(tmp_path, kept):
    page = tmp_path / "page.html"
    page.write_text("{{ x | number(1) }} of {{ 1.25 | number(1) }}")
    first = printed(tmp_path)
    assert kept()
    assert printed(tmp_path) == first
    page.write_text("{{ x | number(2) }} & {{ '<' }}")
    assert printed(tmp_path) == "2.35 & &lt;\n"
