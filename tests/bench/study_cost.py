"""Claim: a study costs little more than its bare runs, and its rows are quick to ask.

Runs in one axis under the example's seven motions, beside `solver.sweep` over the same cases; then
the paper's grid under many records: those of --records, and made ones of 1,000 to 26,000 samples.
"""

from __future__ import annotations

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
from measure import RECORDS, ROOT, SMOKE, figure

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
RUNS, COUNT = (50_000, 5) if SMOKE else (10_000_000, 200)


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
    columns = ["slope_deg", "intensity", "prd_m"]

    def by_pandas() -> object:
        frame = pd.read_parquet(folder, columns=columns)
        return frame.groupby(["slope_deg", "intensity"])["prd_m"].mean()

    by_duckdb = seconds(lambda: duckdb.sql(sql).fetchall())
    figure("mean PRD by slope and intensity over all rows, by DuckDB", by_duckdb, "s")
    figure("the same by pandas", seconds(by_pandas), "s")


def one_suite() -> None:
    """Print what many runs under one suite cost, and hold."""
    campaign = example(RUNS)
    small = replace(campaign, cases=campaign.cases[:50])
    run_part(Runner(small), slice(0, 50))
    swept(replace(campaign, cases=campaign.cases[:16]))
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name) / "runs"
        _, cpu = studied(campaign, folder)
        _, bare_cpu = swept(campaign)
        size = sum(path.stat().st_size for path in folder.glob("part-*"))
        figure("runs in one axis", campaign.rows)
        figure("processor time, Parquet included", cpu, "s", digits=3)
        figure("more than `solver.sweep` alone by", 100.0 * (cpu / bare_cpu - 1.0), "%")
        figure("estimate of `--dry-run` by measured", float(campaign.seconds.sum() / cpu))
        figure("runs in a second of processor time", campaign.rows / cpu)
        figure("size of a run on disk", size / campaign.rows, "B", digits=3)
        identity = manifest_of(campaign, {})["identity"]
        found = done_parts(folder, campaign, identity)
        rows = sum(peaks(read_part(folder, done), campaign).prd_m.size for done in found.values())
        assert rows == campaign.rows
        peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1e6
        figure("largest memory, every part read again", peak, "GB")
        queries(folder)


def many_records() -> None:
    """Print what runs under records of unequal length cost."""
    given = list(real(RECORDS)) if RECORDS else []
    campaign = stand_in(COUNT, given)
    with tempfile.TemporaryDirectory() as name:
        wall, cpu = studied(campaign, Path(name) / "runs")
    bare_wall, bare_cpu = swept(campaign)
    figure("records of unequal length", COUNT)
    figure("of these, recorded in earthquakes", min(len(given), COUNT))
    figure("runs under them", campaign.rows)
    figure("more processor time than `solver.sweep` by", 100.0 * (cpu / bare_cpu - 1.0), "%")
    figure("wall by processor time", wall / cpu)
    figure("the same of `solver.sweep`", bare_wall / bare_cpu)


if __name__ == "__main__":
    one_suite()
    many_records()
