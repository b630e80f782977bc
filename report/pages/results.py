"""Results by array, and the comparison with the prescriptive displacement."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

from report.assess import ArrayAssessment, MotionRun, PolarityRun
from report.pages.checks import check_table
from report.pages.parts import NO_VALUE, Column, Row, Scene, Table, Wide, statistic
from report.units import number
from solver.model import Status

_SHORT = {Status.OK: "", Status.SLIDING_AT_END: "sliding", Status.UPLIFT: "uplift"}


def array_results(scene: Scene, found: ArrayAssessment) -> Mapping[str, object]:
    """Return the table of one array and the lines below it."""
    troubles = [
        text
        for text in scene.assessment.warnings
        if text.casefold().startswith(f"array {found.array.id},".casefold())
    ]
    return {"table": _peaks(scene, found), "facts": _facts(scene, found), "troubles": troubles}


def _facts(scene: Scene, found: ArrayAssessment) -> str:
    array = found.array
    return (
        f"Slope {number(math.degrees(array.slope_rad), 2)}° "
        f"({number(100.0 * math.tan(array.slope_rad), 1)} %), μ = {number(array.mu, 3)}, "
        f"{array.construction}."
    )


def _peaks(scene: Scene, found: ArrayAssessment) -> Table:
    say = scene.say
    rows = [
        _run_row(scene, run, polarity, first=index == 0)
        for run in found.motions
        for index, polarity in enumerate(run.runs)
    ]
    return Table(
        caption=f"Array {found.array.id}: every motion in each polarity",
        columns=(
            Column(head="Motion", align="left", share=1.0),
            Column(head="Sign", align="center", share=0.5),
            *say.columns("PRD", share=0.85),
            *say.columns("Residual", share=0.85),
            *say.columns("Down", share=0.85),
            *say.columns("Up", share=0.85),
            Column(head="t PRD", unit="s", share=0.8),
            Column(head="Stops", share=0.65),
            Column(head="N/(m g)", share=0.8),
            Column(head="Status", align="left", share=0.85),
        ),
        rows=(*rows, *_statistics(scene, found)),
        notes=(
            "Relative to the roof, positive down the slope; + as recorded, − reversed, bold what "
            "counts. Stops include reversals. N/(m g): least of the run.",
        ),
        kind="compact",
    )


def _run_row(scene: Scene, run: MotionRun, polarity: PolarityRun, *, first: bool) -> Row:
    say, result = scene.say, polarity.result
    return Row(
        cells=(
            run.motion.id if first else "",
            "+" if polarity.sign > 0 else "−",
            *say.cells(result.prd_m),
            *say.cells(result.residual_m),
            *say.cells(result.down_m),
            *say.cells(result.up_m),
            number(result.t_prd_s, 2),
            NO_VALUE if math.isnan(result.prd_m) else str(result.n_stops),
            number(result.n_min_g, 2),
            _SHORT[result.status] or "at rest",
        ),
        kind="counts" if polarity is run.governing else "",
    )


def _statistics(scene: Scene, found: ArrayAssessment) -> Sequence[Row]:
    analysis, rules = found.analysis, scene.assessment.rules
    factor = rules.values["analysis_factor"].clause + scene.mark("analysis_factor")
    floor = rules.values["analysis_floor"].clause + scene.mark("analysis_floor")
    lines = (
        ("Mean", analysis.mean_m, "", "over the motions, of the larger of both polarities"),
        ("Largest", analysis.largest_m, "", "over all motions"),
        ("Analysis", analysis.value_m, "", f"{statistic(analysis.basis)}, {factor}"),
        ("Floor", found.floor_m, scene.mark("analysis_floor"), _floor_words(scene, floor)),
        ("Design", found.design_m, scene.design_mark(found), f"governed by: {found.governs}"),
    )
    return [
        Row(
            cells=(Wide(label, 2), *scene.say.cells(value, mark=mark), Wide(words, 10)),
            kind="total",
        )
        for label, value, mark, words in lines
    ]


def _floor_words(scene: Scene, clause: str) -> str:
    if scene.data.options.peer_reviewed:
        return "none, the analysis being peer reviewed"
    share = number(100.0 * scene.assessment.rules["analysis_floor"], 0)
    return f"{share} % of the prescriptive displacement, {clause}"


def comparison(scene: Scene) -> Mapping[str, object]:
    """Return the comparison with the prescriptive displacement, without its chart."""
    checks = [
        (f"Array {found.array.id}", check)
        for found in scene.assessment.arrays
        for check in found.prescriptive_checks
    ]
    return {
        "table": _ratios(scene),
        "routes": check_table(
            "Whether the prescriptive route is open", scene, checks, ("kept", "not kept")
        ),
        "sentences": tuple(_sentence(scene, found) for found in scene.assessment.arrays),
    }


def _ratios(scene: Scene) -> Table:
    say = scene.say
    return Table(
        caption="Displacement by analysis against the prescriptive displacement",
        columns=(
            Column(head="Array", align="left", share=1.1),
            *say.columns("Prescriptive"),
            *say.columns("Mean"),
            *say.columns("Analysis"),
            *say.columns("Floor"),
            *say.columns("Design"),
            Column(head="Analysis / prescr.", share=1.2),
            Column(head="Design / prescr.", share=1.2),
            Column(head="Governs", align="left", share=1.4),
        ),
        rows=tuple(_ratio_row(scene, found) for found in scene.assessment.arrays),
        kind="compact",
    )


def _ratio_row(scene: Scene, found: ArrayAssessment) -> Row:
    say = scene.say
    shares = (found.analysis.value_m / found.prescriptive.value_m, found.ratio)
    return Row(
        cells=(
            found.array.id,
            *say.cells(found.prescriptive.value_m, mark=scene.mark(scene.prescriptive_key(found))),
            *say.cells(found.analysis.mean_m),
            *say.cells(found.analysis.value_m),
            *say.cells(found.floor_m, mark=scene.mark("analysis_floor")),
            *say.cells(found.design_m, mark=scene.design_mark(found)),
            *(NO_VALUE if math.isnan(share) else number(share, 2) for share in shares),
            found.governs,
        )
    )


def _sentence(scene: Scene, found: ArrayAssessment) -> str:
    failed = [check.title for check in found.prescriptive_checks if not check.ok]
    route = (
        f"the prescriptive route is not open ({'; '.join(failed)})"
        if failed
        else "the prescriptive route is open as well"
    )
    if math.isnan(found.design_m):
        return f"Array {found.array.id}: no value from analysis, {route}."
    if scene.data.options.peer_reviewed:
        floor = "no floor applies, the analysis being peer reviewed"
    else:
        share = number(100.0 * scene.assessment.rules["analysis_floor"], 0)
        floor = (
            f"the floor of {share} % of the prescriptive value"
            f"{scene.mark('analysis_floor')} "
            f"{'governs' if found.governs == 'floor' else 'does not govern'}"
        )
    return f"Array {found.array.id}: {floor}; {route}."
