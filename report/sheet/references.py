"""Names that refer to something that is not there, and what may have been meant."""

from __future__ import annotations

import difflib
from collections.abc import Collection, Iterable


def nearest(value: str, names: Iterable[str]) -> str:
    """Return the name that is spelled nearly as a value, ignoring case; empty for none."""
    folded = {name.casefold(): name for name in names}
    close = difflib.get_close_matches(value.casefold(), folded, n=1)
    return folded[close[0]] if close else ""


def suggestion(value: str, ids: Collection[str]) -> str:
    """Return in words which id may have been meant, or which there are."""
    if close := nearest(value, ids):
        return f"did you mean '{close}'?"
    names = ", ".join(list(ids)[:8])
    return f"give one of {names}" if names else "add it there first"
