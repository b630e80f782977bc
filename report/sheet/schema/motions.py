"""The roof motions, as asked for; `report.sheet.records` loads them.

Read `report.sheet.schema` first.
"""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from report.sheet.fields import Cell, Frozen
from report.sheet.schema.choices import AccelUnit, Id, Polarity, RequiredText, Scaling, Text


class MotionInput(Frozen):
    """A roof motion, as asked for; `records` loads it."""

    id: Annotated[Id, Cell("ID", "Short and unique, such as M1.", "M1")]
    record: Annotated[
        RequiredText,
        Cell(
            "Horizontal record",
            "A file beside this workbook, or Sheet!Header of a pasted column.",
            "records/m1-x.csv",
        ),
    ]
    transverse: Annotated[
        RequiredText | None,
        Cell(
            "Transverse record",
            "The other horizontal component; blank for none. Each of the two is run along the"
            " slope, and the largest counts.",
            "records/m1-y.csv",
        ),
    ] = None
    vertical: Annotated[
        RequiredText | None,
        Cell(
            "Vertical record",
            "As the horizontal one, positive upwards; blank for none.",
            "records/m1-z.csv",
        ),
    ] = None
    units: Annotated[AccelUnit, Cell("Record units", "Of all components.", "g")]
    dt_s: Annotated[
        Annotated[float, Field(gt=0, le=1)] | None,
        Cell("Time step", "Leave blank where the file has a column of times.", 0.01, "s"),
    ] = None
    scaling: Annotated[
        Scaling,
        Cell(
            "Scaling",
            "As recorded, by a factor, or to a PPA: the peak of the horizontal record. One factor"
            " for all components.",
            "as recorded",
        ),
    ] = Scaling.AS_RECORDED
    scale_value: Annotated[
        Annotated[float, Field(gt=0, le=1000)] | None,
        Cell("Factor or PPA", "The factor, or the PPA in g. Blank for as recorded.", 1.0),
    ] = None
    polarity: Annotated[
        Polarity,
        Cell(
            "Polarity",
            "Both runs each horizontal component in both senses, and the largest counts.",
            "both",
        ),
    ] = Polarity.BOTH
    source: Annotated[
        Text,
        Cell(
            "Source",
            "Event, station and processing, printed in the package.",
            "Spectrum-compatible, seed 1",
        ),
    ] = ""
