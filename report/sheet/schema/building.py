"""The building between a ground motion and its roof, and the target spectra of the motions.

Read `report.sheet.schema` first; `solver.building.roof` and `solver.records.scaling` use them.
"""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from report.sheet.schema.choices import StructureType
from report.sheet.schema.fields import Cell, Frozen
from solver.rules.spectra import Tail

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
    horizontal_g: Annotated[float, Field(gt=0, le=100), Cell("Horizontal", 0.8, "g")]
    """Pseudo-acceleration, 5 % damping."""
    vertical_g: Annotated[float | None, Field(gt=0, le=100), Cell("Vertical", 0.4, "g")] = None
    """In every row, or blank in every row to use AC156."""
