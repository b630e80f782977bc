"""Friction tests: the report, and the runs as they are pasted from it.

Read `report.sheet.schema` first; `solver.friction_tests` takes the means and fits the law.
"""

from __future__ import annotations

import datetime as dt
import math
from typing import Annotated

from pydantic import Field

from report.sheet.fields import Cell, Frozen
from report.sheet.schema.choices import Id, NotNegative, Text
from report.words.units import Quantity
from solver.friction_tests import MOST_MU, FrictionRun, Surface

Mu = Annotated[float, Field(ge=0.0, le=MOST_MU)]


class FrictionTests(Frozen):
    """What the report on the friction tests states."""

    laboratory: Annotated[
        Text, Cell("Laboratory", "Laboratory that performed the tests.", "Example Laboratories")
    ] = ""
    accreditation: Annotated[
        Text,
        Cell("Accreditation", "Accreditation of the laboratory.", "ISO/IEC 17025, no. 1234.01"),
    ] = ""
    standard: Annotated[Text, Cell("Standard", "Test standard.", "ASTM G115-10")] = ""
    report: Annotated[Text, Cell("Report number", "Number of the report.", "FT-2025-118")] = ""
    date: Annotated[
        dt.date | None, Cell("Report date", "Date of the report.", dt.date(2025, 6, 12))
    ] = None
    membrane: Annotated[
        Text, Cell("Membrane", "Roof surface as tested: product and thickness.", "TPO, 60 mil")
    ] = ""
    support: Annotated[
        Text,
        Cell("Support material", "Surface of the array's supports as tested.", "EPDM pad"),
    ] = ""


class FrictionTestRow(Frozen):
    """One run of a friction test."""

    surface: Annotated[Surface, Cell("Surface", "Condition of the roof surface.", "wet")]
    number: Annotated[Annotated[int, Field(ge=1, le=1000)], Cell("Run", "Number of the run.", 1)]
    mu: Annotated[
        Mu,
        Cell(
            "Kinetic coefficient",
            "Mean friction coefficient while sliding.",
            0.46,
            usual=(0.3, 0.8),
        ),
    ]
    velocity_mps: Annotated[
        NotNegative | None,
        Cell("Velocity", "Sliding velocity. Blank: not reported.", 1.0, Quantity.VELOCITY),
    ] = None
    mu_static: Annotated[
        Mu | None,
        Cell("Static coefficient", "At breakaway. Blank: not reported.", 0.52, usual=(0.3, 1.0)),
    ] = None
    report: Annotated[
        Id | None,
        Cell(
            "Report",
            "Only with runs of several reports. Blank: the report above.",
            "FT-2025-118",
            is_rare=True,
        ),
    ] = None

    def run(self, report: str) -> FrictionRun:
        """Return the run, of a given report unless the row names another."""
        return FrictionRun(
            report=self.report or report,
            surface=self.surface,
            velocity_mps=math.nan if self.velocity_mps is None else self.velocity_mps,
            mu=self.mu,
            mu_static=math.nan if self.mu_static is None else self.mu_static,
        )
