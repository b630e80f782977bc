"""Names that refer to something that is not there, and what may have been meant."""

from __future__ import annotations

from collections.abc import Collection

from solver.meant import nearest


def suggestion(value: str, ids: Collection[str]) -> str:
    """Return in words which id may have been meant, or which there are."""
    if close := nearest(value, ids):
        return f"did you mean '{close}'?"
    names = ", ".join(list(ids)[:8])
    return f"give one of {names}" if names else "add it there first"
