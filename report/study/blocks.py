"""The parts of the manual, and the format of its numbers.

Contains no content: see `report.manual.sections`.
"""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from dataclasses import dataclass

from report.document.blocks import Part, Picture
from report.document.tables import Table
from report.words.letters import power_of_ten
from report.words.units import number

PASS, FAIL = "PASS", "FAIL"


@dataclass(frozen=True, slots=True, kw_only=True)
class Chart:
    """A figure of the manual with its file name."""

    name: str
    picture: Picture


@dataclass(frozen=True, slots=True, kw_only=True)
class Block:
    """A unit of layout: optional heading, texts, tables on top, charts, tables, a list."""

    title: str = ""
    texts: Sequence[str] = ()
    top: Sequence[Table] = ()
    charts: Sequence[Chart] = ()
    tables: Sequence[Table] = ()
    items: Sequence[str] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class ManualSection:
    """A numbered section of the manual."""

    id: str
    title: str
    blocks: Sequence[Block]


def numbered(sections: Sequence[ManualSection]) -> tuple[Part, ...]:
    """Return the sections as numbered parts, with their titled blocks as subsections."""
    return tuple(
        Part(
            id=section.id,
            number=str(count),
            title=section.title,
            parts=tuple(
                Part(id=f"{section.id}-{below}", number=f"{count}.{below}", title=title)
                for below, title in enumerate((b.title for b in section.blocks if b.title), start=1)
            ),
        )
        for count, section in enumerate(sections, start=1)
    )


def scientific(value: float) -> str:
    """Return `3.2 × 10⁻¹⁵`; plain 0; an em dash for NaN."""
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
    """Return a duration with a suitable unit; an em dash for NaN."""
    if value != value:
        return "—"
    for size, unit in ((1.0, "s"), (1e-3, "ms"), (1e-6, "µs")):
        if value >= size:
            return f"{value / size:.3g} {unit}"
    return f"{value / 1e-9:.3g} ns"


def digits(value: float) -> str:
    """Return a value with ten digits."""
    if value != value:
        return "none"
    if 0.0 < abs(value) < 1e-4:
        return scientific(value)
    return f"{value:.10g}".replace("-", "−")


def unbroken(text: str) -> str:
    """Return a text with no line break inside `μ = 0.4` and `1 g`."""
    return re.sub(r" (?=[=/])|(?<=[=/]) | (?=g\b)", "\u00a0", text)


def slug(text: str) -> str:
    """Return a text as part of a file name."""
    return re.sub(r"[^a-z0-9.]+", "-", text.lower()).strip("-")


def joined(names: Sequence[str]) -> str:
    """Return `a, b and c`."""
    *first, last = names
    return f"{', '.join(first)} and {last}" if first else last


def small(value: float) -> str:
    """Return two digits of a number, by powers of ten where it is small."""
    return f"{value:.2g}" if value >= 1e-3 else scientific(value)
