"""A study in memory is every single run, and its numbers follow from them."""

import math
from dataclasses import replace
from itertools import product

import numpy as np
import pytest

import solver
from solver import InputError, Model, Status, coulomb
from solver.studies.curves import statistics

pytestmark = pytest.mark.quick

SLOPES, MUS, LEVELS = [0.0, 0.25], [0.2, 0.3, 0.5], [0.5, 1.0]


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
    return solver.study(motions, slopes_rad=SLOPES, mus=MUS, intensities=LEVELS)


def test_every_run_is_that_of_solve(motions, runs):
    assert runs.prd_m.shape == (2, 3, 2, 4)
    assert runs.lengths.shape == (5, 2, 3, 2, 3 + 4)
    columns = [(motion, each) for motion in motions for each in motion.orientations]
    assert list(runs.runs) == [(motion.id, each.name) for motion, each in columns]
    axes = (SLOPES, MUS, LEVELS, columns)
    for (i, slope), (j, mu), (k, level), (c, (motion, each)) in product(*map(enumerate, axes)):
        scaled = replace(motion, scale=level)
        one = solver.solve(scaled.scene(each, slope_rad=slope, friction=coulomb(mu)))
        found = runs.lengths[:, i, j, k, c]
        names = ("prd_m", "down_m", "up_m", "across_m", "residual_m")
        np.testing.assert_array_equal(found, [getattr(one.result, name) for name in names])
        assert tuple(Status)[runs.status[i, j, k, c]] is one.result.status
        assert Model(runs.model[i, j, k, c]) is one.model


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
    for capacity, motion in zip(found.capacities.intensity, some, strict=True):
        below, above = (
            solver.slide(motion, scale=capacity * factor, slope_rad=0.0, mu=0.3).prd_m
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
        with pytest.raises(InputError, match="give"):
            solver.study(motions, **({"slopes_rad": [0.0], "mus": [0.3]} | wrong))
