"""The code rules: the formulas that read a rule set, in SI.

Knows nothing of motions or solvers. The numbers with their clauses are in `solver.rules.rulesets`.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from enum import StrEnum

from solver.rules.rulesets import OVERRIDABLE as OVERRIDABLE
from solver.rules.rulesets import RULE_SETS as RULE_SETS
from solver.rules.rulesets import Confidence as Confidence
from solver.rules.rulesets import Provision as Provision
from solver.rules.rulesets import RuleSet as RuleSet

# Limits such as "1 in 20" meet typed slopes such as "5 percent": equal up to this ratio is equal.
_EQUAL = 1e-9


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
    # A design displacement that is not there must not become the least value.
    return required if required != required else max(required, least_separation_m(rules, neighbour))


def least_separation_m(rules: RuleSet, neighbour: Neighbour) -> float:
    """Return the least separation [m] that a rule set sets whatever the displacement; else 0."""
    return rules.length_m("separation_edge_min_in") if neighbour is Neighbour.EDGE else 0.0


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


def building_checks(rules: RuleSet, *, risk_category: int, stories: int) -> tuple[Check, ...]:
    """Return the limits on the building that both routes keep."""
    return (
        _check(rules, "Risk category (I = 1 to IV = 4)", risk_category, "max_risk_category"),
        _check(rules, "Number of stories", stories, "max_stories"),
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
