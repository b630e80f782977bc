"""The part on roof motions: list, limits, processing, response spectra and target."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from functools import partial

import numpy as np
from markupsafe import Markup

from report.assessment.checks.motion_checks import DRIFT_M, drifts
from report.assessment.support.evidence import Evidence
from report.assessment.support.further_runs import Beyond
from report.assessment.support.response_spectra import Departure, Spectra, departures
from report.document.columns import centered, length, plain, text, words
from report.document.tables import Column, Table, headed, listed
from report.motions.history import OWN, PreparedMotion
from report.pages.acceptance import acceptance_table, lowest_between, strength_table
from report.pages.building import building_part
from report.pages.parts import MOTION_ROWS, PackageData
from report.pages.symbols import with_symbols
from report.text.grouping import grouped_by
from report.text.letter_case import lowered
from report.text.unit_format import UnitFormat
from report.text.units import G_MPS2, NO_BREAK, Unit, digits_up, number, with_unit
from report.typeset.equations import symbol
from solver.model import Floats, Motion
from solver.records.acceptance import N_AC156, N_SETS, N_SLIDING, POINTS_HZ
from solver.records.processing import AS_RECORDED
from solver.rules.ac156 import Tail
from solver.rules.limit import Consequence


def below(package: PackageData) -> tuple[tuple[str, str], ...]:
    """Return the parts below, in order."""
    ground = (("motions-building", "From ground to roof"),) if package.has_ground else ()
    return (
        ("motions-list", "Motions"),
        ("motions-limits", "Limits on the motions"),
        ("motions-processing", "Processing and drift"),
        ("motions-spectra", "Response spectra"),
        *ground,
    )


def page(package: PackageData, evidence: Evidence) -> Mapping[str, object]:
    """Return the part on motions, without its charts."""
    done, fmt = package.assessment, package.fmt
    shaking, spectra, limits = done.shaking, evidence.spectra, done.acceptance.rows
    targets, sources = done.targets, _sources(shaking.motions)
    table, alike = _motion_table(package, has_sources=not sources)
    return {
        "motions": table,
        "alike": ", ".join(f"{lowered(name)} {value}" for name, value in alike.items()),
        "sources": [
            (f" of {', '.join(ids)}" if len(sources) > 1 else "", source.rstrip("."))
            for source, ids in sources.items()
        ],
        "notes": dict.fromkeys(
            # The components of a motion often say the same.
            f"Motion {row.motion_id}: {note.rstrip('.')}."
            for row in shaking.records
            for note in row.notes
        ),
        "events": _events_table(package),
        "acceptance": acceptance_table(package),
        "has_program_limit": any(row.is_program_limit for row in limits),
        "has_target": any(row.is_ratio_to_target for row in limits),
        "has_condition": any(row.consequence is Consequence.CONDITION for row in limits),
        "n_points": len(POINTS_HZ),
        "n_sliding": N_SLIDING,
        "n_ac156": N_AC156,
        "n_sets": N_SETS,
        "between": _between(package, spectra),
        "strength": strength_table(package),
        "ends": _ends(shaking.prepared, fmt),
        "drift": _drift_table(package, fmt.units()[0]),
        "drift_limit": fmt.both(DRIFT_M),
        "highpass": _highpass_table(package, evidence.highpass) if evidence.highpass else None,
        "highpass_caption": f"Effect of the high-pass filter: PRD of array {done.governing.id}",
        "governing": done.governing.id,
        "has_own_target": targets.roof.name == OWN,
        "tail": Tail(package.data.target.tail).sentence,
        "ground_target": _ground_target(targets.ground.name) if package.has_ground else "",
        "departures": [_departure(departure) for departure in departures(spectra)],
        "building": building_part(package, evidence.building) if package.has_ground else None,
    }


def _between(package: PackageData, spectra: Sequence[Spectra]) -> str:
    """Return the lower points of a spectrum between the points of the limits; nothing if none."""
    lowest = lowest_between(package.assessment.acceptance, spectra)
    if lowest is None:
        return ""
    ratio, motion, period_s, component = lowest
    return (
        "Between the points, where no limit is checked, a spectrum may be lower; the smallest "
        f"ratio shown below is {number(ratio, 2)} ({motion}, {component.lower()}, at "
        f"{1.0 / period_s:.3g}{NO_BREAK}Hz)."
    )


def _ground_target(name: str) -> str:
    """Return the target of ground motions in a sentence."""
    if not name:
        return (
            "Ground motions have no target, because the workbook contains neither a spectrum nor "
            "S_1, F_v and T_L for the design spectrum of ASCE 7."
        )
    if name == OWN:
        return "Target of ground motions: the project-specific spectrum (Spectrum worksheet)."
    return "Target of ground motions: the two-period design response spectrum of ASCE 7, 11.4.6."


def _departure(departure: Departure) -> str:
    """Return the deviation of the mean of the motions from its target, and the consequence."""
    first, *others = departure.titles
    likewise = f" ({'; '.join(others).lower()} likewise)" if others else ""
    hertz = f"{NO_BREAK}Hz"
    place = f"{1.0 / departure.period_s:.3g}{hertz}"
    if departure.is_short:
        reaches, beyond = f"falls to {number(departure.ratio, 2)}", "is below"
        effect = (
            "Weaker shaking results in smaller displacements. Scale or replace the motions, or "
            "justify the difference."
        )
    else:
        reaches = f"reaches {digits_up(departure.ratio, 3)}"
        beyond = f"exceeds {number(departure.maximum_excess, 2)} times"
        effect = "Displacements are not reduced for this excess."
    where = f"from {1.0 / departure.to_s:.3g} to {1.0 / departure.from_s:.3g}{hertz}"
    if departure.from_s == departure.to_s:
        where = "there only"
    return (
        f"{first}{likewise}: the mean of the motions {reaches} times the target "
        f"({departure.target}) at {place}; it {beyond} the target {where}. {effect}"
    )


def _events_table(package: PackageData) -> Table | None:
    """Return the events of the records; nothing where none is given."""
    columns = (
        ("Motion", 1), ("Event", 3), ("M", 1, "right"), ("R", 1, "right", "km"),
        (symbol("V_s30"), 1, "right", "m/s"),
    )  # fmt: skip
    rows: list[Sequence[str]] = []
    for motion in package.data.motions:
        numbers = (motion.magnitude, motion.distance_km, motion.v_s30_mps)
        texts = [motion.event, *("" if value is None else f"{value:g}" for value in numbers)]
        # What is generated has no event; a table of dashes would say nothing.
        if any(texts):
            rows.append((motion.id, *(text or "not entered" for text in texts)))
    return headed(*columns, rows=rows, kind="compact", whole_rows=MOTION_ROWS) if rows else None


def _sources(motions: Sequence[Motion]) -> Mapping[str, Sequence[str]]:
    """Return the motions of each source; nothing where every motion has a source of its own."""
    by_source = grouped_by(motions, lambda motion: motion.source or "not entered")
    # Then the table has a column for it, and a list by source would repeat the table.
    if len(by_source) == len(motions) > 1:
        return {}
    return {source: [motion.id for motion in group] for source, group in by_source.items()}


def _motion_table(package: PackageData, *, has_sources: bool) -> tuple[Table, Mapping[str, str]]:
    """Return the motions, and what they all have alike, by name."""
    shaking = package.assessment.shaking
    rows = list(zip(shaking.motions, shaking.prepared, strict=True))
    files = grouped_by(shaking.records, lambda file: file.motion_id)
    source: Column = (words("Source", 3.5), lambda row: with_symbols(row[0].source))
    place: Column = (words("Recorded at", 1.25), lambda row: row[1].recorded_at.value)
    maybe_alike: Sequence[Column] = (
        (text("Step", "s", 1.1), lambda row: f"{row[0].dt_s:.3g}"),
        (
            text("Duration", "s", 1.1),
            # n samples have n - 1 steps between them.
            lambda row: number((len(row[0].ax_mps2) - 1) * row[0].dt_s, 2),
        ),
        (words("Scaling", 1.35), lambda row: row[1].scaling),
        (text("Factor", share=0.8), lambda row: f"{row[0].scale:.4g}"),
        (centered("Polarity"), lambda row: _polarity(row[0])),
    )
    alike = {}
    for head, text_of, *_ in maybe_alike:
        # Compared as printed: what reads the same in every row is in a note.
        texts = {str(text_of(row)) for row in rows}
        if len(texts) == 1:
            alike[head.head] = with_unit(texts.pop(), head.unit)
    columns = (
        (words("Motion", 0.9), lambda row: row[0].id),
        *([source] if has_sources else []),
        *([place] if package.has_ground else []),
        (plain("Peak [g]", 3, "record"), lambda row: _peak_g(row[0], row[0].ax_mps2)),
        (plain("Peak [g]", 3, "transv."), lambda row: _peak_g(row[0], row[0].ay_mps2)),
        (plain("Peak [g]", 3, "vertical", 1.1), lambda row: _peak_g(row[0], row[0].az_mps2)),
        *(column for column in maybe_alike if column[0].head not in alike),
        # Eight digits tell files apart; those of the appendix are complete.
        (
            words("SHA-256 of the files", 3.4),
            lambda row: " ".join(file.sha256[:8] for file in files[row[0].id]),
        ),
    )
    table = listed(rows, columns, package.fmt, kind="compact", whole_rows=MOTION_ROWS)
    return table, alike


def _peak_g(motion: Motion, a_mps2: Floats) -> float:
    # As run, with its scale: the file has another peak.
    return float(np.abs(motion.scaled(a_mps2)).max() / G_MPS2) if len(a_mps2) else math.nan


def _polarity(motion: Motion) -> str:
    return "both" if len(motion.signs) == 2 else "+" if motion.signs[0] > 0 else "−"


def _drift_table(package: PackageData, unit: Unit) -> Table:
    """Return the processing of each motion, and where each component ends."""
    names = {"horizontal": "record", "transverse": "transv.", "vertical": "vertical"}
    ends = {
        f"Velocity, {unit.symbol}/s": "final_velocity_mps",
        f"Displacement, {unit.symbol}": "final_displacement_m",
    }
    columns: list[Column] = [
        (words("Motion", 1.1), lambda prepared: prepared.motion_id),
        (words("Processing", 3.6), lambda prepared: prepared.done),
    ]
    for head, end in ends.items():
        for name, short_name in names.items():
            final = partial(_final, name=name, end=end, si=unit.si)
            columns.append((plain(head, unit=short_name, share=0.9), final))
    drift = Markup("<b>drifts</b>")
    columns.append((words("Drift", 0.9), lambda prepared: drift if drifts(prepared) else "none"))
    prepared = package.assessment.shaking.prepared
    return listed(prepared, columns, package.fmt, kind="compact", whole_rows=MOTION_ROWS)


def _final(prepared: PreparedMotion, name: str, end: str, si: float) -> float:
    """Return a final value of a component in a unit; NaN for a missing component."""
    measures = prepared.measures.get(name)
    return getattr(measures, end) / si if measures else math.nan


def _ends(preparations: Sequence[PreparedMotion], fmt: UnitFormat) -> tuple[str, str] | None:
    """Return the largest final velocity and displacement; None if any is processed or drifts."""
    # A sentence does for records that are run as they are and end at rest; else each has a row.
    if any(drifts(prepared) or prepared.done != AS_RECORDED for prepared in preparations):
        return None
    unit = fmt.units()[0]
    measures = [m for prepared in preparations for m in prepared.measures.values()]
    speed_mps = max(abs(m.final_velocity_mps) for m in measures)
    end_m = max(abs(m.final_displacement_m) for m in measures)
    return (
        with_unit(number(speed_mps / unit.si, 2), f"{unit.symbol}/s"),
        with_unit(number(end_m / unit.si, 2), unit.symbol),
    )


def _highpass_table(package: PackageData, beyond: Sequence[Beyond]) -> Table:
    """Return the part of the slip caused by periods that a high-pass filter removes."""
    columns = (
        (words("Motion", 1.2), lambda run: run.motion_id),
        (text("Corner", "Hz"), lambda run: f"{run.corner_hz:g}"),
        (text("Period", "s"), lambda run: f"{1.0 / run.corner_hz:.3g}"),
        (length("With the high-pass filter, as analyzed", 1.3), lambda run: run.filtered_m),
        (length("Without the filter", 1.3), lambda run: run.unfiltered_m),
        (text("Removed", "%", 1.2), lambda run: number(100.0 * run.share, 0)),
    )
    return listed(beyond, columns, package.fmt, kind="compact", whole_rows=MOTION_ROWS)
