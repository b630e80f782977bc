"""`roofslip.cmd` in Wine's cmd, with uv for Windows: what it installs, and what it then runs."""

import os
import re
import shutil
import signal
import subprocess
from pathlib import Path
from threading import Timer
from urllib.request import ProxyHandler, build_opener

import pytest
from wine import WINE, command, installed, on_windows

from places import ROOT

pytestmark = pytest.mark.nightly


@pytest.fixture(scope="module")
def windows(tmp_path_factory):
    return installed(tmp_path_factory)


@pytest.fixture(scope="module")
def checkout(tmp_path_factory):
    """What an image is made of, with the tests, in a folder with a blank and an accent."""
    folder = tmp_path_factory.mktemp("launcher") / "Roof slip é"
    rules = re.findall("^!(.*)", (ROOT / ".dockerignore").read_text(), re.M)
    for path in (path for rule in (*rules, "tests") for path in ROOT.glob(rule)):
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
    code, told = launched(windows, checkout, r".\roofslip check projects\example")
    assert code == 1
    assert "ask your IT to allow GitHub and the Python" in told
    assert not (checkout / ".venv").exists()

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
    assert re.findall("^verdict: .*", told, re.M) == ["verdict: OK with conditions"]
    assert (checkout / "projects" / "example" / "out" / "calc-package.pdf").exists()

    page_is_opened_by_a_double_click(windows, checkout)

    line = r".\roofslip test tests\solver tests\report\test_worker_process.py"
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
