"""The roof motions, as requested; `report.motions.components` loads them.

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
    """A roof motion, as requested."""

    id: Annotated[Id, Cell("ID", "Short and unique, such as M1.", "M1")]
    record: Annotated[
        RequiredText,
        Cell(
            "Horizontal record",
            "A file beside this workbook, or Sheet!Header of a pasted column. If the file has"
            " several channels: file | channel, by name or number.",
            "records/m1-x.csv",
        ),
    ]
    transverse: Annotated[
        RequiredText | None,
        Cell(
            "Transverse record",
            "Second horizontal component; blank for none. Each component is run along the slope,"
            " and the larger displacement is used.",
            "records/m1-y.csv",
        ),
    ] = None
    vertical: Annotated[
        RequiredText | None,
        Cell(
            "Vertical record",
            "Given like the horizontal record, positive upward; blank for none.",
            "records/m1-z.csv",
        ),
    ] = None
    units: Annotated[
        AccelUnit,
        Cell(
            "Record units", "Units of all components, if the files do not state them.", "from file"
        ),
    ] = AccelUnit.FROM_FILE
    dt_s: Annotated[
        Annotated[float, Field(gt=0, le=1)] | None,
        Cell(
            "Time step",
            "Leave blank if the file states it or has a time column.",
            0.01,
            "s",
            usual=(0.001, 0.02),
        ),
    ] = None
    scaling: Annotated[
        Scaling,
        Cell(
            "Scaling",
            "By a factor, to a PPA (peak of the horizontal record), or to the target spectrum over"
            " the scaling periods on the sheet Options. All components get the same factor.",
            "as recorded",
        ),
    ] = Scaling.AS_RECORDED
    scale_value: Annotated[
        Annotated[float, Field(gt=0, le=1000)] | None,
        Cell(
            "Factor or PPA",
            "The factor, or the PPA in g; blank for other types of scaling.",
            1.0,
            usual=(0.2, 5.0),
            unit_from=("scaling", lambda text: "g" if text == Scaling.PPA else ""),
        ),
    ] = None
    polarity: Annotated[
        Polarity,
        Cell(
            "Polarity",
            "Both: each horizontal component is run as recorded and reversed, and the larger"
            " displacement is used.",
            "both",
            is_rare=True,
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
            "Ground motions are carried to the roof by the building on the sheet Building.",
            "roof",
        ),
    ] = RecordedAt.ROOF
    from_s: Annotated[
        Annotated[float, Field(ge=0)] | None,
        Cell(
            "Start time",
            "Measured from the first sample; blank: first sample.",
            2.0,
            "s",
            is_rare=True,
        ),
    ] = None
    to_s: Annotated[
        Annotated[float, Field(gt=0)] | None,
        Cell(
            "End time",
            "Measured from the first sample; blank: last sample.",
            40.0,
            "s",
            is_rare=True,
        ),
    ] = None
    baseline: Annotated[
        Baseline,
        Cell("Baseline", "Fitted to the acceleration and subtracted.", "linear", is_rare=True),
    ] = Baseline.NONE
    highpass_hz: Annotated[
        Annotated[float, Field(gt=0, le=100)] | None,
        Cell(
            "High-pass corner",
            "Zero-phase; blank for none. Removing long periods also removes some slip; the package"
            " states how much.",
            0.1,
            "Hz",
            is_rare=True,
        ),
    ] = None
    lowpass_hz: Annotated[
        Annotated[float, Field(gt=0, le=1000)] | None,
        Cell("Low-pass corner", "Zero-phase; blank for none.", 40.0, "Hz", is_rare=True),
    ] = None
    order: Annotated[
        Annotated[int, Field(ge=2, le=12)],
        Cell(
            "Filter order",
            "Order of both filters. The power at the corner is one half.",
            4,
            is_rare=True,
        ),
    ] = 4
    new_dt_s: Annotated[
        Annotated[float, Field(gt=0, le=1)] | None,
        Cell(
            "New time step",
            "Resampled without aliasing; blank: unchanged.",
            0.005,
            "s",
            is_rare=True,
        ),
    ] = None
    pad_s: Annotated[
        Annotated[float, Field(gt=0, le=600)] | None,
        Cell(
            "Zero padding",
            "Added at the end, for the array to come to rest; blank: none.",
            5.0,
            "s",
            is_rare=True,
        ),
    ] = None
    event: Annotated[
        Text,
        Cell(
            "Event",
            "Earthquake and year of a record; blank for a generated motion.",
            "Kobe 1995",
            is_rare=True,
        ),
    ] = ""
    magnitude: Annotated[
        Annotated[float, Field(ge=3, le=10)] | None,
        Cell(
            "M", "Moment magnitude of the event of a record.", 6.9, usual=(5.0, 8.5), is_rare=True
        ),
    ] = None
    distance_km: Annotated[
        Annotated[float, Field(ge=0, le=1000)] | None,
        Cell(
            "R",
            "Distance of the recording station from the rupture.",
            7.1,
            "km",
            usual=(0.0, 150.0),
            is_rare=True,
        ),
    ] = None
    v_s30_mps: Annotated[
        Annotated[float, Field(ge=50, le=3000)] | None,
        Cell(
            "V_s30",
            "Mean shear-wave velocity of the upper 30 m at the station.",
            312.0,
            "m/s",
            usual=(150.0, 1500.0),
            is_rare=True,
        ),
    ] = None
