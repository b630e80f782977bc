"""Line style of each method, the same in the package and in the verification manual.

Marker and line style distinguish the methods in black and white; color is secondary.
"""

from __future__ import annotations

from collections.abc import Mapping
from itertools import cycle
from typing import Any

from report.figures.base import ACCENT, DASHDOT, DASHED, DOTTED, GRAY, INK
from solver.rivals.methods import METHODS

_LONG = (0, (9, 2))
_STYLES = (
    ("*", "none", INK, INK),
    ("o", "-", ACCENT, "white"),
    ("s", DASHED, INK, "white"),
    ("^", DASHDOT, ACCENT, ACCENT),
    ("v", DOTTED, INK, INK),
    ("D", _LONG, GRAY, GRAY),
    ("X", DASHED, GRAY, GRAY),
    ("P", "none", GRAY, GRAY),
)
"""Marker, line style, color, and color within the marker."""


def _look(label: str, marker: str, line: object, color: str, fill: str) -> dict[str, Any]:
    return {
        "marker": marker,
        "markersize": 4.5,
        "markeredgecolor": color,
        "markerfacecolor": fill,
        "markeredgewidth": 0.9,
        "color": color,
        "linestyle": line,
        "linewidth": 1.1,
        "label": label,
    }


LOOKS: Mapping[str, dict[str, Any]] = {
    method.name: _look(method.label, *style)
    for method, style in zip(METHODS.values(), cycle(_STYLES), strict=False)
}
"""Keywords for a line with markers, by the name of the method; styles in the order of the methods.
"""
