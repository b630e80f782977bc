"""What directions of shaking that a package does not run would change.

Run from the top: .venv/bin/python tests/bench/angles.py [RECORD ...]
Records of three components (GeoNet V2A); without arguments those of the tests, where they are, else
the example's motions. Each is run in two axes as a package runs it, the components along the slope
by turns and in both senses, and with its components turned by every 15 degrees, and with the
vertical reversed. Medians and largest values of the worst PRD of each over that of the package.
"""

from __future__ import annotations

import math
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np

from solver import ladder
from solver.formats.reader import read_motion_file, read_record
from solver.model import STANDARD_GRAVITY_MPS2 as G
from solver.model import Floats, Scene, coulomb
from solver.verification.triples import readonly

ROOT = Path(__file__).resolve().parents[2]
SHARED = ROOT.parent / "shared" / "records"
CASES = [(0.0, 0.2, 0.8), (0.0, 0.4, 1.2), (2.0, 0.3, 1.0), (5.0, 0.5, 1.5)]
STEP_DEG = 15
LEAST_M = 5e-3


def motions() -> list[tuple[str, list[Floats], float]]:
    """Return name, three components and time step of each motion."""
    paths = [Path(name) for name in sys.argv[1:]] or sorted(SHARED.glob("*.V2A"))
    found = []
    for path in paths:
        channels = read_motion_file(path).channels
        found.append((path.stem, [one.a_mps2 for one in channels], channels[0].dt_s))
    if not found:
        for path in sorted((ROOT / "projects" / "example" / "records").glob("*-x.csv")):
            names = [path.with_name(path.name.replace("-x", side)) for side in ("-x", "-y", "-z")]
            records = [read_record(name) for name in names]
            found.append((path.stem, [one.a_mps2 for one in records], records[0].dt_s))
    return found


def turned(scene: Scene, degrees: float) -> Scene:
    """Turn the shaking in plan."""
    cs, sn = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    ax, ay = scene.ax_mps2, scene.ay_mps2
    return replace(scene, ax_mps2=readonly(cs * ax - sn * ay), ay_mps2=readonly(sn * ax + cs * ay))


def worst(scene: Scene, angles: range) -> float:
    """Return the largest PRD over angles [m]; NaN where the block leaves the roof."""
    return max(ladder.solve(turned(scene, angle)).result.prd_m for angle in angles)


def main() -> None:
    """Print the ratios of each case, and of all."""
    rows: dict[str, list[float]] = {"every angle": [], "vertical reversed": []}
    for _, (ax, ay, az), dt in motions():
        for slope_deg, mu, peak_g in CASES:
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
            other = worst(replace(scene, az_mps2=readonly(-az)), range(0, 360, 90))
            rows["every angle"].append(every / package)
            rows["vertical reversed"].append(other / package)
    for name, ratios in rows.items():
        kept = np.array([one for one in ratios if math.isfinite(one)])
        print(f"{name:20}{kept.size:4} scenes  median {np.median(kept):.3f}  largest "
              f"{kept.max():.3f}")  # fmt: skip


if __name__ == "__main__":
    main()
