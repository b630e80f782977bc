"""The study workbook as data: what is studied, with which mats, arrays, motions and buildings.

Template, reader and messages come from these models; values are SI. Checks that involve more than
one cell are in `read`. Read `Study` first.
"""

from __future__ import annotations

import datetime as dt
import itertools
import re
from enum import StrEnum
from typing import Annotated

from pydantic import Field

from report.sheet.fields import Cell, Frozen, SheetSection
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
from report.words.units import Quantity

MOST_VALUES = 500
"""Most values of one axis of a grid."""

MOST_RUNS = 2_000_000_000
MOST_CASES = 2_000_000
"""Most runs and most cases of a study."""

MOST_SAMPLES = 30_000_000
"""Most samples of all records, which are held in memory."""

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


def values(text: str) -> tuple[float, ...]:
    """Return the numbers of `0, 1, 2.5` or `0 to 7 by 0.5`, increasing; empty if it is neither.

    A comma needs a blank after it, so that a decimal comma never splits a number.
    """
    try:
        if steps := _STEPS.fullmatch(text.strip()):
            low, high, step = map(float, steps.groups())
            count = (high - low) / step if step > 0.0 else -1.0
            if not 0.0 <= count < MOST_VALUES or abs(count - round(count)) > 1e-6:
                return ()
            return tuple(float(f"{low + step * k:.12g}") for k in range(round(count) + 1))
        found = [float(part) for part in re.split(r";\s*|,\s+", text.strip())]
    except ValueError:
        return ()
    is_row = all(one < two for one, two in itertools.pairwise(found))
    return tuple(found) if is_row and len(found) <= MOST_VALUES else ()


Dispersion = Annotated[float, Field(gt=0, le=2)]


class Study(Frozen):
    """What is studied."""

    title: Annotated[RequiredText, Cell("Title", "Printed on the first page.", "Mats of product X")]
    prepared_by: Annotated[Text, Cell("Prepared by", "Printed on the first page.", "RG")] = ""
    date: Annotated[dt.date, Cell("Date", "Printed on every page.", dt.date(2026, 3, 1))]
    units_first: Annotated[UnitsFirst, Cell("Primary units", "Units printed first.", "US")] = (
        UnitsFirst.US
    )
    slopes_deg: Annotated[
        RequiredText,
        Cell(
            "Slopes",
            "Increasing, 0 or more: a list with a blank after each comma, or from, to and step.",
            "0 to 7 by 1",
            "deg",
        ),
    ]
    mus: Annotated[
        Text,
        Cell(
            "Friction coefficients",
            "Increasing, above 0, in addition to those of the mats. Required without mats.",
            "0.3 to 0.8 by 0.05",
        ),
    ] = ""
    intensity: Annotated[
        Intensity,
        Cell(
            "Intensity measure",
            "The motions are scaled to each intensity: PPA and PPV are peaks of the horizontal"
            " record at the roof, PGA of a ground motion; S_DS scales from the S_DS below.",
            "PPA [g]",
        ),
    ] = Intensity.PPA
    intensities: Annotated[
        RequiredText,
        Cell("Intensities", "Increasing, above 0, given like the slopes.", "0.1 to 2 by 0.1"),
    ]
    s_ds_g: Annotated[
        Annotated[float, Field(gt=0, le=5)] | None,
        Cell(
            "S_DS of the motions", "S_DS that the records represent. Required with S_DS.", 1.0, "g"
        ),
    ] = None
    rule_set: Annotated[
        RuleSetName,
        Cell("Rule set", "For the prescriptive displacement beside the curves.", "SEAOC PV1-2012"),
    ] = RuleSetName("SEAOC PV1-2012")
    allowed_m: Annotated[
        Positive | None,
        Cell(
            "Allowed displacement",
            "Gives the least friction and the largest slope. Blank for none.",
            24.0,
            Quantity.SIZE,
        ),
    ] = None
    folder: Annotated[
        Text,
        Cell(
            "Folder of motions",
            "Every record in it is a motion; files that differ only in an ending -x, -y or -z are"
            " the components of one. Blank if the sheet Motions lists them.",
            "records",
        ),
    ] = ""
    units: Annotated[
        AccelUnit, Cell("Record units", "If the files do not state them.", "from file")
    ] = AccelUnit.FROM_FILE
    dt_s: Annotated[
        Annotated[float, Field(gt=0, le=1)] | None,
        Cell("Time step", "If the files do not state it.", 0.01, "s"),
    ] = None
    polarity: Annotated[
        Polarity, Cell("Polarity", "Signs in which each horizontal record is run.", "both")
    ] = Polarity.BOTH
    recorded_at: Annotated[
        RecordedAt,
        Cell("Recorded at", "Ground motions are carried through each building.", "roof"),
    ] = RecordedAt.ROOF
    no_value: Annotated[
        NoValue,
        Cell(
            "Run without a value",
            "Uplift, or sliding at the end of the record: counted in a fragility as an exceedance,"
            " or censored at that intensity.",
            "exceedance",
        ),
    ] = NoValue.EXCEEDANCE
    site_intensity: Annotated[
        Positive | None,
        Cell(
            "Intensity at the site",
            "Median; gives the chance that a clearance is exceeded. Blank for none.",
            1.0,
            unit_from=("intensity", lambda text: Intensity(text).unit if text else ""),
        ),
    ] = None
    intensity_beta: Annotated[
        Annotated[float, Field(ge=0, le=2)],
        Cell("Dispersion of intensity", "Standard deviation of its logarithm.", 0.2),
    ] = 0.0
    slope_tolerance_deg: Annotated[
        Annotated[float, Field(ge=0, le=5)],
        Cell("Tolerance of slope", "Half the width of a uniform distribution.", 0.25, "deg"),
    ] = 0.0
    sampling: Annotated[
        Sampling,
        Cell(
            "Sampling",
            "Latin hypercube of friction, slope and intensity; or every tested friction with the"
            " slope at its tolerances and middle, and the median intensity.",
            "Latin hypercube",
        ),
    ] = Sampling.LATIN_HYPERCUBE
    samples: Annotated[
        Annotated[int, Field(ge=10, le=5000)],
        Cell("Samples", "Of the Latin hypercube, each under every motion.", 200),
    ] = 200
    seed: Annotated[
        Annotated[int, Field(ge=0, le=2**31)],
        Cell("Seed", "The same seed gives the same samples.", 1),
    ] = 1
    record_beta: Annotated[
        Dispersion | None,
        Cell(
            "Record-to-record dispersion",
            "Of the exported fragilities, in place of that of the motions. Required for motions"
            " matched to one spectrum. Blank: that of the motions.",
            0.4,
        ),
    ] = None
    record_source: Annotated[
        Text,
        Cell("Record-to-record source", "Required with the value.", "Hazard analysis, 2026"),
    ] = ""
    modeling_beta: Annotated[
        Dispersion | None,
        Cell(
            "Modeling dispersion",
            "Of the exported fragilities. FEMA P-58 has about 0.1 to 0.5. Blank: not included.",
            0.25,
        ),
    ] = None
    quality_beta: Annotated[
        Dispersion | None,
        Cell(
            "Quality of data dispersion",
            "Of the exported fragilities. FEMA P-58 has about 0.1 to 0.5. Blank: not included.",
            0.25,
        ),
    ] = None


class Mat(Frozen):
    """A mat: its friction coefficient, or tested values."""

    id: Annotated[Id, Cell("ID", "Short and unique.", "EPDM pad")]
    mu: Annotated[
        Annotated[float, Field(gt=0, le=2)] | None,
        Cell("Friction coefficient", "Blank: the geometric mean of the tested values.", 0.5),
    ] = None
    tested: Annotated[
        Text,
        Cell("Tested values", "Three or more, in any order; blank for none.", "0.47, 0.50, 0.53"),
    ] = ""
    report: Annotated[Text, Cell("Report", "Printed.", "Lab 12")] = ""


class StudyArray(Frozen):
    """An array for which fragilities are made."""

    id: Annotated[Id, Cell("ID", "Short and unique.", "A1")]
    mat: Annotated[Id, Cell("Mat", "ID on the sheet Mats.", "EPDM pad")]
    slope_deg: Annotated[
        Annotated[float, Field(ge=0, le=45)], Cell("Slope", "Of the roof.", 2.0, "deg")
    ]
    clearance_m: Annotated[
        Positive, Cell("Clearance", "To the nearest object or edge.", 24.0, Quantity.SIZE)
    ]
    reaches: Annotated[
        Text, Cell("Object", "What it strikes, or the edge it reaches.", "RTU-1")
    ] = ""


class StudyMotion(Frozen):
    """A motion of a study."""

    id: Annotated[Id, Cell("ID", "Short and unique.", "M1")]
    record: Annotated[
        RequiredText,
        Cell(
            "Horizontal record",
            "A file beside this workbook, or file | channel.",
            "records/m1-x.csv",
        ),
    ]
    transverse: Annotated[
        RequiredText | None,
        Cell("Transverse record", "Second horizontal component.", "records/m1-y.csv"),
    ] = None
    vertical: Annotated[
        RequiredText | None, Cell("Vertical record", "Positive upward.", "records/m1-z.csv")
    ] = None
    source: Annotated[Text, Cell("Source", "Event and station.", "Kobe 1995, JMA")] = ""


class StudyBuilding(Frozen):
    """A building of the family through which ground motions reach the roof."""

    id: Annotated[Id, Cell("ID", "Short and unique.", "T 0.3 s")]
    period_s: Annotated[
        Annotated[float, Field(gt=0, le=10)], Cell("Period T1", "First mode.", 0.3, "s")
    ]
    damping_percent: Annotated[
        Annotated[float, Field(ge=1, le=50)], Cell("Damping", "Of all modes.", 5.0, "%")
    ] = 5.0
    stiffness_ratio: Annotated[
        Annotated[float, Field(ge=0, le=1000)] | None,
        Cell("Lateral stiffness ratio", "H sqrt(GA/EI). Blank: shear deformation only.", 4.0),
    ] = None
    stories: Annotated[
        Annotated[int, Field(ge=1, le=200)], Cell("Stories", "Of equal height.", 1)
    ] = 1


def _section(
    key: str, sheet: str, title: str, hint: str, model: type[Frozen], *, is_table: bool = True
) -> SheetSection:
    return SheetSection(
        key=key,
        sheet=sheet,
        title=title,
        hint=hint,
        model=model,
        is_table=is_table,
        may_be_absent=False,
    )


STUDY = _section(
    "study", "Study", "Study", "Fill in, then run roofslip study FOLDER.", Study, is_table=False
)
SECTIONS = (
    STUDY,
    _section("mats", "Mats", "Mats", "One row for each mat; optional.", Mat),
    _section(
        "study_arrays", "Arrays", "Arrays", "Optional: one row for each fragility.", StudyArray
    ),
    _section(
        "motions",
        "Motions",
        "Motions",
        "One row for each motion; leave blank if the sheet Study names a folder.",
        StudyMotion,
    ),
    _section(
        "buildings",
        "Buildings",
        "Buildings",
        "Only for ground motions: one row each.",
        StudyBuilding,
    ),
)
