"""Many scenes at once: all combinations of slope, friction coefficient and scale of a record.

Three slopes, four friction coefficients and five scales are 60 runs of one record.

Plans the work and shapes the results; each run is `solver.kernels.one_axis.slide_exact`.
Read `solver.sliding.checked` for a single run.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace
from itertools import chain, product
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from solver.errors import raise_any
from solver.kernels import one_axis
from solver.kernels.compiler import THREADS
from solver.model import STANDARD_GRAVITY_MPS2, Floats, Motion, Scene, SlideResult, Status, coulomb
from solver.records.record import Record
from solver.sliding import two_axes
from solver.sliding.arguments import (
    Given,
    checked_number,
    checked_records,
    overflow,
    shortened,
    unit_size,
    unpacked,
)

if TYPE_CHECKING:
    import pandas as pd

_MANY = 200  # runs in one axis for which threads are started

# Meaning of the numbers in `Sweep.status`.
STATUSES = (
    Status.OK, Status.SLIDING_AT_END, Status.UPLIFT, Status.STEP_LIMIT, Status.DIVERGED
)  # fmt: skip


@dataclass(frozen=True, slots=True, kw_only=True)
class Sweep:
    """Every combination of a sweep. Arrays of results have the shape (slopes, mus, scales).

    Attributes
    ----------
    slopes_rad, mus, scales : array, shape (p,), (q,), (r,)
    prd_m, residual_m : array
        Peak relative displacement and displacement at the end, in two axes that downslope [m]; NaN
        if N falls below zero.
    status : array of uint8
        Index into `STATUSES`.
    """

    slopes_rad: Floats
    mus: Floats
    scales: Floats
    prd_m: Floats
    residual_m: Floats
    status: NDArray[np.uint8]

    def __repr__(self) -> str:
        p, q, r = self.prd_m.shape
        return f"Sweep({p} slopes, {q} friction coefficients, {r} scales)"

    def to_frame(self) -> pd.DataFrame:
        """Return the results as a table with one row per combination and the status in words.

        Index: `slope_rad`, `mu`, `scale`; columns: `slope_deg`, `prd_m`, `residual_m`, `status`.
        """
        import pandas as pd  # optional, and 0.8 s to load

        slopes_deg = np.degrees(self.slopes_rad)[:, None, None]
        axes = (self.slopes_rad, self.mus, self.scales)
        words = np.array([status.value for status in STATUSES])[self.status]
        columns = {"slope_deg": np.broadcast_to(slopes_deg, self.prd_m.shape)}
        columns |= {"prd_m": self.prd_m, "residual_m": self.residual_m, "status": words}
        return pd.DataFrame(
            {name: values.ravel() for name, values in columns.items()},
            index=pd.MultiIndex.from_product(axes, names=("slope_rad", "mu", "scale")),
        )


def sweep(
    ax_mps2: Given,
    dt_s: float | None = None,
    *,
    slopes_rad: ArrayLike,
    mus: ArrayLike,
    scales: ArrayLike,
    ay_mps2: ArrayLike | Record | None = None,
    az_mps2: ArrayLike | Record | None = None,
    g_mps2: float = STANDARD_GRAVITY_MPS2,
    units: str | None = None,
    progress: Callable[[float], None] | None = None,
) -> Sweep:
    """Run all combinations of slope, friction coefficient and scale of a record.

    By the exact method; with ay in two axes, to the tolerance of `solver.slide`, and slower. The
    runs are distributed over all cores; the result does not depend on the number of cores.

    Parameters
    ----------
    ax_mps2, dt_s, ay_mps2, az_mps2, g_mps2, units
        As in `solver.slide`.
    slopes_rad : array_like, shape (p,)
        Roof slopes [rad], |slope| < pi/2.
    mus : array_like, shape (q,)
        Friction coefficients, >= 0.
    scales : array_like, shape (r,)
        Factors on all components.
    progress : callable, optional
        Called once for each slope, with the fraction of the work that is done.

    Returns
    -------
    Sweep

    Raises
    ------
    InputError
        As in `solver.slide`, for every value out of range.

    Examples
    --------
    >>> pulse = [0.0, 4.0, -4.0, 0.0, 0.0, 0.0]
    >>> swept = sweep(pulse, 0.1, slopes_rad=[0.0, 0.05], mus=[0.2, 0.3], scales=[1.0])
    >>> swept.to_frame()["prd_m"].unstack("slope_rad").round(4)
    slope_rad    0.00    0.05
    mu  scale
    0.2 1.0    0.0049  0.0117
    0.3 1.0    0.0007  0.0030
    """
    problems: list[str] = []
    axes = _checked_axes(slopes_rad, mus, scales, problems)
    g = _above_zero("g_mps2", g_mps2, problems)
    components = _components(ax_mps2, ay_mps2, az_mps2, dt_s, units, problems)
    raise_any(problems)
    (swept,) = _swept([components], axes, g, progress or _no_progress)
    return swept


def sweep_all(
    records: Sequence[Record | Motion],
    *,
    slopes_rad: ArrayLike,
    mus: ArrayLike,
    scales: ArrayLike,
    g_mps2: float = STANDARD_GRAVITY_MPS2,
    progress: Callable[[float], None] | None = None,
) -> list[Sweep]:
    """Run all combinations for each of several records or motions.

    Parameters
    ----------
    records : sequence of Record or Motion
    slopes_rad, mus, scales, g_mps2
        As in `sweep`, for all of them.
    progress : callable, optional
        Called with the fraction of the work that is done.

    Returns
    -------
    list of Sweep
        In the order of the records; each as `sweep` would give it.

    Raises
    ------
    InputError
        As in `sweep`.

    Examples
    --------
    >>> from solver import read_record
    >>> records = [read_record(f"projects/example/records/RM{n}-x.csv") for n in (1, 2)]
    >>> swept = sweep_all(records, slopes_rad=[0.0], mus=[0.3, 0.4], scales=[1.0])
    >>> [bool(each.prd_m[0, 0, 0] > each.prd_m[0, 1, 0]) for each in swept]
    [True, True]
    """
    problems: list[str] = []
    axes = _checked_axes(slopes_rad, mus, scales, problems)
    g = _above_zero("g_mps2", g_mps2, problems)
    components = []
    for n, record in enumerate(records, start=1):
        if isinstance(record, Record | Motion):
            components.append(_components(record, None, None, None, None, problems))
        else:
            problems.append(f"record {n} is {shortened(record)}; use records or motions")
    raise_any(problems)
    return _swept(components, axes, g, progress or _no_progress)


class _Given(NamedTuple):
    """The components passed to a sweep [m/s2], their step, and the factor of a motion."""

    ax: Floats
    ay: Floats
    az: Floats
    dt_s: float
    factor: float


def _components(
    ax_mps2: Given,
    ay_mps2: ArrayLike | Record | None,
    az_mps2: ArrayLike | Record | None,
    dt_s: float | None,
    units: str | None,
    problems: list[str],
) -> _Given:
    components = {"ax_mps2": ax_mps2, "ay_mps2": ay_mps2, "az_mps2": az_mps2}
    records, step_s, factor = unpacked(components, dt_s, problems)
    size = unit_size(components, units, problems)
    ax, ay, az = checked_records(records, problems, size)
    return _Given(ax, ay, az, _above_zero("dt_s", step_s, problems), factor)


def _checked_axes(
    slopes_rad: ArrayLike, mus: ArrayLike, scales: ArrayLike, problems: list[str]
) -> list[Floats]:
    return [
        axis("slopes_rad", slopes_rad, -math.pi / 2, math.pi / 2, problems),
        # The limits are not within: zero is a coefficient.
        axis("mus", mus, -math.ulp(0.0), math.inf, problems),
        axis("scales", scales, -math.inf, math.inf, problems),
    ]


def _above_zero(name: str, value: float | None, problems: list[str]) -> float:
    return checked_number(name, value, "a number above 0", lambda v: 0.0 < v < math.inf, problems)


def _no_progress(share: float) -> None:
    pass


def _swept(
    records: Sequence[_Given], axes: list[Floats], g_mps2: float, progress: Callable[[float], None]
) -> list[Sweep]:
    """Run all combinations for each of the records."""
    _, mu, scale = (float(np.abs(axis).max()) for axis in axes)
    # The scenes of the largest values: if these do not overflow, none does.
    largest = [
        Scene(
            ax_mps2=record.ax,
            ay_mps2=record.ay,
            az_mps2=record.az,
            dt_s=record.dt_s,
            slope_rad=0.0,
            friction=coulomb(mu),
            scale=scale * abs(record.factor),
            g_mps2=g_mps2,
        )
        for record in records
    ]
    raise_any(chain.from_iterable(map(overflow, largest)))
    count = len(records) * math.prod(axis.size for axis in axes)
    in_plane = any(record.ay.size for record in records)
    # To start the threads takes as long as some 200 runs in one axis.
    threads = ThreadPoolExecutor(THREADS) if in_plane or count >= _MANY else None
    swept = []
    try:
        for n, (record, scene) in enumerate(zip(records, largest, strict=True)):
            follow = _run_in_plane if record.ay.size else _run
            share = _share(progress, n, len(records))
            swept.append(follow(scene, axes, record.factor, threads, share))
    finally:
        if threads:
            threads.shutdown(cancel_futures=True)
    return swept


def _share(progress: Callable[[float], None], n: int, count: int) -> Callable[[float], None]:
    """Return a progress callback for record n of several."""
    return lambda share: progress((n + share) / count)


def _run_in_plane(
    scene: Scene,
    axes: list[Floats],
    factor: float,
    threads: ThreadPoolExecutor | None,
    progress: Callable[[float], None],
) -> Sweep:
    slopes, mus, scales = axes

    def run(case: tuple[float, float, float]) -> SlideResult:
        slope, mu, scale = map(float, case)
        return two_axes.run(
            replace(scene, slope_rad=slope, friction=coulomb(mu), scale=factor * scale)
        )

    results: list[SlideResult] = []
    # `_swept` always starts threads for two axes.
    assert threads is not None
    for k, slope in enumerate(slopes):
        results += threads.map(run, product([slope], mus, scales))
        progress((k + 1) / slopes.size)
    shape = slopes.size, mus.size, scales.size
    return Sweep(
        slopes_rad=slopes,
        mus=mus,
        scales=scales,
        prd_m=np.array([case.prd_m for case in results]).reshape(shape),
        residual_m=np.array([case.residual_m for case in results]).reshape(shape),
        status=np.array([STATUSES.index(r.status) for r in results], np.uint8).reshape(shape),
    )


def axis(name: str, values: ArrayLike, above: float, below: float, problems: list[str]) -> Floats:
    """Return the values of an axis, between two limits, adding a problem for every invalid one."""
    try:
        # A single value is an axis of length 1; `asanyarray` keeps the mask of a masked array.
        samples = np.atleast_1d(np.asanyarray(values))
    except (TypeError, ValueError, OverflowError):
        samples = np.empty(0, dtype=object)
    if samples.dtype.kind not in "fiu" or np.ma.is_masked(samples):
        problems.append(f"{name} is not a row of real numbers; use values that `slide` accepts")
        return np.empty(0)
    array = np.asarray(samples, dtype=np.float64)
    if array.ndim != 1 or array.size == 0:
        problems.append(f"{name} has shape {array.shape}; use one row of values")
    # Negated, so that NaN is rejected as well.
    wrong = array[~((array > above) & (array < below))]
    if wrong.size:
        problems.append(f"{name} has {wrong[0]}; use values that `slide` accepts")
    return array


def _run(
    scene: Scene,
    axes: list[Floats],
    factor: float,
    threads: ThreadPoolExecutor | None,
    progress: Callable[[float], None],
) -> Sweep:
    slopes, mus, scales = axes
    ax, az = scene.ax_mps2, scene.az_mps2
    x = one_axis.bounds(ax)
    up, z = (az, one_axis.bounds(az)) if az.size else (None, None)
    grid = np.meshgrid(slopes, mus, factor * scales, indexing="ij")
    scenes = np.stack([values.ravel() for values in grid], axis=-1)
    outcomes = np.empty((len(scenes), 4))

    def run(chosen: NDArray[np.intp]) -> None:
        out = np.empty((chosen.size, 4))
        one_axis.sweep_exact(ax, up, x, z, scene.dt_s, scene.g_mps2, scenes[chosen], out)
        outcomes[chosen] = out

    # The number of slopes is used only to report progress; a part may contain scenes of any slope.
    for k, part in enumerate(np.array_split(order_alike(scenes), slopes.size)):
        if threads is None:
            run(part)
        else:
            # The kernel lets go of the lock of Python, so threads run side by side; dealt out, so
            # that they take about equal time.
            list(threads.map(run, (part[first::THREADS] for first in range(THREADS))))
        progress((k + 1) / slopes.size)
    s = outcomes.reshape(slopes.size, mus.size, scales.size, 4)
    # The same product as in a single run, so that both results agree to the last bit.
    cs = np.array([math.cos(slope) for slope in slopes])[:, None, None]
    # Indices of `STATUSES`: no number is uplift, and a speed at the end a slide that is not over.
    status = np.where(np.isnan(s[..., 0]), 2, np.where(s[..., 3] == 0.0, 0, 1))
    return Sweep(
        slopes_rad=slopes,
        mus=mus,
        scales=scales,
        # Not -s, which is -0.0 where nothing slips.
        prd_m=cs * np.maximum(s[..., 0], 0.0 - s[..., 1]),
        residual_m=cs * s[..., 2],
        status=status.astype(np.uint8),
    )


def order_alike(scenes: Floats) -> NDArray[np.intp]:
    """Order in which successive scenes begin to slip in one direction at similar accelerations.

    The processor predicts branches from previous runs, so this order is 10 to 20% faster. With
    phi = atan(mu), a block slips first downslope, at a horizontal acceleration of
    g tan(phi - |theta|). Scenes have a row of slope [rad], friction coefficient and scale each.
    """
    slope, mu, scale = scenes.T
    yields_at = np.arctan2(np.tan(np.arctan(mu) - np.abs(slope)), np.abs(scale))
    return np.lexsort((yields_at, np.sign(slope * scale)))
