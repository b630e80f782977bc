"""What the count of typed cells counts."""

from collections import Counter

import pytest

from report.sheet.schema.choices import UnitsFirst
from sheets import blank, make, said, type_into
from typed import typed_cells


@pytest.mark.nightly
def test_only_what_is_filled_and_says_more_than_a_blank_cell_counts(tmp_path):
    path = blank(tmp_path / "input.xlsx", UnitsFirst.US)
    assert all(cells == {} for cells in typed_cells(path).values())
    names = ("Site/Rule set", "Arrays/1/ID", "Options/Peer review")
    type_into(path, dict(zip(names, ("ASCE 7-16", "A1", "No"), strict=True)))
    typed = typed_cells(path)
    assert {**typed["Site"], **typed["Arrays"], **typed["Options"]} == dict(
        zip(said(*names[:2]), ("site.rule_set", "arrays.id"), strict=True)
    )


def test_cells_are_counted_by_sheet_and_field(tmp_path):
    typed = typed_cells(make(tmp_path))
    assert len(typed["Clearances"]) == 5 * 4
    fields = Counter(typed["Motions"].values())
    assert fields["motions.record"] == 3
    assert fields["motions.transverse"] == 0
