"""How two axes keep to their tolerance: against SciPy's DOP853 restarted at every sample and event.

Run from the top: PYTHONPATH=tests .venv/bin/python tests/bench/rungs_accuracy.py [RECORD ...]
Records of three components (GeoNet V2A); without arguments those of the tests, where they are, else
the example's motions. The strong part of each; largest error of any place over all scenes,
relative to the PRD, and the largest bound. SciPy takes minutes.
"""

from __future__ import annotations

import math
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np

import plane_oracle
from solver.formats.reader import read_motion_file, read_record
from solver.model import Scene, coulomb
from solver.sliding.two_axes import TwoAxesOutcome, follow

ROOT = Path(__file__).resolve().parents[2]
SHARED = ROOT.parent / "shared" / "records"
G = 9.80665
TOLERANCES = (1e-4, 1e-6, 1e-8, 1e-10)
# Slope [deg], friction coefficient, PGA of the stronger horizontal component [g].
CASES = [(0.0, 0.2, 0.6), (0.0, 0.4, 1.0), (4.0, 0.3, 0.8), (7.0, 0.5, 1.2), (2.0, 0.8, 1.6)]
SECONDS = 3.0


def motions() -> list[tuple[str, list[np.ndarray], float]]:
    """Return name, three components and time step of each motion, cut to its strong part."""
    paths = [Path(name) for name in sys.argv[1:]] or sorted(SHARED.glob("*.V2A"))
    whole = []
    for path in paths:
        channels = read_motion_file(path).channels
        whole.append((path.stem, [channel.a_mps2 for channel in channels], channels[0].dt_s))
    if not whole:
        for path in sorted((ROOT / "projects" / "example" / "records").glob("*-x.csv"))[:2]:
            names = [path.with_name(path.name.replace("-x", side)) for side in ("-x", "-y", "-z")]
            records = [read_record(name) for name in names]
            whole.append((path.stem, [record.a_mps2 for record in records], records[0].dt_s))
    return [(name, strong_part(sides, dt), dt) for name, sides, dt in whole]


def strong_part(sides: list[np.ndarray], dt: float) -> list[np.ndarray]:
    """Cut around the peak of both horizontal components."""
    peak = int(np.hypot(sides[0], sides[1]).argmax())
    first = max(peak - round(0.5 * SECONDS / dt), 0)
    cut = [np.array(side[first : first + round(SECONDS / dt)]) for side in sides]
    for side in cut:
        side.setflags(write=False)
    return cut


def places(outcome: TwoAxesOutcome) -> np.ndarray:
    """Return what an error is looked for in."""
    sides = outcome.down_m, outcome.up_m, outcome.left_m, outcome.right_m
    return np.array([outcome.prd_m, *sides, *outcome.end_m])


def main() -> None:
    """Print, for each tolerance, the largest error and the largest bound, and their ratio."""
    rows: dict[float, list[tuple[float, float]]] = {tolerance: [] for tolerance in TOLERANCES}
    for name, (ax, ay, az), dt in motions():
        for slope_deg, mu, peak_g in CASES:
            scene = Scene(
                ax_mps2=ax,
                ay_mps2=ay,
                az_mps2=az,
                dt_s=dt,
                slope_rad=math.radians(slope_deg),
                friction=coulomb(mu),
                scale=peak_g * G / float(max(np.abs(ax).max(), np.abs(ay).max())),
                g_mps2=G,
            )
            weight = (G + scene.scale * az) * math.cos(scene.slope_rad)
            if np.min(weight + scene.scale * ax * math.sin(scene.slope_rad)) < 0.0:
                scene = replace(scene, az_mps2=np.empty(0))
            exact = plane_oracle.slide(
                ax,
                ay,
                dt,
                slope_rad=scene.slope_rad,
                mu=mu,
                az=scene.az_mps2 if len(scene.az_mps2) else None,
                scale=scene.scale,
                g=G,
            )
            sides = exact.x_max, -exact.x_min, exact.y_max, -exact.y_min
            theirs = np.array([exact.prd, *sides, *exact.end])
            for tolerance in TOLERANCES if exact.prd > 0.0 else ():
                outcome = follow(scene, tolerance)
                error = float(np.abs(places(outcome) - theirs).max())
                rows[tolerance].append((error / exact.prd, outcome.error_m / exact.prd))
            print(f"{name} {slope_deg:g} deg mu {mu:g}: PRD {exact.prd:.4f} m", flush=True)
    print("tolerance   largest error   largest bound   scenes")
    for tolerance, pairs in rows.items():
        errors, bounds = zip(*pairs, strict=True)
        print(f"{tolerance:9.0e}{max(errors):16.1e}{max(bounds):16.1e}{len(pairs):9d}")


if __name__ == "__main__":
    main()
