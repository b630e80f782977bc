"""Seismic design parameters of ASCE 7: ground-motion values, SDC, T_a and F_p.

With S_S = 1.271 g and F_a = 1.2, S_MS is 1.525 g and S_DS 1.017 g.

The edition of these parameters is independent of the rule set: PV1-2012 is used with any. Read
`EDITIONS`, then `SeismicParameters`.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from enum import StrEnum
from types import MappingProxyType

from solver.errors import raise_any


@dataclass(frozen=True, slots=True, kw_only=True)
class Amplification:
    """Ratio of floor to ground acceleration at height z: (1 + slope z/h) / reduction."""

    slope: float
    reduction: float

    def at(self, z_over_h: float) -> float:
        """Return the ratio at a relative height z/h; there is no reduction at grade."""
        return self.height_factor(z_over_h) / self.reduction_at(z_over_h)

    def reduction_at(self, z_over_h: float) -> float:
        """Return the reduction at a relative height z/h: R_mu of ASCE 7-22 above grade."""
        return self.reduction if z_over_h > 0.0 else 1.0

    def height_factor(self, z_over_h: float) -> float:
        """Return 1 + slope z/h: the factor of ASCE 7-16, H_f of ASCE 7-22 for unknown period."""
        return 1.0 + self.slope * z_over_h


@dataclass(frozen=True, slots=True, kw_only=True)
class Edition:
    """An edition of ASCE 7, as far as the seismic design parameters of a site depend on it."""

    name: str
    has_site_coefficients: bool  # S_MS, S_M1 from F_a, F_v; otherwise from a hazard tool
    amplification: Amplification  # from ground to roof, in AC156 and in F_p
    force_factors: tuple[str, str]  # symbols of the factor on F_p and of its divisor
    clauses: Mapping[str, str]  # of each parameter, by the names used here

    def clause(self, topic: str) -> str:
        """Return edition and clause, as in `ASCE 7-16 11.4.4`."""
        return f"{self.name} {self.clauses[topic]}"


_COMMON = {
    "mapped": "11.4.2",
    "s_ds": "11.4.5",
    "sdc": "11.6",
    "sdc_short": "Table 11.6-1",
    "sdc_1s": "Table 11.6-2",
    "t_l": "11.4.6",
    "period": "12.8.2.1",
    "force": "13.3.1",
    "component_importance": "13.1.3",
    "component_factors": "Tables 13.5-1, 13.6-1",
    "importance": "Table 1.5-2",
    "risk_category": "Table 1.5-1",
    "site_class": "chapter 20",
}

EDITIONS: Mapping[str, Edition] = {
    edition.name: edition
    for edition in (
        Edition(
            name="ASCE 7-16",
            has_site_coefficients=True,
            amplification=Amplification(slope=2.0, reduction=1.0),
            # a_p and R_p of 7-16 became C_AR and R_po of 7-22.
            force_factors=("a_p", "R_p"),
            clauses=_COMMON | {"s_ms": "11.4.4", "site_specific": "11.4.8"},
        ),
        Edition(
            name="ASCE 7-22",
            has_site_coefficients=False,
            # R_mu = sqrt(1.1 R / (I_e Omega_0)) >= 1.3 if the structural system is known; 1.3 is
            # conservative.
            amplification=Amplification(slope=2.5, reduction=1.3),
            force_factors=("C_AR", "R_po"),
            clauses=_COMMON
            | {
                "mapped": "11.4.3",
                "s_ms": "11.4.3",
                "s_ds": "11.4.4",
                "t_l": "11.4.5",
                "site_specific": "11.4.7",
            },
        ),
    )
}
"""Every edition of ASCE 7 by its name."""

# Edition of ASCE 7 by building code, as commonly known of its chapter 35; each has 13.6.12.
REFERENCED: Mapping[str, str] = {
    **dict.fromkeys(("2018 IBC", "2021 IBC", "2019 CBC", "2022 CBC"), "ASCE 7-16"),
    **dict.fromkeys(("2024 IBC", "2025 CBC"), "ASCE 7-22"),
}


@dataclass(frozen=True, slots=True, kw_only=True)
class SeismicParameters:
    """Ground-motion values of a site [g]; None if neither entered nor derivable.

    S_MS = F_a S_S, S_M1 = F_v S_1 (ASCE 7-16 11.4.4); S_DS = 2/3 S_MS, S_D1 = 2/3 S_M1.
    """

    s_ms: float | None
    s_m1: float | None
    s_ds: float | None
    s_d1: float | None

    @property
    def t_s(self) -> float | None:
        """T_S = S_D1 / S_DS [s]."""
        return None if self.s_ds is None or self.s_d1 is None else self.s_d1 / self.s_ds


def seismic_parameters(
    edition: Edition,
    *,
    s_s: float | None = None,
    s_1: float | None = None,
    f_a: float | None = None,
    f_v: float | None = None,
    s_ms: float | None = None,
    s_m1: float | None = None,
    s_ds: float | None = None,
    s_d1: float | None = None,
) -> SeismicParameters:
    """Return the parameters of a site, each as entered or otherwise derived, unrounded [g].

    A given S_DS without S_MS gives S_MS = 3/2 S_DS, and likewise at 1 s.
    """
    # Unrounded: with S_DS rounded first, a permit sheet's separation of 2.12 ft would be 2.11 ft.
    s_ms, s_ds = _pair(edition, s_s, f_a, s_ms, s_ds)
    s_m1, s_d1 = _pair(edition, s_1, f_v, s_m1, s_d1)
    return SeismicParameters(s_ms=s_ms, s_m1=s_m1, s_ds=s_ds, s_d1=s_d1)


def _pair(
    edition: Edition,
    mapped: float | None,
    coefficient: float | None,
    maximum: float | None,
    design: float | None,
) -> tuple[float | None, float | None]:
    """Return the maximum considered and the design value at one period."""
    # 7-22 has no F_a and F_v: its maps give S_MS and S_M1 with the site class in them.
    if maximum is None and edition.has_site_coefficients:
        maximum = None if mapped is None or coefficient is None else coefficient * mapped
    if maximum is None:
        return (None if design is None else 1.5 * design), design
    return maximum, 2.0 / 3.0 * maximum if design is None else design


# Lower ends of the rows of Tables 11.6-1 and 11.6-2 from the second on, and S_1 of 11.6. The tables
# end at D: E and F follow from S_1 alone.
LIMITS_SHORT_G = (0.167, 0.33, 0.50)
LIMITS_1S_G = (0.067, 0.133, 0.20)
NEAR_FAULT_S_1_G = 0.75
MOST_BY_TABLES = "D"


def design_categories(
    *, s_ds_g: float, s_d1_g: float | None, s_1_g: float | None, is_essential: bool
) -> tuple[str, str, str]:
    """Return the SDC by S_DS, by S_D1 and by S_1 (ASCE 7, 11.6); the most severe one controls.

    Those of Tables 11.6-1 and 11.6-2; E or F where S_1 is 0.75 g or more. Empty for a value that is
    not known, and for a smaller S_1. Essential: risk category IV.
    """
    # Tables 11.6-1 and 11.6-2: risk category IV is one letter up from the second row on, D stays D.
    steps = "ACDD" if is_essential else "ABCD"

    def by(value_g: float | None, limits_g: tuple[float, float, float]) -> str:
        # The table rows are "less than": a value equal to a limit belongs to the next row.
        return "" if value_g is None else steps[sum(value_g >= limit for limit in limits_g)]

    is_near = s_1_g is not None and s_1_g >= NEAR_FAULT_S_1_G
    by_s_1 = ("F" if is_essential else "E") if is_near else ""
    return by(s_ds_g, LIMITS_SHORT_G), by(s_d1_g, LIMITS_1S_G), by_s_1


# Importance factor I_e by risk category (ASCE 7, Table 1.5-2).
LEAST_I_E: Mapping[str, float] = {"I": 1.0, "II": 1.0, "III": 1.25, "IV": 1.5}


class HazardBasis(StrEnum):
    """Source of the ground motion values of a site."""

    MAPPED = "mapped values"
    SITE_SPECIFIC = "site-specific analysis"
    EXCEPTION = "exception of 11.4.8"


# Least F_a where site class D is assumed by default (ASCE 7-16 11.4.4).
LEAST_F_A_BY_DEFAULT = 1.2


@dataclass(frozen=True, slots=True, kw_only=True)
class ComponentForce:
    """Seismic design force of a nonstructural component / its weight (ASCE 7, 13.3.1)."""

    formula: float
    maximum: float
    minimum: float

    @property
    def value(self) -> float:
        """F_p / W_p: the formula within its limits."""
        return min(max(self.formula, self.minimum), self.maximum)


def component_force(
    edition: Edition,
    *,
    s_ds_g: float,
    factor: float,
    divisor: float,
    i_p: float,
    z_over_h: float,
    period_s: float | None = None,
) -> ComponentForce:
    """Return F_p / W_p with its maximum and minimum.

    ASCE 7-16 Eqs. 13.3-1 to 13.3-3: 0.4 a_p S_DS (1 + 2 z/h) / (R_p / I_p); ASCE 7-22:
    0.4 S_DS I_p (H_f / R_mu) (C_AR / R_po), with H_f = 1 + 2.5 z/h where the period of the building
    is unknown and R_mu = 1.3 above grade. At most 1.6 S_DS I_p, at least 0.3 S_DS I_p. The factor
    and its divisor are a_p and R_p, or C_AR and R_po; the period is T_a of the building.
    """
    amplified = edition.amplification.at(z_over_h)
    # H_f of the known period takes the place of the one that `amplification` has in it.
    if period_s is not None and not edition.has_site_coefficients:
        known, unknown = period_height_factor(z_over_h, period_s), edition.amplification
        amplified *= known / unknown.height_factor(z_over_h)
    return ComponentForce(
        formula=0.4 * s_ds_g * i_p * amplified * factor / divisor,
        maximum=1.6 * s_ds_g * i_p,
        minimum=0.3 * s_ds_g * i_p,
    )


def period_height_factor(z_over_h: float, period_s: float) -> float:
    """Return H_f of ASCE 7-22, 13.3.1.1 for a known period: 1 + a1 (z/h) + a2 (z/h)^10."""
    a1 = min(1.0 / period_s, 2.5)
    a2 = max(1.0 - (0.4 / period_s) ** 2, 0.0)
    return 1.0 + a1 * z_over_h + a2 * z_over_h**10


# C_t and x of T_a = C_t h_n^x, h_n in feet: ASCE 7-16 and 7-22, 12.8.2.1, Table 12.8-2.
APPROXIMATE_PERIODS = MappingProxyType(
    {
        "steel moment frame": (0.028, 0.8),
        "concrete moment frame": (0.016, 0.9),
        "steel eccentric or buckling-restrained braces": (0.03, 0.75),
        "other": (0.02, 0.75),
    }
)

FOOT_M = 0.3048


def approximate_period_s(system: str, height_m: float) -> float:
    """Return T_a = C_t h_n^x of ASCE 7, 12.8.2.1 (Eq. 12.8-7).

    T_a is intentionally short, which is conservative for design forces but not necessarily for the
    motion of a roof. The system is a key of `APPROXIMATE_PERIODS`.
    """
    problems = []
    if system not in APPROXIMATE_PERIODS:
        problems.append(
            f"structure: found {system!r}; enter one of {', '.join(APPROXIMATE_PERIODS)}"
        )
    if not 0.0 < height_m < math.inf:
        problems.append(f"height: found {height_m} m; enter a number above 0")
    raise_any(problems)
    coefficient, exponent = APPROXIMATE_PERIODS[system]
    # C_t is for customary units, with h_n in feet.
    return float(coefficient * (height_m / FOOT_M) ** exponent)
