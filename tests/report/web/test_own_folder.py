"""The folder of a server: it ends with it, and what a killed one left is swept."""

import subprocess
import sys
from contextlib import contextmanager

import pytest

from places import ROOT
from report.web.own_folder import own_folder

KEEPS = """
import sys
from pathlib import Path
from report.web.own_folder import own_folder
with own_folder(Path(sys.argv[1])) as folder:
    (folder / "session").mkdir()
    print(folder, flush=True)
    sys.stdin.read()
"""


@contextmanager
def another(within):
    """Another server, as far as its folder goes, until it is killed."""
    process = subprocess.Popen(
        [sys.executable, "-c", KEEPS, within],
        cwd=ROOT, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True,
    )  # fmt: skip
    with process:
        yield process.stdout.readline().strip()
        process.kill()


def test_a_start_sweeps_what_a_killed_server_left_and_no_folder_of_a_living_one(tmp_path):
    with another(tmp_path) as killed, own_folder(tmp_path) as first:
        names = sorted(str(path) for path in tmp_path.iterdir())
        assert names == sorted([killed, str(first)])
    assert [str(path) for path in tmp_path.iterdir()] == [killed]
    with own_folder(tmp_path) as mine:
        assert list(tmp_path.iterdir()) == [mine]
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("name", ["roofslip-serve-link", "roofslip-other", "serve"])
def test_nothing_else_is_swept(tmp_path, name):
    elsewhere = tmp_path / "elsewhere"
    elsewhere.mkdir()
    (elsewhere / "file").write_text("kept")
    (tmp_path / name).symlink_to(elsewhere)
    (tmp_path / "roofslip-serve-file").write_text("kept")
    with own_folder(tmp_path):
        pass
    assert {path.name for path in tmp_path.iterdir()} == {"elsewhere", name, "roofslip-serve-file"}
    assert (elsewhere / "file").exists()


def test_a_folder_that_another_start_sweeps_before_it_is_locked_is_made_again(
    tmp_path, monkeypatch
):
    made = []

    def swept(**options):
        made.append(tmp_path / f"roofslip-serve-{len(made)}")
        made[-1].mkdir()
        if len(made) == 1:
            made[-1].rmdir()
        return str(made[-1])

    monkeypatch.setattr("report.web.own_folder.mkdtemp", swept)
    with own_folder(tmp_path) as folder:
        assert folder == made[1]
