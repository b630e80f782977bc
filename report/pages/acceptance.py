"""Acceptance of the motions: the limits on them, their strong motion and correlations.

Formats finished results: `solver.records.acceptance` has the limits. Read `acceptance_table`.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import partial

from report.assessment.checks.check import MOTIONS_ID, THIS_PROGRAM
from report.assessment.checks.sentence import texts
from report.assessment.support.response_spectra import LEAST_MEAN, Spectra
from report.document.columns import plain, text, words
from report.document.tables import Column, Table, by_place, listed, stamp
from report.pages.parts import MOTION_ROWS, PackageData
from report.text.units import number
from solver.records.acceptance import Acceptance, MotionStrength

_COMPONENTS = ("x", "y", "z")
_PAIRS = ("x-y", "x-z", "y-z")
_STRENGTHS = (("Arias intensity, m/s", 2, "arias_mps"), ("D5-95, s", 1, "d5_95_s"))


def acceptance_table(package: PackageData) -> Table:
    """Return every limit on the motions: found, limit, location, OK or consequence."""

    columns = by_place(
        words("Limit", 4.4),
        text("Found", share=1.35),
        text("Required", share=1.35),
        words("Governing", 1.1),
        words("Verdict", 0.75),
    )
    rows = [
        (
            # The note below the table: AC156 has limits from 1.3 Hz up, but slow shaking drives
            # sliding.
            f"{check.title} *" if check.clause == THIS_PROGRAM else check.title,
            *texts(check, package.fmt.us_first),
            check.note or "—",
            stamp(check.verdict),
        )
        for check in package.assessment.checks
        if check.id == MOTIONS_ID
    ]
    return listed(rows, columns, package.fmt, kind="compact")


def lowest_between(
    acceptance: Acceptance, spectra: Sequence[Spectra]
) -> tuple[float, str, float, str] | None:
    """Return the smallest ratio shown, if it is less than at the points of the limits.

    With the motion, the period [s] and the component: the spectra shown are at more periods.
    """
    at_points = [row.found for row in acceptance.rows if row.is_ratio_to_target]
    ratios = [(*part.lowest, part.title) for part in spectra if not part.is_ground]
    # Points of the limits are a grid: between them a spectrum may fall lower, and is said to.
    lowest = min(ratios, default=(math.inf, "", 0.0, ""))
    return lowest if lowest[0] < min([*at_points, LEAST_MEAN]) else None


def strength_table(package: PackageData) -> Table:
    """Return Arias intensity, significant duration and correlations of each motion."""

    def strength(motion: MotionStrength, name: str, field: str) -> float:
        return getattr(motion.strengths.get(name), field, math.nan)

    def correlation(motion: MotionStrength, pair: str) -> str:
        return number(motion.correlations.get(pair, math.nan), 2)

    def hold(motion: MotionStrength) -> str:
        return number(motion.hold_s, 1) if motion.is_generated else "record"

    columns: list[Column] = [(words("Motion", 1.1), lambda motion: motion.id)]
    for head, decimals, field in _STRENGTHS:
        for name in _COMPONENTS:
            strength_of = partial(strength, name=name, field=field)
            columns.append((plain(head, decimals, name), strength_of))
    for pair in _PAIRS:
        columns.append((text("Correlation", pair), partial(correlation, pair=pair)))
    columns.append((text("Hold", "s", 0.9), hold))
    motions = package.assessment.acceptance.motions
    return listed(motions, columns, package.fmt, kind="compact", whole_rows=MOTION_ROWS)
