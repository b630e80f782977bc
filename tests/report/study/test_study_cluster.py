"""Parts on a Dask cluster: the same bytes as here, and none lost when all workers are killed."""

import os
import signal

import pytest

from report.study import run as clusters
from report.study.manifest import manifest_of
from report.study.parts import begin, done_parts, part_name, run_missing
from report.study.run import connected, run_on_cluster
from solver.model import InputError
from studied import KEY, campaign, row_bytes
from study_books import command, write

pytestmark = pytest.mark.filterwarnings("ignore")


LOOPBACK = "127.0.0.1:0"
"""Of the dashboard, which otherwise listens on every address of the machine."""


@pytest.fixture(scope="module")
def cluster():
    from distributed import LocalCluster

    with LocalCluster(
        n_workers=2, threads_per_worker=1, processes=True, dashboard_address=LOOPBACK
    ) as local:
        yield local


NAMES = ["roof"]


@pytest.mark.nightly
def test_killed_workers_lose_nothing_and_every_row_has_the_bytes_of_this_machine(cluster, tmp_path):
    c = campaign("xyz", 2)
    manifest = manifest_of(c, {})
    identity, numbers = manifest["identity"], range(len(c.parts))
    there, here = tmp_path / "there", tmp_path / "here"
    begin(here, manifest, former=0)
    run_missing(here, c, identity, NAMES, numbers, KEY, lambda done: None)
    killed = []

    def on_done(done):
        if not killed:
            killed.extend(client.run(os.getpid).values())
            for process in killed:
                os.kill(process, signal.SIGKILL)

    with connected(cluster.scheduler_address, manifest) as client:
        begin(there, manifest, former=0)
        run_on_cluster(client, there, c, identity, NAMES, numbers, KEY, on_done)
    assert len(killed) == 2
    assert sorted(done_parts(there, c, identity, KEY)) == list(numbers)
    for number in numbers:
        assert row_bytes(there / part_name(number)) == row_bytes(here / part_name(number))


def test_workers_of_another_version_are_an_error_before_anything_runs(cluster):
    manifest = manifest_of(campaign("x"), {})
    manifest["program"] = {**manifest["program"], "numba": "0.1"}
    with (
        pytest.raises(InputError, match="install the same versions") as caught,
        connected(cluster.scheduler_address, manifest),
    ):
        pass
    assert "here 0.1" in str(caught.value)


@pytest.mark.nightly
def test_a_study_runs_on_a_cluster(cluster, tmp_path):
    folder = write(tmp_path)
    done = command(folder, "--scheduler", cluster.scheduler_address, "--quiet")
    assert done.exit_code == 0, done.output
    assert (folder / "out" / "study" / "study.pdf").is_file()


def test_a_cluster_without_workers_is_an_error():
    from distributed import LocalCluster

    with (
        LocalCluster(n_workers=0, processes=False, dashboard_address=LOOPBACK) as empty,
        pytest.raises(InputError, match="has no worker"),
        connected(empty.scheduler_address, manifest_of(campaign("x"), {})),
    ):
        pass


@pytest.mark.parametrize(
    ("address", "wanted"),
    [("tcp://127.0.0.1:9", "no Dask scheduler answers"), ("nowhere://x", "nowhere://x")],
)
@pytest.mark.nightly
def test_a_cluster_that_cannot_be_reached_is_an_error_before_anything_runs(
    tmp_path, monkeypatch, address, wanted
):
    monkeypatch.setattr(clusters, "TIMEOUT_S", 0.5)
    folder = write(tmp_path)
    done = command(folder, "--scheduler", address)
    assert done.exit_code == 2
    assert wanted in done.output
    assert not (folder / "out").exists()
