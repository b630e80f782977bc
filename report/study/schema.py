"""The study workbook as data: what is studied, with which mats, arrays, motions and buildings.

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

from report.sheet.schema.choices import (
    AccelUnit,
    Id,
    Polarity,
    Positive,
    RecordedAt,
    RequiredText,
    RuleSetName,
    Text,
    UnitsFirst,
)
from report.sheet.schema.fields import Cell, Frozen, OnSheet
from report.sheet.schema.project import FrictionTestRow
from report.text.units import Quantity
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
        """The measure without its unit."""
        return self.value.partition(" [")[0]

    @property
    def unit(self) -> str:
        """Its unit."""
        return self.value.partition(" [")[2].rstrip("]")


class NoValue(StrEnum):
    """What a run without a value counts as in a fragility."""

    EXCEEDANCE = "exceedance"
    CENSORED = "censored"


class Sampling(StrEnum):
    """How uncertain values are combined."""

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
    """What is studied."""

    title: Annotated[RequiredText, Cell("Title", "Mats of product X")]
    """Printed on the first page."""
    prepared_by: Annotated[Text, Cell("Prepared by", "RG")] = ""
    """Printed on the first page."""
    date: Annotated[dt.date, Cell("Date", dt.date(2026, 3, 1))]
    """Printed on every page."""
    units_first: Annotated[UnitsFirst, Cell("Primary units", "US")] = UnitsFirst.US
    """Units printed first."""
    slopes_deg: Annotated[RequiredText, Cell("Slopes", "0 to 7 by 1", "deg")]
    """Increasing, 0 or more: a list with a blank after each comma, or from, to and step."""
    mus: Annotated[Text, Cell("Friction coefficients", "0.3 to 0.8 by 0.05")] = ""
    """Increasing, above 0, in addition to those of the mats. Required without mats."""
    intensity: Annotated[Intensity, Cell("Intensity measure", "PPA [g]")] = Intensity.PPA
    """The motions are scaled to each intensity: PPA and PPV are peaks of the horizontal record at
    the roof, PGA of a ground motion; S_DS scales from the S_DS below."""
    intensities: Annotated[RequiredText, Cell("Intensities", "0.1 to 2 by 0.1")]
    """Increasing, above 0, given like the slopes."""
    s_ds_g: Annotated[float | None, Field(gt=0, le=5), Cell("S_DS of the motions", 1.0, "g")] = None
    """S_DS that the records represent. Required with S_DS."""
    rule_set: Annotated[RuleSetName, Cell("Rule set", "SEAOC PV1-2012")] = RuleSetName(
        "SEAOC PV1-2012"
    )
    """For the prescriptive displacement beside the curves."""
    allowed_m: Annotated[Positive | None, Cell("Allowed displacement", 24.0, Quantity.SIZE)] = None
    """Gives the least friction and the largest slope. Blank for none."""
    folder: Annotated[Text, Cell("Folder of motions", "records")] = ""
    """Every record in it is a motion; files that differ only in an ending -x, -y or -z are the
    components of one. Blank if the sheet Motions lists them."""
    units: Annotated[AccelUnit, Cell("Record units", "from file")] = AccelUnit.FROM_FILE
    """If the files do not state them."""
    dt_s: Annotated[float | None, Field(gt=0, le=1), Cell("Time step", 0.01, "s")] = None
    """If the files do not state it."""
    polarity: Annotated[Polarity, Cell("Polarity", "both")] = Polarity.BOTH
    """Signs in which each horizontal record is run."""
    recorded_at: Annotated[RecordedAt, Cell("Recorded at", "roof")] = RecordedAt.ROOF
    """Ground motions are carried through each building."""
    no_value: Annotated[NoValue, Cell("Run without a value", "exceedance")] = NoValue.EXCEEDANCE
    """Uplift, or sliding at the end of the record: counted in a fragility as an exceedance, or
    censored at that intensity."""
    site_intensity: Annotated[
        Positive | None,
        Cell(
            "Intensity at the site",
            1.0,
            unit_from=("intensity", lambda text: Intensity(text).unit if text else ""),
        ),
    ] = None
    """Median; gives the probability that a clearance is exceeded. Blank for none."""
    intensity_beta: Annotated[float, Field(ge=0, le=2), Cell("Dispersion of intensity", 0.2)] = 0.0
    """Standard deviation of its logarithm."""
    slope_tolerance_deg: Annotated[
        float, Field(ge=0, le=5), Cell("Tolerance of slope", 0.25, "deg")
    ] = 0.0
    """Half the width of a uniform distribution."""
    sampling: Annotated[Sampling, Cell("Sampling", "Latin hypercube")] = Sampling.LATIN_HYPERCUBE
    """Latin hypercube of friction, slope and intensity; or every tested friction with the slope at
    its tolerances and middle, and the median intensity."""
    samples: Annotated[int, Field(ge=10, le=5000), Cell("Samples", 200)] = 200
    """Of the Latin hypercube, each under every motion."""
    seed: Annotated[int, Field(ge=0, le=2**31), Cell("Seed", 1)] = 1
    """The same seed gives the same samples."""
    record_beta: Annotated[Dispersion | None, Cell("Record-to-record dispersion", 0.4)] = None
    """Of the exported fragilities, in place of that of the motions. Required for motions matched to
    one spectrum. Blank: that of the motions."""
    record_source: Annotated[Text, Cell("Record-to-record source", "Hazard analysis, 2026")] = ""
    """Required with the value."""
    modeling_beta: Annotated[Dispersion | None, Cell("Modeling dispersion", 0.25)] = None
    """Of the exported fragilities. FEMA P-58 has about 0.1 to 0.5. Blank: not included."""
    quality_beta: Annotated[Dispersion | None, Cell("Quality of data dispersion", 0.25)] = None
    """Of the exported fragilities. FEMA P-58 has about 0.1 to 0.5. Blank: not included."""


class Mat(Frozen):
    """A mat: its friction coefficient, or tested values."""

    id: Annotated[Id, Cell("ID", "EPDM pad")]
    """Short and unique."""
    mu: Annotated[float | None, Field(gt=0, le=2), Cell("Friction coefficient", 0.5)] = None
    """Blank: the geometric mean of the tested values."""
    tested: Annotated[Text, Cell("Tested values", "0.47, 0.50, 0.53")] = ""
    """Three or more, in any order; blank for none."""
    report: Annotated[Text, Cell("Report", "Lab 12")] = ""
    """Printed."""


class StudyArray(Frozen):
    """An array for which fragilities are made."""

    id: Annotated[Id, Cell("ID", "A1")]
    """Short and unique."""
    mat: Annotated[Id, Cell("Mat", "EPDM pad")]
    """ID on the sheet Mats."""
    slope_deg: Annotated[float, Field(ge=0, le=45), Cell("Slope", 2.0, "deg")]
    """Of the roof."""
    clearance_m: Annotated[Positive, Cell("Clearance", 24.0, Quantity.SIZE)]
    """To the nearest object or edge."""
    reaches: Annotated[Text, Cell("Object", "RTU-1")] = ""
    """What it strikes, or the edge it reaches."""


class StudyMotion(Frozen):
    """A motion of a study."""

    id: Annotated[Id, Cell("ID", "M1")]
    """Short and unique."""
    record: Annotated[RequiredText, Cell("Horizontal record", "records/m1-x.csv")]
    """A file beside this workbook, or file | channel."""
    transverse: Annotated[RequiredText | None, Cell("Transverse record", "records/m1-y.csv")] = None
    """Second horizontal component."""
    vertical: Annotated[RequiredText | None, Cell("Vertical record", "records/m1-z.csv")] = None
    """Positive upward."""
    source: Annotated[Text, Cell("Source", "Kobe 1995, JMA")] = ""
    """Event and station."""


class StudyBuilding(Frozen):
    """A building of the family through which ground motions reach the roof."""

    id: Annotated[Id, Cell("ID", "T 0.3 s")]
    """Short and unique."""
    period_s: Annotated[float, Field(gt=0, le=10), Cell("Period T1", 0.3, "s")]
    """First mode."""
    damping_percent: Annotated[float, Field(ge=1, le=50), Cell("Damping", 5.0, "%")] = 5.0
    """Of all modes."""
    stiffness_ratio: Annotated[
        float | None, Field(ge=0, le=1000), Cell("Lateral stiffness ratio", 4.0)
    ] = None
    """H sqrt(GA/EI). Blank: shear deformation only."""
    stories: Annotated[int, Field(ge=1, le=200), Cell("Stories", 1)] = 1
    """Of equal height."""


class Hazard(Frozen):
    """The hazard at the site, from which rates in years follow."""

    file: Annotated[Text, Cell("Hazard curve file", "hazard-pga.csv")] = ""
    """CSV beside this workbook: intensity and annual rate of exceedance in two columns, or as saved
    by the USGS hazard tool. Blank: the table below, or no hazard."""
    site: Annotated[Text, Cell("Site", "Los Angeles, 34.05, -118.25")] = ""
    """Of the curve: name and coordinates. Required with a curve."""
    source: Annotated[Text, Cell("Source of the curve", "USGS, nshmp-haz")] = ""
    """Who computed it. Required with a curve."""
    edition: Annotated[Text, Cell("Hazard model", "NSHM 2018, western US")] = ""
    """Name and edition. Required with a curve."""
    vs30_mps: Annotated[float | None, Field(gt=0), Cell("Vs30 of the curve", 760, "m/s")] = None
    """Required with a curve."""
    site_vs30_mps: Annotated[float | None, Field(gt=0), Cell("Vs30 of the site", 260, "m/s")] = None
    """Required with a curve."""
    site_factor: Annotated[Positive | None, Cell("Factor to the site", 1.2)] = None
    """Intensity at the site / that of the curve. Required where their Vs30 differ."""
    site_basis: Annotated[Text, Cell("Basis of this factor", "ASCE 7-16 Table 11.8-1")] = ""
    """Required with the factor."""
    roof_factor: Annotated[Positive | None, Cell("Factor to the roof", 3.0)] = None
    """Intensity at the roof / that at the site. Required with roof motions; ground motions are
    carried through the buildings."""
    roof_basis: Annotated[Text, Cell("Basis of that factor", "ASCE 7-16 13.3.1, z/h = 1")] = ""
    """Required with the factor."""
    recenter_m: Annotated[Positive | None, Cell("Re-centering above", 6.0, Quantity.SIZE)] = None
    """Distance above which an array is put back after an event, beside never and always. Blank:
    those alone."""

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

    intensity: Annotated[Positive, Cell("Intensity", 0.5)]
    """PGA or Sa(1 s) [g]: as the intensity measure."""
    annual_rate: Annotated[float, Field(ge=0), Cell("Annual rate", 0.0021)]
    """At which it is exceeded [1/year]."""


class StudyFrictionRun(FrictionTestRow):
    """One run of a friction test of a mat."""

    mat: Annotated[Id, Cell("Mat", "EPDM pad")]
    """ID on the sheet Mats."""


class StudyInput(Frozen):
    """The complete input of a study workbook."""

    study: Annotated[Study, OnSheet("Study", "Study")]
    """Fill in, then run roofslip study FOLDER."""
    mats: Annotated[tuple[Mat, ...], OnSheet("Mats", "Mats")] = ()
    """One row for each mat; optional."""
    study_arrays: Annotated[tuple[StudyArray, ...], OnSheet("Arrays", "Arrays")] = ()
    """Optional: one row for each fragility."""
    motions: Annotated[tuple[StudyMotion, ...], OnSheet("Motions", "Motions")] = ()
    """One row for each motion; leave blank if the sheet Study names a folder."""
    buildings: Annotated[tuple[StudyBuilding, ...], OnSheet("Buildings", "Buildings")] = ()
    """Only for ground motions: one row each."""
    hazard: Annotated[Hazard, OnSheet("Hazard", "Hazard at the site", may_be_absent=True)] = (
        Hazard()
    )
    """Optional: gives rates in years and the displacement of 25 years."""
    hazard_points: Annotated[
        tuple[HazardPoint, ...], OnSheet("Hazard", "Hazard curve", may_be_absent=True)
    ] = ()
    """In place of a file, from the smallest intensity."""
    friction_runs: Annotated[
        tuple[StudyFrictionRun, ...],
        OnSheet("Friction runs", "Runs of the friction tests", may_be_absent=True),
    ] = ()
    """Optional: as on the sheet Friction tests of a project, for each mat. With a hazard they take
    the place of the tested values."""

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
