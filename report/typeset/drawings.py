"""SVG pictures converted to PDF operators before the pages that show them are painted.

The conversion of a picture does not depend on its page, so that another process does it during
layout: the report of the example takes 1.17 times as long without. It stands on undocumented parts
of the renderer; `pdf` asks for it only if they are tried. Read `convert`, then `DeferredPicture`.
"""

from __future__ import annotations

import atexit
import base64
import re
from collections.abc import Iterable, Mapping
from concurrent.futures import Future
from dataclasses import dataclass
from functools import cache, cached_property
from math import inf
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

from report.memoized import memoized
from report.typeset.renderer import load, shipped
from solver.model import DefectError

_HEAD = "data:image/svg+xml;base64,"
_SIZE = re.compile(rb'<svg [^>]*?width="([^"]+)" height="([^"]+)"')
_FACES = re.compile(r"@font-face \{.*?\}", re.DOTALL)
_SIMPLE = {"ca", "CA"}
"""Opacity: the only graphics states that a converted picture may have."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Face:
    """A font as a picture uses it: name in the PDF, look, and its glyphs by number."""

    hash: str
    family: str
    is_italic: bool
    weight: int
    texts: Mapping[int, str]
    widths: Mapping[int, int]


@dataclass(frozen=True, slots=True, kw_only=True)
class Drawing:
    """Operators in order, with groups and hatches between them, and the opacities they name."""

    parts: tuple[bytes | Drawing | Hatch, ...]
    opacities: Mapping[str, Mapping[str, float]]
    box: tuple[float, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class Hatch:
    """A tile that fills, or strokes, what is drawn next.

    Attributes
    ----------
    step : tuple of float
        From tile to tile, across and down.
    matrix : tuple of float
        From the tile to the picture, its first two columns by rows.
    """

    tile: Drawing
    step: tuple[float, float]
    matrix: tuple[float, ...]
    strokes: bool


@dataclass(frozen=True, slots=True, kw_only=True)
class Converted:
    """A picture at its own size [px], as operators and fonts."""

    width: float
    height: float
    drawing: Drawing
    faces: tuple[Face, ...]


def convert(sources: Iterable[str], css: Path) -> dict[str, Converted]:
    """Return pictures as PDF operators, by their `data:` address.

    Parameters
    ----------
    css : Path
        Styles with the fonts (`@font-face`), the same as those of the pages.

    Raises
    ------
    DefectError
        If a picture has shadings, masks or images.
    """
    load()
    return {source: _converted(source, css) for source in dict.fromkeys(sources)}


@cache
def fonts_of(css: Path) -> Any:
    """Return the fonts of a style sheet, loaded for the renderer; they live as long as the process.

    Reads nothing else of the styles: a whole sheet takes longer than most pictures.
    """
    from weasyprint import CSS
    from weasyprint.text.fonts import FontConfiguration

    fonts = FontConfiguration()
    faces = "\n".join(_FACES.findall(css.read_text(encoding="utf-8")))
    CSS(string=faces, font_config=fonts, url_fetcher=shipped(css.parent))
    # Held until modules are gone, they could not remove their files.
    atexit.register(fonts_of.cache_clear)
    return fonts


@memoized
def _converted(source: str, css: Path) -> Converted:
    svg = svg_of(source)
    width, height = size_px(svg)
    stream = _recorder()(
        {}, (0.0, 0.0, width, height), no_resources(), {}, None, {}, None, compress=False
    )
    draw(svg, source, fonts_of(css), stream, width, height)
    faces = tuple(
        Face(
            hash=font.hash,
            family=font.family,
            is_italic=bool(font.style),
            weight=font.weight,
            texts=dict(font.to_unicode),
            widths=dict(font.widths),
        )
        for font in stream._fonts.values()
    )
    return Converted(width=width, height=height, drawing=_recorded(stream, ()), faces=faces)


def svg_of(source: str) -> bytes:
    """Return the picture that an address holds."""
    if not source.startswith(_HEAD):
        raise DefectError(f"not the address of an SVG picture: {source[:40]}")
    return base64.b64decode(source.removeprefix(_HEAD))


def size_px(svg: bytes) -> tuple[float, float]:
    """Return the width and height that a picture states."""
    from weasyprint.svg.utils import size

    found = _SIZE.search(svg)
    if found is None:
        raise DefectError("a picture without width and height")
    width, height = (size(text.decode()) for text in found.groups())
    return width, height


def draw(svg: bytes, source: str, fonts: Any, stream: Any, width: float, height: float) -> None:
    """Draw a picture as the renderer does."""
    from weasyprint.svg import SVG

    picture = SVG(ElementTree.fromstring(svg), source, fonts, None)
    picture.draw(stream, width, height, source, None)


def no_resources() -> Any:
    """Return the resources of a stream before anything is drawn."""
    import pydyf

    kinds = ("ExtGState", "XObject", "Pattern", "Shading", "ColorSpace")
    return pydyf.Dictionary({kind: pydyf.Dictionary() for kind in kinds})


@cache
def _recorder() -> Any:
    """Return the class of a stream that keeps groups where they are drawn; loads the renderer."""
    from weasyprint.pdf.stream import Stream

    class Recorder(Stream):  # type: ignore[misc]
        """Keeps groups and hatches themselves in place of operators that name them on a page."""

        def clone(self, **changes: Any) -> Recorder:
            """Return an empty stream for a group."""
            given = {
                "fonts": self._fonts,
                "page_rectangle": self.page_rectangle,
                "resources": self._resources,
                "images": self._images,
                "tags": self._tags,
                "color_profiles": self._color_profiles,
                "output_intent": self._output_intent,
                "compress": self.compress,
            }
            return Recorder(**(given | changes))

        def draw_x_object(self, reference: str) -> None:
            """Draw a group."""
            self.stream.append(self._resources["XObject"][reference])

        def set_color_special(self, name: str | None, stroke: bool = False, *given: Any) -> None:
            """Fill or stroke with a hatch, or with a color of another space."""
            if name is None:
                super().set_color_special(name, stroke, *given)
            else:
                self.stream.append((self._resources["Pattern"][name], stroke))

    return Recorder


def _recorded(stream: Any, box: tuple[float, ...]) -> Drawing:
    """Return what was drawn on a recorder."""
    resources = stream._resources
    states = {name: dict(state) for name, state in resources["ExtGState"].items()}
    others = {key for state in states.values() for key in state.keys() - _SIMPLE}
    if stream._images or resources["Shading"] or others:
        raise DefectError("a picture with shadings, masks or images cannot be kept as operators")
    parts: list[bytes | Drawing | Hatch] = []
    operators: list[bytes] = []
    for item in stream.stream:
        if isinstance(item, bytes | str):
            operators.append(item.encode() if isinstance(item, str) else item)
            continue
        below = _hatch(*item) if isinstance(item, tuple) else _recorded(item, _box(item))
        parts += [b"\n".join(operators), below]
        operators = []
    return Drawing(parts=(*parts, b"\n".join(operators)), opacities=states, box=box)


def _box(stream: Any) -> tuple[float, ...]:
    return tuple(stream.extra["BBox"])


def _hatch(pattern: Any, strokes: bool) -> Hatch:
    about = pattern.extra
    return Hatch(
        tile=_recorded(pattern, _box(pattern)),
        step=(about["XStep"], about["YStep"]),
        matrix=tuple(about["Matrix"]),
        strokes=strokes,
    )


class DeferredPicture:
    """A picture for the renderer: its operators when the page is painted.

    Its size is that of the SVG in its address; where this only names it, it is waited for as the
    page is laid out.
    """

    def __init__(self, source: str, converted: Future[Converted], fonts: Any) -> None:
        self._source = source
        self._converted = converted
        self._fonts = fonts

    @cached_property
    def _size(self) -> tuple[float, float]:
        if (svg := svg_of(self._source)).startswith(b"<svg"):
            return size_px(svg)
        picture = self._converted.result()
        return picture.width, picture.height

    def get_intrinsic_size(self, *_: Any) -> tuple[float, float, float]:
        """Return width, height [px] and their ratio."""
        width, height = self._size
        return width, height, width / height

    def draw(self, stream: Any, width: float, height: float, *_: Any) -> None:
        """Paint the picture, at the place and scale of the stream."""
        picture = self._converted.result()
        for face in picture.faces:
            use(stream, face, self._fonts)
        stream.push_state()
        stream.transform(a=width / picture.width, d=height / picture.height)
        replay(stream, picture.drawing)
        stream.pop_state()


def replay(stream: Any, drawing: Drawing) -> None:
    """Draw again what was recorded."""
    import pydyf

    states = stream._resources["ExtGState"]
    for name, state in drawing.opacities.items():
        states.setdefault(name, pydyf.Dictionary(state))
    for part in drawing.parts:
        if isinstance(part, Drawing):
            group = stream.add_group(0, 0, 0, 0)
            group.extra["BBox"][:] = part.box
            replay(group, part)
            stream.draw_x_object(group.id)
        elif isinstance(part, Hatch):
            from weasyprint.matrix import Matrix

            matrix = Matrix(*part.matrix) @ stream.ctm
            pattern = stream.add_pattern(0, 0, 0, 0, *part.step, matrix)
            pattern.extra["BBox"][:] = part.tile.box
            replay(pattern, part.tile)
            stream.set_color_special(pattern.id, part.strokes)
        elif part:
            stream.stream.append(part)


def use(stream: Any, face: Face, fonts: Any) -> None:
    """Add the glyphs of a face to the font of the document, which is loaded if it is not yet."""
    same = (font for font in stream._fonts.values() if font.hash == face.hash)
    font = next(same, None) or _load(stream, face, fonts)
    for glyph, text in face.texts.items():
        font.to_unicode.setdefault(glyph, text)
    for glyph, width in face.widths.items():
        font.widths.setdefault(glyph, width)


def _load(stream: Any, face: Face, fonts: Any) -> Any:
    """Have the renderer load a font, by setting a letter in it."""
    from weasyprint.css.properties import INITIAL_VALUES
    from weasyprint.svg.text import Style
    from weasyprint.text.line_break import split_first_line

    style = Style(INITIAL_VALUES)
    style.font_config = fonts
    style["font_family"] = [face.family]
    style["font_style"] = "italic" if face.is_italic else "normal"
    style["font_weight"] = face.weight
    style["font_size"] = 10.0
    letter = next(text for text in face.texts.values() if text.strip())
    layout = split_first_line(letter, style, None, inf, 0)[0]
    layout.reactivate(style)
    line, _ = layout.get_first_line()
    font, _ = stream.add_font(line.runs[0].data.item.analysis.font)
    if font.hash != face.hash:
        raise DefectError(f"the font {face.family} of a picture is another one on the pages")
    return font
