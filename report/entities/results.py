"""results.json as one model: the assessment and its evidence in SI units.

Computes nothing. Read `Results`; `report.results.json` writes it, `report.results.since` reads it.
"""

from __future__ import annotations

from importlib.metadata import version
from typing import Any, ClassVar

from report.assessment.evidence import Evidence
from report.assessment.precheck import findings
from report.assessment.project import Assessment
from report.assessment.verdict import Requirement, Verdict
from report.entities.array import ArrayResult, LowVelocityResult, array_result
from report.entities.clearance import ClearanceResult
from report.entities.evidence import (
    CumulativeResult,
    NeighborResult,
    RemedyResult,
    UncertaintyResult,
    cumulative_result,
    neighbor_result,
    remedy_result,
    uncertainty_result,
)
from report.entities.linked import LinkedResult, linked_result
from report.entities.motion import MotionResult, RecordResult, motion_result
from report.entities.requirement import (
    AcceptanceResult,
    FindingResult,
    LimitResult,
    acceptance_result,
    finding_results,
    limit_result,
)
from report.entities.shown import Entity, WrittenSchema
from report.sheet.schema import ProjectInput

SCHEMA_VERSION = 2
"""Raised where a key of results.json changes its name or meaning; 0.1 wrote none."""


class WorkbookResult(Entity):
    """The workbook that was assessed."""

    name: str
    sha256: str


class LowVelocity(Entity):
    """Arrays with their low-velocity friction coefficients alone, and clearances beside them."""

    arrays: tuple[LowVelocityResult, ...]
    clearances: tuple[ClearanceResult, ...]


class Compared(Entity):
    """What a later revision is compared with."""

    roofslip_version: str
    records: tuple[RecordResult, ...]
    input: ProjectInput
    rule_set: str
    verdict: Verdict
    requirements: tuple[Requirement, ...]
    arrays: tuple[ArrayResult, ...]
    clearances: tuple[ClearanceResult, ...]


class Results(Compared):
    """An assessment and its evidence."""

    first: ClassVar[tuple[str, ...]] = (
        "schema_version", "roofslip_version", "workbook", "records", "motions", "input", "s_ds_g",
        "sdc_is_confirmed", "rule_set", "verdict", "warnings", "findings", "building_checks",
    )  # fmt: skip

    schema_version: int
    workbook: WorkbookResult
    motions: tuple[MotionResult, ...]
    s_ds_g: float
    sdc_is_confirmed: bool
    warnings: tuple[str, ...]
    findings: tuple[FindingResult, ...]
    building_checks: tuple[LimitResult, ...]
    low_velocity: LowVelocity
    linked: tuple[LinkedResult, ...]
    acceptance: tuple[AcceptanceResult, ...]
    neighbors: tuple[NeighborResult, ...]
    remedies: tuple[RemedyResult, ...]
    certainty: UncertaintyResult
    cumulative: tuple[CumulativeResult, ...]


def schema() -> dict[str, Any]:
    """Return the JSON schema of results.json."""
    return Results.model_json_schema(by_alias=False, schema_generator=WrittenSchema)


def compared(assessment: Assessment) -> Compared:
    """Return what a later revision is compared with."""
    return Compared.of(assessment, **_compared(assessment))


def _compared(assessment: Assessment) -> dict[str, Any]:
    return {
        "roofslip_version": version("roofslip"),
        "records": assessment.shaking.records,
        "input": assessment.project,
        "rule_set": assessment.rules.name,
        "requirements": assessment.rows,
        "arrays": tuple(array_result(assessment, item) for item in assessment.arrays),
    }


def results(assessment: Assessment, evidence: Evidence) -> Results:
    """Return an assessment and its evidence as one document."""
    sheet, shaking, site = assessment.sheet, assessment.shaking, assessment.project.site
    slow = assessment.low_velocity
    return Results.of(
        assessment,
        **_compared(assessment),
        schema_version=SCHEMA_VERSION,
        workbook=WorkbookResult(name=sheet.path.name, sha256=sheet.sha256),
        motions=tuple(map(motion_result, shaking.motions, shaking.prepared)),
        s_ds_g=site.s_ds,
        sdc_is_confirmed=not site.sdc_lacks,
        findings=tuple(finding_results(findings(sheet, shaking), sheet.addresses)),
        building_checks=tuple(map(limit_result, assessment.building_checks)),
        low_velocity=LowVelocity(
            arrays=tuple(map(LowVelocityResult.of, slow.arrays)),
            clearances=tuple(map(ClearanceResult.of, slow.clearances.values())),
        ),
        linked=tuple(map(linked_result, assessment.linked)),
        acceptance=tuple(map(acceptance_result, assessment.acceptance.rows)),
        neighbors=tuple(map(neighbor_result, assessment.neighbors)),
        remedies=tuple(map(remedy_result, evidence.remedies)),
        certainty=uncertainty_result(evidence.uncertainty),
        cumulative=tuple(map(cumulative_result, evidence.cumulative)),
    )
