"""The roof, the objects and edges on it, the clearances, and the layers of its drawing."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from report.project.model.array import ImportanceCell
from report.project.model.choices import ClearanceSource, Direction, LayerKind, ObjectKind
from report.project.model.shapes import Placed
from report.project.model.values import Frozen, Id, NotNegative, RequiredText, Text

# Whence a row comes that a command has taken from a drawing.
DRAWING = "drawing"
# The same with the number of modules.
DRAWN_MODULES = f"{DRAWING}, modules too"
# Name of the roof on the Outlines worksheet.
ROOF = "roof"


class Roof(Placed):
    """The outline of the roof, if given, and north."""

    x_from_m: float | None = None
    x_to_m: float | None = None
    y_from_m: float | None = None
    y_to_m: float | None = None
    north_deg: Annotated[float, Field(ge=0.0, le=360.0)] = 90.0


class RoofObject(Placed):
    """An object on the roof, or a roof edge."""

    id: Id
    kind: ObjectKind
    height_m: NotNegative | None = None
    x_from_m: float | None = None
    x_to_m: float | None = None
    y_from_m: float | None = None
    y_to_m: float | None = None
    i_p: ImportanceCell = 1.0
    place_from: Text = ""  # `DRAWING` where a command has written the row


class Vertex(Frozen):
    """A vertex of the outline of an array, an object or the roof."""

    name: Id
    x_m: float
    y_m: float
    source: Text = ""


class DrawingLayer(Frozen):
    """A layer of a roof drawing, and its content."""

    layer: RequiredText
    kind: LayerKind


class Clearance(Frozen):
    """The clearance from an array to an object or another array."""

    array: Id
    object: Id
    direction: Direction
    provided_m: NotNegative
    # 0 is none required; None is not stated, which is an open condition.
    pathway_m: NotNegative | None = None
    source: ClearanceSource | None = None
