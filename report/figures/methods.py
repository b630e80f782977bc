"""How each method is drawn, the same in the package and in the verification manual.

Marker and line style tell methods apart in black and white; colour only helps.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from report.figures.base import ACCENT, GREY, INK


@dataclass(frozen=True, slots=True)
class Look:
    """Label in a legend, marker, line style, colour, and whether the marker is filled."""

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

LOOKS: Mapping[str, Look] = {
    "exact": Look("exact", "*", "none", INK, True),
    "paper": Look("paper's, constant acceleration", "o", "-", ACCENT, False),
    "linear": Look("linear acceleration", "s", _DASHED, INK, False),
    "adaptive": Look("paper's, small steps in slip", "^", _DASHDOT, ACCENT, True),
    "penalty-explicit": Look("link, explicit", "v", _DOTTED, INK, True),
    "penalty-implicit": Look("link, implicit", "D", _LONG, GREY, True),
    "regularised": Look("regularised friction", "X", _DASHED, GREY, True),
    "frozen-normal": Look("normal force frozen", "P", "none", GREY, True),
}
"""By the name of the method."""
