"""Checks that ask the same of several subjects, as one.

Electrical slack of A1 with D/C 1.02 and of A2 with D/C 1.09 are one check of A1 and A2 with D/C
1.09; of clearances the worst pair is named, and how many more there are.
"""

from __future__ import annotations

from collections.abc import Hashable, Iterable, Sequence
from dataclasses import replace
from itertools import chain

from report.assessment.checks.check import Check
from report.assessment.checks.sentence import PAIRS
from report.text.amounts import Amount
from report.text.grouping import grouped_by
from report.text.names import ranged
from report.text.units import Rounding, nan_is_worst


def alike(checks: Iterable[Check]) -> Sequence[Check]:
    """Return checks that ask the same of several subjects as one each, with what each has."""

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
    found, limit, note = worst_one.found, worst_one.limit, worst_one.note
    if isinstance(limit, Amount):
        if any((check.found, check.limit) != (found, limit) for check in group):
            limit = replace(limit, mark=f"{limit.mark} ({worst_one.subject})")
    elif all(isinstance(check.found, Amount) for check in group):
        found = _apart(group)
    else:
        found, note = _found(group), ""
    arrays = dict.fromkeys(chain.from_iterable(check.arrays for check in group))
    places = dict.fromkeys(chain.from_iterable(check.places for check in group))
    return replace(
        worst_one,
        subject=subjects(group),
        found=found,
        limit=limit,
        note=note,
        arrays=tuple(arrays),
        remedy=" ".join(dict.fromkeys(check.remedy for check in group)),
        otherwise=" ".join(dict.fromkeys(c.otherwise for c in group if c.otherwise)),
        places=tuple(places),
    )


def size(check: Check) -> tuple[float, float]:
    """Return a sort key, the largest for the worst of checks that ask the same."""
    # Where none of them is given the largest that is required is shown.
    limit = check.limit.value if isinstance(check.limit, Amount) else 0.0
    return nan_is_worst(check.ratio), nan_is_worst(limit)


def _apart(group: Sequence[Check]) -> Amount:
    """Return of amounts that nothing is compared with the one on the safe side."""
    amounts = [(each.found, each.subject) for each in group if isinstance(each.found, Amount)]
    is_capacity = amounts[0][0].rounding is Rounding.DOWN
    found, subject = (min if is_capacity else max)(amounts, key=lambda each: each[0].value)
    is_one = all(each == found for each, _ in amounts)
    return found if is_one else replace(found, mark=f"{found.mark} ({subject})")


def _found(group: Sequence[Check]) -> str:
    """Return in words what is found: what all share is said once."""
    all_parts = [
        [*str(check.found).split("; "), *([check.note] if check.note else [])] for check in group
    ]
    shared = [part for part in all_parts[0] if all(part in parts for parts in all_parts)]
    own = grouped_by(
        zip(group, all_parts, strict=True),
        lambda each: ", ".join(part for part in each[1] if part not in shared),
    )
    others = [f"{subjects([check for check, _ in of])}: {text}" for text, of in own.items() if text]
    return "; ".join([*shared, *others])


def subjects(group: Sequence[Check]) -> str:
    """Return what checks of one kind are of: `A1 to A3`, or the worst pair and how many more."""
    names = list(dict.fromkeys(check.subject for check in group))
    if group[0].id not in PAIRS or len(names) == 1:
        return ranged(names)
    return f"{max(group, key=size).subject} and {len(names) - 1} more"
