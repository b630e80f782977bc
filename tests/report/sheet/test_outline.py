"""The outline of the roof in the workbook: read, echoed, checked against the arrays."""

import pytest

from cells import cell
from inputs import FT
from sheets import edit, make, problems, project, read_workbook, said, same, type_into

ROOF = {"x_from_m": 0.0, "x_to_m": 300 * FT, "y_from_m": 0.0, "y_to_m": 120 * FT, "north_deg": 60.0}


def sides(*values):
    """The cells of the sides of the roof with their values."""
    labels = (f"Site/Roof {side}" for side in ("x from", "x to", "y from", "y to"))
    return dict(zip(labels, values, strict=False))


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
            del book.defined_names[name]
        for name in (*sides(*range(4)), "Site/Direction of north"):
            cell(book, name).offset(column=-1).value = None

    assert same(read_workbook(edit(make(tmp_path), change)).input, project())


def test_half_an_outline_is_refused(tmp_path):
    assert problems(type_into(make(tmp_path), sides(0, 300, 0))) == said(
        "<Site/Roof y to>: roof y to is missing; give all four sides of the rectangle, or none"
    )


def test_sides_are_in_order(tmp_path):
    assert problems(type_into(make(tmp_path), sides(300, 0, 0, 120))) == said(
        "<Site/Roof x to>: x to is 0.00 ft (0.00 m); give more than x from in <Site/Roof x from>,"
        " 300.00 ft (91.44 m)"
    )


def test_arrays_are_inside_the_outline(tmp_path):
    high = (
        "y to is 75.00 ft (22.86 m), outside the roof; give 74.00 ft (22.56 m) or less, or correct"
        " the outline at <Site/Roof y to>"
    )
    assert problems(type_into(make(tmp_path), sides(25, 300, 0, 74))) == said(
        "<Arrays/A1/x from>: x from is 20.00 ft (6.10 m), outside the roof; give 25.00 ft (7.62 m)"
        " or more, or correct the outline at <Site/Roof x from>",
        f"<Arrays/A1/y to>: {high}",
        f"<Arrays/A2/y to>: {high}",
    )
