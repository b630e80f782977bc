"""A study in memory, for a notebook: every slope, friction and intensity under every motion.

Two slopes, three coefficients and five intensities are 30 cases; under seven motions of one
component in two polarities they are 420 runs.

`report.study` handles workbooks, batches on disk and clusters. Read `study`, then `StudyRuns`.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from functools import partial
from itertools import product
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from solver.errors import InputError
from solver.kernels.compiler import THREADS
from solver.model import Floats, Motion, Status
from solver.records.record import Record
from solver.sliding.checked import motion
from solver.sliding.model_selection import Model
from solver.studies.campaign import Campaign, grid
from solver.studies.capacity import Curve, capacities
from solver.studies.curves import Statistics, first_allowed, statistics
from solver.studies.runs import LENGTHS, STATUSES, Runner, run_part
from solver.studies.sweep import axis

if TYPE_CHECKING:
    import pandas as pd

    from solver.studies.fragility import Fragility


@dataclass(frozen=True, slots=True, kw_only=True)
class StudyRuns:
    """The runs of a study; arrays of results have the shape (slopes, mus, intensities, runs).

    A run is a motion in one orientation: `runs` names them, each component along the slope in each
    polarity.

    Attributes
    ----------
    motions : tuple of Motion
    slopes_rad, mus, intensities : array, shape (p,), (q,), (r,)
    runs : tuple of (str, str)
        Motion and orientation, such as ``("RM1", "record +")``.
    lengths : array, shape (5, p, q, r, runs)
        PRD, excursions downslope, upslope and cross-slope, and displacement at the end [m], as in
        `SlideResult`; NaN for none.
    status : array of uint8
        Index into `tuple(Status)`.
    model : array of uint8
        The simplest adequate `Model`.
    """

    motions: tuple[Motion, ...]
    slopes_rad: Floats
    mus: Floats
    intensities: Floats
    runs: tuple[tuple[str, str], ...]
    lengths: Floats
    status: NDArray[np.uint8]
    model: NDArray[np.uint8]

    def __repr__(self) -> str:
        lost = int((self.status != STATUSES.index(Status.OK)).sum())
        return (
            f"StudyRuns: {self.status.size} runs, {lost} without a final value; slopes "
            f"{self.slopes_rad.size}, friction coefficients {self.mus.size}, intensities "
            f"{self.intensities.size}, motions {len(self.motions)}"
        )

    @property
    def prd_m(self) -> Floats:
        """PRD of each motion, the largest of its orientations [m], shape (p, q, r, motions).

        NaN where a run of the motion has no final value.
        """
        final = np.where(self.status == STATUSES.index(Status.OK), self.lengths[0], np.nan)
        # A run without a value is NaN, and so is the maximum over the orientations of its motion.
        ends = np.cumsum([len(motion.orientations) for motion in self.motions])
        return np.stack([run.max(axis=-1) for run in np.split(final, ends[:-1], axis=-1)], axis=-1)

    def statistics(self) -> Statistics:
        """Return mean, 84th percentile and largest PRD over the motions, shape (p, q, r)."""
        return statistics(self.prd_m)

    def minimum_friction(self, allowed_m: float) -> Floats:
        """Return the lowest friction for which the mean PRD is permitted, shape (p, r).

        Interpolated between the coefficients run; NaN if the largest is not sufficient. A rule set
        multiplies the mean: divide `allowed_m` by that factor.
        """
        mean = self.statistics().mean_m
        return np.array(
            [
                [first_allowed(self.mus, of_level, allowed_m) for of_level in of_slope.T]
                for of_slope in mean
            ]
        )

    def fragility(self, limit_m: float, *, slope_rad: float, mu: float, seed: int = 1) -> Fragility:
        """Return the lognormal fragility of a limit on the PRD of a motion.

        The capacity of each motion is found by dedicated runs up to the highest intensity; a run
        without a final value exceeds the limit. Requires SciPy, which `./roofslip study` installs.
        """
        from solver.studies.fragility import fragility  # with SciPy, which is optional

        # The intensity does not matter here: tracks are motions at an intensity of 1.
        tracks = iter(Runner(_campaign(self.motions, (slope_rad,), (mu,), (1.0,))).tracks[0])
        by_motion = [
            Curve(tracks=[next(tracks) for _ in motion.orientations], slope_rad=slope_rad, mu=mu)
            for motion in self.motions
        ]
        prd_m = np.array([curve.prd_m(self.intensities) for curve in by_motion])
        (searched,) = capacities(by_motion, [limit_m], self.intensities, is_censoring=False)
        counted = np.ones(prd_m.shape, dtype=bool)
        # Not >: NaN exceeds every limit.
        return fragility(self.intensities, ~(prd_m <= limit_m), counted, searched, seed=seed)

    def to_frame(self) -> pd.DataFrame:
        """Return the runs as a table with one row each.

        Index: `slope_rad`, `mu`, `intensity`, `motion`, `orientation`; columns: `slope_deg`,
        `prd_m`, `down_m`, `up_m`, `across_m`, `residual_m`, `status`, `model`.
        """
        import pandas as pd  # optional, and 0.8 s to load

        axes = (self.slopes_rad.tolist(), self.mus.tolist(), self.intensities.tolist(), self.runs)
        rows = [(*case, *run) for *case, run in product(*axes)]
        names = ("slope_rad", "mu", "intensity", "motion", "orientation")
        slopes_deg = np.degrees(self.slopes_rad)[:, None, None, None]
        columns = {"slope_deg": np.broadcast_to(slopes_deg, self.status.shape)}
        columns |= dict(zip(LENGTHS, self.lengths, strict=True)) | {
            "status": np.array([status.value for status in STATUSES])[self.status],
            "model": np.array([model.title for model in Model])[self.model],
        }
        return pd.DataFrame(
            {name: values.ravel() for name, values in columns.items()},
            index=pd.MultiIndex.from_tuples(rows, names=names),
        )


def study(
    motions: Sequence[Motion | Record],
    *,
    slopes_rad: ArrayLike,
    mus: ArrayLike,
    intensities: ArrayLike = (1.0,),
) -> StudyRuns:
    """Run every slope, friction and intensity under every motion.

    Each motion is run in all its orientations. Each run is bit-identical to `solver.solve` with a
    tolerance of 1e-4. The runs are distributed over all cores.

    Parameters
    ----------
    motions : sequence of Motion or Record
        With different names. A record is a motion of one component, in both polarities.
    slopes_rad : array_like, shape (p,)
        Increasing roof slopes [rad], |slope| < pi/2.
    mus : array_like, shape (q,)
        Increasing friction coefficients, > 0.
    intensities : array_like, shape (r,)
        Increasing factors on the motions, > 0.

    Returns
    -------
    StudyRuns

    Raises
    ------
    InputError
        With every argument that is not as above.

    Examples
    --------
    >>> from solver import motion
    >>> pulse = motion([0.0, 4.0, -4.0, 0.0, 0.0, 0.0], dt_s=0.1, id="pulse")
    >>> runs = study([pulse], slopes_rad=[0.0], mus=[0.2, 0.25, 0.3])
    >>> runs
    StudyRuns: 6 runs, 0 without a final value; slopes 1, friction
    coefficients 3, intensities 1, motions 1
    >>> runs.minimum_friction(0.002).round(3)
    array([[0.256]])
    """
    as_motions = [motion(item) if isinstance(item, Record) else item for item in motions]
    problems = [] if as_motions else ["motions is empty; use one or more"]
    if len({item.id for item in as_motions}) < len(as_motions):
        problems.append("two motions have one name; pass an id to solver.motion")
    axes = [
        axis("slopes_rad", slopes_rad, -math.pi / 2, math.pi / 2, problems),
        axis("mus", mus, 0.0, math.inf, problems),
        axis("intensities", intensities, 0.0, math.inf, problems),
    ]
    # `minimum_friction` and `fragility` rely on increasing friction and intensity.
    if any((np.diff(values) <= 0.0).any() for values in axes):
        problems.append("slopes_rad, mus, intensities: use each value once, in increasing order")
    if problems:
        raise InputError(problems)
    campaign = _campaign(as_motions, *axes)
    with ThreadPoolExecutor(THREADS) as pool:
        parts = list(pool.map(partial(run_part, Runner(campaign)), campaign.parts))
    shape = (*(values.size for values in axes), len(campaign.columns))
    names = ((as_motions[number].id, item.name) for number, item in campaign.columns)
    return StudyRuns(
        motions=tuple(as_motions),
        slopes_rad=axes[0],
        mus=axes[1],
        intensities=axes[2],
        runs=tuple(names),
        lengths=np.concatenate([p.lengths for p in parts], axis=1).reshape(len(LENGTHS), *shape),
        status=np.concatenate([p.status for p in parts]).reshape(shape),
        model=np.concatenate([p.model for p in parts]).reshape(shape),
    )


def _campaign(
    motions: Sequence[Motion],
    slopes: Iterable[float],
    mus: Iterable[float],
    intensities: Iterable[float],
) -> Campaign:
    return Campaign(motions=(tuple(motions),), cases=grid(1, slopes, mus, intensities))
