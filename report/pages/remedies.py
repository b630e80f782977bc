"""What would satisfy each clearance and array marked NG, in words and as a table."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import groupby

from report.assessment.friction import mu_words
from report.assessment.remedies import Remedy, RemedyKind
from report.assessment.trials import with_mu
from report.document.tables import Table, TableRow, Wide
from report.entities.columns import TableColumn
from report.pages.parts import PackageData
from report.pages.symbols import with_symbols
from report.words.units import Quantity, compared, no_less, number, pair


def sentences(package: PackageData, remedies: Sequence[Remedy]) -> Sequence[str]:
    """Return a sentence for each clearance and array marked NG, and what was varied for it."""
    groups = groupby(remedies, key=lambda remedy: (remedy.clearance, _of_array(remedy)))
    texts = [with_symbols(_sentence(package, list(group))) for _, group in groups]
    return [*texts, *map(with_symbols, bases(remedies))]


def _of_array(remedy: Remedy) -> str:
    return "" if remedy.clearance else remedy.array


def _sentence(package: PackageData, remedies: Sequence[Remedy]) -> str:
    first = remedies[0]
    if first.clearance:
        row = package.assessment.clearances[first.clearance - 1].clearance
        start = f"Clearance {first.clearance}, {row.array} to {row.object}, would be satisfied"
    else:
        start = f"Array {first.array} would have final values"
    frictions = [remedy for remedy in remedies if remedy.kind is RemedyKind.FRICTION]
    others = [remedy for remedy in remedies if remedy.kind is not RemedyKind.FRICTION]
    enough = [_friction(package, frictions)] if all(remedy.exists for remedy in frictions) else []
    enough += [_other(package, remedy) for remedy in others if remedy.exists]
    reasons = {
        f"No {remedy.kind.value} would do: {remedy.basis}."
        for remedy in remedies
        if not remedy.exists
    }
    words = [f"{start} with {_any_of(enough)}."] if enough else [f"{start} by none of these."]
    return " ".join([*words, *sorted(reasons)])


def _any_of(texts: Sequence[str]) -> str:
    """Join alternatives."""
    return texts[0] if len(texts) == 1 else f"{', with '.join(texts[:-1])}, or with {texts[-1]}"


def _friction(package: PackageData, remedies: Sequence[Remedy]) -> str:
    return "μ of at least " + " and ".join(
        f"{_law(package, one, one.value)} for {one.array} (given {_law(package, one, one.given)})"
        for one in remedies
    )


def _law(package: PackageData, remedy: Remedy, mu: float) -> str:
    """Return the friction of an array as run with a low-velocity coefficient."""
    array = next(array for array in package.data.arrays if array.id == remedy.array)
    return mu_words(with_mu(array, mu).friction)


def _other(package: PackageData, remedy: Remedy) -> str:
    if remedy.kind is RemedyKind.S_DS:
        return f"S_DS of at most {number(remedy.value, 2)} g (given {number(remedy.given, 3)} g)"
    enough, given = _separations(package, remedy)
    return f"{enough} provided (given {given})"


def _separations(package: PackageData, remedy: Remedy) -> tuple[str, str]:
    """Return a separation that would do and the one given, as the clearances print them."""
    _, had = compared(remedy.value, remedy.given)
    us_first = package.fmt.us_first
    given = pair(remedy.given, Quantity.SIZE, us_first, had)
    return pair(remedy.value, Quantity.SIZE, us_first, no_less), given


def table(package: PackageData, remedies: Sequence[Remedy]) -> Table:
    """Return what would do, with the resolution and what was verified."""
    return Table(
        caption="What would do, each by itself",
        columns=(
            TableColumn(head="No.", share=0.5),
            TableColumn(head="Quantity", align="left", share=1.9),
            TableColumn(head="Given", align="left", share=1.9),
            TableColumn(head="Would do", align="left", share=2.1),
            TableColumn(head="Resolution", align="left", share=1.1),
            TableColumn(head="Verified by all runs", align="left", share=2.2),
        ),
        rows=tuple(_row(package, remedy) for remedy in remedies),
        notes=(with_symbols(f"{_SEARCH} {' '.join(bases(remedies))}"),),
        kind="compact",
    )


_SEARCH = (
    "Friction is searched from 1.5 down in steps of 0.05 and 0.01, S_DS from 0.05 g up in steps of "
    "0.20, 0.05 and 0.01 g, to the first value at which a run leaves the clearance not satisfied. "
    "All values tried from there to the start of the search satisfy."
)


def bases(remedies: Sequence[Remedy]) -> Sequence[str]:
    """Return what was varied for each quantity, each basis once."""
    texts = (
        f"{_sentence_case(remedy)}: {remedy.basis}."
        for remedy in remedies
        if remedy.exists and remedy.kind is not RemedyKind.SEPARATION
    )
    return list(dict.fromkeys(texts))


def _row(package: PackageData, remedy: Remedy) -> TableRow:
    found = (
        (_value(package, remedy), f"{remedy.resolution:g}" if remedy.resolution else "exact")
        if remedy.exists
        else ()
    )
    return TableRow(
        cells=(
            str(remedy.clearance) if remedy.clearance else "—",
            f"μ of {remedy.array}"
            if remedy.kind is RemedyKind.FRICTION
            else with_symbols(_sentence_case(remedy)),
            _given(package, remedy),
            *((*found, _verified(remedy)) if found else (_none(remedy),)),
        )
    )


def _none(remedy: Remedy) -> Wide:
    return Wide(with_symbols(f"none: {remedy.basis}"), 3)


def _sentence_case(remedy: Remedy) -> str:
    name = remedy.kind.value
    return name[0].upper() + name[1:]


def _given(package: PackageData, remedy: Remedy) -> str:
    if remedy.kind is RemedyKind.SEPARATION:
        return _separations(package, remedy)[1]
    if remedy.kind is RemedyKind.S_DS:
        return f"{number(remedy.given, 3)} g"
    return _law(package, remedy, remedy.given)


def _value(package: PackageData, remedy: Remedy) -> str:
    if remedy.kind is RemedyKind.SEPARATION:
        return f"≥ {_separations(package, remedy)[0]}"
    if remedy.kind is RemedyKind.S_DS:
        return f"≤ {number(remedy.value, 2)} g"
    return f"≥ {_law(package, remedy, remedy.value)}"


def _verified(remedy: Remedy) -> str:
    if remedy.kind is RemedyKind.SEPARATION:
        return "the runs of this package"
    low, high = remedy.verified
    return f"{number(low, 2)} to {number(high, 2)}, {remedy.n_values} values"
