"""The comparison with shake-table tests: acceptance, tests, result; or that there are none."""

from __future__ import annotations

import math
from collections.abc import Iterator

from report.document.sections import Section, section
from report.document.tables import grouped
from report.entities.shown import plain, text, words
from report.figures.shake_table import computed_against_measured
from report.words.counts import grouped_by, joined
from report.words.units import number
from report.words.validation import NOT_VALIDATED, explained
from solver.verification import shake_table as accepted
from solver.verification.evidence import Verification
from solver.verification.shake_table import ShakeTable, TableRun

_TEST = (
    (words("Test", 1.6), lambda run: run.test.name),
    (words("Axes", 0.7), lambda run: _axes(run)),
    (text("θ", "deg", 0.6), lambda run: f"{math.degrees(run.test.scene.slope_rad):.3g}"),
    (text("μ", share=0.9), lambda run: _mus(run)),
    (text("Model", share=0.7), lambda run: int(run.model)),
    (plain("PRD, stated", 1, "mm"), lambda run: 1e3 * run.test.prd_m),
    (
        text("PRD, computed", "mm", 1.1),
        lambda run: run.status.value if math.isnan(run.prd_m) else number(1e3 * run.prd_m, 1),
    ),
    (plain("Ratio", 3, share=0.7), lambda run: run.ratio),
    (plain("Residual, stated", 1, "mm", 1.1), lambda run: 1e3 * run.test.residual_m),
    (plain("Residual, computed", 1, "mm", 1.2), lambda run: 1e3 * run.residual_m),
)


def shake_table(verification: Verification) -> Section:
    """Return the section."""

    def source(run: TableRun) -> str:
        return f"Slip {run.test.data}: {run.test.source}"

    drawn = [table for table in verification.tables if any(run.ratio > 0.0 for run in table.runs)]
    return section(
        "manual/shake-table",
        "Comparison with a shake table",
        explained=explained(()),
        tables=[
            (
                table,
                grouped(grouped_by(table.runs, source), _TEST),
                list(_rows(table)),
                result(table),
            )
            for table in verification.tables
        ],
        charts={"shake-table": computed_against_measured(drawn[-1])} if drawn else {},
    )


def result(table: ShakeTable) -> str:
    """Return whether the acceptance is satisfied, and what follows from it."""
    unsatisfied = [
        f"{name[0].lower()}{name[1:]}, {found} instead of {limit}"
        for name, found, limit, is_satisfied in _rows(table)
        if not is_satisfied
    ]
    words = f"not satisfied: {joined(unsatisfied)}" if unsatisfied else "satisfied"
    words = f"The acceptance is {words}."
    return words if table.validates else f"{words} {NOT_VALIDATED}"


def _rows(table: ShakeTable) -> Iterator[tuple[str, str, str, bool]]:
    """Yield what is required, what was found, what is accepted, and whether it is."""
    count, least, (low, high) = table.ratios.size, accepted.LEAST_TESTS, accepted.MEDIAN
    yield "Number of ratios", str(count), f"{least} or more", count >= least
    is_within = low <= table.median <= high
    yield "Median ratio", number(table.median, 3), f"{low:g} to {high:g}", is_within
    share, least_share, (low, high) = table.share_within, accepted.SHARE, accepted.RATIOS
    found, limit = f"{100.0 * share:.0f} %", f"{100.0 * least_share:g} % or more"
    yield f"Share of the ratios in {low:g} to {high:g}", found, limit, share >= least_share


def _axes(run: TableRun) -> str:
    scene = run.test.scene
    return "x" + ("y" if scene.ay_mps2.size else "") + ("z" if scene.az_mps2.size else "")


def _mus(run: TableRun) -> str:
    law = run.test.scene.friction
    return f"{law.mu_slow:g}" if law.is_constant else f"{law.mu_slow:g}, {law.mu_static:g}"
