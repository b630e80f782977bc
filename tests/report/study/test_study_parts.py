"""Parts of a study: whole or not there, run again where they are missing or damaged."""

import json
import os
import shutil
import signal
import subprocess
import sys
import time

import numpy as np
import pandas as pd
import pytest

from places import ROOT, TESTS
from report.study.manifest import NAME, check_former, manifest_of
from report.study.parts import (
    JOURNAL,
    begin,
    done_parts,
    finished,
    part_name,
    peaks,
    read_part,
    run_missing,
)
from solver.model import InputError
from solver.sliding.least_model import Model
from solver.studies.runs import LENGTHS, STATUSES, Runner, run_part
from studied import campaign

NAMES = ["roof"]


def run(folder, c, about=None):
    """Run what is missing; return the manifest and the numbers of the parts that ran."""
    manifest = manifest_of(c, about or {})
    check_former(folder, manifest)
    begin(folder, manifest)
    identity, ran = manifest["identity"], []
    had = done_parts(folder, c, identity)
    missing = [number for number in range(len(c.parts)) if number not in had]
    run_missing(folder, c, identity, NAMES, missing, lambda done: ran.append(done.number))
    return manifest, sorted(ran)


def table(folder, c):
    parts = [pd.read_parquet(folder / part_name(k)) for k in range(len(c.parts))]
    return pd.concat(parts, ignore_index=True)


@pytest.fixture(scope="module")
def studied(tmp_path_factory):
    folder, c = tmp_path_factory.mktemp("study") / "runs", campaign("xz")
    manifest, ran = run(folder, c)
    assert ran == list(range(len(c.parts)))
    return folder, c, manifest


@pytest.fixture
def copy(studied, tmp_path):
    folder, c, manifest = studied
    shutil.copytree(folder.parent, tmp_path / "study")
    return tmp_path / "study" / "runs", c, manifest


def test_every_run_is_one_row(studied):
    folder, c, _ = studied
    rows = table(folder, c)
    assert len(rows) == c.rows
    keys = ["slope_deg", "mu", "intensity", "motion", "component", "polarity"]
    assert not rows.duplicated(keys).any()
    assert sorted(rows["slope_deg"].unique()) == [0.0, 2.0, 6.0]
    assert set(rows["building"]) == {"roof"}


def test_rows_hold_the_bits_of_the_runs(studied):
    folder, c, _ = studied
    rows = table(folder, c)
    whole = run_part(Runner(c), slice(0, len(c.cases)))
    for name, values in zip(LENGTHS, whole.lengths, strict=True):
        assert np.array_equal(rows[name].to_numpy(), values.ravel(), equal_nan=True)
    assert rows["status"].tolist() == [STATUSES[s].value for s in whole.status.ravel()]
    assert rows["model"].tolist() == [Model(r).title for r in whole.model.ravel()]
    assert (np.radians(rows["slope_deg"]) == rows["slope_rad"]).all()


def test_peaks_are_the_largest_of_the_headings_and_none_without_a_final_value(studied):
    folder, c, manifest = studied
    rows = table(folder, c)
    rows.loc[rows["status"] != "ok", "prd_m"] = np.nan
    keys = ["slope_deg", "mu", "intensity", "motion"]
    wanted = rows.groupby(keys, observed=True, sort=False)["prd_m"].apply(
        lambda v: v.max(skipna=False)
    )
    done = done_parts(folder, c, manifest["identity"])
    found = [peaks(read_part(folder, done[k]), c) for k in sorted(done)]
    prd = np.concatenate([part.prd_m for part in found])
    assert np.array_equal(prd.ravel(), wanted.to_numpy(), equal_nan=True)
    assert np.isnan(prd).any()
    slips = (rows["model"] != "no slip").groupby([rows[k] for k in keys], observed=True, sort=False)
    assert np.concatenate([part.slips for part in found]).ravel().tolist() == slips.any().tolist()


def test_a_damaged_part_is_found_and_run_again(copy):
    folder, c, _ = copy
    good = (folder / part_name(3)).read_bytes()
    (folder / part_name(3)).write_bytes(good[:100] + bytes([good[100] ^ 1]) + good[101:])
    (folder / part_name(5)).unlink()
    assert run(folder, c)[1] == [3, 5]
    assert (folder / part_name(3)).read_bytes() == good


def test_a_part_of_another_manifest_is_run_again(copy, tmp_path_factory):
    folder, c, _ = copy
    other = tmp_path_factory.mktemp("other") / "runs"
    run(other, campaign("x"))
    (folder / part_name(2)).write_bytes((other / part_name(2)).read_bytes())
    assert run(folder, c)[1] == [2]


def test_other_inputs_run_everything_again_and_leave_no_old_part(copy):
    folder, _c, _ = copy
    fewer = campaign("x", mus=(0.3,), intensities=(0.4, 0.8))
    manifest, ran = run(folder, fewer)
    assert ran == list(range(len(fewer.parts)))
    done = done_parts(folder, fewer, manifest["identity"])
    full = finished(folder, manifest, list(done.values()))
    assert len(list(folder.glob("part-*"))) == len(fewer.parts)
    assert sum(full["models"].values()) == fewer.rows
    assert full["agreement"].startswith("all parts ran on one processor model")


def test_a_file_with_the_name_of_a_part_is_neither_replaced_nor_removed(tmp_path):
    for at, name in enumerate((part_name(0), part_name(99999))):
        folder = tmp_path / str(at) / "runs"
        folder.mkdir(parents=True)
        (folder / name).write_bytes(b"mine")
        with pytest.raises(InputError, match=f"{name}: has the name of a part of a study"):
            run(folder, campaign("x", 1))
        assert (folder / name).read_bytes() == b"mine"


def test_a_part_without_its_line_in_the_journal_is_run_again(copy):
    folder, c, _ = copy
    journal = folder / JOURNAL
    journal.write_bytes(b"".join(journal.read_bytes().splitlines(keepends=True)[1:]))
    assert len(run(folder, c)[1]) == 1


def test_a_torn_line_of_the_journal_loses_one_part_only(copy):
    folder, c, _ = copy
    lines = (folder / JOURNAL).read_bytes().splitlines(keepends=True)
    lost = json.loads(lines[-1])["number"]
    (folder / JOURNAL).write_bytes(b"".join(lines)[:-20] + b"\n" + b"[" * 100_000 + b"\n")
    assert run(folder, c)[1] == [lost]
    assert run(folder, c)[1] == []


def test_parts_of_several_processor_models_are_stated(copy):
    folder, c, manifest = copy
    done = done_parts(folder, c, manifest["identity"])
    text = (folder / JOURNAL).read_text().replace(done[0].machine, "another processor", 1)
    (folder / JOURNAL).write_text(text)
    done = done_parts(folder, c, manifest["identity"])
    assert "1e-12" in finished(folder, manifest, list(done.values()))["agreement"]


@pytest.mark.parametrize("change", [{"numba": "0.1"}, {"solver_sha256": "0" * 64}])
def test_a_manifest_of_another_version_is_refused_with_what_to_do(copy, change):
    folder, c, manifest = copy
    other = manifest | {"program": manifest["program"] | change}
    (folder.parent / NAME).write_text(json.dumps(other))
    with pytest.raises(InputError, match="written by another version") as caught:
        run(folder, c)
    assert next(iter(change)) in str(caught.value)
    assert "--out" in str(caught.value)


@pytest.mark.parametrize(
    ("text", "wanted"),
    [("{", "not the manifest of a study"), ("[" * 100_000, "not the manifest of a study"),
     ("[]", "not the manifest of a study"),
     ('{"schema_version": 1}', "not the manifest of a study"), ('"x"', "not the manifest"),
     ('{"schema_version": 99, "program": {}}', "schema_version 99")],
)  # fmt: skip
def test_a_damaged_manifest_or_one_of_another_schema_is_refused(copy, text, wanted):
    folder, c, _ = copy
    (folder.parent / NAME).write_text(text)
    with pytest.raises(InputError, match=wanted):
        run(folder, c)


def test_what_determines_the_results_changes_the_identity():
    def identity(seed, *given, **changes):
        return manifest_of(campaign(*given, **changes), {"seed": seed})["identity"]

    one = identity(1, "x")
    assert one == identity(1, "x")
    others = {identity(2, "x"), identity(1, "xz"), identity(1, "x", mus=(0.3,))}
    assert one not in others | {identity(1, "x", samples=401)}


SLOW = """
import sys
sys.path.insert(0, {tests!r})
from pathlib import Path
from test_study_parts import NAMES, campaign
from report.study.manifest import manifest_of
from report.study.parts import begin, done_parts, run_missing
c = campaign("xyz", 2)
manifest = manifest_of(c, {{}})
folder = Path({folder!r})
begin(folder, manifest)
had = done_parts(folder, c, manifest["identity"])
missing = [k for k in range(len(c.parts)) if k not in had]
print("ready", flush=True)
run_missing(folder, c, manifest["identity"], NAMES, missing, lambda done: None)
"""


@pytest.mark.nightly
def test_a_study_killed_at_any_moment_goes_on_where_it_was(tmp_path):
    """Three runs are killed, after 1, 4 and 7 more parts; the rows are those of a run in peace."""
    folder, c = tmp_path / "killed", campaign("xyz", 2)
    here = str(TESTS / "report" / "study")
    code = SLOW.format(tests=here, folder=str(folder))
    env = os.environ | {"PYTHONPATH": f"{ROOT}{os.pathsep}{TESTS}"}
    identity, reached = manifest_of(c, {})["identity"], 0
    for more in (1, 4, 7):
        process = subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, env=env)
        process.stdout.readline()
        deadline = time.monotonic() + 60.0
        while len(list(folder.glob("part-*"))) < reached + more and process.poll() is None:
            assert time.monotonic() < deadline
            time.sleep(0.002)
        process.send_signal(signal.SIGKILL)
        process.wait()
        process.stdout.close()
        reached = len(done_parts(folder, c, identity))
    _, ran = run(folder, c)
    assert len(ran) == len(c.parts) - reached
    # Only names that are written are touched: what was staged when it was killed stays, hidden.
    assert {path.suffix for path in folder.glob(".roofslip-*")} <= {".part"}
    peace = tmp_path / "peace"
    run(peace, c)
    for number in range(len(c.parts)):
        one, two = ((top / part_name(number)).read_bytes() for top in (folder, peace))
        assert one == two


def test_a_part_changed_while_it_is_read_is_refused(copy):
    folder, c, manifest = copy
    done = done_parts(folder, c, manifest["identity"])
    (folder / part_name(0)).write_bytes(b"PAR1")
    with pytest.raises(InputError, match="changed meanwhile"):
        read_part(folder, done[0])


def test_the_parquet_is_that_of_any_reader(studied):
    """DuckDB reads it in a process of its own: it reports its leaks as it ends."""
    folder, c, _ = studied
    assert len(pd.read_parquet(folder)) == c.rows
    largest_m = "max(prd_m) filter (not isnan(prd_m))"  # it takes NaN as the largest
    query = f"select count(*), count(distinct motion), {largest_m} from '{folder}/part-*.parquet'"
    program = "import sys, duckdb; print(*duckdb.sql(sys.argv[1]).fetchall()[0])"
    done = subprocess.run(
        [sys.executable, "-c", program, query], capture_output=True, text=True, check=True
    )
    count, motions, largest = done.stdout.split()
    assert (int(count), int(motions)) == (c.rows, 2)
    assert float(largest) == pytest.approx(table(folder, c)["prd_m"].max())
