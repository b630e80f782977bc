"""The rows of results.json on what is required, and on what would satisfy it."""

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
    """Name by which a warning is acknowledged; empty where none can be."""
    cell: str
    """Cell of the workbook."""
    text: Words
    """What was found."""
    reason: str
    """Why a warning is acknowledged; empty if it is not."""


class CheckResult(ResultModel):
    """A check: everything that is required, satisfied or not."""

    id: str
    """Kind of check, such as `max_stories`, `clearance` or `peer_review`."""
    title: Words
    """As printed."""
    subject: str
    """Array, motion or clearance, as printed; empty for the project."""
    arrays: tuple[str, ...]
    """Ids of the arrays whose verdict it is part of."""
    found: Number
    """Value found, in the unit; null where it is words, or no value."""
    limit: Number
    """Value required, in the unit; null where it is words."""
    unit: str
    """Unit of both; empty for a count or a ratio."""
    found_text: Words
    """As printed, in both systems of units."""
    limit_text: Words
    """As printed, with its sign."""
    note: Words
    """Where or from what it was found."""
    clause: Words
    """Section of the code with its mark, or whose practice it is."""
    is_satisfied: bool
    """Whether the project satisfies it."""
    consequence: Consequence
    """Where it is not satisfied."""
    verdict: ItemVerdict
    """Of this check alone."""
    ratio: Number
    """Demand / capacity; null for words, and where a required number is not entered."""
    actor: Actor
    """Who must act where it is not satisfied."""
    remedy: Words
    """What they must do, as a sentence; empty where it is satisfied."""
    otherwise: Words
    """What the project comes to if it is not met, as a sentence."""
    cells: tuple[str, ...]
    """Cells of the workbook."""


class RemedyResult(ResultModel):
    """A change that satisfies checks which are NG, or changes that are enough together."""

    quantities: tuple[RemedyKind, ...]
    """What would have to change."""
    checks: tuple[Words, ...]
    """What it satisfies, as printed."""
    change: Words
    """In words."""
    verdict: Verdict
    """On the project with it."""
    governing: Words
    """The same with the checks that then govern, in words."""
