"""Sections that consist of tables: checks, other programs."""

from __future__ import annotations

import math
from collections.abc import Sequence

from report.document.sections import Section, section
from report.document.tables import grouped
from report.entities.shown import centered, text, words
from report.manual.summary import judged
from report.words.counts import grouped_by
from report.words.formats import percent, scientific, seconds, ten_digits, unbroken
from report.words.letters import lettered
from solver.verification.evidence import Check, PeerPoint, Verification

_CHECK = (
    (words("Problem", 3.15), lambda row: unbroken(lettered(row.problem))),
    (words("Quantity", 1.95), lambda row: _quantity(row)),
    (text("Expected", share=1.55), lambda row: ten_digits(row.expected)),
    (text("Computed", share=1.55), lambda row: ten_digits(row.computed)),
    (text("Error", share=1.1), lambda row: scientific(row.error)),
    (text("Tolerance", share=1.1), lambda row: scientific(row.tolerance)),
    (centered("Result", 0.7), lambda row: judged(row.passed)),
)

_PEER = (
    (words("Record", 2.0), lambda peer: peer.record),
    (words("Analysis case", 2.0), lambda peer: lettered(peer.scene)),
    (text("Time per run"), lambda peer: seconds(peer.seconds)),
    (text("Error in PRD"), lambda peer: _error(peer.prd_error_percent)),
)


def checks(verification: Verification) -> Section:
    """Return every check, a table for each section."""

    def source(row: Check) -> str:
        return f"{row.id}. Source: {lettered(row.source)}"

    return section(
        "manual/checks",
        "Checks",
        by_section={
            name: grouped(grouped_by(rows, source), _CHECK)
            for name, rows in grouped_by(verification.checks, lambda row: row.section).items()
        },
    )


def _quantity(row: Check) -> str:
    return row.quantity if row.unit == "1" else f"{row.quantity} [{lettered(row.unit)}]"


def peers(points: Sequence[PeerPoint]) -> Section:
    """Return the results of other programs, each run below its program and model."""
    groups = grouped_by(points, lambda peer: f"{peer.peer} {peer.version}: {peer.note}")
    return section(
        "manual/peers",
        "Other programs",
        peers=grouped(groups, _PEER),
    )


def _error(value_percent: float) -> str:
    return "failed" if math.isnan(value_percent) else percent(value_percent)
