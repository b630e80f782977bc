"""The rivals of the exact method: description, parameters, limitations, and how each runs a scene.

`slide(..., method="paper", substeps=64)` runs Eqs. 1-19 of the paper in 64 steps an interval.

Checks no input (`solver.sliding.arguments`), builds no results (`solver.sliding.one_axis`) and
integrates nothing itself (`solver.kernels.rivals`, `solver.kernels.runge_kutta`,
`solver.rivals.by_scipy`). Read `solver.sliding.method.Method`, then `METHODS`.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace
from functools import partial
from types import MappingProxyType

import numpy as np

from solver.kernels import one_axis, rivals, runge_kutta
from solver.model import Floats
from solver.records.record import NO_RECORD, read_only
from solver.rivals import by_scipy
from solver.sliding.method import EXACT, AxisScene, Method, Outcome, Parameters


def _frozen(scene: AxisScene, parameters: Parameters, samples: Floats) -> Outcome:
    """Run an equivalent flat roof with constant normal force by the exact kernel."""
    # On a flat roof without vertical shaking N = g' and G = -a'. So g' = g cos(theta) makes the
    # normal force constant, and a' = -G preserves the drive, vertical shaking included.
    drive, _ = drive_and_cap(scene)
    a = read_only(-drive)
    x = one_axis.bounds(a)
    none = replace(scene, az=NO_RECORD, z=one_axis.bounds(NO_RECORD))
    flat = replace(none, ax=a, x=x, sn=0.0, cs=1.0, g=scene.g * scene.cs, scale=1.0)
    return EXACT.follow(flat, parameters, samples)


def _constant(scene: AxisScene, parameters: Parameters, samples: Floats, *, skips: bool) -> Outcome:
    p = int(parameters["substeps"])
    return _outcome(rivals.slide_constant(*_letters(scene), p, skips, samples))


def _linear(scene: AxisScene, parameters: Parameters, samples: Floats) -> Outcome:
    p = int(parameters["substeps"])
    return _outcome(rivals.slide_linear(*_letters(scene), p, samples))


def _link(scene: AxisScene, parameters: Parameters, samples: Floats, *, implicit: bool) -> Outcome:
    # Stiffness / weight times g is stiffness / mass, as the kernel requires.
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
    # Only the samples are searched: SciPy's solver returns no values between them.
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
    # G = (g + az) sin(theta) - ax cos(theta), N = (g + az) cos(theta) + ax sin(theta).
    return scene.sn * z - scene.cs * x, scene.mu * (scene.cs * z + scene.sn * x)


def _letters(scene: AxisScene) -> tuple[Floats, Floats, float, float, float, float, float, float]:
    c = scene
    return c.ax, c.az, c.dt, c.sn, c.cs, c.mu, c.g, c.scale


def _outcome(computed: tuple[int, float, float, float, float, float, int]) -> Outcome:
    return Outcome(computed[0] == rivals.FOLLOWED, *computed[1:])


_AS_ACCURATE = "Never, as the exact method: restarted at each sample and event it is as accurate. "
_PAPER = "Predicted Slip of Ballasted Solar Arrays on Angled Roofs due to Seismic Motion"
# 64 is the choice of the paper, whose convergence study found errors of at most 0.48% with it.
_SUBSTEPS: Parameters = MappingProxyType({"substeps": 64})
# The link of the paper: 100 N/mm for a weight of 1 N; 20 sub-steps of a 0.02 s interval are its
# sub-step of 0.001 s.
_LINK: Parameters = MappingProxyType({"stiffness_per_m": 1e5, "substeps": 20})
_POWERS_OF_TWO = (1, 2, 4, 8, 16, 32, 64, 128, 256)

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
    EXACT,
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
            "It is unstable for sub-steps above 2 / √(g k), and above 1.7 / √(g k) it may "
            "slip in every third sub-step. A soft link adds its own stretch, μ / k, and vibrates "
            "without decay."
        ),
        source=f"{_PAPER}, SAP 2000: Newmark γ 0.5, β 0, no damping, 100 N/mm on 1 N",
        follow=partial(_link, implicit=False),
    ),
    _by_link(
        name="penalty-implicit",
        title="Link with a friction cap, implicit",
        label="link, implicit",
        invalid_when=(
            "For sub-steps above 2 / √(g k) Newton's method may alternate between stick and "
            "slip without converging. A soft link adds its own stretch, μ / k."
        ),
        source="OpenSees flatSliderBearing with Newmark γ 0.5, β 0.25 and Newton's method",
        follow=partial(_link, implicit=True),
    ),
    *(
        _without_setting(
            name=f"compiled-{name.lower()}",
            title=f"Coulomb friction, {name} with events, fully compiled",
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
        title="Friction μ N tanh(v / v₀), SciPy's LSODA",
        label="SciPy LSODA, regularized (by steps)",
        parameters=MappingProxyType({"velocity_mps": 1e-4, "tolerance": 1e-4}),
        knob="velocity_mps",
        sweep=(1e-2, 1e-3, 1e-4, 1e-5),
        order=math.nan,
        takes_vertical=True,
        invalid_when=(
            "On any slope: the block creeps at v₀ atanh(tan(θ) / μ) when it should stick, for "
            "any tolerance. Its steps are compiled, and call the compiled right-hand side through "
            "Python."
        ),
        source="scipy.integrate.odeint with a Jacobian: LSODA, Petzold, SIAM J. Sci. Stat. "
        "Comput. 4 (1983)",
        follow=_regularized,
    ),
    _without_setting(
        name="frozen-normal",
        title="Constant normal force, m g cos(θ)",
        label="normal force frozen",
        invalid_when="On any slope and with vertical shaking: both change the normal force.",
        source="As in SLAMMER's dual-slope analysis and with an elastic-plastic spring",
        follow=_frozen,
    ),
)

METHODS: Mapping[str, Method] = MappingProxyType({method.name: method for method in _ALL})
"""Every method by its name."""
