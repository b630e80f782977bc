"""The sentence for a check, or for several identical ones, and its parts for tables.

Electrical slack of A1 with D/C 1.02 and of A2 with D/C 1.09 are one check of A1 and A2 with D/C
1.09; for clearances, the worst pair is named with the number of others.
"""

from __future__ import annotations

import math
from collections.abc import Hashable, Iterable, Sequence
from dataclasses import replace
from itertools import chain

from report.assessment.checks.check import Check, Sense
from report.project.check.finding_lines import listed
from report.text.amounts import Amount, amount_text, amount_texts
from report.text.grouping import grouped_by
from report.text.letter_case import capitalized, lowered
from report.text.names import ranged
from report.text.units import Quantity, Rounding, nan_is_worst, ratio

# Kinds whose subjects are pairs, which do not count on as A1 to A3 do.
PAIRS = ("clearance", "neighbors", "fire_pathway")


def texts(check: Check, us_first: bool, *, is_both: bool = True) -> tuple[str, str]:
    """Return the value found and the value required with its sign, for two table cells.

    Numbers are rounded to the safe side, and so that their order shows. Where it is not both
    systems, they are in the preferred one alone.
    """
    found_text, limit = _texts(check, us_first, is_both=is_both)
    is_amount = isinstance(check.limit, Amount)
    return found_text, f"{check.sense} {limit}" if is_amount else limit


def found_and_limit(check: Check, us_first: bool) -> tuple[str, str]:
    """Return the same in both systems of units, the value found with its note."""
    found_text, limit = texts(check, us_first)
    return found_text + (f" ({check.note})" if check.note else ""), limit


def sentence(check: Check, us_first: bool) -> str:
    """Return a check as a sentence: subject, value found, value required and code section."""
    found_text, limit = _texts(check, us_first)
    heading = f"{check.title}, {check.subject}" if check.subject else check.title
    found_text += f" ({check.note})" if check.note else ""
    if isinstance(check.limit, Amount):
        limit = f"{check.sense.words} {limit}"
    close = check.to_close  # of a note it says what does not follow
    if check.is_open and close:
        close = f"To close: {lowered(close)}"
    parts = (
        f"{heading}: {found_text}.",
        f"Required: {limit} ({check.clause}).",
        close,
        check.otherwise,
    )
    return capitalized(" ".join(filter(None, parts)))


def _texts(check: Check, us_first: bool, *, is_both: bool = True) -> tuple[str, str]:
    found_value, limit = check.found, check.limit
    if isinstance(found_value, Amount) and isinstance(limit, Amount):
        is_at_least = check.sense is Sense.AT_LEAST
        if check.sense is Sense.EQUAL:
            # `in_order` prints digits until the two show this order: equal ones print equal.
            is_at_least = (found_value.value >= limit.value) is check.is_satisfied
        return amount_texts(found_value, limit, us_first, is_at_least=is_at_least, is_both=is_both)
    first, second = (
        amount if isinstance(amount, str) else amount_text(amount, us_first, is_both=is_both)
        for amount in (found_value, limit)
    )
    return first, second


def words(check: Check, array: str = "") -> str:
    """Return a check as a short name: `roof slope of A1 (D/C 1.29)`; or for the row of an array."""
    name = lowered(check.title)
    if check.subject not in ("", array):
        name += f" {check.subject}" if check.id in PAIRS else f" of {check.subject}"
    if math.isinf(check.ratio) and isinstance(check.found, str):
        return f"{name} ({check.found})"
    if isinstance(check.limit, Amount) and check.limit.quantity is Quantity.COUNT:
        found_text, limit = _texts(check, us_first=True)
        return f"{name} ({found_text}, {check.sense.words} {limit})"
    has_ratio = check.is_capacity and not math.isnan(check.ratio)
    return f"{name} (D/C {ratio(check.ratio)})" if has_ratio else name


def alike(checks: Iterable[Check]) -> Sequence[Check]:
    """Return identical checks of several subjects combined into one, with the values of each."""

    def asked(check: Check) -> Hashable:
        # Of numbers the worst stands for all, whatever each is compared with.
        limit = "" if isinstance(check.limit, Amount) else check.limit
        return check.id, check.title, limit, check.clause, check.verdict, check.actor

    return [_as_one(group) for group in grouped_by(checks, asked).values()]


def _as_one(group: Sequence[Check]) -> Check:
    first = group[0]
    if len(group) == 1:
        return first
    worst_one = max(group, key=size)
    found_value, limit, note = worst_one.found, worst_one.limit, worst_one.note
    if isinstance(limit, Amount):
        if any((check.found, check.limit) != (found_value, limit) for check in group):
            # Where the numbers differ those of the worst are printed, and it is named.
            limit = replace(limit, mark=f"{limit.mark} ({worst_one.subject})")
    elif all(isinstance(check.found, Amount) for check in group):
        found_value, note = _apart(group)
    else:
        found_value, note = _found(group), ""
    by_remedy = grouped_by(group, lambda check: check.remedy)
    arrays = dict.fromkeys(chain.from_iterable(check.arrays for check in group))
    places = dict.fromkeys(chain.from_iterable(check.places for check in group))
    return replace(
        worst_one,
        subject=subjects(group),
        found=found_value,
        limit=limit,
        note=note,
        arrays=tuple(arrays),
        remedy=" ".join(_closed(checks) for checks in by_remedy.values()),
        cell="",
        otherwise=" ".join(dict.fromkeys(c.otherwise for c in group if c.otherwise)),
        places=tuple(places),
    )


def _closed(checks: Sequence[Check]) -> str:
    """Return the remedy of checks that have one, with the first few of their cells."""
    return replace(checks[0], cell=listed(check.cell for check in checks)).to_close


def size(check: Check) -> tuple[float, float]:
    """Return a sort key, the largest for the worst of checks that ask the same."""
    # Where none of them is given the largest that is required is shown.
    limit = check.limit.value if isinstance(check.limit, Amount) else 0.0
    return nan_is_worst(check.ratio), nan_is_worst(limit)


def _apart(group: Sequence[Check]) -> tuple[Amount, str]:
    """Return the conservative value of quantities that are not compared with a limit, its note."""
    amounts = [(check.found, check) for check in group if isinstance(check.found, Amount)]
    is_capacity = amounts[0][0].rounding is Rounding.DOWN
    amount, shown = (min if is_capacity else max)(amounts, key=lambda pair: pair[0].value)
    is_one = all((value, check.note) == (amount, shown.note) for value, check in amounts)
    mark = amount.mark if is_one else f"{amount.mark} ({shown.subject})"
    return replace(amount, mark=mark), shown.note


def _found(group: Sequence[Check]) -> str:
    """Return the values found as text, with common parts stated once."""
    all_parts = [
        [*str(check.found).split("; "), *([check.note] if check.note else [])] for check in group
    ]
    shared = [part for part in all_parts[0] if all(part in parts for parts in all_parts)]
    checks_by_text: dict[str, list[Check]] = {}
    for check, parts in zip(group, all_parts, strict=True):
        text = ", ".join(part for part in parts if part not in shared)
        checks_by_text.setdefault(text, []).append(check)
    differing = [f"{subjects(checks)}: {text}" for text, checks in checks_by_text.items() if text]
    return "; ".join([*shared, *differing])


def subjects(group: Sequence[Check]) -> str:
    """Return the subjects of similar checks: `A1 to A3`, or the worst pair and a count."""
    names = list(dict.fromkeys(check.subject for check in group))
    if group[0].id not in PAIRS or len(names) == 1:
        return ranged(names)
    return f"{max(group, key=size).subject} and {len(names) - 1} more"
