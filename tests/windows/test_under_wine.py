"""Windows under Wine: the commands on its own Python, and what `roofslip.cmd` installs and runs."""

import json
import os
import re
import shutil
import signal
import subprocess
from pathlib import Path
from threading import Timer
from urllib.request import ProxyHandler, build_opener

import pytest
from pypdf import PdfReader
from wine import WINE, command, installed, on_windows, roofslip

from fixtures.commands import output_of
from fixtures.packages import reported
from fixtures.paths import ROOT, TESTS
from report.proof.differences import differences

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


def test_a_package_of_windows_is_that_of_linux(windows, project, tmp_path_factory):
    code, told = roofslip(windows, "report", on_windows(project))
    assert code == 0, told
    here = reported(tmp_path_factory, "example").out
    assert re.findall("^verdict: [^,;]*", told, re.M) == ["verdict: OK"]
    one, two = (json.loads((out / "results.json").read_text()) for out in (project / "out", here))
    assert list(differences(one, two)) == []
    pages = [len(PdfReader(out / "calc-package.pdf").pages) for out in (project / "out", here)]
    assert pages[0] == pages[1]
    told = output_of("verify-package", project / "out" / "calc-package.pdf", exit_code=4)
    assert "no differences in what was compared" in told
    assert "system Windows" in told


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
        assert _until(watching, "changes since the last report: 0")
        too_late.cancel()
        watching.kill()
    outs = (project / "out", reported(tmp_path_factory, "example").out)
    one, two = (json.loads((out / "results.json").read_text()) for out in outs)
    assert list(differences(one, two, shared=True)) == []


def _until(process, beginning):
    """Whether a line with a beginning is printed."""
    return any(line.startswith(beginning) for line in process.stdout)


@pytest.fixture(scope="module")
def checkout(tmp_path_factory):
    """What an image is made of, with the tests, in a folder with a blank and an accent."""
    folder = tmp_path_factory.mktemp("launcher") / "Roof slip é"
    rules = re.findall("^!(.*)", (ROOT / ".dockerignore").read_text(), re.M)
    for path in (path for rule in (*rules, "tests", "docs/method.md") for path in ROOT.glob(rule)):
        target = folder / path.relative_to(ROOT)
        target.parent.mkdir(parents=True, exist_ok=True)
        if path.is_dir():
            shutil.copytree(path, target, ignore=shutil.ignore_patterns("out", "__pycache__"))
        else:
            shutil.copy(path, target)
    return folder


def launching(windows, checkout, line, path=r"C:\none"):
    """Return what `subprocess` takes to type a line into cmd in the folder of the checkout."""
    words = command(windows)
    # The folders that Windows looks for programs in; one of another system leads to no package.
    words["env"] |= {"WINEPATH": path, "PIP_FIND_LINKS": "", "PYTEST_ADDOPTS": "-m 'not nightly'"}
    return words | {"args": [WINE, "cmd", "/c", line], "cwd": checkout}


def launched(*about, **more):
    """Type a line; return its exit code, and what is printed."""
    done = subprocess.run(**launching(*about, **more), timeout=3600, check=False)
    return done.returncode, done.stdout


def test_the_launcher_says_what_to_ask_for_then_installs_and_runs(windows, checkout):
    """In one test: each step begins with what the one before has left."""
    code, told = launched(windows, checkout, r".\roofslip motion suite --count 3 --help")
    assert (code, told.splitlines()[0]) == (0, "Usage: roofslip motion suite [OPTIONS] DIR")
    assert "--count INTEGER RANGE" in told
    code, told = launched(windows, checkout, r".\roofslip --version")
    assert told.splitlines()[0].startswith("roofslip, version ")
    code, told = launched(windows, checkout, r".\roofslip slide")
    assert (code, told.splitlines()[0]) == (2, "Usage: roofslip slide [OPTIONS] RECORD")

    code, told = launched(windows, checkout, r".\roofslip check projects\example")
    assert code == 1
    assert "ask your IT to allow GitHub and the Python" in told
    assert not list(checkout.glob(".venv*"))

    # Without uv and PowerShell, but with a Python: pip brings uv, whose hash it checks.
    shutil.copy(windows / "py" / "python.exe", windows / "py" / "py.exe")
    subprocess.run(**command(windows, "-m", "ensurepip"), timeout=300, check=True)
    path = on_windows(windows / "py")
    code, told = launched(windows, checkout, r".\roofslip check projects\example", path=path)
    assert code == 0, told
    assert re.findall("^roofslip: (installing uv into|setting up .venv)", told, re.M)
    assert told.splitlines()[-1] == r"Next: .\roofslip report projects\example"

    code, told = launched(windows, checkout, r".\roofslip report projects\example")
    assert code == 0, told
    assert "roofslip: " not in told  # all is there
    assert re.findall("^verdict: [^,;]*", told, re.M) == ["verdict: OK"]
    assert (checkout / "projects" / "example" / "out" / "calc-package.pdf").exists()

    page_is_opened_by_a_double_click(windows, checkout)

    line = r".\roofslip test tests\solver tests\report\web\test_worker_process.py"
    code, told = launched(windows, checkout, line, path=path)
    assert code == 0, told
    assert "roofslip: setting up .venv from requirements.lock (once, for test;" in told


def page_is_opened_by_a_double_click(windows, checkout):
    with subprocess.Popen(**launching(windows, checkout, r".\roofslip")) as serving:
        too_late = Timer(300.0, lambda: end(checkout))
        too_late.start()
        addresses = (re.search(r"http://127\.0\.0\.1:\S+", line) for line in serving.stdout)
        address = next(filter(None, addresses))[0]
        browser = build_opener(ProxyHandler({}))
        assert b"Roofslip" in browser.open(address, timeout=300.0).read()
        too_late.cancel()
        end(checkout)


def end(checkout):
    """End the server, which Wine has not made a child of this process."""
    for process in Path("/proc").glob("[0-9]*"):
        try:
            words = (process / "cmdline").read_bytes()
        except OSError:  # it has ended
            continue
        if on_windows(checkout).encode() in words and b"report.cli" in words:
            os.kill(int(process.name), signal.SIGKILL)
