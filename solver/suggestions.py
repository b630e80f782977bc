"""Names that refer to something that is not there, and what may have been meant."""

from __future__ import annotations

import difflib
import re
from collections.abc import Collection, Iterable
from itertools import accumulate, islice
from pathlib import Path

_MOST_LISTED = 2_000
_MOST_COMPARED = 50_000
"""Pairs of letters that are compared for one name: a table may have thousands of wrong ones."""

_IGNORED = re.compile(r"[\s_-]|(?<!\d)0+(?=\d)")
_LOCKS = ("~$", ".~lock.")  # of workbooks that a program has open


def nearest(value: str, names: Iterable[str], taken: Collection[str] = ()) -> str:
    """Return the name that is spelled as a value but for case, blanks, hyphens and leading zeros.

    Else the one that is spelled nearly so; of very many or long names, those that begin alike are
    compared. Of several as near it is the one that is not taken; empty for none, and for several.
    """
    wanted, plain = _plain(value), {name: _plain(name) for name in names}
    close = [name for name, each in plain.items() if each == wanted]
    if not close:
        alike = sorted(plain, key=lambda name: plain[name][:2] != wanted[:2])
        costs = accumulate(len(wanted) * len(name) for name in alike)
        near = [name for name, cost in zip(alike, costs, strict=True) if cost <= _MOST_COMPARED]
        matches = difflib.get_close_matches(wanted, {plain[name] for name in near}, n=_MOST_LISTED)
        ratios = {each: difflib.SequenceMatcher(None, each, wanted).ratio() for each in matches}
        best = max(ratios.values(), default=0.0)
        close = [name for name in near if ratios.get(plain[name]) == best]
    left = [name for name in close if name not in taken] or close
    return left[0] if len(left) == 1 else ""


def _plain(name: str) -> str:
    return _IGNORED.sub("", name.casefold())


def meant(path: Path) -> str:
    """Ask for the path that nearly fits one that does not exist; empty for none.

    Of its parts the first that is not there is compared with what is in its folder.
    """
    try:
        lost = [each for each in (path, *path.parents) if not each.exists()][-1]
        there = [each.name for each in islice(lost.parent.iterdir(), _MOST_LISTED)]
        near = nearest(lost.name, [name for name in there if not name.startswith(_LOCKS)])
    except (OSError, IndexError):
        return ""
    whole = lost.parent / near / path.relative_to(lost)
    return f"did you mean '{whole if whole.exists() else lost.parent / near}'?" if near else ""
