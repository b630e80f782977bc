"""What the system refuses, and what a terminal may be shown: exit code 2, never a traceback."""

import json
import os
import resource
import signal
import subprocess
import sys
from pathlib import Path
from subprocess import DEVNULL, PIPE

import pytest

from fixtures.commands import errors_of, hearing, no_override, stdout_of
from fixtures.paths import ROOT
from fixtures.workbooks import cell_address, edit, make, type_into
from report.cli.console import plain, say
from report.cli.several_packages import package

RECORD = ROOT / "projects" / "example" / "records" / "RM1-x.csv"
FULL = "/dev/full"


def python(*arguments, **options):
    usual = {"cwd": ROOT, "stdout": PIPE, "stderr": PIPE, "text": True, "timeout": 120}
    command = [sys.executable, *map(str, arguments)]
    return subprocess.run(command, check=False, **usual | options)


def roofslip(*arguments, **options):
    return python("-m", "report.cli", *arguments, **options)


needs_full = pytest.mark.skipif(not os.path.exists(FULL), reason=f"no {FULL} here")


@needs_full
@pytest.mark.parametrize("arguments", [["--help"], ["check", "none", "--json"]])
def test_an_output_on_a_full_disk_ends_with_a_message(arguments):
    with open(FULL, "w") as full:
        done = roofslip(*arguments, stdout=full)
    assert done.returncode == 2
    assert done.stderr == "The output cannot be written (No space left on device).\n"


@needs_full
@pytest.mark.nightly
def test_errors_on_a_full_disk_keep_the_exit_code():
    with open(FULL, "w") as full:
        done = roofslip("check", "none", stderr=full)
        assert (done.returncode, done.stdout) == (2, "")
        assert roofslip("check", "none", stdout=full, stderr=full).returncode == 2


def no_files():
    resource.setrlimit(resource.RLIMIT_FSIZE, (0, 0))


def test_serve_says_where_no_disk_has_room_for_its_folder():
    done = roofslip("serve", "--once", "--port", "0", preexec_fn=no_files)
    assert done.returncode == 2
    words = "serve: 1 error:\n  a file cannot be written or read (No "
    assert words in done.stderr
    assert "free disk space" in done.stderr


@pytest.mark.quick
def test_a_working_folder_that_is_gone_is_an_input_error(tmp_path):
    gone = tmp_path / "gone"
    gone.mkdir()
    code = (
        "import os; os.rmdir(os.getcwd()); from report.cli.main import main; main(['check', 'x'])"
    )
    done = python("-P", "-c", code, cwd=gone, env=os.environ | {"PYTHONPATH": str(ROOT)})
    assert done.returncode == 2
    assert done.stderr == "The working folder no longer exists; change to another folder.\n"


@pytest.mark.quick
@pytest.mark.parametrize("threads", ["0", "-2", "two", ""])
def test_a_number_of_threads_that_is_none_is_an_input_error(monkeypatch, threads):
    """Numba ends with a traceback at zero, and takes another text for all cores."""
    monkeypatch.setenv("NUMBA_NUM_THREADS", threads)
    assert errors_of("check", "projects/example") == (
        f"The environment variable NUMBA_NUM_THREADS is '{threads}'; set it to a number of "
        "threads, 1 or more, or remove it.\n"
    )


# Starts every command, one after the other, and prints how each ended.
EVERY_COMMAND = """
import sys, click
from report.cli.main import main
def below(group, *words):
    for name, command in group.every().items():
        if isinstance(command, click.Group):
            yield from below(command, *words, name)
        else:
            yield *words, name
for words in below(main):
    try:
        main(words)
    except SystemExit as ended:
        print(*words, ended.code, sep=",")
assert "numba" not in sys.modules
"""


def test_check_loads_no_compiler():
    program = (
        "import sys; from report.cli.main import main; "
        "main(['check', 'projects/example', '--quiet'], standalone_mode=False); "
        "assert not {'numba', 'scipy', 'pandas', 'matplotlib'} & sys.modules.keys()"
    )
    done = python("-P", "-c", program)
    assert (done.returncode, done.stderr) == (0, "")


@pytest.mark.parametrize("kind", ["file", "pipe"])
def test_no_command_starts_beside_settings_of_numba(tmp_path, kind):
    """They may name a folder of compiled code, which would run: numba is not loaded."""
    settings = tmp_path / ".numba_config.yaml"
    if kind == "file":
        settings.write_text("cache_dir: brought")
    else:
        os.mkfifo(settings)
    done = python("-P", "-c", EVERY_COMMAND, cwd=tmp_path)
    ended = [line.rpartition(",")[::2] for line in done.stdout.splitlines()]
    assert {code for _, code in ended} == {"2"}
    assert {"report", "plan,read", "motion,suite", "completion"} <= {words for words, _ in ended}
    told = done.stderr.splitlines()
    assert len(told) == len(ended)
    assert all(
        line.startswith(f"{settings}: this file can make numba, the compiler ") for line in told
    )
    assert "delete it, or change to another folder" in told[0]


@pytest.mark.nightly
def test_without_a_standard_error_the_exit_code_is_the_same(tmp_path):
    code = (
        "import os, sys; os.close(2); sys.stderr = None; from report.cli.main import main; main()"
    )
    for arguments, expected in (
        (["check", tmp_path / "none"], 2),
        (["motion", "info", RECORD], 0),
        (["motion", "suite", tmp_path / "made", "--sds", "9", "--code", "pv1"], 2),
    ):
        assert python("-c", code, *arguments, stderr=None).returncode == expected


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


@pytest.mark.nightly
def test_without_permission_each_command_says_which_file(tmp_path):
    book = make(tmp_path / "book")
    books = {name: make(tmp_path / name) for name in ("workbook", "record", "out")}
    closed = books["out"].parent
    locked = {
        books["workbook"]: 0o000,
        books["record"].parent / "records" / "x.csv": 0o000,
        closed: 0o555,
    }
    for path, mode in locked.items():
        path.chmod(mode)
    commands = {
        "input.xlsx' is not readable": ["check", books["workbook"]],
        "Motions!C8: horizontal record: 'records/x.csv' cannot be read (Permission denied)": [
            "check", books["record"]
        ],
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
    words = json.dumps([str(books["workbook"]), *given])
    try:
        done = python("-c", COMMANDS, words, preexec_fn=no_override)
    finally:
        for path in locked:
            path.chmod(0o755)
    ended = json.loads(done.stdout)
    if not ended:
        pytest.skip("permissions cannot be taken away here")
    for (exit_code, output), told in zip(ended, commands, strict=True):
        assert exit_code == 2, output
        assert told.strip() in output, output
        assert "running" not in output
    assert [path.name for path in closed.iterdir()] == ["records", "input.xlsx"]


def test_a_closed_pipe_stops_no_work_and_has_no_traceback(tmp_path):
    read, write = os.pipe()
    os.close(read)
    made, whole = tmp_path / "made.csv", tmp_path / "whole.csv"
    with os.fdopen(write, "w") as closed:
        done = roofslip("motion", "convert", RECORD, made, stdout=closed)
        assert (done.returncode, done.stderr) == (0, "")
        assert roofslip("motion", "convert", RECORD, whole, stderr=closed).returncode == 0
    assert made.read_bytes() == whole.read_bytes()


@pytest.mark.nightly
def test_ctrl_c_ends_with_130_and_one_line(tmp_path):
    """The whole group gets the signal, as from a terminal."""
    command = [sys.executable, "-m", "report.cli", "report", make(tmp_path)]
    work = subprocess.Popen(
        command, cwd=ROOT, text=True, stdout=PIPE, stderr=PIPE, start_new_session=True,
        preexec_fn=hearing(signal.SIGINT),
    )  # fmt: skip
    try:
        assert work.stderr.readline().startswith("[")  # the first step after a second
        os.killpg(work.pid, signal.SIGINT)
        out, err = work.communicate(timeout=60)
    finally:
        work.kill()
    said = [line for line in err.splitlines() if not line.startswith("[")]
    assert (work.returncode, out, said) == (130, "", ["Interrupted before the end."])


CUT_OFF_IN_COMPILED_CODE = """
import os, signal
from report.cli.main import main
@main.command()
def work():
    try:
        os.kill(os.getpid(), signal.SIGINT)
    except KeyboardInterrupt:
        pass
    raise ValueError("an error of the library's own, which names no interrupt")
main(["work"])
"""


def test_ctrl_c_that_a_library_turns_into_its_own_error_is_still_ctrl_c():
    done = python("-c", CUT_OFF_IN_COMPILED_CODE, preexec_fn=hearing(signal.SIGINT))
    assert (done.returncode, done.stdout) == (130, "")
    assert done.stderr == "Interrupted before the end.\n"


@pytest.mark.nightly
def test_sign_without_a_terminal_is_an_input_error(tmp_path):
    pdf, key = tmp_path / "a.pdf", tmp_path / "a.p12"
    for path in (pdf, key):
        path.write_bytes(b"x")
    env = {name: v for name, v in os.environ.items() if name != "ROOFSLIP_P12_PASSWORD"}
    done = roofslip("sign", pdf, "--p12", key, stdin=DEVNULL, start_new_session=True, env=env)
    assert done.returncode == 2
    assert "without a terminal; set ROOFSLIP_P12_PASSWORD" in done.stderr
    assert "Warning" not in done.stderr
    assert "Password:" not in done.stderr


LONG = "x" * 300
TOO_LONG = "File name too long"


@pytest.mark.parametrize(
    "arguments",
    [
        ["check", LONG],
        ["report", LONG],
        ["new", LONG],
        ["motion", "info", LONG],
        ["motion", "convert", RECORD, LONG],
    ],
)
def test_a_name_that_is_too_long_is_an_input_error(arguments, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert TOO_LONG in errors_of(*arguments)
    assert list(tmp_path.iterdir()) == []


def test_too_long_names_are_refused_before_the_run_odd_letters_and_long_values_shown(tmp_path):
    outcome = package(tmp_path / LONG, False, quiet=True, as_json=False, has_page=False)
    (problem,) = outcome.errors
    assert f"the operating system denied access ({TOO_LONG})" in problem
    told = errors_of("report", make(tmp_path), "--out", tmp_path / LONG)
    assert TOO_LONG in told
    assert "running" not in told
    assert plain("a\x1b[31m\u202eb\u2066c\u2028d\x9be") == "a?[31m?b?c?d?e"
    assert plain("μ is 0.5 — 屋上") == "μ is 0.5 — 屋上"
    assert len(plain("9" * 10_000)) < 2010
    named = tmp_path / "a\u202eb\x1b[31m.csv"
    named.write_text("abc\n")
    for command in (["motion", "info"], ["check"], ["report"]):
        assert not set("\u202e\x1b") & set(errors_of(*command, named))
    told = errors_of("check", type_into(make(tmp_path), {"Arrays/A1/CG height": 10**400}))
    line = f"<Arrays/A1/CG height>: CG height is 1{'0' * 58}…; enter a number greater than 0"
    assert cell_address(line) in told
    assert max(map(len, told.splitlines())) < 300


def test_words_are_printed_with_ordinary_spaces_and_a_path_keeps_its_own(capsys):
    say(Path("a\u00a0b.csv"), ": 30\u00a0in")
    assert capsys.readouterr().out == "a\u00a0b.csv: 30 in\n"


def test_a_name_defined_off_the_sheet_is_no_name(tmp_path):
    def change(book):
        name = next(name for name in book.defined_names if name.startswith("site_"))
        book.defined_names[name].attr_text = "'Site'!$ZZZ$9999999"

    stdout_of("check", edit(make(tmp_path), change))


@pytest.mark.parametrize(
    ("largest", "dt_s", "said"),
    [
        (
            "1e100",
            0.01,
            "the values reach 1e+100 g, which is more than 10 g; are they in cm/s2?",
        ),
        ("0.1", 1e200, "time step"),
        ("0.1", 11.0, "time step"),
        ("0.1", 1e-9, "time step"),
    ],
)
def test_records_of_no_earthquake_are_refused(largest, dt_s, said, tmp_path):
    path = tmp_path / "a.csv"
    path.write_text(f"{largest}\n-0.1\n0\n")
    assert said in errors_of("motion", "info", path, "--units", "g", "--dt", dt_s)
