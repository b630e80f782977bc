"""Every row of a part is the solution of its case by `solver.solve`, to the bit."""

import math
from dataclasses import replace

import numpy as np
import pytest

from solver import solve
from solver.model import Status, coulomb
from solver.sliding.least_model import Model
from solver.sliding.sweep import sweep
from solver.studies.curves import first_allowed
from solver.studies.runs import LENGTHS, STATUSES, Campaign, Runner, cases_of, grid, run_part
from solver.verification.paper_studies import MUS as PAPER_MUS
from solver.verification.paper_studies import PPAS_G, SLOPES_DEG, design_curves
from solver.verification.study import own_records, scale_to
from studied import INTENSITIES, MUS, SLOPES, campaign, motion

pytestmark = pytest.mark.quick


def run_all(c):
    return run_part(Runner(c), slice(0, len(c.cases)))


def solution(c, row, column):
    number, heading = c.columns[column]
    own = c.motions[c.cases.building[row]][number]
    own = replace(own, scale=own.scale * float(c.cases.intensity[row]))
    friction = coulomb(float(c.cases.mu[row]))
    return solve(own.scene(heading, slope_rad=float(c.cases.slope_rad[row]), friction=friction))


def assert_rows_agree(c):
    runner = Runner(c)
    for part in c.parts:
        rows = run_part(runner, part)
        for row in range(part.stop - part.start):
            for column in range(len(c.columns)):
                one = solution(c, part.start + row, column)
                wanted = [getattr(one.result, name) for name in LENGTHS]
                np.testing.assert_array_equal(rows.lengths[:, row, column], wanted)
                assert STATUSES[rows.status[row, column]] is one.result.status
                assert rows.model[row, column] == one.model
        yield rows


@pytest.mark.parametrize(
    ("letters", "models"), [("x", {0, 1}), ("xz", {0, 1, 2}), ("xyz", {0, 1, 2, 3})]
)
def test_rows_are_solutions_to_the_bit(letters, models):
    parts = list(assert_rows_agree(campaign(letters, 1, buildings=2, mus=(0.0, 0.3, 0.7))))
    assert {int(r) for rows in parts for r in np.unique(rows.model)} == models
    found = {STATUSES[s] for rows in parts for s in np.unique(rows.status)}
    assert found >= {Status.OK, Status.SLIDING_AT_END, Status.UPLIFT}


def test_rows_are_solutions_where_rounding_decides_whether_the_block_slips():
    """Friction at the demand itself, and within a few units in the last place of it."""
    c = campaign("x", 1)
    rows = []
    for slope in (0.0, 0.02):
        for column in range(2):
            number, heading = c.columns[column]
            one = c.motions[0][number].scene(heading, slope_rad=slope, friction=coulomb(0.0))
            demand = solve(replace(one, scale=0.3)).friction_demand
            for step in range(-3, 4):
                rows.append((0, slope, demand + step * math.ulp(demand), 0.3))
    list(assert_rows_agree(replace(c, cases=cases_of(rows))))


def test_rows_are_solutions_at_the_edge_of_uplift():
    c = campaign("x", 1)
    slope, peak = 0.4, float(np.abs(c.motions[0][0].ax_mps2).max())
    lifts = 9.80665 * math.cos(slope) / (peak * math.sin(slope))
    scales = [lifts * (1.0 + step * 2.0**-52) for step in range(-4, 5)]
    list(assert_rows_agree(replace(c, cases=grid(1, [slope], [0.5], scales))))


def test_a_part_without_vertical_agrees_with_a_sweep():
    c = campaign("x", 1)
    rows = run_all(c)
    one = c.motions[0][0]
    swept = sweep(one.ax_mps2, one.dt_s, slopes_rad=SLOPES, mus=MUS, scales=INTENSITIES)
    np.testing.assert_array_equal(rows.lengths[0, :, 0], swept.prd_m.ravel())


@pytest.mark.nightly
def test_curves_are_those_of_the_paper_procedure():
    """Figs. 10 to 12: both signs of the slope are both polarities of the record."""
    record = own_records(True)[0]
    study = design_curves(record)
    one = replace(motion(0), dt_s=record.dt_s, ax_mps2=record.a_mps2, scale=scale_to(record, 1.0))
    slopes, ppas = SLOPES_DEG[::7], PPAS_G[3::6]
    c = Campaign(motions=((one,),), cases=grid(1, np.radians(slopes), PAPER_MUS, ppas))
    prd = run_all(c).lengths[0].max(axis=1)
    prd = prd.reshape(slopes.size, PAPER_MUS.size, ppas.size)
    assert prd == pytest.approx(study.prd_m[::7, :, 3::6], rel=1e-12, abs=1e-15)
    wanted = 0.1 * float(prd[1, :, -1].max())
    least = first_allowed(PAPER_MUS, prd[1, :, -1], wanted)
    expected = study.minimum_mu(float(slopes[1]), float(ppas[-1]), wanted)
    assert least == pytest.approx(expected, rel=1e-9)


def test_no_slip_has_no_displacement():
    c = campaign("xz", 1)
    rows = run_all(c)
    assert (rows.lengths[:, rows.model == Model.NO_SLIP] == 0.0).all()
