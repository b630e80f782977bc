"""Claim: a study costs little more than its bare runs, and its rows are quick to ask.

Runs in one axis under the example's seven motions, beside `solver.sweep` over the same cases; then
the paper's grid under many records, 18 real ones and made ones of 1,000 to 26,000 samples.
"""

import resource
import statistics
import tempfile
import time
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import duckdb
import numpy as np
import pandas as pd
from measure import SMOKE, figure, made_records

from fixtures.campaigns import frozen, motion
from peers import real_records
from report.study.manifest import manifest_of
from report.study.parquet_parts import begin, done_parts, peaks, read_part, run_missing
from solver import read_record, sweep
from solver.model import Motion
from solver.studies.campaign import Campaign, grid
from solver.studies.runs import Runner, run_part

SLOPES = np.radians(np.linspace(-7.0, 7.0, 29))
LEVELS = np.linspace(0.05, 1.5, 16)
G = 9.80665
KEY = b"a key of a benchmark"
RUNS, COUNT = (50_000, 5) if SMOKE else (10_000_000, 200)


def read(path: Path) -> Motion:
    """Return a record as a motion whose intensity 1 is a peak of 1 g."""
    record = read_record(path, units="g")
    return made(path.stem, record.dt_s, record.a_mps2)


def made(name: str, dt_s: float, a_mps2: np.ndarray) -> Motion:
    """Return a motion in one axis and one polarity."""
    scale = G / float(np.abs(a_mps2).max())
    return replace(motion(0), id=name, dt_s=dt_s, ax_mps2=frozen(a_mps2), scale=scale, signs=(1,))


def over(motions: list[Motion], frictions: int) -> Campaign:
    """Return all slopes, frictions and intensities under motions."""
    mus = np.linspace(0.1, 0.8, frictions)
    return Campaign(motions=(tuple(motions),), cases=grid(1, SLOPES, mus, LEVELS))


def stand_ins(count: int) -> Iterator[Motion]:
    """Yield made motions of unequal length, with strong shaking in a tenth or more."""
    rng = np.random.default_rng(2)
    for number in range(count):
        t = np.arange(int(rng.integers(1_000, 26_000))) * 0.01
        freq, phase = rng.uniform(0.3, 12.0, (2, 40))
        a = np.sin(2.0 * np.pi * freq * t[:, None] + phase).sum(axis=1)
        middle, width = rng.uniform(0.2, 0.6) * t[-1], rng.uniform(0.05, 0.15) * t[-1]
        yield made(f"S{number}", 0.01, a * np.exp(-(((t - middle) / width) ** 2)))


def studied(campaign: Campaign, folder: Path) -> float:
    """Run a campaign; return its processor time [s]."""
    manifest, started = manifest_of(campaign, {}), time.process_time()
    begin(folder, manifest, n_earlier=0)
    numbers = range(len(campaign.parts))
    run_missing(folder, campaign, manifest["identity"], ["roof"], numbers, KEY, lambda done: None)
    return time.process_time() - started


def swept(campaign: Campaign) -> float:
    """Run the same cases by `solver.sweep`; return the processor time [s]."""
    mus, started = np.unique(campaign.cases.mu), time.process_time()
    for one in campaign.motions[0]:
        sweep(one.ax_mps2, one.dt_s, slopes_rad=SLOPES, mus=mus, scales=LEVELS * one.scale)
    return time.process_time() - started


def seconds(query: object) -> float:
    """Median time of three queries [s]."""
    times = []
    for _ in range(3):
        started = time.perf_counter()
        query()  # type: ignore[operator]
        times.append(time.perf_counter() - started)
    return statistics.median(times)


def queries(folder: Path) -> None:
    """Print the time of a mean of the PRD by slope and intensity, over every row."""
    files = f"{folder}/part-*.parquet"
    sql = f"select slope_deg, intensity, avg(prd_m) from '{files}' group by all"
    columns = ["slope_deg", "intensity", "prd_m"]

    def by_pandas() -> object:
        frame = pd.read_parquet(folder, columns=columns)
        return frame.groupby(["slope_deg", "intensity"])["prd_m"].mean()

    by_duckdb = seconds(lambda: duckdb.sql(sql).fetchall())
    figure("mean PRD by slope and intensity over all rows, with DuckDB", by_duckdb, "s")
    figure("the same with pandas", seconds(by_pandas), "s")


def one_suite() -> None:
    """Print what many runs under one suite cost, and hold."""
    motions = [read(path) for path in made_records()]
    campaign = over(motions, round(RUNS / (len(motions) * SLOPES.size * LEVELS.size)))
    small = replace(campaign, cases=campaign.cases[:50])
    run_part(Runner(small), slice(0, 50))
    swept(replace(campaign, cases=campaign.cases[:16]))
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name) / "runs"
        cpu = studied(campaign, folder)
        bare_cpu = swept(campaign)
        size = sum(path.stat().st_size for path in folder.glob("part-*"))
        figure("runs in one axis", campaign.rows)
        figure("processor time, including Parquet output", cpu, "s", digits=3)
        figure("this, relative to `solver.sweep` alone", cpu / bare_cpu, digits=3)
        figure("runs per second of processor time", campaign.rows / cpu)
        figure("disk space per run", size / campaign.rows, "B", digits=3)
        identity = manifest_of(campaign, {})["identity"]
        found = done_parts(folder, campaign, identity, KEY)
        rows = sum(peaks(read_part(folder, done), campaign)[0].size for done in found.values())
        assert rows == campaign.rows
        peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1e6
        figure("peak memory, with all batches read again", peak, "GB")
        queries(folder)


def many_records() -> None:
    """Print what runs under records of unequal length cost."""
    given = [made(real.name, real.dt_s, real.a_mps2) for real in real_records()][:COUNT]
    campaign = over([*given, *stand_ins(COUNT - len(given))], 15)
    with tempfile.TemporaryDirectory() as name:
        cpu = studied(campaign, Path(name) / "runs")
    bare_cpu = swept(campaign)
    figure("records of unequal length", COUNT)
    figure("of these, recorded in earthquakes", len(given))
    figure("runs with these records", campaign.rows)
    figure("their processor time relative to `solver.sweep` alone", cpu / bare_cpu, digits=3)


if __name__ == "__main__":
    one_suite()
    many_records()
