"""Parts of a study, here or on a Dask cluster: whole or not there, run again where damaged."""

import json
import os
import shutil
import signal
import subprocess
import sys
import time
from dataclasses import replace

import numpy as np
import pandas as pd
import pyarrow.parquet as pq
import pytest

from fixtures.campaigns import KEY, campaign, forged, row_bytes
from fixtures.paths import ROOT, TESTS
from fixtures.study_workbooks import command, write
from report.study.cluster import connected, run_on_cluster
from report.study.manifest import NAME, check_earlier, manifest_of
from report.study.parquet_parts import (
    begin,
    done_parts,
    finished,
    part_name,
    peaks,
    read_part,
    run_missing,
    signed,
)
from solver.errors import InputError
from solver.sliding.model_selection import Model
from solver.studies.runs import LENGTHS, STATUSES, Runner, run_part

NAMES = ["roof"]


def run(folder, c, about=None):
    """Run what is missing; return the manifest and the numbers of the parts that ran."""
    manifest = manifest_of(c, about or {})
    begin(folder, manifest, check_earlier(folder, manifest))
    identity, ran = manifest["identity"], []
    found = done_parts(folder, c, identity, KEY)
    had = {number for number, part in found.items() if part.is_own}
    missing = [number for number in range(len(c.parts)) if number not in had]
    run_missing(
        folder, c, identity, NAMES, missing, KEY, lambda done: ran.append(done.about.number)
    )
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
    done = done_parts(folder, c, manifest["identity"], KEY)
    found = [peaks(read_part(folder, done[k]), c) for k in sorted(done)]
    prd = np.concatenate([prd_m for prd_m, _ in found])
    assert np.array_equal(prd.ravel(), wanted.to_numpy(), equal_nan=True)
    assert np.isnan(prd).any()
    slips = (rows["model"] != "no slip").groupby([rows[k] for k in keys], observed=True, sort=False)
    assert np.concatenate([slips for _, slips in found]).ravel().tolist() == slips.any().tolist()


@pytest.mark.parametrize("place", ["rows", "footer", b"roofslip sha256=", b" hmac=", b"computed"])
def test_a_flipped_byte_is_found_and_the_part_run_again(copy, place):
    folder, c, _ = copy
    path = folder / part_name(3)
    good, rows = path.read_bytes(), row_bytes(path)
    at = {"rows": 100, "footer": len(good) - 12}.get(place)
    at = good.index(place) + len(place) + 5 if at is None else at
    path.write_bytes(good[:at] + bytes([good[at] ^ 1]) + good[at + 1 :])
    (folder / part_name(5)).unlink()
    assert run(folder, c)[1] == [3, 5]
    assert row_bytes(path) == rows


@pytest.mark.parametrize("length", [0, 3, 500])
def test_a_part_that_ends_early_is_run_again(copy, length):
    folder, c, _ = copy
    path = folder / part_name(2)
    path.write_bytes(path.read_bytes()[:length])
    assert run(folder, c)[1] == [2]


def test_a_forged_part_with_a_new_sha_256_is_run_again(copy):
    """Signed with the key of somebody else, and with the HMAC that the part had."""
    folder, c, manifest = copy
    paths = [folder / part_name(number) for number in (1, 4)]
    rows, had = list(map(row_bytes, paths)), paths[1].read_bytes()
    for path in paths:
        forged(path)
    two = paths[1].read_bytes()
    at, before = (content.index(b" hmac=") + 6 for content in (two, had))
    paths[1].write_bytes(two[:at] + had[before : before + 64] + two[at + 64 :])
    found = done_parts(folder, c, manifest["identity"], KEY)
    assert [number for number, part in found.items() if not part.is_own] == [1, 4]
    assert run(folder, c)[1] == [1, 4]
    assert list(map(row_bytes, paths)) == rows


def test_a_part_of_another_key_is_whole_or_not(copy):
    folder, c, manifest = copy
    for number, at in ((0, None), (1, 100)):
        path = folder / part_name(number)
        forged(path)
        if at:
            content = path.read_bytes()
            path.write_bytes(content[:at] + bytes([content[at] ^ 1]) + content[at + 1 :])
    found = done_parts(folder, c, manifest["identity"], KEY)
    assert not found[0].is_own
    assert found[0].about.computed.year == 2001
    assert 1 not in found


@pytest.mark.parametrize("altered", ["rows", "words", "nothing said"])
def test_a_part_that_only_looks_like_one_is_run_again(copy, altered):
    folder, c, manifest = copy
    path, other = folder / part_name(3), folder / part_name(4)
    if altered == "rows":
        table, said = pq.read_table(path).slice(1), pq.read_metadata(path).metadata
    else:
        table, said = pq.read_table(path), pq.read_metadata(other).metadata
    if altered == "nothing said":
        said = {b"roofslip_signature": said[b"roofslip_signature"]}
    with pq.ParquetWriter(path, table.schema) as writer:
        writer.write_table(table)
        writer.add_key_value_metadata({k: v for k, v in said.items() if k != b"ARROW:schema"})
    path.write_bytes(signed(path.read_bytes(), KEY))
    assert 3 not in done_parts(folder, c, manifest["identity"], KEY)
    assert run(folder, c)[1] == [3]


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
    done = done_parts(folder, fewer, manifest["identity"], KEY)
    full = finished(folder, manifest, list(done.values()))
    assert len(list(folder.glob("part-*"))) == len(fewer.parts)
    assert sum(full["models"].values()) == fewer.rows
    assert full["agreement"].startswith("all batches ran on one processor model")


@pytest.mark.quick
def test_a_file_with_the_name_of_a_part_is_neither_replaced_nor_removed(tmp_path):
    for at, name in enumerate((part_name(0), part_name(99999))):
        folder = tmp_path / str(at) / "runs"
        folder.mkdir(parents=True)
        (folder / name).write_bytes(b"mine")
        with pytest.raises(InputError, match=f"{name}: has the name of a part of a study"):
            run(folder, campaign("x", 1))
        assert (folder / name).read_bytes() == b"mine"


def test_parts_of_several_processor_models_are_stated(copy):
    folder, c, manifest = copy
    first, *others = done_parts(folder, c, manifest["identity"], KEY).values()
    first = replace(first, about=replace(first.about, machine="another processor"))
    assert "1e-12" in finished(folder, manifest, [first, *others])["agreement"]


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
     ('{"schema_version": 1}', "not the manifest of a study"),
     ('{"schema_version": 99, "program": {}}', "schema_version 99")],
)  # fmt: skip
def test_a_damaged_manifest_or_one_of_another_schema_is_refused(copy, text, wanted):
    folder, c, _ = copy
    (folder.parent / NAME).write_text(text)
    with pytest.raises(InputError, match=wanted):
        run(folder, c)


@pytest.mark.quick
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
from test_study_parts import KEY, NAMES, campaign
from report.study.manifest import manifest_of
from report.study.parquet_parts import begin, done_parts, run_missing
c = campaign("xyz", 2)
manifest = manifest_of(c, {{}})
folder = Path({folder!r})
begin(folder, manifest, 0)
had = done_parts(folder, c, manifest["identity"], KEY)
missing = [k for k in range(len(c.parts)) if k not in had]
print("ready", flush=True)
run_missing(folder, c, manifest["identity"], NAMES, missing, KEY, lambda done: None)
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
        reached = len(done_parts(folder, c, identity, KEY))
    _, ran = run(folder, c)
    assert len(ran) == len(c.parts) - reached
    # Only names that are written are touched: what was staged when it was killed stays, hidden.
    assert {path.suffix for path in folder.glob(".roofslip-*")} <= {".part"}
    peace = tmp_path / "peace"
    run(peace, c)
    for number in range(len(c.parts)):
        assert row_bytes(folder / part_name(number)) == row_bytes(peace / part_name(number))


def test_a_part_changed_while_it_is_read_is_refused(copy):
    folder, c, manifest = copy
    done = done_parts(folder, c, manifest["identity"], KEY)
    (folder / part_name(0)).write_bytes(b"PAR1")
    with pytest.raises(InputError, match="changed meanwhile"):
        read_part(folder, done[0])


def test_the_parquet_is_that_of_any_reader(studied):
    """DuckDB reads it in a process of its own: it reports its leaks as it ends."""
    pytest.importorskip("duckdb")
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


LOOPBACK = "127.0.0.1:0"
"""Of the dashboard, which otherwise listens on every address of the machine."""

OF_DASK = pytest.mark.filterwarnings("ignore")


@pytest.fixture(scope="module")
def cluster():
    from distributed import LocalCluster

    with LocalCluster(
        n_workers=2, threads_per_worker=1, processes=True, dashboard_address=LOOPBACK
    ) as local:
        yield local


@OF_DASK
@pytest.mark.nightly
def test_killed_workers_lose_nothing_and_every_row_has_the_bytes_of_this_machine(cluster, tmp_path):
    c = campaign("xyz", 2)
    manifest = manifest_of(c, {})
    identity, numbers = manifest["identity"], range(len(c.parts))
    there, here = tmp_path / "there", tmp_path / "here"
    begin(here, manifest, n_earlier=0)
    run_missing(here, c, identity, NAMES, numbers, KEY, lambda done: None)
    killed = []

    def on_done(done):
        if not killed:
            killed.extend(client.run(os.getpid).values())
            for process in killed:
                os.kill(process, signal.SIGKILL)

    with connected(cluster.scheduler_address, manifest) as client:
        begin(there, manifest, n_earlier=0)
        run_on_cluster(client, there, c, identity, NAMES, numbers, KEY, on_done)
    assert len(killed) == 2
    assert sorted(done_parts(there, c, identity, KEY)) == list(numbers)
    for number in numbers:
        assert row_bytes(there / part_name(number)) == row_bytes(here / part_name(number))


@pytest.mark.nightly
@OF_DASK
def test_workers_of_another_version_are_an_error_before_anything_runs(cluster):
    manifest = manifest_of(campaign("x"), {})
    manifest["program"] = {**manifest["program"], "numba": "0.1"}
    with (
        pytest.raises(InputError, match="install the same versions") as caught,
        connected(cluster.scheduler_address, manifest),
    ):
        pass
    assert "here 0.1" in str(caught.value)


@OF_DASK
@pytest.mark.nightly
def test_a_study_runs_on_a_cluster(cluster, tmp_path):
    folder = write(tmp_path)
    done = command(folder, "--scheduler", cluster.scheduler_address, "--quiet")
    assert done.exit_code == 0, done.output
    assert (folder / "out" / "study" / "study.pdf").is_file()


@OF_DASK
def test_a_cluster_without_workers_is_an_error():
    from distributed import LocalCluster

    with (
        LocalCluster(n_workers=0, processes=False, dashboard_address=LOOPBACK) as empty,
        pytest.raises(InputError, match="has no worker"),
        connected(empty.scheduler_address, manifest_of(campaign("x"), {})),
    ):
        pass


@OF_DASK
@pytest.mark.parametrize(
    ("address", "wanted"),
    [("tcp://127.0.0.1:9", "no Dask scheduler answers"), ("nowhere://x", "nowhere://x")],
)
@pytest.mark.nightly
def test_a_cluster_that_cannot_be_reached_is_an_error_before_anything_runs(
    tmp_path, monkeypatch, address, wanted
):
    monkeypatch.setattr("report.study.cluster.TIMEOUT_S", 0.5)
    folder = write(tmp_path)
    done = command(folder, "--scheduler", address)
    assert done.exit_code == 2
    assert wanted in done.output
    assert not (folder / "out").exists()
