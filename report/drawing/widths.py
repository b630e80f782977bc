"""How wide texts are in the font of the pictures.

Draws nothing: of the plotting library it loads the reader of fonts alone, when it first measures.
"""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING

from report.typeset.pdf import TEMPLATES

if TYPE_CHECKING:
    from matplotlib.ft2font import FT2Font

TYPE_PT = 9.0  # the renderer clips letters of 8.5 pt
_FINER = 16.0  # than a point: widths are rounded to pixels


@cache
def width_in(text: str, *, is_bold: bool = False) -> float:
    """Return the width of a text [in] at `TYPE_PT`."""
    font = _font("Semibold" if is_bold else "Regular")
    font.set_text(text, 0.0)
    wide: float = font.get_width_height()[0] / 64.0
    return wide / _FINER / 72.0


@cache
def _font(weight: str) -> FT2Font:
    from matplotlib.ft2font import FT2Font

    font = FT2Font(TEMPLATES / "fonts" / f"SourceSans3-{weight}.ttf")
    font.set_size(TYPE_PT, 72.0 * _FINER)
    return font


def tick_text(name: str) -> str:
    """Return a name truncated to the width of a tick label."""
    return name if len(name) <= 14 else f"{name[:13]}…"
