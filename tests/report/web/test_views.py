"""The answers of the views beside the solver and the package, value for value."""

import json
import math
from types import SimpleNamespace

import numpy as np
import pytest

from fixtures import project_parts, projects
from fixtures.spaces import spaced
from report.assessment.support import response_surface
from report.web import views
from report.web.run_forces import during, run_forces, slips_of
from solver.errors import InputError
from solver.sliding import model_selection

LONG = projects.motions(2, seconds=20.0)  # 4,000 samples
X_MPS2, DT_S = LONG[0].ax_mps2, LONG[0].dt_s
G = projects.G


def made(*found, **changes):
    data = projects.project(options=project_parts.REVIEW, **changes)
    return projects.assess_input(data, found)


@pytest.fixture(scope="module")
def usual():
    fast = {"mu": 0.4, "mu_fast": 0.5, "mu_rate_s_per_m": 30.0}
    return made(
        *LONG,
        arrays=[projects.array("A1", 0.5), projects.array("A2", 2.0, x=120, **fast)],
        objects=[projects.roof_object("RTU-1", "fixed object", 107, 112, 35, 42)],
        clearances=[projects.clearance("A1", "RTU-1", 9.0)],
    )


@pytest.fixture(scope="module")
def along():
    """One horizontal component, and no vertical one."""
    return made(projects.motion("M1", X_MPS2[::2]))


def named(assessment, array):
    return next(one for one in assessment.arrays if one.array.id == array)


def solved(assessment, array, motion, run):
    """The history of a run, solved again from the input alone."""
    item = named(assessment, array).array
    moved = next(one for one in assessment.shaking.motions if one.id == motion)
    orientation = next(one for one in moved.orientations if one.name == run)
    scene = moved.scene(orientation, slope_rad=item.slope_rad, friction=item.friction)
    solution = model_selection.solve(scene)
    return scene, model_selection.history(scene, solution)


def values(series):
    return np.array([math.nan if v is None else v for v in series["v"]])


@pytest.mark.parametrize("array", ["A1", "A2"])
@pytest.mark.quick
def test_a_run_is_that_of_the_solver_to_the_last_bit(usual, array):
    answer = views.slide(usual, array, "M2")
    scene, history = solved(usual, array, "M2", answer["run"])
    assert answer["prd_m"] == history.result.prd_m == named(usual, array).motions[1].governing.prd_m
    assert answer["t_prd_s"] == history.result.t_prd_s
    slips = [(slip["from_s"], slip["to_s"]) for slip in answer["slips"]]
    assert [t for pair in slips for t in pair] == [event.t_s for event in history.events]
    paths = [history.u_m.tolist(), history.across_m.tolist()]
    assert [series["v"] for series in answer["relative"]["series"]] == paths
    cs, sn = unit(scene.slope_rad)
    normal = (G + scene.az_mps2) * cs + scene.ax_mps2 * sn
    assert values(answer["normal"]["series"][0]) == pytest.approx(normal / G, rel=1e-15, abs=0.0)


def test_any_run_of_a_motion_can_be_asked_for(usual):
    names = [one["name"] for one in views.slide(usual, "A1", "M1")["runs"]]
    assert names == ["record +", "record −", "transverse +", "transverse −"]
    for name in names:
        answer = views.slide(usual, "A1", "M1", name)
        assert answer["prd_m"] == solved(usual, "A1", "M1", name)[1].result.prd_m


def test_the_roof_is_its_acceleration_integrated_by_cubic_sums(usual):
    answer = views.slide(usual, "A1", "M1", "transverse −")
    a, dt = -LONG[0].ay_mps2, DT_S
    velocity, place = [0.0], [0.0]
    for before, after in zip(a[:-1].tolist(), a[1:].tolist(), strict=True):
        place.append(place[-1] + dt * velocity[-1] + dt * dt * (before / 3 + after / 6))
        velocity.append(velocity[-1] + dt * (before + after) / 2)
    assert answer["roof_m"][0] == pytest.approx(place, abs=1e-12)


@pytest.mark.parametrize("array", ["A1", "A2"])
def test_the_friction_used_is_what_changes_the_velocity_of_the_solver(usual, array):
    """By Newton's law from the velocities alone: |G - change of velocity| / N between samples."""
    answer = views.slide(usual, array, "M1")
    scene, history = solved(usual, array, "M1", answer["run"])
    slips = slips_of(history)
    run = named(usual, array).motions[0].governing
    normal, demand, used = run_forces(run, history, slips)
    cs, sn = unit(scene.slope_rad)
    drive = (scene.g_mps2 + scene.az_mps2) * sn - scene.ax_mps2 * cs, -scene.ay_mps2
    velocity = history.v_mps / cs, history.across_mps
    rest = [between(g) - np.diff(v) / scene.dt_s for g, v in zip(drive, velocity, strict=True)]
    found = np.hypot(*rest) / (G * between(normal))
    moves = np.hypot(*velocity) > 0.05
    moves = moves[:-1] & moves[1:]
    assert moves.sum() > 1000
    # The direction of sliding turns between samples, at low velocity the most.
    off = np.abs(found / between(used) - 1.0)[moves]
    assert off.max() < 0.03
    assert np.median(off) < 5e-4
    at_rest = ~during(slips, history.t_s)
    assert at_rest.sum() > 100
    assert (used[at_rest] == demand[at_rest]).all()
    assert demand[at_rest].max() <= scene.friction.mu_static


@pytest.mark.parametrize("array", ["A1", "A2"])
def test_the_friction_used_jumps_where_a_slip_begins_and_ends(usual, array):
    """From the demand, which is then the coefficient, and back to the demand."""
    answer = views.slide(usual, array, "M1")
    scene, _ = solved(usual, array, "M1", answer["run"])
    series, dt = answer["friction"]["series"][0], answer["dt_s"]
    i, v = np.array(series["i"]), values(series)
    assert (np.diff(i) >= 0.0).all()
    assert set(range(4000)) <= set(i.tolist())
    mu = {"A1": 0.45, "A2": 0.4}[array]
    for slip in answer["slips"]:
        assert v[i == slip["from_s"] / dt] == pytest.approx([mu, mu], abs=2e-3)
        first, last = v[i == slip["to_s"] / dt]
        assert first == mu
        assert last == pytest.approx(min(demand_at(scene, slip["to_s"]), mu), abs=1e-9)


def demand_at(scene, t_s):
    """|G| / N between samples, from the accelerations there."""
    t, cs, sn = np.arange(scene.ax_mps2.size) * scene.dt_s, *unit(scene.slope_rad)
    x, y, z = (np.interp(t_s, t, a) for a in (scene.ax_mps2, scene.ay_mps2, scene.az_mps2))
    return math.hypot((G + z) * sn - x * cs, y) / ((G + z) * cs + x * sn)


def unit(angle_rad):
    return math.cos(angle_rad), math.sin(angle_rad)


def between(samples):
    return (samples[:-1] + samples[1:]) / 2


def names_of(panel):
    return [one["name"] for one in panel["series"]]


def test_in_one_axis_the_forces_are_those_of_the_model(along):
    answer = views.slide(along, "A2", "M1")
    assert names_of(answer["relative"]) == ["down"]
    assert len(answer["roof_m"]) == 1
    used = values(answer["friction"]["series"][0])
    assert used.max() == 0.45
    assert (used <= 0.45).all()
    assert [one["label"][0] for one in answer["runs"]] == ["+", "−"]


@pytest.mark.quick
def test_a_run_that_lifts_off_has_forces_and_no_displacement():
    assessment = made(projects.motion("M1", X_MPS2, 3.0 * LONG[0].az_mps2, dt_s=DT_S))
    answer = views.slide(assessment, "A2", "M1")
    assert answer["prd_m"] is answer["t_prd_s"] is None
    assert answer["slips"] == []
    assert set(answer["relative"]["series"][0]["v"]) == {None}
    assert min(answer["normal"]["series"][0]["v"]) < 0.0
    assert answer["texts"]["no_slip"].startswith("The normal force falls below zero: outside")
    assert answer["texts"]["prd"] == "no PRD"
    assert not [one for one in answer["runs"] if one["label"].endswith("no PRD, governing")]
    json.dumps(answer, allow_nan=False)


def test_a_block_that_never_slips_uses_what_friction_is_demanded():
    answer = views.slide(made(projects.motion("M1", 0.1 * X_MPS2)), "A1", "M1")
    used, demand = answer["friction"]["series"]
    assert used["v"] == demand["v"]
    assert answer["slips"] == []
    assert spaced(answer["texts"]["prd"]) == "PRD 0.0 in (0 mm) at 0.00 s"


@pytest.mark.nightly
def test_a_slip_that_the_record_cuts_off_ends_with_it():
    assessment = made(projects.motion("M1", X_MPS2[:1800:2]))
    answer = views.slide(assessment, "A2", "M1")
    _, history = solved(assessment, "A2", "M1", answer["run"])
    assert history.result.end_speed_mps != 0.0
    assert answer["slips"][-1]["to_s"] == history.t_s[-1]
    assert answer["texts"]["notes"][0].startswith("Still sliding at the end of the record: ")
    assert answer["friction"]["series"][0]["v"][-1] == 0.45


def test_the_contour_is_the_surface_of_the_array(usual):
    surface = response_surface.surface(usual, usual.governing)
    answer = views.contour(usual, usual.governing.array.id)
    assert answer["mus"] == surface.mus.tolist()
    assert answer["prd_m"] == surface.mean_m.tolist()
    assert answer["slopes_deg"] == np.degrees(surface.slopes_rad).tolist()
    assert answer["here"]["prd_m"] == pytest.approx(usual.governing.analysis.mean_m, rel=2e-3)
    ids = [array.id for array in usual.arrays if array.id not in surface.others]
    assert ", ".join(one["name"] for one in answer["dots"]) == ", ".join(ids)
    assert len(surface.others) == 1


def test_levels_are_round_in_the_first_unit_and_have_contours(usual):
    answer = views.contour(usual, "A1")
    prd_in = np.array(answer["prd_m"]) / 0.0254
    assert len(answer["levels"]) >= 3
    for level in answer["levels"]:
        value, unit_text = level["text"].split()
        assert max(prd_in.min(), 4e-3) < float(value) < prd_in.max()
        assert unit_text == "in"
        assert level["lines"]


def contours_of(mus, slopes_deg, prd_m, level_m):
    axes = {"mus": np.array(mus), "slopes_rad": np.radians(slopes_deg)}
    return views.contour_lines(SimpleNamespace(**axes, mean_m=np.array(prd_m)))(level_m)


@pytest.mark.quick
def test_a_contour_lies_where_the_logarithm_has_its_level():
    mus, slopes = [0.0, 1.0, 2.5, 3.0], [0.0, 2.0, 5.0]
    prd_m = [[10.0 ** (0.5 * mu - 0.2 * slope) for mu in mus] for slope in slopes]
    (line,) = contours_of(mus, slopes, prd_m, 3.0)
    for mu, slope in line:
        assert 0.5 * mu - 0.2 * slope == pytest.approx(math.log10(3.0), abs=1e-12)
    ends = sorted([line[0], line[-1]])
    assert ends[0][1] == 0.0
    assert ends[1][0] == pytest.approx(3.0) or ends[1][1] == pytest.approx(5.0)


@pytest.mark.quick
def test_around_a_lost_value_and_across_a_saddle_a_contour_stays_whole():
    lost = [[1.0, 1.0, 1.0], [1.0, math.nan, 100.0], [1.0, 100.0, 100.0]]
    assert contours_of([0, 1, 2], [0, 1, 2], lost, 10.0) == []
    lines = contours_of([0, 1], [0, 1], [[100.0, 1.0], [1.0, 1000.0]], 10.0)
    assert len(lines) == 2
    for line in lines:  # around the low corners: the middle is above the level
        assert min(math.dist(point, corner) for point in line for corner in ((1, 0), (0, 1))) < 0.8
        assert len({(mu == 0 or slope == 1) for mu, slope in (line[0], line[-1])}) == 1


def test_a_grid_where_nothing_slides_says_so_and_has_no_levels():
    answer = views.contour(made(projects.motion("M1", 1e-3 * X_MPS2)), "A1")
    assert answer["levels"] == []
    assert answer["texts"]["notes"][1:] == [
        "Nothing slides on the whole grid: no contours are drawn."
    ]


@pytest.mark.parametrize(
    ("asked", "found"),
    [
        (("A9", "M1"), "there is no array 'A9'; choose one of A1, A2"),
        (("A1", "M9"), "there is no motion 'M9'; choose one of M1, M2"),
        (("A1", "M1", "up"), "there is no run 'up'; choose one of record +"),
    ],
)
@pytest.mark.quick
def test_what_the_project_does_not_have_is_named_with_what_it_has(usual, asked, found):
    with pytest.raises(InputError, match=found.replace("+", r"\+")):
        views.slide(usual, *asked)
