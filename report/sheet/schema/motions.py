"""The roof motions, the building below them, their target spectra, and rows of linked blocks.

Read `report.sheet.schema` first. `report.motions.components` loads the motions.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Annotated

from pydantic import Field, model_validator

from report.sheet.schema.choices import (
    AccelUnit,
    Baseline,
    Id,
    Polarity,
    Positive,
    RecordedAt,
    RequiredText,
    Scaling,
    StructureType,
    Text,
    decimals,
)
from report.sheet.schema.fields import Cell, Frozen
from report.text.units import G_MPS2, Quantity
from solver.bounds import ORDINATE
from solver.friction_tests import MOST_MU
from solver.rules.hazard import Tail

if TYPE_CHECKING:
    from solver.sliding.row import BlockRow


class MotionInput(Frozen):
    """A roof motion, as requested."""

    id: Annotated[Id, Cell("ID", "M1")]
    """Short and unique, such as M1."""
    record: Annotated[RequiredText, Cell("Horizontal record", "records/m1-x.csv")]
    """A file beside this workbook, or Sheet!Header of a pasted column. If the file has several
    channels: file | channel, by name or number."""
    transverse: Annotated[RequiredText | None, Cell("Transverse record", "records/m1-y.csv")] = None
    """Second horizontal component; blank for none. Each component is run along the slope, and the
    larger displacement is used."""
    vertical: Annotated[RequiredText | None, Cell("Vertical record", "records/m1-z.csv")] = None
    """Given like the horizontal record, positive upward; blank for none."""
    units: Annotated[AccelUnit, Cell("Record units", "from file")] = AccelUnit.FROM_FILE
    """Units of all components, if the files do not state them."""
    dt_s: Annotated[
        float | None, Field(gt=0, le=1), Cell("Time step", 0.01, "s", usual=(0.001, 0.02))
    ] = None
    """Leave blank if the file states it or has a time column."""
    scaling: Annotated[Scaling, Cell("Scaling", "as recorded")] = Scaling.AS_RECORDED
    """By a factor, to a PPA (peak of the horizontal record), or to the target spectrum over the
    scaling periods on the sheet Building. All components get the same factor."""
    scale_value: Annotated[
        float | None,
        Field(gt=0, le=1000),
        Cell(
            "Factor or PPA",
            1.0,
            usual=(0.2, 5.0),
            unit_from=("scaling", lambda text: "g" if text == Scaling.PPA else ""),
        ),
    ] = None
    """The factor, or the PPA in g; blank for other types of scaling."""
    polarity: Annotated[Polarity, Cell("Polarity", "both", is_rare=True)] = Polarity.BOTH
    """Both: each horizontal component is run as recorded and reversed, and the larger displacement
    is used."""
    source: Annotated[Text, Cell("Source", "Spectrum-compatible, seed 1")] = ""
    """Event, station and processing, printed in the package."""
    recorded_at: Annotated[RecordedAt, Cell("Recorded at", "roof")] = RecordedAt.ROOF
    """Ground motions are carried to the roof by the building on the sheet Building."""
    from_s: Annotated[float | None, Field(ge=0), Cell("Start time", 2.0, "s", is_rare=True)] = None
    """Measured from the first sample; blank: first sample."""
    to_s: Annotated[float | None, Field(gt=0), Cell("End time", 40.0, "s", is_rare=True)] = None
    """Measured from the first sample; blank: last sample."""
    baseline: Annotated[Baseline, Cell("Baseline", "linear", is_rare=True)] = Baseline.NONE
    """Fitted to the acceleration and subtracted."""
    highpass_hz: Annotated[
        float | None, Field(gt=0, le=100), Cell("High-pass corner", 0.1, "Hz", is_rare=True)
    ] = None
    """Zero-phase; blank for none. Removing long periods also removes some slip; the package states
    how much."""
    lowpass_hz: Annotated[
        float | None, Field(gt=0, le=1000), Cell("Low-pass corner", 40.0, "Hz", is_rare=True)
    ] = None
    """Zero-phase; blank for none."""
    order: Annotated[int, Field(ge=2, le=12), Cell("Filter order", 4, is_rare=True)] = 4
    """Order of both filters. The power at the corner is one half."""
    new_dt_s: Annotated[
        float | None, Field(gt=0, le=1), Cell("New time step", 0.005, "s", is_rare=True)
    ] = None
    """Resampled without aliasing; blank: unchanged."""
    pad_s: Annotated[
        float | None, Field(gt=0, le=600), Cell("Zero padding", 5.0, "s", is_rare=True)
    ] = None
    """Added at the end, for the array to come to rest; blank: none."""
    event: Annotated[Text, Cell("Event", "Kobe 1995", is_rare=True)] = ""
    """Earthquake and year of a record; blank for a generated motion."""
    magnitude: Annotated[
        float | None, Field(ge=3, le=10), Cell("M", 6.9, usual=(5.0, 8.5), is_rare=True)
    ] = None
    """Moment magnitude of the event of a record."""
    distance_km: Annotated[
        float | None, Field(ge=0, le=1000), Cell("R", 7.1, "km", usual=(0.0, 150.0), is_rare=True)
    ] = None
    """Distance of the recording station from the rupture."""
    v_s30_mps: Annotated[
        float | None,
        Field(ge=50, le=3000),
        Cell("V_s30", 312.0, "m/s", usual=(150.0, 1500.0), is_rare=True),
    ] = None
    """Mean shear-wave velocity of the upper 30 m at the station."""
    drift_by: Annotated[Text, Cell("Permanent displacement by", "RG, SE", is_rare=True)] = ""
    """Only if a component ends away from where it began and the ground or the roof did so: who
    states it. With its source."""
    drift_source: Annotated[
        Text, Cell("Permanent displacement source", "GNSS at the station", is_rare=True)
    ] = ""
    """What shows that the displacement is real. Without both, a record that ends more than 0.5 m
    away is not accepted for the analysis."""

    @property
    def drift_basis(self) -> str:
        """Who states by what that a permanent displacement is real; empty unless both are given."""
        is_stated = self.drift_by and self.drift_source
        return f"{self.drift_by}, {self.drift_source}" if is_stated else ""


Period = Annotated[float, Field(gt=0, le=10)]
Percent = Annotated[float, Field(ge=1, le=50)]


class BuildingInput(Frozen):
    """An elastic building of a few modes; blank if all motions are roof motions."""

    structure: Annotated[StructureType | None, Cell("Structure type", "other")] = None
    """Gives the approximate period C_t h^x of ASCE 7, 12.8.2.1, with h from the sheet Site. Leave
    blank if period T1 is given."""
    period_s: Annotated[Period | None, Cell("Period T1", 0.62, "s", usual=(0.05, 3.0))] = None
    """First mode, from analysis or measurement. More accurate than C_t h^x, which is intended to be
    a low estimate."""
    period_2_s: Annotated[Period | None, Cell("Period T2", 0.2, "s", usual=(0.02, 1.0))] = None
    """Second mode, if known. Blank: that of a uniform beam."""
    transverse_s: Annotated[
        Period | None, Cell("Period T1, transverse", 0.55, "s", usual=(0.05, 3.0))
    ] = None
    """First mode in the direction of the transverse record. Blank: equal to T1."""
    damping_percent: Annotated[Percent, Cell("Damping", 5.0, "%", usual=(1.0, 10.0))] = 5.0
    """Damping of all modes, in percent of critical."""
    stiffness_ratio: Annotated[
        float | None, Field(ge=0, le=1000), Cell("Lateral stiffness ratio", 4.0)
    ] = None
    """H sqrt(GA/EI): 0 for shear walls, 1.5 to 6 for walls with frames, over 20 for moment frames.
    Blank: shear deformation only."""
    left_out_percent: Annotated[
        float, Field(ge=0, le=50), Cell("Modal truncation limit", 5.0, "%")
    ] = 5.0
    """Allowed effect of all neglected modes together, in percent of the peak roof acceleration."""


class TargetInput(Frozen):
    """Target spectra at long periods, and the period range over which motions are scaled."""

    tail: Annotated[Tail, Cell("AC156 below 1.3 Hz", "AC156")] = Tail.AC156
    """The line of AC156, or 1/T for periods above 0.77 s as PV1-2012 Sec. 9 permits."""
    t_l_s: Annotated[
        float | None,
        Field(gt=0, le=20),
        Cell("Long-period transition T_L", 8.0, "s", below=("site", "s_d1_g")),
    ] = None
    """ASCE 7, 11.4.6. Used with S_1 and F_v for the design spectrum of ground motions."""
    from_s: Annotated[float, Field(ge=0.02, le=10), Cell("Shortest scaling period", 0.2, "s")] = 0.2
    """For motions scaled to the target spectrum."""
    to_s: Annotated[float, Field(ge=0.02, le=10), Cell("Longest scaling period", 5.0, "s")] = 5.0
    """Long periods govern sliding: use more than 0.77 s (1.3 Hz)."""


class SpectrumPoint(Frozen):
    """A point of the project-specific target spectrum."""

    period_s: Annotated[float, Field(ge=0.001, le=1000), Cell("Period", 1.0, "s")]
    """Each period once, in any order. Interpolated on log-log axes."""
    horizontal_g: Annotated[float, Field(gt=0, le=ORDINATE.most), Cell("Horizontal", 0.8, "g")]
    """Pseudo-acceleration, 5 % damping."""
    vertical_g: Annotated[
        float | None, Field(gt=0, le=ORDINATE.most), Cell("Vertical", 0.4, "g")
    ] = None
    """In every row, or blank in every row to use AC156."""


# Fewest and most blocks of a row.
BLOCKS = (2, 20)


def coefficients(text: str) -> tuple[float, ...]:
    """Return the numbers of a list such as `0.40, 0.45, 0.50`; empty if the text is not one."""
    mus = decimals(text)
    return mus if BLOCKS[0] <= len(mus) <= BLOCKS[1] and max(mus) <= MOST_MU else ()


class Links(Frozen):
    """An array as a row of linked blocks of equal weight along the slope."""

    array: Annotated[Id, Cell("Array", "A1")]
    """ID of the array. One row for each."""
    friction: Annotated[
        str, Field(min_length=1, max_length=200), Cell("Block friction", "0.40, 0.45, 0.50")
    ]
    """2 to 20 friction coefficients separated by commas, from the upslope block to the downslope
    block. Their range must include the array's coefficient."""
    stiffness_n_per_m: Annotated[Positive, Cell("Link stiffness", 5000.0, Quantity.STIFFNESS)]
    """Axial force per unit elongation or shortening of a link."""
    damping_ratio: Annotated[float, Field(ge=0, le=1), Cell("Link damping", 0.02)] = 0.0
    """Damping ratio of one block on one link. Blank: none."""

    @model_validator(mode="after")
    def _is_row(self) -> Links:
        if not self.mus:
            raise ValueError("give the friction coefficients of 2 to 20 blocks")
        return self

    @property
    def mus(self) -> tuple[float, ...]:
        """Friction coefficient of each block, from the upslope end."""
        return coefficients(self.friction)

    def row(self, weight_n: float) -> BlockRow:
        """Return the row of an array of some weight [N]."""
        from solver.sliding.row import BlockRow  # loads the compiler, and a workbook needs none

        stiffness = self.stiffness_n_per_m * len(self.mus) * G_MPS2 / weight_n
        damping = 2.0 * self.damping_ratio * math.sqrt(stiffness)
        return BlockRow(mus=self.mus, stiffness_per_s2=stiffness, damping_per_s=damping)
