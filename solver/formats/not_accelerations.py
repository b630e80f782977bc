"""A text of numbers that is not a record of acceleration, by its remarks or by its values.

Below the line `Response spectrum, 5% damping`, values that are nowhere negative are refused.
"""

from __future__ import annotations

from itertools import islice

from solver.errors import InputError
from solver.formats import remarks
from solver.formats.headings import Layout
from solver.formats.numbers import number_digits
from solver.formats.phrases import Kind
from solver.model import Floats
from solver.records.record import has_gravity, quoted

FEW = 10
"""Samples up to which a text may be the sketch of a pulse: positive only, or at steps above 1 s."""


def check_remarks(layout: Layout, table: Floats) -> None:
    """Raise if the text above the numbers states that they are not accelerations."""
    numbers = table[:, 1:] if table.shape[1] > 1 else table
    # A record may be matched to a spectrum: only a spectrum is nowhere below zero.
    is_positive = len(numbers) > FEW and bool((numbers >= 0.0).all())
    is_headed = any(heading.kind is Kind.ACCELERATION for heading in layout.headings)
    is_said = is_headed or any(remarks.is_of_acceleration(line) for _, line in layout.remarks)
    lines, head = list(layout.remarks), layout.heading_index
    if [heading.kind for heading in layout.headings[:1]] == [Kind.OTHER]:
        # Two words above two columns may be a title, as `Displacement history` is.
        lines.append((head, layout.source.lines[head]))
    for index, line in lines:
        place = layout.source.at(index)
        if is_positive and remarks.is_of_a_spectrum(line):
            raise InputError(
                f"{place}: found {quoted(line)} above values of which none is negative: this is a"
                " spectrum, not a record; use accelerations by time"
            )
        if not is_said and (quantity := remarks.other_quantity(line)):
            heading = _heading_of(table)
            raise InputError(
                f"{place}: found {quantity!r} but no acceleration; use the acceleration file,"
                f" or a heading such as {heading} if the values are accelerations"
            )


def check_count_among(layout: Layout, table: Floats) -> None:
    """Refuse a column whose first or last number is how many the others are, or the step."""
    if table.shape[1] > 1 or len(table) <= FEW:
        return
    values, others = table[:, 0], len(table) - 1
    # The step may stand above or below the count.
    ends = ((0, others), (0, others - 1), (1, others - 1), (-1, others))
    places = [place for place, count in ends if values[place] == count]
    rows = list(islice(layout.rows(), FEW))
    first, *digits = [number_digits(content) for _, content in rows]
    # A first sample that is equal to the step has as many digits as the others.
    if values[0] == layout.source.dt_s and len({*digits}) == 1 and first not in digits:
        places.append(0)
    for place in places:
        index = [*layout.rows()][0 if layout.per_line and place > 0 else place][0]
        raise InputError(
            f"{layout.source.at(index)}: found {values[place]:g}, the step or the number of the"
            " other values; put # before it"
        )


def _heading_of(table: Floats) -> str:
    """Return a heading that would say that a table is accelerations."""
    return "acc_g" if table.shape[1] == 1 else "time_s,acc_g"


def check_both_ways(layout: Layout, table: Floats) -> None:
    """Refuse values without a heading that go one way only: a spectrum or a curve."""
    is_headed = any(heading.kind is Kind.ACCELERATION for heading in layout.headings)
    columns = range(int(table.shape[1] > 1), table.shape[1])
    values = table[:, columns]
    is_curve = len(table) > FEW and bool((values >= 0.0).all() and values.any())
    if not is_curve or is_headed or layout.per_line:
        return
    # Gravity is told as such, later.
    if not any(has_gravity(table[:, i] * layout.scale(i)) for i in columns):
        raise InputError(
            f"{layout.source.at(layout.first)}: found no value below zero: this is a spectrum or a"
            f" curve, not a record; use accelerations by time, or a heading such as"
            f" {_heading_of(table)} if they are"
        )
