"""The letter of results: one page for the client, every sentence from the data. Read `letter`."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping

from markupsafe import Markup

from report.assessment.arrays import ArrayAssessment
from report.assessment.verdict import Consequence
from report.pages.front import verdict_sentence
from report.pages.parts import PackageData, Table, TableColumn, TableRow, stamp
from report.typeset.equations import symbol
from report.words.units import number, ratio


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
        "arrays": _arrays(package),
        "texts": tuple(_texts(package)),
        "signed": project.prepared_by,
    }


def _analyzed(package: PackageData) -> Markup:
    """Return what was analyzed: arrays, motions, runs and rule set."""
    assessment, site = package.assessment, package.data.site
    arrays, motions = assessment.arrays, assessment.shaking.motions
    runs = sum(len(motion.runs) for array in arrays for motion in array.motions)
    text = (
        f"{counted(len(arrays), 'ballasted array')} ({', '.join(item.id for item in arrays)}) "
        f"{'was' if len(arrays) == 1 else 'were'} analyzed by response history under "
        f"{counted(len(motions), 'motion')}, in {counted(runs, 'run')}, and compared with "
        f"{assessment.rules.name}"
    )
    return Markup("{} for {} = {} g and seismic design category {}.").format(
        text, symbol("S_DS"), number(site.s_ds, 3), site.sdc.value
    )


def counted(count: int, noun: str) -> str:
    """Return a number of things in words, such as `1 array` or `3 arrays`."""
    return f"{count} {noun}" if count == 1 else f"{count} {noun}s"


def _arrays(package: PackageData) -> Table:
    return Table(
        caption="Results",
        columns=(
            TableColumn(head="Array", align="left", share=1.0),
            *package.fmt.columns("Design displacement", share=1.0),
            TableColumn(head="Governed by", align="left", share=1.4),
            TableColumn(head="Largest D/C", share=1.0),
            TableColumn(head="Clearance", align="left", share=1.4),
            TableColumn(head="Verdict", align="center", share=1.6),
        ),
        rows=tuple(TableRow(cells=_array(package, item)) for item in package.assessment.arrays),
        notes=("D/C: required / provided separation of the clearance named beside it.",),
        kind="compact",
    )


def _array(package: PackageData, item: ArrayAssessment) -> tuple[str, ...]:
    gap = package.assessment.governing_clearance(item.id)
    return (
        item.id,
        *package.fmt.cells(item.design_m, mark=package.design_mark(item)),
        item.governs,
        "—" if gap is None else ratio(gap.demand_capacity),
        "none given" if gap is None else f"to {gap.across_from(item.id)}",
        stamp(package.assessment.array_verdict(item)),
    )


def _texts(package: PackageData) -> Iterator[str]:
    yield _clearances(package)
    yield _conditions(package)
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
    are = "is" if passed == 1 else "are"
    return f"{passed} of {counted(len(gaps), 'clearance')} {are} satisfied."


def _conditions(package: PackageData) -> str:
    """Return how many requirements are open, and what they lead to."""
    rows = package.assessment.conditions
    if not rows:
        return "All requirements beside the numeric limits are satisfied."
    severe = sum(row.consequence is Consequence.NG for row in rows)
    leads = [
        f"{count} {'leads' if count == 1 else 'lead'} to {verdict}"
        for count, verdict in ((severe, "NG"), (len(rows) - severe, "OK with conditions"))
        if count
    ]
    are = "is" if len(rows) == 1 else "are"
    return (
        f"{counted(len(rows), 'requirement')} {are} not satisfied: {' and '.join(leads)}. Each is "
        f"listed in {package.part('summary')} with what must be done."
    )


def _departures(package: PackageData) -> Iterator[str]:
    """Yield where the package departs from the numbers of the rule set."""
    options, where = package.data.options, package.part("provisions")
    if package.data.overrides:
        count = counted(len(package.data.overrides), "number")
        are = "is" if len(package.data.overrides) == 1 else "are"
        yield f"{count} of the rule set {are} overridden for this project ({where})."
    if options.directional:
        yield (
            "The clearances take the displacement in their own direction, a departure from the "
            f"rule set ({where})."
        )
    if options.peer_reviewed:
        yield "The floor on the displacement from analysis is not applied: peer review is stated."
    if any(math.isnan(item.design_m) for item in package.assessment.arrays):
        yield "An array without a design displacement is NG: no clearance is shown to suffice."
