"""The roof motions, as requested; `report.motions.components` loads them.

Read `report.sheet.schema` first.
"""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

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
from report.sheet.schema.fields import Cell, Frozen


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
