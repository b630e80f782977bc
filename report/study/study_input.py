"""The study workbook as data: scope, mats, arrays, motions and buildings.

Template, reader and messages come from these models; values are SI. Checks that involve more than
one cell are in `read`. Read `StudyInput` first.
"""

from __future__ import annotations

import datetime as dt
import itertools
import math
import re
from enum import StrEnum
from functools import lru_cache
from typing import Annotated

from pydantic import Field

from report.project.model.choices import AccelUnit, Polarity, RecordedAt, RuleSetName, UnitsFirst
from report.project.model.friction_report import FrictionTestRow
from report.project.model.values import Frozen, Id, Positive, RequiredText, Text
from report.text.units import NO_BREAK
from solver.friction_tests import FrictionRun, Series, Surface, series
from solver.studies.uncertainty import Spread, spread_of_tests

# Most values of one axis of a grid.
MOST_VALUES = 500

# Most runs and most cases of a study.
MOST_RUNS = 2_000_000_000
MOST_CASES = 2_000_000

# Most samples of all records, which are held in memory.
MOST_SAMPLES = 30_000_000

# From here on a site is rock: the boundary of site classes B and C (ASCE 7-22, Table 20.2-1).
ROCK_VS30_MPS = 760.0

_STEPS = re.compile(r"(\S+)\s+to\s+(\S+)\s+by\s+(\S+)")


class Intensity(StrEnum):
    """Measure of intensity, with its unit."""

    PPA = "PPA [g]"
    PPV = "PPV [m/s]"
    PGA = "PGA [g]"
    SA1 = "Sa(1 s) [g]"
    S_DS = "S_DS [g]"

    @property
    def letters(self) -> str:
        """The measure without its unit, as pages have it."""
        return f"Sa(1{NO_BREAK}s)" if self is Intensity.SA1 else self.value.partition(" [")[0]

    @property
    def unit(self) -> str:
        """Its unit."""
        return self.value.partition(" [")[2].rstrip("]")

    @property
    def heading(self) -> str:
        """The measure with its unit, as pages have it."""
        return f"{self.letters} [{self.unit}]"


class NoValue(StrEnum):
    """Treatment of a run without a value in a fragility."""

    EXCEEDANCE = "exceedance"
    CENSORED = "censored"


class Sampling(StrEnum):
    """Method of combining uncertain values."""

    LATIN_HYPERCUBE = "Latin hypercube"
    ALL_COMBINATIONS = "all combinations"


@lru_cache(maxsize=64)
def values(text: str) -> tuple[float, ...]:
    """Return the numbers of `0, 1, 2.5` or `0 to 7 by 0.5`, increasing; empty if it is neither."""
    try:
        if steps := _STEPS.fullmatch(text.strip()):
            low, high, step = map(float, steps.groups())
            count = (high - low) / step if step > 0.0 else -1.0
            # From 0 to 7 by 2 ends at no step.
            if not 0.0 <= count < MOST_VALUES or abs(count - round(count)) > 1e-6:
                return ()
            # As typed: 0.1 times 3 is to be 0.3, which names a row of the tables.
            return tuple(float(f"{low + step * k:.12g}") for k in range(round(count) + 1))
        # A comma needs a blank after it, so that a decimal comma never splits a number.
        numbers = [float(part) for part in re.split(r";\s*|,\s+", text.strip())]
    except ValueError:
        return ()
    is_row = all(first < second for first, second in itertools.pairwise(numbers))
    return tuple(numbers) if is_row and len(numbers) <= MOST_VALUES else ()


def tested(text: str) -> tuple[float, ...]:
    """Return tested values in any order; empty if they are none."""
    parts = [part.strip() for part in text.replace(";", ", ").split(", ") if part.strip()]
    try:
        return tuple(float(part) for part in parts)
    except ValueError:
        return ()


Dispersion = Annotated[float, Field(gt=0, le=2)]


class Study(Frozen):
    """Scope of a study."""

    title: RequiredText
    prepared_by: Text = ""
    date: dt.date
    units_first: UnitsFirst = UnitsFirst.US
    slopes_deg: RequiredText
    mus: Text = ""
    intensity: Intensity = Intensity.PPA
    intensities: RequiredText
    s_ds_g: Annotated[float | None, Field(gt=0, le=5)] = None
    rule_set: RuleSetName = RuleSetName("SEAOC PV1-2012")
    allowed_m: Positive | None = None
    folder: Text = ""
    units: AccelUnit = AccelUnit.FROM_FILE
    dt_s: Annotated[float | None, Field(gt=0, le=1)] = None
    polarity: Polarity = Polarity.BOTH
    recorded_at: RecordedAt = RecordedAt.ROOF
    no_value: NoValue = NoValue.EXCEEDANCE
    site_intensity: Positive | None = None
    intensity_beta: Annotated[float, Field(ge=0, le=2)] = 0.0
    slope_tolerance_deg: Annotated[float, Field(ge=0, le=5)] = 0.0
    sampling: Sampling = Sampling.LATIN_HYPERCUBE
    samples: Annotated[int, Field(ge=10, le=5000)] = 200
    seed: Annotated[int, Field(ge=0, le=2**31)] = 1
    record_beta: Dispersion | None = None
    record_source: Text = ""
    modeling_beta: Dispersion | None = None
    quality_beta: Dispersion | None = None


class Mat(Frozen):
    """A mat: its friction coefficient, or tested values."""

    id: Id
    mu: Annotated[float | None, Field(gt=0, le=2)] = None
    tested: Text = ""
    report: Text = ""


class StudyArray(Frozen):
    """An array with fragilities."""

    id: Id
    mat: Id
    slope_deg: Annotated[float, Field(ge=0, le=45)]
    clearance_m: Positive
    reaches: Text = ""


class StudyMotion(Frozen):
    """A motion of a study."""

    id: Id
    record: RequiredText
    transverse: RequiredText | None = None
    vertical: RequiredText | None = None
    source: Text = ""


class StudyBuilding(Frozen):
    """A building of the family through which ground motions reach the roof."""

    id: Id
    period_s: Annotated[float, Field(gt=0, le=10)]
    damping_percent: Annotated[float, Field(ge=1, le=50)] = 5.0
    stiffness_ratio: Annotated[float | None, Field(ge=0, le=1000)] = None
    stories: Annotated[int, Field(ge=1, le=200)] = 1


class Hazard(Frozen):
    """The hazard at the site, for annual rates."""

    file: Text = ""
    site: Text = ""
    source: Text = ""
    edition: Text = ""
    vs30_mps: Annotated[float | None, Field(gt=0)] = None
    site_vs30_mps: Annotated[float | None, Field(gt=0)] = None
    site_factor: Positive | None = None
    site_basis: Text = ""
    roof_factor: Positive | None = None
    roof_basis: Text = ""
    recenter_m: Positive | None = None

    @property
    def factor(self) -> float:
        """From the intensity of the curve to that of the motions."""
        return (self.site_factor or 1.0) * (self.roof_factor or 1.0)

    @property
    def is_rock(self) -> bool:
        """Whether the curve is for rock: the boundary of site classes B and C, or stiffer."""
        return (self.vs30_mps or 0.0) >= ROCK_VS30_MPS


class HazardPoint(Frozen):
    """A point of the hazard curve."""

    intensity: Positive
    annual_rate: Annotated[float, Field(ge=0)]


class StudyFrictionRun(FrictionTestRow):
    """One run of a friction test of a mat."""

    mat: Id


class StudyInput(Frozen):
    """The complete input of a study workbook."""

    study: Study
    mats: tuple[Mat, ...] = ()
    study_arrays: tuple[StudyArray, ...] = ()
    motions: tuple[StudyMotion, ...] = ()
    buildings: tuple[StudyBuilding, ...] = ()
    hazard: Hazard = Hazard()
    hazard_points: tuple[HazardPoint, ...] = ()
    friction_runs: tuple[StudyFrictionRun, ...] = ()

    @property
    def slopes_deg(self) -> tuple[float, ...]:
        """Slopes of the grid [deg]."""
        return values(self.study.slopes_deg)

    @property
    def intensities(self) -> tuple[float, ...]:
        """Intensities of the grid."""
        return values(self.study.intensities)

    @property
    def mus(self) -> tuple[float, ...]:
        """Friction coefficients of the grid: those listed, and those of the mats."""
        of_mats = {self.friction(mat.id).center for mat in self.mats}
        return tuple(sorted({*values(self.study.mus), *of_mats}))

    def friction(self, mat_id: str) -> Spread:
        """Return the distribution of the friction coefficient of a mat."""
        mat = self._mat(mat_id)
        tests = tested(mat.tested)
        if not tests:
            return Spread(center=float(mat.mu or 0.0))
        # Six digits, as pages and files print it: a coefficient is then named alike everywhere.
        spread = spread_of_tests(tests)
        return Spread(center=mat.mu or float(f"{spread.center:.6g}"), beta=spread.beta)

    def tests(self, mat_id: str) -> tuple[float, ...]:
        """Return the tested values of a mat, or its coefficient alone."""
        mat = self._mat(mat_id)
        return tested(mat.tested) or (float(mat.mu or 0.0),)

    def surfaces(self, mat_id: str) -> tuple[Series, ...]:
        """Return the runs of a mat by report and surface; without any, its tested values."""
        mat = self._mat(mat_id)
        runs = [run for run in self.friction_runs if run.mat.casefold() == mat_id.casefold()]
        if runs:
            return series(run.run(mat.report) for run in runs)
        # Tested values have no velocity and no breakaway coefficient.
        nan = math.nan
        return series(
            FrictionRun(report=mat.report, surface=Surface.DRY, velocity_mps=nan, mu=mu,
                        mu_static=nan)
            for mu in tested(mat.tested)
        )  # fmt: skip

    def _mat(self, mat_id: str) -> Mat:
        return next(row for row in self.mats if row.id.casefold() == mat_id.casefold())
