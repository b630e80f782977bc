"""Names that refer to something that is not there, and what may have been meant."""

from __future__ import annotations

import difflib
from collections.abc import Iterable
from itertools import islice
from pathlib import Path

_MOST_LISTED = 2_000


def nearest(value: str, names: Iterable[str]) -> str:
    """Return the name that is spelled nearly as a value, ignoring case; empty for none."""
    folded = {name.casefold(): name for name in names}
    close = difflib.get_close_matches(value.casefold(), folded, n=1)
    return folded[close[0]] if close else ""


def meant(path: Path) -> str:
    """Ask for the path that nearly fits one that does not exist; empty for none.

    Of its parts the first that is not there is compared with what is in its folder.
    """
    try:
        lost = [each for each in (path, *path.parents) if not each.exists()][-1]
        near = nearest(
            lost.name, (each.name for each in islice(lost.parent.iterdir(), _MOST_LISTED))
        )
    except (OSError, IndexError):
        return ""
    whole = lost.parent / near / path.relative_to(lost)
    return f"did you mean '{whole if whole.exists() else lost.parent / near}'?" if near else ""
