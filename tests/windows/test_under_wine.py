"""The commands on Windows' own Python, under Wine, with the packages that Windows gets."""

import json
import os
import re
import shutil
import subprocess
from threading import Timer

import pytest
from click.testing import CliRunner
from pypdf import PdfReader
from wine import command, installed, on_windows, roofslip

from packages import reported
from places import ROOT, TESTS
from report.cli.main import main
from report.proof.contents import differences

pytestmark = pytest.mark.nightly

FOLDER = "Dach été μ 太陽"
"""No code page of Windows has all of its letters."""

GERMAN = """
import locale
from report.cli.main import main
locale.setlocale(locale.LC_ALL, "de-DE")
assert locale.str(0.5) == "0,5"
main()
"""


@pytest.fixture(scope="module")
def windows(tmp_path_factory):
    return installed(tmp_path_factory)


@pytest.fixture
def project(tmp_path):
    """The example, in a folder of its own."""
    folder = tmp_path / FOLDER
    shutil.copytree(ROOT / "projects" / "example", folder, ignore=shutil.ignore_patterns("out"))
    return folder


def test_everything_that_a_package_needs_is_there(windows):
    code, told = roofslip(windows, "doctor")
    assert code == 0, told
    assert "0.104604267 m" in told
    assert told.splitlines()[-1] == "Everything that a package needs is here."


def test_a_project_is_made_and_checked_in_a_folder_with_letters_of_no_code_page(windows, tmp_path):
    folder = on_windows(tmp_path / FOLDER)
    code, told = roofslip(windows, "new", folder, "--example")
    assert code == 0, told
    assert told.splitlines()[-1] == f'to see its package, run: roofslip report "{folder}"'
    code, told = roofslip(windows, "check", folder)
    assert code == 0, told
    assert "input.xlsx: no errors" in told


def test_a_package_of_windows_is_that_of_linux(windows, project, tmp_path_factory):
    code, told = roofslip(windows, "report", on_windows(project))
    assert code == 0, told
    here = reported(tmp_path_factory, "example").out
    assert re.findall("^verdict: .*", told, re.M) == ["verdict: OK with conditions"]
    one, two = (json.loads((out / "results.json").read_text()) for out in (project / "out", here))
    assert list(differences(one, two)) == []
    pages = [len(PdfReader(out / "calc-package.pdf").pages) for out in (project / "out", here)]
    assert pages[0] == pages[1]
    done = CliRunner().invoke(main, ["verify-package", str(project / "out" / "calc-package.pdf")])
    assert done.exit_code == 4, done.output
    assert "nothing differs in what was compared" in done.output
    assert "system Windows" in done.output


def test_a_folder_whose_path_is_too_long_is_named(windows, tmp_path):
    folder = tmp_path / "/".join(["d" * 80] * 3)
    code, told = roofslip(windows, "new", on_windows(folder), "--example")
    assert code == 2, told
    assert re.search(r"records: the path is too long for Windows by \d+ letters; use a", told)
    assert list(tmp_path.iterdir()) == []


def test_a_held_file_is_read_and_is_not_written(windows, project):
    words = command(windows, "-P", on_windows(TESTS / "windows" / "held.py"), on_windows(project))
    told = subprocess.run(**words, timeout=200, check=True).stdout
    lines = dict(line.split(": ", 1) for line in told.splitlines())
    one, two = (f"calc-package.pdf={text} results.xlsx={text}" for text in ("one", "two"))
    assert lines["new"].startswith(one)
    assert "results.xlsx: cannot be written" in lines["held"]
    assert lines["held"].endswith("; close it in other programs. No file was changed")
    assert lines["after held"].startswith(one)
    assert lines["held for a moment"].startswith(two)
    assert "results.xlsx: is read-only; allow changes to it" in lines["read-only"]
    assert lines["after read-only"].startswith(two)
    assert lines["read"] == "True"
    assert "input.xlsx: cannot be written" in lines["change"]
    assert "so a program has the workbook open; close it there" in lines["change in Excel"]
    assert lines["letters"] == "倉"  # the other one is in the only font of that machine
    left = {path.name for path in project.rglob("*") if path.name.startswith(".roofslip")}
    assert left == set()


def test_a_save_is_followed_by_a_report(windows, project, tmp_path_factory):
    """With the decimal comma, a time zone of half hours, and the line ends of Windows."""
    for record in project.glob("records/*.csv"):
        record.write_bytes(record.read_bytes().replace(b"\n", b"\r\n"))
    words = command(windows, "-P", "-c", GERMAN, "watch", on_windows(project))
    words["env"] |= {"TZ": "Asia/Kolkata"}
    with subprocess.Popen(**words) as watching:
        too_late = Timer(1000.0, watching.kill)
        too_late.start()
        assert _until(watching, "watching ")
        os.utime(project / "input.xlsx")
        assert _until(watching, "changes since the round before: 0")
        too_late.cancel()
        watching.kill()
    outs = (project / "out", reported(tmp_path_factory, "example").out)
    one, two = (json.loads((out / "results.json").read_text()) for out in outs)
    assert list(differences(one, two, shared=True)) == []


def _until(process, beginning):
    """Whether a line with a beginning is printed."""
    return any(line.startswith(beginning) for line in process.stdout)


def test_the_page_answers(windows):
    code, told = roofslip(windows, "serve", "--once", "--port", "0")
    assert code == 0, told
    assert "the example: OK with conditions" in told
