"""The summary: verdict, arrays, governing checks, and open conditions."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from report.assessment.assessment import Assessment
from report.assessment.checks.check import VELOCITY_ROW
from report.assessment.checks.sentence import alike
from report.assessment.remedies.remedy import Remedies
from report.assessment.support.evidence import Evidence
from report.document.tables import stamp
from report.pages.array_tables import summary_table
from report.pages.checks import (
    FirstSheet,
    condition_table,
    first_sheet,
    governing_table,
    verdict_sentence,
)
from report.pages.marks import prescriptive_key
from report.pages.parts import PackageData, statistic
from report.pages.review import by_analysis, excepted
from report.text.counts import numbered
from report.text.letter_case import capitalized, lowered
from report.text.names import named
from report.text.units import number
from solver.rules.provisions import Basis


def page(
    package: PackageData, evidence: Evidence, sheet: FirstSheet | None = None
) -> Mapping[str, object]:
    """Return the summary.

    `sheet` are the checks for which the first sheet has room; without it all of them.
    """
    done, data, numbers = package.assessment, package.data, package.numbers
    sheet = sheet or first_sheet(done)
    notes = alike(check for check in done.checks if check.is_note and not check.is_satisfied)
    then = "NG items, then " if sheet.failed else ""
    return {
        "verdict": stamp(done.verdict, done.verdict.value),
        "verdict_sentence": verdict_sentence(done),
        "s_ds": number(data.site.s_ds, 3),
        "sdc": data.site.sdc_text,
        "i_e": number(data.site.i_e, 2),
        "risk_category": data.site.risk_category.value,
        "rules": done.rules.name,
        "confirmed": data.confirmed,
        "review": list(_review(package)) if data.is_peer_reviewed else [],
        "excepted": excepted(done),
        "arrays": summary_table(package),
        "arrays_caption": _caption(package),
        "has_seaoc": not done.has_motions and not done.rules.name.startswith("SEAOC"),
        "governing": governing_table(sheet, done, numbers),
        "governing_caption": f"Governing of {len(done.checks)} checks: {then}largest ratio of "
        "each type",
        "n_largest": len(sheet.largest),
        "following": capitalized(numbered(sheet.n_following, "more check"))
        if sheet.n_following
        else "",
        "remedy": _enough(done, evidence.remedies) if sheet.has_remedies else "",
        "conditions": condition_table(sheet, done, numbers),
        "n_conditions": len(sheet.conditions),
        "more": capitalized(numbered(sheet.n_more, "more condition")) if sheet.n_more else "",
        "effects": list(_what_if(package, evidence)) if sheet.has_effects else [],
        "notes": "; ".join(dict.fromkeys(lowered(check.title) for check in notes))
        if sheet.has_remedies
        else "",
    }


def _review(package: PackageData) -> Iterator[str]:
    """Yield the effect of peer review, its arrays, and the result without it."""
    done, options = package.assessment, package.data.options
    reviewer = f"{options.peer_reviewer}, {options.peer_license}, {options.peer_date}"
    ids = by_analysis(done)
    if not ids:
        yield f"Peer review by {reviewer}; no array uses the analysis displacement."
        return
    arrays = f" of {named(ids, 'array')}" if len(ids) < len(done.arrays) else ""
    clause = package.marks.clause("analysis_floor")
    yield f"Floor{arrays}: none. Analysis peer reviewed by {reviewer} ({clause})."
    yield done.otherwise.get("peer_review", "")


def _caption(package: PackageData) -> str:
    """Return the caption of the table of arrays, with the provision of the displacements."""
    done, values = package.assessment, package.assessment.rules.values
    if not done.has_motions:
        clause = values[prescriptive_key(done.governing)].clause
        return f"Arrays: prescriptive displacement ({clause}) and design displacement"
    analysis, mark = done.governing.analysis, package.marks.of("analysis_factor")
    motions = numbered(analysis.n_motions, "motion") + mark
    if analysis.basis is Basis.TOO_FEW:
        basis = f"none: {analysis.basis}"
    else:
        clause = values["analysis_factor"].clause
        basis = f"{statistic(analysis.basis)} of {motions}, {clause}"
    return f"Arrays: analysis displacement ({basis}), prescriptive and design displacement"


def _enough(done: Assessment, remedies: Remedies) -> str:
    """Return the sufficient changes for an NG project, as a sentence; or that none was found."""
    if remedies.own and not remedies.together:
        return "None of the combinations tried is sufficient."
    return remedies.sentence


def _what_if(package: PackageData, evidence: Evidence) -> Iterator[str]:
    """Yield the results with other inputs; for a condition, its own row states them."""
    done = package.assessment
    # Of a rule set that the jurisdiction accepts no row says it, nor of friction that tests show.
    stated = {check.otherwise for check in done.checks if check.is_open}
    for id in ("rule_set", VELOCITY_ROW):
        if done.otherwise.get(id, "") not in (*stated, ""):
            yield done.otherwise[id]
    for case in evidence.cases:
        # What friction by velocity comes to is said above, of all arrays together.
        if done.low_velocity.of(case.array.id) is not case.array:
            yield case.words(package.fmt.us_first)
