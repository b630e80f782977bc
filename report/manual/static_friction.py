"""Static above kinetic friction: what it does to the PRD, and where its answers are brittle."""

from __future__ import annotations

import math

import numpy as np

from report.manual.blocks import Block, digits, percent, scientific
from report.pages.parts import Table, TableColumn, TableRow
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
"""Change of the PRD from which on a scene counts as changed."""


def effect(study: RungStudy) -> str:
    """UnitFormat what it does to the PRD, beside the other rungs."""
    words = (
        "Static above kinetic friction: μ is that in motion, and "
        f"{1.0 / study.slow_share:.4g} μ holds the block until it slips and whenever it has "
        "stopped. "
    )
    one, two, static = (study.named(name) for name in (HELD_ONE, HELD, OVER_STATIC))
    if not (one.ratios.size and two.ratios.size and static.ratios.size):
        return words
    return words + (
        f"The PRD is {one.median:.2f} times (median; 10 to 90 %: {one.at(10.0):.2f} to "
        f"{one.at(90.0):.2f}) that with μ throughout in one axis, {two.median:.2f} times "
        f"({two.at(10.0):.2f} to {two.at(90.0):.2f}) in two, and greater in "
        f"{100.0 * two.share_above_one:.0f} % of the runs in two axes: a slip left out may be one "
        "that would have brought the block back. With the static coefficient throughout it "
        f"would be another matter: kinetic friction gives {static.median:.2f} times that."
    )


def block(found: StaticEvidence) -> Block:
    """Return what is left of it as the difference, or the second axis, fades."""
    tables = (_difference_table(found), _fading_table(found)) if found.n_scenes else ()
    return Block(
        title="Static above kinetic friction",
        texts=(_words(found),) if found.n_scenes else (),
        tables=(*tables, _pushed_table(found)),
    )


def _words(found: StaticEvidence) -> str:
    last = found.fading[-1]
    off = int((last.static_above > _TELLING).sum())
    return (
        f"{found.n_scenes} of the scenes above, those that slide {1e3 * LEAST_M:g} mm or more in "
        "one axis, in their first heading. As the difference falls, one axis tends to the exact "
        f"method and two axes to rung 3: the largest change falls with the power {_power(found)} "
        "of the difference. A slip that begins later by a difference lacks a speed of its "
        "square. A second component that fades is another matter. In one axis a block that "
        "turns back comes to rest, and static friction may hold it; with anything across it "
        "turns without coming to rest and is not held. So two axes need not tend to one: with "
        f"{last.share:g} of the second component {off} of {found.n_scenes} scenes are still more "
        f"than {percent(100.0 * _TELLING)} away, the farthest {_farthest(last.static_above)}; "
        f"with one coefficient the farthest is {_farthest(last.one_coefficient)}. "
        "The last table has the extreme of it."
    )


def _farthest(changes: Floats) -> str:
    return percent(100.0 * float(changes[-1]))


def _power(found: StaticEvidence) -> str:
    """Powers of the difference between the last two, in one axis and in two."""
    former, last = found.differences[-2:]
    step = math.log(former.excess / last.excess)
    pairs = (former.one_axis, last.one_axis), (former.two_axes, last.two_axes)
    powers = [math.log(more[-1] / less[-1]) / step for more, less in pairs]
    return " and ".join(f"{power:.1f}" for power in powers)


def _difference_table(found: StaticEvidence) -> Table:
    return Table(
        caption="Change of the PRD by static above kinetic friction",
        columns=(
            TableColumn(head="Static over kinetic", share=1.4),
            TableColumn(head="One axis", unit="median"),
            TableColumn(head="One axis", unit="largest"),
            TableColumn(head="Two axes", unit="median"),
            TableColumn(head="Two axes", unit="largest"),
        ),
        rows=tuple(
            TableRow(cells=(f"{1.0 + d.excess:g}", *_middle_and_top(d.one_axis, d.two_axes)))
            for d in found.differences
        ),
        kind="compact",
    )


def _fading_table(found: StaticEvidence) -> Table:
    static = f"Static {found.ratio:.4g} times kinetic"
    return Table(
        caption="Two axes against one as the second component fades: change of the PRD",
        columns=(
            TableColumn(head="Second component times", share=1.4),
            TableColumn(head="One coefficient", unit="median"),
            TableColumn(head="One coefficient", unit="largest"),
            TableColumn(head=static, unit="median"),
            TableColumn(head=static, unit="largest"),
        ),
        rows=tuple(
            TableRow(cells=(f"{f.share:g}", *_middle_and_top(f.one_coefficient, f.static_above)))
            for f in found.fading
        ),
        kind="compact",
    )


def _middle_and_top(*changes: Floats) -> list[str]:
    return [percent(100.0 * float(value)) for one in changes for value in (np.median(one), one[-1])]


def _pushed_table(found: StaticEvidence) -> Table:
    return Table(
        caption=f"A block that is stopped while {PUSHED_BACK_G:g} g pushes it back; "
        f"μ = {JUMPING.mu_slow:g} in motion, {JUMPING.mu_static:g} at rest: distance from its "
        "start after two seconds",
        columns=(
            TableColumn(head="Push across", unit="m/s²"),
            TableColumn(head="Distance", unit="mm"),
            TableColumn(head="Error as the run tells it", unit="mm", share=1.6),
            TableColumn(head="Distance, friction falling with speed", unit="mm", share=2.2),
        ),
        rows=tuple(_pushed_row(one) for one in found.pushed),
        notes=(
            f"Tolerance {scientific(PUSHED_TOLERANCE)}. The error is the difference between two "
            "tolerances: it tells of the jump where one of them takes the block for stopped and "
            "the other does not, and is silent where both do. Falling: from one to the other with "
            f"{FALLING.rate_s_per_m:g} s/m instead of at once, so that a crawl is held like rest.",
        ),
        kind="compact",
    )


def _pushed_row(one: PushedPoint) -> TableRow:
    return TableRow(
        cells=(
            digits(one.across_mps2),
            number(1e3 * one.end_m, 2),
            scientific(1e3 * one.error_m),
            number(1e3 * one.falling_end_m, 2),
        )
    )
