"""Reads a roof drawing: its closed polylines with their layers and names, and what else there is.

Knows no workbook and no kinds (`report.drawing.plan_read`). Points are in the drawing's world
coordinates and unit. Hostile files are refused by size before the library loads them.
"""

from __future__ import annotations

import logging
import math
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

from report.drawing.dxf import APPLICATION
from report.sheet.schema.shapes import Point, Polygon, ring
from report.words.letters import UNPRINTABLE, trimmed
from solver.meant import meant
from solver.model import InputError

if TYPE_CHECKING:
    from ezdxf.document import Drawing as Document

MB = 1_000_000
MAX_BYTES = 25 * MB
MAX_ENTITIES = 20_000
MAX_VALUES = 1_000_000
MAX_DEPTH = 8
MAX_POINTS = 2000
MAX_COORDINATE = 1e12

SAGITTA_M = 0.003
"""Largest distance [m] of an arc from the chords that it is read as."""

UNITS: Mapping[int, str] = {1: "in", 2: "ft", 4: "mm", 5: "cm", 6: "m"}
"""Units of drawings by $INSUNITS."""

_FLAT = 1e-6
_SPLINE_FRAME = 16  # of a vertex that controls a curve and is not on it
_LINES = ("LWPOLYLINE", "POLYLINE", "CIRCLE")
_TEXTS = ("TEXT", "MTEXT", "ATTRIB")
_ENTITY = re.compile(rb"^[ \t]*0[ \t]*\r?\n[ \t]*[A-Z3_]", re.MULTILINE)


@dataclass(frozen=True, slots=True, kw_only=True)
class Drawn:
    """A closed line of a drawing.

    Attributes
    ----------
    name : str
        As `report` wrote it, or from the attributes of its block; empty if neither.
    points : tuple of Point
        A ring, not repeated, in the unit of the drawing.
    is_ours : bool
        Whether `report` wrote it.
    """

    handle: str
    layer: str
    name: str
    points: tuple[Point, ...]
    is_ours: bool


@dataclass(frozen=True, slots=True, kw_only=True)
class Words:
    """A text of a drawing, and where it is."""

    layer: str
    text: str
    at: Point


@dataclass(frozen=True, slots=True, kw_only=True)
class Unread:
    """Something of a drawing that was not understood, and why."""

    handle: str
    layer: str
    reason: str


@dataclass(frozen=True, slots=True)
class RoofDrawing:
    """What a drawing consists of; its unit is empty if it states none that is known."""

    unit: str
    lines: list[Drawn] = field(default_factory=list)
    texts: list[Words] = field(default_factory=list)
    unread: list[Unread] = field(default_factory=list)


def read_dxf(path: Path, unit_m: float | None = None) -> RoofDrawing:
    """Read a roof drawing.

    Parameters
    ----------
    unit_m : float, optional
        Size of its unit [m], where it states none: arcs become chords by it.

    Raises
    ------
    InputError
        If it is no DXF, damaged, too large, or its blocks expand to too much.
    """
    from report.words.units import LENGTHS

    _check(path)
    document = _loaded(path)
    unit = UNITS.get(document.header.get("$INSUNITS", 0), "")
    sagitta = SAGITTA_M / (unit_m or LENGTHS.get(unit, 1.0))
    drawing = RoofDrawing(unit)
    _check_blocks(document)
    for entity in document.modelspace():
        _take(entity, drawing, sagitta, "", "")
    return drawing


def _check(path: Path) -> None:
    """Refuse what is no DXF in text, and what is too large to load."""
    try:
        size = path.stat().st_size
        if size > MAX_BYTES:
            raise InputError(
                f"{size / MB:.0f} MB, more than {MAX_BYTES // MB} MB; save the roof plan alone"
            )
        data = path.read_bytes()
    except OSError as error:
        asked = f"; {found}" if (found := meant(path)) else ""
        raise InputError(f"cannot be read ({error.strerror}){asked}") from error
    if data.startswith(b"AC10"):
        raise InputError("a DWG drawing; save it as DXF (R12 to R2018)")
    if data.startswith(b"AutoCAD Binary DXF"):
        raise InputError("a binary DXF; save it as DXF in text")
    values = data.count(b"\n") // 2  # each after a line with its code
    if values > MAX_VALUES:
        raise InputError(
            f"{values:,} values, more than {MAX_VALUES:,}; save the layers of the roof plan alone"
        )
    count = sum(1 for _ in _ENTITY.finditer(data))
    if count > MAX_ENTITIES:
        raise InputError(
            f"{count:,} entities, more than {MAX_ENTITIES:,}; save the layers of the roof plan"
            " alone"
        )


def _loaded(path: Path) -> Document:
    import ezdxf

    logging.getLogger("ezdxf").addHandler(logging.NullHandler())
    try:
        return ezdxf.filemanagement.readfile(str(path))
    except Exception as error:  # a damaged drawing makes the library raise almost anything
        raise InputError(
            f"not a DXF drawing, or damaged ({type(error).__name__}: {str(error)[:100]}); open it"
            " in CAD and save it again"
        ) from error


def _check_blocks(document: Document) -> None:
    """Refuse blocks that are nested too deep, in themselves, or expand to too much."""
    sizes: dict[str, int] = {}

    def size(name: str, depth: int) -> int:
        key = name.casefold()
        if key in sizes:
            return sizes[key]
        if depth > MAX_DEPTH:
            raise InputError(f"block {name}: nested more than {MAX_DEPTH} deep; explode it")
        block = document.blocks.get(name)
        total = 0 if block is None else expanded(block, depth)
        sizes[key] = total
        return total

    def expanded(entities: Any, depth: int) -> int:
        total = 0
        for entity in entities:
            total += 1
            if entity.dxftype() == "INSERT":
                total += _count(entity) * size(entity.dxf.get("name", ""), depth + 1)
            if total > MAX_ENTITIES:
                raise InputError(
                    f"its blocks expand to more than {MAX_ENTITIES:,} entities; explode those of"
                    " the roof plan and save it alone"
                )
        return total

    expanded(document.modelspace(), 0)


def _count(insert: Any) -> int:
    """Return how many times an insert shows its block."""
    rows, columns = (max(int(insert.dxf.get(key, 1)), 1) for key in ("row_count", "column_count"))
    return rows * columns


def _take(entity: Any, drawing: RoofDrawing, sagitta: float, name: str, block: str) -> None:
    """Add an entity to the drawing; of a block, what it shows, by the handle of the block."""
    kind, layer = entity.dxftype(), _printable(entity.dxf.get("layer", "0"))
    handle = str(entity.dxf.get("handle") or block)
    try:
        if kind == "INSERT":
            reason = _take_insert(entity, drawing, sagitta, handle)
        elif kind in _TEXTS:
            reason = _take_text(entity, drawing, layer, kind)
        elif kind in _LINES:
            reason = _take_line(entity, drawing, sagitta, layer, name, handle)
        else:
            reason = f"a {kind}"
    except Exception as error:  # as `_loaded`
        reason = f"a {kind} that cannot be read ({type(error).__name__})"
    if reason:
        drawing.unread.append(Unread(handle=handle, layer=layer, reason=reason))


def _printable(text: object) -> str:
    """Return a text of the drawing without what no terminal and no page may print."""
    return trimmed(UNPRINTABLE.sub("", str(text)))


def _take_line(
    entity: Any, drawing: RoofDrawing, sagitta: float, layer: str, name: str, handle: str
) -> str:
    """Add a closed line, or return why it is none."""
    found = _ring(entity, entity.dxftype(), sagitta)
    if isinstance(found, str):
        return found
    own = _own_name(entity)
    drawing.lines.append(
        Drawn(handle=handle, layer=layer, name=own or name, points=found, is_ours=bool(own))
    )
    return ""


def _take_insert(insert: Any, drawing: RoofDrawing, sagitta: float, handle: str) -> str:
    """Add what a block shows, or return why it shows nothing."""
    if insert.block() is None:
        return f"a block '{_printable(insert.dxf.get('name', ''))}' that the drawing does not have"
    name = _attribute(insert)
    layer = insert.dxf.get("layer", "0")
    for one in insert.multi_insert() if _count(insert) > 1 else (insert,):
        for entity in one.virtual_entities():
            # Layer 0 within a block is the layer that the block is put on.
            if entity.dxf.get("layer", "0") == "0":
                entity.dxf.layer = layer
            _take(entity, drawing, sagitta, name, handle)
    return ""


def _attribute(insert: Any) -> str:
    """Return the name that the attributes of a block give: NAME, ID or TAG, or the only one."""
    found = {str(a.dxf.tag).casefold(): _printable(a.dxf.text) for a in insert.attribs}
    for tag in ("name", "id", "tag", "mark"):
        if found.get(tag):
            return found[tag]
    return next(iter(found.values())) if len(found) == 1 else ""


def _own_name(entity: Any) -> str:
    """Return the name that `report` wrote with a line."""
    if not entity.has_xdata(APPLICATION):
        return ""
    tags = entity.get_xdata(APPLICATION)
    return next((_printable(tag.value) for tag in tags if tag.code == 1000), "")


def _take_text(entity: Any, drawing: RoofDrawing, layer: str, kind: str) -> str:
    """Add a text that says something at a place; none is missed that does not."""
    text = entity.plain_text() if kind != "ATTRIB" else entity.dxf.text
    if kind == "MTEXT":
        x, y, _ = entity.dxf.insert
    else:
        x, y, _ = entity.get_placement()[1] or entity.dxf.insert
    words = " ".join(_printable(text).split())
    if words and math.isfinite(x) and math.isfinite(y):
        drawing.texts.append(Words(layer=layer, text=words, at=(float(x), float(y))))
    return ""


def _ring(entity: Any, kind: str, sagitta: float) -> tuple[Point, ...] | str:
    """Return the ring of a closed line, or why it is none."""
    if not _is_flat(entity):
        return f"a {kind} that is not parallel to the plan"
    if kind == "POLYLINE" and not (entity.is_2d_polyline or entity.is_3d_polyline):
        return "a mesh"
    if kind != "CIRCLE" and len(entity) > MAX_POINTS:
        return f"a {kind} of more than {MAX_POINTS} points"
    vertices = _vertices(entity, kind)
    is_closed = kind == "CIRCLE" or bool(entity.is_closed)
    if not all(math.isfinite(value) for vertex in vertices for value in vertex):
        return f"a {kind} with a coordinate that is not a number"
    if not all(abs(value) <= MAX_COORDINATE for vertex in vertices for value in vertex):
        return f"a {kind} with a coordinate or bulge of more than {MAX_COORDINATE:g}"
    if not vertices or not (is_closed or vertices[0][:2] == vertices[-1][:2]):
        return f"an open {kind}"
    points = list(_chords(vertices, sagitta))
    if len(points) > MAX_POINTS:
        return f"a {kind} of more than {MAX_POINTS} points"
    return ring(_without_doubles(points)) if len(points) > 2 else f"a {kind} without an area"


def _vertices(entity: Any, kind: str) -> list[tuple[float, float, float]]:
    """Return x, y and the bulge to the next vertex, in world coordinates."""
    if kind == "CIRCLE":
        (x, y, _), radius = entity.dxf.center, entity.dxf.radius
        found = [(x - radius, y, 1.0), (x + radius, y, 1.0)]
    elif kind == "LWPOLYLINE":
        found = [(x, y, bulge) for x, y, bulge in entity.get_points("xyb")]
    else:
        shown = [v for v in entity.vertices if not v.dxf.flags & _SPLINE_FRAME]
        found = [(v.dxf.location.x, v.dxf.location.y, v.dxf.bulge) for v in shown]
        if entity.is_3d_polyline:
            return found
    # The plane of the line may look down: then x and the turn of arcs are mirrored.
    way = 1.0 if entity.dxf.get("extrusion", (0.0, 0.0, 1.0))[2] > 0.0 else -1.0
    return [(way * float(x), float(y), way * float(bulge)) for x, y, bulge in found]


def _chords(vertices: list[tuple[float, float, float]], sagitta: float) -> Iterator[Point]:
    """Yield the points of a ring with its arcs as chords, up to one more than are allowed.

    A bulge is the tangent of a quarter of the angle of an arc, positive counterclockwise.
    """
    count = 0
    for (x0, y0, bulge), (x1, y1, _) in zip(vertices, (*vertices[1:], vertices[0]), strict=True):
        for share in _shares(math.dist((x0, y0), (x1, y1)), bulge, sagitta):
            count += 1
            if count > MAX_POINTS + 1:
                return
            turn = 4.0 * math.atan(bulge)
            along, aside = _on_arc(turn, share) if turn else (0.0, 0.0)
            dx, dy = x1 - x0, y1 - y0
            yield x0 + along * dx + aside * dy, y0 + along * dy - aside * dx


def _on_arc(turn: float, share: float) -> tuple[float, float]:
    """Return how far along its chord and to the right of it a point of an arc is, in chords."""
    sin, cos = math.sin(0.5 * turn), math.cos(0.5 * turn)
    rest = turn * (0.5 - share)
    return 0.5 * (1.0 - math.sin(rest) / sin), 0.5 * (math.cos(rest) - cos) / sin


def _shares(chord: float, bulge: float, sagitta: float) -> list[float]:
    """Return the shares of an arc at which its chords start; 0 alone for a line."""
    if 0.5 * abs(bulge) * chord <= sagitta:
        return [0.0]
    radius = chord * (1.0 + bulge**2) / (4.0 * abs(bulge))
    step = 4.0 * math.asin(math.sqrt(0.5 * min(sagitta / radius, 0.5)))
    count = min(math.ceil(4.0 * math.atan(abs(bulge)) / step), MAX_POINTS + 1)
    return [k / count for k in range(count)]


def _is_flat(entity: Any) -> bool:
    x, y, z = entity.dxf.get("extrusion", (0.0, 0.0, 1.0))
    return bool(abs(x) <= _FLAT and abs(y) <= _FLAT and z != 0.0)


def _without_doubles(points: list[Point]) -> list[Point]:
    """Return points without those at the place of the one before."""
    kept = points[:1]
    for point in points[1:]:
        if math.dist(point, kept[-1]) > _FLAT * max(1.0, *map(abs, point)):
            kept.append(point)
    if len(kept) > 1 and math.dist(kept[0], kept[-1]) <= _FLAT * max(1.0, *map(abs, kept[0])):
        kept.pop()
    return kept


def polygon(line: Drawn, unit_m: float) -> Polygon:
    """Return a line as a polygon [m]."""
    return Polygon(tuple((x * unit_m, y * unit_m) for x, y in line.points))
