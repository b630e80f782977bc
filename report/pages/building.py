"""From ground to roof: the building model, and the roof motion from each ground motion."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial

from report.document.tables import Column, Table, listed
from report.entities.shown import length, plain, required, text, words
from report.motions.history import first_period_s
from report.pages.parts import MOTION_ROWS, PackageData
from report.sheet.schema.building import BuildingInput
from report.words.counts import grouped_by
from report.words.units import G_MPS2
from solver.building.periods import APPROXIMATE_PERIODS, FOOT_M
from solver.building.roof import RoofMotion
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
    rows = [
        (name, of[0].roof.building, mode, mode < included)
        for name, of in grouped_by(components, lambda item: item.name).items()
        for included in (max(item.roof.n_modes for item in of),)
        for mode in range(min(max(SHOWN_MODES, included + 1), of[0].roof.building.periods_s.size))
    ]
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
            lambda item: item.roof.roof_peak_mps2 / (item.roof.ground_peak_mps2 or math.nan),
        ),
        ("Modes included", 0, lambda item: item.roof.n_modes),
        ("Next mode, % of roof peak", 1, lambda item: 100.0 * item.roof.next_share),
        ("All omitted, % of roof peak", 1, lambda item: 100.0 * item.roof.left_out_share),
    )
    columns: Sequence[Column] = (
        (words("Motion", 1.2), lambda of: of[0].motion),
        *(
            (plain(head, decimals, SHORT[name], 0.9), partial(_of, name, value))
            for head, decimals, value in quantities
            for name in dict.fromkeys(component.name for component in components)
        ),
        (plain("Extended by", 1, "s"), lambda of: of[0].roof.pad_s),
    )
    by_motion = grouped_by(components, lambda item: item.motion)
    return listed(by_motion.values(), columns, package.fmt, kind="compact", whole_rows=MOTION_ROWS)


def _of(
    name: str, value: Callable[[_Transferred], float], components: Sequence[_Transferred]
) -> float:
    """Return a value of one component of a motion; NaN if the motion does not have it."""
    return next((value(item) for item in components if item.name == name), math.nan)


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
        (required("Value from analysis"), lambda row: row[1].value_m),
    )
    return listed(variations, columns, package.fmt, kind="compact", whole_rows=len(variations))
