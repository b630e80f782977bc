"""From ground to roof: the building model, and the roof motion from each ground motion."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial

from markupsafe import Markup

from report.document.columns import plain, required, text, words
from report.document.tables import Column, Table, listed
from report.motions.history import first_period_s
from report.pages.parts import MOTION_ROWS, PackageData
from report.project.model.motion_input import BuildingInput
from report.text.grouping import grouped_by
from report.text.units import G_MPS2, NO_BREAK, Quantity, number
from solver.building.roof import RoofMotion
from solver.rules.hazard import APPROXIMATE_PERIODS, FOOT_M
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
    """Return the text on the building, its modes, and the results with variations."""
    shaking, building, fmt = package.assessment.shaking, package.data.building, package.fmt
    components = []
    for motion, prepared in zip(shaking.motions, shaking.prepared, strict=True):
        per_g = abs(motion.scale) / G_MPS2
        for name, roof in prepared.roof.items():
            components.append(_Transferred(motion.id, per_g, NAMES[name], roof))
    height_m = package.data.site.structure_height_m
    return {
        "model": _model(components),
        "structure": building.structure.value
        if building.structure and building.period_s is None
        else "",
        "period": _period(package),
        "height": fmt.both(height_m, Quantity.PLAN),
        "omitted_percent": f"{number(building.left_out_percent, 1)}%",
        "modes": _modes(package, components),
        "peaks": _peaks(package, components),
        "range": _range([value.mean_m for _, value in variations]),
        "variations": _variations(package, variations),
        "variations_caption": f"Array {package.assessment.governing.id} with the building as used, "
        "in the first row, and with other periods and other damping",
    }


def _model(components: Sequence[_Transferred]) -> str:
    """Return the models of the components as text, by component if they differ."""
    models = grouped_by(components, lambda item: item.roof.building.words)
    texts = []
    for model, of_model in models.items():
        names = " and ".join(dict.fromkeys(item.name for item in of_model))
        texts.append(f"{names}: {model}" if len(models) > 1 else model)
    return "; ".join(texts)


def _period(package: PackageData) -> Markup | None:
    """Return the approximate period of the building as it is computed, if it is."""
    building, height_m = package.data.building, package.data.site.structure_height_m
    if building.period_s is not None or not building.structure:
        return None
    coefficient, exponent = APPROXIMATE_PERIODS[building.structure]
    return Markup("{:g} × {}<sup>{:g}</sup> = {}{}s").format(
        # C_t of ASCE 7, Table 12.8-2 is for a height in feet, also where the package is in SI
        # units.
        coefficient, number(height_m / FOOT_M, 1), exponent,
        number(first_period_s(package.data), 3), NO_BREAK,
    )  # fmt: skip


def _range(means_m: Sequence[float]) -> str:
    """Return the range of the mean PRDs over the first, which is that of the building as used."""
    used_m, known_m = means_m[0], [mean_m for mean_m in means_m if not math.isnan(mean_m)]
    if not used_m > 0.0:
        return ""
    return f"{number(min(known_m) / used_m, 2)} to {number(max(known_m) / used_m, 2)}"


def _modes(package: PackageData, components: Sequence[_Transferred]) -> Table:
    """Return the slowest modes of the building in each direction."""
    rows = []
    for name, items in grouped_by(components, lambda item: item.name).items():
        building, included = items[0].roof.building, max(item.roof.n_modes for item in items)
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

    columns: list[Column] = [(words("Motion", 1.2), lambda of_motion: of_motion[0].motion)]
    names = dict.fromkeys(component.name for component in components)
    for head, decimals, value in quantities:
        for name in names:
            value_of = partial(of_component, name=name, value=value)
            columns.append((plain(head, decimals, SHORT[name], 0.9), value_of))
    columns.append((plain("Extended by", 1, "s"), lambda of_motion: of_motion[0].roof.pad_s))
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
        (required("Mean PRD"), lambda row: row[1].mean_m),
        (plain("Mean PRD", 2, "/ used"), lambda row: row[1].mean_m / (value.mean_m or math.nan)),
        (required("Largest PRD"), lambda row: row[1].largest_m),
        (required("Analysis displacement"), lambda row: row[1].value_m),
    )
    return listed(variations, columns, package.fmt, kind="compact", whole_rows=len(variations))
