"""Letters that no font has are named by cell before anything is run."""

import os
import subprocess
import sys

import pytest
from click.testing import CliRunner

from report.cli.main import main
from report.typeset import letters
from report.typeset.letters import undrawable
from sheets import at, make, type_into


@pytest.fixture(autouse=True)
def forget():
    ask = letters._is_on_machine
    ask.cache_clear()
    yield
    ask.cache_clear()


def test_the_letters_of_a_package_can_be_drawn_without_asking_the_machine(monkeypatch):
    def asked(*arguments, **options):
        raise AssertionError("asked")

    monkeypatch.setattr(subprocess, "run", asked)
    assert undrawable("Alameda Warehouse, 3° slope, ½ in, μ = 0.45 — Łódź, Ωδ") == ""


def test_a_letter_of_a_font_of_the_machine_can_be_drawn(monkeypatch):
    def listed(command, **options):
        found = b"A Font\n" if command[1] == ":charset=5009" else b""
        return subprocess.CompletedProcess(command, 0, found)

    monkeypatch.setattr(subprocess, "run", listed)
    assert undrawable("倉庫") == "庫"


def test_without_fontconfig_only_the_letters_of_a_package_can_be_drawn(monkeypatch):
    def absent(*arguments, **options):
        raise FileNotFoundError

    monkeypatch.setattr(subprocess, "run", absent)
    assert undrawable("倉a庫倉") == "倉庫"


def test_an_id_has_only_letters_of_the_figures(tmp_path, monkeypatch):
    monkeypatch.setattr(letters, "_is_on_machine", lambda letter: True)
    book = type_into(make(tmp_path), {"Motions/M1/ID": "倉1"})
    done = CliRunner().invoke(main, ["check", str(book)])
    assert done.exit_code == 2
    line = "<Motions/M1/ID>: the font of the figures does not have 倉 (U+5009); write"
    assert at(line) in done.output


@pytest.mark.parametrize("command", ["check", "report"])
def test_a_cell_with_letters_without_a_font_is_named(tmp_path, monkeypatch, command):
    monkeypatch.setattr(letters, "_has_font", lambda letter: letter != "倉")
    book = type_into(make(tmp_path), {"Project/Project number": "倉 7"})
    done = CliRunner().invoke(main, [command, str(book)])
    assert done.exit_code == 2
    line = "<Project/Project number>: no font of this machine has 倉 (U+5009); install one that"
    assert at(line + " does, or use other") in done.output
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
