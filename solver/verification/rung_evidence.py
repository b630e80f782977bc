"""What the comparison of the models finds, as frozen records: rung against rung, work, speed.

Computes nothing but ratios. Read `solver.verification.rung_study` for what fills them.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from solver.model import Floats

LEAST_M = 5e-3
"""PRD of both rungs from which on their ratio is told [m]: below, it says little."""

VERTICAL, SECOND, WORST = "Vertical", "Second axis", "Second axis, worst heading"
STIFF, SOFT = "Row, links of 1 mm", "Row, links of 10 mm"
OVER_SLOW, OVER_FAST = "Friction by speed, over μ slow", "Friction by speed, over μ fast"
HELD_ONE, HELD = "Static friction, one axis", "Static friction, two axes"
OVER_STATIC = "Static friction, over μ static"


@dataclass(frozen=True, slots=True, kw_only=True)
class RungChange:
    """What a fuller model does to the PRD, over many runs.

    Attributes
    ----------
    name : str
    ratios : array, shape (n,)
        PRD of the fuller model over that of the lesser, rising; of the runs in which both are
        `LEAST_M` or more.
    n_small : int
        Runs in which one of them is less.
    most_m : float
        Largest change of the PRD, either way, of all runs [m].
    """

    name: str
    ratios: Floats
    n_small: int
    most_m: float

    def at(self, percent: float) -> float:
        """Return a percentile of the ratios; NaN where there are none."""
        return float(np.percentile(self.ratios, percent)) if self.ratios.size else float("nan")

    @property
    def median(self) -> float:
        """The middle ratio."""
        return self.at(50.0)

    @property
    def share_above_one(self) -> float:
        """Share of the ratios that are above 1; NaN where there are none."""
        return float(np.mean(self.ratios > 1.0)) if self.ratios.size else float("nan")


@dataclass(frozen=True, slots=True, kw_only=True)
class RungStudy:
    """The same scenes by every rung.

    Attributes
    ----------
    motions : tuple of str
    n_recorded : int
        Of the motions, in earthquakes.
    slopes_deg, mus, ppas_g : tuple of float
        The scenes: every one with every other.
    slow_share, rate_s_per_m : float
        Friction by speed: mu_slow, the coefficient of the other rungs, over mu_fast; its rate.
        The same share is kinetic of static friction where they differ.
    n_runs, n_uplift : int
        Scenes times motions and headings, and those in which the normal force vanishes.
    changes : tuple of RungChange
        `VERTICAL`, `SECOND`, `WORST`, `OVER_SLOW`, `OVER_FAST`, `HELD_ONE`, `HELD`,
        `OVER_STATIC`, `STIFF` and `SOFT`.
    row_ppa_g : float
        Of the rows, which run in the first heading alone.
    row_shares : tuple of float
        Friction of the blocks of a row over that of the scene.
    largest_error : float
        Largest bound of the error of two axes, of the PRD.
    """

    motions: tuple[str, ...]
    n_recorded: int
    slopes_deg: tuple[float, ...]
    mus: tuple[float, ...]
    ppas_g: tuple[float, ...]
    slow_share: float
    rate_s_per_m: float
    n_runs: int
    n_uplift: int
    changes: tuple[RungChange, ...]
    row_ppa_g: float
    row_shares: tuple[float, ...]
    largest_error: float

    def named(self, name: str) -> RungChange:
        """Return the change of a name."""
        return next(one for one in self.changes if one.name == name)


@dataclass(frozen=True, slots=True, kw_only=True)
class StaticDifference:
    """What is left of static above kinetic friction as their difference falls.

    Attributes
    ----------
    excess : float
        Static over kinetic friction, less 1.
    one_axis, two_axes : array, shape (n,)
        Change of the PRD of each scene, of that with kinetic friction alone, rising.
    """

    excess: float
    one_axis: Floats
    two_axes: Floats


@dataclass(frozen=True, slots=True, kw_only=True)
class FadingAxis:
    """How near two axes come to one as the second component fades.

    Attributes
    ----------
    share : float
        Factor of the second component.
    one_coefficient, static_above : array, shape (n,)
        Change of the PRD of each scene, of that in one axis with the same friction, rising:
        with kinetic friction alone, and with more of it at rest.
    """

    share: float
    one_coefficient: Floats
    static_above: Floats


@dataclass(frozen=True, slots=True, kw_only=True)
class PushedPoint:
    """A block that is pushed back by more than kinetic and less than static friction.

    Attributes
    ----------
    across_mps2 : float
        What pushes it across as well [m/s2].
    end_m : float
        How far from the start it ends [m].
    error_m : float
        What the run says of its own error [m].
    falling_end_m : float
        Where friction falls from static to kinetic with speed, not at once [m].
    """

    across_mps2: float
    end_m: float
    error_m: float
    falling_end_m: float


@dataclass(frozen=True, slots=True, kw_only=True)
class StaticEvidence:
    """What is found of static above kinetic friction.

    Attributes
    ----------
    n_scenes : int
        Of `differences` and `fading`: those whose PRD in one axis is `LEAST_M` or more.
    ratio : float
        Static over kinetic friction of `fading`.
    differences : tuple of StaticDifference
    fading : tuple of FadingAxis
    pushed : tuple of PushedPoint
    """

    n_scenes: int
    ratio: float
    differences: tuple[StaticDifference, ...]
    fading: tuple[FadingAxis, ...]
    pushed: tuple[PushedPoint, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class BoundRatios:
    """How far random pairs of runs come to the bound of their difference.

    Attributes
    ----------
    kind : str
        Of `random_pairs.KINDS`.
    n_pairs : int
        Of which some do not move: they have no ratio.
    n_unanswered : int
        Pairs in which a run has no answer.
    ratios : array, shape (n,)
        Difference of the two in place over the sum of their bounds, rising.
    """

    kind: str
    n_pairs: int
    n_unanswered: int
    ratios: Floats

    @property
    def n_over(self) -> int:
        """Pairs that differ by more than their bounds."""
        return int((self.ratios > 1.0).sum())


@dataclass(frozen=True, slots=True, kw_only=True)
class PlaneWork:
    """One run of a method in two axes.

    Attributes
    ----------
    method, setting : str
    seconds : float
        Of a run [s]; NaN for a failed one.
    steps : int
        Steps, or for SciPy evaluations of the right-hand side.
    error_percent : float
        In place, largest at samples or of the PRD, of the PRD; NaN for a failed run.
    """

    method: str
    setting: str
    seconds: float
    steps: int
    error_percent: float


@dataclass(frozen=True, slots=True, kw_only=True)
class StopPoint:
    """One run of a block that is stopped by friction while something pushes it, and then rests.

    Attributes
    ----------
    method, setting : str
    steps : int
        As in `PlaneWork`.
    error_m : float
        In place at the end [m]; NaN for a failed run.
    end_speed_mps : float
        What is left of its speed, 0 in truth [m/s].
    """

    method: str
    setting: str
    steps: int
    error_m: float
    end_speed_mps: float


@dataclass(frozen=True, slots=True, kw_only=True)
class RungTime:
    """What a run of a rung takes, beside the others.

    Attributes
    ----------
    title : str
    seconds : float
        Median over the scenes, warm, with what chooses left out [s].
    ratio : float
        To one axis.
    """

    title: str
    seconds: float
    ratio: float


@dataclass(frozen=True, slots=True, kw_only=True)
class RungEvidence:
    """All that is found of the models.

    Attributes
    ----------
    study : RungStudy
    static : StaticEvidence
    bounds : tuple of BoundRatios
    work_scene : str
    work : tuple of PlaneWork
    stops : tuple of StopPoint
    times_motion : str
        Length and step of the motion of `times`.
    times : tuple of RungTime
    """

    study: RungStudy
    static: StaticEvidence
    bounds: tuple[BoundRatios, ...]
    work_scene: str
    work: tuple[PlaneWork, ...]
    stops: tuple[StopPoint, ...]
    times_motion: str
    times: tuple[RungTime, ...]
