"""The roof plan as a DXF file: lines, texts and dimensions on layers.

The same plan gives the same bytes. Read `write_dxf`.
"""

from __future__ import annotations

import io
import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

from report.drawing.layers import Layer
from report.project.model.shapes import Point

if TYPE_CHECKING:
    from ezdxf.document import Drawing
    from ezdxf.layouts.layout import Modelspace


@dataclass(frozen=True, slots=True, kw_only=True)
class PlanLine:
    """A line or, if closed, an outline; points in the unit of the drawing, and the id it is of."""

    layer: Layer
    name: str
    points: tuple[Point, ...]
    is_closed: bool


@dataclass(frozen=True, slots=True, kw_only=True)
class PlanText:
    """A text about a point, in the unit of the drawing."""

    layer: Layer
    words: str
    at: Point
    of: str = ""  # id of what it tells the height of, wherever it is; empty for none
    is_left: bool = False  # whether it starts at its point
    is_upright: bool = False  # whether it reads from below


@dataclass(frozen=True, slots=True, kw_only=True)
class PlanDimension:
    """A dimension between two points; its text is centered on a point, empty if it does not fit."""

    layer: Layer
    name: str
    ends: tuple[Point, Point]
    words: str
    at: Point
    is_upright: bool = False
    has_leader: bool = False  # whether a line leads to its text


@dataclass(frozen=True, slots=True, kw_only=True)
class PlanDrawing:
    """The plan in feet (US) or meters (SI), with the height of its texts.

    Its layout has a title block, in pairs of a heading and a text, below a window on the plan about
    a point, at a scale given by the length of the plan in an inch of paper.
    """

    is_feet: bool
    height: float
    lines: tuple[PlanLine, ...]
    texts: tuple[PlanText, ...]
    dimensions: tuple[PlanDimension, ...]
    title: tuple[tuple[str, str], ...]
    middle: Point
    per_in: float


# Application whose extended data names what an outline is of.
APPLICATION = "ROOFSLIP"
_VERSION = "R2010"
_DASHED = "DASHED"
_FONT = "arial.ttf"
_STYLE = "ROOFSLIP"  # of dimensions
_LEGIBLE = 7  # black on white, white on black

# Size of the layout [in], ANSI D and ISO A1, its margin, and the height of the title block.
_SHEETS = {True: (34.0, 22.0), False: (33.1, 23.4)}
_MARGIN_IN, _TITLE_IN = 0.75, 1.0

# The window on the plan, which fits into both.
WINDOW_IN = (33.1 - 2.0 * _MARGIN_IN, 22.0 - 2.0 * _MARGIN_IN - _TITLE_IN)


def write_dxf(plan: PlanDrawing) -> bytes:
    """Return a plan as DXF (AutoCAD 2010): a layer for each kind, outlines as closed polylines."""
    # Imported here: it takes longer than all the rest of the drawing.
    import ezdxf
    from ezdxf.enums import TextEntityAlignment
    from ezdxf.filemanagement import new

    # Its only switch for files without the time of writing and random identifiers.
    ezdxf.options.write_fixed_meta_data_for_testing = True  # type: ignore[attr-defined]
    document = new(_VERSION, units=ezdxf.units.FT if plan.is_feet else ezdxf.units.M)
    # 0 loads the patterns of hatches and lines in inches, 1 those in millimeters.
    document.header["$MEASUREMENT"] = 0 if plan.is_feet else 1
    document.appids.add(APPLICATION)
    # In heights of the texts, so that a dash shows at any size of roof.
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
        # Its name, to be read back, as that of a text which tells the height of something.
        drawn.set_xdata(APPLICATION, [(1000, _plain(line.name))])
    for text in plan.texts:
        align = (
            TextEntityAlignment.MIDDLE_LEFT if text.is_left else TextEntityAlignment.MIDDLE_CENTER
        )
        written = space.add_text(
            _coded(text.words),
            height=plan.height,
            rotation=90.0 if text.is_upright else 0.0,
            dxfattribs={"layer": text.layer.title},
        )
        written.set_placement(text.at, align=align)
        if text.layer in (Layer.ARRAY, Layer.UNLIKE, Layer.OBJECT):
            written.dxf.color = _LEGIBLE  # also on black, where lines in blue and gray are faint
        if text.of:
            written.set_xdata(APPLICATION, [(1000, _plain(text.of))])
    _add_style(document, plan)
    for dimension in plan.dimensions:
        _add_dimension(space, dimension)
    _add_layout(document, plan)
    # As the library would, but sorted: its order is that of a set, another one in each process.
    for kind in sorted(document.entitydb.dxf_types_in_use()):
        document.classes.add_class(kind)
    out = io.StringIO()
    document.write(out)
    # DXF is in UTF-8 from AutoCAD 2007 on.
    return out.getvalue().encode("utf-8")


def _add_layout(document: Drawing, plan: PlanDrawing) -> None:
    """Add the layout: a window on the plan to scale, above the title block."""
    from ezdxf.enums import TextEntityAlignment  # with `ezdxf`, as above

    # Not plotted: its frame would stand within the border of the sheet.
    document.layers.get(Layer.WINDOW.title).dxf.plot = 0
    wide, tall = _SHEETS[plan.is_feet]
    layout = document.paperspace("Layout1")
    margins = (_MARGIN_IN,) * 4
    layout.page_setup(size=(wide, tall), margins=margins, units="inch", device="DWG To PDF.pc3")
    long, high = wide - 2.0 * _MARGIN_IN, tall - 2.0 * _MARGIN_IN - _TITLE_IN
    # The length of the plan that the height of the window shows is what sets its scale.
    layout.add_viewport(
        center=(long / 2, _TITLE_IN + high / 2),
        size=(long, high),
        view_center_point=plan.middle,
        view_height=high * plan.per_in,
        dxfattribs={"layer": Layer.WINDOW.title},
    )
    on_title = {"layer": Layer.TITLE.title}
    frame = ((0.0, 0.0), (long, 0.0), (long, _TITLE_IN + high), (0.0, _TITLE_IN + high))
    rules = [
        layout.add_lwpolyline(frame, close=True, dxfattribs=on_title),
        layout.add_lwpolyline(((0.0, _TITLE_IN), (long, _TITLE_IN)), dxfattribs=on_title),
    ]
    shares = [max(len(head), len(text)) + 4 for head, text in plan.title]
    for count, (head, text) in enumerate(plan.title):
        x = long * sum(shares[:count]) / sum(shares)
        if count:
            ends = ((x, 0.0), (x, _TITLE_IN))
            rules.append(layout.add_lwpolyline(ends, dxfattribs=on_title))
        for words, size, y in ((head, 0.1, 0.75), (text, 0.2, 0.35)):
            written = layout.add_text(_coded(words), height=size, dxfattribs=on_title)
            written.set_placement((x + 0.12, y), align=TextEntityAlignment.MIDDLE_LEFT)
    for rule in rules:  # no closed line of another's plan
        rule.set_xdata(APPLICATION, [(1000, "title block")])


def _add_style(document: Drawing, plan: PlanDrawing) -> None:
    """Add the style of dimensions: horizontal texts in the unit of a displacement, and ticks."""
    per_unit, decimals = (12.0, 1) if plan.is_feet else (1000.0, 0)  # inches, millimeters
    document.dimstyles.new(
        _STYLE,
        dxfattribs={
            "dimtxt": plan.height,
            "dimgap": 0.5 * plan.height,
            # Ticks of this size in place of arrows, as structural drawings have them.
            "dimtsz": 0.4 * plan.height,
            # The plan is in feet or meters, and lengths are read in inches or millimeters.
            "dimlfac": per_unit,
            "dimdec": decimals,
            "dimzin": 0,
            "dimdsep": ord("."),
            # No extension lines: the ends of a gap are the outlines themselves.
            "dimse1": 1,
            "dimse2": 1,
            "dimtfill": 1,  # of the background: a text lies over outlines
            # Texts are horizontal, inside and outside of their lines.
            "dimtih": 1,
            "dimtoh": 1,
        },
    )


def _add_dimension(space: Modelspace, dimension: PlanDimension) -> None:
    """Add a dimension with fixed text and its graphics."""
    (x0, y0), (x1, y1) = dimension.ends
    drawn = space.add_linear_dim(
        base=dimension.ends[0],
        p1=dimension.ends[0],
        p2=dimension.ends[1],
        angle=math.degrees(math.atan2(y1 - y0, x1 - x0)),
        text=_plain(dimension.words) or " ",  # a space is none
        text_rotation=90.0 if dimension.is_upright else None,
        dimstyle=_STYLE,
        dxfattribs={"layer": dimension.layer.title},
    )
    drawn.set_location(dimension.at, leader=dimension.has_leader)
    # The picture of a dimension is a block of its own: programs that only show a DXF draw nothing
    # else.
    drawn.render()
    if not dimension.words:  # the library leaves out its point, which it needs to read it
        drawn.dimension.dxf.text_midpoint = (*dimension.at, 0.0)
    for part in drawn.dimension.get_geometry_block() or ():
        if part.dxf.layer == "0":  # not every viewer takes that for the layer of the dimension
            part.dxf.layer = dimension.layer.title
    drawn.dimension.set_xdata(APPLICATION, [(1000, _plain(dimension.name))])


def _coded(words: str) -> str:
    """Return a text in which nothing begins a code."""
    # %%d is a degree sign in DXF and %%% one percent sign; ^J is a line feed, and a caret with a
    # blank is a caret.
    return _plain(words).replace("%%", "%%%%%%").replace("^", "^ ")


def _plain(words: str) -> str:
    # A value of DXF is one line of the file.
    return " ".join(words.split())
