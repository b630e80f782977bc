"""Accuracy of the governing run by every method, and sensitivity to friction.

Runs the solver and collects numbers; `report.pages.accuracy` prints them and
`report.figures.accuracy` plots them.
"""

from __future__ import annotations

import math
import time
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from report.assessment.arrays import ArrayAssessment
from report.assessment.assess import reassess
from report.assessment.clearances import ClearanceCheck
from report.assessment.friction import SHIFT, with_friction
from report.assessment.project import Assessment
from report.assessment.runs import MotionRun
from solver.model import STANDARD_GRAVITY_MPS2, Floats, SlideResult, Status
from solver.rivals.methods import METHODS, Method
from solver.rules.limit import Limit
from solver.sliding.checked import slide

MOST_STEPS = 64
"""Maximum steps per sampling interval; finer settings are in the verification manual only."""


@dataclass(frozen=True, slots=True, kw_only=True)
class MethodRun:
    """One method with one setting on the governing run."""

    name: str  # name of the method
    parameters: dict[str, float]
    steps: float  # steps in each sampling interval
    is_default: bool  # whether the parameters are the defaults of the method
    result: SlideResult
    error: float  # |PRD / exact PRD - 1|; NaN where the method failed

    @property
    def method(self) -> Method:
        """The method."""
        return METHODS[self.name]

    @property
    def failed(self) -> bool:
        """Whether the run gave no displacement."""
        return math.isnan(self.error)


@dataclass(frozen=True, slots=True, kw_only=True)
class Rivals:
    """The governing run along the slope alone, by every method."""

    array: ArrayAssessment  # the one with the largest design displacement
    motion: MotionRun  # its motion with the largest PRD
    exact: SlideResult  # exact result of its governing run along the slope alone
    # |PRD / PRD - 1| of the exact method with a sample added midway between adjacent samples: the
    # motion is the same, so the change is rounding error. NaN without a displacement
    doubled: float
    seconds: float  # time of the exact run, the smallest of several [s]
    runs: tuple[MethodRun, ...]  # empty where nothing slides or the block lifts off


@dataclass(frozen=True, slots=True, kw_only=True)
class Accuracy:
    """The governing run by every method, and the design with 5 % less and 5 % more friction."""

    rivals: Rivals
    # with the friction coefficients decreased, as given, and increased
    at_reduced_friction: Assessment
    given: Assessment
    at_increased_friction: Assessment

    @property
    def newly_short(self) -> tuple[ClearanceCheck, ...]:
        """Clearances that are satisfied as given but not with less friction."""
        pairs = zip(self.given.clearances, self.at_reduced_friction.clearances, strict=True)
        return tuple(after for before, after in pairs if before.ok and not after.ok)

    @property
    def newly_limited(self) -> tuple[tuple[ArrayAssessment, Limit], ...]:
        """Limits of the routes taken that are satisfied as given but not with less friction."""
        pairs = zip(self.given.arrays, self.at_reduced_friction.arrays, strict=True)
        return tuple(
            (after, check)
            for before, after in pairs
            if all(check.ok for check in before.limits)
            # With less friction another route may be taken, whose limits are other ones.
            for check in replace(after, route=before.route).limits
            if not check.ok
        )


def rivals(array: ArrayAssessment) -> Rivals:
    """Run the governing motion of an array by every method."""
    motion = array.worst
    scene = _scene(motion)
    exact = slide(**scene, units="m/s2")
    peak = exact.prd_m
    return Rivals(
        array=array,
        motion=motion,
        exact=exact,
        doubled=abs(slide(**_doubled(scene), units="m/s2").prd_m / peak - 1.0)
        if peak > 0.0
        else math.nan,
        seconds=_seconds(scene),
        runs=tuple(_runs(scene, peak)) if peak > 0.0 else (),
    )


def accuracy(given: Assessment) -> Accuracy:
    """Run the governing motion by every method, and all arrays with changed friction."""
    return Accuracy(
        rivals=rivals(given.governing),
        at_reduced_friction=given.at_reduced_friction
        or reassess(given, with_friction(given.project, 1.0 - SHIFT)),
        given=given,
        at_increased_friction=reassess(given, with_friction(given.project, 1.0 + SHIFT)),
    )


def _seconds(scene: dict[str, Any]) -> float:
    times = []
    for _ in range(7):
        started = time.perf_counter()
        slide(**scene, units="m/s2")
        times.append(time.perf_counter() - started)
    return min(times)  # disturbances only lengthen a run


def _scene(run: MotionRun) -> dict[str, Any]:
    """Return the governing run, along the slope alone, as arguments of `slide`."""
    governing = run.governing.scene
    return {
        "ax_mps2": governing.ax_mps2,
        "az_mps2": governing.az_mps2 if run.motion.has_vertical else None,
        "dt_s": governing.dt_s,
        "scale": governing.scale,
        "slope_rad": governing.slope_rad,
        "mu": governing.friction.mu_slow,
    }


def _doubled(scene: dict[str, Any]) -> dict[str, Any]:
    vertical = scene["az_mps2"]
    return scene | {
        "dt_s": scene["dt_s"] / 2.0,
        "ax_mps2": _midway(scene["ax_mps2"]),
        "az_mps2": None if vertical is None else _midway(vertical),
    }


def _midway(samples: Floats) -> Floats:
    doubled = np.empty(2 * samples.size - 1)
    doubled[::2] = samples
    doubled[1::2] = (samples[:-1] + samples[1:]) / 2.0
    return doubled


def _runs(scene: dict[str, Any], peak_m: float) -> Iterator[MethodRun]:
    # Regularized friction is too slow. `adaptive` gives the numbers of `paper`, and stands for both
    # with vertical shaking, which `paper` does not accept.
    with_vertical = scene["az_mps2"] is not None
    omitted = {"exact", "regularized", "paper" if with_vertical else "adaptive"}
    shown = [method for method in METHODS.values() if method.name not in omitted]
    for method in shown:
        default = dict(method.parameters)
        settings = [method.settings(v, scene["dt_s"], STANDARD_GRAVITY_MPS2) for v in method.sweep]
        for parameters in [default, *(s for s in settings if s != default)]:
            if parameters.get("substeps", 1.0) > MOST_STEPS:
                continue
            result = slide(**scene, method=method.name, units="m/s2", **parameters)
            has_value = result.status is not Status.DIVERGED
            yield MethodRun(
                name=method.name,
                parameters=parameters,
                steps=parameters.get("substeps", 1.0),
                is_default=parameters == default,
                result=result,
                error=abs(result.prd_m / peak_m - 1.0) if has_value else math.nan,
            )
