"""What a person meets on the terminal: help, colors, names as typed, what may have been meant."""

import re

import click
import pytest
from click.testing import CliRunner

from commands import printed, refused
from places import ROOT
from report.cli.main import main
from report.text.counts import as_typed
from sheets import make

EXAMPLE = ROOT / "projects" / "example"
VERDICT = "\x1b[31m\x1b[1mNG\x1b[0m"


@pytest.mark.quick
def test_the_help_lists_every_command_under_a_title_with_its_whole_first_sentence():
    lines = printed("--help").splitlines()
    titles = [line[:-1] for line in lines if re.fullmatch(r"[A-Z]\w+:", line)]
    assert titles == ["Options", "Package", "Sheet", "Motions", "Studies", "Trust", "Installation"]
    words = " ".join(" ".join(lines).split())
    for name, command in main.commands.items():
        first = " ".join(command.help.partition("\n\n")[0].split())
        assert f" {name} {first}" in words


@pytest.mark.parametrize("words", [(), ("motion",), ("plan",)])
def test_no_help_is_cut(words):
    assert "..." not in printed(*words, "--help").replace("[ARGS]...", "")


def on_a_terminal(*words, env=None):
    """What a command prints where its output keeps its colors, as on a terminal."""
    return CliRunner(env=env).invoke(main, [str(word) for word in words], color=True).stdout


def test_levels_and_verdicts_are_colored_on_a_terminal_alone(tmp_path):
    book = make(tmp_path)
    assert "\x1b[33mwarning\x1b[0m: " in on_a_terminal("check", book)
    assert "\x1b" not in printed("check", book)
    from report.cli.terminal import colored

    assert colored("A1  0.8 in  NG: slope") == f"A1  0.8 in  {VERDICT}: slope"
    assert click.unstyle(colored("verdict: OK with conditions")) == "verdict: OK with conditions"
    assert colored("verdict: OK with conditions").count("\x1b[33m") == 1
    assert colored("a warning: TONG, BOOK, NORTH") == "a warning: TONG, BOOK, NORTH"


@pytest.mark.parametrize(("name", "value"), [("NO_COLOR", "1"), ("TERM", "dumb")])
def test_a_reader_may_want_no_color(tmp_path, monkeypatch, name, value):
    from report.cli.terminal import color_choice

    monkeypatch.delenv("NO_COLOR", raising=False)
    monkeypatch.setenv("TERM", "xterm")
    assert color_choice() is None
    monkeypatch.setenv(name, value)
    assert color_choice() is False


@pytest.mark.parametrize("shell", ["bash", "zsh", "fish"])
@pytest.mark.quick
def test_completion_prints_the_script_of_a_shell(shell):
    script = printed("completion", shell)
    assert "_ROOFSLIP_COMPLETE" in script
    assert f"{shell}_complete" in script


def test_the_shell_is_told_commands_and_options(monkeypatch):
    def completed(words, at):
        env = {"_ROOFSLIP_COMPLETE": "bash_complete", "COMP_WORDS": words, "COMP_CWORD": str(at)}
        return CliRunner(env=env).invoke(main, []).stdout.split()

    assert completed("roofslip ver", 1) == ["plain,verify", "plain,verify-package"]
    assert completed("roofslip motion su", 2) == ["plain,suite"]
    assert completed("roofslip report --fa", 2) == ["plain,--fail-on-ng"]


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (("rreport",), "No such command 'rreport'. Did you mean 'report'?"),
        (("report", "x", "--fail-on"), "Did you mean"),
        (("sign", "README.md", "--p12", "READNE.md"),
         "'READNE.md' does not exist; did you mean 'README.md'?"),
        (("verify", "--table", "docz"), "'docz' does not exist; did you mean 'docs'?"),
        (("check", "projects/exaample"), "did you mean 'projects/example'?"),
    ],
)  # fmt: skip
def test_a_word_that_is_not_known_is_answered_with_the_nearest(monkeypatch, words, told):
    monkeypatch.chdir(ROOT)
    assert told in refused(*words)


@pytest.mark.parametrize(
    ("options", "told"),
    [
        (("--slope-deg", 95, "--mu", 0.3),
         "'--slope-deg': it is 95 deg; give more than -45 deg and less"),
        (("--slope-deg", "nan", "--mu", 0.3), "'--slope-deg': it is nan deg"),
        (("--slope-deg", 2, "--mu", -0.3), "'--mu': it is -0.3; give 0 or more."),
        (("--slope-deg", 2, "--mu", 0.3, "--dt", 0), "'--dt': it is 0 s; give more than 0 s."),
        (("--slope-deg", 2, "--mu", 0.3, "--factor", "inf"), "it is inf; give a finite number."),
    ],
)  # fmt: skip
@pytest.mark.quick
def test_an_error_names_the_option_as_it_was_given_and_its_unit(options, told):
    assert told in refused("slide", EXAMPLE / "records" / "RM1-x.csv", *options)


@pytest.mark.parametrize("typed", ["roofslip", "./roofslip", "'my programs/roofslip'"])
def test_the_command_is_called_as_the_reader_typed_it(tmp_path, monkeypatch, typed):
    monkeypatch.setenv("ROOFSLIP_COMMAND", typed.strip("'"))
    assert f"then run: {typed} check {tmp_path}" in printed("new", tmp_path)
    told = printed("check", make(tmp_path / "filled"))
    assert told.splitlines()[-1].startswith(f"Next: {typed} report ")
    assert as_typed("Run roofslip check FOLDER.") == f"Run {typed} check FOLDER."
    assert (
        as_typed("the signature of Roofslip, roofslip.pdf")
        == "the signature of Roofslip, roofslip.pdf"
    )


def test_a_sheet_calls_the_command_as_it_was_typed(tmp_path, monkeypatch):
    from openpyxl import load_workbook

    monkeypatch.setenv("ROOFSLIP_COMMAND", "./roofslip")
    printed("new", tmp_path)
    book = load_workbook(tmp_path / "input.xlsx", read_only=True)
    start = "\n".join(str(cell) for row in book["Start"].values for cell in row)
    assert "Run ./roofslip check FOLDER, which" in start
    assert not re.search(r"(?<!/)roofslip [a-z]", start)
