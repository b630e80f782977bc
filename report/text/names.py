"""Names of arrays, objects and motions: in sentences, in lines, and as part of a file name.

    named(["A1", "A2", "A3", "A9"], "array")    arrays A1 to A3, A9

Read `ranged`.
"""

from __future__ import annotations

import re
import textwrap
from collections.abc import Iterable, Sequence


def joined(names: Sequence[str]) -> str:
    """Return `a, b and c`."""
    *first, last = names
    return f"{', '.join(first)} and {last}" if first else last


def ranged(names: Iterable[str]) -> str:
    """Return names, each once and sorted, three or more that count on as one: `A1 to A6, A9`."""
    runs: list[list[tuple[str, int, str]]] = []
    for stem, number, name in sorted(set(map(name_order, names))):
        if runs and runs[-1][-1][:2] == (stem, number - 1):
            runs[-1].append((stem, number, name))
        else:
            runs.append([(stem, number, name)])
    texts = []
    for run in runs:
        ids = [name for *_, name in run]
        texts.append(f"{ids[0]} to {ids[-1]}" if len(ids) > 2 else ", ".join(ids))
    return ", ".join(texts)


def name_order(name: str) -> tuple[str, int, str]:
    """Return what is before the number at the end of a name, the number, and the name."""
    stem = name.rstrip("0123456789")
    # Without a number -2, not -1: A and A0 do not count on.
    return stem, int(name[len(stem) :] or -2), name


def named(names: Sequence[str], noun: str) -> str:
    """Return names with their noun before them: `array A9`, `arrays A1 to A6`."""
    return f"{noun}{'' if len(names) == 1 else 's'} {ranged(names)}"


# Letters of a name on one line of a drawing or a chart.
LONGEST = 24


def name_lines(name: str, longest: int = LONGEST) -> list[str]:
    """Return the lines of a name: one, or as many as a long one needs."""
    return textwrap.wrap(name, longest)


def shortened(text: str, max_letters: int) -> str:
    """Return a text truncated to a length, for places of fixed size."""
    text = " ".join(text.split())
    return text if len(text) <= max_letters else text[: max_letters - 1].rstrip() + "…"


def slug(text: str) -> str:
    """Return a text as part of a file name."""
    return re.sub(r"[^a-z0-9.]+", "-", text.lower()).strip("-")
