"""Numerical error on the governing run, and sensitivity to the friction coefficient."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace

from report.assessment.arrays import ArrayAssessment, DesignBasis
from report.assessment.friction import SHIFT, mu_words
from report.assessment.project import Assessment
from report.assessment.sensitivity import Accuracy, MethodRun, Rivals
from report.document.blocks import Picture
from report.document.tables import Table, TableRow
from report.entities.columns import NO_VALUE, TableColumn
from report.entities.marks import dagger
from report.pages.parts import PackageData, check_value
from report.words.letters import lettered, power_of_ten
from report.words.units import number
from solver.model import Status
from solver.sliding.least_model import Rung

_PERCENT = f"{100.0 * SHIFT:.0f} %"


def page(package: PackageData, accuracy: Accuracy) -> Mapping[str, object]:
    """Return the page without its chart."""
    return {
        "shift": _PERCENT,
        "run": _run(package, accuracy.rivals),
        "plane": _plane(package, accuracy.rivals),
        "method": _method(accuracy.rivals),
        "methods": _methods(package, accuracy.rivals) if accuracy.rivals.runs else None,
        "friction": _friction_table(package, accuracy),
        "sentences": [
            *_sentences(package, accuracy),
            *_clearances(accuracy),
            *_limits(package, accuracy),
        ],
    }


def picture(rivals: Rivals, us_first: bool) -> Picture:
    """Return the chart of the page."""
    from report.figures.accuracy import work_precision

    failed = sum(run.failed for run in rivals.runs)
    lost = f" {failed} failed run{'s are' if failed > 1 else ' is'} not drawn." if failed else ""
    return Picture(
        svg=work_precision(rivals, us_first),
        caption="Error in PRD for the governing run along the slope alone, each method from coarse "
        f"to fine. Links stiffen to the right, with the steps required.{lost}",
        alt="Chart of the error in PRD against the steps of each method",
    )


def _run(package: PackageData, rivals: Rivals) -> str:
    run, array = rivals.motion.governing, rivals.array.array
    vertical = "with" if rivals.motion.motion.has_vertical else "without"
    return (
        f"Governing run: array {array.id} (slope {number(math.degrees(array.slope_rad), 2)}°, "
        f"μ = {mu_words(array.friction)}) under motion {rivals.motion.motion.id}, "
        f"{run.heading.name}, {vertical} vertical shaking. PRD {package.fmt.both(run.prd_m)}, "
        f"model {int(run.solution.rung)} of {package.part('model')}, {run.model}."
    )


def _plane(package: PackageData, rivals: Rivals) -> str:
    """Return the error of a run in two axes and the scope of the comparison; or nothing."""
    run = rivals.motion.governing
    if run.solution.rung < Rung.TWO_AXES or math.isnan(run.prd_m):
        return ""
    kind = "a bound" if run.scene.friction.is_monotone else "an estimate from two tolerances"
    slow = "" if run.scene.friction.is_constant else ", and with the low-velocity friction"
    return (
        "Motion in two axes is computed to a tolerance: the error of this PRD is below "
        f"{below_mm(run.result.error_m)} ({kind}). All methods are compared on this run along the "
        f"slope alone, without the cross-slope component{slow}; the verification manual compares "
        f"methods in two axes. That displacement, {package.fmt.both(rivals.exact.prd_m)}, is not "
        "a result of this package."
    )


def below_mm(error_m: float) -> str:
    """Return the power of ten above an error, in mm: the digits depend on the machine."""
    if error_m == 0.0:
        return "rounding error"
    return f"{power_of_ten(math.floor(math.log10(1e3 * error_m)) + 1)} mm"


def _method(rivals: Rivals) -> str:
    """Return the error of the exact method on this run."""
    result = rivals.motion.governing.result
    if result.status is Status.UPLIFT:
        return "The block lifts off the roof: the run gives no displacement and no error."
    if math.isnan(result.prd_m):
        return f"The run gives no displacement and no error: {result.status.sentence}."
    if not rivals.runs:
        return "No sliding along the slope in this run: all methods that model sticking agree."
    return (
        "Along the slope the solution is exact, event by event, with at most one step per sampling "
        "interval. With a sample added midway between samples (the same motion), the PRD "
        f"{_doubled(rivals.doubled)}. A run took less than {_decade_ms(rivals.seconds)} ms. The "
        "verification manual of this version (roofslip verify) compares the method with closed "
        "forms and times each method."
    )


def _decade_ms(seconds: float) -> str:
    """Return a power of ten well above a time [ms], at least 10, for reproducible text."""
    return f"{10.0 ** max(math.ceil(math.log10(seconds * 1e4)), 1):g}"


def _doubled(change: float) -> str:
    # A power of ten above it: the digits depend on the machine.
    if change == 0.0:
        return "is identical to the last digit"
    return f"changes by less than {power_of_ten(math.floor(math.log10(change)) + 1)} of its value"


def _methods(package: PackageData, rivals: Rivals) -> Table:
    fmt, exact = package.fmt, rivals.exact
    top = TableRow(
        cells=(
            "Exact, event by event",
            "none",
            *fmt.cells(exact.prd_m),
            "rounding error",
        ),
        kind="total",
    )
    rows = (_method_row(package, run) for run in rivals.runs if run.is_default)
    return Table(
        caption="The governing run along the slope alone, by every method with default settings",
        columns=(
            TableColumn(head="Method", align="left", share=3.0),
            TableColumn(head="Parameters", align="left", share=2.4),
            *fmt.columns("PRD", share=0.9),
            TableColumn(head="Error in PRD", unit="%", share=1.1),
        ),
        rows=(top, *rows),
        kind="compact",
    )


def _method_row(package: PackageData, run: MethodRun) -> TableRow:
    return TableRow(
        cells=(
            lettered(run.method.title),
            parameters(run.parameters),
            *package.fmt.cells(run.result.prd_m),
            "failed" if run.failed else number(100.0 * run.error, 3),
        )
    )


def parameters(values: Mapping[str, float]) -> str:
    """Return parameters of a method in words."""
    texts = {
        "substeps": "{:g} sub-steps",
        "stiffness_per_m": "stiffness {:g} /m",
        "velocity_mps": "v0 = {:g} m/s",
        "tolerance": "tolerance {:g}",
    }
    return ", ".join(texts[key].format(value) for key, value in values.items()) or "none"


def _by_array(
    accuracy: Accuracy,
) -> Iterator[tuple[ArrayAssessment, ArrayAssessment, ArrayAssessment]]:
    """Yield each array as given, with less and with more friction.

    Without a design value where no route is permitted.
    """
    for given, *others in zip(
        accuracy.given.arrays, accuracy.less.arrays, accuracy.more.arrays, strict=True
    ):
        less, more = (replace(other, design_m=other.permitted_m) for other in others)
        yield replace(given, design_m=given.permitted_m), less, more


def _friction_table(package: PackageData, accuracy: Accuracy) -> Table:
    fmt = package.fmt
    return Table(
        caption="Design displacement with changed friction, all motions rerun",
        columns=(
            TableColumn(head="Array", align="left", share=1.2),
            TableColumn(head="μ", share=1.1),
            *fmt.columns(f"{_PERCENT} less"),
            *fmt.columns("As given"),
            *fmt.columns(f"{_PERCENT} more"),
            TableColumn(head="Change", unit=f"{_PERCENT} less", share=1.0),
            TableColumn(head="Change", unit=f"{_PERCENT} more", share=1.0),
        ),
        rows=tuple(
            TableRow(
                cells=(
                    given.id,
                    mu_words(given.array.friction),
                    *_design_cells(package, less),
                    *_design_cells(package, given),
                    *_design_cells(package, more),
                    _change(less.design_m, given.design_m),
                    _change(more.design_m, given.design_m),
                )
            )
            for given, less, more in _by_array(accuracy)
        ),
        kind="compact",
    )


def _design_cells(package: PackageData, array: ArrayAssessment) -> tuple[str, str]:
    return package.fmt.cells(array.design_m, mark=package.design_mark(array))


def _design(package: PackageData, array: ArrayAssessment) -> str:
    return package.fmt.both(array.design_m) + package.design_mark(array)


def _change(value: float, given: float) -> str:
    if math.isnan(value) or not given > 0.0:
        return NO_VALUE if math.isnan(value) or math.isnan(given) else "—"
    share = 100.0 * (value / given - 1.0)
    return f"{'+' if share > 0.05 else ''}{number(share, 1)} %"


def _sentences(package: PackageData, accuracy: Accuracy) -> Iterator[str]:
    """Yield a sentence for each array; arrays always governed by the floor share one."""
    three = tuple(_by_array(accuracy))
    floored = [given for given, *others in three if _on_floor(given, *others)]
    yield from (_sentence(package, *arrays) for arrays in three if not _on_floor(*arrays))
    if floored:
        names = ", ".join(given.id for given in floored)
        yield (
            f"Array{'s' if len(floored) > 1 else ''} {names}: ±{_PERCENT} friction does "
            "not change the design displacement, governed by the floor of "
            f"{_design(package, floored[0])}."
        )


def _on_floor(*arrays: ArrayAssessment) -> bool:
    return all(array.governs is DesignBasis.FLOOR for array in arrays)


def _sentence(
    package: PackageData, given: ArrayAssessment, less: ArrayAssessment, more: ArrayAssessment
) -> str:
    start = f"Array {given.id}: "
    if any(math.isnan(array.design_m) for array in (given, more)):
        return f"{start}no permitted design displacement, so no sensitivity to friction is given."
    ways = (
        f"with {_PERCENT} {word} friction the design displacement of "
        f"{_design(package, given)} {_becomes(package, given, other)}"
        if index == 0
        else f"with {_PERCENT} {word} {_becomes(package, given, other, short=True)}"
        for index, (word, other) in enumerate((("less", less), ("more", more)))
    )
    return f"{start}{'; '.join(ways)}."


def _becomes(
    package: PackageData, given: ArrayAssessment, other: ArrayAssessment, *, short: bool = False
) -> str:
    if math.isnan(other.design_m):
        words = "no route is permitted" if not other.is_permitted else "there is no value"
        return f"{words}, and the design displacement is none" if short else f"is none: {words}"
    change = other.design_m - given.design_m
    if abs(change) <= 1e-9 * given.design_m:
        return "it is unchanged" if short else "is unchanged"
    verb = "it increases" if change > 0.0 else "it decreases"
    floor = ", the floor" if other.governs is DesignBasis.FLOOR else ""
    share = _change(other.design_m, given.design_m)
    words = f"{verb} to {_design(package, other)}, {share}{floor}"
    return words if short else words.removeprefix("it ")


def _clearances(accuracy: Accuracy) -> Sequence[str]:
    """Return the effect of less friction on clearances and on the outcome of runs."""
    texts = []
    if any(gap.ok for gap in accuracy.given.clearances):
        texts.append(_short_of(accuracy))
    unfinished = _unfinished(accuracy.less) - _unfinished(accuracy.given)
    if unfinished > 0:
        texts.append(
            f"With {_PERCENT} less friction {unfinished} more of the runs are still sliding at the "
            "end of their record: their displacement is not final."
        )
    return texts


def _limits(package: PackageData, accuracy: Accuracy) -> Sequence[str]:
    """Return the limits of arrays that less friction breaks."""
    return [
        f"{check.title}, array {array.id}: with {_PERCENT} less friction "
        f"{check_value(check, check.value, package.fmt)}, and the limit is "
        f"{check_value(check, check.limit, package.fmt)}{dagger(check.provision)}: NG."
        for array, check in accuracy.newly_limited
    ]


def _short_of(accuracy: Accuracy) -> str:
    if not accuracy.newly_short:
        return f"With {_PERCENT} less friction all clearances that are satisfied remain satisfied."
    short = accuracy.newly_short
    names = ", ".join(f"{gap.clearance.array} to {gap.clearance.object}" for gap in short)
    count = f"{len(short)} clearance{'s' if len(short) > 1 else ''}"
    return f"With {_PERCENT} less friction {count} would no longer be satisfied: {names}."


def _unfinished(assessment: Assessment) -> int:
    runs = (run for a in assessment.arrays for motion in a.motions for run in motion.runs)
    return sum(run.result.status is Status.SLIDING_AT_END for run in runs)
