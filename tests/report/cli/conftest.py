"""Commands as on a terminal."""

import sys
from itertools import groupby

import pytest

from report.cli.main import main


@pytest.fixture
def terminal(monkeypatch):
    """A function that takes the captured output for that of a terminal."""
    return lambda: monkeypatch.setattr(sys.stderr, "isatty", lambda: True)


@pytest.fixture
def bars(terminal, monkeypatch, capsys):
    """A function that runs a command and returns how much of 20 is full at each of its steps."""

    def run(*words):
        terminal()
        for stream in ("stdout", "stderr"):
            monkeypatch.setattr(sys, stream, getattr(sys, stream))  # the command replaces it
        main(list(map(str, words)), standalone_mode=False)
        shown = capsys.readouterr().err.split("\r\x1b[2K")
        filled = [line.count("#") for line in shown if line.startswith("[")]
        return [count for count, _ in groupby(filled)]  # a line is written again every second

    return run


@pytest.fixture
def full_after():
    """A function that returns the bars of a command that is done after so many steps."""
    return lambda steps: [20 * done // steps for done in range(steps)]
