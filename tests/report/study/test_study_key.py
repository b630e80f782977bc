"""The key of a user's study parts: made once, of its user alone, or an error says what to do."""

import stat
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest

from report.study.manifest import KEY_BYTES, state_folder, user_key
from solver.model import InputError
from study_books import command, write

pytestmark = pytest.mark.quick


@pytest.fixture
def state(tmp_path, monkeypatch):
    """The state folder of a user, in which nothing is."""
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))
    return tmp_path / "state"


def test_the_key_is_made_once_for_its_user_alone(state):
    key = user_key()
    (path,) = (state / "roofslip").iterdir()
    assert stat.S_IMODE(path.stat().st_mode) == 0o600
    assert stat.S_IMODE(path.parent.stat().st_mode) == 0o700
    assert user_key() == key == path.read_bytes()
    assert len(key) == KEY_BYTES
    path.unlink()
    assert user_key() != key


def test_processes_that_make_it_at_once_agree(state, monkeypatch):
    """Another one is quicker, between the look at the folder and the new file."""
    others, make = bytes(range(KEY_BYTES)), tempfile.mkstemp

    def slow(dir):
        (state / "roofslip/study.key").write_bytes(others)
        return make(dir=dir)

    monkeypatch.setattr(tempfile, "mkstemp", slow)
    assert user_key() == others
    assert [path.name for path in (state / "roofslip").iterdir()] == ["study.key"]


def test_threads_that_make_it_at_once_agree(tmp_path, monkeypatch):
    for number in range(20):
        monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / str(number)))
        with ThreadPoolExecutor(8) as pool:
            assert len(set(pool.map(lambda _: user_key(), range(8)))) == 1


@pytest.mark.parametrize("content", [b"", b"short", bytes(KEY_BYTES + 1)])
def test_a_damaged_key_signs_nothing(state, content):
    user_key()
    (state / "roofslip/study.key").write_bytes(content)
    with pytest.raises(InputError, match=rf"study\.key: damaged, {len(content)} bytes.*delete it"):
        user_key()


def test_a_study_whose_key_cannot_be_kept_says_what_to_do_before_it_runs(state, tmp_path):
    state.write_bytes(b"a file, no folder")
    folder = write(tmp_path / "job")
    done = command(folder)
    assert done.exit_code == 2
    assert f"{state / 'roofslip'}" in done.output
    assert "cannot be kept there (Not a directory)" in done.output
    assert "set XDG_STATE_HOME to a folder of yours" in done.output
    assert not (folder / "out").exists()


def test_a_user_without_a_home_is_told_what_to_do(monkeypatch):
    def none():
        raise RuntimeError("Could not determine home directory.")

    monkeypatch.delenv("XDG_STATE_HOME")
    monkeypatch.setattr(Path, "home", none)
    with pytest.raises(InputError, match=r"your state folder: .* set XDG_STATE_HOME"):
        user_key()


@pytest.mark.parametrize(
    ("platform", "given", "wanted"),
    [
        ("linux", {"XDG_STATE_HOME": "/theirs"}, "/theirs"),
        ("linux", {"XDG_STATE_HOME": "relative"}, "/users/ann/.local/state"),
        ("linux", {}, "/users/ann/.local/state"),
        ("darwin", {}, "/users/ann/Library/Application Support"),
        ("win32", {"LOCALAPPDATA": "/local"}, "/local"),
        ("win32", {}, "/users/ann/AppData/Local"),
    ],
)
def test_the_state_folder_is_that_of_the_platform(monkeypatch, platform, given, wanted):
    for name in ("XDG_STATE_HOME", "LOCALAPPDATA"):
        monkeypatch.delenv(name, raising=False)
    for name, value in given.items():
        monkeypatch.setenv(name, value)
    monkeypatch.setattr("sys.platform", platform)
    monkeypatch.setattr(Path, "home", lambda: Path("/users/ann"))
    assert state_folder() == Path(wanted)
