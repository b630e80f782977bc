"""What several tests share: real records, where they lie beside the checkout, and seeded noise."""

import gc
import os
import signal
import sys
from contextlib import contextmanager

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # the matrices are small: as in ./roofslip
os.environ["ROOFSLIP_VERSION"] = "0.4.0"  # golden texts and pictures are the same at every commit

import numpy as np
import pytest
from hypothesis import settings

import report  # noqa: F401 - before any test loads openpyxl: the package decides what that reads with
import solver.kernels  # noqa: F401 - on Windows it adds a library that numba needs
from fixtures.browser import chromium
from fixtures.paths import RECORDS, SAMPLES

G = 9.80665

gc.disable()  # until all tests are collected: their modules live to the end

# A run in the background of a shell ignores interrupts, and so would all that the tests start.
signal.signal(signal.SIGINT, signal.default_int_handler)

pytest_plugins = ("fixtures.golden",)

settings.register_profile("roofslip", deadline=None)  # a busy machine is no failure
settings.load_profile("roofslip")


def pytest_collection_finish(session):
    """Take what is loaded out of garbage collections: a sixth of the time of tests of workbooks."""
    gc.collect()
    gc.freeze()
    gc.set_threshold(100_000, 20, 100)
    gc.enable()


def pytest_sessionfinish():
    """Save what a process of tests has covered: it is killed if it takes 10 s to end."""
    coverage = sys.modules.get("coverage")
    if coverage and (measured := coverage.Coverage.current()):
        measured.stop()
        measured.save()


@pytest.fixture(scope="session", autouse=True)
def state_folder(tmp_path_factory):
    """No test makes a key in the user's own folder."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("XDG_STATE_HOME", str(tmp_path_factory.mktemp("state")))
        yield


@pytest.fixture(scope="session")
def real_records():
    """Plain-column accelerograms [m/s2] by name, with their sampling interval."""
    if not RECORDS.is_dir():
        pytest.skip("the real records are not here; noise covers the same code")
    steps = {"Kobe": 0.02, "Northridge": 0.01, "Imperial": 0.01, "Landers": 0.005, "Cape": 0.02}
    return {
        path.stem: (np.loadtxt(path) * G, steps[path.name.split("_")[0]])
        for path in sorted(RECORDS.glob("*.txt"))
        if path.name.split("_")[0] in steps
    }


@pytest.fixture(scope="session")
def noise():
    """A seeded record of band-limited noise, 20 s at 0.01 s, peak near 1 g."""
    rng = np.random.default_rng(7)
    t = np.arange(2000) * 0.01
    freq = rng.uniform(0.3, 12.0, 60)
    phase = rng.uniform(0.0, 2 * np.pi, 60)
    wave = np.sin(2 * np.pi * freq * t[:, None] + phase).sum(axis=1)
    return G * wave / np.abs(wave).max() * np.sin(np.pi * t / 20.0)


@pytest.fixture
def files_up_to():
    """A context in which no file grows beyond some bytes: a write fails as on a full disk."""
    resource = pytest.importorskip("resource", reason="Windows does not limit the size of files")

    @contextmanager
    def limited(size):
        before = resource.getrlimit(resource.RLIMIT_FSIZE)
        resource.setrlimit(resource.RLIMIT_FSIZE, (size, before[1]))
        try:
            yield
        finally:
            resource.setrlimit(resource.RLIMIT_FSIZE, before)

    return limited


@pytest.fixture
def file(tmp_path):
    """A function that writes a file of text or bytes and returns its path."""

    def write(content, name="roof.csv"):
        path = tmp_path / name
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        return path

    return write


@pytest.fixture
def altered(file):
    """A function that writes a sample file with old texts replaced and returns its path."""

    def write(name, *changes):
        text = (SAMPLES / name).read_bytes().decode()
        for old, new in changes:
            assert old in text, old
            text = text.replace(old, new, 1)
        return file(text, name)

    return write


# Of a module: while it is open, asyncio.run of another library fails in the same thread.
@pytest.fixture(scope="module")
def browser():
    """Debian's Chromium."""
    with chromium() as started:
        yield started
