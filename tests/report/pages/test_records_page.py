"""The records with their hashes."""

from dataclasses import replace

import pytest

import scenes
from printed import printed

pytestmark = pytest.mark.quick


def test_a_record_shows_its_format_and_what_was_noted():
    done = scenes.package().assessment
    record = replace(
        done.shaking.records[0],
        component="vertical",
        name="records/a.V2A | Up",
        format="GeoNet V2A",
        npts=100,
        dt_s=0.02,
        peak_g=0.25,
        notes=("uneven times were resampled",),
    )

    def given(*files):
        return replace(done, shaking=replace(done.shaking, records=files))

    def table(*files):
        return printed(given(*files), "hashes").table("Records as read")

    made = table(record)
    assert made.cells == (("M1", "vertical", "0.2500", "records/a.V2A | Up", "ab" * 32),)
    assert made.notes == ("Every record: Format GeoNet V2A, Samples 100, Step [s] 0.02.",)
    assert printed(given(record), "records").line("M1 vertical: uneven times were resampled")
    made = table(record, replace(record, motion_id="M2", npts=200, notes=()))
    assert made.column("Samples") == ["100", "200"]
    assert made.notes[0] == "Every record: Format GeoNet V2A, Step [s] 0.02."
