"""The part on roof motions: what they are, what was done to them, their spectra and the target."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence

import numpy as np
from markupsafe import Markup, escape

from report.assessment.evidence import Evidence
from report.assessment.highpass import Beyond
from report.assessment.spectra import PRINTED_S, Spectra
from report.motions.components import RecordFile
from report.motions.history import PreparedMotion
from report.motions.targets import OWN
from report.pages.building import building_part
from report.pages.parts import PackageData, Table, TableColumn, TableRow
from report.sheet.schema import RecordedAt
from report.typeset.equations import symbol
from report.words.units import G_MPS2, number
from solver.model import Floats, Motion
from solver.records.processing import AS_RECORDED
from solver.rules.spectra import Tail

DRIFT_M = 0.010
"""Displacement left at the end from which a component is marked."""


def below(package: PackageData) -> tuple[tuple[str, str], ...]:
    """Return the parts below, in order."""
    ground = (("motions-building", "From ground to roof"),) if has_ground(package) else ()
    return (
        ("motions-list", "Motions"),
        ("motions-processing", "Processing and drift"),
        *ground,
        ("motions-spectra", "Response spectra"),
    )


def has_ground(package: PackageData) -> bool:
    """Whether any motion was recorded on the ground."""
    return any(row.recorded_at is RecordedAt.GROUND for row in package.data.motions)


def motion_table(motions: Sequence[Motion], preparations: Sequence[PreparedMotion]) -> Table:
    """Return what each motion is, as run."""
    grounds = [prepared.recorded_at is RecordedAt.GROUND for prepared in preparations]
    where = [TableColumn(head="From", align="left", share=0.9)] if any(grounds) else []
    return Table(
        caption="Roof motions as run, after scaling",
        columns=(
            TableColumn(head="Motion", align="left", share=1.0),
            TableColumn(head="Source", align="left", share=3.7),
            *where,
            TableColumn(head="Peak", unit="record, g", share=0.95),
            TableColumn(head="Peak", unit="transv., g", share=0.95),
            TableColumn(head="Peak", unit="vertical, g", share=1.0),
            TableColumn(head="Step", unit="s", share=0.7),
            TableColumn(head="Duration", unit="s", share=0.85),
            TableColumn(head="Scaling", align="left", share=1.5),
            TableColumn(head="Factor", share=0.8),
            TableColumn(head="Polarity", align="center", share=0.85),
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
            motion.source or "—",
            *([prepared.recorded_at.value] if with_place else []),
            *(_peak(values, motion.scale) for values in peaks),
            f"{motion.dt_s:.4g}",
            number((len(motion.ax_mps2) - 1) * motion.dt_s, 2),
            prepared.scaling,
            f"{motion.scale:.4g}",
            "both" if len(motion.signs) == 2 else "+" if motion.signs[0] > 0 else "−",
        )
    )


def _peak(values: Floats, scale: float) -> str:
    return number(float(np.abs(values).max() * abs(scale) / G_MPS2), 3) if len(values) else "none"


def drift_table(package: PackageData, preparations: Sequence[PreparedMotion]) -> Table:
    """Return what was done to each motion, and the drift that is left in it."""
    unit = package.fmt.units()[0]
    names = ("horizontal", "transverse", "vertical")
    short = {"horizontal": "record", "transverse": "transv.", "vertical": "vertical"}
    limit = package.fmt.both(DRIFT_M)
    return Table(
        caption="Processing, and what is left at the end of each component",
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
            "Each component where it was recorded, processed and scaled. Drift in the input "
            f"becomes slip: a motion with a component that ends more than {limit} from where it "
            "began is marked.",
        ),
        kind="compact",
    )


def drift_sentence(package: PackageData, preparations: Sequence[PreparedMotion]) -> str:
    """Return the same in words, where every motion is as recorded and none drifts; else nothing."""
    if any(drifts(prepared) or prepared.done != AS_RECORDED for prepared in preparations):
        return ""
    unit = package.fmt.units()[0]
    found = [m for prepared in preparations for m in prepared.measures.values()]
    speed = max(abs(m.final_velocity_mps) for m in found) / unit.si
    place = max(abs(m.final_displacement_m) for m in found) / unit.si
    return (
        "All motions are run as recorded: nothing is cut, filtered or taken off. At the end no "
        f"component moves faster than {number(speed, 2)} {unit.symbol}/s or lies farther than "
        f"{number(place, 2)} {unit.symbol} from where it began: none drifts. Drift in the input "
        f"would become slip, and is marked from {package.fmt.both(DRIFT_M)} on."
    )


def _drift_row(prepared: PreparedMotion, names: Sequence[str], si: float) -> TableRow:
    found = [prepared.measures.get(name) for name in names]
    speeds = ("none" if m is None else number(m.final_velocity_mps / si, 2) for m in found)
    places = ("none" if m is None else number(m.final_displacement_m / si, 2) for m in found)
    return TableRow(
        cells=(
            prepared.motion_id,
            prepared.done,
            *speeds,
            *places,
            Markup("<b>drifts</b>") if drifts(prepared) else "none",
        )
    )


def drifts(prepared: PreparedMotion) -> bool:
    """Whether a component of a motion ends away from where it began."""
    return any(abs(m.final_displacement_m) > DRIFT_M for m in prepared.measures.values())


def beyond_table(package: PackageData, found: Sequence[Beyond]) -> Table:
    """Return how much of the slip comes from periods that a high-pass takes away."""
    fmt = package.fmt
    return Table(
        caption=f"Periods beyond the high-pass corner: PRD of array {package.governing.array.id}",
        columns=(
            TableColumn(head="Motion", align="left", share=1.2),
            TableColumn(head="Corner", unit="Hz"),
            TableColumn(head="Period", unit="s"),
            *fmt.columns("With the high-pass, as run", share=1.3),
            *fmt.columns("Without it", share=1.3),
            TableColumn(head="From beyond", unit="%", share=1.2),
        ),
        rows=tuple(
            TableRow(
                cells=(
                    one.motion_id,
                    f"{one.corner_hz:g}",
                    f"{1.0 / one.corner_hz:.3g}",
                    *fmt.cells(one.filtered_m),
                    *fmt.cells(one.unfiltered_m),
                    "—" if math.isnan(one.share) else number(100.0 * one.share, 0),
                )
            )
            for one in found
        ),
        notes=(
            "The same motion at the same scale without the high-pass, all else alike. The largest "
            "run counts; where the part is negative the high-pass makes it larger. What is taken "
            "away may be motion or drift of the instrument alike: judge the corner.",
        ),
        kind="compact",
    )


def spectrum_table(part: Spectra) -> Table:
    """Return the target and what the motions have at a few periods, and the one over the other."""
    at = [int(np.argmin(np.abs(part.periods_s - period))) for period in PRINTED_S]
    target, sa = part.target_g[at], part.sa_g[:, at]
    count = f"{len(part.ids)} motion{'s' if len(part.ids) > 1 else ''}"
    rows = [_ordinates(f"Mean of {count} [g]", sa.mean(axis=0))]
    if part.target.name:
        share = sa / target
        rows = [
            _ordinates(f"Target, {part.target.name} [g]", target),
            *rows,
            _ordinates("Mean / target", share.mean(axis=0), kind="total", decimals=2),
            _ordinates("Least motion / target", share.min(axis=0), kind="total", decimals=2),
            _ordinates("Largest motion / target", share.max(axis=0), kind="total", decimals=2),
        ]
    return Table(
        caption=f"{part.title}: pseudo-acceleration, 5 % damping, achieved against the target",
        columns=(
            TableColumn(head="Period", align="left", share=2.9),
            *(
                TableColumn(head=f"{period:g} s", unit=f"{1 / period:.3g} Hz")
                for period in PRINTED_S
            ),
        ),
        rows=tuple(rows),
        kind="compact",
    )


def _ordinates(name: str, values: Floats, *, kind: str = "", decimals: int = 3) -> TableRow:
    return TableRow(cells=(name, *(number(float(value), decimals) for value in values)), kind=kind)


def achieved_table(found: Sequence[Spectra]) -> Table:
    """Return how the motions lie to the target over the band, a row for each component."""
    return Table(
        caption="Achieved over target, 0.3 to 33 Hz in 1/12 octaves",
        columns=(
            TableColumn(head="Component", align="left", share=1.7),
            TableColumn(head="Motions", share=0.9),
            TableColumn(head="Mean of motions", unit="least", share=0.9),
            TableColumn(head="Mean of motions", unit="largest", share=0.9),
            TableColumn(head="Mean below 1.3 Hz", unit="least", share=0.9),
            TableColumn(head="Mean below 1.3 Hz", unit="largest", share=0.9),
            TableColumn(head="Single motion", unit="least", share=0.7),
            TableColumn(head="Single motion", unit="of, at", align="left", share=1.6),
            TableColumn(head="Single motion", unit="largest", share=0.7),
            TableColumn(head="Single motion", unit="of, at", align="left", share=1.6),
        ),
        rows=tuple(_achieved(part) for part in found if part.in_band.any()),
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
    """Return one ratio, and which motion has it at which period."""
    motion, period = np.unravel_index(at, each.shape)
    return (
        number(float(each[motion, period]), 2),
        f"{part.ids[motion]}, {part.periods_s[part.in_band][period]:.2f} s",
    )


def target_words(package: PackageData) -> Sequence[str]:
    """Return which spectra the motions are held against, a sentence each."""
    goals, tail = package.assessment.targets, Tail(package.data.target.tail)
    roof = (
        "the project's own spectrum (sheet Spectrum of the workbook), which replaces that of AC156"
        if goals.roof.name == OWN
        else Markup("AC156 required response spectrum, corners in {}; {}").format(
            package.part("method"), symbol("A_FLX").join(map(escape, tail.sentence.split("A_FLX")))
        )
    )
    texts: list[str] = [
        Markup("Target at the roof: {}. Sliding is driven by long periods.").format(roof)
    ]
    if has_ground(package):
        texts.append(_GROUND.get(goals.ground.name, _GROUND[""]))
    return texts


_GROUND = {
    OWN: "Target of ground motions: the project's own spectrum (sheet Spectrum of the workbook).",
    "": "Ground motions have no target: the workbook gives neither a spectrum nor S_1, F_v and "
    "T_L for the design spectrum of ASCE 7.",
    "ASCE 7 design spectrum": "Target of ground motions: the design response spectrum of ASCE 7, "
    "11.4.6, of two periods.",
}


def _notes(records: Sequence[RecordFile]) -> Sequence[str]:
    """Return what is to be known of the reading of records, each once for a motion."""
    said = (f"Motion {row.motion_id}: {note}" for row in records for note in row.notes)
    return tuple(dict.fromkeys(f"{text.rstrip('.')}." for text in said))


def page(package: PackageData, evidence: Evidence) -> Mapping[str, object]:
    """Return the part on motions, without its charts."""
    shaking, found = package.assessment.shaking, evidence.spectra
    motions, preparations, beyond = shaking.motions, shaking.prepared, evidence.highpass
    return {
        "table": motion_table(motions, preparations),
        "notes": _notes(shaking.records),
        "undisturbed": drift_sentence(package, preparations),
        "drift": drift_table(package, preparations),
        "beyond": [beyond_table(package, beyond)] if beyond else [],
        "building": building_part(package, motions, preparations) if has_ground(package) else None,
        "target": target_words(package),
        "achieved": achieved_table(found),
        "spectra": tuple(spectrum_table(part) for part in found),
    }
