"""Results of a verification: frozen records, and data frames where every row is a run.

Ratios of two models of 0.9, 1.2 and 1.5 have a median of 1.2, and two thirds of them are above 1.

Computes only values read from the curves. `solver.verification.run` fills them, and those of the
comparison of models are filled by `solver.verification.model_study`.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
import pandas as pd

from solver.model import Floats
from solver.spaces import NO_BREAK
from solver.studies.curves import first_allowed
from solver.verification.reference import DIGITS

# Least PRD of both models for which their ratio is reported [m]; smaller ones are not telling.
LEAST_M = 5e-3

VERTICAL, SECOND, WORST = "Vertical", "Second axis", "Second axis, worst heading"
STIFF, SOFT = f"Row, links of 1{NO_BREAK}mm", f"Row, links of 10{NO_BREAK}mm"
OVER_SLOW = "Velocity-dependent μ / low-velocity μ"
OVER_FAST = "Velocity-dependent μ / high-velocity μ"
HELD_ONE, HELD = "Static friction, one axis", "Static friction, two axes"
OVER_STATIC = "Static and kinetic μ / static μ"


@dataclass(frozen=True, slots=True, kw_only=True)
class ModelChange:
    """Effect of a more complete model on the PRD, over many runs."""

    name: str
    # shape (n,): PRD of the fuller model over that of the simpler, ascending, for the runs in which
    # both are `LEAST_M` or more
    ratios: Floats
    n_small: int  # number of the other runs
    maximum_m: float  # largest change of the PRD, of either sign, over all runs [m]

    def at(self, percent: float) -> float:
        """Return a percentile of the ratios; NaN if there are none."""
        return float(np.percentile(self.ratios, percent)) if self.ratios.size else float("nan")

    @property
    def median(self) -> float:
        """The median ratio."""
        return self.at(50.0)

    @property
    def share_above_one(self) -> float:
        """Fraction of the ratios above 1; NaN if there are none."""
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
class ModelEvidence:
    """The complete comparison of models."""

    study: ModelStudy
    pushed: pd.DataFrame  # see `solver.verification.model_study.pushed`
    work: pd.DataFrame  # see `solver.verification.workprecision.work`


# Errors in percent are relative to the exact displacement, or to 1 mm if that is larger [m].
FLOOR_M = 1e-3
ROUNDING = 1e-12
"""Tolerance where the expected and computed values differ by rounding error only."""

SECTIONS = {
    "CF": "Closed forms",
    "PH": "Physical checks of the paper",
    "DA": f"Decimal arithmetic, {DIGITS} digits",
    "ME": "Methods",
    "RM": "Roof motion computed from ground motion",
    "TA": "Two axes and the choice of model",
    "DV": "Code rules, spectra, filters, uplift and tipping",
}
"""Sections of checks by the letters with which their ids begin."""


def percent_of(off_m: Floats, exact_m: Floats | float) -> Floats:
    """Return an error in percent of |exact|, or of `FLOOR_M` if |exact| is less."""
    return np.asarray(100.0 * off_m / np.maximum(np.abs(exact_m), FLOOR_M))


def percent_off(computed_m: Floats | float, exact_m: Floats | float) -> Floats:
    """Return |computed - exact| as `percent_of` the exact value."""
    return percent_of(np.abs(np.asarray(computed_m) - np.asarray(exact_m)), exact_m)


@dataclass(frozen=True, slots=True)
class Verified:
    """One expected value and the computed value."""

    # of the group of checks to which it belongs, such as ``CF-1``; the manual prints it, and
    # `solver.verification.features` refers to it
    id: str
    source: str
    quantity: str
    unit: str
    problem: str
    expected: float
    computed: float
    tolerance: float = ROUNDING
    of: float = 0.0  # what the error is relative to; 0: `expected`
    is_run: bool = True  # False where SciPy, which it needs, is not installed

    @property
    def section(self) -> str:
        """Section of the checks to which it belongs."""
        return SECTIONS[self.id.partition("-")[0]]

    @property
    def error(self) -> float:
        """Relative to `of` or `expected`; absolute if both are 0."""
        return abs(self.computed - self.expected) / (abs(self.of) or abs(self.expected) or 1.0)

    @property
    def passed(self) -> bool:
        """Whether the error is within the tolerance; a NaN does not pass."""
        return bool(self.error <= self.tolerance)


@dataclass(frozen=True, slots=True, kw_only=True)
class StabilityMap:
    """Error over two quantities, the largest of several scenes in each cell; y is logarithmic."""

    title: str
    note: str
    x_label: str
    x: Floats  # shape (p,)
    y_label: str
    y: Floats  # shape (q,)
    error_percent: Floats  # shape (q, p): of the PRD, see `percent_off`; NaN in a failed cell
    limit: Floats = field(default_factory=lambda: np.empty(0))  # shape (p,) or (0,): y of a limit
    x_mark: float = math.nan  # x of a limit independent of y; NaN for none
    x_log: bool = True

    @property
    def failed(self) -> np.ndarray[tuple[int, ...], np.dtype[np.bool_]]:
        """The cells in which a run diverged or stalled."""
        return np.isnan(self.error_percent)


@dataclass(frozen=True, slots=True, kw_only=True)
class LinkComparison:
    """Figs. 6 to 9 of the paper: the exact method against a link with a friction cap."""

    record: str
    slope_deg: float
    ppa_g: float
    # by friction coefficient: magnitudes of peak and residual relative displacement [m], columns
    # `PRD, exact`, `PRD, link`, `RRD, exact` and `RRD, link`; NaN where the link diverged
    runs_m: pd.DataFrame
    history_mu: float  # the friction coefficient with the largest difference in RRD
    history_m: pd.DataFrame  # by time [s]: displacement, with columns `exact` and `link`
    # difference in RRD relative to the link's, as in the paper, see `percent_off`
    worst_percent: float
    mean_percent: float


@dataclass(frozen=True, slots=True, kw_only=True)
class DesignCurves:
    """Figs. 10 to 12 of the paper: PRD over slope, friction coefficient and PPA."""

    record: str
    runs: int
    seconds: float  # total time of all runs [s]
    slopes_deg: Floats  # shape (p,): ascending from 0
    mus: Floats  # shape (q,): ascending
    ppas_g: Floats  # shape (r,): ascending
    prd_m: Floats  # shape (p, q, r): the larger of both signs of the slope [m]

    def prd(self, slope_deg: float, ppa_g: float) -> Floats:
        """Return the PRD [m] at every friction coefficient, interpolated between the runs."""
        by_slope = np.apply_along_axis(
            lambda column: np.interp(slope_deg, self.slopes_deg, column), 0, self.prd_m
        )
        return np.array([np.interp(ppa_g, self.ppas_g, row) for row in by_slope])

    def minimum_mu(self, slope_deg: float, ppa_g: float, wanted_m: float) -> float:
        """Return the lowest friction coefficient that limits the PRD; see `first_allowed`."""
        return first_allowed(self.mus, self.prd(slope_deg, ppa_g), wanted_m)


@dataclass(frozen=True, slots=True, kw_only=True)
class Conditioning:
    """Effect of a small change of friction on the exact PRD: no method can be more accurate."""

    title: str
    note: str
    record: str
    slope_deg: float
    ppa_g: float
    mu: Floats  # shape (n,)
    prd_m: Floats  # shape (n,)
    change_percent: Floats  # shape (n,): larger of the two changes of the PRD, see `percent_off`


@dataclass(frozen=True, slots=True, kw_only=True)
class RoofPrediction:
    """A roof motion computed from the ground motion, compared with the recorded one."""

    name: str  # source of the building's properties
    period_s: float  # of the first mode [s]
    damping: float  # of every mode
    alpha0: float  # lateral stiffness ratio
    n_modes: int
    left_out_share: float  # see `solver.building.roof.RoofMotion`
    # sum of squares of (computed - recorded) roof acceleration over that of the recorded one
    unexplained: float
    peak_mps2: float
    # shape (m,): pseudo-spectral acceleration at `RoofComparison.periods_s`, 5 % damping [m/s2]
    sa_mps2: Floats
    band_ratios: Floats  # shape (b,): geometric mean of computed over recorded spectrum
    band_scatters: Floats  # shape (b,): standard deviation of its natural logarithm
    a_mps2: Floats  # shape (n,): the roof motion, over the duration of the recorded one
    prd_m: Floats  # shape (k,): for the scenes of `RoofComparison` [m]


@dataclass(frozen=True, slots=True, kw_only=True)
class RoofComparison:
    """One building whose ground and roof were recorded, with the computed roof motions."""

    title: str
    description: str  # type of building and location of the instruments
    is_recorded: bool  # in an earthquake; otherwise the model building
    dt_s: float
    roof_mps2: Floats  # shape (n,): recorded [m/s2]
    periods_s: Floats  # shape (m,)
    # shape (m,): recorded, 5 % damping [m/s2]
    ground_sa_mps2: Floats
    roof_sa_mps2: Floats
    bands_s: tuple[tuple[float, float], ...]  # limits of the period bands [s]
    slope_deg: float  # of all scenes
    scale: float  # of all scenes
    mus: Floats  # shape (k,): friction coefficient of each scene
    prd_m: Floats  # shape (k,): under the recorded roof motion [m]
    predictions: tuple[RoofPrediction, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class Verification:
    """The complete result of `verify`."""

    checks: tuple[Verified, ...]
    left_out: tuple[Verified, ...]  # not run, as SciPy is not installed
    rivals: pd.DataFrame  # see `solver.verification.checks.rival_errors`
    work: pd.DataFrame  # see `solver.verification.workprecision.work_points`
    maps: tuple[StabilityMap, ...]
    # by record, the project's first: see `solver.verification.paper_studies.convergence`
    convergence: Mapping[str, pd.DataFrame]
    links: tuple[LinkComparison, ...]  # slopes 0 and 4 degrees for each record, the project's first
    curves: tuple[DesignCurves, ...]  # one for each record, the project's first
    conditioning: tuple[Conditioning, ...]
    # the model building first, then those whose records were given
    roofs: tuple[RoofComparison, ...]
    models: tuple[ModelEvidence, ...]  # one
    records: tuple[str, ...]  # names of the records, the project's first
    quick: bool
    seconds: float  # total time [s]

    @property
    def passed(self) -> bool:
        """Whether every check passed."""
        return all(row.passed for row in self.checks)
