"""Checks of the motions of an analysis: target spectra, final displacements, long periods."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import partial
from operator import attrgetter

import numpy as np

from report.assessment.checks.check import MOTIONS_ID, THIS_PROGRAM, Actor, Check, Sense, condition
from report.assessment.checks.rule_limits import of_limit
from report.assessment.design.verdict import NOT_GIVEN, STAYS
from report.motions.components import RecordFile
from report.motions.history import PreparedMotion, Targets, targets
from report.motions.prepare import Shaking
from report.project.check.motion_faults import FIELDS
from report.project.model import ProjectInput
from report.project.model.choices import RecordedAt
from report.project.model.input_rows import Place
from report.text.amounts import capacity, demand
from report.text.command_line import quoted
from report.text.grouping import grouped_by, ids_by
from report.text.names import ranged
from report.text.units import G_MPS2, NO_BREAK, Quantity, digits_up
from solver.records.acceptance import (
    FULL_RATIO,
    POINTS_HZ,
    Acceptance,
    SpectraOf,
    acceptance,
    one_by_one,
    spectrum_mps2,
)
from solver.rules.limit import PROGRAM, Consequence, Limit, Measure

# Final displacement [m] and velocity [m/s] above which it is not accepted: in no code. A fault may
# move the ground by more, and no ground keeps moving.
MOST_DRIFT_M, MOST_END_MPS = 0.5, 0.1
_DRIFT_TITLES = (
    "Final displacement of each component, unless stated to be permanent",
    "Final velocity of each component",
)

# Above it, records that are scaled to a target are of another intensity than it.
MOST_FACTOR = 2.0


def of_acceptance(
    acceptance: Acceptance, analyzed: Sequence[str], shaking: Shaking
) -> Iterator[Check]:
    """Yield the limits on the motions; `analyzed` are the arrays with the analysis procedure."""
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
    """Return how records can reach the target: by a common factor, or as seeds of motions."""
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
            " Or clear their rows on the Motions worksheet and, in the folder of the workbook,"
            " generate motions that reach it from their records: roofslip motion suite"
            " matched --into ."
            f" --records {seeds}"
        )
    return ways


def _ways_of_drift(missed: Limit, shaking: Shaking) -> str:
    """Return the records with final displacement or velocity, and the remedy; else empty."""
    if missed.title not in _DRIFT_TITLES:
        return ""
    ids = [
        motion.motion_id
        for motion in shaking.prepared
        if any(not limit.ok for limit in drift_limits([motion]))
    ]
    return f" Correct the baseline of {ranged(ids)} (Baseline or High-pass corner on its row)."


def drift_limits(prepared: Sequence[PreparedMotion]) -> tuple[Limit, ...]:
    """Return the limits on the final displacement and velocity of the components of the motions."""
    # A displacement that a source states to be permanent is no drift; no source makes a record end
    # at a velocity.
    free = [motion for motion in prepared if not motion.drift_basis]

    def largest(motions: Sequence[PreparedMotion], end: str) -> tuple[float, str]:
        largest_end = (0.0, "")
        for motion in motions:
            for name, measures in motion.measures.items():
                # To a nanometer: rounding error at the end of a generated motion is 0, and names
                # no motion.
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
            found=end_value,
            limit=limit,
            is_at_least=False,
            measure=measure,
            provision=PROGRAM,
            worst=worst if end_value > 0.0 else "",
        )
        for title, (end_value, worst, limit, measure) in zip(_DRIFT_TITLES, ends, strict=True)
    )


def _is_spectral(row: Limit) -> bool:
    """Whether a limit is on the ratio of a spectrum to its target, or on the points below it."""
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


def shaking_acceptance(
    shaking: Shaking, targets: Targets, spectra_of: SpectraOf = one_by_one
) -> Acceptance:
    """Compare the motions as run with the targets at the roof, and with the other limits."""
    if not shaking.motions:
        return Acceptance(rows=(), motions=())
    done = acceptance(
        shaking.motions,
        [_hold_s(prepared, shaking.records) for prepared in shaking.prepared],
        lambda freq_hz: targets.roof.ordinates(1.0 / freq_hz),
        lambda freq_hz: targets.vertical.ordinates(1.0 / freq_hz),
        spectra_of,
    )
    return replace(done, rows=(*done.rows, *drift_limits(shaking.prepared)))


def _hold_s(prepared: PreparedMotion, files: Sequence[RecordFile]) -> float:
    """Hold of the envelope that all files of a motion state [s]; NaN if any does not."""
    holds = [file.hold_s for file in files if file.motion_id == prepared.motion_id]
    # The response of a building no longer has the envelope of the ground motion.
    is_stated = prepared.recorded_at is RecordedAt.ROOF and not any(map(math.isnan, holds))
    return min(holds, default=math.nan) if is_stated else math.nan


# Final displacement of a record [m] above which it drifts: the block would follow it as slip.
DRIFT_M = 0.010

# Periods from which on the mean of the ground motions / their target is compared, and the ratio
# above which a peer reviewer must accept the motions: in no code.
LONG_PERIOD_S, MOST_LONG_RATIO = 1.0, 2.0


def of_records(data: ProjectInput, prepared: Sequence[PreparedMotion]) -> Iterator[Check]:
    """Yield the checks of final displacements, and of ground motions at long periods."""
    for index, motion in enumerate(prepared):
        yield _drift(motion, index)
    yield from _ground_motions(data, prepared)


def _drift(motion: PreparedMotion, index: int) -> Check:
    ends = {name: abs(m.final_displacement_m) for name, m in motion.measures.items()}
    component = max(ends, key=ends.__getitem__)
    return condition(
        id="drift",
        title="Final displacement of the record",
        subject=motion.motion_id,
        found=demand(ends[component], Quantity.DRIFT),
        limit=capacity(DRIFT_M, Quantity.DRIFT),
        sense=Sense.AT_MOST,
        clause=THIS_PROGRAM,
        is_satisfied=not drifts(motion),
        is_capacity=False,
        note=f"permanent by {motion.drift_basis}" if motion.drift_basis else "",
        remedy="Obtain acceptance of the permanent displacement, which is computed as slip. "
        + STAYS
        if motion.drift_basis
        else "Correct the baseline of the record, whose drift is computed as slip, or state on the "
        "Motions worksheet who determined the permanent displacement, and the source.",
        places=(Place("motions", index, FIELDS[component]),),
    )


def drifts(prepared: PreparedMotion) -> bool:
    """Whether any component of a motion has a final displacement."""
    return any(abs(m.final_displacement_m) > DRIFT_M for m in prepared.measures.values())


def _ground_motions(data: ProjectInput, prepared: Sequence[PreparedMotion]) -> Iterator[Check]:
    # Sliding is driven by long periods: an excess there goes straight into the displacement.
    target, periods_s = targets(data).ground, 1.0 / POINTS_HZ
    # NaN at short periods, so that nanargmax looks at the long ones alone.
    goal_mps2 = np.where(periods_s >= LONG_PERIOD_S, G_MPS2 * target.ordinates(periods_s), math.nan)
    ratio, where = 0.0, ""
    for name in ("horizontal", "transverse"):
        records = [item.scaled[name] for item in prepared if item.roof and name in item.scaled]
        if records and np.isfinite(goal_mps2).any():
            spectra = [spectrum_mps2(record.a_mps2.tobytes(), record.dt_s) for record in records]
            ratios = np.mean(spectra, axis=0) / goal_mps2
            index = int(np.nanargmax(ratios))
            ratio, where = max(
                (ratio, where),
                (float(ratios[index]), f"{name}, at {periods_s[index]:.3g}{NO_BREAK}s"),
            )
    row = partial(
        condition,
        id="ground_motions",
        limit=capacity(MOST_LONG_RATIO),
        sense=Sense.AT_MOST,
        clause=THIS_PROGRAM,
        is_capacity=False,
        places=(Place("motions"),),
    )
    if where:
        yield row(
            title=f"Mean of the ground motions / target ({target.name}), {LONG_PERIOD_S:g} to "
            f"10{NO_BREAK}s",
            found=demand(ratio),
            note=where,
            is_satisfied=ratio <= MOST_LONG_RATIO,
            actor=Actor.REVIEWER,
            remedy="Obtain the peer reviewer's acceptance of the ground motions in writing, or use "
            f"ground motions that match the target at long periods. {STAYS}",
        )
    elif any(item.roof for item in prepared):
        values = {"S_D1": data.site.s_d1, "T_L": data.target.t_l_s}
        lacking = [name for name, value in values.items() if value is None]
        yield row(
            title="Mean of the ground motions / target at long periods",
            found=f"{' and '.join(lacking)} {NOT_GIVEN}: no target"
            if lacking and not data.spectrum
            else f"no target from {LONG_PERIOD_S:g}{NO_BREAK}s on",
            is_satisfied=False,
            remedy=f"Enter S_1 and F_v, or S_D1, and T_L; or a spectrum up to 10{NO_BREAK}s.",
        )
