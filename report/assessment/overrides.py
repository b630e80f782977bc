"""Overrides of provisions and departures from the rule set that require less of a project.

Each needs the consent of the authority having jurisdiction, and is a row. A number that is another
under the rule set as adopted carries a mark. Read `override_rows`, then `as_adopted`.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import asdict
from functools import partial

from report.assessment.verdict import STAYS, Requirement, condition
from report.sheet.schema import Override, ProjectInput, provision_name, provision_unit
from report.sheet.schema.choices import RuleSetName, Statistic
from report.sheet.schema.fields import Place
from report.words.counts import lowered
from solver.rules.hazard import REFERENCED
from solver.rules.provisions import RULE_SETS, Basis, RuleSet
from solver.rules.rulesets import ALLOWED

OVERRIDDEN = "‡"
"""Mark of a number that an override or a departure changes."""

MEANING = f"{OVERRIDDEN}: changed by an override or a departure"

OVERRIDE_ID = "override"
LOWERING = (OVERRIDE_ID, "directional", "statistic")
"""Ids of the rows here."""

CONSENT = f"Obtain the consent of the authority having jurisdiction. {STAYS}"


def override_rows(data: ProjectInput) -> tuple[Requirement, ...]:
    """Return what requires less than the rule set: each override that does, and each departure."""
    rules = RULE_SETS[data.site.rule_set]
    overrides = (pair for pair in enumerate(data.overrides) if _lowers(rules, pair[1]))
    return (*(_override(rules, *pair) for pair in overrides), *_departures(data, rules))


def rule_set_of(data: ProjectInput) -> RuleSet:
    """Return the rule set of a project with its overrides, as it was confirmed.

    Raises
    ------
    InputError
        For an override of a provision that the rule set does not have.
    """
    changes = {row.provision: (row.value, row.reason) for row in data.overrides}
    rules = RULE_SETS[data.site.rule_set].overridden(changes)
    return rules.confirmed() if data.confirmed else rules


def as_adopted(data: ProjectInput) -> ProjectInput:
    """Return an input without its overrides and departures; the input itself if it has none."""
    given = data.options
    statistic = Statistic.RULE_SET if _takes_plain_mean(data) else given.statistic
    options = given.model_copy(update={"directional": False, "statistic": statistic})
    if not data.overrides and options == given:
        return data
    return data.model_copy(update={"overrides": (), "options": options})


def under_code(data: ProjectInput) -> ProjectInput:
    """Return an input under the rule set of its building code as adopted; itself if it has that."""
    site = data.site
    name = REFERENCED.get(site.code_text, site.rule_set)
    if name == site.rule_set:
        return data
    values = {f"{symbol}_g": value for symbol, value in asdict(site.parameters).items()}
    # With what it derives: another edition may not.
    other = site.model_copy(update=values | {"rule_set": RuleSetName(name), "edition_name": None})
    return as_adopted(data.model_copy(update={"site": other}))


def mark_of(value: float, adopted: float) -> str:
    """Return the mark of a number that is another under the rule set as adopted; none for NaN."""
    return "" if math.isnan(value) or value == adopted else OVERRIDDEN


def _lowers(rules: RuleSet, row: Override) -> bool:
    given = rules.values.get(row.provision)
    return given is not None and ALLOWED[row.provision].lowers(row.value, given.value)


def _override(rules: RuleSet, index: int, row: Override) -> Requirement:
    given, unit = rules.values[row.provision], provision_unit(row.provision)
    value, adopted = (f"{v:.4g} {unit}".rstrip() for v in (row.value, given.value))
    sign = "≤" if ALLOWED[row.provision].is_maximum else "≥"
    return _row(
        title=f"Override of the {lowered(provision_name(row.provision))}",
        id=OVERRIDE_ID,
        found=f"{value}{OVERRIDDEN}, {row.reason}",
        limit=f"{sign} {adopted}",
        basis=given.clause,
        places=(Place("overrides", index, "value"),),
    )


def _departures(data: ProjectInput, rules: RuleSet) -> Iterator[Requirement]:
    options = data.options
    if options.directional:
        yield _row(
            id="directional",
            title="Displacement by direction",
            found=f"displacement toward each clearance{OVERRIDDEN}, {options.directional_reason}",
            limit="design displacement in full in every direction",
            basis=rules.name,
            places=(Place("options", 0, "directional"),),
        )
    if _takes_plain_mean(data):
        yield _row(
            id="statistic",
            title="Design value statistic",
            found=f"{options.statistic}{OVERRIDDEN}",
            limit="statistic of the rule set, with its factor",
            basis=rules.values["analysis_factor"].clause,
            places=(Place("options", 0, "statistic"),),
        )


def _takes_plain_mean(data: ProjectInput) -> bool:
    """Whether the workbook requests a mean without factor where the rule set has one."""
    is_stated = RULE_SETS[data.site.rule_set].statistic_is_stated
    return is_stated and data.options.statistic.value == Basis.MEAN.value


_row = partial(condition, is_satisfied=False, remedy=CONSENT)
