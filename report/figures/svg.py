"""A figure as the text of an SVG of plain paths and words, for pages.

matplotlib's own is full of styles, groups and symbols: laying out the pages takes a sixth longer
with it. Cuts off at rectangles alone and writes no images. Knows no chart; read
`report.figures.base` next.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any
from xml.sax.saxutils import escape

import numpy as np
from matplotlib import font_manager
from matplotlib.backend_bases import GraphicsContextBase, RendererBase
from matplotlib.colors import to_hex
from matplotlib.figure import Figure
from matplotlib.path import Path
from matplotlib.textpath import text_to_path
from matplotlib.transforms import Affine2D, BboxTransformTo, Transform
from numpy.typing import NDArray

Points = NDArray[np.float64]

_DPI = 72  # of a figure whose unit is the point
_LETTERS = {Path.MOVETO: "M", Path.LINETO: "L", Path.CURVE3: "Q", Path.CURVE4: "C"}
_CAPS = {"projecting": "square"}
_HATCH_PT = 72  # side of the square that a hatch repeats
_NEAR_PT = 0.01  # what lies outside by less is not cut off


def svg_text(figure: Figure) -> str:
    """Return a figure as the text of an SVG; the same figure gives the same text."""
    figure.set_dpi(_DPI)
    width, height = (float(v) * _DPI for v in figure.get_size_inches())
    renderer = _Renderer(width, height)
    figure.draw(renderer)
    return (
        '<svg xmlns="http://www.w3.org/2000/svg" version="1.1" '
        f'width="{width:g}pt" height="{height:g}pt" viewBox="0 0 {width:g} {height:g}" '
        f'stroke-linejoin="round">{"".join(renderer.parts)}</svg>'
    )


class _Renderer(RendererBase):
    """Writes what matplotlib draws; y runs down the page."""

    def __init__(self, width: float, height: float) -> None:
        super().__init__()
        self.parts: list[str] = []
        self._size = width, height
        self._flip = Affine2D().scale(1.0, -1.0).translate(0.0, height)
        self._defined: dict[str, str] = {}

    def get_canvas_width_height(self) -> tuple[float, float]:
        return self._size

    def get_text_width_height_descent(
        self, s: str, prop: Any, ismath: Any
    ) -> tuple[float, float, float]:
        found: tuple[float, float, float] = text_to_path.get_text_width_height_descent(
            s, prop, ismath
        )
        return found

    def draw_path(
        self,
        gc: GraphicsContextBase,
        path: Path,
        transform: Transform,
        rgbFace: Any = None,  # noqa: N803
    ) -> None:
        # Lines may be thinned where nothing of it is seen, areas not.
        simplify = path.should_simplify and rgbFace is None and gc.get_hatch() is None
        self._add_path(gc, rgbFace, *_outline(path, transform + self._flip, simplify))

    def draw_markers(
        self,
        gc: GraphicsContextBase,
        marker_path: Path,
        marker_trans: Transform,
        path: Path,
        trans: Transform,
        rgbFace: Any = None,  # noqa: N803
    ) -> None:
        """Draw all markers of a line as one path."""
        places = [at[-2:] for at, _ in path.iter_segments(trans, simplify=False) if len(at)]
        found = [
            _outline(marker_path, marker_trans + Affine2D().translate(*at) + self._flip, False)
            for at in places
        ]
        if found:
            outlines, corners = zip(*found, strict=True)
            self._add_path(gc, rgbFace, "".join(outlines), np.concatenate(corners))

    def draw_text(
        self,
        gc: GraphicsContextBase,
        x: float,
        y: float,
        s: str,
        prop: Any,
        angle: float,
        ismath: Any = False,
        mtext: Any = None,
    ) -> None:
        found = {
            "x": f"{x:.2f}",
            "y": f"{y:.2f}",
            "font-family": prop.get_family()[0],
            "font-size": f"{prop.get_size_in_points():g}",
            "fill": to_hex(gc.get_rgb()[:3]),
        }
        if prop.get_weight() != "normal":
            found["font-weight"] = str(font_manager.weight_dict[prop.get_weight()])
        if angle:
            found["transform"] = f"rotate({-angle:g} {x:.2f} {y:.2f})"
        self.parts.append(f"<text{_written(found)}>{escape(s)}</text>")

    def _add_path(self, gc: GraphicsContextBase, face: Any, outline: str, corners: Points) -> None:
        if outline:
            found = {**self._fill(gc, face), **_stroke(gc), **self._clip(gc, corners)}
            self.parts.append(f'<path d="{outline}"{_written(found)}/>')

    def _fill(self, gc: GraphicsContextBase, face: Any) -> dict[str, str]:
        if gc.get_hatch():
            return {"fill": f"url(#{self._hatch(gc, face)})"}
        if face is None:
            return {"fill": "none"}
        return {"fill": to_hex(face[:3])} | _alpha("fill", face)

    def _hatch(self, gc: GraphicsContextBase, face: Any) -> str:
        """Return the id of the pattern of a hatch."""
        side, color = _HATCH_PT, to_hex(gc.get_hatch_color())
        ground = "none" if face is None else to_hex(face[:3])
        upright = Affine2D().scale(side, -side).translate(0.0, side)
        lines, _ = _outline(gc.get_hatch_path(), upright, simplify=False)
        return self._define(
            f'<pattern id="{{}}" patternUnits="userSpaceOnUse" width="{side}" height="{side}">'
            f'<rect width="{side + 1}" height="{side + 1}" fill="{ground}"/><path d="{lines}" '
            f'fill="{color}" stroke="{color}" stroke-width="{gc.get_hatch_linewidth():g}"/>'
            "</pattern>"
        )

    def _clip(self, gc: GraphicsContextBase, corners: Points) -> dict[str, str]:
        """Return where a path is cut off, if any of its corners lies outside."""
        frame = gc.get_clip_rectangle()
        if frame is None:
            return {}
        outline, border = _outline(
            Path.unit_rectangle(), BboxTransformTo(frame) + self._flip, simplify=False
        )
        if _holds(border, corners):
            return {}
        name = self._define(f'<clipPath id="{{}}"><path d="{outline}"/></clipPath>')
        return {"clip-path": f"url(#{name})"}

    def _define(self, definition: str) -> str:
        """Return the id of a definition, written where it is first needed."""
        name = self._defined.get(definition)
        if name is None:
            name = self._defined[definition] = f"d{len(self._defined) + 1}"
            self.parts.append(f"<defs>{definition.format(name)}</defs>")
        return name


def _outline(path: Path, transform: Transform, simplify: bool) -> tuple[str, Points]:
    """Return a path as SVG writes it, and its corners, shape (n, 2)."""
    words, corners = [], []
    for found, code in path.iter_segments(transform, simplify=simplify):
        if code == Path.CLOSEPOLY:
            words.append("Z")
            continue
        corners.append(found)
        words.append(_LETTERS[code] + " ".join(f"{v:.2f}" for v in found.tolist()))
    return "".join(words), np.concatenate(corners or [np.empty(0)]).reshape(-1, 2)


def _holds(border: Points, corners: Points) -> bool:
    inside = (corners >= border.min(axis=0) - _NEAR_PT) & (corners <= border.max(axis=0) + _NEAR_PT)
    return bool(inside.all())


def _stroke(gc: GraphicsContextBase) -> dict[str, str]:
    if not gc.get_linewidth():
        return {}
    found = {
        "stroke": to_hex(gc.get_rgb()[:3]),
        "stroke-width": f"{gc.get_linewidth():g}",
        **_alpha("stroke", gc.get_rgb()),
    }
    offset, dashes = gc.get_dashes()
    if dashes is not None:
        found["stroke-dasharray"] = " ".join(f"{v:g}" for v in np.asarray(dashes).tolist())
        found["stroke-dashoffset"] = f"{offset:g}"
    if gc.get_joinstyle() != "round":
        found["stroke-linejoin"] = gc.get_joinstyle()
    if gc.get_capstyle() != "butt":
        found["stroke-linecap"] = _CAPS.get(gc.get_capstyle(), gc.get_capstyle())
    return found


def _alpha(what: str, color: Sequence[float]) -> dict[str, str]:
    alpha = color[3] if len(color) == 4 else 1.0
    return {} if alpha == 1.0 else {f"{what}-opacity": f"{alpha:g}"}


def _written(attributes: Mapping[str, str]) -> str:
    return "".join(f' {name}="{value}"' for name, value in attributes.items())
