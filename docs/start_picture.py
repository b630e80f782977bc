"""Draws the picture on the sheet Start: a roof plan and a section with the words of the sheets.

.venv/bin/python docs/start_picture.py
"""

from __future__ import annotations

from pathlib import Path

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

PICTURE = Path(__file__).resolve().parents[1] / "report" / "project" / "write" / "start.png"
SIZE_IN = (9.6, 3.9)
DPI = 110
_INK, _GRAY, _ARRAY, _OBJECT, _ARROW = "#1F3A4D", "#7A7F85", "#CFE0EC", "#E4E2DC", "#B3261E"


def main() -> None:
    """Draw the picture, the same bytes each time."""
    figure = Figure(figsize=SIZE_IN, dpi=DPI)
    plan, section = figure.subplots(1, 2, gridspec_kw={"width_ratios": (1.45, 1.0)})
    _draw_plan(plan)
    _draw_section(section)
    for axes, title, left, right in ((plan, "Roof plan", -30, 130), (section, "Section", -8, 112)):
        axes.set_xlim(left, right)
        axes.set_ylim(-24, 84)
        axes.set_title(title, loc="left", fontsize=11, fontweight="bold", color=_INK)
        axes.set_aspect("equal", anchor="N")
        axes.axis("off")
    figure.subplots_adjust(left=0.01, right=0.99, top=0.93, bottom=0.03, wspace=0.04)
    figure.savefig(PICTURE, metadata={"Software": None})


def _box(axes: Axes, x: float, y: float, width: float, height: float, color: str) -> None:
    axes.add_patch(Rectangle((x, y), width, height, facecolor=color, edgecolor=_INK, linewidth=1.2))


def _arrow(
    axes: Axes, start: tuple[float, float], end: tuple[float, float], color: str, style: str = "-|>"
) -> None:
    arrow = {"arrowstyle": style, "color": color, "linewidth": 1.5, "shrinkA": 0, "shrinkB": 0}
    axes.annotate("", xy=end, xytext=start, arrowprops=arrow)


def _say(axes: Axes, x: float, y: float, text: str, color: str = _INK, ha: str = "left") -> None:
    axes.text(x, y, text, color=color, fontsize=9, ha=ha, va="center")


def _draw_plan(axes: Axes) -> None:
    _box(axes, 0, 0, 120, 74, "#FFFFFF")
    _box(axes, 20, 20, 52, 40, _ARRAY)
    _box(axes, 94, 28, 14, 14, _OBJECT)
    _say(axes, 24, 55, "A1")
    _say(axes, 101, 48, "RTU-1", ha="center")
    _say(axes, 60, 79, "edge with or without parapet: an object", _GRAY, "center")
    _arrow(axes, (-14, -14), (6, -14), _INK)
    _arrow(axes, (-14, -14), (-14, 2), _INK)
    _say(axes, 8, -14, "+x, 0 deg")
    _say(axes, -26, 7, "+y, 90 deg")
    for x, label in ((20, "x from"), (72, "x to")):
        axes.plot((x, x), (20, -4), color=_GRAY, linewidth=0.8, linestyle=":")
        _say(axes, x, -7, label, ha="center")
    for y, label in ((20, "y from"), (60, "y to")):
        axes.plot((20, -2), (y, y), color=_GRAY, linewidth=0.8, linestyle=":")
        _say(axes, -4, y, label, ha="right")
    _arrow(axes, (46, 42), (46, 20), _ARROW)
    _say(axes, 42, 30, "downslope\n270 deg", _ARROW, "right")
    _arrow(axes, (72, 35), (94, 35), _ARROW, "<|-|>")
    _say(axes, 83, 29, "clearance", _ARROW, "center")


def _draw_section(axes: Axes) -> None:
    _box(axes, 4, 0, 88, 40, "#FFFFFF")
    axes.plot((4, 92), (50, 40), color=_INK, linewidth=2)
    axes.plot((4, 4, 92), (40, 50, 40), color=_INK, linewidth=1.2)
    _roof_array(axes)
    axes.plot((-6, 100), (0, 0), color=_GRAY, linewidth=1.5)
    axes.plot((92, 102), (45, 45), color=_GRAY, linewidth=0.8, linestyle=":")
    _arrow(axes, (99, 0), (99, 45), _INK, "<|-|>")
    _say(axes, 101, 22, "h, z")
    _say(axes, 48, -7, "base", _GRAY, "center")
    _say(axes, 48, -15, "h: average roof height, z: height of the array", _GRAY, "center")
    _say(axes, 60, 37, "slope", ha="left")


def _roof_array(axes: Axes) -> None:
    """Draw the array on the slope, with the height of its center of gravity and its base."""
    left, right, rise = 38.0, 68.0, -10.0 / 88.0

    def roof(x: float) -> float:
        return 50.0 + rise * (x - 4.0)

    xs = (left, right, right, left, left)
    ys = (roof(left), roof(right), roof(right) + 11, roof(left) + 11, roof(left))
    axes.fill(xs, ys, facecolor=_ARRAY, edgecolor=_INK, linewidth=1.2)
    middle = (left + right) / 2
    center = roof(middle) + 6
    axes.plot(middle, center, "o", color=_ARROW, markersize=5)
    axes.plot((middle, 82), (center, center), color=_GRAY, linewidth=0.8, linestyle=":")
    _arrow(axes, (77, roof(77)), (77, center + 0.5), _ARROW, "<|-|>")
    _say(axes, 80, center + 4, "CG height", _ARROW)
    _arrow(axes, (left, roof(left) + 16), (right, roof(right) + 16), _ARROW, "<|-|>")
    _say(axes, middle, roof(middle) + 23, "b: base dimension", _ARROW, "center")
    _arrow(axes, (8, roof(8) + 5), (26, roof(26) + 5), _ARROW)
    _say(axes, 5, roof(8) + 11, "downslope", _ARROW)


if __name__ == "__main__":
    main()
