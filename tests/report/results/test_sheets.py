"""results.xlsx on paper, and in LibreOffice when an engineer changes it there."""

import io
from io import BytesIO
from textwrap import wrap

import openpyxl
import pytest
from openpyxl.utils import get_column_letter, range_boundaries
from pypdf import PdfReader

from fixtures import assessments, projects
from fixtures.cells import cell
from fixtures.libreoffice import converted, recalculated
from fixtures.marks import by_day
from fixtures.workbooks import put, row_cells
from report.assessment.support.response_spectra import spectra
from report.provenance.package_sources import fingerprint
from report.results.xlsx import results_xlsx
from report.text.units import ratio

LETTER_PX, MARGIN_PX = 7, 5
PAGE_IN = {"1": (11.0, 8.5), "9": (11.69, 8.27)}  # Letter and A4: long side, short side
DATA = {"Spectra", "Runs", "LinkRuns"}
LEGIBLE = 0.6  # of 11 pt


@pytest.fixture(
    scope="module",
    params=by_day(
        [assessments.usual, assessments.unpermitted, lambda: assessments.shipped("campus")], 1
    ),
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


def printed(sheet):
    return sheet.print_area.rpartition("!")[2].replace("$", "")


def heading_row(sheet):
    return int(sheet.print_title_rows.split(":")[0].strip("$"))


def shown(cell):
    decimals = len(cell.number_format.partition('"')[0].partition(".")[2])
    return f"{cell.value:.{decimals}f}" if isinstance(cell.value, float) else str(cell.value)


@pytest.mark.quick
def test_sheets_are_in_order_landscape_and_legible(book):
    order = [
        "Summary", "Design", "Clearances", "Adjacent items", "Requirements", "Inputs", "Motions",
        "Records", "Spectra", "Peaks", "Runs", "Links", "LinkRuns",
    ]  # fmt: skip
    assert book.sheetnames == [name for name in order if name in book.sheetnames]
    for sheet in book:
        wide, top = widths(sheet), heading_row(sheet) if sheet.print_title_rows else 3
        for row in sheet.iter_rows(min_row=top):
            for at in (at for at in row if at.value is not None):
                text, letters = shown(at), wide[at.column_letter]
                assert max(map(len, text.split()), default=0) < letters, (sheet.title, text)
                lines = len(wrap(text, int(letters))) or 1
                height = sheet.row_dimensions[at.row].height or 15.0
                assert height >= 15.0 * lines, (sheet.title, text)
                assert lines == 1 or at.alignment.wrap_text, (sheet.title, text)


@pytest.mark.quick
def test_pages_are_legible_on_the_paper_of_the_units_and_data_do_not_print(done, book):
    for sheet in book:
        setup, wide = sheet.page_setup, widths(sheet)
        paper = "1" if done.project.us_first else "9"
        turned = "portrait" if sheet.title == "Summary" else "landscape"
        assert (setup.orientation, str(setup.paperSize)) == (turned, paper)
        if sheet.title in DATA:
            left, top, right, bottom = range_boundaries(printed(sheet))
            assert (left, top) == (right, bottom)
            assert sheet.cell(top, left).value is None
            assert "Data, not printed" in sheet.oddHeader.left.text
            continue
        size_in = PAGE_IN[paper]
        page_in = size_in[turned == "portrait"] - sheet.page_margins.left - sheet.page_margins.right
        columns_in = [(LETTER_PX * letters + MARGIN_PX) / 96.0 for letters in wide.values()]
        if sheet.print_area:
            columns_in = columns_in[: range_boundaries(printed(sheet))[2]]
        if sheet.sheet_properties.pageSetUpPr and sheet.sheet_properties.pageSetUpPr.fitToPage:
            assert (setup.fitToWidth, setup.fitToHeight) in ((1, 0), (None, 0))
            assert sum(columns_in) * LEGIBLE <= page_in
        else:
            assert setup.scale == 100 * LEGIBLE
            keys = sheet.print_title_cols.replace("$", "").split(":")
            assert keys[0] == "A"
            repeated = sum(columns_in[: list(wide).index(keys[1]) + 1])
            assert (repeated + max(columns_in)) * LEGIBLE <= page_in


@pytest.mark.quick
def test_every_sheet_says_what_it_is_of_and_shows_a_verdict_that_changes_to_ng(done, book):
    project = done.project.project
    of = f"revision {project.revision}, hash {fingerprint(done.source, done.shaking)}"
    assert book.properties.title == f"{project.number} {project.name}, {of}"
    for sheet in book:
        assert sheet.oddHeader.left.text.startswith(f"{project.number}   {project.name}   {of}")
    for title in ("Summary", "Design", "Clearances", "Requirements"):
        last = book[title].cell(book[title].max_row, 5).coordinate
        formats = {
            rule.formula[0]: rule.dxf.font
            for some in book[title].conditional_formatting
            if "A1" in some.sqref and last in some.sqref
            for rule in some.rules
        }
        assert set(formats) == {'"NG"', '"Condition"', '"OK with conditions"'}
        assert all(font.b for font in formats.values())
        assert formats['"NG"'].color.rgb == "FFC00000"


INCH = 0.0254
GOVERNING = "Governing array"
SITE = projects.site()
REVIEWED = assessments.REVIEW | {"statistic": "1.1 x largest"}


def assessed(**changes):
    return assessments.package(assessments.motions(7), **changes).assessment


def written(assessment):
    return openpyxl.load_workbook(io.BytesIO(results_xlsx(assessment, spectra(assessment))))


def compared(book, row, headings):
    return [cell(book, f"{row}/{heading}").value for heading in headings]


@pytest.fixture(scope="module")
def before():
    return assessed()


@pytest.fixture(scope="module")
def reviewed():
    return assessed(options=REVIEWED)


NARROW_M = 5 * INCH


def change_inputs(book):
    put(
        book,
        row_cells("Inputs", {"S_DS": 1.3, "Importance factor I_e": 1.25, "Peer review": "Yes"}),
    )
    put(book, {"Inputs/Design value statistic": "1.1 x largest"})
    put(book, {"Clearances/2/Provided": NARROW_M / INCH})


def other_array(reviewed):
    """The array whose displacement does not govern the first clearance."""
    first = reviewed.clearances[0]
    assert {first.clearance.array, first.clearance.object} == {"A1", "A3"}
    return "A1" if first.governing_array == "A3" else "A3"


def change_peaks(book, array):
    runs = book["Runs"]
    head = [cell.value for cell in runs[1]]
    for row in runs.iter_rows(min_row=2):
        if row[0].value == array:
            row[head.index("PRD [in]")].value = 90.0


@pytest.fixture(scope="module")
def changed(before, reviewed, tmp_path_factory):
    """Two workbooks that were changed as by an engineer, as LibreOffice saves them in one start."""
    folder = tmp_path_factory.mktemp("changed")
    of_inputs, of_peaks = written(before), written(reviewed)
    change_inputs(of_inputs)
    change_peaks(of_peaks, other_array(reviewed))
    paths = [folder / "inputs.xlsx", folder / "peaks.xlsx"]
    of_inputs.save(paths[0])
    of_peaks.save(paths[1])
    return recalculated(paths, folder)


@pytest.mark.nightly
def test_the_verdict_follows_five_changed_inputs_as_in_a_report_made_from_them(before, changed):
    gaps = [gap.model_dump() for gap in projects.project().clearances]
    gaps[1] |= {"provided_m": NARROW_M}
    site = SITE | {"s_ds_g": 1.3, "i_e": 1.25}
    after = assessed(site=site, options=REVIEWED, clearances=gaps)
    assert before.clearances[1].ok
    assert not after.clearances[1].ok
    book = changed[0]
    assert cell(book, "Summary/Verdict").value == after.verdict.value
    worst = max(after.clearances, key=lambda gap: gap.demand_capacity)
    row = f"Summary/{worst.clearance.array} to {worst.clearance.object}"
    assert cell(book, f"{row}/D/C").value == float(ratio(worst.demand_capacity))
    assert cell(book, f"{row}/All").value == "NG"
    lengths = [
        f"{heading}, unrounded"
        for heading in ("Prescriptive", "Mean PRD", "Largest PRD", "Analysis", "Floor", "Design")
    ]
    for item in after.arrays:
        row, found = f"Design/{item.id}", item.analysis
        wanted = (
            item.prescriptive.value_m, found.mean_m, found.largest_m, found.value_m,
            item.floor_m, item.design_m,
        )  # fmt: skip
        in_inches = [value / INCH for value in wanted]
        assert compared(book, row, lengths) == pytest.approx(in_inches, rel=1e-9)
        verdict = after.array_verdict(item)
        headings = ("Number of motions", "Verdict", "Statistic")
        assert compared(book, row, headings) == [found.n_motions, verdict, found.basis.value]
    for number, gap in enumerate(after.clearances, start=1):
        row = f"Clearances/{number}"
        lengths = (gap.design_m, gap.factor * INCH, gap.required_m, gap.clearance.provided_m)
        wanted = [*(value / INCH for value in lengths), float(ratio(gap.demand_capacity))]
        headings = ("Design, unrounded", "Factor", "Required, unrounded", "Provided", "D/C")
        assert compared(book, row, headings) == pytest.approx(wanted, rel=1e-9)
        wanted = [gap.governing_array, gap.verdict.value]
        assert compared(book, row, (GOVERNING, "Verdict")) == wanted


@pytest.mark.nightly
def test_the_governing_array_follows_a_peak_that_is_changed(reviewed, changed):
    headings = (GOVERNING, "Design, unrounded", "Required, unrounded", "Provided", "Verdict")
    governing, design, required, provided, result = compared(changed[1], "Clearances/1", headings)
    assert governing == other_array(reviewed)
    assert design == pytest.approx(1.1 * 90.0)
    assert result == ("OK" if required <= provided else "NG")


@pytest.mark.nightly
def test_every_printed_page_names_its_sheet(before, tmp_path):
    path = tmp_path / "results.xlsx"
    path.write_bytes(results_xlsx(before, spectra(before)))
    names = openpyxl.load_workbook(path).sheetnames
    (printed,) = converted([path], tmp_path, "pdf")
    texts = [page.extract_text() for page in PdfReader(printed).pages]
    counts = {name: sum(f"xlsx, {name}" in text for text in texts) for name in names}
    assert {name for name, count in counts.items() if not count} == DATA & set(names)
    assert len(texts) == sum(counts.values())
    project = before.project.project
    hash_ = fingerprint(before.source, before.shaking)
    for said in (project.number, project.name, f"revision {project.revision}", hash_):
        assert all(said in text for text in texts), said


@pytest.mark.nightly
def test_the_example_prints_ten_pages(tmp_path):
    done = assessments.shipped("example")
    path = tmp_path / "results.xlsx"
    path.write_bytes(results_xlsx(done, spectra(done)))
    (printed,) = converted([path], tmp_path, "pdf")
    assert len(PdfReader(printed).pages) == 10
