"""A roof plan as an architect draws it: NCS layers, lines and arcs, blocks, 17 degrees askew."""

import math

from sketch import Sketch

ANGLE = 17.0
ROOF = ((0, 0), (200, 0), (200, 120), (120, 120), (120, 90), (0, 90))
ARRAYS = {
    "A1": ((10, 10), (90, 10), (90, 40), (10, 40)),
    "A2": ((10, 50), (90, 50), (90, 80), (10, 80)),
}
UNITS = {"RTU-1": (130, 20), "RTU-2": (160, 60)}


def at(point, degrees=ANGLE):
    """Where a point of the plan is in the drawing [ft]."""
    cos, sin = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    return point[0] * cos - point[1] * sin, point[0] * sin + point[1] * cos


def roof_plan():
    """An outline of lines, arrays of polylines, units as blocks, a tank of arcs, notes."""
    sketch = Sketch()
    space = sketch.space

    def look(layer):
        return {"layer": layer}

    for k, corner in enumerate(ROOF):
        ends = (at(corner), at(ROOF[(k + 1) % len(ROOF)]))
        space.add_line(*(ends if k % 2 else ends[::-1]), dxfattribs=look("A-ROOF-OTLN"))
    for name, points in ARRAYS.items():
        space.add_lwpolyline(map(at, points), close=True, dxfattribs=look("E-SOLR-PANL"))
        text = space.add_mtext(f"{name}\\P60 MODULES", dxfattribs=look("E-SOLR-PANL"))
        text.set_location(at((points[0][0] + 5, points[0][1] + 20)))
    block = sketch.document.blocks.new("RTU")
    block.add_lwpolyline([(0, 0), (10, 0), (10, 8), (0, 8)], close=True)
    for name, place in UNITS.items():
        turned = look("M-HVAC-EQPM") | {"rotation": ANGLE}
        put = space.add_blockref("RTU", at(place), dxfattribs=turned)
        put.add_attrib("TAG", name)
        put.add_attrib("HT", "3'-6\"" if name == "RTU-1" else "4")
    for start in (0, 180):
        space.add_arc(at((180, 100)), 6, start, start + 180, dxfattribs=look("A-ROOF-TANK"))
    space.add_text("TANK", dxfattribs=look("A-ROOF-TANK")).set_placement(at((179, 102)))
    space.add_text('ELEV 60"', dxfattribs=look("A-ROOF-TANK")).set_placement(at((179, 98)))
    cloud = map(at, ((0, -9), (9, -9), (9, -5)))
    space.add_lwpolyline(cloud, close=True, dxfattribs=look("A-ANNO-NOTE"))
    space.add_line(at((0, -20)), at((9, -20)), dxfattribs=look("A-DETL"))
    return sketch
