"""results.xlsx in LibreOffice: what an engineer changes there, and how it prints."""

import datetime as dt
import io

import openpyxl
import pytest
from pypdf import PdfReader
from recalculated import converted

import stand_in
from report.assessment.spectra import spectra
from report.results.xlsx import results_xlsx

pytestmark = pytest.mark.slow

INCH = 0.0254
SITE = stand_in.project().site.model_dump()
REVIEWED = {
    "peer_reviewed": True,
    "peer_reviewer": "Reviewer of record",
    "peer_license": "CA S0000",
    "peer_date": dt.date(2026, 3, 1),
    "statistic": "1.1 x largest",
}


def assessed(**changes):
    return stand_in.assessed(stand_in.book(stand_in.project(**changes)))


def saved_as(folder, content, kind="xlsx"):
    """The workbook as LibreOffice saves it."""
    (folder / "results.xlsx").write_bytes(content)
    (path,) = converted([folder / "results.xlsx"], folder, kind)
    return io.BytesIO(path.read_bytes())


def compared(sheet, row, columns):
    return [sheet[f"{column}{row}"].value for column in columns]


def test_the_verdict_follows_five_changed_inputs_as_in_a_report_made_from_them(tmp_path):
    gaps = [gap.model_dump() for gap in stand_in.project().clearances]
    before = assessed()
    book = openpyxl.load_workbook(io.BytesIO(results_xlsx(before, spectra(before))))
    narrow = 10 * INCH
    inputs = {row[0].value: row[1] for row in book["Inputs"].iter_rows(min_row=5)}
    inputs["S_DS [g]"].value = 1.3
    inputs["Importance factor I_e"].value = 1.25
    inputs["Design value statistic"].value = "1.1 x largest"
    inputs["Peer review"].value = "Yes"
    book["Clearances"]["K6"].value = narrow / INCH
    changed = io.BytesIO()
    book.save(changed)
    gaps[1] |= {"provided_m": narrow}
    site = SITE | {"s_ds_g": 1.3, "i_e": 1.25}
    after = assessed(site=site, options=REVIEWED, clearances=gaps)
    assert before.clearances[1].ok
    assert not after.clearances[1].ok
    recalculated = openpyxl.load_workbook(saved_as(tmp_path, changed.getvalue()), data_only=True)
    design, clearances = recalculated["Design"], recalculated["Clearances"]
    assert design["B3"].value == after.verdict.value
    for row, item in enumerate(after.arrays, start=5):
        values = compared(design, row, "FGHIKMN")
        wanted = (
            item.prescriptive.value_m, item.analysis.n_motions * INCH, item.analysis.mean_m,
            item.analysis.largest_m, item.analysis.value_m, item.floor_m, item.design_m,
        )  # fmt: skip
        assert values == pytest.approx([value / INCH for value in wanted], rel=1e-9)
        assert compared(design, row, "ST") == [
            after.array_verdict(item).value,
            item.analysis.basis.value,
        ]
    for row, gap in enumerate(after.clearances, start=5):
        values = compared(clearances, row, "FGIKL")
        lengths = (gap.design_m, gap.factor * INCH, gap.required_m, gap.clearance.provided_m)
        wanted = [*(value / INCH for value in lengths), gap.demand_capacity]
        assert values == pytest.approx(wanted, rel=1e-9)
        governing = f"{gap.governing_array}, {gap.governing_direction.value}"
        assert compared(clearances, row, "EM") == [governing, gap.verdict.value]


def test_the_governing_array_follows_a_peak_that_is_changed(tmp_path):
    before = assessed(options=REVIEWED)
    first = before.clearances[0]
    assert {first.clearance.array, first.clearance.object} == {"A1", "A3"}
    other = "A1" if first.governing_array == "A3" else "A3"
    book = openpyxl.load_workbook(io.BytesIO(results_xlsx(before, spectra(before))))
    runs = book["Runs"]
    head = [cell.value for cell in runs[1]]
    for row in runs.iter_rows(min_row=2):
        if row[0].value == other:
            row[head.index("PRD [in]")].value = 90.0
    changed = io.BytesIO()
    book.save(changed)
    recalculated = openpyxl.load_workbook(saved_as(tmp_path, changed.getvalue()), data_only=True)
    sheet = recalculated["Clearances"]
    assert sheet["E5"].value == f"{other}, any"
    assert sheet["F5"].value == pytest.approx(1.1 * 90.0)
    assert sheet["M5"].value == ("OK" if sheet["I5"].value <= sheet["K5"].value else "NG")


def test_every_sheet_prints_as_wide_as_a_page(tmp_path):
    assessment = assessed()
    content = results_xlsx(assessment, spectra(assessment))
    sheets = openpyxl.load_workbook(io.BytesIO(content)).worksheets
    for sheet in sheets:
        assert (sheet.page_setup.orientation, sheet.page_setup.paperSize) == ("landscape", 1)
        assert sheet.page_setup.fitToWidth in (1, None)  # 1 where it is not stated
        assert sheet.page_setup.fitToHeight == 0
        assert sheet.sheet_properties.pageSetUpPr.fitToPage
        assert sheet.print_title_rows
    pages = PdfReader(saved_as(tmp_path, content, "pdf")).pages
    # No sheet is split in its width: every page shows the first column's heading.
    names = [sheet.title for sheet in sheets]
    counts = {name: sum(f", {name}" in page.extract_text() for page in pages) for name in names}
    assert all(counts.values()), counts
    assert len(pages) == sum(counts.values())
    long = {"Runs", "Records", "Motions", "Requirements", "Peaks", "Spectra"}
    assert all(count == 1 for name, count in counts.items() if name not in long), counts
