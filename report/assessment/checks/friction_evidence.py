"""Friction tests on file and at the sliding velocities, and the effect of less friction."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from functools import partial
from typing import TYPE_CHECKING

from report.assessment.checks.check import VELOCITY_ROW, Actor, Check, Sense, condition, stated
from report.assessment.design.friction import SHIFT
from report.assessment.design.tested_friction import (
    LEAST_RUNS,
    MOST_BEYOND,
    STANDARD,
    is_complete,
    runs_by_velocity,
    tested,
    velocity_check,
)
from report.assessment.design.verdict import NOT_GIVEN
from report.project.model import ProjectInput
from report.project.model.input_rows import Place
from report.text.amounts import capacity, compared_pairs, demand, entered
from report.text.grouping import grouped_by
from report.text.units import Quantity, number
from solver.friction_tests import Series, Surface
from solver.rules.limit import Consequence

if TYPE_CHECKING:
    from report.assessment.assessment import Assessment
    from report.assessment.design.arrays import ArrayAssessment
    from report.assessment.design.tested_friction import VelocityCheck


_row = partial(condition, clause="friction tests", actor=Actor.LABORATORY)


def of_tests(data: ProjectInput) -> Iterator[Check]:
    """Yield the requirements on the friction tests."""
    # PV1-2012: by ASTM G115 in an accredited laboratory, wet and dry, and three runs as commonly
    # known.
    yield _on_file(data)
    yield _standard(data)
    yield _wet_and_dry(data)


def _on_file(data: ProjectInput) -> Check:
    tests = data.friction_tests
    on_file = stated(
        "friction_tests",
        laboratory=("laboratory", tests.laboratory),
        report=("report number", tests.report),
        date=("date", tests.date),
    )
    attached = "; attached" if tests.report_file else ""
    return _row(
        id="friction_tests",
        title="Friction test report",
        found=on_file.found + attached,
        is_satisfied=not on_file.missing,
        places=on_file.missing,
        limit="laboratory, report number and date",
        remedy="Obtain the friction test report, and enter it on the Friction tests worksheet.",
    )


def _standard(data: ProjectInput) -> Check:
    tests = data.friction_tests
    lacking = {
        "standard": not STANDARD.search(tests.standard),
        "accreditation": not tests.accreditation,
    }
    standard = f"standard {tests.standard or NOT_GIVEN}"
    accreditation = f"accreditation {tests.accreditation or NOT_GIVEN}"
    return _row(
        id="friction_tests",
        title="Friction test standard",
        found=f"{standard}; {accreditation}",
        limit="ASTM G115, accredited laboratory",
        is_satisfied=not any(lacking.values()),
        remedy="Obtain tests to ASTM G115 by an accredited laboratory, and enter both on the "
        "Friction tests worksheet.",
        places=tuple(
            Place("friction_tests", 0, field) for field, lacks in lacking.items() if lacks
        ),
    )


def _wet_and_dry(data: ProjectInput) -> Check:
    by_surface = {(series.report, series.surface): series for series in tested(data)}
    reports = dict.fromkeys(report for report, _ in by_surface)
    still = [index for index, row in enumerate(data.friction_runs) if row.velocity_mps is None]
    rows = [
        (f"report {report or 'without a number'}, " if len(reports) > 1 else "")
        + ", ".join(_runs({s: by_surface.get((report, s)) for s in Surface}, data.us_first))
        for report in reports
    ]
    return _row(
        id="friction_tests",
        title="Friction test repeats",
        found="; ".join(rows) or "no runs",
        limit=f"at least {LEAST_RUNS} dry and {LEAST_RUNS} wet runs at each velocity",
        is_satisfied=bool(reports) and all(is_complete(data, report) for report in reports),
        remedy="Obtain the missing runs, and enter them with their velocities on the Friction "
        "tests worksheet.",
        places=tuple(Place("friction_runs", index, "velocity_mps") for index in still)
        or (Place("friction_runs"),),
    )


def _runs(by_surface: Mapping[Surface, Series | None], us_first: bool) -> Iterator[str]:
    """Yield the runs in each condition, those that are alike together."""
    words = {
        s: runs_by_velocity(series, us_first) if series else "0 runs"
        for s, series in by_surface.items()
    }
    for text, alike in grouped_by(words, words.__getitem__).items():
        yield f"{' and '.join(alike)}: {text}"


def of_velocities(data: ProjectInput, arrays: Sequence[ArrayAssessment]) -> Iterator[Check]:
    """Yield for each array whether tests support the friction above the tested velocities."""
    for item in arrays:
        yield _velocity(item.id, velocity_check(data, item), data.us_first)


def _velocity(array_id: str, check: VelocityCheck, us_first: bool) -> Check:
    return _row(
        id=VELOCITY_ROW,
        title="Friction at the sliding velocity",
        subject=array_id,
        arrays=(array_id,),
        **_compared(check, us_first),
        is_satisfied=check.is_satisfied,
        # That a test is fast enough is no use of a capacity.
        is_capacity=False,
        # No coefficient is offered but the one that is run: with less friction it may be NG.
        remedy="Obtain friction tests at the sliding velocities.",
    )


def _compared(check: VelocityCheck, us_first: bool) -> Mapping[str, object]:
    """Return what is compared: the sliding velocity, or the friction above the tested range."""
    fastest_mps, tested_mps = check.fastest_mps, check.tested_mps
    speed, tested = (
        demand(fastest_mps, Quantity.VELOCITY),
        entered(tested_mps, Quantity.VELOCITY),
    )
    if not check.is_beyond:
        if math.isnan(tested_mps):
            return {"found": "does not slide", "limit": "tests at the sliding velocities"}
        return {"found": speed, "limit": tested, "sense": Sense.AT_MOST, "note": "as tested"}
    velocities = speed, tested, Quantity.VELOCITY
    slides, range_text = compared_pairs(*velocities, us_first, is_at_least=False)
    slides = (
        "no velocity from one run" if math.isnan(fastest_mps) else f"peak sliding velocity {slides}"
    )
    if check.tests is None:
        found_text = f"{slides}; no friction test runs entered"
        return {"found": found_text, "limit": "tests at the sliding velocities"}
    range_text = f"tested to {range_text}"
    if math.isnan(tested_mps):
        range_text = f"velocities tested {NOT_GIVEN}"
    mu, minimum = f"μ above the tested range {check.beyond_words}", check.minimum_words
    incomplete = "" if check.is_complete else "tests incomplete"
    notes = filter(None, (range_text, f"{mu}, smallest tested {minimum}", incomplete))
    if check.is_far and math.isfinite(fastest_mps) and tested_mps > 0.0:
        limit = capacity(MOST_BEYOND * tested_mps, Quantity.VELOCITY)
        note = f"{'; '.join(notes)}; at most {MOST_BEYOND:g} times as fast"
        return {"found": speed, "limit": limit, "sense": Sense.AT_MOST, "note": note}
    # What is required here are tests, no number.
    if check.is_far or incomplete:
        return {
            "found": "; ".join((slides, *notes)),
            "limit": f"complete tests, up to {MOST_BEYOND:g} times as fast",
        }
    return {
        "found": demand(check.mu_beyond, Quantity.COEFFICIENT),
        "limit": capacity(check.minimum_mu, Quantity.COEFFICIENT),
        "sense": Sense.AT_MOST,
        "note": f"μ above the tested range; {slides}, {range_text}",
    }


def of_less(done: Assessment) -> Iterator[Check]:
    """Yield the procedures and clearances satisfied as entered, but not with less friction."""
    reduced = done.at_reduced_friction
    if reduced is None:
        return
    friction = f"{number(100.0 * SHIFT, 0)}% less friction"
    row = partial(condition, is_satisfied=False, clause="sensitivity", is_capacity=False)
    changed = [*_routes(done, reduced, friction, row), *_clearances(done, reduced, friction, row)]
    yield from changed or [
        row(
            id="less_friction",
            title=f"Procedures and clearances with {friction}",
            found="permitted and satisfied as entered",
            limit="permitted and satisfied",
            is_satisfied=True,
        )
    ]


def _routes(
    done: Assessment, reduced_assessment: Assessment, friction: str, row: partial[Check]
) -> Iterator[Check]:
    for array, reduced in zip(done.arrays, reduced_assessment.arrays, strict=True):
        if array.is_permitted and not reduced.is_permitted:
            # No code asks for this margin, and no cell could show it: only a larger coefficient.
            yield row(
                id="less_friction",
                consequence=Consequence.NOTE,
                title=f"The {array.route} procedure with {friction}",
                subject=array.id,
                found=f"not permitted with μ = {number(reduced.array.minimum_mu, 3)}",
                limit="permitted",
                remedy=f"The procedure is permitted as entered but not with {friction}.",
            )


def _clearances(
    done: Assessment, reduced_assessment: Assessment, friction: str, row: partial[Check]
) -> Iterator[Check]:
    for gap, short in zip(done.clearances, reduced_assessment.clearances, strict=True):
        if gap.verdict.is_permitted and not short.verdict.is_permitted:
            clearance = gap.clearance
            yield row(
                id="clearance_less_friction",
                title=f"Clearance with {friction}",
                subject=f"{clearance.array} to {clearance.object}",
                arrays=(clearance.array,),
                found="not satisfied",
                limit="satisfied",
                remedy="Confirm the friction coefficient, or provide more clearance.",
            )
