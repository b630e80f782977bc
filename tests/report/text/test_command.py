"""Commands as the reader's shell takes them."""

import sys
from pathlib import PureWindowsPath

import pytest

from report.text.counts import quoted

pytestmark = pytest.mark.quick


@pytest.mark.parametrize(
    ("path", "typed"),
    [
        (r"C:\w\roof-1\input.xlsx", r"C:\w\roof-1\input.xlsx"),
        (r"C:\My projects\roof", r'"C:\My projects\roof"'),
        (r"C:\R&D\roof (2)", r'"C:\R&D\roof (2)"'),
        (r"C:\it's", r'''"C:\it's"'''),
    ],
)
def test_a_path_of_windows_has_the_quotes_of_cmd_and_powershell(monkeypatch, path, typed):
    monkeypatch.setattr(sys, "platform", "win32")
    assert quoted(PureWindowsPath(path)) == typed
