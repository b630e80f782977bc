"""Suggestions for names that do not exist.

`nearest("A-01", ["A1", "B1"])` is `A1`, and `nearest("RTU-9", ["RTU-1", "RTU-2"])` is empty.
"""

from __future__ import annotations

import difflib
import re
from collections.abc import Collection, Iterable
from itertools import accumulate, islice
from pathlib import Path

_MOST_LISTED = 2_000
_MOST_COMPARED = 50_000
"""Pairs of letters that are compared for one name: a table may have thousands of wrong ones."""

# A1, a-01 and "A 1" are treated as one name.
_IGNORED = re.compile(r"[\s_-]|(?<!\d)0+(?=\d)")
_LOCKS = ("~$", ".~lock.")  # of workbooks that a program has open


def nearest(value: str, names: Iterable[str], taken: Collection[str] = ()) -> str:
    """Return the name equal to a value except for case, blanks, hyphens and leading zeros.

    Otherwise the closest spelling; among very many or long names, only those with the same
    beginning are compared. Of several equally close names, the one not yet used; empty if there is
    none or more than one.
    """
    key, plain = _plain(value), {name: _plain(name) for name in names}
    close = [name for name, plain_name in plain.items() if plain_name == key]
    if not close:
        # False sorts before True: names that begin with the same two characters come first, so the
        # limit on comparisons drops the others.
        alike = sorted(plain, key=lambda name: plain[name][:2] != key[:2])
        costs = accumulate(len(key) * len(name) for name in alike)
        near = [name for name, cost in zip(alike, costs, strict=True) if cost <= _MOST_COMPARED]
        # All matches, not the default of three: if several are equally close, none is suggested.
        matches = difflib.get_close_matches(key, {plain[name] for name in near}, n=_MOST_LISTED)
        ratios = {
            plain_name: difflib.SequenceMatcher(None, plain_name, key).ratio()
            for plain_name in matches
        }
        best = max(ratios.values(), default=0.0)
        close = [name for name in near if ratios.get(plain[name]) == best]
    candidates = [name for name in close if name not in taken] or close
    return candidates[0] if len(candidates) == 1 else ""


def _plain(name: str) -> str:
    return _IGNORED.sub("", name.casefold())


def meant(path: Path) -> str:
    """Suggest an existing path close to one that does not exist; empty if there is none.

    The first missing part of the path is compared with the contents of its folder.
    """
    try:
        # The list runs from the file up to the root, so the last missing entry is the first missing
        # part of the path.
        lost = [entry for entry in (path, *path.parents) if not entry.exists()][-1]
        names = [entry.name for entry in islice(lost.parent.iterdir(), _MOST_LISTED)]
        near = nearest(lost.name, [name for name in names if not name.startswith(_LOCKS)])
    except (OSError, IndexError):
        return ""
    path_meant = lost.parent / near / path.relative_to(lost)
    return (
        f"did you mean '{path_meant if path_meant.exists() else lost.parent / near}'?"
        if near
        else ""
    )
