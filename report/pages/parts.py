"""Data that the pages of a package are made from, and texts shared by several pages.

Owns no content: see the other `report.pages` modules. Read `PackageData`.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

from markupsafe import Markup

from report.assessment.assessment import Assessment
from report.assessment.checks.sentence import alike, sentence
from report.assessment.design.verdict import Verdict
from report.assessment.revision_changes import NO_FORMER, Changes
from report.document.tables import stamp
from report.drawing.on_paper import PrintedPlan, printed_plan
from report.pages.marks import Marks
from report.project.model import ProjectInput
from report.project.model.choices import PackageEdition, RecordedAt
from report.project.model.friction_report import FrictionTests
from report.provenance.package_sources import fingerprint
from report.text.unit_format import UnitFormat
from report.text.units import no_less, no_more
from solver.rules.provisions import Basis
from solver.rules.rulesets import ALLOWED

BAR = "changed"
"""Style of what changed since a former revision: a bar in the margin."""
# Up to as many rows, eleven pairs of components, a table of motions stays on one sheet.
MOTION_ROWS = 22


def statistic(basis: Basis) -> str:
    """Return the statistic of the peaks as text."""
    return basis.value.replace(" x ", " × ")


def verdict(ok: bool, words: tuple[str, str] = ("OK", "NG")) -> Markup:
    """Return OK, or NG highlighted."""
    good, bad = words
    return stamp(Verdict.OK, good) if ok else stamp(Verdict.NG, bad)


@dataclass(frozen=True, kw_only=True)
class PackageData:
    """Everything that the pages are made from."""

    assessment: Assessment
    edition: PackageEdition
    numbers: Mapping[str, str]
    changes: Changes = NO_FORMER

    @property
    def data(self) -> ProjectInput:
        """The input."""
        return self.assessment.project

    @property
    def fmt(self) -> UnitFormat:
        """Format of values."""
        return UnitFormat(us_first=self.data.us_first)

    @property
    def marks(self) -> Marks:
        """The marks of numbers."""
        return Marks(self.assessment)

    def part(self, name: str) -> str:
        """Return the reference to a part, as in `Section 6`."""
        number = self.numbers[name]
        return f"Section {number}" if number.isdigit() else f"Appendix {number}"

    @property
    def has_ground(self) -> bool:
        """Whether any motion is given at the ground."""
        return any(row.recorded_at is RecordedAt.GROUND for row in self.data.motions)

    @property
    def mu_share(self) -> float:
        """Width of a column of friction coefficients: wide where one depends on velocity."""
        # A law by velocity prints two coefficients and a rate in one cell.
        return 2.8 if any(array.friction.is_by_velocity for array in self.data.arrays) else 0.9

    def sentences(self, id: str, arrays: Collection[str] = ()) -> Sequence[str]:
        """Return the open checks of a verdict as sentences, identical ones combined."""
        ids = set(arrays or (item.id for item in self.assessment.arrays))
        checks = self.assessment.checks
        of_kind = [c for c in checks if c.id == id and c.is_open and not ids.isdisjoint(c.arrays)]
        return [sentence(check, self.fmt.us_first) for check in alike(of_kind)]

    @cached_property
    def printed_plan(self) -> PrintedPlan:
        """The roof plan as it is placed on its sheet, which takes a while."""
        return printed_plan(self.assessment)

    @property
    def fingerprint(self) -> str:
        """Short hash of workbook, records and version, at the foot of every sheet."""
        return fingerprint(self.assessment.source, self.assessment.shaking)

    def rule_length(self, key: str) -> str:
        """Return a length of the rule set in both systems of units, with its marks."""
        show = no_more if ALLOWED[key].is_maximum else no_less
        length = self.fmt.both(self.assessment.rules.length_m(key), show=show)
        return length + self.marks.of(key)


def bar(is_changed: bool, kind: str = "") -> str:
    """Return the style of a row, with a bar in the margin where it changed."""
    return f"{kind} {BAR}".lstrip() if is_changed else kind


def all_or(ids: Sequence[str], n_arrays: int) -> str:
    """Return ids of arrays, or that these are all."""
    return "all arrays" if 1 < len(ids) == n_arrays else ", ".join(ids)


def friction_report(tests: FrictionTests) -> str:
    """Return the report on the friction tests; nothing where none is given."""
    report = f"report {tests.report}" if tests.report else ""
    parts = tests.laboratory, tests.standard, report, tests.date
    return ", ".join(str(part) for part in parts if part)
