"""Limits on the motions, margins, and the years of a study beside the design displacement."""

import json
import math
import re
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from openpyxl import Workbook

from fixtures import assessments, project_parts, projects
from fixtures.pages import page_of
from report.assessment.checks.motion_checks import shaking_acceptance
from report.assessment.support.response_spectra import spectra
from report.assessment.support.uncertainty import uncertainty
from report.motions.components import read_components
from report.motions.history import TargetSpectrum, targets
from report.pages.registry import package_data
from report.project.model.choices import RecordedAt
from report.project.model.motion_input import MotionInput
from report.project.read.archive import open_book
from report.project.read.documents import Document, read_documents
from report.project.read.years_file import SUPPORTING, StudyYears
from report.web.views import MOST_LEVELS, levels
from solver.records.acceptance import Acceptance
from solver.records.record import Record, write_record
from solver.rules.limit import Limit


def limits(given, **evidence):
    """The table of the limits, of an assessment or of other acceptance beside it."""
    if isinstance(given, Acceptance):
        given = replace(assessments.package().assessment, acceptance=given)
    return page_of(given, "motions", **evidence).table("Limits on the motions")


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
    book = projects.book(shaking=assessments.motions(3, seconds=6.0))
    first, *others = (replace(file, hold_s=20.0) for file in book.records)
    files = (replace(first, hold_s=first_hold_s), *others)
    prepared = tuple(replace(given, recorded_at=recorded_at) for given in book.prepared)
    shaking = book.having(records=files, prepared=prepared).shaking
    accepted = shaking_acceptance(shaking, targets(book.input))
    assert [motion.is_generated for motion in accepted.motions] == generated
    titles = " ".join(row.title for row in accepted.rows)
    assert ("Strong-motion duration of generated motions (hold time)" in titles) is any(generated)
    assert ("Correlation" in titles) is any(generated)
    assert ("Strong-motion duration of records" in titles) is not all(generated)


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
    ("value", "shown", "word"), [(0.899999, "0.89", "NG"), (0.9, "0.90", "OK")]
)
def test_a_miss_never_rounds_onto_its_limit(value, shown, word):
    row = Limit(title="Ratio", found=value, limit=0.9, is_at_least=True, worst="M1 x")
    made = limits(Acceptance(rows=(row,), motions=())).row("Ratio")
    assert [*made.values()][1:] == [shown, "≥ 0.90†", "M1 x", word]


def test_a_spectrum_that_falls_between_the_points_of_the_limits_is_said():
    done = assessments.package().assessment
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
        "the smallest ratio shown below is 0.91 (M2, horizontal, at "
        f"{1.0 / part.periods_s[0]:.3g} Hz)."
    )
    higher = said(replace(part, sa_g=part.sa_g + 0.1))
    assert said(replace(part, is_ground=True)) == higher == said(part)[: len(higher)]


@pytest.mark.quick
def test_a_limit_that_is_a_note_is_one_in_each_table():
    """Without an array that takes the value from analysis, what makes that value NG is a note."""
    alone = {"arrays": [projects.array("A1", 0.5)], "objects": [], "clearances": []}
    package = assessments.package(assessments.motions(2, 4.0), **alone)
    title = "Number of motions"
    shown = page_of(package, "motions").table("Limits on the motions").rows
    assert [row["Verdict"] for row in shown if row["Limit"] == title] == ["note"]


@pytest.mark.quick
def test_friction_beyond_its_tests_has_one_verdict_in_each_table():
    """Without an array that takes the value from analysis it is a note; with one, a condition."""
    slow = [{"surface": "wet", "number": k, "mu": 0.2, "velocity_mps": 0.001} for k in range(1, 4)]
    given = {"friction_runs": slow, "objects": [], "clearances": []}
    for count, verdict in ((2, "note"), (3, "Condition")):
        arrays = [projects.array("A1", 0.5 if count == 2 else 2.0)]
        package = assessments.package(assessments.motions(count, 4.0), arrays=arrays, **given)
        title = "Friction at the sliding velocity"
        assert page_of(package, "limits").table("All checks").row(title)["Verdict"] == verdict
        first = page_of(package, "summary")
        opened = " ".join(first.table("Open conditions").column("Condition"))
        assert (title.lower() in opened) is (verdict == "Condition")
        table = page_of(package, "inputs").table("Friction at the sliding velocities")
        assert table.row("A1")["Verdict"] == verdict


@pytest.mark.parametrize(
    ("sources", "notes"),
    [("XXX", ["Source: X."]), ("XYX", ["Source of M1, M3: X.", "Source of M2: Y."]), ("XYZ", [])],
)
def test_a_source_that_motions_share_is_said_once(sources, notes):
    assessment = assessments.package().assessment
    pairs = zip(assessment.shaking.motions, sources, strict=True)
    motions = tuple(replace(motion, source=source) for motion, source in pairs)
    given = replace(assessment, shaking=replace(assessment.shaking, motions=motions))
    table = page_of(given, "motions").table("Roof motions as analyzed")
    assert list(table.notes[1:]) == notes  # below what all motions have alike
    assert ("Source" in table.headings) is (not notes)
    assert "Source" not in table.headings or table.column("Source") == list(sources)


def made(found=None, **changes):
    """A package, what it has of margins, and the page."""
    package = assessments.package(found, **{"options": project_parts.REVIEW} | changes)
    done = uncertainty(package.assessment)
    return package, done, page_of(package, "accuracy", uncertainty=done)


def test_the_smallest_margin_is_said_with_what_ends_the_search():
    (roomy,) = made(clearances=[projects.clearance("A2", "A3", 9.0)])[0].assessment.clearances
    _, found, page = made(clearances=[projects.clearance("A2", "A3", 1.3 * roomy.required_m)])
    least = max(found.margins, key=lambda one: one.minimum_mu / one.array.array.mu)
    text = page.line("The smallest friction margin")
    assert f"from {least.array.array.mu:.2f} to {least.minimum_mu:.2f}." in text
    shown = {row["Array"]: row for row in page.table("Lowest friction").rows}
    assert shown[least.array.id]["μ [lowest]"] == f"{least.minimum_mu:.2f}"
    package, found, _ = made()
    margins = tuple(
        replace(margin, minimum_mu=0.4, required_m=0.1004, limited_by=limited_by)
        for margin, limited_by in zip(
            found.margins, ("clearance", "Friction", "search"), strict=False
        )
    )
    page = page_of(package, "accuracy", uncertainty=replace(found, margins=margins))
    rows = page.table("Lowest friction").rows
    assert {row["Required at this μ [mm]"] for row in rows} == {"101"}
    assert [row["Limited by"] for row in rows] == ["clearance", "friction", "search"]


@pytest.mark.quick
def test_ratios_need_slip_and_levels_are_round():
    still = tuple(replace(motion, scale=1e-3) for motion in assessments.motions(3, 4.0))
    _, _, page = made(still, arrays=[projects.array("B1", 0.5, mu=1.0)], objects=[], clearances=[])
    assert "lists no clearances, so no margin" in page
    assert not re.search(r"\b(nan|inf|None)\b", page)
    line = page.line("PRD used for array B1")
    assert "more angles gives PRDs up to 0.0 in (0 mm);" in line
    assert "times this PRD" not in line
    assert levels([3.0, 120.0]) == [5, 7, 10, 15, 20, 30, 50, 70, 100]
    for low, high in ((0.1, 3000.0), (1e-4, 1e3), (9.0, 11.0), (5.0, 5.0)):
        found = levels([low, high])
        assert len(found) <= MOST_LEVELS
        assert all(low < value < high for value in found)


DISTANCE = {"mean_m": 0.1, "p95_m": 0.4, "beyond": 0.03, "without_value": 0.0}
ARRAY = {
    "array": "a1",
    "building": "roof",
    "slope_deg": 2.0,
    "mu": 0.5,
    "clearance_m": 0.6,
    "clearance_rate": 2e-3,
    "prd_m": {"475": 0.3, "700": None},
    "largest": {"never": DISTANCE},
    "last": {"never": DISTANCE | {"mean_m": None}},
}
YEARS = {
    "note": SUPPORTING,
    "title": "Twenty-five years",
    "date": "2026-03-01",
    "study": "ab" * 32,
    "program": "0.2.0",
    "hazard": {"site": "Here", "source": "Survey", "edition": "Model 2018", "vs30_mps": 760.0,
               "site_vs30_mps": 530.0},
    "life_years": 25.0,
    "arrays": [ARRAY],
}  # fmt: skip


def with_study(years):
    """The stand-in's package with a study of years beside its workbook."""
    given = assessments.package().assessment
    document = Document(
        label="Service-life study", path="years.json", size=1000, sha256="ab" * 32,
        years=StudyYears.model_validate(years),
    )  # fmt: skip
    return package_data(replace(given, source=replace(given.source, documents=(document,))))


def test_the_comparison_has_the_years_of_its_own_arrays():
    package = with_study(YEARS)
    text = page_of(package, "comparison")
    row = text.table("For comparison with the design displacement").rows[0]
    assert row["Array"] == "A1"
    assert row["PRD of 700 years"] == "none"
    assert row["Largest distance, mean"] == "4.0 in (100 mm)"
    assert row["95%"] == "15.8 in (400 mm)"
    assert f"{SUPPORTING}: neither a design displacement nor a verdict depends on it" in text
    assert "Here; Survey; Model 2018; Vs30 of the curve 760 m/s" in text
    design = page_of(assessments.package(), "comparison").tables
    assert page_of(package, "comparison").tables[: len(design)] == design
    text = page_of(with_study(YEARS | {"arrays": [ARRAY | {"array": "Z"}]}), "comparison")
    assert "None of its arrays has the name of an array in this package" in text


def test_a_former_mean_without_the_lives_that_have_no_distance_is_none():
    never = DISTANCE | {"without_value": 0.001}
    text = page_of(with_study(YEARS | {"arrays": [ARRAY | {"largest": {"never": never}}]}),
                   "comparison")  # fmt: skip
    row = text.table("For comparison with the design displacement").rows[0]
    assert (row["Largest distance, mean"], row["95%"]) == ("none", "15.8 in (400 mm)")


@pytest.mark.parametrize(("mu", "is_said"), [(0.4, True), (None, False)])
def test_another_friction_than_that_of_the_package_is_said(mu, is_said):
    (array, *_) = assessments.package().assessment.arrays
    one = ARRAY | {"mu": mu or array.array.mu, "slope_deg": array.array.slope_value}
    text = page_of(with_study(YEARS | {"arrays": [one]}), "comparison")
    assert ("differs from that of this package" in text) is is_said


def test_the_file_is_attached_or_refused_at_its_cell(tmp_path):
    book = SimpleNamespace(path=tmp_path / "input.xlsx", files={})
    inputs = {"options": [{"study_years": "years.json"}], "site": [], "friction_tests": []}
    path = tmp_path / "years.json"
    path.write_text(json.dumps(YEARS))
    (document,), faults = read_documents(book, inputs)
    assert not faults
    assert document.years.arrays[0].mu == 0.5
    assert json.loads(book.files[document.sha256]) == YEARS
    path.write_text(json.dumps(YEARS | {"note": "code value"}))
    _, (fault,) = read_documents(book, inputs)
    assert "is not a years.json of a study (note: " in fault.text
    assert fault.place.field == "study_years"
