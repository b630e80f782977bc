"""Cases and parts: every case in one part, parts of equal size, within the limits."""

import numpy as np
import pytest

from solver.studies import runs as made
from solver.studies.runs import cases_of, grid, joined
from studied import campaign

pytestmark = pytest.mark.quick


def test_a_grid_has_every_combination_once():
    cases = grid(2, [0.0, 0.1], [0.3, 0.4, 0.5], [1.0, 2.0])
    assert len(cases) == 2 * 2 * 3 * 2
    rows = np.stack([cases.building, cases.slope_rad, cases.mu, cases.intensity], axis=-1)
    assert len(np.unique(rows, axis=0)) == len(cases)
    assert rows[1].tolist() == [0.0, 0.0, 0.3, 2.0]


def test_cases_are_joined_in_order():
    one, two = cases_of([(0, 0.1, 0.4, 1.0)]), grid(1, [0.0], [0.5], [1.0, 2.0])
    assert joined([one, two]).mu.tolist() == [0.4, 0.5, 0.5]


@pytest.mark.parametrize("letters", ["x", "xz", "xyz"])
def test_parts_cover_every_case_once_and_in_order(letters):
    c = campaign(letters)
    rows = np.arange(len(c.cases))
    assert np.concatenate([rows[part] for part in c.parts]).tolist() == rows.tolist()
    assert all(part.start < part.stop for part in c.parts)
    assert c.parts == campaign(letters).parts


def test_columns_are_the_headings_of_every_motion():
    assert len(campaign("x").columns) == 4
    assert len(campaign("xyz").columns) == 8
    assert campaign("xyz").rows == 8 * 90


def test_parts_have_about_as_many_cases():
    c = campaign("x", mus=np.linspace(0.1, 0.8, 40), intensities=np.linspace(0.05, 2.0, 40))
    sizes = [part.stop - part.start for part in c.parts]
    assert len(sizes) == made.LEAST_PARTS
    assert max(sizes) - min(sizes) <= 1


@pytest.mark.parametrize(("letters", "limit"), [("x", "PART_ROWS"), ("xyz", "PLANE_PART_ROWS")])
def test_no_part_has_more_rows_than_the_limit(letters, limit, monkeypatch):
    monkeypatch.setattr(made, limit, 16)
    c = campaign(letters)
    assert max(part.stop - part.start for part in c.parts) * len(c.columns) <= 16
    assert c.parts[-1].stop == len(c.cases)
