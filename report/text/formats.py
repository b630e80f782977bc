"""Errors, shares and times of a verification for print, and that no test validates the solution;
names for files; data for JSON and CSV; tables for a terminal.

An em dash is NaN.
"""

from __future__ import annotations

import csv
import io
import math
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any

from report.text.counts import power_of_ten
from report.text.units import number


def scientific(value: float) -> str:
    """Return `3.2 × 10⁻¹⁵`; plain 0."""
    if value != value:
        return "—"
    if value == 0.0 or math.isinf(value):
        return "0" if value == 0.0 else "∞"
    digits, exponent = f"{value:.1e}".split("e")
    return f"{digits} × {power_of_ten(int(exponent))}".replace("-", "−")


def percent(value: float) -> str:
    """Return a percentage with three digits, or as a power of ten if small."""
    if value != value:
        return "—"
    if value == 0.0:
        return "0 %"
    if abs(value) < 1e-3:
        return f"{scientific(value)} %"
    decimals = max(0, 2 - math.floor(math.log10(abs(value))))
    return f"{number(value, min(decimals, 4))} %"


def seconds(value: float) -> str:
    """Return a duration with a suitable unit."""
    if value != value:
        return "—"
    for size, unit in ((1.0, "s"), (1e-3, "ms"), (1e-6, "µs")):
        if value >= size:
            return f"{value / size:.3g} {unit}"
    return f"{value / 1e-9:.3g} ns"


def ten_digits(value: float) -> str:
    """Return a value with ten digits; `none` for NaN."""
    if value != value:
        return "none"
    if 0.0 < abs(value) < 1e-4:
        return scientific(value)
    return f"{value:.10g}".replace("-", "−")


def general(value: float) -> str:
    """Return a number with no more than six digits, as it would be typed."""
    return f"{value:g}"


def unbroken(text: str) -> str:
    """Return a text with no line break inside `μ = 0.4` and `1 g`."""
    return re.sub(r" (?=[=/])|(?<=[=/]) | (?=g\b)", "\u00a0", text)


def slug(text: str) -> str:
    """Return a text as part of a file name."""
    return re.sub(r"[^a-z0-9.]+", "-", text.lower()).strip("-")


def shortened(text: str, most: int) -> str:
    """Return a text truncated to a length, for places of fixed size."""
    text = " ".join(text.split())
    return text if len(text) <= most else text[: most - 1].rstrip() + "…"


def aligned(rows: Sequence[Sequence[str]], sides: Sequence[str] = ()) -> Iterator[str]:
    """Yield rows of text as lines, each column as wide as its longest text.

    `sides` are `<` or `>` for each column; without them all are aligned to the left.
    """
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    for row in rows:
        placed = zip(row, sides or "<" * len(row), widths, strict=True)
        yield "  ".join(f"{text:{side}{width}}" for text, side, width in placed).rstrip()


def finite(value: Any) -> Any:
    """Return data for JSON: null for every NaN or infinity."""
    # JSON has neither; Python would write NaN, which other readers refuse.
    if isinstance(value, float):
        return value if math.isfinite(value) else None
    if isinstance(value, Mapping):
        return {key: finite(item) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [finite(item) for item in value]
    return value


_NUMBER = re.compile(r"[+-]?(\d+(\.\d*)?|\.\d+)([eE][+-]?\d+)?", re.ASCII)
# Their first characters; Excel in Japanese reads the wide ones as well.
_FORMULAS = tuple("=+-@＝＋－＠")


def csv_text(rows: Iterable[Sequence[Any]]) -> str:
    """Return rows as CSV, the same on every system, with no text that a spreadsheet computes."""
    text = io.StringIO()
    # It quotes only those line ends that are its own: a bare return would begin a row.
    csv.writer(text, lineterminator="\r\n").writerows([*map(_as_text, row)] for row in rows)
    return text.getvalue().replace("\r\n", "\n")


def _as_text(value: Any) -> Any:
    """Return a field, with an apostrophe before a text that would begin a formula."""
    if not isinstance(value, str) or _NUMBER.fullmatch(value):
        return value
    is_live = value.startswith(("\t", "\r", "\n")) or value.lstrip().startswith(_FORMULAS)
    return f"'{value}" if is_live else value


NOT_VALIDATED = (
    "The sliding solution has not been validated against shake-table tests of ballasted arrays."
)

VALIDATION = (
    f"{NOT_VALIDATED} The checks of the verification manual show that the equations are solved "
    "correctly. They do not show how well friction between a ballasted array and a roof membrane "
    "follows them."
)
"""The same, with what remains unknown."""
