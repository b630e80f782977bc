"""The roof plan for the page: the items placed by `report.drawing.on_paper`, as SVG elements.

Placed on the widest sheet that the page has room for; the page places nothing. Reads finished
numbers; the package paints the same in `report.figures.plan_figure`.
"""

from __future__ import annotations

import math
from bisect import bisect_left
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from markupsafe import Markup, escape

from report.assessment.assessment import Assessment
from report.assessment.design.verdict import Verdict
from report.drawing.layers import Layer
from report.drawing.on_paper import plan_on_paper
from report.drawing.paper_items import TYPE_PT, Arrow, Circle, Look, Mark, Outline, Text
from report.drawing.sheet import Paper, PlanSize
from report.project.model.shapes import Point

Cell = Mapping[str, str]


def stamp(verdict: Verdict, text: str = "") -> Cell:
    """Return a verdict and its look; that on the project as a text."""
    return {"text": text or verdict, "look": verdict.name.lower()}


_TYPE_PX = 13.0  # of the page
_PX = _TYPE_PX / (TYPE_PT / 72.0)  # in an inch
_LEAST_PX, _STEP_PX, _KEY_PX = 340, 40, 52.0
_TALLER = 0.72  # than wide; the least and the most fit the first screen of a phone and of a monitor
_TALL_PX = (350.0, 540.0)
USUAL_PX = 740
"""Width of the plan on a page that has not said how wide it is."""
_CLASSES: Mapping[Look, str] = {
    Layer.OUTLINE: "roof",
    Layer.BARE_EDGE: "edge is-bare",
    Layer.DESIGN: "envelope",
    Layer.ARRAY: "array",
    Layer.OBJECT: "object",
    Layer.UNLIKE: "object is-unlike",
    Layer.PARAPET: "edge has-parapet",
    Layer.EDGE: "edge",
    Layer.CLEARANCE: "gap",
    Layer.CLEARANCE_NG: "gap",
    Mark.FAILED: "ng-area",
    Mark.LEADER: "leader",
    Mark.FRAME: "backing",
    Mark.BACKING: "backing",
    Mark.NUMBER: "number",
    Mark.NG: "ng-back",
    Mark.DARK: "dark",
    Mark.LIGHT: "light",
}
"""What begins with `ng-` is a verdict."""


def plan(
    assessment: Assessment,
    designs: Mapping[str, Cell],
    ratios: Mapping[str, float],
    room_px: int = USUAL_PX,
    *,
    has_verdicts: bool = True,
) -> Mapping[str, Any]:
    """Return the plan with its design displacements, its clearances and what is without one.

    `ratios` are the largest D/C of arrays, which shade them. Provisional values have no verdicts.
    """
    words = {name: str(cell["text"]) for name, cell in designs.items()}
    # The widest sheet that there is room for; in steps, so that it stays while a window is resized.
    steps = max(room_px - _LEAST_PX, 0) // _STEP_PX
    wide_px = _LEAST_PX + steps * _STEP_PX
    tall_px = min(max(_TALLER * wide_px, _TALL_PX[0]), _TALL_PX[1])
    wide, tall, key = wide_px / _PX, tall_px / _PX, _KEY_PX / _PX
    size = PlanSize(wide=wide, tall=tall, key_wide=wide, key_tall=key, is_screen=True)
    paper = plan_on_paper(assessment, size, words, has_verdicts=has_verdicts).paper
    return {
        "size_px": [round(paper.wide * _PX), round(paper.tall * _PX)],
        "rooms_px": [wide_px if steps else 0, wide_px + _STEP_PX],
        "drawn": Markup("".join(_elements(paper, ratios))),
    }


SHADES = (0.5, 0.75, 0.9, 1.0)
"""D/C up to which each shade goes; one more is above the last."""


def _elements(paper: Paper, ratios: Mapping[str, float]) -> Iterator[str]:
    """Yield what is on paper as elements of SVG; a key is that of a tip."""
    written = {item.words for item in paper.items if isinstance(item, Text)}
    unnamed = list[str]()  # until the plan is zoomed

    def at(point: Point) -> tuple[float, float]:
        # SVG counts down from the top, the plan up from the bottom.
        return round(point[0] * _PX, 1), round((paper.tall - point[1]) * _PX, 1)

    def path(points: Sequence[Point]) -> str:
        return "M" + "L".join(f"{x:g} {y:g}" for x, y in map(at, points))

    for item in paper.items:
        if isinstance(item, Text):
            x, y = at(item.at)
            look = ("strong" if item.is_bold else "label") + (" middle" if item.is_centered else "")
            turn = f' transform="rotate(-90 {x:g} {y:g})"' if item.is_upright else ""
            place = f'class="{"ng-box" if item.is_light else look}" x="{x:g}" y="{y:g}"{turn}'
            yield f"<text {place}>{escape(item.words)}</text>"
        elif isinstance(item, Circle):
            x, y = at(item.center)
            place = f'cx="{x:g}" cy="{y:g}" r="{round(item.radius * _PX, 1):g}"'
            key = _key(f"#{item.name}" if item.name else "")
            yield f'<circle class="{_CLASSES[item.look]}"{key} {place}/>'
        elif isinstance(item, Arrow):
            yield f'<path class="arrow" d="{path((item.tail, item.tip))}"/>'
        else:
            lines = (item.points,) if isinstance(item, Outline) else item.lines
            d = "".join(map(path, lines)) + "Z" * isinstance(item, Outline)
            look, ratio = _CLASSES[item.look], ratios.get(item.name, math.nan)
            if look == "array" and not math.isnan(ratio):
                look += f" is-shade-{bisect_left(SHADES, ratio)}"
            yield f'<path class="{look}"{_key(item.name)} d="{d}"/>'
            if item.name and item.name not in written:
                along = zip(*(at(point) for line in lines for point in line), strict=True)
                x, y = ((min(values) + max(values)) / 2 for values in along)
                name = escape(item.name)
                unnamed.append(f'<text class="small-name" x="{x:g}" y="{y:g}">{name}</text>')
    yield from unnamed


def _key(name: str) -> str:
    return f' data-key="{escape(name)}"' if name else ""
