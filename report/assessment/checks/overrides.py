"""What requires less than the rule set: overrides and departures."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

from report.assessment.checks.check import OVERRIDE_ID, Actor, Check, condition
from report.assessment.design.rule_set import OVERRIDDEN, takes_plain_mean
from report.assessment.design.words import STAYS
from report.project.model import ProjectInput
from report.project.model.options import Override
from report.project.model.place import Place
from report.project.model.provision_names import provision_name, provision_unit
from report.text.letter_case import lowered
from solver.rules.provisions import RULE_SETS
from solver.rules.rulesets import ALLOWED, Provision


def of_overrides(data: ProjectInput) -> Iterator[Check]:
    """Yield what requires less than the rule set: each override that does, and each departure."""
    rules = RULE_SETS[data.site.rule_set]
    for index, row in enumerate(data.overrides):
        if row.provision in rules.values:
            yield _override(rules.values[row.provision], index, row)
    if takes_plain_mean(data):
        yield _lowering(
            id="statistic",
            title="Design value statistic",
            found=f"{data.options.statistic}{OVERRIDDEN}",
            limit="statistic of the rule set, with its factor",
            clause=rules.values["analysis_factor"].clause,
            is_satisfied=False,
            places=(Place("options", 0, "statistic"),),
        )


def _override(rule: Provision, index: int, row: Override) -> Check:
    allowed, unit = ALLOWED[row.provision], provision_unit(row.provision)
    value, adopted = (f"{v:.4g} {unit}".rstrip() for v in (row.value, rule.value))
    return _lowering(
        id=OVERRIDE_ID,
        title=f"Override of the {lowered(provision_name(row.provision))}",
        found=f"{value}{OVERRIDDEN}, {row.reason}",
        limit=f"{'≤' if allowed.is_maximum else '≥'} {adopted}",
        clause=rule.clause,
        # One on the safe side needs nobody's consent.
        is_satisfied=not allowed.lowers(row.value, rule.value),
        places=(Place("overrides", index, "value"),),
    )


_lowering = partial(
    condition,
    actor=Actor.JURISDICTION,
    remedy=f"Obtain the consent of the authority having jurisdiction. {STAYS}",
)
