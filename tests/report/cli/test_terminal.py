"""Progress on the terminal."""

import sys
import time
import warnings
from itertools import groupby

import pytest

from report.cli.main import main
from report.cli.terminal import Progress, show_warnings
from sheets import make

pytestmark = pytest.mark.quick


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


def test_on_a_terminal_a_bar_grows_with_each_step_and_is_cleared(terminal, capsys):
    terminal()
    with Progress(4) as progress:
        for step in ("reading", "running", "writing"):
            progress(step)
    shown = capsys.readouterr().err.split("\r\x1b[2K")
    assert [line.partition("]")[0] for line in shown] == [
        "",
        "[" + "." * 20,
        "[" + "#" * 5 + "." * 15,
        "[" + "#" * 10 + "." * 10,
        "",
    ]
    assert shown[2].endswith(" s  running")


def shown_at(seconds, monkeypatch, capsys, progress):
    """The lines that a terminal shows of steps that begin at these times."""
    now = iter(seconds)
    monkeypatch.setattr("report.cli.terminal.time.monotonic", lambda: next(now))
    made = progress()
    for number in range(len(seconds) - 1):
        made(f"step {number}")
    return capsys.readouterr().err.split("\r\x1b[2K")[1:]


def test_the_time_left_follows_from_what_is_done_by_shares_of_steps(terminal, monkeypatch, capsys):
    terminal()
    times = (0.0, 1.0, 3.0, 320.0)
    lines = shown_at(times, monkeypatch, capsys, lambda: Progress(4))
    assert [line.partition("] ")[2] for line in lines] == [
        " 1.0 s  step 0",
        " 3.0 s, 9 s left  step 1",
        "320.0 s, 5 min left  step 2",
    ]
    terminal()
    lines = shown_at((0.0, 0.0, 9.0), monkeypatch, capsys, lambda: Progress((3, 1)))
    assert lines[1] == "[" + "#" * 15 + "." * 5 + "]  9.0 s, 3 s left  step 1"
    terminal()
    monkeypatch.setenv("COLUMNS", "30")
    lines = shown_at((0.0, 0.0), monkeypatch, capsys, lambda: Progress(4))
    assert lines == ["[" + "." * 20 + "]  0.0 s"]


@pytest.mark.nightly
def test_the_line_is_written_again_while_a_step_lasts(terminal, capsys):
    terminal()
    with Progress(2) as progress:
        progress("running")
        time.sleep(1.5)
    *lines, cleared = capsys.readouterr().err.split("\r\x1b[2K")[1:]
    assert len(lines) >= 2
    assert all(line.endswith("  running") for line in lines)
    assert cleared == ""


def test_there_is_no_bar_without_a_number_of_steps_or_where_quiet(terminal, capsys):
    terminal()
    with Progress() as progress:
        progress("reading")
    shown = capsys.readouterr().err
    assert "reading" in shown
    assert "[" not in shown.replace("\x1b[", "")
    terminal()
    with Progress(2, quiet=True) as progress:
        progress("reading")
    assert capsys.readouterr().err == ""


@pytest.mark.parametrize(
    ("command", "steps"),
    [
        (["check", "{0}"], 3),
        (["motion", "suite", "{1}", "--sds=1", "--zh=1", "--code=pv1", "--count=2"], 3),
    ],
)
@pytest.mark.nightly
def test_the_bar_of_a_command_is_full_when_it_ends(tmp_path, bars, command, steps):
    paths = make(tmp_path / "old"), tmp_path / "new"
    assert bars(*(word.format(*paths) for word in command)) == [
        20 * done // steps for done in range(steps)
    ]


def test_elsewhere_plain_lines_start_after_a_second_and_a_warning_is_one(monkeypatch, capsys):
    now = iter((0.0, 0.9, 1.5))
    monkeypatch.setattr("report.cli.terminal.time.monotonic", lambda: next(now))
    progress = Progress(2)
    progress("reading")
    progress("running")
    assert capsys.readouterr().err == "[ 1.5 s] running\n"
    monkeypatch.setattr(warnings, "showwarning", lambda *_, **__: print("to developers"))
    show_warnings()
    warnings.showwarning(UserWarning("cannot be\x1bkept"), UserWarning, "cache.py", 49)
    warnings.showwarning(DeprecationWarning("old"), DeprecationWarning, "other.py", 1)
    shown = capsys.readouterr()
    assert shown.err == "warning: cannot be?kept\n"
    assert shown.out == "to developers\n"
