"""The results letter: scope of the analysis, verdict, arrays, and conditions of use."""

from __future__ import annotations

import math
from collections.abc import Mapping

from report.assessment.assessment import Assessment
from report.assessment.checks.check import LOWERING
from report.assessment.design.tested_friction import basis_words
from report.assessment.design.verdict import Verdict
from report.document.tables import stamp
from report.pages.array_tables import letter_table
from report.pages.checks import verdict_sentence
from report.pages.parts import PackageData, all_or, friction_report
from report.pages.review import by_analysis, excepted
from report.text.counts import counted, spelled
from report.text.grouping import ids_by
from report.text.letter_case import capitalized, lowered
from report.text.names import ranged


def page(package: PackageData) -> Mapping[str, object]:
    """Return the paragraphs of the letter."""
    done, data = package.assessment, package.data
    n_overrides, summary = len(data.overrides), package.part("summary")
    lowered_checks = [check for check in done.checks if check.id in LOWERING]
    return {
        "data": data,
        "project": data.project,
        "membrane": data.friction_tests.membrane,
        "support": data.friction_tests.support,
        "scope": _scope(package),
        "rules": done.rules.name,
        "verdict": stamp(done.verdict, done.verdict.value),
        "verdict_sentence": verdict_sentence(done, f"in {summary}"),
        "arrays": letter_table(package),
        "has_clearances": bool(done.clearances or done.missing_gaps),
        "clearances": _clearances(done),
        "open_checks": _open_checks(done, summary),
        "overrides": f"{capitalized(counted(n_overrides, 'value'))} of the rule set "
        f"{'is' if n_overrides == 1 else 'are'} overridden for this project "
        f"({package.part('provisions')})."
        if n_overrides
        else "",
        # What asks for less than the rule set stands in the letter, too.
        "lowered": "; ".join(
            f"{lowered(check.title)}: {check.found} (required: {check.limit})"
            for check in lowered_checks
        ),
        "has_no_floor": bool(data.is_peer_reviewed and by_analysis(done)),
        "excepted": excepted(done),
        "is_unpermitted": any(math.isnan(item.permitted_m) for item in done.arrays),
        "friction": _friction(package),
        "report": friction_report(data.friction_tests),
        "has_motions": done.has_motions,
        "workbook": done.source.path.name,
    }


def _scope(package: PackageData) -> str:
    """Return the analysis and the number of arrays, up to the name of the rule set."""
    done = package.assessment
    ids = [item.id for item in done.arrays]
    were = "was" if len(ids) == 1 else "were"
    arrays = f"{capitalized(counted(len(ids), 'ballasted array'))} ({ranged(ids)}) {were}"
    if not done.has_motions:
        return f"{arrays} assigned the prescriptive displacement of"
    n_runs = sum(len(item.runs) for item in done.arrays)
    motions = counted(len(done.shaking.motions), "motion")
    return (
        f"{arrays} analyzed by response history under {motions}, in {counted(n_runs, 'run')}, and "
        "compared with"
    )


def _clearances(done: Assessment) -> str:
    """Return the number of satisfied clearances, and of those without a row."""
    n_missing = len(done.missing_gaps)
    count, passed = len(done.clearances) + n_missing, sum(gap.ok for gap in done.clearances)
    if not count:
        text = "The workbook lists no clearances; none is checked."
    elif count == 1:
        text = f"The clearance is {'' if passed else 'not '}satisfied."
    elif not passed:
        text = f"None of the {counted(count, 'clearance')} is satisfied."
    elif passed == count:
        text = "Both clearances" if count == 2 else f"All {counted(count, 'clearance')}"
        text += " are satisfied."
    else:
        are = "is" if passed == 1 else "are"
        text = f"{capitalized(spelled(passed))} of {counted(count, 'clearance')} {are} satisfied."
    if not n_missing:
        return text
    which = "it" if count == 1 else f"{spelled(n_missing)} of them"
    return f"{text} The plan shows {which} without a row in the workbook."


def _open_checks(done: Assessment, summary: str) -> str:
    """Return the number of open checks, and how the summary lists them."""
    count = len(done.open)
    n_failed = sum(check.verdict is Verdict.NG for check in done.open)
    if not count:
        return "All other requirements are satisfied."
    which, condition = ("it", "a condition") if count == 1 else ("them", "conditions")
    if n_failed == count:
        listed = f"{which} as NG"
    elif not n_failed:
        listed = f"{which} as {condition}"
    else:
        listed = f"{spelled(n_failed)} as NG and {counted(count - n_failed, 'condition')}"
    are = "is" if count == 1 else "are"
    required = capitalized(counted(count, "requirement"))
    return f"{required} {are} open; the summary ({summary}) lists {listed}."


def _friction(package: PackageData) -> str:
    """Return the source of the friction of each array."""
    arrays = package.data.arrays
    sources = ids_by(arrays, lambda array: (basis_words(package.data, array), array.mu_report))
    sentences = [
        f"{capitalized(all_or(ids, len(arrays)))}: {report + '; ' if report else ''}{basis}"
        for (basis, report), ids in sources.items()
    ]
    return ". ".join(sentences)
