"""US and SI side by side: quantities, their units in both systems, and the one number formatter.

Values are in SI everywhere else; values that a user reads or enters are converted here.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from enum import Enum

from solver.model import INCH_M, STANDARD_GRAVITY_MPS2
from solver.spaces import NO_BREAK as NO_BREAK
from solver.spaces import spaced as spaced

NEWTONS_PER_POUND = 4.4482216152605
G_MPS2 = STANDARD_GRAVITY_MPS2

LENGTHS = {"in": INCH_M, "ft": 0.3048, "mm": 1e-3, "cm": 1e-2, "m": 1.0}
"""Lengths in m."""

# Weights in N; a mass is multiplied by standard gravity.
WEIGHTS = {
    "lb": NEWTONS_PER_POUND,
    "kip": 1e3 * NEWTONS_PER_POUND,
    "N": 1.0,
    "kN": 1e3,
    "kg": G_MPS2,
}

STIFFNESSES = {
    "lb/in": NEWTONS_PER_POUND / INCH_M,
    "kip/in": 1e3 * NEWTONS_PER_POUND / INCH_M,
    "N/m": 1.0,
    "N/mm": 1e3,
    "kN/m": 1e3,
}
"""Stiffnesses in N/m."""

VELOCITIES = {"in/s": INCH_M, "in/min": INCH_M / 60.0, "ft/s": 0.3048, "mm/s": 1e-3, "m/s": 1.0}
"""Velocities in m/s."""

PRESSURES = {"psf": NEWTONS_PER_POUND / 0.3048**2, "kPa": 1e3, "Pa": 1.0}
"""Pressures in Pa."""


@dataclass(frozen=True, slots=True)
class Unit:
    """A unit: its symbol, its size in SI, and the number of decimals printed."""

    symbol: str
    si: float
    decimals: int


Show = Callable[[float, Unit], str]
# Of the last digit printed: 36 in from meters is not 36.1 in.
NOISE = 1e-6


class Quantity(Enum):
    """A physical quantity: (US unit, SI unit)."""

    DISPLACEMENT = (Unit("in", INCH_M, 1), Unit("mm", 1e-3, 0))
    # An alias: the same units, and the name says what is meant.
    SIZE = DISPLACEMENT
    PLAN = (Unit("ft", 0.3048, 2), Unit("m", 1.0, 2))
    WEIGHT = (Unit("lb", NEWTONS_PER_POUND, 0), Unit("kN", 1e3, 2))
    STIFFNESS = (Unit("lb/in", NEWTONS_PER_POUND / INCH_M, 0), Unit("kN/m", 1e3, 1))
    VELOCITY = (Unit("in/s", INCH_M, 2), Unit("mm/s", 1e-3, 1))
    PRESSURE = (Unit("psf", PRESSURES["psf"], 1), Unit("kPa", 1e3, 2))
    # At the end of a record, where a limit is as small as 10 mm.
    DRIFT = (Unit("in", INCH_M, 2), Unit("mm", 1e-3, 1))
    # In one unit alone, whichever system is preferred. An angle is in degrees everywhere.
    ANGLE = (Unit("°", 1.0, 2),) * 2
    TIME = (Unit("s", 1.0, 1),) * 2
    ACCELERATION = (Unit("g", G_MPS2, 3),) * 2
    COUNT = (Unit("", 1.0, 0),) * 2
    PERCENT = (Unit("%", 1.0, 1),) * 2
    RATIO = (Unit("", 1.0, 2),) * 2
    COEFFICIENT = (Unit("", 1.0, 3),) * 2

    @property
    def accepted(self) -> Mapping[str, float]:
        """Symbols accepted in the input, each with its size in SI."""
        symbols = {
            Quantity.WEIGHT: WEIGHTS,
            Quantity.STIFFNESS: STIFFNESSES,
            Quantity.VELOCITY: VELOCITIES,
            Quantity.PRESSURE: PRESSURES,
        }
        return symbols.get(self, LENGTHS)

    @property
    def has_systems(self) -> bool:
        """Whether it has a unit in each of the two systems."""
        return self.us != self.si

    @property
    def base(self) -> str:
        """The unit of a value that is kept, such as `m`; empty for a ratio or a count."""
        return _BASE.get(self, self.si.symbol)

    @property
    def us(self) -> Unit:
        """The US unit."""
        return self.value[0]

    @property
    def si(self) -> Unit:
        """The SI unit."""
        return self.value[1]


_BASE = {
    Quantity.DISPLACEMENT: "m",
    Quantity.DRIFT: "m",
    Quantity.WEIGHT: "N",
    Quantity.STIFFNESS: "N/m",
    Quantity.VELOCITY: "m/s",
    Quantity.PRESSURE: "Pa",
    Quantity.ANGLE: "deg",
    Quantity.ACCELERATION: "m/s2",
}


def number(value: float, decimals: int) -> str:
    """Return a number for print: fixed decimals, a true minus, ∞, an em dash for NaN."""
    if value != value:
        return "—"
    text = f"{value:.{decimals}f}"
    # What rounds to zero has no sign.
    if float(text) == 0.0:
        text = text.lstrip("-")
    return text.replace("-", "−").replace("inf", "∞")


class Rounding(Enum):
    """How a quantity is rounded wherever it is printed."""

    NEAREST = "nearest"  # what is entered or measured, and what follows from it such as a weight
    UP = "up"  # what is required, and a demand
    DOWN = "down"  # what is provided, and a capacity

    def of(self, value: float, decimals: int) -> float:
        """Return a number rounded so."""
        rounded = {Rounding.UP: round_up, Rounding.DOWN: round_down}
        return rounded.get(self, round)(value, decimals)

    def text(self, value: float, decimals: int) -> str:
        """Return a number rounded so, for print."""
        return number(self.of(value, decimals), decimals)


def measured(value_si: float, unit: Unit) -> str:
    """Return a value in a unit, for print, without the symbol."""
    return Rounding.NEAREST.text(value_si / unit.si, unit.decimals)


def no_less(value_si: float, unit: Unit) -> str:
    """Return a value in a unit, rounded up."""
    return Rounding.UP.text(value_si / unit.si, unit.decimals)


def no_more(value_si: float, unit: Unit) -> str:
    """Return a value in a unit, rounded down."""
    return Rounding.DOWN.text(value_si / unit.si, unit.decimals)


def digits_up(value: float, digits: int) -> str:
    """Return a number with significant digits, rounded up."""
    decimals = _decimals(value, digits)
    return number(round_up(value, decimals), decimals)


def digits_down(value: float, digits: int) -> str:
    """Return a number with significant digits, rounded down."""
    decimals = _decimals(value, digits)
    return number(round_down(value, decimals), decimals)


def _decimals(value: float, digits: int) -> int:
    """Return the decimals that show so many digits of a number."""
    has_digits = math.isfinite(value) and value != 0.0
    return max(digits - 1 - math.floor(math.log10(abs(value))), 0) if has_digits else 0


def round_up(value: float, decimals: int) -> float:
    """Return a number rounded up, but for rounding error."""
    per_digit = 10.0**decimals
    return math.ceil(value * per_digit - NOISE) / per_digit if math.isfinite(value) else value


def round_down(value: float, decimals: int) -> float:
    """Return a number rounded down, but for rounding error."""
    per_digit = 10.0**decimals
    return math.floor(value * per_digit + NOISE) / per_digit if math.isfinite(value) else value


def with_unit(text: str, symbol: str) -> str:
    """Return a number for print with the symbol of its unit, between which no line breaks."""
    space = "" if symbol in ("", "°", "%") else NO_BREAK
    return f"{text}{space}{symbol}"


def pair(value_si: float, quantity: Quantity, us_first: bool = True, show: Show = measured) -> str:
    """Return a value in both systems, such as `81.6 in (2072 mm)`, the preferred one first."""
    first, second = (
        with_unit(show(value_si, unit), unit.symbol)
        for unit in (quantity.value if us_first else quantity.value[::-1])
    )
    return f"{first} ({second})"


def ratio(value: float) -> str:
    """Return a demand/capacity ratio, rounded up so that 1.00 never hides a failure."""
    if math.isnan(value):
        return "none"
    if value > 100.0:  # of almost no capacity more digits say nothing
        return "∞" if math.isinf(value) else "> 100"
    # Less 1e-7, or a ratio of 1 could print as 1.01 by rounding error.
    return number(math.ceil(value * 100.0 - 1e-7) / 100.0, 2)


def ratio_up(value: float) -> str:
    """Return the factor on a design displacement, with three decimals, rounded up."""
    if math.isnan(value):
        return "none"
    # Rounded down, the product would print too small. Less a millionth of the last digit, which is
    # rounding error.
    return number(math.ceil(value * 1e3 - 1e-6) / 1e3 if math.isfinite(value) else value, 3)


def round_below(value: float) -> float:
    """Return the largest of 1, 2, 5 times a power of ten that is not above a value."""
    power = 10.0 ** math.floor(math.log10(value))
    # A power of ten is not exact: a value of 0.2 is to give 0.2.
    return max(digit * power for digit in (1.0, 2.0, 5.0) if digit * power <= value * (1 + 1e-9))


def nan_is_worst(value: float) -> float:
    """Return a sort key in which NaN is the largest."""
    return math.inf if math.isnan(value) else value
