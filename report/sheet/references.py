"""Names that refer to something that is not there, and what may have been meant."""

from __future__ import annotations

import difflib
from collections.abc import Collection


def suggestion(value: str, ids: Collection[str]) -> str:
    """Return in words which id may have been meant, or which there are."""
    folded = {name.casefold(): name for name in ids}
    close = difflib.get_close_matches(value.casefold(), folded, n=1)
    if close:
        return f"did you mean '{folded[close[0]]}'?"
    names = ", ".join(list(ids)[:8])
    return f"give one of {names}" if names else "add it there first"
