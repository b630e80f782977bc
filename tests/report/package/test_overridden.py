"""A number that an override lowers carries its mark in every output, and is named to the reader."""

import io
import json
import re
from dataclasses import replace

import openpyxl
import pytest

import scenes
import stand_in
from printed import printed
from report.assessment.evidence import support
from report.assessment.spectra import spectra
from report.assessment.verdict import Verdict
from report.drawing.on_paper import plan_on_paper
from report.drawing.plan import plan_drawing
from report.drawing.sheet import LETTER
from report.figures.base import style
from report.figures.plan import painted
from report.pages.summary import summary
from report.results.results_json import results_json
from report.results.xlsx import results_xlsx
from report.sheet.reading.archive import open_book
from report.web.answers import answer
from sheets import make

pytestmark = pytest.mark.quick

FACTOR = {"provision": "separation_fixed", "value": 0.5, "reason": "Agreed on 2026-02-10"}
MINIMUM = {"provision": "prescriptive_factor_in", "value": 40.0, "reason": "Agreed on 2026-02-11"}
LENGTH = r"[\d.,]+ in \([\d.,]+ mm\)"


@pytest.fixture(scope="module")
def done():
    outline = {"x_from_m": 0.0, "x_to_m": 220 * stand_in.FOOT,
               "y_from_m": 0.0, "y_to_m": 171 * stand_in.FOOT}  # fmt: skip
    changes = {"overrides": [FACTOR, MINIMUM], "roof": outline}
    return scenes.package(**changes).assessment


def test_lowered_values_are_marked_where_they_are_and_govern(done):
    assert {item.governs for item in done.arrays} == {"floor"}
    assert {item.design_mark for item in done.arrays} == {"‡"}
    assert done.verdict is not Verdict.OK
    assert printed(done, "summary").table("Arrays").row("A1")["Prescriptive [in]"].endswith("‡")
    row = printed(done, "comparison").table("Displacement by analysis").row("A1")
    assert all(row[f"{name} [in]"].endswith("‡") for name in ("Prescriptive", "Floor", "Design"))


def test_plan_dxf_and_results_json_mark_it(done):
    with style():
        figure = painted(plan_on_paper(done, LETTER).paper)
    said = " ".join(text.get_text() for text in figure.findobj(lambda a: hasattr(a, "get_text")))
    assert re.search(rf"Δ {LENGTH}‡", said)
    arrays, schedule = printed(done, "plan").tables[:2]
    for row in arrays.rows:
        assert all(re.fullmatch(r"[\d.]+‡", row[f"{name} [in]"]) for name in ("Δ", "Keep clear"))
    assert all(re.fullmatch(r"[\d.]+‡", row["Req’d [in]"]) for row in schedule.rows)
    said = " ".join(text.words for text in plan_drawing(done).texts)
    assert re.search(rf"design displacement {LENGTH} \(overridden\)", said)
    assert re.search(r"keep clear \d+ in \(overridden\); no conduit", said)
    assert "‡" not in said
    found = json.loads(results_json(done, support(done)))
    assert all(item["design_is_overridden"] for item in found["arrays"])
    assert all(item["required_is_overridden"] for item in found["clearances"])
    ids = [row["id"] for row in found["requirements"] if row["verdict"] != "OK"]
    assert ids.count("override") == 2


def test_results_xlsx_shows_the_mark_and_keeps_the_number(done):
    book = openpyxl.load_workbook(io.BytesIO(results_xlsx(done, spectra(done))), data_only=True)
    for sheet, headings in (
        ("Design", ("Prescriptive [in]", "Floor [in]", "Design [in]", "Design by Roofslip [in]")),
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


def test_terminal_and_page_mark_it(done, tmp_path):
    book = open_book(make(tmp_path))
    done = replace(done, sheet=replace(done.sheet, book=book))
    lines = list(summary(done))
    assert re.search(rf"A1 .*{LENGTH}‡ .*{LENGTH}‡ .*[\d.]+‡", lines[1])
    assert "‡: changed by an override or a departure" in lines
    assert any(line.startswith("condition: override of the separation") for line in lines)
    shown = answer(done, is_provisional=False)
    for table, columns in {"arrays": ["Design"], "clearances": ["Required", "D/C"]}.items():
        for cells in shown[table]["rows"]:
            row = dict(zip(shown[table]["heads"], cells, strict=True))
            assert all(row[column]["text"].endswith("‡") for column in columns)
            assert all("‡" in row[column].get("title", "‡") for column in columns)
    assert "‡: changed by an override" in shown["model_text"]
