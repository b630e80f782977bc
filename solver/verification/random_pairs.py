"""Random scenes in two axes, in pairs whose results may differ only by their stated bounds.

Short records of many shapes, most unlike an earthquake: equal samples, jumps, accelerations equal
to the yield acceleration, proportional components, no friction, no normal force.
Read `Pair`, then `KINDS`.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from solver.model import STANDARD_GRAVITY_MPS2 as G
from solver.model import Floats, Friction, Scene, Status, coulomb
from solver.records.record import NO_RECORD, read_only
from solver.sliding.two_axes import TwoAxesOutcome, follow

EPS = 2.0**-52
TOLERANCES = (1e-2, 1e-4, 1e-6, 1e-8, 1e-10)
STEPS_S = (0.0005, 0.001, 0.005, 0.01, 0.02, 0.05, 0.1, 0.5)
SLOPES_DEG = (0.0, 0.0, 0.0, 0.5, -0.5, 2.0, -2.0, 5.0, 7.0, 12.0, -20.0)
MUS = (0.001, 0.02, 0.1, 0.2, 0.4, 0.8)

Random = np.random.Generator
Compare = Callable[[TwoAxesOutcome, TwoAxesOutcome], Floats]
Law = Callable[[float], Friction]


def _same(a: TwoAxesOutcome, b: TwoAxesOutcome) -> Floats:
    return np.subtract(a.places, b.places)


def _mirrored_across(a: TwoAxesOutcome, b: TwoAxesOutcome) -> Floats:
    x, y = b.end_m
    return np.subtract(a.places, [b.prd_m, b.down_m, b.up_m, b.right_m, b.left_m, x, -y])


def _mirrored_along(a: TwoAxesOutcome, b: TwoAxesOutcome) -> Floats:
    x, y = b.end_m
    return np.subtract(a.places, [b.prd_m, b.up_m, b.down_m, b.left_m, b.right_m, -x, y])


@dataclass(frozen=True, slots=True, kw_only=True)
class PairComparison:
    """Comparison of the two runs of a pair."""

    prd_m: float  # PRD of the first run [m]
    off_m: float  # largest difference in position between the two [m]
    # allowed difference: the sum of both bounds plus the effect of rounding error in the second
    # scene's input [m]; inf where friction falls with velocity
    bound_m: float

    @property
    def ratio(self) -> float:
        """Difference over bound: 1 at most."""
        return self.off_m / self.bound_m if self.off_m > 0.0 else 0.0


@dataclass(frozen=True, slots=True, kw_only=True)
class Pair:
    """Two scenes with equal results."""

    first: Scene
    second: Scene
    tolerances: tuple[float, float]  # of both runs
    rounding_m: float = 0.0  # effect of rounding error in the second scene's input (`rounding`)
    compare: Compare = _same  # returns the differences in position, which should be zero

    def run(self) -> PairComparison:
        """Run both.

        Raises `ArithmeticError` if one of them has no result.
        """
        scenes = zip((self.first, self.second), self.tolerances, strict=True)
        a, b = (follow(scene, tolerance) for scene, tolerance in scenes)
        if a.status is not Status.OK or b.status is not Status.OK:
            raise ArithmeticError(f"{a.status}, {b.status}")
        bound = a.error_m + b.error_m + self.rounding_m
        return PairComparison(
            prd_m=a.prd_m,
            off_m=float(np.abs(self.compare(a, b)).max()),
            bound_m=bound if self.first.friction.is_monotone else math.inf,
        )


def pair(kind: str, index: int) -> Pair:
    """Return pair number `index` of a kind; the same on every call."""
    # Each pair has its own generator, so that a failed pair can be run again by its number.
    return KINDS[kind](np.random.default_rng([list(KINDS).index(kind), index]))


def rounding(scene: Scene) -> float:
    """Return the effect on position of half a unit in the last place of every sample [m]."""
    # Friction is monotone: an acceleration error d changes the velocity by at most d t and the
    # position by d t^2 / 2. The same is added for the time step, whose quotient is rounded.
    sn, cs = abs(math.sin(scene.slope_rad)), math.cos(scene.slope_rad)
    mu = max(scene.friction.mu_slow, scene.friction.mu_fast)
    ax, ay, az = (
        float(np.abs(a).max(initial=0.0)) for a in (scene.ax_mps2, scene.ay_mps2, scene.az_mps2)
    )
    push = (sn + mu * cs) * (scene.g_mps2 + az) + (cs + mu * sn) * ax + ay
    return EPS * push * ((scene.ax_mps2.size - 1) * scene.dt_s) ** 2


def _wave(rng: Random, n: int) -> Floats:
    """Return a record of one of eight shapes, its peak about 1."""
    t: Floats = np.arange(n, dtype=np.float64) / max(n - 1, 1)
    wave: Floats = np.zeros(n)
    shape = rng.integers(8)
    if shape == 0:
        freq, phase = rng.uniform(0.3, 0.25 * n, (6, 1)), rng.uniform(0.0, 6.3, (6, 1))
        wave = np.sin(2.0 * np.pi * freq * t + phase).sum(axis=0) / 3.0
    elif shape == 1:
        wave = rng.normal(size=n)
    elif shape == 2:  # constant over many samples
        wave = np.repeat(rng.choice((-1.0, -0.5, 0.0, 0.5, 1.0), n), rng.integers(1, 6))[:n]
    elif shape == 3:  # mostly quiet
        wave[rng.random(n) < 0.25] = rng.normal()
    elif shape == 4:  # one-sided
        wave = np.minimum(t * rng.uniform(1.0, 8.0), 1.0)
    elif shape == 5:
        wave = np.sin(2.0 * np.pi * rng.uniform(0.5, 5.0) * t) * np.minimum(4.0 * t, 1.0)
    elif shape == 6:
        wave[rng.integers(n) :] = 1.0
    else:
        wave[rng.integers(n)] = 1.0
    return wave * float(rng.choice((-1.0, 1.0)))


def _horizontal(rng: Random, n: int, peak: float) -> tuple[Floats, Floats]:
    """Return two components; the second may be very small, proportional or piecewise constant."""
    ax, ay = _wave(rng, n) * peak * rng.lognormal(0.3, 0.7), _wave(rng, n)
    how = rng.integers(7)
    if how == 0:
        ay = ax * rng.choice((1.0, -0.5, 1e-3, 1e-9, 1e-15, -2.0))
    elif how == 1:
        ay = ay * peak * 10.0 ** -rng.uniform(1.0, 16.0)
    elif how == 2:
        ay = np.where(ay > 0.3, np.abs(ax).max(), 0.0)
    elif how == 3:
        ay = 0.0 * ay
    else:
        ay = ay * peak * rng.lognormal(0.0, 0.8)
    return (ay, ax) if rng.random() < 0.2 else (ax, ay)


def _held_down(
    rng: Random, ax: Floats, az: Floats, slope_rad: float, min_normal: float | None
) -> Floats:
    """Return a vertical record whose least normal force is `least` [g]; None: 0.05 g or more."""
    sn, cs = math.sin(slope_rad), math.cos(slope_rad)
    lowest = ((G + (az if az.size else 0.0)) * cs + ax * sn).min()
    if min_normal is None and lowest >= 0.05 * G:
        return az
    az = az if az.size else np.zeros(ax.size)
    floor = 0.05 * G if min_normal is None else min_normal * G
    if rng.random() < 0.5:
        az = az + (floor - lowest) / cs
    else:
        az = np.maximum(az, (floor - ax * sn) / cs - G)
        az[rng.integers(az.size)] = (floor - ax * sn).max() / cs - G
    # Rounding may leave a sample some bits below zero: raised until none is.
    for _ in range(60):
        short = (G + az) * cs + ax * sn < 0.0
        az = np.where(short, az + 4e-15 * G, az)
    return az


def _scene(
    rng: Random,
    *,
    slope_deg: float | None = None,
    mu: float | None = None,
    law: Law = coulomb,
    minimum_normal_g: float | None = None,
) -> Scene:
    n = int(rng.choice((2, 3, 4, 6, 10, 30)))
    slope = math.radians(rng.choice(SLOPES_DEG) if slope_deg is None else slope_deg)
    if mu is None:
        mu = float(rng.choice((*MUS, rng.uniform(0.01, 1.0))))
        if rng.random() < 0.1:
            mu = abs(math.tan(slope)) * (1.0 + rng.choice((0.0, 1e-12, 1e-3, -1e-9)))
    peak = max(mu, 0.01) * G
    ax, ay = _horizontal(rng, n, peak)
    if rng.random() < 0.15:  # at the yield acceleration of a flat roof, to the last bit
        ax = np.where(np.abs(ax) > peak, np.sign(ax) * peak, ax)
    has_vertical = rng.random() < 0.6
    az = _wave(rng, n) * G * rng.choice((0.0, 0.05, 0.3, 0.6)) if has_vertical else NO_RECORD
    return Scene(
        ax_mps2=read_only(ax),
        ay_mps2=read_only(ay),
        az_mps2=read_only(_held_down(rng, ax, az, slope, minimum_normal_g)),
        dt_s=float(rng.choice(STEPS_S)),
        slope_rad=slope,
        friction=law(float(mu)),
        scale=1.0,
        g_mps2=G,
    )


def _by_speed(rng: Random) -> Law:
    """Return friction that rises with velocity, by a random amount at a random rate."""
    rate = 0.0 if rng.random() < 0.05 else 10.0 ** rng.uniform(0.0, 3.0)
    gain = float(rng.choice((1e-6, 1e-3, 0.05, 0.5, 3.0)))

    def law(mu: float) -> Friction:
        return Friction(mu_slow=mu, mu_fast=mu + gain * mu, rate_s_per_m=rate, mu_static=mu)

    return law


def _falling(rng: Random) -> Law:
    """Return friction that is greatest at rest."""
    static, fast = 1.0 + rng.choice((0.0, 1e-6, 0.3)), rng.choice((1.0, 0.999999, 0.5))
    rate = 10.0 ** rng.uniform(0.0, 3.0)

    def law(mu: float) -> Friction:
        return Friction(
            mu_slow=mu, mu_fast=fast * mu, rate_s_per_m=rate, mu_static=float(static * mu)
        )

    return law


def finer(scene: Scene, factor: int) -> Scene:
    """Return a scene with linearly interpolated samples added."""
    coarse = np.arange(scene.ax_mps2.size)
    fine = np.arange((coarse.size - 1) * factor + 1) / factor
    ax, ay, az = (
        read_only(np.interp(fine, coarse, a)) if a.size else a
        for a in (scene.ax_mps2, scene.ay_mps2, scene.az_mps2)
    )
    return replace(scene, ax_mps2=ax, ay_mps2=ay, az_mps2=az, dt_s=scene.dt_s / factor)


def _put_between(rng: Random, first: Scene) -> Pair:
    tolerance = float(rng.choice(TOLERANCES))
    second = finer(first, int(rng.integers(2, 9)))
    return Pair(
        first=first, second=second, tolerances=(tolerance, tolerance), rounding_m=rounding(first)
    )


def _tolerances(rng: Random, first: Scene) -> Pair:
    tolerances = float(rng.choice(TOLERANCES)), float(rng.choice(TOLERANCES))
    return Pair(first=first, second=first, tolerances=tolerances)


def _either(rng: Random, first: Scene) -> Pair:
    return _put_between(rng, first) if rng.random() < 0.5 else _tolerances(rng, first)


def _mirrored(rng: Random) -> Pair:
    first, tolerance = _scene(rng), float(rng.choice(TOLERANCES))
    across, compare = replace(first, ay_mps2=read_only(-first.ay_mps2)), _mirrored_across
    if rng.random() < 0.5:
        across = replace(first, ax_mps2=read_only(-first.ax_mps2), slope_rad=-first.slope_rad)
        compare = _mirrored_along
    return Pair(first=first, second=across, tolerances=(tolerance, tolerance), compare=compare)


def _rotated(rng: Random) -> Pair:
    first, tolerance = _scene(rng, slope_deg=0.0), float(rng.choice(TOLERANCES))
    turn = float(rng.choice((math.pi / 2, rng.uniform(0.0, 6.3))))
    sn, cs = math.sin(turn), math.cos(turn)
    ax, ay = first.ax_mps2, first.ay_mps2

    def compare(a: TwoAxesOutcome, b: TwoAxesOutcome) -> Floats:
        x, y = a.end_m
        x, y = cs * x - sn * y, sn * x + cs * y
        return np.array([a.prd_m - b.prd_m, math.hypot(x - b.end_m[0], y - b.end_m[1])])

    return Pair(
        first=first,
        second=replace(
            first, ax_mps2=read_only(cs * ax - sn * ay), ay_mps2=read_only(sn * ax + cs * ay)
        ),
        tolerances=(tolerance, tolerance),
        # Two products and a sum per sample, and the same again for rotating the position.
        rounding_m=4.0 * rounding(first),
        compare=compare,
    )


def _at_tan_slope(rng: Random) -> Pair:
    degrees = float(rng.choice((0.5, 2.0, -7.0, 20.0, rng.uniform(0.1, 25.0))))
    mu = abs(math.tan(math.radians(degrees)))
    mu *= 1.0 + float(rng.choice((0.0, 0.0, EPS, -EPS, 1e-12, -1e-12, 1e-9)))
    law = coulomb if rng.random() < 0.5 else _by_speed(rng)
    return _either(rng, _scene(rng, slope_deg=degrees, mu=mu, law=law))


def _light(rng: Random) -> Pair:
    smallest_g = float(rng.choice((0.0, 0.0, 1e-15, 1e-9, 1e-6, 1e-3)))
    law = _by_speed(rng) if rng.random() < 0.2 else coulomb
    return _either(rng, _scene(rng, minimum_normal_g=smallest_g, law=law))


KINDS: dict[str, Callable[[Random], Pair]] = {
    "interpolated samples": lambda rng: _put_between(rng, _scene(rng)),
    "mirrored": _mirrored,
    "rotated on a flat roof": _rotated,
    "two tolerances": lambda rng: _tolerances(rng, _scene(rng)),
    "μ = tan(slope)": _at_tan_slope,
    "μ = 0": lambda rng: _either(rng, _scene(rng, mu=0.0)),
    "normal force near zero": _light,
    "velocity-dependent friction": lambda rng: _either(rng, _scene(rng, law=_by_speed(rng))),
    "velocity-weakening friction": lambda rng: _tolerances(rng, _scene(rng, law=_falling(rng))),
}

UNBOUNDED = ("velocity-weakening friction",)
"""Kinds whose runs have no bound; the runs must only finish."""
