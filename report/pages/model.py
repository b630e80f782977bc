"""The model used for each array, the reason it is adequate, and what it neglects.

Selects nothing: `solver.sliding.least_model` does. Read `report.pages.parts` first.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from itertools import groupby

from report.assessment.arrays import ArrayAssessment
from report.assessment.friction import mu_words
from report.assessment.friction_rows import basis_words
from report.assessment.runs import RUNGS, HeadingRun
from report.document.tables import Table, TableRow, Wide, listed
from report.entities.columns import NO_VALUE, TableColumn
from report.entities.shown import centered, plain, text, words
from report.pages import links
from report.pages.accuracy import below_mm
from report.pages.parts import PackageData, nan_is_worst, verdict
from report.sheet.schema import Array, Direction
from report.words.counts import spelled
from report.words.units import number, ratio
from solver.model import INCH_M
from solver.sliding.least_model import DEFAULT, Rung, Solution

_NEGLECTED = {
    Rung.ONE_AXIS_VERTICAL: "Vertical shaking",
    Rung.TWO_AXES: "Cross-slope shaking",
    Rung.SPEED_FRICTION: "Velocity-dependent friction",
}


def page(package: PackageData) -> Mapping[str, object]:
    """Return the page on the models."""
    arrays = package.assessment.arrays
    matters = (
        f"{number(1e3 * DEFAULT.matters_m, 0)} mm ({number(DEFAULT.matters_m / INCH_M, 2)} in) or "
        f"{number(100.0 * DEFAULT.matters_share, 1)} %"
    )
    return {
        "rungs": tuple(f"{int(rung)}: {rung.title}" for rung in Rung if rung is not Rung.ROW),
        "matters": matters,
        "combinations": _combinations(package),
        "table": _table(package),
        "neglected": _neglected_table(package),
        "stability": _stability_table(package),
        "sentences": [text for array in arrays for text in _sentences(package, array)],
        "troubles": tuple(model_troubles(package)),
        "links": links.part(package, matters),
    }


def model_troubles(package: PackageData) -> Iterator[str]:
    """Yield in words which requested models are not adequate."""
    for array in package.assessment.arrays:
        if array.is_model_enough:
            continue
        worst = max(Direction, key=lambda d: array.chosen_toward_m(d) - array.design_toward_m(d))
        yield (
            f"Array {array.id}: the requested model, {array.array.model.value}, gives "
            f"{package.fmt.both(array.design_toward_m(worst))} ({worst.value}); the adequate "
            f"model gives {package.fmt.both(array.chosen_toward_m(worst))}."
        )


def tipping_troubles(package: PackageData) -> Iterator[str]:
    """Yield in words which arrays begin to tip about an edge of their supports."""
    for array in package.assessment.arrays:
        if not array.tipping.is_ok:
            yield (
                f"Array {array.id} begins to tip ({array.tipping.governs}): the ratio of "
                f"demand to b/(2c) is {ratio(array.tipping.ratio)}."
            )


def _stability_table(package: PackageData) -> Table:
    """Return the checks of uplift and tipping."""

    def demand(array: ArrayAssessment) -> str:
        demand = array.tipping.demand
        return number(demand, 2) if math.isfinite(demand) else "no limit"

    columns = (
        (words("Array", 0.8), lambda item: item.id),
        (plain("Min. N", unit="m g"), lambda item: item.uplift.n_min_g),
        (
            text("Uplift time", "s", 1.1),
            lambda item: number(item.uplift.duration_s, 3) if item.uplift.lifts else "none",
        ),
        (text("Demand", "V/N"), demand),
        (plain("Transmitted", unit="V/N", share=1.1), lambda item: item.tipping.transmitted),
        (plain("Capacity", unit="b/(2c)", share=1.1), lambda item: item.tipping.capacity),
        (text("Ratio, at rest", share=1.2), lambda item: ratio(item.tipping.at_rest_ratio)),
        (text("Ratio, sliding", share=1.2), lambda item: ratio(item.tipping.sliding_ratio)),
        (centered("Verdict"), lambda item: verdict(item.tipping.is_ok and not item.uplift.lifts)),
    )
    return listed(
        package.assessment.arrays,
        columns,
        "Checks independent of the model: uplift and tipping",
        package.fmt,
        kind="compact",
        notes=(
            "The worst run of each array. Tipping: an array begins to tip about an edge of its "
            "supports where the transmitted shear exceeds b/(2c) times the normal force. "
            "Transmitted: the lesser of the demand and the friction coefficient; b: smallest "
            "support spacing; c: height of the center of gravity, midway between the supports "
            "(Housner, 1963; Ishiyama, 1982).",
        ),
    )


def _runs(array: ArrayAssessment) -> Sequence[HeadingRun]:
    return [run for motion in array.motions for run in motion.runs]


def _by_rung(array: ArrayAssessment) -> Iterator[tuple[Rung, Sequence[HeadingRun]]]:
    ordered = sorted(_runs(array), key=lambda run: run.solution.rung)
    for rung, group in groupby(ordered, key=lambda run: run.solution.rung):
        yield rung, list(group)


def _combinations(package: PackageData) -> str:
    motions = [run.motion for run in package.governing.motions]
    two = sum(motion.has_transverse for motion in motions)
    if not two:
        return (
            "No motion has a second horizontal component: each record is applied along the slope, "
            "in the polarities that the workbook requests. Cross-slope shaking also uses part of "
            "the friction: with both components most displacements are larger (verification "
            "manual)."
        )
    both = all(len(motion.signs) == 2 for motion in motions)
    of = "Each motion has" if two == len(motions) else f"{two} of {len(motions)} motions have"
    counts = sorted({len(motion.headings) for motion in motions if motion.has_transverse})
    run = " or ".join(map(spelled, counts))
    polarities = "" if both else " where the workbook requests both polarities"
    so = "so" if both else "so in the polarities requested"
    return (
        f"{of} eight combinations{polarities}: either horizontal component along the slope, in "
        "either polarity, with the other component across it in either polarity. Reversing the "
        "cross-slope component mirrors the motion and changes no downslope, upslope or cross-slope "
        f"displacement, {so} {run} are run and the largest PRD governs."
    )


def _table(package: PackageData) -> Table:
    return Table(
        caption="Model used, by array",
        columns=(
            TableColumn(head="Array", align="left", share=0.8),
            TableColumn(head="Model", align="left", share=2.1),
            TableColumn(head="Runs", share=1.0),
            TableColumn(head="μ", unit="at rest", share=0.9),
            TableColumn(head="Demand", share=0.9),
            TableColumn(head="Reason", align="left", share=4.2),
            TableColumn(head="Error of PRD", align="left", share=1.6),
        ),
        rows=tuple(
            TableRow(cells=cells)
            for array in package.assessment.arrays
            for cells in _model_rows(array)
        ),
        notes=(
            "Demand: the largest ratio of shear to normal force with no slip; the array slips "
            "where it exceeds μ at rest. Reason: for the run with the largest PRD. Error: relative "
            "to the exact solution for acceleration that varies linearly between samples.",
        ),
        kind="compact",
    )


def _model_rows(array: ArrayAssessment) -> Iterator[tuple[str, ...]]:
    total = len(_runs(array))
    for rung, runs in _by_rung(array):
        worst = max(runs, key=lambda run: nan_is_worst(run.prd_m))
        demand = max(run.solution.friction_demand for run in runs)
        yield (
            array.id,
            f"{int(rung)}, {_model(runs)}",
            f"{len(runs)} of {total}",
            number(array.array.friction.mu_static, 2),
            number(demand, 2) if math.isfinite(demand) else "no limit",
            _reason(array, worst),
            _error(runs),
        )


def _model(runs: Sequence[HeadingRun]) -> str:
    """Return the name of the model of runs, and how many have no vertical component to model."""
    title, names = runs[0].solution.rung.title, {run.model for run in runs}
    lacking = sum(run.model != title for run in runs)
    return runs[0].model if len(names) == 1 else f"{title} ({lacking} runs without)"


def _reason(array: ArrayAssessment, run: HeadingRun) -> str:
    reason = run.solution.reason
    return "requested in the workbook" if array.is_model_requested else reason


def _error(runs: Sequence[HeadingRun]) -> str:
    errors = [run.result.error_m for run in runs]
    if any(map(math.isnan, errors)):
        return NO_VALUE
    worst = max(errors)
    return below_mm(worst) if worst == 0.0 else f"below {below_mm(worst)}"


def _neglected_table(package: PackageData) -> Table:
    fmt = package.fmt
    where = "see below" if package.assessment.linked else package.part("basis")
    return Table(
        caption="Neglected effects and the largest change that they could cause",
        columns=(
            TableColumn(head="Array", align="left", share=0.8),
            TableColumn(head="Neglected", align="left", share=3.1),
            *fmt.columns("PRD, at most", share=0.9),
            *fmt.columns("Design displ., at most", share=0.9),
            TableColumn(head="Basis", align="left", share=3.6),
        ),
        rows=tuple(
            TableRow(cells=cells)
            for array in package.assessment.arrays
            for cells in _neglected_rows(package, array)
        ),
        notes=(
            "No model includes rotation in plan, rocking, or the flexibility of the array "
            f"({where}).",
        ),
        kind="compact",
    )


def _neglected_rows(
    package: PackageData, array: ArrayAssessment
) -> Iterator[tuple[str | Wide, ...]]:
    if array.is_model_requested:
        yield _requested_row(package, array)
        return
    solutions = [run.solution for run in _runs(array)]
    neglected = sorted(
        {solution.next_rung for solution in solutions if solution.next_rung > solution.rung}
    )
    for rung in neglected:
        # A run that already has this model has nothing to tell of it.
        without = [solution for solution in solutions if solution.next_rung is rung > solution.rung]
        yield _effect_row(package, array, rung, without)
    if neglected:
        return
    blank = ("—",) * 4
    if all(solution.rung is Rung.NO_SLIP for solution in solutions):
        yield array.id, "None: no slip", *blank, "exact"
    elif array.array.friction.is_constant:
        basis = "the workbook gives one coefficient"
        yield array.id, _NEGLECTED[Rung.SPEED_FRICTION], Wide("not known", 4), basis
    else:
        yield array.id, "None of the given inputs", *blank, "the most complete model is used"


def _effect_row(
    package: PackageData, array: ArrayAssessment, rung: Rung, group: Sequence[Solution]
) -> tuple[str | Wide, ...]:
    effect = max((solution.next_effect_m for solution in group), key=nan_is_worst)
    basis = "both models run; error included" if rung is Rung.TWO_AXES else "exact: both models run"
    if not math.isfinite(effect):
        no_result = "no result with the more complete model"
        return array.id, _NEGLECTED[rung], Wide("not known", 4), no_result
    raised = max(array.analysis.value_m + array.analysis.factor * effect, array.floor_m)
    return (
        array.id,
        _NEGLECTED[rung],
        *package.fmt.cells(effect),
        *package.fmt.cells(raised - array.design_m),
        basis,
    )


def _requested_row(package: PackageData, array: ArrayAssessment) -> tuple[str | Wide, ...]:
    """Return the change that the adequate models make to the requested one."""
    fmt, other = package.fmt, array.chosen[Direction.ANY]
    rung = max(run.solution.rung for motion in array.needed for run in motion.runs)
    name = f"Effects of {rung.title}" if rung > RUNGS[array.array.model] else "None"
    if math.isnan(array.design_m) or math.isnan(other.value_m):
        return array.id, name, Wide(NO_VALUE, 4), "no value from analysis"
    effect = max(
        abs(more.governing.prd_m - run.governing.prd_m)
        for run, more in zip(array.motions, array.needed, strict=True)
    )
    change = array.chosen_toward_m(Direction.ANY) - array.design_m
    floor = array.floor_m >= max(other.value_m, array.analysis.value_m)
    return (
        array.id,
        name,
        *fmt.cells(effect),
        *fmt.cells(abs(change)),
        "exact: both models run" + ("; the floor governs both" if floor else ""),
    )


def _sentences(package: PackageData, array: ArrayAssessment) -> Iterator[str]:
    name, worst = array.id, array.worst
    least = array.uplift.n_min_g  # of the whole motion, also where the vertical is neglected
    lifted = "uplift occurs" if least < 0.0 else "no uplift"
    yield (
        f"Array {name}: the governing run is {worst.motion.id}, {worst.governing.heading.name}, "
        f"with PRD {package.fmt.both(worst.governing.prd_m)}. Minimum normal force "
        f"{number(least, 2)} m g: {lifted}.{friction(package, array.array)}"
    )
    is_bounded = array.array.friction.is_monotone
    if worst.governing.solution.rung is Rung.SPEED_FRICTION and not is_bounded:
        yield (
            f"Array {name}: the friction decreases at the onset of sliding or with velocity. A "
            "negligible perturbation may then decide whether the array stops, and the error of the "
            "PRD is the difference between two tolerances, not a bound. With one coefficient, the "
            "smallest, the error is a bound."
        )


def friction(package: PackageData, array: Array) -> str:
    """Return friction that is no single coefficient in words; otherwise nothing."""
    law = array.friction
    if law.is_constant:
        return ""
    rate = f" (rate {number(law.rate_s_per_m, 1)} s/m)" if law.is_by_velocity else ""
    return f" Friction: {mu_words(law)}{rate}; {basis_words(package.data, array)}."
