"""The letter of results: one page for the client, every sentence from the data. Read `letter`."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping

from markupsafe import Markup

from report.assessment.overrides import LOWERING
from report.document.tables import stamp
from report.pages.front import verdict_sentence
from report.pages.parts import PackageData
from report.pages.review import review_sentences
from report.pages.symbols import with_symbols
from report.typeset.equations import symbol
from report.words.counts import capitalized, counted, spelled
from report.words.units import number
from solver.records.acceptance_row import Consequence


def letter(package: PackageData) -> Mapping[str, object]:
    """Return the letter of results."""
    project = package.data.project
    return {
        "date": project.date.isoformat(),
        "to": tuple(text for text in (project.client or "The owner", project.address) if text),
        "subject": f"{project.number} {project.name}: seismic displacement of ballasted rooftop "
        "solar arrays",
        "analyzed": _analyzed(package),
        "verdict": stamp(package.assessment.verdict),
        "sentence": verdict_sentence(package),
        "texts": tuple(_texts(package)),
        "signed": project.prepared_by,
    }


def _analyzed(package: PackageData) -> Markup:
    """Return what was analyzed: arrays, motions, runs and rule set."""
    assessment, site = package.assessment, package.data.site
    arrays, motions = assessment.arrays, assessment.shaking.motions
    runs = sum(len(motion.runs) for array in arrays for motion in array.motions)
    ids = ", ".join(item.id for item in arrays)
    text = (
        f"{capitalized(counted(len(arrays), 'ballasted array'))} ({ids}) "
        f"{'was' if len(arrays) == 1 else 'were'} analyzed by response history under "
        f"{counted(len(motions), 'motion')}, in {counted(runs, 'run')}, and compared with "
        f"{assessment.rules.name}"
    )
    return Markup("{} for {} = {} g and seismic design category {}.").format(
        text, symbol("S_DS"), number(site.s_ds, 3), site.sdc_text
    )


def _texts(package: PackageData) -> Iterator[str]:
    yield _clearances(package)
    yield _requirements(package)
    yield from _departures(package)
    yield (
        f"The verdicts are explained in {package.part('basis')}. The displacements are in "
        f"{package.part('results')} and {package.part('comparison')}, the clearances in "
        f"{package.part('clearances')}, the limits in {package.part('limits')}, and the values "
        f"entered in {package.part('echo')}."
    )


def _clearances(package: PackageData) -> str:
    gaps = package.assessment.clearances
    if not gaps:
        return "The workbook lists no clearances; none is checked."
    passed = sum(gap.ok for gap in gaps)
    if passed == len(gaps):
        each = "The clearance is" if passed == 1 else f"All {counted(passed, 'clearance')} are"
        return f"{each} satisfied."
    if not passed:
        if len(gaps) == 1:
            return "The clearance is not satisfied."
        return f"None of the {counted(len(gaps), 'clearance')} is satisfied."
    are = "is" if passed == 1 else "are"
    return f"{capitalized(spelled(passed))} of {counted(len(gaps), 'clearance')} {are} satisfied."


def _requirements(package: PackageData) -> str:
    """Return how many requirements are open, and as what the summary lists them."""
    rows, where = package.assessment.conditions, package.part("summary")
    if not rows:
        return "All requirements beside the numeric limits are satisfied."
    severe = sum(row.consequence is Consequence.NG for row in rows)
    is_one = len(rows) == 1
    open_ = f"{capitalized(counted(len(rows), 'requirement'))} {'is' if is_one else 'are'} open"
    if severe in (0, len(rows)):
        kind = "NG" if severe else "a condition" if is_one else "conditions"
        return f"{open_}; the summary ({where}) lists {'it' if is_one else 'them'} as {kind}."
    rest = counted(len(rows) - severe, "condition")
    return f"{open_}; the summary ({where}) lists {spelled(severe)} as NG and {rest}."


def _departures(package: PackageData) -> Iterator[str]:
    """Yield where the package departs from the numbers of the rule set."""
    options, where = package.data.options, package.part("provisions")
    if package.data.overrides:
        count = capitalized(counted(len(package.data.overrides), "number"))
        are = "is" if len(package.data.overrides) == 1 else "are"
        yield f"{count} of the rule set {are} overridden for this project ({where})."
    lowered = [row for row in package.assessment.rows if row.id in LOWERING]
    if lowered:
        named = "; ".join(
            f"{row.title[0].lower()}{row.title[1:]}: {row.found} (required: {row.limit})"
            for row in lowered
        )
        yield with_symbols(
            "This requires less than the rule set does, and needs the consent of the authority "
            f"having jurisdiction: {named}."
        )
    if options.directional:
        yield (
            "The clearances take the displacement in their own direction, a departure from the "
            f"rule set ({where})."
        )
    yield from review_sentences(package)
    if any(math.isnan(item.permitted_m) for item in package.assessment.arrays):
        yield (
            "An array without a permitted design displacement is NG: no clearance beside it is "
            "shown to suffice."
        )
