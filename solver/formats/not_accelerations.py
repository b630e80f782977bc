"""A text of numbers that is not a record of acceleration, by its remarks or by its values.

Below the line `Response spectrum, 5% damping`, values that are nowhere negative are refused.
"""

from __future__ import annotations

from solver.errors import InputError
from solver.formats import phrases
from solver.formats.headings import Layout
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
    is_said = is_headed or any(phrases.is_of_acceleration(line) for _, line in layout.remarks)
    remarks, head = list(layout.remarks), layout.heading_index
    if [heading.kind for heading in layout.headings[:1]] == [Kind.OTHER]:
        # Two words above two columns may be a title, as `Displacement history` is.
        remarks.append((head, layout.source.lines[head]))
    for index, line in remarks:
        place = layout.source.at(index)
        if is_positive and phrases.is_of_a_spectrum(line):
            raise InputError(
                f"{place}: found {quoted(line)} above values of which none is negative: this is a"
                " spectrum, not a record; use accelerations by time"
            )
        if not is_said and (quantity := phrases.other_quantity(line)):
            heading = _heading_of(table)
            raise InputError(
                f"{place}: found {quantity!r} but no acceleration; use the acceleration file,"
                f" or a heading such as {heading} if the values are accelerations"
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
