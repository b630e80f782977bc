"""Writes a plan as DXF: the only module that knows the library.

The same plan gives the same bytes. Decides nothing (`report.drawing.plan`).
"""

from __future__ import annotations

import io
import math
from typing import TYPE_CHECKING

from report.drawing.items import Layer, PlanDimension, PlanDrawing

if TYPE_CHECKING:
    from ezdxf.document import Drawing
    from ezdxf.layouts.layout import Modelspace

APPLICATION = "ROOFSLIP"
"""Application whose extended data names what an outline is of."""

_VERSION = "R2010"
_DASHED = "DASHED"
_FONT = "arial.ttf"
_STYLE = "ROOFSLIP"  # of dimensions


def write_dxf(plan: PlanDrawing) -> bytes:
    """Return a plan as DXF (AutoCAD 2010): a layer for each kind, outlines as closed polylines.

    Each line carries its name as extended data of `APPLICATION`, to be read back, and so does each
    text that tells the height of something.
    """
    # Imported here: it takes longer than all the rest of the drawing.
    import ezdxf
    from ezdxf.enums import TextEntityAlignment
    from ezdxf.filemanagement import new

    # Its only switch for files without the time of writing and random identifiers.
    ezdxf.options.write_fixed_meta_data_for_testing = True  # type: ignore[attr-defined]
    document = new(_VERSION, units=ezdxf.units.FT if plan.is_feet else ezdxf.units.M)
    document.header["$MEASUREMENT"] = 0 if plan.is_feet else 1
    document.appids.add(APPLICATION)
    dash = [part * plan.height for part in (3.0, 2.0, -1.0)]
    document.linetypes.add(_DASHED, dash, description="Dashed __ __ __")
    document.styles.get("Standard").dxf.font = _FONT
    for layer in Layer:
        title, color, is_dashed = layer.value
        linetype = _DASHED if is_dashed else "Continuous"
        document.layers.add(title, color=color, linetype=linetype)
    space = document.modelspace()
    for line in plan.lines:
        drawn = space.add_lwpolyline(
            line.points, close=line.is_closed, dxfattribs={"layer": line.layer.title}
        )
        drawn.set_xdata(APPLICATION, [(1000, _plain(line.name))])
    for text in plan.texts:
        align = (
            TextEntityAlignment.MIDDLE_LEFT if text.is_left else TextEntityAlignment.MIDDLE_CENTER
        )
        words = _plain(text.words).replace("%%", "%%%%%%").replace("^", "^ ")  # begin codes
        written = space.add_text(
            words,
            height=plan.height,
            rotation=90.0 if text.is_upright else 0.0,
            dxfattribs={"layer": text.layer.title},
        )
        written.set_placement(text.at, align=align)
        if text.of:
            written.set_xdata(APPLICATION, [(1000, _plain(text.of))])
    _add_style(document, plan)
    for dimension in plan.dimensions:
        _add_dimension(space, dimension)
    # As the library would, but sorted: its order is that of a set, another one in each process.
    for kind in sorted(document.entitydb.dxf_types_in_use()):
        document.classes.add_class(kind)
    out = io.StringIO()
    document.write(out)
    return out.getvalue().encode("utf-8")


def _add_style(document: Drawing, plan: PlanDrawing) -> None:
    """Add the style of dimensions: horizontal texts in the unit of a displacement, and ticks."""
    per_unit, decimals = (12.0, 1) if plan.is_feet else (1000.0, 0)  # inches, millimeters
    document.dimstyles.new(
        _STYLE,
        dxfattribs={
            "dimtxt": plan.height,
            "dimgap": 0.5 * plan.height,
            "dimtsz": 0.4 * plan.height,
            "dimlfac": per_unit,
            "dimdec": decimals,
            "dimzin": 0,
            "dimdsep": ord("."),
            "dimse1": 1,
            "dimse2": 1,
            "dimtfill": 1,  # of the background: a text lies over outlines
            "dimtih": 1,
            "dimtoh": 1,
        },
    )


def _add_dimension(space: Modelspace, dimension: PlanDimension) -> None:
    """Add a dimension with its text, which no program measures again, and its picture."""
    (x0, y0), (x1, y1) = dimension.ends
    drawn = space.add_linear_dim(
        base=dimension.ends[0],
        p1=dimension.ends[0],
        p2=dimension.ends[1],
        angle=math.degrees(math.atan2(y1 - y0, x1 - x0)),
        text=dimension.words or " ",  # a space is none
        text_rotation=90.0 if dimension.is_upright else None,
        dimstyle=_STYLE,
        dxfattribs={"layer": dimension.layer.title},
    )
    drawn.set_location(dimension.at, leader=dimension.has_leader)
    drawn.render()
    if not dimension.words:  # the library leaves out its point, which it needs to read it
        drawn.dimension.dxf.text_midpoint = (*dimension.at, 0.0)
    for part in drawn.dimension.get_geometry_block() or ():
        if part.dxf.layer == "0":  # not every viewer takes that for the layer of the dimension
            part.dxf.layer = dimension.layer.title
    drawn.dimension.set_xdata(APPLICATION, [(1000, _plain(dimension.name))])


def _plain(words: str) -> str:
    """Return a text on one line."""
    return " ".join(words.split())
