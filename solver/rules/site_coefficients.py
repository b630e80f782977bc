"""The site coefficients F_a and F_v of ASCE 7-16, Tables 11.4-1 and 11.4-2, by site class.

Site class D has F_a = 1.4 at S_S = 0.5, and 1.3 at 0.625, halfway to the next column.

ASCE 7-22 has none. A package uses the coefficients entered in its workbook; the workbook shows
these next to them. Read `site_coefficient`, then `site_specific_reason`.
"""

from __future__ import annotations

import math
from bisect import bisect_right
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from solver.rules.hazard import LEAST_F_A_BY_DEFAULT, Edition
from solver.rules.rulesets import Confidence
from solver.spaces import NO_BREAK

# Site class D where the soil was not investigated.
BY_DEFAULT = "D (default)"


@dataclass(frozen=True, slots=True, kw_only=True)
class CoefficientTable:
    """A table of site coefficients."""

    symbol: str
    edition: str
    clause: str
    mapped_g: tuple[float, ...]  # of the columns; the first and the last one hold beyond them
    rows: Mapping[str, tuple[float, ...]]  # by site class; NaN: it asks for a site-specific hazard
    confidence: Confidence


_D_SHORT = (1.6, 1.4, 1.2, 1.1, 1.0, 1.0)
_D_1S = (2.4, 2.2, 2.0, 1.9, 1.8, 1.7)

F_A = CoefficientTable(
    symbol="F_a",
    edition="ASCE 7-16",
    clause="ASCE 7-16 Table 11.4-1",
    mapped_g=(0.25, 0.5, 0.75, 1.0, 1.25, 1.5),
    rows={
        "A": (0.8,) * 6,
        "B": (0.9,) * 6,
        "C": (1.3, 1.3, 1.2, 1.2, 1.2, 1.2),
        "D": _D_SHORT,
        BY_DEFAULT: tuple(max(value, LEAST_F_A_BY_DEFAULT) for value in _D_SHORT),
        "E": (2.4, 1.7, 1.3, math.nan, math.nan, math.nan),
        "F": (math.nan,) * 6,
    },
    confidence=Confidence.KNOWN,
)

F_V = CoefficientTable(
    symbol="F_v",
    edition="ASCE 7-16",
    clause="ASCE 7-16 Table 11.4-2",
    mapped_g=(0.1, 0.2, 0.3, 0.4, 0.5, 0.6),
    rows={
        "A": (0.8,) * 6,
        "B": (0.8,) * 6,
        "C": (1.5, 1.5, 1.5, 1.5, 1.5, 1.4),
        "D": _D_1S,
        BY_DEFAULT: _D_1S,
        "E": (4.2, math.nan, math.nan, math.nan, math.nan, math.nan),
        "F": (math.nan,) * 6,
    },
    confidence=Confidence.KNOWN,
)


def site_coefficient(table: CoefficientTable, site_class: str, mapped_g: float) -> float:
    """Return a site coefficient, interpolated along a row; NaN where it is site-specific."""
    row, heads = table.rows[site_class], table.mapped_g
    # The first and last columns are "at most" and "at least" in the tables.
    acceleration_g = min(max(mapped_g, heads[0]), heads[-1])
    column = bisect_right(heads, acceleration_g) - 1
    # Not interpolated: NaN beside a tabled value must not spoil it.
    if acceleration_g == heads[column]:
        return row[column]
    share = (acceleration_g - heads[column]) / (heads[column + 1] - heads[column])
    return row[column] + share * (row[column + 1] - row[column])


# S_1 [g] from which site class D needs a site-specific hazard analysis (ASCE 7-16 11.4.8).
LEAST_S_1_OF_D_G = 0.2


def site_specific_reason(
    edition: Edition, *, site_class: str, s_s_g: float | None, s_1_g: float | None
) -> tuple[str, Sequence[str]]:
    """Return why a site needs a site-specific hazard analysis; empty if it does not.

    Names the missing mapped values if they decide whether it does.

    ASCE 7-16 11.4.8: site class F; E where the tables have no coefficient; D with S_1 >= 0.2 g. It
    may need one if the deciding mapped value is not entered. The multi-period values of ASCE 7-22
    leave site class F.
    """
    if site_class == "F":
        return "site class F", ()
    if not edition.has_site_coefficients:
        return "", ()
    name = "site class D by default" if site_class == BY_DEFAULT else f"site class {site_class}"
    missing = []
    for symbol, table, mapped_g in (("S_S", F_A, s_s_g), ("S_1", F_V, s_1_g)):
        if mapped_g is None:
            # With the largest value there is: does it matter at all that this one is missing?
            missing += [symbol] if _needs_analysis(table, site_class, math.inf) else []
        elif _needs_analysis(table, site_class, mapped_g):
            return f"{name} with {symbol} = {mapped_g:g}{NO_BREAK}g", ()
    return f"{name}, {' and '.join(missing)} not entered" if missing else "", missing


def _needs_analysis(table: CoefficientTable, site_class: str, mapped_g: float) -> bool:
    if site_class == "E":
        return math.isnan(site_coefficient(table, site_class, mapped_g))
    return table is F_V and site_class in ("D", BY_DEFAULT) and mapped_g >= LEAST_S_1_OF_D_G
