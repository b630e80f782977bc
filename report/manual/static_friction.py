"""Static above kinetic friction: its effect on the PRD, and where the result is sensitive."""

from __future__ import annotations

import math

import numpy as np

from report.document.tables import Table, TableRow
from report.entities.columns import TableColumn
from report.manual.blocks import Block, digits, percent, scientific
from report.words.units import number
from solver.model import Floats
from solver.verification.rung_evidence import (
    HELD,
    HELD_ONE,
    LEAST_M,
    OVER_STATIC,
    PushedPoint,
    RungStudy,
    StaticEvidence,
)
from solver.verification.static_study import (
    FALLING,
    JUMPING,
    PUSHED_BACK_G,
    PUSHED_TOLERANCE,
)

_TELLING = 1e-3
"""Least relative change of the PRD for which a scene counts as changed."""


def effect(study: RungStudy) -> str:
    """Return the effect on the PRD relative to the other models, in words."""
    words = (
        "Static friction above kinetic friction: the kinetic coefficient is μ. The static "
        f"coefficient, {1.0 / study.slow_share:.4g} μ, applies before the first slip and after "
        "every stop. "
    )
    one_axis, two_axes, static = (study.named(name) for name in (HELD_ONE, HELD, OVER_STATIC))
    if not (one_axis.ratios.size and two_axes.ratios.size and static.ratios.size):
        return words
    return words + (
        f"Relative to μ throughout, the PRD is {one_axis.median:.2f} times in one axis "
        f"(median; 10 to 90 %: {one_axis.at(10.0):.2f} to {one_axis.at(90.0):.2f}) and "
        f"{two_axes.median:.2f} times in two axes ({two_axes.at(10.0):.2f} to "
        f"{two_axes.at(90.0):.2f}). It is greater in {100.0 * two_axes.share_above_one:.0f} % of "
        "the runs in two axes, because static friction can prevent a slip that would have "
        "returned the block toward its initial position. Relative to "
        f"the static coefficient throughout, the PRD is {static.median:.2f} times (median)."
    )


def block(evidence: StaticEvidence) -> Block:
    """Return the limits of a small difference and of a small second component."""
    tables = (_difference_table(evidence), _fading_table(evidence)) if evidence.n_scenes else ()
    return Block(
        title="Static friction above kinetic friction",
        texts=(_words(evidence),) if evidence.n_scenes else (),
        tables=(*tables, _pushed_table(evidence)),
    )


def _words(evidence: StaticEvidence) -> str:
    last = evidence.fading[-1]
    off = int((last.static_above > _TELLING).sum())
    return (
        f"The first two tables use {evidence.n_scenes} of the cases above: those that slide "
        f"{1e3 * LEAST_M:g} mm or more in one axis, in their first heading. As the difference of "
        "the coefficients decreases, one axis converges to the exact method, and two axes "
        "converge to model 3. The median change decreases with the power "
        f"{_power(evidence)} of the difference (one axis and two axes), because a later onset of "
        "slip changes the velocity by the square of the delay. A small second component has a "
        "different effect. In one axis, a block that reverses comes to rest, and static friction "
        "may then prevent slip. With any cross-slope component, the block reverses without coming "
        "to rest, and static friction does not act. Two axes therefore need not converge to one: "
        f"with {last.share:g} of the second component, {off} of {evidence.n_scenes} cases still "
        f"differ by more than {percent(100.0 * _TELLING)}, the largest difference being "
        f"{_farthest(last.static_above)}. With one coefficient, the largest difference is "
        f"{_farthest(last.one_coefficient)}. The last table shows an extreme case."
    )


def _farthest(changes: Floats) -> str:
    return percent(100.0 * float(changes[-1]))


def _power(evidence: StaticEvidence) -> str:
    """Observed order of the median from the last two differences, in one axis and in two.

    The largest change is of a single case, whose terms of second and third order may still cancel.
    """
    former, last = evidence.differences[-2:]
    step = math.log(former.excess / last.excess)
    pairs = (former.one_axis, last.one_axis), (former.two_axes, last.two_axes)
    powers = [math.log(np.median(more) / np.median(less)) / step for more, less in pairs]
    return " and ".join(f"{power:.1f}" for power in powers)


def _difference_table(evidence: StaticEvidence) -> Table:
    return Table(
        caption="Change of the PRD due to static friction above kinetic friction",
        columns=(
            TableColumn(head="Static / kinetic μ", share=1.4),
            TableColumn(head="One axis", unit="median"),
            TableColumn(head="One axis", unit="largest"),
            TableColumn(head="Two axes", unit="median"),
            TableColumn(head="Two axes", unit="largest"),
        ),
        rows=tuple(
            TableRow(cells=(f"{1.0 + d.excess:g}", *_middle_and_top(d.one_axis, d.two_axes)))
            for d in evidence.differences
        ),
        kind="compact",
    )


def _fading_table(evidence: StaticEvidence) -> Table:
    static = f"Static / kinetic μ = {evidence.ratio:.4g}"
    return Table(
        caption="Change of the PRD from one axis to two axes with a reduced second component",
        columns=(
            TableColumn(head="Factor on second component", share=1.4),
            TableColumn(head="One coefficient", unit="median"),
            TableColumn(head="One coefficient", unit="largest"),
            TableColumn(head=static, unit="median"),
            TableColumn(head=static, unit="largest"),
        ),
        rows=tuple(
            TableRow(cells=(f"{f.share:g}", *_middle_and_top(f.one_coefficient, f.static_above)))
            for f in evidence.fading
        ),
        kind="compact",
    )


def _middle_and_top(*changes: Floats) -> list[str]:
    return [
        percent(100.0 * float(value))
        for change in changes
        for value in (np.median(change), change[-1])
    ]


def _pushed_table(evidence: StaticEvidence) -> Table:
    return Table(
        caption="Distance from the initial position after 2 s: a sliding block stops under an "
        f"opposing acceleration of {PUSHED_BACK_G:g} g; kinetic μ = {JUMPING.mu_slow:g}, "
        f"static μ = {JUMPING.mu_static:g}",
        columns=(
            TableColumn(head="Transverse acceleration", unit="m/s²", share=1.5),
            TableColumn(head="Distance", unit="mm"),
            TableColumn(head="Error reported by the run", unit="mm", share=1.6),
            TableColumn(head="Distance, gradual decrease of μ", unit="mm", share=2.0),
        ),
        rows=tuple(_pushed_row(point) for point in evidence.pushed),
        notes=(
            f"Tolerance {scientific(PUSHED_TOLERANCE)}. The error is the difference between the "
            "results at two tolerances. It shows the jump if the block stops at one tolerance and "
            "not at the other; it does not show the jump if the block stops at both. Gradual "
            "decrease: μ falls from static to kinetic with velocity at a rate of "
            f"{FALLING.rate_s_per_m:g} s/m instead of abruptly, so that static friction also acts "
            "at low velocity.",
        ),
        kind="compact",
    )


def _pushed_row(point: PushedPoint) -> TableRow:
    return TableRow(
        cells=(
            digits(point.across_mps2),
            number(1e3 * point.end_m, 2),
            scientific(1e3 * point.error_m),
            number(1e3 * point.falling_end_m, 2),
        )
    )
