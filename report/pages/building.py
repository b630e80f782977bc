"""From ground to roof: the building model, and the roof motion from each ground motion."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence

from markupsafe import Markup

from report.document.tables import Table, TableRow
from report.entities.columns import TableColumn
from report.motions.history import PreparedMotion, first_period_s
from report.pages.parts import PackageData
from report.words.units import G_MPS2, Quantity, number
from solver.building.periods import APPROXIMATE_PERIODS, FOOT_M
from solver.building.roof import Building, RoofMotion
from solver.model import Motion

SHOWN_MODES = 6
NAMES = {"horizontal": "record", "transverse": "transverse"}
"""Names of the horizontal components in the tables of runs."""


def building_part(
    package: PackageData, motions: Sequence[Motion], preparations: Sequence[PreparedMotion]
) -> Mapping[str, object]:
    """Return the texts and tables on the motion from ground to roof."""
    components = [
        (motion, NAMES[name], roof)
        for motion, prepared in zip(motions, preparations, strict=True)
        for name, roof in prepared.roof.items()
    ]
    return {
        "texts": tuple(_texts(package, components)),
        "tables": (_modes(components), _peaks(components)),
    }


_Carried = tuple[Motion, str, RoofMotion]


def _texts(package: PackageData, components: Sequence[_Carried]) -> Iterator[str]:
    yield Markup("{} {}").format(
        "Motions given at the ground are transferred to the roof through an elastic building "
        f"model, each horizontal component independently: {_words(components)}.",
        _period_words(package),
    )
    share = package.data.building.left_out_percent
    yield (
        "The number of modes is the smallest for which the omitted modes together contribute no "
        f"more than {number(share, 1)} % of the peak roof acceleration; omitted modes are treated "
        "as rigid. The modal equations are solved exactly for acceleration that varies linearly "
        "between samples (Nigam and Jennings, 1969), and the response is continued until the free "
        "vibration has decayed."
    )
    yield (
        "The result is sensitive to period and damping, most to damping: measured or analyzed "
        "values are better than approximate ones."
    )
    yield (
        "The mass of the array is neglected in the building response. The vertical motion at the "
        "roof is that of the ground. Torsion, yielding and soil-structure interaction are "
        "neglected; the roof is assumed rigid in its plane."
    )


def _words(components: Sequence[_Carried]) -> str:
    names: dict[str, list[str]] = {}
    for _, name, roof in components:
        same = names.setdefault(roof.building.words, [])
        same += [name] if name not in same else []
    if len(names) == 1:
        return next(iter(names))
    return "; ".join(f"{' and '.join(same)}: {words}" for words, same in names.items())


def _period_words(package: PackageData) -> Markup:
    """Return the source of the first period."""
    building, height = package.data.building, package.data.site.structure_height_m
    if building.period_s is not None or building.structure is None:
        return Markup("The period is as given in the workbook.")
    coefficient, exponent = APPROXIMATE_PERIODS[building.structure]
    return Markup(
        "The period is approximate, ASCE 7, 12.8.2.1, structure type “{}”: C<sub>t</sub> "
        "h<sup>x</sup> = {} × {}<sup>{}</sup> = {} s, h in feet ({}). It is intended "
        "to be short, which is conservative for forces but not necessarily for roof motion."
    ).format(
        building.structure.value,
        f"{coefficient:g}",
        number(height / FOOT_M, 1),
        f"{exponent:g}",
        number(first_period_s(package.data), 3),
        package.fmt.both(height, Quantity.PLAN),
    )


def _modes(components: Sequence[_Carried]) -> Table:
    """Return the slowest modes of the building in each direction."""
    buildings: dict[str, Building] = {}
    included: dict[str, int] = {}
    for _, name, roof in components:
        buildings[name] = roof.building
        included[name] = max(included.get(name, 0), roof.n_modes)
    return Table(
        caption="Modes of the building",
        columns=(
            TableColumn(head="Direction", align="left", share=1.3),
            TableColumn(head="Mode", share=0.6),
            TableColumn(head="Period", unit="s"),
            TableColumn(head="Damping", unit="% of critical"),
            TableColumn(head="Roof factor", unit="Γφ"),
            TableColumn(head="Included", align="left", share=1.0),
        ),
        rows=tuple(
            TableRow(
                cells=(
                    name if mode == 0 else "",
                    str(mode + 1),
                    f"{building.periods_s[mode]:.3g}",
                    number(100.0 * float(building.damping[mode]), 1),
                    number(float(building.roof_factors[mode]), 3),
                    "yes" if mode < included[name] else "no",
                )
            )
            for name, building in buildings.items()
            for mode in range(min(max(SHOWN_MODES, included[name] + 1), building.periods_s.size))
        ),
        kind="compact",
    )


def _peaks(components: Sequence[_Carried]) -> Table:
    """Return the peaks of each component on the ground and at the roof."""
    return Table(
        caption="Peak acceleration on the ground and at the roof, after scaling, and modes",
        columns=(
            TableColumn(head="Motion", align="left", share=1.2),
            TableColumn(head="Component", align="left", share=1.3),
            TableColumn(head="Peak", unit="ground, g"),
            TableColumn(head="Peak", unit="roof, g"),
            TableColumn(head="Roof / ground", share=1.0),
            TableColumn(head="Modes included", share=0.9),
            TableColumn(head="Next mode", unit="% of roof peak", share=1.2),
            TableColumn(head="All omitted", unit="% of roof peak", share=1.2),
            TableColumn(head="Extended by", unit="s", share=0.9),
        ),
        rows=tuple(_peak_row(*component) for component in components),
        kind="compact",
    )


def _peak_row(motion: Motion, name: str, roof: RoofMotion) -> TableRow:
    ground, top = (
        abs(motion.scale) * peak / G_MPS2 for peak in (roof.ground_peak_mps2, roof.roof_peak_mps2)
    )
    return TableRow(
        cells=(
            motion.id,
            name,
            number(ground, 3),
            number(top, 3),
            number(top / ground if ground > 0.0 else math.nan, 2),
            str(roof.n_modes),
            number(100.0 * roof.next_share, 1),
            number(100.0 * roof.left_out_share, 1),
            number(roof.pad_s, 1),
        )
    )
