"""The rows of results.json on requirements, and on changes that would satisfy them."""

from __future__ import annotations

from report.assessment.checks.check import Actor
from report.assessment.design.verdict import ItemVerdict, Verdict
from report.assessment.remedies.remedy import RemedyKind
from report.project.model.finding import Level
from report.results.result_base import Number, ResultModel, Words
from solver.rules.limit import Consequence


class FindingResult(ResultModel):
    """A warning or note on the input."""

    level: Level
    """Warning or note."""
    id: str
    """Name by which a warning is acknowledged; empty if it cannot be."""
    cell: str
    """Cell of the workbook."""
    text: Words
    """What was found."""
    reason: str
    """Reason for acknowledging a warning; empty if it is not acknowledged."""


class CheckResult(ResultModel):
    """A check: one requirement, satisfied or not."""

    id: str
    """Type of check, such as `max_stories`, `clearance` or `peer_review`."""
    title: Words
    """As printed."""
    subject: str
    """Array, motion or clearance, as printed; empty for the project."""
    arrays: tuple[str, ...]
    """Ids of the arrays whose verdict it is part of."""
    found: Number
    """Value found, in the unit; null if it is text or there is no value."""
    limit: Number
    """Value required, in the unit; null if it is text."""
    unit: str
    """Unit of both; empty for a count or a ratio."""
    found_text: Words
    """As printed, in both systems of units."""
    limit_text: Words
    """As printed, with its sign."""
    note: Words
    """Location or derivation of the value found."""
    clause: Words
    """Section of the code with its mark, or whose practice it is."""
    is_satisfied: bool
    """Whether the project satisfies it."""
    consequence: Consequence
    """Consequence if it is not satisfied."""
    verdict: ItemVerdict
    """Verdict on this check alone."""
    ratio: Number
    """Demand / capacity; null for text, and if a required number is not entered."""
    actor: Actor
    """Party who must act if it is not satisfied."""
    remedy: Words
    """Action required, as a sentence; empty if it is satisfied."""
    otherwise: Words
    """Result for the project if it is not met, as a sentence."""
    cells: tuple[str, ...]
    """Cells of the workbook."""


class RemedyResult(ResultModel):
    """A change that satisfies NG checks, or changes that are sufficient together."""

    quantities: tuple[RemedyKind, ...]
    """Quantities that would have to change."""
    checks: tuple[Words, ...]
    """Checks that it satisfies, as printed."""
    change: Words
    """The change as text."""
    verdict: Verdict
    """Verdict on the project with it."""
    governing: Words
    """The verdict with the checks that then govern, as text."""
