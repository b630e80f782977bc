"""Which model answered for each array, why it is enough, and what was left out.

Chooses nothing: `solver.sliding.least_model` did. Read `report.pages.parts` first.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from itertools import groupby

from report.assessment.arrays import ArrayAssessment
from report.assessment.runs import RUNGS, HeadingRun
from report.pages import links
from report.pages.accuracy import below_mm
from report.pages.parts import (
    NO_VALUE,
    PackageData,
    Table,
    TableColumn,
    TableRow,
    Wide,
    nan_is_worst,
    verdict,
)
from report.sheet.schema import Array, Direction
from report.words.units import number, ratio
from solver.sliding.least_model import DEFAULT, Rung, Solution

_LEFT_OUT = {
    Rung.ONE_AXIS_VERTICAL: "Vertical shaking",
    Rung.TWO_AXES: "Shaking across the slope",
    Rung.SPEED_FRICTION: "Friction by speed",
}


def page(package: PackageData) -> Mapping[str, object]:
    """Return the page on the models."""
    arrays = package.assessment.arrays
    matters = (
        f"{number(1e3 * DEFAULT.matters_m, 0)} mm ({number(DEFAULT.matters_m / 0.0254, 2)} in) or "
        f"{number(100.0 * DEFAULT.matters_share, 1)} %"
    )
    return {
        "rungs": tuple(f"{int(rung)}: {rung.title}" for rung in Rung if rung is not Rung.ROW),
        "matters": matters,
        "combinations": _combinations(package),
        "table": _table(package),
        "left_out": _left_out_table(package),
        "stability": _stability_table(package),
        "sentences": [text for found in arrays for text in _sentences(package, found)],
        "troubles": tuple(model_troubles(package)),
        "links": links.part(package, matters),
    }


def model_troubles(package: PackageData) -> Iterator[str]:
    """Yield in words which models that were asked for give too little."""
    for found in package.assessment.arrays:
        if found.is_model_enough:
            continue
        worst = max(Direction, key=lambda d: found.chosen_towards_m(d) - found.design_towards_m(d))
        yield (
            f"Array {found.array.id}: the model asked for, {found.array.model.value}, gives "
            f"{package.fmt.both(found.design_towards_m(worst))} ({worst.value}), the one that its "
            f"motions need {package.fmt.both(found.chosen_towards_m(worst))}."
        )


def tipping_troubles(package: PackageData) -> Iterator[str]:
    """Yield in words which arrays begin to turn about an edge of their supports."""
    for found in package.assessment.arrays:
        if not found.tipping.is_ok:
            yield (
                f"Array {found.array.id}: begins to tip, {found.tipping.governs}: ratio "
                f"{ratio(found.tipping.ratio)} of demand to b/(2h)."
            )


def _stability_table(package: PackageData) -> Table:
    """Return what keeps each array flat on the roof: no uplift, no tipping."""
    return Table(
        caption="Beside every model: uplift and tipping",
        columns=(
            TableColumn(head="Array", align="left", share=0.8),
            TableColumn(head="Least N", unit="m g", share=1.0),
            TableColumn(head="Time lifted", unit="s", share=1.1),
            TableColumn(head="Demand", unit="V/N", share=1.0),
            TableColumn(head="Capacity", unit="b/(2h)", share=1.1),
            TableColumn(head="Ratio, held", share=1.1),
            TableColumn(head="Ratio, sliding", share=1.2),
            TableColumn(head="Verdict", align="center", share=1.0),
        ),
        rows=tuple(TableRow(cells=_stability(found)) for found in package.assessment.arrays),
        notes=(
            "The worst run of each. Tipping: an array begins to turn about an edge of its supports "
            "where the shear that reaches it, never more than friction gives, is above b/(2h) of "
            "the normal force; b least support spacing, h height of the centre of gravity, midway "
            "between the supports (Housner, 1963; Ishiyama, 1982).",
        ),
        kind="compact",
    )


def _stability(found: ArrayAssessment) -> tuple[str, ...]:
    tips, lifts = found.tipping, found.uplift
    return (
        found.array.id,
        number(lifts.n_min_g, 2),
        number(lifts.duration_s, 3) if lifts.lifts else "none",
        number(tips.demand, 2) if math.isfinite(tips.demand) else "no limit",
        number(tips.capacity, 2),
        ratio(tips.held_ratio),
        ratio(tips.sliding_ratio),
        verdict(tips.is_ok and not lifts.lifts),
    )


def _runs(found: ArrayAssessment) -> Sequence[HeadingRun]:
    return [run for motion in found.motions for run in motion.runs]


def _by_rung(found: ArrayAssessment) -> Iterator[tuple[Rung, Sequence[HeadingRun]]]:
    ordered = sorted(_runs(found), key=lambda run: run.solution.rung)
    for rung, group in groupby(ordered, key=lambda run: run.solution.rung):
        yield rung, list(group)


def _combinations(package: PackageData) -> str:
    motions = [run.motion for run in package.governing.motions]
    two = sum(motion.has_transverse for motion in motions)
    if not two:
        return (
            "No motion has a second horizontal component: each record is run along the slope, in "
            "the senses that the workbook asks for. Shaking across the slope uses up friction too: "
            "with both components most displacements are larger (verification manual, section 12)."
        )
    both = all(len(motion.signs) == 2 for motion in motions)
    of = "Each motion has" if two == len(motions) else f"{two} of {len(motions)} motions have"
    senses = "" if both else " where the workbook asks for both senses"
    return (
        f"{of} eight combinations{senses}: either horizontal component along the slope, in either "
        "sense, with the other one across it in either sense. Reversing the one across mirrors "
        "the motion and changes no displacement down, up or across the slope, so four are run "
        "and the worst counts."
    )


def _table(package: PackageData) -> Table:
    return Table(
        caption="Model used, by array",
        columns=(
            TableColumn(head="Array", align="left", share=0.8),
            TableColumn(head="Model", align="left", share=2.1),
            TableColumn(head="Runs", share=1.0),
            TableColumn(head="μ", share=0.9),
            TableColumn(head="Demand", share=0.9),
            TableColumn(head="Why this one", align="left", share=4.2),
            TableColumn(head="Error of PRD", align="left", share=1.6),
        ),
        rows=tuple(
            TableRow(cells=cells)
            for found in package.assessment.arrays
            for cells in _model_rows(found)
        ),
        notes=(
            "Demand: the largest shear over normal force of an array that is held; it slips where "
            "this is above μ, at rest. Why: in the run with the largest PRD. Error: against the "
            "exact motion of the record joined by straight lines.",
        ),
        kind="compact",
    )


def _model_rows(found: ArrayAssessment) -> Iterator[tuple[str, ...]]:
    total = len(_runs(found))
    for rung, runs in _by_rung(found):
        worst = max(runs, key=lambda run: nan_is_worst(run.result.prd_m))
        demand = max(run.solution.friction_demand for run in runs)
        yield (
            found.array.id,
            f"{int(rung)}, {rung.title}",
            f"{len(runs)} of {total}",
            number(found.array.friction.mu_static, 2),
            number(demand, 2) if math.isfinite(demand) else "no limit",
            _why(found, worst),
            _error(runs),
        )


def _why(found: ArrayAssessment, run: HeadingRun) -> str:
    reason = run.solution.reason
    return "asked for in the workbook" if found.is_model_asked_for else reason


def _error(runs: Sequence[HeadingRun]) -> str:
    errors = [run.result.error_m for run in runs]
    if any(map(math.isnan, errors)):
        return NO_VALUE
    worst = max(errors)
    return below_mm(worst) if worst == 0.0 else f"below {below_mm(worst)}"


def _left_out_table(package: PackageData) -> Table:
    fmt = package.fmt
    rows = "see the rows below" if package.assessment.linked else package.part("basis")
    return Table(
        caption="What was left out, and what it could change in the design displacement",
        columns=(
            TableColumn(head="Array", align="left", share=0.8),
            TableColumn(head="Left out", align="left", share=3.1),
            *fmt.columns("PRD, by at most", share=0.9),
            *fmt.columns("Design, by at most", share=0.9),
            TableColumn(head="How it is known", align="left", share=3.6),
        ),
        rows=tuple(
            TableRow(cells=cells)
            for found in package.assessment.arrays
            for cells in _left_out_rows(package, found)
        ),
        notes=(
            "Not in any of these models: turning in plan, rocking, and the array's own "
            f"flexibility ({rows}).",
        ),
        kind="compact",
    )


def _left_out_rows(
    package: PackageData, found: ArrayAssessment
) -> Iterator[tuple[str | Wide, ...]]:
    if found.is_model_asked_for:
        yield _asked_row(package, found)
        return
    solutions = [run.solution for run in _runs(found)]
    seen = sorted({one.next_rung for one in solutions if one.next_rung > one.rung})
    for rung in seen:
        yield _effect_row(package, found, rung, [one for one in solutions if one.next_rung is rung])
    if seen:
        return
    blank = ("—",) * 4
    if all(one.rung is Rung.NO_SLIP for one in solutions):
        yield found.array.id, "Nothing: it never slips", *blank, "exact"
    elif found.array.friction.is_constant:
        how = "the workbook gives one coefficient"
        yield found.array.id, "Friction by speed", Wide("not known", 4), how
    else:
        yield found.array.id, "Nothing that the workbook gives", *blank, "the fullest model is used"


def _effect_row(
    package: PackageData, found: ArrayAssessment, rung: Rung, group: Sequence[Solution]
) -> tuple[str | Wide, ...]:
    effect = max((one.next_effect_m for one in group), key=nan_is_worst)
    how = "run both ways, with its error" if rung is Rung.TWO_AXES else "exact: run both ways"
    if not math.isfinite(effect):
        return found.array.id, _LEFT_OUT[rung], Wide("not known", 4), "the fuller run has no result"
    raised = max(found.analysis.value_m + found.analysis.factor * effect, found.floor_m)
    return (
        found.array.id,
        _LEFT_OUT[rung],
        *package.fmt.cells(effect),
        *package.fmt.cells(raised - found.design_m),
        how,
    )


def _asked_row(package: PackageData, found: ArrayAssessment) -> tuple[str | Wide, ...]:
    """Return what the models would give that the scenes need, in place of the one asked for."""
    fmt, other = package.fmt, found.chosen[Direction.ANY]
    rung = max(run.solution.rung for motion in found.needed for run in motion.runs)
    name = f"What {rung.title} add" if rung > RUNGS[found.array.model] else "Nothing needed"
    if math.isnan(found.design_m) or math.isnan(other.value_m):
        return found.array.id, name, Wide(NO_VALUE, 4), "no value from analysis"
    effect = max(
        abs(more.governing.result.prd_m - run.governing.result.prd_m)
        for run, more in zip(found.motions, found.needed, strict=True)
    )
    change = found.chosen_towards_m(Direction.ANY) - found.design_m
    floor = found.floor_m >= max(other.value_m, found.analysis.value_m)
    return (
        found.array.id,
        name,
        *fmt.cells(effect),
        *fmt.cells(abs(change)),
        "exact: run both ways" + ("; the floor governs in both" if floor else ""),
    )


def _sentences(package: PackageData, found: ArrayAssessment) -> Iterator[str]:
    name, worst = found.array.id, found.worst
    least = found.uplift.n_min_g  # of the whole motion, also where the vertical is left out
    lifted = "it leaves the roof" if least < 0.0 else "it stays on the roof"
    yield (
        f"Array {name}: the worst run is {worst.motion.id}, {worst.governing.heading.name}, with "
        f"PRD {package.fmt.both(worst.governing.result.prd_m)}. Least normal force "
        f"{number(least, 2)} m g: {lifted}.{friction(found.array)}"
    )
    is_bounded = found.array.friction.is_monotone
    if worst.governing.solution.rung is Rung.SPEED_FRICTION and not is_bounded:
        yield (
            f"Array {name}: its friction falls as it begins to move or gets faster. Next to "
            "nothing may then decide whether it stops, and the error of its PRD is the difference "
            "of two tolerances, no bound. With one coefficient, the least, the error has a bound."
        )


def friction(array: Array) -> str:
    """Return friction by speed in words; nothing where one coefficient holds for all."""
    law = array.friction
    if law.is_constant:
        return ""
    static = "" if law.mu_static == law.mu_slow else f", {number(law.mu_static, 3)} at rest"
    if law.mu_fast == law.mu_slow or law.rate_s_per_m == 0.0:
        return f" Friction by test: {number(law.mu_slow, 3)} sliding{static}."
    return (
        f" Friction by test: {number(law.mu_slow, 3)} at a crawl, {number(law.mu_fast, 3)} at "
        f"speed, rate {number(law.rate_s_per_m, 1)} s/m{static}."
    )
