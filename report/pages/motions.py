"""The part on roof motions: list, processing, response spectra and target.

From ground to roof: the building model, and the roof motion from each ground motion.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from operator import itemgetter

import numpy as np
from markupsafe import Markup

from report.assessment.checks.records import DRIFT_M, drifts
from report.assessment.support.departures import departures
from report.assessment.support.evidence import Evidence
from report.assessment.support.filter_effect import Beyond
from report.assessment.support.spectra import PRINTED_S, Spectra
from report.document.columns import centered, length, plain, required, text, words
from report.document.tables import Column, Table, Wide, by_place, listed
from report.motions.history import PreparedMotion, first_period_s
from report.pages.acceptance import acceptance_table, events, lowest_between, strength_table
from report.pages.parts import MOTION_ROWS, PackageData
from report.pages.symbols import with_symbols
from report.project.model.motion_input import BuildingInput
from report.text.counts import grouped_by, numbered
from report.text.units import G_MPS2, Unit, number
from solver.building.roof import RoofMotion
from solver.building.structure import APPROXIMATE_PERIODS, FOOT_M
from solver.model import Floats, Motion
from solver.records.acceptance import N_AC156, N_SETS, N_SLIDING, POINTS_HZ
from solver.records.processing import AS_RECORDED
from solver.rules.hazard import Tail
from solver.rules.provisions import AnalysisValue

SHOWN_MODES = 6
NAMES = {"horizontal": "record", "transverse": "transverse"}
"""Names of the horizontal components in the tables of runs."""
SHORT = {"record": "record", "transverse": "transv."}


@dataclass(frozen=True, slots=True)
class _Transferred:
    """A component of a motion, transferred to the roof."""

    motion: str
    per_g: float  # scale / g [s2/m]
    name: str
    roof: RoofMotion


def building_part(
    package: PackageData, variations: Sequence[tuple[BuildingInput, AnalysisValue]]
) -> Mapping[str, object]:
    """Return what the page needs on the motion from ground to roof."""
    shaking = package.assessment.shaking
    components = [
        _Transferred(motion.id, abs(motion.scale) / G_MPS2, NAMES[name], roof)
        for motion, prepared in zip(shaking.motions, shaking.prepared, strict=True)
        for name, roof in prepared.roof.items()
    ]
    structure = package.data.building.structure
    return {
        "models": grouped_by(components, lambda item: item.roof.building.words),
        "coefficients": structure and APPROXIMATE_PERIODS[structure],
        "height_ft": package.data.site.structure_height_m / FOOT_M,
        "period_s": first_period_s(package.data),
        "modes": _modes(package, components),
        "peaks": _peaks(package, components),
        "means_m": [value.mean_m for _, value in variations],
        "variations": _variations(package, variations),
    }


def _modes(package: PackageData, components: Sequence[_Transferred]) -> Table:
    """Return the slowest modes of the building in each direction."""
    rows = []
    for name, of in grouped_by(components, lambda item: item.name).items():
        building, included = of[0].roof.building, max(item.roof.n_modes for item in of)
        # One more than included: a reader sees what the first omitted mode would add.
        printed = min(max(SHOWN_MODES, included + 1), building.periods_s.size)
        rows += [(name, building, mode, mode < included) for mode in range(printed)]
    columns = (
        (words("Direction", 1.3), lambda row: row[0] if row[2] == 0 else ""),
        (text("Mode", share=0.6), lambda row: row[2] + 1),
        (text("Period", "s"), lambda row: f"{row[1].periods_s[row[2]]:.3g}"),
        (plain("Damping", 1, "% of critical"), lambda row: 100.0 * row[1].damping[row[2]]),
        (plain("Roof factor", 3, "Γφ"), lambda row: row[1].roof_factors[row[2]]),
        (words("Included"), lambda row: "yes" if row[3] else "no"),
    )
    return listed(rows, columns, package.fmt, kind="compact")


def _peaks(package: PackageData, components: Sequence[_Transferred]) -> Table:
    """Return the peaks and modes of each motion, its components side by side."""
    quantities: Sequence[tuple[str, int, Callable[[_Transferred], float]]] = (
        ("Ground peak, g", 3, lambda item: item.per_g * item.roof.ground_peak_mps2),
        ("Roof peak, g", 3, lambda item: item.per_g * item.roof.roof_peak_mps2),
        (
            "Roof / ground",
            2,
            # A component may be all zeros.
            lambda item: item.roof.roof_peak_mps2 / (item.roof.ground_peak_mps2 or math.nan),
        ),
        ("Modes included", 0, lambda item: item.roof.n_modes),
        ("Next mode, % of roof peak", 1, lambda item: 100.0 * item.roof.next_share),
        ("All omitted, % of roof peak", 1, lambda item: 100.0 * item.roof.left_out_share),
    )

    def of_component(
        components: Sequence[_Transferred], name: str, value: Callable[[_Transferred], float]
    ) -> float:
        # A motion need not have each component that another one has.
        return next((value(item) for item in components if item.name == name), math.nan)

    columns: Sequence[Column] = (
        (words("Motion", 1.2), lambda of: of[0].motion),
        *(
            (
                plain(head, decimals, SHORT[name], 0.9),
                partial(of_component, name=name, value=value),
            )
            for head, decimals, value in quantities
            for name in dict.fromkeys(component.name for component in components)
        ),
        (plain("Extended by", 1, "s"), lambda of: of[0].roof.pad_s),
    )
    by_motion = grouped_by(components, lambda item: item.motion)
    return listed(by_motion.values(), columns, package.fmt, kind="compact", whole_rows=MOTION_ROWS)


def _variations(
    package: PackageData, variations: Sequence[tuple[BuildingInput, AnalysisValue]]
) -> Table:
    """Return each variation and its ratios to the building as used, which is first."""
    used, value = variations[0]
    columns = (
        (plain("Period", 3, "s"), lambda row: row[0].period_s),
        (plain("Period", 2, "/ used"), lambda row: row[0].period_s / used.period_s),
        (plain("Damping", 1, "% of critical"), lambda row: row[0].damping_percent),
        (length("Mean PRD"), lambda row: row[1].mean_m),
        (plain("Mean PRD", 2, "/ used"), lambda row: row[1].mean_m / (value.mean_m or math.nan)),
        (length("Largest PRD"), lambda row: row[1].largest_m),
        (required("Analysis displacement"), lambda row: row[1].value_m),
    )
    return listed(variations, columns, package.fmt, kind="compact", whole_rows=len(variations))


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


def _sources(motions: Sequence[Motion]) -> Mapping[str, Sequence[str]]:
    """Return the motions of each source; nothing where every motion has a source of its own."""
    by_source = grouped_by(motions, lambda motion: motion.source or "not entered")
    # Then the table has a column for it, and a list by source would repeat the table.
    if len(by_source) == len(motions) > 1:
        return {}
    return {source: [motion.id for motion in of] for source, of in by_source.items()}


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
            lambda row: number((len(row[0].ax_mps2) - 1) * row[0].dt_s, 2),
        ),
        (words("Scaling", 1.35), lambda row: row[1].scaling),
        (text("Factor", share=0.8), lambda row: f"{row[0].scale:.4g}"),
        (centered("Polarity"), lambda row: _polarity(row[0])),
    )
    alike = {
        shown.head: f"{said.pop()} {shown.unit}".rstrip()
        for shown, cell, *_ in maybe_alike
        # Compared as printed: what reads the same in every row is in a note.
        if len(said := {str(cell(row)) for row in rows}) == 1
    }
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
    columns: Sequence[Column] = (
        (words("Motion", 1.1), lambda prepared: prepared.motion_id),
        (words("Processing", 3.6), lambda prepared: prepared.done),
        *(
            (
                plain(head, unit=names[name], share=0.9),
                partial(_final, name=name, end=end, si=unit.si),
            )
            for head, end in ends.items()
            for name in names
        ),
        (words("Drift", 0.9),
         lambda prepared: Markup("<b>drifts</b>") if drifts(prepared) else "none"),
    )  # fmt: skip
    prepared = package.assessment.shaking.prepared
    return listed(prepared, columns, package.fmt, kind="compact", whole_rows=MOTION_ROWS)


def _final(prepared: PreparedMotion, name: str, end: str, si: float) -> float:
    """Return an end of a component in a unit; NaN for a component that there is none of."""
    measures = prepared.measures.get(name)
    return getattr(measures, end) / si if measures else math.nan


def _largest_ends(preparations: Sequence[PreparedMotion]) -> tuple[float, float] | None:
    """Return the largest final velocity and displacement; None if any is processed or drifts."""
    # A sentence does for records that are run as they are and end at rest; else each has a row.
    if any(drifts(prepared) or prepared.done != AS_RECORDED for prepared in preparations):
        return None
    measures = [m for prepared in preparations for m in prepared.measures.values()]
    return (
        max(abs(m.final_velocity_mps) for m in measures),
        max(abs(m.final_displacement_m) for m in measures),
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


def spectrum_table(spectra: Sequence[Spectra]) -> Table:
    """Return target, achieved ordinates and their ratios at a few periods, by component."""
    periods = (text(f"{period:g} s", f"{1 / period:.3g} Hz") for period in PRINTED_S)
    rows = (row for part in spectra for row in _spectrum_rows(part))
    columns = by_place(words("Period", 2.9), *periods)
    return listed(rows, columns, kind="compact", style=itemgetter(-1))


def _spectrum_rows(part: Spectra) -> Iterator[Sequence[str | Wide]]:
    """Yield name, ordinates and style of each row; a component stays on one sheet."""
    at = [int(np.argmin(np.abs(part.periods_s - period))) for period in PRINTED_S]
    target, sa = part.target_g[at], part.sa_g[:, at]
    # With how many, since a component may be missing in some motions.
    mean = f"Mean of {numbered(len(part.ids), 'motion')} [g]", *_numbers(sa.mean(axis=0), 3)
    yield Wide(Markup("<b>{}</b>").format(part.title), 1 + len(PRINTED_S)), "total group"
    if not part.target.name:
        yield *mean, ""
        return
    share = sa / target
    yield f"Target, {part.target.name} [g]", *_numbers(target, 3), "group"
    yield *mean, "group"
    yield "Mean / target", *_numbers(share.mean(axis=0), 2), "group"
    yield "Smallest motion / target", *_numbers(share.min(axis=0), 2), "group"
    yield "Largest motion / target", *_numbers(share.max(axis=0), 2), ""


def _numbers(values: Floats, decimals: int) -> Sequence[str]:
    return [number(float(value), decimals) for value in values]


def spectra(_: PackageData, evidence: Evidence) -> Mapping[str, object]:
    """Return the table of spectra."""
    return {"table": spectrum_table(evidence.spectra)}


def page(package: PackageData, evidence: Evidence) -> Mapping[str, object]:
    """Return the part on motions, without its charts."""
    shaking, spectra = package.assessment.shaking, evidence.spectra
    unit, sources = package.fmt.units()[0], _sources(shaking.motions)
    table, alike = _motion_table(package, has_sources=not sources)
    return {
        "table": table,
        "alike": alike,
        "sources": sources,
        "notes": dict.fromkeys(
            # The components of a motion often say the same.
            (row.motion_id, note.rstrip("."))
            for row in shaking.records
            for note in row.notes
        ),
        "unit": unit,
        "ends": _largest_ends(shaking.prepared),
        "drift": _drift_table(package, unit),
        "drift_m": DRIFT_M,
        "highpass": _highpass_table(package, evidence.highpass) if evidence.highpass else None,
        "building": building_part(package, evidence.building) if package.has_ground else None,
        "tail": Tail(package.data.target.tail).sentence,
        "departures": departures(spectra),
        "events": list(events(package.data.motions)),
        "acceptance": acceptance_table(package),
        "points": {"all": len(POINTS_HZ), "sliding": N_SLIDING, "ac156": N_AC156, "sets": N_SETS},
        "between": lowest_between(package.assessment.acceptance, spectra),
        "strength": strength_table(package),
    }
