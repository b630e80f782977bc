"""The outline of the roof in the workbook: read, echoed, checked against the arrays."""

import pytest
from openpyxl import load_workbook

from sheets import FT, edit, make, problems, project, read_workbook, same

ROOF = {"x_from_m": 0.0, "x_to_m": 300 * FT, "y_from_m": 0.0, "y_to_m": 120 * FT, "north_deg": 60.0}


def cell(book, field):
    """The address of a field of the block, by its defined name."""
    return book.defined_names[f"roof_{field}"].attr_text.split("!")[1].replace("$", "")


def changed(path, **values):
    """Change fields of the roof in a workbook; return the addresses by field."""
    addresses = {}

    def change(book):
        for field in ("x_from_m", "x_to_m", "y_from_m", "y_to_m", "north_deg"):
            addresses[field] = f"Site!{cell(book, field)}"
        for field, value in values.items():
            book["Site"][cell(book, field)] = value

    edit(path, change)
    return addresses


def test_the_outline_is_read_back_as_written(tmp_path):
    data = read_workbook(make(tmp_path, roof=ROOF)).input
    assert same(data, project(roof=ROOF))
    assert data.roof.placed.x_to_m == pytest.approx(300 * FT)


def test_without_an_outline_north_is_up(tmp_path):
    roof = read_workbook(make(tmp_path)).input.roof
    assert roof.placed is None
    assert roof.north_deg == 90.0


def test_a_workbook_without_the_block_is_read(tmp_path):
    def change(book):
        for name in [n for n in book.defined_names if n.startswith("roof_")]:
            address = book.defined_names[name].attr_text.split("!")[1].replace("$", "")
            row = address.lstrip("ABC")
            book["Site"][f"A{row}"] = None
            del book.defined_names[name]

    assert same(read_workbook(edit(make(tmp_path), change)).input, project())


def test_half_an_outline_is_refused(tmp_path):
    path = make(tmp_path)
    at = changed(path, x_from_m=0, x_to_m=300, y_from_m=0)
    assert problems(path) == (
        f"{at['y_to_m']}: y to is missing; give all four sides of the rectangle, or none",
    )


def test_sides_are_in_order(tmp_path):
    path = make(tmp_path)
    at = changed(path, x_from_m=300, x_to_m=0, y_from_m=0, y_to_m=120)
    assert problems(path) == (
        f"{at['x_to_m']}: x to is 0.00 ft (0.00 m); give more than x from in {at['x_from_m']}, "
        "300.00 ft (91.44 m)",
    )


def column(path, heading):
    """The letter of a column of Arrays."""
    sheet = load_workbook(path)["Arrays"]
    headed = (cell for row in sheet.iter_rows() for cell in row if cell.value == heading)
    return next(headed).column_letter


def test_arrays_are_inside_the_outline(tmp_path):
    path = make(tmp_path)
    at = changed(path, x_from_m=25, x_to_m=300, y_from_m=0, y_to_m=74)
    x_from, y_to = column(path, "x from [ft]"), column(path, "y to [ft]")
    high = (
        "y to is 75.00 ft (22.86 m), outside the roof; give 74.00 ft (22.56 m) or less, or correct "
        f"the outline at {at['y_to_m']}"
    )
    assert problems(path) == (
        f"Arrays!{x_from}8: x from is 20.00 ft (6.10 m), outside the roof; give 25.00 ft (7.62 m) "
        f"or more, or correct the outline at {at['x_from_m']}",
        f"Arrays!{y_to}8: {high}",
        f"Arrays!{y_to}9: {high}",
    )
