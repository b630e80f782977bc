"""The marks of the numbers of a package: † unverified, ‡ overridden, § not permitted.

A number is marked by the provision that it comes from, not by all that were compared:

    †     the floor governs, and its share of the prescriptive displacement was not verified
    †‡    and an override of the project changed it

Read `Marks`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from report.assessment.assessment import Assessment
from report.assessment.checks.check import dagger
from report.assessment.design.arrays import ArrayAssessment, DesignBasis
from report.assessment.design.clearances import ClearanceCheck
from report.assessment.design.routes import SEAOC
from solver.rules.provisions import PrescriptiveBasis

UNVERIFIED = (
    "Values marked † have not been compared with the text of the adopted document and shall be "
    "verified against it"
)


def joined(marks: str, added: str) -> str:
    """Return marks, each once."""
    # A displacement and what follows from it may rest on one override.
    return marks if added in marks else marks + added


def prescriptive_key(array: ArrayAssessment) -> str:
    """Return which provision the prescriptive displacement comes from."""
    return {
        PrescriptiveBasis.FORMULA: "prescriptive_factor_in",
        PrescriptiveBasis.MINIMUM: "prescriptive_minimum_in",
        PrescriptiveBasis.LOW_CATEGORY: "prescriptive_low_sdc_in",
    }[array.prescriptive.governs]


@dataclass(frozen=True, slots=True)
class Marks:
    """The marks of the numbers of an assessment."""

    assessment: Assessment
    # A terminal and the screen have no note at their foot that would say what a dagger means.
    has_daggers: bool = True

    def of(self, key: str) -> str:
        """Return the marks of a provision."""
        marks = dagger(self.assessment.rules.values[key])
        # An override, ‡, is kept: it is a decision of this project, and `MEANING` is printed with
        # it.
        return marks if self.has_daggers else marks.removeprefix("†")

    def clause(self, key: str) -> str:
        """Return the clause of a provision with its marks."""
        return self.assessment.rules.values[key].clause + self.of(key)

    @property
    def seaoc(self) -> str:
        """The mark of the displacement by SEAOC PV1."""
        is_known = SEAOC.values["prescriptive_factor_in"].verified or not self.has_daggers
        return "" if is_known else "†"

    def design(self, array: ArrayAssessment) -> str:
        """Return the marks of a design displacement."""
        if math.isnan(array.design_m):
            return ""
        key = {
            DesignBasis.PRESCRIPTIVE: prescriptive_key(array),
            DesignBasis.FLOOR: "analysis_floor",
        }.get(array.governs, "analysis_factor")
        return joined(self.of(key), array.overridden.design)

    def prescriptive(self, array: ArrayAssessment) -> str:
        """Return the marks of the prescriptive displacement."""
        mark = array.prescriptive_mark("§") if self.has_daggers else array.prescriptive_mark()
        return joined(self.of(prescriptive_key(array)), mark)

    def floor(self, array: ArrayAssessment) -> str:
        """Return the marks of the floor of an array, if it has one."""
        if self.assessment.project.is_peer_reviewed:
            return ""
        return joined(self.of("analysis_floor"), array.overridden.floor)

    def required(self, gap: ClearanceCheck) -> str:
        """Return the marks of a required separation."""
        # Where the minimum governs, the number that is marked is the minimum.
        minimum_mark = self.of("separation_edge_min_in") if gap.is_minimum_value else ""
        return joined(minimum_mark, gap.mark)
