"""Writes a plan as DXF: the only module that knows the library.

The same plan gives the same bytes. Decides nothing (`report.drawing.plan`).
"""

from __future__ import annotations

import io

from report.drawing.layers import Layer, PlanDrawing

APPLICATION = "ROOFSLIP"
"""Application whose extended data names what an outline is of."""

_VERSION = "R2010"
_DASHED = "DASHED"


def write_dxf(plan: PlanDrawing) -> bytes:
    """Return a plan as DXF (AutoCAD 2010): a layer for each kind, outlines as closed polylines.

    Each line carries its name as extended data of `APPLICATION`, to be read back.
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
    document.linetypes.add(_DASHED, [3.0, 2.0, -1.0], description="Dashed __ __ __")
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
        look = {"layer": text.layer.title, "height": text.height}
        words = _plain(text.words).replace("%%", "%%%%%%").replace("^", "^ ")  # begin codes
        written = space.add_text(words, dxfattribs=look)
        written.set_placement(text.at, align=TextEntityAlignment.MIDDLE_CENTER)
    # As the library would, but sorted: its order is that of a set, another one in each process.
    for kind in sorted(document.entitydb.dxf_types_in_use()):
        document.classes.add_class(kind)
    out = io.StringIO()
    document.write(out)
    return out.getvalue().encode("utf-8")


def _plain(words: str) -> str:
    """Return a text on one line."""
    return " ".join(words.split())
