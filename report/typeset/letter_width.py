"""How wide a text is in the font of a package, in its type size. Read `width_em`."""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from matplotlib.ft2font import FT2Font

_PX = 144  # to an em


@cache
def width_em(text: str, *, is_bold: bool = False) -> float:
    """Return the width of a text in the font of a package, in its type size."""
    # Letter by letter, without kerning: a report of 300 arrays measures thousands of texts, and
    # laying each of them out took a fifth of its time.
    weight = "Semibold" if is_bold else "Regular"
    return sum(_advance_em(weight, letter) for letter in text)


@cache
def _advance_em(weight: str, letter: str) -> float:
    """Return how far a letter moves the next one, in the type size."""
    advance: float = _font(weight).load_char(ord(letter)).linearHoriAdvance
    return advance / 65536.0 / _PX


@cache
def _font(weight: str) -> FT2Font:
    from matplotlib.ft2font import FT2Font

    from report.typeset.pdf import TEMPLATES

    font = FT2Font(TEMPLATES / "fonts" / f"SourceSans3-{weight}.ttf")
    font.set_size(_PX, 72.0)
    return font
