"""Results of a verification as frozen records: checks, accuracy against run time, maps, figures.

Computes only values read from the curves. See `solver.verification.run` for what fills them.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from solver.model import Floats, Status
from solver.studies.curves import minimum_friction
from solver.verification.model_evidence import ModelEvidence
from solver.verification.shake_table import ShakeTable

FLOOR_M = 1e-3
"""Errors in percent are relative to the exact displacement, or to 1 mm if that is larger [m]."""


def percent_of(off_m: Floats, exact_m: Floats | float) -> Floats:
    """Return an error in percent of |exact|, or of `FLOOR_M` where |exact| is less."""
    return np.asarray(100.0 * off_m / np.maximum(np.abs(exact_m), FLOOR_M))


def percent_off(computed_m: Floats | float, exact_m: Floats | float) -> Floats:
    """Return |computed - exact| as `percent_of` the exact value."""
    return percent_of(np.abs(np.asarray(computed_m) - np.asarray(exact_m)), exact_m)


@dataclass(frozen=True, slots=True, kw_only=True)
class CheckRow:
    """One expected value and the computed value.

    Attributes
    ----------
    id : str
        Of the group of checks to which it belongs, such as ``CF-1``; the manual prints it, and
        `solver.verification.features` refers to it.
    section, problem, source, quantity, unit : str
    expected, computed : float
    error : float
        Relative to `expected`, or to what `quantity` says; absolute where `expected` is 0.
    tolerance : float
    passed : bool
        Whether error <= tolerance; a NaN does not pass.
    """

    id: str
    section: str
    problem: str
    source: str
    quantity: str
    unit: str
    expected: float
    computed: float
    error: float
    tolerance: float
    passed: bool


@dataclass(frozen=True, slots=True, kw_only=True)
class WorkPoint:
    """One run of one method: its run time and its error relative to the exact method.

    Attributes
    ----------
    method : str
        Key of `solver.METHODS`.
    setting : float
        Value of the method's accuracy setting; NaN for a method without one.
    parameters : mapping
        All parameters of the run.
    record, scene : str
    seconds : float
        Least time of several repeats, warm, without input checks [s]; NaN for a failed run.
    prd_error_m, prd_error_percent, residual_error_m, residual_error_percent : float
        NaN for a failed run; see `percent_off`.
    status : Status
    """

    method: str
    setting: float
    parameters: Mapping[str, float]
    record: str
    scene: str
    seconds: float
    prd_error_m: float
    prd_error_percent: float
    residual_error_m: float
    residual_error_percent: float
    status: Status


@dataclass(frozen=True, slots=True, kw_only=True)
class StabilityMap:
    """Error over two quantities, the largest of several scenes in each cell.

    Attributes
    ----------
    title, note, x_label, y_label : str
    x, y : array, shape (p,), (q,)
    error_percent : array, shape (q, p)
        Of the PRD, see `percent_off`; NaN in a failed cell.
    failed : array of bool, shape (q, p)
        A run of the cell diverged or stalled.
    limit : array, shape (p,) or (0,)
        y of the theoretical limit in each column; empty for none.
    x_mark : float
        x of a limit independent of y; NaN for none.
    x_log, y_log : bool
    """

    title: str
    note: str
    x_label: str
    x: Floats
    y_label: str
    y: Floats
    error_percent: Floats
    failed: np.ndarray[tuple[int, ...], np.dtype[np.bool_]]
    limit: Floats
    x_mark: float
    x_log: bool
    y_log: bool


@dataclass(frozen=True, slots=True, kw_only=True)
class Convergence:
    """Fig. 5 of the paper: the paper's method with increasing sub-steps, in 60 scenarios.

    Attributes
    ----------
    record : str
    scenarios : int
    substeps : tuple of int
    largest_error_exact_percent, largest_error_p256_percent : array, shape (len(substeps),)
        Of the residual, largest over the scenarios, see `percent_off`; relative to the exact
        method, and to the last number of sub-steps as in the paper (0 there).
    largest_error_of_prd_percent : array, shape (len(substeps),)
        The same errors against the exact method, in percent of the PRD: where a block returns to
        within a millimeter of its start, an error in percent of the residual is not meaningful.
    worst_cases : tuple of str
        The scenario of each `largest_error_exact_percent`.
    longest_seconds : array, shape (len(substeps),)
        Longest time of one run [s].
    """

    record: str
    scenarios: int
    substeps: tuple[int, ...]
    largest_error_exact_percent: Floats
    largest_error_p256_percent: Floats
    largest_error_of_prd_percent: Floats
    worst_cases: tuple[str, ...]
    longest_seconds: Floats


@dataclass(frozen=True, slots=True, kw_only=True)
class LinkComparison:
    """Figs. 6 to 9 of the paper: the exact method against a link with a friction cap.

    Attributes
    ----------
    record : str
    slope_deg, ppa_g : float
    mus : array, shape (n,)
    prd_exact_m, prd_link_m, rrd_exact_m, rrd_link_m : array, shape (n,)
        Magnitudes of peak and residual relative displacement [m]; NaN where the link diverged.
    history_mu : float
        The friction coefficient with the largest difference in RRD.
    history_t_s, history_exact_m, history_link_m : array, shape (m,)
    worst_percent, mean_percent : float
        Difference in RRD relative to the link's, as in the paper, see `percent_off`.
    """

    record: str
    slope_deg: float
    ppa_g: float
    mus: Floats
    prd_exact_m: Floats
    prd_link_m: Floats
    rrd_exact_m: Floats
    rrd_link_m: Floats
    history_mu: float
    history_t_s: Floats
    history_exact_m: Floats
    history_link_m: Floats
    worst_percent: float
    mean_percent: float


@dataclass(frozen=True, slots=True, kw_only=True)
class DesignCurves:
    """Figs. 10 to 12 of the paper: PRD over slope, friction coefficient and PPA.

    Attributes
    ----------
    record : str
    runs : int
    seconds : float
        Total time of all runs [s].
    slopes_deg, mus, ppas_g : array, shape (p,), (q,), (r,)
        Ascending; slopes from 0.
    prd_m : array, shape (p, q, r)
        The larger of both signs of the slope [m].
    """

    record: str
    runs: int
    seconds: float
    slopes_deg: Floats
    mus: Floats
    ppas_g: Floats
    prd_m: Floats

    def prd(self, slope_deg: float, ppa_g: float) -> Floats:
        """Return the PRD [m] at every friction coefficient, interpolated between the runs."""
        by_slope = np.apply_along_axis(
            lambda column: np.interp(slope_deg, self.slopes_deg, column), 0, self.prd_m
        )
        return np.array([np.interp(ppa_g, self.ppas_g, row) for row in by_slope])

    def minimum_mu(self, slope_deg: float, ppa_g: float, wanted_m: float) -> float:
        """Return the least friction coefficient that limits the PRD; see `minimum_friction`."""
        return minimum_friction(self.mus, self.prd(slope_deg, ppa_g), wanted_m)


@dataclass(frozen=True, slots=True, kw_only=True)
class Conditioning:
    """Effect of a small change of friction on the exact PRD: no method can be more accurate.

    Attributes
    ----------
    title, note, record : str
    slope_deg, ppa_g : float
    relative_change : float
        Of mu, both increased and decreased.
    mu, prd_m : array, shape (n,)
    change_percent : array, shape (n,)
        The larger of the two changes of the PRD, see `percent_off`.
    """

    title: str
    note: str
    record: str
    slope_deg: float
    ppa_g: float
    relative_change: float
    mu: Floats
    prd_m: Floats
    change_percent: Floats


@dataclass(frozen=True, slots=True, kw_only=True)
class PeerPoint:
    """One run by another program, if installed.

    Attributes
    ----------
    peer, version, record, scene, note : str
    seconds : float
        [s]; NaN for a failed run.
    prd_error_percent : float
        See `percent_off`; NaN for a failed run.
    """

    peer: str
    version: str
    record: str
    scene: str
    seconds: float
    prd_error_percent: float
    note: str


@dataclass(frozen=True, slots=True, kw_only=True)
class RoofPrediction:
    """A roof motion computed from the ground motion, compared with the recorded one.

    Attributes
    ----------
    name : str
        Source of the building's properties.
    period_s, damping, alpha0 : float
        Of the first mode [s], of every mode, and the lateral stiffness ratio.
    n_modes : int
    left_out_share : float
        See `solver.building.roof.RoofMotion`.
    unexplained : float
        Sum of squares of (computed - recorded) roof acceleration over that of the recorded one.
    peak_mps2 : float
    sa_mps2 : array, shape (m,)
        Pseudo-spectral acceleration at `RoofComparison.periods_s`, 5 % damping [m/s2].
    band_ratios, band_scatters : array, shape (b,)
        Geometric mean of computed over recorded spectrum in each band, and the standard deviation
        of its natural logarithm there.
    a_mps2 : array, shape (n,)
        The roof motion, over the duration of the recorded one.
    prd_m : array, shape (k,)
        For the scenes of `RoofComparison` [m].
    """

    name: str
    period_s: float
    damping: float
    alpha0: float
    n_modes: int
    left_out_share: float
    unexplained: float
    peak_mps2: float
    sa_mps2: Floats
    band_ratios: Floats
    band_scatters: Floats
    a_mps2: Floats
    prd_m: Floats


@dataclass(frozen=True, slots=True, kw_only=True)
class RoofComparison:
    """One building whose ground and roof were recorded, with the computed roof motions.

    Attributes
    ----------
    title, description : str
        Name; type of building and location of the instruments.
    is_recorded : bool
        In an earthquake; otherwise the model building.
    dt_s : float
    roof_mps2 : array, shape (n,)
        Recorded [m/s2].
    ground_peak_mps2 : float
    periods_s : array, shape (m,)
    ground_sa_mps2, roof_sa_mps2 : array, shape (m,)
        Recorded, 5 % damping [m/s2].
    bands_s : tuple of pairs of float
        Limits of the period bands [s].
    slope_deg, scale : float
        Slope and scale factor of all scenes.
    mus, prd_m : array, shape (k,)
        Friction coefficient of each scene, and PRD under the recorded roof motion [m].
    predictions : tuple of RoofPrediction
    """

    title: str
    description: str
    is_recorded: bool
    dt_s: float
    roof_mps2: Floats
    ground_peak_mps2: float
    periods_s: Floats
    ground_sa_mps2: Floats
    roof_sa_mps2: Floats
    bands_s: tuple[tuple[float, float], ...]
    slope_deg: float
    scale: float
    mus: Floats
    prd_m: Floats
    predictions: tuple[RoofPrediction, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class Verification:
    """The complete result of `verify`.

    Attributes
    ----------
    checks : tuple of CheckRow
    work : tuple of WorkPoint
    maps : tuple of StabilityMap
    convergence : tuple of Convergence
        One for each record, the project's first.
    links : tuple of LinkComparison
        Slopes 0 and 4 degrees for each record, the project's first.
    curves : tuple of DesignCurves
        One for each record, the project's first.
    conditioning : tuple of Conditioning
    roofs : tuple of RoofComparison
        The model building first, then those whose records were given.
    models : tuple of ModelEvidence
        One.
    tables : tuple of ShakeTable
        One if tests of a shake table were given, otherwise empty.
    peers : tuple of PeerPoint
        Empty if none is installed.
    records : tuple of str
        Names of the records, the project's first.
    quick : bool
    seconds : float
        Total time [s].
    """

    checks: tuple[CheckRow, ...]
    work: tuple[WorkPoint, ...]
    maps: tuple[StabilityMap, ...]
    convergence: tuple[Convergence, ...]
    links: tuple[LinkComparison, ...]
    curves: tuple[DesignCurves, ...]
    conditioning: tuple[Conditioning, ...]
    roofs: tuple[RoofComparison, ...]
    models: tuple[ModelEvidence, ...]
    tables: tuple[ShakeTable, ...]
    peers: tuple[PeerPoint, ...]
    records: tuple[str, ...]
    quick: bool
    seconds: float

    @property
    def passed(self) -> bool:
        """Whether every check passed."""
        return all(row.passed for row in self.checks)
