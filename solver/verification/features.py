"""Every feature of the program, the checks that verify it, and the table tests that would validate.

The status of a feature is computed from the checks that ran. Read `FEATURES`, then `statuses`.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from solver.verification.evidence import CheckRow
from solver.verification.shake_table import ShakeTable
from solver.verification.table_tests import TableTest


def _no_test(_: TableTest) -> bool:
    return False


def _one_axis(test: TableTest) -> bool:
    return _has_one_coefficient(test) and not test.scene.ay_mps2.size


def _vertical(test: TableTest) -> bool:
    return _one_axis(test) and bool(test.scene.az_mps2.size)


def _two_axes(test: TableTest) -> bool:
    return _has_one_coefficient(test) and bool(test.scene.ay_mps2.size)


def _has_one_coefficient(test: TableTest) -> bool:
    return test.scene.friction.is_constant


def _static(test: TableTest) -> bool:
    return not _has_one_coefficient(test)


@dataclass(frozen=True, slots=True, kw_only=True)
class Feature:
    """What the program does, and what shows that it does it right."""

    name: str
    # ids of checks that verify it; empty if no check of the manual does
    checks: tuple[str, ...] = ()
    extra: tuple[str, ...] = ()  # ids of checks that count where they can run: they need SciPy
    # which tests of a shake table would validate it
    validated_by: Callable[[TableTest], bool] = _no_test
    only: str = ""  # what the checks do not cover, or what covers it instead


def _ids(letters: str, last: int, first: int = 1) -> tuple[str, ...]:
    return tuple(f"{letters}-{number}" for number in range(first, last + 1))


_TESTS_ONLY = "Automatic tests only"

FEATURES = (
    Feature(
        name="Sliding in one axis",
        checks=(*_ids("CF", 9), *_ids("PH", 4), "DA-1", *_ids("SY", 5)),
        validated_by=_one_axis,
    ),
    Feature(
        name="Sliding in one axis with vertical shaking",
        checks=("CF-3", "DA-1"),
        validated_by=_vertical,
    ),
    Feature(
        name="Sliding in two axes",
        checks=_ids("TA", 5),
        extra=("TA-13",),
        validated_by=_two_axes,
    ),
    Feature(name="Error bound in two axes, one coefficient", checks=("TA-11",), extra=("TA-13",)),
    Feature(
        name="Velocity-dependent friction",
        checks=("TA-6", "TA-11"),
        only="Small dependence, random pairs; no closed form",
    ),
    Feature(
        name="Static friction above kinetic",
        checks=("TA-7", "TA-8"),
        validated_by=_static,
        only="Small difference; no closed form",
    ),
    Feature(
        name="Row of linked blocks",
        checks=("TA-9",),
        only="Rows that move as one block; loaded links: automatic tests",
    ),
    Feature(name="Choice of the simplest adequate model", checks=("TA-10", "TA-12")),
    Feature(name="Uplift", checks=("DV-4",)),
    Feature(name="Tipping", checks=("DV-5",)),
    Feature(
        name="Roof motion from ground motion",
        checks=_ids("RM", 9),
        only="Elastic, uniform building; recorded ones in section 11",
    ),
    Feature(name="Response spectra", checks=("DV-6",)),
    Feature(
        name="Filters of records",
        checks=("DV-7",),
        only="Other processing: automatic tests only",
    ),
    Feature(
        name="Prescriptive displacement, value from analysis",
        checks=("DV-1", "DV-3"),
        only="Formulas; a package marks unconfirmed values",
    ),
    Feature(name="Separation, interconnection: SEAOC PV1-2012", checks=("DV-2",)),
    Feature(
        name="Separation, interconnection: ASCE 7",
        checks=("DV-8",),
        only="ASCE 7-16; 7-22 has the same numbers, not compared with its text",
    ),
    Feature(name="Comparison methods", checks=("ME-1",)),
    Feature(name="Formats of records", only=_TESTS_ONLY),
    Feature(name="Scaling and acceptance of motions", only=_TESTS_ONLY),
    Feature(name="Generated suites of motions", only=_TESTS_ONLY),
    Feature(name="Reading of workbook and roof drawing", only=_TESTS_ONLY),
    Feature(name="Gaps between outlines", only=_TESTS_ONLY),
    Feature(
        name="Text and tables of a package",
        only=f"{_TESTS_ONLY}; verify-package repeats a package",
    ),
    Feature(name="Studies, fragilities and their exports", only=_TESTS_ONLY),
)


@dataclass(frozen=True, slots=True, kw_only=True)
class FeatureStatus:
    """What the checks and the tests of one verification show of a feature."""

    feature: Feature
    ids: tuple[str, ...]  # checks that ran, by id
    n_checks: int
    n_passed: int
    missing: tuple[str, ...]  # ids of checks that verify it and did not run
    n_tests: int  # measured tests of a shake table that belong to it
    is_validated: bool  # whether those tests satisfy the acceptance

    @property
    def is_verified(self) -> bool:
        """Whether there are checks, all of them ran, and all passed."""
        return bool(self.ids) and not self.missing and self.n_passed == self.n_checks


def statuses(checks: Sequence[CheckRow], tables: Sequence[ShakeTable]) -> tuple[FeatureStatus, ...]:
    """Return the status of every feature.

    Parameters
    ----------
    checks : sequence of CheckRow
        Those that ran.
    tables : sequence of ShakeTable
        Empty if no tests were given.
    """
    return tuple(_status(feature, checks, tables) for feature in FEATURES)


def _status(
    feature: Feature, checks: Sequence[CheckRow], tables: Sequence[ShakeTable]
) -> FeatureStatus:
    ran = {row.id for row in checks}
    wanted = (*feature.checks, *(id for id in feature.extra if id in ran))
    rows = [row for row in checks if row.id in wanted]
    own = [table.of(feature.validated_by) for table in tables]
    return FeatureStatus(
        feature=feature,
        ids=tuple(id for id in wanted if id in ran),
        n_checks=len(rows),
        n_passed=sum(row.passed for row in rows),
        missing=tuple(id for id in wanted if id not in ran),
        n_tests=sum(len(table.runs) for table in own if table.is_measured),
        is_validated=any(table.validates for table in own),
    )
