"""The limits of the rule set on the building and each array, and less stringent overrides."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import partial

from report.assessment.checks.check import OVERRIDE_ID, Actor, Check, Sense, condition, dagger
from report.assessment.checks.sentence import words
from report.assessment.design.routes import Route, RouteLimits, lacking_motions, statistic_basis
from report.assessment.design.rule_set import OVERRIDDEN, takes_plain_mean
from report.assessment.design.verdict import STAYS
from report.project.model import ProjectInput
from report.project.model.input_rows import Place
from report.project.model.overrides import Override, provision_name, provision_unit
from report.text.amounts import limit_amounts
from report.text.letter_case import lowered
from report.text.units import with_unit
from solver.records.acceptance import Acceptance
from solver.rules.limit import Consequence, Limit, Measure
from solver.rules.provisions import building_checks
from solver.rules.rulesets import ALLOWED, RULE_SETS, Provision, RuleSet


def of_building(data: ProjectInput, rules: RuleSet) -> Iterator[Check]:
    """Yield the limits on the building."""
    for limit in building_limits(data, rules):
        yield replace(of_limit(limit), places=(Place("site", 0, _FIELDS[limit.key]),))


def building_limits(data: ProjectInput, rules: RuleSet) -> tuple[Limit, ...]:
    """Return the limits on the building, of the solver."""
    categories = list(type(data.site.risk_category))
    # The solver has risk categories as numbers, 1 for I.
    return building_checks(
        rules,
        risk_category=categories.index(data.site.risk_category) + 1,
        stories=data.site.stories,
    )


def of_array(item: RouteLimits, index: int, id: str, *, has_motions: bool) -> Iterator[Check]:
    """Yield the limits on an array; those of the procedure not used are notes."""

    def of(limit: Limit) -> Check:
        field = _FIELDS.get(limit.key, "")
        place = Place("arrays", index, field) if field else Place("motions")
        return replace(of_limit(limit, id), places=(place,))

    yield from map(of, item.required)
    is_analysis = item.route is Route.ANALYSIS
    for limit in item.prescriptive_checks if is_analysis else item.analysis_checks:
        # Without motions nobody takes the analysis: how many there are says nothing.
        if is_analysis or has_motions:
            yield replace(of(limit), consequence=Consequence.NOTE, remedy="")


def against_analysis(
    data: ProjectInput, rules: RuleSet, item: RouteLimits, acceptance: Acceptance, n_motions: int
) -> Sequence[str]:
    """Return the short reasons why the analysis of an array is not permitted."""
    limits = (*acceptance.missed, *item.analysis_checks)
    missed = [limit for limit in limits if not limit.ok and limit.consequence is Consequence.NG]
    lacking = lacking_motions(rules, statistic_basis(data), n_motions)
    # The number of motions is a limit on the motions and on each array: the two say the same.
    reasons = list(dict.fromkeys(words(of_limit(limit)) for limit in missed))
    return reasons or [lacking] * bool(lacking)


def of_limit(limit: Limit, subject: str = "") -> Check:
    """Return a limit of the solver as a check."""
    found_value, required = limit_amounts(limit)
    marks = dagger(limit.provision)
    return Check(
        id=limit.key,
        title=limit.title,
        subject=subject,
        arrays=(subject,) if subject else (),
        found="no value" if math.isnan(limit.found) else found_value,
        limit=replace(required, mark=marks),
        sense=Sense.AT_LEAST if limit.is_at_least else Sense.AT_MOST,
        note=f"permitted: {limit.provision.note}" if limit.passes_by_exception else limit.worst,
        clause=limit.provision.clause + marks,
        is_satisfied=limit.ok,
        consequence=limit.consequence,
        is_capacity=limit.measure is not Measure.COUNT,
        remedy=_REMEDIES.get(limit.key, ""),
    )


# The cell that a limit compares, by the key of the limit.
_FIELDS = {
    "low_profile_in": "cg_height_m",
    "ibc_max_slope_deg": "slope_value",
    "analysis_max_slope_deg": "slope_value",
    "prescriptive_max_slope_deg": "slope_value",
    "prescriptive_min_mu": "mu",
    "max_risk_category": "risk_category",
    "max_stories": "stories",
}

_REMEDIES = {
    "low_profile_in": "Lower the center of gravity of the array, or increase its support spacing.",
    "prescriptive_min_mu": "Provide more friction, shown by tests.",
    "analysis_min_motions": "Complete the motions.",
}


def of_overrides(data: ProjectInput) -> Iterator[Check]:
    """Yield each override and departure that is less stringent than the rule set."""
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
    value, adopted = (with_unit(f"{v:.4g}", unit) for v in (row.value, rule.value))
    return _lowering(
        id=OVERRIDE_ID,
        title=f"Override of the {lowered(provision_name(row.provision))}",
        found=f"{value}{OVERRIDDEN}, {row.reason}",
        limit=f"{'≤' if allowed.is_maximum else '≥'} {adopted}{dagger(rule)}",
        clause=f"{rule.clause}{dagger(rule)}",
        # One on the safe side needs nobody's consent.
        is_satisfied=not allowed.lowers(row.value, rule.value),
        places=(Place("overrides", index, "value"),),
    )


_lowering = partial(
    condition,
    actor=Actor.JURISDICTION,
    remedy=f"Obtain the consent of the authority having jurisdiction. {STAYS}",
)
