"""Symbolic formulas as pictures, and the little markup that substituted lines are made of.

Knows no values of a project: `report.pages_method` puts numbers beside the symbols.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from functools import cache

from markupsafe import Markup, escape

SIZE_PT = 11.0
_SIZE = re.compile(r'<svg [^>]*?width="([\d.]+)" height="([\d.]+)" viewBox="([-\d. ]+)"')


@dataclass(frozen=True, slots=True, kw_only=True)
class Formula:
    """A formula as a picture: width and height [pt], depth below the baseline [pt]."""

    svg: str
    width_pt: float
    height_pt: float
    depth_pt: float
    latex: str


@cache
def formula(latex: str) -> Formula:
    """Return a LaTeX formula as a picture."""
    from ziamath import Latex

    svg: str = Latex(latex, size=SIZE_PT).svg()
    found = _SIZE.match(svg)
    if found is None:
        raise ValueError(f"no size in the picture of {latex}")
    top = float(found[3].split()[1])
    return Formula(
        svg=svg,
        width_pt=float(found[1]),
        height_pt=float(found[2]),
        depth_pt=float(found[2]) + top,
        latex=latex,
    )


def symbol(text: str) -> Markup:
    """Return a symbol with its subscript: `S_DS` reads S with a lowered DS."""
    stem, _, below = text.partition("_")
    lowered = Markup("<sub>{}</sub>").format(below) if below else Markup("")
    return Markup("<i>{}</i>{}").format(stem, lowered)


def fraction(above: str, below: str) -> Markup:
    """Return a fraction set on two lines."""
    return Markup(
        '<span class="frac"><span class="above">{}</span><span class="below">{}</span></span>'
    ).format(escape(above), escape(below))
