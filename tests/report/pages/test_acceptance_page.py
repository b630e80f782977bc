"""The part on motions states the limits on the motions, and what follows from a miss."""

import math
from dataclasses import replace

import numpy as np
import pytest
from openpyxl import Workbook

import scenes
import stand_in
from printed import printed
from report.assessment.precheck import shaking_acceptance
from report.assessment.spectra import spectra
from report.motions.components import read_components
from report.motions.history import TargetSpectrum, targets
from report.sheet.reading.archive import open_book
from report.sheet.schema.choices import RecordedAt
from report.sheet.schema.motions import MotionInput
from solver.records.acceptance import Acceptance
from solver.records.record import Record, write_record
from solver.rules.limit import Limit


def limits(given, **evidence):
    """The table of the limits, of an assessment or of other acceptance beside it."""
    if isinstance(given, Acceptance):
        given = replace(scenes.package().assessment, acceptance=given)
    return printed(given, "motions", **evidence).table("Limits on the motions")


@pytest.mark.parametrize(
    ("first_hold_s", "recorded_at", "generated"),
    [
        (20.0, RecordedAt.ROOF, [True, True, True]),
        (20.0, RecordedAt.GROUND, [False, False, False]),  # the building lengthens its envelope
        (math.nan, RecordedAt.ROOF, [False, True, True]),
    ],
)
@pytest.mark.quick
def test_a_motion_is_generated_where_all_its_files_state_a_hold(
    first_hold_s, recorded_at, generated
):
    book = stand_in.book(shaking=scenes.motions(3, seconds=6.0))
    first, *others = (replace(file, hold_s=20.0) for file in book.records)
    files = (replace(first, hold_s=first_hold_s), *others)
    prepared = tuple(replace(given, recorded_at=recorded_at) for given in book.prepared)
    shaking = book.having(records=files, prepared=prepared).shaking
    accepted = shaking_acceptance(shaking, targets(book.input))
    assert [motion.is_generated for motion in accepted.motions] == generated
    titles = " ".join(row.title for row in accepted.rows)
    assert ("Strong motion of generated motions: hold of the envelope" in titles) is any(generated)
    assert ("Correlation" in titles) is any(generated)
    assert ("Strong motion of records" in titles) is not all(generated)


@pytest.mark.parametrize(("changes", "hold_s"), [({}, 20.0), ({"to_s": 5.0}, math.nan)])
@pytest.mark.quick
def test_a_part_of_a_record_has_no_longer_its_envelope(tmp_path, changes, hold_s):
    values = np.sin(np.arange(2001) * 0.05)
    record = Record(name="x", dt_s=0.005, a_mps2=values)
    write_record(tmp_path / "x.csv", record, hold_s=20.0)
    Workbook().save(tmp_path / "book.xlsx")
    row = MotionInput(id="M1", record="x.csv", **changes)
    opened = open_book(tmp_path / "book.xlsx")
    (file,) = read_components(opened, 0, row.model_dump()).files
    assert file.hold_s == pytest.approx(hold_s, nan_ok=True)


@pytest.mark.parametrize(
    ("value", "shown", "word"),
    [(0.8999, "0.8999", "NG"), (0.899999, "0.899999", "NG"), (0.9, "0.90", "OK")],
)
def test_a_miss_never_rounds_onto_its_limit(value, shown, word):
    row = Limit(title="Ratio", found=value, limit=0.9, is_at_least=True, worst="M1 x")
    made = limits(Acceptance(rows=(row,), motions=())).row("Ratio")
    assert [*made.values()][1:] == [shown, "≥ 0.90†", "M1 x", word]


def test_a_spectrum_that_falls_between_the_points_of_the_limits_is_said():
    done = scenes.package().assessment
    row = Limit(title="Each component", found=1.0, limit=0.9, is_at_least=True, worst="M1 x",
                is_ratio_to_target=True)  # fmt: skip
    given = replace(done, acceptance=Acceptance(rows=(row,), motions=()))
    part, *others = spectra(done)
    flat = TargetSpectrum(name="AC156", at=np.ones_like, from_s=0.01, to_s=10.0)
    part = replace(part, target=flat, sa_g=np.full_like(part.sa_g, 1.1))
    part.sa_g[1, 0] = 0.906

    def said(part):
        above = (replace(other, target=flat, sa_g=part.sa_g + 0.2) for other in others)
        return limits(given, spectra=(part, *above)).notes[0]

    assert said(part).endswith(
        "the smallest ratio of those shown below is 0.91 (M2, horizontal, at "
        f"{1.0 / part.periods_s[0]:.3g} Hz)."
    )
    higher = said(replace(part, sa_g=part.sa_g + 0.1))
    assert said(replace(part, is_ground=True)) == higher == said(part)[: len(higher)]


def test_events_are_printed_where_the_workbook_gives_any():
    plain = {"id": "M1", "record": "x.csv"}
    given = plain | {"id": "M2", "event": "Kobe 1995", "magnitude": 6.9, "v_s30_mps": 312.0}
    page = printed(scenes.package(motions=[plain, given]), "motions")
    (row,) = page.table("Events of the records").cells
    assert row == ("M2", "Kobe 1995", "6.9", "not given", "312")
    assert "Events" not in printed(scenes.package(), "motions")


@pytest.mark.quick
def test_a_limit_that_is_a_note_is_one_in_each_table():
    """Without an array that takes the value from analysis, what makes that value NG is a note."""
    alone = {"arrays": [stand_in.array("A1", 0.5)], "objects": [], "clearances": []}
    package = scenes.package(scenes.motions(2, 4.0), **alone)
    title = "Number of motions"
    rows = printed(package, "limits").table("Other requirements").rows
    assert [row["Verdict"] for row in rows if row["Requirement"] == title] == ["note"]
    shown = printed(package, "motions").table("Limits on the motions").rows
    assert [row["Verdict"] for row in shown if row["Limit"] == title] == ["note"]


@pytest.mark.quick
def test_friction_beyond_its_tests_has_one_verdict_in_each_table():
    """Without an array that takes the value from analysis it is a note; with one, a condition."""
    slow = [{"surface": "wet", "number": k, "mu": 0.2, "velocity_mps": 0.001} for k in range(1, 4)]
    given = {"friction_runs": slow, "objects": [], "clearances": []}
    for count, verdict in ((2, "note"), (3, "Condition")):
        arrays = [stand_in.array("A1", 0.5 if count == 2 else 2.0)]
        package = scenes.package(scenes.motions(count, 4.0), arrays=arrays, **given)
        rows = printed(package, "limits").table("Other requirements").rows
        title = "Friction beyond the velocities tested"
        listed = [row["Verdict"] for row in rows if row["Requirement"] == title]
        assert listed == ([verdict] if verdict == "note" else [])  # a condition: in the summary
        assert (title.lower() in printed(package, "summary")) is (verdict == "Condition")
        table = printed(package, "inputs").table("Friction at the sliding velocities")
        assert table.row("A1")["Verdict"] == verdict


@pytest.mark.parametrize(
    ("sources", "notes"),
    [
        ("XXX", ["Source: X."]),
        ("XYX", ["Source of M1, M3: X.", "Source of M2: Y."]),
        ("XYZ", []),
    ],
)
def test_a_source_that_motions_share_is_said_once(sources, notes):
    assessment = scenes.package().assessment
    pairs = zip(assessment.shaking.motions, sources, strict=True)
    motions = tuple(replace(motion, source=source) for motion, source in pairs)
    given = replace(assessment, shaking=replace(assessment.shaking, motions=motions))
    table = printed(given, "motions").table("Roof motions as run")
    assert list(table.notes[1:]) == notes  # below what all motions have alike
    assert ("Source" in table.headings) is (not notes)
    assert "Source" not in table.headings or table.column("Source") == list(sources)
