"""What several tests share: real records, where they lie beside the checkout, and seeded noise."""

from pathlib import Path

import numpy as np
import pytest

RECORDS = Path(__file__).resolve().parents[2] / "shared" / "records"
SAMPLES = Path(__file__).parent / "data" / "motions"
G = 9.80665


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
