"""Maps show failure where theory has it, and conditioning shows where no method can help."""

import numpy as np
import pytest

from solver.verification import stability
from solver.verification.study import near_fault_pulse

pytestmark = pytest.mark.quick


@pytest.fixture(scope="module")
def record():
    return near_fault_pulse()


@pytest.fixture(scope="module")
def maps(record):
    return {m.title: m for m in stability.maps(record, quick=True)}


@pytest.fixture
def links(maps):
    found = [m for title, m in maps.items() if title.startswith("Link")]
    assert len(found) == 2
    return found


def test_every_map_has_a_cell_for_each_pair_and_marks_those_that_failed(maps):
    assert len(maps) == 8
    for m in maps.values():
        assert m.error_percent.shape == m.failed.shape == (m.y.size, m.x.size)
        np.testing.assert_array_equal(m.failed, np.isnan(m.error_percent))
        assert (np.diff(m.x) > 0.0).all()
        assert m.note.startswith("near-fault-pulse")


def test_a_link_fails_above_its_limit_and_is_sound_well_below(links):
    for m in links:
        above = m.y[:, None] > 1.05 * m.limit
        below = m.y[:, None] < 0.8 * m.limit
        # Not all: a block that slips in one long go hardly strains its link.
        assert m.failed[above].mean() > 0.8
        assert below.any()
        assert not m.failed[below].any()


def test_a_soft_link_is_far_off_whatever_its_sub_step_and_a_stiff_one_is_not(links):
    for m in links:
        fine = int(m.y.argmin())
        assert m.error_percent[fine, 0] > 1.0
        assert np.nanmin(m.error_percent[fine]) < 0.01


def test_the_stepped_methods_are_better_with_smaller_sub_steps_on_both_sides_of_rest(maps):
    stepped = [m for m in maps.values() if np.isfinite(m.x_mark)]
    assert len(stepped) == 4
    for m in stepped:
        assert m.x[0] < m.x_mark < m.x[-1]
        order = np.argsort(m.y)
        assert (m.error_percent[order[0]] <= m.error_percent[order[-1]] + 1e-9).all()


def test_two_axes_end_without_a_result_at_steep_rising_laws_and_coarse_samples_alone(maps):
    rises, falls = (
        maps[f"This program in two axes: sampling interval against rate, μ {way}"]
        for way in ("rises", "falls")
    )
    assert rises.failed[:, -1].all()
    assert not rises.failed[:, rises.x <= 1000.0].any()
    assert rises.failed[0].sum() > rises.failed[-1].sum()
    assert not falls.failed.any()
    assert np.nanmax(rises.error_percent) < 0.1


def test_at_the_critical_friction_the_ninth_digit_shows_and_elsewhere_it_does_not(record):
    still, shaken, wide, design = stability.conditioning(record, quick=True)
    nearest = int(np.abs(still.mu / stability.CRITICAL_MU - 1.0).argmin())
    assert abs(still.mu[nearest] / stability.CRITICAL_MU - 1.0) < 1.1e-6
    assert still.change_percent.max() > 1000 * np.median(wide.change_percent)
    # Below the critical friction PRD ~ mu_c - mu: a change of 1e-9 at 1e-6 from it is 1 in 1000.
    below = still.mu < stability.CRITICAL_MU
    expected = 100.0 * 1e-9 * still.mu[below] / (stability.CRITICAL_MU - still.mu[below])
    large = still.prd_m[below] > 1e-3
    assert still.change_percent[below][large] == pytest.approx(expected[large], rel=1e-3)
    assert (still.prd_m[~below] == 0.0).all()
    assert shaken.ppa_g == stability.PPA_G
    assert np.median(design.change_percent) > 1.0
