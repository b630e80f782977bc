"""Approximate periods of buildings by ASCE 7, when no analysis or measurement is available.

Contains one equation and its table. Read `approximate_period_s`; `solver.building.structure` uses
periods.
"""

from __future__ import annotations

import math
from types import MappingProxyType

from solver.model import InputError

APPROXIMATE_PERIODS = MappingProxyType(
    {
        "steel moment frame": (0.028, 0.8),
        "concrete moment frame": (0.016, 0.9),
        "steel eccentric or buckling-restrained braces": (0.03, 0.75),
        "other": (0.02, 0.75),
    }
)
"""C_t and x of T_a = C_t h_n^x, h_n in feet: ASCE 7-16 and 7-22, 12.8.2.1, Table 12.8-2."""

FOOT_M = 0.3048


def approximate_period_s(system: str, height_m: float) -> float:
    """Return T_a = C_t h_n^x of ASCE 7, 12.8.2.1 (Eq. 12.8-7).

    T_a is intentionally short, which is conservative for design forces but not necessarily for the
    motion of a roof.

    Parameters
    ----------
    system : str
        A key of `APPROXIMATE_PERIODS`.
    height_m : float
        Structural height h_n [m], > 0.

    Raises
    ------
    InputError
    """
    problems = []
    if system not in APPROXIMATE_PERIODS:
        problems.append(
            f"structure: found {system!r}; give one of {', '.join(APPROXIMATE_PERIODS)}"
        )
    if not 0.0 < height_m < math.inf:
        problems.append(f"height: found {height_m} m; give a number above 0")
    if problems:
        raise InputError(problems)
    coefficient, exponent = APPROXIMATE_PERIODS[system]
    return float(coefficient * (height_m / FOOT_M) ** exponent)
