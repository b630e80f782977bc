"""Cost of a study beside a bare sweep: overhead, use of the cores, memory, queries of its rows.

    PYTHONPATH=tests .venv/bin/python tests/bench/study_cost.py [RUNS [RECORDS [FOLDER]]]

RUNS (10,000,000) in one axis under the example's seven motions; then the paper's grid under RECORDS
(500) records: those of a folder, and made ones of 1,000 to 26,000 samples. Both cores should be
idle.
"""

from __future__ import annotations

import resource
import statistics
import sys
import tempfile
import time
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import duckdb
import numpy as np
import pandas as pd

from places import ROOT
from report.study.manifest import manifest_of
from report.study.parts import begin, done_parts, peaks, read_part, run_missing
from solver import read_record, sweep
from solver.model import InputError, Motion
from solver.studies.campaign import Campaign, grid
from solver.studies.runs import Runner, run_part
from studied import frozen, motion

SLOPES = np.radians(np.linspace(-7.0, 7.0, 29))
LEVELS = np.linspace(0.05, 1.5, 16)
G = 9.80665


def example(runs: int) -> Campaign:
    """The example's motions in one axis and one polarity, with enough friction coefficients."""
    motions = []
    for number in range(1, 8):
        record = read_record(ROOT / "projects" / "example" / "records" / f"RM{number}-x.csv")
        scale = G / float(np.abs(record.a_mps2).max())
        motions.append(made(f"RM{number}", record.dt_s, record.a_mps2, scale))
    mus = np.linspace(0.1, 0.8, max(2, round(runs / (7 * SLOPES.size * LEVELS.size))))
    return Campaign(motions=(tuple(motions),), cases=grid(1, SLOPES, mus, LEVELS))


def made(name: str, dt_s: float, a_mps2: np.ndarray, scale: float) -> Motion:
    one = replace(motion(0), id=name, dt_s=dt_s, ax_mps2=frozen(a_mps2), scale=scale)
    return replace(one, signs=(1,))


def real(folder: Path) -> Iterator[Motion]:
    """The records of a folder with one component each, scaled to 1 g."""
    for path in sorted(folder.rglob("*")):
        try:
            record = read_record(path)
        except (InputError, OSError):
            continue
        scale = G / float(np.abs(record.a_mps2).max())
        yield made(path.stem, record.dt_s, record.a_mps2, scale)


def stand_in(records: int, given: list[Motion]) -> Campaign:
    """Given records and made ones of unequal length, with strong shaking in a tenth or more."""
    rng = np.random.default_rng(2)
    motions = given[:records]
    for number in range(records - len(motions)):
        samples = int(rng.integers(1_000, 26_000))
        t = np.arange(samples) * 0.01
        freq, phase = rng.uniform(0.3, 12.0, (2, 40))
        a = np.sin(2.0 * np.pi * freq * t[:, None] + phase).sum(axis=1)
        middle, width = rng.uniform(0.2, 0.6) * t[-1], rng.uniform(0.05, 0.15) * t[-1]
        a *= np.exp(-(((t - middle) / width) ** 2))
        motions.append(made(f"S{number}", 0.01, a, G / float(np.abs(a).max())))
    mus = np.linspace(0.1, 0.8, 15)
    return Campaign(motions=(tuple(motions),), cases=grid(1, SLOPES, mus, LEVELS))


def studied(campaign: Campaign, folder: Path) -> tuple[float, float]:
    """Run a campaign; return its wall and processor time [s]."""
    manifest = manifest_of(campaign, {})
    wall, cpu = time.perf_counter(), time.process_time()
    begin(folder, manifest)
    numbers = range(len(campaign.parts))
    run_missing(folder, campaign, manifest["identity"], ["roof"], numbers, lambda done: None)
    return time.perf_counter() - wall, time.process_time() - cpu


def swept(campaign: Campaign) -> tuple[float, float]:
    """Run the same cases by `solver.sweep`."""
    mus = np.unique(campaign.cases.mu)
    wall, cpu = time.perf_counter(), time.process_time()
    for one in campaign.motions[0]:
        sweep(one.ax_mps2, one.dt_s, slopes_rad=SLOPES, mus=mus, scales=LEVELS * one.scale)
    return time.perf_counter() - wall, time.process_time() - cpu


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
    by_duckdb = seconds(lambda: duckdb.sql(sql).fetchall())
    columns = ["slope_deg", "intensity", "prd_m"]

    def by_pandas() -> object:
        frame = pd.read_parquet(folder, columns=columns)
        return frame.groupby(["slope_deg", "intensity"])["prd_m"].mean()

    print(
        f"mean by slope and intensity: DuckDB {by_duckdb:.2f} s, pandas {seconds(by_pandas):.2f} s"
    )


def main() -> None:
    """Print what the README states."""
    runs, records = (
        [int(float(v)) for v in sys.argv[1:3]] + [10_000_000, 500][len(sys.argv) - 1 :]
    )[:2]
    given = [motion for folder in sys.argv[3:] for motion in real(Path(folder))]
    campaign = example(runs)
    small = replace(campaign, cases=campaign.cases[:50])
    run_part(Runner(small), slice(0, 50))
    swept(replace(campaign, cases=campaign.cases[:16]))
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name) / "runs"
        wall, cpu = studied(campaign, folder)
        bare_wall, bare_cpu = swept(campaign)
        size = sum(path.stat().st_size for path in folder.glob("part-*"))
        print(f"{campaign.rows:,} runs: {cpu:.1f} s of processor time, {wall:.1f} s of wall")
        print(f"bare sweep: {bare_cpu:.1f} s of processor time, {bare_wall:.1f} s of wall")
        print(f"overhead: {100.0 * (cpu / bare_cpu - 1.0):.0f} % of processor time")
        print(f"cost model: {campaign.seconds.sum():.1f} s")
        print(
            f"{campaign.rows / cpu:,.0f} runs a processor second, {size / campaign.rows:.1f} B each"
        )
        print(f"10^9 runs: {1e9 * cpu / campaign.rows / 3600.0:.1f} processor hours")
        manifest = manifest_of(campaign, {})
        found = done_parts(folder, campaign, manifest["identity"])
        rows = sum(peaks(read_part(folder, done), campaign).prd_m.size for done in found.values())
        assert rows == campaign.rows
        peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1e3
        print(f"largest memory, with a second reading of every part: {peak:.0f} MB")
        queries(folder)
    many = stand_in(records, given)
    with tempfile.TemporaryDirectory() as name:
        wall, cpu = studied(many, Path(name) / "runs")
    print(f"{records} records, {len(given)} of them given, {many.rows:,} runs:")
    print(f"wall / processor time {wall / cpu:.2f}")
    bare_wall, bare_cpu = swept(many)
    print(f"bare sweep of the same: {bare_wall / bare_cpu:.2f}; {cpu / bare_cpu:.2f} of its time")


if __name__ == "__main__":
    main()
