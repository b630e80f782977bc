"""Findings on a project before any run: limits, requirements, warnings on the input.

Runs nothing. Read `findings` and `limits_before_runs`.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace
from functools import partial
from itertools import chain

from report.assessment.checks.capacities import slack_check
from report.assessment.checks.check import Check
from report.assessment.checks.displacement import MORE_MOTIONS, no_design
from report.assessment.checks.every import before_runs
from report.assessment.checks.fire_access import of_pathways
from report.assessment.checks.motion_checks import shaking_acceptance
from report.assessment.checks.rule_limits import against_analysis
from report.assessment.checks.sentence import sentence
from report.assessment.design.routes import Route, lacking_motions, limits_of, statistic_basis
from report.assessment.design.rule_set import rule_set_of
from report.assessment.design.verdict import Verdict
from report.assessment.plan.neighbors import (
    REACH_FACTOR,
    NearbyKind,
    design_before_runs_m,
    pairs_before_runs,
)
from report.motions.history import targets
from report.motions.prepare import Shaking
from report.motions.record_findings import record_findings
from report.project.check.covered import outdated
from report.project.check.finding_lines import acknowledged, listed
from report.project.check.plausible import implausible
from report.project.model import ProjectInput
from report.project.model.finding import Finding, limit, note
from report.project.model.input_rows import Place
from report.project.read.unseen import warnings
from report.project.read.workbook_data import Sheet, WorkbookSource
from report.text.command_line import quoted
from report.text.counts import numbered
from report.text.units import Quantity, no_less, no_more, pair
from solver.records.acceptance import POINTS_HZ
from solver.records.block_spectra import together

# Pairs without a clearance that are named; the nearest.
MOST_NAMED = 50


def findings(source: WorkbookSource, data: ProjectInput, shaking: Shaking) -> tuple[Finding, ...]:
    """Return the warnings that an engineer must answer, with the reasons in the workbook."""
    hidden = [*source.unseen, *chain.from_iterable(file.unseen for file in shaking.records)]
    of_input = [*implausible(data), *record_findings(data, shaking)]
    return acknowledged(data, [*source.warnings, *warnings(hidden), *of_input])


def limits_before_runs(data: ProjectInput, shaking: Shaking) -> Iterator[Finding]:
    """Yield the checks that need no displacement and are not satisfied, each at its cell."""
    # As `assess` begins, for `check` and `report` name the same limits (test_precheck.py).
    data = outdated(data, shaking.hashes)
    rules = rule_set_of(data)
    # By products of matrices: the compiled kernel takes longer to load than these spectra to
    # compute (`solver.records.block_spectra`).
    spectra_of = partial(together, periods_s=1.0 / POINTS_HZ)
    acceptance = shaking_acceptance(shaking, targets(data), spectra_of)
    basis = statistic_basis(data)
    lacking = lacking_motions(rules, basis, len(shaking.motions))
    routes = [
        limits_of(
            data,
            rules,
            array,
            n_motions=len(shaking.motions),
            has_value=acceptance.qualifies and not lacking,
        )
        for array in data.arrays
    ]
    statistic = Place("options", 0, "statistic")
    pairs = zip(data.arrays, routes, strict=True)
    analyzed = [array.id for array, limits in pairs if limits.route is Route.ANALYSIS]
    # A statistic that the workbook asks for. Too few motions for that of the rule set miss a limit
    # of the analysis, which is among `known` below.
    if basis and lacking and analyzed:
        none = no_design(rules, analyzed, lacking, MORE_MOTIONS)
        yield _finding(replace(none, places=(statistic,)), data.us_first)
    for array, limits in zip(data.arrays, routes, strict=True):
        if limits.route is Route.PRESCRIPTIVE and shaking.motions:
            why = against_analysis(data, rules, limits, acceptance, len(shaking.motions))
            place = statistic if why == [lacking] else Place("motions")
            yield note(place, f"{array.id} uses the prescriptive displacement: {'; '.join(why)}")
    if not shaking.motions:
        yield from _not_run(data)
    known = before_runs(data, rules, shaking, acceptance, routes, analyzed)
    for check in (*known, *of_pathways(data)):
        # Of the limits of a route that is not taken, the note above says what follows.
        if check.is_open or (check.verdict is Verdict.NOTE and check.remedy):
            yield _finding(check, data.us_first)
    for index, array in enumerate(data.arrays):
        # Whether a slack that is entered is enough depends on the runs; that none is entered does
        # not.
        if array.slack_m is None:
            yield _finding(slack_check(array, math.nan, index), data.us_first)


def _finding(check: Check, us_first: bool) -> Finding:
    text = sentence(check, us_first)
    if check.verdict is Verdict.NOTE:
        return note(check.places[0], text)
    return limit(f"{check.verdict}. {text}", *check.places)


def _not_run(data: ProjectInput) -> Iterator[Finding]:
    """Yield requests of a workbook without motions that only runs can fulfill."""
    asked = (
        (Place("links"), "the comparison with a row of linked blocks", bool(data.links)),
        (Place("options", 0, "smaller_events"), "the sum including smaller events",
         bool(data.options.smaller_factors)),
        (Place("options", 0, "peer_reviewed"), "peer review", data.options.peer_reviewed),
    )  # fmt: skip
    for place, noun, is_asked in asked:
        if is_asked:
            yield note(place, f"{noun} requires motions and is skipped")


def missing_clearances(sheet: Sheet) -> Iterator[Finding]:
    """Yield the pairs of the plan without a clearance, before any run, each with its distance."""
    data = sheet.project
    near = [neighbor for neighbor in pairs_before_runs(data, sheet.addresses) if neighbor.is_near]
    missing = sorted(
        (neighbor for neighbor in near if not neighbor.given), key=lambda neighbor: neighbor.gap_m
    )
    if not missing:
        return
    units = Quantity.SIZE, data.us_first
    sizes = (f"{neighbor.names} {pair(neighbor.gap_m, *units, no_more)}" for neighbor in missing)
    named = listed(sizes, MOST_NAMED)
    reach = pair(REACH_FACTOR * design_before_runs_m(data), *units, no_less)
    is_bare = any(neighbor.kind is NearbyKind.BARE_EDGE for neighbor in missing)
    text = (
        f"{len(missing)} of {numbered(len(near), 'pair')} within reach have no row: {named}."
        f" Reach before any run: twice the prescriptive displacement, {reach}, or what it requires."
        f" {'Add the roof edges as objects, then run' if is_bare else 'Run'} roofslip plan"
        f" clearances {quoted(sheet.path)}, or add the rows"
    )
    yield limit(text, Place("clearances"))
