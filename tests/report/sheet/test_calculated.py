"""A workbook that was saved before its formulas were calculated is a warning."""

import re

import pytest

from cells import address
from sheets import edit, formula_cells, make, pack, parts, saved_by_libreoffice, told


def saying(path, attributes):
    """Let a workbook say how it was calculated."""
    book = re.sub(rb"<calcPr[^>]*/>", b"<calcPr %b/>" % attributes, parts(path)["xl/workbook.xml"])
    return pack(path, parts(path) | {"xl/workbook.xml": book})


@pytest.fixture
def saved(tmp_path):
    return saved_by_libreoffice(tmp_path)


def typed(path):
    """The cells of `saved` in which formulas were typed."""
    return [address(path, f"Arrays/{array}/Friction coefficient") for array in ("A1", "A2")]


MANUAL = b'calcId="191029" calcMode="manual" calcCompleted="0"'


def test_formulas_that_manual_calculation_left_are_named(saved):
    first, second = typed(saved)
    assert told(saying(saved, MANUAL)) == [
        (
            "calculation",
            first,
            "the workbook was saved before its formulas were calculated (calculation is manual),"
            f" and {first}, {second} may show former values: calculate it (F9) and save it",
        )
    ]


def test_a_calculation_that_was_stopped_is_a_warning_without_manual_mode(saved):
    ((_, _, text),) = told(saying(saved, b'calcCompleted="false"'))
    assert text.startswith("the workbook was saved before its formulas were calculated, and Arrays")


def test_a_workbook_whose_values_were_changed_from_outside_asks_to_be_calculated(saved):
    ((name, _, text),) = told(saved)  # the names of its records were
    assert name == "calculation"
    first, _ = typed(saved)
    assert text.startswith(f"the workbook asks to be calculated when it is opened, and {first},")


@pytest.mark.parametrize(
    "says",
    [b"", b'calcMode="manual"', b'calcMode="manual" calcCompleted="1"', b'fullCalcOnLoad="0"'],
)
def test_a_workbook_that_was_calculated_is_no_warning(saved, says):
    assert told(saying(saved, says)) == []


def test_computed_cells_alone_are_a_warning_in_manual_mode_and_none_in_a_fresh_workbook(tmp_path):
    path = make(tmp_path)
    assert told(path) == []  # it asks to be calculated when it is opened
    assert told(saying(path, MANUAL)) == [
        (
            "calculation",
            "Project",
            "the workbook was saved before its formulas were calculated (calculation is manual),"
            " and its computed cells may show former values: calculate it (F9) and save it",
        )
    ]


def test_a_workbook_without_formulas_has_none_that_was_not_calculated(tmp_path):
    def without(book):
        for sheet in book.worksheets:
            for table in sheet.tables.values():
                for column in table.tableColumns:
                    column.calculatedColumnFormula = None
        for cell in formula_cells(book):
            cell.value = None

    assert told(saying(edit(make(tmp_path), without), MANUAL)) == []
