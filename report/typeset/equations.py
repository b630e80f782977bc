"""Typesetting of an equation: as a picture, or its symbols and fractions as markup in text.

Knows no values of a project: the templates add the numbers.
"""

from __future__ import annotations

import base64
import re
import warnings
from typing import TypedDict

from markupsafe import Markup, escape

from solver.errors import DefectError

SIZE_PT = 11.0
# Of a page 482 pt wide: a wider formula leaves no room for its numbers beside it.
WIDE_PT = 175.0
_SIZE = re.compile(r'<svg [^>]*?width="([\d.]+)" height="([\d.]+)" viewBox="([-\d. ]+)"')
_PATH = re.compile(r'<path d="([^"]+)"')
_DECIMALS = re.compile(r"(\.\d\d)\d+")
_BAR = re.compile(r"<rect [^>]+>")


class FormulaPicture(TypedDict):
    """A formula as a picture: width and height [pt]."""

    svg: str
    width_pt: float
    height_pt: float
    is_wide: bool
    latex: str


def data_uri(svg: str) -> str:
    """Return the `data:` address of an SVG."""
    return "data:image/svg+xml;base64," + base64.b64encode(svg.encode()).decode()


def formula(latex: str) -> FormulaPicture:
    """Return a LaTeX formula as a picture."""
    # As a filter of a constant it is typeset when its template is compiled, which keeps only plain
    # types: hence a dictionary.
    # The renderer spends time on decimals that print cannot show.
    svg = _DECIMALS.sub(r"\1", _typeset(latex))
    size = _SIZE.match(svg)
    outlines = _PATH.findall(svg)
    # Fraction bars are rectangles.
    bars = ["M{0} {1}h{2}v{3}h-{2}Z".format(*_bar(bar)) for bar in _BAR.findall(svg)]
    if size is None or not outlines:
        raise DefectError(f"no outlines in the picture of {latex}")
    width, height, box = size.groups()
    return FormulaPicture(
        svg=f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" '
        f'viewBox="{box}"><path d="{" ".join([*outlines, *bars])}"/></svg>',
        width_pt=float(width),
        height_pt=float(height),
        is_wide=float(width) > WIDE_PT,
        latex=latex,
    )


def _typeset(latex: str) -> str:
    with warnings.catch_warnings():
        # On import, ziamath loads its font through a deprecated Python interface.
        warnings.simplefilter("ignore", DeprecationWarning)
        from ziamath.config import config
        from ziamath.zmath import Latex
    # Inline outlines: reused symbols cost the page much more.
    config.svg2 = False
    return str(Latex(latex, size=SIZE_PT).svg())


def _bar(tag: str) -> list[str]:
    return [re.findall(rf'\b{name}="([-\d.]+)"', tag)[0] for name in ("x", "y", "width", "height")]


def symbol(text: str) -> Markup:
    """Return a symbol with its subscript: `S_DS` is S with subscript DS."""
    stem, _, below = text.partition("_")
    subscript = Markup("<sub>{}</sub>").format(below) if below else Markup("")
    return Markup("<i>{}</i>{}").format(stem, subscript)


def fraction(above: str, below: str) -> Markup:
    """Return a fraction with numerator above denominator."""
    return Markup(
        '<span class="frac"><span class="above">{}</span><span class="below">{}</span></span>'
    ).format(escape(above), escape(below))
