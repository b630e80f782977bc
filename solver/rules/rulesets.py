"""The rule sets as data: one table for each adopted document, with clause and confidence.

Rule sets are kept apart and never mixed. Lengths are inches because the codes' are. The formulas
that read these numbers are in `solver.rules.provisions`.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from enum import StrEnum

from solver.model import InputError

INCH_M = 0.0254


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
    "max_stories": "most stories of the building",
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
max_stories                 6      K  Sec. 5
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
max_stories                 6      K  13.6.12
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
