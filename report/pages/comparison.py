"""The comparison with the prescriptive displacement: chart, table, reason for each procedure.

    Array A1: the limits of the prescriptive procedure are satisfied, but the analysis
    displacement exceeds the prescriptive displacement.

Read `page`.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

from markupsafe import Markup

from report.assessment.checks.rule_limits import building_limits, of_limit
from report.assessment.checks.sentence import words
from report.assessment.design.arrays import ArrayAssessment
from report.assessment.design.routes import Route
from report.assessment.support.evidence import Evidence
from report.pages.array_tables import comparison_table
from report.pages.marks import prescriptive_key
from report.pages.parts import PackageData
from report.pages.study_years import study_years
from report.pages.symbols import with_symbols
from report.text.counts import numbered
from report.text.grouping import ids_by
from report.text.letter_case import capitalized
from report.text.names import named
from report.text.units import number


def page(package: PackageData, evidence: Evidence) -> Mapping[str, object]:
    """Return the values in captions, the table, the procedures, and years if in a study."""
    done, marks = package.assessment, package.marks
    has_floor = any(item.floor_m for item in done.arrays)
    routes = ids_by(done.arrays, lambda item: _routes(package, item))
    return {
        "prescriptive_clause": marks.clause(prescriptive_key(done.governing)),
        "has_floor": has_floor,
        "floor_clause": marks.clause("analysis_floor"),
        "floor_percent": number(100.0 * done.rules["analysis_floor"], 0),
        "takes_larger": has_floor and any(item.route is Route.ANALYSIS for item in done.arrays),
        "cases": Markup("; ").join(
            Markup("{} with {}, {}").format(
                case.array.id,
                with_symbols(case.changed),
                package.fmt.both_up(case.array.design_m),
            )
            for case in evidence.cases
        ),
        "arrays": comparison_table(package),
        "is_seaoc": done.rules.name.startswith("SEAOC"),
        "routes": [(named(ids, "Array"), words) for words, ids in routes.items()],
        "studies": list(study_years(package)),
    }


def _routes(package: PackageData, item: ArrayAssessment) -> str:
    """Return the reason for the procedure of an array, and whether the other is permitted."""
    done, given_m, analysis = package.assessment, item.prescriptive.value_m, item.analysis
    building = building_limits(done.project, done.rules)
    limits = (*item.limits.prescriptive_checks, *item.limits.checks, *building)
    failed = [words(of_limit(limit)) for limit in limits if not limit.ok]
    if failed:
        status = f"the prescriptive procedure is not permitted: {_reasons(package, failed)}"
    elif analysis.value_m > given_m:
        status = (
            "the limits of the prescriptive procedure are satisfied, but the analysis "
            "displacement exceeds the prescriptive displacement"
        )
    else:
        status = f"the prescriptive displacement may be used instead ({package.part('limits')})"
    faults = _reasons(package, done.against_analysis(item))
    refused = f"the analysis procedure is not permitted: {faults}"
    parts: list[str] = []
    if item.route is Route.PRESCRIPTIVE:
        parts.append("the prescriptive procedure is used")
        if analysis.largest_m > given_m:
            parts.append("the largest PRD exceeds the prescriptive displacement and is used")
        return _sentences([*parts, refused])
    if math.isnan(item.design_m):
        return _sentences(["no analysis displacement", status])
    n_above = sum(run.governing.prd_m > given_m for run in item.motions)
    above = f"{n_above} of {len(item.motions)} PRDs {'exceeds' if n_above == 1 else 'exceed'}"
    if analysis.value_m > given_m:
        parts.append(
            f"the analysis displacement is {number(analysis.value_m / given_m, 2)} times the "
            f"prescriptive displacement ({above} it){' and governs' if item.is_permitted else ''}"
        )
    elif n_above:
        parts.append(
            f"{above} the prescriptive displacement, but the analysis displacement does not"
        )
    if package.data.is_peer_reviewed:
        parts.append("no floor applies because the analysis is peer reviewed")
    if not item.is_permitted:
        parts.append(refused)
    return _sentences([*parts, status])


def _reasons(package: PackageData, limits: Sequence[str]) -> str:
    """Return the first two limits that do not permit a procedure, and where the others are."""
    count = len(limits) - 2
    further = [f"{numbered(count, 'more limit')} in {package.part('limits')}"] if count > 0 else []
    return "; ".join([*limits[:2], *further])


def _sentences(parts: Sequence[str]) -> str:
    """Return parts as sentences, the first after a colon and the last without its full stop."""
    return ". ".join([parts[0], *map(capitalized, parts[1:])])
