"""The schema of results.json: a plain model for each kind of row, units in the keys, NaN as null.

The docstring of a field is its description in the schema. Computes nothing: `report.results.rows`
makes the rows. Read `Results`, then its rows in the modules that are imported here.
"""

from __future__ import annotations

from report.assessment.design.verdict import Verdict
from report.project.model import ProjectInput
from report.results.array_results import ArrayResult, LinkedResult
from report.results.check_results import CheckResult, FindingResult, RemedyResult
from report.results.clearance_results import ClearanceResult, LowVelocity, NeighborResult
from report.results.result_base import PrintedResult, ResultModel, Words
from report.results.source_results import DocumentResult, MotionResult, RecordResult, WorkbookResult
from report.results.uncertainty_results import CumulativeResult, UncertaintyResult, VariationResult

# Raised where a key of results.json changes its name or meaning; 0.1 wrote none.
SCHEMA_VERSION = 3


class Results(ResultModel):
    """An assessment and its evidence: the whole of results.json."""

    schema_version: int
    """Increased if the name or meaning of a key changes."""
    roofslip_version: str
    """Version that wrote the file."""
    workbook: WorkbookResult
    """The file that was assessed."""
    records: tuple[RecordResult, ...]
    """Records as read."""
    documents: tuple[DocumentResult, ...] = ()
    """Documents that the workbook attaches."""
    motions: tuple[MotionResult, ...]
    """Motions as run."""
    input: ProjectInput
    """Content of the workbook."""
    s_ds_g: float
    """S_DS used."""
    sdc_is_confirmed: bool
    """Whether the workbook contains everything needed for the seismic design category."""
    rule_set: str
    """Name of the rule set."""
    printed: PrintedResult
    """How numbers are printed."""
    verdict: Verdict
    """Verdict on the project."""
    warnings: tuple[Words, ...]
    """Warnings of the runs, as sentences."""
    findings: tuple[FindingResult, ...]
    """Warnings and notes on the input."""
    checks: tuple[CheckResult, ...] = ()
    """All requirements, satisfied or not; not written by version 0.3."""
    arrays: tuple[ArrayResult, ...]
    """Arrays in the order of the workbook."""
    clearances: tuple[ClearanceResult, ...]
    """Clearances in the order of the workbook."""
    low_velocity: LowVelocity
    """The same with low-velocity friction only."""
    linked: tuple[LinkedResult, ...]
    """Arrays as rows of linked blocks."""
    neighbors: tuple[NeighborResult, ...]
    """Pairs in plan that are near or have a clearance."""
    remedies: tuple[RemedyResult, ...]
    """Changes that would satisfy NG checks."""
    certainty: UncertaintyResult | None
    """Margins in friction, slope and direction; null without motions."""
    cumulative: tuple[CumulativeResult, ...]
    """Cumulative displacement; empty if not requested."""
    building_variations: tuple[VariationResult, ...]
    """The governing array with the building as used, which is first, and with others; empty where
    no motion goes through the building."""


class Compared(ResultModel):
    """Data that a later revision is compared with: keys of `Results`."""

    roofslip_version: str
    records: tuple[RecordResult, ...]
    documents: tuple[DocumentResult, ...] = ()
    input: ProjectInput
    rule_set: str
    verdict: Verdict
    checks: tuple[CheckResult, ...] = ()
    arrays: tuple[ArrayResult, ...]
    clearances: tuple[ClearanceResult, ...]
