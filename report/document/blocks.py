"""Blocks of a document: pictures, lines of a calculation, numbered parts.

Templates print these. Owns no content.
"""

from __future__ import annotations

from dataclasses import dataclass, field

from markupsafe import Markup

from report.typeset.equations import data_uri

SHORT_LETTERS = 64
"""Length of numbers that fit beside an equation."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Picture:
    """A figure: SVG, caption and alternative text."""

    svg: str
    caption: str
    alt: str

    @property
    def src(self) -> str:
        """Its `data:` address."""
        return data_uri(self.svg)


@dataclass(frozen=True, slots=True, kw_only=True)
class Line:
    """A step of the calculation: equation, source, substituted numbers with results."""

    latex: str
    reference: str
    steps: tuple[tuple[str, str], ...] = ()
    note: str = ""

    @property
    def is_long(self) -> bool:
        """Whether its numbers are too long to stand beside the equation."""
        texts = (f"{Markup(left).striptags()} = {right}" for left, right in self.steps)
        return any(len(text) > SHORT_LETTERS for text in texts)


@dataclass(frozen=True, slots=True, kw_only=True)
class Part:
    """A numbered part of the package; `parts` are those below it."""

    id: str
    number: str
    title: str
    parts: tuple[Part, ...] = field(default=())

    @property
    def set(self) -> str:
        """Style of the list of its parts in the table of contents."""
        return "many" if len(self.parts) > 6 else "few"
