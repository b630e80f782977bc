"""Results of the comparison of models: frozen records, and data frames where every row is a run.

Computes only ratios. See `solver.verification.model_study` for what fills them.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
import pandas as pd

from solver.model import Floats

LEAST_M = 5e-3
"""Least PRD of both models for which their ratio is reported [m]; smaller ones are not telling."""

VERTICAL, SECOND, WORST = "Vertical", "Second axis", "Second axis, worst heading"
STIFF, SOFT = "Row, links of 1 mm", "Row, links of 10 mm"
OVER_SLOW = "Velocity-dependent μ / low-velocity μ"
OVER_FAST = "Velocity-dependent μ / high-velocity μ"
HELD_ONE, HELD = "Static friction, one axis", "Static friction, two axes"
OVER_STATIC = "Static and kinetic μ / static μ"


@dataclass(frozen=True, slots=True, kw_only=True)
class ModelChange:
    """Effect of a fuller model on the PRD, over many runs."""

    name: str
    # shape (n,): PRD of the fuller model over that of the simpler, ascending, for the runs in which
    # both are `LEAST_M` or more
    ratios: Floats
    n_small: int  # number of the other runs
    maximum_m: float  # largest change of the PRD, of either sign, over all runs [m]

    def at(self, percent: float) -> float:
        """Return a percentile of the ratios; NaN where there are none."""
        return float(np.percentile(self.ratios, percent)) if self.ratios.size else float("nan")

    @property
    def median(self) -> float:
        """The median ratio."""
        return self.at(50.0)

    @property
    def share_above_one(self) -> float:
        """Share of the ratios that are above 1; NaN where there are none."""
        return float(np.mean(self.ratios > 1.0)) if self.ratios.size else float("nan")


@dataclass(frozen=True, slots=True, kw_only=True)
class ModelStudy:
    """The same scenes by every model."""

    motions: tuple[str, ...]
    n_recorded: int  # number of motions recorded in earthquakes
    # the scenes are all combinations of these
    slopes_deg: tuple[float, ...]
    mus: tuple[float, ...]
    ppas_g: tuple[float, ...]
    n_runs: int  # scenes times motions and headings
    n_uplift: int  # runs in which the normal force vanishes
    # `VERTICAL`, `SECOND`, `WORST`, `OVER_SLOW`, `OVER_FAST`, `HELD_ONE`, `HELD`, `OVER_STATIC`,
    # `STIFF` and `SOFT`
    changes: tuple[ModelChange, ...]
    row_ppa_g: float  # PPA of the rows, which are run in the first heading only
    largest_error: float  # largest error bound in two axes, relative to the PRD

    def named(self, name: str) -> ModelChange:
        """Return the change with that name."""
        return next(change for change in self.changes if change.name == name)


@dataclass(frozen=True, slots=True, kw_only=True)
class StaticEvidence:
    """Results for static friction above kinetic friction."""

    # scenes of `differences` and `fading`: those whose PRD in one axis is `LEAST_M` or more
    n_scenes: int
    ratio: float  # static over kinetic friction in `fading`
    # by static over kinetic friction, less 1: change of the PRD of each scene relative to kinetic
    # friction alone, with columns `one_axis` and `two_axes`
    differences: Mapping[float, pd.DataFrame]
    # by factor of the second component: change of the PRD of each scene relative to one axis with
    # the same friction, kinetic alone (`one_coefficient`) and static above it (`static_above`)
    fading: Mapping[float, pd.DataFrame]
    pushed: pd.DataFrame  # see `solver.verification.static_study.pushed`


@dataclass(frozen=True, slots=True, kw_only=True)
class BoundRatios:
    """Differences of random pairs of runs relative to their bounds."""

    kind: str  # kind of pair, see `random_pairs.KINDS`
    n_pairs: int  # includes pairs without slip, which have no ratio
    n_unanswered: int  # pairs in which a run has no result
    ratios: Floats  # shape (n,): difference in position over the sum of the two bounds, ascending

    @property
    def n_over(self) -> int:
        """Pairs that differ by more than their bounds."""
        return int((self.ratios > 1.0).sum())


@dataclass(frozen=True, slots=True, kw_only=True)
class ModelEvidence:
    """The complete comparison of models."""

    study: ModelStudy
    static: StaticEvidence
    bounds: tuple[BoundRatios, ...]
    # runs of one scene, and of a block that stops, see `solver.verification.plane_work`
    work: pd.DataFrame
    stops: pd.DataFrame
    times_motion: str  # name, length and time step of the motion used for `times`
    # of each model, one axis first: median over the scenes, warm, without the choice of model [s]
    times: Mapping[str, float]
