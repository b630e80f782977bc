"""The comparison with shake-table tests: acceptance, tests, result; or that there are none."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

from report.document.sections import Section
from report.document.tables import by_name, grouped, listed
from report.entities.shown import centered, text, words
from report.figures.shake_table import computed_against_measured
from report.manual.summary import judged
from report.words.counts import joined
from report.words.units import number
from report.words.validation import NOT_VALIDATED, explained
from solver.verification.evidence import Verification
from solver.verification.shake_table import (
    LEAST_M,
    LEAST_TESTS,
    MEDIAN,
    RATIOS,
    SHARE,
    ShakeTable,
    TableRun,
)

_TEST = (
    (words("Test", 1.6), lambda run: run.test.name),
    (words("Axes", 0.7), lambda run: _axes(run)),
    (text("θ", "deg", 0.6), lambda run: f"{math.degrees(run.test.scene.slope_rad):.3g}"),
    (text("μ", share=0.9), lambda run: _mus(run)),
    (text("Model", share=0.7), lambda run: int(run.model)),
    (text("PRD, stated", "mm"), lambda run: _mm(run.test.prd_m)),
    (text("PRD, computed", "mm", 1.1), lambda run: _prd(run)),
    (text("Ratio", share=0.7), lambda run: number(run.ratio, 3)),
    (text("Residual, stated", "mm", 1.1), lambda run: _mm(run.test.residual_m)),
    (text("Residual, computed", "mm", 1.2), lambda run: _mm(run.residual_m)),
)

_JUDGED = (
    (words("Requirement", 3.0), lambda row: row[0]),
    (text("Found", share=1.2), lambda row: row[1]),
    (text("Accepted", share=1.4), lambda row: row[2]),
    (centered("Result", 0.8), lambda row: judged(row[3])),
)


def shake_table(verification: Verification) -> Section:
    """Return the section."""
    return Section(
        id="shake-table",
        title="Comparison with a shake table",
        template="manual/shake-table.html",
        content={
            "MEDIAN": MEDIAN,
            "SHARE": SHARE,
            "RATIOS": RATIOS,
            "LEAST_TESTS": LEAST_TESTS,
            "LEAST_M": LEAST_M,
            "explained": explained(()),
            "tables": [
                (
                    table,
                    grouped(by_name(table.runs, _source), _TEST, kind="compact"),
                    listed(_rows(table), _JUDGED),
                    result(table),
                )
                for table in verification.tables
            ],
        },
        charts=dict(_charts(verification.tables)),
    )


def _charts(tables: Sequence[ShakeTable]) -> Iterator[tuple[str, str]]:
    for table in tables:
        if any(run.ratio > 0.0 for run in table.runs):
            yield "shake-table", computed_against_measured(table)


def result(table: ShakeTable) -> str:
    """Return whether the acceptance is satisfied, and what follows from it."""
    words = "The acceptance is satisfied." if table.is_accepted else (
        f"The acceptance is not satisfied: {joined(list(_unsatisfied(table)))}."
    )  # fmt: skip
    return words if table.validates else f"{words} {NOT_VALIDATED}"


def _unsatisfied(table: ShakeTable) -> Iterator[str]:
    for name, found, limit, is_satisfied in _rows(table):
        if not is_satisfied:
            yield f"{name[0].lower()}{name[1:]}, {found} instead of {limit}"


def _rows(table: ShakeTable) -> Iterator[tuple[str, str, str, bool]]:
    """Yield what is required, what was found, what is accepted, and whether it is."""
    count, share, (low, high) = table.ratios.size, 100.0 * table.share_within, MEDIAN
    named = f"Share of the ratios in {RATIOS[0]:g} to {RATIOS[1]:g}"
    yield "Number of ratios", str(count), f"{LEAST_TESTS} or more", count >= LEAST_TESTS
    is_within = low <= table.median <= high
    yield "Median ratio", number(table.median, 3), f"{low:g} to {high:g}", is_within
    yield named, f"{share:.0f} %", f"{100.0 * SHARE:g} % or more", table.share_within >= SHARE


def _source(run: TableRun) -> str:
    return f"Slip {run.test.data}: {run.test.source}"


def _axes(run: TableRun) -> str:
    scene = run.test.scene
    return "x" + ("y" if scene.ay_mps2.size else "") + ("z" if scene.az_mps2.size else "")


def _mus(run: TableRun) -> str:
    law = run.test.scene.friction
    return f"{law.mu_slow:g}" if law.is_constant else f"{law.mu_slow:g}, {law.mu_static:g}"


def _prd(run: TableRun) -> str:
    return run.status.value if math.isnan(run.prd_m) else _mm(run.prd_m)


def _mm(value_m: float) -> str:
    return number(1e3 * value_m, 1)
