"""The input workbook as data: fields, units, allowed ranges, labels and help texts.

Template, reader and input echo all come from these models; values are SI. Checks that involve more
than one cell are in `checks`. Read `report.sheet.read` next.
"""

from __future__ import annotations

import datetime as dt
from dataclasses import replace
from typing import Annotated

from pydantic import AfterValidator, model_validator

from report.sheet.fields import Cell, Frozen, SheetSection, YesNo
from report.sheet.legacy_labels import PROVISIONS
from report.sheet.schema.building import BuildingInput, SpectrumPoint, TargetInput
from report.sheet.schema.choices import (
    MAX_TEXT,
    AccelUnit,
    Baseline,
    Direction,
    LayerKind,
    ModelChoice,
    ObjectKind,
    Polarity,
    RecordedAt,
    RequiredText,
    RiskCategory,
    RuleSetName,
    Scaling,
    Sdc,
    SiteClass,
    SlopeUnit,
    Statistic,
    StructureType,
    Text,
    UnitsFirst,
    decimals,
)
from report.sheet.schema.friction import FrictionTestRow, FrictionTests
from report.sheet.schema.links import Links, coefficients
from report.sheet.schema.motions import MotionInput
from report.sheet.schema.project import Project, Revision, Site, edition_of, site_class_or_default
from report.sheet.schema.roof import Roof
from report.sheet.schema.scene import (
    ROOF,
    SIDES,
    Array,
    Clearance,
    DrawingLayer,
    RoofObject,
    Vertex,
    slope_rad,
)
from report.sheet.shapes import Point, Polygon, Rectangle, Shape, ring
from solver.rules.provisions import MEAN_WITHOUT_FACTOR_MOTIONS, OVERRIDABLE

__all__ = [
    "MAX_TEXT",
    "PROVISION_KEYS",
    "ROOF",
    "SECTIONS",
    "SIDES",
    "AccelUnit",
    "Acknowledgment",
    "Array",
    "Baseline",
    "BuildingInput",
    "Clearance",
    "Direction",
    "DrawingLayer",
    "FrictionTestRow",
    "FrictionTests",
    "LayerKind",
    "Links",
    "ModelChoice",
    "MotionInput",
    "ObjectKind",
    "Options",
    "Override",
    "Polarity",
    "Polygon",
    "Project",
    "ProjectInput",
    "RecordedAt",
    "Rectangle",
    "Revision",
    "RiskCategory",
    "Roof",
    "RoofObject",
    "RuleSetName",
    "Scaling",
    "Sdc",
    "Shape",
    "Site",
    "SiteClass",
    "SlopeUnit",
    "SpectrumPoint",
    "Statistic",
    "StructureType",
    "TargetInput",
    "UnitsFirst",
    "Vertex",
    "YesNo",
    "coefficients",
    "edition_of",
    "factors",
    "provision_name",
    "provision_unit",
    "site_class_or_default",
    "slope_rad",
]

MAX_EVENTS = 20
"""Most smaller events whose displacements are added."""

PROVISION_KEYS = OVERRIDABLE
"""Provisions that can be overridden, each with its meaning and unit."""


def provision_name(key: str) -> str:
    """Return the name of a provision in words, as on the sheet Provisions; without its unit."""
    words = PROVISION_KEYS[key].partition(" [")[0]
    return words[:1].upper() + words[1:]


def provision_unit(key: str) -> str:
    """Return the unit of a provision; empty for none."""
    return PROVISION_KEYS[key].partition(" [")[2].rstrip("]")


_KEYS_BY_NAME = {provision_name(key).casefold(): key for key in PROVISION_KEYS}


def _provision_key(text: str) -> str:
    """Return the key of a provision given by its name, its key or an earlier key."""
    name = " ".join(text.partition(" [")[0].split()).casefold()
    return PROVISIONS.get(text, _KEYS_BY_NAME.get(name, text))


def _unit_of_named(text: str) -> str:
    key = _provision_key(text)
    return provision_unit(key) if key in PROVISION_KEYS else ""


def factors(text: str) -> tuple[float, ...]:
    """Return factors such as `0.50, 0.25`, each above 0 and up to 1; empty if it is not one."""
    values = decimals(text)
    fits = 1 <= len(values) <= MAX_EVENTS and min(values) > 0.0 and max(values) <= 1.0
    return values if fits else ()


class Options(Frozen):
    """Choices that the rule sets leave open."""

    statistic: Annotated[
        Statistic,
        Cell(
            "Design value statistic",
            "rule set",
            help="Rule set: the statistic that the rule set requires for this number of motions."
            f" Mean: {MEAN_WITHOUT_FACTOR_MOTIONS} motions or more.",
        ),
    ] = Statistic.RULE_SET
    peer_reviewed: Annotated[bool, Cell("Peer review", "No")] = False
    """Yes removes the lower limit on the displacement from analysis."""
    peer_reviewer: Annotated[Text, Cell("Peer reviewer", "Reviewer of record")] = ""
    """Required with peer review."""
    peer_license: Annotated[Text, Cell("Reviewer's license", "CA S0000")] = ""
    """State and number. Required with peer review."""
    peer_date: Annotated[dt.date | None, Cell("Date of review", dt.date(2026, 3, 1))] = None
    """Required with peer review."""
    directional: Annotated[bool, Cell("Displacement by direction", "No")] = False
    """No: a clearance takes the full design displacement in every direction, as the rule sets do.
    Yes: the displacement toward it, a departure that the package prints."""
    directional_reason: Annotated[
        Text, Cell("Reason for direction", "Agreed with the building department")
    ] = ""
    """Required with displacement by direction."""
    directional_reviewer: Annotated[Text, Cell("Reviewer of direction", "Reviewer of record")] = ""
    """Required with displacement by direction."""
    directional_license: Annotated[Text, Cell("License for direction", "CA S0000")] = ""
    """State and number. Required with displacement by direction."""
    directional_date: Annotated[dt.date | None, Cell("Date for direction", dt.date(2026, 3, 1))] = (
        None
    )
    """Required with displacement by direction."""
    smaller_events: Annotated[Text, Cell("Smaller events", "0.50, 0.50")] = ""
    """Up to 20 factors on the motions, each above 0.0 and up to 1.0, separated by commas: the
    package adds the displacement of these events to that of the design event, for information.
    Blank: none."""

    @property
    def smaller_factors(self) -> tuple[float, ...]:
        """Factors on the motions for the smaller events; empty if none are asked for."""
        return factors(self.smaller_events)


class Override(Frozen):
    """A replacement for the number of a provision, with the reason that the package prints."""

    provision: Annotated[
        RequiredText,
        AfterValidator(_provision_key),
        Cell("Provision", provision_name("parapet_height_in")),
    ]
    """The number to replace, from the list; the sheet Provisions has its value and clause."""
    value: Annotated[float, Cell("Value", 18.0, unit_from=("provision", _unit_of_named))]
    """In the unit stated on the sheet Provisions."""
    reason: Annotated[
        RequiredText, Cell("Reason", "Agreed with the building department, 2026-02-10")
    ]
    """Printed in the package."""


class Acknowledgment(Frozen):
    """A warning that is intended as it is, with the reason that the package prints."""

    warning: Annotated[RequiredText, Cell("Warning", "weight A1")]
    """As in the brackets that `roofslip check` prints."""
    reason: Annotated[RequiredText, Cell("Reason", "Weight of the frames alone; ballast by others")]
    """Printed in the package."""


class ProjectInput(Frozen):
    """The complete input of a workbook."""

    project: Project
    revisions: tuple[Revision, ...] = ()
    site: Site
    roof: Roof = Roof()
    arrays: tuple[Array, ...]
    friction_tests: FrictionTests = FrictionTests()
    friction_runs: tuple[FrictionTestRow, ...] = ()
    objects: tuple[RoofObject, ...] = ()
    clearances: tuple[Clearance, ...] = ()
    motions: tuple[MotionInput, ...]
    building: BuildingInput = BuildingInput()
    spectrum: tuple[SpectrumPoint, ...] = ()
    links: tuple[Links, ...] = ()
    options: Options = Options()
    target: TargetInput = TargetInput()
    overrides: tuple[Override, ...] = ()
    outlines: tuple[Vertex, ...] = ()
    layers: tuple[DrawingLayer, ...] = ()
    acknowledged: tuple[Acknowledgment, ...] = ()

    @model_validator(mode="after")
    def _spell_ids_alike(self) -> ProjectInput:
        """Spell every reference as the id it refers to: capitals do not distinguish ids."""
        ids = {row.id.casefold(): row.id for row in self.arrays}
        ids |= {row.id.casefold(): row.id for row in self.objects}

        def spelled(name: str) -> str:
            return ids.get(name.casefold(), name)

        clearances = tuple(
            row.model_copy(update={"array": spelled(row.array), "object": spelled(row.object)})
            for row in self.clearances
        )
        links = tuple(row.model_copy(update={"array": spelled(row.array)}) for row in self.links)
        object.__setattr__(self, "clearances", clearances)  # the model itself is frozen
        object.__setattr__(self, "links", links)
        corners = tuple(row.model_copy(update={"name": spelled(row.name)}) for row in self.outlines)
        object.__setattr__(self, "outlines", corners)
        return self

    @model_validator(mode="after")
    def _place(self) -> ProjectInput:
        """Give arrays, objects and the roof their outlines."""
        rings: dict[str, list[Point]] = {}
        for row in self.outlines:
            name = ROOF if row.name.casefold() == ROOF else row.name
            rings.setdefault(name, []).append((row.x_m, row.y_m))
        outlines = {name: ring(points) for name, points in rings.items()}
        for section in ("arrays", "objects"):
            placed = tuple(row.outlined(outlines.get(row.id, ())) for row in getattr(self, section))
            object.__setattr__(self, section, placed)
        object.__setattr__(self, "roof", self.roof.outlined(outlines.get(ROOF, ())))
        lost = [row.id for row in self.arrays if row.placed is None]
        if lost:
            raise ValueError(f"no rectangle and no outline of {', '.join(lost)}")
        return self


def _block(
    key: str, sheet: str, title: str, hint: str, model: type[Frozen], *, may_be_absent: bool = False
) -> SheetSection:
    return SheetSection(
        key=key,
        sheet=sheet,
        title=title,
        hint=hint,
        model=model,
        is_table=False,
        may_be_absent=may_be_absent,
    )


def _table(
    key: str, sheet: str, title: str, hint: str, model: type[Frozen], *, may_be_absent: bool = False
) -> SheetSection:
    block = _block(key, sheet, title, hint, model, may_be_absent=may_be_absent)
    return replace(block, is_table=True)


SECTIONS = (
    _block("project", "Project", "Project", "Printed on the cover and on every page.", Project),
    _table("revisions", "Project", "Revisions", "One row for each issue.", Revision),
    _block("site", "Site", "Site and building", "Give S_DS, S_MS, or S_S and F_a.", Site),
    _block(
        "roof",
        "Site",
        "Roof outline and north",
        "Optional. The plan draws the outline, and every roof edge near an array must then be an"
        " object.",
        Roof,
        may_be_absent=True,
    ),
    _table(
        "arrays",
        "Arrays",
        "Arrays",
        "One row for each array that moves as a unit. Columns to the right of Downslope direction"
        " are optional.",
        Array,
    ),
    _block(
        "friction_tests",
        "Friction tests",
        "Friction tests",
        "Optional: the report on the friction tests. Leave blank what the report does not state.",
        FrictionTests,
        may_be_absent=True,
    ),
    _table(
        "friction_runs",
        "Friction tests",
        "Runs of the friction tests",
        "Optional: one row for each run, wet and dry. The package compares the friction"
        " coefficients of the arrays with the kinetic means.",
        FrictionTestRow,
        may_be_absent=True,
    ),
    _table(
        "objects",
        "Objects",
        "Objects and roof edges",
        "One row for each object that an array could strike and each edge it could fall from. The"
        " plan rectangle is optional; enter an edge as a strip outside the roof.",
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
        "One row for each motion. Records are files beside this workbook (file, or file |"
        " channel) or columns pasted into a sheet (Sheet!Header). Columns to the right of Source"
        " are optional.",
        MotionInput,
    ),
    _block(
        "building",
        "Building",
        "Building between ground and roof",
        "Required only for ground motions: give period T1 or a structure type.",
        BuildingInput,
        may_be_absent=True,
    ),
    _table(
        "spectrum",
        "Spectrum",
        "Project-specific target spectrum",
        "Optional. Replaces the AC156 spectrum for roof motions, or the design spectrum for ground"
        " motions. 5 % damping, at least two rows.",
        SpectrumPoint,
        may_be_absent=True,
    ),
    _table(
        "links",
        "Links",
        "Rows of linked blocks",
        "Optional: one row for each array for which the package checks whether one rigid block is"
        " adequate. The blocks have equal weights and lie in a row along the slope.",
        Links,
        may_be_absent=True,
    ),
    _block("options", "Options", "Options", "The defaults suit most projects.", Options),
    _block(
        "target",
        "Options",
        "Target spectrum and scaling",
        "The default target is the AC156 spectrum for roof motions and the ASCE 7 design"
        " spectrum for ground motions.",
        TargetInput,
        may_be_absent=True,
    ),
    _table(
        "overrides",
        "Options",
        "Overrides of provisions",
        "Each is printed in the package with its reason.",
        Override,
    ),
    _table(
        "outlines",
        "Outlines",
        "Outlines",
        "Optional: arrays, objects and the roof that are no rectangles. One row for each vertex, in"
        " order around the outline; leave the four sides of the rectangle blank.",
        Vertex,
        may_be_absent=True,
    ),
    _table(
        "layers",
        "Layers",
        "Layers of the roof drawing",
        "Optional, for roofslip plan read: what is drawn on each layer. The layers of plan.dxf are"
        " known without a row.",
        DrawingLayer,
        may_be_absent=True,
    ),
    _table(
        "acknowledged",
        "Acknowledged",
        "Acknowledged warnings",
        "Optional: one row for each warning of `roofslip check` that is intended as it is. It is"
        " then printed with the reason.",
        Acknowledgment,
        may_be_absent=True,
    ),
)
