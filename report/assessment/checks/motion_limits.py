"""The limits on the motions of an analysis, and how motions reach them."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace
from operator import attrgetter

from report.assessment.checks.check import MOTIONS_ID, Check
from report.assessment.checks.rule_limits import of_limit
from report.assessment.design.words import STAYS
from report.motions.history import PreparedMotion
from report.motions.prepare import Shaking
from report.project.model.place import Place
from report.text.command_line import quoted
from report.text.grouping import grouped_by, ids_by
from report.text.names import ranged
from report.text.units import digits_up
from solver.records.acceptance import FULL_RATIO, Acceptance
from solver.rules.limit import PROGRAM, Consequence, Limit, Measure

# Final displacement [m] and velocity [m/s] above which it is not accepted: in no code. A fault may
# move the ground by more, and no ground keeps moving.
MOST_DRIFT_M, MOST_END_MPS = 0.5, 0.1
_DRIFT_TITLES = (
    "Final displacement of each component, unless it is stated to be permanent",
    "Final velocity of each component",
)

# Above it, records that are scaled to a target are of another intensity than it.
MOST_FACTOR = 2.0


def of_acceptance(
    acceptance: Acceptance, analyzed: Sequence[str], shaking: Shaking
) -> Iterator[Check]:
    """Yield the limits on the motions; `analyzed` are the arrays that take the analysis route."""
    # The way out is said once, at the first of the spectral limits.
    spectral = next(filter(_is_spectral, acceptance.missed), None)
    for limit in acceptance.rows:
        # The prescriptive displacement rests on no motion: there a miss is a condition only.
        is_ng = limit.consequence is Consequence.NG
        way = _ways(acceptance, shaking) if limit is spectral else _ways_of_drift(limit, shaking)
        yield replace(
            of_limit(limit),
            id=MOTIONS_ID,
            arrays=tuple(analyzed) if is_ng else (),
            consequence=limit.consequence if analyzed else Consequence.CONDITION,
            is_capacity=False,
            remedy="" if limit.ok else _remedy(is_ng=is_ng, has_analysis=bool(analyzed)) + way,
            places=(Place("motions"),),
        )


def _remedy(*, is_ng: bool, has_analysis: bool) -> str:
    if not is_ng:
        show = "Show that the duration of strong motion is sufficient, or replace the motions."
        return f"{show} {STAYS}"
    why = (
        "until then the analysis displacement is not permitted"
        if has_analysis
        else "the prescriptive displacement is compared with the runs under them"
    )
    return f"Replace or complete the motions: {why}."


def _ways(acceptance: Acceptance, shaking: Shaking) -> str:
    """Return how records reach the target: by a factor, if one does, and by motions of them."""
    ways, common = "", _factor(acceptance)
    if common <= MOST_FACTOR:
        factors = ids_by(shaking.motions, lambda motion: digits_up(motion.scale * common, 4))
        listed = "; ".join(f"{ranged(ids)} {factor}" for factor, ids in factors.items())
        ways = (
            f" With {digits_up(common, 3)} times their factors they reach it: set Scaling to factor"
            f" on the Motions worksheet, and the factors {listed}."
        )
    are_records = not any(motion.is_generated for motion in acceptance.motions)
    if are_records and all(file.is_file for file in shaking.records):
        files = grouped_by(shaking.records, attrgetter("motion_id")).values()
        seeds = " ".join(quoted(",".join(file.name for file in names)) for names in files)
        ways += (
            " Or clear their rows on the Motions worksheet and generate motions from them that"
            " reach it, in the folder of the workbook: roofslip motion suite matched --into ."
            f" --records {seeds}"
        )
    return ways


def _ways_of_drift(missed: Limit, shaking: Shaking) -> str:
    """Return which records end elsewhere or in motion, and what would do; empty for another."""
    if missed.title not in _DRIFT_TITLES:
        return ""
    ids = [
        motion.motion_id
        for motion in shaking.prepared
        if any(not limit.ok for limit in drift_limits([motion]))
    ]
    return f" Correct the baseline of {ranged(ids)} (Baseline or High-pass corner on its row)."


def drift_limits(prepared: Sequence[PreparedMotion]) -> tuple[Limit, ...]:
    """Return the limits on where the components of the motions end, and how fast they are then."""
    free = [motion for motion in prepared if not motion.drift_basis]

    def largest(motions: Sequence[PreparedMotion], end: str) -> tuple[float, str]:
        largest_end = (0.0, "")
        for motion in motions:
            for name, measures in motion.measures.items():
                value = round(abs(getattr(measures, end)), 9)
                largest_end = max(largest_end, (value, f"{motion.motion_id}, {name}"))
        return largest_end

    ends = (
        (*largest(free, "final_displacement_m"), MOST_DRIFT_M, Measure.LENGTH_M),
        (*largest(prepared, "final_velocity_mps"), MOST_END_MPS, Measure.VELOCITY_MPS),
    )
    return tuple(
        Limit(
            title=title,
            found=found,
            limit=limit,
            is_at_least=False,
            measure=measure,
            provision=PROGRAM,
            worst=worst if found > 0.0 else "",
        )
        for title, (found, worst, limit, measure) in zip(_DRIFT_TITLES, ends, strict=True)
    )


def _is_spectral(row: Limit) -> bool:
    """Whether a limit is on a spectrum over its target, or on how many of its points are below."""
    return row.is_ratio_to_target or (row.measure is Measure.COUNT and not row.is_at_least)


def _factor(acceptance: Acceptance) -> float:
    """Return a factor of all motions with which they satisfy every limit on their spectra."""
    ratios = [row for row in acceptance.rows if row.is_ratio_to_target]
    is_dipping = any(_is_spectral(row) and row not in ratios for row in acceptance.missed)
    # Points below 1.00 are counted from 1.3 Hz on: a factor with which none is needs no count.
    return max(
        (FULL_RATIO if is_dipping and not row.is_program_limit else row.limit) / row.found
        if row.found > 0.0
        else math.inf
        for row in ratios
    )
