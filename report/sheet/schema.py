"""The input sheet as data: what is asked, in which unit, within which range, and how it is said.

Template, reader, input echo and documentation all come from these models; values are SI. Checks
that look at more than one cell are in `checks`. Read `workbook` next.
"""

from __future__ import annotations

import datetime as dt
import math
from dataclasses import dataclass
from enum import StrEnum
from typing import Annotated

from pydantic import Field, model_validator

from report.sheet.fields import Cell, Frozen, Section
from report.sheet.fields import YesNo as YesNo
from report.units import Quantity
from solver.provisions import OVERRIDABLE

MAX_TEXT = 2000
PROVISION_KEYS = OVERRIDABLE
"""Provisions that can be overridden, each with what it is and its unit."""


class RuleSetName(StrEnum):
    """Rule set to compare with."""

    PV1_2012 = "SEAOC PV1-2012"
    ASCE_7_16 = "ASCE 7-16"
    ASCE_7_22 = "ASCE 7-22"


class UnitsFirst(StrEnum):
    """System of units printed first."""

    US = "US"
    SI = "SI"


class RiskCategory(StrEnum):
    """Risk category, ASCE 7 Table 1.5-1."""

    I = "I"  # noqa: E741
    II = "II"
    III = "III"
    IV = "IV"


class SiteClass(StrEnum):
    """Site class, ASCE 7 chapter 20; the halves came with the 2022 edition."""

    A = "A"
    B = "B"
    BC = "BC"
    C = "C"
    CD = "CD"
    D = "D"
    D_DEFAULT = "D (default)"
    DE = "DE"
    E = "E"
    F = "F"


class Sdc(StrEnum):
    """Seismic design category, ASCE 7 section 11.6."""

    A = "A"
    B = "B"
    C = "C"
    D = "D"
    E = "E"
    F = "F"


class SlopeUnit(StrEnum):
    """How a roof slope is written."""

    DEGREES = "degrees"
    PERCENT = "percent"
    IN_PER_12 = "in/12"


class ObjectKind(StrEnum):
    """What an array could strike or fall from."""

    FIXED = "fixed object"
    UNLIKE_ARRAY = "unlike array"
    EDGE_WITH_PARAPET = "edge with parapet"
    EDGE_WITHOUT_PARAPET = "edge without parapet"


class Direction(StrEnum):
    """Where a clearance lies, seen from the array."""

    DOWN = "down"
    UP = "up"
    ACROSS = "across"
    ANY = "any"


class AccelUnit(StrEnum):
    """Unit of a motion record."""

    G = "g"
    M_S2 = "m/s2"
    CM_S2 = "cm/s2"
    MM_S2 = "mm/s2"


class Scaling(StrEnum):
    """How a record is scaled; a PPA is a peak of the horizontal component."""

    AS_RECORDED = "as recorded"
    FACTOR = "factor"
    PPA = "PPA"


class Polarity(StrEnum):
    """Signs of the horizontal component to run."""

    BOTH = "both"
    AS_RECORDED = "as recorded"
    REVERSED = "reversed"


class Statistic(StrEnum):
    """From the peaks of all motions to one value."""

    RULE_SET = "rule set"
    MEAN_1_1 = "1.1 x mean"
    LARGEST_1_1 = "1.1 x largest"
    MEAN = "mean"


Text = Annotated[str, Field(max_length=MAX_TEXT)]
RequiredText = Annotated[str, Field(min_length=1, max_length=MAX_TEXT)]
Id = Annotated[str, Field(min_length=1, max_length=40)]
Positive = Annotated[float, Field(gt=0)]
NotNegative = Annotated[float, Field(ge=0)]


class Project(Frozen):
    """Whose calculation this is."""

    name: Annotated[
        RequiredText, Cell("Project name", "Printed on the cover.", "Alameda Warehouse")
    ]
    number: Annotated[RequiredText, Cell("Project number", "Printed on every page.", "24-117")]
    client: Annotated[Text, Cell("Client", "Printed on the cover.", "Harbor Logistics LLC")] = ""
    address: Annotated[
        Text, Cell("Address", "Of the building.", "1200 Alameda St, Los Angeles, CA")
    ] = ""
    prepared_by: Annotated[
        RequiredText, Cell("Prepared by", "Name or initials, printed on every page.", "RG")
    ]
    checked_by: Annotated[
        Text,
        Cell(
            "Checked by",
            "Name or initials, printed on every page. Leave blank until it is checked.",
            "MT",
        ),
    ] = ""
    date: Annotated[dt.date, Cell("Date", "Date of this issue.", dt.date(2026, 3, 5))]
    revision: Annotated[
        RequiredText, Cell("Revision", "Of this issue, printed on every page.", "0")
    ]
    units_first: Annotated[
        UnitsFirst, Cell("Units first", "Both are printed; this one comes first.", "US")
    ] = UnitsFirst.US


class Revision(Frozen):
    """One line of the revision block."""

    revision: Annotated[RequiredText, Cell("Revision", "Number or letter.", "0")]
    date: Annotated[dt.date, Cell("Date", "Date of issue.", dt.date(2026, 3, 5))]
    description: Annotated[RequiredText, Cell("Description", "What changed.", "Issued for permit")]
    by: Annotated[Text, Cell("By", "Name or initials.", "RG")] = ""


def s_ds(s_ds_g: float | None, s_s_g: float | None, f_a: float | None) -> float | None:
    """Return S_DS [g]: as given, else 2/3 F_a S_S unrounded (ASCE 7 eq. 11.4-1, 11.4-3)."""
    if s_ds_g is not None:
        return s_ds_g
    if s_s_g is None or f_a is None:
        return None
    return 2.0 / 3.0 * f_a * s_s_g


class Site(Frozen):
    """Where the building stands and which rules govern."""

    rule_set: Annotated[
        RuleSetName,
        Cell("Rule set", "The adopted provisions. Rules are never mixed.", "SEAOC PV1-2012"),
    ]
    risk_category: Annotated[RiskCategory, Cell("Risk category", "ASCE 7 Table 1.5-1.", "II")]
    i_e: Annotated[
        float,
        Field(ge=1.0, le=2.0),
        Cell(
            "Importance factor I_e", "Risk category I, II: 1.0; III: 1.25; IV: 1.5; or more.", 1.0
        ),
    ]
    s_s_g: Annotated[
        Annotated[float, Field(gt=0, le=10)] | None,
        Cell("S_S", "Mapped, 0.2 s. With F_a, or give S_DS.", 1.97, "g"),
    ] = None
    s_1_g: Annotated[
        Annotated[float, Field(gt=0, le=10)] | None,
        Cell("S_1", "Mapped, 1 s. From 0.75 g on the design category is E or F.", 0.70, "g"),
    ] = None
    site_class: Annotated[SiteClass | None, Cell("Site class", "ASCE 7 chapter 20.", "D")] = None
    f_a: Annotated[
        Annotated[float, Field(gt=0, le=10)] | None,
        Cell("F_a", "Site coefficient, 0.2 s. With S_S, or give S_DS.", 1.2),
    ] = None
    f_v: Annotated[
        Annotated[float, Field(gt=0, le=10)] | None, Cell("F_v", "Site coefficient, 1 s.", 1.7)
    ] = None
    s_ds_g: Annotated[
        Annotated[float, Field(gt=0, le=5)] | None,
        Cell(
            "S_DS", "Design, short period. Leave blank to have 2/3 F_a S_S, unrounded.", 1.566, "g"
        ),
    ] = None
    sdc: Annotated[Sdc, Cell("Seismic design category", "ASCE 7 section 11.6.", "D")]
    storeys: Annotated[int, Field(ge=1, le=200), Cell("Storeys", "Above grade.", 1)]
    structure_height_m: Annotated[
        Positive,
        Cell(
            "Structure height h",
            "Average roof height above the base, ASCE 7 section 13.3.",
            36.0,
            Quantity.PLAN,
        ),
    ]
    roof_height_m: Annotated[
        NotNegative,
        Cell(
            "Height of the array z",
            "Of the roof that carries the array, above the base.",
            36.0,
            Quantity.PLAN,
        ),
    ]

    @model_validator(mode="after")
    def _enough_for_s_ds(self) -> Site:
        if s_ds(self.s_ds_g, self.s_s_g, self.f_a) is None:
            raise ValueError("give S_DS, or S_S and F_a")
        return self

    @property
    def s_ds(self) -> float:
        """S_DS [g], as given, else from S_S and F_a."""
        value = s_ds(self.s_ds_g, self.s_s_g, self.f_a)
        assert value is not None  # checked when made
        return value


def slope_rad(value: float, unit: SlopeUnit) -> float:
    """Return a slope as an angle [rad]."""
    if unit is SlopeUnit.DEGREES:
        return math.radians(value)
    return math.atan(value / (100.0 if unit is SlopeUnit.PERCENT else 12.0))


@dataclass(frozen=True, slots=True)
class Rectangle:
    """A rectangle in roof plan [m]."""

    x_from_m: float
    x_to_m: float
    y_from_m: float
    y_to_m: float


def _plan(edge: str) -> Cell:
    examples = {"x from": 20.0, "x to": 100.0, "y from": 15.0, "y to": 75.0}
    return Cell(
        edge,
        "Rectangle in roof plan, from any fixed corner of the roof.",
        examples[edge],
        Quantity.PLAN,
    )


class Array(Frozen):
    """A ballasted array that moves as one block."""

    id: Annotated[Id, Cell("ID", "Short and unique, such as A1.", "A1")]
    slope_value: Annotated[
        NotNegative, Cell("Slope", "Of the roof under the array, 0 to under 45 deg.", 2.0)
    ]
    slope_unit: Annotated[
        SlopeUnit, Cell("Slope unit", "In which the slope is written.", "degrees")
    ]
    mu: Annotated[
        float,
        Field(ge=0.0, le=1.5),
        Cell("Friction coefficient", "Kinetic, by test, the least of wet and dry.", 0.45),
    ]
    mu_report: Annotated[
        Text,
        Cell(
            "Friction test report",
            "Laboratory, number and date of the friction test.",
            "ASTM G115, Lab 1234, 2025-06-12",
        ),
    ] = ""
    construction: Annotated[
        RequiredText,
        Cell(
            "Construction",
            "Product and layout. Arrays with the same text here are like arrays.",
            "Tray 10 deg, landscape",
        ),
    ]
    weight_n: Annotated[
        Positive, Cell("Weight", "Of modules, racking and ballast.", 42000.0, Quantity.WEIGHT)
    ]
    cg_height_m: Annotated[
        Positive, Cell("CG height", "Centre of gravity above the roof surface.", 9.0, Quantity.SIZE)
    ]
    support_spacing_m: Annotated[
        Positive,
        Cell(
            "Support spacing",
            "Least spacing of the supports on the roof, either way in plan.",
            40.0,
            Quantity.SIZE,
        ),
    ]
    x_from_m: Annotated[float, _plan("x from")]
    x_to_m: Annotated[float, _plan("x to")]
    y_from_m: Annotated[float, _plan("y from")]
    y_to_m: Annotated[float, _plan("y to")]
    downslope_deg: Annotated[
        float,
        Field(ge=0.0, le=360.0),
        Cell(
            "Downslope direction",
            "In plan, counter-clockwise from +x: 0 is +x, 90 is +y.",
            270.0,
            "deg",
        ),
    ]

    @property
    def slope_rad(self) -> float:
        """The slope as an angle [rad]."""
        return slope_rad(self.slope_value, self.slope_unit)

    @property
    def rectangle(self) -> Rectangle:
        """The array in roof plan."""
        return Rectangle(self.x_from_m, self.x_to_m, self.y_from_m, self.y_to_m)


class RoofObject(Frozen):
    """What stands on the roof beside the arrays, and the roof's edges."""

    id: Annotated[Id, Cell("ID", "Short and unique, such as RTU-1.", "RTU-1")]
    kind: Annotated[
        ObjectKind,
        Cell(
            "Kind",
            "An unlike array is one of other construction that is not in Arrays.",
            "fixed object",
        ),
    ]
    height_m: Annotated[
        NotNegative | None,
        Cell(
            "Height",
            "Of the object or parapet above the roof; an edge with parapet needs it.",
            42.0,
            Quantity.SIZE,
        ),
    ] = None
    x_from_m: Annotated[float | None, _plan("x from")] = None
    x_to_m: Annotated[float | None, _plan("x to")] = None
    y_from_m: Annotated[float | None, _plan("y from")] = None
    y_to_m: Annotated[float | None, _plan("y to")] = None

    @property
    def rectangle(self) -> Rectangle | None:
        """The object in roof plan, where given."""
        x_from, x_to, y_from, y_to = self.x_from_m, self.x_to_m, self.y_from_m, self.y_to_m
        if x_from is None or x_to is None or y_from is None or y_to is None:
            return None
        return Rectangle(x_from, x_to, y_from, y_to)


class Clearance(Frozen):
    """The room an array has towards an object or another array."""

    array: Annotated[Id, Cell("Array", "ID of the array that moves.", "A1")]
    object: Annotated[Id, Cell("Object", "ID of an object, or of another array.", "RTU-1")]
    direction: Annotated[
        Direction, Cell("Direction", "From the array: down the slope, up, across.", "any")
    ]
    provided_m: Annotated[
        NotNegative, Cell("Provided", "Clear distance in roof plan.", 96.0, Quantity.SIZE)
    ]


class MotionInput(Frozen):
    """A roof motion, as asked for; `records` loads it."""

    id: Annotated[Id, Cell("ID", "Short and unique, such as M1.", "M1")]
    record: Annotated[
        RequiredText,
        Cell(
            "Horizontal record",
            "A file beside this workbook, or Sheet!Header of a pasted column.",
            "records/m1-x.csv",
        ),
    ]
    units: Annotated[AccelUnit, Cell("Record units", "Of both components.", "g")]
    dt_s: Annotated[
        Annotated[float, Field(gt=0, le=1)] | None,
        Cell("Time step", "Leave blank where the file has a column of times.", 0.01, "s"),
    ] = None
    vertical: Annotated[
        RequiredText | None,
        Cell(
            "Vertical record",
            "As the horizontal one, positive upwards; blank for none.",
            "records/m1-z.csv",
        ),
    ] = None
    scaling: Annotated[
        Scaling,
        Cell(
            "Scaling",
            "As recorded, by a factor, or to a peak horizontal acceleration (PPA).",
            "as recorded",
        ),
    ] = Scaling.AS_RECORDED
    scale_value: Annotated[
        Annotated[float, Field(gt=0, le=1000)] | None,
        Cell("Factor or PPA", "The factor, or the PPA in g. Blank for as recorded.", 1.0),
    ] = None
    polarity: Annotated[
        Polarity,
        Cell("Polarity", "Both runs each motion in both senses, and the larger counts.", "both"),
    ] = Polarity.BOTH
    source: Annotated[
        Text,
        Cell(
            "Source",
            "Event, station and processing, printed in the package.",
            "Spectrum-compatible, seed 1",
        ),
    ] = ""


class Options(Frozen):
    """Choices that the rule sets leave open."""

    statistic: Annotated[
        Statistic,
        Cell(
            "Design value from peaks",
            "Rule set: what the chosen rule set states for this number of motions.",
            "rule set",
        ),
    ] = Statistic.RULE_SET
    peer_reviewed: Annotated[
        bool, Cell("Analysis is peer reviewed", "Lifts the floor on the value from analysis.", "No")
    ] = False


class Override(Frozen):
    """A provision's number, replaced, with the reason that the package prints."""

    provision: Annotated[
        RequiredText, Cell("Provision", "Choose which number to replace.", "parapet_height_in")
    ]
    value: Annotated[float, Cell("Value", "In the unit that the sheet Provisions names.", 18.0)]
    reason: Annotated[
        RequiredText,
        Cell(
            "Reason", "Printed in the package.", "Agreed with the building department, 2026-02-10"
        ),
    ]


class ProjectInput(Frozen):
    """Everything a workbook says."""

    project: Project
    revisions: tuple[Revision, ...] = ()
    site: Site
    arrays: tuple[Array, ...]
    objects: tuple[RoofObject, ...] = ()
    clearances: tuple[Clearance, ...] = ()
    motions: tuple[MotionInput, ...]
    options: Options = Options()
    overrides: tuple[Override, ...] = ()


def _block(key: str, sheet: str, title: str, hint: str, model: type[Frozen]) -> Section:
    return Section(key=key, sheet=sheet, title=title, hint=hint, model=model, is_table=False)


def _table(key: str, sheet: str, title: str, hint: str, model: type[Frozen]) -> Section:
    return Section(key=key, sheet=sheet, title=title, hint=hint, model=model, is_table=True)


SECTIONS = (
    _block("project", "Project", "Project", "Printed on the cover and on every page.", Project),
    _table("revisions", "Project", "Revisions", "One row for each issue.", Revision),
    _block("site", "Site", "Site and building", "Give S_DS, or S_S and F_a.", Site),
    _table("arrays", "Arrays", "Arrays", "One row for each array that moves as one.", Array),
    _table(
        "objects",
        "Objects",
        "Objects and roof edges",
        "One row for each thing an array could strike or fall from. The plan rectangle is optional;"
        " an edge is a strip outside the roof.",
        RoofObject,
    ),
    _table(
        "clearances",
        "Clearances",
        "Clearances",
        "One row for each clearance to check; the object may be another array.",
        Clearance,
    ),
    _table(
        "motions",
        "Motions",
        "Roof motions",
        "One row for each motion. Records lie beside this workbook, or in a sheet as columns.",
        MotionInput,
    ),
    _block("options", "Options", "Options", "The defaults suit most projects.", Options),
    _table(
        "overrides",
        "Options",
        "Overrides of provisions",
        "Each is printed in the package with its reason.",
        Override,
    ),
)
