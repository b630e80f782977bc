"""A workbook that LibreOffice saved is read and changed like any other."""

import pytest
from openpyxl import load_workbook
from pypdfium2 import PdfDocument
from test_live import OVER, formulas, lost, typed_over

from cells import cell
from projects.example import make as example
from recalculated import converted
from report.sheet.reading.read import read
from report.sheet.schema.choices import UnitsFirst
from report.sheet.writing.template import write_template
from sheets import arrays, blank, edit, make, project, said, same, site, type_into

pytestmark = pytest.mark.nightly

WEIGHT = "Arrays/A1/Weight"
METRIC = project(
    arrays=arrays(i_p=1.5),
    objects=[row.model_dump() | {"i_p": 1.25} for row in project().objects],
    site=site(i_e=1.25, risk_category="III"),
)


@pytest.fixture(scope="module")
def saved(tmp_path_factory):
    """Workbooks by name, beside their records, as LibreOffice saves them in one start."""
    folder = tmp_path_factory.mktemp("saved")
    filled = type_into(make(folder), {WEIGHT: "=21000*2"}).rename(folder / "filled.xlsx")
    metric = folder / "metric.xlsx"
    write_template(metric, units=UnitsFirst.SI, example=METRIC)
    empty = blank(folder / "blank.xlsx", UnitsFirst.SI)
    paths = converted([filled, empty, metric], folder)
    (paths[0].parent / "records").symlink_to(folder / "records")
    return {path.stem: path for path in paths}


def test_what_libreoffice_saved_is_read_and_changed(saved):
    """With formulas as LibreOffice writes them, and the value of one that was typed."""
    assert same(read(saved["filled"]).project, project())
    assert same(read(saved["metric"]).project, METRIC)
    book = saved["filled"].with_name("changed.xlsx")
    book.write_bytes(saved["filled"].read_bytes())
    before = read(book).project
    assert cell(load_workbook(book), WEIGHT).value == "=21000*2"
    after = read(type_into(book, {"Arrays/A1/x to": 99.0}))
    assert after.problems == ()
    first = after.project.arrays[0]
    assert first.x_to_m == pytest.approx(99 * 0.3048)
    assert first.weight_n == before.arrays[0].weight_n == pytest.approx(42000 * 4.4482216152605)
    assert after.project.arrays[1] == before.arrays[1]


def test_a_saved_book_gives_no_warning_but_of_what_is_typed_over(saved, tmp_path):
    book = saved["filled"]
    assert formulas(book) != formulas(make(tmp_path))  # it spells some of them in another way
    assert lost(saved["blank"]) == lost(book) == []
    for name in saved:
        sheet = read(saved[name])
        assert (sheet.unseen, sheet.warnings) == ((), ()), name
    spoiled = book.with_name("spoiled.xlsx")
    spoiled.write_bytes(book.read_bytes())
    assert tuple(lost(edit(spoiled, typed_over))) == said(*OVER)


def test_the_example_prints_on_twelve_sheets(tmp_path):
    paths = [tmp_path / f"{units}.xlsx" for units in UnitsFirst]
    for units, path in zip(UnitsFirst, paths, strict=True):
        write_template(path, units=units, example=example.project())
    for path in converted(paths, tmp_path, "pdf"):
        with PdfDocument(path) as printed:
            assert len(printed) <= 12, path
