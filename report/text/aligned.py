"""Tables for a terminal."""

from __future__ import annotations

from collections.abc import Iterator, Sequence


def aligned(rows: Sequence[Sequence[str]], sides: Sequence[str] = ()) -> Iterator[str]:
    """Yield rows of text as lines, each column as wide as its longest text.

    `sides` are `<` or `>` for each column; without them all are aligned to the left.
    """
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    for row in rows:
        placed = zip(row, sides or "<" * len(row), widths, strict=True)
        yield "  ".join(f"{text:{side}{width}}" for text, side, width in placed).rstrip()
