"""The formulas of the code rules, in SI, with the numbers of a rule set.

The prescriptive displacement of PV1-2012 at S_DS = 1.0 and I = 1.0 is 60 in (1.0 - 0.4)^2 =
21.6 in.

Independent of motions and solvers. The numbers with their clauses are in `solver.rules.rulesets`.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from enum import StrEnum
from typing import TypeVar

from solver.model import Floats
from solver.rules.limit import Limit, Measure, at_least
from solver.rules.rulesets import ALLOWED, LowProfileLength, RuleSet

Lengths = TypeVar("Lengths", float, Floats)


class PrescriptiveBasis(StrEnum):
    """Basis that governs the prescriptive displacement."""

    LOW_CATEGORY = "SDC A, B, C"
    FORMULA = "equation"
    MINIMUM = "minimum"


@dataclass(frozen=True, slots=True, kw_only=True)
class Prescriptive:
    """The prescriptive displacement, the minimum of its formula, and which governs."""

    minimum_m: float
    value_m: float
    governs: PrescriptiveBasis


def prescriptive_displacement(
    rules: RuleSet, *, s_ds_g: float, sdc: str, importance: float
) -> Prescriptive:
    """Return the prescriptive design seismic displacement.

    PV1-2012: 60 in. (S_DS - 0.4)^2 >= 6 in. in SDC D, E, F; 6 in. in SDC A, B, C.
    ASCE 7, 13.6.12: 5 I_e (S_DS - 0.4)^2 ft >= 24 in. The term (S_DS - 0.4) is taken as zero for
    S_DS below 0.4 g.
    """
    bracket = max(s_ds_g - 0.4, 0.0)
    formula = rules.length_m("prescriptive_factor_in") * bracket**2
    # I once only: here (ASCE 7) or in the separation (PV1-2012), `required_separation`.
    if not rules.importance_in_separation:
        formula *= importance
    minimum = rules.length_m("prescriptive_minimum_in")
    # PV1-2012 alone; ASCE 7 takes its formula in every category.
    if rules.low_sdc_is_flat and sdc in "ABC":
        flat = rules.length_m("prescriptive_low_sdc_in")
        return Prescriptive(minimum_m=flat, value_m=flat, governs=PrescriptiveBasis.LOW_CATEGORY)
    return Prescriptive(
        minimum_m=minimum,
        value_m=max(formula, minimum),
        governs=PrescriptiveBasis.FORMULA if formula >= minimum else PrescriptiveBasis.MINIMUM,
    )


class Basis(StrEnum):
    """Statistic of the peaks on which the design value is based."""

    MEAN_FACTORED = "1.1 x mean"
    LARGEST_FACTORED = "1.1 x largest"
    MEAN = "mean"
    TOO_FEW = "too few motions"

    @property
    def takes_largest(self) -> bool:
        """Whether the value is based on the largest peak instead of the mean."""
        return self is Basis.LARGEST_FACTORED

    @property
    def has_factor(self) -> bool:
        """Whether the value includes the analysis factor of the rule set."""
        return self is not Basis.MEAN


@dataclass(frozen=True, slots=True, kw_only=True)
class AnalysisValue:
    """Displacement by response-history analysis, from the peaks of the motions [m].

    NaN if a peak is NaN or there are too few motions: then there is no design value.
    """

    n_motions: int
    mean_m: float
    largest_m: float
    basis: Basis
    factor: float
    value_m: float


MEAN_WITHOUT_FACTOR_MOTIONS = 11  # ASCE 7 Chapter 16 practice, available with ASCE rule sets


def analysis_value(
    rules: RuleSet, peaks_m: Sequence[float], basis: Basis | None = None
) -> AnalysisValue:
    """Return the value from analysis; with `basis` None the rule set determines the basis.

    PV1-2012: 1.1 x mean of the peaks with 7 motions or more, 1.1 x largest with 3 to 6.
    A basis that requires more motions than are available returns `Basis.TOO_FEW`.
    """
    n = len(peaks_m)
    mean = sum(peaks_m) / n if n else math.nan
    # max() passes over NaN where it does not come first; the mean does not.
    largest = math.nan if mean != mean else max(peaks_m)
    basis_used = basis_for(rules, n, basis)
    return AnalysisValue(
        n_motions=n,
        mean_m=mean,
        largest_m=largest,
        basis=basis_used,
        # The factor of the requested basis, even if there are too few motions for it.
        factor=_factor(rules, basis or basis_used),
        value_m=factored(rules, basis_used, mean, largest),
    )


def basis_for(rules: RuleSet, n_motions: int, asked: Basis | None = None) -> Basis:
    """Return the statistic for a number of motions; with `asked` None that of the rule set."""
    if asked is None:
        enough = n_motions >= rules["analysis_mean_motions"]
        asked = Basis.MEAN_FACTORED if enough else Basis.LARGEST_FACTORED
    return asked if n_motions >= minimum_motions(rules, asked) else Basis.TOO_FEW


def factored(rules: RuleSet, basis: Basis, mean_m: Lengths, largest_m: Lengths) -> Lengths:
    """Return the value from analysis [m] by the mean and the largest peak; NaN if too few."""
    # NaN times any peak is NaN: too few motions give no value, whatever they are.
    factor = math.nan if basis is Basis.TOO_FEW else _factor(rules, basis)
    return factor * (largest_m if basis.takes_largest else mean_m)


def _factor(rules: RuleSet, basis: Basis) -> float:
    return rules["analysis_factor"] if basis.has_factor else 1.0


def analysis_floor_m(
    rules: RuleSet, prescriptive: Prescriptive, *, is_reviewed: bool = False
) -> float:
    """Return the minimum of the value from analysis [m]: none with peer review."""
    return 0.0 if is_reviewed else rules["analysis_floor"] * prescriptive.value_m


def minimum_motions(rules: RuleSet, basis: Basis) -> float:
    """Return the minimum number of motions for a statistic."""
    return {
        Basis.MEAN_FACTORED: rules["analysis_mean_motions"],
        Basis.LARGEST_FACTORED: rules["analysis_min_motions"],
        Basis.MEAN: float(MEAN_WITHOUT_FACTOR_MOTIONS),
        # No number makes it enough: what has no value keeps none.
        Basis.TOO_FEW: math.inf,
    }[basis]


class Neighbor(StrEnum):
    """Type of object on the other side of a clearance."""

    LIKE = "array of similar construction"
    FIXED = "fixed object"
    UNLIKE = "array of different construction"
    PARAPET = "edge with qualifying parapet"
    EDGE = "edge without qualifying parapet"

    @classmethod
    def _missing_(cls, value: object) -> Neighbor | None:
        # Words of results before 0.4.0.
        return {"like array": cls.LIKE, "unlike array": cls.UNLIKE}.get(str(value))

    @property
    def is_edge(self) -> bool:
        """Whether it is a roof edge, with or without a parapet."""
        return self in (Neighbor.PARAPET, Neighbor.EDGE)


SEPARATION_KEYS: Mapping[Neighbor, str] = {
    Neighbor.LIKE: "separation_like",
    Neighbor.FIXED: "separation_fixed",
    Neighbor.UNLIKE: "separation_fixed",
    Neighbor.PARAPET: "separation_parapet",
    Neighbor.EDGE: "separation_edge",
}


def required_separation(
    rules: RuleSet, neighbor: Neighbor, *, design_m: float, importance: float
) -> float:
    """Return the required separation [m]: factor x I x design displacement, or the minimum.

    The importance factor applies here only if the displacement does not include it: I_e of the
    building at edges, the larger I_p of array and neighbor elsewhere.
    """
    required = rules[SEPARATION_KEYS[neighbor]] * design_m
    if rules.importance_in_separation:
        required *= importance
    # NaN, no design displacement, must not be replaced with the minimum.
    return (
        required if required != required else max(required, minimum_separation_m(rules, neighbor))
    )


def minimum_separation_m(rules: RuleSet, neighbor: Neighbor) -> float:
    """Return the minimum separation [m] of a rule set for any displacement; 0 if it has none."""
    # 48 in. in ASCE 7; PV1-2012 has no minimum.
    return rules.length_m("separation_edge_min_in") if neighbor is Neighbor.EDGE else 0.0


def parapet_qualifies(rules: RuleSet, *, parapet_height_m: float, cg_height_m: float) -> bool:
    """Whether a parapet is high enough above the roof and above the center of gravity of the array.

    Its strength (0.2 S_DS W impact in ASCE 7) is not checked here.
    """
    # A height typed in one unit equals the limit in another but for rounding.
    # PV1-2012: 24 in above the roof and 6 in above the center of gravity; ASCE 7: 12 in.
    return at_least(parapet_height_m, rules.length_m("parapet_height_in")) and at_least(
        parapet_height_m - cg_height_m, rules.length_m("parapet_over_cg_in")
    )


def interconnection_strength_n(rules: RuleSet, *, s_ds_g: float, w1_n: float) -> float:
    """Return the interconnection strength [N] for a part of weight w1_n on its lighter side."""
    # 0.133 S_DS W1, and 0.1 W1 or more, in all rule sets.
    # Equal at S_DS = 0.752: below that 0.1 governs.
    return max(rules["interconnection_sds"] * s_ds_g, rules["interconnection_min"]) * w1_n


def required_mu(rules: RuleSet, slope_rad: float) -> float:
    """Return the minimum friction coefficient of the prescriptive route at a slope.

    ASCE 7, 13.6.12: 0.4 up to a slope of 0.03, then 0.4 + 0.7 (slope - 0.03).
    """
    # The code gives the slope as rise over run.
    rise = max(math.tan(abs(slope_rad)) - 0.03, 0.0) if rules.mu_rises_with_slope else 0.0
    return rules["prescriptive_min_mu"] + 0.7 * rise


def building_checks(rules: RuleSet, *, risk_category: int, stories: int) -> tuple[Limit, ...]:
    """Return the checks of the limits on the building, which apply to both routes."""
    return (
        _check(rules, "Risk Category (I = 1 to IV = 4)", risk_category, "max_risk_category"),
        _check(rules, "Number of stories", stories, "max_stories"),
    )


def array_checks(
    rules: RuleSet, *, cg_height_m: float, support_spacing_m: float, base_m: float, slope_rad: float
) -> tuple[Limit, ...]:
    """Return the checks of an array for both routes: low profile, and slope by the IBC."""
    # Half of the smallest plan dimension of the supporting base (PV1-2012), or of the smallest
    # spacing of the supports (ASCE 7).
    takes_base = rules.low_profile_length is LowProfileLength.BASE
    length = rules["low_profile_ratio"] * (base_m if takes_base else support_spacing_m)
    return (
        _check(
            rules,
            "Height of the center of gravity",
            cg_height_m,
            "low_profile_in",
            limit=min(length, rules.length_m("low_profile_in")),
            measure=Measure.LENGTH_M,
        ),
        _check(
            rules,
            "Roof slope, any ballasted system",
            # The sign of the slope states only the direction of the record's axis.
            math.degrees(abs(slope_rad)),
            "ibc_max_slope_deg",
            measure=Measure.ANGLE_DEG,
        ),
    )


def prescriptive_checks(rules: RuleSet, *, slope_rad: float, mu: float) -> tuple[Limit, ...]:
    """Return the checks of the limits of the prescriptive route."""
    return (
        _check(
            rules,
            "Roof slope, prescriptive procedure",
            math.degrees(abs(slope_rad)),
            "prescriptive_max_slope_deg",
            measure=Measure.ANGLE_DEG,
        ),
        _check(
            rules,
            "Friction coefficient, prescriptive procedure",
            mu,
            "prescriptive_min_mu",
            limit=required_mu(rules, slope_rad),
            measure=Measure.PLAIN,
        ),
    )


def review_lifts_slope(rules: RuleSet, sdc: str) -> bool:
    """Whether roofs steeper than the limit of the analysis route are permitted with peer review."""
    return rules.steeper_if_reviewed and sdc in "ABC"


def analysis_checks(
    rules: RuleSet, *, slope_rad: float, n_motions: int, sdc: str, is_reviewed: bool
) -> tuple[Limit, ...]:
    """Return the checks of the limits of the analysis route.

    ASCE 7, 13.6.12: steeper roofs in SDC A, B, C with peer review. The limit of the IBC, which
    then governs, is among those of both routes.
    """
    slope = _check(
        rules,
        "Roof slope, analysis procedure",
        math.degrees(abs(slope_rad)),
        "analysis_max_slope_deg",
        measure=Measure.ANGLE_DEG,
    )
    may_exceed = is_reviewed and review_lifts_slope(rules, sdc)
    count = _check(rules, "Number of motions", n_motions, "analysis_min_motions")
    return replace(slope, may_exceed=may_exceed), count


def _check(
    rules: RuleSet,
    title: str,
    value: float,
    key: str,
    *,
    limit: float | None = None,
    measure: Measure = Measure.COUNT,
) -> Limit:
    return Limit(
        title=title,
        found=value,
        limit=rules[key] if limit is None else limit,
        is_at_least=not ALLOWED[key].is_maximum,
        measure=measure,
        key=key,
        provision=rules.values[key],
    )
