"""The one-axis methods by name: description, parameters, limitations, and how each runs a scene.

Checks no input (`solver.sliding.arguments`), builds no results (`solver.sliding.one_axis`) and
integrates nothing itself (`solver.kernels.one_axis`, `solver.kernels.rivals`,
`solver.kernels.runge_kutta`, `solver.rivals.by_scipy`). Read `METHODS` first.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import partial
from types import MappingProxyType
from typing import NamedTuple

import numpy as np

from solver.kernels import one_axis, rivals, runge_kutta
from solver.model import Floats
from solver.records.record import NO_RECORD, read_only
from solver.rivals import by_scipy


@dataclass(frozen=True, slots=True)
class AxisScene:
    """One block under one motion, checked, in the notation of the kernels.

    `ax` and `az` are read-only; `az` has shape (0,) without vertical shaking. `x` and `z` are the
    `one_axis.bounds` of `ax` and `az`.
    """

    ax: Floats
    x: Floats
    az: Floats
    z: Floats
    dt: float
    sn: float
    cs: float
    mu: float
    g: float
    scale: float


class Outcome(NamedTuple):
    """Result of a method, along the slope: [m], [m/s], [s].

    The largest speed is that of the exact kernel; NaN by the other methods.
    """

    followed: bool
    s_max: float
    s_min: float
    s_end: float
    w_end: float
    t_peak: float
    n_stops: int
    w_max: float = math.nan


Parameters = Mapping[str, float]
# Runs a scene. An array of shape (2, n) is filled with s and s' at the samples; (2, 0) is not.
Follow = Callable[[AxisScene, Parameters, Floats], Outcome]


@dataclass(frozen=True, slots=True, kw_only=True)
class Method:
    """One method to compute the motion of the block.

    Attributes
    ----------
    name, title, label : str
        Key, title, and label in a legend.
    parameters : mapping
        Its parameters with their defaults.
    knob : str
        The parameter that controls its accuracy; empty if there is none.
    sweep : tuple of float
        Values of that parameter from coarse to fine.
    order : float
        Formal order of the error in the sub-step for smooth motion; NaN if there is none. With
        stick-slip events every order drops to first.
    takes_vertical : bool
    invalid_when : str
        Conditions in which it should not be used, as a sentence.
    source : str
    link_steps_per_radian : float
        In a sweep (`settings`), sub-steps for each radian omega dt of the link; 0 without a link.
    follow : callable
        Given the `AxisScene`, the parameters by name, and an array of shape (2, n) that it fills
        with displacement [m] and velocity [m/s] along the slope, or of shape (2, 0).
    """

    name: str
    title: str
    label: str
    parameters: Parameters
    knob: str
    sweep: tuple[float, ...]
    order: float
    takes_vertical: bool
    invalid_when: str
    source: str
    link_steps_per_radian: float = 0.0
    follow: Follow

    def settings(self, value: float, dt_s: float, g_mps2: float) -> dict[str, float]:
        """Return all parameters for one value of the knob, with the sub-steps that a link needs."""
        parameters = dict(self.parameters) | {self.knob: value}
        if self.link_steps_per_radian:
            # A sub-step is 1 / omega at most: beyond 2 / omega the explicit link is unstable.
            radians = link_frequency(parameters["stiffness_per_m"], g_mps2) * dt_s
            parameters["substeps"] = max(1, math.ceil(radians * self.link_steps_per_radian))
        return parameters


def link_frequency(stiffness_per_m: float, g_mps2: float) -> float:
    """Return omega = sqrt(g k) [rad/s] of a block on a link, k its stiffness over the weight."""
    return math.sqrt(g_mps2 * stiffness_per_m)


def minimum_normal(scene: AxisScene) -> tuple[float, float]:
    """Return the least N / (m g), and when N first falls below zero [s]; NaN if it never does."""
    c, (az, z) = scene, _vertical(scene)
    n_min_and_time: tuple[float, float] = one_axis.minimum_normal(
        c.ax, az, c.x, z, c.dt, c.sn, c.cs, c.g, c.scale
    )
    return n_min_and_time


def exact_events(scene: AxisScene, n_stops: int) -> Floats:
    """Return time, kind (see `kernels.one_axis`) and s of each event of a run with n_stops stops.

    Shape (m, 3).
    """
    # A slip before each stop, and one that may go on at the end.
    rows = np.empty((2 * n_stops + 1, 3))
    n_events = _run_exact(scene, rows)[-1]
    return rows[: int(n_events)]


def _vertical(scene: AxisScene) -> tuple[Floats | None, Floats | None]:
    """Return the vertical record and its bounds as the exact kernels take them."""
    return (scene.az, scene.z) if scene.az.size else (None, None)


def _run_exact(
    scene: AxisScene, events: Floats | None
) -> tuple[float, float, float, float, float, int, float, int]:
    c, (az, z) = scene, _vertical(scene)
    result: tuple[float, float, float, float, float, int, float, int] = one_axis.slide_exact(
        c.ax, az, c.x, z, c.dt, c.sn, c.cs, c.mu, c.g, c.scale, events
    )
    return result


def _exact(scene: AxisScene, _: Parameters, samples: Floats) -> Outcome:
    c, outcome = scene, Outcome(True, *_run_exact(scene, None)[:-1])
    if samples.size:
        events = exact_events(scene, outcome.n_stops)
        one_axis.fill_history(
            c.ax, _vertical(c)[0], c.dt, c.sn, c.cs, c.mu, c.g, c.scale, events, samples
        )
        # As the run has them, so that history and result agree to the last bit.
        samples[:, -1] = outcome.s_end, outcome.w_end
    return outcome


def _frozen(scene: AxisScene, parameters: Parameters, samples: Floats) -> Outcome:
    """Run an equivalent flat roof with constant normal force by the exact kernel."""
    # On a flat roof without vertical shaking N = g' and G = -a'. So g' = g cos(theta) makes the
    # normal force constant, and a' = -G preserves the drive, vertical shaking included.
    drive, _ = drive_and_cap(scene)
    a = read_only(-drive)
    x = one_axis.bounds(a)
    none = replace(scene, az=NO_RECORD, z=one_axis.bounds(NO_RECORD))
    flat = replace(none, ax=a, x=x, sn=0.0, cs=1.0, g=scene.g * scene.cs, scale=1.0)
    return _exact(flat, parameters, samples)


def _constant(scene: AxisScene, parameters: Parameters, samples: Floats, *, skips: bool) -> Outcome:
    p = int(parameters["substeps"])
    return _outcome(rivals.slide_constant(*_letters(scene), p, skips, samples))


def _linear(scene: AxisScene, parameters: Parameters, samples: Floats) -> Outcome:
    p = int(parameters["substeps"])
    return _outcome(rivals.slide_linear(*_letters(scene), p, samples))


def _link(scene: AxisScene, parameters: Parameters, samples: Floats, *, implicit: bool) -> Outcome:
    p, k = int(parameters["substeps"]), scene.g * parameters["stiffness_per_m"]
    return _outcome(rivals.slide_link(*_letters(scene), p, k, implicit, samples))


def _compiled(scene: AxisScene, _: Parameters, samples: Floats, *, order: int) -> Outcome:
    return Outcome(*runge_kutta.slide_line(*_letters(scene), order, samples))


def _by_events(scene: AxisScene, _: Parameters, samples: Floats, *, solver: str) -> Outcome:
    return Outcome(*by_scipy.line(*drive_and_cap(scene), scene.dt, solver, samples))


def _regularized(scene: AxisScene, parameters: Parameters, samples: Floats) -> Outcome:
    """Run friction without stick; a block slower than v0 at the end counts as at rest."""
    v0 = parameters["velocity_mps"]
    rows = np.column_stack(drive_and_cap(scene))
    s, w = history = by_scipy.regularized(rows, scene.dt, v0, parameters["tolerance"])
    if samples.size:
        samples[:] = history
    peak = int(np.abs(s).argmax())
    # It creeps and never rests: what is slower than v0 is taken for a stop.
    moving = np.sign(w) * (np.abs(w) > v0)
    n_stops = int(((moving[:-1] != 0.0) & (moving[1:] != moving[:-1])).sum())
    end = float(w[-1]) if moving[-1] else 0.0
    is_finite = bool(np.isfinite(history).all())
    return Outcome(
        is_finite, float(s.max()), float(s.min()), float(s[-1]), end, peak * scene.dt, n_stops
    )


def drive_and_cap(scene: AxisScene) -> tuple[Floats, Floats]:
    """Return G and mu N at the samples [m/s2]."""
    x = scene.scale * scene.ax
    z = scene.g + scene.scale * (scene.az if scene.az.size else np.zeros_like(x))
    return scene.sn * z - scene.cs * x, scene.mu * (scene.cs * z + scene.sn * x)


def _letters(scene: AxisScene) -> tuple[Floats, Floats, float, float, float, float, float, float]:
    c = scene
    return c.ax, c.az, c.dt, c.sn, c.cs, c.mu, c.g, c.scale


def _outcome(computed: tuple[int, float, float, float, float, float, int]) -> Outcome:
    return Outcome(computed[0] == rivals.FOLLOWED, *computed[1:])


_AS_ACCURATE = "Never, as the exact method: restarted at each sample and event it is as accurate. "
_PAPER = "Predicted Slip of Ballasted Solar Arrays on Angled Roofs due to Seismic Motion"
_SUBSTEPS: Parameters = MappingProxyType({"substeps": 64})
_LINK: Parameters = MappingProxyType({"stiffness_per_m": 1e5, "substeps": 20})
_POWERS_OF_TWO = (1, 2, 4, 8, 16, 32, 64, 128, 256)

_WHOLE = "a whole number of 1 or more"
_POSITIVE = "a finite number above 0"
_TOLERANCE = "a number from 1e-13 to 0.1"
# What each parameter accepts, in words and as a test.
WANTED: Mapping[str, tuple[str, Callable[[float], bool]]] = {
    "substeps": (_WHOLE, lambda v: v >= 1.0 and v.is_integer()),
    "stiffness_per_m": (_POSITIVE, lambda v: 0.0 < v < math.inf),
    "velocity_mps": (_POSITIVE, lambda v: 0.0 < v < math.inf),
    "tolerance": (_TOLERANCE, lambda v: 1e-13 <= v <= 0.1),
}

# What a parameter of a method of your own accepts.
ANY_NUMBER = ("a finite number", math.isfinite)

# What methods have in common: those without a setting, by sub-steps, and with a link.
_without_setting = partial(
    Method, parameters=MappingProxyType({}), knob="", sweep=(), order=math.nan, takes_vertical=True
)
_by_substeps = partial(Method, parameters=_SUBSTEPS, knob="substeps", sweep=_POWERS_OF_TWO)
_by_link = partial(
    Method,
    parameters=_LINK,
    knob="stiffness_per_m",
    sweep=(1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8),
    order=2.0,
    takes_vertical=True,
    link_steps_per_radian=1.0,
)

_ALL = (
    _without_setting(
        name="exact",
        title="Exact, event by event",
        label="exact",
        invalid_when="Never, if the model is one rigid block with one friction coefficient.",
        source="solver.kernels.one_axis.slide_exact: roots of the cubic motion between samples",
        follow=_exact,
    ),
    _by_substeps(
        name="paper",
        title="The paper's, constant acceleration",
        label="paper's, constant acceleration",
        order=1.0,
        takes_vertical=False,
        invalid_when=(
            "With vertical shaking. With few sub-steps its error varies irregularly with their "
            "number, because events fall at different points of a sub-step."
        ),
        source=f"{_PAPER}, Eqs. 1-19",
        follow=partial(_constant, skips=False),
    ),
    _by_substeps(
        name="linear",
        title="Linear acceleration",
        label="linear acceleration",
        order=2.0,
        takes_vertical=True,
        invalid_when=(
            "If the block often reverses without coming to rest: the method is then first order, "
            "because it detects a reversal only at the end of a sub-step."
        ),
        source=f"{_PAPER}, Limitations: a linear acceleration method",
        follow=_linear,
    ),
    _by_substeps(
        name="adaptive",
        title="The paper's, sub-steps during slip only",
        label="paper's, sub-steps in slip only",
        order=1.0,
        takes_vertical=True,
        invalid_when=(
            "As for the paper's method, whose results it reproduces; it saves no time during "
            "sustained slip."
        ),
        source=f"{_PAPER}, Limitations: larger time steps while no slip is detected",
        follow=partial(_constant, skips=True),
    ),
    _by_link(
        name="penalty-explicit",
        title="Link with a friction cap, explicit",
        label="link, explicit",
        invalid_when=(
            "It is unstable for sub-steps above 2 / sqrt(g k), and above 1.7 / sqrt(g k) it may "
            "slip in every third sub-step. A soft link adds its own stretch, mu / k, and vibrates "
            "without decay."
        ),
        source=f"{_PAPER}, SAP 2000: Newmark gamma 0.5, beta 0, no damping, 100 N/mm on 1 N",
        follow=partial(_link, implicit=False),
    ),
    _by_link(
        name="penalty-implicit",
        title="Link with a friction cap, implicit",
        label="link, implicit",
        invalid_when=(
            "For sub-steps above 2 / sqrt(g k) Newton's method may alternate between stick and "
            "slip without converging. A soft link adds its own stretch, mu / k."
        ),
        source="OpenSees flatSliderBearing with Newmark gamma 0.5, beta 0.25 and Newton's method",
        follow=partial(_link, implicit=True),
    ),
    *(
        _without_setting(
            name=f"compiled-{name.lower()}",
            title=f"Coulomb friction, {name} with events, compiled whole",
            label=f"{name}, events (compiled)",
            invalid_when=f"{_AS_ACCURATE}Its steps are compiled with what restarts them.",
            source=f"solver.kernels.runge_kutta.slide_line: {authors}",
            follow=partial(_compiled, order=order),
        )
        for name, order, authors in (
            ("DOP853", 8, "Hairer, Nørsett, Wanner, Solving Ordinary Differential Equations I"),
            ("RK45", 5, "Dormand, Prince, J. Comput. Appl. Math. 6 (1980)"),
        )
    ),
    *(
        _without_setting(
            name=f"events-{solver.lower()}",
            title=f"Coulomb friction, SciPy's {solver} with events",
            label=f"SciPy {solver}, events (interpreted)",
            invalid_when=(
                f"{_AS_ACCURATE}Its steps run in Python; the right-hand side is compiled."
            ),
            source=f"scipy.integrate.{solver}, scipy.optimize.brentq",
            follow=partial(_by_events, solver=solver),
        )
        for solver in ("DOP853", "RK45")
    ),
    Method(
        name="regularized",
        title="Friction mu N tanh(v / v0), SciPy's LSODA",
        label="SciPy LSODA, regularized (by steps)",
        parameters=MappingProxyType({"velocity_mps": 1e-4, "tolerance": 1e-4}),
        knob="velocity_mps",
        sweep=(1e-2, 1e-3, 1e-4, 1e-5),
        order=math.nan,
        takes_vertical=True,
        invalid_when=(
            "On any slope: the block creeps at v0 atanh(tan(theta) / mu) when it should stick, for "
            "any tolerance. Its steps are compiled, and call the compiled right-hand side through "
            "Python."
        ),
        source="scipy.integrate.odeint with a Jacobian: LSODA, Petzold, SIAM J. Sci. Stat. "
        "Comput. 4 (1983)",
        follow=_regularized,
    ),
    _without_setting(
        name="frozen-normal",
        title="Constant normal force, m g cos(theta)",
        label="normal force frozen",
        invalid_when="On any slope and with vertical shaking: both change the normal force.",
        source="As in SLAMMER's dual-slope analysis and with an elastic-plastic spring",
        follow=_frozen,
    ),
)

METHODS: Mapping[str, Method] = MappingProxyType({method.name: method for method in _ALL})
"""Every method by its name."""
