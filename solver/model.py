"""What the solver takes and gives: frozen records, outcomes, the two kinds of error.

Owns no mathematics and no files. Read `solver.sliding.checked` next.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

STANDARD_GRAVITY_MPS2 = 9.80665


class InputError(ValueError):
    """What a user can fix: every problem found, each with its place, what was found, what would do.

    Attributes
    ----------
    problems : tuple of str
        One line for each problem.
    """

    def __init__(self, problems: str | Sequence[str]):
        self.problems = (problems,) if isinstance(problems, str) else tuple(problems)
        super().__init__("\n".join(self.problems))


class DefectError(RuntimeError):
    """What only the developers can fix: a state that the code holds impossible."""


class Status(StrEnum):
    """Outcome of one run; `sentence` says it to a reader."""

    OK = "ok"
    SLIDING_AT_END = "sliding_at_end"
    UPLIFT = "uplift"
    DIVERGED = "diverged"
    STEP_LIMIT = "step_limit"

    @property
    def sentence(self) -> str:
        """The outcome in words."""
        return _SENTENCES[self]


_SENTENCES = {
    Status.OK: "followed to the end of the record, at rest there",
    Status.SLIDING_AT_END: "still sliding when the record ends: the displacement is not final",
    Status.UPLIFT: "the normal force falls below zero: outside the model, no displacement given",
    Status.DIVERGED: "the method did not converge or blew up: no displacement given",
    Status.STEP_LIMIT: "more steps are needed than a run may take: no displacement given",
}


@dataclass(frozen=True, slots=True, kw_only=True)
class SlideResult:
    """One block under one motion. Displacements are horizontal, relative to the roof.

    With `Status.UPLIFT`, `Status.DIVERGED` and `Status.STEP_LIMIT` every displacement, its time and
    its error are NaN.

    Attributes
    ----------
    status : Status
    prd_m : float
        Peak relative displacement, the largest |u| [m].
    residual_m : float
        u at the end of the record [m], positive down the slope for a positive slope.
    down_m, up_m : float
        Largest excursion in positive and in negative u [m], both >= 0.
    across_m, residual_across_m : float
        Largest excursion across the slope, either way, and where it ends, positive to the left
        of down the slope [m]; 0 in one axis. With two axes the PRD is the largest resultant.
    t_prd_s : float
        Time of the PRD [s]; 0 when nothing moves.
    n_stops : int
        How often the sliding speed came to zero, reversals included.
    n_min_g : float
        Least normal force over the record / (m g).
    t_uplift_s : float
        When the normal force first falls below zero [s]; NaN if it never does.
    end_speed_mps : float
        Horizontal relative velocity at the end of the record [m/s].
    error_m : float
        No displacement is more than this from the exact motion of the interpolated record [m]: the
        method's own bound in two axes, an allowance for rounding by the method `exact` in one
        (`sliding.rounding`); NaN for the other methods. Where friction falls with speed or at the
        breakaway there is no bound: then it is twice the difference of two tolerances.
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
    error_m: float


class EventKind(StrEnum):
    """What happens at an event of a sliding motion."""

    SLIP = "slip"
    STOP = "stop"


class Event(NamedTuple):
    """Slip begins or ends: time [s], kind, displacement down and across the slope [m].

    A tuple, because a run has hundreds of them.
    """

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
        Time [s], horizontal relative displacement [m] and velocity [m/s]; all NaN
        where the result gives none.
    across_m, across_mps : array, shape (n,) or (0,)
        The same across the slope; empty in one axis.
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


@dataclass(frozen=True, slots=True, kw_only=True)
class Friction:
    """Coefficient of friction by speed w: mu_fast - (mu_fast - mu_slow) exp(-rate w).

    Constantinou, Mokha and Reinhorn, J. Struct. Eng. 116 (1990) 455-474, Eq. 2. `mu_static` holds
    the block until it slips and whenever it has stopped.

    Attributes
    ----------
    mu_slow, mu_fast : float
        At a crawl and at great speed, >= 0.
    rate_s_per_m : float
        >= 0 [s/m].
    mu_static : float
        mu_slow or more.
    """

    mu_slow: float
    mu_fast: float
    rate_s_per_m: float
    mu_static: float

    @property
    def is_constant(self) -> bool:
        """Whether it is Coulomb's: one coefficient for all."""
        turns = self.mu_fast != self.mu_slow and self.rate_s_per_m > 0.0
        return not turns and self.mu_static == self.mu_slow

    @property
    def is_monotone(self) -> bool:
        """Whether it never falls as the speed grows, from rest on: then errors cannot grow."""
        return self.mu_fast >= self.mu_slow and self.mu_static == self.mu_slow


def coulomb(mu: float) -> Friction:
    """Return friction with one coefficient."""
    return Friction(mu_slow=mu, mu_fast=mu, rate_s_per_m=0.0, mu_static=mu)


@dataclass(frozen=True, slots=True, kw_only=True)
class Scene:
    """One block under one motion, checked.

    Attributes
    ----------
    ax_mps2, ay_mps2 : array, shape (n,)
        Horizontal roof acceleration, in the vertical plane of the slope and across it [m/s2];
        read-only, as all records.
    az_mps2 : array, shape (n,) or (0,)
        Vertical, positive up [m/s2]; empty for none.
    dt_s, slope_rad, g_mps2 : float
        As of `solver.slide`.
    scale : float
        Factor for all components.
    friction : Friction
    """

    ax_mps2: Floats
    ay_mps2: Floats
    az_mps2: Floats
    dt_s: float
    slope_rad: float
    friction: Friction
    scale: float
    g_mps2: float


@dataclass(frozen=True, slots=True, kw_only=True)
class Heading:
    """Which horizontal component of a motion runs along the slope, and in which sense.

    The other one runs across it as recorded: its sense mirrors the motion of the block and
    changes no displacement.

    Attributes
    ----------
    swapped : bool
        Whether the transverse component runs along the slope instead of the record.
    sign : int
        +1 as recorded, -1 reversed.
    """

    swapped: bool
    sign: int

    @property
    def component(self) -> str:
        """The component along the slope, in words: record or transverse."""
        return "transverse" if self.swapped else "record"

    @property
    def name(self) -> str:
        """The run in words, such as `record +` or `transverse −`."""
        return f"{self.component} {'+' if self.sign > 0 else '−'}"


@dataclass(frozen=True, slots=True, kw_only=True)
class Motion:
    """A roof motion ready to run: scaled, in m/s2, evenly sampled, arrays read-only.

    Attributes
    ----------
    id, source : str
    dt_s : float
        Sampling interval [s].
    ax_mps2, ay_mps2, az_mps2 : array, shape (n,)
        Horizontal record, the other horizontal component (transverse) and vertical (positive up)
        acceleration, unscaled [m/s2]; ay or az of shape (0,) where there is none.
    scale : float
        Factor for all components.
    signs : tuple of int
        Polarities of a horizontal component to run, from {+1, -1}.
    """

    id: str
    source: str
    dt_s: float
    ax_mps2: Floats
    ay_mps2: Floats
    az_mps2: Floats
    scale: float
    signs: tuple[int, ...]

    @property
    def has_vertical(self) -> bool:
        """Whether a vertical component goes with the horizontal one."""
        return len(self.az_mps2) > 0

    @property
    def has_transverse(self) -> bool:
        """Whether there is a second horizontal component."""
        return len(self.ay_mps2) > 0

    @property
    def headings(self) -> tuple[Heading, ...]:
        """The runs along the slope: each horizontal component in each of its polarities."""
        components = (False, True) if self.has_transverse else (False,)
        return tuple(Heading(swapped=s, sign=sign) for s in components for sign in self.signs)

    def scene(self, heading: Heading, *, slope_rad: float, friction: Friction) -> Scene:
        """Return a run of an array: a slope, its friction, and this motion with a heading."""
        along, across = self.ax_mps2, self.ay_mps2
        if heading.swapped:
            along, across = across, along
        along = along * heading.sign
        along.setflags(write=False)
        return Scene(
            ax_mps2=along,
            ay_mps2=across,
            az_mps2=self.az_mps2,
            dt_s=self.dt_s,
            slope_rad=slope_rad,
            friction=friction,
            scale=self.scale,
            g_mps2=STANDARD_GRAVITY_MPS2,
        )
