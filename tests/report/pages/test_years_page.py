"""The 25 years of a study in a package: beside the design displacement, and never part of it."""

import hashlib
import json
from dataclasses import replace
from types import SimpleNamespace

import pytest

import scenes
from printed import printed
from report.pages.registry import package_data
from report.sheet.reading.linked_files import SUPPORTING, Document, StudyYears, read_documents

DISTANCE = {"mean_m": 0.1, "p95_m": 0.4, "beyond": 0.03, "without_value": 0.001}
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
    given = scenes.package().assessment
    content = json.dumps(years).encode()
    sha256 = hashlib.sha256(content).hexdigest()
    document = Document(label="Study of years", path="years.json", size=len(content), sha256=sha256)
    book = SimpleNamespace(files={sha256: content})
    sheet = replace(given.sheet, documents=(document,), book=book)
    return package_data(replace(given, sheet=sheet))


def test_the_comparison_has_the_years_of_its_own_arrays():
    package = with_study(YEARS)
    text = printed(package, "comparison")
    row = text.table("Beside the design displacement").rows[0]
    assert row["Array"] == "A1"
    assert row["PRD of 700 years"] == "none"
    assert row["Largest distance, mean"] == "4.0 in (100 mm)"
    assert row["95 %"] == "15.8 in (400 mm)"
    assert f"{SUPPORTING}: neither a design displacement nor a verdict depends on it" in text
    assert "Here; Survey; Model 2018; Vs30 of the curve 760 m/s" in text
    design = printed(scenes.package(), "comparison").tables
    assert printed(package, "comparison").tables[: len(design)] == design
    text = printed(with_study(YEARS | {"arrays": [ARRAY | {"array": "Z"}]}), "comparison")
    assert "None of its arrays has the name of an array of this package" in text


@pytest.mark.parametrize(("mu", "is_said"), [(0.4, True), (None, False)])
def test_another_friction_than_that_of_the_package_is_said(mu, is_said):
    (array, *_) = scenes.package().assessment.arrays
    one = ARRAY | {"mu": mu or array.array.mu, "slope_deg": array.array.slope_value}
    text = printed(with_study(YEARS | {"arrays": [one]}), "comparison")
    assert ("differ from those of this package" in text) is is_said


def test_the_file_is_attached_or_refused_at_its_cell(tmp_path):
    book = SimpleNamespace(path=tmp_path / "input.xlsx", files={})
    draft = {"options": [{"study_years": "years.json"}], "site": [], "friction_tests": []}
    path = tmp_path / "years.json"
    path.write_text(json.dumps(YEARS))
    (document,), faults = read_documents(book, draft)
    assert not faults
    assert StudyYears.model_validate_json(book.files[document.sha256]).arrays[0].mu == 0.5
    path.write_text(json.dumps(YEARS | {"note": "code value"}))
    _, (fault,) = read_documents(book, draft)
    assert "is no years.json of a study (note: " in fault.text
    assert fault.place.field == "study_years"
