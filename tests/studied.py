"""Small campaigns for the tests of studies."""

import json

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq

from report.study.parts import signed
from solver.model import Motion
from solver.studies.runs import LENGTHS, Campaign, grid

SLOPES = np.radians([0.0, 2.0, 6.0])
MUS = (0.0, 0.05, 0.3, 0.5, 0.7)
INTENSITIES = (0.05, 0.4, 0.8, 1.2, 2.5, 12.0)


def frozen(values):
    array = np.array(values, dtype=float)
    array.setflags(write=False)
    return array


def wave(seed, samples=400, dt=0.02):
    """Noise of a few sinusoids with a peak of 1 g that begins and ends with zero."""
    rng = np.random.default_rng(seed)
    t = dt * np.arange(samples)
    freq, phase = rng.uniform(0.5, 6.0, (2, 12))
    a = np.sin(2.0 * np.pi * freq * t[:, None] + phase).sum(axis=1) * np.sin(np.pi * t / t[-1])
    return frozen(9.80665 * a / np.abs(a).max())


def motion(number, letters="x", *, samples=400, signs=(1, -1)):
    """A motion whose intensity 1 is a peak of 1 g."""
    none = frozen([])
    return Motion(
        id=f"M{number}", source="", dt_s=0.02, scale=1.0, signs=signs,
        ax_mps2=wave(3 * number, samples),
        ay_mps2=wave(3 * number + 1, samples) if "y" in letters else none,
        az_mps2=frozen(0.4 * wave(3 * number + 2, samples)) if "z" in letters else none,
    )  # fmt: skip


def campaign(letters="x", count=2, *, mus=MUS, intensities=INTENSITIES, buildings=1, samples=400):
    sets = tuple(
        tuple(motion(10 * b + k, letters, samples=samples) for k in range(count))
        for b in range(buildings)
    )
    return Campaign(motions=sets, cases=grid(buildings, SLOPES, mus, intensities))


KEY = b"a key of the tests"


def row_bytes(path):
    """The bytes of the rows of a part, without what it says of itself behind them."""
    content = path.read_bytes()
    return content[: -8 - int.from_bytes(content[-8:-4], "little")]


def forged(path, key=b"another key", computed="2001-02-03T04:05:06Z"):
    """Give a part a quarter of its displacements, another date, and its SHA-256; sign it."""
    table, said = pq.read_table(path), pq.read_metadata(path).metadata
    for name in LENGTHS:
        quarter = pa.array(0.25 * table[name].to_numpy())
        table = table.set_column(table.schema.get_field_index(name), name, quarter)
    about = json.loads(said[b"roofslip_study"]) | {"computed": computed}
    said = {
        b"roofslip_study": json.dumps(about),
        b"roofslip_signature": said[b"roofslip_signature"],
    }
    with pq.ParquetWriter(path, table.schema) as writer:
        writer.write_table(table)
        writer.add_key_value_metadata(said)
    path.write_bytes(signed(path.read_bytes(), key))
