"""From processed records to motions as run: scaled, and carried to the roof for ground motions.

Owns the order of these steps and records what each did; the steps themselves are those of
`solver.records.scaling` and `solver.building.roof`. Read `shake` first.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from report.motions.components import Components, processing_of
from report.motions.targets import targets
from report.sheet.checking.motion_checks import LABELS
from report.sheet.schema import ProjectInput
from report.sheet.schema.building import BuildingInput
from report.sheet.schema.choices import Polarity, RecordedAt, Scaling
from report.sheet.schema.motions import MotionInput
from report.words.units import G_MPS2
from solver.building.periods import approximate_period_s
from solver.building.roof import RoofMotion, shaking_to_roof
from solver.building.structure import Building, building_of_periods
from solver.model import Motion
from solver.records.measures import Measures, measures
from solver.records.record import Record, read_only
from solver.records.scaling import factor_to_target
from solver.rivals.methods import NO_RECORD

SIGNS = {Polarity.BOTH: (1, -1), Polarity.AS_RECORDED: (1,), Polarity.REVERSED: (-1,)}


@dataclass(frozen=True, slots=True, kw_only=True)
class PreparedMotion:
    """Processing and scaling of the records of one motion before the runs."""

    motion_id: str
    recorded_at: RecordedAt
    done: str  # processing, in words
    scaling: str  # in words, without the factor
    # by name of the component, processed and scaled, at the recording level
    measures: Mapping[str, Measures]
    scaled: Mapping[str, Record]  # the same components as records
    # unscaled, by name of the horizontal component; empty for a motion recorded at the roof
    roof: Mapping[str, RoofMotion]
    # the motion without its high-pass filter; empty if there is none
    unfiltered: tuple[Motion, ...]


def shake(
    data: ProjectInput, by_motion: Sequence[Components]
) -> tuple[tuple[Motion, PreparedMotion], ...]:
    """Return the motions of a project as run, each with its processing and scaling.

    Raises
    ------
    InputError
    """
    return tuple(
        _shake(data, row, components)
        for row, components in zip(data.motions, by_motion, strict=True)
    )


def _shake(
    data: ProjectInput, row: MotionInput, components: Components
) -> tuple[Motion, PreparedMotion]:
    scale = _scale(data, row, components.records)
    motion, roof = _motion(data, row, components.records, scale)
    scaled = {
        LABELS[field]: replace(record, name=row.id, a_mps2=read_only(motion.scaled(record.a_mps2)))
        for field, record in components.records.items()
    }
    bare = components.unfiltered
    prepared = PreparedMotion(
        motion_id=row.id,
        recorded_at=row.recorded_at,
        done=processing_of(row).words(),
        scaling=_scaling_words(data, row),
        measures={name: measures(record) for name, record in scaled.items()},
        scaled=scaled,
        roof=roof,
        unfiltered=(_motion(data, row, bare, scale)[0],) if bare else (),
    )
    return motion, prepared


def _motion(
    data: ProjectInput, row: MotionInput, records: Mapping[str, Record], scale: float
) -> tuple[Motion, Mapping[str, RoofMotion]]:
    """Return a motion at the roof, and the roof response of each horizontal component."""
    a = {field: record.a_mps2 for field, record in records.items()}
    dt_s, roof = records["record"].dt_s, {}
    if row.recorded_at is RecordedAt.GROUND:
        fields = [field for field in a if field != "vertical"]
        shaking = shaking_to_roof(
            [a[field] for field in fields],
            a.get("vertical", NO_RECORD),
            dt_s,
            [_building(data, field) for field in fields],
            share=data.building.left_out_percent / 100.0,
        )
        dt_s, roof = shaking.dt_s, dict(zip(fields, shaking.horizontal, strict=True))
        a = {field: response.a_mps2 for field, response in roof.items()} | {
            "vertical": shaking.vertical_mps2
        }
    motion = Motion(
        id=row.id,
        source=row.source,
        dt_s=dt_s,
        ax_mps2=a["record"],
        ay_mps2=a.get("transverse", NO_RECORD),
        az_mps2=a.get("vertical", NO_RECORD),
        scale=scale,
        signs=SIGNS[row.polarity],
    )
    return motion, {LABELS[field]: response for field, response in roof.items()}


def through_building(data: ProjectInput, row: MotionInput, prepared: PreparedMotion) -> Motion:
    """Return a prepared motion, already scaled, at the roof of the building of an input."""
    named = prepared.scaled
    records = {field: named[label] for field, label in LABELS.items() if label in named}
    return _motion(data, row, records, 1.0)[0]


def _building(data: ProjectInput, field: str) -> Building:
    """Return the building in the direction of a horizontal component."""
    asked = data.building
    periods = [first_period_s(data)]
    if field == "transverse" and asked.transverse_s is not None:
        periods = [asked.transverse_s]
    elif asked.period_2_s is not None:
        periods.append(asked.period_2_s)
    return building_of_periods(
        periods,
        damping=(asked.damping_percent / 100.0,),
        alpha0=math.inf if asked.stiffness_ratio is None else asked.stiffness_ratio,
        stories=data.site.stories,
    )


def first_period_s(data: ProjectInput) -> float:
    """Return the building's first period [s]: given, or else approximate; NaN for neither."""
    asked: BuildingInput = data.building
    if asked.period_s is not None:
        return asked.period_s
    if asked.structure is None:
        return math.nan
    return approximate_period_s(asked.structure, data.site.structure_height_m)


def _scale(data: ProjectInput, row: MotionInput, records: Mapping[str, Record]) -> float:
    """Return the factor of all components, from the records at the recording level."""
    horizontals = [record for field, record in records.items() if field != "vertical"]
    match row.scaling:
        case Scaling.FACTOR:
            return float(row.scale_value or 1.0)
        case Scaling.PPA:
            peak = np.abs(records["record"].a_mps2).max()
            return float((row.scale_value or 1.0) * G_MPS2 / peak)
        case Scaling.TARGET:
            periods = (data.target.from_s, data.target.to_s)
            target = targets(data).horizontal(row.recorded_at)
            return factor_to_target(horizontals, target.at, periods)
    return 1.0


def _scaling_words(data: ProjectInput, row: MotionInput) -> str:
    match row.scaling:
        case Scaling.PPA:
            return f"PPA {row.scale_value:g} g"
        case Scaling.TARGET:
            asked = data.target
            return f"target, {asked.from_s:g} to {asked.to_s:g} s"
    return row.scaling.value
