"""Data types of a run: friction, motion, scene and result, all frozen.

Contains no mathematics and reads no files. Read `solver.sliding.checked` next.
"""

from __future__ import annotations

import math
from dataclasses import astuple, dataclass
from enum import StrEnum
from functools import cached_property
from itertools import product
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    import pandas as pd

Floats = NDArray[np.float64]

# Both exact: the international inch of 1959, and g_n of the third General Conference on Weights and
# Measures (1901).
INCH_M = 0.0254
STANDARD_GRAVITY_MPS2 = 9.80665


class Status(StrEnum):
    """Outcome of one run; `sentence` describes it for the reader."""

    OK = "ok"
    SLIDING_AT_END = "sliding_at_end"
    UPLIFT = "uplift"
    DIVERGED = "diverged"
    STEP_LIMIT = "step_limit"

    @property
    def sentence(self) -> str:
        """The outcome as a phrase."""
        return _SENTENCES[self]


_SENTENCES = {
    Status.OK: "at rest at the end of the record",
    Status.SLIDING_AT_END: "still sliding at the end of the record: the displacement is not final",
    Status.UPLIFT: "the normal force falls below zero: outside the model, no displacement reported",
    Status.DIVERGED: "the method did not converge or became unstable: no displacement reported",
    Status.STEP_LIMIT: "the run exceeded the limit on time steps: no displacement reported",
}


@dataclass(frozen=True, slots=True, kw_only=True)
class SlideResult:
    """One block under one motion. Displacements are horizontal, relative to the roof.

    With `Status.UPLIFT`, `Status.DIVERGED` or `Status.STEP_LIMIT` every displacement, its time and
    its error, and every speed are NaN.

    Attributes
    ----------
    status : Status
    prd_m : float
        Peak relative displacement, the largest |u| [m].
    residual_m : float
        u at the end of the record [m], positive downslope for a positive slope.
    down_m, up_m : float
        Largest excursion toward positive and toward negative u [m], both >= 0.
    across_m, residual_across_m : float
        Largest cross-slope excursion in either direction, and cross-slope displacement at the end,
        positive to the left when facing downslope [m]; 0 in one axis. In two axes the PRD is the
        largest resultant.
    t_prd_s : float
        Time of the PRD [s]; 0 if the block does not slip.
    n_stops : int
        Number of times the sliding velocity became zero, reversals included.
    n_min_g : float
        Minimum normal force over the record / (m g).
    t_uplift_s : float
        When the normal force first falls below zero [s]; NaN if it never does.
    end_speed_mps : float
        Horizontal relative velocity at the end of the record [m/s].
    peak_speed_mps : float
        Largest sliding speed [m/s], along the surface of the roof as in the friction law; NaN by
        methods other than `exact`.
    error_m : float
        Largest difference of any displacement from the exact motion under the interpolated record
        [m]: the method's own bound in two axes; in one axis an allowance for rounding error by the
        method `exact`, and NaN for the other methods. If friction decreases with velocity or at
        breakaway there is no bound: it is 16 times the difference between runs at two tolerances.
    """

    status: Status
    prd_m: float
    residual_m: float
    down_m: float
    up_m: float
    across_m: float
    residual_across_m: float
    t_prd_s: float
    n_stops: int
    n_min_g: float
    t_uplift_s: float
    end_speed_mps: float
    peak_speed_mps: float
    error_m: float

    def __repr__(self) -> str:
        return f"SlideResult: {self.words}"

    @property
    def words(self) -> str:
        """One-line summary of the result."""
        if math.isnan(self.prd_m):
            return self.status.sentence
        if self.prd_m == 0.0:
            return "no slip"
        when = "" if math.isnan(self.t_prd_s) else f" at {self.t_prd_s:.2f} s"
        # z: what rounds to zero has no minus sign.
        end = f"{1e3 * self.residual_m:+z.1f} mm"
        if self.residual_across_m:
            end += f" and {1e3 * self.residual_across_m:+z.1f} mm cross-slope"
        stops = f"{self.n_stops} {'stop' if self.n_stops == 1 else 'stops'}"
        return f"PRD {1e3 * self.prd_m:.1f} mm{when}, {end} at the end, {stops}, {self.status}"

    def __eq__(self, other: object) -> bool:
        """Whether all values are equal; NaN equals NaN, in every version of Python."""
        return isinstance(other, SlideResult) and self._values == other._values

    def __hash__(self) -> int:
        # Computed from the same values as equality: the hash of a NaN depends on its identity.
        return hash(self._values)

    @property
    def _values(self) -> tuple[object, ...]:
        # NaN is the only value that differs from itself; it is compared as None.
        return tuple(None if value != value else value for value in astuple(self))


class EventKind(StrEnum):
    """Kind of event in a sliding motion."""

    SLIP = "slip"
    STOP = "stop"


class Event(NamedTuple):
    """Slip begins or ends: time [s], kind, downslope and cross-slope displacement [m]."""

    # A tuple for speed: a run has hundreds of them.
    t_s: float
    kind: EventKind
    u_m: float
    across_m: float = 0.0


@dataclass(frozen=True, slots=True, kw_only=True)
class SlideHistory:
    """The motion at the samples of the record, with its events.

    Attributes
    ----------
    t_s, u_m, v_mps : array, shape (n,)
        Time [s], horizontal relative displacement [m] and velocity [m/s]; displacement and velocity
        are NaN if the result gives no displacement.
    across_m, across_mps : array, shape (n,) or (0,)
        Cross-slope displacement [m] and velocity [m/s]; empty in one axis.
    events : tuple of Event
    result : SlideResult
    """

    t_s: Floats
    u_m: Floats
    v_mps: Floats
    across_m: Floats
    across_mps: Floats
    events: tuple[Event, ...]
    result: SlideResult

    def __repr__(self) -> str:
        samples, events = len(self.t_s), len(self.events)
        return f"SlideHistory: {samples} samples, {events} events; {self.result.words}"

    def to_frame(self) -> pd.DataFrame:
        """Return the motion as a table with one row per sample, indexed by time [s].

        Columns: `u_m`, `v_mps`, and in two axes `across_m`, `across_mps`.
        """
        import pandas as pd  # optional, and 0.8 s to load

        columns = {"u_m": self.u_m, "v_mps": self.v_mps}
        if self.across_m.size:
            columns |= {"across_m": self.across_m, "across_mps": self.across_mps}
        return pd.DataFrame(columns, index=pd.Index(self.t_s, name="t_s"))


@dataclass(frozen=True, slots=True, kw_only=True)
class Friction:
    """Velocity-dependent coefficient of friction: mu_fast - (mu_fast - mu_slow) exp(-rate w).

    w is the sliding speed. Constantinou, Mokha and Reinhorn, J. Struct. Eng. 116 (1990) 455-474,
    Eq. 2. `mu_static` applies to a block at rest: before the first slip and after every stop.

    Attributes
    ----------
    mu_slow, mu_fast : float
        Coefficient at low and at high velocity, >= 0.
    rate_s_per_m : float
        >= 0 [s/m].
    mu_static : float
        mu_slow or more.
    """

    mu_slow: float
    mu_fast: float
    rate_s_per_m: float
    mu_static: float

    def at(self, speed_mps: float) -> float:
        """Return the coefficient at a sliding speed [m/s]."""
        drop = self.mu_fast - self.mu_slow
        return self.mu_fast - drop * math.exp(-self.rate_s_per_m * speed_mps)

    @property
    def is_by_velocity(self) -> bool:
        """Whether it depends on velocity while sliding."""
        return self.mu_fast != self.mu_slow and self.rate_s_per_m > 0.0

    @property
    def is_constant(self) -> bool:
        """Whether it is Coulomb friction: one coefficient at rest and at every velocity."""
        return not self.is_by_velocity and self.mu_static == self.mu_slow

    @property
    def is_monotone(self) -> bool:
        """Whether it never decreases with velocity, from rest on, so that errors cannot grow."""
        # Friction is then a monotone operator of velocity: the difference of the velocities of two
        # blocks never increases (Brezis, cited in `solver.kernels.two_axes.slide_plane`).
        return self.mu_fast >= self.mu_slow and self.mu_static == self.mu_slow


def coulomb(mu: float) -> Friction:
    """Return Coulomb friction with one coefficient.

    Parameters
    ----------
    mu : float
        Friction coefficient, static and kinetic, >= 0.

    Returns
    -------
    Friction

    Raises
    ------
    Nothing
        The function that receives the friction checks it.

    Examples
    --------
    >>> coulomb(0.4).at(1.0)
    0.4
    """
    return Friction(mu_slow=mu, mu_fast=mu, rate_s_per_m=0.0, mu_static=mu)


@dataclass(frozen=True, slots=True, kw_only=True)
class Accelerations:
    """The acceleration of a roof, evenly sampled, with a factor on all its components.

    Horizontal, transverse, and vertical (positive upward), unscaled, shape (n,), read-only; ay or
    az has shape (0,) if there is none.
    """

    dt_s: float
    ax_mps2: Floats
    ay_mps2: Floats
    az_mps2: Floats
    scale: float  # beside the arrays, as kernels take it: scenes of any scale share them

    @property
    def components(self) -> dict[str, Floats]:
        """The existing components by the names x, y and z, unscaled [m/s2]."""
        arrays = {"x": self.ax_mps2, "y": self.ay_mps2, "z": self.az_mps2}
        return {name: a for name, a in arrays.items() if len(a)}

    def scaled(self, unscaled: Floats) -> Floats:
        """Return a component, or a quantity proportional to it such as its spectrum, as run."""
        return self.scale * unscaled


@dataclass(frozen=True, slots=True, kw_only=True)
class Scene(Accelerations):
    """One block under one motion, checked; ax is along the slope, ay cross-slope.

    Attributes
    ----------
    Those of `Accelerations`, and
    slope_rad, g_mps2 : float
        As in `solver.slide`.
    friction : Friction
    """

    slope_rad: float
    friction: Friction
    g_mps2: float

    def __repr__(self) -> str:
        axes = len(self.components)
        return (
            f"Scene({axes} component{'s' if axes > 1 else ''} of {self.ax_mps2.size} samples at "
            f"{self.dt_s:g} s, slope {math.degrees(self.slope_rad):.4g} deg, mu "
            f"{self.friction.mu_slow:g}, scale {self.scale:g})"
        )


class HorizontalComponent(StrEnum):
    """A horizontal component of a motion."""

    RECORD = "record"
    TRANSVERSE = "transverse"


@dataclass(frozen=True, slots=True, kw_only=True)
class Orientation:
    """Which horizontal component of a motion is applied along the slope, and with which sign.

    The other component is applied cross-slope as recorded: reversing it mirrors the motion of the
    block and changes no displacement.
    """

    component: HorizontalComponent  # the one along the slope
    polarity: int  # +1 as recorded, -1 reversed

    @property
    def is_transverse(self) -> bool:
        """Whether the transverse component is along the slope."""
        return self.component is HorizontalComponent.TRANSVERSE

    @property
    def name(self) -> str:
        """Name of the run, such as `record +` or `transverse −`."""
        return f"{self.component} {'+' if self.polarity > 0 else '−'}"


@dataclass(frozen=True, kw_only=True)  # without slots, for what is computed once
class Motion(Accelerations):
    """A roof motion ready to run; ax is the horizontal record, ay the transverse component.

    Attributes
    ----------
    Those of `Accelerations`, and
    id, source : str
    signs : tuple of int
        Polarities in which each horizontal component is run, from {+1, -1}.
    """

    id: str
    source: str
    signs: tuple[int, ...]

    # Scenes share all their arrays with the motion: a package has hundreds of scenes, and gives
    # them to another process.
    @cached_property
    def _reversed(self) -> tuple[Floats, Floats]:
        """The horizontal components reversed."""
        backward = (-self.ax_mps2, -self.ay_mps2)
        for component in backward:
            component.setflags(write=False)
        return backward

    def __repr__(self) -> str:
        samples = f"{len(self.ax_mps2)} samples of {self.dt_s:g} s"
        names = " and ".join(self.components)
        return f"Motion: {self.id}, {names}, {samples}, scale {self.scale:g}"

    @property
    def has_vertical(self) -> bool:
        """Whether there is a vertical component."""
        return len(self.az_mps2) > 0

    @property
    def has_transverse(self) -> bool:
        """Whether there is a second horizontal component."""
        return len(self.ay_mps2) > 0

    @property
    def orientations(self) -> tuple[Orientation, ...]:
        """The runs: each horizontal component along the slope, in each of its polarities."""
        components = tuple(HorizontalComponent)[: 1 + self.has_transverse]
        runs = product(components, self.signs)
        return tuple(Orientation(component=component, polarity=sign) for component, sign in runs)

    def scene(self, orientation: Orientation, *, slope_rad: float, friction: Friction) -> Scene:
        """Return the scene of one run: this motion in an orientation, on a slope with friction."""
        # The cross-slope component keeps its sign: reversing it would only mirror the motion.
        components, along_index = (self.ax_mps2, self.ay_mps2), int(orientation.is_transverse)
        along = (components if orientation.polarity > 0 else self._reversed)[along_index]
        return Scene(
            ax_mps2=along,
            ay_mps2=components[1 - along_index],
            az_mps2=self.az_mps2,
            dt_s=self.dt_s,
            slope_rad=slope_rad,
            friction=friction,
            scale=self.scale,
            g_mps2=STANDARD_GRAVITY_MPS2,
        )
