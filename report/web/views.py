"""What the views of the page draw: one run in time, PRD over friction and slope, paths in plan.

Each function answers from a finished assessment and runs again only what a drawing needs. Values
are those of the package; a number that does not exist is None. Read `slide`.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from typing import TypeVar

import numpy as np

from report.assessment.project import THREADS, Assessment
from report.assessment.runs import MotionRun, OrientedRun
from report.assessment.uncertainty import ResponseSurface, surface
from report.figures.levels import LEAST_M, is_decade, levels
from report.pages.uncertainty import dots
from report.web.answers import finite
from report.web.run_forces import Slip, run_forces, slips_of, with_jumps
from report.web.thinning import Indices, beside, peaks_kept
from report.words.units import G_MPS2, Quantity, Unit, measured, number, pair
from solver.model import INCH_M, Event, Floats, InputError, Scene, SlideHistory, Status
from solver.records.measures import velocity_displacement
from solver.records.record import Record
from solver.sliding import least_model

Json = dict[str, object]
_T = TypeVar("_T")

MOST_ON_TRACK = 1500  # of one direction, beside the events
MOST_ON_PATH = 200  # of one direction; a path is drawn an inch or two wide

_VELOCITY = (Unit("in/s", INCH_M, 1), Unit("mm/s", 1e-3, 0))
_ONE_UNIT: Mapping[str, Unit] = {
    "acceleration": Unit("g", G_MPS2, 2),
    "normal": Unit("W", 1.0, 2),
    "friction": Unit("", 1.0, 2),
    "time": Unit("s", 1.0, 2),
    "slope": Unit("deg", 1.0, 2),
}


def slide(assessment: Assessment, array_id: str, motion_id: str, run: str | None = None) -> Json:
    """Return one run in time, as drawn.

    Parameters
    ----------
    run : str, optional
        Name of the orientation; the governing one if not given.

    Raises
    ------
    InputError
        For an array, motion or run that the project does not have.
    """
    item = _named("array", assessment.arrays, array_id, lambda one: one.array.id)
    motion = _named("motion", item.motions, motion_id, lambda one: one.motion.id)
    chosen = motion.governing
    if run is not None:
        chosen = _named("run", motion.runs, run, lambda one: one.orientation.name)
    us_first = _us_first(assessment)
    history = least_model.history(chosen.scene, chosen.solution)
    slips = slips_of(history)
    roof = _roof(chosen.scene)
    return {
        "array": array_id,
        "motion": motion_id,
        "run": chosen.orientation.name,
        "runs": [_run_choice(motion, one, us_first) for one in motion.runs],
        "dt_s": chosen.scene.dt_s,
        "seconds": motion.seconds,
        "plan": {
            "outline": item.array.shape.points,
            "downslope_deg": item.array.downslope_deg,
        },
        "track": _track(history, roof, chosen.scene.dt_s),
        "slips": [_slip(*slip, us_first) for slip in slips],
        "peak": _peak(history),
        **_series(chosen, history, roof, slips),
        "prd_m": finite(history.result.prd_m),
        "t_prd_s": finite(history.result.t_prd_s),
        "units": _units(us_first),
        "texts": {
            "title": f"Array {array_id}, motion {motion_id}, run {chosen.orientation.name}",
            **_slide_texts(chosen, history, roof, us_first),
        },
    }


def contour(assessment: Assessment, array_id: str) -> Json:
    """Return the mean PRD of an array over friction and slope: the grid of the package.

    Raises
    ------
    InputError
        For an array that the project does not have.
    """
    item = _named("array", assessment.arrays, array_id, lambda one: one.array.id)
    us_first = _us_first(assessment)
    with ThreadPoolExecutor(THREADS) as pool:
        found = surface(assessment, item, pool)
    row = int(np.argmin(np.abs(found.slopes_rad - item.array.slope_rad)))
    column = int(np.argmin(np.abs(found.mus - item.array.mu)))
    return {
        "array": array_id,
        "mus": found.mus.tolist(),
        "slopes_deg": np.degrees(found.slopes_rad).tolist(),
        "prd_m": [_numbers(means) for means in found.mean_m],
        "levels": list(_levels(found, us_first)),
        "here": {
            "mu": item.array.mu,
            "slope_deg": math.degrees(item.array.slope_rad),
            "prd_m": finite(float(found.mean_m[row, column])),
        },
        "arrays": [
            {
                "id": one.array.id,
                "mu": one.array.mu,
                "slope_deg": math.degrees(one.array.slope_rad),
            }
            for one in assessment.arrays
            if one.array.id not in found.others
        ],
        "least_m": LEAST_M,
        "units": _units(us_first),
        "texts": _contour_texts(found, float(found.mean_m[row, column]), us_first),
    }


def paths(assessment: Assessment, array_id: str) -> Json:
    """Return the path in plan of the governing run of each motion; downslope is down the page.

    Raises
    ------
    InputError
        For an array that the project does not have.
    """
    item = _named("array", assessment.arrays, array_id, lambda one: one.array.id)
    us_first = _us_first(assessment)
    return {
        "array": array_id,
        "paths": [_path(motion, us_first) for motion in item.motions],
        "units": _units(us_first),
        "texts": {
            "title": f"Paths of array {array_id} in plan, all at one scale",
            "caption": "Governing run of each motion, relative to the roof. A cross marks the "
            "start, a dot the peak relative displacement (PRD).",
        },
    }


def _named(kind: str, items: Sequence[_T], wanted: str, name: Callable[[_T], str]) -> _T:
    for item in items:
        if name(item) == wanted:
            return item
    known = ", ".join(name(item) for item in items)
    raise InputError(f"there is no {kind} '{wanted}'; choose one of {known}")


def _us_first(assessment: Assessment) -> bool:
    return assessment.project.project.units_first.is_us


def _run_choice(motion: MotionRun, run: OrientedRun, us_first: bool) -> Json:
    unit = Quantity.DISPLACEMENT.us if us_first else Quantity.DISPLACEMENT.si
    label, prd_m = f"{_orientation(motion, run)}, no PRD", run.result.prd_m
    if not math.isnan(prd_m):
        governs = ", governing" if run is motion.governing else ""
        prd = f"PRD {measured(prd_m, unit)} {unit.symbol}"
        label = f"{_orientation(motion, run)}, {prd}{governs}"
    return {"name": run.orientation.name, "label": label}


def _orientation(motion: MotionRun, run: OrientedRun) -> str:
    """Return the component and polarity of a run, the polarity alone where there is one."""
    return run.orientation.name if motion.motion.has_transverse else run.orientation.name[-1]


def _prd(prd_m: float, us_first: bool) -> str:
    return "no PRD" if math.isnan(prd_m) else f"PRD {pair(prd_m, Quantity.DISPLACEMENT, us_first)}"


def _roof(scene: Scene) -> tuple[Record, ...]:
    """Return the roof motion as run: downslope, cross-slope and vertical, as far as it has them."""
    components = scene.ax_mps2, scene.ay_mps2, scene.az_mps2
    return tuple(
        Record(name=name, dt_s=scene.dt_s, a_mps2=scene.scale * a_mps2)
        for name, a_mps2 in zip(("downslope", "cross-slope", "vertical"), components, strict=True)
        if a_mps2.size
    )


def _track(history: SlideHistory, roof: Sequence[Record], dt_s: float) -> Json:
    """Return where the roof and the block are, at common samples."""
    events = np.array([event.t_s for event in history.events])
    relative = [history.u_m, history.across_m] if history.across_m.size else [history.u_m]
    kept = [peaks_kept(values, MOST_ON_TRACK) for values in relative]
    at = np.unique(np.concatenate([*kept, beside(events, dt_s, len(history.t_s))]))
    horizontal = [velocity_displacement(record)[1] for record in roof if record.name != "vertical"]
    nothing = np.zeros(len(history.t_s))
    return {
        "i": at.tolist(),
        "roof_m": [_at(values, at) for values in (*horizontal, nothing)[:2]],
        "relative_m": [_at(values, at) for values in (*relative, nothing)[:2]],
    }


def _series(
    run: OrientedRun,
    history: SlideHistory,
    roof: Sequence[Record],
    slips: Sequence[Slip],
) -> dict[str, object]:
    """Return the histories with all of their samples, so that every reading is right."""
    relative = {"downslope": history.u_m}
    if history.across_m.size:
        relative["cross-slope"] = history.across_m
    normal, demand, used = run_forces(run, history, slips)
    i, with_used = with_jumps(run, used, history.events)
    return {
        "acceleration": [_history(record.name, record.a_mps2) for record in roof],
        "velocity": [_history(one.name, velocity_displacement(one)[0]) for one in roof],
        "relative": [_history(name, values) for name, values in relative.items()],
        "normal": [_history("normal force", normal)],
        "friction": [
            {"name": "used", "i": i.tolist(), "v": _numbers(with_used)},
            _history("demand", demand),
        ],
    }


def _slip(begin: Event, end: Event, us_first: bool) -> Json:
    net_m = math.hypot(end.u_m - begin.u_m, end.across_m - begin.across_m)
    moved = pair(net_m, Quantity.DISPLACEMENT, us_first)
    text = f"{number(begin.t_s, 3)} s to {number(end.t_s, 3)} s, net {moved}"
    return {"from_s": begin.t_s, "to_s": end.t_s, "text": text}


def _peak(history: SlideHistory) -> Json | None:
    """Return when and where the displacement is largest, between the samples beside it."""
    result = history.result
    if math.isnan(result.prd_m):
        return None
    down, across = (
        float(np.interp(result.t_prd_s, history.t_s, values)) if values.size else 0.0
        for values in (history.u_m, history.across_m)
    )
    return {"t_s": result.t_prd_s, "down_m": down, "across_m": across}


def _slide_texts(
    run: OrientedRun, history: SlideHistory, roof: Sequence[Record], us_first: bool
) -> Json:
    result = history.result
    travel = max(float(np.abs(velocity_displacement(record)[1]).max()) for record in roof)
    when = "" if math.isnan(result.prd_m) else f" at {number(result.t_prd_s, 2)} s"
    return {
        "prd": f"{_prd(result.prd_m, us_first)}{when}",
        "model": f"Model: {run.model}; {run.solution.reason}.",
        "status": "" if result.status is Status.OK else _capitalized(result.status.sentence),
        "roof": "Roof velocity and displacement are integrated from the acceleration as analyzed, "
        "without baseline correction; the roof moves "
        f"{pair(travel, Quantity.DISPLACEMENT, us_first)} at most.",
        "axes": "Down is downslope; cross is cross-slope, positive to the left when facing "
        "downslope.",
    }


def _capitalized(sentence: str) -> str:
    return f"{sentence[0].upper()}{sentence[1:]}."


def _levels(found: ResponseSurface, us_first: bool) -> Iterator[Json]:
    """Yield the contours that the package draws."""
    unit = Quantity.DISPLACEMENT.us if us_first else Quantity.DISPLACEMENT.si
    mean = np.maximum(found.mean_m, LEAST_M) / unit.si
    seen = mean[~np.isnan(mean)]
    if not (found.mean_m > 0.0).any():
        return
    for level in levels(seen.tolist()):
        text = f"{level:g} {unit.symbol}"
        yield {"prd_m": level * unit.si, "text": text, "is_major": is_decade(level)}


def _contour_texts(found: ResponseSurface, here_m: float, us_first: bool) -> Json:
    array, runs = found.array.array, len(found.array.motions)
    lost = int(np.isnan(found.mean_m).sum())
    notes = []
    if not lost and not (found.mean_m > 0.0).any():
        notes.append("Nothing slides on the whole grid: no contours are drawn.")
    if lost:
        notes.append(
            f"{lost} of {found.mean_m.size} points have no value: a run there gives no "
            "displacement."
        )
    if found.n_unfinished:
        notes.append(
            f"{found.n_unfinished} of {found.n_runs} runs on the grid are still sliding at the end "
            "of their record: their PRD is not final."
        )
    if found.others:
        notes.append(dots(found))
    return {
        "title": f"Mean PRD of {runs} motion{'s' if runs > 1 else ''} over friction and slope, "
        f"array {array.id}",
        "here": f"{array.id}: {_mean(here_m, us_first)}",
        "caption": "Each motion in its governing heading. Crosses are computed points; contours "
        "and values between them interpolate the logarithm.",
        "notes": notes,
        "x": "Friction coefficient μ at low velocity",
        "y": "Slope [deg]",
    }


def _mean(mean_m: float, us_first: bool) -> str:
    none = math.isnan(mean_m)
    return "no value" if none else f"mean PRD {pair(mean_m, Quantity.DISPLACEMENT, us_first)}"


def _path(motion: MotionRun, us_first: bool) -> Json:
    """Return a path, to the right and up the page, as in the package."""
    run, history = motion.governing, motion.history()
    path: Json = {
        "motion": motion.motion.id,
        "run": _orientation(motion, run),
        "prd": _prd(history.result.prd_m, us_first),
        "dt_s": run.scene.dt_s,
        "i": [],
        "x_m": [],
        "y_m": [],
        "peak": None,
    }
    if math.isnan(history.result.prd_m):
        return path
    # Cross-slope displacement is positive to the left when facing downslope, which is down here.
    x = history.across_m if history.across_m.size else np.zeros(len(history.u_m))
    y = -history.u_m
    top = int(np.argmax(np.hypot(x, y)))
    at = np.unique([*peaks_kept(x, MOST_ON_PATH), *peaks_kept(y, MOST_ON_PATH), top])
    return path | {
        "i": at.tolist(),
        "x_m": _at(x, at),
        "y_m": _at(y, at),
        "peak": {"x_m": float(x[top]), "y_m": float(y[top]), "t_s": float(history.t_s[top])},
    }


def _history(name: str, values: Floats) -> Json:
    return {"name": name, "v": _numbers(values)}


def _at(values: Floats, at: Indices) -> list[float | None]:
    return _numbers(values[at])


def _numbers(values: Floats) -> list[float | None]:
    return [finite(value) for value in values.tolist()]


def _units(us_first: bool) -> dict[str, list[Json]]:
    """Return the units of each quantity, the preferred one first."""
    both = {"displacement": Quantity.DISPLACEMENT.value, "velocity": _VELOCITY}
    pairs = {name: units[:: 1 if us_first else -1] for name, units in both.items()}
    alone = {name: (unit,) for name, unit in _ONE_UNIT.items()}
    return {
        name: [{"symbol": u.symbol, "si": u.si, "decimals": u.decimals} for u in units]
        for name, units in (pairs | alone).items()
    }
