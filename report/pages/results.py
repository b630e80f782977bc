"""Results by array, and the comparison with the prescriptive displacement."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

from markupsafe import Markup

from report.assess import ArrayAssessment, MotionRun
from report.pages.checks import check_table
from report.pages.parts import NO_VALUE, Column, Row, Scene, Table, Wide, statistic
from report.units import number
from solver.model import Heading, Status

_SHORT = {Status.OK: "", Status.SLIDING_AT_END: "sliding", Status.UPLIFT: "uplift"}


def array_results(scene: Scene, found: ArrayAssessment) -> Mapping[str, object]:
    """Return the table of one array and the lines above and below it."""
    troubles = [
        text
        for text in scene.assessment.warnings
        if text.casefold().startswith(f"array {found.array.id},".casefold())
    ]
    return {
        "table": _peaks(scene, found),
        "facts": f"{_facts(found)} {_spread(found)}".rstrip(),
        "troubles": troubles,
    }


def _facts(found: ArrayAssessment) -> str:
    array = found.array
    return (
        f"Slope {number(math.degrees(array.slope_rad), 2)}° "
        f"({number(100.0 * math.tan(array.slope_rad), 1)} %), μ = {number(array.mu, 3)}, "
        f"{array.construction}."
    )


def _spread(found: ArrayAssessment) -> str:
    """Return which motions lie farthest from the mean; nothing where there is no mean."""
    if not found.analysis.mean_m > 0.0:
        return ""
    ordered = sorted(found.motions, key=lambda run: run.governing.result.prd_m)
    least, most = ordered[0], ordered[-1]
    return (
        f"Motion {most.motion.id} ({most.governing.heading.name}) governs with "
        f"{_over_mean(found, most)} of the mean PRD; the least is {least.motion.id} with "
        f"{_over_mean(found, least)}. Coefficient of variation {number(found.variation, 2)}."
    )


def _over_mean(found: ArrayAssessment, run: MotionRun) -> str:
    mean = found.analysis.mean_m
    return number(run.governing.result.prd_m / mean, 2) if mean > 0.0 else "—"


def _peaks(scene: Scene, found: ArrayAssessment) -> Table:
    say, headings = scene.say, _headings(found)
    first = say.units()[0].symbol
    return Table(
        caption=f"Array {found.array.id}: every motion in every run",
        columns=(
            Column(head="Motion", align="left", share=1.1),
            *(Column(head="PRD of each run", unit=_short(heading)) for heading in headings),
            *say.columns("PRD that counts"),
            Column(head="PRD / mean", share=0.9),
            *(Column(head=head, unit=first) for head in ("Residual", "Down", "Up")),
            Column(head="t PRD", unit="s", share=0.9),
            Column(head="Stops", share=0.85),
            Column(head="N/(m g)", share=1.0),
            Column(head="Status", align="left", share=1.05),
        ),
        rows=(
            *(_motion_row(scene, found, run, headings) for run in found.motions),
            *_statistics(scene, found, len(headings)),
        ),
        notes=(
            f"{_meaning(headings)}; bold what counts. The columns behind belong to the run that "
            "counts: relative to the roof, positive down the slope; stops include reversals; "
            "N/(m g) is the least. The file results.xlsx has every run in both systems of units.",
        ),
        kind="compact",
    )


def _headings(found: ArrayAssessment) -> tuple[Heading, ...]:
    """Return every run that any motion has, in order."""
    seen = {run.heading: None for motion in found.motions for run in motion.runs}
    return tuple(sorted(seen, key=lambda heading: (heading.swapped, -heading.sign)))


def _short(heading: Heading) -> str:
    return f"{'transv.' if heading.swapped else 'rec.'} {heading.name[-1]}"


def _meaning(headings: Sequence[Heading]) -> str:
    """Return what the runs are, in words."""
    two = ", transv. the transverse component" if any(h.swapped for h in headings) else ""
    return f"Rec.: the horizontal record along the slope{two}; − reversed"


def _motion_row(
    scene: Scene, found: ArrayAssessment, run: MotionRun, headings: Sequence[Heading]
) -> Row:
    say, result = scene.say, run.governing.result
    return Row(
        cells=(
            run.motion.id,
            *(_peak(scene, run, heading) for heading in headings),
            *say.cells(result.prd_m),
            _over_mean(found, run),
            *(say.cells(value)[0] for value in (result.residual_m, result.down_m, result.up_m)),
            number(result.t_prd_s, 2),
            NO_VALUE if math.isnan(result.prd_m) else str(result.n_stops),
            number(result.n_min_g, 2),
            _SHORT[result.status] or "at rest",
        )
    )


def _peak(scene: Scene, run: MotionRun, heading: Heading) -> str:
    """Return the PRD of one run in the first unit; blank where the motion has no such run."""
    for one in run.runs:
        if one.heading == heading:
            text = scene.say.cells(one.result.prd_m)[0]
            return Markup("<b>{}</b>").format(text) if one is run.governing else text
    return ""


def _statistics(scene: Scene, found: ArrayAssessment, runs: int) -> Sequence[Row]:
    analysis, rules = found.analysis, scene.assessment.rules
    factor = rules.values["analysis_factor"].clause + scene.mark("analysis_factor")
    floor = rules.values["analysis_floor"].clause + scene.mark("analysis_floor")
    lines = (
        ("Mean", analysis.mean_m, "", "over the motions, of the largest of their runs"),
        ("Largest", analysis.largest_m, "", "over all motions"),
        ("Analysis", analysis.value_m, "", f"{statistic(analysis.basis)}, {factor}"),
        ("Floor", found.floor_m, scene.mark("analysis_floor"), _floor_words(scene, floor)),
        ("Design", found.design_m, scene.design_mark(found), f"governed by: {found.governs}"),
    )
    return [
        Row(
            cells=(Wide(label, 1 + runs), *scene.say.cells(value, mark=mark), Wide(words, 8)),
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
