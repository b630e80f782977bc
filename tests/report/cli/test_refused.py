"""What the system refuses to a whole process: permission, disk space, outputs, size of files."""

import ctypes
import json
import os
import resource
import signal
import subprocess
import sys

import pytest
from click.testing import CliRunner

from places import ROOT
from report.cli.main import main
from sheets import make

RECORD = ROOT / "projects" / "example" / "records" / "RM1-x.csv"
FULL = "/dev/full"


def roofslip(*arguments, **options):
    return subprocess.run(
        [sys.executable, "-m", "report.cli", *map(str, arguments)],
        cwd=ROOT,
        text=True,
        check=False,
        timeout=120,
        **{"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, **options},
    )


needs_full = pytest.mark.skipif(not os.path.exists(FULL), reason=f"no {FULL} here")


@needs_full
@pytest.mark.parametrize(
    "arguments", [["--help"], ["motion", "info", RECORD], ["check", "none", "--json"]]
)
@pytest.mark.by_day(1)
def test_an_output_on_a_full_disk_ends_with_a_message(arguments):
    with open(FULL, "w") as full:
        done = roofslip(*arguments, stdout=full)
    assert done.returncode == 2
    assert done.stderr == "The output cannot be written (No space left on device).\n"


@needs_full
@pytest.mark.nightly("report/cli/terminal.py")
def test_errors_on_a_full_disk_keep_the_exit_code():
    with open(FULL, "w") as full:
        done = roofslip("check", "none", stderr=full)
        assert (done.returncode, done.stdout) == (2, "")
        assert roofslip("check", "none", stdout=full, stderr=full).returncode == 2


def small_files():
    resource.setrlimit(resource.RLIMIT_FSIZE, (4096, 4096))


def test_serve_says_where_no_disk_has_room_for_its_folder():
    def no_files():
        resource.setrlimit(resource.RLIMIT_FSIZE, (0, 0))

    done = roofslip("serve", "--once", "--port", "0", preexec_fn=no_files)
    assert done.returncode == 2
    assert done.stderr.startswith(
        "serve: 1 problem found.\n  a file cannot be written or read (No "
    )
    assert "free disk space" in done.stderr


@pytest.mark.parametrize("command", [["batch"], ["watch", "--once"]])
def test_what_the_system_refuses_is_a_problem_of_the_input(command):
    done = CliRunner().invoke(main, [*command, "a" * 300])
    assert done.exit_code == 2
    assert "the system refuses it (File name too long)" in done.stderr
    assert "Traceback" not in done.stderr


@pytest.mark.parametrize(
    "arguments",
    [["motion", "convert", RECORD, "made.csv"], ["motion", "info", RECORD, "--plot", "made.svg"]],
)
@pytest.mark.by_day(1)
def test_a_limit_on_the_size_of_files_leaves_no_half_file(arguments, tmp_path):
    *arguments, name = arguments
    done = roofslip(*arguments, tmp_path / name, preexec_fn=small_files)
    assert done.returncode == 2
    assert f"{name}: cannot be written (File too large)" in done.stderr
    assert "Traceback" not in done.stderr
    assert list(tmp_path.iterdir()) == []


def test_a_set_beyond_the_limit_on_the_size_of_files_is_not_published(tmp_path):
    (tmp_path / "a.txt").write_text("old")
    code = (
        "import sys; from pathlib import Path; from report.results.publish import publish\n"
        "publish({'a.txt': b'new', 'b.txt': b'9' * 10000}, Path(sys.argv[1]))"
    )
    done = subprocess.run(
        [sys.executable, "-c", code, tmp_path],
        cwd=ROOT, capture_output=True, text=True, check=False, preexec_fn=small_files,
    )  # fmt: skip
    assert "InputError" in done.stderr
    assert "cannot be written (File too large); free disk space" in done.stderr
    assert [(path.name, path.read_text()) for path in tmp_path.iterdir()] == [("a.txt", "old")]


# Runs commands one after the other, and prints how each ended.
COMMANDS = """
import json, os, sys
from click.testing import CliRunner
from report.cli.main import main
locked, *commands = json.loads(sys.argv[1])
if os.access(locked, os.R_OK):
    print("[]")
else:
    ended = [CliRunner().invoke(main, command) for command in commands]
    print(json.dumps([(done.exit_code, done.output) for done in ended]))
"""


def no_override():
    """Give up the right of root to read and write what permissions forbid."""
    libc, drop_from_bounding_set = ctypes.CDLL(None), 24
    for override in (1, 2):
        libc.prctl(drop_from_bounding_set, override, 0, 0, 0)


@pytest.mark.nightly("report/cli/terminal.py")
def test_without_permission_each_command_says_which_file(tmp_path):
    book = make(tmp_path / "book")
    books = {name: make(tmp_path / name) for name in ("workbook", "record", "records", "out")}
    locked = {
        books["workbook"]: 0o000,
        books["record"].parent / "records" / "x.csv": 0o000,
        books["records"].parent / "records": 0o000,
        books["out"].parent: 0o555,
    }
    for path, mode in locked.items():
        path.chmod(mode)
    closed = books["out"].parent
    commands = {
        "input.xlsx' is not readable": ["check", books["workbook"]],
        "x.csv: cannot be read (Permission denied)": ["check", books["record"]],
        "'records/x.csv' cannot be read (Permission denied); allow it": ["check", books["records"]],
        f"{closed}: no permission to write; choose another folder": ["report", books["out"]],
        f"{closed}: no permission": ["report", book, "--out", closed / "a" / "b"],
        f"{closed}: no permission ": ["verify", "--quick", "--out", closed / "a"],
        "input.xlsx: cannot be written (Permission denied)": ["new", closed / "new"],
        "made.csv: cannot be written": ["motion", "convert", RECORD, closed / "made.csv"],
        f" {closed}: no permission": [
            "motion", "suite", closed, "--sds", 1.0, "--code", "asce7-16", "--count", 1,
        ],
    }  # fmt: skip
    given = [[str(word) for word in command] for command in commands.values()]
    try:
        done = subprocess.run(
            [sys.executable, "-c", COMMANDS, json.dumps([str(books["workbook"]), *given])],
            cwd=ROOT, capture_output=True, text=True, check=False, preexec_fn=no_override,
        )  # fmt: skip
    finally:
        for path in locked:
            path.chmod(0o755)
    ended = json.loads(done.stdout)
    if not ended:
        pytest.skip("permissions cannot be taken away here")
    for (exit_code, output), words in zip(ended, commands, strict=True):
        assert exit_code == 2, output
        assert words.strip() in output, output
        assert "running" not in output
    assert [path.name for path in closed.iterdir()] == ["records", "input.xlsx"]


def test_a_closed_pipe_stops_no_work_and_has_no_traceback(tmp_path):
    read, write = os.pipe()
    os.close(read)
    made = tmp_path / "made.csv"
    with os.fdopen(write, "w") as closed:
        done = roofslip("motion", "convert", RECORD, made, stdout=closed)
        assert (done.returncode, done.stderr) == (0, "")
        whole = tmp_path / "whole.csv"
        assert roofslip("motion", "convert", RECORD, whole, stderr=closed).returncode == 0
    assert made.read_bytes() == whole.read_bytes()


def test_ctrl_c_ends_with_130_and_one_line(tmp_path):
    """The whole group gets the signal, as from a terminal."""
    work = subprocess.Popen(
        [sys.executable, "-m", "report.cli", "report", make(tmp_path), "--out", tmp_path / "out"],
        cwd=ROOT, text=True, stderr=subprocess.PIPE, stdout=subprocess.PIPE,
        start_new_session=True,
    )  # fmt: skip
    try:
        assert work.stderr.readline().startswith("[")  # the first step after a second
        os.killpg(work.pid, signal.SIGINT)
        out, err = work.communicate(timeout=60)
    finally:
        work.kill()
    said = [line for line in err.splitlines() if not line.startswith("[")]
    assert (work.returncode, out, said) == (130, "", ["Interrupted: the work was cut off."])


def test_sign_without_a_terminal_is_an_input_error(tmp_path):
    for name in ("a.pdf", "a.p12"):
        (tmp_path / name).write_bytes(b"x")
    done = roofslip(
        "sign", tmp_path / "a.pdf", "--p12", tmp_path / "a.p12",
        stdin=subprocess.DEVNULL, start_new_session=True,
        env={k: v for k, v in os.environ.items() if k != "ROOFSLIP_P12_PASSWORD"},
    )  # fmt: skip
    assert done.returncode == 2
    assert "without a terminal; set ROOFSLIP_P12_PASSWORD" in done.stderr
    assert "Warning" not in done.stderr
    assert "Password:" not in done.stderr
