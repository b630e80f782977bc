"""Line style of each method, the same in the package and in the verification manual.

Marker and line style distinguish the methods in black and white; color is secondary.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import cycle
from typing import Any

from report.figures.base import ACCENT, GRAY, INK
from solver.rivals.methods import METHODS


@dataclass(frozen=True, slots=True)
class MethodStyle:
    """Legend label, marker, line style, color, and whether the marker is filled."""

    label: str
    marker: str
    line: Any
    color: str
    is_filled: bool

    @property
    def points(self) -> dict[str, Any]:
        """Keywords for markers."""
        return {
            "marker": self.marker,
            "markersize": 4.5,
            "markeredgecolor": self.color,
            "markerfacecolor": self.color if self.is_filled else "white",
            "markeredgewidth": 0.9,
            "color": self.color,
        }

    @property
    def all(self) -> dict[str, Any]:
        """Keywords for a line with markers."""
        return self.points | {"linestyle": self.line, "linewidth": 1.1, "label": self.label}


_DASHED, _DOTTED, _DASHDOT, _LONG = (0, (4, 1.6)), (0, (1, 1.4)), (0, (5, 1.4, 1, 1.4)), (0, (9, 2))

_STYLES = (
    ("*", "none", INK, True),
    ("o", "-", ACCENT, False),
    ("s", _DASHED, INK, False),
    ("^", _DASHDOT, ACCENT, True),
    ("v", _DOTTED, INK, True),
    ("D", _LONG, GRAY, True),
    ("X", _DASHED, GRAY, True),
    ("P", "none", GRAY, True),
)

LOOKS: Mapping[str, MethodStyle] = {
    method.name: MethodStyle(method.label, *style)
    for method, style in zip(METHODS.values(), cycle(_STYLES), strict=False)
}
"""Keyed by the name of the method, styles in the order of the methods."""
