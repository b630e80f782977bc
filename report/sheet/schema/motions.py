"""The roof motions, as asked for; `report.motions.components` loads them.

Read `report.sheet.schema` first.
"""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from report.sheet.fields import Cell, Frozen
from report.sheet.schema.choices import (
    AccelUnit,
    Baseline,
    Id,
    Polarity,
    RecordedAt,
    RequiredText,
    Scaling,
    Text,
)


class MotionInput(Frozen):
    """A roof motion, as asked for; `records` loads it."""

    id: Annotated[Id, Cell("ID", "Short and unique, such as M1.", "M1")]
    record: Annotated[
        RequiredText,
        Cell(
            "Horizontal record",
            "A file beside this workbook, or Sheet!Header of a pasted column. Where a file has"
            " several channels: file | channel, its name or number.",
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
    units: Annotated[
        AccelUnit,
        Cell("Record units", "Of all components, where their files do not say.", "from file"),
    ] = AccelUnit.FROM_FILE
    dt_s: Annotated[
        Annotated[float, Field(gt=0, le=1)] | None,
        Cell("Time step", "Leave blank where the file says it or has times.", 0.01, "s"),
    ] = None
    scaling: Annotated[
        Scaling,
        Cell(
            "Scaling",
            "By a factor, to a PPA (peak of the horizontal record), or to the target spectrum over"
            " the periods of the sheet Options. One factor for all components.",
            "as recorded",
        ),
    ] = Scaling.AS_RECORDED
    scale_value: Annotated[
        Annotated[float, Field(gt=0, le=1000)] | None,
        Cell("Factor or PPA", "The factor, or the PPA in g; blank for other scalings.", 1.0),
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
    recorded_at: Annotated[
        RecordedAt,
        Cell(
            "Recorded at",
            "A motion of the ground goes to the roof through the building of the sheet Building.",
            "roof",
        ),
    ] = RecordedAt.ROOF
    from_s: Annotated[
        Annotated[float, Field(ge=0)] | None,
        Cell("Keep from", "Time from the first sample; blank: from the start.", 2.0, "s"),
    ] = None
    to_s: Annotated[
        Annotated[float, Field(gt=0)] | None,
        Cell("Keep to", "Time from the first sample; blank: to the end.", 40.0, "s"),
    ] = None
    baseline: Annotated[
        Baseline,
        Cell("Baseline", "Fitted to the acceleration and taken off.", "linear"),
    ] = Baseline.NONE
    highpass_hz: Annotated[
        Annotated[float, Field(gt=0, le=100)] | None,
        Cell(
            "High-pass corner",
            "Zero phase; blank for none. Longer periods are lost, and with them some of the slip:"
            " the package says how much.",
            0.1,
            "Hz",
        ),
    ] = None
    lowpass_hz: Annotated[
        Annotated[float, Field(gt=0, le=1000)] | None,
        Cell("Low-pass corner", "Zero phase; blank for none.", 40.0, "Hz"),
    ] = None
    order: Annotated[
        Annotated[int, Field(ge=2, le=12)],
        Cell("Filter order", "Of both filters, which have half the power at the corner.", 4),
    ] = 4
    new_dt_s: Annotated[
        Annotated[float, Field(gt=0, le=1)] | None,
        Cell("New time step", "Resampled, without aliases; blank: as it is.", 0.005, "s"),
    ] = None
    pad_s: Annotated[
        Annotated[float, Field(gt=0, le=600)] | None,
        Cell("Zeros at the end", "Time in which an array comes to rest; blank: none.", 5.0, "s"),
    ] = None
