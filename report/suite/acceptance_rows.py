"""The acceptance of a generated suite: its rows as text and as data."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from typing import Any

from report.suite.targets import SuiteTargets
from report.text.amounts import limit_texts
from solver.records.acceptance import Acceptance, acceptance
from solver.rules.hazard import target_sa_g
from solver.rules.limit import Limit
from solver.sliding.checked import motion
from solver.synthesis.suite import SuiteMotion


def suite_acceptance(suite: Sequence[SuiteMotion], targets: SuiteTargets) -> Acceptance:
    """Compare a suite with its targets as the motions of an analysis; motions count from 1."""
    return acceptance(
        [motion(m.x, m.y, m.z, id=f"motion-{k:02d}") for k, m in enumerate(suite, start=1)],
        [m.hold_s for m in suite],
        partial(target_sa_g, targets.horizontal),
        partial(target_sa_g, targets.vertical),
    )


def acceptance_lines(rows: Sequence[Limit]) -> list[str]:
    """Return a line for each row: OK or what follows, title, value found, limit, where."""
    lines = []
    for row in rows:
        value, limit = limit_texts(row, us_first=True)  # none is a length
        where = f" ({row.worst})" if row.worst else ""
        ours = "; not a code requirement, limit set by this program"
        lines.append(
            f"{'OK' if row.ok else row.consequence.value}: {row.title}: "
            f"{value}, {'at least' if row.is_at_least else 'at most'} {limit}{where}"
            f"{ours if row.is_program_limit else ''}"
        )
    return lines


def acceptance_facts(rows: Sequence[Limit]) -> list[dict[str, Any]]:
    """Return the rows for suite.json."""
    return [
        {
            "title": row.title,
            "found": row.found,
            "limit": row.limit,
            "unit": row.measure.value,
            "is_at_least": row.is_at_least,
            "satisfied": row.ok,
            "worst": row.worst,
            "is_ours": row.is_program_limit,
            "consequence": row.consequence.value,
        }
        for row in rows
    ]
