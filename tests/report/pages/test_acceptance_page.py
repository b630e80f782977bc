"""The part on motions states the limits on the motions, and what follows from a miss."""

import math
from dataclasses import replace

import numpy as np
import pytest
from openpyxl import Workbook

import scenes
import stand_in
from printed import printed
from report.assessment.acceptance import shaking_acceptance
from report.assessment.spectra import spectra
from report.motions.components import read_components
from report.motions.prepare import Shaking
from report.motions.targets import TargetSpectrum, targets
from report.sheet.archive import open_book
from report.sheet.schema import MotionInput, RecordedAt
from solver.records.acceptance import Acceptance
from solver.records.acceptance_row import AcceptanceRow
from solver.records.record import Record, write_record

MOTIONS = scenes.motions(3, seconds=6.0)


def found(motions, hold_s=math.nan, **changes):
    """The acceptance of motions whose files state a hold."""
    book = stand_in.book(stand_in.project(), tuple(motions))
    files = tuple(replace(file, hold_s=hold_s) for file in book.shaking.records)
    prepared = tuple(replace(given, **changes) for given in book.shaking.prepared)
    shaking = Shaking(motions=tuple(motions), prepared=prepared, records=files)
    return shaking_acceptance(shaking, targets(book.sheet.project))


def limits(given, **evidence):
    """The table of the limits, of an assessment or of other acceptance beside it."""
    if isinstance(given, Acceptance):
        given = replace(scenes.package().assessment, acceptance=given)
    return printed(given, "motions", **evidence).table("Limits on the motions")


def test_a_file_that_states_its_hold_is_generated():
    generated = found(MOTIONS, hold_s=20.0)
    titles = [row.title for row in generated.rows]
    assert "Strong motion of generated motions: hold of the envelope" in titles
    assert any("Correlation" in title for title in titles)
    assert not any("records" in title for title in titles)


def test_the_response_of_a_building_has_no_longer_the_envelope_of_its_motion():
    carried = found(MOTIONS, hold_s=20.0, recorded_at=RecordedAt.GROUND)
    assert all(not motion.is_generated for motion in carried.motions)
    assert any(row.title.startswith("Strong motion of records") for row in carried.rows)


def test_one_file_without_a_hold_makes_the_motion_a_record():
    book = stand_in.book(stand_in.project(), MOTIONS)
    first, *others = book.shaking.records
    files = (first, *(replace(file, hold_s=20.0) for file in others))
    shaking = Shaking(motions=MOTIONS, prepared=book.shaking.prepared, records=files)
    motions = shaking_acceptance(shaking, targets(book.sheet.project)).motions
    assert [motion.is_generated for motion in motions] == [False, True, True]


@pytest.mark.parametrize(("changes", "hold_s"), [({}, 20.0), ({"to_s": 5.0}, math.nan)])
def test_a_part_of_a_record_has_no_longer_its_envelope(tmp_path, changes, hold_s):
    values = np.sin(np.arange(2001) * 0.05)
    record = Record(name="x", dt_s=0.005, a_mps2=values)
    write_record(tmp_path / "x.csv", record, hold_s=20.0)
    book = Workbook()
    book.save(tmp_path / "book.xlsx")
    row = MotionInput(id="M1", record="x.csv", **changes)
    opened = open_book(tmp_path / "book.xlsx")
    (file,) = read_components(opened, 0, row.model_dump()).files
    assert file.hold_s == pytest.approx(hold_s, nan_ok=True)


def test_a_short_record_is_a_condition_and_a_missing_component_is_ng():
    bare = tuple(replace(m, ay_mps2=np.empty(0)) for m in MOTIONS)
    shown = limits(scenes.package(bare))
    strong = shown.row("Strong motion of records: D5-95 of each component")
    assert (strong["Limit value"], strong["Result"]) == ("≥ 20.0 s", "condition")
    missing = "Number of components of each motion: two horizontal and the vertical together"
    assert [*shown.row(missing).values()][1:] == ["2", "≥ 3", f"{MOTIONS[0].id}, no y", "NG"]
    assert [*shown.row("Number of motions").values()][1:] == ["3", "≥ 3", "—", "OK"]


@pytest.mark.parametrize(
    ("value", "shown", "word"),
    [(0.8999, "0.8999", "NG"), (0.899999, "0.899999", "NG"), (0.9, "0.90", "OK")],
)
def test_a_miss_never_rounds_onto_its_limit(value, shown, word):
    row = AcceptanceRow(title="Ratio", found=value, limit=0.9, is_at_least=True, worst="M1 x")
    found = limits(Acceptance(rows=(row,), motions=())).row("Ratio")
    assert [*found.values()][1:] == [shown, "≥ 0.90", "M1 x", word]


def test_only_limits_of_this_program_are_marked_as_such():
    shown = limits(scenes.package())
    marked = [title for title in shown.column("Limit") if "*" in title]
    assert len(marked) == 2
    assert all("0.1 to 1.3 Hz" in title for title in marked)
    assert "in no code" in shown.notes[0]


def test_a_spectrum_that_falls_between_the_points_of_the_limits_is_said():
    done = scenes.package().assessment
    row = AcceptanceRow(title="Spectrum / target, 1.3 to 33.3 Hz, each component", found=1.0,
                        limit=0.9, is_at_least=True, worst="M1 x")  # fmt: skip
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


def test_strong_motion_and_correlations_are_those_of_the_arrays():
    motion = scenes.motions()[0]
    row = printed(scenes.package(), "motions").table("Strong motion").row(motion.id)
    x, y = (a * motion.scale for a in (motion.ax_mps2, motion.ay_mps2))
    # pi / (2 g) times the integral of the square of straight lines between samples.
    squares = (x[:-1] ** 2 + x[:-1] * x[1:] + x[1:] ** 2) / 3.0
    arias = math.pi / (2.0 * 9.80665) * motion.dt_s * squares.sum()
    assert row["Arias intensity, m/s [x]"] == f"{arias:.2f}"
    correlation = float(row["Correlation [x-y]"].replace("−", "-"))
    assert correlation == pytest.approx(np.corrcoef(x, y)[0, 1], abs=0.005)


def test_events_are_printed_where_the_workbook_gives_any():
    plain = {"id": "M1", "record": "x.csv"}
    given = plain | {"id": "M2", "event": "Kobe 1995", "magnitude": 6.9, "v_s30_mps": 312.0}
    page = printed(scenes.package(motions=[plain, given]), "motions")
    (row,) = page.table("Events of the records").cells
    assert row == ("M2", "Kobe 1995", "6.9", "not given", "312")
    assert "Events" not in printed(scenes.package(), "motions")
