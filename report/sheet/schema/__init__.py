"""The input sheet as data: what is asked, in which unit, within which range, and how it is said.

Template, reader, input echo and documentation all come from these models; values are SI. Checks
that look at more than one cell are in `checks`. Read `workbook` next.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Annotated

from pydantic import AfterValidator

from report.sheet.fields import Cell, Frozen, Section, YesNo
from report.sheet.formerly import PROVISIONS
from report.sheet.schema.building import BuildingInput, SpectrumPoint, TargetInput
from report.sheet.schema.choices import (
    MAX_TEXT,
    AccelUnit,
    Baseline,
    Direction,
    Model,
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
    TailRule,
    UnitsFirst,
)
from report.sheet.schema.links import Links, coefficients
from report.sheet.schema.motions import MotionInput
from report.sheet.schema.project import Project, Revision, Site, s_ds
from report.sheet.schema.scene import Array, Clearance, Rectangle, RoofObject, slope_rad
from solver.rules.provisions import OVERRIDABLE

__all__ = [
    "MAX_TEXT",
    "PROVISION_KEYS",
    "SECTIONS",
    "AccelUnit",
    "Array",
    "Baseline",
    "BuildingInput",
    "Clearance",
    "Direction",
    "Links",
    "Model",
    "MotionInput",
    "ObjectKind",
    "Options",
    "Override",
    "Polarity",
    "Project",
    "ProjectInput",
    "RecordedAt",
    "Rectangle",
    "Revision",
    "RiskCategory",
    "RoofObject",
    "RuleSetName",
    "Scaling",
    "Sdc",
    "Site",
    "SiteClass",
    "SlopeUnit",
    "SpectrumPoint",
    "Statistic",
    "StructureType",
    "TailRule",
    "TargetInput",
    "UnitsFirst",
    "YesNo",
    "coefficients",
    "s_ds",
    "slope_rad",
]

PROVISION_KEYS = OVERRIDABLE
"""Provisions that can be overridden, each with what it is and its unit."""


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
        RequiredText,
        AfterValidator(lambda key: PROVISIONS.get(key, key)),
        Cell("Provision", "Choose which number to replace.", "parapet_height_in"),
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
    building: BuildingInput = BuildingInput()
    spectrum: tuple[SpectrumPoint, ...] = ()
    links: tuple[Links, ...] = ()
    options: Options = Options()
    target: TargetInput = TargetInput()
    overrides: tuple[Override, ...] = ()


def _block(
    key: str, sheet: str, title: str, hint: str, model: type[Frozen], *, may_be_absent: bool = False
) -> Section:
    return Section(
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
) -> Section:
    block = _block(key, sheet, title, hint, model, may_be_absent=may_be_absent)
    return replace(block, is_table=True)


SECTIONS = (
    _block("project", "Project", "Project", "Printed on the cover and on every page.", Project),
    _table("revisions", "Project", "Revisions", "One row for each issue.", Revision),
    _block("site", "Site", "Site and building", "Give S_DS, or S_S and F_a.", Site),
    _table(
        "arrays",
        "Arrays",
        "Arrays",
        "One row for each array that moves as one. Columns behind Downslope may stay blank.",
        Array,
    ),
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
        "One row for each motion. Records lie beside this workbook (file, or file | channel), or in"
        " a sheet as columns (Sheet!Header). Columns behind Source may stay blank.",
        MotionInput,
    ),
    _block(
        "building",
        "Building",
        "Building between ground and roof",
        "Only for motions recorded on the ground: give period T1, or a structure type.",
        BuildingInput,
        may_be_absent=True,
    ),
    _table(
        "spectrum",
        "Spectrum",
        "The project's own target spectrum",
        "Optional; it replaces AC156's at the roof, or the design spectrum on the ground. 5 %"
        " damping, at least two rows.",
        SpectrumPoint,
        may_be_absent=True,
    ),
    _table(
        "links",
        "Links",
        "Rows of linked blocks",
        "Optional: one row for each array of which the package is to say whether one rigid block"
        " is enough for it. Blocks of equal weight, in a row down the slope.",
        Links,
        may_be_absent=True,
    ),
    _block("options", "Options", "Options", "The defaults suit most projects.", Options),
    _block(
        "target",
        "Options",
        "Target spectrum and scaling",
        "The target at the roof is AC156's; for ground motions the design spectrum of ASCE 7.",
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
)
