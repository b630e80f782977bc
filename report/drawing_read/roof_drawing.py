"""What a roof drawing consists of, as data; its file: loaded, repaired, or refused; what names say.

`report.drawing_read.read_dxf` fills it, and `report.drawing_read.plan_read` says what of it is the
plan. A layer's name proposes what is drawn on it, which counts when it is taken
(`report.cli.plan`); lines of text such as `RTU-1, height 42 in` have names and heights.
"""

from __future__ import annotations

import cmath
import io
import logging
import math
import re
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from report.project.model.choices import LayerKind
from report.project.model.shapes import Point
from report.project.read.typed_text import plain_marks
from report.text.units import LENGTHS
from solver.files import read_file
from solver.model import InputError
from solver.suggestions import meant

if TYPE_CHECKING:
    from ezdxf.document import Drawing as Document


@dataclass(frozen=True, slots=True, kw_only=True)
class Drawn:
    """A closed line of a drawing, or the outline of modules, whose points are in m."""

    handle: str  # of the line, or of the first of those that are joined
    layer: str
    name: str  # as `report` wrote it, or from the attributes of its block; empty if neither
    points: tuple[Point, ...]  # a ring, not repeated, in the unit of the drawing
    is_ours: bool  # whether `report` wrote it
    heights: tuple[str, ...] = ()  # attributes of its block that give one, each as `HT 42`
    # of its modules, the most frequent first: their number, long side [m] and short side [m]
    sizes: tuple[tuple[int, float, float], ...] = ()
    rounded_m: float = 0.0  # step to which corners of turned modules are rounded; 0 for a fine one


@dataclass(frozen=True, slots=True, kw_only=True)
class Words:
    """A text of a drawing, or the first line of it, where it is, and its other lines."""

    layer: str
    text: str
    at: Point
    others: tuple[str, ...] = ()
    of: str = ""  # what `report` wrote it of, wherever it is; empty for none


@dataclass(frozen=True, slots=True, kw_only=True)
class Unread:
    """Something of a drawing that was not understood, why, and what of it."""

    handle: str
    layer: str
    reason: str
    detail: str = ""


@dataclass(frozen=True, slots=True)
class RoofDrawing:
    """What a drawing consists of."""

    unit: str  # empty if it states none of `UNITS`
    other_unit: str = ""  # what to say of one of `OTHER_UNITS`; empty for none
    layouts: tuple[str, ...] = ()  # that have closed lines, which no plan is read from
    repairs: str = ""  # what to say of a damaged drawing; empty for a sound one
    lines: list[Drawn] = field(default_factory=list)
    texts: list[Words] = field(default_factory=list)
    unread: list[Unread] = field(default_factory=list)
    counts: Counter[tuple[str, str]] = field(default_factory=Counter)  # by layer and kind of entity
    # By GEODATA, counterclockwise from +x; NaN for none. Not by `$NORTHDIRECTION`, "the angle
    # between the Y axis of WCS and the grid north" (AutoCAD help): its sense is not documented.
    north_deg: float = math.nan
    turned_deg: float = 0.0  # since it was read

    def turned(self, degrees: float) -> RoofDrawing:
        """Return the drawing turned counterclockwise about its origin, with its north."""
        places = turned([text.at for text in self.texts], degrees)
        return replace(
            self,
            lines=[replace(line, points=turned(line.points, degrees)) for line in self.lines],
            texts=[replace(text, at=at) for text, at in zip(self.texts, places, strict=True)],
            north_deg=(self.north_deg + degrees) % 360.0,
            turned_deg=self.turned_deg + degrees,
        )


def turned(points: Sequence[Point], degrees: float) -> tuple[Point, ...]:
    """Return points turned counterclockwise about the origin."""
    turn = cmath.rect(1.0, math.radians(degrees))
    turned_points = (complex(*point) * turn for point in points)
    return tuple((z.real, z.imag) for z in turned_points)


MB = 1_000_000
MAX_BYTES = 25 * MB
MAX_ENTITIES = 20_000
MAX_VALUES = 1_000_000
MAX_LINE = 10_000

# Units of drawings by $INSUNITS.
UNITS: Mapping[int, str] = {1: "in", 2: "ft", 4: "mm", 5: "cm", 6: "m"}
# Units that drawings state and roofs are not drawn in, and in which such a drawing mostly is.
OTHER_UNITS: Mapping[int, tuple[str, str]] = {
    3: ("miles", "ft"), 7: ("kilometers", "m"), 8: ("microinches", "in"), 9: ("mils", "in"),
    10: ("yards", "ft"), 14: ("decimeters", "m"), 15: ("decameters", "m"),
    16: ("hectometers", "m"), 21: ("US survey feet", "ft"), 22: ("US survey inches", "in"),
    23: ("US survey yards", "ft"), 24: ("US survey miles", "ft"),
}  # fmt: skip

DAMAGED = "not a DXF drawing, or damaged; open it in CAD and save it again"
# What else is given as one, by how it begins, and what would do.
_OTHER_FILES = (
    (rb"AC10", "a DWG drawing; save it as DXF (R12 to R2018)"),
    (rb"AutoCAD Binary DXF", "a binary DXF; save it as DXF in text"),
    (rb"%PDF", "a PDF; give the DXF that it was plotted from"),
    (rb"PK\x03\x04", "a zip; unpack it and give the DXF in it"),
    (
        rb"\x89PNG|\xff\xd8\xff|II\*\x00|MM\x00\*|GIF8|BM",
        "a picture; give the drawing as DXF",
    ),
    (rb"ISO-10303-21", "an IFC or STEP model; export its roof plan as DXF"),
    (rb"\xd0\xcf\x11\xe0", "a model of Revit, or an old Office file; export its roof plan as DXF"),
    (rb"(?:<[?!][^>]*>\s*){0,9}<svg", "an SVG; save it as DXF"),
    (rb"<", "XML or a web page; export the roof plan as DXF"),
    (rb"[{\[]", "JSON, such as GeoJSON; export the roof plan as DXF in ft or m"),
)
_ENDED = re.compile(rb"\n[ \t]*0[ \t]*\r?\n[ \t]*EOF\s*\Z")
_ENTITY = re.compile(rb"^[ \t]*0[ \t]*\r?\n[ \t]*[A-Z3_]", re.MULTILINE)


def other_unit(code: int) -> str:
    """Return what to say of a unit of `OTHER_UNITS`, by $INSUNITS; empty for another."""
    if code not in OTHER_UNITS:
        return ""
    stated, unit = OTHER_UNITS[code]
    is_same = stated == f"US survey {'feet' if unit == 'ft' else 'inches'}"  # within 2 in a million
    condition = "" if is_same else ", if that is what it is drawn in, or scale it in CAD"
    return f"states {stated}; give --units {unit}{condition}"


def _read(path: Path) -> bytes:
    """Return a drawing; refuse what is no DXF in text, and what is too large to load."""
    if not path.exists():
        raise InputError(f"no such file; {meant(path) or 'give a DXF drawing'}")
    data = read_file(path, MAX_BYTES, too_large="save the roof plan alone")
    begin = data[:1000].removeprefix(b"\xef\xbb\xbf").lstrip()
    for pattern, told in _OTHER_FILES:
        if re.match(pattern, begin, re.IGNORECASE):
            raise InputError(told)
    # By counting bytes: the library builds all entities before anything can be refused.
    values = data.count(b"\n") // 2  # each after a line with its code
    limit(values, MAX_VALUES, "values")
    limit(sum(1 for _ in _ENTITY.finditer(data)), MAX_ENTITIES, "entities")
    # Names are read once for each entity that has them; formats allow lines of 2,049 letters.
    limit(max(map(len, data.splitlines()), default=0), MAX_LINE, "letters in a line")
    return data


def limit(count: int, most: int, what: str) -> None:
    """Refuse more than a drawing may have."""
    if count > most:
        raise InputError(
            f"{count:,} {what}, more than {most:,}; save the layers of the roof plan alone"
        )


def _strict(data: bytes) -> Document:
    from ezdxf.filemanagement import dxf_stream_info, read

    info = dxf_stream_info(io.TextIOWrapper(io.BytesIO(data), "utf-8", "ignore"))
    return read(io.TextIOWrapper(io.BytesIO(data), info.encoding, "surrogateescape"))


def loaded(path: Path) -> tuple[Document, str]:
    """Return a drawing, and what to say of its repair if strict reading refuses it.

    Raises `InputError` if it is no DXF, damaged, or too large.
    """
    from ezdxf import recover

    data = _read(path)
    logging.getLogger("ezdxf").addHandler(logging.NullHandler())
    try:
        return _strict(data), ""
    except Exception as refused:  # a damaged drawing makes the library raise almost anything
        # What is missing at the end of a drawing that was cut off, no repair would tell.
        if not _ENDED.search(data):
            raise InputError(DAMAGED) from refused
    try:
        # Slower, and lenient: it is asked only after the strict reader.
        document, audit = recover.read(io.BytesIO(data))
    except Exception as error:
        raise InputError(DAMAGED) from error
    if audit.has_errors:  # such as a coordinate that it has guessed
        raise InputError(DAMAGED)
    count = len(audit.fixes)
    fixes = f", {count} faults repaired" if count > 1 else ", a fault repaired" if count else ""
    return document, f"a damaged drawing, read as far as it can be{fixes}: compare the plan"


# Names, in capitals with hyphens for blanks and underscores, and what they mean; the first that
# fits counts.
#
# The fields ANNO, DIMS, IDEN, NPLT, PATT, TTLB (annotation), ROOF, OTLN (outline), EQPM (equipment)
# and their order are of the AIA CAD Layer Guidelines (U.S. National CAD Standard), the one letter
# at the end is its status. The names with `pvc` are those of PVCAD (PVComplete, help article "Layer
# Names"). SOLR, PV and the other words are taken by what they mean: no public list was found that
# has them, nor one of the layers that HelioScope, Aurora and PVcase export.
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
_TOP = r"(?:TO[CPW]|TOP(?: OF(?: [A-Z]{1,12}){1,2})?|T(?:\.O\.(?:[A-Z]\.)?|/O?) ?(?:[A-Z]{1,12})?)"
_ABOUT = r"(?:\+/-|[+±~])"
_KEYWORD = re.compile(
    rf"(?<!\w)(?:(HT|HGT|HEIGHT(?: ABOVE ROOF)?|(?:{_TOP} ?)?EL(?:EV(?:ATION)?)?|{_TOP})(?: OF)?"
    rf"[.:=@ ]*(?:{_ABOUT} ?)?|([HZ]) ?[=:] ?(?:{_ABOUT} ?)?)(?=\d)"
    rf"|(?:(?<=[\s(])|^)({_ABOUT}) ?(?=\d)",
    re.IGNORECASE,
)
# What may be a height as well, before or behind a number with a unit: it is said.
_LIKE_ONE = re.compile(
    r"(?<![\w./])(?:H|H(?:EIG)?HT|HGT|T[./]O|TO[CPW]|EL|ELEV|Z|ABV|ABOVE|A\.?F\.?F)(?![a-z])",
    re.IGNORECASE,
)
_LENGTH = re.compile(r"\d ?(?:[\"']|(?:ft|feet|inch|inches|in|mm|cm|m)\b)", re.IGNORECASE)
# Heights above the roof; what other words give may be above a datum.
ABOVE_ROOF = ("H", "HT", "HGT", "HEIGHT", "HEIGHT ABOVE ROOF")
_ALSO_A_NAME = ("TOP", "TOC", "TOW", "T/", "+", "+/-", "±", "~")  # before no unit
_DIGITS = r"\d(?:[\d .'/#^-]|,(?=\d)){0,16}?"
# As sizes of equipment are written: a number with its unit before a lone H.
_BEFORE = re.compile(
    rf"(?<![\w./'\"#^-])(?P<value>(?:{_DIGITS}(?:ft|feet)\.?[ -]{{0,3}})?"
    rf"{_DIGITS}(?:['\"]|(?:ft|feet|inches|inch|in|mm|cm|m)\.?))"
    r"[ -]?\(?(?:H|HT|HIGH|TALL|ABOVE|ABV|A\.?(?:F\.?)?R)\b(?![.:= ]*\d)",
    re.IGNORECASE,
)
_OTHER_SIZES = re.compile(r"(?:[\d.'\"/-]{1,12}+ ?+[WLD]?+ ?+[x×] ?+){1,3}+$", re.IGNORECASE)
_METRIC = re.compile(r"(?<![\w.,'\"/-])(\d{1,6}),(\d{1,2})(?= ?(?:mm|cm|m)\b)", re.IGNORECASE)
_VALUE = re.compile(
    rf"(?:(?P<feet>{_NUMBER})(?: (?P<of_foot>{_SHARE}))?[ -]?(?:'|(?:ft|feet)\b\.?)[ -]{{0,3}}"
    rf"(?:(?P<of_inch>{_SHARE})[ -]?\")?)?"
    rf"(?:(?P<number>{_NUMBER})(?:[ -](?P<share>{_SHARE}))?"
    r"(?:[ -]?(?P<unit>\"|(?:inches|inch|in|mm|cm|m)(?![a-z]))\.?)?)?"
    # Nothing of the number is left: neither `42x60` nor `42-48` nor `42 1/2` is a height of 42.
    r"(?![\w./'\"#^{\\]|,\d|\s{0,3}[-/]\s{0,3}\d|\s{1,3}\d{1,2}/\d)",
    re.IGNORECASE,
)
_HEIGHT_UNITS = LENGTHS | dict.fromkeys(('"', "inch", "inches"), LENGTHS["in"])


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
        match, start = _VALUE.match(text, word.end()), word.start()
        said = word[word.lastindex or 0].strip()
    elif before := _BEFORE.search(text):
        match, start, said = _VALUE.fullmatch(before["value"]), before.start(), "H"
    else:
        is_like = _LIKE_ONE.search(text) and _LENGTH.search(text)
        return text, Height(math.nan, "", False) if is_like else None
    name = _OTHER_SIZES.sub("", text[:start]).lstrip(" ,;:-").rstrip(" ,;:-(@")
    name = name if ")" in name else name.lstrip("(")  # `(N) RTU-1` is one
    unclear = Height(math.nan, said.upper(), False)
    if not match or not match[0]:
        return name, unclear
    unit = match["unit"] or ('"' if match["feet"] else "")
    if not unit and said.upper() in _ALSO_A_NAME:
        return text, None if said[0] in "Tt" else unclear
    if word and not unit and text[match.end() :].lstrip()[:1].isalnum():
        return name, unclear  # such as `42 yd` or `42 1/0`
    value, feet = (
        float(match[number] or 0.0) + float(Fraction(match[share] or 0))
        for number, share in (("number", "share"), ("feet", "of_foot"))
    )
    value += float(Fraction(match["of_inch"] or 0))
    value_m = value * _HEIGHT_UNITS.get(unit.lower(), unit_m) + feet * _HEIGHT_UNITS["ft"]
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
