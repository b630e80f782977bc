"""A workbook that is filled in on the page: its errors, its tables, and what is typed."""

import json

import pytest

from fixtures.browser import at_rest, called, opened, quiet_page, saved, served
from fixtures.paths import ROOT
from fixtures.workbooks import blank
from report.project.model.choices import UnitsFirst
from report.project.read.read import read
from report.web import jobs
from report.web.fields import tables, typed_cells

EXAMPLE = ROOT / "projects" / "example"
TYPED = {
    "Project!B5": "Two sheds", "Project!B6": "1", "Project!B9": "RG", "Project!B14": "2026-03-05",
    "Project!B15": "0", "Site!B5": "ASCE 7-16", "Site!B7": "II", "Site!B15": "1.2",
    "Site!B19": "D", "Site!B26": "2", "Site!B27": "30", "Site!B28": "30",
}  # fmt: skip
ARRAY = ["A1", "1", "degrees", "0.55", "Tray", "42000", "9", "40", "20", "100", "15", "75", "270"]
OBJECT = ["RTU-1", "fixed object", "106", "112", "30", "40"]


def state(path):
    return jobs.perform({"do": "state", "workbook": str(path)})["answer"]


def row(table, values):
    """The first row of a table with values, by cell."""
    cells = (one["where"] for one in table["rows"][0])
    return dict(zip(cells, values, strict=True))


def fill(path, cells):
    """Fill in the workbook itself; return the answer of the job."""
    filled = path.parent / "filled.xlsx"
    job = {"do": "fill_in", "workbook": str(path), "cells": json.dumps(cells), "to": str(filled)}
    reply = jobs.perform(job)
    if filled.exists():
        filled.rename(path)
    return reply


@pytest.mark.quick
def test_what_is_typed_is_a_number_a_text_or_nothing():
    typed = {
        "Site!B1": " 1.5 ",
        "Site!C2": "-2e3",
        "Site!C3": "1-2",
        "A b!AA10": " D ",
        "S!A1": " ",
    }
    assert {cell.address: value for cell, value in typed_cells(typed).items()} == {
        "Site!B1": 1.5, "Site!C2": -2000.0, "Site!C3": "1-2", "A b!AA10": "D", "S!A1": None,
    }  # fmt: skip


@pytest.mark.parametrize("units", UnitsFirst)
def test_a_blank_workbook_is_filled_in_until_it_opens(tmp_path, units):
    path = blank(tmp_path / "input.xlsx", units)
    first = state(path)
    assert (first["project"], first["lacks"]) == (None, ["arrays"])
    missing = {problem["place"] for problem in first["problems"]}
    assert missing - {"Arrays!B7"} <= TYPED.keys()
    arrays, objects, _ = tables(path)
    heads = [head["text"] for head in arrays["heads"]]
    assert len(heads) == len(ARRAY)
    assert arrays["rows"][0][heads.index("Slope unit")]["choices"]
    cells = TYPED | {one["where"]: v for one, v in zip(arrays["rows"][0], ARRAY, strict=True)}
    cells |= {one["where"]: v for one, v in zip(objects["rows"][0], OBJECT, strict=True)}
    assert fill(path, cells) == {"answer": {"lines": []}}
    done = state(path)
    assert done["problems"] == []
    assert done["lacks"][0] == "motions"
    sheet = read(path)
    assert (sheet.project.project.name, sheet.project.arrays[0].mu) == ("Two sheds", 0.55)


def test_a_cell_that_no_sheet_has_is_refused_and_nothing_is_changed(tmp_path):
    path = blank(tmp_path / "input.xlsx")
    before = path.read_bytes()
    assert "problems" in fill(path, {"Nowhere!B5": "1"})
    assert path.read_bytes() == before


WANTED = ["records/m1.csv", "low", "documents/a.pdf"]
PLACED = [
    (["m1.csv", "a.pdf"], ["input.xlsx"], ["input.xlsx", "records/m1.csv", "documents/a.pdf"]),
    (["all/m1.csv"], ["p/input.xlsx", "p/records/m1.csv"], ["p/input.xlsx", "p/records/m1.csv"]),
    (["roof.dxf"], ["p/input.xlsx"], ["p/input.xlsx", "p/roof.dxf"]),
    (["q/input.xlsx", "q/m1.csv"], ["p/input.xlsx"], ["q/input.xlsx", "q/m1.csv"]),
    (["m1.csv"], ["all.zip"], ["m1.csv"]),
    (["m1.csv"], None, ["m1.csv"]),
]


@pytest.mark.parametrize(("files", "former", "found"), PLACED)
def test_records_follow_the_workbook_that_names_them(scripts, files, former, found):
    body = """const of = (paths) => paths?.map((path) => ({ path }));
        return m.besideWorkbook(of(g[0]), of(g[1]), g[2]).map(({ path }) => path);"""
    assert called(scripts, "upload", body, [files, former, WANTED]) == found


@pytest.mark.nightly
def test_from_nothing_to_a_verdict_on_the_page(browser, tmp_path):
    with served() as (address, _), quiet_page(browser, locale="en-US") as page:
        opened(page, address)
        page.click("#new")
        page.wait_for_selector("#problems tbody tr")
        assert page.inner_text("#problems h2") == "What the workbook needs first"
        rows = page.locator(".fields details").nth(0).locator("tbody tr").first
        for field, value in zip(rows.locator("input, select").all(), ARRAY, strict=True):
            is_choice = field.evaluate("(one) => one.tagName") == "SELECT"
            (field.select_option if is_choice else field.fill)(value)
        while page.locator("#problems").is_visible():
            for field in page.locator("#problems .problems [data-at]").all():
                field.fill(TYPED[field.get_attribute("data-at")])
            page.click("#check")
            page.wait_for_selector("#busy", state="visible")
            page.wait_for_selector("#busy", state="hidden", timeout=60_000)
        at_rest(page)
        assert page.inner_text("h1") == "Two sheds"
        assert page.inner_text("#verdict .tag") == "OK with conditions"
        assert page.locator("#make-package").is_enabled()
        name, content = saved(page, lambda: page.click("#save-workbook"))
        (tmp_path / name).write_bytes(content)
        assert read(tmp_path / name).project.arrays[0].mu == 0.55


@pytest.mark.nightly
def test_equal_remedies_are_one_line_and_the_records_may_follow(browser):
    with served() as (address, _), quiet_page(browser) as page:
        opened(page, address)
        page.set_input_files("#files", EXAMPLE / "input.xlsx")
        page.wait_for_selector("#problems tbody tr")
        told = page.locator("#problems .problems > tbody > tr")
        motions = [one.inner_text() for one in told.all() if "Motions!" in one.inner_text()]
        assert len(motions) == 1
        assert "20 more with the same remedy" in motions[0]
        sent = [*(EXAMPLE / "records").glob("*"), *(EXAMPLE / "documents").glob("*")]
        page.set_input_files("#files", sent)
        page.wait_for_selector("#problems", state="hidden", timeout=60_000)
        at_rest(page)
        assert page.locator("#welcome").is_hidden()
        assert page.inner_text("#verdict .tag") == "OK"


@pytest.mark.nightly
def test_rows_of_the_project_that_is_open_are_edited_also_through_an_error(browser):
    with served() as (address, _), quiet_page(browser) as page:
        opened(page, address)
        friction = page.locator(".fields [data-at='Arrays!E8']")
        page.click("#edit")
        page.locator(".fields summary").first.click()
        assert friction.input_value() == "0.5"
        friction.fill("low")
        page.click("#check")
        page.wait_for_selector("#problems .problems tbody tr")
        assert page.inner_text("#problems .problems th[scope=row]").startswith("Arrays!E8")
        page.locator(".problems [data-at='Arrays!E8']").fill("0.45")
        page.click("#check")
        page.wait_for_selector("#problems", state="hidden", timeout=60_000)
        at_rest(page)
        assert page.locator("#welcome").is_hidden()  # it is a copy
        assert page.locator("#controls output").first.inner_text().startswith("0.45 (A1)")
