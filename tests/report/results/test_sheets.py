"""The sheets of results.xlsx on paper: in the order of the package, with columns that fit."""

from io import BytesIO
from textwrap import wrap

import openpyxl
import pytest
from openpyxl.utils import get_column_letter

import scenes
from report.assessment.spectra import spectra
from report.results.xlsx import results_xlsx

pytestmark = pytest.mark.quick

LETTER_PX, MARGIN_PX = 7, 5
PAGE_IN = {"1": 11.0, "9": 11.69}  # Letter and A4 in landscape
LEGIBLE = 0.6  # of 11 pt


@pytest.fixture(
    scope="module",
    params=[scenes.usual, scenes.unpermitted, lambda: scenes.shipped("campus")],
    ids=["usual", "unpermitted", "campus"],
)
def done(request):
    return request.param()


@pytest.fixture(scope="module")
def book(done):
    return openpyxl.load_workbook(BytesIO(results_xlsx(done, spectra(done))), data_only=True)


def widths(sheet):
    """Return the width of each column in letters; one entry of the file may be for several."""
    found = {}
    for at in sheet.column_dimensions.values():
        found |= {get_column_letter(k): at.width for k in range(at.min, at.max + 1)}
    return found


def heading_row(sheet):
    return int(sheet.print_title_rows.split(":")[0].strip("$"))


def shown(cell):
    decimals = len(cell.number_format.partition('"')[0].partition(".")[2])
    return f"{cell.value:.{decimals}f}" if isinstance(cell.value, float) else str(cell.value)


def test_sheets_are_in_order_landscape_and_legible(book):
    order = [
        "Design", "Clearances", "Neighbors", "Requirements", "Inputs", "Motions", "Records",
        "Spectra", "Directions", "Peaks", "Runs", "Links", "LinkRuns",
    ]  # fmt: skip
    assert book.sheetnames == [name for name in order if name in book.sheetnames]
    for sheet in book:
        wide, top = widths(sheet), heading_row(sheet)
        for row in sheet.iter_rows(min_row=top):
            for cell in (cell for cell in row if cell.value is not None):
                text, letters = shown(cell), wide[cell.column_letter]
                assert max(map(len, text.split()), default=0) < letters, (sheet.title, text)
                lines = len(wrap(text, int(letters))) or 1
                height = sheet.row_dimensions[cell.row].height or 15.0
                assert height >= 15.0 * lines, (sheet.title, text)
                assert lines == 1 or cell.alignment.wrap_text, (sheet.title, text)


def test_pages_are_landscape_and_legible_on_the_paper_of_the_units(done, book):
    for sheet in book:
        setup, wide = sheet.page_setup, widths(sheet)
        assert (setup.orientation, str(setup.paperSize)) == (
            "landscape",
            "1" if done.project.us_first else "9",
        )
        page_in = PAGE_IN[str(setup.paperSize)] - sheet.page_margins.left - sheet.page_margins.right
        columns_in = [(LETTER_PX * letters + MARGIN_PX) / 96.0 for letters in wide.values()]
        if sheet.sheet_properties.pageSetUpPr and sheet.sheet_properties.pageSetUpPr.fitToPage:
            assert (setup.fitToWidth, setup.fitToHeight) in ((1, 0), (None, 0))
            assert sum(columns_in) * LEGIBLE <= page_in
        else:
            assert setup.scale == 100 * LEGIBLE
            keys = sheet.print_title_cols.replace("$", "").split(":")
            assert keys[0] == "A"
            repeated = sum(columns_in[: list(wide).index(keys[1]) + 1])
            assert (repeated + max(columns_in)) * LEGIBLE <= page_in
