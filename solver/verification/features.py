"""Every feature of the program, and the checks that verify it.

The status of a feature is computed from the checks that ran. Read `FEATURES`, then `statuses`.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from solver.verification.evidence import Verified


@dataclass(frozen=True, slots=True)
class Feature:
    """One function of the program, and the checks that verify it."""

    name: str
    # ids of checks that verify it; empty if no check of the manual does
    checks: tuple[str, ...] = ()
    extra: tuple[str, ...] = ()  # ids of checks that count where they can run: they need SciPy
    only: str = ""  # what the checks do not cover, or what covers it instead


def _ids(letters: str, last: int, first: int = 1) -> tuple[str, ...]:
    return tuple(f"{letters}-{number}" for number in range(first, last + 1))


_TESTS_ONLY = "Automatic tests only"

FEATURES = (
    Feature("Sliding in one axis", (*_ids("CF", 9), *_ids("PH", 4), "DA-1")),
    Feature("Sliding in one axis with vertical shaking", ("CF-3", "DA-1")),
    Feature("Sliding in two axes", _ids("TA", 5), extra=("TA-13",)),
    Feature("Error bound in two axes, one coefficient", ("TA-11",), extra=("TA-13",)),
    Feature(
        "Velocity-dependent friction",
        ("TA-6", "TA-11"),
        only="Small dependence, random pairs; no closed form",
    ),
    Feature(
        "Static friction above kinetic", ("TA-7", "TA-8"), only="Small difference; no closed form"
    ),
    Feature(
        "Row of linked blocks",
        ("TA-9",),
        only="Rows that move as one block; loaded links: automatic tests",
    ),
    Feature("Choice of the simplest adequate model", ("TA-10", "TA-12")),
    Feature("Uplift", ("DV-4",)),
    Feature("Tipping", ("DV-5",)),
    Feature(
        "Roof motion from ground motion",
        _ids("RM", 9),
        only="Elastic, uniform building; recorded ones in section 11",
    ),
    Feature("Response spectra", ("DV-6",)),
    Feature("Filters of records", ("DV-7",), only="Other processing: automatic tests only"),
    Feature(
        "Prescriptive displacement, analysis displacement",
        ("DV-1", "DV-3"),
        only="Formulas; a package marks unconfirmed values",
    ),
    Feature("Separation, interconnection: SEAOC PV1-2012", ("DV-2",)),
    Feature(
        "Separation, interconnection: ASCE 7",
        ("DV-8",),
        only="ASCE 7-16; 7-22 has the same numbers, not compared with its text",
    ),
    Feature(
        "Comparison methods",
        ("ME-2",),
        only="Those restarted at each sample and event; others: automatic tests",
    ),
    Feature("Formats of records", only=_TESTS_ONLY),
    Feature("Scaling and acceptance of motions", only=_TESTS_ONLY),
    Feature("Generated suites of motions", only=_TESTS_ONLY),
    Feature("Reading of workbook and roof drawing", only=_TESTS_ONLY),
    Feature("Gaps between outlines", only=_TESTS_ONLY),
    Feature(
        "Text and tables of a package", only=f"{_TESTS_ONLY}; verify-package repeats a package"
    ),
    Feature("Studies, fragilities and their exports", only=_TESTS_ONLY),
)


@dataclass(frozen=True, slots=True, kw_only=True)
class FeatureStatus:
    """Result of the checks of one verification for a feature."""

    feature: Feature
    ids: tuple[str, ...]  # checks that ran, by id
    n_checks: int
    n_passed: int
    missing: tuple[str, ...]  # ids of checks that verify it and did not run

    @property
    def is_verified(self) -> bool:
        """Whether there are checks, all of them ran, and all passed."""
        return bool(self.ids) and not self.missing and self.n_passed == self.n_checks


def statuses(checks: Sequence[Verified]) -> tuple[FeatureStatus, ...]:
    """Return the status of every feature, of the checks that ran."""
    return tuple(_status(feature, checks) for feature in FEATURES)


def _status(feature: Feature, checks: Sequence[Verified]) -> FeatureStatus:
    ran = {row.id for row in checks}
    required = (*feature.checks, *(id for id in feature.extra if id in ran))
    rows = [row for row in checks if row.id in required]
    return FeatureStatus(
        feature=feature,
        ids=tuple(id for id in required if id in ran),
        n_checks=len(rows),
        n_passed=sum(row.passed for row in rows),
        missing=tuple(id for id in required if id not in ran),
    )
