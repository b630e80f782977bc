"""What names of layers say is drawn, and lines of text such as `RTU-1, height 42 in` of objects.

Proposes and decides nothing: a proposal counts when it is taken (`report.cli.plan`).
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterable
from fractions import Fraction
from typing import NamedTuple

from report.drawing.roof_drawing import RoofDrawing
from report.sheet.reading.typed_text import plain_marks
from report.sheet.schema.choices import LayerKind
from report.text.units import LENGTHS

_PATTERNS: tuple[tuple[re.Pattern[str], LayerKind], ...] = (
    (re.compile(r"-(ANNO|DIMS|IDEN|NPLT|PATT|TTLB)(-|$)"), LayerKind.NOT_READ),
    (re.compile(r"^PVC(SETBACK|INSTALLATIONAREA|SHADOW|WINDZONES)$"), LayerKind.NOT_READ),
    (
        re.compile(
            r"^(A-)?ROOF(-(OTLN|OUTLINE|BOUNDARY|PERIMETER))?(-[A-Z])?$|^PVCROOF$|^BUILDING-(OUTLINE|FOOTPRINT)$"
        ),
        LayerKind.ROOF,
    ),
    (re.compile(r"PARAPET"), LayerKind.EDGE_WITH_PARAPET),
    (
        re.compile(
            r"-SOLR(-|$)|(^|-)(PV|SOLAR)-?(MODULE|PANEL|ARRAY)S?(-|$)|^PVCLAYOUT$"
            r"|^(PV|SOLAR)?-?(MODULES?|PANELS?|ARRAYS)$|^(PV|SOLAR)$"
        ),
        LayerKind.ARRAY,
    ),
    (
        re.compile(
            r"-EQPM(-|$)|^PVCOBSTRUCTION$|(^|-)(OBSTRUCTION|OBSTACLE|RTU|SKYLIGHT|VENT|CHIMNEY)S?(-|$)"
            r"|(^|-)(HVAC|HATCH(ES)?|KEEP-?OUTS?|EQUIPMENT|MECH-EQUIP|EXHAUST-FANS?)$"
            r"|^(MECH(ANICAL)?|ROOFTOP|HVAC|AC)-UNITS?$"
        ),
        LayerKind.FIXED,
    ),
)
"""Names, in capitals with hyphens for blanks and underscores, and what they mean; the first that
fits counts.

The fields ANNO, DIMS, IDEN, NPLT, PATT, TTLB (annotation), ROOF, OTLN (outline), EQPM (equipment)
and their order are of the AIA CAD Layer Guidelines (U.S. National CAD Standard), the one letter at
the end is its status. The names with `pvc` are those of PVCAD (PVComplete, help article "Layer
Names"). SOLR, PV and the other words are taken by what they mean: no public list was found that has
them, nor one of the layers that HelioScope, Aurora and PVcase export.
"""


def proposed(layer: str) -> LayerKind | None:
    """Return what is likely drawn on a layer; None where its name does not say."""
    # A reference that is bound to the drawing has its name before that of the layer.
    name = re.sub(r"[ _-]+", "-", re.split(r"[|$]", layer)[-1].upper())
    return next((kind for pattern, kind in _PATTERNS if pattern.search(name)), None)


def drawn_on(drawing: RoofDrawing, layer: str) -> str:
    """Return what is drawn on a layer, such as `3 LWPOLYLINE, 2 TEXT`."""
    counts = sorted((of, count) for (at, of), count in drawing.counts.items() if at == layer)
    return ", ".join(f"{count} {of}" for of, count in counts)


_NUMBER, _SHARE = r"\d{1,6}(?:\.\d{1,6})?", r"\d{1,2}/[1-9]\d?"
_KEYWORD = re.compile(r"\b(?:(HT|HGT|HEIGHT|ELEV)(?: OF)?[.:= ]*|(H) ?[=:] ?)(?=\d)", re.IGNORECASE)
_DIGITS = r"\d(?:[\d .'/-]|,(?=\d)){0,16}?"
# As sizes of equipment are written: a number with its unit before a lone H.
_BEFORE = re.compile(
    rf"(?<![\w./'\"-])(?P<value>(?:{_DIGITS}(?:ft|feet)\.?[ -]{{0,3}})?"
    rf"{_DIGITS}(?:['\"]|(?:ft|feet|inches|inch|in|mm|cm|m)\.?))"
    r"[ -]?(?:H|HT|HIGH|TALL)\b(?![.:= ]*\d)",
    re.IGNORECASE,
)
_OTHER_SIZES = re.compile(r"(?:[\d.'\"/-]{1,12}+ ?+[WLD]?+ ?+[x×] ?+){1,3}+$", re.IGNORECASE)
_METRIC = re.compile(r"(?<![\w.,'\"/-])(\d{1,6}),(\d{1,2})(?= ?(?:mm|cm|m)\b)", re.IGNORECASE)
_VALUE = re.compile(
    rf"(?:(?P<feet>{_NUMBER})(?: (?P<of_foot>{_SHARE}))?[ -]?(?:'|(?:ft|feet)\b\.?)[ -]{{0,3}})?"
    rf"(?:(?P<number>{_NUMBER})(?:[ -](?P<share>{_SHARE}))?"
    r"(?:[ -]?(?P<unit>\"|(?:inches|inch|in|mm|cm|m)(?![a-z]))\.?)?)?"
    # Nothing of the number is left: neither `42x60` nor `42-48` is a height of 42.
    r"(?![\w./'\"]|,\d|\s{0,3}[-/]\s{0,3}\d)",
    re.IGNORECASE,
)
_UNITS = LENGTHS | dict.fromkeys(('"', "inch", "inches"), LENGTHS["in"])


class Height(NamedTuple):
    """A height [m] as written, NaN if that is not understood: by which word, with a unit or not."""

    value_m: float
    word: str
    has_unit: bool


def read_line(text: str, unit_m: float) -> tuple[str, Height | None]:
    """Return the name and the height in a line, whose height without a unit is in `unit_m` [m]."""
    text = _METRIC.sub(r"\1.\2", plain_marks(text))
    word = _KEYWORD.search(text)
    if word:
        match, start, said = _VALUE.match(text, word.end()), word.start(), word[1] or word[2]
    elif before := _BEFORE.search(text):
        match, start, said = _VALUE.fullmatch(before["value"]), before.start(), "H"
    else:
        return text, None
    name = _OTHER_SIZES.sub("", text[:start]).strip(" ,;:-(@")
    unclear = Height(math.nan, said.upper(), False)
    if not match or not match[0]:
        return name, unclear
    unit = match["unit"] or ('"' if match["feet"] else "")
    if word and not unit and text[match.end() :].lstrip()[:1].isalnum():
        return name, unclear  # such as `42 yd` or `42 1/0`
    value, feet = (
        float(match[number] or 0.0) + float(Fraction(match[share] or 0))
        for number, share in (("number", "share"), ("feet", "of_foot"))
    )
    value_m = value * _UNITS.get(unit.lower(), unit_m) + feet * _UNITS["ft"]
    return name, Height(value_m, said.upper(), bool(unit))


def first_height(lines: Iterable[str], unit_m: float) -> tuple[Height | None, str]:
    """Return the first height in lines that is understood; else the first line that is not."""
    unclear = ""
    for line in lines:
        height = read_line(line, unit_m)[1]
        if height and math.isfinite(height.value_m):
            return height, ""
        unclear = unclear or (line if height else "")
    return None, unclear
