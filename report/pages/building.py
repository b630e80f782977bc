"""From ground to roof: the building model, and the roof motion from each ground motion."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial

from report.assessment.building_variations import BuildingVariation
from report.document.tables import Column, Table, listed
from report.entities.shown import length, plain, text, words
from report.motions.history import first_period_s
from report.pages.parts import PackageData
from report.words.units import G_MPS2
from solver.building.periods import APPROXIMATE_PERIODS, FOOT_M
from solver.building.roof import Building, RoofMotion

SHOWN_MODES = 6
NAMES = {"horizontal": "record", "transverse": "transverse"}
"""Names of the horizontal components in the tables of runs."""
SHORT = {"record": "record", "transverse": "transv."}


@dataclass(frozen=True, slots=True)
class _Transferred:
    """A component of a motion, transferred to the roof."""

    motion: str
    scale: float
    name: str
    roof: RoofMotion

    @property
    def ground_g(self) -> float:
        return abs(self.scale) * self.roof.ground_peak_mps2 / G_MPS2

    @property
    def roof_g(self) -> float:
        return abs(self.scale) * self.roof.roof_peak_mps2 / G_MPS2

    @property
    def amplification(self) -> float:
        return self.roof_g / self.ground_g if self.ground_g else math.nan


def building_part(
    package: PackageData, variations: Sequence[BuildingVariation]
) -> Mapping[str, object]:
    """Return what the page needs on the motion from ground to roof."""
    shaking = package.assessment.shaking
    components = [
        _Transferred(motion.id, motion.scale, NAMES[name], roof)
        for motion, prepared in zip(shaking.motions, shaking.prepared, strict=True)
        for name, roof in prepared.roof.items()
    ]
    structure = package.data.building.structure
    return {
        "models": _models(components),
        "coefficients": structure and APPROXIMATE_PERIODS[structure],
        "height_ft": package.data.site.structure_height_m / FOOT_M,
        "period_s": first_period_s(package.data),
        "modes": _modes(package, components),
        "peaks": _peaks(package, components),
        "shares": _shares(variations),
        "variations": _variations(package, variations),
    }


def _models(components: Sequence[_Transferred]) -> Mapping[str, Sequence[str]]:
    """Return the names of the components by the building model that transfers them, in words."""
    names: dict[str, dict[str, None]] = {}
    for component in components:
        names.setdefault(component.roof.building.words, {})[component.name] = None
    return {words: list(same) for words, same in names.items()}


def _modes(package: PackageData, components: Sequence[_Transferred]) -> Table:
    """Return the slowest modes of the building in each direction."""
    buildings: dict[str, Building] = {}
    included: dict[str, int] = {}
    for component in components:
        name, roof = component.name, component.roof
        buildings[name] = roof.building
        included[name] = max(included.get(name, 0), roof.n_modes)
    rows = [
        (name, building, mode, mode < included[name])
        for name, building in buildings.items()
        for mode in range(min(max(SHOWN_MODES, included[name] + 1), building.periods_s.size))
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
    names = dict.fromkeys(component.name for component in components)
    quantities: Sequence[tuple[str, int, Callable[[_Transferred], float]]] = (
        ("Ground peak, g", 3, lambda item: item.ground_g),
        ("Roof peak, g", 3, lambda item: item.roof_g),
        (
            "Roof / ground",
            2,
            lambda item: item.roof_g / item.ground_g if item.ground_g else math.nan,
        ),
        ("Modes included", 0, lambda item: item.roof.n_modes),
        ("Next mode, % of roof peak", 1, lambda item: 100.0 * item.roof.next_share),
        ("All omitted, % of roof peak", 1, lambda item: 100.0 * item.roof.left_out_share),
    )
    columns: Sequence[Column] = (
        (words("Motion", 1.2), lambda of: next(iter(of.values())).motion),
        *(
            (plain(head, decimals, SHORT[name], 0.9), partial(_value, name=name, value=value))
            for head, decimals, value in quantities
            for name in names
        ),
        (plain("Extended by", 1, "s"), lambda of: max(item.roof.pad_s for item in of.values())),
    )
    by_motion: dict[str, dict[str, _Transferred]] = {}
    for component in components:
        by_motion.setdefault(component.motion, {})[component.name] = component
    return listed(by_motion.values(), columns, package.fmt, kind="compact")


def _value(
    of: Mapping[str, _Transferred], name: str, value: Callable[[_Transferred], float]
) -> float:
    """Return a value of a component; NaN for one that the motion does not have."""
    return value(of[name]) if name in of else math.nan


def _shares(variations: Sequence[BuildingVariation]) -> Sequence[float]:
    """Return the mean PRD of each variation / that as used, which is first; NaN for none."""
    used_m = variations[0].mean_prd_m
    return [each.mean_prd_m / used_m if used_m > 0.0 else math.nan for each in variations]


def _variations(package: PackageData, variations: Sequence[BuildingVariation]) -> Table:
    used = variations[0]

    def changed(item: BuildingVariation) -> str:
        if item is used:
            return "none, as used"
        percent = 100.0 * (item.period_s / used.period_s - 1.0)
        return f"period {percent:+.0f} %".replace("-", "−") if percent else "damping"

    columns = (
        (words("Change", 1.2), lambda row: changed(row[0])),
        (plain("Period", 3, "s"), lambda row: row[0].period_s),
        (plain("Damping", 1, "% of critical"), lambda row: row[0].damping_percent),
        (length("Mean PRD"), lambda row: row[0].mean_prd_m),
        (plain("Mean PRD", 2, "/ used"), lambda row: row[1]),
        (length("Largest PRD"), lambda row: row[0].largest_prd_m),
        (length("Design displacement"), lambda row: row[0].design_m),
    )
    rows = zip(variations, _shares(variations), strict=True)
    return listed(
        rows, columns, package.fmt, kind="compact", whole_rows=len(variations),
        style=lambda row: "total" if row[0] is used else "",
    )  # fmt: skip
