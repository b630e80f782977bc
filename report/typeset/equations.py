"""Equations as pictures, and the markup of symbols and fractions in text.

Knows no values of a project: the templates add the numbers.
"""

from __future__ import annotations

import base64
import re
import warnings
from dataclasses import dataclass
from functools import cache

from markupsafe import Markup, escape

from solver.model import DefectError

SIZE_PT = 11.0
WIDE_PT = 175.0  # of a page 482 pt wide
_SIZE = re.compile(r'<svg [^>]*?width="([\d.]+)" height="([\d.]+)" viewBox="([-\d. ]+)"')
_PATH = re.compile(r'<path d="([^"]+)"')
_BAR = re.compile(r"<rect [^>]+>")


@dataclass(frozen=True, slots=True, kw_only=True)
class FormulaPicture:
    """A formula as a picture: width and height [pt]."""

    svg: str
    width_pt: float
    height_pt: float
    latex: str

    @property
    def src(self) -> str:
        """Its `data:` address."""
        return data_uri(self.svg)

    @property
    def size(self) -> str:
        """Its size on the page, as a style."""
        return f"width: {self.width_pt:.2f}pt; height: {self.height_pt:.2f}pt"

    @property
    def is_wide(self) -> bool:
        """Whether it leaves no room for its numbers beside it."""
        return self.width_pt > WIDE_PT


def data_uri(svg: str) -> str:
    """Return the `data:` address of an SVG."""
    return "data:image/svg+xml;base64," + base64.b64encode(svg.encode()).decode()


class Equations(dict[str, FormulaPicture]):
    """Equations by their LaTeX, typeset as they are asked for."""

    def __missing__(self, latex: str) -> FormulaPicture:
        self[latex] = formula(latex)
        return self[latex]


@cache
def formula(latex: str) -> FormulaPicture:
    """Return a LaTeX formula as a picture."""
    svg = _typeset(latex)
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
        latex=latex,
    )


def _typeset(latex: str) -> str:
    with warnings.catch_warnings():
        # On import, ziamath loads its font through a deprecated Python interface.
        warnings.simplefilter("ignore", DeprecationWarning)
        from ziamath.config import config
        from ziamath.zmath import Latex
    config.svg2 = False  # inline outlines: reused symbols cost the page much more
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
