"""The steps of making a package, as a terminal or the browser page shows them."""

from __future__ import annotations

from dataclasses import dataclass

STEPS = (0.03, 0.2, 0.18, 0.58, 0.01)
"""Usual shares of the time of the steps that `make` reports, as for `projects/example`."""


@dataclass(frozen=True, slots=True)
class Step:
    """A step of `make`, with a hint for a terminal."""

    doing: str
    hint: str = ""

    def __str__(self) -> str:
        return f"{self.doing} ({self.hint})" if self.hint else self.doing
