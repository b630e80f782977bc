"""Choices that the rule sets leave open, confirmations, overrides, acknowledged warnings."""

from __future__ import annotations

import datetime as dt
from typing import Annotated

from pydantic import AfterValidator

from report.project.model.choices import (
    EditionName,
    Frozen,
    PackageEdition,
    PlanPaper,
    RequiredText,
    RuleSetName,
    Statistic,
    Text,
    decimals,
)
from solver.rules.rulesets import ALLOWED


def provision_name(key: str) -> str:
    """Return the name of a provision in words, as on the Provisions worksheet; without its unit."""
    words = ALLOWED[key].meaning.partition(" [")[0]
    return words[:1].upper() + words[1:]


def provision_unit(key: str) -> str:
    """Return the unit of a provision, as a cell names it; empty for none."""
    allowed = ALLOWED.get(provision_key(key))
    return allowed.meaning.partition(" [")[2].rstrip("]") if allowed else ""


# Names in workbooks of versions before 0.4.0, without units.
_FORMER_NAMES = {
    "factor on (s_ds - 0.4)^2 in the prescriptive displacement": "prescriptive_factor_in",
    "maximum slope for the prescriptive route": "prescriptive_max_slope_deg",
    "minimum friction coefficient for the prescriptive route": "prescriptive_min_mu",
    "maximum slope for the analysis route": "analysis_max_slope_deg",
    "maximum height of the center of gravity / least base or support spacing": "low_profile_ratio",
    "minimum number of motions for the analysis route": "analysis_min_motions",
    "minimum number of motions for a value from the mean": "analysis_mean_motions",
    "minimum fraction of the prescriptive displacement without peer review": "analysis_floor",
    "separation between like arrays / design displacement": "separation_like",
    "separation to a fixed object or unlike array / design displacement": "separation_fixed",
    "separation to an edge with a qualifying parapet / design displacement": "separation_parapet",
    "separation to an edge without qualifying parapet / design displacement": "separation_edge",
    "minimum separation to an edge without a qualifying parapet": "separation_edge_min_in",
    "minimum height of a qualifying parapet above the roof": "parapet_height_in",
    "minimum height of a qualifying parapet above the array's c.g.": "parapet_over_cg_in",
}
_KEYS_BY_NAME = {provision_name(key).casefold(): key for key in ALLOWED} | _FORMER_NAMES


def provision_key(text: str) -> str:
    """Return the key of a provision given by its name or its key."""
    name = " ".join(text.partition(" [")[0].split()).casefold()
    return _KEYS_BY_NAME.get(name, text)


# Most smaller events whose displacements are added.
MAX_EVENTS = 20


def factors(text: str) -> tuple[float, ...]:
    """Return factors such as `0.50, 0.25`, each above 0 and up to 1; empty if it is not one."""
    values = decimals(text)
    fits = 1 <= len(values) <= MAX_EVENTS and min(values) > 0.0 and max(values) <= 1.0
    return values if fits else ()


class Options(Frozen):
    """Choices that the rule sets leave open."""

    statistic: Statistic = Statistic.RULE_SET
    peer_reviewed: bool = False
    peer_reviewer: Text = ""
    peer_license: Text = ""
    peer_date: dt.date | None = None
    peer_covered: Text = ""
    peer_letter: Text = ""
    smaller_events: Text = ""
    study_years: Text = ""
    package_edition: PackageEdition = PackageEdition.PLAN_CHECK
    letter: bool = False
    plan_paper: PlanPaper = PlanPaper.BY_SIZE

    @property
    def has_review(self) -> bool:
        """Whether peer review is stated with all that a plan checker asks for."""
        parts = self.peer_reviewer, self.peer_license, self.peer_date, self.peer_letter
        return self.peer_reviewed and all(parts)

    @property
    def smaller_factors(self) -> tuple[float, ...]:
        """Factors on the motions for the smaller events; empty if none are asked for."""
        return factors(self.smaller_events)


class Confirmation(Frozen):
    """Who compared the provisions with the adopted code, and which."""

    by: Text = ""
    date: dt.date | None = None
    rule_set: RuleSetName | None = None
    edition: EditionName | None = None
    code: Text = ""
    covered: Text = ""

    @property
    def of(self) -> tuple[str, str, str]:
        """What was confirmed: rule set, edition and building code."""
        return self.rule_set or "", self.edition or "", self.code


class Override(Frozen):
    """A replacement for the number of a provision, with the reason that the package prints."""

    provision: Annotated[RequiredText, AfterValidator(provision_key)]
    value: float
    reason: RequiredText


class Acknowledgment(Frozen):
    """A warning that is intended as it is, with the reason that the package prints."""

    warning: RequiredText
    reason: RequiredText
