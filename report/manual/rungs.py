"""Rung against rung: what each fuller model changes, two axes against general solvers, speed."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from report.figures import rungs as figures
from report.figures.scales import power_of_ten
from report.manual.blocks import Block, Chart, ManualSection, joined, percent, scientific, seconds
from report.manual.static_friction import block, effect
from report.pages.parts import Picture, Table, TableColumn, TableRow
from report.words.letters import lettered
from report.words.units import number
from solver.verification.evidence import Verification
from solver.verification.rung_evidence import (
    LEAST_M,
    OVER_FAST,
    OVER_SLOW,
    SECOND,
    WORST,
    BoundRatios,
    PlaneWork,
    RungChange,
    RungEvidence,
    RungStudy,
    StopPoint,
)


def rungs(found: Verification) -> ManualSection:
    """Return the comparison of the models."""
    return ManualSection(
        id="rungs",
        title="From one axis to two, and to rows of blocks",
        blocks=tuple(block for one in found.rungs for block in _blocks(one)),
    )


def _blocks(found: RungEvidence) -> tuple[Block, ...]:
    return (
        Block(texts=_ladder()),
        Block(
            title="Rung against rung",
            texts=(
                _scenes(found.study),
                _underestimates(found.study),
                _friction(found.study),
                effect(found.study),
                _rows(found.study),
            ),
            top=(_changes_table(found.study),),
            charts=(_changes_chart(found.study),),
        ),
        Block(
            title="What each rung takes",
            tables=(_times_table(found),),
        ),
        Block(
            title="Work against precision in two axes",
            texts=(_work_words(found),),
            charts=(_work_chart(found),),
            tables=(_work_table(found.work),),
        ),
        Block(
            title="How the stated bound holds",
            texts=(_bound_words(found.bounds),),
            charts=(_bound_chart(found.bounds),),
            tables=(_bound_table(found.bounds),),
        ),
        Block(
            title="Near a stop",
            texts=(_stop_words(),),
            tables=(_stop_table(found.stops),),
        ),
        block(found.static),
    )


def _ladder() -> tuple[str, ...]:
    return (
        "A scene is answered by the least model that does: no slip (0), one axis (1), one axis "
        "with vertical (2), two axes with vertical (3), friction that depends on speed (4). A row "
        "of linked blocks (5) shows whether one rigid array is enough. One axis is followed to "
        "rounding. Two axes have no closed form: they are followed by power series from event to "
        "event, with a bound of the error, to a tolerance of 10⁻⁶ of the PRD unless another is "
        "set; where SciPy is installed, the checks of section 3 hold every tolerance against it.",
    )


def _scenes(study: RungStudy) -> str:
    made = len(study.motions) - study.n_recorded
    kinds = [f"{made} made motion{'s' if made > 1 else ''}"] if made else []
    kinds += [f"{study.n_recorded} recorded in earthquakes"] if study.n_recorded else []
    words = (
        f"{study.n_runs} runs: {joined(kinds)} (named in section 2), each on slopes of "
        f"{_list(study.slopes_deg)}° with μ = {_list(study.mus)} at a PPA of "
        f"{_list(study.ppas_g)} g, the larger horizontal component having that peak and all "
        "components one factor; each horizontal component along the slope in both senses. "
    )
    if study.n_uplift:
        words += (
            f"In {study.n_uplift} runs the vertical lifts the block off the roof: no displacement, "
            "and not counted here. "
        )
    if not study.n_recorded:
        words += (
            "No records of three components were given to this run (option --records): what "
            "follows is made motions alone. "
        )
    return words + (
        f"Largest bound of the error in two axes: {scientific(study.largest_error)} of the PRD."
    )


def _list(values: Sequence[float]) -> str:
    return joined([f"{value:g}" for value in values])


def _underestimates(study: RungStudy) -> str:
    """UnitFormat plainly what one axis leaves out."""
    one, worst = study.named(SECOND), study.named(WORST)
    if not one.ratios.size or not worst.ratios.size:
        return f"No scene slides {1e3 * LEAST_M:g} mm or more in both models."
    verdict = "One axis underestimates." if one.median > 1.0 else "Here one axis is enough."
    return (
        f"{verdict} Friction has one direction at a time: what pushes the block "
        "across the slope uses it up, and what is left for the slope is less. With the second "
        f"component the PRD is {one.median:.2f} times that of one axis with the same heading "
        f"(median; 10 to 90 % of the runs: {one.at(10.0):.2f} to {one.at(90.0):.2f}; largest "
        f"{one.at(100.0):.1f}), and greater in {100.0 * one.share_above_one:.0f} % of the runs. "
        "Running each horizontal component alone in both senses and taking the worst does not "
        f"mend that: two axes give {worst.median:.2f} times the worst of those (10 to 90 %: "
        f"{worst.at(10.0):.2f} to {worst.at(90.0):.2f}; largest {worst.at(100.0):.1f})."
    )


def _friction(study: RungStudy) -> str:
    slow, fast = study.named(OVER_SLOW), study.named(OVER_FAST)
    words = (
        f"Friction by speed: μ slow, the coefficient of the other rungs, is {study.slow_share:g} "
        f"of μ fast, and it rises with {study.rate_s_per_m:g} s/m. "
    )
    if not slow.ratios.size or not fast.ratios.size:
        return words
    return words + (
        f"The PRD is {slow.median:.2f} times (median) that with the coefficient at a crawl for "
        f"every speed, and less than that in {100.0 * (1.0 - slow.share_above_one):.0f} % of the "
        f"runs; it is {fast.median:.2f} times that with the coefficient of fast sliding, and more "
        f"in {100.0 * fast.share_above_one:.0f} %. Neither is a bound: a motion that comes back "
        "may end anywhere."
    )


def _rows(study: RungStudy) -> str:
    return (
        f"A row of {len(study.row_shares)} blocks joined along the slope, whose friction is "
        f"{_list(study.row_shares)} times μ from the top down, against one rigid array with their "
        "mean: links that stretch by 1 mm or 10 mm under the weight of a block, damping 5 %; the "
        f"first heading alone, at {study.row_ppa_g:g} g, vertical in, the second axis out. The "
        "PRD of a row is that of the block that goes farthest."
    )


def _changes_chart(study: RungStudy) -> Chart:
    return Chart(
        name="rungs-changes",
        picture=Picture(
            svg=figures.changes(study.changes),
            caption="What each step up changes: dots, runs; upright mark, median; bar, 10 to 90 %.",
            alt="Ratios of the PRD of a fuller model to that of a lesser one",
        ),
    )


def _changes_table(study: RungStudy) -> Table:
    return Table(
        caption="PRD of the fuller model over that of the lesser",
        columns=(
            TableColumn(head="Step", align="left", share=3.0),
            TableColumn(head="Runs"),
            TableColumn(head="Least"),
            TableColumn(head="10 %"),
            TableColumn(head="Median"),
            TableColumn(head="90 %"),
            TableColumn(head="Largest"),
            TableColumn(head="Above 1", unit="%"),
            TableColumn(head="Not counted", share=1.2),
            TableColumn(head="Largest change", unit="mm", share=1.3),
        ),
        rows=tuple(_change_row(one) for one in study.changes),
        notes=(
            f"Not counted: the PRD of one of them is under {1e3 * LEAST_M:g} mm. Largest change: "
            "of all, these too. Vertical: rung 2 over rung 1. Second axis: rung 3 over rung 2. "
            "Worst heading: the largest of four headings in two axes over the largest in one. "
            "Friction by speed: rung 4 over rung 3 with the one or the other coefficient. Static "
            "friction: rung 4 over rung 2 or 3 with the kinetic coefficient, at last over rung 3 "
            "with the static one. TableRow: rung 5 over rung 2 with the mean coefficient.",
        ),
        kind="compact",
    )


def _change_row(one: RungChange) -> TableRow:
    return TableRow(
        cells=(
            one.name,
            str(one.ratios.size),
            *(number(one.at(at), 2) for at in (0.0, 10.0, 50.0, 90.0, 100.0)),
            number(100.0 * one.share_above_one, 0),
            str(one.n_small),
            number(1e3 * one.most_m, 0),
        )
    )


def _work_words(found: RungEvidence) -> str:
    words = (
        f"Scene: {found.work_scene}. Errors are against the power series with the tightest "
        "tolerance, 10⁻¹⁰; that of the power series is the largest at any sample, of the others "
        "that of the PRD. Fixed steps are compiled like the power series. "
    )
    if any("SciPy" in one.method for one in found.work):
        return words + (
            "SciPy's DOP853 is held against that tolerance in section 3. Its solvers call a "
            "right-hand side in plain Python, so hold their evaluations against steps rather than "
            "their times; friction is μN tanh(v/v₀) for them."
        )
    return words + "SciPy is not installed here; its solvers are left out."


def _work_chart(found: RungEvidence) -> Chart:
    return Chart(
        name="rungs-work",
        picture=Picture(
            svg=figures.work(found.work),
            caption=f"Two axes, {found.work_scene}: further down is more accurate, further left "
            "faster. With v₀ the regularised friction has a floor that no tolerance mends.",
            alt="Time per run against error, methods in two axes",
        ),
    )


def _work_table(points: Sequence[PlaneWork]) -> Table:
    rows = []
    for name in dict.fromkeys(one.method for one in points):
        own = [one for one in points if one.method == name]
        shown = own[::2] if len(own) > 3 else own
        rows += [
            TableRow(
                cells=(
                    lettered(name) if n == 0 else "",
                    _setting(one.setting),
                    str(one.steps),
                    seconds(one.seconds),
                    "failed" if math.isnan(one.seconds) else percent(one.error_percent),
                )
            )
            for n, one in enumerate(shown)
        ]
    return Table(
        caption="Two axes: steps, or evaluations for SciPy, times and errors",
        columns=(
            TableColumn(head="Method", align="left", share=3.2),
            TableColumn(head="Setting", align="left", share=1.2),
            TableColumn(head="Steps", share=1.0),
            TableColumn(head="Time per run", share=1.2),
            TableColumn(head="Error", share=1.2),
        ),
        rows=tuple(rows),
        notes=("Of long rows of settings every second one.",),
        kind="compact",
    )


def _bound_words(found: Sequence[BoundRatios]) -> str:
    pairs, over = sum(one.n_pairs for one in found), sum(one.n_over for one in found)
    unanswered = sum(one.n_unanswered for one in found)
    verdict = (
        "Every pair keeps to its bound."
        if over + unanswered == 0
        else f"Pairs over their bounds: {over}; without an answer: {unanswered}."
    )
    return (
        f"{pairs:,} pairs of runs on random scenes, most of them nothing like an earthquake: equal "
        "samples, jumps, pushes at the yield acceleration to the last digit, components in "
        "proportion or next to none, steps of 0.0005 to 0.5 s, tolerances of 10⁻² to 10⁻¹⁰. The "
        "two runs of a pair must give the same: with samples put between on the straight lines, "
        "mirrored, rotated on a flat roof, or at two tolerances. Their difference, the largest of "
        "the PRD, of the four excursions and of the place at the end, may be the sum of both "
        "stated bounds, and where the input of the second is rounded anew, half a unit in the "
        f"last place of every sample as a push for the whole record. {verdict}"
    )


def _bound_chart(found: Sequence[BoundRatios]) -> Chart:
    return Chart(
        name="rungs-bounds",
        picture=Picture(
            svg=figures.bounds(found),
            caption="Share of the pairs whose difference over bound is above a value. Differences "
            f"below {power_of_ten(figures.LEAST_RATIO)} of the bound are drawn there.",
            alt="Distribution of the difference of two runs over the sum of their bounds",
        ),
    )


def _bound_table(found: Sequence[BoundRatios]) -> Table:
    return Table(
        caption="Difference of the two runs of a pair over the sum of their bounds",
        columns=(
            TableColumn(head="Pairs", align="left", share=2.4),
            TableColumn(head="Number"),
            TableColumn(head="That move"),
            TableColumn(head="Median"),
            TableColumn(head="99 %"),
            TableColumn(head="Largest"),
            TableColumn(head="Above 1"),
            TableColumn(head="No answer"),
        ),
        rows=tuple(
            TableRow(
                cells=(
                    one.kind.replace("mu", "μ"),
                    str(one.n_pairs),
                    str(one.ratios.size),
                    *(_small(float(value)) for value in np.percentile(one.ratios, (50, 99, 100))),
                    str(one.n_over),
                    str(one.n_unanswered),
                )
            )
            for one in found
        ),
        kind="compact",
    )


def _stop_words() -> str:
    return (
        "A block is thrown down a flat roof while 2 m/s² push it across; μ = 0.4 stops it after "
        "0.15 s and holds it from then on, at a place known in closed form (section 3). As the "
        "speed goes to zero its direction turns faster and faster, and friction has a jump at "
        "zero. Fixed steps that take friction against v alone chatter on; regularised friction "
        "creeps for as long as the push lasts, by v₀ artanh(G/μN); without regularisation a "
        "general solver does not get past the stop. The power series end in it."
    )


def _stop_table(points: Sequence[StopPoint]) -> Table:
    return Table(
        caption="Two seconds of a block that is stopped and should rest",
        columns=(
            TableColumn(head="Method", align="left", share=3.4),
            TableColumn(head="Setting", align="left", share=1.1),
            TableColumn(head="Steps", share=1.0),
            TableColumn(head="Error in place", unit="mm", share=1.3),
            TableColumn(head="Speed left", unit="mm/s", share=1.3),
        ),
        rows=tuple(
            TableRow(
                cells=(
                    lettered(one.method),
                    _setting(one.setting),
                    str(one.steps),
                    "did not end" if math.isnan(one.error_m) else _small(1e3 * one.error_m),
                    _small(1e3 * one.end_speed_mps),
                )
            )
            for one in points
        ),
        notes=("Steps of SciPy: evaluations of the right-hand side.",),
        kind="compact",
    )


def _setting(words: str) -> str:
    name, _, value = words.partition(" ")
    return f"{name} {power_of_ten(float(value))}" if name == "tol." else words


def _small(value: float) -> str:
    return f"{value:.2g}" if value >= 1e-3 else scientific(value)


def _times_table(found: RungEvidence) -> Table:
    return Table(
        caption=f"Time per run of each rung, {found.times_motion}",
        columns=(
            TableColumn(head="Rung", align="left", share=3.0),
            TableColumn(head="Time per run", share=1.2),
            TableColumn(head="of one axis", share=1.2),
        ),
        rows=tuple(
            TableRow(
                cells=(
                    one.title,
                    seconds(one.seconds),
                    number(one.ratio, 0 if one.ratio >= 10.0 else 1),
                )
            )
            for one in found.times
        ),
        notes=(
            "Medians over three scenes, one thread, warm; two axes and friction by speed to the "
            "tolerance of 10⁻⁶.",
        ),
        kind="compact",
    )


def answers(found: Verification) -> tuple[tuple[str, str], ...]:
    """Return what the summary says of two axes: questions and answers."""
    rows = []
    for one in found.rungs:
        second, worst = one.study.named(SECOND), one.study.named(WORST)
        if second.ratios.size and worst.ratios.size:
            text = (
                f"{second.median:.2f} times, 10 to 90 % of the runs {second.at(10.0):.2f} to "
                f"{second.at(90.0):.2f}; over the worst heading of one axis {worst.median:.2f} "
                "times"
            )
            rows.append(("PRD in two axes over that in one, median", text))
    return tuple(rows)
