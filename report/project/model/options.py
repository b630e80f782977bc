"""What the engineer decides of a project: options, and what is confirmed and acknowledged."""

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


class Acknowledgment(Frozen):
    """A warning that is intended as it is, with the reason that the package prints."""

    warning: RequiredText
    reason: RequiredText
