"""An assessment with the marks of its numbers. Computes nothing. Read `Marked`."""

from __future__ import annotations

import math
from dataclasses import dataclass

from report.assessment.assessment import Assessment
from report.assessment.checks.check import dagger
from report.assessment.design.arrays import ArrayAssessment, DesignBasis
from report.assessment.design.clearances import ClearanceCheck
from report.assessment.design.routes import SEAOC
from report.project.model import ProjectInput
from report.text.unit_format import UnitFormat
from report.text.units import Quantity, no_less
from solver.rules.provisions import PrescriptiveBasis

UNVERIFIED = (
    "Numbers marked † have not been compared with the text of the adopted document and shall be "
    "verified against it"
)


def joined(marks: str, more: str) -> str:
    """Return marks, each once."""
    # A displacement and what follows from it may rest on one override.
    return marks if more in marks else marks + more


@dataclass(frozen=True, kw_only=True)
class Marked:
    """An assessment with the marks of its numbers and its system of units."""

    assessment: Assessment
    # Whether numbers that were not compared with the adopted document are marked.
    has_daggers: bool = True

    @property
    def data(self) -> ProjectInput:
        """The input."""
        return self.assessment.project

    @property
    def fmt(self) -> UnitFormat:
        """Format of values."""
        return UnitFormat(us_first=self.data.us_first)

    def both(self, value_si: float, quantity: str = "DISPLACEMENT") -> str:
        """Return a value in both systems of units: `81.6 in (2072 mm)`."""
        return self.fmt.both(value_si, Quantity[quantity])

    def both_up(self, value_si: float, quantity: str = "DISPLACEMENT") -> str:
        """Return what is required, or what a requirement follows from, rounded up."""
        return self.fmt.both(value_si, Quantity[quantity], no_less)

    def mark(self, key: str) -> str:
        """Return the marks of a provision."""
        marks = dagger(self.assessment.rules.values[key])
        return marks if self.has_daggers else marks.removeprefix("†")

    @property
    def mark_of_seaoc(self) -> str:
        """The mark of the displacement by SEAOC PV1."""
        is_known = SEAOC.values["prescriptive_factor_in"].verified or not self.has_daggers
        return "" if is_known else "†"

    def clause(self, key: str) -> str:
        """Return the clause of a provision with its marks."""
        return self.assessment.rules.values[key].clause + self.mark(key)

    def prescriptive_key(self, array: ArrayAssessment) -> str:
        """Return which provision the prescriptive displacement comes from."""
        return {
            PrescriptiveBasis.FORMULA: "prescriptive_factor_in",
            PrescriptiveBasis.MINIMUM: "prescriptive_minimum_in",
            PrescriptiveBasis.LOW_CATEGORY: "prescriptive_low_sdc_in",
        }[array.prescriptive.governs]

    def design_mark(self, array: ArrayAssessment) -> str:
        """Return the marks of a design displacement."""
        if math.isnan(array.design_m):
            return ""
        if array.governs is DesignBasis.PRESCRIPTIVE:
            return joined(self.mark(self.prescriptive_key(array)), array.overridden.design)
        # A number is marked by the provision that it comes from, not by all that were compared.
        key = "analysis_floor" if array.governs is DesignBasis.FLOOR else "analysis_factor"
        return joined(self.mark(key), array.overridden.design)

    def prescriptive_mark(self, array: ArrayAssessment) -> str:
        """Return the marks of the prescriptive displacement."""
        mark = array.prescriptive_mark("§") if self.has_daggers else array.prescriptive_mark()
        return joined(self.mark(self.prescriptive_key(array)), mark)

    def floor_mark(self, array: ArrayAssessment) -> str:
        """Return the marks of the floor of an array, if it has one."""
        if self.data.is_peer_reviewed:
            return ""
        return joined(self.mark("analysis_floor"), array.overridden.floor)

    def required_mark(self, gap: ClearanceCheck) -> str:
        """Return the marks of a required separation."""
        # Where the minimum governs, the number that is marked is the minimum.
        least = self.mark("separation_edge_min_in") if gap.is_minimum_value else ""
        return joined(least, gap.mark)
