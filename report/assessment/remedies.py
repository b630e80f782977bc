"""What would satisfy a clearance or an array marked NG: separation, peer review, friction.

Each is entered and assessed (`report.assessment.assess`); friction is searched with the runs of
`report.assessment.trials`. `report.pages.summary` prints the results. Read `remedies`.
"""

from __future__ import annotations

import math
from bisect import bisect_left
from collections.abc import Iterator, Mapping, Sequence
from concurrent.futures import Executor, ThreadPoolExecutor
from dataclasses import dataclass, replace
from enum import StrEnum
from functools import partial

from report.assessment.arrays import DesignBasis
from report.assessment.assess import changed, entered, refused
from report.assessment.causes import ProjectOutcome, outcome
from report.assessment.clearances import ClearanceCheck
from report.assessment.neighbors import compass
from report.assessment.plan_clearances import shapes_of
from report.assessment.project import THREADS, Assessment
from report.assessment.routes import Route
from report.assessment.trials import (
    HUNDREDTH,
    Trials,
    above,
    involved,
    is_final,
    resting,
    search,
    single_array_check,
    trials_of,
    with_mu,
)
from report.assessment.verdict import Verdict, nan_is_worst
from report.sheet.schema import ProjectInput
from report.sheet.schema.scene import SIDES, Array, Clearance
from report.sheet.schema.shapes import Point, Polygon, Rectangle, Shape, gap_m
from report.text.counts import ranged
from report.text.units import Quantity, no_less, pair, round_up
from solver.friction_tests import MOST_MU

_NOISE_M = 1e-8  # a length that is rounded up is no less than what it is rounded from
_MOST_HUNDREDTHS = round(100.0 * MOST_MU)
_NORTH_UP_DEG = 90.0  # counterclockwise from +x
_MOST_TRIES = 10  # of the length of a move: more only where it goes past the other shape


def moves(
    assessment: Assessment, number: int, gap: ClearanceCheck
) -> tuple[Assessment | None, str]:
    """Return the project with a clearance as required, and how; or none, and why not."""
    row, data = gap.clearance, assessment.project
    unit = Quantity.SIZE.us if data.us_first else Quantity.SIZE.si
    lack_m = round_up((gap.required_m - row.provided_m) / unit.si, unit.decimals) * unit.si
    more = pair(lack_m, Quantity.SIZE, data.us_first, no_less)
    shapes = shapes_of(assessment)
    if row.object not in shapes:  # not in plan: the clearance alone is entered
        rows = list(data.clearances)
        rows[number - 1] = row.model_copy(update={"provided_m": row.provided_m + lack_m + _NOISE_M})
        return entered(assessment, changed(data, clearances=tuple(rows))), f"{more} more"
    before = _failed(assessment)
    ways = sorted(_ways_to_move(data, shapes, row, lack_m), key=lambda way: way[0])
    # The shortest move with which nothing else becomes NG.
    for length_m, array, (dx, dy) in ways:
        by = (dx * length_m, dy * length_m)
        # Most are refused by a neighbor in plan: only the others are assessed.
        if not _has_room(assessment, array, shifted(shapes[array.id], by)):
            continue
        done = entered(assessment, _moved(data, shapes, array, by))
        if done is not None and done.clearances[number - 1].ok and _failed(done) <= before:
            toward = _toward(dx, dy, data.roof.north_deg)
            length = pair(length_m - _NOISE_M, Quantity.SIZE, data.us_first, no_less)
            return done, f"{array.id} moved {length} {toward}"
    return None, (
        f"{more} more is needed, and no move of one array along an axis of the plan gives it and "
        "leaves all else sufficient"
    )


def _toward(dx: float, dy: float, north_deg: float) -> str:
    """Return a direction along an axis of the plan in words, by the compass where north is up."""
    if north_deg == _NORTH_UP_DEG:
        return compass(math.degrees(math.atan2(dy, dx)), north_deg)
    axis, along = ("x", dx) if dx else ("y", dy)
    return f"toward {'−' if along < 0.0 else '+'}{axis} of the plan"


def _has_room(assessment: Assessment, array: Array, moved: Shape) -> bool:
    """Whether no pair of the plan comes nearer than is required, as far as that is known."""
    near = (pair for pair in assessment.pairs if pair.involves(array.id))
    others = ((pair, pair.far if pair.array == array.id else pair.near) for pair in near)
    return not any(
        gap_m(moved, other) < min(pair.required_m, pair.gap_m) - _NOISE_M for pair, other in others
    )


def _ways_to_move(
    data: ProjectInput, shapes: dict[str, Shape], row: Clearance, lack_m: float
) -> Iterator[tuple[float, Array, Point]]:
    """Yield the length of each move along an axis of the plan that gives what lacks [m]."""
    sides = ((row.array, row.object), (row.object, row.array))
    for own, other in sides:
        for array in (each for each in data.arrays if each.id == own):
            for way in ((1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0)):
                length_m = _length_m(shapes[own], shapes[other], way, lack_m)
                if not math.isnan(length_m):
                    yield length_m, array, way


def _length_m(near: Shape, far: Shape, way: Point, lack_m: float) -> float:
    """Return how far a shape is to move for so much more distance [m]; NaN if it comes nearer."""
    wanted_m, length_m = gap_m(near, far) + lack_m, lack_m
    for _ in range(_MOST_TRIES):
        still_m = wanted_m - gap_m(shifted(near, (way[0] * length_m, way[1] * length_m)), far)
        if still_m <= _NOISE_M:
            return length_m + _NOISE_M
        if still_m > lack_m + _NOISE_M:
            break
        length_m += still_m
    return math.nan


def shifted(shape: Shape, by: Point) -> Shape:
    """Return a shape moved in plan [m]."""
    dx, dy = by
    if isinstance(shape, Polygon):
        return Polygon(tuple((x + dx, y + dy) for x, y in shape.points))
    x0, x1, y0, y1 = shape.x_from_m, shape.x_to_m, shape.y_from_m, shape.y_to_m
    return Rectangle(x0 + dx, x1 + dx, y0 + dy, y1 + dy)


def _moved(data: ProjectInput, shapes: dict[str, Shape], array: Array, by: Point) -> ProjectInput:
    """Return an input with an array moved, and its clearances as the plan then shows them."""
    old, new = shapes[array.id], shifted(shapes[array.id], by)

    def provided(row: Clearance) -> Clearance:
        other = row.object if row.array == array.id else row.array
        if array.id not in (row.array, row.object) or other not in shapes:
            return row
        change_m = gap_m(new, shapes[other]) - gap_m(old, shapes[other])
        return row.model_copy(update={"provided_m": row.provided_m + change_m})

    sides = {name: getattr(new, name) for name in SIDES} if isinstance(new, Rectangle) else {}
    return changed(
        data,
        arrays=tuple(
            row.model_copy(update=sides) if row.id == array.id else row for row in data.arrays
        ),
        outlines=tuple(
            row.model_copy(update={"x_m": row.x_m + by[0], "y_m": row.y_m + by[1]})
            if row.name == array.id
            else row
            for row in data.outlines
        ),
        clearances=tuple(map(provided, data.clearances)),
    )


def _failed(assessment: Assessment) -> set[tuple[str, ...]]:
    """Return what is NG: clearances, pairs of the plan without one, requirements."""
    gaps = (*(gap for gap in assessment.clearances if not gap.ok), *assessment.missing_gaps)
    rows = (row for row in assessment.rows if not row.verdict.is_permitted)
    return {*(gap.between for gap in gaps), *((row.id, row.subject, row.title) for row in rows)}


# Clearances for which remedies are searched, those with the largest D/C: each takes runs.
MOST_GAPS = 12


class RemedyKind(StrEnum):
    """Quantity that would have to change."""

    FRICTION = "friction coefficient"
    SEPARATION = "provided separation"
    REVIEW = "design displacement by peer review"


@dataclass(frozen=True, slots=True, kw_only=True)
class Remedy:
    """One quantity that would satisfy a clearance, or give an array final values, by itself."""

    kind: RemedyKind
    clearance: int  # number of the clearance in the workbook, from 1; 0 for no single one
    array: str  # array whose friction or displacement it is; those of a peer review
    given: float  # value in the workbook; by peer review the largest design displacement [m]
    # least coefficient or separation [m] that would do, or that displacement without its floor; NaN
    # if none within the search would
    value: float
    resolution: float = 0.0  # step of the search; 0 for a value that follows from the runs
    # smallest and largest of the values at which all runs satisfied, without failure between
    verified: tuple[float, float]
    n_values: int  # number of values tried from one to the other
    basis: str  # what was varied and what with it; or why no value would do; a clause
    # of the project with it, and with the friction of the other array of the clearance where that
    # is short, too
    outcome: ProjectOutcome | None

    @property
    def exists(self) -> bool:
        """Whether a value would do."""
        return not math.isnan(self.value)


def remedies(assessment: Assessment) -> tuple[Remedy, ...]:
    """Return what would satisfy the clearances marked NG, and each array without final values."""
    with ThreadPoolExecutor(THREADS) as pool:
        return tuple(remedy for way in _ways(assessment, pool) for remedy in way)


def best_remedy(assessment: Assessment, *, may_run: bool = True) -> Sequence[Remedy]:
    """Return what is entered together as the best remedy of the governing clearance; or nothing."""
    # The first with which the project is not NG, or else the first that would do.
    first: Sequence[Remedy] = ()
    with ThreadPoolExecutor(THREADS) as pool:
        for way in _ways(assessment, pool, most=1, may_run=may_run):
            outcomes = [remedy.outcome for remedy in way if remedy.outcome]
            if way and len(outcomes) == len(way):
                first = first or way
                if outcomes[0].verdict.is_permitted:
                    return way
    return first


def _ways(
    assessment: Assessment, pool: Executor, *, most: int = MOST_GAPS, may_run: bool = True
) -> Iterator[Sequence[Remedy]]:
    """Yield the remedies that are entered together, those that need runs last."""
    if assessment.verdict.is_permitted:
        return
    numbered = enumerate(assessment.clearances, start=1)
    failed = [(number, gap) for number, gap in numbered if gap.verdict is Verdict.NG]
    short = sorted(failed, key=lambda each: -nan_is_worst(each[1].demand_capacity))[:most]
    yield from ([_separation(assessment, *each)] for each in short)
    yield list(_review(assessment))
    if not may_run:
        return
    trials = trials_of(assessment, pool)
    yield from (_frictions(assessment, *each, trials) for each in short)
    for array in assessment.arrays:
        if not is_final(array):
            yield _together(assessment, [_friction(trials[array.id], 0, None)])


def _frictions(
    assessment: Assessment, number: int, gap: ClearanceCheck, trials: Mapping[str, Trials]
) -> Sequence[Remedy]:
    """Return the friction of each array beside a clearance that is too small for it."""
    row, short = gap.clearance, []
    for array in involved(assessment, row):
        check = single_array_check(assessment, assessment.project, array, row)
        if not (is_final(array) and check.ok):
            short.append(_friction(trials[array.id], number, row))
    return _together(assessment, short)


def _together(assessment: Assessment, remedies: Sequence[Remedy]) -> Sequence[Remedy]:
    """Return coefficients with what comes of all of them, if each would do."""
    if not all(remedy.exists for remedy in remedies):
        return remedies
    done = entered(
        assessment,
        _with_mus(assessment.project, {remedy.array: remedy.value for remedy in remedies}),
    )
    return [replace(remedy, outcome=outcome(done) if done else None) for remedy in remedies]


def _with_mus(data: ProjectInput, mus: dict[str, float]) -> ProjectInput:
    arrays = (with_mu(row, mus[row.id]) if row.id in mus else row for row in data.arrays)
    return changed(data, arrays=tuple(arrays))


def _friction(trials: Trials, number: int, row: Clearance | None) -> Remedy:
    """Return the least friction coefficient with which an array satisfies."""
    array = trials.array.array
    end, most = above(array.mu), _most_mu(trials)
    reason = _in_vain(trials, row)
    held: tuple[int, ...] = ()
    if not reason and end <= most:
        held = search(lambda mu: trials.satisfies(row, mu=mu), most, end)
    law = (
        "one coefficient at every velocity"
        if array.friction.is_constant
        else "the friction law scaled as a whole, the coefficient given being that at low velocity"
    )
    by_tests = "" if most == _MOST_HUNDREDTHS else ", the most that its tests give,"
    least = held[-1] / 100 if held else math.nan
    return Remedy(
        kind=RemedyKind.FRICTION,
        clearance=number,
        array=array.id,
        given=array.mu,
        value=least,
        resolution=HUNDREDTH,
        verified=(least, most / 100 if held else math.nan),
        n_values=len(held),
        basis=law if held else reason or f"no coefficient up to {most / 100}{by_tests} is enough",
        outcome=None,
    )


def _most_mu(trials: Trials) -> int:
    """Return the largest coefficient that `check` accepts, in hundredths; tests may limit it."""
    data, array = trials.assessment.project, trials.array.array
    mus = range(above(array.mu), _MOST_HUNDREDTHS + 1)

    def is_refused(mu: int) -> bool:
        return bool(refused(data, _with_mus(data, {array.id: mu / 100})))

    # Where one is refused a larger one is, too: it is above the tests as well.
    return mus.start - 1 + bisect_left(mus, True, key=is_refused)


def _in_vain(trials: Trials, row: Clearance | None) -> str:
    """Return why no friction can satisfy, if so: found without a run."""
    assessment, array = trials.assessment, trials.array
    if array.lacks_motions:
        return "there are too few motions for the requested statistic"
    is_prescriptive = array.route is Route.PRESCRIPTIVE
    least_m = array.prescriptive.value_m if is_prescriptive else array.floor_m
    holds = partial(single_array_check, assessment, assessment.project)
    if row is None or holds(resting(array, least_m), row).ok:
        return ""
    if holds(resting(array), row).ok:
        least = "prescriptive displacement" if is_prescriptive else "floor"
        return f"the {least} alone requires more than is provided"
    return "the minimum separation of the rule set is more than is provided"


def _separation(assessment: Assessment, number: int, gap: ClearanceCheck) -> Remedy:
    """Return the required separation, where the plan has room for it or does not show both."""
    required, basis, result = gap.required_m, "there is no design displacement", None
    if not math.isnan(required):
        result, basis = moves(assessment, number, gap)
    value = required if result else math.nan
    return Remedy(
        kind=RemedyKind.SEPARATION,
        clearance=number,
        array=gap.governing_array,
        given=gap.clearance.provided_m,
        value=value,
        verified=(value, value),
        n_values=1 if result else 0,
        basis=basis,
        outcome=outcome(result) if result else None,
    )


def _review(assessment: Assessment) -> Iterator[Remedy]:
    """Yield peer review, where it removes a floor that governs."""
    data = assessment.project
    floored = [
        item
        for item in assessment.arrays
        if item.governs is DesignBasis.FLOOR and item.is_permitted
    ]
    if not floored:
        return
    review = {
        "peer_reviewed": True,
        "peer_date": data.project.date,
        "peer_covered": "",
        **dict.fromkeys(("peer_reviewer", "peer_license", "peer_letter"), "to be given"),
    }
    done = entered(assessment, changed(data, options=data.options.model_copy(update=review)))
    if done is None:
        return
    ids = [item.id for item in floored]
    value = max(item.design_m for item in done.arrays if item.id in ids)
    yield Remedy(
        kind=RemedyKind.REVIEW,
        clearance=0,
        array=ranged(ids),
        given=max(item.design_m for item in floored),
        value=value,
        verified=(value, value),
        n_values=1,
        basis="peer review of the analysis removes the floor",
        outcome=outcome(done),
    )
