"""Amounts: values found and required, rounded as everywhere.

36.02 in required of 36.0 in provided print as 36.1 and 36.0: what is not met never reads as met.

Required values and demands are rounded up, provided values and capacities down. Read `Amount`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import lru_cache

from report.text.units import Quantity, Rounding, Show, Unit, pair, with_unit
from solver.rules.limit import Limit, Measure, at_least

# Decimals beyond those of a unit that are tried to show the order of two values.
_MOST_MORE = 2


@dataclass(frozen=True, slots=True)
class Amount:
    """A value in SI with its quantity, and how it is rounded."""

    value: float
    rounding: Rounding
    quantity: Quantity = Quantity.RATIO
    mark: str = ""  # behind the number, such as †

    def text(self, size: float, decimals: int) -> str:
        """Return it in a unit of a size, for print."""
        return self.rounding.text(self.value / size, decimals)


def entered(value: float, quantity: Quantity = Quantity.RATIO) -> Amount:
    """Return an entered or measured value."""
    return Amount(value, Rounding.NEAREST, quantity)


def demand(value: float, quantity: Quantity = Quantity.RATIO, mark: str = "") -> Amount:
    """Return a required value, or a demand."""
    return Amount(value, Rounding.UP, quantity, mark)


def capacity(value: float, quantity: Quantity = Quantity.RATIO, mark: str = "") -> Amount:
    """Return a provided value, or a capacity."""
    return Amount(value, Rounding.DOWN, quantity, mark)


# Asked again and again for the same values: without what it keeps, an answer of the page about 30
# arrays with 61 clearances would take 40 ms instead of 35.
@lru_cache(4096)
def in_order(
    found: Amount, limit: Amount, decimals: int, *, is_at_least: bool, size: float = 1.0
) -> tuple[str, str]:
    """Return a value found and its limit for print, in the order in which they are.

    Values close to each other get more digits: an unmet limit never reads as met, nor the reverse.
    """
    is_met = _is_met(found.value, limit.value, is_at_least=is_at_least)
    ways = [((found, limit), decimals + extra) for extra in range(_MOST_MORE + 1)]
    safe, opposite = (demand, capacity) if is_at_least else (capacity, demand)
    # At the last, rounded so that it shows, whatever the digits: equal values alike.
    as_they_are = (entered(found.value), entered(limit.value)), decimals + 1
    apart = (opposite(found.value), safe(limit.value)), decimals
    for both, digits in (*ways, as_they_are if is_met else apart):
        rounded = (amount.rounding.of(amount.value / size, digits) for amount in both)
        if _is_met(*rounded, is_at_least=is_at_least) is is_met:
            break
    first, second = (amount.text(size, digits) for amount in both)
    return first, second


def _is_met(found: float, limit: float, *, is_at_least: bool) -> bool:
    return at_least(found, limit) if is_at_least else at_least(limit, found)


def shown_in_order(found: Amount, limit: Amount, *, is_at_least: bool = True) -> tuple[Show, Show]:
    """Return the format of a value found and its limit, side by side, in any unit."""

    def texts(unit: Unit) -> tuple[str, str]:
        return in_order(found, limit, unit.decimals, is_at_least=is_at_least, size=unit.si)

    def show_found(_: float, unit: Unit) -> str:
        return texts(unit)[0]

    def show_limit(_: float, unit: Unit) -> str:
        return texts(unit)[1]

    return show_found, show_limit


def compared_pairs(
    found: Amount, limit: Amount, quantity: Quantity, us_first: bool, *, is_at_least: bool = True
) -> tuple[str, str]:
    """Return a value found and its limit in both systems, in the order in which they are."""
    shows = shown_in_order(found, limit, is_at_least=is_at_least)
    first, second = (pair(math.nan, quantity, us_first, show) for show in shows)
    return first, second


def limit_texts(check: Limit, us_first: bool) -> tuple[str, str]:
    """Return the value found and the limit, with the units of its measure."""
    return amount_texts(*limit_amounts(check), us_first, is_at_least=check.is_at_least)


_QUANTITIES = {
    Measure.ANGLE_DEG: Quantity.ANGLE,
    Measure.LENGTH_M: Quantity.SIZE,
    Measure.TIME_S: Quantity.TIME,
    Measure.VELOCITY_MPS: Quantity.VELOCITY,
    Measure.COUNT: Quantity.COUNT,
    Measure.PLAIN: Quantity.RATIO,
}


def limit_amounts(check: Limit) -> tuple[Amount, Amount]:
    """Return the value found, and the limit."""
    quantity = _QUANTITIES[check.measure]
    if check.key and quantity is Quantity.RATIO:
        quantity = Quantity.COEFFICIENT
    is_at_least = check.is_at_least
    limit = (demand if is_at_least else capacity)(check.limit, quantity)
    # A limit of the rule set looks at what was entered, one on the motions at what is computed.
    if check.key:
        return entered(check.found, quantity), limit
    return (capacity if is_at_least else demand)(check.found, quantity), limit


def amount_texts(
    found: Amount, limit: Amount, us_first: bool, *, is_at_least: bool, is_both: bool = True
) -> tuple[str, str]:
    """Return a value found and its limit with units, in the order in which they are.

    Where it is not both systems, in the preferred one alone.
    """
    quantity = limit.quantity
    if quantity is Quantity.ANGLE and is_both:
        degrees = in_order(found, limit, 2, is_at_least=is_at_least)
        slope, limit_slope = (
            replace(amount, value=100.0 * math.tan(math.radians(amount.value)))
            for amount in (found, limit)
        )
        # Ordered by themselves: degrees that differ may round to one percentage.
        percents = in_order(slope, limit_slope, 1, is_at_least=is_at_least)
        texts = [f"{a}° ({b}%)" for a, b in zip(degrees, percents, strict=True)]
    elif quantity.has_systems and is_both:
        texts = [*compared_pairs(found, limit, quantity, us_first, is_at_least=is_at_least)]
    else:
        unit = quantity.us if us_first else quantity.si
        both = in_order(found, limit, unit.decimals, is_at_least=is_at_least, size=unit.si)
        texts = [with_unit(text, unit.symbol) for text in both]
    return texts[0] + found.mark, texts[1] + limit.mark


def amount_text(amount: Amount, us_first: bool, *, is_both: bool = True) -> str:
    """Return an amount with its units that is not compared with another."""
    return amount_texts(amount, amount, us_first, is_at_least=True, is_both=is_both)[0]
