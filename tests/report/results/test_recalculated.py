"""results.xlsx in LibreOffice: what an engineer changes there, and how it prints."""

import io

import openpyxl
import pytest
from pypdf import PdfReader

import scenes
import stand_in
from cells import cell
from recalculated import converted, recalculated
from report.assessment.spectra import spectra
from report.results.xlsx import results_xlsx
from report.text.units import ratio
from sheets import of, put

pytestmark = pytest.mark.nightly

INCH = 0.0254
GOVERNING = "Governing array, direction"
SITE = stand_in.site()
REVIEWED = scenes.REVIEW | {"statistic": "1.1 x largest"}


def assessed(**changes):
    return scenes.package(scenes.motions(7), **changes).assessment


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
    put(book, of("Inputs", {"S_DS": 1.3, "Importance factor I_e": 1.25, "Peer review": "Yes"}))
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


def test_the_verdict_follows_five_changed_inputs_as_in_a_report_made_from_them(before, changed):
    gaps = [gap.model_dump() for gap in stand_in.project().clearances]
    gaps[1] |= {"provided_m": NARROW_M}
    site = SITE | {"s_ds_g": 1.3, "i_e": 1.25}
    after = assessed(site=site, options=REVIEWED, clearances=gaps)
    assert before.clearances[1].ok
    assert not after.clearances[1].ok
    book = changed[0]
    assert cell(book, "Design/Verdict").value == after.verdict.value
    lengths = ("Prescriptive", "Mean PRD", "Largest PRD", "Computed", "Floor [in]", "Design [in]")
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
        headings = ("Design", "Factor", "Required [in]", "Provided", "D/C")
        assert compared(book, row, headings) == pytest.approx(wanted, rel=1e-9)
        governing = f"{gap.governing_array}, {gap.governing_direction.value}"
        assert compared(book, row, (GOVERNING, "Verdict")) == [governing, gap.verdict.value]


def test_the_governing_array_follows_a_peak_that_is_changed(reviewed, changed):
    headings = (GOVERNING, "Design", "Required [in]", "Provided", "Verdict")
    governing, design, required, provided, result = compared(changed[1], "Clearances/1", headings)
    assert governing == f"{other_array(reviewed)}, any"
    assert design == pytest.approx(1.1 * 90.0)
    assert result == ("OK" if required <= provided else "NG")


def test_every_printed_page_names_its_sheet(before, tmp_path):
    path = tmp_path / "results.xlsx"
    path.write_bytes(results_xlsx(before, spectra(before)))
    names = openpyxl.load_workbook(path).sheetnames
    (printed,) = converted([path], tmp_path, "pdf")
    texts = [page.extract_text() for page in PdfReader(printed).pages]
    counts = {name: sum(f", {name}" in text for text in texts) for name in names}
    assert all(counts.values()), counts
    assert len(texts) == sum(counts.values())
