"""results.json as one model: the assessment and its evidence, with units in the keys.

Computes nothing. Read `Results`; `report.results.results_json` writes and reads it.
"""

from __future__ import annotations

from collections.abc import Mapping
from importlib.metadata import version
from itertools import starmap
from typing import Annotated, Any, ClassVar

from pydantic import BeforeValidator

from report.assessment.checks.check import sentence
from report.assessment.evidence import Evidence
from report.assessment.precheck import findings
from report.assessment.project import Assessment
from report.assessment.verdict import Verdict
from report.entities.array import ArrayResult, LowVelocityResult, array_result
from report.entities.clearance import ClearanceResult
from report.entities.evidence import (
    CumulativeResult,
    LinkedResult,
    NeighborResult,
    RemedyResult,
    UncertaintyResult,
    VariationResult,
    linked_result,
    remedy_results,
    uncertainty_result,
    variation_result,
)
from report.entities.motion import MotionResult, RecordResult, motion_result
from report.entities.requirement import (
    CheckResult,
    FindingResult,
    check_results,
    finding_results,
)
from report.entities.shown import Entity, WrittenSchema, at
from report.project.model import ProjectInput

# Raised where a key of results.json changes its name or meaning; 0.1 wrote none.
SCHEMA_VERSION = 3


class WorkbookResult(Entity):
    """The workbook that was assessed."""

    name: Annotated[str, at("path.name")]
    """Name of the file."""
    sha256: str
    """SHA-256 of the file."""


class DocumentResult(Entity):
    """A document that the workbook attaches."""

    label: str
    """Label of its cell."""
    path: str
    """Path from the folder of the workbook."""
    size: int
    """Number of bytes."""
    sha256: str
    """SHA-256 of the file."""


def _in_order(gaps: Any) -> tuple[Any, ...]:
    # The assessment has them by number, a file of results as a list.
    return tuple(gaps.values() if isinstance(gaps, Mapping) else gaps)


class LowVelocity(Entity):
    """Arrays with their low-velocity friction coefficients alone, and clearances beside them."""

    arrays: tuple[LowVelocityResult, ...]
    """Arrays whose friction depends on velocity."""
    clearances: Annotated[tuple[ClearanceResult, ...], BeforeValidator(_in_order)]
    """Clearances beside them."""


class Compared(Entity):
    """What a later revision is compared with."""

    roofslip_version: str
    """Version that wrote the file."""
    records: Annotated[tuple[RecordResult, ...], at("shaking.records")]
    """Records as read."""
    documents: Annotated[tuple[DocumentResult, ...], at("sheet.documents")] = ()
    """Documents that the workbook attaches."""
    input: Annotated[ProjectInput, at("project")]
    """Content of the workbook."""
    rule_set: Annotated[str, at("rules.name")]
    """Name of the rule set."""
    verdict: Verdict
    """Verdict on the project."""
    checks: tuple[CheckResult, ...] = ()
    """Everything that is required, satisfied or not; version 0.3 wrote none."""
    arrays: tuple[ArrayResult, ...]
    """Arrays in the order of the workbook."""
    clearances: tuple[ClearanceResult, ...]
    """Clearances in the order of the workbook."""


class Results(Compared):
    """An assessment and its evidence."""

    # Else the fields of `Compared` would be first: what a reader looks for stands at the top.
    first: ClassVar[tuple[str, ...]] = (
        "schema_version", "roofslip_version", "workbook", "records", "documents", "motions",
        "input", "s_ds_g", "sdc_is_confirmed", "rule_set", "verdict", "warnings", "findings",
    )  # fmt: skip

    schema_version: int
    """Raised where a key changes its name or meaning."""
    workbook: Annotated[WorkbookResult, at("sheet")]
    """The file that was assessed."""
    motions: tuple[MotionResult, ...]
    """Motions as run."""
    s_ds_g: Annotated[float, at("project.site.s_ds")]
    """S_DS used."""
    sdc_is_confirmed: bool
    """Whether the workbook states all that the seismic design category needs."""
    warnings: tuple[str, ...]
    """Warnings of the runs, as sentences."""
    findings: tuple[FindingResult, ...]
    """Warnings and notes on the input."""
    low_velocity: LowVelocity
    """The same with friction at low velocity alone."""
    linked: tuple[LinkedResult, ...]
    """Arrays as rows of linked blocks."""
    neighbors: tuple[NeighborResult, ...]
    """Pairs in plan that are near or have a clearance."""
    remedies: tuple[RemedyResult, ...]
    """Changes that would satisfy what is NG."""
    certainty: UncertaintyResult | None
    """Margins in friction, slope and direction; null without motions."""
    cumulative: tuple[CumulativeResult, ...]
    """Cumulative displacement; empty where it is not asked for."""
    building_variations: tuple[VariationResult, ...]
    """The governing array with the building as used, which is first, and with others; empty where
    no motion goes through the building."""


def schema() -> dict[str, Any]:
    """Return the JSON schema of results.json."""
    return Results.model_json_schema(by_alias=False, schema_generator=WrittenSchema)


def compared(assessment: Assessment) -> Compared:
    """Return what a later revision is compared with."""
    return Compared.of(assessment, **_compared(assessment))


def _compared(assessment: Assessment) -> dict[str, Any]:
    return {
        "roofslip_version": version("roofslip"),
        "arrays": tuple(array_result(assessment, item) for item in assessment.arrays),
        "checks": tuple(check_results(assessment)),
    }


def results(assessment: Assessment, evidence: Evidence) -> Results:
    """Return an assessment and its evidence as one document."""
    sheet, shaking = assessment.sheet, assessment.shaking
    return Results.of(
        assessment,
        **_compared(assessment),
        schema_version=SCHEMA_VERSION,
        motions=tuple(map(motion_result, shaking.motions, shaking.prepared)),
        sdc_is_confirmed=not assessment.project.site.sdc_lacks,
        findings=tuple(finding_results(findings(sheet, shaking), sheet.addresses)),
        linked=tuple(map(linked_result, assessment.linked)),
        warnings=tuple(
            sentence(check, assessment.project.us_first)
            for check in assessment.open
            if check.id == "runs"
        ),
        remedies=tuple(remedy_results(evidence.remedies)),
        certainty=evidence.uncertainty and uncertainty_result(evidence.uncertainty),
        cumulative=evidence.cumulative,
        building_variations=tuple(starmap(variation_result, evidence.building)),
    )
