"""From processed records to motions as run: scaled, and for ground motions transferred to the roof.

Owns the order of these steps and records what each did; the steps themselves are those of
`solver.records.spectrum` and `solver.building.roof`. Owns the target spectra that a project
requests. Read `shake` first.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from report.motions.components import Components, processing_of
from report.project.check.motion_faults import LABELS
from report.project.model import ProjectInput
from report.project.model.choices import Polarity, RecordedAt, Scaling
from report.project.model.motion_input import BuildingInput, MotionInput, SpectrumPoint
from report.text.units import G_MPS2, NO_BREAK
from solver.building.roof import RoofMotion, shaking_to_roof
from solver.building.structure import Building, building_of_periods
from solver.model import Floats, Motion
from solver.records.measures import Measures, measures
from solver.records.record import NO_RECORD, Record, read_only
from solver.records.spectrum import Target, design_spectrum, factor_to_target
from solver.rules.ac156 import RequiredSpectrum, Tail, ac156_horizontal, ac156_vertical, target_sa_g
from solver.rules.hazard import approximate_period_s

OWN = "project-specific"


@dataclass(frozen=True, slots=True, kw_only=True)
class TargetSpectrum:
    """A target spectrum, 5% damping."""

    name: str  # empty if there is no target; the ordinates are then NaN
    # Spectral acceleration [g] at frequencies [Hz]; a target given by points is constant beyond
    # them. Not a closure, so that it can be pickled.
    at: Target
    # range of periods for which it is given [s]
    from_s: float
    to_s: float

    def ordinates(self, periods_s: Floats) -> Floats:
        """Return accelerations [g] at periods [s]; NaN outside its range."""
        # The ends are inside, whatever the rounding of 1 / f makes of them.
        inside = (periods_s >= self.from_s * (1.0 - 1e-9)) & (periods_s <= self.to_s * (1.0 + 1e-9))
        return np.where(inside, self.at(1.0 / periods_s), math.nan)


@dataclass(frozen=True, slots=True, kw_only=True)
class Targets:
    """Target spectra of the roof components, and of the horizontal ground components."""

    roof: TargetSpectrum
    vertical: TargetSpectrum
    ground: TargetSpectrum

    def horizontal(self, recorded_at: RecordedAt) -> TargetSpectrum:
        """Return the target at the recording level of a motion."""
        return self.ground if recorded_at is RecordedAt.GROUND else self.roof


# A function of the module, so that workers can pickle it.
def _nowhere(freq_hz: Floats) -> Floats:
    return np.full(freq_hz.shape, math.nan)


NO_TARGET = TargetSpectrum(name="", at=_nowhere, from_s=0.0, to_s=math.inf)


def targets(data: ProjectInput) -> Targets:
    """Return the targets of a project: its own table if given, or else those of its rule set."""
    roof, vertical = ac156(data)
    points = data.spectrum
    across = _own(points, [row.horizontal_g for row in points]) if points else None
    upward = [row.vertical_g for row in points if row.vertical_g is not None]
    has_ground = any(row.recorded_at is RecordedAt.GROUND for row in data.motions)
    return Targets(
        # If there are ground motions, the project-specific spectrum applies at the ground.
        roof=across if across and not has_ground else _ac156(roof),
        vertical=_own(points, upward) if upward else _ac156(vertical),
        ground=across or _design(data),
    )


def ac156(data: ProjectInput) -> tuple[RequiredSpectrum, RequiredSpectrum]:
    """Return the AC156 spectra at the roof, horizontal and vertical."""
    site, tail = data.site, Tail(data.target.tail)
    horizontal = ac156_horizontal(
        site.edition,
        s_ds_g=site.s_ds,
        z_over_h=site.roof_height_m / site.structure_height_m,
        tail=tail,
    )
    return horizontal, ac156_vertical(s_ds_g=site.s_ds, tail=tail)


def _ac156(spectrum: RequiredSpectrum) -> TargetSpectrum:
    return TargetSpectrum(name="AC156", at=spectrum.at, from_s=0.0, to_s=1.0 / spectrum.freq_hz[0])


def _own(rows: Sequence[SpectrumPoint], sa_g: Sequence[float]) -> TargetSpectrum:
    # Points are given by period, and interpolated by frequency.
    order = np.argsort([-row.period_s for row in rows])
    freq = 1.0 / np.array([row.period_s for row in rows])[order]
    return TargetSpectrum(
        name=OWN,
        at=partial(target_sa_g, (freq, np.array(sa_g)[order])),
        from_s=float(1.0 / freq[-1]),
        to_s=float(1.0 / freq[0]),
    )


def _design(data: ProjectInput) -> TargetSpectrum:
    site, t_l_s = data.site, data.target.t_l_s
    if site.s_d1 is None or t_l_s is None:
        return NO_TARGET
    spectrum = design_spectrum(s_ds_g=site.s_ds, s_d1_g=site.s_d1, t_l_s=t_l_s)
    return TargetSpectrum(name="ASCE 7 design spectrum", at=spectrum, from_s=0.0, to_s=math.inf)


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
    drift_basis: str = ""  # who states by what that it ends elsewhere, as in the workbook


def shake(
    data: ProjectInput, by_motion: Sequence[Components]
) -> tuple[tuple[Motion, PreparedMotion], ...]:
    """Return the motions of a project as run, each with its processing and scaling.

    Raises `InputError`.
    """
    return tuple(
        _shake(data, row, components)
        for row, components in zip(data.motions, by_motion, strict=True)
    )


def _shake(
    data: ProjectInput, row: MotionInput, components: Components
) -> tuple[Motion, PreparedMotion]:
    # One factor for all components, and for the motion without its high-pass: it is the same
    # earthquake.
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
        drift_basis=row.drift_basis,
    )
    return motion, prepared


def _motion(
    data: ProjectInput, row: MotionInput, records: Mapping[str, Record], scale: float
) -> tuple[Motion, Mapping[str, RoofMotion]]:
    """Return a motion at the roof, and the roof response of each horizontal component."""
    a = {field: record.a_mps2 for field, record in records.items()}
    dt_s, roof = records["record"].dt_s, {}
    if row.recorded_at is RecordedAt.GROUND:
        # The vertical reaches the roof as it is: the model of the building is one of lateral
        # modes.
        fields = [field for field in a if field != "vertical"]
        shaking = shaking_to_roof(
            [a[field] for field in fields],
            a.get("vertical", NO_RECORD),
            dt_s,
            [_building(data, field) for field in fields],
            share=data.building.left_out_percent / 100.0,
        )
        # The response may have a smaller step than the record, by the periods of its modes.
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
    # The records are scaled already.
    return _motion(data, row, records, 1.0)[0]


def _building(data: ProjectInput, field: str) -> Building:
    """Return the building in the direction of a horizontal component."""
    asked = data.building
    periods = [first_period_s(data)]
    if field == "transverse" and asked.transverse_s is not None:
        # Across the building, no second period is asked for.
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
            # The PPA is that of the horizontal record. All components get its factor, so that their
            # ratios stay.
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
            return f"PPA {row.scale_value:g}{NO_BREAK}g"
        case Scaling.TARGET:
            asked = data.target
            return f"target, {asked.from_s:g} to {asked.to_s:g}{NO_BREAK}s"
    return row.scaling.value
