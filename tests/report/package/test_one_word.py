"""PDF, results.json and results.xlsx say the same word of the same thing."""

import io
import json
import re

import openpyxl
import pytest

import scenes
from printed import printed
from report.assessment.evidence import support
from report.assessment.verdict import as_one
from report.results.results_json import results_json
from report.results.xlsx import results_xlsx
from report.text.counts import grouped_by

CASES = {
    "example": lambda: scenes.shipped("example"),
    "conditions": lambda: scenes.shipped("conditions"),
    "unpermitted": scenes.unpermitted,
    "departing": lambda: scenes.departing().assessment,
}


@pytest.fixture(scope="module", params=CASES)
def made(request):
    """A package, its results.json and its results.xlsx."""
    package = scenes.package_data(CASES[request.param]())
    found = support(package.assessment)
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
    table = printed(package, "summary").table("Arrays: displacement").rows
    arrays = document["arrays"]
    assert [row["Verdict"].split(" ")[0] for row in table] == [row["verdict"] for row in arrays]
    governs = [row["design_governs"] for row in arrays]
    assert [bare(row["Governs"]).removesuffix(", not permitted") for row in table] == [
        word or "—" for word in governs
    ]
    cells = rows_of(book["Design"], 4)
    assert [row["Verdict"] for row in cells] == [row["verdict"] for row in arrays]
    assert book["Design"]["C3"].value == document["verdict"]
    gaps = document["clearances"]
    table = printed(package, "plan").table("Schedule of clearances").rows
    kinds = [f"{row['neighbor']}, {row['direction']}" for row in gaps]
    shown = [kind.removesuffix(", any") for kind in kinds]
    assert [row["Verdict"] for row in table] == [row["verdict"] for row in gaps]
    measured = printed(package, "notes").table("Schedule of gaps").rows
    assert [bare(row["Kind"]) for row in measured] == shown
    cells = rows_of(book["Clearances"], 4)
    assert [row["Verdict"] for row in cells] == [row["verdict"] for row in gaps]
    assert [f"{row['Kind']}, {row['Direction']}" for row in cells] == kinds
    _, document, book = made
    expected = {(row["array"], row["other"]): row["what"] for row in document["neighbors"]}
    cells = {(row["Array"], row["Neighbor"]): row["Kind"] for row in rows_of(book["Neighbors"], 1)}
    assert cells == expected


def test_the_verdicts_of_requirements(made):
    package, document, book = made
    expected = {
        (row["subject"] or "Project", row["title"], row["found"]): row["verdict"]
        for row in document["requirements"]
    }
    cells = {
        (row["Item"], row["Requirement"], row["Found"]): row["Verdict"]
        for row in rows_of(book["Requirements"], 4)
    }
    assert {key: cells[key] for key in expected} == expected
    # In the PDF those that ask the same are one, with what each finds.
    alike = grouped_by(package.assessment.rows, lambda row: (*row.asked, row.basis, row.verdict))
    said = {
        (plain(one.title), plain(one.found)): one.verdict.value
        for one in map(as_one, alike.values())
    }
    table = printed(package, "limits").table("Other requirements").rows
    shown = {(plain(r["Requirement"]), plain(r["Found"])): bare(r["Verdict"]) for r in table}
    assert shown
    assert shown.items() <= said.items()
