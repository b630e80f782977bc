"""All requirements on a project, satisfied or not. Read `every`, then `before_runs`."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import chain
from typing import TYPE_CHECKING

from report.assessment.checks import (
    capacities,
    clearance_checks,
    confirmations,
    displacement,
    fire_access,
    friction_evidence,
    motion_checks,
    rule_limits,
    seismic_parameters,
)
from report.assessment.checks.check import MOTIONS_ID, VELOCITY_ROW, Check
from report.assessment.design.routes import Route, RouteLimits, interconnection_n
from report.motions.prepare import Shaking
from report.project.model import ProjectInput
from solver.records.acceptance import Acceptance
from solver.rules.limit import Consequence
from solver.rules.rulesets import RuleSet

if TYPE_CHECKING:
    from report.assessment.assessment import Assessment


# Of a check on the analysis where nothing follows from it.
NO_EFFECT = "For information only: the design displacement is prescriptive."

# Who takes the prescriptive displacement need not meet them.
_OF_ANALYSIS = (MOTIONS_ID, "drift", "ground_motions", "peer_review", VELOCITY_ROW)


def every(done: Assessment) -> tuple[Check, ...]:
    """Return all requirements on an assessed project."""
    data, by_runs = done.project, {item.id for item in done.arrays if item.is_by_runs}
    routes = [item.limits for item in done.arrays]
    has_variations = done.at_reduced_friction is not None and done.has_motions
    checks = (
        *before_runs(data, done.rules, done.shaking, done.acceptance, routes, by_runs),
        *chain.from_iterable(displacement.of_array(done, item) for item in done.arrays),
        *map(displacement.of_links, done.linked),
        *clearance_checks.of_clearances(done),
        *fire_access.of_pathways(data, done.pairs),
        *clearance_checks.of_neighbors(done),
        *noted(
            friction_evidence.of_velocities(data, done.arrays) if has_variations else (),
            by_runs,
        ),
        *friction_evidence.of_less(done),
    )
    return tuple(_with_otherwise(checks, done.otherwise))


def _with_otherwise(checks: Sequence[Check], otherwise: Mapping[str, str]) -> Iterator[Check]:
    """Yield checks, each outcome with the first that is open of those that it is the outcome of."""
    # Two overrides have one outcome, and so has one friction law of several arrays.
    carriers = dict[str, Check]()
    # The order is stable: among open checks the first of the page carries the sentence.
    for check in sorted(checks, key=lambda check: not check.is_open):
        if check.id in otherwise:
            carriers.setdefault(otherwise[check.id], check)
    for check in checks:
        text = otherwise.get(check.id, "")
        yield replace(check, otherwise=text) if carriers.get(text) is check else check


def before_runs(
    data: ProjectInput,
    rules: RuleSet,
    shaking: Shaking,
    acceptance: Acceptance,
    routes: Sequence[RouteLimits],
    by_runs: Collection[str],
) -> Iterator[Check]:
    """Yield the checks of a project that need no run; `routes` are those of its arrays.

    `by_runs` are the arrays whose design displacement is based on their runs.
    """
    ids = [array.id for array in data.arrays]
    analyzed = [id for id, item in zip(ids, routes, strict=True) if item.route is Route.ANALYSIS]
    yield from rule_limits.of_building(data, rules)
    for index, (id, item) in enumerate(zip(ids, routes, strict=True)):
        yield from rule_limits.of_array(item, index, id, has_motions=bool(shaking.motions))
    yield confirmations.of_building_code(data)
    yield from clearance_checks.of_roof(data)
    yield from capacities.of_existing_roof(data)
    yield from noted(confirmations.of_confirmations(data), by_runs)
    yield from rule_limits.of_overrides(data)
    yield from seismic_parameters.of_site(data)
    yield from noted(motion_checks.of_records(data, shaking.prepared), by_runs)
    yield from friction_evidence.of_tests(data)
    yield from noted(motion_checks.of_acceptance(acceptance, analyzed, shaking), by_runs)
    for array in data.arrays:
        yield from capacities.before_runs(data, array, interconnection_n(data, rules, array))


def noted(checks: Iterator[Check] | tuple[()], by_runs: Collection[str]) -> Iterator[Check]:
    """Yield checks; those on the analysis alone become notes if they have no consequence."""
    for check in checks:
        # The motions are those of the whole project: their limits count as soon as one array takes
        # its runs. A sliding velocity is that of one array.
        concerned = check.subject in by_runs if check.id == VELOCITY_ROW else bool(by_runs)
        if concerned or check.id not in _OF_ANALYSIS:
            yield check
        else:
            yield replace(check, consequence=Consequence.NOTE, remedy=NO_EFFECT, arrays=())
