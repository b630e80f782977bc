"""The rule set of a project: with its overrides, as adopted, and that of the building code."""

from __future__ import annotations

import math
from dataclasses import asdict, replace

from report.project.model import ProjectInput
from report.project.model.choices import RuleSetName, Statistic
from solver.rules.hazard import REFERENCED
from solver.rules.provisions import Basis
from solver.rules.rulesets import IBC_SECTION, IBC_SLOPE, RULE_SETS, RuleSet

# Mark of a number that an override or a departure changes.
OVERRIDDEN = "‡"

MEANING = f"{OVERRIDDEN}: changed by an override or a departure"


def rule_set_of(data: ProjectInput) -> RuleSet:
    """Return the rule set of a project with its overrides, as it was confirmed.

    Raises `InputError` for an override of a provision that the rule set does not have.
    """
    changes = {row.provision: (row.value, row.reason) for row in data.overrides}
    rules = RULE_SETS[data.site.rule_set].overridden(changes)
    code, year = data.site.building_code, data.site.building_code_year
    if code:  # the slope limit of the IBC by the code that is adopted
        limit = replace(rules.values[IBC_SLOPE], clause=f"{code} {IBC_SECTION}, {year}")
        rules = replace(rules, values={**rules.values, IBC_SLOPE: limit})
    return rules.confirmed() if data.confirmed else rules


def as_adopted(data: ProjectInput) -> ProjectInput:
    """Return an input without its overrides and departures; the input itself if it has none."""
    chosen = data.options
    # PV1-2012 states 1.1 x the mean or the largest; ASCE 7 states no statistic to depart from.
    statistic = Statistic.RULE_SET if takes_plain_mean(data) else chosen.statistic
    if not data.overrides and statistic is chosen.statistic:
        return data
    options = chosen.model_copy(update={"statistic": statistic})
    return data.model_copy(update={"overrides": (), "options": options})


def under_code(data: ProjectInput) -> ProjectInput:
    """Return an input under the rule set of its building code as adopted; itself if it has that."""
    site = data.site
    name = REFERENCED.get(site.code_text, site.rule_set)
    if name == site.rule_set:
        return data
    values: dict[str, object] = {
        f"{symbol}_g": value for symbol, value in asdict(site.parameters).items()
    }
    # With what it derives: another edition may not.
    site_of_code = site.model_copy(
        update=values | {"rule_set": RuleSetName(name), "edition_name": None}
    )
    return as_adopted(data.model_copy(update={"site": site_of_code}))


def mark_of(value: float, adopted: float) -> str:
    """Return the mark of a number that differs under the rule set as adopted; none for NaN."""
    return "" if math.isnan(value) or value == adopted else OVERRIDDEN


def takes_plain_mean(data: ProjectInput) -> bool:
    """Whether the workbook requests a mean without a factor although the rule set has one."""
    is_stated = RULE_SETS[data.site.rule_set].statistic_is_stated
    return is_stated and data.options.statistic.value == Basis.MEAN.value
