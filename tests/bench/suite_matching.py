"""How well and how fast made suites keep to AC156: ten seeds, seven motions each.

Run from the top: .venv/bin/python tests/bench/suite_matching.py [SEEDS [RECORDS]]
Four records of the folder RECORDS seed a component each; where reqpy-M is installed (in an
environment of its own, with this folder on PYTHONPATH), it matches them too.
"""

from __future__ import annotations

import importlib.util
import logging
import sys
import time
from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np

from solver.formats import read_record
from solver.model import Floats
from solver.records.measures import measures
from solver.records.record import Record
from solver.rules.hazard import EDITIONS
from solver.rules.spectra import ac156_horizontal, ac156_vertical
from solver.synthesis import make_suite, spectrum_fit
from solver.synthesis.matching import make_frame, matched, rounded, shaped
from solver.synthesis.seeds import Seed, grown, strongest

S_DS_G = 1.2
DT_S, N = 0.005, 6001
RECORDS = Path(sys.argv[2]) if len(sys.argv) > 2 else Path("records")


def targets() -> tuple[tuple[Floats, Floats], tuple[Floats, Floats]]:
    """Return the AC156 spectra at the roof, ASCE 7-16."""
    across = ac156_horizontal(EDITIONS["ASCE 7-16"], s_ds_g=S_DS_G, z_over_h=1.0)
    upward = ac156_vertical(s_ds_g=S_DS_G)
    return (across.freq_hz, across.sa_g), (upward.freq_hz, upward.sa_g)


def suites(seeds: Sequence[int]) -> None:
    """Make seven motions of each seed and print the extremes over all."""
    across, upward = targets()
    make_suite(across, upward, count=1, seed=0)  # compiled
    fits, correlations, drift, begun = [], [], 0.0, time.perf_counter()
    for seed in seeds:
        for motion in make_suite(across, upward, count=7, seed=seed):
            correlations += [abs(value) for value in motion.correlations]
            for record, target in zip(motion.components, (across, across, upward), strict=True):
                fits.append(spectrum_fit(record, target))
                whole = [round(a) for a in (record.a_mps2 / 9.80665 * 1e5).tolist()]
                drift = max(drift, abs(sum(whole)), abs(sum(n * k for n, k in enumerate(whole))))
    seconds = (time.perf_counter() - begun) / len(fits)
    print(f"{len(seeds)} seeds, {len(fits)} components, {seconds:.2f} s each, checks included")
    print(f"ratio to the target from {min(f.least for f in fits):.3f}", end=" ")
    print(f"to {max(f.greatest for f in fits):.3f}", end=", mean ")
    print(f"{min(f.mean for f in fits):.3f} to {max(f.mean for f in fits):.3f}")
    print(f"largest correlation {max(correlations):.3f}; sums of samples off zero by {drift}")


def ours(record: Record) -> Floats:
    """Match a record as `make_suite` does, once."""
    target = targets()[0]
    part = Seed(name=record.name, a=strongest(record, DT_S, N), own_phases=True)
    start = grown(part, np.random.default_rng(1), N, 0)
    frame = make_frame(target, DT_S, DT_S * (N - 1))
    return rounded(matched(frame, shaped(frame, start, target), target))


def reqpy(record: Record) -> Floats:
    """Match the same part of a record by reqpy-M to 10 s, with the base line that fits best."""
    import reqpy_M

    freq_hz, sa_g = targets()[0]
    periods = np.geomspace(0.02, 12.0, 400)
    wanted = np.exp(np.interp(np.log(1 / periods), np.log(freq_hz), np.log(sa_g)))
    compatible = reqpy_M.generate_single_component_compatible_record(
        s=strongest(record, DT_S, N),
        fs=1 / DT_S,
        T_PSA=periods,
        targetPSA=wanted,
        T1PSA=0.02,
        T2PSA=10.0,
        baseline_method="classic",
    )
    return np.asarray(compatible["sc"]) * 9.80665


def compare(name: str, match: Callable[[Record], Floats], records: Sequence[Record]) -> None:
    """Print how one program matches each record."""
    target = targets()[0]
    match(records[0])  # compiled
    for record in records:
        begun = time.perf_counter()
        a = match(record)
        seconds = time.perf_counter() - begun
        made = Record(name=record.name, dt_s=DT_S, a_mps2=np.ascontiguousarray(a))
        fit, measured = spectrum_fit(made, target), measures(made)
        print(
            f"{name:8} {record.name:34} {seconds:5.2f} s  {fit.least:.3f} to {fit.greatest:.3f}, "
            f"mean {fit.mean:.3f}; end {100 * measured.final_velocity_mps:.1e} cm/s, "
            f"{100 * measured.final_displacement_m:.1e} cm; D5-95 {measured.d5_95_s:.1f} s"
        )


def main() -> None:
    """Run the suites, then both programs on the same records."""
    suites(range(int(sys.argv[1]) if len(sys.argv) > 1 else 10))
    dts = {"Imperial*180": 0.01, "Chi*000": 0.005, "Kobe*000": 0.02, "Landers*260": 0.005}
    files = [(path, dt) for name, dt in dts.items() for path in RECORDS.glob(f"{name}.txt")]
    records = [read_record(path, units="g", dt_s=dt) for path, dt in files]
    if records:
        compare("ours", ours, records)
    if records and importlib.util.find_spec("reqpy_M"):
        logging.disable()
        compare("reqpy-M", reqpy, records)


if __name__ == "__main__":
    main()
