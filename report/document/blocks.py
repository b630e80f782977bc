"""Blocks of a document: pictures, numbered parts.

Templates print these. Owns no content.
"""

from __future__ import annotations

from dataclasses import dataclass, field


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
