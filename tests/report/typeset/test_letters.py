"""Letters that no font has are named by cell before anything is run."""

import os
import sys

import pytest
from click.testing import CliRunner

from report.cli.main import main
from report.typeset.letters import undrawable
from sheets import at, make, type_into


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
        program.write_text(
            f'#!/bin/sh\necho asked >> {calls}\n[ "$1" = {known} ] && echo A Font\nexit 0\n'
        )
        program.chmod(0o755)
        monkeypatch.setenv("PATH", str(program.parent))
        return lambda: calls.read_text().count("asked") if calls.exists() else 0

    return have


@pytest.mark.quick
def test_the_letters_of_a_package_can_be_drawn_without_asking_the_machine(fonts):
    asked = fonts()
    assert undrawable("Alameda Warehouse, 3° slope, ½ in, μ = 0.45 — Łódź, Ωδ") == ""
    assert asked() == 0


@pytest.mark.quick
def test_a_letter_of_a_font_of_the_machine_can_be_drawn(fonts):
    asked = fonts("倉")
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
        ("check", NUMBER, "棟 7", NO_FONT),
        ("report", NUMBER, "棟 7", NO_FONT),
        ("check", ID, "蔵1", "the font of the figures does not have 蔵 (U+8535); write"),
    ],
)
def test_a_cell_with_letters_without_a_font_is_named(tmp_path, fonts, command, cell, typed, line):
    """An ID is in the figures, whose font is the only one there."""
    fonts("蔵")
    done = CliRunner().invoke(main, [command, str(type_into(make(tmp_path), {cell: typed}))])
    assert done.exit_code == 2
    assert at(f"<{cell}>: {line}") in done.output
    assert not (tmp_path / "out").exists()


@pytest.mark.skipif(sys.platform != "linux", reason="other systems have no such names")
@pytest.mark.parametrize("name", [b"a\x01.xlsx", b"a\xff.xlsx", "a\ufffe.xlsx".encode()])
@pytest.mark.parametrize("command", ["check", "report"])
def test_a_file_name_that_cannot_be_printed_is_refused_before_the_runs(tmp_path, command, name):
    book = make(tmp_path).rename(tmp_path / os.fsdecode(name))
    done = CliRunner().invoke(main, [command, str(book)])
    assert done.exit_code == 2, done.output
    assert "the file name: no font of this machine has" in done.output
    assert "rename the workbook" in done.output
