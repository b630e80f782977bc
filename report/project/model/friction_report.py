"""The report on the friction tests, and its runs."""

from __future__ import annotations

import datetime as dt
import math
from typing import Annotated

from pydantic import Field

from report.project.model.values import Frozen, Id, NotNegative, Positive, Text
from solver.friction_tests import MOST_MU, FrictionRun, Surface

Mu = Annotated[float, Field(ge=0.0, le=MOST_MU)]


class FrictionTests(Frozen):
    """Data of the friction test report."""

    laboratory: Text = ""
    accreditation: Text = ""
    standard: Text = ""
    report: Text = ""
    date: dt.date | None = None
    tests_covered: Text = ""
    membrane: Text = ""
    support: Text = ""
    contact_pressure_pa: Positive | None = None
    report_file: Text = ""


class FrictionTestRow(Frozen):
    """One run of a friction test."""

    surface: Surface
    number: Annotated[int, Field(ge=1, le=1000)]
    mu: Mu
    velocity_mps: NotNegative | None = None
    mu_static: Mu | None = None
    report: Id | None = None

    def run(self, report: str) -> FrictionRun:
        """Return the run, of a given report unless the row names another."""
        return FrictionRun(
            report=self.report or report,
            surface=self.surface,
            # NaN, not 0: a test without a velocity is not one at rest.
            velocity_mps=math.nan if self.velocity_mps is None else self.velocity_mps,
            mu=self.mu,
            mu_static=math.nan if self.mu_static is None else self.mu_static,
        )
