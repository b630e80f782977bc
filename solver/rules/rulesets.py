"""The rule sets as data: one table for each adopted document, with section and confidence.

The separation from a roof edge without a parapet is 1.5 times the displacement by PV1-2012, and
twice the displacement by ASCE 7.

Rule sets are separate and never mixed. Lengths are in inches, as in the codes. The formulas that
use these numbers are in `solver.rules.provisions`.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from enum import StrEnum
from functools import partial

from solver.errors import InputError
from solver.model import INCH_M


class Confidence(StrEnum):
    """Confidence in a number; every number not CONFIRMED is marked for the reader to verify."""

    CONFIRMED = "C"  # agrees with a published permit calculation, or confirmed for a project
    KNOWN = "K"  # commonly known and consistent across sources; code text not available
    LOW = "L"


@dataclass(frozen=True, slots=True, kw_only=True)
class Provision:
    """One number of a rule set, with its clause; `reason` is not empty if it is overridden.

    `note` states anything else the reader must know about the number.
    """

    value: float
    clause: str
    confidence: Confidence
    reason: str = ""
    note: str = ""

    @property
    def verified(self) -> bool:
        """Whether it needs no mark to verify: confirmed and not overridden."""
        return self.confidence is Confidence.CONFIRMED and not self.reason


@dataclass(frozen=True, slots=True)
class Allowed:
    """Permitted range of an override of a rule-set number, and the number's description."""

    low: float
    high: float
    meaning: str  # with its unit in brackets
    is_whole: bool = False
    is_maximum: bool = False  # limits a project from above: a larger number requires less of it

    def lowers(self, value: float, adopted: float) -> bool:
        """Whether a value is less stringent than the number of the rule set."""
        return value > adopted if self.is_maximum else value < adopted

    def has(self, value: float) -> bool:
        """Whether a value is within the range."""
        return self.low <= value <= self.high and not (self.is_whole and value % 1.0)

    @property
    def words(self) -> str:
        """The range as text."""
        return f"a {'whole ' if self.is_whole else ''}number from {self.span}"

    @property
    def span(self) -> str:
        """Both ends."""
        return f"{self.low:.3g} to {self.high:.3g}"


_at_most, _whole = partial(Allowed, is_maximum=True), partial(Allowed, is_whole=True)
_whole_at_most = partial(Allowed, is_whole=True, is_maximum=True)

# What a workbook may override. Outside of its range a number has another unit or no meaning. A
# factor below 1 on the peaks would give less than was computed.
ALLOWED: Mapping[str, Allowed] = {
    "prescriptive_factor_in": Allowed(1, 600, "prescriptive displacement / (S_DS - 0.4)^2 [in]"),
    "prescriptive_minimum_in": Allowed(0, 240, "minimum prescriptive displacement [in]"),
    "prescriptive_low_sdc_in": Allowed(0, 240, "prescriptive displacement in SDC A, B, C [in]"),
    "prescriptive_max_slope_deg": _at_most(0, 30, "maximum slope, prescriptive procedure [deg]"),
    "prescriptive_min_mu": Allowed(0, 1.5, "minimum friction coefficient, prescriptive procedure"),
    "analysis_max_slope_deg": _at_most(0, 30, "maximum slope, analysis procedure [deg]"),
    "ibc_max_slope_deg": _at_most(0, 30, "maximum slope of any ballasted system [deg]"),
    "max_stories": _whole_at_most(1, 200, "maximum number of stories of the building"),
    "max_risk_category": _whole_at_most(1, 4, "highest risk category (I = 1 ... IV = 4)"),
    "low_profile_in": _at_most(1, 120, "maximum height of the center of gravity [in]"),
    "low_profile_ratio": _at_most(
        0.01, 5, "maximum height of the center of gravity / smallest base or support spacing"
    ),
    "analysis_min_motions": _whole(1, 100, "minimum number of motions, analysis procedure"),
    "analysis_mean_motions": _whole(1, 100, "minimum number of motions for use of the mean"),
    "analysis_factor": Allowed(1, 10, "factor on the mean or on the largest peak"),
    "analysis_floor": Allowed(0, 1, "floor without peer review / prescriptive displacement"),
    "separation_like": Allowed(0, 10, "separation factor, array of similar construction"),
    "separation_fixed": Allowed(
        0.1, 10, "separation factor, fixed object or array of different construction"
    ),
    "separation_parapet": Allowed(0, 10, "separation factor, edge with qualifying parapet"),
    "separation_edge": Allowed(0.1, 10, "separation factor, edge without qualifying parapet"),
    "separation_edge_min_in": Allowed(
        0, 600, "minimum separation, edge without qualifying parapet [in]"
    ),
    "parapet_height_in": Allowed(0, 240, "qualifying parapet height above the roof [in]"),
    "parapet_over_cg_in": Allowed(0, 240, "qualifying parapet height above the array's c.g. [in]"),
    "interconnection_sds": Allowed(0, 2, "interconnection strength / (S_DS W1)"),
    "interconnection_min": Allowed(0, 2, "minimum interconnection strength / W1"),
}


class LowProfileLength(StrEnum):
    """The length that limits the height of the center of gravity to half of it."""

    BASE = "smallest plan dimension of the supporting base"
    SPACING = "smallest spacing of the supports"


@dataclass(frozen=True, slots=True, kw_only=True)
class RuleSet:
    """One adopted document: its numbers by key, and where the importance factor applies."""

    code: str  # on the command line
    name: str
    title: str
    values: Mapping[str, Provision]
    importance_in_separation: bool  # otherwise it is included in the displacement; never both
    low_sdc_is_flat: bool  # SDC A, B, C have a constant displacement instead of the formula
    mu_rises_with_slope: bool
    low_profile_length: LowProfileLength
    steeper_if_reviewed: bool  # its slope limit may be exceeded in SDC A, B, C with peer review
    statistic_is_stated: bool  # of the peaks; otherwise a mean without factor is no departure
    edition: str  # of the seismic parameters, unless the workbook states another

    def __getitem__(self, key: str) -> float:
        return self.values[key].value

    def length_m(self, key: str) -> float:
        """Return a length, stored in inches, in meters."""
        # Tables have inches, as the codes print them, so that a reader can compare each number.
        return self.values[key].value * INCH_M

    def overridden(self, changes: Mapping[str, tuple[float, str]]) -> RuleSet:
        """Return the rule set with some numbers replaced: key -> (value, reason).

        Raises `InputError` for every key that it does not have, and every value not `ALLOWED`.
        """
        unknown = [key for key in changes if key not in self.values]
        if unknown:
            known = ", ".join(self.values)
            raise InputError([f"provision is '{key}'; {self.name} has {known}" for key in unknown])
        outside = [
            f"{key} is {value!r:.40}; enter {ALLOWED[key].words}"
            for key, (value, _) in changes.items()
            if not ALLOWED[key].has(value)
        ]
        if outside:
            raise InputError(outside)
        values = dict(self.values)
        for key, (value, reason) in changes.items():
            # The clause is kept: a package prints which provision was overridden, with the reason.
            values[key] = replace(values[key], value=value, reason=reason)
        return replace(self, values=values)

    def confirmed(self) -> RuleSet:
        """Return the rule set as confirmed against its text: only overrides are marked."""
        # An override keeps its reason, and by that its mark.
        values = {
            key: replace(row, confidence=Confidence.CONFIRMED) for key, row in self.values.items()
        }
        return replace(self, values=values)


# By key: value, confidence and clause.
_Rows = Mapping[str, tuple[float, Confidence, str]]


def _table(
    rows: _Rows, document: str, notes: Mapping[str, str], *, is_compared: bool = True
) -> dict[str, Provision]:
    """Return the numbers of a document; one without a clause cites the document.

    An edition that was not compared inherits no confirmation.
    """
    table = {
        key: Provision(
            value=float(value),
            clause=f"{document} {clause}".rstrip(),
            confidence=confidence if is_compared else Confidence.LOW,
            note=notes.get(key, ""),
        )
        for key, (value, confidence, clause) in rows.items()
    }
    # The cap of the IBC is in every rule set, because it holds for every ballasted system.
    return table | _IBC


C, K, L = Confidence.CONFIRMED, Confidence.KNOWN, Confidence.LOW

# Clause numbers of PV1 other than Sec. 4 to 6 are not known: the document alone is cited.
_PV1: _Rows = {
    "prescriptive_factor_in": (60, C, ""),
    "prescriptive_minimum_in": (6, C, ""),
    "prescriptive_low_sdc_in": (6, C, ""),
    "prescriptive_max_slope_deg": (3, K, ""),
    "prescriptive_min_mu": (0.4, K, ""),
    "analysis_max_slope_deg": (7, K, ""),
    "max_stories": (6, K, ""),
    "max_risk_category": (3, K, ""),
    "low_profile_in": (36, K, "Sec. 5"),
    "low_profile_ratio": (0.5, K, "Sec. 5"),
    "analysis_min_motions": (3, K, ""),
    "analysis_mean_motions": (7, K, ""),
    "analysis_factor": (1.1, K, ""),
    "analysis_floor": (0.5, K, ""),
    "separation_like": (0.5, C, "Sec. 6"),
    "separation_fixed": (1.0, C, "Sec. 6"),
    "separation_parapet": (1.0, C, "Sec. 6"),
    "separation_edge": (1.5, C, "Sec. 6"),
    "separation_edge_min_in": (0, K, "Sec. 6"),
    "parapet_height_in": (24, K, ""),
    "parapet_over_cg_in": (6, K, ""),
    "interconnection_sds": (0.133, C, "Sec. 6"),
    "interconnection_min": (0.1, C, "Sec. 6"),
}

_ONE_IN_20_DEG = math.degrees(math.atan(1 / 20))

# The maximum slope is 1 in 20. No parapet height above the c.g. is stated.
# 13.6.12 states the displacement in feet, 5 I_e (S_DS - 0.4)^2; 5 ft are 60 in.
_ASCE: _Rows = {
    "prescriptive_factor_in": (60, C, "13.6.12"),
    "prescriptive_minimum_in": (24, K, "13.6.12"),
    "prescriptive_max_slope_deg": (_ONE_IN_20_DEG, K, "13.6.12"),
    "prescriptive_min_mu": (0.4, K, "13.6.12"),
    "analysis_max_slope_deg": (_ONE_IN_20_DEG, L, "13.6.12"),
    "max_stories": (6, K, "13.6.12"),
    "max_risk_category": (3, K, "13.6.12"),
    "low_profile_in": (36, K, "13.6.12"),
    "low_profile_ratio": (0.5, K, "13.6.12"),
    "analysis_min_motions": (3, L, "13.6.12"),
    "analysis_mean_motions": (7, L, "13.6.12"),
    "analysis_factor": (1.1, L, "13.6.12"),
    "analysis_floor": (0.8, K, "13.6.12"),
    "separation_like": (0.5, C, "13.6.12"),
    "separation_fixed": (1.0, C, "13.6.12"),
    "separation_parapet": (1.0, C, "13.6.12"),
    "separation_edge": (2.0, C, "13.6.12"),
    "separation_edge_min_in": (48, K, "13.6.12"),
    "parapet_height_in": (12, K, "13.6.12"),
    "parapet_over_cg_in": (0, K, "13.6.12"),
    "interconnection_sds": (0.133, K, "13.6.12"),
    "interconnection_min": (0.1, K, "13.6.12"),
}

# Limits every ballasted system, beside all rule sets: 1 in 12.
IBC_SLOPE, IBC_SECTION = "ibc_max_slope_deg", "1613.3"
_IBC = {
    IBC_SLOPE: Provision(
        value=math.degrees(math.atan(1 / 12)),
        clause=f"IBC {IBC_SECTION}",
        confidence=Confidence.KNOWN,
    )
}

_PV1_NOTES = {
    "analysis_max_slope_deg": "quoted for attached arrays (Sec. 4); an unattached array on a slope"
    " over 3 deg may be outside PV1-2012"
}

_ASCE_NOTES = {"analysis_max_slope_deg": "in SDC A, B, C it may be exceeded with peer review"}

_ASCE_7_16 = RuleSet(
    code="asce7-16",
    name="ASCE 7-16",
    title="ASCE/SEI 7-16, Minimum Design Loads and Associated Criteria for Buildings "
    "and Other Structures, 13.6.12",
    values=_table(_ASCE, "ASCE 7-16", _ASCE_NOTES),
    importance_in_separation=False,
    low_sdc_is_flat=False,
    mu_rises_with_slope=True,
    low_profile_length=LowProfileLength.SPACING,
    steeper_if_reviewed=True,
    statistic_is_stated=False,
    edition="ASCE 7-16",
)

RULE_SETS: Mapping[str, RuleSet] = {
    rules.name: rules
    for rules in (
        RuleSet(
            code="pv1",
            name="SEAOC PV1-2012",
            title="SEAOC PV1-2012, Structural Seismic Requirements and Commentary for Rooftop "
            "Solar Photovoltaic Arrays",
            values=_table(_PV1, "PV1-2012", _PV1_NOTES),
            importance_in_separation=True,
            low_sdc_is_flat=True,
            mu_rises_with_slope=False,
            low_profile_length=LowProfileLength.BASE,
            steeper_if_reviewed=False,
            statistic_is_stated=True,
            edition="ASCE 7-16",
        ),
        _ASCE_7_16,
        replace(
            _ASCE_7_16,
            code="asce7-22",
            name="ASCE 7-22",
            title=_ASCE_7_16.title.replace("7-16", "7-22"),
            values=_table(_ASCE, "ASCE 7-22", _ASCE_NOTES, is_compared=False),
            edition="ASCE 7-22",
        ),
    )
}


def usual(key: str, rule_sets: Mapping[str, RuleSet] = RULE_SETS) -> Allowed:
    """Return the range beyond which an override of a provision is unusual.

    Half of the least to twice the greatest value of the rule sets, as far as it is allowed; all
    that is allowed where they have no value but zero.
    """
    values = [rules.values[key].value for rules in rule_sets.values() if key in rules.values]
    allowed = ALLOWED[key]
    if not any(values):
        return allowed
    low, high = max(0.5 * min(values), allowed.low), min(2.0 * max(values), allowed.high)
    if allowed.is_whole:
        # Inward: only whole numbers are allowed.
        low, high = math.ceil(low), math.floor(high)
    return replace(allowed, low=low, high=high)
