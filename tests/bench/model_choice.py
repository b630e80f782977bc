"""Claim: the model of a package neglects no second axis that matters, and little else by angle.

Random scenes of two components, 10 to 20 s: noise, periodic and recorded shaking along the slope,
and across it a share of that, noise, or a push that stays. Each is solved by the chosen model and
in two axes to 1e-8; the chosen model must not be off by more than it may be. Then what a package
does not run: shaking turned by every 15 degrees, and the vertical reversed, in the PRD by that of
the package; and the PRD in two axes by the largest of the axes run alone. Recorded motions are
those of --records, else made ones are used.
"""

import csv
import itertools
import math
import time
from collections import Counter
from collections.abc import Iterable, Iterator
from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
from measure import RECORDS, ROOT, SMOKE, figure

from fixtures.blocks import block
from report.motions.prepare import prepare
from report.project.read.read import read
from solver.formats import read_record
from solver.model import STANDARD_GRAVITY_MPS2 as G
from solver.model import Floats, Scene, SlideResult, Status
from solver.records.record import NO_RECORD, read_only
from solver.sliding import model_selection, one_axis, two_axes
from solver.verification import model_study
from solver.verification.evidence import WORST
from solver.verification.verification_motions import own_triples, recorded_triples

SCENES = 30 if SMOKE else 10_000
KINDS, ACROSS = ("noise", "periodic", "recorded"), ("like it", "noise", "push")
CASES = tuple(itertools.product((1.0, 3.0, 7.0), (0.2, 0.4, 0.6), (0.6, 0.9, 1.2)))
STEP_DEG, LEAST_M = 15, 25e-3

Motion = tuple[Floats, Floats, Floats, float]


@cache
def motions() -> tuple[Motion, ...]:
    """Return three components, the third at times empty, and the time step of each motion."""
    triples = recorded_triples(RECORDS) if RECORDS else own_triples(quick=SMOKE)
    found = [(triple.ax_mps2, triple.ay_mps2, triple.az_mps2, triple.dt_s) for triple in triples]
    return (*found, *(pairs(RECORDS) if RECORDS else ()))


def pairs(folder: Path) -> Iterator[Motion]:
    """Yield the pairs of horizontal components that a folder's manifest lists."""
    listed = csv.DictReader((folder / "MANIFEST.csv").open(encoding="utf-8"))
    rows = [row for row in listed if row["units"] == "g" and row["file"].endswith(".txt")]
    for one, other in itertools.pairwise(rows):
        if (one["station"], one["event"]) == (other["station"], other["event"]):
            dt = float(one["dt_s"])
            sides = [read_record(folder / r["file"], units="g", dt_s=dt) for r in (one, other)]
            n = min(len(side.a_mps2) for side in sides)
            x, y = (read_only(side.a_mps2[:n]) for side in sides)
            yield x, y, NO_RECORD, dt


def noise(rng: np.random.Generator, n: int, dt: float) -> Floats:
    """Noise of 0.3 to 8 Hz under a bell, its peak 1."""
    freq = np.fft.rfftfreq(n, dt)
    wave = np.fft.irfft(((freq > 0.3) & (freq < 8.0)) * np.exp(6.2832j * rng.random(freq.size)), n)
    wave *= np.sin(np.pi * np.arange(n) / n)
    return wave / np.abs(wave).max()


def random_scene(rng: np.random.Generator) -> Scene:
    """Return a scene of any kind."""
    kind, across = str(rng.choice(KINDS)), str(rng.choice(ACROSS))
    dt, mu, az = 0.01, float(rng.choice((0.2, 0.3, 0.4, 0.5, 0.7))), NO_RECORD
    t = np.arange(int(rng.choice((1000, 2000)))) * dt
    if kind == "recorded":
        *sides, dt = motions()[rng.integers(len(motions()))]
        every = max(1, round(0.01 / dt))
        peak = np.abs(sides[0]).max()
        ax, ay, az = (side[::every] / peak for side in sides)
        dt, az = dt * every, 0.5 * az if rng.random() < 0.5 else NO_RECORD
        t = np.arange(ax.size) * dt
    elif kind == "noise":
        ax, ay = noise(rng, t.size, dt), noise(rng, t.size, dt)
    else:
        hz = rng.uniform(0.5, 5.0)
        ax = np.sin(2.0 * np.pi * hz * t) * np.minimum(t / 2.0, 1.0)
        ay = np.sin(2.0 * np.pi * hz * rng.choice((1.0, 0.5, 1.37)) * t + rng.uniform(0.0, 6.28))
    if across == "like it":
        ay = ax * rng.choice((-1.0, 1.0))
    elif across == "push":
        ay = np.minimum(t / rng.uniform(0.5, 5.0), 1.0)
    peak = mu * rng.uniform(1.02, 4.0) * G
    ay = ay * 10.0 ** rng.uniform(-4.0, 0.3) * mu * G
    slope = math.radians(rng.choice((0.0, 0.0, 1.0, 3.0, 7.0)))
    return block(ax * peak, ay, az * peak, dt=dt, slope=slope, friction=mu)


def difference(result: SlideResult, other: SlideResult) -> float:
    """Return the largest difference of PRD and excursions [m]."""
    names = ("prd_m", "down_m", "up_m", "across_m")
    return max(abs(getattr(result, name) - getattr(other, name)) for name in names)


def numbered(index: int) -> Scene:
    """Return a random scene that has this number."""
    return random_scene(np.random.default_rng([10, index]))


def cost(scenes: Iterable[Scene]) -> float:
    """Return the time of selecting and running scenes, over that of always two axes.

    Each comes first in every other scene: what comes first finds nothing of it in the caches.
    """
    ways, took = (model_selection.solve, two_axes.run), [0.0, 0.0]
    for index, scene in enumerate(scenes):
        for k in (0, 1) if index % 2 else (1, 0):
            started = time.process_time()
            ways[k](scene)
            took[k] += time.process_time() - started
    return took[0] / took[1]


def choose() -> None:
    """Print how many scenes are wrong, need two axes and get them, and what choosing costs."""
    count: Counter[str] = Counter()
    groups: dict[str, list[int]] = {"": [], ", one axis": [], ", two axes": [], ", one-sided": []}
    every, one, two, push = groups.values()
    largest = 0.0
    for index in range(SCENES):
        scene = numbered(index)
        solution = model_selection.solve(scene)
        if (
            solution.model is model_selection.Model.NO_SLIP
            or solution.result.status is Status.UPLIFT
        ):
            continue
        needed = solution.model is model_selection.Model.TWO_AXES
        for group in (every, two if needed else one):
            group.append(index)
        if (np.diff(scene.ay_mps2) >= 0.0).all():
            push.append(index)
        true, lesser = two_axes.run(scene, 1e-8), one_axis.run(scene)
        off, bound = (
            difference(solution.result, true),
            model_selection.DEFAULT.bound_m(lesser.prd_m),
        )
        largest = max(largest, off / bound)
        count["wrong"] += off > bound + true.error_m + solution.result.error_m
        count["need"] += difference(lesser, true) > bound
    figure("random cases that slide", len(every))
    figure("cases in which the selected model neglects too much", count["wrong"])
    figure("largest neglected effect, relative to the tolerance", largest)
    figure("cases that need two axes", 100.0 * count["need"] / len(every), "%", digits=3)
    figure("cases run in two axes", 100.0 * len(two) / len(every), "%", digits=3)
    ratios = {name: cost(map(numbered, group)) for name, group in groups.items()}
    for name, scenes in (("conditions", of_project("conditions")), ("rotated", turned())):
        ratios[f", {name}"] = cost(scenes)
    for name, ratio in ratios.items():
        what = "time to select and run the model, relative to two axes for all"
        figure(what + name, ratio, digits=3)


def of_project(name: str) -> Iterator[Scene]:
    """Yield the scenes of a project's package: each array, motion and orientation."""
    sheet = read(ROOT / "projects" / name / "input.xlsx")
    for motion in prepare(sheet).motions:
        for array, to in itertools.product(sheet.project.arrays, motion.orientations):
            yield motion.scene(to, slope_rad=array.slope_rad, friction=array.friction)


def turned() -> Iterator[Scene]:
    """Yield the scenes whose shaking `turn` turns, as recorded."""
    for ax, ay, az, dt in motions():
        peak = float(max(np.abs(ax).max(), np.abs(ay).max()))
        for slope_deg, mu, peak_g in CASES[:: 9 if SMOKE else 1]:
            about = {"dt": dt, "slope": math.radians(slope_deg), "friction": mu}
            yield block(ax, ay, az, **about, scale=peak_g * G / peak)


def worst(scene: Scene, step_deg: int) -> float:
    """Return the largest PRD over headings [m]; NaN where the block leaves the roof."""
    ax, ay, found = scene.ax_mps2, scene.ay_mps2, []
    for angle in np.radians(np.arange(0, 360, step_deg)):
        x, y = np.cos(angle) * ax - np.sin(angle) * ay, np.sin(angle) * ax + np.cos(angle) * ay
        turned = replace(scene, ax_mps2=read_only(x), ay_mps2=read_only(y))
        found.append(model_selection.solve(turned).result.prd_m)
    return float(np.max(found))


def turn() -> None:
    """Print what directions that a package does not run would change."""
    rotated = f"rotation in steps of {STEP_DEG} degrees"
    rows: dict[str, list[float]] = {rotated: [], "the vertical component reversed": []}
    every, reversed_ = rows.values()
    for scene in turned():
        package = worst(scene, 90)
        if package > LEAST_M:
            every.append(worst(scene, STEP_DEG) / package)
            if scene.az_mps2.size:
                backward = read_only(-scene.az_mps2)
                reversed_.append(worst(replace(scene, az_mps2=backward), 90) / package)
    kind = "recorded" if RECORDS else "generated"
    figure("motions that are rotated", len(motions()), kind)
    for what, ratios in rows.items():
        finite = [ratio for ratio in ratios if math.isfinite(ratio)]
        name = f"PRD with {what}, relative to the package"
        figure(f"{name}, median", float(np.median(finite)), digits=3)
        figure(f"{name}, largest", max(finite), digits=3)


def second_axis() -> None:
    """Print what two axes add to the largest PRD of the axes run alone, as the manual does."""
    triples = (*own_triples(quick=SMOKE), *(recorded_triples(RECORDS) if RECORDS else ()))
    changes = model_study.study(triples, quick=SMOKE).changes
    worst_heading = next(change for change in changes if change.name == WORST)
    figure("motions of the manual, generated and recorded", len(triples))
    name = "PRD in two axes, relative to the largest one-axis PRD"
    figure(f"{name}, median", worst_heading.median, digits=3)
    for percent in (10, 90):
        figure(f"{name}, {percent}th percentile of the runs", worst_heading.at(percent), digits=3)


if __name__ == "__main__":
    choose()
    turn()
    second_axis()
