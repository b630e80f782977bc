"""Decisions of the engineer on a project: options, confirmations, acknowledged warnings."""

from __future__ import annotations

import datetime as dt

from report.project.model.choices import (
    EditionName,
    PackageEdition,
    PlanPaper,
    RuleSetName,
    Statistic,
)
from report.project.model.values import Frozen, RequiredText, Text, decimals

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
        """Whether peer review is entered with everything required by a plan checker."""
        parts = self.peer_reviewer, self.peer_license, self.peer_date, self.peer_letter
        return self.peer_reviewed and all(parts)

    @property
    def smaller_factors(self) -> tuple[float, ...]:
        """Factors on the motions for the smaller events; empty if none are requested."""
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
        """The confirmed documents: rule set, edition and building code."""
        return self.rule_set or "", self.edition or "", self.code


class Acknowledgment(Frozen):
    """An accepted warning, with the reason that the package prints."""

    warning: RequiredText
    reason: RequiredText
