"""The one sentence that says a check, and its parts for the columns of tables."""

from __future__ import annotations

import math

from report.assessment.checks.check import Check, Sense
from report.text.amounts import Amount, amount_text, amount_texts
from report.text.letter_case import capitalized, lowered
from report.text.units import Quantity, ratio

# Kinds whose subjects are pairs, which do not count on as A1 to A3 do.
PAIRS = ("clearance", "neighbors", "fire_pathway")


def texts(check: Check, us_first: bool, *, is_both: bool = True) -> tuple[str, str]:
    """Return what is found and what is required with its sign, for two cells of a table.

    Numbers are rounded to the safe side, and so that their order shows. Where it is not both
    systems, they are in the preferred one alone.
    """
    found, limit = _texts(check, us_first, is_both=is_both)
    is_amount = isinstance(check.limit, Amount)
    return found, f"{check.sense} {limit}" if is_amount else limit


def found_and_limit(check: Check, us_first: bool) -> tuple[str, str]:
    """Return the same in both systems, what is found with its note."""
    found, limit = texts(check, us_first)
    return found + (f" ({check.note})" if check.note else ""), limit


def sentence(check: Check, us_first: bool) -> str:
    """Return a check in words: of what, what was found, what is required and by which clause."""
    found, limit = _texts(check, us_first)
    heading = f"{check.title}, {check.subject}" if check.subject else check.title
    found += f" ({check.note})" if check.note else ""
    if isinstance(check.limit, Amount):
        limit = f"{check.sense.words} {limit}"
    close = check.to_close  # of a note it says what does not follow
    if check.is_open and close:
        close = f"To close: {lowered(close)}"
    parts = f"{heading}: {found}.", f"Required: {limit} ({check.clause}).", close, check.otherwise
    return capitalized(" ".join(filter(None, parts)))


def _texts(check: Check, us_first: bool, *, is_both: bool = True) -> tuple[str, str]:
    found, limit = check.found, check.limit
    if isinstance(found, Amount) and isinstance(limit, Amount):
        is_at_least = check.sense is Sense.AT_LEAST
        if check.sense is Sense.EQUAL:
            is_at_least = (found.value >= limit.value) is check.is_satisfied
        return amount_texts(found, limit, us_first, is_at_least=is_at_least, is_both=is_both)
    first, second = (
        each if isinstance(each, str) else amount_text(each, us_first, is_both=is_both)
        for each in (found, limit)
    )
    return first, second


def words(check: Check, array: str = "") -> str:
    """Return a check in a few words: `roof slope of A1 (D/C 1.29)`; or in the row of an array."""
    name = lowered(check.title)
    if check.subject not in ("", array):
        name += f" {check.subject}" if check.id in PAIRS else f" of {check.subject}"
    if math.isinf(check.ratio) and isinstance(check.found, str):
        return f"{name} ({check.found})"
    if isinstance(check.limit, Amount) and check.limit.quantity is Quantity.COUNT:
        found, limit = _texts(check, us_first=True)
        return f"{name} ({found}, {check.sense.words} {limit})"
    has_ratio = check.is_capacity and not math.isnan(check.ratio)
    return f"{name} (D/C {ratio(check.ratio)})" if has_ratio else name
