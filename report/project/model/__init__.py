"""The input of a project as plain frozen models, in SI or in the unit at the end of a name.

They contain no Excel: names and contents of cells are in `report.project.workbook`. They are
pydantic models, for `model_copy`, JSON and validated types.
"""

from __future__ import annotations

import datetime as dt
from collections.abc import Mapping
from typing import Annotated, Any

from pydantic import Field, model_validator

from report.project.model.array import Array, Links
from report.project.model.choices import ClearanceSource, DistanceBasis, PlanPaper, UnitsFirst
from report.project.model.friction_report import FrictionTestRow, FrictionTests
from report.project.model.motion_input import BuildingInput, MotionInput, SpectrumPoint, TargetInput
from report.project.model.options import Acknowledgment, Confirmation, Options
from report.project.model.overrides import Override
from report.project.model.roof import ROOF, Clearance, DrawingLayer, Roof, RoofObject, Vertex
from report.project.model.shapes import Point, Shape, ring
from report.project.model.site_input import Site
from report.project.model.values import Frozen, RequiredText, Text


class Project(Frozen):
    """Project data."""

    name: RequiredText
    number: RequiredText
    client: Text = ""
    address: Text = ""
    prepared_by: RequiredText
    checked_by: Text = ""
    firm: Text = ""
    firm_contact: Text = ""
    license: Text = ""
    date: dt.date
    revision: RequiredText
    units_first: UnitsFirst = UnitsFirst.US
    plan_number: Text = ""
    plan_date: dt.date | None = None
    drawing_confirmed_by: Text = ""
    drawing_confirmed_date: dt.date | None = None
    drawing_covered: Text = ""


class Revision(Frozen):
    """One line of the revision block."""

    revision: RequiredText
    date: dt.date
    description: RequiredText
    by: Text = ""


# Fields that refer to arrays and objects, by section.
_NAMING = {"clearances": ("array", "object"), "links": ("array",), "outlines": ("name",)}


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
    motions: tuple[MotionInput, ...] = ()
    building: BuildingInput = BuildingInput()
    spectrum: tuple[SpectrumPoint, ...] = ()
    links: tuple[Links, ...] = ()
    options: Options = Options()
    confirmation: Confirmation = Confirmation()
    target: TargetInput = TargetInput()
    overrides: tuple[Override, ...] = ()
    outlines: tuple[Vertex, ...] = ()
    layers: tuple[DrawingLayer, ...] = ()
    acknowledged: tuple[Acknowledgment, ...] = ()
    changed_sheets: Annotated[tuple[tuple[str, str], ...], Field(exclude=True)] = ()
    """Each section whose confirmation is outdated, with the changed sheets as text."""

    @model_validator(mode="after")
    def _linked(self) -> ProjectInput:
        return linked(self)

    @property
    def us_first(self) -> bool:
        """Whether US units are printed before SI units."""
        return self.project.units_first.is_us

    @property
    def is_on_a4(self) -> bool:
        """Whether the package is on A4 and A3, and not on Letter and 11 x 17 in."""
        paper = self.options.plan_paper
        if paper is PlanPaper.BY_SIZE:
            return not self.us_first
        return paper in (PlanPaper.A4, PlanPaper.A3)

    @property
    def outdated(self) -> Mapping[str, str]:
        """By section, the sheets that have changed since its confirmation, as text."""
        return dict(self.changed_sheets)

    @property
    def is_peer_reviewed(self) -> bool:
        """Whether a whole peer review is given, of these inputs, not dated after the package."""
        date, is_of_these = self.options.peer_date, "options" not in self.outdated
        is_dated = date is not None and date <= self.project.date
        return self.options.has_review and is_of_these and is_dated

    @property
    def confirmed(self) -> str:
        """Who confirmed the provisions of these inputs, and when; empty if not confirmed."""
        confirmation = self.confirmation
        is_of_these = "confirmation" not in self.outdated and confirmation.of == self.site.adopted
        is_dated = confirmation.date is not None and confirmation.date <= self.project.date
        return f"{confirmation.by}, {confirmation.date}" if is_of_these and is_dated else ""

    @property
    def shapes(self) -> dict[str, Shape]:
        """The arrays and the objects with a location in plan, by id."""
        shapes: dict[str, Shape] = {item.id: item.placed for item in self.objects if item.placed}
        return shapes | {array.id: array.shape for array in self.arrays}

    def changed(self, **sections: Any) -> ProjectInput:
        """Return the input with other sections, whose names and outlines are placed again."""
        return linked(self.model_copy(update=sections))

    def basis_of(self, row: Clearance) -> DistanceBasis:
        """Return the basis of the distance of a clearance."""
        if row.source is ClearanceSource.DRAWING:
            confirmed = self.project.drawing_confirmed_date
            # A date after that of the package is a slip of typing, and confirms nothing.
            is_confirmed = confirmed is not None and confirmed <= self.project.date
            is_confirmed &= "project" not in self.outdated
            return DistanceBasis.CONFIRMED if is_confirmed else DistanceBasis.DRAWN
        return DistanceBasis.ENTERED if row.source is None else DistanceBasis.MEASURED


def linked(data: ProjectInput) -> ProjectInput:
    """Return an input whose names are spelled as their rows are, and whose outlines are placed."""
    # Capitals do not distinguish ids.
    ids = {row.id.casefold(): row.id for row in data.arrays}
    ids |= {row.id.casefold(): row.id for row in data.objects}
    parts: dict[str, Any] = {}
    for key, fields in _NAMING.items():
        rows = []
        for row in getattr(data, key):
            names = {field: getattr(row, field) for field in fields}
            spelled = {field: ids.get(name.casefold(), name) for field, name in names.items()}
            rows.append(row.model_copy(update=spelled))
        parts[key] = tuple(rows)
    rings: dict[str, list[Point]] = {}
    for row in parts["outlines"]:
        name = ROOF if row.name.casefold() == ROOF else row.name
        rings.setdefault(name, []).append((row.x_m, row.y_m))
    outlines = {name: ring(points) for name, points in rings.items()}
    arrays = tuple(row.outlined(outlines.get(row.id, ())) for row in data.arrays)
    parts["objects"] = tuple(item.outlined(outlines.get(item.id, ())) for item in data.objects)
    parts["roof"] = data.roof.outlined(outlines.get(ROOF, ()))
    parts["arrays"] = arrays
    lost = [row.id for row in arrays if row.placed is None]
    if lost:
        raise ValueError(f"no rectangle or outline for {', '.join(lost)}")
    return data.model_copy(update=parts)
