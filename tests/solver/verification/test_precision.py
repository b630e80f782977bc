"""Work against precision, outside judges, and maps of where methods fail."""

import importlib.util
import itertools
import math
from dataclasses import replace

import numpy as np
import pandas as pd
import pytest

import peers
from solver.model import STANDARD_GRAVITY_MPS2, Status
from solver.rivals import by_scipy
from solver.rivals.methods import METHODS
from solver.sliding import one_axis
from solver.verification import conditioning, stability, study_cases, workprecision
from solver.verification.study_cases import CASES, compared_runs
from solver.verification.verification_motions import near_fault_pulse, own_triples, shortened


@pytest.fixture(scope="module")
def record():
    return shortened(near_fault_pulse(), 5.0)


@pytest.fixture(scope="module")
def points(record):
    return workprecision.work_points([(record, case) for case in CASES[:3]], quick=True)


def test_every_method_runs_in_every_case_over_its_settings(points):
    assert (points["time per run [s]"] > 0.0).all()
    assert set(points["status"]) <= {Status.OK, Status.SLIDING_AT_END}
    assert set(points["method"]) == set(METHODS)
    for name, method in METHODS.items():
        mine = points[points["method"] == name]
        assert mine["case"].nunique() == 3
        wanted = list(method.sweep[::2]) if method.knob else [math.nan]
        np.testing.assert_array_equal(mine["setting"], wanted * 3)


def test_the_exact_method_has_no_error_and_finer_settings_have_less(points):
    exact = points[points["method"] == "exact"]
    assert (exact[["PRD error [m]", "residual error [m]"]] == 0.0).all(axis=None)
    for name in ("paper", "linear", "penalty-explicit", "penalty-implicit"):
        by_setting = points[points["method"] == name].groupby("setting")
        median, sweep = by_setting["PRD error [%]"].median(), METHODS[name].sweep[::2]
        assert median[sweep[-1]] < 0.1 * median[sweep[0]]
    events = points[points["method"].str.endswith(("dop853", "rk45"))]
    assert len(events) == 4 * 3
    assert (events["PRD error [%]"] < 1e-10).all()


def test_a_single_run_takes_what_the_method_prepares_too(points):
    more = points[workprecision.SINGLE] > points[workprecision.TIME]
    assert more.tolist() == (points["method"] == "exact").tolist()


@pytest.mark.quick
def test_times_are_compared_where_a_method_is_as_accurate():
    run = {"record": "r", "case": "c", "setting": 1.0}
    ours = pd.DataFrame([run | {"error": 1e-8, workprecision.TIME: 2.0}])
    others = pd.DataFrame(
        [
            run | {"error": 1e-7, workprecision.TIME: 4.0},
            run | {"error": 1e-8, workprecision.TIME: 10.0},
            run | {"error": 1e-9, workprecision.TIME: 20.0},
        ]
    )
    assert workprecision.times_longer(others, ours, "error") == 5.0
    assert math.isnan(workprecision.times_longer(others[:1], ours, "error"))


@pytest.mark.quick
def test_methods_are_compared_in_every_case_of_the_records():
    assert {case for _, case in compared_runs(False)} == set(CASES)
    assert [len(compared_runs(is_quick)) for is_quick in (True, False)] == [2 * 3, 3 * 6]


@pytest.mark.quick
def test_a_failed_run_is_a_hole_with_its_status(record, monkeypatch):
    stiff = replace(METHODS["penalty-explicit"], sweep=(1e8,), link_steps_per_radian=0.0)
    monkeypatch.setattr(workprecision, "runnable_methods", lambda: [stiff])
    failed = workprecision.work_points([(record, CASES[0])], quick=True)
    assert failed["status"].tolist() == [Status.DIVERGED]
    measured = failed[["time per run [s]", "PRD error [m]", "residual error [%]"]]
    assert measured.isna().all(axis=None)


@pytest.mark.quick
def test_what_is_timed_is_what_is_run(record):
    for case, name in itertools.product(CASES, ("exact", "paper", "penalty-implicit")):
        method, scene = METHODS[name], study_cases.prepared(record, case)
        outcome = method.follow(scene, method.parameters, np.empty((2, 0)))
        assert scene.cs * outcome.s_end == study_cases.run(record, case, name).residual_m


# Two axes


@pytest.fixture(scope="module")
def plane():
    return workprecision.work(own_triples(True)[:1], quick=True)


def of(frame, method):
    return frame[frame["method"] == method]


def errors(frame, method):
    """The largest error over the cases by setting, from coarse to fine."""
    return of(frame, method).groupby("setting", sort=False)["residual error [%]"].max().tolist()


def test_fixed_steps_gain_with_their_number_and_stay_far_behind(plane):
    ours, mine = (errors(plane, name) for name in (workprecision.OURS, workprecision.FIXED))
    assert (np.array(ours) <= 100.0 * np.array(workprecision.TOLERANCES)).all()
    assert (plane[workprecision.TIME] > 0.0).all()
    assert mine[-1] < 0.1 * mine[0]
    assert mine[-1] > 1e3 * ours[4]


@pytest.mark.parametrize("name", ["compiled-dop853", "compiled-rk45"])
def test_compiled_solvers_gain_with_their_tolerance(plane, name):
    off = errors(plane, METHODS[name].label)
    assert off[-1] < 1e-9
    assert off[0] > 1e4 * off[-1]


def test_scipy_takes_part_where_it_is_installed(plane, monkeypatch):
    counts = plane[plane["method"].str.startswith("SciPy")].groupby("method").size()
    assert counts.tolist() == ([3, 12] if by_scipy.is_installed() else [])
    if counts.size:
        assert errors(plane, workprecision.SCIPY)[0] < 1e-4
        off = errors(plane, workprecision.REGULARIZED.label)
        assert off[-1] < 0.05 * off[0]
    monkeypatch.setattr(by_scipy, "is_installed", lambda: False)
    monkeypatch.setattr(workprecision, "MODEL_CASES", CASES[:1])
    points = workprecision.work(own_triples(True)[:1], quick=True)
    assert not points["method"].str.startswith("SciPy").any()


RECORD = near_fault_pulse()


def peer(prd_m, module="math"):
    return peers.Peer(name="Judge", module=module, note="as is", prd_m=prd_m)


def judged(*judges, model=peers.ONE_AXIS, triples=()):
    return list(
        peers.peer_points(
            {model: judges}, [(RECORD, case) for case in CASES[:2]], triples, quick=True
        )
    )


@pytest.mark.quick
def test_a_peer_gets_the_scaled_record_and_its_error_is_of_the_exact_prd():
    peaks = []

    def one_percent_off(scene):
        peaks.append(scene.scale * abs(scene.ax_mps2).max() / STANDARD_GRAVITY_MPS2)
        assert scene.dt_s == RECORD.dt_s
        return 1.01 * one_axis.run(scene).prd_m

    results = judged(peer(one_percent_off))
    assert peaks == pytest.approx([1.0, 1.0])
    assert [point.prd_error_percent for point in results] == pytest.approx([1.0, 1.0])
    assert all(point.seconds > 0.0 and point.version == "unknown" for point in results)
    assert {(point.model, point.note) for point in results} == {("one axis", "as is")}


@pytest.mark.quick
def test_a_peer_that_raises_is_a_hole_with_its_reason_and_one_that_is_absent_left_out():
    def broken(_):
        raise RuntimeError("no library")

    results = judged(peer(broken), peer(lambda _: math.nan))
    assert len(results) == 4
    assert all(math.isnan(p.seconds) and math.isnan(p.prd_error_percent) for p in results)
    assert [point.note for point in results[::2]] == [
        "RuntimeError: no library",
        "as is; did not converge",
    ]
    assert judged(peer(lambda _: 1.0, module="no_such_module")) == []


@pytest.mark.quick
@pytest.mark.parametrize(
    ("model", "judge"),
    [
        *((peers.ONE_AXIS, judge) for judge in peers.JUDGES[peers.ONE_AXIS]),
        *((peers.VERTICAL, judge) for judge in peers.JUDGES[peers.VERTICAL]),
        (peers.TWO_AXES, peers.JUDGES[peers.TWO_AXES][-1]),
    ],
    ids=lambda given: getattr(given, "note", given),
)
def test_a_peer_that_is_installed_comes_near_the_exact_prd(model, judge):
    if importlib.util.find_spec(judge.module) is None:
        pytest.skip(f"{judge.module} is not installed")
    alone = model == peers.ONE_AXIS
    found = judged(judge, model=model, triples=() if alone else own_triples(True))
    # One-way sliding leaves out what comes back, which in a pulse is half of it.
    ceiling = 100.0 if judge.module == "pyslammer" else 2.0 if alone else 5.0
    assert found
    assert all(point.prd_error_percent < ceiling for point in found)


@pytest.fixture(scope="module")
def pulse():
    return near_fault_pulse()


@pytest.fixture(scope="module")
def maps(pulse):
    return {m.title: m for m in stability.maps(pulse, quick=True)}


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
    stepped = [m for m in maps.values() if np.isfinite(m.x_mark)]
    assert len(stepped) == 4
    for m in stepped:
        assert m.x[0] < m.x_mark < m.x[-1]
        order = np.argsort(m.y)
        assert (m.error_percent[order[0]] <= m.error_percent[order[-1]] + 1e-9).all()


def test_a_link_fails_above_its_limit_and_is_sound_well_below(links):
    for m in links:
        above = m.y[:, None] > 1.05 * m.limit
        below = m.y[:, None] < 0.8 * m.limit
        # Not all: a block that slips in one long go hardly strains its link.
        assert m.failed[above].mean() > 0.8
        assert below.any()
        assert not m.failed[below].any()
        # A soft one is far off whatever its sub-step, a stiff one is not.
        fine = int(m.y.argmin())
        assert m.error_percent[fine, 0] > 1.0
        assert np.nanmin(m.error_percent[fine]) < 0.01


@pytest.mark.quick
def test_at_the_critical_friction_the_ninth_digit_shows_and_elsewhere_it_does_not(pulse):
    still, shaken, wide, design = conditioning.conditioning(pulse, quick=True)
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
