"""Progress on the terminal."""

import warnings

import pytest

from report.cli.terminal import Progress, show_warnings
from sheets import make


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


def test_without_a_number_of_steps_there_is_no_bar(terminal, capsys):
    terminal()
    with Progress() as progress:
        progress("reading")
    shown = capsys.readouterr().err
    assert "reading" in shown
    assert "[" not in shown.replace("\x1b[", "")


@pytest.mark.parametrize(
    ("command", "steps"),
    [
        (["check", "{0}"], 3),
        (["motion", "suite", "{1}", "--sds=1", "--zh=1", "--code=pv1", "--count=2"], 4),
    ],
)
@pytest.mark.nightly
def test_the_bar_of_a_command_is_full_when_it_ends(tmp_path, bars, full_after, command, steps):
    """That of `new --example` is tested in test_cli.py."""
    paths = make(tmp_path / "old"), tmp_path / "new"
    assert bars(*(word.format(*paths) for word in command)) == full_after(steps)


def test_elsewhere_plain_lines_start_after_a_second(monkeypatch, capsys):
    now = iter((0.0, 0.9, 1.5))
    monkeypatch.setattr("report.cli.terminal.time.monotonic", lambda: next(now))
    progress = Progress(2)
    progress("reading")
    progress("running")
    assert capsys.readouterr().err == "[ 1.5 s] running\n"


def test_quiet_progress_prints_nothing(terminal, capsys):
    terminal()
    with Progress(2, quiet=True) as progress:
        progress("reading")
    assert capsys.readouterr().err == ""


def test_a_warning_to_the_user_is_one_line(monkeypatch, capsys):
    monkeypatch.setattr(warnings, "showwarning", lambda *_, **__: print("to developers"))
    show_warnings()
    warnings.showwarning(UserWarning("cannot be\x1bkept"), UserWarning, "cache.py", 49)
    warnings.showwarning(DeprecationWarning("old"), DeprecationWarning, "other.py", 1)
    shown = capsys.readouterr()
    assert shown.err == "warning: cannot be?kept\n"
    assert shown.out == "to developers\n"
