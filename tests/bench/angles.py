"""What directions of shaking that a package does not run would change.

Run from the top: .venv/bin/python tests/bench/angles.py [FOLDER]
Records of three components in a folder, and pairs of horizontal ones that its MANIFEST.csv lists;
without one those of the tests, where they are, else the example's motions. Each is run in two axes
as a package runs it, the components along the slope by turns and in both senses, then turned by
every 15 degrees, and with the vertical reversed: the worst PRD of each over that of the package.
"""

from __future__ import annotations

import csv
import itertools
import math
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np

from solver.model import STANDARD_GRAVITY_MPS2 as G
from solver.model import Floats, Scene, coulomb
from solver.rivals.methods import NO_RECORD
from solver.sliding import least_model
from solver.verification.triples import own_triples, readonly, recorded_triples

ROOT = Path(__file__).resolve().parents[2]
SHARED = ROOT.parent / "shared" / "records"
SLOPES_DEG, MUS, PEAKS_G = (1.0, 3.0, 7.0), (0.2, 0.4, 0.6), (0.6, 0.9, 1.2)
STEP_DEG = 15
LEAST_M = 25e-3


def motions() -> list[tuple[Floats, Floats, Floats, float]]:
    """Return three components, the third at times empty, and the time step of each motion."""
    folder = Path(sys.argv[1]) if sys.argv[1:] else SHARED
    triples = [*recorded_triples(folder)] if folder.is_dir() else own_triples(quick=False)
    made = [(triple.x_mps2, triple.y_mps2, triple.z_mps2, triple.dt_s) for triple in triples]
    manifest = folder / "MANIFEST.csv"
    rows = list(csv.DictReader(manifest.open(encoding="utf-8"))) if manifest.is_file() else []
    pairs = [row for row in rows if row["units"] == "g" and row["file"].endswith(".txt")]
    for row_of_x, other in itertools.pairwise(pairs):
        if row_of_x["station"] == other["station"] and row_of_x["event"] == other["event"]:
            ax, ay = (np.loadtxt(folder / row["file"]) * G for row in (row_of_x, other))
            n = min(ax.size, ay.size)
            made.append((readonly(ax[:n]), readonly(ay[:n]), NO_RECORD, float(row_of_x["dt_s"])))
    return made


def turned(scene: Scene, degrees: float) -> Scene:
    """Turn the shaking in plan."""
    cs, sn = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    ax, ay = scene.ax_mps2, scene.ay_mps2
    return replace(scene, ax_mps2=readonly(cs * ax - sn * ay), ay_mps2=readonly(sn * ax + cs * ay))


def worst(scene: Scene, angles: range) -> float:
    """Return the largest PRD over angles [m]; NaN where the block leaves the roof."""
    return max(least_model.solve(turned(scene, angle)).result.prd_m for angle in angles)


def main() -> None:
    """Print the ratios of each case, and of all."""
    rows: dict[str, list[float]] = {"every angle": [], "vertical reversed": []}
    for ax, ay, az, dt in motions():
        for slope_deg, mu, peak_g in itertools.product(SLOPES_DEG, MUS, PEAKS_G):
            scene = Scene(
                ax_mps2=readonly(ax),
                ay_mps2=readonly(ay),
                az_mps2=readonly(az),
                dt_s=dt,
                slope_rad=math.radians(slope_deg),
                friction=coulomb(mu),
                scale=peak_g * G / float(max(np.abs(ax).max(), np.abs(ay).max())),
                g_mps2=G,
            )
            package = worst(scene, range(0, 360, 90))
            if not package > LEAST_M:
                continue
            every = worst(scene, range(0, 360, STEP_DEG))
            rows["every angle"].append(every / package)
            if az.size:
                other = worst(replace(scene, az_mps2=readonly(-az)), range(0, 360, 90))
                rows["vertical reversed"].append(other / package)
    for name, ratios in rows.items():
        kept = np.array([ratio for ratio in ratios if math.isfinite(ratio)])
        print(f"{name:20}{kept.size:4} scenes  median {np.median(kept):.3f}  largest "
              f"{kept.max():.3f}")  # fmt: skip


if __name__ == "__main__":
    main()
