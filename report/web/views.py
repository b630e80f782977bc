"""Data for the views of the page: one run in time, PRD over friction and slope, paths in plan.

Each function answers from a finished assessment and runs again only what a drawing needs. Values
are those of the package; a number that does not exist is None. Read `slide`.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict
from typing import Any, TypeVar

import numpy as np
from contourpy import contour_generator

from report.assessment.assessment import Assessment
from report.assessment.design.arrays import ArrayAssessment
from report.assessment.support.response_surface import ResponseSurface, surface
from report.drawing.sheet import unit_format
from report.runs import MotionRun, OrientedRun
from report.text.grouping import ids_by
from report.text.json_numbers import finite
from report.text.letter_case import capitalized
from report.text.names import ranged
from report.text.typed_letters import cut
from report.text.unit_format import UnitFormat
from report.text.units import Unit, no_less, number
from report.web.run_forces import Slip, run_forces, slips_of, with_jumps
from solver.errors import InputError
from solver.model import Floats, Scene, SlideHistory, Status
from solver.records.measures import velocity_displacement
from solver.records.record import Record
from solver.sliding import model_selection

Json = dict[str, Any]
_T = TypeVar("_T")

LEAST_M = 1e-4
"""Displacement below which no contour is drawn [m]."""

MOST_LEVELS = 9

_FINE = 6  # parts of a cell of the grid, in each direction, between which contours are straight

_NORMAL = (Unit("W", 1.0, 2),)
_RATIO = (Unit("", 1.0, 2),)


def slide(assessment: Assessment, array_id: str, motion_id: str, run: str | None = None) -> Json:
    """Return one run in time, as drawn: that of an orientation by name, else the governing one."""
    item, fmt = _array(assessment, array_id), unit_format(assessment)
    motion = _named("motion", item.motions, motion_id, lambda one: one.motion.id)
    chosen = motion.governing
    if run is not None:
        chosen = _named("run", motion.runs, run, lambda one: one.orientation.name)
    history = model_selection.history(chosen.scene, chosen.solution)
    slips = slips_of(history)
    roof_m = _roof_m(chosen.scene)
    return {
        "run": chosen.orientation.name,
        "runs": [_run_choice(motion, one, fmt) for one in motion.runs],
        "dt_s": chosen.scene.dt_s,
        "seconds": motion.seconds,
        "plan": {
            "outline": item.array.shape.points,
            "downslope_deg": item.array.downslope_deg,
        },
        "roof_m": [_numbers(along) for axis, along in roof_m.items() if axis != "z"],
        "slips": [_slip(k, slips, fmt) for k in range(len(slips))],
        **_panels(chosen, history, slips, fmt),
        "prd_m": finite(history.result.prd_m),
        "t_prd_s": finite(history.result.t_prd_s),
        "texts": {
            "title": f"Array {array_id}, motion {motion_id}, run {chosen.orientation.name}",
            **_slide_texts(chosen, history, roof_m, fmt),
        },
    }


def contour(assessment: Assessment, array_id: str) -> Json:
    """Return the mean PRD of an array over friction and slope."""
    item, fmt = _array(assessment, array_id), unit_format(assessment)
    contours = surface(assessment, item)
    row = int(np.argmin(np.abs(contours.slopes_rad - item.array.slope_rad)))
    column = int(np.argmin(np.abs(contours.mus - item.array.mu)))
    here_m, unit = float(contours.mean_m[row, column]), fmt.units()[0]
    lines_at = contour_lines(contours)
    return {
        "mus": contours.mus.tolist(),
        "slopes_deg": np.degrees(contours.slopes_rad).tolist(),
        "prd_m": list(map(_numbers, contours.mean_m)),
        "levels": [
            {
                "text": f"{level:g} {unit.symbol}",
                "is_major": math.isclose(math.log10(level), round(math.log10(level)), abs_tol=1e-9),
                "lines": lines_at(level * unit.si),
            }
            for level in _drawn_levels(contours, unit.si)
        ],
        "here": {
            "mu": item.array.mu,
            "slope_deg": math.degrees(item.array.slope_rad),
            "prd_m": finite(here_m),
        },
        "dots": [
            {
                "mu": mu,
                "slope_deg": slope,
                "name": cut(ranged(ids), 24),
                "is_shown": array_id in ids,
            }
            for (mu, slope), ids in _dots(contours, assessment.arrays).items()
        ],
        "least_m": LEAST_M,
        "units": _units(fmt.units()),
        "texts": _contour_texts(contours, here_m, fmt),
    }


def contour_lines(surface: ResponseSurface) -> Callable[[float], list[list[list[float]]]]:
    """Return what gives the contours of a PRD [m], each as its points (μ, slope [deg]).

    Between grid points the logarithm of PRD is linear; a cell with a lost corner has no contour.
    """
    slopes_deg = np.degrees(surface.slopes_rad)
    # The PRD spans decades, from nothing at high friction: LEAST_M stands for 0.
    logs = np.log10(np.maximum(surface.mean_m, LEAST_M))
    fine_mus, fine_slopes = _divided(surface.mus), _divided(slopes_deg)
    rows = np.array([np.interp(fine_mus, surface.mus, row) for row in logs])
    fine = np.array([np.interp(fine_slopes, slopes_deg, column) for column in rows.T]).T
    grid = contour_generator(fine_mus, fine_slopes, fine, corner_mask=False)
    return lambda prd_m: [np.asarray(line).tolist() for line in grid.lines(math.log10(prd_m))]


def _divided(axis: Floats) -> Floats:
    places = np.arange(_FINE * (axis.size - 1) + 1) / _FINE
    return np.interp(places, np.arange(axis.size), axis)


def _array(assessment: Assessment, id: str) -> ArrayAssessment:
    return _named("array", assessment.arrays, id, lambda run: run.id)


def _named(kind: str, items: Sequence[_T], asked: str, name: Callable[[_T], str]) -> _T:
    """Return the item of a name; where the project does not have it, say which it has."""
    for item in items:
        if name(item) == asked:
            return item
    known = ", ".join(name(item) for item in items)
    raise InputError(f"there is no {kind} '{asked}'; choose one of {known}")


def _run_choice(motion: MotionRun, run: OrientedRun, fmt: UnitFormat) -> Json:
    prd_m = run.result.prd_m
    governs = run is motion.governing and not math.isnan(prd_m)
    label = f"{_orientation(motion, run)}, {_prd(prd_m, fmt.short)}"
    return {"name": run.orientation.name, "label": label + (", governing" if governs else "")}


def _orientation(motion: MotionRun, run: OrientedRun) -> str:
    """Return the component and polarity of a run, the polarity alone where there is one."""
    return run.orientation.name if motion.motion.has_transverse else run.orientation.name[-1]


def _prd(prd_m: float, said: Callable[..., str]) -> str:
    return "no PRD" if math.isnan(prd_m) else f"PRD {said(prd_m, show=no_less)}"


def _roof_m(scene: Scene) -> Mapping[str, Floats]:
    """Return the displacement of the roof as run [m], along each axis that it moves in."""
    records = {
        axis: Record(name=axis, dt_s=scene.dt_s, a_mps2=scene.scaled(a))
        for axis, a in scene.components.items()
    }
    return {axis: velocity_displacement(record)[1] for axis, record in records.items()}


def _panels(
    run: OrientedRun, history: SlideHistory, slips: Sequence[Slip], fmt: UnitFormat
) -> Json:
    """Return the histories with all of their samples, so that every reading is right."""
    relative = [_history("down", history.u_m)]
    if history.across_m.size:
        relative.append(_history("cross", history.across_m))
    normal, demand, used = run_forces(run, history, slips)
    i, with_used = with_jumps(run, used, history.events)
    friction = [_history("used", with_used) | {"i": i.tolist()}, _history("demand", demand)]
    return {
        kind: {"title": title, "units": _units(units), "series": series}
        for kind, title, units, series in (
            ("relative", "Displacement", fmt.units(), relative),
            ("normal", "Normal force", _NORMAL, [_history("N / W", normal)]),
            ("friction", "Friction F / N", _RATIO, friction),
        )
    }


def _slip(k: int, slips: Sequence[Slip], fmt: UnitFormat) -> Json:
    begin, end = slips[k]
    net_m = math.hypot(end.u_m - begin.u_m, end.across_m - begin.across_m)
    when = f"{number(begin.t_s, 3)} s to {number(end.t_s, 3)} s"
    text = f"Slip {k + 1} of {len(slips)}: {when}, net {fmt.both(net_m)}"
    return {"from_s": begin.t_s, "to_s": end.t_s, "text": text}


def _slide_texts(
    run: OrientedRun, history: SlideHistory, roof_m: Mapping[str, Floats], fmt: UnitFormat
) -> Json:
    result = history.result
    travel = max(float(np.abs(along).max()) for along in roof_m.values())
    when = "" if math.isnan(result.prd_m) else f" at {number(result.t_prd_s, 2)} s"
    status = [f"{capitalized(result.status.sentence)}."] * (result.status is not Status.OK)
    return {
        "prd": f"{_prd(result.prd_m, fmt.both)}{when}",
        "no_slip": "".join(status) or "The array does not slip in this run.",
        "notes": [
            *status,
            "Down is downslope; cross is cross-slope, positive to the left when facing downslope.",
            f"Model: {run.model}; {run.solution.reason}.",
            "The roof displacement is integrated from the acceleration as analyzed, without "
            f"baseline correction; the roof moves {fmt.both(travel)} at most.",
        ],
    }


def _contour_texts(contours: ResponseSurface, here_m: float, fmt: UnitFormat) -> Json:
    array, runs = contours.array.array, len(contours.array.motions)
    lost = int(np.isnan(contours.mean_m).sum())
    notes = [
        "Each motion in its governing heading. Crosses are computed points; contours and values "
        "between them interpolate the logarithm."
    ]
    if not lost and not (contours.mean_m > 0.0).any():
        notes.append("Nothing slides on the whole grid: no contours are drawn.")
    if lost:
        notes.append(
            f"{lost} of {contours.mean_m.size} points have no value: a run there gives no "
            "displacement."
        )
    if contours.n_unfinished:
        notes.append(
            f"{contours.n_unfinished} of {contours.n_runs} runs on the grid are still sliding at "
            "the end of their record: their PRD is not final."
        )
    if contours.others:
        law = "constant" if array.friction.is_constant else "velocity-dependent"
        notes.append(
            f"Dots: the arrays with the friction of {array.id} ({law}), scaled as a whole; not "
            f"{ranged(contours.others)}."
        )
    return {
        "title": f"Mean PRD of {runs} motion{'s' if runs > 1 else ''} over friction and slope, "
        f"array {array.id}",
        "here": f"{array.id}: {'' if math.isnan(here_m) else 'mean PRD '}"
        f"{fmt.both(here_m, show=no_less)}",
        "notes": notes,
    }


def _history(name: str, values: Floats) -> Json:
    return {"name": name, "v": _numbers(values)}


def _numbers(values: Floats) -> list[float | None]:
    return [finite(value) for value in values.tolist()]


def _units(units: Sequence[Unit]) -> list[Json]:
    return [asdict(unit) for unit in units]


def levels(mean: Sequence[float]) -> list[float]:
    """Return round values within a range of positive ones, at most `MOST_LEVELS`."""
    low, high = min(mean), max(mean)
    # From the finest steps on: the first that are few enough.
    for steps in ((1, 1.5, 2, 3, 5, 7), (1, 2, 3, 5), (1, 2, 5), (1, 3), (1,)):
        decades = range(math.floor(math.log10(low)), math.ceil(math.log10(high)) + 1)
        values = [step * 10.0**exponent for exponent in decades for step in steps]
        inside = [value for value in values if 1.1 * low < value < high / 1.1]
        if len(inside) <= MOST_LEVELS:
            break
    return inside


def _drawn_levels(surface: ResponseSurface, unit_m: float) -> list[float]:
    """Return the levels that are drawn of a grid, in a unit; none where nothing slides."""
    if not (surface.mean_m > 0.0).any():
        return []
    mean = np.maximum(surface.mean_m, LEAST_M) / unit_m
    return levels(mean[~np.isnan(mean)].tolist())


def _dots(
    surface: ResponseSurface, arrays: Sequence[ArrayAssessment]
) -> Mapping[tuple[float, float], Sequence[str]]:
    """Return the arrays at each friction and slope [deg] of a grid: equal ones share a dot."""
    # To the digits that are printed: what reads alike shares a dot.
    drawn = (array for array in arrays if array.id not in surface.others)
    return ids_by(
        drawn, lambda item: (round(item.array.mu, 3), round(math.degrees(item.array.slope_rad), 2))
    )
