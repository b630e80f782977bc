"""Parts and studies in memory: every row is the solution of its case, to the bit."""

import math
from dataclasses import replace
from itertools import product

import numpy as np
import pytest

import solver
from fixtures.campaigns import campaign, motion
from solver import InputError, Model, Status, coulomb, solve
from solver.studies import runs as made
from solver.studies.campaign import LEAST_PARTS, Campaign, cases_of, grid
from solver.studies.curves import first_allowed, statistics
from solver.studies.runs import LENGTHS, STATUSES, Runner, run_part
from solver.verification.paper_studies import MUS as PAPER_MUS
from solver.verification.paper_studies import PPAS_G, SLOPES_DEG, design_curves
from solver.verification.verification_motions import own_records, scale_to

pytestmark = pytest.mark.quick


def solution(c, row, column):
    number, heading = c.columns[column]
    own = c.motions[c.cases.building[row]][number]
    own = replace(own, scale=own.scale * float(c.cases.intensity[row]))
    friction = coulomb(float(c.cases.mu[row]))
    scene = own.scene(heading, slope_rad=float(c.cases.slope_rad[row]), friction=friction)
    return solve(scene, made.SETTINGS)


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


def test_rows_are_solutions_where_the_vertical_changes_the_residual_alone():
    rng = np.random.default_rng(5)
    ax, az = rng.normal(0.0, 4.0, 40), rng.normal(0.0, 0.3, 40)
    shaken = solver.motion(ax, az_mps2=az - az.mean(), dt_s=0.05, id="shaken")
    cases = grid(1, [0.0, 0.03, 0.06], [0.2, 0.25, 0.3, 0.35, 0.4], np.linspace(0.5, 2.0, 7))
    parts = list(assert_rows_agree(Campaign(motions=((shaken,),), cases=cases)))
    models = {int(model) for rows in parts for model in np.unique(rows.model)}
    assert models >= {Model.ONE_AXIS, Model.ONE_AXIS_VERTICAL}


@pytest.mark.nightly
def test_curves_are_those_of_the_paper_procedure():
    """Figs. 10 to 12: both signs of the slope are both polarities of the record."""
    record = own_records(True)[0]
    study = design_curves(record)
    one = replace(motion(0), dt_s=record.dt_s, ax_mps2=record.a_mps2, scale=scale_to(record, 1.0))
    slopes, ppas = SLOPES_DEG[::7], PPAS_G[3::6]
    c = Campaign(motions=((one,),), cases=grid(1, np.radians(slopes), PAPER_MUS, ppas))
    prd = run_part(Runner(c), slice(0, len(c.cases))).lengths[0].max(axis=1)
    prd = prd.reshape(slopes.size, PAPER_MUS.size, ppas.size)
    assert prd == pytest.approx(study.prd_m[::7, :, 3::6], rel=1e-12, abs=1e-15)
    wanted = 0.1 * float(prd[1, :, -1].max())
    least = first_allowed(PAPER_MUS, prd[1, :, -1], wanted)
    expected = study.minimum_mu(float(slopes[1]), float(ppas[-1]), wanted)
    assert least == pytest.approx(expected, rel=1e-9)


SCALES = {"slopes_rad": [0.0, 0.25], "mus": [0.2, 0.3, 0.5], "intensities": [0.5, 1.0]}


@pytest.fixture(scope="module")
def motions():
    rng = np.random.default_rng(3)
    rows = 6.0 * rng.standard_normal((4, 400)).cumsum(axis=1) / 20.0
    rows *= np.sin(np.linspace(0.0, np.pi, 400))
    rows[:, -60:] = 0.0
    along = [
        solver.motion(row, az_mps2=0.2 * row[::-1], dt_s=0.02, id=f"M{k}", signs=(1,))
        for k, row in enumerate(rows[:3])
    ]
    return [*along, solver.motion(rows[3], rows[0], dt_s=0.02, id="both")]


@pytest.fixture(scope="module")
def runs(motions):
    return solver.study(motions, **SCALES)


def test_every_run_is_that_of_solve(motions, runs):
    assert runs.prd_m.shape == (2, 3, 2, 4)
    assert runs.lengths.shape == (5, 2, 3, 2, 3 + 4)
    columns = [(one, each) for one in motions for each in one.orientations]
    assert list(runs.runs) == [(one.id, each.name) for one, each in columns]
    axes = (*SCALES.values(), columns)
    for (i, slope), (j, mu), (k, level), (c, (given, each)) in product(*map(enumerate, axes)):
        scene = replace(given, scale=level).scene(each, slope_rad=slope, friction=coulomb(mu))
        one = solve(scene, made.SETTINGS)
        found = runs.lengths[:, i, j, k, c]
        names = ("prd_m", "down_m", "up_m", "across_m", "residual_m")
        np.testing.assert_array_equal(found, [getattr(one.result, name) for name in names])
        assert tuple(Status)[runs.status[i, j, k, c]] is one.result.status
        assert Model(runs.model[i, j, k, c]) is one.model
        closer = solve(scene).result.prd_m
        np.testing.assert_allclose(found[0], closer, rtol=made.SETTINGS.tolerance)


def test_the_prd_of_a_motion_is_its_largest_and_unknown_where_a_run_is(runs):
    final = runs.status == 0
    assert not final.all()
    expected = np.where(final, runs.lengths[0], np.nan)
    np.testing.assert_array_equal(runs.prd_m[..., 0], expected[..., 0])
    both = expected[..., 3:]
    np.testing.assert_array_equal(
        runs.prd_m[..., 3],
        np.where(np.isnan(both).any(axis=-1), np.nan, np.fmax.reduce(both, axis=-1)),
    )
    np.testing.assert_array_equal(runs.statistics().mean_m, statistics(runs.prd_m).mean_m)
    lost = f"{(~final).sum()} without a final value"
    assert repr(runs).startswith(f"StudyRuns: {runs.status.size} runs, {lost}; slopes 2")


def test_least_friction_is_read_off_the_mean(runs):
    mean = runs.statistics().mean_m
    allowed = 0.5 * (mean[0, 1, 0] + mean[0, 2, 0])
    found = runs.minimum_friction(allowed)
    assert found.shape == (2, 2)
    assert found[0, 0] == pytest.approx(0.4)
    assert np.isnan(runs.minimum_friction(0.0)).any()


def test_a_fragility_is_fitted_to_the_first_exceedance_of_each_motion(motions):
    levels = np.linspace(0.1, 3.0, 30)
    # Those of one component and no vertical, whose PRD rises with intensity.
    some = [solver.motion(m.ax_mps2, dt_s=m.dt_s, id=m.id, signs=(1,)) for m in motions[:3]]
    study = solver.study(some, slopes_rad=[0.0], mus=[0.3], intensities=levels)
    limit_m = 0.01
    found = study.fragility(limit_m, slope_rad=0.0, mu=0.3)
    for capacity, one in zip(found.capacities.intensity, some, strict=True):
        below, above = (
            solver.slide(one, scale=capacity * factor, slope_rad=0.0, mu=0.3).prd_m
            for factor in (1.0, 1.0 + 1e-4)
        )
        assert below <= limit_m < above
    logs = np.log(found.capacities.intensity)
    assert found.fitted.theta == pytest.approx(np.exp(logs.mean()))
    assert found.fitted.beta == pytest.approx(logs.std(ddof=1))
    fit = f"median {found.fitted.theta:.4g}, dispersion {found.fitted.beta:.3g}"
    assert repr(found) == f"Fragility: {fit}, 3 motions, 0 censored"
    exceeded = ~(study.prd_m[0, 0] <= limit_m)
    assert found.exceeded.tolist() == exceeded.sum(axis=1).tolist()


def test_a_table_has_a_row_for_each_run(runs):
    frame = runs.to_frame()
    assert len(frame) == runs.status.size
    row = frame.loc[(0.25, 0.3, 1.0, "both", "transverse −")]
    at = (1, 1, 1, runs.runs.index(("both", "transverse −")))
    assert row["slope_deg"] == pytest.approx(math.degrees(0.25))
    assert row["prd_m"] == runs.lengths[0][at]
    assert row["status"] == tuple(Status)[runs.status[at]].value
    assert row["model"] == Model(runs.model[at]).title


def test_a_record_is_a_motion_of_its_name():
    pulse = solver.record_from_values("pulse", [0.0, 4.0, -4.0, 0.0, 0.0], units="m/s2", dt_s=0.1)
    found, wanted = (
        solver.study([given], slopes_rad=[0.0], mus=[0.2])
        for given in (pulse, solver.motion(pulse))
    )
    assert found.motions[0].id == "pulse"
    assert found.to_frame().equals(wanted.to_frame())


def test_what_is_no_study_is_refused(motions):
    with pytest.raises(InputError, match="motions is empty"):
        solver.study([], slopes_rad=[0.0], mus=[0.3])
    with pytest.raises(InputError, match="two motions have one name"):
        solver.study([motions[0], motions[0]], slopes_rad=[0.0], mus=[0.3])
    for wrong in ({"mus": [0.3, 0.2]}, {"mus": [0.0, 0.2]}, {"slopes_rad": [2.0]}):
        with pytest.raises(InputError, match=r"[:;] use"):
            solver.study(motions, **({"slopes_rad": [0.0], "mus": [0.3]} | wrong))


@pytest.mark.parametrize("letters", ["x", "xz", "xyz"])
def test_parts_cover_every_case_once_and_in_order(letters):
    c = campaign(letters)
    rows = np.arange(len(c.cases))
    assert np.concatenate([rows[part] for part in c.parts]).tolist() == rows.tolist()
    assert all(part.start < part.stop for part in c.parts)
    assert c.parts == campaign(letters).parts


def test_parts_have_about_as_many_cases():
    c = campaign("x", mus=np.linspace(0.1, 0.8, 40), intensities=np.linspace(0.05, 2.0, 40))
    sizes = [part.stop - part.start for part in c.parts]
    assert len(sizes) == LEAST_PARTS
    assert max(sizes) - min(sizes) <= 1


@pytest.mark.parametrize(("letters", "limit"), [("x", "PART_ROWS"), ("xyz", "PLANE_PART_ROWS")])
def test_no_part_has_more_rows_than_the_limit(letters, limit, monkeypatch):
    monkeypatch.setattr(f"solver.studies.campaign.{limit}", 16)
    c = campaign(letters)
    assert max(part.stop - part.start for part in c.parts) * len(c.columns) <= 16
    assert c.parts[-1].stop == len(c.cases)
