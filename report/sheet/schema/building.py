"""The building between a ground motion and its roof, and the spectra that motions are held against.

Read `report.sheet.schema` first; `solver.building.roof` and `solver.records.scaling` use them.
"""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from report.sheet.fields import Cell, Frozen
from report.sheet.schema.choices import StructureType, TailRule

Period = Annotated[float, Field(gt=0, le=10)]
Percent = Annotated[float, Field(ge=1, le=50)]


class BuildingInput(Frozen):
    """An elastic building of a few modes; blank where all motions are those of the roof."""

    structure: Annotated[
        StructureType | None,
        Cell(
            "Structure type",
            "For the approximate period C_t h^x of ASCE 7, 12.8.2.1, h from the sheet Site. Blank"
            " where period T1 is given.",
            "other",
        ),
    ] = None
    period_s: Annotated[
        Period | None,
        Cell(
            "Period T1",
            "Of the first mode, from an analysis or a measurement: better than C_t h^x, which is"
            " meant to be short.",
            0.62,
            "s",
        ),
    ] = None
    period_2_s: Annotated[
        Period | None,
        Cell("Period T2", "Of the second mode, where known; blank: that of a beam.", 0.2, "s"),
    ] = None
    transverse_s: Annotated[
        Period | None,
        Cell(
            "Period T1, transverse",
            "Of the building in the direction of the transverse record; blank: the same.",
            0.55,
            "s",
        ),
    ] = None
    damping_percent: Annotated[
        Percent, Cell("Damping", "Of all modes, in percent of critical damping.", 5.0, "%")
    ] = 5.0
    stiffness_ratio: Annotated[
        Annotated[float, Field(ge=0, le=1000)] | None,
        Cell(
            "Lateral stiffness ratio",
            "H sqrt(GA/EI): 0 walls in bending, 1.5 to 6 walls with frames, over 20 frames;"
            " blank: shear alone.",
            4.0,
        ),
    ] = None
    left_out_percent: Annotated[
        Annotated[float, Field(ge=0, le=50)],
        Cell(
            "Modes may leave out",
            "All modes that are left out together, in percent of the roof's peak.",
            5.0,
            "%",
        ),
    ] = 5.0


class TargetInput(Frozen):
    """How target spectra fall at long periods, and over which periods motions are scaled."""

    tail: Annotated[
        TailRule,
        Cell(
            "AC156 below 1.3 Hz",
            "The line of AC156, or 1/T beyond 0.77 s, which PV1-2012 Sec. 9 allows.",
            "AC156",
        ),
    ] = TailRule.AC156
    t_l_s: Annotated[
        Annotated[float, Field(gt=0, le=20)] | None,
        Cell(
            "Long-period transition T_L",
            "ASCE 7, 11.4.6. For ground motions: with S_1 and F_v it gives the design spectrum.",
            8.0,
            "s",
        ),
    ] = None
    from_s: Annotated[
        Annotated[float, Field(ge=0.02, le=10)],
        Cell("Scaling periods from", "Of motions scaled to the target spectrum.", 0.2, "s"),
    ] = 0.2
    to_s: Annotated[
        Annotated[float, Field(ge=0.02, le=10)],
        Cell("Scaling periods to", "Long periods drive sliding: do not stop at 1.3 Hz.", 5.0, "s"),
    ] = 5.0


class SpectrumPoint(Frozen):
    """A point of the project's own target spectrum."""

    period_s: Annotated[
        Annotated[float, Field(ge=0.001, le=1000)],
        Cell("Period", "Each once, in any order; straight between them on log-log axes.", 1.0, "s"),
    ]
    horizontal_g: Annotated[
        Annotated[float, Field(gt=0, le=100)],
        Cell("Horizontal", "Pseudo-acceleration, 5 % damping.", 0.8, "g"),
    ]
    vertical_g: Annotated[
        Annotated[float, Field(gt=0, le=100)] | None,
        Cell("Vertical", "In every row, or blank in all: that of AC156.", 0.4, "g"),
    ] = None
