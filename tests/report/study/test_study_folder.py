"""The folder of a study: what is in its place, and parts of another user or machine."""

import html
import json
import shutil

import numpy as np
import pytest

import printed
import stranger
from report.cli.study import make
from report.study.exports import export_files
from report.study.run import planned, run_study
from report.study.wording import headline
from solver.files import LOCK, locked
from solver.model import InputError
from studied import forged
from study_books import command, sheet_rows, small, write


@pytest.mark.quick
def test_a_study_does_not_replace_its_own_workbook(tmp_path):
    folder = write(tmp_path, small())
    book = (folder / "input.xlsx").rename(folder / "study.xlsx")
    content = book.read_bytes()
    done = command(book, "--out", folder)
    assert done.exit_code == 2, done.output
    assert "is an input of this run, and would be replaced by its study.xlsx" in done.output
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
    assert told[1].startswith(f"  {out / 'study'}: has the results of input.xlsx, not of b.xlsx;")
    assert told[2].startswith(f"{out / 'study' / 'study.pdf'} and ")
    study, before = (folder / "study.xlsx" for folder in (out / "study", made[0] / "out" / "study"))
    assert study.read_bytes() == before.read_bytes()


def test_a_second_study_in_the_same_folder_waits_and_then_says_so(tmp_path, monkeypatch):
    monkeypatch.setattr("solver.files.WAIT_S", 0.1)
    folder = write(tmp_path, small())
    runs = folder / "out" / "study" / "runs"
    runs.mkdir(parents=True)
    plan, _ = planned(folder)
    with locked(runs), pytest.raises(InputError, match="another command has been writing there"):
        make(plan, runs.parent, lambda _: None)
    assert list(runs.iterdir()) == []


@pytest.fixture
def forged_study(made, tmp_path):
    """A plan, the folder of its outputs, and its study after part 0 was forged."""
    out = shutil.copytree(made[0] / "out" / "study", tmp_path / "out")
    forged(out / "runs" / "part-00000.parquet")
    return planned(made[0])[0], out


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
def test_a_forged_part_is_computed_again_and_the_user_is_told(forged_study, results):
    plan, out = forged_study
    with pytest.warns(
        UserWarning, match=r": 1 part \([0-9,]+ runs\) without .*--trust-parts takes"
    ):
        found = run_study(plan, out)
    assert np.array_equal(found.curves.mean_m, results.curves.mean_m, equal_nan=True)
    (own,) = found.manifest["taken_over"]
    assert 0 < own["runs"] < found.manifest["rows"]


@pytest.mark.nightly
def test_a_forged_part_is_taken_over_on_the_word_of_the_option_and_every_file_says_so(
    forged_study, results
):
    plan, out = forged_study
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
    assert told in printed.study(found)
    assert {"What": "Runs taken over", "Value": told} in sheet_rows(found, "Study")
    exports = export_files(found)
    assert len(exports) == 4
    for content in exports.values():
        text = content.decode() if isinstance(content, bytes) else content
        assert f"{told}." in html.unescape(text)
    with pytest.warns(UserWarning, match="computed again"):
        run_study(plan, out)  # taken over, it is not signed


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
    assert "warning: computed again: 1 part (" in done.output
    assert "on the word of" not in done.output


STUDY = ("out", "out/study", "out/study/runs", "out/study/manifest.json", "out/study/study.xlsx",
         "out/study/runs/part-00000.parquet", f"out/study/runs/{LOCK}")  # fmt: skip


@pytest.mark.parametrize(
    ("place", "kind"),
    [(place, kind) for place in STUDY for kind in ("link", "dangling link", "pipe", "device")]
    + [(place, "hard link") for place in STUDY if place.endswith(LOCK)],
)
def test_a_study_is_not_written_through_what_is_in_its_place(tmp_path, place, kind):
    outside = tmp_path / "outside"
    outside.write_bytes(b"theirs")
    job = write(tmp_path / "job", small())
    (job / place).parent.mkdir(parents=True, exist_ok=True)
    stranger.occupied(job / place, kind, outside)
    before = stranger.state(tmp_path)
    told = command(job).output
    assert f"{job / place}: is a" in told
    assert stranger.state(tmp_path) == before
