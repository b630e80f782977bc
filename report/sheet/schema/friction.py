"""Friction tests: the report, and the runs as they are pasted from it.

Read `report.sheet.schema` first; `solver.friction_tests` takes the means and fits the law.
"""

from __future__ import annotations

import datetime as dt
import math
from typing import Annotated

from pydantic import Field

from report.sheet.schema.choices import Id, NotNegative, Text
from report.sheet.schema.fields import Cell, Frozen
from report.words.units import Quantity
from solver.friction_tests import MOST_MU, FrictionRun, Surface

Mu = Annotated[float, Field(ge=0.0, le=MOST_MU)]


class FrictionTests(Frozen):
    """What the report on the friction tests states."""

    laboratory: Annotated[Text, Cell("Laboratory", "Example Laboratories")] = ""
    """Laboratory that performed the tests."""
    accreditation: Annotated[Text, Cell("Accreditation", "ISO/IEC 17025, no. 1234.01")] = ""
    """Accreditation of the laboratory."""
    standard: Annotated[Text, Cell("Standard", "ASTM G115-10")] = ""
    """Test standard."""
    report: Annotated[Text, Cell("Report number", "FT-2025-118")] = ""
    """Number of the report."""
    date: Annotated[dt.date | None, Cell("Report date", dt.date(2025, 6, 12))] = None
    """Date of the report."""
    tests_covered: Annotated[
        Text, Cell("Test report covered", "2025-06-12: Friction tests 3f2a91")
    ] = ""
    """Filled in by roofslip report: the date with a short hash of the runs. Leave blank."""
    membrane: Annotated[Text, Cell("Membrane", "TPO, 60 mil")] = ""
    """Roof surface as tested: product and thickness."""
    support: Annotated[Text, Cell("Support material", "EPDM pad")] = ""
    """Surface of the array's supports as tested."""
    report_file: Annotated[Text, Cell("Test report file", "friction-report.pdf")] = ""
    """The report as a PDF in the workbook's folder; the package attaches it. All such files: at
    most 20 MB."""


class FrictionTestRow(Frozen):
    """One run of a friction test."""

    surface: Annotated[Surface, Cell("Surface", "wet")]
    """Condition of the roof surface."""
    number: Annotated[int, Field(ge=1, le=1000), Cell("Run", 1)]
    """Number of the run."""
    mu: Annotated[Mu, Cell("Kinetic coefficient", 0.46, usual=(0.3, 0.8))]
    """Mean friction coefficient while sliding."""
    velocity_mps: Annotated[NotNegative | None, Cell("Velocity", 1.0, Quantity.VELOCITY)] = None
    """Sliding velocity. Blank: not reported."""
    mu_static: Annotated[Mu | None, Cell("Static coefficient", 0.52, usual=(0.3, 1.0))] = None
    """At breakaway. Blank: not reported."""
    report: Annotated[Id | None, Cell("Report", "FT-2025-118", is_rare=True)] = None
    """Only with runs of several reports. Blank: the report above."""

    def run(self, report: str) -> FrictionRun:
        """Return the run, of a given report unless the row names another."""
        return FrictionRun(
            report=self.report or report,
            surface=self.surface,
            velocity_mps=math.nan if self.velocity_mps is None else self.velocity_mps,
            mu=self.mu,
            mu_static=math.nan if self.mu_static is None else self.mu_static,
        )
