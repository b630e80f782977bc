"""Roof drawings as others make them, for the tests that read them."""

from dataclasses import dataclass

from ezdxf.filemanagement import new

from inputs import FT, INCH
from report.drawing_read.plan_read import plan_of
from report.drawing_read.read_dxf import read_dxf

UNITS = {"in": (1, INCH), "ft": (2, FT), "mm": (4, 1e-3), "m": (6, 1.0)}
"""Code of $INSUNITS and size [m] of units."""

L_FT = ((20, 20), (100, 20), (100, 50), (60, 50), (60, 75), (20, 75))
BOX_FT = ((120, 20), (200, 20), (200, 75), (120, 75))
UNIT_FT = ((67, 55), (75, 55), (75, 65), (67, 65))
ROOF_FT = ((0, 0), (240, 0), (240, 160), (0, 160))


@dataclass
class Sketch:
    """A drawing in the making."""

    version: str = "R2018"
    unit: str = "ft"

    def __post_init__(self):
        code, self.unit_m = UNITS[self.unit]
        self.document = new(self.version, units=code)
        self.space = self.document.modelspace()

    def ring(self, layer, points_ft, name=""):
        """Draw a closed line, and a name inside of it a quarter up from its first point."""
        points = [(x * FT / self.unit_m, y * FT / self.unit_m) for x, y in points_ft]
        look = {"layer": layer}
        if self.version == "R12":
            drawn = self.space.add_polyline2d(points, close=True, dxfattribs=look)
        else:
            drawn = self.space.add_lwpolyline(points, close=True, dxfattribs=look)
        if name:
            (x0, y0), (x1, _), (_, y2) = points[:3]
            at = ((x0 + x1) / 2, y0 + 0.25 * (y2 - y0))
            self.space.add_text(name, dxfattribs=look).set_placement(at)
        return drawn

    def saved(self, tmp_path):
        """Save the drawing; return its path."""
        path = tmp_path / "roof.dxf"
        self.document.saveas(path)
        return path


def plan(path, unit=None, layers=()):
    """The plan of a drawing."""
    unit_m = UNITS[unit][1] if unit else None
    found = read_dxf(path, unit_m)
    return plan_of(found, unit_m or UNITS[found.unit][1], dict(layers))


_VERTICES = "".join(
    f"0\nVERTEX\n8\nPV\n10\n{x}\n20\n{y}\n"
    for x, y in ((0.0, 0.0), (10.0, 0.0), (10.0, 5.0), (0.0, 5.0))
)

LIBRECAD_R12 = (
    "0\nSECTION\n2\nHEADER\n9\n$ACADVER\n1\nAC1009\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n"
    f"0\nPOLYLINE\n8\nPV\n66\n1\n70\n1\n{_VERTICES}0\nSEQEND\n8\nPV\n"
    "0\nTEXT\n8\nPV\n10\n4.0\n20\n2.0\n40\n1.0\n1\nA7\n0\nENDSEC\n0\nEOF\n"
)
"""An array as LibreCAD writes R12: a polyline with vertices, no handles and no units."""
