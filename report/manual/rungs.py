"""Comparison of models: effect of each fuller model, two axes against general solvers, time."""

from __future__ import annotations

import math
from collections.abc import Sequence

from report.document.blocks import Picture
from report.document.tables import Table, TableRow
from report.entities.columns import TableColumn
from report.figures import rungs as figures
from report.figures.scales import power_of_ten
from report.manual import bounds
from report.manual.blocks import (
    Block,
    Chart,
    ManualSection,
    joined,
    percent,
    scientific,
    seconds,
    small,
)
from report.manual.static_friction import block, effect
from report.words.letters import lettered
from report.words.units import number
from solver.verification.evidence import Verification
from solver.verification.rung_evidence import (
    LEAST_M,
    OVER_FAST,
    OVER_SLOW,
    SECOND,
    WORST,
    PlaneWork,
    RungChange,
    RungEvidence,
    RungStudy,
    StopPoint,
)


def rungs(verification: Verification) -> ManualSection:
    """Return the comparison of the models."""
    return ManualSection(
        id="rungs",
        title="Models: one axis, two axes and rows of blocks",
        blocks=tuple(block for evidence in verification.rungs for block in _blocks(evidence)),
    )


def _blocks(evidence: RungEvidence) -> tuple[Block, ...]:
    return (
        Block(texts=_ladder()),
        Block(
            title="Effect of each model on the PRD",
            texts=(
                _scenes(evidence.study),
                _underestimates(evidence.study),
                _friction(evidence.study),
                effect(evidence.study),
                _rows(evidence.study),
            ),
            top=(_changes_table(evidence.study),),
            charts=(_changes_chart(evidence.study),),
        ),
        Block(
            title="Run time of each model",
            tables=(_times_table(evidence),),
        ),
        Block(
            title="Accuracy against run time in two axes",
            texts=(_work_words(evidence),),
            charts=(_work_chart(evidence),),
            tables=(_work_table(evidence.work),),
        ),
        bounds.block(evidence.bounds),
        Block(
            title="Behavior at a stop",
            texts=(_stop_words(),),
            tables=(_stop_table(evidence.stops),),
        ),
        block(evidence.static),
    )


def _ladder() -> tuple[str, ...]:
    return (
        "For each analysis case the program uses the simplest sufficient model: no slip (0), one "
        "axis (1), one axis with vertical (2), two axes with vertical (3), or two axes with "
        "velocity-dependent friction (4). A row of linked blocks (5) shows whether one rigid array "
        "is an adequate model. One axis is solved to rounding error. Two axes have no closed form. "
        "They are solved by power series from event to event, with an error bound and a tolerance "
        "of 10⁻⁶ of the PRD unless another is set. Where SciPy is installed, section 3 compares "
        "every tolerance with it.",
    )


def _scenes(study: RungStudy) -> str:
    made = len(study.motions) - study.n_recorded
    kinds = [f"{made} generated motion{'s' if made > 1 else ''}"] if made else []
    kinds += [f"{study.n_recorded} recorded in earthquakes"] if study.n_recorded else []
    words = (
        f"The comparison has {study.n_runs} runs: {joined(kinds)} (listed in section 2), each on "
        f"slopes of {_list(study.slopes_deg)}° with μ = {_list(study.mus)} at a PPA of "
        f"{_list(study.ppas_g)} g. The larger horizontal component is scaled to the PPA, and all "
        "components have the same factor. Each horizontal component is applied along the slope "
        "with both signs. "
    )
    if study.n_uplift:
        words += (
            f"In {study.n_uplift} runs the vertical component lifts the block off the roof; these "
            "runs give no displacement and are excluded. "
        )
    if not study.n_recorded:
        words += (
            "No records of three components were given to this run (option --records); the results "
            "below are for generated motions only. "
        )
    return words + (
        f"The largest error bound in two axes is {scientific(study.largest_error)} of the PRD."
    )


def _list(values: Sequence[float]) -> str:
    return joined([f"{value:g}" for value in values])


def _underestimates(study: RungStudy) -> str:
    """Return the effect of the second component that one axis neglects, in words."""
    second, worst = study.named(SECOND), study.named(WORST)
    if not second.ratios.size or not worst.ratios.size:
        return f"No run slides {1e3 * LEAST_M:g} mm or more in both models."
    verdict = (
        "One axis underestimates the PRD."
        if second.median > 1.0
        else "One axis does not underestimate the median PRD of these runs."
    )
    return (
        f"{verdict} Friction acts opposite to the total velocity; the part that resists "
        "cross-slope motion is not available along the slope. With the second "
        f"component the PRD is {second.median:.2f} times that of one axis with the same heading "
        f"(median; 10 to 90 % of the runs: {second.at(10.0):.2f} to {second.at(90.0):.2f}; largest "
        f"{second.at(100.0):.1f}), and greater in {100.0 * second.share_above_one:.0f} % of the "
        "runs. The largest PRD from each horizontal component run alone with both signs does not "
        f"cover this effect: two axes give {worst.median:.2f} times that PRD (10 to 90 %: "
        f"{worst.at(10.0):.2f} to {worst.at(90.0):.2f}; largest {worst.at(100.0):.1f})."
    )


def _friction(study: RungStudy) -> str:
    slow, fast = study.named(OVER_SLOW), study.named(OVER_FAST)
    words = (
        "Velocity-dependent friction: the low-velocity coefficient, used by the other models, is "
        f"{study.slow_share:g} of the high-velocity coefficient, and the rate of the increase is "
        f"{study.rate_s_per_m:g} s/m. "
    )
    if not slow.ratios.size or not fast.ratios.size:
        return words
    return words + (
        f"The PRD is {slow.median:.2f} times (median) that with the low-velocity coefficient at "
        f"all velocities, and not greater in {100.0 * (1.0 - slow.share_above_one):.0f} % of the "
        f"runs. It is {fast.median:.2f} times (median) that with the high-velocity coefficient, "
        f"and greater in {100.0 * fast.share_above_one:.0f} % of the runs. Neither coefficient "
        "gives a bound on the PRD, because the displacement of a block that reverses direction "
        "does not vary monotonically with friction."
    )


def _rows(study: RungStudy) -> str:
    return (
        f"Row of blocks: {len(study.row_shares)} blocks are linked along the slope, with "
        f"coefficients of {_list(study.row_shares)} times μ from the upslope end. The row is "
        "compared with one rigid array that has the mean coefficient. The links elongate 1 mm or "
        "10 mm under the weight of a block and have 5 % damping. The row is run in the first "
        f"heading only, at {study.row_ppa_g:g} g, with the vertical component and without the "
        "second axis. The PRD of a row is the largest PRD of its blocks."
    )


def _changes_chart(study: RungStudy) -> Chart:
    return Chart(
        name="rungs-changes",
        picture=Picture(
            svg=figures.changes(study.changes),
            caption="Ratio of PRD, fuller model / simpler model. Dots: runs; vertical mark: "
            "median; bar: 10 to 90 %.",
            alt="Ratios of the PRD of a fuller model to that of a simpler one",
        ),
    )


def _changes_table(study: RungStudy) -> Table:
    return Table(
        caption="Ratio of PRD, fuller model / simpler model",
        columns=(
            TableColumn(head="Comparison", align="left", share=4.0),
            TableColumn(head="Runs"),
            TableColumn(head="Least"),
            TableColumn(head="10 %"),
            TableColumn(head="Median"),
            TableColumn(head="90 %"),
            TableColumn(head="Largest"),
            TableColumn(head="Above 1", unit="%"),
            TableColumn(head="Excluded", share=1.1),
            TableColumn(head="Largest change", unit="mm", share=1.3),
        ),
        rows=tuple(_change_row(change) for change in study.changes),
        notes=(
            f"Excluded: runs in which either PRD is less than {1e3 * LEAST_M:g} mm. Largest "
            "change: of all runs, including the excluded ones. Vertical: model 2 / model 1. Second "
            "axis: model 3 / model 2. Worst heading: largest of four headings in two axes / "
            "largest in one axis. Velocity-dependent μ: model 4 / model 3 with the low-velocity or "
            "the high-velocity coefficient. Static friction: model 4 / model 2 or 3 with the "
            "kinetic coefficient. Static and kinetic μ / static μ: model 4 / model 3 with the "
            "static coefficient. Row: model 5 / model 2 with the mean coefficient.",
        ),
        kind="compact",
    )


def _change_row(change: RungChange) -> TableRow:
    return TableRow(
        cells=(
            change.name,
            str(change.ratios.size),
            *(number(change.at(at), 2) for at in (0.0, 10.0, 50.0, 90.0, 100.0)),
            number(100.0 * change.share_above_one, 0),
            str(change.n_small),
            number(1e3 * change.most_m, 0),
        )
    )


def _work_words(evidence: RungEvidence) -> str:
    words = (
        f"The analysis case is {evidence.work_scene}. Errors are measured against the power series "
        "with the tightest tolerance, 10⁻¹⁰. The error of the power series is the largest at any "
        "sample; the errors of the other methods are those of the PRD. The fixed-step methods are "
        "compiled, as is the power series. "
    )
    if any("SciPy" in point.method for point in evidence.work):
        return words + (
            "Section 3 compares that tolerance with SciPy's DOP853. The SciPy solvers evaluate the "
            "right-hand side in Python, so their number of evaluations, not their time, should be "
            "compared with the number of steps. They use the regularized friction μN tanh(v/v₀)."
        )
    return words + "SciPy is not installed here; its solvers are not shown."


def _work_chart(evidence: RungEvidence) -> Chart:
    return Chart(
        name="rungs-work",
        picture=Picture(
            svg=figures.work(evidence.work),
            caption=f"Two axes, {evidence.work_scene}. Lower points are more accurate; points "
            "further left are faster. The error of regularized friction has a floor set by v₀, "
            "whatever the tolerance.",
            alt="Error against time per run, methods in two axes",
        ),
    )


def _work_table(points: Sequence[PlaneWork]) -> Table:
    rows = []
    for name in dict.fromkeys(point.method for point in points):
        own = [point for point in points if point.method == name]
        shown = own[::2] if len(own) > 3 else own
        rows += [
            TableRow(
                cells=(
                    lettered(name) if n == 0 else "",
                    _setting(point.setting),
                    str(point.steps),
                    seconds(point.seconds),
                    "failed" if math.isnan(point.seconds) else percent(point.error_percent),
                )
            )
            for n, point in enumerate(shown)
        ]
    return Table(
        caption="Two axes: steps (evaluations for SciPy), times and errors",
        columns=(
            TableColumn(head="Method", align="left", share=3.2),
            TableColumn(head="Setting", align="left", share=1.2),
            TableColumn(head="Steps", share=1.0),
            TableColumn(head="Time per run", share=1.2),
            TableColumn(head="Error", share=1.2),
        ),
        rows=tuple(rows),
        notes=("Where a method has more than three settings, every second one is shown.",),
        kind="compact",
    )


def _stop_words() -> str:
    return (
        "A block is set in motion on a flat roof while a transverse acceleration of 2 m/s² acts on "
        "it. Friction with μ = 0.4 stops the block after 0.15 s. It stays at rest from then on, at "
        "a position known in closed form (section 3). As the velocity approaches zero its "
        "direction rotates faster and faster, and friction is discontinuous at zero. Fixed steps "
        "without stick chatter. With regularized friction the block creeps at a velocity of "
        "v₀ artanh(G/μN) as long as the acceleration acts. Without regularization a "
        "general-purpose solver cannot integrate past the stop. The power series reach the stop "
        "and end there."
    )


def _stop_table(points: Sequence[StopPoint]) -> Table:
    return Table(
        caption="Block that stops and should remain at rest: state after 2 s",
        columns=(
            TableColumn(head="Method", align="left", share=3.4),
            TableColumn(head="Setting", align="left", share=1.1),
            TableColumn(head="Steps", share=1.0),
            TableColumn(head="Position error", unit="mm", share=1.3),
            TableColumn(head="Final velocity", unit="mm/s", share=1.3),
        ),
        rows=tuple(
            TableRow(
                cells=(
                    lettered(point.method),
                    _setting(point.setting),
                    str(point.steps),
                    "stalled" if math.isnan(point.error_m) else small(1e3 * point.error_m),
                    small(1e3 * point.end_speed_mps),
                )
            )
            for point in points
        ),
        notes=("Steps of SciPy: evaluations of the right-hand side.",),
        kind="compact",
    )


def _setting(words: str) -> str:
    name, _, value = words.partition(" ")
    return f"{name} {power_of_ten(float(value))}" if name == "tol." else words


def _times_table(evidence: RungEvidence) -> Table:
    return Table(
        caption=f"Time per run of each model, {evidence.times_motion}",
        columns=(
            TableColumn(head="Model", align="left", share=3.0),
            TableColumn(head="Time per run", share=1.2),
            TableColumn(head="Ratio to one axis", share=1.2),
        ),
        rows=tuple(
            TableRow(
                cells=(
                    timing.title,
                    seconds(timing.seconds),
                    number(timing.ratio, 0 if timing.ratio >= 10.0 else 1),
                )
            )
            for timing in evidence.times
        ),
        notes=(
            "Medians over three analysis cases, one thread, after compilation. Two axes are run "
            "with a tolerance of 10⁻⁶.",
        ),
        kind="compact",
    )


def answers(verification: Verification) -> tuple[tuple[str, str], ...]:
    """Return the summary's rows on two axes: quantity and result."""
    rows = []
    for evidence in verification.rungs:
        second, worst = evidence.study.named(SECOND), evidence.study.named(WORST)
        if second.ratios.size and worst.ratios.size:
            text = (
                f"{second.median:.2f} times (10 to 90 % of the runs: {second.at(10.0):.2f} to "
                f"{second.at(90.0):.2f}); {worst.median:.2f} times for the worst heading"
            )
            rows.append(("PRD in two axes relative to one axis, median", text))
    return tuple(rows)
