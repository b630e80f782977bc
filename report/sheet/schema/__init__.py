"""The input workbook as data: fields, units, allowed ranges, labels and help texts.

Template, reader and input echo all come from these models; values are SI.
"""

from __future__ import annotations

import datetime as dt
from collections.abc import Mapping, Sequence
from typing import Annotated, Any

from pydantic import AfterValidator, Field, model_validator

from report.sheet.schema.choices import (
    ClearanceSource,
    DistanceBasis,
    EditionName,
    PackageEdition,
    PlanPaper,
    RequiredText,
    RuleSetName,
    Statistic,
    Text,
    decimals,
)
from report.sheet.schema.fields import Cell, Frozen, OnSheet, SheetSection, sections_of
from report.sheet.schema.motions import (
    BuildingInput,
    Links,
    MotionInput,
    SpectrumPoint,
    TargetInput,
)
from report.sheet.schema.project import FrictionTestRow, FrictionTests, Project, Revision, Site
from report.sheet.schema.scene import ROOF, Array, Clearance, DrawingLayer, Roof, RoofObject, Vertex
from report.sheet.schema.shapes import Point, ring
from solver.rules.provisions import MEAN_WITHOUT_FACTOR_MOTIONS
from solver.rules.rulesets import ALLOWED

# Most smaller events whose displacements are added.
MAX_EVENTS = 20


def provision_name(key: str) -> str:
    """Return the name of a provision in words, as on the sheet Provisions; without its unit."""
    words = ALLOWED[key].meaning.partition(" [")[0]
    return words[:1].upper() + words[1:]


def provision_unit(key: str) -> str:
    """Return the unit of a provision, as a cell names it; empty for none."""
    allowed = ALLOWED.get(_provision_key(key))
    return allowed.meaning.partition(" [")[2].rstrip("]") if allowed else ""


_KEYS_BY_NAME = {provision_name(key).casefold(): key for key in ALLOWED}


def _provision_key(text: str) -> str:
    """Return the key of a provision given by its name or its key."""
    name = " ".join(text.partition(" [")[0].split()).casefold()
    return _KEYS_BY_NAME.get(name, text)


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
    """Yes removes the floor of the value from analysis, once the four cells below are given."""
    peer_reviewer: Annotated[Text, Cell("Peer reviewer", "Reviewer of record")] = ""
    """Required with peer review."""
    peer_license: Annotated[Text, Cell("Reviewer's license", "CA S0000")] = ""
    """State and number. Required with peer review."""
    peer_date: Annotated[dt.date | None, Cell("Date of review", dt.date(2026, 3, 1))] = None
    """Required with peer review."""
    peer_covered: Annotated[Text, Cell("Review covered", "2026-03-01: Site 3f2a91")] = ""
    """Filled in by roofslip report: date, and a hash of each sheet that the analysis rests on."""
    peer_letter: Annotated[Text, Cell("Letter of review", "peer-review.pdf")] = ""
    """PDF in the workbook's folder. Required with peer review."""
    smaller_events: Annotated[Text, Cell("Smaller events", "0.50, 0.50")] = ""
    """Up to 20 factors on the motions, above 0.0 up to 1.0, with commas: events that are added, for
    information."""
    study_years: Annotated[Text, Cell("Study of years", "years.json")] = ""
    """years.json of a study, attached; its years are printed for information."""
    package_edition: Annotated[PackageEdition, Cell("Edition", "plan check")] = (
        PackageEdition.PLAN_CHECK
    )
    """Complete adds input echo, table of spectra, histories, paths, symbols and whole hashes."""
    letter: Annotated[bool, Cell("Letter of results", "No")] = False
    """Yes: a letter to the client with the results is in the package."""
    plan_paper: Annotated[PlanPaper, Cell("Paper of the roof plan", "by size")] = PlanPaper.BY_SIZE
    """By size: Letter with US units first, A4 with SI units first; 11 x 17 in or A3 where labels
    have no room. The other sheets go with it: Letter or A4."""

    @property
    def has_review(self) -> bool:
        """Whether peer review is stated with all that a plan checker asks for."""
        given = self.peer_reviewer, self.peer_license, self.peer_date, self.peer_letter
        return self.peer_reviewed and all(given)

    @property
    def smaller_factors(self) -> tuple[float, ...]:
        """Factors on the motions for the smaller events; empty if none are asked for."""
        return factors(self.smaller_events)


class Confirmation(Frozen):
    """Who compared the provisions with the adopted code, and which."""

    by: Annotated[Text, Cell("Confirmed by", "RG, SE")] = ""
    """Name. With all five, no number of the rule set has †."""
    date: Annotated[dt.date | None, Cell("Confirmed on", dt.date(2026, 3, 1))] = None
    """When they were compared."""
    rule_set: Annotated[RuleSetName | None, Cell("Confirmed rule set", "SEAOC PV1-2012")] = None
    """Whose numbers and clauses were compared with its text."""
    edition: Annotated[EditionName | None, Cell("Confirmed edition of ASCE 7", "ASCE 7-16")] = None
    """That of the seismic parameters."""
    code: Annotated[Text, Cell("Confirmed building code", "2022 CBC")] = ""
    """Adopted code with its year, as on the sheet Site."""
    covered: Annotated[Text, Cell("Confirmation covered", "2026-03-01: Site 3f2a91")] = ""
    """Filled in by roofslip report: date, and a hash of these cells, of Site, of the overrides."""

    @property
    def of(self) -> tuple[str, str, str]:
        """What was confirmed: rule set, edition and building code."""
        return self.rule_set or "", self.edition or "", self.code


class Override(Frozen):
    """A replacement for the number of a provision, with the reason that the package prints."""

    provision: Annotated[
        RequiredText,
        AfterValidator(_provision_key),
        Cell("Provision", provision_name("parapet_height_in")),
    ]
    """The number to replace, from the list; the sheet Provisions has its value and clause."""
    value: Annotated[float, Cell("Value", 18.0, unit_from=("provision", provision_unit))]
    """In the unit stated on the sheet Provisions."""
    reason: Annotated[RequiredText, Cell("Reason", "Agreed 2026-02-10")]
    """Printed in the package."""


class Acknowledgment(Frozen):
    """A warning that is intended as it is, with the reason that the package prints."""

    warning: Annotated[RequiredText, Cell("Warning", "weight A1")]
    """As in the brackets that `roofslip check` prints."""
    reason: Annotated[RequiredText, Cell("Reason", "Weight of the frames alone; ballast by others")]
    """Printed in the package."""


# Fields that refer to arrays and objects, by section.
_NAMING = {"clearances": ("array", "object"), "links": ("array",), "outlines": ("name",)}


class ProjectInput(Frozen):
    """The complete input of a workbook."""

    project: Annotated[Project, OnSheet("Project", "Project")]
    """Printed on the cover and on every page."""
    revisions: Annotated[tuple[Revision, ...], OnSheet("Project", "Revisions")] = ()
    """One row for each issue."""
    site: Annotated[Site, OnSheet("Site", "Site and building")]
    """Give S_DS, S_MS, or S_S and F_a."""
    roof: Annotated[Roof, OnSheet("Building", "Roof outline and north", may_be_absent=True)] = (
        Roof()
    )
    """Optional. The plan draws the outline, and every roof edge near an array must then be an
    object."""
    arrays: Annotated[tuple[Array, ...], OnSheet("Arrays", "Arrays")]
    """One row for each array that moves as a unit. Columns to the right of Downslope direction are
    optional."""
    friction_tests: Annotated[
        FrictionTests, OnSheet("Friction tests", "Friction tests", may_be_absent=True)
    ] = FrictionTests()
    """Optional: the report on the friction tests. Leave blank what the report does not state."""
    friction_runs: Annotated[
        tuple[FrictionTestRow, ...],
        OnSheet("Friction tests", "Runs of the friction tests", may_be_absent=True),
    ] = ()
    """Optional: one row for each run, wet and dry. The package compares the friction coefficients
    of the arrays with the kinetic means."""
    objects: Annotated[tuple[RoofObject, ...], OnSheet("Objects", "Objects and roof edges")] = ()
    """One row for each object that an array could strike and each edge it could fall from. The plan
    rectangle is optional; enter an edge as a strip outside the roof."""
    clearances: Annotated[tuple[Clearance, ...], OnSheet("Clearances", "Clearances")] = ()
    """One row for each clearance to check; the object may be another array."""
    motions: Annotated[tuple[MotionInput, ...], OnSheet("Motions", "Roof motions")] = ()
    """One row for each motion; without any, no analysis is made. Records are files beside this
    workbook (file, or file | channel) or columns pasted into a sheet (Sheet!Header). Columns to the
    right of Source are optional."""
    building: Annotated[
        BuildingInput, OnSheet("Building", "Building between ground and roof", may_be_absent=True)
    ] = BuildingInput()
    """Required only for ground motions: give period T1 or a structure type."""
    spectrum: Annotated[
        tuple[SpectrumPoint, ...],
        OnSheet("Spectrum", "Project-specific target spectrum", may_be_absent=True),
    ] = ()
    """Optional. Replaces the AC156 spectrum for roof motions, or the design spectrum for ground
    motions. 5 % damping, at least two rows."""
    links: Annotated[
        tuple[Links, ...], OnSheet("Links", "Rows of linked blocks", may_be_absent=True)
    ] = ()
    """Optional: one row for each array for which the package checks whether one rigid block is
    adequate. The blocks have equal weights and lie in a row along the slope."""
    options: Annotated[Options, OnSheet("Options", "Options")] = Options()
    """The defaults suit most projects."""
    confirmation: Annotated[
        Confirmation, OnSheet("Options", "Confirmation of the provisions", may_be_absent=True)
    ] = Confirmation()
    """Optional. A later change of any of these, or of an override, brings the marks † back."""
    target: Annotated[
        TargetInput, OnSheet("Building", "Target spectrum and scaling", may_be_absent=True)
    ] = TargetInput()
    """The default target is the AC156 spectrum for roof motions and the ASCE 7 design spectrum for
    ground motions."""
    overrides: Annotated[tuple[Override, ...], OnSheet("Options", "Overrides of provisions")] = ()
    """Each is printed in the package with its reason."""
    outlines: Annotated[
        tuple[Vertex, ...], OnSheet("Outlines", "Outlines", may_be_absent=True)
    ] = ()
    """Optional: arrays, objects and the roof that are no rectangles. One row for each vertex, in
    order around the outline; leave the four sides of the rectangle blank."""
    layers: Annotated[
        tuple[DrawingLayer, ...],
        OnSheet("Layers", "Layers of the roof drawing", may_be_absent=True),
    ] = ()
    """Optional, for roofslip plan read: what is drawn on each layer. The layers of plan.dxf are
    known without a row."""
    acknowledged: Annotated[
        tuple[Acknowledgment, ...],
        OnSheet("Acknowledged", "Acknowledged warnings", may_be_absent=True),
    ] = ()
    """Optional: one row for each warning of `roofslip check` that is intended as it is. It is then
    printed with the reason."""
    changed_sheets: Annotated[tuple[tuple[str, str], ...], Field(exclude=True)] = ()
    """Each section whose confirmation is outdated, with the sheets that changed, in words."""

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
        """By section, in words, the sheets that have changed since its confirmation."""
        return dict(self.changed_sheets)

    @property
    def is_peer_reviewed(self) -> bool:
        """Whether a whole peer review is given, of these inputs, not dated after the package."""
        date, is_of_these = self.options.peer_date, "options" not in self.outdated
        is_dated = date is not None and date <= self.project.date
        return self.options.has_review and is_of_these and is_dated

    @property
    def confirmed(self) -> str:
        """Who confirmed the provisions of these inputs, and when; empty where nobody did."""
        confirmation = self.confirmation
        is_of_these = "confirmation" not in self.outdated and confirmation.of == self.site.adopted
        is_dated = confirmation.date is not None and confirmation.date <= self.project.date
        return f"{confirmation.by}, {confirmation.date}" if is_of_these and is_dated else ""

    def basis_of(self, row: Clearance) -> DistanceBasis:
        """Return the basis of the distance of a clearance."""
        if row.source is ClearanceSource.DRAWING:
            confirmed = self.project.drawing_confirmed_date
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
        parts[key] = tuple(_spelled(row, fields, ids) for row in getattr(data, key))

    rings: dict[str, list[Point]] = {}
    for row in parts["outlines"]:
        name = ROOF if row.name.casefold() == ROOF else row.name
        rings.setdefault(name, []).append((row.x_m, row.y_m))
    outlines = {name: ring(points) for name, points in rings.items()}
    arrays = tuple(row.outlined(outlines.get(row.id, ())) for row in data.arrays)
    parts["objects"] = tuple(item.outlined(outlines.get(item.id, ())) for item in data.objects)
    parts["roof"] = data.roof.outlined(outlines.get(ROOF, ()))
    parts["arrays"] = arrays
    if lost := [row.id for row in arrays if row.placed is None]:
        raise ValueError(f"no rectangle and no outline of {', '.join(lost)}")
    return data.model_copy(update=parts)


def _spelled(row: Frozen, fields: Sequence[str], ids: Mapping[str, str]) -> Frozen:
    names = {field: getattr(row, field) for field in fields}
    return row.model_copy(update={key: ids.get(n.casefold(), n) for key, n in names.items()})


SECTIONS = sections_of(ProjectInput)
"""Parts of the workbook, in its order."""

SECTION: Mapping[str, SheetSection] = {section.key: section for section in SECTIONS}
"""The same by key."""
