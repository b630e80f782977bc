"""Reads a roof drawing: its closed lines with their layers and names, and everything else.

Knows no workbook and no kinds (`report.drawing_read.plan_read`).
`report.drawing_read.dxf_file` loads it.
"""

from __future__ import annotations

import math
import re
from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import chain
from pathlib import Path
from typing import Any, NamedTuple

import shapely
from ezdxf.document import Drawing as Document
from ezdxf.xclip import XClip

from report.drawing_read.areas import (
    HATCHES,
    boundaries,
    faces,
    is_fill,
    is_mesh,
    outlines,
    polygons,
)
from report.drawing_read.closed_lines import join
from report.drawing_read.curves import CURVES, MAX_POINTS, curve
from report.drawing_read.dxf_file import DAMAGED, MAX_ENTITIES, UNITS, limit, loaded, other_unit
from report.drawing_read.dxf_texts import attributes, lines_of_text, name_by_report, printable
from report.drawing_read.roof_drawing import DrawnOutline, RoofDrawing, Unread, Words
from report.project.model.shapes import Point, Polygon, ring
from report.text.units import LENGTHS
from solver.errors import InputError

MAX_DEPTH = 8
MAX_CURVE_POINTS = 500_000
# The library's reader of texts takes a time that grows faster than their length: 200,000 stacked
# fractions kept it busy without end.
MAX_LETTERS = 500_000

SAGITTA_M = 0.003  # largest distance [m] of an arc from the chords that it is read as
JOIN_M = 0.005  # largest distance [m] between the ends of open lines that are joined

_TEXTS = ("TEXT", "MTEXT", "ATTRIB")


def read_dxf(path: Path, unit_m: float | None = None) -> RoofDrawing:
    """Read a roof drawing; arcs become chords by the size of its unit [m] where it states none.

    Raises `InputError` if it is not a DXF, damaged, too large, or its blocks expand to too much.
    """
    document, repairs = loaded(path)
    try:
        return _read(document, repairs, unit_m)
    except InputError:
        raise
    except Exception as error:  # a damaged drawing makes the library raise almost anything
        raise InputError(DAMAGED) from error


def _read(document: Document, repairs: str, unit_m: float | None) -> RoofDrawing:
    code = document.header.get("$INSUNITS", 0)
    unit = UNITS.get(code, "")
    geodata = document.modelspace().get_geodata()
    north_deg = math.nan
    # GEODATA may have (0, 0) for north, which is no direction.
    if geodata and not (north := geodata.dxf.north_direction.vec2).is_null:
        north_deg = north.angle_deg % 360.0
    # A drawing is read as it is shown: what is hidden is no part of the plan.
    hidden = {
        layer.dxf.name.casefold(): "frozen" if layer.is_frozen() else "off"
        for layer in document.layers
        if layer.is_frozen() or layer.is_off()
    }
    size_m = unit_m or LENGTHS.get(unit, 1.0)
    drawing = RoofDrawing(
        unit,
        other_unit=other_unit(code),
        repairs=repairs,
        north_deg=north_deg,
        layouts=tuple(_drawn_layouts(document, size_m, hidden)),
    )
    reader = _Reader(drawing, size_m, hidden)
    reader.take_all(document.modelspace())
    return drawing


def _check_degrees(lines: Iterable[DrawnOutline]) -> None:
    """Refuse a plan that would be smaller than 1 in any unit and lies far from its origin."""
    points = [*chain.from_iterable(line.shape.points for line in lines)]
    if not points:
        return
    (west, east), (south, north) = ((min(v), max(v)) for v in zip(*points, strict=True))
    far = max(abs(west + east), abs(south + north)) / 2.0
    # 0.5 degree is some 50 km: in any other unit a roof is larger than 0.5.
    if max(east - west, north - south) < 0.5 and 1.0 < far <= 180.0:
        raise InputError(
            f"the drawing is in degrees: {west:.5f}, {south:.5f} is a longitude and latitude;"
            " export it in ft or m, such as in State Plane or UTM coordinates"
        )


def _drawn_layouts(document: Document, unit_m: float, hidden: Mapping[str, str]) -> Iterator[str]:
    """Yield the layouts that have closed lines, as far as the limits of a drawing go."""
    drawing = RoofDrawing("")
    # A reader of its own: lines in a layout are counted and never taken.
    reader = _Reader(drawing, unit_m, hidden)
    for name in document.layouts.names_in_taborder():
        before = len(drawing.lines)
        try:
            if name != "Model":
                reader.take_all(document.paperspace(name))
        # What lies in layouts is only a hint where model space is empty: too much of it is no
        # error.
        except InputError:
            return
        # That of `report` has a title block alone.
        if not all(line.is_ours for line in drawing.lines[before:]):
            yield printable(name)


def _check_expanded(count: int) -> None:
    """Reject a drawing with too many entities, or blocks, which may be empty."""
    if count > MAX_ENTITIES:
        raise InputError(
            f"its blocks expand to more than {MAX_ENTITIES:,} entities; explode those of"
            " the roof plan and save only these"
        )


_Clip = tuple[list[Point], bool]


class _Block(NamedTuple):
    """The block that an entity is shown by: which one of all, in how many, and what it says."""

    number: int = 0
    depth: int = 0
    handle: str = ""
    name: str = ""
    heights: tuple[str, ...] = ()


@dataclass(slots=True)
class _Reader:
    """The drawing as far as it is read, and its open lines, which are joined at the end."""

    drawing: RoofDrawing
    unit_m: float
    hidden: Mapping[str, str]  # layers that are not shown, and why
    # by their blocks and layers
    opened: dict[tuple[int, str], list[DrawnOutline]] = field(
        default_factory=lambda: defaultdict(list)
    )
    # by their blocks and layers, and of each mesh and hatch by itself
    areas: dict[tuple[int, str, str], tuple[DrawnOutline, str, list[Any]]] = field(
        default_factory=dict
    )
    entities: int = 0
    blocks: int = 0
    points: int = 0
    letters: int = 0

    def take_all(self, space: Iterable[Any]) -> None:
        """Add all of model space, or of a layout."""
        for entity in space:
            self.take(entity, _Block())
        # Before lines are joined: in degrees, the ends of all of them would be near each other.
        _check_degrees(chain(self.drawing.lines, *self.opened.values()))
        self._take_joined()

    def take(self, entity: Any, block: _Block) -> None:
        """Add an entity to the drawing; of a block, what it shows, by the handle of the block."""
        self.entities += 1
        _check_expanded(self.entities)
        kind, layer = entity.dxftype(), printable(entity.dxf.get("layer", "0"))
        handle = str(entity.dxf.get("handle") or block.handle)
        if kind != "INSERT":
            self.drawing.counts[layer, kind] += 1
        hidden = self.hidden.get(layer.casefold(), "")
        try:
            if entity.dxf.get("invisible", 0):
                reason = "invisible"
            # What a block has on layers of its own is shown where that of the block is off.
            elif hidden and not (kind == "INSERT" and hidden == "off"):
                reason = (
                    "on a layer that is turned off" if hidden == "off" else f"on a {hidden} layer"
                )
            elif kind == "INSERT":
                reason = self._take_insert(entity, layer, handle, block)
            elif kind in _TEXTS:
                reason = self._take_text(entity, layer, kind)
            elif kind in HATCHES or is_mesh(entity):
                reason = self._take_area(entity, layer, handle, block)
            elif kind in CURVES:
                reason = self._take_curve(entity, layer, handle, block)
            else:
                reason = f"a {kind}"
        # A limit is of the whole drawing, and ends its reading; damage is of one entity.
        except InputError:
            raise
        except Exception as error:  # a damaged drawing makes the library raise almost anything
            reason = f"a {kind} that cannot be read ({type(error).__name__})"
        if reason:
            self._leave(handle, layer, reason)

    def _take_curve(self, entity: Any, layer: str, handle: str, block: _Block) -> str:
        """Add a closed line, or note an open one, or return why it is neither."""
        outline = curve(entity, SAGITTA_M / self.unit_m)
        if isinstance(outline, str):
            return outline
        points, is_closed = outline
        self.points += len(points)
        limit(self.points, MAX_CURVE_POINTS, "points of curves")
        own_name = name_by_report(entity)
        line = DrawnOutline(handle=handle, layer=layer, name=own_name or block.name,
                            shape=Polygon(tuple(points)), is_ours=bool(own_name),
                            heights=block.heights)  # fmt: skip
        if is_closed:
            return self._close(line, entity.dxftype())
        if len(points) > MAX_POINTS:
            return f"a {entity.dxftype()} of more than {MAX_POINTS} points"
        if points:
            self.opened[block.number, layer.casefold()].append(line)
        return "" if points else f"a {entity.dxftype()} without an area"

    def _take_area(self, entity: Any, layer: str, handle: str, block: _Block) -> str:
        """Note a hatch, or the faces of a mesh, or return why it is not one."""
        kind = entity.dxftype()
        is_hatch = kind in HATCHES
        areas = (
            boundaries(entity, SAGITTA_M / self.unit_m, JOIN_M / self.unit_m)
            if is_hatch
            else faces(entity)
        )
        if isinstance(areas, str):
            return areas
        if not areas and kind != "3DFACE":  # a vertical one is a side of the others
            return f"a {kind} without an area"
        self.points += sum(len(shapely.get_coordinates(area)) for area in areas)
        limit(self.points, MAX_CURVE_POINTS, "points of curves")
        own_name = name_by_report(entity)
        line = DrawnOutline(handle=handle, layer=layer, name=own_name or block.name,
                            shape=Polygon(()), is_ours=bool(own_name),
                            heights=block.heights)  # fmt: skip
        # Faces that are drawn one by one are those of one body where they touch.
        # Names of layers are the same in any case, as in AutoCAD.
        key = (block.number, layer.casefold(), "" if kind == "3DFACE" else str(self.entities))
        self.areas.setdefault(key, (line, kind, []))[2].extend(areas)
        return ""

    def _take_areas(self) -> None:
        """Add the outlines of hatches, faces and meshes, but for what fills closed lines."""
        if not self.areas:
            return
        lines = self.drawing.lines
        solids = [shapely.union_all(polygons([line.shape.points])) for line in lines]
        layers = [line.layer.casefold() for line in lines]
        tree, gap = shapely.STRtree(solids), JOIN_M / self.unit_m
        for line, kind, outline in self.areas.values():
            rings, has_holes = outlines(outline, gap)
            if not rings:
                self._leave(line.handle, line.layer, f"a {kind} without an area")
            for points in rings:
                area = shapely.union_all(polygons([points]))
                near = [(solids[k], layers[k]) for k in tree.query(area, predicate="intersects")]
                # A hatch over a closed line fills it: its outline would be the same array a second
                # time.
                if is_fill(area, line.layer.casefold(), near, gap):
                    self._leave(line.handle, line.layer, f"a {kind} over a closed line")
                elif reason := self._close(replace(line, shape=Polygon(tuple(points))), kind):
                    self._leave(line.handle, line.layer, reason)
            if has_holes or (kind in HATCHES and len(outline) > len(rings)):
                self._leave(line.handle, line.layer, f"holes of a {kind}, whose outline is read")
        self.areas.clear()

    def _close(self, line: DrawnOutline, kind: str) -> str:
        """Add a line as closed, or return why it is not closed."""
        points = line.shape.points
        if len(points) < 3:
            return f"a {kind} without an area"
        if len(points) > MAX_POINTS:
            return f"a {kind} of more than {MAX_POINTS} points"
        self.drawing.lines.append(replace(line, shape=Polygon(ring(points))))
        return ""

    def _take_joined(self) -> None:
        """Add the closed lines that the open ones form."""
        for lines in self.opened.values():
            closed, unclosed = join([line.shape.points for line in lines], JOIN_M / self.unit_m)
            for points, parts in closed:
                line = replace(lines[parts[0]], shape=Polygon(tuple(points)))
                if reason := self._close(line, "closed line"):
                    self._leave(line.handle, line.layer, reason)
            for k, reason in unclosed.items():
                self._leave(lines[k].handle, lines[k].layer, reason)
        self.opened.clear()
        self._take_areas()

    def _leave(self, handle: str, layer: str, reason: str) -> None:
        """Note what is not read, with details after a colon."""
        cause, _, detail = re.sub("^a (?=[AEIO])", "an ", reason).partition(": ")
        unread = Unread(handle=handle, layer=layer, reason=cause, detail=detail)
        self.drawing.unread.append(unread)

    def _take_insert(self, insert: Any, layer: str, handle: str, outer: _Block) -> str:
        """Add what a block shows, or return why; what it does not say, the one around it says."""
        depth = outer.depth + 1
        block_of, quoted_name = insert.block(), f"'{printable(insert.dxf.name)}'"
        if block_of is None:
            return f"a missing block: {quoted_name}"
        # What it refers to is another file, which is not opened: it may be anyone's.
        if block_of.block.is_xref or block_of.block.is_xref_overlay:
            return f"an external reference (bind it in CAD): {quoted_name}"
        if insert.dxf.get("zscale", 1.0) == 0.0:
            insert.dxf.zscale = 1.0  # a plan has no use of it
        if depth > MAX_DEPTH:
            raise InputError(f"block {quoted_name}: nested more than {MAX_DEPTH} deep; explode it")
        name, heights = attributes(insert)
        times = (max(int(insert.dxf.get(key, 1)), 1) for key in ("row_count", "column_count"))
        count, clip = math.prod(times), _clip(insert)
        _check_expanded(count)
        for copy in insert.multi_insert() if count > 1 else (insert,):
            self.blocks += 1
            _check_expanded(self.blocks)
            says = (name or outer.name, heights or outer.heights)
            block = _Block(self.blocks, depth, handle, *says)
            before = len(self.drawing.lines), len(self.drawing.texts)
            for entity in copy.virtual_entities():
                # Layer 0 within a block is the layer that the block is put on.
                if entity.dxf.get("layer", "0") == "0":
                    entity.dxf.layer = layer
                self.take(entity, block)
            if clip and count == 1:
                self._clip_off(before, block.number, clip)
        if clip:
            crossed = "read whole where the clip crosses a line"
            return f"a block that is clipped, and {crossed}: {quoted_name}"
        return ""

    def _clip_off(self, before: tuple[int, int], first_block: int, clip: _Clip) -> None:
        """Skip what a block and those within it have that its clip hides completely."""
        path, is_inverted = clip
        area, (first_line, first_text) = shapely.Polygon(path).buffer(0.0), before

        def is_off(shape: Any) -> bool:
            return bool(area.contains(shape) if is_inverted else not area.intersects(shape))

        def shown(lines: Sequence[DrawnOutline]) -> Iterator[DrawnOutline]:
            for line in lines:
                if is_off(shapely.LineString([*line.shape.points, line.shape.points[0]])):
                    self._leave(line.handle, line.layer, "clipped off")
                else:
                    yield line

        self.drawing.lines[first_line:] = [*shown(self.drawing.lines[first_line:])]
        texts = [t for t in self.drawing.texts[first_text:] if not is_off(shapely.Point(t.at))]
        self.drawing.texts[first_text:] = texts
        for (number, _), lines in self.opened.items():
            if number >= first_block:
                lines[:] = [*shown(lines)]
        for key, (line, _, parts) in [*self.areas.items()]:
            shown_parts = [part for part in parts if not is_off(part)]
            if key[0] >= first_block and not shown_parts:
                del self.areas[key]
                self._leave(line.handle, line.layer, "clipped off")
            elif key[0] >= first_block:
                parts[:] = shown_parts

    def _take_text(self, entity: Any, layer: str, kind: str) -> str:
        """Add a text that says something at a place; none is missed that does not."""
        self.letters += len(entity.text if kind == "MTEXT" else entity.dxf.text)
        limit(self.letters, MAX_LETTERS, "characters of text")
        placed = None if kind == "MTEXT" else entity.get_placement()[1]
        at = placed or entity.dxf.insert
        # The coordinates of a TEXT are its own, which are mirrored in a mirrored block.
        x, y, _ = at if kind == "MTEXT" else entity.ocs().to_wcs(at)
        lines = lines_of_text(entity)
        if lines and math.isfinite(x) and math.isfinite(y):
            self.drawing.texts.append(
                Words(layer=layer, text=lines[0], at=(float(x), float(y)), others=tuple(lines[1:]),
                      of=name_by_report(entity))
            )  # fmt: skip
        return ""


def _clip(insert: Any) -> _Clip | None:
    """Return the clip of a block in world coordinates, and whether it hides what is inside."""
    # One within another block is a copy, which has no clip of its own.
    clip = XClip(insert.origin_of_copy or insert)
    if not clip.is_clipping_enabled:
        return None
    path = clip.get_block_clipping_path()
    corners = insert.matrix44().transform_vertices([(p.x, p.y, 0.0) for p in path.inner_polygon()])
    return [(float(p.x), float(p.y)) for p in corners], path.is_inverted_clip
