"""How near the exact method comes to 40-digit arithmetic, over real or made records.

Run from the top: PYTHONPATH=tests .venv/bin/python tests/bench/solver_accuracy.py [RECORD DT ...]
Errors in PRD and residual, relative to the PRD. Without arguments: the example's records, with and
without their vertical components.
"""

from __future__ import annotations

import math
import statistics
import sys
from pathlib import Path

import numpy as np

import oracle
from solver.formats import read_record
from solver.sliding.checked import slide

ROOT = Path(__file__).resolve().parents[2]
G = 9.80665
# Slope [deg], friction coefficient, PPA [g].
SCENES = [(0.0, 0.1, 1.0), (4.0, 0.3, 1.5), (-7.0, 0.5, 2.0), (2.0, 0.45, 1.5)]


def records() -> list[tuple[str, np.ndarray, np.ndarray | None, float]]:
    """Return name, horizontal, vertical or None, and time step of each record to run."""
    if sys.argv[1:]:
        pairs = zip(sys.argv[1::2], sys.argv[2::2], strict=True)
        read = [read_record(Path(name), units="g", dt_s=float(dt)) for name, dt in pairs]
        return [(record.name, record.a_mps2, None, record.dt_s) for record in read]
    components: list[tuple[str, np.ndarray, np.ndarray | None, float]] = []
    for path in sorted((ROOT / "projects" / "example" / "records").glob("*-x.csv")):
        h = read_record(path, units="g")
        v = read_record(path.with_name(path.name.replace("-x", "-z")), units="g")
        components += [(h.name, h.a_mps2, z, h.dt_s) for z in (None, v.a_mps2)]
    return components


def main() -> None:
    """Print the largest and the median error, and the worst runs."""
    rows = []
    for name, ax, az, dt in records():
        for degrees, mu, ppa in SCENES:
            scene = {"slope_rad": math.radians(degrees), "mu": mu}
            scale = ppa * G / float(np.abs(ax).max())
            result = slide(ax, dt, az_mps2=az, scale=scale, **scene)
            exact = oracle.slide(ax, dt, az=az, scale=scale, **scene)
            if math.isnan(result.prd_m) or not exact.prd:
                continue
            errors = (abs(result.prd_m - exact.prd), abs(result.residual_m - exact.residual))
            rows.append((float(max(errors) / exact.prd), name, degrees, mu, ppa))
    rows.sort(reverse=True)
    median = statistics.median(row[0] for row in rows)
    print(f"{len(rows)} runs: largest error {rows[0][0]:.1e}, median {median:.1e} of the PRD")
    for row in rows[:3]:
        print("{:.1e}  {} at {} deg, mu {}, PPA {} g".format(*row))


if __name__ == "__main__":
    main()
