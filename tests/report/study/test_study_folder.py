"""The folder of a study, parts of another user or machine, and the key that signs one's own."""

import json
import shutil
import stat
import tempfile
from pathlib import Path

import numpy as np
import pytest

from fixtures import folders, pages
from fixtures.campaigns import forged
from fixtures.marks import by_day
from fixtures.study_workbooks import command, sheet_rows, small, write
from report.study.exports import export_files
from report.study.outputs import make_study
from report.study.run_study import planned, run_study
from report.study.sentences import headline
from report.study.user_key import KEY_BYTES, state_folder, user_key
from solver.errors import InputError
from solver.file_writing import LOCK, locked


@pytest.mark.quick
def test_a_study_does_not_replace_its_own_workbook(tmp_path):
    folder = write(tmp_path, small())
    book = (folder / "input.xlsx").rename(folder / "study.xlsx")
    content = book.read_bytes()
    done = command(book, "--out", folder)
    assert done.exit_code == 2, done.output
    assert "is an input of this run and would be replaced by its study.xlsx" in done.output
    assert book.read_bytes() == content
    assert not (folder / "runs").exists()


def test_a_study_does_not_begin_in_place_of_a_file(tmp_path):
    folder = write(tmp_path, small())
    (tmp_path / "out").write_text("mine")
    done = command(folder)
    assert done.exit_code == 2
    assert "is a file, not a folder, and is not written to" in done.output


@pytest.mark.nightly
def test_a_study_does_not_replace_the_results_of_another_workbook(made, tmp_path):
    out = shutil.copytree(made[0] / "out", tmp_path / "out")
    book = (write(tmp_path, small()) / "input.xlsx").rename(tmp_path / "b.xlsx")
    done = command(book)
    assert done.exit_code == 2
    told = done.output.splitlines()
    assert told[1].startswith(
        f"  {out / 'study'}: contains the results of input.xlsx, not of b.xlsx;"
    )
    assert told[2].startswith(f"{out / 'study' / 'study.pdf'} and ")
    study, before = (folder / "study.xlsx" for folder in (out / "study", made[0] / "out" / "study"))
    assert study.read_bytes() == before.read_bytes()


def test_a_second_study_in_the_same_folder_waits_and_then_says_so(tmp_path, monkeypatch):
    monkeypatch.setattr("solver.file_writing.WAIT_S", 0.1)
    folder = write(tmp_path, small())
    runs = folder / "out" / "study" / "runs"
    runs.mkdir(parents=True)
    plan, _ = planned(folder)
    with locked(runs), pytest.raises(InputError, match="another command has been writing there"):
        make_study(plan, runs.parent, lambda _: None)
    assert list(runs.iterdir()) == []


@pytest.mark.nightly
def test_runs_that_are_taken_over_are_stated_with_their_dates(made, results):
    """The first study took over nothing; that which went on with its parts says so."""
    today = json.loads((made[0] / "out/study/manifest.json").read_text())["taken_over"]
    rows = results.manifest["rows"]
    (one,) = today
    assert one == {**one, "runs": rows, "on_the_word_of": "the key of this user"}
    told = (
        f"{rows:,} of the {rows:,} runs were taken over from parts that are signed with the key of"
        f" this user and were computed on {one['from']} (UTC)"
    )
    assert told in headline(results)
    assert "taken over" not in made[1]
    assert {"What": "Runs taken over", "Value": told} in sheet_rows(results, "Study")


@pytest.mark.nightly
def test_a_forged_part_is_taken_over_on_the_word_of_the_option_and_every_file_says_so(
    made, results, tmp_path
):
    out = shutil.copytree(made[0] / "out" / "study", tmp_path / "out")
    forged(out / "runs" / "part-00000.parquet")
    plan, _ = planned(made[0])
    found = run_study(plan, out, trust_parts=True, allow_matched=True)
    slid = results.curves.mean_m > 0.0
    shares = found.curves.mean_m[slid] / results.curves.mean_m[slid]
    assert shares.min() == pytest.approx(0.25)
    own, other = found.manifest["taken_over"]
    assert own["runs"] + other["runs"] == found.manifest["rows"]
    assert other["on_the_word_of"] == "--trust-parts"
    told = (
        f"{other['runs']:,} of the {found.manifest['rows']:,} runs were taken over on the word of"
        " --trust-parts: their parts are not signed with the key of this user and state that they"
        " were computed on 2001-02-03 (UTC)"
    )
    assert json.loads((out / "manifest.json").read_text())["taken_over"] == [own, other]
    assert told in pages.study(found)
    assert {"What": "Runs taken over", "Value": told} in sheet_rows(found, "Study")
    assert f"{told}." in export_files(found)["fragility.csv"].decode()
    again = r"recomputed: [0-9,]+ runs in 1 of \d+ batches not signed .*--trust-parts also reuses"
    with pytest.warns(UserWarning, match=again):
        found = run_study(plan, out)  # taken over, it is not signed
    assert np.array_equal(found.curves.mean_m, results.curves.mean_m, equal_nan=True)
    (own,) = found.manifest["taken_over"]
    assert 0 < own["runs"] < found.manifest["rows"]


@pytest.mark.filterwarnings("always::UserWarning")  # the command prints them
@pytest.mark.nightly
def test_the_command_takes_forged_parts_over_only_when_told_to(made, tmp_path):
    folder = shutil.copytree(made[0], tmp_path / "job")
    forged(folder / "out/study/runs/part-00000.parquet")
    done = command(folder, "--trust-parts")
    assert done.exit_code == 0, done.output
    assert "on the word of --trust-parts" in done.output
    done = command(folder)
    assert done.exit_code == 0, done.output
    assert "warning: recomputed:" in done.output
    assert "on the word of" not in done.output


STUDY = ("out", "out/study", "out/study/runs", "out/study/manifest.json", "out/study/study.xlsx",
         "out/study/runs/part-00000.parquet", f"out/study/runs/{LOCK}")  # fmt: skip


@pytest.mark.parametrize(
    ("place", "kind"),
    by_day(
        [(place, kind) for place in STUDY for kind in ("link", "dangling link", "pipe", "device")],
        2,
    )
    + [(place, "hard link") for place in STUDY if place.endswith(LOCK)],
)
def test_a_study_is_not_written_through_what_is_in_its_place(tmp_path, place, kind):
    outside = tmp_path / "outside"
    outside.write_bytes(b"theirs")
    job = write(tmp_path / "job", small())
    (job / place).parent.mkdir(parents=True, exist_ok=True)
    folders.occupied(job / place, kind, outside)
    before = folders.state(tmp_path)
    told = command(job).output
    assert f"{job / place}: is a" in told
    assert folders.state(tmp_path) == before


@pytest.fixture
def state(tmp_path, monkeypatch):
    """The state folder of a user, in which nothing is."""
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))
    return tmp_path / "state"


@pytest.mark.quick
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


@pytest.mark.parametrize("content", [b"", bytes(KEY_BYTES + 1)])
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
    assert "cannot be stored there (Not a directory)" in done.output
    assert "set XDG_STATE_HOME to a folder of yours" in done.output
    assert not (folder / "out").exists()


@pytest.mark.quick
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
