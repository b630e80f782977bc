"""What would satisfy each clearance and array marked NG, for sentences and as a table."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import groupby
from operator import attrgetter

from report.assessment.friction import mu_words
from report.assessment.remedies import Remedy, RemedyKind
from report.assessment.trials import with_mu
from report.document.tables import Table, Wide, listed
from report.entities.shown import text, words
from report.pages.parts import PackageData
from report.pages.symbols import with_symbols
from report.words.counts import capitalized
from report.words.units import Quantity, beside, no_less, number, pair


@dataclass(frozen=True, slots=True, kw_only=True)
class PrintedRemedy:
    """A remedy with the value given and the one that would do, for print; the latter if any."""

    remedy: Remedy
    given: str
    value: str


def answers(package: PackageData, remedies: Sequence[Remedy]) -> Mapping[str, object]:
    """Return what would do, in groups and as a table, with what was varied; empty if nothing."""
    if not remedies:
        return {}
    found = [_answer(package, remedy) for remedy in remedies]
    # Of a clearance all arrays together; what is of none, each array by itself.
    groups = groupby(found, key=lambda one: one.remedy.clearance or one.remedy.array)
    return {
        "groups": [_group(package, list(group)) for _, group in groups],
        "bases": dict.fromkeys(
            (remedy.kind.value, remedy.basis)
            for remedy in remedies
            if remedy.exists and remedy.kind is not RemedyKind.SEPARATION
        ),
        "table": _table(package, found),
    }


def _answer(package: PackageData, remedy: Remedy) -> PrintedRemedy:
    given, value = remedy.given, remedy.value
    if remedy.kind is RemedyKind.SEPARATION:
        # As the clearances print them.
        shows = ((given, beside(value, given)), (value, no_less))
        us_first = package.fmt.us_first
        texts = [pair(length_m, Quantity.SIZE, us_first, show) for length_m, show in shows]
    else:
        array = next(array for array in package.data.arrays if array.id == remedy.array)
        mus = (given, value) if remedy.exists else (given, given)
        texts = [mu_words(with_mu(array, mu).friction) for mu in mus]
    return PrintedRemedy(remedy=remedy, given=texts[0], value=texts[1] if remedy.exists else "")


def _group(package: PackageData, group: Sequence[PrintedRemedy]) -> Mapping[str, object]:
    """Return the ways to satisfy a clearance, or to give an array final values, each by itself."""
    first = group[0].remedy
    frictions = [one for one in group if one.remedy.kind is RemedyKind.FRICTION]
    others = [[one] for one in group if one.remedy.kind is not RemedyKind.FRICTION]
    return {
        "number": first.clearance,
        "gap": package.assessment.clearances[first.clearance - 1] if first.clearance else None,
        "array": first.array,
        "ways": [way for way in (frictions, *others) if way and all(one.value for one in way)],
        "in_vain": sorted(
            {(one.remedy.kind.value, one.remedy.basis) for one in group if not one.value}
        ),
    }


def _table(package: PackageData, found: Sequence[PrintedRemedy]) -> Table:
    """Return what would do, with the resolution and what was verified."""

    def quantity(one: PrintedRemedy) -> str:
        if one.remedy.kind is RemedyKind.FRICTION:
            return f"μ of {one.remedy.array}"
        return with_symbols(capitalized(one.remedy.kind.value))

    def value(one: PrintedRemedy) -> str | Wide:
        if not one.value:
            return Wide(with_symbols(f"none: {one.remedy.basis}"), 3)
        return f"≥ {one.value}"

    def resolution(one: PrintedRemedy) -> str:
        return f"{one.remedy.resolution:g}" if one.remedy.resolution else "exact"

    def verified(one: PrintedRemedy) -> str:
        if one.remedy.kind is RemedyKind.SEPARATION:
            return "the runs of this package"
        low, high = one.remedy.verified
        return f"{number(low, 2)} to {number(high, 2)}, {one.remedy.n_values} values"

    columns = (
        (text("No.", share=0.5), lambda one: one.remedy.clearance or "—"),
        (words("Quantity", 1.9), quantity),
        (words("Given", 1.9), attrgetter("given")),
        (words("Sufficient", 2.1), value),
        (words("Resolution", 1.1), resolution),
        (words("Verified by all runs", 2.2), verified),
    )
    return listed(found, columns, package.fmt, kind="compact")
