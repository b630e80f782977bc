"""The section through the governing array: its caption, with weight per area.

`report.figures.section` draws it.
"""

from __future__ import annotations

import math

from report.document.blocks import Picture
from report.pages.parts import PackageData
from report.sheet.schema import Array
from report.words.units import Quantity, measured, number


def picture(package: PackageData) -> Picture:
    """Return the section through the array with the largest design displacement."""
    from report.figures.section import array_section, drawn_slope_deg

    array = package.governing.array
    own, drawn = math.degrees(array.slope_rad), drawn_slope_deg(array)
    slope = (
        ""
        if math.isclose(own, drawn)
        else f" The roof is drawn at {number(drawn, 0)}° instead of {number(own, 2)}°."
    )
    return Picture(
        svg=array_section(array, package.fmt.us_first),
        caption=f"Array {array.id}: section, and forces during downslope slip with the inertia"
        " forces of the roof acceleration. c: height of the center of gravity; b: spacing of the"
        f" supports.{slope} {_weights(package)} Ballast for wind by others.",
        alt=f"Section through array {array.id} with its free body",
    )


def weight_per_area_pa(array: Array) -> float:
    """Return the weight of an array over its plan area [Pa]."""
    return array.weight_n / array.shape.area_m2


def _weights(package: PackageData) -> str:
    """Return the weight over plan area of the array, and the range of the others."""
    array = package.governing.array
    others = [weight_per_area_pa(one) for one in package.data.arrays if one.id != array.id]
    text = f"W over plan area: {package.fmt.both(weight_per_area_pa(array), Quantity.PRESSURE)}"
    if not others:
        return f"{text}."
    unit, _ = package.fmt.units(Quantity.PRESSURE)
    low, high = (measured(value, unit) for value in (min(others), max(others)))
    span = low if low == high else f"{low} to {high}"
    return f"{text}; other arrays {span} {unit.symbol}."
