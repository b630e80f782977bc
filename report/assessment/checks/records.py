"""Whether records end where they began, and ground motions keep to long periods."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from functools import partial

import numpy as np

from report.assessment.checks.check import THIS_PROGRAM, Actor, Check, Sense, condition
from report.assessment.design.words import NOT_GIVEN, STAYS
from report.motions.history import PreparedMotion, targets
from report.project.check.motion_faults import FIELDS
from report.project.model import ProjectInput
from report.project.model.place import Place
from report.text.amounts import capacity, demand
from report.text.units import G_MPS2, Quantity
from solver.records.acceptance import POINTS_HZ, spectrum_mps2

# Final displacement of a record [m] above which it drifts: the block would follow it as slip.
DRIFT_M = 0.010

# Periods from which on the mean of the ground motions / their target is compared, and the ratio
# above which a peer reviewer must accept the motions: in no code.
LONG_PERIOD_S, MOST_LONG_RATIO = 1.0, 2.0


def of_records(data: ProjectInput, prepared: Sequence[PreparedMotion]) -> Iterator[Check]:
    """Yield whether records end where they began, and ground motions keep to long periods."""
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
        remedy=f"A permanent displacement is computed as slip. {STAYS}"
        if motion.drift_basis
        else "Correct the baseline of the record, whose drift is computed as slip, or state on the "
        "Motions worksheet by whom and by what source the displacement is permanent.",
        places=(Place("motions", index, FIELDS[component]),),
    )


def drifts(prepared: PreparedMotion) -> bool:
    """Whether any component of a motion ends away from where it began."""
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
                (ratio, where), (float(ratios[index]), f"{name}, at {periods_s[index]:.3g} s")
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
            title=f"Mean of the ground motions / target ({target.name}), {LONG_PERIOD_S:g} to 10 s",
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
            else f"no target from {LONG_PERIOD_S:g} s on",
            is_satisfied=False,
            remedy="Enter S_1 and F_v, or S_D1, and T_L; or a spectrum up to 10 s.",
        )
