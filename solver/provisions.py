"""The code rules as data, and the few formulas that read them: one table for each rule set.

Rule sets are kept apart and never mixed; each number has its clause and how sure it is. Lengths
in the tables are inches because the codes are; every function takes and gives SI.
Knows nothing of motions or solvers.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from enum import StrEnum

import numpy as np

from solver.model import Floats, InputError

INCH_M = 0.0254
# Limits such as "1 in 20" meet typed slopes such as "5 percent": equal up to this ratio is equal.
_EQUAL = 1e-9


class Confidence(StrEnum):
    """How sure a number is; everything but CONFIRMED is marked for the reader to verify."""

    CONFIRMED = "C"  # against a published permit calculation
    KNOWN = "K"  # commonly known, consistent across sources, text not at hand
    LOW = "L"


@dataclass(frozen=True, slots=True, kw_only=True)
class Provision:
    """One number of a rule set, with its clause; `reason` is not empty once overridden."""

    value: float
    clause: str
    confidence: Confidence
    reason: str = ""

    @property
    def verified(self) -> bool:
        """Whether it needs no mark: confirmed and not overridden."""
        return self.confidence is Confidence.CONFIRMED and not self.reason


# What a workbook may override, with the meaning and the unit of the value.
OVERRIDABLE: Mapping[str, str] = {
    "prescriptive_factor_in": "factor of (S_DS - 0.4)^2 in the prescriptive displacement [in]",
    "prescriptive_minimum_in": "least prescriptive displacement [in]",
    "prescriptive_low_sdc_in": "prescriptive displacement in SDC A, B, C [in]",
    "prescriptive_max_slope_deg": "steepest slope for the prescriptive route [deg]",
    "prescriptive_min_mu": "least friction coefficient for the prescriptive route",
    "analysis_max_slope_deg": "steepest slope for the analysis route [deg]",
    "max_storeys": "most storeys of the building",
    "max_risk_category": "highest risk category (I = 1 ... IV = 4)",
    "low_profile_in": "greatest height of the centre of gravity [in]",
    "low_profile_ratio": "greatest height of the centre of gravity / least support dimension",
    "analysis_min_motions": "fewest motions for the analysis route",
    "analysis_mean_motions": "fewest motions for a value from the mean",
    "analysis_factor": "factor of the mean or of the largest peak",
    "analysis_floor": "least share of the prescriptive displacement without peer review",
    "separation_like": "separation between like arrays / design displacement",
    "separation_fixed": "separation to a fixed object or unlike array / design displacement",
    "separation_parapet": "separation to an edge with a qualifying parapet / design displacement",
    "separation_edge": "separation to an edge without / design displacement",
    "separation_edge_min_in": "least separation to an edge without a qualifying parapet [in]",
    "parapet_height_in": "least height of a qualifying parapet above the roof [in]",
    "parapet_over_cg_in": "least height of a qualifying parapet above the array's c.g. [in]",
    "interconnection_sds": "interconnection strength / (S_DS W1)",
    "interconnection_min": "least interconnection strength / W1",
}


@dataclass(frozen=True, slots=True, kw_only=True)
class RuleSet:
    """One adopted document: its numbers by key, and where the importance factor enters."""

    name: str
    title: str
    values: Mapping[str, Provision]
    importance_in_separation: bool  # else it is inside the displacement: never both
    low_sdc_is_flat: bool  # SDC A, B, C take a flat displacement instead of the formula
    mu_rises_with_slope: bool

    def __getitem__(self, key: str) -> float:
        return self.values[key].value

    def length_m(self, key: str) -> float:
        """Return a number kept in inches as metres."""
        return self.values[key].value * INCH_M

    def overridden(self, changes: Mapping[str, tuple[float, str]]) -> RuleSet:
        """Return the rule set with some numbers replaced: key -> (value, reason).

        Raises
        ------
        InputError
            For every key that the rule set does not have.
        """
        unknown = [key for key in changes if key not in self.values]
        if unknown:
            known = ", ".join(self.values)
            raise InputError([f"provision is '{key}'; {self.name} has {known}" for key in unknown])
        values = dict(self.values)
        for key, (value, reason) in changes.items():
            values[key] = replace(values[key], value=value, reason=reason)
        return replace(self, values=values)


def _table(rows: str, document: str) -> dict[str, Provision]:
    """Read rows of `key value confidence clause`."""
    table = {}
    for row in rows.strip().splitlines():
        key, value, confidence, clause = row.split(maxsplit=3)
        table[key] = Provision(
            value=float(value), clause=f"{document} {clause}", confidence=Confidence(confidence)
        )
    return table


_PV1 = """
prescriptive_factor_in      60     C  Sec. 6
prescriptive_minimum_in     6      K  Sec. 6
prescriptive_low_sdc_in     6      K  Sec. 6
prescriptive_max_slope_deg  3      K  Sec. 6
prescriptive_min_mu         0.4    K  Sec. 6
analysis_max_slope_deg      7      K  Sec. 5
max_storeys                 6      K  Sec. 5
max_risk_category           3      K  Sec. 5
low_profile_in              36     K  Sec. 5
low_profile_ratio           0.5    K  Sec. 5
analysis_min_motions        3      K  Sec. 9
analysis_mean_motions       7      K  Sec. 9
analysis_factor             1.1    K  Sec. 9
analysis_floor              0.5    K  Sec. 9
separation_like             0.5    C  Sec. 6
separation_fixed            1.0    C  Sec. 6
separation_parapet          1.0    C  Sec. 6
separation_edge             2.0    C  Sec. 6
separation_edge_min_in      0      K  Sec. 6
parapet_height_in           24     K  Sec. 6
parapet_over_cg_in          6      K  Sec. 6
interconnection_sds         0.133  K  Sec. 6
interconnection_min         0.1    K  Sec. 6
"""

# Slopes of 1 in 20 and 1 in 12; no second parapet height is stated.
_ASCE = f"""
prescriptive_factor_in      60     C  13.6.12
prescriptive_minimum_in     24     K  13.6.12
prescriptive_max_slope_deg  {math.degrees(math.atan(1 / 20))!r}  K  13.6.12
prescriptive_min_mu         0.4    K  13.6.12
analysis_max_slope_deg      {math.degrees(math.atan(1 / 12))!r}  L  13.6.12
max_storeys                 6      K  13.6.12
max_risk_category           3      K  13.6.12
low_profile_in              36     K  13.6.12
low_profile_ratio           0.5    K  13.6.12
analysis_min_motions        3      L  13.6.12
analysis_mean_motions       7      L  13.6.12
analysis_factor             1.1    L  13.6.12
analysis_floor              0.8    K  13.6.12
separation_like             0.5    C  13.6.12
separation_fixed            1.0    C  13.6.12
separation_parapet          1.0    C  13.6.12
separation_edge             2.0    C  13.6.12
separation_edge_min_in      48     K  13.6.12
parapet_height_in           12     K  13.6.12
parapet_over_cg_in          0      K  13.6.12
interconnection_sds         0.133  K  13.6.12
interconnection_min         0.1    K  13.6.12
"""


def _lowered(table: dict[str, Provision]) -> dict[str, Provision]:
    """Mark what differs in an edition that was not compared as low confidence."""
    return {
        key: row
        if row.confidence is Confidence.CONFIRMED
        else replace(row, confidence=Confidence.LOW)
        for key, row in table.items()
    }


RULE_SETS: Mapping[str, RuleSet] = {
    rules.name: rules
    for rules in (
        RuleSet(
            name="SEAOC PV1-2012",
            title="SEAOC PV1-2012, Structural Seismic Requirements and Commentary for Rooftop "
            "Solar Photovoltaic Arrays",
            values=_table(_PV1, "PV1-2012"),
            importance_in_separation=True,
            low_sdc_is_flat=True,
            mu_rises_with_slope=False,
        ),
        RuleSet(
            name="ASCE 7-16",
            title="ASCE/SEI 7-16, Minimum Design Loads and Associated Criteria for Buildings "
            "and Other Structures, 13.6.12",
            values=_table(_ASCE, "ASCE 7-16"),
            importance_in_separation=False,
            low_sdc_is_flat=False,
            mu_rises_with_slope=True,
        ),
        RuleSet(
            name="ASCE 7-22",
            title="ASCE/SEI 7-22, Minimum Design Loads and Associated Criteria for Buildings "
            "and Other Structures, 13.6.12",
            values=_lowered(_table(_ASCE, "ASCE 7-22")),
            importance_in_separation=False,
            low_sdc_is_flat=False,
            mu_rises_with_slope=True,
        ),
    )
}


@dataclass(frozen=True, slots=True, kw_only=True)
class Prescriptive:
    """The prescriptive displacement: what the formula gives, its minimum, and what governs."""

    formula_m: float
    minimum_m: float
    value_m: float
    governs: str


def prescriptive_displacement(
    rules: RuleSet, *, s_ds_g: float, sdc: str, importance: float
) -> Prescriptive:
    """Return the prescriptive design seismic displacement.

    PV1-2012: 60 in (S_DS - 0.4)^2 and not below 6 in (SDC D, E, F), 6 in in SDC A, B, C.
    ASCE 7, 13.6.12: 5 I_e (S_DS - 0.4)^2 ft and not below 24 in. Below S_DS = 0.4 g the bracket
    is zero.
    """
    bracket = max(s_ds_g - 0.4, 0.0)
    formula = rules.length_m("prescriptive_factor_in") * bracket**2
    if not rules.importance_in_separation:
        formula *= importance
    minimum = rules.length_m("prescriptive_minimum_in")
    if rules.low_sdc_is_flat and sdc in "ABC":
        flat = rules.length_m("prescriptive_low_sdc_in")
        return Prescriptive(formula_m=formula, minimum_m=flat, value_m=flat, governs="SDC A, B, C")
    return Prescriptive(
        formula_m=formula,
        minimum_m=minimum,
        value_m=max(formula, minimum),
        governs="formula" if formula >= minimum else "minimum",
    )


class Basis(StrEnum):
    """Which statistic of the peaks the design value comes from."""

    MEAN_FACTORED = "1.1 x mean"
    LARGEST_FACTORED = "1.1 x largest"
    MEAN = "mean"
    TOO_FEW = "too few motions"


@dataclass(frozen=True, slots=True, kw_only=True)
class AnalysisValue:
    """Displacement by response-history analysis from the peaks of the motions [m].

    NaN where a peak is NaN or the motions are too few: then there is no value to design with.
    """

    n_motions: int
    mean_m: float
    largest_m: float
    basis: Basis
    factor: float
    value_m: float


MEAN_WITHOUT_FACTOR_MOTIONS = 11  # ASCE 7 Chapter 16 practice, offered for ASCE rule sets


def analysis_value(
    rules: RuleSet, peaks_m: Sequence[float], basis: Basis | None = None
) -> AnalysisValue:
    """Return the value from analysis; `basis` None follows the rule set.

    PV1-2012 Sec. 9: 7 motions or more, 1.1 x mean of the peaks; 3 to 6, 1.1 x the largest.
    A chosen basis that the number of motions does not allow gives `Basis.TOO_FEW`.
    """
    n = len(peaks_m)
    mean = sum(peaks_m) / n if n else math.nan
    largest = math.nan if mean != mean else max(peaks_m)
    if basis is None:
        enough = n >= rules["analysis_mean_motions"]
        basis = Basis.MEAN_FACTORED if enough else Basis.LARGEST_FACTORED
    factor = 1.0 if basis is Basis.MEAN else rules["analysis_factor"]
    if n < least_motions(rules, basis):
        basis, value = Basis.TOO_FEW, math.nan
    else:
        value = factor * (largest if basis is Basis.LARGEST_FACTORED else mean)
    return AnalysisValue(
        n_motions=n, mean_m=mean, largest_m=largest, basis=basis, factor=factor, value_m=value
    )


def least_motions(rules: RuleSet, basis: Basis) -> float:
    """Return how many motions a statistic needs."""
    return {
        Basis.MEAN_FACTORED: rules["analysis_mean_motions"],
        Basis.LARGEST_FACTORED: rules["analysis_min_motions"],
        Basis.MEAN: float(MEAN_WITHOUT_FACTOR_MOTIONS),
        Basis.TOO_FEW: math.inf,
    }[basis]


class Neighbour(StrEnum):
    """What lies across a clearance."""

    LIKE = "like array"
    FIXED = "fixed object"
    UNLIKE = "unlike array"
    PARAPET = "edge with qualifying parapet"
    EDGE = "edge without qualifying parapet"


SEPARATION_KEYS: Mapping[Neighbour, str] = {
    Neighbour.LIKE: "separation_like",
    Neighbour.FIXED: "separation_fixed",
    Neighbour.UNLIKE: "separation_fixed",
    Neighbour.PARAPET: "separation_parapet",
    Neighbour.EDGE: "separation_edge",
}


def required_separation(
    rules: RuleSet, neighbour: Neighbour, *, design_m: float, importance: float
) -> float:
    """Return the required separation [m]: factor x I x design displacement, least value applied.

    The importance factor enters here only where it is not inside the displacement.
    """
    required = rules[SEPARATION_KEYS[neighbour]] * design_m
    if rules.importance_in_separation:
        required *= importance
    if neighbour is Neighbour.EDGE and required == required:
        required = max(required, rules.length_m("separation_edge_min_in"))
    return required


def parapet_qualifies(rules: RuleSet, *, parapet_height_m: float, cg_height_m: float) -> bool:
    """Whether a parapet is high enough above the roof and above the array's c.g.

    Its strength (0.2 S_DS W impact in ASCE 7) is not checked here.
    """
    return _at_least(parapet_height_m, rules.length_m("parapet_height_in")) and _at_least(
        parapet_height_m - cg_height_m, rules.length_m("parapet_over_cg_in")
    )


def interconnection_strength_n(rules: RuleSet, *, s_ds_g: float, w1_n: float) -> float:
    """Return the interconnection strength [N] for a part of weight w1_n on its lighter side."""
    return max(rules["interconnection_sds"] * s_ds_g, rules["interconnection_min"]) * w1_n


class Measure(StrEnum):
    """How the numbers of a check read."""

    ANGLE_DEG = "deg"
    LENGTH_M = "m"
    COUNT = "count"
    PLAIN = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class Check:
    """A limit of a rule set against what the project has; NaN never passes."""

    title: str
    found: float
    limit: float
    at_most: bool
    measure: Measure
    key: str
    provision: Provision

    @property
    def ok(self) -> bool:
        """Whether the limit is kept; equal within rounding is kept."""
        return _at_least(*((self.limit, self.found) if self.at_most else (self.found, self.limit)))


def _at_least(value: float, limit: float) -> bool:
    return value >= limit - _EQUAL * abs(limit)


def required_mu(rules: RuleSet, slope_rad: float) -> float:
    """Return the least friction coefficient of the prescriptive route at a slope.

    ASCE 7, 13.6.12: 0.4 to a slope of 1 in 33, then 0.4 + 0.7 (slope - 0.03).
    """
    rise = max(math.tan(abs(slope_rad)) - 0.03, 0.0) if rules.mu_rises_with_slope else 0.0
    return rules["prescriptive_min_mu"] + 0.7 * rise


def building_checks(rules: RuleSet, *, risk_category: int, storeys: int) -> tuple[Check, ...]:
    """Return the limits on the building that both routes keep."""
    return (
        _check(rules, "Risk category (I = 1 to IV = 4)", risk_category, "max_risk_category"),
        _check(rules, "Number of storeys", storeys, "max_storeys"),
    )


def array_checks(
    rules: RuleSet, *, cg_height_m: float, support_spacing_m: float
) -> tuple[Check, ...]:
    """Return the low-profile limits that both routes keep."""
    spacing = rules["low_profile_ratio"] * support_spacing_m
    return (
        _check(
            rules,
            "Height of the centre of gravity",
            cg_height_m,
            "low_profile_in",
            limit=min(spacing, rules.length_m("low_profile_in")),
            measure=Measure.LENGTH_M,
        ),
    )


def prescriptive_checks(rules: RuleSet, *, slope_rad: float, mu: float) -> tuple[Check, ...]:
    """Return the limits of the prescriptive route."""
    return (
        _check(
            rules,
            "Roof slope, prescriptive route",
            math.degrees(abs(slope_rad)),
            "prescriptive_max_slope_deg",
            measure=Measure.ANGLE_DEG,
        ),
        _check(
            rules,
            "Friction coefficient, prescriptive route",
            mu,
            "prescriptive_min_mu",
            limit=required_mu(rules, slope_rad),
            at_most=False,
            measure=Measure.PLAIN,
        ),
    )


def analysis_checks(rules: RuleSet, *, slope_rad: float, n_motions: int) -> tuple[Check, ...]:
    """Return the limits of the analysis route."""
    return (
        _check(
            rules,
            "Roof slope, analysis route",
            math.degrees(abs(slope_rad)),
            "analysis_max_slope_deg",
            measure=Measure.ANGLE_DEG,
        ),
        _check(
            rules,
            "Number of motions",
            n_motions,
            "analysis_min_motions",
            at_most=False,
        ),
    )


def _check(
    rules: RuleSet,
    title: str,
    found: float,
    key: str,
    *,
    limit: float | None = None,
    at_most: bool = True,
    measure: Measure = Measure.COUNT,
) -> Check:
    return Check(
        title=title,
        found=found,
        limit=rules[key] if limit is None else limit,
        at_most=at_most,
        measure=measure,
        key=key,
        provision=rules.values[key],
    )


@dataclass(frozen=True, slots=True, kw_only=True)
class RequiredSpectrum:
    """AC156 required response spectrum: corners to join by straight lines on log-log axes.

    Attributes
    ----------
    freq_hz, sa_g : array, shape (4,)
    """

    freq_hz: Floats
    sa_g: Floats

    def at(self, freq_hz: Floats) -> Floats:
        """Return ordinates [g] at frequencies [Hz], flat outside the corners."""
        return np.asarray(
            np.exp(np.interp(np.log(freq_hz), np.log(self.freq_hz), np.log(self.sa_g))),
            dtype=np.float64,
        )


def ac156_horizontal(rules: RuleSet, *, s_ds_g: float, z_over_h: float) -> RequiredSpectrum:
    """Return the horizontal AC156 spectrum, 5 % damping.

    A_FLX = S_DS (1 + 2 z/h) <= 1.6 S_DS, A_RIG = 0.4 S_DS (1 + 2 z/h); with ASCE 7-22
    A_FLX = S_DS H_f/R_mu <= 1.6 S_DS, A_RIG = 0.4 S_DS H_f/R_mu, H_f = 1 + 2.5 z/h, R_mu = 1.3.
    """
    ratio = (1.0 + 2.5 * z_over_h) / 1.3 if rules.name == "ASCE 7-22" else 1.0 + 2.0 * z_over_h
    return _corners(min(ratio, 1.6) * s_ds_g, 0.4 * ratio * s_ds_g)


def ac156_vertical(*, s_ds_g: float) -> RequiredSpectrum:
    """Return the vertical AC156 spectrum: 0.67 S_DS and 0.27 S_DS."""
    return _corners(0.67 * s_ds_g, 0.27 * s_ds_g)


def _corners(flexible_g: float, rigid_g: float) -> RequiredSpectrum:
    return RequiredSpectrum(
        freq_hz=np.array([0.1, 1.3, 8.3, 33.3]),
        sa_g=np.array([0.1 * flexible_g, flexible_g, flexible_g, rigid_g]),
    )
