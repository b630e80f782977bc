"""The part on roof motions: list, processing, response spectra and target."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence

import numpy as np
from markupsafe import Markup, escape

from report.assessment.conditions import DRIFT_M, drifts
from report.assessment.evidence import Evidence
from report.assessment.highpass import Beyond
from report.assessment.spectra import (
    MOST_EXCESS,
    PRINTED_S,
    Departure,
    Spectra,
    departures,
)
from report.document.tables import Table, TableRow, Wide
from report.entities.columns import TableColumn
from report.motions.components import RecordFile
from report.motions.history import PreparedMotion
from report.motions.targets import OWN
from report.pages.acceptance import acceptance_table, event_table, frequency, strength_table
from report.pages.building import building_part
from report.pages.parts import PackageData
from report.pages.symbols import with_symbols
from report.sheet.schema import RecordedAt
from report.typeset.equations import symbol
from report.words.units import G_MPS2, number
from solver.model import Floats, Motion
from solver.records.processing import AS_RECORDED
from solver.records.spectrum_acceptance import POINTS_HZ
from solver.rules.spectra import Tail


def below(package: PackageData) -> tuple[tuple[str, str], ...]:
    """Return the parts below, in order."""
    ground = (("motions-building", "From ground to roof"),) if has_ground(package) else ()
    return (
        ("motions-list", "Motions"),
        ("motions-limits", "Limits on the motions"),
        ("motions-processing", "Processing and drift"),
        *ground,
        ("motions-spectra", "Response spectra"),
    )


def has_ground(package: PackageData) -> bool:
    """Whether any motion is given at the ground."""
    return any(row.recorded_at is RecordedAt.GROUND for row in package.data.motions)


def motion_table(motions: Sequence[Motion], preparations: Sequence[PreparedMotion]) -> Table:
    """Return the list of the motions as run."""
    grounds = [prepared.recorded_at is RecordedAt.GROUND for prepared in preparations]
    where = [TableColumn(head="Given at", align="left", share=1.25)] if any(grounds) else []
    return Table(
        caption="Roof motions as run, after scaling",
        columns=(
            TableColumn(head="Motion", align="left", share=0.9),
            TableColumn(head="Source", align="left", share=3.5),
            *where,
            TableColumn(head="Peak [g]", unit="record", share=1.0),
            TableColumn(head="Peak [g]", unit="transv.", share=1.0),
            TableColumn(head="Peak [g]", unit="vertical", share=1.1),
            TableColumn(head="Step", unit="s", share=1.1),
            TableColumn(head="Duration", unit="s", share=1.1),
            TableColumn(head="Scaling", align="left", share=1.35),
            TableColumn(head="Factor", share=0.8),
            TableColumn(head="Polarity", align="center", share=1.0),
        ),
        rows=tuple(
            _motion_row(motion, prepared, with_place=any(grounds))
            for motion, prepared in zip(motions, preparations, strict=True)
        ),
        kind="compact",
    )


def _motion_row(motion: Motion, prepared: PreparedMotion, *, with_place: bool) -> TableRow:
    peaks = (motion.ax_mps2, motion.ay_mps2, motion.az_mps2)
    return TableRow(
        cells=(
            motion.id,
            with_symbols(motion.source or "—"),
            *([prepared.recorded_at.value] if with_place else []),
            *(_peak(values, motion.scale) for values in peaks),
            f"{motion.dt_s:.3g}",
            number((len(motion.ax_mps2) - 1) * motion.dt_s, 2),
            prepared.scaling,
            f"{motion.scale:.4g}",
            "both" if len(motion.signs) == 2 else "+" if motion.signs[0] > 0 else "−",
        )
    )


def _peak(values: Floats, scale: float) -> str:
    return number(float(np.abs(values).max() * abs(scale) / G_MPS2), 3) if len(values) else "none"


def drift_table(package: PackageData, preparations: Sequence[PreparedMotion]) -> Table:
    """Return the processing of each motion and its residual drift."""
    unit = package.fmt.units()[0]
    names = ("horizontal", "transverse", "vertical")
    short = {"horizontal": "record", "transverse": "transv.", "vertical": "vertical"}
    limit = package.fmt.both(DRIFT_M)
    return Table(
        caption="Processing, and final velocity and displacement of each component",
        columns=(
            TableColumn(head="Motion", align="left", share=1.1),
            TableColumn(head="Processing", align="left", share=3.6),
            *(
                TableColumn(head=f"Velocity, {unit.symbol}/s", unit=short[name], share=0.9)
                for name in names
            ),
            *(
                TableColumn(head=f"Displacement, {unit.symbol}", unit=short[name], share=0.9)
                for name in names
            ),
            TableColumn(head="Drift", align="left", share=0.9),
        ),
        rows=tuple(_drift_row(prepared, names, unit.si) for prepared in preparations),
        notes=(
            "Each component at the place of its record, ground or roof, after processing and "
            "scaling. Drift in the input becomes slip: a motion is marked where a component has a "
            f"final displacement of more than {limit}.",
        ),
        kind="compact",
    )


def drift_sentence(package: PackageData, preparations: Sequence[PreparedMotion]) -> str:
    """Return the same as text if all motions are as recorded and none drifts; else nothing."""
    if any(drifts(prepared) or prepared.done != AS_RECORDED for prepared in preparations):
        return ""
    unit = package.fmt.units()[0]
    measures = [m for prepared in preparations for m in prepared.measures.values()]
    speed = max(abs(m.final_velocity_mps) for m in measures) / unit.si
    place = max(abs(m.final_displacement_m) for m in measures) / unit.si
    return (
        "All motions are run without trimming, filtering or baseline correction. The "
        f"final velocity of every component is at most {number(speed, 2)} {unit.symbol}/s and its "
        f"final displacement at most {number(place, 2)} {unit.symbol}: none drifts. Drift in the "
        "input would become slip; a final displacement of more than "
        f"{package.fmt.both(DRIFT_M)} would be marked."
    )


def _drift_row(prepared: PreparedMotion, names: Sequence[str], si: float) -> TableRow:
    measures = [prepared.measures.get(name) for name in names]
    speeds = ("none" if m is None else number(m.final_velocity_mps / si, 2) for m in measures)
    places = ("none" if m is None else number(m.final_displacement_m / si, 2) for m in measures)
    return TableRow(
        cells=(
            prepared.motion_id,
            prepared.done,
            *speeds,
            *places,
            Markup("<b>drifts</b>") if drifts(prepared) else "none",
        )
    )


def beyond_table(package: PackageData, beyond: Sequence[Beyond]) -> Table:
    """Return the part of the slip caused by periods that a high-pass filter removes."""
    fmt = package.fmt
    return Table(
        caption=f"Effect of the high-pass filter: PRD of array {package.governing.id}",
        columns=(
            TableColumn(head="Motion", align="left", share=1.2),
            TableColumn(head="Corner", unit="Hz"),
            TableColumn(head="Period", unit="s"),
            *fmt.columns("With the high-pass, as run", share=1.3),
            *fmt.columns("Without it", share=1.3),
            TableColumn(head="Removed", unit="%", share=1.2),
        ),
        rows=tuple(
            TableRow(
                cells=(
                    run.motion_id,
                    f"{run.corner_hz:g}",
                    f"{1.0 / run.corner_hz:.3g}",
                    *fmt.cells(run.filtered_m),
                    *fmt.cells(run.unfiltered_m),
                    "—" if math.isnan(run.share) else number(100.0 * run.share, 0),
                )
            )
            for run in beyond
        ),
        notes=(
            "The same motion at the same scale, with and without the high-pass filter: the largest "
            "PRD of all runs. A negative value means that the filter increases the PRD. The filter "
            "may remove ground motion as well as instrument drift: review the corner frequency.",
        ),
        kind="compact",
    )


def spectrum_table(spectra: Sequence[Spectra]) -> Table:
    """Return target, achieved ordinates and their ratios at a few periods, by component."""
    return Table(
        caption="Pseudo-acceleration, 5 % damping, achieved and target",
        columns=(
            TableColumn(head="Period", align="left", share=2.9),
            *(
                TableColumn(head=f"{period:g} s", unit=f"{1 / period:.3g} Hz")
                for period in PRINTED_S
            ),
        ),
        rows=tuple(row for part in spectra for row in _spectrum_rows(part)),
        kind="compact",
    )


def _spectrum_rows(part: Spectra) -> Sequence[TableRow]:
    at = [int(np.argmin(np.abs(part.periods_s - period))) for period in PRINTED_S]
    target, sa = part.target_g[at], part.sa_g[:, at]
    count = f"{len(part.ids)} motion{'s' if len(part.ids) > 1 else ''}"
    title = Markup("<b>{}</b>").format(part.title)
    head = TableRow(cells=(Wide(title, 1 + len(PRINTED_S)),), kind="total group")
    mean = _ordinates(f"Mean of {count} [g]", sa.mean(axis=0))
    if not part.target.name:
        return head, mean
    share = sa / target
    return (
        head,
        _ordinates(f"Target, {part.target.name} [g]", target),
        mean,
        _ordinates("Mean / target", share.mean(axis=0), decimals=2),
        _ordinates("Smallest motion / target", share.min(axis=0), decimals=2),
        _ordinates("Largest motion / target", share.max(axis=0), decimals=2),
    )


def _ordinates(name: str, values: Floats, *, decimals: int = 3) -> TableRow:
    return TableRow(cells=(name, *(number(float(value), decimals) for value in values)))


def achieved_table(spectra: Sequence[Spectra]) -> Table:
    """Return the ratios of the motions to the target over the band, a row per component."""
    return Table(
        caption=f"Achieved / target, 0.1 to 33.3 Hz, at the {len(POINTS_HZ)} points of the limits",
        columns=(
            TableColumn(head="Component", align="left", share=1.7),
            TableColumn(head="Motions", share=0.9),
            TableColumn(head="Mean of motions", unit="min.", share=0.9),
            TableColumn(head="Mean of motions", unit="max.", share=0.9),
            TableColumn(head="Mean below 1.3 Hz", unit="min.", share=0.9),
            TableColumn(head="Mean below 1.3 Hz", unit="max.", share=0.9),
            TableColumn(head="Single motion", unit="min.", share=0.7),
            TableColumn(head="Single motion", unit="motion, Hz", align="left", share=1.6),
            TableColumn(head="Single motion", unit="max.", share=0.7),
            TableColumn(head="Single motion", unit="motion, Hz", align="left", share=1.6),
        ),
        rows=tuple(_achieved(part) for part in spectra if part.in_band.any()),
        kind="compact",
    )


def _achieved(part: Spectra) -> TableRow:
    periods = part.periods_s[part.in_band]
    each = (part.sa_g / part.target_g)[:, part.in_band]
    mean = each.mean(axis=0)
    slow = mean[periods >= 1 / 1.3]
    return TableRow(
        cells=(
            part.title,
            str(len(part.ids)),
            *(_extreme(values, fold) for values in (mean, slow) for fold in (np.min, np.max)),
            *(text for at in (each.argmin(), each.argmax()) for text in _single(part, each, at)),
        )
    )


def _extreme(values: Floats, fold: Callable[[Floats], float]) -> str:
    return number(float(fold(values)), 2) if values.size else "—"


def _single(part: Spectra, each: Floats, at: np.intp) -> tuple[str, str]:
    """Return one ratio, with the motion and the frequency at which it occurs."""
    motion, period = np.unravel_index(at, each.shape)
    return (
        number(float(each[motion, period]), 2),
        f"{part.ids[motion]}, {1.0 / part.periods_s[part.in_band][period]:.3g}",
    )


def target_words(package: PackageData) -> Sequence[str]:
    """Return the target spectra of the motions, a sentence each."""
    goals, tail = package.assessment.targets, Tail(package.data.target.tail)
    roof = (
        "the project-specific spectrum (workbook sheet Spectrum), which replaces that of AC156"
        if goals.roof.name == OWN
        else Markup("AC156 required response spectrum, corners in {}; {}").format(
            package.part("method"), symbol("A_FLX").join(map(escape, tail.sentence.split("A_FLX")))
        )
    )
    texts: list[str] = [
        Markup("Target at the roof: {}. Sliding is governed by long periods.").format(roof)
    ]
    if has_ground(package):
        texts.append(with_symbols(_GROUND.get(goals.ground.name, _GROUND[""])))
    return texts


def departure_sentence(found: Departure) -> str:
    """Return where the motions miss their target, and what follows."""
    return f"{departure_place(found)} {departure_effect(found)}"


def departure_place(found: Departure) -> str:
    """Return where the motions miss their target, and by how much."""
    first, *others = found.titles
    also = f" ({'; '.join(others).lower()} likewise)" if others else ""
    ratio, at = number(found.ratio, 2), f"at {frequency(found.period_s)}"
    where = (
        "there alone"
        if found.from_s == found.to_s
        else f"from {1.0 / found.to_s:.3g} to {frequency(found.from_s)}"
    )
    if found.is_short:
        return (
            f"{first}{also}: the mean of the motions falls to {ratio} times the target "
            f"({found.target}) {at}; it is below the target {where}."
        )
    return (
        f"{first}{also}: the mean of the motions reaches {ratio} times the target "
        f"({found.target}) {at}; it exceeds {number(MOST_EXCESS, 2)} times the target {where}."
    )


def departure_effect(found: Departure) -> str:
    """Return what follows from motions that miss their target."""
    if found.is_short:
        return (
            "Weaker shaking gives smaller displacements: scale or replace the motions, or justify "
            "the difference."
        )
    return "The displacements are those of the stronger motions, and are not reduced."


_GROUND = {
    OWN: "Target of ground motions: the project-specific spectrum (workbook sheet Spectrum).",
    "": "Ground motions have no target: the workbook gives neither a spectrum nor S_1, F_v and "
    "T_L for the design spectrum of ASCE 7.",
    "ASCE 7 design spectrum": "Target of ground motions: the two-period design response spectrum "
    "of ASCE 7, 11.4.6.",
}


def _notes(records: Sequence[RecordFile]) -> Sequence[str]:
    """Return the notes from reading the records, without repetition within a motion."""
    notes = (f"Motion {row.motion_id}: {note}" for row in records for note in row.notes)
    return tuple(dict.fromkeys(f"{text.rstrip('.')}." for text in notes))


def page(package: PackageData, evidence: Evidence) -> Mapping[str, object]:
    """Return the part on motions, without its charts."""
    shaking, spectra = package.assessment.shaking, evidence.spectra
    motions, preparations, beyond = shaking.motions, shaking.prepared, evidence.highpass
    return {
        "table": motion_table(motions, preparations),
        "notes": _notes(shaking.records),
        "undisturbed": drift_sentence(package, preparations),
        "drift": drift_table(package, preparations),
        "beyond": [beyond_table(package, beyond)] if beyond else [],
        "building": building_part(package, motions, preparations) if has_ground(package) else None,
        "target": (*target_words(package), *map(departure_sentence, departures(spectra))),
        "achieved": achieved_table(spectra),
        "spectra": spectrum_table(spectra),
        "events": event_table(package.data.motions),
        "acceptance": acceptance_table(package.assessment.acceptance, spectra),
        "strength": strength_table(package.assessment.acceptance.motions),
    }
