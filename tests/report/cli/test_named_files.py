"""What a user names as a file is one: no pipe, device or endless file is waited for or read."""

import os
import signal
import socket
import sys

import click
import numpy as np
import pytest

from fixtures import commands, records, workbooks
from fixtures.marks import by_day
from report.cli.main import main

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="none of these has a place there")

AC156 = ("--sds", 1, "--code", "asce7-16", "--count", 1)
SLID = ("--slope-deg", 1, "--mu", 0.4, "--dt", 0.01, "--units", "g")
BALLAST = ("--units", "m", "--block-weight", 32, "lb")
SIGNED = ("sign", "job/input.xlsx", "--password", "x")
READ = {
    "check source": ("check", "it.xlsx"),
    "report sources": ("report", "it.xlsx"),
    "report since": ("report", "job", "--since", "it.json"),
    "watch source": ("watch", "it.xlsx"),
    "study source": ("study", "it.xlsx"),
    "serve token_file": ("serve", "--no-browser", "--token-file", "it"),
    "plan read drawing": ("plan", "read", "it.dxf", "job", "--accept"),
    "plan read project": ("plan", "read", "roof.dxf", "it.xlsx"),
    "plan clearances project": ("plan", "clearances", "it.xlsx"),
    "plan ballast ballast_map": ("plan", "ballast", "it.csv", "job", *BALLAST),
    "plan ballast project": ("plan", "ballast", "map.csv", "it.xlsx", *BALLAST),
    "motion info file": ("motion", "info", "it.csv"),
    "motion info response": ("motion", "info", "raw.mseed", "--response", "it.xml"),
    "motion convert file": ("motion", "convert", "it.csv", "new.csv"),
    "motion convert response": ("motion", "convert", "raw.mseed", "new.csv", "--response",
                                     "it.xml"),
    "motion suite records": ("motion", "suite", "made", *AC156, "--records", "it.csv"),
    "motion suite more": ("motion", "suite", "made", *AC156, "--records", "x.csv", "it.csv"),
    "motion suite into": ("motion", "suite", "job/made", "--into", "it.xlsx"),
    "motion suite target": ("motion", "suite", "made", "--target", "it.csv"),
    "motion rows source": ("motion", "rows", "it.zip"),
    "motion rows project": ("motion", "rows", "set", "it.xlsx", "--at", "roof"),
    "slide record": ("slide", "it.csv", *SLID),
    "slide transverse": ("slide", "x.csv", "--transverse", "it.csv", *SLID),
    "slide vertical": ("slide", "x.csv", "--vertical", "it.csv", *SLID),
    "verify records": ("verify", "--records", "it"),
    "verify-package file": ("verify-package", "it.pdf"),
    "sign file": ("sign", "it.pdf", "--p12", "x.csv", "--password", "x"),
    "sign p12": (*SIGNED, "--p12", "it.p12"),
}  # fmt: skip
WRITTEN = {
    "new folder": ("new", "it"),
    "report out": ("report", "job", "--out", "it"),
    "study out": ("study", "job", "--out", "it"),
    "motion convert out": ("motion", "convert", "x.csv", "it.csv", "--units", "g", "--dt",
                                0.01),
    "motion suite folder": ("motion", "suite", "it", *AC156),
    "verify out": ("verify", "--out", "it"),
    "verify-package out": ("verify-package", "x.csv", "--out", "it.pdf"),
}  # fmt: skip
TRIED_ELSEWHERE = {
    "watch out": "that of report, after which it waits for the next save",
    "verify-package records": "a folder, in which names of a package are sought",
    "sign out": "tests/report/proof/test_sign.py",
}
KINDS = ("pipe", "device", "socket", "circle", "huge", "folder")


def leaves(group, name=""):
    for word, command in group.every().items():
        if isinstance(command, click.Group):
            yield from leaves(command, f"{name} {word}")
        else:
            yield f"{name} {word}".strip(), command


def names_a_file(parameter):
    """Whether it is a path, or a text whose help shows it as one or shows nothing."""
    metavar = str(parameter.metavar)
    is_text = parameter.type is click.STRING and parameter.nargs in (1, -1)
    words = ("RECORD", "FILES", "CSV", "xml", "p12", "PDF")
    is_told = any(word in metavar for word in words) or parameter.name in ("record", "more")
    return isinstance(parameter.type, click.Path) or (is_text and is_told)


@pytest.mark.quick
def test_every_option_and_argument_that_names_a_file_is_tried():
    found = {
        f"{name} {parameter.name}"
        for name, command in leaves(main)
        for parameter in command.params
        if names_a_file(parameter)
    }
    assert found == {*READ, *WRITTEN, *TRIED_ELSEWHERE}


@pytest.fixture
def beside(tmp_path, monkeypatch):
    """A folder with a project and records, in which commands run that may not wait."""
    monkeypatch.chdir(tmp_path)
    workbooks.make(tmp_path / "job")
    for axis in "xyz":
        records.write_record(tmp_path / "set" / f"M-{axis}.csv", dt_s=0.02, count=300)
    (tmp_path / "x.csv").write_text("0.1\n-0.1\n" * 50)
    (tmp_path / "map.csv").write_text("x,y,blocks\n1,1,1\n")
    obspy = pytest.importorskip("obspy")
    trace = obspy.Trace(np.arange(-50, 50, dtype=np.int32), {"station": "ABC", "channel": "HNZ"})
    trace.write(str(tmp_path / "raw.mseed"), format="MSEED")

    def late(*_):
        raise AssertionError("it waits")

    former = signal.signal(signal.SIGALRM, late)
    signal.alarm(60)
    yield tmp_path
    signal.alarm(0)
    signal.signal(signal.SIGALRM, former)


def put(path, kind):
    match kind:
        case "pipe":
            os.mkfifo(path)
        case "device":
            path.symlink_to("/dev/zero")
        case "socket":
            listening = socket.socket(socket.AF_UNIX)
            listening.bind(path.name)  # a path of few letters
            listening.close()
        case "circle":
            path.symlink_to(path.name)
        case "huge":
            with path.open("wb") as hollow:
                hollow.truncate(10**12)
        case "folder":
            path.mkdir()


def check_refused(folder, kind, words):
    name = next(str(word) for word in words if str(word).startswith("it"))
    put(folder / name, kind)
    before = sorted(folder.rglob("*"))
    done = commands.run(*words)
    assert done.exit_code == 2, (done.output, done.exception)
    assert isinstance(done.exception, SystemExit)
    assert sorted(folder.rglob("*")) == before


@pytest.mark.parametrize("kind", by_day(KINDS, 1))
@pytest.mark.parametrize("place", by_day(READ, 6))
def test_what_is_no_file_is_refused_at_once(beside, kind, place):
    if (place, kind) == ("watch source", "huge"):
        pytest.skip("it waits until a smaller workbook is saved")
    check_refused(beside, kind, READ[place])


@pytest.mark.nightly
@pytest.mark.parametrize("kind", ["pipe", "device", "socket", "circle"])
@pytest.mark.parametrize("place", WRITTEN)
def test_what_is_no_file_is_not_written_to(beside, kind, place):
    check_refused(beside, kind, WRITTEN[place])
