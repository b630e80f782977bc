"""The worksheets of the roof: Building, Arrays, Objects, Clearances, Outlines, Layers."""

from __future__ import annotations

from collections.abc import Iterator

from report.project.model.array import Array, weight_of_parts
from report.project.model.roof import DRAWING, Clearance, DrawingLayer, Roof, RoofObject, Vertex
from report.project.model.shapes import SIDES
from report.project.workbook.entries import Entry, block, table
from report.text.units import Quantity

OR_OUTLINE = "required, or an outline"
_SIDE = (
    (20.0, 100.0, 15.0, 75.0),
    "Rectangle on the roof plan, measured from any fixed corner of the roof. For another shape,"
    " leave all four cells blank and enter vertices on the Outlines worksheet.",
)
_ROOF = (
    (0.0, 360.0, 0.0, 240.0),
    "Roof edge in the coordinates of the arrays. Enter all four sides, or none. For another shape,"
    " enter vertices on the Outlines worksheet under the name roof.",
)


def _sides(
    words: tuple[tuple[float, ...], str], owner: str = "", need: str = ""
) -> Iterator[Entry]:
    examples, note = words
    for field, example in zip(SIDES, examples, strict=True):
        side = field.removesuffix("_m").replace("_", " ")
        yield Entry(f"{owner}{side}", field, example, Quantity.PLAN, need=need, note=note)


ROOF = block("roof", "Building", "Roof outline and north", Roof, "Optional. The plan shows the"
    " outline; each roof edge near an array must then be listed as an object.",
    *_sides(_ROOF, "Roof "),
    Entry("Direction of north", "north_deg", 90.0, "deg",
          note="In plan, counterclockwise from +x: 90 is +y."),
    may_be_absent=True,
)  # fmt: skip

ARRAYS = table("arrays", "Arrays", "Arrays", Array, "One row for each array that moves as a unit."
    " Columns to the right of Downslope direction are optional.",
    Entry("ID", "id", "A1", note="Short and unique, such as A1."),
    Entry("Slope", "slope_value", 2.0, unit_from=("slope_unit", str),
          note="Slope of the roof under the array, 0 to less than 45 deg."),
    Entry("Slope unit", "slope_unit", "degrees", note="Unit of the slope."),
    Entry("Friction coefficient", "mu", 0.45, usual=(0.3, 0.8),
          note="Kinetic, from tests; the smaller of wet and dry."),
    Entry("Friction test report", "mu_report", "ASTM G115, Lab 1234, 2025-06-12",
          note="Laboratory, number and date of the friction test."),
    Entry("Construction", "construction", "Tray 10 deg, landscape", note="Product and layout."
          " Arrays with identical text, slope, friction and downslope direction are treated as"
          " arrays of similar construction."),
    Entry("Modules", "modules", 320, note="Number of modules."),
    Entry("Module weight", "module_weight_n", 75.0, Quantity.WEIGHT, usual=(20.0, 300.0),
          note="Weight of one module with its racking, without ballast."),
    Entry("Ballast weight", "ballast_n", 18000.0, Quantity.WEIGHT, usual=(0.0, 500000.0),
          note="Ballast of the whole array; 0 if it has none."),
    Entry("Weight", "weight_n", 42000.0, Quantity.WEIGHT, need="required, or modules and ballast",
          usual=(500.0, 500000.0), computed=weight_of_parts, note="Modules, racking and ballast."
          " If blank, computed from modules, module weight and ballast weight."),
    Entry("CG height", "cg_height_m", 9.0, Quantity.SIZE, usual=(4.0, 36.0),
          note="Center of gravity above the roof surface."),
    Entry("Support spacing", "support_spacing_m", 40.0, Quantity.SIZE, usual=(12.0, 120.0),
          note="Smallest spacing of the supports on the roof, in either plan direction."),
    *_sides(_SIDE, need=OR_OUTLINE),
    Entry("Downslope direction", "downslope_deg", 270.0, "deg",
          note="In plan, counterclockwise from +x: 0 is +x, 90 is +y."),
    Entry("High-velocity friction", "mu_fast", 0.5, usual=(0.3, 0.9), is_rare=True,
          former="Friction at speed", note="Only if tests show velocity-dependent friction: the"
          " coefficient at high velocity. The friction coefficient is then the low-velocity"
          " value."),
    Entry("Friction rate", "mu_rate_s_per_m", 30.0, "s/m", usual=(1.0, 200.0), is_rare=True,
          note="Rate of transition from low to high velocity: fast - (fast - slow) exp(-rate x"
          " velocity). Required with high-velocity friction."),
    Entry("Static friction", "mu_static", 0.55, usual=(0.3, 1.0), is_rare=True,
          note="Only if tested: the coefficient at which slip starts. If blank, the friction"
          " coefficient."),
    Entry("Importance factor I_p", "i_p", 1.0, is_rare=True, note="Component importance factor."
          " PV1-2012 separations use the larger I_p of the array and the adjacent item."),
    # PV1-2012 limits the height by the base, ASCE 7 by the spacing of the supports: two numbers.
    Entry("Base dimension", "base_m", 60.0, Quantity.SIZE, usual=(12.0, 240.0), is_rare=True,
          note="Smallest plan dimension of the supporting base, for the low-profile limit of"
          " PV1-2012. If blank, the support spacing is used (conservative)."),
    Entry("Contact pressure", "contact_pressure_pa", 150.0, Quantity.PRESSURE, is_rare=True,
          note="Weight divided by the contact area of the supports; printed next to that of the"
          " friction tests."),
    Entry("Interconnection strength", "interconnection_n", 4000.0, Quantity.WEIGHT,
          note="Smallest strength provided between the parts of the array; compared with the"
          " strength that the rule set requires."),
    Entry("Electrical slack", "slack_m", 48.0, Quantity.SIZE, usual=(6.0, 240.0),
          note="Slack in the wiring to the array; compared with the design displacement."),
    Entry("Allowable roof load", "roof_capacity_pa", 6.0, Quantity.PRESSURE, usual=(2.0, 50.0),
          former="Roof capacity", note="Weight per area of the array permitted by the engineer of"
          " the roof; compared with the weight over the plan area. If blank, by others."),
    Entry("Weight in wind design", "wind_weight_pa", 5.5, Quantity.PRESSURE, usual=(1.0, 50.0),
          note="Weight per area, with ballast, in the wind design by others; compared with the"
          " weight over the plan area."),
    Entry("Location source", "place_from", DRAWING, is_rare=True, former="Place from",
          note="Drawing: entered by roofslip plan read, which deletes the row if the drawing no"
          " longer contains the item. Clear this cell if you change the location. Blank: as"
          " entered."),
    needs_rows=True,
)  # fmt: skip

OBJECTS = table("objects", "Objects", "Objects and roof edges", RoofObject,
    "One row for each object that an array could strike and each edge it could fall from. The plan"
    " rectangle is optional; enter an edge as a strip outside the roof.",
    Entry("ID", "id", "RTU-1", note="Short and unique, such as RTU-1."),
    Entry("Type", "kind", "fixed object", former="Kind",
          note="Array of different construction: one that is not listed on the Arrays worksheet,"
          " such as an existing array."),
    Entry("Height", "height_m", 42.0, Quantity.SIZE, usual=(4.0, 240.0),
          note="Height of the object or parapet above the roof; required for an edge with"
          " parapet."),
    *_sides(_SIDE),
    Entry("Importance factor I_p", "i_p", 1.0, is_rare=True,
          note="Importance factor of the object; not used for edges."),
    Entry("Location source", "place_from", DRAWING, is_rare=True, former="Place from",
          note="Same as for arrays."),
)  # fmt: skip

CLEARANCES = table("clearances", "Clearances", "Clearances", Clearance,
    "One row for each clearance to check; the object may be another array.",
    Entry("Array", "array", "A1", note="ID of the array that moves."),
    Entry("Object", "object", "RTU-1", note="ID of an object, or of another array."),
    Entry("Direction", "direction", "any",
          note="From the array: downslope, upslope, cross-slope, or any."),
    Entry("Provided clearance", "provided_m", 96.0, Quantity.SIZE, usual=(6.0, 600.0),
          former="Provided", note="Clear distance in roof plan."),
    Entry("Fire pathway", "pathway_m", 48.0, Quantity.SIZE, usual=(24.0, 240.0), zero="none",
          note="Width required by the fire code along this clearance, or none. The package checks"
          " that this width remains after the design displacement. If blank, the package has an"
          " open condition."),
    Entry("Clearance source", "source", "measured", former="Distance from", note="Blank: as"
          " entered. Drawing: from the plan, an open condition until you confirm it by selecting"
          " measured here, or for all by name and date on the Project worksheet."),
)  # fmt: skip

OUTLINES = table("outlines", "Outlines", "Outlines", Vertex, "Optional. Arrays, objects and"
    " roofs that are not rectangles. One row for each vertex, in order around the outline; leave"
    " the four sides of the rectangle blank.",
    Entry("Outline of", "name", "A1", note="ID of an array or an object, or roof for the roof."),
    Entry("x", "x_m", 20.0, Quantity.PLAN,
          note="Vertices in order around the outline, one to a row."),
    Entry("y", "y_m", 15.0, Quantity.PLAN, note="In the coordinates of the arrays."),
    Entry("From", "source", DRAWING, note="Drawing: entered by roofslip plan read. Clear this cell"
          " if you change the row. Blank: as entered."),
    may_be_absent=True,
)  # fmt: skip

LAYERS = table("layers", "Layers", "Layers of the roof drawing", DrawingLayer,
    "Optional, for roofslip plan read: what is drawn on each layer. The layers of plan.dxf need"
    " no row.",
    Entry("Layer", "layer", "A-ROOF-PV", note="Name of a layer of the roof drawing."),
    Entry("Content", "kind", "array", former="Drawn on it",
          note="What the closed polylines on the layer represent."),
    may_be_absent=True,
)  # fmt: skip
