"""A stranger's folder is no place to take settings or code from, whatever command is started there.

Each command runs in a folder with the files that libraries and Python look for; that of Python is
`roofslip` as pip installs it, without the launcher.
"""

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

from fixtures import dxf, workbooks
from fixtures.marks import by_day
from fixtures.paths import ROOT

PROGRAM = Path(sys.executable).with_name("roofslip")
EXAMPLE = ROOT / "projects" / "example"
RECORD = EXAMPLE / "records" / "RM1-x.csv"
MODULES = [
    *("multiprocessing", "signal", "tempfile", "json", "runpy", "sitecustomize", "usercustomize"),
    *("numpy", "numba", "matplotlib", "ezdxf", "evil", "yaml", "click", "solver", "report"),
    *("distributed", "dask", "pyarrow", "weasyprint", "uvicorn", "openpyxl", "scipy"),
]
"""Files of these names write a mark as they are imported."""

SETTINGS = ["ezdxf.ini", "matplotlibrc", "dask.yaml", "uv.toml", "fonts.conf", "pyhanko.yml"]
"""Pipes of these names: who opens one waits for ever."""


@pytest.fixture
def stranger(tmp_path):
    """A folder with all that; a function that runs a command there and asserts it took nothing."""
    folder, mark = tmp_path / "stranger", tmp_path / "mark"
    (folder / "dask-scratch-space" / "worker-abc").mkdir(parents=True)
    (folder / "dask-scratch-space" / "worker-abc.dirlock").symlink_to(mark)
    for name in MODULES:
        (folder / f"{name}.py").write_text(f"open({str(mark)!r}, 'a').write({name!r})\n")
    for name in SETTINGS:
        os.mkfifo(folder / name)

    def seen():
        return {path: path.lstat().st_mtime_ns for path in [folder, *folder.rglob("*")]}

    def run(*words, program=PROGRAM, code=0):
        before = seen()
        done = subprocess.run(
            [program, *map(str, words)],
            cwd=folder,
            capture_output=True,
            text=True,
            timeout=120,
            check=False,
        )
        assert not mark.exists(), mark.read_text()
        assert seen() == before
        assert done.returncode == code, done.stderr
        return done.stdout + done.stderr

    return run


@pytest.fixture
def project(tmp_path):
    """A small project, with a drawing of its roof beside the workbook."""
    folder = tmp_path / "project"
    folder.mkdir()
    layers = [{"layer": "PV", "kind": "array"}]
    workbooks.make(folder, layers=layers)
    drawing = dxf.Sketch()
    drawing.ring("PV", dxf.BOX_FT, "A1")
    (folder / "blocks.csv").write_text("x,y,blocks\n1,1,2\n")
    drawing.saved(folder)
    return folder


DAY = {
    "check": ["check", "PROJECT"],
    "clearances": ["plan", "clearances", "PROJECT"],
    "completion": ["completion", "bash"],
    "convert": ["motion", "convert", RECORD, "OUT.csv"],
    "info": ["motion", "info", RECORD],
    "new": ["new", "OUT", "--example"],
    "plan": ["plan", "read", "PROJECT/roof.dxf", "PROJECT", "--replace", "--accept"],
    "rows": ["motion", "rows", EXAMPLE / "records"],
    "schema": ["schema"],
    "slide": ["slide", RECORD, "--slope-deg", 2, "--mu", 0.3],
}
NIGHT = {
    "several": ["report", "PROJECT", "PROJECT"],
    "doctor": ["doctor"],
    "serve": ["serve", "--once", "--port", 0],
    "study": ["study", ROOT / "projects" / "study", "--out", "OUT"],
    "suite": ["motion", "suite", "OUT", "--sds", 1, "--code", "asce7-16", "--count", 1],
    "verify": ["verify", "--quick", "--out", "OUT"],
}


@pytest.fixture
def started(stranger, project, tmp_path):
    """A function that runs a command of the lists with its project and output."""

    def run(words, code=0):
        places = {"PROJECT": str(project), "OUT": str(tmp_path / "out")}
        given = [re.sub("PROJECT|OUT", lambda found: places[found[0]], str(word)) for word in words]
        return stranger(*given, code=code)

    return run


@pytest.mark.parametrize("words", by_day(DAY.values(), 1), ids=DAY)
def test_a_command_takes_nothing_from_the_current_folder(started, words):
    started(words)


@pytest.mark.nightly
@pytest.mark.parametrize("words", NIGHT.values(), ids=NIGHT)
def test_nor_does_one_that_takes_longer(started, words):
    started(words)


@pytest.mark.nightly
def test_nor_is_anything_taken_to_write_compare_and_sign_a_package(started):
    started(["report", "PROJECT"])
    package = "PROJECT/out/calc-package.pdf"
    assert "Same: " in started(["verify-package", package])
    told = started(["sign", package, "--p12", RECORD, "--password", "x"], code=2)
    assert "cannot open the certificate" in told
