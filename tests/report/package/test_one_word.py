"""One thing has one word, one number and one mark wherever it stands: sheets, files, screens."""

import io
import json
import math
import re

import numpy as np
import openpyxl
import pytest

from fixtures import assessments, projects
from fixtures.cells import cell
from fixtures.marks import by_day
from fixtures.pages import IDS, page_of
from fixtures.spaces import spaced
from report.assessment.assess import reassess
from report.assessment.checks.sentence import alike
from report.assessment.design.verdict import Verdict
from report.assessment.support.response_spectra import spectra
from report.drawing.on_paper import plan_on_paper
from report.drawing.plan_layers import plan_drawing
from report.drawing.sheet import LETTER
from report.figures.base import style
from report.figures.plan_figure import painted
from report.pages.checks import APART
from report.pages.terminal import summary
from report.results.results_json import results_json
from report.results.xlsx import results_xlsx
from report.web.answers import answer

CASES = {
    "example": lambda: assessments.shipped("example"),
    "conditions": lambda: assessments.shipped("conditions"),
    "unpermitted": assessments.unpermitted,
    "departing": lambda: assessments.departing().assessment,
}


@pytest.fixture(scope="module", params=by_day(CASES, 2))
def made(request):
    """A package, its results.json and its results.xlsx."""
    package = assessments.package_data(CASES[request.param]())
    found = assessments.evidence(package.assessment)
    content = results_xlsx(package.assessment, found.spectra)
    book = openpyxl.load_workbook(io.BytesIO(content), data_only=True)
    return package, json.loads(results_json(package.assessment, found)), book


def rows_of(sheet, head_row):
    head, *rows = sheet.iter_rows(min_row=head_row, values_only=True)
    return [dict(zip(head, row, strict=True)) for row in rows if row[0]]


def bare(text):
    """A cell without its marks and what follows the verdict in it."""
    return text.strip("†§*¶ ")


def plain(text):
    """A text without what is set as a subscript in the PDF."""
    return re.sub(r"[_\s†]", "", text)


def test_verdicts_of_arrays_clearances_and_neighbors_are_one_word(made):
    package, document, book = made
    table = page_of(package, "summary").table("Arrays").rows
    arrays = document["arrays"]
    assert [row["Verdict"].split(" ")[0] for row in table] == [row["verdict"] for row in arrays]
    governs = [row["design_governs"] for row in arrays]
    assert [bare(row["Governs"]).removesuffix(", not permitted") for row in table] == [
        word or "—" for word in governs
    ]
    cells = rows_of(book["Design"], 4)
    assert [row["Verdict"] for row in cells] == [row["verdict"] for row in arrays]
    assert cell(book, "Summary/Verdict").value == document["verdict"]
    gaps = document["clearances"]
    table = page_of(package, "plan").table("Schedule of clearances").rows
    kinds = [f"{row['neighbor']}, {row['direction']}" for row in gaps]
    shown = [kind.removesuffix(", any") for kind in kinds]
    assert [row["Verdict"] for row in table] == [row["verdict"] for row in gaps]
    measured = page_of(package, "notes").table("Clearance schedule").rows
    assert [bare(row["Type"]) for row in measured] == shown
    cells = rows_of(book["Clearances"], 4)
    assert [row["Verdict"] for row in cells] == [row["verdict"] for row in gaps]
    assert [f"{row['Type']}, {row['Direction']}" for row in cells] == kinds
    expected = {(row["array"], row["other"]): row["what"] for row in document["neighbors"]}
    cells = {
        (row["Array"], row["Adjacent item"]): row["Type"]
        for row in rows_of(book["Adjacent items"], 1)
    }
    assert cells == expected


def test_the_verdicts_of_requirements(made):
    package, document, book = made
    verdicts = {(row["id"], row["subject"]): row["verdict"] for row in document["checks"]}
    checks = [check for check in package.assessment.checks if check.id != "clearance"]
    assert {verdicts[c.id, c.subject] for c in checks} == {c.verdict.value for c in checks}
    sheet = [
        (row["Item"], row["Requirement"], row["Verdict"])
        for row in rows_of(book["Requirements"], 4)
    ]
    assert sheet == [
        (c.subject or "Project", spaced(c.title), c.verdict.value) for c in alike(checks)
    ]
    # In the PDF those that ask the same are one; clearances and motions have tables of their own.
    checks = alike(check for check in package.assessment.checks if check.id not in APART)
    said = [(c.subject or "project", plain(c.title), c.verdict.value) for c in checks]
    table = page_of(package, "limits").table("All checks").rows
    shown = [(r["Item"], plain(r["Check"]), r["Verdict"]) for r in table if r["Check"]]
    assert shown == said


INCH = 0.0254
# On the sheets of results a value in one direction, which is another one, may be the lower number.
PAGES = ("letter", "summary", "plan", "comparison", "method", "model", "accuracy")


@pytest.fixture(scope="module")
def example():
    """The example with a slope of A3 whose displacement would be less, rounded to the nearest."""
    given = assessments.shipped("example")
    for slope_deg in np.arange(3.0, 2.5, -0.03).tolist():
        arrays = (
            array.model_copy(update={"slope_value": slope_deg}) if array.id == "A3" else array
            for array in given.project.arrays
        )
        data = given.project.model_copy(update={"arrays": tuple(arrays)})
        other = reassess(given, data)
        if round(inches := other.governing.design_m / INCH, 1) < inches:
            return assessments.package_data(other)
    raise AssertionError


def test_no_page_rounds_the_design_displacement_down(example):
    item = example.assessment.governing
    inches = item.design_m / INCH
    up, down = (f"{to(10 * inches) / 10:.1f}" for to in (math.ceil, math.floor))
    assert up != down
    assert round(inches, 1) == float(down)  # rounded to the nearest it would be less
    assert set(PAGES) <= {"letter", *IDS}
    for page in PAGES:
        words = page_of(example, page)
        assert not re.search(rf"(?<![\d.]){re.escape(down)}(?!\d)", words), page
    for page in ("letter", "summary", "comparison", "plan"):
        assert up in page_of(example, page)
    said = "\n".join(summary(example.assessment))
    assert up in said
    assert f"{down} in" not in said
    shown = str(answer(example.assessment, is_provisional=False)["arrays"])
    assert up in shown
    assert f"{down} in" not in shown


FACTOR = {"provision": "separation_fixed", "value": 0.5, "reason": "Agreed on 2026-02-10"}
MINIMUM = {"provision": "prescriptive_factor_in", "value": 40.0, "reason": "Agreed on 2026-02-11"}
LENGTH = r"[\d.,]+\sin \([\d.,]+\smm\)"


@pytest.fixture(scope="module")
def done():
    outline = {"x_from_m": 0.0, "x_to_m": 220 * projects.FOOT,
               "y_from_m": 0.0, "y_to_m": 171 * projects.FOOT}  # fmt: skip
    changes = {"overrides": [FACTOR, MINIMUM], "roof": outline}
    return assessments.package(**changes).assessment


@pytest.mark.quick
def test_lowered_values_are_marked_where_they_govern_on_the_plan_and_in_results_json(done):
    assert {item.governs for item in done.arrays} == {"floor"}
    assert {item.overridden.design for item in done.arrays} == {"‡"}
    assert done.verdict is not Verdict.OK
    row = page_of(done, "comparison").table("Analysis displacement").row("A1")
    assert all(row[f"{name} [in]"].endswith("‡") for name in ("Prescriptive", "Floor", "Design"))
    with style():
        figure = painted(plan_on_paper(done, LETTER).paper)
    said = " ".join(text.get_text() for text in figure.findobj(lambda a: hasattr(a, "get_text")))
    assert re.search(rf"Δ {LENGTH}‡", said)
    arrays, schedule = page_of(done, "plan").tables[:2]
    for row in arrays.rows:
        assert all(re.fullmatch(r"[\d.]+‡", row[f"{name} [in]"]) for name in ("Δ", "Keep clear"))
    assert all(re.fullmatch(r"[\d.]+‡", row["Req’d [in]"]) for row in schedule.rows)
    said = " ".join(text.words for text in plan_drawing(done).texts)
    assert re.search(rf"A1 {LENGTH} \(overridden\) \d+\sin \(overridden\)", said)
    assert "‡" not in said
    found = json.loads(results_json(done, assessments.evidence(done)))
    assert all(item["design_is_overridden"] for item in found["arrays"])
    assert all(item["required_is_overridden"] for item in found["clearances"])
    ids = [row["id"] for row in found["checks"] if row["verdict"] != "OK"]
    assert ids.count("override") == 2


def test_results_xlsx_shows_the_mark_and_keeps_the_number_as_terminal_and_page(done, tmp_path):
    book = openpyxl.load_workbook(io.BytesIO(results_xlsx(done, spectra(done))), data_only=True)
    for sheet, headings in (
        ("Design", ("Prescriptive [in]", "Floor [in]", "Design [in]", "Design, as reported [in]")),
        ("Clearances", ("Design [in]", "Required [in]", "Required [mm]", "D/C")),
    ):
        rows = list(book[sheet].iter_rows(min_row=4))
        names = [cell.value for cell in rows[0]]
        for heading in headings:
            cell = rows[1][names.index(heading)]
            assert isinstance(cell.value, float)
            assert cell.number_format.endswith('"‡"'), (sheet, heading)
        assert "‡: changed by an override" in " ".join(str(cell.value) for cell in book[sheet][2])
    said = [cell.value for row in book["Requirements"].iter_rows() for cell in row]
    assert any("0.5‡" in str(value) for value in said)
    lines = list(summary(done))
    assert re.search(rf"A1 .*{LENGTH}‡ .*{LENGTH}‡ .*[\d.]+‡", lines[1])
    assert "‡: changed by an override or a departure" in lines
    assert any(line.startswith("condition: Override of the separation") for line in lines)
    shown = answer(done, is_provisional=False)
    for table, columns in {"arrays": ["Design Δ"], "clearances": ["Required", "D/C"]}.items():
        for cells in shown[table]["rows"]:
            row = dict(zip(shown[table]["heads"], cells, strict=True))
            assert all(row[column]["text"].endswith("‡") for column in columns)
            assert all("‡" in row[column].get("title", "‡") for column in columns)
    assert "‡: changed by an override" in shown["model_text"]
